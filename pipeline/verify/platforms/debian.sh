#!/bin/bash
# The two commands of README.md as on a new machine: a fresh Debian system, a fresh clone, an empty environment. An hour and
# a half on two cores.
. "$(dirname "$0")/chroot.sh"
read_arguments debian "$@"

make_system
fresh_clone /crumble
step packages make -C /crumble/pipeline packages
step granules make -C /crumble/pipeline
tail -n 12 "$folder/granules.log"
step tests make -C /crumble/pipeline test
grep -E 'tests passed|^The following tests FAILED|^\s+[0-9]+ - ' "$folder/tests.log" || true
read -r -d '' -a packages <<< "$(sed '/^\[/,$d; s/#.*//' "$top/pipeline/packages.txt")" || true
describe "${packages[@]}"
[[ ! $failed ]]
