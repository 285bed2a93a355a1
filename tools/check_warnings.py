#!/usr/bin/env python3
"""Build everything with run-time checks, and fail on anything that the compiler said of a file of ours.

Usage: make check-warnings, which sets DEBUG_FLAGS

fpm keeps what the compiler said of each file beside its object, whenever it was compiled; -Werror would hit the test library as well.
"""

from __future__ import annotations

import os
import pathlib
import signal
import subprocess
import sys

from fortran_source import ROOT, sources


def build_objects(flags: str) -> list[pathlib.Path]:
    """Build everything, then ask for the objects of our own files. fpm names them within a second and goes on for two minutes, so it
    is stopped as soon as it has named all."""
    fpm = [str(ROOT / "tools/fpm"), "build", "--tests", "--no-prune", "--flag", flags]
    built = subprocess.run(fpm, cwd=ROOT, capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL)
    if built.returncode:
        sys.exit(built.stdout + built.stderr)
    wanted = {str(path.relative_to(ROOT)).replace("/", "_") + ".o" for path in sources("src", "app", "test")}
    found = []
    with subprocess.Popen(fpm + ["--list"], cwd=ROOT, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, start_new_session=True) as listing:
        for line in listing.stdout:
            path = ROOT / line.strip()
            if path.name in wanted:
                wanted.discard(path.name)
                found.append(path)
            if not wanted:
                os.killpg(listing.pid, signal.SIGKILL)
                break
    if wanted:
        sys.exit("not compiled: " + " ".join(sorted(wanted)))
    return found


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
