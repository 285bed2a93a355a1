"""Parts that the figures share: the cam angle axis, the values axis, curves, legend and heading."""

from dataclasses import replace
import textwrap

from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, LogLocator, MultipleLocator, NullFormatter
import numpy as np

from quantities import curve_of
from units import fitting_unit

NOSE = 180.0  # cam angle of full lift [deg]
MARGIN = 30.0  # shown on each side of the event [deg]
MOST_PANELS = 9
LEGEND_ROW = 0.17  # height [inch]
CHARACTERS = 11.0  # of a legend in an inch
SAMPLE = 7.0  # characters that have room in the place of a line sample and the distance to the next column
LEAST_TITLE = 24  # characters of a line of a file's title above its entries
BUSY = 0.2  # part of a torque's range that is reached outside of the first cam's event where other cams are at work there
WIDE = 100.0  # largest over smallest value of a quantity from which on its axis is logarithmic
ALIKE = 10.0  # panels whose largest values differ by more than this have axes of their own


def event_window(layout, names=()):
    """Cam angles from a little before to a little after the valve is off its seat, over all cases.

    The whole turn where that is not known, or where one of the series named is of a shaft whose other cams are at work outside.
    """
    first, last = 360.0, 0.0
    for result in layout.results:
        lift = result.series.get("valve_lift")
        if lift is None:
            return 0.0, 360.0
        peak = np.nanmax(np.abs(lift.values), initial=0.0)
        open_angles = result.cam_angle[np.any(np.abs(lift.values) > 1e-4 * peak, axis=0)]
        if open_angles.size:
            first, last = min(first, open_angles[0]), max(last, open_angles[-1])
    if first > last:
        return 0.0, 360.0
    window = max(0.0, 10.0 * np.floor((first - MARGIN) / 10.0)), min(360.0, 10.0 * np.ceil((last + MARGIN) / 10.0))
    return (0.0, 360.0) if any(_is_busy_outside(result, name, window) for result in layout.results for name in names) else window


def _is_busy_outside(result, name, window):
    """Does a torque of the shaft vary much outside of the window?"""
    if not name.startswith("torque_") or name not in result.series:
        return False
    values = result.series[name].values
    values = values[np.isfinite(values).all(axis=1)]
    outside = values[:, (result.cam_angle < window[0]) | (result.cam_angle > window[1])]
    return outside.size > 0 and bool((np.ptp(outside, axis=1) > BUSY * np.ptp(values, axis=1)).any())


def closed(angle, values):
    """The cycle with its first point repeated at the end."""
    return np.append(angle, angle[0] + 360.0), np.append(values, values[0])


def angle_axis(axes, window, labelled=True):
    """Cam angle axis with the nose marked."""
    axes.set_xlim(window)
    axes.xaxis.set_major_locator(MultipleLocator(60.0 if window[1] - window[0] > 250.0 else 30.0))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda angle, _: "180\nnose" if angle == NOSE else f"{angle:g}"))
    axes.axvline(NOSE, color="0.6", linewidth=0.7, linestyle=":", zorder=0)
    axes.grid(True, color="0.9", linewidth=0.6)
    axes.set_axisbelow(True)
    axes.tick_params(labelbottom=labelled)
    if labelled:
        axes.set_xlabel("cam angle [deg]")


def crank_axis(axes, layout):
    """Crank angle from the firing dead centre of cylinder 1 along the upper edge, where every result is one of the same engine."""
    known = {tuple(float(result.scalar(name).values[0]) for name in ("crank_turns", "crank_angle_at_nose"))
             if "crank_angle_at_nose" in result.summary else None for result in layout.results}
    if len(known) != 1 or None in known:
        return
    turns, nose = known.pop()
    upper = axes.secondary_xaxis("top")
    upper.xaxis.set_major_locator(axes.xaxis.get_major_locator())
    upper.xaxis.set_major_formatter(FuncFormatter(lambda angle, _: f"{(nose + turns * (angle - NOSE)) % (360.0 * turns):g}"))
    upper.set_xlabel("crank angle [deg]")


def draw_curve(axes, layout, curve, panel, window):
    """All curves of one panel; returns lowest and highest value within the window, None if there is none."""
    low, high = np.inf, -np.inf
    for entry in layout.entries_of(panel, layout.shown_colours()):
        values = curve_of(layout, entry, curve)
        if values is None:
            continue
        angle, values = closed(layout.results[entry.file].cam_angle, values)
        axes.plot(angle, values, **layout.style(entry))
        seen = seen_range(angle, values, window)
        if seen:
            low, high = min(low, seen[0]), max(high, seen[1])
    if low <= high:
        return low, high
    axes.set_yticks([])
    say_no_result(axes)
    return None


def say_no_result(axes):
    """Words in a panel whose cases have no result."""
    axes.annotate("no result", (0.5, 0.5), xycoords="axes fraction", ha="center", color="0.4")


def seen_range(angle, values, window):
    """Lowest and highest of the values within the window; None where there is none."""
    seen = values[(angle >= window[0]) & (angle <= window[1]) & np.isfinite(values)]
    return (seen.min(), seen.max()) if seen.size else None


def ranges_of(curve, limits):
    """Range of the values for each panel: one for all where their sizes are alike or they are shares, so that panels compare."""
    known = [pair for pair in limits if pair]
    if not known:
        return limits
    sizes = [max(abs(low), abs(high)) for low, high in known]
    if curve.scale == "log" or curve.least_top > 0.0 or max(sizes) <= ALIKE * min(sizes):
        return [(min(pair[0] for pair in known), max(pair[1] for pair in known))] * len(limits)
    return limits


def set_values_axis(axes, curve, limits):
    """Range of the upright axis with a little room; logarithmic only where the values differ much and none is zero or negative."""
    if limits is None:
        return
    low, high = max(limits[0], curve.floor) if curve.floor > 0.0 else limits[0], max(limits[1], curve.least_top)
    if curve.least_top > 0.0:  # a share: from nothing to all
        low = min(low, 0.0)
    if curve.scale == "log" and low > 0.0 and high > 3.0 * low:
        log_axis(axes, low, high)
    else:
        linear_axis(axes, low, high)


def mark_values(axes, curve):
    """Thin lines at values that mean something, where they are within the axis."""
    low, high = axes.get_ylim()
    for value in curve.lines:
        if low < value < high:
            axes.axhline(value, color="0.45", linewidth=0.8, linestyle=(0, (5, 3)), zorder=0.9)  # on a line of the grid, too


def least_shown(tops):
    """Where the axis of cases with these largest values ends below: at zero, or logarithmic far below the smallest of them where they differ
    much."""
    tops = np.array([top for top in tops if np.isfinite(top) and top > 0.0])
    return tops.min() / WIDE if tops.size and tops.max() > WIDE * tops.min() else 0.0


def suited(layout, curve):
    """A curve without a unit in the one that suits the values of all cases, on an axis for them; any other as it is."""
    if curve.unit:
        return curve
    found = [(layout.results[entry.file].series[curve.series], entry.case) for entry in layout.entries
             if curve.series in layout.results[entry.file].series]
    tops = [np.nanmax(quantity.values[case], initial=0.0) for quantity, case in found]
    unit, scale = fitting_unit(curve.series, found[0][0].units, tops)
    floor = scale * least_shown(tops)
    return replace(curve, unit=unit, scale="log" if floor else curve.scale, floor=floor)


def log_axis(axes, low, high):
    """Logarithmic axis for positive values."""
    axes.set_yscale("log", nonpositive="mask")
    axes.set_ylim(low / 1.2, high * 1.2)
    axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if high < 300.0 * low else (1.0,)))
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.yaxis.set_minor_formatter(NullFormatter())


def linear_axis(axes, low, high):
    """Linear axis, from zero for values that are not negative."""
    room = 0.05 * (high - low) or 0.05 * abs(high) or 1.0
    axes.set_ylim(0.0 if low >= 0.0 else low - room, high + room)
    if low < 0.0:
        axes.axhline(0.0, color="0.6", linewidth=0.7, zorder=0)


def legend_handles(layout, drawn, width):
    """Legend of the cases that are drawn in a figure of some width [inch], entries and columns: colours by swept value, families of
    colours and line styles by file."""
    if layout.colour_key is None or (len(layout.files) > 1 and len(layout.shown_colours()) == 1):
        first = {entry.file: entry for entry in reversed(drawn)}
        handles = [Line2D([], [], label=layout.titles[number], **layout.style(first[number])) for number in sorted(first)]
        return wrap_labels(handles, width), None
    first = {(entry.file, entry.colour): entry for entry in reversed(drawn)}
    entries = {number: [Line2D([], [], label=layout.name(layout.colour_key, value), **layout.style(first[number, value]))
                        for value in layout.colours_of(number) if (number, value) in first] for number in layout.files}
    if len(layout.files) == 1:
        return wrap_labels(entries[layout.files[0]], width) if len(layout.colours) > 1 else [], None
    return file_legend(layout, {number: own for number, own in entries.items() if own}, width)


def file_legend(layout, entries, width):
    """Legend of several files: the title of each on top of its entries, as many side by side as fit into a figure of some width [inch]."""
    if not entries:
        return [], None
    longest = max(_longest_line(handles) for handles in entries.values())
    least = max(longest, min(LEAST_TITLE, max(len(layout.titles[number]) for number in entries)))
    rows = -(-len(entries) // _columns(len(entries), least, width))
    columns = -(-len(entries) // rows)
    titles = {number: in_lines(layout.titles[number], width / columns) for number in entries}
    lines, most = max(title.count("\n") for title in titles.values()), max(map(len, entries.values()))
    blocks = [[_words(titles[number] + "\n" * (lines - titles[number].count("\n"))), *wrap_labels(own, width / columns),
               *[_words("")] * (most - len(own))]
              for number, own in entries.items()]
    blocks += [[_words("\n" * lines), *[_words("")] * most]] * (rows * columns - len(blocks))
    return [handle for column in range(columns) for block in blocks[column::columns] for handle in block], columns


def in_lines(text, width):
    """A label of a legend, or of a column of one, in lines that fit into some width [inch]."""
    return textwrap.fill(text, max(1, int(CHARACTERS * width - SAMPLE)))


def wrap_labels(handles, width):
    """The handles of a legend, their labels in lines that fit into a figure of some width [inch]."""
    for handle in handles:
        handle.set_label(in_lines(handle.get_label(), width))
    return handles


def head(figure, layout, title, legend, left_out, shown):
    """Top of a page: what it shows, of which file, what is left out of a big sweep, of which cams the quantities are that are shown, and the
    legend."""
    handles, columns = legend
    words = [layout.titles[layout.files[0]]] if len(layout.files) == 1 else []
    if layout.colour_key and len(layout.colours) == 1:
        words.append(layout.name(layout.colour_key, layout.colours[0]))
    if len(layout.panels) == 1 and layout.panel_name(layout.panels[0]):
        words.append(layout.panel_name(layout.panels[0]))
    words += left_out + layout.common_words() + several_cams(layout, shown)
    width = int(11.0 * figure.bbox.width / figure.dpi)
    text = "\n".join([title[:1].upper() + title[1:], *textwrap.wrap(", ".join(words), width)]).strip()
    is_told = len(handles) + len(layout.colours) + len(layout.files) > 3
    legend = figure.legend(handles=handles if is_told else [], title=text, title_fontsize="large",
                           loc="outside upper center", ncols=columns or columns_for(figure, handles), frameon=False)
    legend.get_title().set_multialignment("center")


def _words(label):
    """Words in a legend, without a line."""
    return Line2D([], [], linestyle="none", label=label)


def several_cams(layout, shown):
    """Of which cams the quantities of these names are, where there are several cams: torques of all, anything else of the first."""
    cams = shafts = 1
    for result in layout.results:
        shafts = max(shafts, int(result.deck["engine.camshafts"].values) if "engine.camshafts" in result.deck else 1)
        given = result.deck.get("cam_bearings.cam_positions_mm")
        if given is not None:
            cams = max(cams, len(str(given.values).split(",")) if isinstance(given.values, str) else np.size(given.values))
    if cams * shafts == 1:
        return []
    words = f"{shafts} camshafts with {cams} cam{'s' * (cams > 1)} each" if shafts > 1 else f"{cams} cams"
    are_of_shaft = {name.removeprefix("mean_").startswith("torque_") for name in shown}
    if True not in are_of_shaft:
        return [f"of the first cam of {words}"]
    return [f"torques of {'all ' * (shafts == 1)}{words}" + ", all else of the first cam" * (False in are_of_shaft)]


def legend_height(legend, width):
    """Height of the lines of a legend after the first, in a figure of some width [inch]."""
    handles, columns = legend
    lines = [1 + handle.get_label().count("\n") for handle in handles]
    return LEGEND_ROW * max(0, *(int(part.sum()) - 1 for part in np.array_split(lines, columns or columns_that_fit(handles, width))))


def columns_for(figure, handles):
    """Columns of a legend so that it is not wider than the figure."""
    return columns_that_fit(handles, figure.bbox.width / figure.dpi)


def columns_that_fit(handles, width):
    """Columns of a legend in a figure of some width [inch]."""
    return _columns(len(handles), _longest_line(handles), width)


def _columns(count, longest, width):
    """Columns of a legend with so many entries or blocks, whose longest line has so many characters, in a figure of some width [inch]."""
    return int(max(1, min(count, CHARACTERS * width / (longest + SAMPLE))))


def _longest_line(handles):
    """Characters of the longest line of the labels."""
    return max([len(line) for handle in handles for line in handle.get_label().split("\n")] + [1])
