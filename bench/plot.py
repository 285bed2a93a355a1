#!/usr/bin/env python3
"""Plot error against time, one curve a solver, one panel a task.

Usage: plot.py FOLDER TABLE...      FOLDER/work_precision_<group>.png
"""

from __future__ import annotations

import pathlib
import sys

import matplotlib

matplotlib.use("Agg")

# pylint: disable-next=wrong-import-position
import matplotlib.pyplot as plt  # noqa: E402

from work_precision import THEIRS, Row, front, names, read  # noqa: E402

# Of CVODE's variants the plots show the fastest front of all
GOALS = {"consistent": 1.0, "source": 0.5}
STYLES = {
    "cvode": ("CVODE", "black", "-", "s"), "LSODA": ("scipy LSODA", "0.35", "--", "^"), "BDF": ("scipy BDF", "0.5", ":", "v"),
    "Radau": ("scipy Radau", "0.5", "-.", "D"),
}
EXPLICIT = ("dormand_prince",)


def curves(rows: list[Row]) -> dict[str, list[Row]]:
    """Rows by the name of the curve: CVODE's variants as one."""
    by_name: dict[str, list[Row]] = {}
    for row in rows:
        by_name.setdefault("cvode" if row.solver.startswith("cvode") else row.solver, []).append(row)
    return by_name


def style(solver: str, ours: list[str]) -> tuple[str, object, str, str]:
    """Label, colour, line and marker."""
    if solver in STYLES:
        return STYLES[solver]
    if solver in EXPLICIT:
        return solver.replace("_", "-"), "tab:olive" if solver == EXPLICIT[0] else "tab:cyan", "-", "."
    return solver, plt.get_cmap("tab10")(ours.index(solver)), "-", "o"


def draw(rows: list[Row], prefix: str, columns: int, path: pathlib.Path) -> None:
    """One figure."""
    tasks = [task for task in names(rows, "task") if task.startswith(prefix)]
    ours = [solver for solver in names(rows, "solver") if solver not in THEIRS and solver not in EXPLICIT]
    lines = -(-len(tasks) // columns)
    figure, panels = plt.subplots(lines, columns, figsize=(4.2 * columns, 3.4 * lines + 0.9), sharex=True, sharey=True,
                                  squeeze=False, layout="constrained")
    for panel, task in zip(panels.flat, tasks):
        for solver, part in curves([row for row in rows if row.task == task]).items():
            label, colour, line, marker = style(solver, ours)
            points = front(part)
            panel.loglog([row.error for row in points], [1e-3 * row.time for row in points], line, color=colour, marker=marker,
                         markersize=3, linewidth=1.1, label=label)
        if prefix in GOALS:
            panel.plot([1e-4], [GOALS[prefix]], "*", color="red", markersize=11, label="goal", zorder=5)
        panel.set_title(title(task), fontsize=10)
        panel.grid(True, which="major", linewidth=0.4, alpha=0.6)
    panels[0, 0].set_xlim(1.0, 1e-9)
    for panel in panels[-1, :]:
        panel.set_xlabel("error of sliding speed or mean loss, relative")
    for panel in panels[:, 0]:
        panel.set_ylabel("time of a cycle [ms]")
    handles, labels = panels[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=8, fontsize=9, frameon=False)
    figure.savefig(path, dpi=85)
    plt.close(figure)


def title(task: str) -> str:
    """Words for a task."""
    kind, *point = task.split("_")
    if kind == "roller":
        return f"roller problem {point[0]}"
    return f"{point[0]} rev/min, {point[1]} °C, {kind}"


def main() -> None:
    """All figures."""
    folder, *tables = sys.argv[1:]
    rows = read(*map(pathlib.Path, tables))
    for prefix in ("consistent", "source", "roller"):
        draw(rows, prefix, 3, pathlib.Path(folder) / f"work_precision_{prefix}.png")


if __name__ == "__main__":
    main()
