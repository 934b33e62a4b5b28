#!/bin/bash
#SBATCH --job-name=crumble --requeue --open-mode=append --signal=B:TERM@120
# sbatch --ntasks=32 pipeline/cluster/sbatch.sh TARGET [NAME=VALUE...], from the top folder: the same without anyone at a terminal.
# Two minutes before its time is up every run leaves a checkpoint, and the job queues again and goes on.
[[ ${1:-} != -h && ${1:-} != --help ]] || { sed -n '3,/^[^#]/s/^# //p' "$0"; exit 0; }
make -C pipeline -j"$SLURM_NTASKS" CLUSTER=slurm "$@" &
trap 'kill -TERM $!; wait $!; scontrol requeue "$SLURM_JOB_ID"' TERM
wait $!
