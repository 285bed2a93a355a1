#!/usr/bin/env bash
# Tell the build which commit it builds: write build/commit/build_commit.inc where that has changed.
#
# The compiler finds this file before the one in include, which says "unknown" for builds without make. fpm does not look
# into included files, so what was compiled from the old one is removed.
set -euo pipefail
cd "$(dirname "$0")/.."

commit=$(git rev-parse --short=12 HEAD 2> /dev/null) || commit=unknown
if [ "$commit" != unknown ] && ! git diff --quiet HEAD -- src app include fpm.toml; then
    commit=$commit-changed
fi
target=build/commit/build_commit.inc
text="character(len=*), parameter :: build_commit = \"$commit\""
if [ -f "$target" ] && [ "$(cat "$target")" = "$text" ]; then exit 0; fi
mkdir -p build/commit
printf '%s\n' "$text" > "$target"
# where the sources are in the folder above, fpm calls an object after it, with dots in front
rm -f build/gfortran_*/camroller/src_base_version.f90.o* mpi/build/*/camroller-mpi/.*src_base_version.f90.o* \
    bench/build/*/bench/.*src_base_version.f90.o*
