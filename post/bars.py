"""Bar charts of means over the cycle: slip, and friction torque by source.

One group of bars for each panel of the other figures, in it one bar for each value of the first
swept key, with that value below the bar and the group's below the group.
"""

from matplotlib.patches import Patch
import numpy as np

from layout import MOST_COLOURS, spread_colours, thin_out
from parts import MOST_PANELS, columns_for
from quantities import SOURCES, mean_of

MOST_BARS = 40
MOST_NUMBERS = 12  # bars that still have room for their value above them
FILE_HATCHES = ["", "////", "....", "xxxx"]
GAP = 0.7  # between groups, in bars


def shown_in_bars(layout):
    """Values of the first key and panels that fit into a bar chart."""
    panels = thin_out(layout.panels, MOST_PANELS)
    return thin_out(layout.colours, max(MOST_COLOURS, MOST_BARS // len(panels))), panels


def slip_bars(figure, layout):
    """Mean slip, bars of several files side by side."""
    axes = figure.subplots()
    colours, panels = shown_in_bars(layout)
    tones = dict(zip(colours, spread_colours(len(colours))))
    width = 0.84 / len(layout.files)
    for entry, position in _places(layout, colours, panels):
        value = mean_of(layout, entry, "mean_slip_ratio", "%")
        if value is not None:
            place = layout.files.index(entry.file)
            axes.bar(position - 0.42 + (place + 0.5) * width, value, width, color=tones[entry.colour], linewidth=0.0,
                     hatch=FILE_HATCHES[place % len(FILE_HATCHES)])
            if len(colours) * len(panels) * len(layout.files) <= MOST_NUMBERS and np.isfinite(value):
                number_above(axes, position - 0.42 + (place + 0.5) * width, value, f"{value:.2g}")
    axes.axhline(0.0, color="0.3", linewidth=0.8)
    axes.set_ylabel("mean slip ratio [%]")
    _case_axis(axes, layout, colours, panels)
    if len(layout.files) > 1:
        legend_below(figure, [Patch(facecolor="0.4", hatch=FILE_HATCHES[place % len(FILE_HATCHES)], linewidth=0.0,
                                    label=layout.titles[number]) for place, number in enumerate(layout.files)])


def torque_bars(figure, layout):
    """Mean friction torque stacked by source, a row of bars for each file."""
    grid = figure.subplots(len(layout.files), 1, sharex=True, squeeze=False)[:, 0]
    colours, panels = shown_in_bars(layout)
    places = _places(layout, colours, panels)
    top = max([sum(_parts(layout, entry)) for entry, _ in places])
    for axes, number in zip(grid, layout.files):
        for entry, position in places:
            if entry.file == number:
                _stack(axes, position, _parts(layout, entry), len(colours) * len(panels) <= MOST_NUMBERS)
        axes.set_ylim(0.0, 1.18 * top or 1.0)
        axes.set_ylabel("mean friction\ntorque [N mm]")
        _case_axis(axes, layout, colours, panels, labelled=axes is grid[-1])
        if len(layout.files) > 1:
            axes.set_title(layout.titles[number], fontsize="medium")
    legend_below(figure, [Patch(facecolor=tone, hatch=hatch, linewidth=0.0, label=label)
                          for name, label, tone, hatch in SOURCES
                          if any(name in result.summary for result in layout.results)])


def legend_below(figure, handles):
    """Legend below the bars."""
    figure.legend(handles=handles, loc="outside lower center", ncols=columns_for(figure, handles), frameon=False,
                  columnspacing=1.0, handlelength=1.5)


def _places(layout, colours, panels):
    """Cases that are shown, each with the position of its bar."""
    return [(entry, panels.index(entry.panel) * (len(colours) + GAP) + colours.index(entry.colour))
            for entry in layout.entries if entry.panel in panels and entry.colour in colours]


def _parts(layout, entry):
    """Mean torques of one case in the order of SOURCES; zero for what is not there."""
    values = [mean_of(layout, entry, name, "N mm") for name, *_ in SOURCES]
    return [value if value is not None and np.isfinite(value) else 0.0 for value in values]


def _stack(axes, position, parts, numbered):
    bottom = 0.0
    for value, (_, _, tone, hatch) in zip(parts, SOURCES):
        axes.bar(position, value, 0.84, bottom=bottom, color=tone, hatch=hatch, linewidth=0.0)
        bottom += value
    if numbered:
        number_above(axes, position, bottom, f"{bottom:.3g}")


def number_above(axes, position, top, text):
    """Value in figures above a bar, or below one that points down."""
    axes.annotate(text, (position, top), (0, 2 if top >= 0.0 else -2), textcoords="offset points", ha="center",
                  va="bottom" if top >= 0.0 else "top", fontsize="small")


def _case_axis(axes, layout, colours, panels, labelled=True):
    """Axis of the cases: values of the first key below the bars, those of the others below the groups."""
    names = [f"{value:.4g}" if isinstance(value, float) else str(value or "") for value in colours]
    width = axes.figure.bbox.width / axes.figure.dpi
    room = int(14.0 * width / len(panels) / (max(map(len, names)) + 2))
    named = thin_out(range(len(names)), room) if room > 1 or len(names) == 1 else []
    starts = [group * (len(colours) + GAP) for group in range(len(panels))]
    ticks = [(start + place, names[place]) for start in starts for place in named]
    axes.set_xticks([tick for tick, _ in ticks], [name for _, name in ticks], fontsize="small")
    axes.tick_params(axis="x", length=0.0, labelbottom=labelled)
    last = starts[-1] + len(colours) - 1
    room = max(0.8, 0.5 * (4.0 - last))
    axes.set_xlim(-room, last + room)
    axes.grid(True, axis="y", color="0.9", linewidth=0.6)
    axes.set_axisbelow(True)
    if not labelled:
        return
    lower = axes
    if len(panels) > 1:
        lower = axes.secondary_xaxis("bottom")
        lower.set_xticks([start + 0.5 * (len(colours) - 1) for start in starts],
                         ["\n" + layout.panel_name(panel) for panel in panels], fontsize="small")
        lower.tick_params(length=0.0)
    if layout.colour_key:
        span = "" if named else f", from {names[0]} to {names[-1]} in each group"
        lower.set_xlabel(layout.axis_name(layout.colour_key) + span)
