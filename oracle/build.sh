#!/bin/sh
# Builds the programs that the other scripts run, into target/oracle and target/release.
set -eu
cd "$(dirname "$0")"
out=../target/oracle
mkdir -p "$out"
for name in sets bench mesh; do
  if [ ! -x "$out/cgal-$name" ] || [ -n "$(find cgal -newer "$out/cgal-$name" -name '*.?pp')" ]; then
    g++ -O2 -DNDEBUG -std=c++17 -o "$out/cgal-$name" "cgal/$name.cpp" -lgmp -lmpfr
  fi
done
(cd spade && cargo build --quiet --release --target-dir "../$out/spade")
(cd .. && cargo build --quiet --release && cargo build --quiet --release --features generators --examples)
