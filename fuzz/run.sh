#!/usr/bin/env bash
# Runs every fuzz target and prints its executions. Usage: fuzz/run.sh SECONDS [TARGET...]
# SECONDS is the budget of each core target; each reader gets a sixth of it. JOBS targets run at once (default 2).
# What is found new goes to fuzz/runs/TARGET, an input that breaks a promise to fuzz/artifacts/TARGET. Needs cargo-fuzz; stable is enough.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
seconds=${1:?seconds for each core target}
shift
targets=("$@")
if [ ${#targets[@]} -eq 0 ]; then
    mapfile -t targets < <(cargo fuzz list)
fi
cargo fuzz build -s none
bin="fuzz/target/$(rustc -vV | sed -n 's/^host: //p')/release"

one() {
    local target=$1 seconds=$2 bin=$3
    case $target in read_*) seconds=$((seconds / 6)) ;; esac
    mkdir -p "fuzz/runs/$target" "fuzz/artifacts/$target" "fuzz/corpus/$target"
    # Memory asked for and never touched counts too.
    case $target in read_*) ulimit -v 1048576 ;; esac
    local log="fuzz/runs/$target.log" status=0
    nice "$bin/$target" "fuzz/runs/$target" "fuzz/corpus/$target" -max_total_time="$seconds" -max_len=4096 -timeout=60 \
        -rss_limit_mb=2048 -print_final_stats=1 -artifact_prefix="fuzz/artifacts/$target/" >"$log" 2>&1 || status=$?
    local executions
    executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
    if [ "$status" -eq 0 ]; then
        echo "$target: ${executions:-?} executions in $seconds s"
    else
        echo "$target: FAILED after ${executions:-?} executions, see $log"
    fi
    return "$status"
}
export -f one
printf '%s\n' "${targets[@]}" | xargs -P "${JOBS:-2}" -I{} bash -c 'one "$@"' one {} "$seconds" "$bin"
