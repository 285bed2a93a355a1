#!/usr/bin/env python3
"""Run the program and the Fortran tests with the compiler's checks of memory and of undefined behaviour, and list what they find.

Usage: make sanitize [SUITES="names"] [DECKS="paths"]

The program runs every shipped deck, exports and computes again what it wrote, and prints what it prints; then the Fortran suites
run. Everything is built with -fsanitize=address,undefined. Leaks count in the suites; the program ends without waiting for
libraries, so they are not looked for there. Ends with one line of counts.
"""

from __future__ import annotations

import os
import pathlib
import re
import subprocess
import sys
import tempfile

from fortran_source import ROOT

FPM = str(ROOT / "tools/fpm")
REPORT = re.compile(r"ERROR: AddressSanitizer.*|SUMMARY: AddressSanitizer: (?!\d+ byte).*|[^\s:]+:\d+:\d+: runtime error: .*")
# No fault: gfortran adds strides of an optional array that is absent, which it never sets, before it hands the absence on to another
# procedure (-fdump-tree-original shows it). What stands there is mostly a real: numbers that no index and no count of ours reaches
ABSENT_ARRAY = re.compile(r"signed integer overflow: -?\d{16,} - -?\d{16,} cannot be represented in type 'integer\(kind=8\)'")
# A leak, and the first frame below malloc: what a test or the list of tests keeps to its end is none of ours
LEAK = re.compile(r"^Direct leak of (\d+) byte.*\n(?:\s+#0 .*\n)\s+#1 \S+ in (\S+ (?:\./)?(?:src|app)/\S+)", re.MULTILINE)
ADDRESSES = re.compile(r" (?:on address |at pc |bp |sp )0x[0-9a-f]+")
SECONDS = 1200  # for one command
# Libraries of others, which keep what they allocate once
SUPPRESSIONS = "leak:libhdf5\nleak:H5\nleak:libopenblas\nleak:libgomp\nleak:libgfortran\nleak:ld-linux\n"
# Suites that draw many cases at random or measure: hours with checks, and the same code as the others
LONG_SUITES = {"random_cases", "random_ehl", "needed", "ehl_rough"}


def environment(leaks: bool) -> dict[str, str]:
    """Variables that the checks read."""
    suppressions = ROOT / "build/sanitize.suppressions"
    suppressions.write_text(SUPPRESSIONS, encoding="utf-8")
    return os.environ | {
        "ASAN_OPTIONS": f"detect_leaks={int(leaks)}:detect_stack_use_after_return=0:allocator_may_return_null=1",
        "LSAN_OPTIONS": f"suppressions={suppressions}:print_suppressions=0",
        "UBSAN_OPTIONS": "print_stacktrace=1",
        "OPENBLAS_NUM_THREADS": "1",
        "WIDE_CASES": "12",  # random cases of the suite random_wide, which takes a minute for each with checks
    }


def attempt(words: list[str], folder: pathlib.Path, leaks: bool = False) -> list[str]:
    """Run a command; what the checks found, once each."""
    try:
        done = subprocess.run(words, cwd=folder, env=environment(leaks), stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, errors="replace", timeout=SECONDS, check=False)
    except subprocess.TimeoutExpired:
        return [f"not over after {SECONDS} s"]
    log = ROOT / "build/sanitize.log"
    found = sorted(set(ADDRESSES.sub("", match[0]) for match in REPORT.finditer(done.stdout)
                       if not ABSENT_ARRAY.search(match[0])))
    found += sorted(set(f"leak of {match[1]} bytes in {match[2]}" for match in LEAK.finditer(done.stdout)))
    if not found and done.returncode < 0:
        found = [f"ended by signal {-done.returncode}"]
    if found:
        with log.open("a", encoding="utf-8") as file:
            file.write(f"==== {' '.join(words)}\n{done.stdout}\n")
    return found


def commands(program: str, decks: list[pathlib.Path]):
    """What the program is asked to do; all files go to the present folder."""
    yield [program, "help"]
    yield [program, "version"]
    yield [program, "defaults"]
    for deck in decks:
        name = deck.stem
        coarse = ["--set", "output.angle_step_deg=5"]
        yield [program, "check", str(deck)]
        yield [program, "run", str(deck), "-o", f"{name}.h5", *coarse]
        yield [program, "export", f"{name}.h5", "-o", f"{name}.csv"]
        yield [program, "export", f"{name}.h5", "--summary"]
        yield [program, "rerun", f"{name}.h5", "--threads", "2"]
    thesis = str(ROOT / "decks/thesis.nml")
    one = ["--set", "sweep.values_1=300", "--set", "sweep.values_2=60"]
    yield [program, "sweep", thesis, "-o", "sweep.h5", "--threads", "2"]
    yield [program, "study", thesis, "-o", "study.h5", "--quick", "--repeats", "1", *one]
    yield [program, "audit", thesis, "-o", "audit.h5", "--repeats", "1", *one]
    yield [program, "ehl", thesis, "-o", "ehl.h5", "--set", "sweep.values_1=300", "--set", "sweep.values_2=90"]


def suites() -> list[str]:
    """Names of the Fortran suites."""
    text = (ROOT / "test/main.f90").read_text(encoding="utf-8")
    return [name for name in re.findall(r'new_testsuite\("(\w+)"', text) if name not in LONG_SUITES]


def main() -> int:
    """All of it; returns the exit code."""
    flags = os.environ["SANITIZE_FLAGS"]
    program = str(ROOT / "build/sanitize/bin/camroller")
    chosen = os.environ.get("DECKS", "").split()
    decks = [pathlib.Path(name).resolve() for name in chosen] or sorted((ROOT / "decks").glob("*.nml")) + sorted(
        (ROOT / "decks/hard").glob("*.nml"))
    names = os.environ.get("SUITES", "").split() or suites()
    (ROOT / "build/sanitize.log").unlink(missing_ok=True)
    runs = faults = 0
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        works = [(words, False) for words in commands(program, decks)]
        runner = subprocess.run([FPM, "test", "--flag", flags, "--runner", "echo"], cwd=ROOT, stdout=subprocess.PIPE, text=True,
                                check=True).stdout.splitlines()[-1].strip()
        works += [([runner, name], True) for name in names]
        for words, leaks in works:
            found = attempt(words, ROOT if leaks else folder, leaks)
            runs += 1
            faults += bool(found)
            label = " ".join(pathlib.Path(word).name if "/" in word else word for word in words)
            print(f"{'FOUND' if found else 'clean'}  {label}", *[f"       {line}" for line in found], sep="\n", flush=True)
    print(f"{runs - faults} passed, {faults} failed")
    if faults:
        print("the whole reports are in build/sanitize.log")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
