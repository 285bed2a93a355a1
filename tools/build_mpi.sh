#!/usr/bin/env bash
# Build the program for many nodes, build/mpi/bin/camroller-mpi, with the flags of the release build, so that its numbers are the same.
#
# Usage: make mpi          does nothing where there is no Open MPI (libopenmpi-dev and openmpi-bin in Debian)
set -euo pipefail
cd "$(dirname "$0")/.."

if ! command -v mpifort > /dev/null; then
    echo "mpi: there is no mpifort here, nothing is built"
    exit 0
fi
mkdir -p build
(cd mpi && FPM_FC=mpifort ../.venv/bin/fpm install --flag "$RELEASE_FLAGS -I../build/commit" --prefix ../build/mpi) \
    > build/mpi.log 2>&1 || { cat build/mpi.log; exit 1; }
