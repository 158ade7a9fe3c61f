#!/bin/sh
# Every real graph refined by ours, CGAL's Mesh_2, spade and Triangle, side by side: oracle/refine.sh [degrees] [part of a file's name]
set -eu
here=$(cd "$(dirname "$0")" && pwd)
"$here/build.sh"
python3 "$here/refine.py" "$here/../target" "${ORTHOBALL_DATA:-$here/../../shared/data}" "$@"
