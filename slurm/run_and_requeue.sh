#!/usr/bin/env bash
# For the job scripts here: run a command, pass the end of the job's time on to it, queue the job again where it has more to do.

# Exit code of a sweep that was stopped and can be gone on with
readonly code_unfinished=8
# Threads that OpenBLAS starts with each process would wait busily for work that the program never gives them
export OPENBLAS_NUM_THREADS=1

run_and_requeue() { # command
    local child code
    "$@" &
    child=$!
    # mpirun passes this one on and returns what its processes do; of TERM and INT it makes an end with 1 for itself
    trap 'kill -USR1 "$child" 2> /dev/null' TERM USR1 INT
    wait "$child"
    code=$?
    # a signal ends the first wait, not the command
    while kill -0 "$child" 2> /dev/null; do
        wait "$child"
        code=$?
    done
    if [ "$code" = "$code_unfinished" ] && [ -n "${SLURM_JOB_ID:-}" ]; then
        echo "queueing the job again"
        scontrol requeue "$SLURM_JOB_ID" && exit 0
    fi
    exit "$code"
}
