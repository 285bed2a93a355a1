"""The installed library: from an empty prefix a C program is built and tries every call of the interface.

The libraries are built by CMake, without HDF5 but for one test, into build/cmake-tests, which is kept from run to run.
"""

from __future__ import annotations

import collections
import os
import re
import shutil
import subprocess

import pytest

from conftest import ROOT, printed

DECK = ROOT / "decks" / "thesis.nml"
CAMSHAFT = ROOT / "decks" / "three_cam_head.nml"


@pytest.fixture(scope="module")
def prefix(cmake_prefix):
    """A prefix with the core installed."""
    return cmake_prefix


def built(prefix, source, program):
    """A C program, built by what pkg-config says of the prefix."""
    flags = printed("pkg-config", "--cflags", "--libs", "camroller",
                    env={**os.environ, "PKG_CONFIG_PATH": str(prefix / "lib" / "pkgconfig")}).split()
    printed("gcc", "-std=c11", "-Wall", "-Wextra", "-Werror", "-g", ROOT / "tools" / source, *flags, "-lm", "-lpthread",
            f"-Wl,-rpath,{prefix}/lib", "-o", program)
    return program


@pytest.fixture(scope="module")
def host(prefix, tmp_path_factory):
    """The program that tries every call."""
    return built(prefix, "try_c_interface.c", tmp_path_factory.mktemp("host") / "interface")


@pytest.fixture(scope="module")
def threads(prefix, tmp_path_factory):
    """The program that does the same work in many threads and in one."""
    return built(prefix, "try_threads.c", tmp_path_factory.mktemp("threads") / "threads")


def test_every_call_of_the_c_interface(host):
    assert "0 failures" in printed(host, DECK, CAMSHAFT)


def test_every_call_is_tried_with_null_in_every_place():
    """Pointers of each call of the header, and those places where the program above gives NULL."""
    header = re.sub(r"/\*.*?\*/", "", (ROOT / "include" / "camroller.h").read_text(), flags=re.DOTALL)
    source = (ROOT / "tools" / "try_c_interface.c").read_text()
    # what is refused is tried without an error struct, too
    calls = [(name, f"{words}, NULL") for name, words in re.findall(r"REFUSED\(\w+, \".*?\", (camroller_\w+), (.*)\);", source)]
    calls += re.findall(r"\b(camroller_\w+)\(([^()]*)\)", source)
    tried = collections.defaultdict(set)
    for name, words in calls:
        tried[name] |= {place for place, word in enumerate(words.split(",")) if word.strip() == "NULL"}
    declared = re.findall(r"\b(camroller_\w+)\(([^)]*)\);", header)
    assert len(declared) > 40
    for name, words in declared:
        pointers = {place for place, word in enumerate(words.split(",")) if "*" in word}
        assert pointers <= tried[name], (name, pointers - tried[name])


def test_no_memory_is_lost_or_misused(host):
    if shutil.which("valgrind") is None:
        pytest.skip("valgrind is not installed")
    # threads that OpenMP keeps for later are "possibly lost" at the end of a program
    printed("valgrind", "-q", "--leak-check=full", "--errors-for-leak-kinds=definite,indirect", "--error-exitcode=3", host, DECK,
            CAMSHAFT)


@pytest.mark.parametrize("deck", ["thesis", "numerical_film"])
def test_a_saved_follower_continues_in_another_process_with_the_same_bits(host, tmp_path, deck):
    """With films solved beforehand, too: the second process solves them for the same speed and oil."""
    block = tmp_path / "block"
    first = printed(host, ROOT / "decks" / f"{deck}.nml", "--restore", block)
    assert block.stat().st_size > 0
    assert printed(host, ROOT / "decks" / f"{deck}.nml", "--restore", block) == first


def test_decks_and_followers_in_64_threads_give_the_bits_of_one_thread(threads):
    """THREAD_RUNS=100 does it as often for each thread, which takes a minute."""
    assert "0 of 64" in printed(threads, DECK, 64, os.environ.get("THREAD_RUNS", "5"))


def test_helgrind_finds_no_data_race(threads):
    if shutil.which("valgrind") is None:
        pytest.skip("valgrind is not installed")
    printed("valgrind", "--tool=helgrind", "-q", "--error-exitcode=7", threads, DECK, 3, 1)


def test_the_header_compiles_as_c_plus_plus(prefix, tmp_path):
    source = tmp_path / "use.cpp"
    source.write_text("#include <camroller.h>\nint main() { return camroller_library_version() / 100 != CAMROLLER_VERSION / 100; }\n")
    printed("gcc", "-x", "c++", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", f"-I{prefix}/include", source)


def test_the_library_shows_its_own_names_and_needs_no_hdf5(prefix):
    library = prefix / "lib" / "libcamroller.so"
    shown = [line.split()[-1] for line in printed("nm", "-D", "--defined-only", library).splitlines()]
    assert [name for name in shown if not name.startswith(("camroller_", "__camroller_"))] == []
    declared = set(re.findall(r"\b(camroller_\w+)\(", (ROOT / "include" / "camroller.h").read_text()))
    assert declared == {name for name in shown if name.startswith("camroller_")}
    assert "hdf5" not in printed("ldd", library)
    assert re.search(r"SONAME.*libcamroller\.so\.\d+\.\d+\]", printed("readelf", "-d", library))


def test_no_call_of_c_has_the_name_of_a_module():
    """Both are global names of a program: gfortran takes one for the other without a word."""
    sources = [path.read_text() for top in ("src", "app") for path in (ROOT / top).rglob("*.f90")]
    calls = {name for text in sources for name in re.findall(r'bind\(C, name="(\w+)"\)', text)}
    modules = {name for text in sources for name in re.findall(r"^module (\w+)$", text, re.MULTILINE)}
    assert "camroller_case_run" in calls and not calls & modules


def test_all_that_a_case_is_made_of_and_all_torques_are_public():
    core = (ROOT / "src" / "core.f90").read_text()
    case = (ROOT / "src" / "case" / "case.f90").read_text()
    components = re.search(r"type :: case_t\n(.*?)end type case_t", case, re.DOTALL)[1]
    torques = re.findall(r"\bof_\w+", (ROOT / "src" / "losses" / "torque_list.f90").read_text())
    names = {*re.findall(r"\btype\((\w+)\)", components), *torques}
    assert len(names) > 40 and names - set(re.findall(r"\w+", core)) == set()


def test_a_fortran_program_and_a_cmake_project_find_the_prefix(prefix, tmp_path):
    (tmp_path / "host.f90").write_text("""program host
   use camroller_core, only : wp, error_t, deck_t, override_t, case_t, simulation_t, outcome_t, inputs_t, read_deck, make_case, &
      & start_simulation, advance
   implicit none
   type(deck_t) :: deck
   type(case_t) :: case
   type(simulation_t) :: simulation
   type(outcome_t) :: outcome
   type(override_t) :: none(0)
   type(error_t), allocatable :: error
   character(len=512) :: path
   call get_command_argument(1, path)
   call read_deck(deck, trim(path), none, error)
   if (.not. allocated(error)) call make_case(deck, none, case, error)
   if (.not. allocated(error)) call start_simulation(simulation, case, 0.0_wp, error)
   if (.not. allocated(error)) call advance(simulation, 1.0_wp, inputs_t(30.0_wp, 333.15_wp), inputs_t(31.0_wp, 333.15_wp), &
      & outcome, error)
   if (allocated(error)) stop 1
   if (.not. outcome%mean_torque_friction > 0.0_wp) stop 2
end program host
""")
    (tmp_path / "CMakeLists.txt").write_text("""cmake_minimum_required(VERSION 3.16)
project(host LANGUAGES C Fortran)
find_package(camroller REQUIRED)
foreach(kind shared static)
  add_executable(${kind} host.f90)
  target_link_libraries(${kind} PRIVATE camroller::camroller_${kind})
endforeach()
""")
    printed("cmake", "-S", tmp_path, "-B", tmp_path / "build", f"-DCMAKE_PREFIX_PATH={prefix}")
    printed("cmake", "--build", tmp_path / "build")
    for kind in ("shared", "static"):
        printed(tmp_path / "build" / kind, DECK)
        assert ("libcamroller" in printed("ldd", tmp_path / "build" / kind)) == (kind == "shared")


def test_nothing_installed_points_to_the_sources(prefix):
    """So that the source tree can go: neither texts nor the places where libraries look for others."""
    texts = [path for path in prefix.rglob("*") if path.suffix in (".pc", ".cmake", ".h", ".txt", ".nml", ".f90", ".c", ".py")]
    assert len(texts) > 8
    assert [path for path in texts if str(ROOT) in path.read_text()] == []
    for library in prefix.rglob("*.so*"):
        assert str(ROOT) not in printed("readelf", "-d", library)


def test_with_hdf5_there_are_both_libraries_the_program_and_its_pages(cmake_io_prefix, tmp_path):
    prefix = cmake_io_prefix
    result = tmp_path / "result.h5"
    printed(prefix / "bin" / "camroller", "run", DECK, "--no-sweep", "-o", result, "--quiet")
    assert result.read_bytes()[:4] == b"\x89HDF"
    assert (prefix / "share" / "man" / "man1" / "camroller.1").read_text().startswith(".TH")
    printed("bash", "-n", prefix / "share" / "bash-completion" / "completions" / "camroller")
    library = prefix / "lib" / "libcamroller_io.so"
    shown = [line.split()[-1] for line in printed("nm", "-D", "--defined-only", library).splitlines()]
    assert shown and all(name.startswith(("camroller_", "__camroller_")) for name in shown)
    assert "hdf5" in printed("ldd", library) and "hdf5" not in printed("ldd", prefix / "lib" / "libcamroller.so")
    # a program of Fortran for both, from another place
    (tmp_path / "CMakeLists.txt").write_text("""cmake_minimum_required(VERSION 3.16)
project(host LANGUAGES C Fortran)
find_package(camroller REQUIRED)
foreach(kind shared static)
  add_executable(${kind} two_cases.f90)
  target_link_libraries(${kind} PRIVATE camroller::camroller_io_${kind})
endforeach()
""")
    shutil.copy(ROOT / "example" / "library" / "two_cases.f90", tmp_path)
    printed("cmake", "-S", tmp_path, "-B", tmp_path / "build", f"-DCMAKE_PREFIX_PATH={prefix}")
    printed("cmake", "--build", tmp_path / "build")
    assert printed(tmp_path / "build" / "shared") == printed(tmp_path / "build" / "static") != ""
    assert printed(tmp_path / "build" / "shared") == run_by_pkg_config(prefix, tmp_path)


def run_by_pkg_config(prefix, place):
    """What the same program prints when it is built by what pkg-config says of both libraries."""
    flags = printed("pkg-config", "--cflags", "--libs", "camroller_io",
                    env={**os.environ, "PKG_CONFIG_PATH": str(prefix / "lib" / "pkgconfig")}).split()
    printed("gfortran", place / "two_cases.f90", *flags, f"-Wl,-rpath,{prefix}/lib", "-o", place / "by_pkg_config", folder=place)
    return printed(place / "by_pkg_config")


def test_a_sweep_leaves_the_printing_of_errors_by_hdf5_as_it_was(cmake_io_prefix, tmp_path):
    """A host that uses HDF5 itself sees the library's messages before and after."""
    (tmp_path / "host.f90").write_text("""program host
   use, intrinsic :: iso_c_binding, only : c_int
   use camroller, only : deck_t, error_t, override_t, read_deck, run_sweep, sweep_options_t, sweep_report_t
   implicit none
   interface
      function open_none(name, flags, access) bind(C, name="H5Fopen") result(file)
         use, intrinsic :: iso_c_binding, only : c_char, c_int, c_int64_t
         character(kind=c_char), intent(in) :: name(*)
         integer(c_int), value :: flags
         integer(c_int64_t), value :: access
         integer(c_int64_t) :: file
      end function open_none
   end interface
   type(deck_t) :: deck
   type(override_t) :: none(0)
   type(sweep_options_t) :: options
   type(sweep_report_t) :: report
   type(error_t), allocatable :: error
   character(len=512) :: path
   call get_command_argument(1, path)
   call read_deck(deck, trim(path), none, error)
   if (.not. allocated(error)) call run_sweep(deck, "sweep.h5", options, report, error)
   if (allocated(error)) stop 1
   if (open_none("there is none"//achar(0), 0_c_int, 0_8) >= 0) stop 2
end program host
""")
    flags = printed("pkg-config", "--cflags", "--libs", "camroller_io",
                    env={**os.environ, "PKG_CONFIG_PATH": str(cmake_io_prefix / "lib" / "pkgconfig")}).split()
    needed = printed("ldd", cmake_io_prefix / "lib" / "libcamroller_io.so")
    hdf5 = re.findall(r" => (\S*/libhdf5(?:_serial)?\.so\S*)", needed)[0]
    printed("gfortran", "host.f90", *flags, hdf5, f"-Wl,-rpath,{cmake_io_prefix}/lib", "-o", "host", folder=tmp_path)
    done = subprocess.run([str(tmp_path / "host"), str(DECK)], capture_output=True, text=True, check=False, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert "HDF5-DIAG" in done.stderr
