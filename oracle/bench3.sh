#!/bin/sh
# Speed in space against CGAL in one run, as ratios of medians: oracle/bench3.sh [repeats] [points] [parts]   (default 5, 10^6, all)
set -eu
here=$(cd "$(dirname "$0")" && pwd)
"$here/build.sh" space
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 "$here/bench_space.py" "$here/../target" "$work" "${1:-5}" "${2:-1000000}" ${3:-}
