"""Bar charts of means over the cycle: slip, and friction torque by source.

One group of bars for each panel of the other figures, in it one bar for each value of the first
swept key, with that value below the bar and the group's below the group.
"""

import textwrap

from matplotlib.patches import Patch
import numpy as np

from layout import MOST_COLOURS, family, spread_colours, thin_out
from parts import MOST_PANELS, columns_for
from quantities import SOURCES, mean_of
from units import number

MOST_BARS = 40
CHARACTER = 0.066  # width of a small digit [inch]
AXES_PART = 0.85  # of the figure's width
FILE_HATCHES = ["", "////", "....", "xxxx"]
GAP = 0.7  # between groups, in bars


def shown_in_bars(layout):
    """Values of the first key and panels that fit into a bar chart."""
    if layout.is_list:
        return list(layout.colours), list(layout.panels)
    panels = thin_out(layout.panels, MOST_PANELS)
    return thin_out(layout.colours, max(MOST_COLOURS, MOST_BARS // len(panels))), panels


def slip_bars(figure, layout):
    """Mean slip, bars of several files side by side."""
    axes = figure.subplots()
    colours, panels = shown_in_bars(layout)
    files = len(layout.files)
    tones = [spread_colours(len(colours))] if files == 1 else [family(place, len(colours)) for place in range(files)]
    width = 0.84 / files
    bars = []
    for entry, position in _places(layout, colours, panels):
        value, place = mean_of(layout, entry, "mean_slip_ratio", "%"), layout.files.index(entry.file)
        if value is None:
            continue
        left = position - 0.42 + (place + 0.5) * width
        bars.append((left, value))
        if np.isfinite(value):
            axes.bar(left, value, width, color=tones[place][colours.index(entry.colour)], linewidth=0.0,
                     hatch=FILE_HATCHES[place % len(FILE_HATCHES)])
    axes.axhline(0.0, color="0.3", linewidth=0.8)
    axes.set_ylabel("mean slip ratio [%]")
    _case_axis(axes, layout, colours, panels)
    numbers_above(axes, bars, width)
    axes.margins(y=0.12)
    if files > 1:
        legend_below(figure, [Patch(facecolor=family(place, 3)[1], hatch=FILE_HATCHES[place % len(FILE_HATCHES)], linewidth=0.0,
                                    label=layout.titles[number]) for place, number in enumerate(layout.files)])


def torque_bars(figure, layout):
    """Mean friction torque stacked by source, a row of bars for each file."""
    grid = figure.subplots(len(layout.files), 1, sharex=True, squeeze=False)[:, 0]
    colours, panels = shown_in_bars(layout)
    places = _places(layout, colours, panels)
    sums = [sum(_parts(layout, entry)) for entry, _ in places]
    top = np.nanmax([0.0, *sums])
    for axes, number in zip(grid, layout.files):
        for entry, position in places:
            if entry.file == number:
                _stack(axes, position, _parts(layout, entry))
        axes.set_ylim(0.0, 1.18 * top or 1.0)
        axes.set_ylabel("mean friction\ntorque [N mm]")
        _case_axis(axes, layout, colours, panels, labelled=axes is grid[-1])
        numbers_above(axes, [(position, total) for (entry, position), total in zip(places, sums) if entry.file == number], 0.84)
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
    """Mean torques of one case in the order of SOURCES; zero for what is not there, no number for a case without a result."""
    values = [mean_of(layout, entry, name, "N mm") for name, *_ in SOURCES]
    return [0.0 if value is None else value for value in values]


def _stack(axes, position, parts):
    bottom = 0.0
    for value, (_, _, tone, hatch) in zip(parts, SOURCES):
        if np.isfinite(value):
            axes.bar(position, value, 0.84, bottom=bottom, color=tone, hatch=hatch, linewidth=0.0)
            bottom += value


def numbers_above(axes, bars, width):
    """Values above the bars, upright where they are too long to stand beside each other; left out where there is no room for that."""
    texts = [number(value) if np.isfinite(value) else "no result" for _, value in bars]
    low, high = axes.get_xlim()
    room = AXES_PART * _inches(axes) * width / (high - low)
    longest = max(map(len, texts), default=0)
    turn = 0 if CHARACTER * longest <= room or len(bars) == 1 else 90
    if turn and room < 1.5 * CHARACTER:
        return
    for (position, value), text in zip(bars, texts):
        down = np.isfinite(value) and value < 0.0
        axes.annotate(text, (position, value if np.isfinite(value) else 0.0), (0, -2 if down else 2), textcoords="offset points",
                      ha="center", va="top" if down else "bottom", fontsize="small", rotation=turn)


def _inches(axes):
    """Width of the figure that the axes are in."""
    return axes.figure.bbox.width / axes.figure.dpi


def _case_axis(axes, layout, colours, panels, labelled=True):
    """Axis of the cases: values of the first key below the bars, those of the others below the groups."""
    names = [layout.text(layout.colour_key, value) for value in colours]
    group = AXES_PART * _inches(axes) / len(panels)
    room = int(group / CHARACTER / (max(map(len, names)) + 2))
    named = range(len(names)) if layout.is_list else thin_out(range(len(names)), room) if room > 1 or len(names) == 1 else []
    starts = [place * (len(colours) + GAP) for place in range(len(panels))]
    ticks = [(start + place, names[place]) for start in starts for place in named]
    turn = {"rotation": 35 if len(names) <= 16 else 90, "ha": "right", "rotation_mode": "anchor"} if layout.is_list else {}
    axes.set_xticks([tick for tick, _ in ticks], [name for _, name in ticks], fontsize="small", **turn)
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
                         ["\n" + textwrap.fill(layout.panel_name(panel), max(6, int(group / CHARACTER))) for panel in panels],
                         fontsize="small")
        lower.tick_params(length=0.0)
    if layout.colour_key:
        span = "" if named else f", from {names[0]} to {names[-1]} in each group"
        lower.set_xlabel(layout.axis_name(layout.colour_key) + span)
