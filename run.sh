#!/usr/bin/env bash
# Builds orthoball if need be and runs it: ./run.sh mesh examples/lake.poly -o lake.vtu
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
source "$here/tools/m4.sh"
exec cargo run --quiet --release --manifest-path "$here/Cargo.toml" -- "$@"
