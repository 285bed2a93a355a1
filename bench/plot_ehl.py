#!/usr/bin/env python3
"""Draw how the cost of the numerical film grows with the number of nodes, and LAPACK's part of it.

Usage: bench/plot_ehl.py bench/tables/ehl_cost.txt FIGURE.png
"""

from __future__ import annotations

import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

WORDS = {
    "steady": "steady contact",
    "cycle_300_60": "coupled cycle, 300 rev/min, 60 degC",
    "cycle_300_25": "coupled cycle, 300 rev/min, 25 degC",
}


def read(path: str) -> dict[str, list[list[float]]]:
    """Rows of numbers by task."""
    rows: dict[str, list[list[float]]] = {}
    with open(path, encoding="utf-8") as file:
        for line in file:
            if not line.lstrip().startswith("#"):
                name, *numbers = line.split()
                rows.setdefault(name, []).append([float(number) for number in numbers])
    return rows


def read_setting(path: str) -> str:
    """Linear algebra library with its threads, and machine, from the head of a table."""
    with open(path, encoding="utf-8") as file:
        head = dict(line[1:].strip().split(":", 1) for line in file if line.startswith("#") and ":" in line)
    return ";".join(head[key] for key in ("LAPACK", "machine")).strip()


def draw(rows: dict[str, list[list[float]]], path: str, setting: str) -> None:
    """Time, and LAPACK's part, over nodes."""
    figure, (time, part) = plt.subplots(1, 2, figsize=(10, 4.2), layout="constrained")
    for name, lines in rows.items():
        nodes = [line[0] for line in lines]
        time.loglog(nodes, [line[1] for line in lines], "o-", label=WORDS.get(name, name))
        part.semilogx(nodes, [line[2] for line in lines], "o-")
        part.semilogx(nodes, [sum(line[2:5]) for line in lines], "--", color=part.lines[-1].get_color())
    first = rows["steady"][0]
    nodes = [line[0] for line in rows["steady"]]
    for power in (2, 3):
        time.loglog(nodes, [first[1] * 0.4 * (n / first[0]) ** power for n in nodes], ":", color="grey")
        time.text(nodes[-1], first[1] * 0.4 * (nodes[-1] / first[0]) ** power, f" n^{power}", color="grey", fontsize=9)
    time.set(xlabel="nodes", ylabel="processor time [ms]", ylim=(0.05, 1e6))
    time.legend(fontsize=8, loc="upper left")
    part.set(xlabel="nodes", ylabel="part [%]: dgetrf; dashed: + dgetrs, dgemv", ylim=(0, 100))
    for axis in (time, part):
        axis.set_xticks(nodes, [f"{n:.0f}" for n in nodes])
        axis.minorticks_off()
    figure.suptitle(setting, fontsize="medium")
    figure.savefig(path, dpi=90)


def main(arguments=None) -> int:
    """Command line; returns the exit code."""
    words = sys.argv[1:] if arguments is None else arguments
    if len(words) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    draw(read(words[0]), words[1], read_setting(words[0]))
    return 0


if __name__ == "__main__":
    sys.exit(main())
