#!/usr/bin/env bash
#SBATCH --job-name=camroller
#SBATCH --ntasks-per-core=1
#SBATCH --time=01:00:00
#SBATCH --signal=B:TERM@60
#SBATCH --requeue
# A sweep on many nodes, by MPI.
#
# Usage: sbatch --nodes=N --ntasks-per-node=M slurm/nodes.sh DECK FILE.h5 [option of 'camroller sweep' ...]
# Cases are given out while it runs, so slow ones do not hold up the rest. FILE.h5 has to be on a file system that all nodes see.
# CAMROLLER_MPI names the program where it is not in the path, LAUNCHER what starts its processes ('srun --mpi=pmix', say).
set -uo pipefail
# shellcheck source=slurm/run_and_requeue.sh
source "${CAMROLLER_SLURM:-$SLURM_SUBMIT_DIR/slurm}/run_and_requeue.sh"
deck=$1 file=$2
shift 2
# shellcheck disable=SC2086  # the launcher may have options
run_and_requeue ${LAUNCHER:-mpirun} "${CAMROLLER_MPI:-camroller-mpi}" sweep "$deck" -o "$file" --resume \
    --threads "${SLURM_CPUS_PER_TASK:-1}" "$@"
