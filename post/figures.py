"""The figures by name, each drawn from a layout into a matplotlib figure.

`draw(name, layout)` makes one of `FIGURES`; it raises `Missing` where no file has what it needs.
"""

import textwrap

from matplotlib.figure import Figure
from matplotlib.lines import Line2D
import numpy as np

from bars import MOST_BARS, both_bars, legend_inches, shown_in_bars, slip_bars, torque_bars
from dampers import dampers_figure
from layout import line_style, wrapped
from parts import (MOST_PANELS, angle_axis, closed, crank_axis, draw_curve, event_window, file_legend, head, legend_handles,
                   legend_height, mark_values, ranges_of, say_no_result, seen_range, set_values_axis, suited)
from quantities import (CURVES, OVERVIEW, PARTS, SOURCES, TORQUES, TRAIN, Missing, has_series, is_nothing, need_series, source_words,
                        values_of)
from roller import roller_figure
from running_in import running_in_figure
from turns import turns_figure
from units import unit_words

MOST_COLUMNS = 4  # of the overview
BARS_WIDTH = 7.5  # of a bar chart as a figure of its own [inch]
TITLE = 40  # characters of a panel's title
MEANS = {slip_bars: ["mean_slip_ratio"], torque_bars: [name for name, *_ in SOURCES]}  # that a bar chart shows


def draw(name, layout, whole_cycle=None):
    """Figure by its name; `whole_cycle` overrides what the figure would show of the cam angle."""
    return FIGURES[name](layout, whole_cycle)


def curve_figure(curve, layout, whole_cycle):
    """One quantity over the cam angle, a panel for each value of the second swept key."""
    need_series(layout, curve.series)
    layout.refuse_too_many()
    curve = suited(layout, curve)
    same = same_in_all_panels(layout, curve)
    panels = layout.panels[:1] if same else layout.shown_panels(MOST_PANELS)
    columns = min(len(panels), 3)
    rows = -(-len(panels) // columns)
    shown = layout.shown_colours(), panels, [curve.series]
    width = 7.0 if columns == 1 else 2.0 + 3.2 * columns
    legend = legend_handles(layout, layout.drawn(*shown), width)
    figure = Figure(figsize=(width, 1.6 + 2.9 * rows + legend_height(legend, width)), layout="constrained")
    grid = figure.subplots(rows, columns, squeeze=False)
    whole = curve.whole_cycle if whole_cycle is None else whole_cycle
    window = (0.0, 360.0) if whole else event_window(layout, [curve.series])
    for axes in list(grid.flat)[len(panels):]:
        axes.remove()
    limits = [draw_curve(axes, layout, curve, panel, window) for axes, panel in zip(grid.flat, panels)]
    for place, (axes, panel, pair) in enumerate(zip(grid.flat, panels, ranges_of(curve, limits))):
        set_values_axis(axes, curve, pair)
        mark_values(axes, curve)
        angle_axis(axes, window, labelled=place + columns >= len(panels))
        if len(panels) > 1:
            axes.set_title(wrapped(layout.panel_name(panel), TITLE), fontsize="medium")
        if place % columns == 0:
            axes.set_ylabel(f"{curve.title} [{unit_words(curve.unit)}]")
    title = curve.title + (f", the same at each {layout.panel_words()}" if same else "")
    head(figure, layout, title, legend, layout.shown_words(shown[0], layout.panels if same else panels, shown[2]) + layout.turn_words(),
         [curve.series])
    return figure


def same_in_all_panels(layout, curve):
    """Whether a quantity (the lift, say) does not depend on the keys that make the panels."""
    drawn, counts = {}, {}
    for entry in layout.entries:
        values, place = values_of(layout, entry, curve.series, curve.unit), (entry.file, entry.colour)
        counts[place] = counts.get(place, 0) + 1
        if values is None or not np.array_equal(drawn.setdefault(place, values), values):
            return False
    return len(layout.panels) > 1 and set(counts.values()) == {len(layout.panels)}


def torque_figure(layout, whole_cycle, parts=TORQUES, title="drive torque and its parts", unit="N m"):
    """Drive torque with its geometric and friction parts, or friction torque by source, a panel for each case."""
    parts = [part for part in parts if has_series(layout, part[0])] or parts
    need_series(layout, *(name for name, *_ in parts))
    layout.refuse_too_many()
    colours, panels = layout.some_colours(3), layout.shown_panels(3)
    shown = colours, panels, [name for name, *_ in parts]
    places = [(colour, panel) for colour in colours for panel in panels]
    columns = min(3, len(places)) if layout.is_list else len(panels)
    rows = -(-len(places) // columns)
    width = 7.0 if columns == 1 else 2.0 + 3.2 * columns
    legend = _torque_legend(layout, parts, layout.drawn(*shown), width)
    figure = Figure(figsize=(width, 1.6 + 2.4 * rows + legend_height(legend, width)), layout="constrained")
    grid = list(figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False).flat)
    window = (0.0, 360.0) if whole_cycle else event_window(layout, [name for name, *_ in parts])
    limits = []
    for number, (axes, (colour, panel)) in enumerate(zip(grid, places)):
        drawn = [_torque_curve(axes, layout, entry, part, window, unit) for part in parts
                 for entry in layout.entries_of(panel, [colour])]
        limits += drawn
        if not any(drawn):
            say_no_result(axes)
        angle_axis(axes, window, labelled=number + columns >= len(places))
        if number < columns:
            crank_axis(axes, layout)
        names = [layout.name(layout.colour_key, colour) if len(layout.colours) > 1 else "",
                 layout.panel_name(panel) if len(layout.panels) > 1 else ""]
        axes.set_title("\n".join(textwrap.wrap(", ".join(filter(None, names)), 42)), fontsize="medium")
        if number % columns == 0:
            axes.set_ylabel(f"torque [{unit}]")
    known = [pair for pair in limits if pair]
    for axes in grid[:len(places)]:
        set_values_axis(axes, CURVES["total_torque"],
                        (min(pair[0] for pair in known), max(pair[1] for pair in known)) if known else None)
    for axes in grid[len(places):]:
        axes.remove()
    head(figure, layout, title, legend, layout.shown_words(*shown) + layout.turn_words(), shown[2])
    return figure


def _torque_legend(layout, parts, drawn, width):
    """The parts, in the colours of each file that is drawn and has them, in a figure of some width [inch]."""
    there = {number: layout.results[number].series for number in layout.files if number in {entry.file for entry in drawn}}
    entries = {number: [Line2D([], [], color=tones[place % len(tones)], linestyle=dash if len(layout.files) == 1 else line_style(place),
                               linewidth=broad, label=source_words(layout, label)) for name, label, tones, dash, broad in parts if name in there[number]]
               for place, number in enumerate(layout.files) if number in there}
    return (next(iter(entries.values()), []), None) if len(layout.files) == 1 else file_legend(layout, entries, width)


def _torque_curve(axes, layout, entry, part, window, unit):
    series, _, tones, dash, width = part
    values = values_of(layout, entry, series, unit)
    if values is None:
        return None
    angle, values = closed(layout.results[entry.file].cam_angle, values)
    place = layout.files.index(entry.file)
    if len(layout.files) > 1:
        dash = line_style(place)
    axes.plot(angle, values, color=tones[place % len(tones)], linestyle=dash, linewidth=width)
    return seen_range(angle, values, window)


def overview_figure(layout, wanted, parts, needed=()):
    """Several quantities on one page: a row for each and a column for each value of the second swept key, with bars below."""
    need_series(layout, *needed)
    curves = [curve for curve in wanted.values() if has_series(layout, curve.series) and not is_nothing(layout, curve.series)]
    bars = [part for part in parts if _has_summary(layout, part)]
    if not curves:
        raise Missing("none of its series in the file" + ("s" if len(layout.files) > 1 else ""))
    layout.refuse_too_many()
    panels = layout.shown_panels(MOST_COLUMNS)
    columns = len(panels) if len(panels) > 1 else 2
    rows = len(curves) if len(panels) > 1 else -(-len(curves) // columns)
    shown = layout.shown_colours(), panels, [curve.series for curve in curves]
    width = 2.0 + 3.2 * columns
    legend = legend_handles(layout, layout.drawn(*shown), width)
    together = layout.is_list and len(bars) > 1 and len(layout.files) == 1
    below = max([legend_inches(part, layout, width if together else width / len(bars)) for part in bars], default=0.0)
    heights = [1.5 + 1.5 * rows + legend_height(legend, width), (lying_height(layout) or 2.6 + 0.8 * len(layout.files)) + below]
    figure = Figure(figsize=(width, sum(heights[:1 + bool(bars)])), layout="constrained")
    upper, lower = figure.subfigures(2, 1, height_ratios=heights) if bars else (figure, None)
    _overview_curves(upper, layout, curves, panels, (rows, columns))
    head(upper, layout, "", legend, _left_out(layout, layout.shown_words(*shown), bars) + layout.turn_words(),
         shown[2] + [name for part in bars for name in MEANS[part]])
    if together:
        both_bars(lower, layout)
        return figure
    for part, place in zip(bars, np.atleast_1d(lower.subfigures(1, len(bars))) if bars else []):
        part(place, layout)
    return figure


def _left_out(layout, of_curves, bars):
    """What curves and bars of an overview leave out, in words."""
    of_bars = _left_out_of_bars(layout) if bars else of_curves
    if of_curves == of_bars:
        return of_curves
    return [f"in the curves {words}" for words in of_curves] + [f"in the bars {words}" for words in of_bars]


def _left_out_of_bars(layout):
    """What bars leave out."""
    colours, panels = shown_in_bars(layout)
    return layout.shown_words(colours, panels)


def lying_height(layout):
    """Height of a chart of lying bars [inch]; 0 for upright ones."""
    if not layout.is_list:
        return 0.0
    lines = sum(1.0 + len(label) // 45 for label in layout.colours)
    return 1.2 + max(0.22 * len(layout.files), 0.2) * lines + 0.4 * len(layout.files)


def _overview_curves(figure, layout, curves, panels, shape):
    grid = figure.subplots(*shape, squeeze=False)
    window = event_window(layout, [curve.series for curve in curves])
    places = list(grid.flat)
    for axes in places[len(curves) * len(panels):]:  # an odd number of curves in two columns
        axes.remove()
    for number, curve in enumerate(curves):
        row = places[number * len(panels):(number + 1) * len(panels)]
        limits = [draw_curve(axes, layout, curve, panel, window) for axes, panel in zip(row, panels)]
        for axes, panel, pair in zip(row, panels, ranges_of(curve, limits)):
            set_values_axis(axes, curve, pair)
            mark_values(axes, curve)
            angle_axis(axes, window, labelled=places.index(axes) + shape[1] >= len(curves) * len(panels))
            if number == 0 and len(panels) > 1:
                axes.set_title(wrapped(layout.panel_name(panel), TITLE), fontsize="medium")
        row[0].set_ylabel(f"{curve.title}\n[{unit_words(curve.unit)}]")
    figure.align_ylabels()


def _has_summary(layout, part):
    return any(name in layout.results[number].summary for number in layout.files for name in MEANS[part])


def bars_figure(part, title, layout):
    """A bar chart as a figure of its own."""
    if not _has_summary(layout, part):
        raise Missing("no means of it in the file" + ("s" if len(layout.files) > 1 else ""))
    layout.refuse_too_many(MOST_BARS)
    rows = len(layout.files) if part is torque_bars else 1
    height = 0.6 + lying_height(layout) if layout.is_list else 2.6 + 1.9 * rows
    height += legend_inches(part, layout, BARS_WIDTH)
    figure = Figure(figsize=(BARS_WIDTH, height), layout="constrained")
    part(figure, layout)
    head(figure, layout, title, ([], None), _left_out_of_bars(layout), MEANS[part])
    return figure


def _curve_drawer(curve):
    return lambda layout, whole_cycle: curve_figure(curve, layout, whole_cycle)


FIGURES = {
    "overview": lambda layout, _: overview_figure(layout, OVERVIEW, (slip_bars, torque_bars)),
    "train": lambda layout, _: overview_figure(layout, TRAIN, (), ("load_error",)),
    **{name: _curve_drawer(curve) for name, curve in CURVES.items() if name != "total_torque"},
    "roller": roller_figure,
    "running_in": running_in_figure,
    "drive_torque": torque_figure,
    "friction_sources": lambda layout, whole: torque_figure(layout, whole, PARTS, "friction torque by source", "N mm"),
    "mean_slip": lambda layout, _: bars_figure(slip_bars, "mean slip ratio", layout),
    "mean_torque": lambda layout, _: bars_figure(torque_bars, "mean friction torque by source", layout),
    "dampers": dampers_figure,
    "turns": turns_figure,
}
#: Figures of what a file has without series as well
WITHOUT_SERIES = ("running_in", "mean_slip", "mean_torque", "dampers", "turns")
