#!/usr/bin/env bash
# Build the optimised program and install it below a prefix: PREFIX/bin/camroller. For packages; no network, no .venv.
#
# Usage: packaging/install.sh PREFIX      with gfortran, fpm, pkg-config, HDF5 with Fortran, OpenBLAS; FPM names another fpm, and
#                                         FFLAGS, which builders of packages set, stands in the place of -O3 -g1
# Works on a copy in build/package without the tests, whose library fpm would fetch.
set -euo pipefail
cd "$(dirname "$0")/.."
[ $# = 1 ] || { echo "usage: packaging/install.sh PREFIX" >&2; exit 1; }
prefix=$(mkdir -p "$1" && cd "$1" && pwd)
fpm=$(command -v "${FPM:-fpm}") || { echo "fpm is not there: install it, or name it in FPM" >&2; exit 1; }
fpm=$(realpath -s "$fpm")

# All of it anew: the archive of an earlier build keeps the objects of sources that have moved
rm -rf build/package
mkdir -p build/package
cp -r src app include build/package
tools/write_commit.sh build/package/include/build_commit.inc
sed -e '/^\[dev-dependencies\]/,/^$/d' -e '/^\[\[test\]\]/,/^$/d' fpm.toml > build/package/fpm.toml
cd build/package
"$fpm" install --flag "-std=f2018 ${FFLAGS:--O3 -g1} -ffp-contract=off" --prefix "$prefix"
"$prefix/bin/camroller" --version
