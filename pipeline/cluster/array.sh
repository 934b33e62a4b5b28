#!/bin/bash
#SBATCH --job-name=crumble --requeue --open-mode=append
# sbatch --array=1-100%20 pipeline/cluster/array.sh CAMPAIGN.toml -o FOLDER, from the top folder: a campaign in 100 jobs, 20 of them at a time.
# When they have ended, `make -C pipeline campaign` makes what failed, and the tables.
[[ ${1:-} != -h && ${1:-} != --help ]] || { sed -n '3,/^[^#]/s/^# //p' "$0"; exit 0; }
exec /usr/bin/python3 -B pipeline/campaign run "$@" --part "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" --jobs "$SLURM_CPUS_ON_NODE"
