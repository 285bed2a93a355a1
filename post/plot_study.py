"""Draw what `camroller study` has measured.

    python post/plot_study.py results/thesis_study.h5            a figure beside the file
    python post/plot_study.py FILE --output doc/figures --name thesis

`<name>_work_precision.png`: error against time and, where they are counted, against evaluations; one curve for each way to compute
the cases, geometric means over the cases; how many cases have no result, and how many settings are not shown since a case has none at
them. Needs no display. Exit code 2 where the file is no study.
"""

import argparse
from pathlib import Path
import sys
import textwrap

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams.update({"font.size": 9.0, "axes.spines.top": False, "axes.spines.right": False})

from matplotlib.figure import Figure  # noqa: E402
from matplotlib.ticker import LogLocator, NullFormatter  # noqa: E402
import numpy as np  # noqa: E402

from command import script, save_figure  # noqa: E402
from read import ResultError, opened, text_columns  # noqa: E402

COLOURS = ["#111111", "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#6a51a3"]
CHARACTERS = 11.0  # of the title in an inch
MARKERS = "os^vD<h>"
ERRORS = {"error_sliding_speed": "error of the sliding speed [-]", "error_mean_friction": "error of the mean friction torque [-]"}


def read_study(path):
    """The table of a study as a dictionary of columns."""
    with opened(path, "a study") as file:
        return text_columns(file["study/study"])


def curves(table, error):
    """For each way: geometric means over all cases of error, time and evaluations, for the settings at which no case failed."""
    found = {}
    for way, rows in settings(table):
        if (table["status"][rows] == 0).all():
            found.setdefault(way, []).append(tuple(_mean(table[name][rows]) for name in (error, "time", "evaluations")))
    return {way: np.array(points) for way, points in found.items()}


def settings(table):
    """Each setting: its way, and its rows, one for each case."""
    ways = [way for way in dict.fromkeys(zip(table["way"], table["dial"])) if way[1] != "reference"]
    for way, dial in ways:
        of_way = (table["way"] == way) & (table["dial"] == dial)
        for value in _different(table["setting"][of_way]):
            yield way, of_way & ((table["setting"] == value) | (np.isnan(table["setting"]) & np.isnan(value)))


def left_out(table):
    """How many cases have no result at all, and how many settings are not shown since a case has none at them: parts of a sentence."""
    cases, there = np.unique(table["case"]), np.unique(table["case"][table["status"] == 0])
    lost = cases.size - there.size
    words = [f"{lost} of {cases.size} cases {'has' if lost == 1 else 'have'} no result"] if lost else []
    all_ways = [way for way, _ in settings(table)]
    gone = [way for way, rows in settings(table) if (table["status"][rows] != 0).any()]
    if gone:
        words.append(f"{len(gone)} of {len(all_ways)} settings not shown, at which a case has no result ({', '.join(dict.fromkeys(gone))})")
    return words


def _different(values):
    """The numbers in their order, each once; at most one that is no number."""
    numbers = list(dict.fromkeys(values[~np.isnan(values)]))
    return numbers + ([np.nan] if np.isnan(values).any() else [])


def _mean(values):
    return float(np.exp(np.mean(np.log(values))))


def work_precision(table):
    """Error of the sliding speed and of the mean friction against time; of the sliding speed against evaluations as well."""
    panels = [("error_sliding_speed", 1, "processor time of a run [ms]", 1e3),
              ("error_mean_friction", 1, "processor time of a run [ms]", 1e3)]
    if not np.isnan(table["evaluations"][table["status"] == 0]).any():
        panels.append(("error_sliding_speed", 2, "evaluations of the equations of motion", 1.0))
    figure = Figure(figsize=(1.6 + 4.2 * len(panels), 4.6), layout="constrained")
    grid = figure.subplots(1, len(panels))
    for axes, (error, column, words, factor) in zip(grid, panels):
        for number, (way, points) in enumerate(curves(table, error).items()):
            axes.plot(factor * points[:, column], points[:, 0], color=COLOURS[number % len(COLOURS)], label=way, linewidth=1.2,
                      marker=MARKERS[number % len(MARKERS)], markersize=4)
        axes.set(xscale="log", yscale="log", xlabel=words, ylabel=ERRORS[error])
        _label_few_decades(axes)
        axes.grid(True, which="major", linewidth=0.3)
    grid[-1].legend(frameon=False, loc="upper left", bbox_to_anchor=(1.0, 1.0))
    cases = len(np.unique(table["case"][table["status"] == 0]))
    words = ["one case" if cases == 1 else f"geometric means over {cases} cases", *left_out(table)]
    figure.suptitle(textwrap.fill(", ".join(words), int(CHARACTERS * figure.get_figwidth())), fontsize="medium")
    return figure


def _label_few_decades(axes):
    """Plain numbers at 1, 2 and 5 along the lower axis, where powers of ten would be one or two."""
    low, high = axes.get_xlim()
    if high < 100.0 * low:
        axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        axes.xaxis.set_major_formatter("{x:g}")
        axes.xaxis.set_minor_formatter(NullFormatter())


def drawn(table, path):
    """The figure of a study; ResultError where columns are missing, have no numbers or lengths of their own."""
    try:
        return work_precision(table)
    except (KeyError, ValueError, IndexError, TypeError) as error:
        raise ResultError(f"{path}: not a study that can be drawn: {error}") from None


@script
def main(arguments=None):
    """Command line; returns the exit code."""
    made = argparse.ArgumentParser(prog="plot_study.py", description=__doc__,
                                   formatter_class=argparse.RawDescriptionHelpFormatter)
    made.add_argument("file", metavar="FILE", help="file of a study")
    made.add_argument("--output", metavar="DIR", help="folder for the figure (default: that of the file)")
    made.add_argument("--name", help="beginning of its name (default: that of the file)")
    options = made.parse_args(arguments)
    path = Path(options.file)
    folder = Path(options.output) if options.output else path.parent
    target = folder / f"{options.name or path.stem}_work_precision.png"
    save_figure(drawn(read_study(path), path), target, dpi=110)
    print(f"work_precision: {target}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
