# Sourced by run.sh and test.sh. The exact kernel builds GMP from source, which needs gcc, make and m4; only m4 is seldom there.
if ! command -v m4 >/dev/null; then
    echo "m4 is missing; installing it with apt-get" >&2
    if [ "$(id -u)" -eq 0 ]; then sudo=(); else sudo=(sudo); fi
    "${sudo[@]}" apt-get update -qq >&2
    DEBIAN_FRONTEND=noninteractive "${sudo[@]}" apt-get install -y -qq --no-install-recommends m4 >&2
fi
