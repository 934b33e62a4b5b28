#!/bin/bash
# ThreadSanitizer on one short run of each program with four threads. GCC's libgomp says nothing to the sanitizer of its barriers, so that
# with it a correct sum is reported; clang's libomp does, through its tool Archer. That this is so here is tried first, on a correct
# program and on one with a race. Ends with 77 where clang or Archer is missing.
set -euo pipefail
[[ ${1:-} != -h && ${1:-} != --help ]] || { sed -n '2,/^[^#]/s/^# //p' "$0"; exit 0; }
top="$(cd "$(dirname "$0")/../.." && pwd)"
archer="$(find /usr/lib/llvm-*/lib -name libarcher.so 2> /dev/null | sort -V | tail -1)"
[[ -n $archer ]] && command -v clang++ > /dev/null || { echo "no clang++ or no Archer here: pipeline/packages.sh analysis" >&2; exit 77; }
export OMP_NUM_THREADS=4 OPENBLAS_NUM_THREADS=1 OMP_TOOL_LIBRARIES="$archer" TSAN_OPTIONS="ignore_noninstrumented_modules=1 exitcode=66"
# The sanitizer of clang 14 does not know the address space layout of newer kernels.
run=(setarch "$(uname -m)" -R)
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
cd "$work"

for kind in correct racing; do
  cat > $kind.cpp << EOF
#include <vector>
int main() {
  std::vector<double> a(100000, 0.5);
  double sum = 0;
#pragma omp parallel for $([[ $kind == racing ]] || echo "reduction(+ : sum)")
  for (int k = 0; k < 100000; ++k) sum += a[static_cast<unsigned>(k)];
  return sum < 0;
}
EOF
  clang++ -O1 -g -fopenmp -fsanitize=thread $kind.cpp -o $kind
done
"${run[@]}" ./correct > out 2>&1 || { echo "a correct sum is reported: the sanitizer says nothing here"; cat out; exit 1; }
"${run[@]}" ./racing > out 2>&1 && { echo "a race is not reported: the sanitizer says nothing here"; exit 1; }
echo "a race is reported, a correct sum is not"

programs="$top/build/threads/bin"
cmake -S "$top" -B "$top/build/threads" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -g -fsanitize=thread" \
  -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ -DCRUMBLE_MARCH= > /dev/null
cmake --build "$top/build/threads" -j "$(nproc)" --target dryer agglomerate rigidstress breaker > /dev/null
status=0
under() {
  local name="$1" code=0
  shift
  "${run[@]}" "$@" > out 2>&1 || code=$?
  echo "$name: ended with $code, $(grep -c 'WARNING: ThreadSanitizer' out || true) reports"
  if ((code)); then head -80 out; status=1; fi
}
source "$top/pipeline/verify/short_runs"
short_runs "$programs" "$top"
exit $status
