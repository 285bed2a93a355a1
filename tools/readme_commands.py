#!/usr/bin/env python3
"""List or run the commands that README.md shows.

Usage: tools/readme_commands.py [--run] [--skip COMMAND]... [FILE]

Commands stand in blocks fenced by ```sh: one a line, continued by a backslash, `#` starts a remark. Each runs in a shell of its
own in the top folder, without input. Ends with the line `N passed, N failed`.
"""

from __future__ import annotations

import argparse
import pathlib
import re
import subprocess
import sys

from fortran_source import ROOT

BLOCK = re.compile(r"^```sh[ \t]*\n(.*?)^```[ \t]*$", re.MULTILINE | re.DOTALL)


def commands_of(text: str) -> list[str]:
    """The commands of a text in Markdown, in order."""
    found = []
    for block in BLOCK.findall(text):
        for line in block.replace("\\\n", " ").splitlines():
            command = re.sub(r"(^|\s)#.*$", "", line)
            command = re.sub(r"\s+", " ", command).strip()
            if command:
                found.append(command)
    return found


def main(arguments=None) -> int:
    """Command line; returns the exit code."""
    parser = argparse.ArgumentParser(description="list or run the commands that README.md shows")
    parser.add_argument("--run", action="store_true", help="run them instead of listing them")
    parser.add_argument("--skip", action="append", default=[], help="a command not to run")
    parser.add_argument("file", nargs="?", type=pathlib.Path, default=ROOT / "README.md")
    options = parser.parse_args(arguments)
    commands = [c for c in commands_of(options.file.read_text(encoding="utf-8")) if c not in options.skip]
    if not options.run:
        print("\n".join(commands))
        return 0
    failed = 0
    for command in commands:
        print(f"$ {command}", flush=True)
        code = subprocess.run(["bash", "-c", command], cwd=ROOT, stdin=subprocess.DEVNULL, check=False).returncode
        if code:
            print(f"exit code {code}: {command}", file=sys.stderr)
            failed += 1
    print(f"{len(commands) - failed} passed, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
