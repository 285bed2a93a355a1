#!/usr/bin/env python3
"""Check that `use` lines only point downwards and never run in a circle.

Usage: tools/check_layers.py [--root DIR] [--show]

The folder below src is the layer of a file; files directly in src stand on top with app. Inside physics a file may use
files on lower floors only. A file that is not in the table of floors below fails the check: place it there when you add it.
"""

from __future__ import annotations

import argparse
import pathlib
import re
import sys

from fortran_source import ROOT, sources, statements

# What each layer may use.
MAY_USE = {
    "base": {"base"},
    "numerics": {"base", "numerics"},
    "physics": {"base", "numerics", "physics"},
    "ehl": {"base", "numerics", "physics", "ehl"},
    "solver": {"base", "numerics", "physics", "ehl", "solver"},
    "io": {"base", "physics", "ehl", "solver", "io"},
    "app": {"base", "numerics", "physics", "ehl", "solver", "io", "app"},
}

# The floors of physics, lowest first: what does not depend on the valve train, then along the chain from the cam's shape
# to the roller, last what adds up.
PHYSICS_FLOORS = [
    {"contact_rule", "materials"},
    {"lubricant"},
    {"lift_table", "greenwood_tripp", "zhao_maietta_chang"},
    {"lift"},
    {"kinematics"},
    {"dynamics"},
    {"hertz", "gas", "film_table"},
    {"film", "asperity"},
    {"load_share"},
    {"traction"},
    {"roller"},
    {"torque", "camshaft"},
]
# Beside the chain: these use nothing of the chain but the bottom, only the top may use them.
PHYSICS_BESIDE = {"needle", "journal", "guide", "pivot"}

USE = re.compile(r"^use\s*(?:,\s*(?:non_)?intrinsic\s*)?(?:::)?\s*(\w+)")
MODULE = re.compile(r"^module\s+(?!procedure\b|subroutine\b|function\b)(\w+)$")


def layer_of(path: pathlib.Path, root: pathlib.Path) -> str:
    """Name of the layer that a file is on."""
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


def floor_of(name: str) -> float | None:
    """Floor of a physics file; None where the file is not in the table."""
    if name in PHYSICS_BESIDE:
        return 1.5
    for floor, names in enumerate(PHYSICS_FLOORS):
        if name in names:
            return float(floor)
    return None


def physics_fault(user: str, used: str) -> str:
    """What is wrong with physics file `user` using physics file `used`; empty where nothing is."""
    user_floor, used_floor = floor_of(user), floor_of(used)
    if user_floor is None or used_floor is None:
        return ""  # reported once per file
    if used in PHYSICS_BESIDE and user not in PHYSICS_FLOORS[-1]:
        return "stands beside the chain; only torque may use it"
    if used_floor >= user_floor:
        return "is not on a lower floor of physics"
    return ""


def find_faults(tree, root: pathlib.Path) -> list[str]:
    """All arrows that point up or sideways, one line each."""
    faults = []
    for path, uses in tree.items():
        layer, short = layer_of(path, root), path.relative_to(root)
        if layer not in MAY_USE:
            faults.append(f"{short}: '{layer}' is no layer; layers are {', '.join(MAY_USE)}")
            continue
        if layer == "physics" and floor_of(path.stem) is None:
            faults.append(f"{short}: has no floor in physics; add it to tools/check_layers.py")
        for line, module, target in uses:
            other = layer_of(target, root)
            if other not in MAY_USE[layer]:
                faults.append(f"{short}:{line}: {layer} may not use {module} of {other}")
            elif layer == other == "physics" and (why := physics_fault(path.stem, target.stem)):
                faults.append(f"{short}:{line}: {module} {why}")
    return faults


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
    parser = argparse.ArgumentParser(description="check that use lines only point down the layers")
    parser.add_argument("--root", type=pathlib.Path, default=ROOT, help="top folder of the project")
    parser.add_argument("--show", action="store_true", help="list what each file uses")
    options = parser.parse_args(arguments)
    root = options.root.resolve()
    tree = read_tree(root)
    if options.show:
        for path in tree:
            print(path.relative_to(root), "->", ", ".join(sorted({t.stem for _, _, t in tree[path]})) or "nothing")
    faults = find_faults(tree, root)
    if circle := find_circle(tree):
        faults.append("circle: " + " -> ".join(str(path.relative_to(root)) for path in circle))
    for fault in faults:
        print(fault, file=sys.stderr)
    print(f"layers: {len(tree)} files, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
