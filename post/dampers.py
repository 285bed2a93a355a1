"""Energy that a flexible train loses in a turn, damper by damper."""

from matplotlib.figure import Figure
from matplotlib.patches import Patch
import numpy as np

from parts import head, legend_handles, legend_height
from quantities import Missing, mean_of
from units import number, unit_words

# Scalar, words
DAMPERS = (("damping_work_cam", "cam and roller"), ("damping_work_pad", "pad at the valve"), ("damping_work_seat", "valve seat"),
           ("damping_work_spring", "spring"), ("damping_work_plunger", "plunger's wall"), ("damping_work_stops", "plunger's stops"),
           ("damping_work_leak", "leak of the adjuster"), ("damping_work_check_valve", "check valve"))
UNIT = "mJ"
SHOWN = 1e-9  # of the largest energy: what is less has no bar, and the title says so
ROOM = 0.8  # of the distance from damper to damper, for its bars
MOST_PANELS = 3


def dampers_figure(layout, _whole_cycle=None):
    """A group of bars for each damper that takes energy in some case, in it one for each case; panels side by side."""
    layout.refuse_too_many()
    panels = layout.shown_panels(MOST_PANELS)
    columns = [layout.entries_of(panel, layout.shown_colours()) for panel in panels]
    lost = {words: [[mean_of(layout, entry, name, UNIT) or 0.0 for entry in entries] for entries in columns] for name, words in DAMPERS}
    most = {words: np.nanmax([0.0, *(value for of_panel in values for value in of_panel)]) for words, values in lost.items()}
    lost = {words: values for words, values in lost.items() if most[words] > 0.0}
    if not lost:
        raise Missing("energies lost in dampers: &dynamics")
    top = max(most.values())
    positive = [value for values in lost.values() for of_panel in values for value in of_panel if value > 0.0]
    least = max(0.5 * min(positive), SHOWN * top)
    cut = [f"energies below {number(least)} {UNIT} have no bar"] if min(positive) < least else []
    size = 5.0 + 2.5 * len(panels), 1.6 + (0.13 * max(map(len, columns)) + 0.1) * len(lost)
    lines, legend_columns = legend_handles(layout, layout.drawn(layout.shown_colours(), panels), size[0])
    legend = [_as_bar(line) for line in lines], legend_columns
    figure = Figure(figsize=(size[0], size[1] + legend_height(legend, size[0])), layout="constrained")
    for place, (axes, panel, entries) in enumerate(zip(figure.subplots(1, len(panels), sharey=True, squeeze=False)[0], panels, columns)):
        width = ROOM / len(entries)
        for index, entry in enumerate(entries):
            axes.barh(np.arange(len(lost)) + (index + 0.5) * width - 0.5 * ROOM, [values[place][index] for values in lost.values()], width,
                      color=layout.style(entry)["color"])
        axes.set_xscale("log")
        axes.set_xlim(least, 2.0 * top)
        axes.set_xlabel(f"energy lost in a turn [{unit_words(UNIT)}]")
        axes.grid(True, axis="x", color="0.9", linewidth=0.6)
        axes.set_axisbelow(True)
        if len(panels) > 1:
            axes.set_title(layout.panel_name(panel), fontsize="medium")
    figure.axes[0].set_yticks(range(len(lost)), lost)
    figure.axes[0].set_ylim(len(lost) - 0.5, -0.5)
    head(figure, layout, "energy lost in a turn by damper", legend,
         [*layout.shown_words(layout.shown_colours(), panels), *cut], [name for name, _ in DAMPERS])
    return figure


def _as_bar(line):
    """A bar of the colour of a line of the legend; words without a line stay."""
    return line if line.get_linestyle() == "None" else Patch(color=line.get_color(), label=line.get_label())
