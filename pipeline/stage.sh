#!/bin/bash
# stage.sh PROGRAM OUTPUT.h5 INPUT... [-- OPTION...]: runs one stage unless its output and report are newer than all that
# they come from. File names may hold blanks, which make's own targets may not.
set -euo pipefail
[[ ${1:-} != -h && ${1:-} != --help ]] || { sed -n '2,/^[^#]/s/^# //p' "$0"; exit 0; }

program=$1 output=$2
shift 2
inputs=()
while (($#)) && [[ $1 != -- ]]; do inputs+=("$1") && shift; done
(($#)) && shift

report="${output%.h5}.json"
for input in "${inputs[@]}"; do
  [[ -f $input ]] || { echo "$input: no such file" >&2 && exit 2; }
done

# A program writes both beside their names and renames them when they are complete, the report last: an older report beside a newer
# file is of another run.
fresh=yes
[[ ! $report -ot $output ]] || fresh=no
for made in "$output" "$report"; do
  for source in "$program" "${inputs[@]}"; do
    [[ -f $made && ! $made -ot $source ]] || fresh=no
  done
done
if [[ $fresh == yes ]]; then
  echo "$output is up to date"
  exit 0
fi

mkdir -p "$(dirname "$output")"
exec "$program" "${inputs[@]}" -o "$output" --report "$report" --overwrite "$@"
