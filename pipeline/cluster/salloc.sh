#!/bin/bash
# salloc.sh TASKS TARGET [NAME=VALUE...]: waits in the queue once, for so many processors; make then starts every run as a step on one of them.
#     pipeline/cluster/salloc.sh 32 campaign CAMPAIGN=my.toml
set -euo pipefail
[[ ${1:-} != -h && ${1:-} != --help ]] || { sed -n '2,/^[^#]/s/^# //p' "$0"; exit 0; }
exec salloc --ntasks="$1" make -C "$(dirname "$0")/.." -j"$1" CLUSTER=slurm "${@:2}"
