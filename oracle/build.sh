#!/bin/sh
# Builds the programs that the other scripts run, into target/oracle and target/release: build.sh [plane|space]   (default plane)
set -eu
cd "$(dirname "$0")"
out=../target/oracle
mkdir -p "$out"
case ${1:-plane} in
  plane) programs="sets bench mesh" headers="common.hpp mesh.hpp" ;;
  space) programs="space_sets space_bench space_mesh" headers="space.hpp" ;;
esac
for name in $programs; do
  # shellcheck disable=SC2086
  if [ ! -x "$out/cgal-$name" ] || [ -n "$(cd cgal && find "$name.cpp" $headers -newer "../$out/cgal-$name")" ]; then
    g++ -O2 -DNDEBUG -std=c++17 -o "$out/cgal-$name" "cgal/$name.cpp" -lgmp -lmpfr
  fi
done
[ "${1:-plane}" = space ] || (cd spade && cargo build --quiet --release --target-dir "../$out/spade")
(cd .. && cargo build --quiet --release && cargo build --quiet --release --features generators --examples)
