"""Draw what `camroller study` has measured.

    python post/plot_study.py results/thesis_study.h5            three figures beside the file
    python post/plot_study.py FILE --output doc/figures --name thesis

A study with `--film` has one figure, `<name>_work_precision.png`: steady film over nodes and time, cycles over time.

`<name>_work_precision.png`: error of the sliding speed against time, one curve a method, geometric means over the cases;
`<name>_cheapest.png`: time of each method for a given error; `<name>_stability.png`: the fixed step of the source over fastest
decay rate and step, with the theoretical limit. Needs no display. Exit code 2 where the file is no study.
"""

import argparse
from pathlib import Path
import sys

import matplotlib
import matplotlib.lines

matplotlib.use("Agg")
matplotlib.rcParams.update({"font.size": 9.0, "axes.spines.top": False, "axes.spines.right": False})

from matplotlib.figure import Figure  # noqa: E402
import numpy as np  # noqa: E402

from command import run, save_figure  # noqa: E402
from read import ResultError, opened, text_columns  # noqa: E402

LIMIT = 2.0  # of explicit Euler: decay rate times step
CHATTER = 1.05  # total variation of the slip ratio over that of the reference, above which a cycle chatters
LEVELS = 10.0 ** np.arange(-1.0, -7.5, -0.5)
COLOURS = ["#08306b", "#2171b5", "#6baed6", "#d55e00", "#a63603", "#74c476", "#e7298a", "#238b45", "#6a51a3", "#9e9ac8",
           "#525252", "#111111"]
MARKERS = "os^vD<h>PX*p"


def read_study(path):
    """Tables of a study as dictionaries of columns."""
    with opened(path, "a study") as file:
        return {name: text_columns(file["study"][name]) for name in ("references", "methods", "models", "accuracy")}


def curves(methods):
    """For each method: its rungs in order, as geometric means over all cases of error, time, evaluations, where all are fine."""
    found = {}
    for method in dict.fromkeys(methods["method"]):
        rung = np.where(np.isnan(methods["tolerance"]), methods["step"], methods["tolerance"])
        points = []
        for value in dict.fromkeys(rung[methods["method"] == method]):
            rows = (methods["method"] == method) & (rung == value)
            if (methods["status"][rows] == 0).all():
                points.append(tuple(_mean(methods[name][rows]) for name in ("error_sliding_speed", "time", "evaluations")))
        if points:
            found[method] = np.array(points)
    return found


def _mean(values):
    return float(np.exp(np.mean(np.log(values))))


def time_for(points, error):
    """Shortest time at which a method's mean error is at or below a level; not a number where it is never."""
    times = points[points[:, 0] <= error, 1]
    return times.min() if times.size else np.nan


def work_precision(study):
    """Error against time, and against evaluations, which no other load of the machine touches."""
    figure = Figure(figsize=(11.0, 4.8), layout="constrained")
    panels = figure.subplots(1, 2, sharey=True)
    for number, (method, points) in enumerate(curves(study["methods"]).items()):
        for axes, costs in zip(panels, (1e3 * points[:, 1], points[:, 2])):
            axes.plot(costs, points[:, 0], color=COLOURS[number % len(COLOURS)], label=method, linewidth=1.2,
                      marker=MARKERS[number % len(MARKERS)], markersize=4)
    for axes, words in zip(panels, ("time for a periodic cycle [ms]", "evaluations of the roller equation")):
        axes.set(xscale="log", yscale="log", xlabel=words, ylim=(5e-9, 30.0))
        axes.grid(True, which="major", linewidth=0.3)
    panels[0].set_ylabel("error of the sliding speed, max over max [-]")
    panels[1].legend(frameon=False, loc="upper left", bbox_to_anchor=(1.0, 1.0))
    cases = (study["references"]["status"] == 0).sum()
    figure.suptitle(f"geometric means over {cases} cases", fontsize="medium")
    return figure


def cheapest(study):
    """Time of each method for a given error; the cheapest is drawn over in black."""
    figure = Figure(figsize=(7.5, 4.5), layout="constrained")
    axes = figure.subplots()
    found = curves(study["methods"])
    times = np.array([[time_for(points, level) for level in LEVELS] for points in found.values()])
    for number, (method, row) in enumerate(zip(found, times)):
        axes.plot(LEVELS, 1e3 * row, color=COLOURS[number % len(COLOURS)], label=method, linewidth=1.2,
                  marker=MARKERS[number % len(MARKERS)], markersize=4)
    best = np.nanmin(np.where(np.isnan(times), np.inf, times), axis=0)
    axes.plot(LEVELS, 1e3 * np.where(np.isinf(best), np.nan, best), color="black", linewidth=4, alpha=0.25, label="cheapest")
    axes.set(xscale="log", yscale="log", xlabel="error of the sliding speed allowed [-]", ylabel="time for a periodic cycle [ms]")
    axes.invert_xaxis()
    axes.grid(True, which="major", linewidth=0.3)
    axes.legend(frameon=False, loc="upper left", bbox_to_anchor=(1.0, 1.0))
    return figure


def is_stable(methods):
    """Rows whose cycle became periodic and does not chatter."""
    variation = np.where(np.isnan(methods["variation"]), np.inf, methods["variation"])
    return (methods["status"] == 0) & (variation <= CHATTER)


def stability(study):
    """Where the fixed step of the source is stable, a panel for each oil temperature."""
    methods, references = study["methods"], study["references"]
    fixed = np.array(methods["method"]) == "euler"
    stable = is_stable(methods)
    oils = np.unique(references["oil_temperature"])
    figure = Figure(figsize=(2.0 + 2.8 * len(oils), 4.0), layout="constrained")
    grid = np.atleast_1d(figure.subplots(1, len(oils), sharey=True))
    for axes, oil in zip(grid, oils):
        cases = np.flatnonzero((references["oil_temperature"] == oil) & (references["status"] == 0))
        cases = cases[np.argsort(references["speed"][cases])]
        rpm = references["speed"][cases] * 30.0 / np.pi
        for case, speed in zip(cases, rpm):
            rows = fixed & (methods["case"] == references["case"][case])
            for good, colour, marker in ((True, "#2171b5", "o"), (False, "#d55e00", "x")):
                chosen = rows & (stable == good)
                axes.plot(np.full(chosen.sum(), speed), methods["step"][chosen], color=colour, marker=marker, linestyle="none",
                          markersize=5)
        axes.plot(rpm, np.degrees(LIMIT / references["fastest_decay"][cases]), color="black", linewidth=1.0)
        axes.set(yscale="log", xlabel="camshaft speed [rev/min]", title=f"oil at {oil - 273.15:.0f} \N{DEGREE SIGN}C")
        axes.margins(x=0.15)
    grid[0].set_ylabel("fixed step [\N{DEGREE SIGN}]")
    handles = [matplotlib.lines.Line2D([], [], color="#2171b5", marker="o", linestyle="none", label="periodic, no chatter"),
               matplotlib.lines.Line2D([], [], color="#d55e00", marker="x", linestyle="none", label="chatters or never closes"),
               matplotlib.lines.Line2D([], [], color="black", label="fastest decay rate times step = 2")]
    figure.legend(handles=handles, loc="outside upper center", ncols=3, frameon=False)
    return figure


FILM_TABLES = ("contacts", "film_table", "film_cycle")


def read_films(path):
    """Tables of a study of films; none where the file has another study."""
    with opened(path, "a study") as file:
        if "film_cycle" not in file["study"]:
            return None
        return {name: text_columns(file["study"][name]) for name in FILM_TABLES}


def film_points(table, rows, error, cost):
    """Largest error and geometric mean of the cost over the cases, or nothing where none is fine."""
    rows = rows & ~np.isnan(table[error]) & ~np.isnan(table[cost])
    return (_mean(table[cost][rows]), table[error][rows].max()) if rows.any() else None


def film_work_precision(study):
    """Steady film against nodes and time; tables of films and solved cycles against time, beside the film law."""
    figure = Figure(figsize=(14.0, 4.8), layout="constrained")
    panels = figure.subplots(1, 3)
    contacts, tables, cycles = (study[name] for name in FILM_TABLES)
    for number, name in enumerate(word for word in dict.fromkeys(contacts["contact"]) if word):
        rows = contacts["contact"] == name
        for cost, style, words in (("cold_time", "-", "from nothing"), ("warm_time", "--", "from nearby")):
            points = [film_points(contacts, rows & (contacts["nodes"] == nodes), "error_film_min", cost)
                      for nodes in np.unique(contacts["nodes"][rows])]
            points = np.array([point for point in points if point])
            if points.size:
                panels[0].plot(1e3 * points[:, 0], points[:, 1], "C" + str(number) + style, marker="o", markersize=4,
                               label=f"{name}, {words}")
    panels[0].set(xlabel="time [ms]", ylabel="error of the smallest film [-]", title="steady film, 33 to 513 nodes")
    for axes, error, words in ((panels[1], "error_film_min", "largest error of the smallest film [-]"),
                               (panels[2], "error_slip", "error of the mean sliding speed [-]")):
        solved = cycles["model"] == "solved"
        for number, nodes in enumerate(np.unique(cycles["nodes"][solved & ~np.isnan(cycles["nodes"])])):
            rows = solved & (cycles["nodes"] == nodes)
            points = [film_points(cycles, rows & (cycles["step_error"] == step), error, "time")
                      for step in np.unique(cycles["step_error"][rows])]
            points = np.array([point for point in points if point])
            if points.size:
                axes.plot(1e3 * points[:, 0], points[:, 1], f"C{number}o-", markersize=4,
                          label=f"solved, {nodes:.0f} nodes" + (", as the reference" if nodes > 256 else ""))
        for name, marker in zip((word for word in dict.fromkeys(cycles["model"]) if word and word != "solved"), "sD^"):
            point = film_points(cycles, cycles["model"] == name, error, "time")
            if point:
                axes.plot(1e3 * point[0], point[1], "k" + marker, label="run, " + name)
        axes.set(xlabel="time [ms]", ylabel=words, title="cycle, against 257 nodes")
    for axes in panels:
        axes.set(xscale="log", yscale="log")
        axes.grid(True, which="major", linewidth=0.3)
    # both panels of cycles have the same curves
    for axes in (panels[0], panels[2]):
        axes.legend(frameon=False, fontsize=7.5, handlelength=3.5)
    # whichever library the program was linked with: it sets the number of its threads
    figure.suptitle("one core, one thread of BLAS", fontsize="medium")
    return figure


FIGURES = {"work_precision": work_precision, "cheapest": cheapest, "stability": stability}


def _drawn(draw, study, path):
    """A figure of a study; ResultError where columns are missing, have no numbers or lengths of their own."""
    try:
        return draw(study)
    except (KeyError, ValueError, IndexError, TypeError) as error:
        raise ResultError(f"{path}: not a study that can be drawn: {error}") from None


def main(arguments=None):
    """Command line; returns the exit code."""
    made = argparse.ArgumentParser(prog="plot_study.py", description=__doc__,
                                   formatter_class=argparse.RawDescriptionHelpFormatter)
    made.add_argument("file", metavar="FILE", help="file of a study")
    made.add_argument("--output", metavar="DIR", help="folder for the figures (default: that of the file)")
    made.add_argument("--name", help="beginning of their names (default: that of the file)")
    options = made.parse_args(arguments)
    path = Path(options.file)
    folder = Path(options.output) if options.output else path.parent
    try:
        study, figures = read_films(path), {"work_precision": film_work_precision}
        if study is None:
            study, figures = read_study(path), FIGURES
        for name, draw in figures.items():
            target = folder / f"{options.name or path.stem}_{name}.png"
            save_figure(_drawn(draw, study, path), target, dpi=110)
            print(f"{name}: {target}")
    except ResultError as error:
        print(f"plot_study.py: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(run(main, "plot_study.py"))
