#!/usr/bin/env python3
"""Sum up tables of error and time: cost of an error of 1e-4 at each operating point, ratios to CVODE and scipy; of trains, cost of
errors of 1e-3 and 1e-4.

Usage: summarise.py TABLE...      a text on the output
"""

from __future__ import annotations

import pathlib
import sys

from work_precision import THEIRS, Row, cheapest, mean_ratio, names, read

ERROR = 1e-4
# Goals for one cycle from the periodic start with the sliding speed at 720 angles [us]
GOALS = {"consistent": 1000.0, "source": 500.0}
# Tasks of flexible trains, errors for them
TRAINS, TRAIN_ERRORS = ("fixed_", "adjuster_"), (1e-3, 1e-4)
RANGES = {"1e-2 to 1e-5": [10.0**(-0.5 * k) for k in range(4, 11)], "1e-2 to 1e-8": [10.0**(-0.5 * k) for k in range(4, 17)]}
GROUPS = {"nine points, consistent": "consistent", "nine points, source": "source", "roller problem": "roller"}


def cost_table(rows: list[Row], error: float = ERROR, of: str = "sliding speed and mean loss") -> None:
    """Time and tolerance that each solver needs at each task."""
    solvers = names(rows, "solver")
    print(f"Time in us to reach an error of {error:g} in {of} (tolerance it takes)\n")
    print(f"{'':20s}" + "".join(f"{solver:>20s}" for solver in solvers))
    for task in names(rows, "task"):
        line = f"{task:20s}"
        for solver in solvers:
            best = cheapest([row for row in rows if (row.task, row.solver) == (task, solver)], error)
            line += f"{f'{best.time:.0f} ({best.tolerance:.0e})':>20s}" if best else f"{'-':>20s}"
        print(line)
    print()
    for prefix, goal in GOALS.items():
        for solver in solvers:
            times = [best.time for task in names(rows, "task") if task.startswith(prefix) and (best := cheapest(
                [row for row in rows if (row.task, row.solver) == (task, solver)], ERROR))]
            reached = sum(time <= goal for time in times)
            if reached:
                print(f"{prefix}: {solver} reaches the goal of {goal:.0f} us at {reached} of 9 points; slowest {max(times):.0f} us")
    print()


def ratio_table(rows: list[Row]) -> None:
    """Geometric means of the ratios of times."""
    solvers = names(rows, "solver")
    ours = [solver for solver in solvers if solver not in THEIRS]
    cvode = tuple(solver for solver in THEIRS if solver.startswith("cvode"))
    others = {"CVODE": cvode} | {solver: (solver,) for solver in THEIRS if solver in solvers and solver not in cvode}
    for label, errors in RANGES.items():
        print(f"Their time over ours, geometric mean over errors reached from {label} (cases both reach, where not all);")
        print("CVODE: the fastest of its variants in each case; best: the fastest of ours\n")
        print(f"{'':42s}" + "".join(f"{solver:>20s}" for solver in [*ours, "best"]))
        for group, prefix in (GROUPS | {"all": ""}).items():
            part = [row for row in rows if row.task.startswith(prefix)]
            for name, theirs in others.items():
                line = f"{group:28s}{name:14s}"
                for mine in [*((solver,) for solver in ours), tuple(ours)]:
                    ratio, counted, cases = mean_ratio(part, theirs, mine, errors)
                    line += f"{f'{ratio:.2f}' + (f' ({counted}/{cases})' if counted < cases else ''):>20s}"
                print(line)
        print()


def main() -> None:
    """Both tables."""
    rows = read(*map(pathlib.Path, sys.argv[1:]))
    if any(row.task.startswith(TRAINS) for row in rows):
        for error in TRAIN_ERRORS:
            cost_table(rows, error, "contact load, over the largest, and mean load")
        return
    cost_table(rows)
    ratio_table(rows)


if __name__ == "__main__":
    main()
