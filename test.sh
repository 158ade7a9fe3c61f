#!/usr/bin/env bash
# Builds orthoball with all its tests and runs them.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
source tools/m4.sh
cargo test --all-features "$@"
