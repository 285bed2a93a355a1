#!/usr/bin/env python3
"""Run all tests and end with one line of counts.

Usage: make test, which builds both programs and sets DEBUG_FLAGS and RELEASE_FLAGS

Fortran tests with run-time checks and optimised, the examples, Python tests. Python tests that start the program run with
both programs, the others once. A part that breaks off counts as one failure.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import time
import xml.etree.ElementTree

from fortran_source import ROOT

COUNTS = re.compile(r"^(\d+) passed, (\d+) failed$")
FPM = str(ROOT / ".venv/bin/fpm")


def run(command: list[str], **variables: str) -> tuple[int, list[str]]:
    """Run a command, pass its output on and keep it."""
    lines = []
    environment = os.environ | variables
    with subprocess.Popen(command, cwd=ROOT, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, errors="replace") as process:
        for line in process.stdout:
            if not line.startswith(("[", " found ")):  # progress of fpm
                print(line, end="", flush=True)
            lines.append(line.rstrip("\n"))
    return process.returncode, lines


def settle(code: int, passed: int, failed: int) -> tuple[int, int]:
    """Counts of a part; one failure more where it ended badly without naming any."""
    return (passed, failed + 1) if code and not failed else (passed, failed)


def fortran_tests(flags: str) -> tuple[int, int]:
    """The Fortran test runner, built with the flags."""
    code, lines = run([FPM, "test", "--flag", flags])
    counts = [match for line in lines if (match := COUNTS.match(line))]
    if not counts:
        return 0, 1
    return settle(code, int(counts[-1][1]), int(counts[-1][2]))


def examples(flags: str) -> tuple[int, int]:
    """Every example program counts as one test."""
    passed = failed = 0
    for path in sorted((ROOT / "example").glob("*.f90")):
        code, _ = run([FPM, "run", "--example", path.stem, "--flag", flags])
        passed, failed = (passed, failed + 1) if code else (passed + 1, failed)
    return passed, failed


def python_tests(profile: str, *options: str) -> tuple[int, int]:
    """pytest on the program of one profile."""
    report = ROOT / f"build/tests/pytest-{profile}.xml"
    report.parent.mkdir(parents=True, exist_ok=True)
    report.unlink(missing_ok=True)
    program = str(ROOT / f"build/{profile}/bin/camroller")
    command = [sys.executable, "-m", "pytest", "-q", f"--junitxml={report}", *options]
    code, _ = run(command, CAMROLLER=program, MPLBACKEND="Agg")
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
    debug, release = os.environ["DEBUG_FLAGS"], os.environ["RELEASE_FLAGS"]
    parts = [
        ("Fortran tests, run-time checks", lambda: fortran_tests(debug)),
        ("Fortran tests, optimised", lambda: fortran_tests(release)),
        ("examples", lambda: examples(release)),
        ("Python tests, optimised program", lambda: python_tests("release")),
        ("Python tests, program with run-time checks", lambda: python_tests("debug", "-m", "program")),
    ]
    table = []
    for name, part in parts:
        print(f"==== {name}", flush=True)
        start = time.monotonic()
        table.append((name, *part(), time.monotonic() - start))
    print("====")
    for name, passed, failed, seconds in table:
        print(f"{name:<45} {passed:5d} passed {failed:3d} failed {seconds:7.1f} s")
    passed, failed = sum(row[1] for row in table), sum(row[2] for row in table)
    print(f"{passed} passed, {failed} failed")
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main())
