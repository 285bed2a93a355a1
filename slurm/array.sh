#!/usr/bin/env bash
#SBATCH --job-name=camroller
#SBATCH --ntasks=1
#SBATCH --time=01:00:00
#SBATCH --signal=B:TERM@60
#SBATCH --requeue
# One shard of a sweep for each task of an array job: no MPI, and any number of tasks at a time.
#
# Usage: job=$(sbatch --parsable --array=1-100 slurm/array.sh DECK FILE.h5 [option of 'camroller sweep' ...])
#        sbatch --dependency=afterany:$job slurm/merge.sh DECK FILE.h5
# More shards than tasks at a time even out shards of unequal length. FILE.h5 has to be on a file system that all nodes see.
# CAMROLLER names the program where it is not in the path.
set -uo pipefail
# shellcheck source=slurm/run_and_requeue.sh
source "${CAMROLLER_SLURM:-$SLURM_SUBMIT_DIR/slurm}/run_and_requeue.sh"
deck=$1 file=$2
shift 2
run_and_requeue "${CAMROLLER:-camroller}" sweep "$deck" -o "$file" --resume --threads "${SLURM_CPUS_PER_TASK:-1}" \
    --shard "$((SLURM_ARRAY_TASK_ID - SLURM_ARRAY_TASK_MIN + 1))/$SLURM_ARRAY_TASK_COUNT" "$@"
