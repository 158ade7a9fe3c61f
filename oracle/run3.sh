#!/bin/bash
# Compares triangulations of space with CGAL's, exactly: oracle/run3.sh [seconds]   (default 60 for the generated cases, after the large ones)
# Exit code 1 on any difference. Needs oracle/install.sh once; the largest cases take some 4 GB of memory.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
"$here/build.sh" space
data=${ORTHOBALL_DATA:-$here/../../shared/data}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
bin=$here/../target
cases=$bin/release/examples/space_cases
if [ -d "$data" ]; then
  python3 "$here/corpora_space.py" "$data"/points/*/* "$data"/plc/*/*.node "$data"/surface/*/*.off >"$work/real.cases"
else
  echo "no real inputs at $data: generated cases only"
fi
"$cases" edited 2000 >"$work/edited.cases"
"$cases" large >"$work/large.cases"
python3 "$here/compare_space.py" "$bin/release/examples/simplices_of" "$bin/oracle/cgal-space_sets" "$cases" "${1:-60}" "$work"/*.cases
# The same answers with four threads.
python3 "$here/compare_space.py" "$bin/release/examples/simplices_of 4" "$bin/release/examples/simplices_of 1" "$cases" 0 "$work/large.cases" "$work/real.cases" | tail -2
if command -v tetgen >/dev/null; then
  python3 "$here/tetgen_space.py" "$bin/release/examples/simplices_of" "$cases"
else
  echo "no tetgen: not compared with it"
fi
