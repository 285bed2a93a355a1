#!/usr/bin/env bash
#SBATCH --job-name=camroller-merge
#SBATCH --ntasks=1
#SBATCH --time=01:00:00
# The one file of a sweep, from the shards of an array job; see array.sh.
#
# Usage: sbatch --dependency=afterany:JOB slurm/merge.sh DECK FILE.h5 [option of 'camroller merge' ...]
set -uo pipefail
deck=$1 file=$2
shift 2
exec "${CAMROLLER:-camroller}" merge "$deck" -o "$file" "$@"
