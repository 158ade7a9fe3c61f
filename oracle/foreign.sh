#!/bin/sh
# Tetrahedral meshes of TetGen, CGAL and Gmsh judged by `check`, whole and spoilt in five ways: oracle/foreign.sh [points]   (default 1500)
# Exit code 1 if a verdict is wrong or a witness does not name the place. Needs oracle/install.sh once.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
"$here/build.sh" space
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 "$here/foreign.py" "$here/../target" "$work" "${1:-1500}"
