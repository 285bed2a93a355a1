"""Draw results of a sweep as functions of the keys that it varies.

    python post/plot_sweep.py results/sweep.h5                              the figure that suits the sweep
    python post/plot_sweep.py FILE --quantity mean_slip_ratio,max_hertz_pressure --figure scatter --output doc/figures
    python post/plot_sweep.py FILE --where 'mean_slip_ratio < 0.01' --where 'speed_rpm >= 600'     only these cases
    python post/plot_sweep.py FILE --over speed_rpm --take largest --where 'mean_slip_ratio < 0.01'  designs that hold this at every speed

`map`: two swept keys as axes, the quantity as colour. `curves`: one key along the axis, the others as curves. `scatter`: every
swept key against every quantity. `parallel`: an axis for each key and quantity, a line for each case, coloured by the last one.
Without --figure a grid of two long keys becomes a map, other grids curves, samples and tables a scatter. Quantities that are all above
zero and differ by more than a factor of a hundred have logarithmic axes. Cases that lose contact have a cross in maps, a circle in
curves and scatters; the title has their number. With --over the cases that differ in these keys only, as
operating points of one design, count as one, with the largest, smallest or mean value; conditions hold for that value. Only the summary
is read, so a file of a hundred thousand cases is drawn as well. Needs no display. Exit code 2 where the file or a name does not suit.
"""

import argparse
from pathlib import Path
import re
import sys
import textwrap

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams.update({"font.size": 9.0, "axes.spines.top": False, "axes.spines.right": False,
                            "axes.formatter.useoffset": False})  # it would stand on the label of its axis

from matplotlib.cm import ScalarMappable  # noqa: E402
from matplotlib.colors import LogNorm, Normalize  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402
from matplotlib.patheffects import withStroke  # noqa: E402
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter  # noqa: E402
import numpy as np  # noqa: E402

from cases import lost_contact, lost_contact_words, missing_words, status_of  # noqa: E402
from command import DPI, ONCE, names_of, script, save_figure, take_over  # noqa: E402
from layout import TAKEN, groups_over, is_one_of, key_meant, some_numbers, thin_out  # noqa: E402
from parts import WIDE  # noqa: E402
from quantities import SPEED, given_shaft  # noqa: E402
from read import ResultError, fills_grid, read_result  # noqa: E402
from units import distinct_texts, fitting_unit, key_words, number, shaft_words, unit_words, with_unit  # noqa: E402

FIGURES = ("map", "curves", "scatter", "parallel")
QUANTITY = "mean_torque_drive"
MOST_CURVES = 8  # with a legend; of numbers more have a colour bar
MOST_COLOURS = 60
MOST_LINES = 2000  # of parallel coordinates; of more cases evenly spread ones are drawn
NEAR = 1e-3  # of the largest value: where all are as near as this, numbers along a lower axis are too long for more than its ends
FREE_TEXTS = ("table", "title")  # keys of the deck whose values are no names of choices
MOST_WORDS = 24  # values of a key that the axis of a map can name
ROUNDING = 1e-9  # part of a quantity within which its values are the same
CONDITION = re.compile(r"^\s*([\w.]+)\s*(?:(<=|>=|<|>)\s*([-+]?[\d.]+(?:[eE][-+]?\d+)?)|=\s*([^=<>]+?))\s*$")
RELATIONS = {"<": np.less, ">": np.greater, "<=": np.less_equal, ">=": np.greater_equal}
PLAIN = FuncFormatter(lambda value, _: f"{value:g}")  # numbers of logarithmic axes
# Cases that lose contact: in maps, and about the points of curves
CROSS = {"marker": "x", "markersize": 4, "linewidth": 0.0, "color": "#d55e00", "markeredgewidth": 0.8, "clip_on": False, "label": "_lost"}
CIRCLE = {"marker": "o", "markersize": 5, "linewidth": 0.0, "markerfacecolor": "white", "label": "_lost"}
SPREAD = 0.18  # of points of a scatter about the word they belong to


class Sweep:
    """What varies in a file and what came of it: columns of numbers, with names of their values where they are words.

    Keys whose range the deck divides by equal ratios are drawn on logarithmic axes.
    """

    def __init__(self, path, quantities, conditions=(), over=(), take="largest"):
        self.keys, self.quantities, self.words, self.logarithmic, self.remarks = {}, {}, {}, set(), []
        result = read_result(path, with_series=False)
        result.need_results()
        self.title, self.take, shaft = result.title, take, given_shaft(result)
        gone, groups = groups_over(result, range(result.cases), over)
        self.groups = groups if gone else None
        if gone:
            names = ", ".join(key.split(".")[-1] for key in gone)
            self.remarks.append(f"{take} over {names}, {result.cases} cases make {len(groups)}")
        of_cases = status_of(result)
        # of a group the error of a case, else that a case was not computed
        self.status = [int(of_cases[group].max() if (of_cases[group] > 0).any() else of_cases[group].min()) for group in groups]
        self.failed = np.not_equal(self.status, 0)
        self.lost = {lobe: np.array([lost[group].any() for group in groups]) for lobe, lost in lost_contact(result).items()}
        for key, quantity in result.sweep.items():
            if key not in gone:
                values = self._numbers(key, quantity.values)[[group[0] for group in groups]]
                label = with_unit(key_words(key, quantity.units), unit_words(quantity.units))
                self.keys[key] = (values, f"{shaft} {label}" if key == SPEED and shaft else label)
                if _is_logarithmic(result, key) and (values > 0).all():
                    self.logarithmic.add(key)
        if not self.keys:
            raise ResultError(f"nothing{' else' * bool(gone)} varies in {path}; plot.py draws its curves, table.py prints its means")
        kept = self._kept(result, conditions)
        for name in quantities:
            self._add(result, name, kept)
        if not any(np.isfinite(values).any() for values, _ in self.quantities.values()):
            infinite = any(np.isinf(values).any() for values, _ in self.quantities.values())
            raise ResultError(f"{path}: no case has a {'finite ' * infinite}value of {', '.join(self.quantities)}"
                              + "; infinity stands for a limit that is never reached" * infinite)

    def _add(self, result, name, kept):
        """A scalar of the summary, without number for the cases that are not kept."""
        quantity = result.scalar(name)
        values = self._numbers(name, self._taken(name, quantity.values))
        unit, label, shaft = quantity.units, key_words(name, quantity.units), shaft_words(result.summary, name, quantity.units)
        if name not in self.words:
            unit, scale = fitting_unit(name, unit, values)
            values, label = values * scale, (f"{self.take} {name}" if self.groups else name).replace("_", " ")
        values = np.where(kept, values, np.nan)
        self.quantities[name] = (values, with_unit(label + shaft, unit_words(unit)))
        known = values[np.isfinite(values)]
        if name not in self.words and known.size and known.min() > 0 and known.max() > WIDE * known.min():
            self.logarithmic.add(name)

    def _kept(self, result, conditions):
        """Which cases meet every condition, as `mean_slip_ratio < 0.01` or `law = moes`, in the units of the file."""
        kept = np.ones(len(self.failed), dtype=bool)
        for condition in conditions:
            found = CONDITION.match(condition)
            if not found:
                raise ResultError(f"--where takes NAME < NUMBER, or with >, <= or >=, or NAME=VALUES, not '{condition}'")
            name, relation, limit, wanted = found.groups()
            key = None if name in result.summary else key_meant(name, result.sweep)
            if key is None and name not in result.summary:
                raise ResultError(f"{result.path} has no summary and no key '{name}' to choose cases by")
            values = self._taken(name, (result.sweep[key] if key else result.scalar(name)).values)
            if relation and values.dtype.kind in "US":
                raise ResultError(f"{result.path}: {name} holds words: --where {name}=WORD chooses by them")
            if relation:
                kept &= RELATIONS[relation](values, float(limit))
            else:
                kept &= [is_one_of(value, wanted) for value in values]
        if conditions:
            if not kept.any():
                raise ResultError(f"{result.path}: no case has {' and '.join(conditions)}")
            self.remarks.append(f"{kept.sum()} of {len(kept)} cases have {' and '.join(conditions)}")
        return kept

    def _numbers(self, name, values):
        """The values, of words their places in the list of different ones."""
        if values.dtype.kind in "US":
            self.words[name], values = np.unique(values, return_inverse=True)
        return np.asarray(values, dtype=float)

    def _taken(self, name, values):
        """One value for each group of cases: none where a case of it has none, of words the one that all cases of it have."""
        if self.groups is None:
            return values
        if values.dtype.kind not in "US":
            return np.array([TAKEN[self.take](values[group]) for group in self.groups])
        if any(len(set(values[group])) > 1 for group in self.groups):
            raise ResultError(f"{name} holds words, of which --over can take no {self.take} one")
        return np.array([values[group[0]] for group in self.groups])

    def lengths(self):
        """Number of different values of each key."""
        return {key: len(np.unique(values)) for key, (values, _) in self.keys.items()}

    def is_grid(self):
        """Is every value there with every other?"""
        return fills_grid([values.tolist() for values, _ in self.keys.values()], len(self.failed))

    def is_drawn_lost(self, names):
        """Cases that lose contact and have a value of one of these quantities."""
        lost = np.any([*self.lost.values(), np.zeros(len(self.failed), dtype=bool)], axis=0)
        return lost & np.any([np.isfinite(self.quantities[name][0]) for name in names], axis=0)

    def has_value(self):
        """Cases that have a value of one of the quantities, as the conditions leave them."""
        return np.any([np.isfinite(values) for values, _ in self.quantities.values()], axis=0)

    def column(self, name):
        """Values and label of a key or a quantity."""
        return self.keys.get(name) or self.quantities[name]

    def label_value(self, key, value):
        """A value of a key or a quantity in words."""
        if key in self.words:
            word = str(self.words[key][int(value)])
            return word if key.rpartition(".")[2] in FREE_TEXTS else word.replace("_", " ")
        if key in self.quantities:
            return number(value)
        values = np.unique(self.keys[key][0])
        return distinct_texts(values.tolist())[int(np.searchsorted(values, value))] if len(values) <= MOST_WORDS else f"{value:.4g}"


def _words(result, key):
    """Value of a key of the deck that holds words; blank where it has none."""
    return str(result.deck[key].values) if key in result.deck else ""


def _is_logarithmic(result, key):
    """Does the deck divide the range of a key by equal ratios?"""
    place = next((name.split("_")[-1] for name in result.deck if name.startswith("sweep.key_") and _words(result, name) == key), "")
    return _words(result, f"sweep.scale_{place}") == "logarithmic"


def suitable_figure(sweep):
    """The figure that suits the sweep."""
    if not sweep.is_grid():
        return "scatter"
    long = [n for n in sweep.lengths().values() if n > MOST_CURVES]
    return "map" if len(long) >= 2 else "curves"


def draw_map(sweep):
    """One map for each quantity; where more than two keys vary, the others have one value, the first with a result."""
    lengths = sweep.lengths()
    if len(lengths) < 2 or not sweep.is_grid():
        raise ResultError("a map needs a grid over two keys; see --figure")
    first, second = sorted(sorted(lengths, key=lengths.get, reverse=True)[:2], key=list(lengths).index)
    chosen = _where_others_are_first(sweep, (first, second))
    x, y = sweep.keys[first][0][chosen], sweep.keys[second][0][chosen]
    figure = Figure(figsize=(5.2 * len(sweep.quantities), 4.0), layout="constrained")
    for axes, name in zip(_row(figure, len(sweep.quantities)), sweep.quantities):
        values, label = sweep.quantities[name]
        columns, i = np.unique(x, return_inverse=True)
        rows, j = np.unique(y, return_inverse=True)
        table = np.full((len(rows), len(columns)), np.nan)
        table[j, i] = values[chosen]
        image = axes.pcolormesh(_edges(sweep, first, columns), _edges(sweep, second, rows),
                                np.ma.masked_invalid(table), cmap="viridis", norm=_colour_scale(sweep, name))
        axes.set_facecolor("#dddddd")  # cases without a result
        lost = chosen & sweep.is_drawn_lost([name])
        if lost.any():
            axes.plot(sweep.keys[first][0][lost], sweep.keys[second][0][lost], **CROSS)
        figure.colorbar(image, ax=axes, label=label, format=PLAIN if name in sweep.logarithmic else None)
        if min(table.shape) > 1 and not {first, second} & set(sweep.words) and np.isfinite(table).all() and np.ptp(table) > 0:
            lines = axes.contour(columns, rows, table, colors="white", linewidths=0.6,
                                 locator=LogLocator() if name in sweep.logarithmic else None)
            shade = [withStroke(linewidth=1.4, foreground="#00000080")]
            lines.set(path_effects=shade)
            for label in axes.clabel(lines, fontsize=7, fmt="%g"):
                label.set_path_effects(shade)
        _name_axis(sweep, axes, "x", first)
        _name_axis(sweep, axes, "y", second)
    _note(figure, sweep, (first, second), mark=" (crosses)")
    return figure


def draw_curves(sweep):
    """The longest key of numbers along the axis, the next key as curves; the others have one value, the first with a result."""
    if not sweep.is_grid():
        raise ResultError("curves need a grid; see --figure")
    lengths = sweep.lengths()
    order = sorted(lengths, key=lambda key: (key not in sweep.words, lengths[key]), reverse=True)
    axis, curve = order[0], (order[1] if len(order) > 1 else None)
    chosen = _where_others_are_first(sweep, order[:2])
    there = np.unique(sweep.keys[curve][0][chosen & sweep.has_value()]) if curve else [None]
    is_many = len(there) > MOST_CURVES and curve not in sweep.words
    steps = thin_out(there, MOST_COLOURS if is_many else MOST_CURVES)
    scale = _colour_scale(sweep, curve) if is_many else None
    figure = Figure(figsize=(5.2 * len(sweep.quantities), 4.0), layout="constrained")
    for axes, name in zip(_row(figure, len(sweep.quantities)), sweep.quantities):
        values = sweep.quantities[name][0]
        for number, step in enumerate(steps):
            here = chosen if step is None else chosen & (sweep.keys[curve][0] == step)
            order_here = np.argsort(sweep.keys[axis][0][here], kind="stable")
            place = scale(step) if is_many else 0.9 * number / max(1, len(steps) - 1)
            axes.plot(sweep.keys[axis][0][here][order_here], values[here][order_here], marker="o", markersize=3,
                      linewidth=0.0 if axis in sweep.words else 1.3, color=matplotlib.colormaps["viridis"](place),
                      label=sweep.label_value(curve, step) if curve and np.isfinite(values[here]).any() else None)
            lost = here & sweep.is_drawn_lost([name])
            if lost.any():
                axes.plot(sweep.keys[axis][0][lost], values[lost], color=matplotlib.colormaps["viridis"](place), **CIRCLE)
        _name_axis(sweep, axes, "y", name)
        _name_axis(sweep, axes, "x", axis)
        if is_many:
            figure.colorbar(ScalarMappable(scale, "viridis"), ax=axes, label=sweep.keys[curve][1],
                            format=PLAIN if curve in sweep.logarithmic else None)
        elif axes.get_legend_handles_labels()[0]:
            axes.legend(title=sweep.keys[curve][1], fontsize=7, title_fontsize=7, frameon=False)
    words = [f"{len(steps)} of {sweep.lengths()[curve]} values of {sweep.keys[curve][1]} shown"] if len(steps) < len(there) else []
    _note(figure, sweep, order[:2], words if is_many or not curve else [*words, *_words_without_result(sweep, curve, chosen)],
          " (open circles)")
    return figure


def _words_without_result(sweep, key, chosen):
    """Values of a key with which none of some cases has a result."""
    values = sweep.keys[key][0]
    bare = [sweep.label_value(key, value) for value in np.unique(values[chosen]) if sweep.failed[chosen & (values == value)].all()]
    return [f"no case of {sweep.keys[key][1]} = {some_numbers(bare)} has a result"] if bare else []


def draw_scatter(sweep):
    """Every key against every quantity."""
    rows, columns = len(sweep.quantities), len(sweep.keys)
    figure = Figure(figsize=(2.7 * columns + 0.6, 2.4 * rows + 0.4), layout="constrained")
    grid = figure.subplots(rows, columns, squeeze=False, sharey="row", sharex="col")
    size = float(np.clip(3e3 / len(sweep.failed), 0.3, 12.0))
    for i, name in enumerate(sweep.quantities):
        for j, key in enumerate(sweep.keys):
            axes = grid[i][j]
            places, lost = sweep.keys[key][0] + _sideways(sweep, key), sweep.is_drawn_lost([name])
            axes.scatter(places, sweep.quantities[name][0], s=size, color="#08306b", linewidths=0, alpha=0.6, rasterized=True)
            axes.scatter(places[lost], sweep.quantities[name][0][lost], s=3 * size, facecolors="none", edgecolors="#d55e00",
                         linewidths=0.6, rasterized=True)
            if i == rows - 1:
                _name_axis(sweep, axes, "x", key)
            if j == 0:
                _name_axis(sweep, axes, "y", name)
    _note(figure, sweep, sweep.keys, mark=" (circles)")
    return figure


def draw_parallel(sweep):
    """An axis for each key and quantity, scaled to its own range; a line for each case."""
    names = [*sweep.keys, *sweep.quantities]
    cases = np.flatnonzero(np.all([np.isfinite(sweep.column(name)[0]) for name in names], axis=0))
    if not len(cases):
        raise ResultError("no case has a result of all these quantities")
    count = len(cases)
    cases = cases[np.unique(np.linspace(0, len(cases) - 1, MOST_LINES).round().astype(int))]
    scaled, ends = [], []
    for name in names:
        values = sweep.column(name)[0][cases]
        ends.append((values.min(), values.max()))
        values = np.log(values) if name in sweep.logarithmic else values
        low, high = values.min(), values.max()
        scaled.append(np.full(len(values), 0.5) if _about(values) else (values - low) / (high - low))
    scaled = np.array(scaled)
    figure = Figure(figsize=(1.6 * len(names) + 1.0, 4.4), layout="constrained")
    axes = figure.subplots()
    if ends[-1][0] < ends[-1][1] and names[-1] not in sweep.words:
        is_logarithmic = names[-1] in sweep.logarithmic
        bar = ScalarMappable((LogNorm if is_logarithmic else Normalize)(*ends[-1]), "viridis")
        figure.colorbar(bar, ax=axes, label=sweep.column(names[-1])[1], format=PLAIN if is_logarithmic else None)
    width = float(np.clip(60.0 / len(cases), 0.5, 1.5))
    for line in np.argsort(scaled[-1], kind="stable"):
        axes.plot(scaled[:, line], color=matplotlib.colormaps["viridis"](scaled[-1, line]), linewidth=width,
                  alpha=min(1.0, 0.25 + 0.5 * width))
    for place, (name, (low, high)) in enumerate(zip(names, ends)):
        axes.plot([place, place], [0, 1], color="black", linewidth=0.8)
        for height, value, side in ((-0.02, low, "top"), (1.02, high, "bottom")):
            axes.text(place, height, sweep.label_value(name, value), ha="center", va=side, fontsize=7)
        if name in sweep.words and high - low < MOST_WORDS:
            for value in range(int(low) + 1, int(high)):
                axes.annotate(sweep.label_value(name, value), (place, (value - low) / (high - low)), (4, 0), textcoords="offset points",
                              va="center", fontsize=7, path_effects=[withStroke(linewidth=2.0, foreground="white")])
    labels = [sweep.column(name)[1].replace(" [", "\n[") + "\nlogarithmic" * (name in sweep.logarithmic) for name in names]
    axes.set_xticks(range(len(names)), labels, fontsize=7)
    axes.tick_params(axis="x", length=0, pad=4)
    axes.set_yticks([])
    axes.set_ylim(-0.08, 1.08)
    axes.spines[:].set_visible(False)
    _note(figure, sweep, names, [f"{len(cases)} of {count} cases shown"] * (len(cases) < count))
    return figure


def _colour_scale(sweep, name):
    """Colours over the values of a key or a quantity."""
    values = sweep.column(name)[0]
    values = values[np.isfinite(values)]
    if not values.size:
        return None
    return (LogNorm if name in sweep.logarithmic else Normalize)(*(_about(values) or (values.min(), values.max())))


def _about(values):
    """Range about values that are the same but for rounding; None of others."""
    known = values[np.isfinite(values)]
    low, high = known.min(), known.max()
    if high - low > ROUNDING * max(abs(low), abs(high)):
        return None
    room = 0.05 * abs(low) or 1.0
    return low - room, high + room


def _row(figure, count):
    return figure.subplots(1, count, squeeze=False)[0]


def _values_of_others(sweep, shown):
    """The one value of each key that a figure does not show: the first, as the file lists them, with which a case has a value."""
    there, found = sweep.has_value(), {}
    for key, (values, _) in sweep.keys.items():
        if key not in shown:
            found[key] = values[np.isin(values, values[there])][0]
            there &= values == found[key]
    return found


def _where_others_are_first(sweep, shown):
    """Cases whose other keys have that value."""
    chosen = np.ones(len(sweep.failed), dtype=bool)
    for key, value in _values_of_others(sweep, shown).items():
        chosen &= sweep.keys[key][0] == value
    return chosen


def _edges(sweep, key, centres):
    """Edges of cells about their centres, halfway in what the axis shows; of numbers the outer cells end where the results do."""
    is_logarithmic = key in sweep.logarithmic
    places = np.log(centres) if is_logarithmic else centres
    if len(places) == 1:
        return centres * np.array([0.9, 1.1]) if is_logarithmic else centres + np.array([-0.5, 0.5])
    inner = (places[1:] + places[:-1]) / 2
    ends = (2 * places[0] - inner[0], 2 * places[-1] - inner[-1]) if key in sweep.words else (places[0], places[-1])
    places = np.concatenate((ends[:1], inner, ends[1:]))
    return np.exp(places) if is_logarithmic else places


def _sideways(sweep, key):
    """Points that share a word, spread evenly beside each other."""
    if key not in sweep.words:
        return 0.0
    return SPREAD * (2 * ((np.arange(len(sweep.failed)) * (5**0.5 - 1) / 2) % 1) - 1)


def _name_axis(sweep, axes, side, name):
    values, label = sweep.column(name)
    getattr(axes, f"set_{side}label")(label)
    drawn = getattr(axes.dataLim, f"interval{side}")
    about = _about(drawn) if name not in sweep.words and np.isfinite(drawn).all() else None
    if about:
        getattr(axes, f"set_{side}lim")(*about)
    elif name in sweep.logarithmic:
        getattr(axes, f"set_{side}scale")("log")
        ticks = getattr(axes, f"{side}axis")
        few = np.nanmax(values) < 30 * np.nanmin(values)
        ticks.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if few else (1.0,)))
        ticks.set_major_formatter(PLAIN)
        ticks.set_minor_formatter(NullFormatter())
    elif side == "x" and name not in sweep.words and 0.0 < np.nanmax(values) - np.nanmin(values) < NEAR * np.nanmax(np.abs(values)):
        ends = [float(np.nanmin(values)), float(np.nanmax(values))]
        for label, end in zip(axes.set_xticks(ends, distinct_texts(ends)), ("left", "right")):
            label.label1.set_horizontalalignment(end)
    if name in sweep.words and len(sweep.words[name]) <= MOST_WORDS:
        words = [sweep.label_value(name, place) for place in range(len(sweep.words[name]))]
        is_long = side == "x" and sum(map(len, words)) > 24
        turn = {"rotation": 20, "ha": "right"} if is_long else {}
        getattr(axes, f"set_{side}ticks")(range(len(words)), words, fontsize=7, **turn)
        getattr(axes, f"set_{side}lim")(-0.5, len(words) - 0.5)


def _note(figure, sweep, shown, more=(), mark=""):
    """Title of the deck, values of the keys that are not shown, what else is left out, cases without a result and with lost contact."""
    words = [f"{sweep.keys[key][1]} = {sweep.label_value(key, value)}" for key, value in _values_of_others(sweep, shown).items()]
    words += [*more, *sweep.remarks, *missing_words(sweep.status)]
    chosen = _where_others_are_first(sweep, shown)
    drawn = sweep.is_drawn_lost(sweep.quantities)
    words += [text + mark for text in lost_contact_words({lobe: (lost & drawn)[chosen] for lobe, lost in sweep.lost.items()})]
    width = max(30, int(14 * figure.get_figwidth()))
    figure.suptitle("\n".join([textwrap.fill(sweep.title, width), *textwrap.wrap(", ".join(words), width)]), fontsize=9)


@script
def main(arguments=None):
    """Command line; returns the exit code."""
    parser = argparse.ArgumentParser(prog="plot_sweep.py", description="draw how a result answers to what a sweep varies")
    parser.add_argument("file", type=Path)
    parser.add_argument("--quantity", action=ONCE, help=f"names in /summary, separated by commas (default: {QUANTITY})")
    parser.add_argument("--figure", choices=FIGURES, help="what is drawn; what suits the sweep where not given")
    parser.add_argument("--where", action="append", default=[], metavar="CONDITION",
                        help="only cases with this, as 'mean_slip_ratio < 0.01', 'speed_rpm >= 600', speed_rpm=300,600 or law=moes; a "
                             "name in /summary (SI) or a swept key (unit of the deck); given more than once, a case must meet all")
    parser.add_argument("--over", action=ONCE, metavar="KEYS",
                        help="swept keys, separated by commas: cases that differ in them only count as one")
    parser.add_argument("--take", choices=TAKEN, help="with --over: value of several cases that count as one (default: largest)")
    parser.add_argument("--output", type=Path, help="folder; that of the file where not given")
    parser.add_argument("--dpi", type=DPI, default=150)
    options = parser.parse_args(arguments)
    over = names_of(options.over, "--over") or ()
    sweep = Sweep(options.file, names_of(options.quantity, "--quantity") or [QUANTITY], options.where, over,
                  take_over(options.take, over))
    name = options.figure or suitable_figure(sweep)
    figure = {"map": draw_map, "curves": draw_curves, "scatter": draw_scatter, "parallel": draw_parallel}[name](sweep)
    target = (options.output or options.file.parent) / f"{options.file.stem}_{name}.png"
    save_figure(figure, target, dpi=options.dpi)
    print(target)
    return 0


if __name__ == "__main__":
    sys.exit(main())
