#!/usr/bin/env bash
# Tell the build what it builds: write build/commit/build_commit.inc, or FILE, where that has changed.
#
# Usage: tools/write_commit.sh [FILE]     by make and fpm without FILE; CMake and packages name a file of theirs
#
# What it builds is its commit; with sources that differ from the commit, the commit and a checksum of all sources; without git, and
# where the sources are none of git's, "unknown" and the checksum. So two builds have the same mark only where their sources are the same.
#
# The compiler finds this file before the one in include, which says "unknown" for builds without make. fpm does not look
# into included files, so what was compiled from the old one is removed. fpm does not take the object of a source that was
# moved or removed out of its library either, where it would stand beside the new one: such objects and libraries are removed.
set -euo pipefail
target=${1:-}
case $target in '' | /*) ;; *) target=$PWD/$target ;; esac
cd "$(dirname "$0")/.."

# Eight digits for the content of all sources; nothing where there are none, or no program that reads them
checksum_of_sources() {
    local files sum
    files=$(find src app include fpm.toml -type f \( -name '*.f90' -o -name '*.inc' -o -name '*.h' -o -name fpm.toml \) 2> /dev/null |
        LC_ALL=C sort) || true
    [ -n "$files" ] || return 0
    sum=$(tr '\n' '\0' <<< "$files" | xargs -0 cksum | cksum) || return 0
    printf -- '-%08x' "${sum%% *}"
}

# A folder inside of a repository need not belong to it
if git ls-files --error-unmatch src/base/version.f90 > /dev/null 2>&1 && commit=$(git rev-parse --short=12 HEAD 2> /dev/null); then
    changes=$(git --no-optional-locks status --porcelain -- 'src/*.f90' 'app/*.f90' include fpm.toml) || changes=unknown
    if [ -n "$changes" ]; then commit=$commit-changed$(checksum_of_sources); fi
else
    commit=unknown$(checksum_of_sources)
fi
text="character(len=*), parameter :: build_commit = \"$commit\""

# Write a file where it does not say so already; fails where it does
write_anew() {
    if [ -f "$1" ] && [ "$(cat "$1")" = "$text" ]; then return 1; fi
    mkdir -p "$(dirname "$1")"
    printf '%s\n' "$text" > "$1"
}

if [ -n "$target" ]; then
    write_anew "$target" || true
    exit 0
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
if write_anew build/commit/build_commit.inc; then
    rm -f build/gfortran_*/camroller/src_base_version.f90.o* \
        bench/build/*/bench/.*src_base_version.f90.o*
fi
