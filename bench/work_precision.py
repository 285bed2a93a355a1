"""Read tables of error and time; what a solver needs to reach an error."""

from __future__ import annotations

import dataclasses
import math
import pathlib

THEIRS = ("cvode", "cvode_slope", "cvode_restart", "cvode_slope_restart", "LSODA", "BDF", "Radau")


@dataclasses.dataclass(frozen=True)
class Row:
    """One solver at one tolerance on one task; errors without unit, time in microseconds."""

    task: str
    solver: str
    tolerance: float
    slip_error: float
    loss_error: float
    evaluations: int
    jacobians: int
    steps: int
    rejected: int
    time: float

    @property
    def error(self) -> float:
        """The larger of the errors of sliding speed and mean loss."""
        return max(self.slip_error, self.loss_error)


def read(*paths: pathlib.Path) -> list[Row]:
    """Rows of tables."""
    rows = []
    for path in paths:
        for line in path.read_text(encoding="utf-8").splitlines():
            if line.strip() and not line.startswith("#"):
                task, solver, tolerance, slip, loss, evaluations, jacobians, steps, rejected, time, _ = line.split()
                rows.append(Row(task, solver, float(tolerance), float(slip), float(loss), int(evaluations), int(jacobians),
                                int(steps), int(rejected), float(time)))
    return rows


def names(rows: list[Row], attribute: str) -> list[str]:
    """Tasks or solvers in the order of the table."""
    return list(dict.fromkeys(getattr(row, attribute) for row in rows))


def cheapest(rows: list[Row], error: float) -> Row | None:
    """The fastest row that reaches an error."""
    return min((row for row in rows if row.error <= error), key=lambda row: row.time, default=None)


def front(rows: list[Row]) -> list[Row]:
    """Rows that no faster one beats in error, fastest first."""
    kept: list[Row] = []
    for row in sorted(rows, key=lambda row: row.time):
        if not kept or row.error < kept[-1].error:
            kept.append(row)
    return kept


def mean_ratio(rows: list[Row], slower: tuple[str, ...], faster: tuple[str, ...], errors: list[float]) -> tuple[float, int, int]:
    """Geometric mean over tasks and errors of the times of two groups of solvers, each at its best; cases counted, cases there are.

    A case counts where both groups reach the error.
    """
    logarithms, cases = [], 0
    for task in names(rows, "task"):
        mine = [row for row in rows if row.task == task and row.solver in faster]
        other = [row for row in rows if row.task == task and row.solver in slower]
        for error in errors:
            cases += 1
            left, right = cheapest(other, error), cheapest(mine, error)
            if left and right:
                logarithms.append(math.log(left.time / right.time))
    if not logarithms:
        return math.nan, 0, cases
    return math.exp(sum(logarithms) / len(logarithms)), len(logarithms), cases
