#!/usr/bin/env bash
#SBATCH --job-name=camroller
#SBATCH --nodes=1
#SBATCH --ntasks=1
#SBATCH --exclusive
#SBATCH --time=01:00:00
#SBATCH --signal=B:TERM@60
#SBATCH --requeue
# A sweep on one node, in as many threads as it has cores.
#
# Usage: sbatch [--time=...] [--cpus-per-task=...] slurm/node.sh DECK FILE.h5 [option of 'camroller sweep' ...]
# A minute before its time is up the job is told to stop: it keeps what is done, and is queued again to go on with it.
# CAMROLLER names the program where it is not in the path.
set -uo pipefail
# shellcheck source=slurm/run_and_requeue.sh
source "${CAMROLLER_SLURM:-$SLURM_SUBMIT_DIR/slurm}/run_and_requeue.sh"
deck=$1 file=$2
shift 2
run_and_requeue "${CAMROLLER:-camroller}" sweep "$deck" -o "$file" --resume --threads "${SLURM_CPUS_ON_NODE:-1}" "$@"
