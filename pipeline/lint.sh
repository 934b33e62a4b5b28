#!/bin/bash
# lint.sh [FILE...]: cppcheck on the sources of the programs, then clang-tidy, with the checks of .clang-tidy, on the files that are
# named; without files on all, which takes some seconds each. lint.sh --cppcheck: that alone, 11 s of CPU. Ends with 77 where a
# tool is not there (packages.sh analysis), with 1 if something is found.
set -euo pipefail
[[ ${1:-} != -h && ${1:-} != --help ]] || { sed -n '2,/^[^#]/s/^# //p' "$0"; exit 0; }
cd "$(dirname "$0")/.."
for tool in cppcheck $([[ ${1:-} == --cppcheck ]] || echo clang-tidy); do
  command -v $tool > /dev/null || { echo "no $tool here: pipeline/packages.sh analysis" >&2; exit 77; }
done

# Not `style` and `performance`, which want arguments of a pointer's size by reference; tests hold macros of GoogleTest that it does not
# know. What else is left out stands in cppcheck.supp, each with its reason.
sed 's/ *#.*//;/^$/d' pipeline/verify/cppcheck.supp > "${TMPDIR:-/tmp}/cppcheck-$$.supp"
trap 'rm -f "${TMPDIR:-/tmp}/cppcheck-$$.supp"' EXIT
cppcheck --enable=warning,portability --std=c++20 --language=c++ -I . --quiet --error-exitcode=1 -j "$(nproc)" \
  --suppressions-list="${TMPDIR:-/tmp}/cppcheck-$$.supp" --template='{file}:{line}: {id}: {message}' common dryer breaker rigidstress tests/fuzz
[[ ${1:-} != --cppcheck ]] || exit 0

build="${BUILD:-build/release}"
[[ -f $build/compile_commands.json ]] || cmake --preset release > /dev/null
files=("$@")
((${#files[@]})) || mapfile -t files < <(git ls-files 'common/*.cpp' 'dryer/*.cpp' 'breaker/*.cpp' 'rigidstress/*.cpp' 'tests/fuzz/*.cpp')
# GCC's options that clang does not know are no finding.
printf '%s\n' "${files[@]}" | xargs -P "$(nproc)" -n 1 clang-tidy -p "$build" --quiet --extra-arg=-Wno-unknown-warning-option \
  --extra-arg=-Wno-ignored-optimization-argument --warnings-as-errors='*' 2> /dev/null
