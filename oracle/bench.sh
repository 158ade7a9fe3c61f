#!/bin/sh
# Speed against CGAL, spade and Triangle in one run, as ratios of medians: oracle/bench.sh [repeats] [points]   (default 5, 10^6)
set -eu
here=$(cd "$(dirname "$0")" && pwd)
"$here/build.sh"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 "$here/bench.py" "$here/../target" "$work" "${1:-5}" "${2:-1000000}"
