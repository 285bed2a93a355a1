#!/usr/bin/env python3
"""Check the blanks inside statements with fprettify, or set them right.

Usage: tools/check_format.py [--fix]

Indentation and continued lines are left as written, and so are the blanks in `only :` and `, .not.`.
"""

from __future__ import annotations

import argparse
import concurrent.futures
import difflib
import io
import logging
import re
import sys

import fprettify

from fortran_source import ROOT, sources


def formatted(text: str) -> str:
    """What fprettify makes of a source text."""
    logging.disable(logging.WARNING)  # on lines that it thinks too long to touch
    result = io.StringIO()
    fprettify.reformat_ffile(io.StringIO(text), result, impose_indent=False, whitespace=2, llength=200, orig_filename="text")
    better = re.sub(r"(\bonly)\s*:(?!:)", r"\1 :", result.getvalue())
    return re.sub(r",\s*\.not\.", ", .not.", better)


def main(arguments=None) -> int:
    """Command line; returns the exit code."""
    parser = argparse.ArgumentParser(description="check the blanks inside statements with fprettify")
    parser.add_argument("--fix", action="store_true", help="write the changes instead of listing them")
    fix = parser.parse_args(arguments).fix
    files = sources("src", "app", "test", "example")
    texts = [path.read_text(encoding="utf-8") for path in files]
    with concurrent.futures.ProcessPoolExecutor() as pool:
        results = list(pool.map(formatted, texts, chunksize=8))
    changed = 0
    for path, text, better in zip(files, texts, results):
        if better == text:
            continue
        changed += 1
        if fix:
            path.write_text(better, encoding="utf-8")
            continue
        name = str(path.relative_to(ROOT))
        diff = difflib.unified_diff(text.splitlines(), better.splitlines(), name, name, lineterm="", n=0)
        print("\n".join(diff), file=sys.stderr)
    print(f"format: {len(files)} files, {changed} {'changed' if fix else 'faults'}")
    return 1 if changed and not fix else 0


if __name__ == "__main__":
    sys.exit(main())
