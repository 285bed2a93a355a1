#!/usr/bin/env bash
# Bring up Slurm on this machine alone, run a sweep as an array job with it, one shard stopped and queued again on the way, and
# compare the file with that of one process. Everything is in a folder of its own and is taken down again.
#
# Usage: slurm/one_node.sh          as root; needs slurmctld, slurmd, slurm-client and munge, installed on Debian where missing
# Ends with `N passed, N failed`.
set -uo pipefail
cd "$(dirname "$0")/.."

program=$PWD/build/release/bin/camroller
mpi_program=$PWD/build/mpi/bin/camroller-mpi
python=$PWD/.venv/bin/python
folder=$(mktemp -d /tmp/camroller-slurm.XXXXXX)
passed=0
failed=0

say() { printf 'slurm: %s\n' "$*"; }
fail() { printf 'slurm: %s\n' "$*" >&2; exit 1; }

install_slurm() {
    if command -v slurmctld > /dev/null && command -v slurmd > /dev/null && command -v munged > /dev/null &&
        command -v sbatch > /dev/null; then return; fi
    command -v apt-get > /dev/null || fail "needs slurmctld, slurmd, slurm-client and munge"
    say "installing Slurm"
    { apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends \
        slurmctld slurmd slurm-client munge; } > "$folder/apt.log" 2>&1 < /dev/null || { tail -n 20 "$folder/apt.log"; exit 1; }
}

write_configuration() {
    local host
    host=$(hostname -s)
    mkdir -p "$folder/state" "$folder/spool"
    dd if=/dev/urandom of="$folder/munge.key" bs=1024 count=1 status=none
    chmod 400 "$folder/munge.key"
    cat > "$folder/slurm.conf" << END
ClusterName=camroller
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=26817
SlurmdPort=26818
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket
CredType=cred/munge
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=sched_interval=2,batch_sched_delay=0
MpiDefault=none
ReturnToService=2
KillWait=5
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP
END
}

start_slurm() {
    export SLURM_CONF=$folder/slurm.conf
    munged --force --foreground --key-file="$folder/munge.key" --socket="$folder/munge.socket" \
        --pid-file="$folder/munge.pid" --log-file="$folder/munge.log" --seed-file="$folder/munge.seed" 2> "$folder/munge.err" &
    processes=($!)
    for _ in $(seq 50); do [ -S "$folder/munge.socket" ] && break; sleep 0.1; done
    slurmctld -D > "$folder/slurmctld.out" 2>&1 &
    processes+=($!)
    slurmd -D > "$folder/slurmd.out" 2>&1 &
    processes+=($!)
    for _ in $(seq 100); do
        [ "$(sinfo -h -o %T 2> /dev/null)" = idle ] && return
        sleep 0.2
    done
    tail -n 20 "$folder"/*.log "$folder"/*.out "$folder"/*.err
    fail "Slurm does not come up"
}

stop_slurm() {
    scancel --quiet --state=PENDING --state=RUNNING --user=root 2> /dev/null
    for ((i = ${#processes[@]} - 1; i >= 0; i--)); do
        kill "${processes[i]}" 2> /dev/null
        wait "${processes[i]}" 2> /dev/null
    done
    rm -rf "$folder"
}

check() { # what, command
    local what=$1
    shift
    if "$@"; then
        passed=$((passed + 1))
        say "passed: $what"
    else
        failed=$((failed + 1))
        say "FAILED: $what"
        tail -n 5 "$(find "$folder" -name 'job-*' -newer "$folder/reference.h5" | sort | tail -n 1)"
    fi
}

# A job that is queued again may not start for two minutes, which is of no use here.
wait_for_jobs() { # seconds
    local job
    for _ in $(seq $(($1 * 2))); do
        [ -z "$(squeue -h 2> /dev/null)" ] && return
        for job in $(squeue -h -o '%i %r' 2> /dev/null | sed -n 's/ BeginTime$//p'); do
            scontrol update "JobId=$job" StartTime=now 2> /dev/null
        done
        sleep 0.5
    done
    say "jobs do not end:"
    squeue
    return 1
}

submit() { sbatch --parsable --open-mode=append --chdir="$folder" --output="$folder/job-%A-%a.txt" "$@"; }

same_file() { # one file, another
    PYTHONPATH=test/python "$python" -c "
import sys
import sweeps
def content(path):
    found = sweeps.content(path)
    found['run'][1].pop('options')  # has folders in it
    for name in ('deck/overrides', 'deck/values/sweep.wall_time_limit_s'):
        found.pop(name, None)
    return list(found.items())
for one, other in zip(content(sys.argv[1]), content(sys.argv[2]), strict=True):
    if one != other:
        sys.exit(f'{one} is not {other}'[:2000])" "$1" "$2"
}

requeued() { grep -qs "queueing the job again" "$folder"/job-*; }

[ "$(id -u)" = 0 ] || fail "only root can bring Slurm up"
[ -x "$program" ] || fail "$program is missing: make build"
processes=()
trap 'stop_slurm' EXIT
install_slurm
write_configuration
start_slurm
say "$(sinfo -h -o 'node %N, %c cores, %T'), version $(sinfo --version | cut -d ' ' -f 2)"

export CAMROLLER=$program CAMROLLER_MPI=$mpi_program CAMROLLER_SLURM=$PWD/slurm
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
PYTHONPATH=test/python "$python" -c "
import pathlib, sweeps
sweeps.write_deck(pathlib.Path('$folder/deck.nml'), sweeps.GRID.replace('count_1 = 6', 'count_1 = 60'))"
"$program" sweep "$folder/deck.nml" -o "$folder/reference.h5" --quiet || fail "the sweep in one process fails"

job=$(submit --array=1-4 slurm/array.sh "$folder/deck.nml" "$folder/array.h5" --quiet)
last=$(submit --dependency="afterok:$job" slurm/merge.sh "$folder/deck.nml" "$folder/array.h5")
say "array job $job with four shards, and job $last that merges them"
check "the jobs end" wait_for_jobs 120
check "the array job gives the file of one process" same_file "$folder/reference.h5" "$folder/array.h5"

job=$(submit slurm/node.sh "$folder/deck.nml" "$folder/node.h5" --set sweep.wall_time_limit_s=0.05 --quiet)
say "job $job, stopped after 0.05 s again and again"
check "the job ends" wait_for_jobs 240
check "it was queued again" requeued
check "it gives the file of one process" same_file "$folder/reference.h5" "$folder/node.h5"

if [ -x "$mpi_program" ]; then
    job=$(LAUNCHER="mpirun --oversubscribe -n 2" submit --ntasks=2 slurm/nodes.sh "$folder/deck.nml" "$folder/nodes.h5" --quiet)
    say "job $job with two processes"
    check "the job ends" wait_for_jobs 120
    check "two processes give the file of one" same_file "$folder/reference.h5" "$folder/nodes.h5"
fi
echo "$passed passed, $failed failed"
[ $failed = 0 ]
