#!/usr/bin/env bash
# Bring up Slurm on this machine alone and run sweeps with it: as an array job, in threads and by MPI with a stop on the way. The files
# are compared with those of one process. Everything is in a folder of its own and is taken down again.
#
# Usage: slurm/one_node.sh      as root after `make build mpi`; needs slurmctld, slurmd, slurm-client and munge, which it installs
#                               where there is apt-get
# Ends with `N passed, N failed` after half a minute, five minutes at most. Exit code 77 and the reason in the last line where this
# machine cannot run Slurm at all: no root, no packages, or a container in which its daemons do not come up.
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
skip() { printf 'slurm: not tried, since %s\n' "$*"; exit 77; }

install_slurm() {
    if command -v slurmctld > /dev/null && command -v slurmd > /dev/null && command -v munged > /dev/null &&
        command -v sbatch > /dev/null; then return; fi
    command -v apt-get > /dev/null || skip "slurmctld, slurmd, slurm-client and munge are not there, and no apt-get to install them"
    say "installing Slurm"
    # lists of packages that the set-up has fetched will do
    apt_install || { timeout 60 apt-get update -qq < /dev/null > "$folder/apt.log" 2>&1 && apt_install; } || {
        tail -n 5 "$folder/apt.log"
        skip "its packages cannot be installed"
    }
}

apt_install() {
    DEBIAN_FRONTEND=noninteractive timeout 120 apt-get install -y --no-install-recommends slurmctld slurmd slurm-client munge \
        > "$folder/apt.log" 2>&1 < /dev/null
}

free_ports() { # how many
    python3 -c "
import socket
sockets = [socket.create_server(('127.0.0.1', 0)) for _ in range($1)]
print(*(s.getsockname()[1] for s in sockets))"
}

# A job that is queued again waits for as long as its credential is good, by default two minutes.
write_configuration() {
    local host ports
    host=$(uname -n)
    host=${host%%.*}
    read -ra ports <<< "$(free_ports 2)"
    mkdir -p "$folder/state" "$folder/spool"
    dd if=/dev/urandom of="$folder/munge.key" bs=1024 count=1 status=none
    chmod 400 "$folder/munge.key"
    cat > "$folder/slurm.conf" << END
ClusterName=camroller
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=${ports[0]}
SlurmdPort=${ports[1]}
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket,cred_expire=5
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
SlurmdParameters=config_overrides
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP
END
}

start_slurm() {
    export SLURM_CONF=$folder/slurm.conf
    munged --force --foreground --key-file="$folder/munge.key" --socket="$folder/munge.socket" \
        --pid-file="$folder/munge.pid" --log-file="$folder/munge.log" --seed-file="$folder/munge.seed" 2> "$folder/munge.err" &
    for _ in $(seq 50); do [ -S "$folder/munge.socket" ] && break; sleep 0.1; done
    slurmctld -D > "$folder/slurmctld.out" 2>&1 &
    slurmd -D > "$folder/slurmd.out" 2>&1 &
    for _ in $(seq 150); do
        [ "$(timeout 5 sinfo -h -o %T 2> /dev/null)" = idle ] && return
        [ "$(jobs -pr | wc -l)" = 3 ] || break
        sleep 0.2
    done
    tail -n 20 "$folder"/*.log "$folder"/*.out "$folder"/*.err
    skip "Slurm does not come up: $(grep -hsi 'fatal' "$folder"/*.{err,log,out} | tail -n 1 | grep . ||
        echo 'its node is not ready after half a minute')"
}

# Everything that was started here has our configuration in its environment; jobs and their steps leave the groups of the shell.
ours() {
    local process
    for process in /proc/[0-9]*; do
        if grep -qszFx "SLURM_CONF=$folder/slurm.conf" "$process/environ"; then echo "${process#/proc/}"; fi
    done
}

stop_slurm() {
    trap - EXIT
    local process
    for process in $(ours); do kill -TERM "$process" 2> /dev/null; done
    for _ in $(seq 50); do [ -z "$(ours)" ] && break; sleep 0.1; done
    for process in $(ours); do kill -KILL "$process" 2> /dev/null; done
    wait 2> /dev/null
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
        tail -n 5 "$folder"/job-* "$folder"/slurm*.out
    fi
}

wait_for_jobs() { # seconds
    local queue
    for _ in $(seq $(($1 * 2))); do
        queue=$(timeout 10 squeue -h 2> /dev/null) && [ -z "$queue" ] && return
        sleep 0.5
    done
    say "jobs do not end:"
    timeout 10 squeue
    return 1
}

submit() { timeout 20 sbatch --parsable --open-mode=append --chdir="$folder" --output="$folder/job-%A-%a.txt" "$@"; }

same_file() { # one file, another
    PYTHONPATH=test:test/python "$python" -c "
import sys
import sweeps
def content(path):
    found = sweeps.content(path)
    found['run'][1].pop('options')  # has folders in it
    return list(found.items())
for one, other in zip(content(sys.argv[1]), content(sys.argv[2]), strict=True):
    if one != other:
        sys.exit(f'{one} is not {other}'[:2000])" "$1" "$2"
}

stop_when_begun() { # result file
    local part
    for _ in $(seq 400); do
        part=$(find "$folder" -name "$1.part-*" -size +3k)
        [ -n "$part" ] && timeout 10 scancel --batch --signal=TERM "$job" && return
        sleep 0.05
    done
    return 1
}

requeued() { grep -qs "queueing the job again" "$folder/job-$job"-*; }

trap stop_slurm EXIT
trap 'fail "stopped"' TERM INT HUP
[ "$(id -u)" = 0 ] || skip "only root can bring Slurm up"
[ -x "$program" ] || fail "$program is missing: make build"
install_slurm
write_configuration
start_slurm
say "$(sinfo -h -o 'node %N, %c cores, %T'), version $(sinfo --version | cut -d ' ' -f 2)"

export CAMROLLER=$program CAMROLLER_MPI=$mpi_program CAMROLLER_SLURM=$PWD/slurm
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
PYTHONPATH=test:test/python "$python" -c "
import pathlib, sweeps
for name, count in (('deck', 60), ('long', 200)):
    sweeps.write_deck(pathlib.Path(f'$folder/{name}.nml'), sweeps.GRID.replace('count_1 = 6', f'count_1 = {count}'))"
for name in deck long; do
    "$program" sweep "$folder/$name.nml" -o "$folder/$name-reference.h5" --quiet || fail "the sweep in one process fails"
done

job=$(submit --array=1-4 slurm/array.sh "$folder/deck.nml" "$folder/array.h5" --quiet)
last=$(submit --dependency="afterok:$job" slurm/merge.sh "$folder/deck.nml" "$folder/array.h5")
say "array job $job with four shards, and job $last that merges them"
check "the jobs end" wait_for_jobs 60
check "the array job gives the file of one process" same_file "$folder/deck-reference.h5" "$folder/array.h5"

job=$(submit slurm/node.sh "$folder/long.nml" "$folder/node.h5" --quiet)
say "job $job, told to stop by Slurm when it has begun to write"
check "it begins and is told" stop_when_begun node.h5
check "the job ends" wait_for_jobs 60
check "it was queued again" requeued
check "it gives the file of one process" same_file "$folder/long-reference.h5" "$folder/node.h5"

if [ -x "$mpi_program" ]; then
    job=$(LAUNCHER="mpirun --oversubscribe -n 2" submit --ntasks=2 slurm/nodes.sh "$folder/long.nml" "$folder/nodes.h5" --quiet)
    say "job $job with two processes, told to stop as well"
    check "it begins and is told" stop_when_begun nodes.h5
    check "the job ends" wait_for_jobs 60
    check "it was queued again" requeued
    check "two processes give the file of one" same_file "$folder/long-reference.h5" "$folder/nodes.h5"
fi
echo "$passed passed, $failed failed"
[ $failed = 0 ]
