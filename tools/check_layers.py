#!/usr/bin/env python3
"""Check that `use` lines point down the folders only and never run in a circle, and that folders use all that they may.

Usage: tools/check_layers.py [--root DIR] [--show]

What each folder may use stands in the table of folders of CONTRIBUTING.md, and nowhere else: a folder may use itself and what
its row names. Files directly in src stand on top with app.
"""

from __future__ import annotations

import argparse
import pathlib
import re
import sys

from fortran_source import ROOT, sources, statements

USE = re.compile(r"^use\b\s*(?:,\s*(?:non_)?intrinsic\s*)?(?:::)?\s*(\w+)")
MODULE = re.compile(r"^module\s+(?!procedure\b|subroutine\b|function\b)(\w+)$")
TABLE = re.compile(r"<!-- folders -->\n(.*?)<!-- end of folders -->", re.DOTALL)
ROW = re.compile(r"^\| `(?:src/)?(\w+)` \|[^|]*\|([^|]*)\|$", re.MULTILINE)


def read_table(root: pathlib.Path) -> dict[str, set[str]]:
    """What each folder may use, in the order of the table."""
    table = TABLE.search((root / "CONTRIBUTING.md").read_text(encoding="utf-8"))
    rows = ROW.findall(table[1] if table else "")
    folders = [name for name, _ in rows]
    named = {name: {word.strip() for word in uses.split(",")} - {"nothing"} for name, uses in rows}
    return {name: {name} | (set(folders) if "all" in uses else uses) for name, uses in named.items()}


def table_faults(table: dict[str, set[str]]) -> list[str]:
    """Rows that name what is no folder, or a folder that does not stand below them."""
    names = list(table)
    return [f"CONTRIBUTING.md: folder '{name}' may not use '{used}', which is not further down in the table of folders"
            for at, name in enumerate(names) for used in sorted(table[name] - set(names[at:]))]


def folder_of(path: pathlib.Path, root: pathlib.Path) -> str:
    """Folder that a file belongs to."""
    parts = path.relative_to(root).parts
    return parts[1] if parts[0] == "src" and len(parts) > 2 else "app"


def read_tree(root: pathlib.Path) -> dict[pathlib.Path, list[tuple[int, str, pathlib.Path]]]:
    """For each file the modules of ours that it uses: line, module, file of that module."""
    texts = {path: statements(path.read_text(encoding="utf-8")) for path in sources("src", "app", root=root)}
    home = {}
    for path, lines in texts.items():
        for statement in lines:
            if match := MODULE.match(statement.text):
                home[match[1]] = path
    tree = {}
    for path, lines in texts.items():
        tree[path] = []
        for statement in lines:
            match = USE.match(statement.text)
            if match and match[1] in home and home[match[1]] != path:
                tree[path].append((statement.line, match[1], home[match[1]]))
    return tree


def find_faults(tree, table: dict[str, set[str]], root: pathlib.Path) -> list[str]:
    """All arrows that point up, one line each."""
    faults = []
    for path, uses in tree.items():
        folder, short = folder_of(path, root), path.relative_to(root)
        if folder not in table:
            faults.append(f"{short}: folder '{folder}' is not in the table of folders of CONTRIBUTING.md")
            continue
        faults += [f"{short}:{line}: {folder} may not use {module} of {folder_of(target, root)}"
                   for line, module, target in uses if folder_of(target, root) not in table[folder]]
    return faults


def unused_rights(tree, table: dict[str, set[str]], root: pathlib.Path) -> list[str]:
    """What rows of the table allow and no file of their folder does; the row that allows all is not meant."""
    used = {(folder_of(path, root), folder_of(target, root)) for path, uses in tree.items() for _, _, target in uses}
    return [f"CONTRIBUTING.md: folder '{name}' may use '{other}', which none of its files does"
            for name, uses in table.items() if uses < set(table) for other in sorted(uses - {name}) if (name, other) not in used]


def find_circle(tree) -> list[pathlib.Path]:
    """One circle of files that use each other; empty where there is none."""
    done: set[pathlib.Path] = set()

    def walk(path, trail):
        if path in trail:
            return trail[trail.index(path):] + [path]
        if path in done:
            return []
        for _, _, target in tree[path]:
            if circle := walk(target, trail + [path]):
                return circle
        done.add(path)
        return []

    for path in tree:
        if circle := walk(path, []):
            return circle
    return []


def main(arguments=None) -> int:
    """Command line; returns the exit code."""
    parser = argparse.ArgumentParser(description="check that use lines only point down the folders, and that folders use all that they may")
    parser.add_argument("--root", type=pathlib.Path, default=ROOT, help="top folder of the project")
    parser.add_argument("--show", action="store_true", help="list what each file uses")
    options = parser.parse_args(arguments)
    root = options.root.resolve()
    tree, table = read_tree(root), read_table(root)
    if options.show:
        for path in tree:
            print(path.relative_to(root), "->", ", ".join(sorted({t.stem for _, _, t in tree[path]})) or "nothing")
    faults = table_faults(table) + find_faults(tree, table, root) + unused_rights(tree, table, root)
    if circle := find_circle(tree):
        faults.append("circle: " + " -> ".join(str(path.relative_to(root)) for path in circle))
    for fault in faults:
        print(fault, file=sys.stderr)
    print(f"layers: {len(tree)} files in {len(table)} folders, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
