"""Read one result file of camroller.

    from read import read_result
    result = read_result("results/thesis.h5")
    result.cam_angle                     # degrees, nose at 180, (cam_angle)
    result.series["contact_load"].values # newton, (case, cam_angle)
    result.summary["mean_slip_ratio"]    # (case)
    result.value_of("operating_point.speed_rpm", case=0)

Everything else (units, names, the deck and how the file was made) comes with it; nothing is
converted here, so all series are in SI units. Needs h5py and numpy.
"""

from dataclasses import dataclass, field
from pathlib import Path
import re

import h5py
import numpy as np


class ResultError(Exception):
    """The file cannot be used; the text says why in one line."""


@dataclass
class Quantity:
    """Values with their unit as the file states it, and what they mean in words."""

    values: np.ndarray
    units: str = ""
    long_name: str = ""


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

    @property
    def cases(self):
        """Number of cases."""
        return next(iter(self.series.values())).values.shape[0] if self.series else 0

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

    def failed_cases(self):
        """Cases without a result, each with the reason that the file gives."""
        status = self.summary.get("status")
        if status is None:
            return []
        return [(int(case), self.messages[case] if case < len(self.messages) else "")
                for case in np.flatnonzero(status.values)]


def read_result(path):
    """Read a whole result file into memory; raise ResultError with one clear line if it is not one."""
    path = Path(path)
    if not path.exists():
        raise ResultError(f"{path}: no such file")
    try:
        with h5py.File(path, "r") as file:
            return _read(path, file)
    except OSError as error:
        reason = "not an HDF5 file" if not h5py.is_hdf5(path) else str(error).splitlines()[0]
        raise ResultError(f"{path}: cannot be read: {reason}") from None


def _read(path, file):
    if "series" not in file or "cam_angle" not in file["series"]:
        raise ResultError(f"{path}: not a result file of camroller (no /series/cam_angle)")
    if int(np.ravel(file.attrs.get("complete", 0))[0]) != 1:
        raise ResultError(f"{path}: not complete: the run that wrote it did not finish")
    angle = np.asarray(file["series/cam_angle"], dtype=float)
    series = {name: _quantity(data) for name, data in file["series"].items() if name != "cam_angle"}
    for name, quantity in series.items():
        if quantity.values.ndim != 2 or quantity.values.shape[1] != angle.size:
            raise ResultError(f"{path}: series {name} does not have the dimensions (case, cam_angle)")
    if len({quantity.values.shape[0] for quantity in series.values()}) != 1:
        raise ResultError(f"{path}: no series, or series with different numbers of cases")
    deck_text = _text(file["deck/text"][()]) if "deck/text" in file else ""
    deck = _datasets(file, "deck/values")
    sweep = _datasets(file, "sweep")
    cases = next(iter(series.values())).values.shape[0]
    for key, quantity in sweep.items():
        if np.shape(quantity.values) != (cases,):
            raise ResultError(f"{path}: swept key {key} does not have one value for each case")
    run = {name: _text(value) for name, value in file["run"].attrs.items()} if "run" in file else {}
    messages = [_text(message) for message in file["run/messages"][()]] if "run/messages" in file else []
    return Result(path, angle, series, _datasets(file, "summary"),
                  _in_deck_order(sweep, deck_text, deck), deck, deck_text, run, messages)


def _datasets(file, group):
    """All datasets below a group by name, with dots between the parts of the name."""
    found = {}
    if group in file:
        file[group].visititems(
            lambda name, item: found.update({name.replace("/", "."): _quantity(item)})
            if isinstance(item, h5py.Dataset) else None)
    return found


def _quantity(data):
    values = data[()]
    if h5py.check_string_dtype(data.dtype) is not None:
        values = _text(values) if np.ndim(values) == 0 else np.array([_text(value) for value in values])
    return Quantity(values, _text(data.attrs.get("units", "")), _text(data.attrs.get("long_name", "")))


def _text(value):
    """String from what HDF5 may hold: bytes padded with blanks, an array of one, a number."""
    if isinstance(value, np.ndarray):
        return "\n".join(_text(item) for item in np.ravel(value))
    return value.decode("utf-8", "replace").rstrip(" \0") if isinstance(value, bytes) else str(value).rstrip()


def _in_deck_order(sweep, deck_text, deck):
    """Swept keys in the order in which the deck's sweep group names them (HDF5 lists them by name)."""
    start = max(deck_text.lower().find("&sweep"), 0)
    resolved = "\n".join(_text(quantity.values) for key, quantity in sorted(deck.items())
                         if key.startswith("sweep.") and np.asarray(quantity.values).dtype.kind in "US")
    text = resolved.lower() + "\n" + deck_text[start:].lower()

    def position(item):
        found = text.find(item[0].lower())
        return found if found >= 0 else len(text)

    return dict(sorted(sweep.items(), key=position))
