#!/bin/sh
# Compares sets of triangles with CGAL's, exactly: oracle/run.sh [seconds]   (default 60 for the generated cases)
# Exit code 1 on any difference. Needs oracle/install.sh once.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
"$here/build.sh"
data=${ORTHOBALL_DATA:-$here/../../shared/data}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
if [ -d "$data" ]; then
  python3 "$here/corpora.py" poly "$data"/pslg/as_poly/*.poly >"$work/pslg.cases"
  python3 "$here/corpora.py" points "$data"/points/*/*.node "$data"/points/*/*.json "$data"/points/*/*.wkt "$data"/points/*/*.xyz >"$work/points.cases"
else
  echo "no real inputs at $data: generated cases only"
fi
bin=$here/../target
python3 "$here/compare.py" "$bin/release/examples/triangles_of" "$bin/oracle/cgal-sets" "${1:-60}" "$bin/release/examples/oracle_cases" $(ls "$work"/*.cases 2>/dev/null)
