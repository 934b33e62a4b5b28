#!/bin/bash
# fuzz.sh MINUTES [RUNS] [HARNESS...]: builds the fuzzers of tests/fuzz with clang, AddressSanitizer and UndefinedBehaviorSanitizer in
# build/fuzz and lets each run for so many minutes, or for RUNS executions if that is not 0. What is new is kept in results/fuzz/HARNESS,
# what crashes, takes more than TIMEOUT=1 second or more than 2 GB in results/fuzz/HARNESS-findings: then this ends with 1.
set -euo pipefail
[[ ${1:-} != -h && ${1:-} != --help && $# -gt 0 ]] || { sed -n '2,/^[^#]/s/^# //p' "$0"; exit 0; }
command -v clang++ > /dev/null || { echo "no clang++ here: pipeline/packages.sh analysis" >&2; exit 77; }
minutes="$1" runs="${2:-0}"
harnesses=("${@:3}")
((${#harnesses[@]})) || harnesses=(file dryer_scene breaker_scene rigidstress_scene points history)
cd "$(dirname "$0")/.."
cmake --preset fuzz > /dev/null
cmake --build build/fuzz -j "${JOBS:-$(nproc)}" --target "${harnesses[@]/#/fuzz_}" > /dev/null
# Stacks of where memory was taken cost a fifth of the time; a finding that needs them is run again without this.
export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 ASAN_OPTIONS="${ASAN_OPTIONS:-malloc_context_size=1}"
status=0
for harness in "${harnesses[@]}"; do
  kept="pipeline/results/fuzz/$harness" findings="pipeline/results/fuzz/$harness-findings"
  mkdir -p "$kept" "$findings"
  begin=$SECONDS
  if ! nice -n 10 build/fuzz/bin/fuzz_"$harness" "$kept" "tests/fuzz/corpus/$harness" -max_len=2048 -entropic=0 -timeout="${TIMEOUT:-1}" -rss_limit_mb=2048 \
    -artifact_prefix="$findings/" -print_final_stats=1 -verbosity=1 -max_total_time=$((runs > 0 ? 0 : 60 * minutes)) -runs=$((runs > 0 ? runs : -1)) \
    > "pipeline/results/fuzz/$harness.log" 2>&1; then
    status=1
    echo "$harness: found something, see pipeline/results/fuzz/$harness.log and $findings"
  fi
  executed="$(sed -n 's/^stat::number_of_executed_units: *//p' "pipeline/results/fuzz/$harness.log")"
  covered="$(grep -o 'cov: [0-9]* ft: [0-9]*' "pipeline/results/fuzz/$harness.log" | tail -1 || true)"
  echo "$harness: ${executed:-?} executions in $((SECONDS - begin)) s, $covered"
done
exit $status
