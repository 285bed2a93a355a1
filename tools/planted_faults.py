#!/usr/bin/env python3
"""Plant faults into a copy of the sources, one at a time: the test that is named for each of them has to fail.

Usage: make faults [ONLY=pattern of the name]      a minute or two each; ends with one line of counts

The list is tools/planted_faults.toml. The copy is built with run-time checks, and stands in a temporary folder. First the tests that
are named run without a fault: they have to pass.
"""

from __future__ import annotations

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib

from fortran_source import ROOT

LIST = ROOT / "tools/planted_faults.toml"
# What fpm has built already, so that a fault costs only what depends on its file
BUILT = ("gfortran_*", "dependencies", "commit", "pkgconfig", "cache.toml")


def faults() -> list[dict]:
    """The list."""
    return tomllib.loads(LIST.read_text(encoding="utf-8"))["fault"]


def copy_tree(target: pathlib.Path) -> None:
    """Copy what git knows and what is built; the tools of .venv are shared."""
    names = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    for name in names.split("\0"):
        if name and (ROOT / name).is_file():
            (target / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, target / name)
    (target / "build").mkdir()
    for pattern in BUILT:
        for path in (ROOT / "build").glob(pattern):
            (shutil.copytree if path.is_dir() else shutil.copy2)(path, target / "build" / path.name)
    (target / ".venv").symlink_to(ROOT / ".venv")


def run(folder: pathlib.Path, command: list[str], **variables: str) -> tuple[int, str]:
    """Run a command in the copy; its exit code and what it prints."""
    done = subprocess.run(command, cwd=folder, env=os.environ | variables, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, errors="replace", check=False)
    return done.returncode, done.stdout


def passes(folder: pathlib.Path, fault: dict) -> bool:
    """Build the copy and run the test of a fault; a copy that does not compile is no verdict."""
    flags, fpm = os.environ["DEBUG_FLAGS"], str(folder / "tools/fpm")
    if "suite" in fault:
        code, text = run(folder, [fpm, "build", "--tests", "--flag", flags])
        test = [fpm, "test", "--flag", flags, "--", fault["suite"]]
        variables = {}
    else:
        code, text = run(folder, [fpm, "install", "--flag", flags, "--prefix", "build/debug"])
        test = [str(folder / ".venv/bin/python"), "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", *fault["pytest"].split()]
        variables = {"CAMROLLER": str(folder / "build/debug/bin/camroller")}
    if code:
        sys.exit(f"'{fault['name']}' does not compile:\n{text[-3000:]}")
    return run(folder, test, **variables)[0] == 0


def main(only: str) -> int:
    """Plant all faults whose name has the regular expression; the exit code."""
    chosen = [fault for fault in faults() if re.search(only, fault["name"])]
    seen = missed = 0
    with tempfile.TemporaryDirectory(prefix="camroller-faults-") as name:
        folder = pathlib.Path(name)
        copy_tree(folder)
        for test in {fault.get("suite", fault.get("pytest")): fault for fault in chosen}.values():
            if not passes(folder, test):
                sys.exit(f"without a fault: {test.get('suite', test.get('pytest'))} fails")
        for fault in chosen:
            path = folder / fault["file"]
            right = path.read_text(encoding="utf-8")
            path.write_text(right.replace(fault["old"], fault["new"]), encoding="utf-8")
            is_missed = passes(folder, fault)
            path.write_text(right, encoding="utf-8")
            seen, missed = seen + (not is_missed), missed + is_missed
            print(f"{'NOT SEEN' if is_missed else 'seen':8}   {fault['name']}: {fault.get('suite', fault.get('pytest'))}", flush=True)
    print(f"{seen} passed, {missed} failed")
    return 1 if missed or not seen else 0


if __name__ == "__main__":
    sys.exit(main(" ".join(sys.argv[1:])))
