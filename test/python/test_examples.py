"""Examples for hosts: built from an installed prefix alone, away from the sources, and run."""

from __future__ import annotations

import os
import re
import shutil
import sys

import pytest

from conftest import printed

WORDS = re.compile(r"cycle (\d) drive +(\S+) friction +(\S+) bearings +(\S+)")


@pytest.fixture(scope="module")
def place(cmake_prefix, tmp_path_factory):
    """The examples as they are installed, copied to where nothing else is."""
    (installed,) = cmake_prefix.glob("share/doc/*/examples/engine_host")
    place = tmp_path_factory.mktemp("host")
    shutil.copytree(installed, place, dirs_exist_ok=True)
    return place


@pytest.fixture(scope="module")
def built(place, cmake_prefix):
    """Both hosts by make and pkg-config."""
    printed("make", "-j2", folder=place, env={**os.environ, "PKG_CONFIG_PATH": str(cmake_prefix / "lib" / "pkgconfig")})
    return place


def numbers(text):
    """Torques of each cycle."""
    return [tuple(float(word) for word in row[1:]) for row in WORDS.findall(text)]


@pytest.fixture(scope="module")
def of_c(built):
    """Torques of one cycle of the host in C, in two threads."""
    return numbers(printed(built / "engine_host_c", "engine.nml", 1, 2, folder=built))[0]


def test_hosts_in_fortran_and_c_get_the_same_torques_with_any_threads(built, of_c):
    one = numbers(printed(built / "engine_host_fortran", "engine.nml", 1, 1, folder=built))
    assert len(one) == 1 and 0.0 < one[0][2] < one[0][1]
    assert numbers(printed(built / "engine_host_fortran", "engine.nml", 1, 3, folder=built)) == one
    # the mathematical functions of C and Fortran may differ in the last digit of a pressure
    assert of_c == pytest.approx(one[0], rel=1e-9)


def test_a_cmake_project_builds_both_hosts(place, cmake_prefix):
    printed("cmake", "-B", "build", f"-DCMAKE_PREFIX_PATH={cmake_prefix}", folder=place)
    printed("cmake", "--build", "build", "-j2", folder=place)
    for name in ("engine_host_fortran", "engine_host_c"):
        printed("ldd", place / "build" / name)


def test_the_script_in_python_gets_what_the_hosts_get(built, of_c, installed_package):
    text = printed(sys.executable, built / "engine_host.py", built / "engine.nml",
                   env={**os.environ, "PYTHONPATH": str(installed_package)})
    # steps twice as long
    assert float(re.search(r"friction (\S+) N m, of", text).group(1)) == pytest.approx(of_c[1], rel=1e-3)


def test_fmpy_runs_the_engine(place, camroller, cmake_prefix):
    printed(camroller, "fmu", "engine.nml", "--library", cmake_prefix / "lib" / "camroller", folder=place)
    text = printed(sys.executable, "engine_host_fmu.py", "engine.fmu", folder=place)
    assert 0.1 < float(re.search(r"friction (\S+) N m", text).group(1)) < 1.0
