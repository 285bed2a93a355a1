#!/usr/bin/env bash
# Build the benchmarks, run all of them, rewrite the tables and plots in bench/tables.
#
# Usage: make bench          all but the following, on an idle machine
#        make bench-ehl      the numerical film alone: cost over nodes
#        make bench-dynamics   a cycle of flexible trains beside CVODE and scipy
#        make range-ehl      its whole range: NODES=1025 FIRST=1 STRIDE=1
# Times are processor times of one core, medians of repeated runs, solvers taking turns; only ratios carry over to other machines.
# Needs SUNDIALS, which nothing else here does: installed as root on a machine with apt-get, otherwise named.
set -euo pipefail
cd "$(dirname "$0")/.."

fail() { printf 'bench: %s\n' "$*" >&2; exit 1; }

if [ ! -f /usr/include/cvode/cvode.h ] && ! pkg-config --exists sundials_cvode 2> /dev/null; then
    command -v apt-get > /dev/null || fail "SUNDIALS is missing (libsundials-dev in Debian)"
    [ "$(id -u)" = 0 ] || fail "SUNDIALS is missing; type: sudo apt-get install --no-install-recommends libsundials-dev"
    { apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends libsundials-dev; } \
        > build/bench-apt.log 2>&1 < /dev/null || { tail -n 20 build/bench-apt.log >&2; fail "cannot install libsundials-dev"; }
    # it brings a second HDF5, among which the set-up chooses
    tools/setup.sh
fi

# As the release build, and fit for a shared library without giving up what knowing the callee allows
flags="$RELEASE_FLAGS -I../build/commit -fPIC -fno-semantic-interposition"
# LAPACK and BLAS through a clock, bench/src/lapack_clock.f90
wrapped="-Wl,--wrap=dgetrf_,--wrap=dgetrs_,--wrap=dgemv_"
fpm=$PWD/tools/fpm
python=$PWD/.venv/bin/python
target=$PWD/build/bench
mkdir -p "$target" bench/tables
(cd bench && "$fpm" install --flag "$flags" --link-flag "$wrapped" --prefix "$target") > "$target/build.log" 2>&1 || { cat "$target/build.log"; exit 1; }

export OPENBLAS_NUM_THREADS=1
core=()
if command -v taskset > /dev/null; then core=(taskset -c "$(($(nproc) - 1))"); fi
tables=bench/tables
measure() { # table, command
    local table=$1
    shift
    printf 'bench: %s\n' "$table"
    "${core[@]}" "$@" > "$target/table.part" && mv "$target/table.part" "$tables/$table"
}
if [ "${1:-all}" = ehl ]; then
    measure ehl_cost.txt "$target/bin/ehl_cost" decks
    "$python" bench/plot_ehl.py "$tables/ehl_cost.txt" doc/figures/ehl_cost.png
    exit 0
fi
if [ "${1:-all}" = range ]; then
    "${core[@]}" "$target/bin/ehl_range" "${@:2}"
    exit 0
fi

# the system's own: static libraries, which programs have, do not go into a shared one
folder=$(PKG_CONFIG_PATH='' pkg-config --libs-only-L hdf5-serial 2> /dev/null || PKG_CONFIG_PATH='' pkg-config --libs-only-L hdf5)
hdf5=()
for name in hdf5hl_fortran hdf5_hl_fortran hdf5_fortran hdf5_hl hdf5; do
    if gfortran -shared -o "$target/found.so" $folder "-l$name" 2> /dev/null; then hdf5+=("-l$name"); fi
done
gfortran -shared -o "$target/librhs.so" -Wl,-u,bench_open "$target/lib/libbench.a" $folder "${hdf5[@]}" \
    -lsundials_cvode -lsundials_nvecserial -lopenblas

if [ "${1:-all}" = dynamics ]; then
    measure dynamics_cvode.txt "$target/bin/against_cvode" decks trains
    measure dynamics_scipy.txt "$python" bench/against_scipy.py "$target/librhs.so" decks trains
    "$python" bench/summarise.py "$tables/dynamics_cvode.txt" "$tables/dynamics_scipy.txt" > "$tables/dynamics_summary.txt"
    cat "$tables/dynamics_summary.txt"
    exit 0
fi
measure cycle_speed.txt "$target/bin/cycle_speed" decks
measure ehl_speed.txt "$target/bin/ehl_speed"
measure ehl_map.txt "$target/bin/ehl_map"
"$python" post/ehl_map.py "$tables/ehl_map.txt" doc/figures/ehl_map.png
measure against_cvode.txt "$target/bin/against_cvode" decks roller
measure against_scipy.txt "$python" bench/against_scipy.py "$target/librhs.so" decks roller
"$python" bench/summarise.py "$tables/against_cvode.txt" "$tables/against_scipy.txt" > "$tables/summary.txt"
"$python" bench/plot.py "$tables" "$tables/against_cvode.txt" "$tables/against_scipy.txt"
cat "$tables/summary.txt"
