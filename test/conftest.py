"""Shared by all Python tests: commands that are run, the program under test, the installed library."""

import contextlib
import fcntl
import functools
import os
import pathlib
import shutil
import signal
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parent.parent
# Folder in which tests build with CMake, and the level at which they do, which takes half of the time of -O3
CMAKE_BUILD = ROOT / "build" / "cmake-tests"
CMAKE_FLAGS = "CMAKE_Fortran_FLAGS_RELEASE=-O1"


def heed_signals() -> None:
    """Heed signals as at a terminal: what is started by nohup, or in the background of a shell, hands on to all that it starts
    that they are ignored."""
    for number in (signal.SIGHUP, signal.SIGINT, signal.SIGQUIT, signal.SIGTERM, signal.SIGUSR1):
        if signal.getsignal(number) is signal.SIG_IGN:
            signal.signal(number, signal.default_int_handler if number == signal.SIGINT else signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_SETMASK, ())


heed_signals()


def run(program, *arguments, folder=ROOT, **options):
    """Run a command without a terminal and wait for it; a list is a program with its first arguments."""
    words = [str(word) for word in (*(program if isinstance(program, list) else [program]), *arguments)]
    source = {} if "input" in options else {"stdin": subprocess.DEVNULL}
    usual = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True, "timeout": 600, **source}
    return subprocess.run(words, cwd=folder, check=False, **(usual | options))


def done(program, *arguments, code=0, **options):
    """Run a command that must end with this exit code."""
    result = run(program, *arguments, **options)
    assert result.returncode == code, f"{result.stdout}{result.stderr}"
    return result


def printed(program, *arguments, **options):
    """What a command prints that must end well, however long it takes."""
    return done(program, *arguments, timeout=None, **options).stdout


@pytest.fixture(scope="session")
def camroller() -> str:
    """Path of the program: from the environment variable CAMROLLER, else the optimised build."""
    path = pathlib.Path(os.environ.get("CAMROLLER", ROOT / "build/release/bin/camroller"))
    assert path.is_file(), f"{path} is missing: `make build` or `make test`"
    return str(path)


@pytest.fixture(scope="session")
def checked(camroller):
    """What `check` says of a deck as it is, which takes seconds for some: asked for once, however many tests look at it."""
    return functools.cache(lambda deck: run(camroller, "check", deck))


@pytest.fixture(scope="session")
def cmake_prefix(tmp_path_factory) -> pathlib.Path:
    """A prefix with the core installed by CMake, without HDF5; what is built stays in build/cmake-tests from run to run."""
    return installed_by_cmake(tmp_path_factory.mktemp("prefix"), "OFF")


@pytest.fixture(scope="session")
def cmake_io_prefix(tmp_path_factory) -> pathlib.Path:
    """The same with what needs HDF5, and the program."""
    return installed_by_cmake(tmp_path_factory.mktemp("io_prefix"), "ON")


def installed_by_cmake(place: pathlib.Path, io: str) -> pathlib.Path:
    """The prefix, with libraries that are installed into it: with `io` ON those that need HDF5, too, and the program."""
    if shutil.which("cmake") is None:
        pytest.skip("cmake is not installed")
    # the one that builds the wheel: another version would compile everything again
    cmake = shutil.which("cmake", path=f"{pathlib.Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}")
    with alone_in_cmake():
        _install(cmake, place, io)
    return place


@contextlib.contextmanager
def alone_in_cmake():
    """Hold off other runs of the tests, such as that of the other build, which share the folder: each sets a prefix of its own."""
    (ROOT / "build").mkdir(exist_ok=True)
    with open(ROOT / "build" / "cmake.lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def _install(cmake: str, place: pathlib.Path, io: str) -> None:
    """Configure, build and install."""
    printed(cmake, "-G", "Unix Makefiles", "-S", ROOT, "-B", CMAKE_BUILD, f"-D{CMAKE_FLAGS}", f"-DCAMROLLER_IO={io}",
            "-DCMAKE_INSTALL_LIBDIR=lib", "-DCAMROLLER_BUNDLE_DIR=lib/camroller", f"-DCMAKE_INSTALL_PREFIX={place}")
    printed(cmake, "--build", CMAKE_BUILD, "-j2")
    printed(cmake, "--install", CMAKE_BUILD)


@pytest.fixture(scope="session")
def installed_package(cmake_prefix, tmp_path_factory) -> pathlib.Path:
    """A folder with the package of Python over the installed bundle, as the wheel has it."""
    place = tmp_path_factory.mktemp("package")
    shutil.copytree(ROOT / "python" / "camroller", place / "camroller", ignore=shutil.ignore_patterns("lib", "__pycache__"))
    (place / "camroller" / "lib").symlink_to(cmake_prefix / "lib" / "camroller")
    return place


def pytest_collection_modifyitems(items):
    """Mark what starts the program, so that it can be repeated with the other build."""
    for item in items:
        if "camroller" in getattr(item, "fixturenames", ()):
            item.add_marker("program")
