"""Load per length along the roller at some cam angles, from the series of its slices (`slice_series = .true.` in &roller_profile)."""

import re
import textwrap

from matplotlib.figure import Figure
import numpy as np

from layout import line_style
from parts import MOST_PANELS, event_window, head
from quantities import Missing, values_of

SLICE = re.compile(r"line_load_(\d+)$")
TITLE = 42  # characters of a line of a panel's title
MOST_ANGLES = 5  # in a panel: the base circle, then those of the event from the first to the last


def slices_of(layout, entry):
    """Loads per length of all slices of a case [N/mm], shape (slice, cam angle); None where the file has none."""
    names = sorted((name for name in layout.results[entry.file].series if SLICE.match(name)), key=lambda name: int(SLICE.match(name)[1]))
    return np.array([values_of(layout, entry, name, "N/mm") for name in names]) if names else None


def chosen_angles(layout, entry, total):
    """Places among the cam angles: the middle of the base circle, the largest load of the event, and between."""
    angle = layout.results[entry.file].cam_angle
    first, last = event_window(layout)
    inside = np.flatnonzero((angle >= first) & (angle <= last))
    if inside.size == angle.size:
        return np.linspace(0, angle.size - 1, MOST_ANGLES).astype(int)
    base = int(np.argmin(np.abs((angle - 0.5 * (first + last)) % 360.0 - 180.0)))
    event = inside[np.linspace(0, inside.size - 1, MOST_ANGLES).astype(int)[1:-1]]
    return np.unique([base, *event, inside[int(np.argmax(total[inside]))]])


def roller_figure(layout, _whole_cycle=None):
    """Load per length over the place along the roller, a panel for each case."""
    layout.refuse_too_many()
    entries = [entry for entry in layout.entries if slices_of(layout, entry) is not None]
    if not entries:
        raise Missing("series line_load_1 and so on: slice_series = .true. in &roller_profile")
    most = max(1, MOST_PANELS // len(layout.files))
    colours = layout.some_colours(most)
    panels = layout.shown_panels(max(1, most // len(colours)))
    entries = [entry for entry in entries if entry.colour in colours and entry.panel in panels]
    columns = min(len(entries), 2)
    rows = -(-len(entries) // columns)
    figure = Figure(figsize=(7.5, 1.0 + 2.7 * rows), layout="constrained")
    grid = list(figure.subplots(rows, columns, squeeze=False, sharex=True).flat)
    for axes in grid[len(entries):]:
        axes.remove()
    for number, (axes, entry) in enumerate(zip(grid, entries)):
        loads = slices_of(layout, entry)
        places = (np.arange(loads.shape[0]) + 0.5) / loads.shape[0] - 0.5
        angle = layout.results[entry.file].cam_angle
        for place, at in enumerate(chosen_angles(layout, entry, loads.sum(axis=0))):
            axes.plot(places, loads[:, at], linestyle=line_style(place), label=f"{angle[at]:g}°")
        axes.set_title(textwrap.fill(layout.entry_words(entry), TITLE), fontsize="medium")
        axes.set_ylim(bottom=0.0)
        axes.legend(title="cam angle", fontsize="x-small", title_fontsize="x-small", handlelength=3.0)
        if number % columns == 0:
            axes.set_ylabel("load per length [N/mm]")
        if number + columns >= len(entries):
            axes.set_xlabel("place along the roller over its length")
    head(figure, layout, "load along the roller", ([], None), layout.shown_words(colours, panels) + layout.turn_words(), ["line_load"])
    return figure
