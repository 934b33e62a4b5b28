#!/bin/bash
# Memcheck on one short run of each program: nothing reads what nobody wrote, nothing writes where it must not. As Valgrind
# knows no AVX-512, the programs are built for x86-64-v2 (other processors: their own level), in a folder of their own;
# VALGRIND_BUILD=folder takes programs that are there. Ends with 77 where there is no Valgrind.
set -euo pipefail
[[ ${1:-} != -h && ${1:-} != --help ]] || { sed -n '2,/^[^#]/s/^# //p' "$0"; exit 0; }
command -v valgrind > /dev/null || { echo "no valgrind here: pipeline/packages.sh analysis" >&2; exit 77; }
top="$(cd "$(dirname "$0")/../.." && pwd)"
build="${VALGRIND_BUILD:-$top/build/valgrind}"
if [[ -z ${VALGRIND_BUILD:-} ]]; then
  cmake -S "$top" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -g" -DCRUMBLE_MARCH= > /dev/null
  cmake --build "$build" -j "$(nproc)" --target dryer agglomerate rigidstress breaker > /dev/null
fi
export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 OPENBLAS_CORETYPE=Nehalem
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
cp "$top"/data/samples/{dryer.toml,load.toml,three.csv} "$work"
cd "$work"
printf 'particle.fragments = "largest"\nhydrodynamics.method = "fts"\nflow.orbits = 1\nflow.starts = 2\nflow.strain = 5\n' > stress.toml

status=0
memcheck() {
  local name="$1" begin=$SECONDS
  shift
  if valgrind --quiet --error-exitcode=99 --leak-check=full --errors-for-leak-kinds=definite --show-leak-kinds=definite \
    --suppressions="$top/pipeline/verify/valgrind.supp" --log-file=log "$@" > out 2>&1; then
    echo "$name: no error, $((SECONDS - begin)) s"
  else
    echo "$name: ended with $?"
    head -60 log
    tail -5 out
    status=1
  fi
}
memcheck dryer "$build/bin/dryer" dryer.toml -o dried.h5 --threads 1 --quiet
memcheck agglomerate "$build/bin/agglomerate" import three.csv -o imported.h5
memcheck "agglomerate check" "$build/bin/agglomerate" check dried.h5 imported.h5
memcheck rigidstress "$build/bin/rigidstress" stress.toml dried.h5 -o loaded.h5 --threads 1 --quiet
memcheck breaker "$build/bin/breaker" load.toml dried.h5 -o broken.h5 --threads 1 --quiet --set error.estimate=false --set particle.fragments=largest
exit $status
