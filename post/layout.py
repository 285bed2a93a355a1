"""Who gets which colour, line style and panel: the arrangement that all figures share.

The first swept key of the deck is told apart by colour, the other swept keys by panel, several
files by line style. Without a swept key the files are told apart by colour. Where a sweep has more
values than a figure can show, evenly spread ones are drawn, the first and the last among them.
"""

from dataclasses import dataclass

import numpy as np

from read import ResultError

# Told apart by their lightness alone too, for grey print and for colour-blind readers.
THREE_COLOURS = ["#08306b", "#d55e00", "#7cc0ea"]
LINE_STYLES = ["-", "--", "-.", ":", (0, (6, 1, 1, 1, 1, 1)), (0, (1, 2.5)), (0, (8, 3))]
MOST_COLOURS = 7
UNIT_WORDS = {"rpm": "rev/min", "degC": "\N{DEGREE SIGN}C", "deg": "\N{DEGREE SIGN}", "um": "\N{MICRO SIGN}m",
              "Pas": "Pa s", "GPa": "GPa", "MPa": "MPa", "mm": "mm", "kg": "kg", "N": "N"}


@dataclass(frozen=True)
class Entry:
    """One case of one file and its place: value of the colour key, values of the panel keys."""

    file: int
    case: int
    colour: object
    panel: tuple


class Layout:
    """Arrangement of the chosen cases of some results."""

    def __init__(self, results, selections=()):
        self.results = results
        keys = list(dict.fromkeys(key for result in results for key in result.sweep))
        self.colour_key, self.panel_keys = (keys[0], keys[1:]) if keys else (None, [])
        self.short_names = _short_names(keys)
        self.units = {key: _unit(key, results) for key in keys}
        self.entries = []
        for number, result in enumerate(results):
            for case in chosen_cases(result, selections):
                self.entries.append(Entry(number, case, _plain(result, self.colour_key, case),
                                          tuple(_plain(result, key, case) for key in self.panel_keys)))
        if not self.entries:
            raise ResultError("no case is left to draw: see --cases")
        self.colours = _in_order(entry.colour for entry in self.entries)
        self.panels = _in_order(entry.panel for entry in self.entries)
        self.files = sorted({entry.file for entry in self.entries})
        self.titles = _titles(results)

    def shown_colours(self):
        """Values of the colour key that fit into one panel."""
        return thin_out(self.colours, MOST_COLOURS)

    def entries_of(self, panel, colours=None):
        """Cases that belong into a panel, all or only those of some values of the colour key."""
        return [entry for entry in self.entries
                if entry.panel == panel and (colours is None or entry.colour in colours)]

    def style(self, entry):
        """Colour, line style and width of the curve of one case."""
        shown = self.shown_colours()
        several = len(self.files) > 1
        if self.colour_key is None:
            index = self.files.index(entry.file)
            return {"color": spread_colours(len(self.files))[index], "linestyle": line_style(index), "linewidth": 1.4}
        index = shown.index(entry.colour)
        dash = self.files.index(entry.file) if several else index
        return {"color": spread_colours(len(shown))[index], "linestyle": line_style(dash), "linewidth": 1.4}

    def name(self, key, value):
        """A value of a swept key as people write it: `300 rev/min`."""
        if value is None:
            return f"{self.short_names[key]} not given"
        if isinstance(value, str):
            return value
        unit = self.units[key]
        return f"{value:g} {unit}" if unit else f"{self.short_names[key]} {value:g}"

    def panel_name(self, panel):
        """Title of a panel; empty without a second swept key."""
        return ", ".join(self.name(key, value) for key, value in zip(self.panel_keys, panel))

    def panel_words(self):
        """Names of the keys that make the panels."""
        return " and ".join(self.short_names[key] for key in self.panel_keys)

    def axis_name(self, key):
        """Label of an axis along a swept key."""
        unit = self.units[key]
        return f"{self.short_names[key]} [{unit}]" if unit else self.short_names[key]


def chosen_cases(result, selections):
    """Indices of the cases that fit all selections: `0,2-4` or `speed_rpm=300,600`."""
    cases = list(range(result.cases))
    for selection in selections:
        name, equals, wanted = selection.rpartition("=")
        if equals:
            key = _matching_key(result, name.strip())
            texts = [text.strip() for text in wanted.split(",")]
            cases = [case for case in cases if any(_same(result.value_of(key, case), text) for text in texts)]
        else:
            indices = _indices(selection, result)
            cases = [case for case in cases if case in indices]
    return cases


def thin_out(values, most):
    """At most so many of the values, evenly spread, ends included."""
    if len(values) <= most:
        return list(values)
    return [values[index] for index in np.unique(np.linspace(0, len(values) - 1, most).round().astype(int))]


def spread_colours(count):
    """So many colours, dark to light."""
    if count <= len(THREE_COLOURS):
        return THREE_COLOURS[:count]
    from matplotlib import colormaps
    return [colormaps["viridis"](value) for value in np.linspace(0.0, 0.88, count)]


def line_style(index):
    """Line style by number, repeating when they run out."""
    return LINE_STYLES[index % len(LINE_STYLES)]


def _plain(result, key, case):
    value = result.value_of(key, case) if key else None
    return float(f"{value:.10g}") if isinstance(value, (int, float)) else value


def _in_order(values):
    """Distinct values, numbers by size, anything else as it came; what is not given comes last."""
    distinct = list(dict.fromkeys(values))

    def rank(value):
        parts = value if isinstance(value, tuple) else (value,)
        return [(0, part) if isinstance(part, float) else (2 if part is None else 1, distinct.index(value))
                for part in parts]

    return sorted(distinct, key=rank)


def _titles(results):
    """Title of each file; the file's name goes with it where titles repeat."""
    titles = [result.title for result in results]
    return [title if titles.count(title) == 1 else f"{title} ({result.path.name})"
            for title, result in zip(titles, results)]


def _short_names(keys):
    """Last part of each key in words and without its unit; the whole key where that is not unique."""
    short = {key: _without_unit(key.rpartition(".")[2]).replace("_", " ") for key in keys}
    return {key: name if list(short.values()).count(name) == 1 else key for key, name in short.items()}


def _without_unit(name):
    head, _, last = name.rpartition("_")
    return head if head and last in UNIT_WORDS else name


def _unit(key, results):
    """Unit of a swept key for people: that of the file, else the last word of the key."""
    for result in results:
        if key in result.sweep:
            unit = result.sweep[key].units or key.rpartition("_")[2]
            if unit in UNIT_WORDS:
                return UNIT_WORDS[unit]
            return unit if unit not in ("", "1", "-") and result.sweep[key].units else ""
    return ""


def _matching_key(result, name):
    """The swept key, else the deck key, meant by its name, its last part, or that without the unit."""
    for known in (result.sweep, result.deck):
        keys = [key for key in known
                if name in (key, key.rpartition(".")[2], _without_unit(key.rpartition(".")[2]))]
        if len(keys) == 1:
            return keys[0]
    swept = ", ".join(result.sweep) or "none"
    raise ResultError(f"--cases: '{name}' is not one key of the deck in {result.path} (swept keys: {swept})")


def _same(value, text):
    try:
        return abs(float(value) - float(text)) <= 1e-9 * abs(float(text))
    except (TypeError, ValueError):
        return str(value).lower() == text.lower()


def _indices(selection, result):
    indices = set()
    for part in selection.split(","):
        first, _, last = part.partition("-")
        try:
            found = range(int(first), int(last or first) + 1)
        except ValueError:
            raise ResultError(f"--cases: '{part}' is neither a case number, a range nor KEY=VALUES") from None
        if not found or found[-1] >= result.cases:
            raise ResultError(f"--cases: {result.path} has the cases 0 to {result.cases - 1}, not {part}")
        indices.update(found)
    return indices
