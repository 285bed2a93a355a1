"""Read one result file of camroller.

    from read import read_result
    result = read_result("results/thesis.h5")
    result.cam_angle                     # degrees, nose at 180, (cam_angle)
    result.series["contact_load"].values # newton, (case, cam_angle)
    result.summary["mean_slip_ratio"]    # (case)
    result.value_of("operating_point.speed_rpm", case=0)

Everything else (units, names, the deck and how the file was made) comes with it; nothing is
converted here, so all series are in SI units. A file of a sweep may have series of few cases or of none. Series are read from the
file when their values are asked for. Needs h5py and numpy.
"""

from contextlib import contextmanager
from dataclasses import dataclass, field
import difflib
from functools import partial
import os
from pathlib import Path
import re
import select
import signal

import h5py
import numpy as np


LONGEST_READ = 60.0  # [s]
NONE_AT_ZERO = re.compile(r"seating_speed$|^min_(.*_)?film_(thickness_min|thickness_central|ratio)$")  # scalars: 0 is no value
SLOWEST_READ = 1e7  # bytes that are read in a second at least
MOST_HELD = 5e7  # bytes of series that are held for a second use, beside the last one


#: What else the program writes than results: a group of it, its name, what is in it, and the script that reads it
OTHER_FILES = {"study/study": ("a study", "what `camroller study` has measured", "plot_study.py"),
               "study/audit": ("an audit", "what `camroller audit` has measured", "plot_audit.py"),
               "ehl": ("a file of solved contacts", "the solved contacts of `camroller ehl`", "ehl.py")}


class ResultError(Exception):
    """The file cannot be used; the text says why in one line."""


@dataclass
class Quantity:
    """Values with their unit as the file states it, and what they mean in words."""

    values: np.ndarray
    units: str = ""
    long_name: str = ""


class Series:
    """A quantity over the cam angle, (case, cam_angle), whose values are read or computed when they are asked for: a file of a sweep
    may have more series than there is memory. Those of the last uses are held."""

    _held = {}

    def __init__(self, source, units="", long_name=""):
        self._source, self.units, self.long_name = source, units, long_name

    @property
    def values(self):
        """The values, not to be changed."""
        values = self._held.pop(self, None)
        values = self._source() if values is None else values
        self._held[self] = values
        spare = sum(other.nbytes for other in self._held.values()) - MOST_HELD
        for other in list(self._held)[:-1]:
            if spare > 0:
                spare -= self._held.pop(other).nbytes
        return values


@dataclass
class Result:
    """Contents of one result file; see the head of this module."""

    path: Path
    cam_angle: np.ndarray
    series: dict = field(default_factory=dict)
    summary: dict = field(default_factory=dict)
    sweep: dict = field(default_factory=dict)
    deck: dict = field(default_factory=dict)
    deck_text: str = ""
    run: dict = field(default_factory=dict)
    messages: list = field(default_factory=list)
    cases: int = 0
    measured: dict = field(default_factory=dict)
    history: dict = field(default_factory=dict)  # over hours of running, (case, row)
    turns: dict = field(default_factory=dict)  # of a flexible train that does not repeat every turn, (case, turn)

    @property
    def title(self):
        """Title that the deck gives, else the name of the file."""
        given = self.deck.get("case.title")
        if given is not None and str(given.values).strip(" '\""):
            return str(given.values).strip(" '\"")
        found = re.search(r"&case\b[^/&]*?\btitle\s*=\s*('(?:[^']|'')*'|\"[^\"]*\")", self.deck_text, re.I)
        title = found.group(1)[1:-1].replace("''", "'").strip() if found else ""
        return title or self.path.stem

    def value_of(self, key, case):
        """Value of a deck key (`group.key`) in one case, in the deck's unit; None if not there or a list."""
        if key in self.sweep:
            value = self.sweep[key].values[case]
        elif key in self.deck and np.ndim(self.deck[key].values) == 0:
            value = self.deck[key].values
        else:
            return None
        return value.item() if isinstance(value, (np.generic, np.ndarray)) else value

    def turn_count(self, case):
        """Number of turns of a case that are listed one by one; 0 where none is."""
        listed = [np.isfinite(measure.values[case]) for measure in self.turns.values()]
        return int(np.max(np.nonzero(np.any(listed, axis=0))[0], initial=-1)) + 1 if listed else 0

    def period(self, case):
        """Turns after which the flexible trains of all lobe shapes repeat themselves; 0 where one never does, None for rigid trains."""
        periods = [int(scalar.values[case]) for name, scalar in self.summary.items() if name.endswith("period_cycles")]
        return (0 if 0 in periods else max(periods)) if periods else None

    def failed_cases(self):
        """Cases without a result, each with the reason that the file gives."""
        status = self.summary.get("status")
        if status is None or np.shape(status.values) != (self.cases,):
            return []
        return [(int(case), reason_of(case, self.messages[case]) if case < len(self.messages) else "")
                for case in np.flatnonzero(status.values)]

    def need_results(self):
        """ResultError where no case has a result."""
        failed = self.failed_cases()
        if failed and len(failed) == self.cases:
            raise without_results(self.path, failed[0][1])

    def scalar(self, name):
        """A scalar of the summary for each case; ResultError where it is not there, as where no case has a result, or is no such list."""
        if name not in self.summary:
            self.need_results()
            near = difflib.get_close_matches(name, self.summary, 3) or [other for other in self.summary if name in other][:3]
            raise ResultError(f"{self.path}: no scalar {name} in the summary" + (f"; there is {', '.join(near)}" if near else ""))
        quantity = self.summary[name]
        if np.shape(quantity.values) != (self.cases,):
            raise ResultError(f"{self.path}: the scalar {name} does not have one value for each of {self.cases} cases")
        return quantity

    def cases_with_series(self):
        """Cases whose series are in the file; a sweep may keep them of a few cases only."""
        filled = np.zeros(self.cases, dtype=bool)
        failed = [case for case, _ in self.failed_cases()]
        for quantity in self.series.values():
            filled |= np.isfinite(quantity.values).any(axis=1)
            if np.delete(filled, failed).all():
                break
        return np.flatnonzero(filled).tolist()

    def is_grid(self):
        """Is every swept value there with every other, once?"""
        return fills_grid([quantity.values.tolist() for quantity in self.sweep.values()], self.cases)


def reason_of(case, message):
    """Message of a failed case without the number that it begins with: what varies, and why it failed."""
    return re.sub(rf"^case {case}(?: \((.*?)\))?: ", lambda found: f"{found[1]}: " if found[1] else "", message)


def without_results(path, reason):
    """The error of a file in which no case has a result, with the reason of the first."""
    return ResultError(f"{path}: no case has a result: {reason}".rstrip(": "))


def fills_grid(columns, count):
    """Do so many rows of these columns hold every value with every other, once?"""
    lengths = [float(len(set(column))) for column in columns]
    return float(np.prod(lengths)) == count and len(set(zip(*columns))) == count if columns else count <= 1


@contextmanager
def opened(path, kind="a result file of camroller"):
    """An HDF5 file to be read from; whatever is wrong with it is a ResultError of one line."""
    path = Path(path)
    if not path.exists():
        raise ResultError(f"{path}: no such file")
    if not path.is_file():
        raise ResultError(f"{path}: not a regular file")
    try:
        with _time_limit(path), h5py.File(path, "r") as file:
            try:
                yield file
            except KeyError:
                _refuse_other_kind(path, file, kind)
                raise
    except ResultError:
        raise
    except Exception as error:  # pylint: disable=broad-except
        # A damaged file makes h5py raise exceptions of nearly every kind
        reason = next(iter(str(error.args[0] if error.args else error).splitlines()), type(error).__name__)
        if not h5py.is_hdf5(path):
            reason = "cannot be read: not an HDF5 file" if isinstance(error, OSError) else reason
        elif isinstance(error, OSError):
            reason = f"cannot be read: {reason}"
        else:
            reason = f"not {kind}, or damaged: {reason}"
        raise ResultError(f"{path}: {reason}") from None


def _refuse_other_kind(path, file, wanted):
    """ResultError where a file that lacks something is known to be of another kind than that wanted."""
    for group, (kind, words, script) in OTHER_FILES.items():
        if group in file and kind != wanted:
            raise ResultError(f"{path}: {words}, not {wanted}; post/{script} draws it")
    if "summary/status" in file and wanted in [kind for kind, *_ in OTHER_FILES.values()]:
        raise ResultError(f"{path}: the results of a run or sweep, not {wanted}; post/plot.py draws them")


@contextmanager
def _time_limit(path):
    """End this process with a line if reading takes far too long: damaged bytes can make the HDF5 library go in circles.

    A second process watches, since nothing in this one runs until the library comes back.
    """
    limit = LONGEST_READ + path.stat().st_size / SLOWEST_READ
    done, told = os.pipe()
    watcher = os.fork()
    if watcher == 0:
        try:
            os.close(told)
            if not select.select([done], [], [], limit)[0]:
                os.write(2, f"{path}: cannot be read: the HDF5 library goes in circles, the file is damaged\n".encode())
                os.kill(os.getppid(), signal.SIGTERM)
        finally:
            os._exit(0)
    os.close(done)
    try:
        yield
    finally:
        os.close(told)
        os.waitpid(watcher, 0)


def text_columns(group):
    """Datasets of a table by name, texts decoded."""
    return {name: _quantity(data).values for name, data in group.items()}


def read_result(path, with_series=True):
    """Read a result file, its series when they are asked for; raise ResultError with one clear line if it is not one."""
    path = Path(path)
    with opened(path) as file:
        return _read(path, file, with_series)


def _read(path, file, with_series):
    summary = set(file.get("summary", ()))
    # a file of solved contacts has the status of its cases and nothing else in its summary
    is_other = "status" not in summary or ("ehl" in file and summary == {"status"})
    if "series" not in file or ("cam_angle" not in file["series"] and is_other):
        for group, (_, words, script) in OTHER_FILES.items():
            if group in file:
                raise ResultError(f"{path}: {words}, not the results of a run; post/{script} draws it")
        raise ResultError(f"{path}: not a result file of camroller (neither /series/cam_angle nor /summary/status)")
    if not any(int(np.ravel(file.attrs.get(name, 0))[0]) for name in ("complete", "missing_cases")):
        raise ResultError(f"{path}: not complete: the run that wrote it did not finish")
    angle, series = _read_series(path, file) if with_series else (np.zeros(0), {})
    deck_text = text_of(file["deck/text"][()]) if "deck/text" in file else ""
    deck = _datasets(file, "deck/values")
    sweep = _datasets(file, "sweep")
    cases = _count_cases(path, file)
    measured = _datasets(file, "measured")
    for key, quantity in (*sweep.items(), *measured.items()):
        if np.shape(quantity.values) != (cases,):
            raise ResultError(f"{path}: column {key} does not have one value for each case")
    run = {name: text_of(value) for name, value in file["run"].attrs.items()} if "run" in file else {}
    messages = [text_of(message) for message in file["run/messages"][()]] if "run/messages" in file else []
    return Result(path, angle, series, _without_none(_datasets(file, "summary")),
                  _in_deck_order(sweep, deck_text, deck), deck, deck_text, run, messages, cases, measured, _datasets(file, "running_in"),
                  _without_none({name: quantity for name, quantity in _datasets(file, "turns").items() if name != "turn"}))


def _read_series(path, file):
    """Cam angles and series by name; both empty where a sweep has kept none."""
    if "cam_angle" not in file["series"]:
        return np.zeros(0), {}
    angle = np.asarray(file["series/cam_angle"][()], dtype=float)
    if angle.ndim != 1 or angle.size == 0:
        raise ResultError(f"{path}: /series/cam_angle is not a list of angles")
    found = {name: data for name, data in file["series"].items() if name != "cam_angle"}
    for name, data in found.items():
        if data.ndim != 2 or data.shape[1] != angle.size or data.dtype.kind not in "fiu":
            raise ResultError(f"{path}: series {name} does not have the dimensions (case, cam_angle)")
    if len({data.shape[0] for data in found.values()}) > 1:
        raise ResultError(f"{path}: series with different numbers of cases")
    return angle, {name: Series(partial(_values, path, data.name), *_words(data)) for name, data in found.items()}


def _values(path, name):
    """All values of a dataset."""
    with opened(path) as file:
        return file[name][()]


def _count_cases(path, file):
    """Number of cases, from the series, else from what has one value for each case."""
    shapes = [data.shape for data in file["series"].values() if isinstance(data, h5py.Dataset) and data.ndim == 2]
    shapes += [file[name].shape for name in ("summary/status", "case") if name in file and isinstance(file[name], h5py.Dataset)]
    if not shapes or not shapes[0] or shapes[0][0] < 1:
        raise ResultError(f"{path}: no cases in it")
    return shapes[0][0]


def _datasets(file, group):
    """All datasets below a group by name, with dots between the parts of the name."""
    found = {}
    if group in file:
        file[group].visititems(
            lambda name, item: found.update({name.replace("/", "."): _quantity(item)})
            if isinstance(item, h5py.Dataset) else None)
    return found


def _without_none(quantities):
    """Not-a-number where a valve never meets its seat or contact is lost: files hold numbers alone, and a speed of seating or a smallest
    film of 0 stands for none."""
    for name in [name for name in quantities if NONE_AT_ZERO.search(name)]:
        none = quantities[name].values == 0
        for of_it in (name + suffix for suffix in ("", "_deviation", "_lowest", "_highest") if name + suffix in quantities):
            quantities[of_it].values = np.where(none, np.nan, quantities[of_it].values)
    return quantities


def _quantity(data):
    values = data[()]
    if h5py.check_string_dtype(data.dtype) is not None:
        values = text_of(values) if np.ndim(values) == 0 else np.array([text_of(value) for value in values])
    return Quantity(values, *_words(data))


def _words(data):
    """Unit and meaning of a dataset."""
    return text_of(data.attrs.get("units", "")), text_of(data.attrs.get("long_name", ""))


def text_of(value):
    """String from what HDF5 may hold: bytes padded with blanks, an array of one, a number."""
    if isinstance(value, np.ndarray):
        return "\n".join(text_of(item) for item in np.ravel(value))
    return value.decode("utf-8", "replace").rstrip(" \0") if isinstance(value, bytes) else str(value).rstrip()


def _in_deck_order(sweep, deck_text, deck):
    """Swept keys in the order in which the deck's sweep group names them (HDF5 lists them by name)."""
    start = max(deck_text.lower().find("&sweep"), 0)
    resolved = "\n".join(text_of(quantity.values) for key, quantity in sorted(deck.items())
                         if key.startswith("sweep.") and np.asarray(quantity.values).dtype.kind in "US")
    text = resolved.lower() + "\n" + deck_text[start:].lower()

    def position(item):
        found = text.find(item[0].lower())
        return found if found >= 0 else len(text)

    return dict(sorted(sweep.items(), key=position))
