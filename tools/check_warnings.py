#!/usr/bin/env python3
"""Have the compiler read every file of ours again, with the flags of the build with run-time checks, and fail on any warning.

Usage: make check-warnings, which sets DEBUG_FLAGS

fpm shows warnings only of what it happens to compile, and -Werror would hit the test library as well. No code is made, which takes a
fifth of the time: what gfortran says only while it makes code are guesses, on values that may not be set for the most part.
"""

from __future__ import annotations

import concurrent.futures
import json
import os
import subprocess
import sys
import tempfile

from fortran_source import ROOT

WARNINGS = "-Wall -Wextra -Wimplicit-interface -fsyntax-only"


def build_commands(flags: str) -> list[dict]:
    """Build everything, then ask for the commands of our own files."""
    fpm = [str(ROOT / ".venv/bin/fpm"), "build", "--tests", "--no-prune", "--flag", flags]
    result = subprocess.run(fpm, cwd=ROOT, capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL)
    if result.returncode:
        sys.exit(result.stdout + result.stderr)
    # One thread: fpm writes the list from all its threads at once and damages it.
    subprocess.run(fpm + ["--list"], cwd=ROOT, capture_output=True, check=True, stdin=subprocess.DEVNULL,
                   env=os.environ | {"OMP_NUM_THREADS": "1"})
    commands = json.loads((ROOT / "build/compile_commands.json").read_text(encoding="utf-8"))
    return [c for c in commands if not os.path.normpath(c["file"]).startswith("build/")]


def warnings_of(command: dict, folder: str) -> str:
    """What the compiler says about one file; its module file goes nowhere."""
    arguments = list(command["arguments"])
    output = arguments.index("-o")
    del arguments[output:output + 2]
    if "-J" in arguments:
        own = os.path.join(folder, os.path.normpath(command["file"]).replace(os.sep, "_"))
        os.makedirs(own)
        modules = arguments.index("-J") + 1
        arguments += ["-I" + arguments[modules]]
        arguments[modules] = own
    arguments += WARNINGS.split()
    result = subprocess.run(arguments, cwd=command["directory"], capture_output=True, text=True, check=False)
    return result.stderr


def main() -> int:
    """All files; returns the exit code."""
    commands = build_commands(os.environ["DEBUG_FLAGS"])
    noisy = 0
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for text in pool.map(lambda c: warnings_of(c, folder), commands):
            if text:
                noisy += 1
                print(text, file=sys.stderr)
    print(f"warnings: {len(commands)} files, {noisy} with warnings")
    return 1 if noisy else 0


if __name__ == "__main__":
    sys.exit(main())
