#!/usr/bin/env bash
# Build the program for many nodes, build/mpi/bin/camroller-mpi, of the library of the release build, so that its numbers are the same.
#
# Usage: make mpi          does nothing where there is no Open MPI (libopenmpi-dev and openmpi-bin in Debian);
#                          MPI_LINK_FLAGS=-fno-lto links the machine code of the library, in seconds: the same bits, a tenth slower
set -euo pipefail
cd "$(dirname "$0")/.."

if ! command -v mpifort > /dev/null; then
    echo "mpi: there is no mpifort here, nothing is built"
    exit 0
fi
library=build/release/lib/libcamroller.a
# all of it anew where the library is another: CMake does not look at modules that it has not made
cmp -s $library build/mpi/libcamroller.a || rm -rf build/mpi
mkdir -p build/mpi
cp $library build/mpi/libcamroller.a
{ cmake -S mpi -B build/mpi/objects -DCMAKE_Fortran_FLAGS="$RELEASE_FLAGS -fimplicit-none" -DCMAKE_INSTALL_PREFIX="$PWD/build/mpi" \
    -DCMAKE_EXE_LINKER_FLAGS="${MPI_LINK_FLAGS:-}" &&
    cmake --build build/mpi/objects -j2 && cmake --install build/mpi/objects; } > build/mpi.log 2>&1 || { cat build/mpi.log; exit 1; }
