#!/usr/bin/env bash
# Both kernels, the same bytes: runs `mesh --mirror` on every real graph whose mesh has at most 5,000 vertices, and on ten of
# them with all queue orders and choices. Exit code 1 if any trace differs.
#
#   oracle/mirror.sh [folder of .poly files]
set -euo pipefail
cd "$(dirname "$0")/.."
data=${1:-../shared/data/pslg/as_poly}
[ -d "$data" ] || { echo "skipped: no folder $data"; exit 0; }
cargo build --release --quiet
program=target/release/orthoball
limit=5000
same=0 large=0 refused=0 different=0
mirror() { # file, options: counts the verdict
  local code=0 answer
  answer=$("$program" mesh "$@" --mirror --json 2>/dev/null) || code=$?
  case "$code $answer" in
    *'"verdict":"identical"'*) same=$((same + 1)) ;;
    "2 "*) refused=$((refused + 1)) ;;
    *) echo "DIFFERENT (exit code $code): mesh $*"; different=$((different + 1)) ;;
  esac
}
ten=0
for file in "$data"/*.poly; do
  vertices=$("$program" mesh "$file" --min-angle 25 --json 2>/dev/null | grep -o '"vertices": *[0-9]*' | head -1 | tr -dc 0-9 || true)
  if [ -n "$vertices" ] && [ "$vertices" -gt $limit ]; then large=$((large + 1)); continue; fi
  mirror "$file" --min-angle 25
  if [ -n "$vertices" ] && [ "$vertices" -gt 100 ] && [ "$vertices" -lt 600 ] && [ $ten -lt 10 ]; then
    ten=$((ten + 1))
    for order in shortest-edge worst-first fifo; do
      for choice in center extreme random offcenter; do
        mirror "$file" --min-angle 25 --order $order --choice $choice --d1 0.9 --d2 0.9 --mu 0.8 --seed 7 --max-steps 5000
      done
    done
  fi
done
echo "$same runs identical, $different different, $refused refused, $large above $limit vertices, $ten files with all orders and choices"
[ $different = 0 ]
