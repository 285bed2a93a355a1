#!/usr/bin/env bash
# Set up what building and testing need: system packages, .venv with the tools of requirements.txt, test-drive for fpm.
#
# Usage: tools/setup.sh          quick where there is nothing left to do
# Called by the Makefile. Only installs system packages as root on a machine with apt-get; otherwise says which are
# missing and ends with exit code 1. Open MPI is the one package that is installed where it can be and done without elsewhere.
set -euo pipefail
cd "$(dirname "$0")/.."

say() { printf 'setup: %s\n' "$*"; }
fail() { printf 'setup: %s\n' "$*" >&2; exit 1; }

# ---- system packages ---------------------------------------------------------------------------------------------
# Looked for by what they bring, so that other systems and other ways to install them do as well.
missing_packages() {
    command -v make > /dev/null || echo make
    command -v git > /dev/null || echo git
    command -v gcc > /dev/null || echo gcc
    command -v gfortran > /dev/null || echo gfortran
    command -v pkg-config > /dev/null || echo pkg-config
    has_hdf5 || echo libhdf5-dev
    pkg-config --exists openblas 2> /dev/null || echo libopenblas-dev
    command -v cmake > /dev/null || echo cmake
    command -v python3 > /dev/null || echo python3
    python3 -c 'import ensurepip, venv' 2> /dev/null || echo python3-venv
}

has_hdf5() {
    local directory
    pkg-config --exists hdf5 2> /dev/null || return 1
    directory=$(pkg-config --cflags-only-I hdf5 | tr -s ' ' '\n' | sed -n 's/^-I//p' | head -n 1)
    [ -f "${directory:-/usr/include}/hdf5.mod" ]
}

# What programs are linked with, of which pkg-config hears in build/pkgconfig first: where HDF5 is there with and without MPI, the serial
# one; where its static libraries are there, these: the shared one brings 40 others into a process, for files on web servers, which takes
# longer than all else of its start. The linker takes a text of that form in the place of a library.
hdf5_to_link() {
    local package=hdf5 names=(hdf5hl_fortran hdf5_fortran hdf5_hl hdf5) target=build/pkgconfig
    local folder file name static=()
    local -x PKG_CONFIG_PATH=${PKG_CONFIG_PATH-}
    PKG_CONFIG_PATH=${PKG_CONFIG_PATH#"$PWD/$target:"}
    ! pkg-config --exists hdf5-serial 2> /dev/null || package=hdf5-serial
    file=$(pkg-config --variable=pcfiledir $package)/$package.pc
    folder=$(pkg-config --libs-only-L $package | tr -s ' ' '\n' | sed -n 's/^-L//p' | head -n 1)
    mkdir -p $target
    for name in "${names[@]}"; do
        if [ -f "${folder:-/usr/lib}/lib$name.a" ]; then static+=("${folder:-/usr/lib}/lib$name.a"); fi
    done
    if [ ${#static[@]} = ${#names[@]} ] && [ -f "${folder:-/usr/lib}/libhdf5.so" ]; then
        sed 's/^Libs:.*/Libs: -L${pcfiledir} -lhdf5/' "$file" | keep $target/hdf5.pc
        { echo "GROUP ( ${static[*]}"
          echo "AS_NEEDED ( $(ldd "${folder:-/usr/lib}/libhdf5.so" | sed -n 's/.* => \(\/[^ ]*\) .*/\1/p' | tr '\n' ' ')) )"
        } | keep $target/libhdf5.a
        for name in "${names[@]}"; do [ $name = hdf5 ] || ln -sfn libhdf5.a $target/lib$name.a; done
    elif [ -f "$file" ] && [ $package = hdf5-serial ]; then
        ln -sfn "$file" $target/hdf5.pc
    fi
}

# Write a file of what comes in, unless it is there and the same.
keep() { # file
    cat > "$1.part"
    if [ ! -L "$1" ] && cmp -s "$1.part" "$1"; then rm "$1.part"; else mv -f "$1.part" "$1"; fi
}

system_packages() {
    local missing
    missing=$(missing_packages | tr '\n' ' ')
    [ -n "$missing" ] || return 0
    command -v apt-get > /dev/null || fail "missing on this system: $missing(names as in Debian 12); install them and repeat"
    [ "$(id -u)" = 0 ] || fail "missing on this system: $missing; type: sudo apt-get install -y --no-install-recommends $missing"
    say "installing $missing"
    # shellcheck disable=SC2086  # the names are words
    install_packages $missing ||
        { tail -n 20 build/apt.log >&2; fail "cannot install packages; type: apt-get update && apt-get install $missing"; }
    missing=$(missing_packages | tr '\n' ' ')
    [ -z "$missing" ] || fail "still missing after the installation: $missing"
}

install_packages() { # names
    { apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "$@"; } \
        > build/apt.log 2>&1 < /dev/null
}

# Open MPI is for sweeps over many nodes; where it cannot be had, that is said once and everything else works without.
optional_packages() {
    local note=build/without-open-mpi
    if command -v mpifort > /dev/null && command -v mpirun > /dev/null; then return 0; fi
    if ! command -v apt-get > /dev/null || [ "$(id -u)" != 0 ] || [ -f "$note" ]; then return 0; fi
    say "installing libopenmpi-dev openmpi-bin"
    if ! install_packages libopenmpi-dev openmpi-bin; then
        tail -n 3 build/apt.log | tee "$note" >&2
        say "cannot install Open MPI; goes on without the program for many nodes (remove $note to try again)"
    fi
}

# ---- tools in Python ---------------------------------------------------------------------------------------------
# The commands of a virtual environment name its folder: in a checkout that was moved or copied it is made anew.
python_tools() {
    local folder stamp=.venv/requirements.done
    mkdir -p .venv
    folder=$(cd -P .venv && pwd)
    if [ -x .venv/bin/python ] && python_stamp "$folder" | cmp -s - "$stamp"; then return 0; fi
    python3 -c 'import sys; sys.exit(sys.version_info < (3, 11))' ||
        fail "Python 3.11 or later is needed; python3 is $(python3 --version 2>&1)"
    say "installing the tools of requirements.txt in .venv"
    if ! [ -x .venv/bin/python ] || ! grep -qsxF "# $folder" "$stamp"; then python3 -m venv --clear "$folder"; fi
    .venv/bin/python -m pip install --quiet --disable-pip-version-check --use-pep517 -r requirements.txt < /dev/null ||
        fail "pip cannot install requirements.txt"
    python_stamp "$folder" > "$stamp"
}

python_stamp() { # folder
    echo "# $1"
    cat requirements.txt
}

# ---- test-drive --------------------------------------------------------------------------------------------------
# The test library that fpm.toml names; fpm takes a dependency that it finds in build/dependencies as it is. It comes from its
# repository where git reaches that, otherwise from a source package on PyPI that carries the same release. Either copy is
# taken only if its files have the checksums of tools/test-drive.sha256.
readonly test_drive_archive=tblite==0.7.0 # its folder subprojects/test-drive

test_drive() {
    local target=build/dependencies/test-drive part=build/test-drive.part source=cloned url tag
    [ -f "$target/src/testdrive.F90" ] && return 0
    rm -rf "$target" "$part"
    mkdir -p build/dependencies "$part"
    url=$(sed -n 's/^test-drive\.git = "\(.*\)"/\1/p' fpm.toml)
    tag=$(sed -n 's/^test-drive\.tag = "\(.*\)"/\1/p' fpm.toml)
    say "fetching test-drive $tag"
    if ! { clone_test_drive "$url" "$tag" "$part/cloned" && has_checksums "$part/cloned"; }; then
        source=unpacked
        unpack_test_drive "$part" > build/test-drive.log 2>&1 && has_checksums "$part/unpacked" ||
            { cat build/test-drive.log >&2
              fail "cannot fetch test-drive $tag, neither by git nor from PyPI; put its sources into $target"; }
    fi
    mv "$part/$source" "$target"
    # fpm reads the commit of a dependency
    [ -d "$target/.git" ] || { git -C "$target" init -q && git -C "$target" add -A &&
        git -C "$target" -c user.name=setup -c user.email=setup@localhost commit -q -m "test-drive $tag"; }
    rm -rf "$part"
}

clone_test_drive() { # url, tag, folder
    export GIT_TERMINAL_PROMPT=0
    timeout 10 git ls-remote "$1" HEAD > /dev/null 2>&1 < /dev/null &&
        timeout 120 git -c advice.detachedHead=false clone -q --depth 1 --branch "$2" "$1" "$3" < /dev/null
}

# pip would build what it downloads; unearth downloads only, from the index that pip is set to.
unpack_test_drive() { # folder
    local index
    index=${PIP_INDEX_URL:-$(.venv/bin/python -m pip config get global.index-url 2> /dev/null)} || index=
    .venv/bin/unearth ${index:+--index-url "$index"} --no-binary --download "$1" "$test_drive_archive" < /dev/null &&
        tar -xzf "$1"/tblite-*.tar.gz -C "$1" && mv "$1"/tblite-*/subprojects/test-drive "$1/unpacked"
}

has_checksums() { # folder
    local list=$PWD/tools/test-drive.sha256
    (cd "$1" && grep -v '^#' "$list" | sha256sum --check --status) || { say "this copy of test-drive is another one: $1" >&2; return 1; }
}

mkdir -p build
system_packages
optional_packages
hdf5_to_link
python_tools
test_drive
