#!/usr/bin/env python3
"""Draw the error of each film formula: ratio of formula to numerical film as a function of speed and load.

Usage: post/ehl_map.py bench/tables/ehl_map.txt FIGURE.png
"""

from __future__ import annotations

import sys
import warnings

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy

from command import one_line, script, save_figure
from read import ResultError

LAWS = ["Dowson-Higginson", "Pan-Hamrock", "Masjedi-Khonsari", "Moes"]
COLUMNS = 4 + 2 * len(LAWS)
LEVELS = [-0.5, -0.2, -0.1, -0.05, 0.05, 0.1, 0.2, 0.5]


def read(path: str) -> numpy.ndarray:
    """The table; ResultError where it is none."""
    try:
        with warnings.catch_warnings(action="ignore"):  # of an empty file
            table = numpy.loadtxt(path, ndmin=2)
    except (OSError, ValueError) as error:
        raise ResultError(f"{path}: no table of film formulas: {one_line(error)}") from None
    if table.shape[1] != COLUMNS or table.shape[0] < 3 or not (table[:, :2] > 0).all():
        raise ResultError(f"{path}: no table of film formulas: {COLUMNS} columns and 3 rows or more are needed, U and W above 0")
    return table


def draw(table: numpy.ndarray):
    """One panel for each law and film."""
    figure, axes = plt.subplots(2, 4, figsize=(13, 6.4), sharex=True, sharey=True, layout="constrained")
    for row, film in enumerate(["smallest film", "central film"]):
        for column, law in enumerate(LAWS):
            off = table[:, 4 + 2 * column + row] - 1
            axis = axes[row, column]
            levels = [-1.0, *LEVELS, 1.0]
            image = axis.tricontourf(numpy.log10(table[:, 0]), numpy.log10(table[:, 1]), off, levels=levels, extend="both",
                                     cmap="RdBu_r", norm=matplotlib.colors.BoundaryNorm(levels, 256, extend="both"))
            axis.set_title(f"{law}, {film}", fontsize=10)
            if row:
                axis.set_xlabel("log10 U")
            if not column:
                axis.set_ylabel("log10 W*")
    figure.colorbar(image, ax=axes, label="formula over numerical film, less one", ticks=levels)
    return figure


@script
def main(arguments=None) -> int:
    """Command line; returns the exit code."""
    words = sys.argv[1:] if arguments is None else arguments
    if len(words) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    save_figure(draw(read(words[0])), words[1], dpi=90)
    return 0


if __name__ == "__main__":
    sys.exit(main())
