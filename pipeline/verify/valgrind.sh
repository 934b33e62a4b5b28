#!/bin/bash
# Memcheck on one short run of each program: nothing is read that nobody wrote, nothing written where it must not be, nothing lost. On the
# build that runs on any x86-64, as Valgrind knows no AVX-512; valgrind.sh PROGRAMS takes those of another folder. Ends with 77 where
# there is no Valgrind.
set -euo pipefail
[[ ${1:-} != -h && ${1:-} != --help ]] || { sed -n '2,/^[^#]/s/^# //p' "$0"; exit 0; }
command -v valgrind > /dev/null || { echo "no valgrind here: pipeline/packages.sh analysis" >&2; exit 77; }
top="$(cd "$(dirname "$0")/../.." && pwd)"
programs="${1:-$top/build/portable/bin}"
if [[ $# == 0 ]]; then
  (cd "$top" && cmake --preset portable > /dev/null && cmake --build --preset portable -j "$(nproc)" --target dryer agglomerate rigidstress breaker > /dev/null)
fi
source "$top/pipeline/verify/short_runs"
# OpenBLAS would choose its kernel for AVX-512; without the third the programs start themselves anew, out of sight.
export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 OPENBLAS_CORETYPE=Nehalem GOMP_SPINCOUNT=100
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
cd "$work"
status=0
under() {
  local name="$1" code=0
  shift
  valgrind --error-exitcode=99 --leak-check=full --errors-for-leak-kinds=definite --show-leak-kinds=definite --log-file=log.%p "$@" > out 2>&1 || code=$?
  echo "$name: ended with $code; $(grep -h 'ERROR SUMMARY' log.* | sed 's/.*ERROR SUMMARY: //; s/ (.*//' | sort | uniq -c | sed 's/^ *//' | paste -sd ';')"
  if ((code)); then
    head -80 log.*
    tail -5 out
    status=1
  fi
  rm -f log.*
}
short_runs "$programs" "$top"
exit $status
