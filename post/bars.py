"""Bar charts of means over the cycle: slip, and friction torque by source.

Of a grid, one group of vertical bars for each panel of the other figures, in it one bar for each value of the first swept key,
with that value below the bar and the group's below the group. Of a list of cases, one horizontal bar for each, labelled beside it.
"""

import textwrap

from matplotlib.patches import Patch
import numpy as np

from layout import MOST_COLOURS, family, wrapped
from parts import MOST_PANELS, columns_for, legend_height, wrap_labels
from quantities import SOURCES, mean_of, source_words
from units import number

MOST_BARS = 40
CHARACTER = 0.066  # width of a small digit [inch]
AXES_PART = 0.85  # of the figure's width
AXES_HEIGHT = 0.55  # of the figure's height, at least
FILE_HATCHES = ["", "////", "....", "xxxx"]
LONGEST_TURNED = 8  # characters of a value that may stand upright below its bar
GAP = 0.7  # between groups, in bars


def shown_in_bars(layout):
    """Values of the first key and panels that fit into a bar chart."""
    if layout.is_list:
        return list(layout.colours), list(layout.panels)
    panels = layout.shown_panels(MOST_PANELS)
    return layout.some_colours(max(MOST_COLOURS, MOST_BARS // len(panels))), panels


def slip_bars(figure, layout):
    """Mean slip, bars of several files side by side."""
    _slip(figure.subplots(), layout)
    legend_below(figure, bar_handles(slip_bars, layout))


def torque_bars(figure, layout):
    """Mean friction torque stacked by source, a chart for each file."""
    grid = figure.subplots(len(layout.files), 1, sharex=True, squeeze=False)[:, 0]
    for axes, number in zip(grid, layout.files):
        _torque(axes, layout, number, axes is grid[-1])
        if len(layout.files) > 1:
            letters = (0.5 if layout.is_list else AXES_PART) * _inches(axes) / (1.3 * CHARACTER)
            axes.set_title(textwrap.fill(layout.titles[number], int(letters)), fontsize="medium")
    legend_below(figure, bar_handles(torque_bars, layout))


def both_bars(figure, layout):
    """Both for a list of one file, side by side with the labels of the cases on the left."""
    left, right = figure.subplots(1, 2, sharey=True)
    _slip(left, layout)
    _torque(right, layout, layout.files[0], True)
    right.tick_params(axis="y", labelleft=False)
    legend_below(figure, bar_handles(torque_bars, layout))


def _slip(axes, layout):
    colours, panels = shown_in_bars(layout)
    files = len(layout.files)
    width = 0.84 / files
    bars = []
    for entry, position in _places(layout, colours, panels):
        value, place = mean_of(layout, entry, "mean_slip_ratio", "%"), layout.files.index(entry.file)
        if value is None:
            continue
        own = layout.colours_of(entry.file) if layout.is_list else colours
        tones = layout.tones(entry.file, own)
        left = position - 0.42 + (place + 0.5) * width
        bars.append((left, value))
        if np.isfinite(value):
            _bar(axes, layout, left, value, width, color=tones[own.index(entry.colour)],
                 hatch=FILE_HATCHES[place % len(FILE_HATCHES)])
    _name_values(axes, layout, "mean slip ratio [%]")
    _case_axis(axes, layout, colours, panels)
    _numbers(axes, layout, bars, width)


def _torque(axes, layout, file, labelled):
    colours, panels = shown_in_bars(layout)
    if layout.is_list:
        colours = layout.colours_of(file)
    top = np.nanmax([0.0, *(sum(_parts(layout, entry)) for entry, _ in _places(layout, *shown_in_bars(layout)))])
    bars = []
    for entry, position in _places(layout, colours, panels):
        if entry.file == file:
            parts = _parts(layout, entry)
            _stack(axes, layout, position, parts)
            bars.append((position, sum(parts)))
    (axes.set_xlim if layout.is_list else axes.set_ylim)(0.0, 1.18 * top or 1.0)
    words = "mean friction torque [N mm]" if layout.is_list else "mean friction\ntorque [N mm]"
    _name_values(axes, layout, words, labelled or not layout.is_list)
    _case_axis(axes, layout, colours, panels, labelled)
    _numbers(axes, layout, bars, 0.84)


def file_handles(layout):
    """Legend of the bars of several files."""
    tones = [layout.tones(number, [None])[0] if layout.is_one_each() else family(place, 3)[1] for place, number in enumerate(layout.files)]
    return [Patch(facecolor=tone, hatch=FILE_HATCHES[place % len(FILE_HATCHES)], linewidth=0.0, label=layout.titles[number])
            for place, (number, tone) in enumerate(zip(layout.files, tones))]


def bar_handles(part, layout):
    """Legend of a bar chart: sources of friction, or the files where there are several."""
    if part is slip_bars:
        return file_handles(layout) if len(layout.files) > 1 else []
    return [Patch(facecolor=tone, hatch=hatch, linewidth=0.0, label=source_words(layout, label))
            for _, label, tone, hatch in _sources(layout)]


def _sources(layout):
    """Rows of SOURCES that some result has."""
    return [source for source in SOURCES if any(source[0] in result.summary for result in layout.results)]


def legend_inches(part, layout, width):
    """Height of the lines of a bar chart's legend after the first, in a figure of some width [inch]."""
    return legend_height((wrap_labels(bar_handles(part, layout), width), None), width)


def legend_below(figure, handles):
    """Legend below the bars, where there is one."""
    if not handles:
        return
    handles = wrap_labels(handles, figure.bbox.width / figure.dpi)
    figure.legend(handles=handles, loc="outside lower center", ncols=columns_for(figure, handles), frameon=False,
                  columnspacing=1.0, handlelength=1.5)


def _places(layout, colours, panels):
    """Cases that are shown, each with the position of its bar."""
    return [(entry, panels.index(entry.panel) * (len(colours) + GAP) + colours.index(entry.colour))
            for entry in layout.entries if entry.panel in panels and entry.colour in colours]


def _parts(layout, entry):
    """Mean torques of one case by source; zero for what its file does not have, no number for a case without a result."""
    values = [mean_of(layout, entry, name, "N mm") for name, *_ in _sources(layout)]
    return [0.0 if value is None else value for value in values]


def _bar(axes, layout, position, value, width, start=0.0, **style):
    """A bar, lying where each case has a label of its own."""
    if layout.is_list:
        axes.barh(position, value, width, left=start, linewidth=0.0, **style)
    else:
        axes.bar(position, value, width, bottom=start, linewidth=0.0, **style)


def _stack(axes, layout, position, parts):
    start = 0.0
    for value, (_, _, tone, hatch) in zip(parts, _sources(layout)):
        if np.isfinite(value):
            _bar(axes, layout, position, value, 0.84, start, color=tone, hatch=hatch)
            start += value


def _name_values(axes, layout, words, labelled=True):
    """Axis of the values: its name, a line at zero, and a grid behind the bars."""
    if layout.is_list:
        axes.set_xlabel(words if labelled else "")
        axes.axvline(0.0, color="0.3", linewidth=0.8)
        axes.margins(x=0.15)
    else:
        axes.set_ylabel(words)
        axes.axhline(0.0, color="0.3", linewidth=0.8)
        axes.margins(y=0.12)
    axes.grid(True, axis="x" if layout.is_list else "y", color="0.9", linewidth=0.6)
    axes.set_axisbelow(True)


def _numbers(axes, layout, bars, width):
    """Values at the ends of the bars; above upright ones turned where they are too long to stand beside each other."""
    texts = [number(value) if np.isfinite(value) else "no result" for _, value in bars]
    turn = 0
    if not layout.is_list:
        low, high = axes.get_xlim()
        room = AXES_PART * _inches(axes) * width / (high - low)
        turn = 0 if CHARACTER * max(map(len, texts), default=0) <= room or len(bars) == 1 else 90
        if turn and room < 1.5 * CHARACTER:
            return
        if turn:
            axes.set_ylim(_room_for(axes, [(*_end(value), text) for (_, value), text in zip(bars, texts)]))
    for (position, value), text in zip(bars, texts):
        end, side = _end(value)
        place, shift = ((end, position), (2 * side, 0)) if layout.is_list else ((position, end), (0, 2 * side))
        across, upright = ("left" if side > 0 else "right"), ("bottom" if side > 0 else "top")
        axes.annotate(text, place, shift, textcoords="offset points", fontsize="small", rotation=turn,
                      ha=across if layout.is_list else "center", va="center" if layout.is_list else upright)


def _end(value):
    """End of a bar where its number stands, and the number's side: 1 above, -1 below."""
    return (value, 1 if value >= 0.0 else -1) if np.isfinite(value) else (0.0, 1)


def _room_for(axes, numbers):
    """Range of the values in which turned numbers at these ends, on these sides, do not go beyond the axes."""
    height = AXES_HEIGHT * axes.figure.bbox.height / axes.figure.dpi
    low, high = axes.get_ylim()
    for _ in range(20):  # the longer the range, the more of it has the length of a number
        reached = [end + side * CHARACTER * (len(text) + 1) / height * (high - low) for end, side, text in numbers]
        low, high = min(low, *reached), max(high, *reached)
    return low, high


def _inches(axes):
    """Width of the figure that the axes are in."""
    return axes.figure.bbox.width / axes.figure.dpi


def _case_axis(axes, layout, colours, panels, labelled=True):
    """Axis of the cases: the label of each of a list, else values of the first key, and those of the others below the groups."""
    if layout.is_list:
        axes.set_yticks(range(len(colours)), [textwrap.fill(name, 44) for name in colours], fontsize="small")
        axes.set_ylim(len(colours) - 0.4, -0.6)
        axes.tick_params(axis="y", length=0.0)
        return
    names = [layout.text(layout.colour_key, value) for value in colours]
    group = AXES_PART * _inches(axes) / len(panels)
    longest = max(map(len, names))
    room = int(group / CHARACTER / (longest + 2))
    # Names that have no room beside each other stand upright
    turned = room < len(names) and longest <= LONGEST_TURNED
    if turned:
        room = int(group / (1.6 * CHARACTER))
    # each of them, each second one, ...: at even distances none touches the next
    named = range(0, len(names), -(-len(names) // max(room, 1))) if room > 1 or len(names) == 1 else []
    turned = turned and bool(named)
    starts = [place * (len(colours) + GAP) for place in range(len(panels))]
    ticks = [(start + place, names[place]) for start in starts for place in named]
    axes.set_xticks([tick for tick, _ in ticks], [name for _, name in ticks], fontsize="small", rotation=90 if turned else 0)
    axes.tick_params(axis="x", length=0.0, labelbottom=labelled)
    last = starts[-1] + len(colours) - 1
    room = max(0.8, 0.5 * (4.0 - last))
    axes.set_xlim(-room, last + room)
    if not labelled:
        return
    lower = axes
    if len(panels) > 1:
        lower = axes.secondary_xaxis("bottom")
        lower.set_xticks([start + 0.5 * (len(colours) - 1) for start in starts],
                         ["\n" + wrapped(layout.panel_name(panel), max(6, int(group / CHARACTER) - 2)) for panel in panels],
                         fontsize="small")
        lower.tick_params(length=0.0, pad=72.0 * CHARACTER * (longest + 0.5) if turned else 3.0)
    if layout.colour_key:
        span = "" if named else f", from {names[0]} to {names[-1]} in each group"
        lower.set_xlabel(layout.axis_name(layout.colour_key) + span)
