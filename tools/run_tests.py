#!/usr/bin/env python3
"""Run all tests and end with one line of counts.

Usage: make test, which builds both programs and sets DEBUG_FLAGS and RELEASE_FLAGS

Fortran tests with run-time checks and optimised, the examples, Python tests. Python tests that start the program run with
both programs, the others once, as do those that are marked `once`. Two parts run at a time; each prints when it is over. A part
that breaks off counts as one failure.
"""

from __future__ import annotations

import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys
import time
import xml.etree.ElementTree

from fortran_source import ROOT

COUNTS = re.compile(r"^(\d+) passed, (\d+) failed$")
FPM = str(ROOT / "tools/fpm")
# threads of a step wait for each other asleep: busily they take the cores from the other part, for ten times as long
SIDE_BY_SIDE = {"OMP_WAIT_POLICY": "passive"}


class Part:
    """A part of the tests: its commands, and what they print, kept so that parts that run side by side do not mix."""

    def __init__(self, name: str, work, *arguments: str):
        self.name, self.work, self.arguments = name, work, arguments
        self.text: list[str] = []
        self.passed = self.failed = 0
        self.seconds = 0.0

    def run(self, command: list[str], **variables: str) -> tuple[int, list[str]]:
        """Run a command; its exit code and its output."""
        done = subprocess.run(command, cwd=ROOT, env=os.environ | SIDE_BY_SIDE | variables, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")
        lines = done.stdout.splitlines()
        self.text += [line for line in lines if not line.startswith(("[", " found "))]  # those are fpm's progress
        return done.returncode, lines

    def do(self) -> Part:
        """All of it; returns itself."""
        start = time.monotonic()
        self.passed, self.failed = self.work(self, *self.arguments)
        self.seconds = time.monotonic() - start
        return self

    def show(self) -> None:
        """Print what it has said."""
        print(f"==== {self.name}", *self.text, sep="\n", flush=True)


def settle(code: int, passed: int, failed: int) -> tuple[int, int]:
    """Counts of a part; one failure more where it ended badly without naming any."""
    return (passed, failed + 1) if code and not failed else (passed, failed)


def fortran_tests(part: Part, program: str) -> tuple[int, int]:
    """The Fortran test runner, built before."""
    code, lines = part.run([program])
    counts = [match for line in lines if (match := COUNTS.match(line))]
    if not counts:
        return 0, 1
    return settle(code, int(counts[-1][1]), int(counts[-1][2]))


def examples(part: Part) -> tuple[int, int]:
    """Every example program counts as one test."""
    passed = failed = 0
    for path in sorted((ROOT / "example/library").glob("*.f90")):
        code, _ = part.run(["make", "--no-print-directory", "example", f"EXAMPLE={path.stem}"])
        passed, failed = (passed, failed + 1) if code else (passed + 1, failed)
    return (passed, failed) if passed + failed else (0, 1)


def build(part: Part, flags: str) -> tuple[int, int]:
    """Build the Fortran test runner of the library that the program has; its path, which fpm knows, becomes the last line of the
    part's text. It is linked without -flto, which would take minutes; the program is there before and is not linked anew."""
    code, lines = part.run([FPM, "test", "--flag", flags, "--link-flag", "-fno-lto", "--runner", "echo"])
    return (1, 0) if code == 0 and pathlib.Path(lines[-1].strip()).is_file() else (0, 1)


def python_tests(part: Part, profile: str, folder: str, *options: str) -> tuple[int, int]:
    """pytest on the tests of one folder, with the program of one profile."""
    report = ROOT / f"build/tests/pytest-{profile}-{folder}.xml"
    report.parent.mkdir(parents=True, exist_ok=True)
    report.unlink(missing_ok=True)
    program = str(ROOT / f"build/{profile}/bin/camroller")
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", f"--junitxml={report}", *options, folder]
    code, _ = part.run(command, CAMROLLER=program, MPLBACKEND="Agg")
    if code == 5:  # no test chosen
        return 0, 0
    if not report.exists():
        return 0, 1
    suite = next(xml.etree.ElementTree.parse(report).iter("testsuite"))
    total, skipped = int(suite.get("tests")), int(suite.get("skipped"))
    failed = int(suite.get("failures")) + int(suite.get("errors"))
    return settle(code, total - skipped - failed, failed)


def main() -> int:
    """All parts; returns the exit code."""
    debug, optimised = os.environ["DEBUG_FLAGS"], os.environ["RELEASE_FLAGS"]
    # fpm writes to one folder whatever the flags: builds one after the other, then the tests side by side
    builds = [Part(f"build of the tests, {name}", build, flags).do() for name, flags in
              (("run-time checks", debug), ("optimised", optimised))]
    table = [Part("examples", examples).do()]
    for part in builds + table:
        part.show()
    if any(part.failed for part in builds):
        print(f"0 passed, {sum(part.failed for part in builds)} failed")
        return 1
    programs = [part.text[-1].strip() for part in builds]
    # in the order in which two at a time end at nearly the same time, the longest first
    parts = [
        Part("Python tests, optimised program", python_tests, "release", "test"),
        Part("Python tests, program with run-time checks", python_tests, "debug", "test", "-m", "program and not once"),
        Part("Python tests of figures", python_tests, "release", "post"),
        Part("Fortran tests, optimised", fortran_tests, programs[1]),
        Part("Fortran tests, run-time checks", fortran_tests, programs[0]),
    ]
    with concurrent.futures.ThreadPoolExecutor(max_workers=min(2, os.cpu_count() or 1)) as pool:
        for done in concurrent.futures.as_completed([pool.submit(part.do) for part in parts]):
            done.result().show()
    table += parts
    print("====")
    for part in table:
        print(f"{part.name:<45} {part.passed:5d} passed {part.failed:3d} failed {part.seconds:7.1f} s")
    passed, failed = sum(part.passed for part in table), sum(part.failed for part in table)
    print(f"{passed} passed, {failed} failed")
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main())
