#!/usr/bin/env python3
"""Compile the library with another compiler than gfortran 12 and run the tests that then can run.

Usage: make second-compiler [SECOND_FC="flang-22"], or tools/second_compiler.py --install to install flang first, as root on Debian

Modules of HDF5 are there for one compiler only; what uses them, directly or not, is left out and counted. Everything else has to
compile, and every suite of tests that needs nothing else has to pass. Exit code 0; 1 with what failed; 77 where there is no other compiler.
"""

from __future__ import annotations

import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import sys

from check_layers import MODULE, USE
from fortran_source import ROOT, sources, statements

DEBIAN_PACKAGE = "flang-22"
COMPILERS = ("flang-22", "flang-21", "flang-20", "flang-19", "gfortran-15", "gfortran-14", "gfortran-13")
BUILD = ROOT / "build/second"
TEST_DRIVE = ROOT / "build/dependencies/test-drive/src"
INTRINSIC = {"iso_fortran_env", "iso_c_binding", "ieee_arithmetic", "ieee_exceptions", "ieee_features"}
NO_COMPILER = 77


class Unit:
    """A source file: its module, and the modules it uses."""

    def __init__(self, path: pathlib.Path):
        self.path, self.name, self.uses = path, path.stem, set()
        for statement in statements(path.read_text(encoding="utf-8")):
            if match := MODULE.match(statement.text):
                self.name = match[1]
            elif match := USE.match(statement.text):
                self.uses.add(match[1])
        self.uses -= INTRINSIC

    @property
    def object(self) -> pathlib.Path:
        """Where its object file goes."""
        return BUILD / f"{self.name}.o"


def install() -> None:
    """Install a compiler where there is none and Debian's package can be had; where it cannot, the reason is shown."""
    if find_compiler() is None and os.getuid() == 0 and shutil.which("apt-get"):
        for command in (["update", "-qq"], ["install", "-qq", "-y", "--no-install-recommends", DEBIAN_PACKAGE]):
            subprocess.run(["apt-get", *command], check=False, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                           env=os.environ | {"DEBIAN_FRONTEND": "noninteractive"})


def find_compiler() -> str | None:
    """The compiler asked for, or the first that is there."""
    asked = os.environ.get("SECOND_FC")
    return asked if asked else next((name for name in COMPILERS if shutil.which(name)), None)


def available(units: dict[str, Unit]) -> dict[str, Unit]:
    """Units that need no module from outside, directly or not; a unit stands behind what it uses."""
    found: dict[str, Unit] = {}
    rest = dict(units)
    while ready := [unit for unit in rest.values() if unit.uses <= found.keys()]:
        for unit in ready:
            found[unit.name] = rest.pop(unit.name)
    return found


def compile_all(flags: list[str], units: dict[str, Unit]) -> list[str]:
    """Compile units, each as soon as what it uses is there; messages of those that failed."""
    faults: list[str] = []
    done: set[str] = set()
    waiting = dict(units)

    def compile_one(unit: Unit) -> subprocess.CompletedProcess:
        return subprocess.run([*flags, "-c", str(unit.path), "-o", str(unit.object)], cwd=BUILD, capture_output=True, text=True,
                              check=False, stdin=subprocess.DEVNULL)

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        running: dict[concurrent.futures.Future, Unit] = {}
        while True:
            for unit in [unit for unit in waiting.values() if unit.uses <= done]:
                running[pool.submit(compile_one, waiting.pop(unit.name))] = unit
            if not running:
                return faults
            for future in concurrent.futures.wait(running, return_when=concurrent.futures.FIRST_COMPLETED).done:
                unit = running.pop(future)
                if future.result().returncode:
                    faults.append(f"{unit.path.relative_to(ROOT)}: {future.result().stderr[:2000]}")
                else:
                    done.add(unit.name)


def runner(modules: dict[str, Unit]) -> tuple[Unit, list[str], list[str]]:
    """The test runner with the suites that can be built; these, and those left out."""
    text = (ROOT / "test/main.f90").read_text(encoding="utf-8")
    suites = re.findall(r"^ +new_testsuite\(\"(\w+)\"", text, re.MULTILINE)
    out = [name for name in suites if f"test_{name}" not in modules]
    kept = [name for name in suites if name not in out]
    for name in out:
        text = re.sub(rf'^ +use test_{name},.*\n|^ +new_testsuite\("{name}".*\n', "", text, flags=re.MULTILINE)
    last = f'new_testsuite("{kept[-1]}", collect_{kept[-1]})'
    text = re.sub(rf"{re.escape(last)}(, )? ?&", last + " &", text)
    path = BUILD / "main.f90"
    path.write_text(text, encoding="utf-8")
    return Unit(path), kept, out


def run_tests(flags: list[str], modules: dict[str, Unit], main: Unit) -> tuple[int, str]:
    """Link and run the test runner; its exit code and what it says."""
    link = [*flags, "-o", str(BUILD / "check"), str(main.object), *(str(unit.object) for unit in modules.values()), "-lopenblas"]
    done = subprocess.run(link, cwd=BUILD, capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL)
    if done.returncode:
        return done.returncode, done.stderr[-3000:]
    done = subprocess.run([BUILD / "check"], cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace",
                          check=False, stdin=subprocess.DEVNULL, env=os.environ | {"OPENBLAS_NUM_THREADS": "1"})
    return done.returncode, done.stdout


def main() -> int:
    """Everything; returns the exit code."""
    if sys.argv[1:] == ["--install"]:
        install()
    compiler = find_compiler()
    if compiler is None:
        print(f"none of {', '.join(COMPILERS)} is there, and SECOND_FC is not set; on Debian 12: apt-get install {DEBIAN_PACKAGE}")
        return NO_COMPILER
    shutil.rmtree(BUILD, ignore_errors=True)
    BUILD.mkdir(parents=True)
    flags = [compiler, "-std=f2018", "-O1", "-ffp-contract=off", f"-I{ROOT / 'include'}", f"-J{BUILD}"]
    library = {unit.name: unit for unit in map(Unit, sources("src"))}
    tests = {unit.name: unit for unit in map(Unit, sources("test")) if unit.name != "main"}
    tests |= {unit.name: unit for unit in (Unit(TEST_DRIVE / "testdrive.F90"), Unit(TEST_DRIVE / "testdrive_version.f90"))}
    modules = available(library | tests)
    main_unit, kept, out = runner(modules)
    version = subprocess.run([compiler, "--version"], capture_output=True, text=True, check=False).stdout.splitlines()[0]
    print(f"{version}: {len(library.keys() & modules.keys())} of {len(library)} files of the library and {len(kept)} of {len(kept) + len(out)} "
          f"suites need no module of HDF5")
    faults = compile_all(flags, modules | {main_unit.name: main_unit})
    for fault in faults:
        print(fault, file=sys.stderr)
    if faults:
        print(f"{len(faults)} files do not compile", file=sys.stderr)
        return 1
    code, said = run_tests(flags, modules, main_unit)
    lines = said.splitlines()
    print(*(line for line in lines if "FAILED" in line), *lines[-1:], sep="\n")
    return code


if __name__ == "__main__":
    sys.exit(main())
