#!/usr/bin/env bash
# Tell the build which commit it builds: write build/commit/build_commit.inc where that has changed.
#
# The compiler finds this file before the one in include, which says "unknown" for builds without make. fpm does not look
# into included files, so what was compiled from the old one is removed. fpm does not take the object of a source that was
# moved or removed out of its library either, where it would stand beside the new one: such objects and libraries are removed.
set -euo pipefail
cd "$(dirname "$0")/.."

commit=$(git rev-parse --short=12 HEAD 2> /dev/null) || commit=unknown
if [ "$commit" != unknown ] && ! git diff --quiet HEAD -- src app include fpm.toml; then
    commit=$commit-changed
fi
names=$(find src -name '*.f90' 2> /dev/null | tr / _) || true
# where the sources are in the folder above, fpm calls an object after it, with dots in front
for object in build/gfortran_*/camroller/src_*.f90.o bench/build/*/bench/.*src_*.f90.o; do
    [ -f "$object" ] || continue
    name=${object##*/}
    name=src_${name#*src_}
    if ! grep -qxF "${name%.o}" <<< "$names"; then
        rm -f "$object" "$object.digest" "${object%/*/*/*}"/*/*/lib*.a
    fi
done
target=build/commit/build_commit.inc
text="character(len=*), parameter :: build_commit = \"$commit\""
if [ -f "$target" ] && [ "$(cat "$target")" = "$text" ]; then exit 0; fi
mkdir -p build/commit
printf '%s\n' "$text" > "$target"
rm -f build/gfortran_*/camroller/src_base_version.f90.o* \
    bench/build/*/bench/.*src_base_version.f90.o*
