#!/bin/bash
# Lines of common, dryer, breaker and rigidstress that the tests run: builds everything with gcov's counters at -O1, runs the tests and
# prints the share of each part. coverage.sh REGEX runs the tests of that name alone. Ends with 77 where gcovr is missing,
# with 1 where a part is below 90 %.
set -euo pipefail
[[ ${1:-} != -h && ${1:-} != --help ]] || { sed -n '2,/^[^#]/s/^# //p' "$0"; exit 0; }
command -v gcovr > /dev/null || { echo "no gcovr here: pipeline/packages.sh analysis" >&2; exit 77; }
top="$(cd "$(dirname "$0")/../.." && pwd)"
build="$top/build/coverage"
cmake -S "$top" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 --coverage -fprofile-update=atomic" > /dev/null
cmake --build "$build" -j "$(nproc)" > /dev/null
find "$build" -name '*.gcda' -delete
# A test that fails has run its lines, too; whether all pass is told by make test.
ctest --test-dir "$build" -j "$(nproc)" ${1:+-R "$1"} > "$build/tests.log" 2>&1 || tail -20 "$build/tests.log" >&2
status=0
for part in common dryer breaker rigidstress; do
  gcovr --root "$top" --object-directory "$build" --filter "$top/$part/" --json-summary "$build/$part.json" "$build" > "$build/$part.txt"
  /usr/bin/python3 - "$part" "$build/$part.json" << 'EOF' || status=1
import json, sys
part, file = sys.argv[1:]
of = json.load(open(file))
print(f"{part}: {of['line_percent']} % of {of['line_total']} lines")
sys.exit(of["line_percent"] < 90)
EOF
done
exit $status
