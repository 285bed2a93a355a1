#!/usr/bin/env python3
"""Build everything with run-time checks, and fail on anything that the compiler said of a file of ours.

Usage: make check-warnings, which sets DEBUG_FLAGS

fpm keeps what the compiler said of each file beside its object, whenever it was compiled; -Werror would hit the test library as well.
"""

from __future__ import annotations

import os
import pathlib
import subprocess
import sys

from fortran_source import ROOT


def build_objects(flags: str) -> list[pathlib.Path]:
    """Build everything, then ask for the objects of our own files."""
    fpm = [str(ROOT / "tools/fpm"), "build", "--tests", "--no-prune", "--flag", flags]
    built = subprocess.run(fpm, cwd=ROOT, capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL)
    if built.returncode:
        sys.exit(built.stdout + built.stderr)
    listed = subprocess.run(fpm + ["--list"], cwd=ROOT, capture_output=True, text=True, check=True, stdin=subprocess.DEVNULL)
    paths = [ROOT / line.strip() for line in (listed.stdout + listed.stderr).splitlines() if line.endswith(".o")]
    return [path for path in paths if not path.name.startswith("build_dependencies")]


def main() -> int:
    """All files; returns the exit code."""
    objects = build_objects(os.environ["DEBUG_FLAGS"])
    said = [path.with_name(path.name + ".log").read_text(encoding="utf-8") for path in objects]
    noisy = [words for words in said if words]
    for words in noisy:
        print(words, file=sys.stderr)
    print(f"warnings: {len(objects)} files, {len(noisy)} with warnings")
    return 0 if objects and not noisy else 1


if __name__ == "__main__":
    sys.exit(main())
