"""Draw what `camroller audit` has measured, and print it as a table for a page.

    python post/plot_audit.py results/thesis_audit.h5            <name>.png beside the file
    python post/plot_audit.py FILE --output doc/figures --name thesis_effects
    python post/plot_audit.py FILE --table                       a table in Markdown instead of a figure

One panel each for mean torque, smallest film, slip and time: a bar from the smallest to the largest change without each effect over
the cases, a dot for each case, and for the first three a cross for what was expected before the run; how many cases and runs without
an effect have no result, and what is not shown. Needs no display. Exit code 2 where the file is no audit.
"""

import argparse
from pathlib import Path
import sys

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams.update({"font.size": 9.0, "axes.spines.top": False, "axes.spines.right": False})

from matplotlib.figure import Figure  # noqa: E402
import numpy as np  # noqa: E402

from command import script, save_figure  # noqa: E402
from read import ResultError, opened, text_columns  # noqa: E402
from units import number  # noqa: E402

QUANTITIES = {"mean_torque": "mean friction torque", "minimum_film": "smallest film", "slip": "slip per turn"}
COLUMNS = ["case", "run", "effect", "status", "time_share", "is_left_out",
           *(prefix + name for name in QUANTITIES for prefix in ("change_", "estimate_"))]
FLOOR = 1e-7  # changes below are drawn there, and the figure says so: the accuracy of the runs
UNKNOWN = 1e10  # estimates from here on are no bound: infinite, the largest number in files of older programs
FAR = 5.0  # widths of the middle half of all shares of time: what is farther from that half was disturbed by the machine, and is not shown


def read_audit(path):
    """Table of an audit as a dictionary of columns."""
    with opened(path, "an audit") as file:
        audit = text_columns(file["study/audit"])
        missing = [name for name in COLUMNS if name not in audit]
        if missing or len({len(audit[name]) for name in COLUMNS}) != 1:
            raise ResultError(f"{path}: not an audit: " + (f"no {missing[0]}" if missing else "columns of different lengths"))
        if not effects(audit):
            raise ResultError(f"{path}: no run without an effect in it")
        return audit


def without(audit, effect):
    """Rows of the runs without an effect that have a result, as the run with it has."""
    return (audit["run"] == "without") & (audit["effect"] == effect) & (audit["status"] == 0) & np.isfinite(audit["time_share"])


def left_out(audit):
    """How many cases, and of the others how many runs without an effect, have no result: parts of a sentence."""
    is_listed, is_without, failed = audit["run"] == "listed", audit["run"] == "without", audit["status"] != 0
    lost = set(audit["case"][is_listed & failed])
    is_without &= ~np.isin(audit["case"], list(lost))
    counts = [(len(lost), is_listed.sum(), "cases"), ((is_without & failed).sum(), is_without.sum(), "runs without an effect")]
    return [f"{count} of {of_all} {what} {'has' if count == 1 else 'have'} no result" for count, of_all, what in counts if count]


def effects(audit):
    """Effects in the order of the table, those that a run without has a result of."""
    return [name for name in dict.fromkeys(audit["effect"][audit["run"] == "without"]) if without(audit, name).any()]


def draw(audit):
    """The figure."""
    names = effects(audit)
    figure = Figure(figsize=(11.0, 0.9 + 0.42 * len(names)), layout="constrained")
    panels = figure.subplots(1, 4, sharey=True)
    places = np.arange(len(names))[::-1]
    for axes, (quantity, title) in zip(panels, QUANTITIES.items()):
        for place, name in zip(places, names):
            rows = without(audit, name)
            change = np.maximum(np.abs(audit["change_" + quantity][rows]), FLOOR)
            estimate = audit["estimate_" + quantity][rows]
            known = estimate < UNKNOWN
            axes.plot([change.min(), change.max()], [place, place], color="#6baed6", linewidth=5, solid_capstyle="butt")
            axes.plot(change, np.full(change.size, place), "o", color="#08306b", markersize=3, label="change without it")
            axes.plot(np.maximum(estimate[known], FLOOR), np.full(known.sum(), place + 0.25), "x", color="#d55e00", markersize=4,
                      label="expected at most")
        axes.set(xscale="log", title=title, xlabel="relative change [-]", xlim=(0.5 * FLOOR, None))
        axes.grid(True, axis="x", which="major", linewidth=0.3)
    words = [*left_out(audit), *unknown_words(audit), *floor_words(audit), *_draw_times(panels[3], audit, places)]
    panels[0].set_yticks(places, [name.replace("_", " ") for name in names])
    marks = {label: handle for axes in (panels[0], panels[3]) for handle, label in zip(*axes.get_legend_handles_labels())}
    figure.legend(marks.values(), marks, loc="outside lower center", ncols=len(marks), frameon=False)
    if words:
        figure.suptitle(", ".join(words), fontsize="medium")
    return figure


def unknown_words(audit):
    """How many expectations are not drawn, as they say nothing: parts of a sentence."""
    estimates = [audit["estimate_" + quantity][without(audit, name)] for name in effects(audit) for quantity in QUANTITIES]
    unknown = sum(int((estimate >= UNKNOWN).sum()) for estimate in estimates)
    return [f"{unknown} of {sum(map(len, estimates))} changes have no bound beforehand"] if unknown else []


def floor_words(audit):
    """How many changes are drawn at the lower end of the axes, as they are below it: parts of a sentence."""
    changes = np.concatenate([np.abs(audit["change_" + quantity][without(audit, name)]) for name in effects(audit) for quantity in QUANTITIES])
    small = int((changes < FLOOR).sum())
    return [f"{small} of {changes.size} changes are below {FLOOR:g} and drawn there"] if small else []


def _draw_times(axes, audit, places):
    """The share of time that each run without an effect saves, and their median; returns words on those beyond the axis."""
    shares = [100.0 * audit["time_share"][without(audit, name)] for name in effects(audit)]
    low, high = np.percentile(np.concatenate(shares), [25, 75])
    reach = FAR * max(high - low, 1.0)  # [%]: a clock tells less apart
    ends, outside = (min(low - reach, 0.0), max(high + reach, 0.0)), 0
    for place, share in zip(places, shares):
        far = (share < ends[0]) | (share > ends[1])
        outside += int(far.sum())
        axes.plot(share[~far], np.full((~far).sum(), place), "o", color="#08306b", markersize=3)
        axes.plot([np.clip(np.median(share), *ends)], [place], "|", color="#d55e00", markersize=14, markeredgewidth=2, label="median of the time saved")
    axes.axvline(0.0, color="black", linewidth=0.5)
    axes.set(title="time that leaving it out saves", xlabel="part of the run [%]")
    axes.grid(True, axis="x", which="major", linewidth=0.3)
    return [f"{outside} of {sum(map(len, shares))} times beyond {ends[0]:.0f} to {ends[1]:.0f} % not shown"] if outside else []


def table(audit):
    """The same in Markdown: smallest and largest change over the cases, median of the time."""
    lines = ["| without | mean friction torque | smallest film | slip per turn | time saved | cases that need it |",
             "|---|---|---|---|---|---|"]
    for name in effects(audit):
        rows = without(audit, name)
        cells = [_span(audit["change_" + quantity][rows]) for quantity in QUANTITIES]
        needed = int((audit["is_left_out"][rows] == 0).sum())
        lines.append(f"| {name.replace('_', ' ')} | " + " | ".join(cells)
                     + f" | {number(round(100 * np.median(audit['time_share'][rows])))} % | {needed} of {rows.sum()} |")
    return "\n".join([*lines, *([""] if left_out(audit) else []), *(f"{words}." for words in left_out(audit))])


def _span(values):
    if not np.abs(values).max() > 0.0:
        return "0"
    return f"{_per_cent(values.min())} to {_per_cent(values.max())} %"


def _per_cent(part):
    return number(100.0 * part, 2)


@script
def main(arguments=None):
    """Command line; returns the exit code."""
    made = argparse.ArgumentParser(prog="plot_audit.py", description=__doc__,
                                   formatter_class=argparse.RawDescriptionHelpFormatter)
    made.add_argument("file", metavar="FILE", help="file of an audit")
    made.add_argument("--output", metavar="DIR", help="folder for the figure (default: that of the file)")
    made.add_argument("--name", help="its name (default: that of the file)")
    made.add_argument("--table", action="store_true", help="print a table in place of a figure")
    options = made.parse_args(arguments)
    path = Path(options.file)
    folder = Path(options.output) if options.output else path.parent
    audit = read_audit(path)
    if options.table:
        print(table(audit))
        return 0
    target = folder / f"{options.name or path.stem}.png"
    save_figure(draw(audit), target, dpi=110)
    print(target)
    return 0


if __name__ == "__main__":
    sys.exit(main())
