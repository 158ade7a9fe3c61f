#!/bin/sh
# Every real graph through mesh, verify and check, and sizes against Triangle: oracle/corpus.sh [table|sizes|both] [part of a file's name]
set -eu
here=$(cd "$(dirname "$0")" && pwd)
(cd "$here/.." && cargo build --quiet --release)
python3 "$here/corpus.py" "$here/../target/release/orthoball" "${ORTHOBALL_DATA:-$here/../../shared/data}" "$@"
