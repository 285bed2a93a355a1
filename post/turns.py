"""A flexible train from turn to turn, where it does not repeat itself every turn (`/turns` of a result file)."""

from matplotlib.figure import Figure
import numpy as np

from parts import head, legend_height, wrap_labels
from quantities import Missing
from units import unit_words

WIDTH, HEIGHT = 9.0, 7.6  # of the figure without the lines of its legend after the first [inch]
SIDE = 0.03  # room beside the first and the last turn, of all of them
LIFT, SPEED = "valve_lift_at_nose", "valve_velocity_at_nose"
# Title, unit, factor from the file's unit, name of the measure
PANELS = (("lift at the nose less its mean", "um", 1e6, LIFT), ("largest contact load", "N", 1.0, "dynamic_load_max"),
          ("speed of seating", "m/s", 1.0, "seating_speed"))


def turns_of(result, name, case):
    """A measure of all turns of a case, not-a-number in those that do not have it; none where its turns are not listed."""
    if name not in result.turns:
        return np.zeros(0)
    return result.turns[name].values[case][:result.turn_count(case)]


def turns_figure(layout, _whole_cycle=None):
    """What a train does turn by turn, and where its valve is at the nose, a colour for each case."""
    layout.refuse_too_many()
    entries = [entry for entry in layout.entries if turns_of(layout.results[entry.file], LIFT, entry.case).size]
    if not entries:
        raise Missing("trains that do not repeat every turn")
    figure = Figure(figsize=(WIDTH, HEIGHT), layout="constrained")
    *panels, section = figure.subplots(2, 2).flat
    most = 1
    for number, entry in enumerate(entries):
        result, style = layout.results[entry.file], {"color": f"C{number % 10}", "markersize": 3.5}
        for axes, (_, _, factor, name) in zip(panels, PANELS):
            values = factor * turns_of(result, name, entry.case)
            most = max(most, values.size)
            axes.plot(np.arange(1, 1 + values.size), values - (values.mean() if name == LIFT else 0.0), marker="o", linewidth=0.7, **style)
        lift = 1e6 * turns_of(result, LIFT, entry.case)
        section.plot(lift - lift.mean(), turns_of(result, SPEED, entry.case), marker="o", linestyle="none", label=_words(layout, entry), **style)
    for axes, (title, unit, *_) in zip(panels, PANELS):
        axes.set_ylabel(f"{title} [{unit_words(unit)}]")
        axes.set_xlabel("turn")
        axes.set_xlim(1.0 - SIDE * most, most + SIDE * most)  # also where turns at the ends have no value
    section.set_xlabel(f"{PANELS[0][0]} [{unit_words('um')}]")
    section.set_ylabel("speed of the valve at the nose [m/s]")
    for axes in figure.axes:
        axes.grid(alpha=0.3)
    legend = wrap_labels(section.get_legend_handles_labels()[0], WIDTH), None
    figure.set_figheight(HEIGHT + legend_height(legend, WIDTH))
    head(figure, layout, "from turn to turn", legend, [], [LIFT, SPEED])
    return figure


def _words(layout, entry):
    """Name of a case, and after how many turns it repeats."""
    period = layout.results[entry.file].summary.get("period_cycles")
    repeats = int(period.values[entry.case]) if period is not None else 0
    return ", ".join(filter(None, [layout.entry_words(entry), f"repeats after {repeats} turns" if repeats else "no period"]))
