"""Colours, line styles and panels: the arrangement that all figures share.

Where the cases are a grid, colours distinguish the values of the first swept key of the deck, panels those of the others; where a
sweep has more values than a figure can show, evenly spread ones are drawn, the first and the last among them. Any other set of
cases (lists side by side, rows of a table, samples) is a list: each case has a colour and a label of its own, and more of them
than a figure can hold are refused. Families of colours and line styles distinguish several files.
"""

from dataclasses import dataclass
import re

from matplotlib import colormaps
import numpy as np

from cases import failure_lines, lost_contact, lost_contact_words, missing_words, not_computed_words, status_of
from quantities import SPEED, add_derived, given_shaft
from read import ResultError
from units import WORDS, bare_name, distinct_texts, key_words, unit_words, with_unit

# Told apart by their lightness alone too, for grey print and for colour-blind readers.
THREE_COLOURS = ["#440154", "#21918c", "#7ad151"]  # none of them that of a source of friction beside it
FAMILIES = ["Blues", "Oranges", "Greens", "Purples", "Greys", "Reds"]  # of the files, dark to light in each
LINE_STYLES = ["-", "--", "-.", ":", (0, (6, 1, 1, 1, 1, 1)), (0, (1, 2.5)), (0, (8, 3))]
MOST_COLOURS = 7
MOST_LISTED = 12  # cases of a list in a figure of curves
TAKEN = {"largest": np.max, "smallest": np.min, "mean": np.mean}  # of the values of several cases that count as one
POINT = (SPEED, "operating_point.oil_temperature_degC")
LONGEST_TITLE = 100  # characters of a file's title beside those of others
LIST = "case"  # stands for the swept keys where each case has a label of its own


class TooMany(ResultError):
    """A list has more cases than a figure can hold."""


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
        for result in results:
            result.need_results()
            add_derived(result)
        keys = list(dict.fromkeys(key for result in results for key in result.sweep))
        self.colour_key, self.panel_keys = (keys[0], keys[1:]) if keys else (None, [])
        points = _differing_points(results, keys)
        self.units = {key: _unit(key, results) for key in (*keys, *points)}
        self.short_names = _short_names([*keys, *points], results)
        self.entries = []
        self.failed = [{case for case, _ in result.failed_cases()} for result in results]
        self.chosen = [chosen_cases(result, selections) for result in results]
        for number, result in enumerate(results):
            for case in self.chosen[number]:
                self.entries.append(Entry(number, case, _plain(result, self.colour_key, case),
                                          tuple(_plain(result, key, case) for key in self.panel_keys)))
        if not self.entries:
            raise ResultError("no case is left to draw: see --cases")
        self.remarks = self._leave_out_cases_without_series()
        self.colours = _in_order(entry.colour for entry in self.entries)
        self.panels = _in_order(entry.panel for entry in self.entries)
        self._texts = {key: _texts({_plain(result, key, case) for result in results for case in range(result.cases)})
                       for key in (*keys, *points)}
        self.listed_keys = []
        if not self._is_grid():
            self._become_list(keys)
        self.files = sorted({entry.file for entry in self.entries})
        self.titles = self._titles(points)

    def _titles(self, points):
        """Title of each file and these values of its operating point; the file's name goes with it where titles repeat."""
        if len(self.results) == 1:
            return [self.results[0].title]
        titles = [_shortened(result.title) for result in self.results]
        named = [title if titles.count(title) == 1 else f"{title} ({result.path.name})" for title, result in zip(titles, self.results)]
        shafts = [_shaft(result) for result in self.results]
        of_shaft = [[f"speed of the {shaft}"] if len(set(shafts)) > 1 else [] for shaft in shafts]
        return [", ".join([words, *(self.name(key, _plain(result, key, 0)) for key in points), *of_it])
                for words, result, of_it in zip(named, self.results, of_shaft)]

    def entry_words(self, entry):
        """What tells a case from the others: title of its file, value of the first key, those of the panel."""
        words = [self.titles[entry.file] if len(self.files) > 1 else "",
                 self.name(self.colour_key, entry.colour) if len(self.colours) > 1 else "",
                 self.panel_name(entry.panel) if len(self.panels) > 1 else ""]
        return ", ".join(filter(None, words))

    def _leave_out_cases_without_series(self):
        """Cases whose series a sweep has not kept go, where it has kept those of others; returns a line for each such file."""
        remarks = []
        for number, result in enumerate(self.results):
            there = set(result.cases_with_series())
            if not result.series or len(there | self.failed[number]) == result.cases:
                continue
            kept = [entry for entry in self.entries if entry.file != number or entry.case in there]
            if not any(entry.file == number for entry in kept):
                raise ResultError(f"{result.path}: {'; '.join(self._reasons_without_series(number, sorted(there)))}")
            self.entries = kept
            remarks.append(f"{result.path}: series of {len(there)} of {result.cases} cases are in the file; only these are drawn")
        return remarks

    def _reasons_without_series(self, number, there):
        """Why none of the chosen cases of a file has series: they were not computed or failed, or only others were to be kept."""
        result, chosen = self.results[number], self.chosen[number]
        reasons = [words for words in (not_computed_words(status_of(result)[chosen]), *failure_lines(result, chosen)) if words]
        if set(chosen) <= self.failed[number]:
            return reasons
        which = "the other chosen" if reasons else "these"
        return [*reasons, f"no series of {which} cases in the file; it has those of {some_numbers(there) or 'none'}: "
                "'series' and 'series_cases' in &sweep choose"]

    def _is_grid(self):
        """Is every value of the first key there with every panel, once in a file?"""
        places = [(entry.file, entry.colour, entry.panel) for entry in self.entries]
        return len(set(places)) == len(places) and \
            len({place[1:] for place in places}) == len(self.colours) * len(self.panels)

    def _become_list(self, keys):
        """Give each set of swept values a label of its own, in the place of values and panels."""
        entries = [entry for entry in self.entries if self._has_result(entry)]
        if not entries:
            raise ResultError("no case has a result")
        values = [dict(zip(keys, (entry.colour, *entry.panel))) for entry in entries]
        self.listed_keys = [key for key in keys if len({value[key] for value in values}) > 1]
        places = [(entry.file, tuple(value.values())) for entry, value in zip(entries, values)]
        numbered = len(set(places)) < len(places)
        labels = [", ".join([f"case {entry.case}"] * (numbered or not self.listed_keys)
                            + [self._listed_name(key, value[key]) for key in self.listed_keys])
                  for entry, value in zip(entries, values)]
        self.common = {key: values[0][key] for key in keys if key not in self.listed_keys}
        self.entries = [Entry(entry.file, entry.case, label, ()) for entry, label in zip(entries, labels)]
        self.colours, self.panels = list(dict.fromkeys(labels)), [()]
        self.colour_key, self.panel_keys = LIST, []
        self.units[LIST] = ""
        self.short_names[LIST] = "case"

    def _listed_name(self, key, value):
        """A value in the label of a case, with the key's name where the unit does not tell which it is."""
        name, unit = self.name(key, value), self.units[key]
        alike = [other for other in self.listed_keys if self.units[other] == unit]
        return f"{self.short_names[key]} {name}" if unit and len(alike) > 1 else name

    @property
    def is_list(self):
        """Has each case a label of its own?"""
        return self.colour_key == LIST and len(self.colours) > 1

    def refuse_too_many(self, most=MOST_LISTED):
        """TooMany where a list has more cases than a figure can hold."""
        if self.is_list and len(self.colours) > most:
            raise TooMany(f"{len(self.colours)} cases that are no grid are too many for this figure, which holds {most}: "
                          f"choose with --cases 0,3,7-9 or --cases {_example(self)}; plot_sweep.py draws summaries of all")

    def some_colours(self, most):
        """At most so many values of the colour key; all of a list."""
        return list(self.colours) if self.is_list else self._some(self.colours, most, lambda entry: entry.colour)

    def shown_colours(self):
        """Values of the colour key that fit into one panel."""
        return self.some_colours(MOST_COLOURS)

    def colours_of(self, file):
        """Values of the colour key that a file has a colour for: of those that are shown its own."""
        own = {entry.colour for entry in self.entries if entry.file == file}
        return [value for value in self.shown_colours() if value in own]

    def drawn(self, colours, panels, series=()):
        """Cases with a curve: those with a result that have one of these colours, one of these panels and one of these series."""
        return [entry for entry in self.entries if entry.colour in colours and entry.panel in panels and self._has_result(entry)
                and (not series or any(name in self.results[entry.file].series for name in series))]

    def _has_result(self, entry):
        return entry.case not in self.failed[entry.file]

    def _some(self, values, most, value_of):
        """At most so many values, evenly spread among those that some case with a result has, and of every file one at least."""
        of_files = [{value_of(entry) for entry in self.entries if entry.file == file and self._has_result(entry)} for file in self.files]
        there = set().union(*of_files)
        return list(values) if len(values) <= most else \
            thin_out([value for value in values if value in there] or values, most, of_files)

    def shown_panels(self, most):
        """At most so many panels: of each of their keys evenly spread values, each with all of the others, so that neighbours are the
        same in all keys but one. Numbers are left out before names."""
        if len(self.panels) <= most:
            return list(self.panels)
        values = self._panel_values(self.panels)
        if np.prod([len(of_key) for of_key in values]) > len(self.panels):
            return self._some(self.panels, most, lambda entry: entry.panel)
        counts = [len(of_key) for of_key in values]
        while np.prod(counts) > most:
            longest = max(range(len(counts)), key=lambda key: (counts[key] > 2, isinstance(values[key][0], float), counts[key]))
            counts[longest] -= 1
        values = [self._some(of_key, count, lambda entry, key=key: entry.panel[key])
                  for key, (of_key, count) in enumerate(zip(values, counts))]
        return [panel for panel in self.panels if all(value in of_key for value, of_key in zip(panel, values))]

    def _panel_values(self, panels):
        """Values of each key of the panels."""
        return [_in_order(panel[place] for panel in panels) for place in range(len(self.panel_keys))]

    def shown_words(self, colours, panels, series=()):
        """What is left out where these values of the first key and these panels are shown, of these series: values of each key, files."""
        words = [] if len(colours) >= len(self.colours) else \
            [f"{len(colours)} of {len(self.colours)} values of {self.short_names.get(self.colour_key)} shown"]
        there = {entry.file for entry in self.drawn(colours, panels, series)}
        words += [f"nothing of {self.titles[file]}" for file in self.files if file not in there and len(self.files) > 1]
        if len(panels) == len(self.panels):
            return words
        parts = [(len(some), len(of_key), key) for some, of_key, key
                 in zip(self._panel_values(panels), self._panel_values(self.panels), self.panel_keys)]
        if np.prod([of_all for _, of_all, _ in parts]) > len(self.panels):
            return [*words, f"{len(panels)} of {len(self.panels)} pairs of {self.panel_words()} shown"]
        return words + [f"{some} of {of_all} values of {self.short_names[key]} shown" for some, of_all, key in parts if some < of_all]

    def entries_of(self, panel, colours=None):
        """Cases that belong into a panel, all or only those of some values of the colour key."""
        return [entry for entry in self.entries
                if entry.panel == panel and (colours is None or entry.colour in colours)]

    def is_one_each(self):
        """Does each file have one colour, as there is one value of the colour key?"""
        return self.colour_key is None or (len(self.files) > 1 and len(self.shown_colours()) == 1)

    def tones(self, file, values):
        """Colours of a file for these values of the colour key."""
        place = self.files.index(file)
        if self.is_one_each():
            return [spread_colours(len(self.files))[place]] * len(values)
        return family(place, len(values)) if len(self.files) > 1 else spread_colours(len(values))

    def style(self, entry):
        """Colour, line style and width of the curve of one case."""
        shown = self.colours_of(entry.file) if len(self.files) > 1 else self.shown_colours()
        index = shown.index(entry.colour)
        return {"color": self.tones(entry.file, shown)[index],
                "linestyle": line_style(self.files.index(entry.file) if len(self.files) > 1 else index), "linewidth": 1.4}

    def name(self, key, value):
        """A value of a swept key as people write it: `300 rev/min`."""
        if value is None:
            return f"{self.short_names[key]} not given"
        if isinstance(value, str):
            return value
        unit, text = self.units[key], self._texts[key][value]
        return f"{text} {unit}" if unit else f"{self.short_names[key]} {text}"

    def text(self, key, value):
        """A value of a swept key without its unit."""
        return "" if value is None else value if isinstance(value, str) else self._texts[key][value]

    def panel_name(self, panel):
        """Title of a panel, of the keys that differ between panels; empty without a second swept key."""
        return ", ".join(self.name(key, value) for place, (key, value) in enumerate(zip(self.panel_keys, panel))
                         if len(self.panels) == 1 or self._differs(place))

    def _differs(self, place):
        """Do the panels differ in this one of their keys?"""
        return len({panel[place] for panel in self.panels}) > 1

    def panel_words(self):
        """Names of the keys that make the panels."""
        return " and ".join(self.short_names[key] for place, key in enumerate(self.panel_keys) if self._differs(place))

    def axis_name(self, key):
        """Label of an axis along a swept key."""
        return with_unit(self.short_names[key], self.units[key])

    def turn_words(self):
        """Of which turns curves and means are, where trains do not repeat every turn."""
        cases = [(self.results[entry.file], entry.case) for entry in self.entries if self._has_result(entry)]
        periods = [(period, result.turn_count(case)) for result, case in cases if (period := result.period(case)) is not None]
        without, several = ([turns for turns in periods if is_it(turns[0])] for is_it in (lambda n: n == 0, lambda n: n > 1))
        words = []
        for found, what, curves in ((without, "no period", "the last"), (several, "a period of several turns", "one")):
            counts = {count for _, count in found}
            where = f" in {len(found)} of {len(self.entries)} cases" if len(found) < len(self.entries) else ""
            of_all = f"of {counts.pop()} turns" if len(counts) == 1 and 0 not in counts else "of the turns"
            words += [f"{what}{where}: curves are {curves} {of_all}, means of all"] * bool(found)
        return words

    def common_words(self):
        """What all cases have in common, how many of them have no result, and how many have lost contact, with which lobe."""
        words = [self.name(key, value) for key, value in self.common.items()] if self.is_list else []
        words += [self.name(key, self.panels[0][place]) for place, key in enumerate(self.panel_keys)
                  if len(self.panels) > 1 and not self._differs(place)]
        words += missing_words([status for result, chosen in zip(self.results, self.chosen) for status in status_of(result)[chosen]])
        lost_of = [lost_contact(result) for result in self.results]
        lost = {lobe: [lobe in lost_of[entry.file] and lost_of[entry.file][lobe][entry.case] for entry in self.entries]
                for lobe in set().union(*lost_of)}
        return words + lost_contact_words(lost)


def _example(layout):
    """A selection that a reader can change: a range over the first key whose values are numbers."""
    for key in layout.listed_keys:
        values = [layout.results[entry.file].value_of(key, entry.case) for entry in layout.entries]
        if all(isinstance(value, (int, float)) for value in values):
            low, high = min(values), max(values)
            return f"{key.rpartition('.')[2]}={low:.4g}:{low + 0.2 * (high - low):.4g}"
    return "KEY=VALUE"


def some_numbers(cases, most=8):
    """Some numbers in words."""
    return ", ".join(map(str, cases[:most])) + (" ..." if len(cases) > most else "")


def chosen_cases(result, selections):
    """Indices of the cases that fit all selections: `0,2-4`, `speed_rpm=300,600` or `speed_rpm=300:600`."""
    cases = list(range(result.cases))
    for selection in selections:
        name, equals, wanted = selection.rpartition("=")
        if equals:
            key = key_meant(name.strip(), result.sweep, result.deck)
            if key is None:
                swept = ", ".join(result.sweep) or "none"
                raise ResultError(f"--cases: '{name.strip()}' is not one key of the deck in {result.path} (swept keys: {swept})")
            cases = [case for case in cases if is_one_of(result.value_of(key, case), wanted)]
        else:
            indices = _indices(selection, result)
            cases = [case for case in cases if case in indices]
    return cases


def groups_over(result, cases, over):
    """Swept keys meant by these names, and the cases that differ in them only, group by group; each by itself without names."""
    gone = [key_meant(name, result.sweep) for name in over]
    if None in gone:
        raise ResultError(f"{result.path}: --over: '{over[gone.index(None)]}' is not one of the swept keys: "
                          f"{', '.join(result.sweep) or 'there is none'}")
    kept = [quantity.values.tolist() for key, quantity in result.sweep.items() if key not in gone]
    groups = {}
    for case in cases:
        groups.setdefault(tuple(column[case] for column in kept) if gone else case, []).append(case)
    return gone, list(groups.values())


def key_meant(name, *groups):
    """The key meant by its name, its last part, or that without the unit, in the first group that has one of these; else None."""
    for known in groups:
        keys = [key for key, quantity in known.items()
                if name in (key, key.rpartition(".")[2], bare_name(key.rpartition(".")[2], quantity.units))]
        if len(keys) == 1:
            return keys[0]
    return None


def thin_out(values, most, groups=()):
    """At most so many of the values, evenly spread, ends included: at the same distance where many may stay and that leaves more than
    half of them. A group none of which is among them gets one, in the place of its neighbour, or beside it where that is the only one of
    another group."""
    last = len(values) - 1
    if last < most:
        return list(values)
    distances = [distance for distance in range(1, last + 1)
                 if most > MOST_COLOURS and last % distance == 0 and most // 2 < last // distance + 1 <= most]
    places = set(range(0, last + 1, distances[0]) if distances else np.linspace(0, last, most).round().astype(int).tolist())
    groups = [{place for place, value in enumerate(values) if value in group} for group in groups]
    for group in (group for group in groups if group):
        if group & places:
            continue
        wanted = min(sorted(group), key=lambda place: min(abs(place - other) for other in places))
        spare = [place for place in sorted(places)
                 if all(other & ((places - {place}) | {wanted}) for other in groups if other & places)]
        places -= {min(spare, key=lambda place: abs(place - wanted))} if spare else set()
        places |= {wanted}
    return [values[place] for place in sorted(places)]


def wrapped(text, width):
    """Text in lines of at most so many characters, where its words are not longer: they may end behind an underscore, too."""
    lines = [""]
    for word in re.findall(r"[^ _]*[ _]|[^ _]+$", text):
        if lines[-1] and len((lines[-1] + word).rstrip()) > width:
            lines.append("")
        lines[-1] += word
    return "\n".join(line.rstrip() for line in lines)


def spread_colours(count):
    """So many colours, dark to light."""
    if count <= len(THREE_COLOURS):
        return THREE_COLOURS[:count]
    return [colormaps["viridis"](value) for value in np.linspace(0.0, 0.88, count)]


def family(place, count):
    """So many colours of one file, dark to light."""
    shades = colormaps[FAMILIES[place % len(FAMILIES)]]
    return [shades(value) for value in np.linspace(0.9, 0.4, count)]


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


def _shortened(title):
    """A title that leaves room for others."""
    return title if len(title) <= LONGEST_TITLE else title[:LONGEST_TITLE - 1].rstrip() + "\N{HORIZONTAL ELLIPSIS}"


def _differing_points(results, swept):
    """Keys of the operating point in which files differ while none varies them."""
    return [key for key in POINT if key not in swept and len({_plain(result, key, 0) for result in results}) > 1]


def _texts(values):
    """Text of each number of a key."""
    numbers = sorted(value for value in values if isinstance(value, float))
    return dict(zip(numbers, distinct_texts(numbers)))


def _short_names(keys, results):
    """Each key in words and without its unit; the whole key where that is not unique."""
    short = {key: key_words(key, _file_unit(key, results)) for key in keys}
    shafts = {_shaft(result) for result in results}
    if SPEED in short and len(shafts) == 1 and any(map(given_shaft, results)):
        short[SPEED] = f"{shafts.pop()} {short[SPEED]}"
    return {key: name if list(short.values()).count(name) == 1 else key for key, name in short.items()}


def _shaft(result):
    """Shaft whose speed is that of a result."""
    return given_shaft(result) or "camshaft"


def _file_unit(key, results):
    """Unit of a swept key as the files state it."""
    return next((result.sweep[key].units for result in results if key in result.sweep), "")


def _unit(key, results):
    """Unit of a swept key for people: that of the file, else the last word of the key."""
    unit = _file_unit(key, results)
    last = key.rpartition("_")[2]
    return "" if unit in ("1", "-") else unit_words(unit or (last if last in WORDS else ""))


def is_one_of(value, wanted):
    """Is the value among `300,600`, or within a range as `300:600`?"""
    return any(_same(value, text.strip()) for text in wanted.split(","))


def _same(value, text):
    low, colon, high = text.partition(":")
    try:
        if colon:
            return float(low or "-inf") <= float(value) <= float(high or "inf")
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
