"""camroller: friction, film, slip and drive torque of roller-finger-follower valve trains.

SI units and radians everywhere; cam angles have the nose, full lift, at pi. Values of deck keys alone have the unit that the key's
name says. What goes wrong is raised as `CamrollerError` or one of its kinds.
"""

from __future__ import annotations

import array
import concurrent.futures
import itertools
import numbers
import os
from ctypes import c_char_p, c_double, create_string_buffer

from ._library import (LIBRARY, Cam, CamrollerError, ConvergenceError, DeckError, DomainError, FileError, Handle, Inputs, Outcome,
                       ShaftOutcome, UsageError, byref, call, encoded, list_remarks, list_texts)

__all__ = ["Cam", "CamrollerError", "Case", "ConvergenceError", "DeckError", "DomainError", "FileError", "Inputs", "Outcome",
           "Quantity", "Remark", "Result", "Shaft", "ShaftOutcome", "Simulation", "UsageError", "run", "run_cases", "__version__"]


def _version():
    buffer = create_string_buffer(32)
    LIBRARY.camroller_library_version_text(buffer, len(buffer))
    return buffer.value.decode()


__version__ = _version()


class Remark(str):
    """A sentence on a step, and the name of its `kind`, the same in every step."""

    __slots__ = ("kind",)

    def __new__(cls, kind, words):
        remark = super().__new__(cls, words)
        remark.kind = kind
        return remark


class Quantity(tuple):
    """Name, unit and meaning of a number."""

    __slots__ = ()
    name = property(lambda self: self[0])
    unit = property(lambda self: self[1])
    meaning = property(lambda self: self[2])


def _word(value):
    """A value as a deck has it: texts in quotes, lists parted by commas. Numbers and arrays of numpy are what they hold."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, bool):
        return ".true." if value else ".false."
    if isinstance(value, str):
        return value if value[:1] in ("'", '"') else "'" + value.replace("'", "''") + "'"
    if isinstance(value, (list, tuple)):
        return ", ".join(_word(part) for part in value)
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        return repr(float(value))
    raise TypeError(f"a value of a key is a number, a text, true or false, or a list of them, not {type(value).__name__}")


def _path(path):
    """A path for the library."""
    if b"\0" in os.fsencode(path):
        raise UsageError(f"a path has a null character in it: {path!r}")
    return os.fsencode(path)


class Case(Handle):
    """A case of the file of a deck; `Case.from_text` takes its text. `set` gives keys, named `group.key`, other values, all of them
    together."""

    _kind = "case"
    _instead = "; give other processes the path or the text of its deck, and the values that were set"
    #: Keys that were given other values
    _given = frozenset()

    def __init__(self, path, set=None):
        self._take("case_from_file", _path(path))
        self.set_all(set or {})

    @classmethod
    def from_text(cls, text, folder=None, set=None):
        """A case of the text of a deck; paths of tables start at `folder`. A mark of the order of bytes at its beginning is skipped."""
        case = cls._make("case_from_text", encoded(text, "the text of a deck").removeprefix("\ufeff".encode()),
                         None if folder is None else _path(folder))
        case.set_all(set or {})
        return case

    def copy(self):
        """A copy, which goes its own way."""
        made = super().copy()
        made._given = self._given
        return made

    def set(self, key, value):
        """Give a key another value; the case stays as it was where that fails."""
        self.set_all({key: value})

    def set_all(self, values):
        """Give several keys other values at once, for those that a deck can only have together; the case stays as it was where that
        fails."""
        keys = [encoded(key, "the name of a key") for key in values]
        words = [encoded(_word(value), f"the value of {key}") for key, value in values.items()]
        texts = c_char_p * len(keys)
        call("case_set_all", self._pointer, len(keys), texts(*keys), texts(*words))
        self._given |= {_plain_key(key) for key in values}

    def check(self):
        """Laws, geometry and oil, without a run."""
        call("case_check", self._pointer)

    def run(self):
        """Run the case as it stands, without the deck's sweep."""
        return Result._make("case_run", self._pointer)

    @property
    def remarks(self):
        """Remarks on the deck, a list of sentences: numbers that no engine has, keys without effect. A result has others."""
        return list_remarks("case_remarks", self._pointer)

    @property
    def numbers(self):
        """Keys that the deck gives with one number each, with their values in the unit of the key."""
        value = c_double()
        return {name: value.value for name, _, _ in list_texts("case_number", 3, self._pointer, after=(byref(value),))}

    def sweep(self):
        """Cases of the deck's sweep: for each the keys that vary with their values, and the case. A key that varies cannot have been
        set."""
        unused = [key for key in self._varied(0) if _plain_key(key) in self._given]
        if unused:
            raise UsageError(f"the deck's sweep varies {unused[0]}, so that the value that was set is not used; run the case alone, or "
                             "give a sweep of your own")
        for number in range(LIBRARY.camroller_case_sweep_size(self._pointer)):
            yield self._varied(number), Case._make("case_sweep_case", self._pointer, number)

    def _varied(self, number):
        values = {}
        for key, word in list_texts("case_sweep_value", 2, self._pointer, number):
            try:
                values[key] = float(word)
            except ValueError:
                values[key] = word.strip("'\"")
        return values


class Result(Handle):
    """A result: `scalars` and `series` by name, `units` and `meanings` of both, `remarks`. Series are arrays of doubles, which numpy
    takes without a copy; that of `cam_angle` holds the angle of each row [rad]."""

    _kind = "result"
    _instead = "; its scalars and series can be"

    def copy(self):
        """Results do not change: there is nothing that a copy would be for."""
        raise TypeError("a Result of camroller is not copied: it does not change, another name for it is enough")

    def __getattr__(self, name):
        if name not in ("scalars", "series", "units", "meanings", "remarks"):
            raise AttributeError(name)
        self._read()
        return self.__dict__[name]

    def _read(self):
        rows = LIBRARY.camroller_result_rows(self._pointer)
        self.units = {"cam_angle": "rad"}
        self.meanings = {"cam_angle": "cam angle, pi at full lift"}
        self.series = {"cam_angle": self._series("cam_angle", rows)}
        self.scalars = {}
        for name, unit, meaning in list_texts("result_quantity", 3, self._pointer, 0):
            self.series[name] = self._series(name, rows)
            self.units[name], self.meanings[name] = unit, meaning
        value = c_double()
        for name, unit, meaning in list_texts("result_quantity", 3, self._pointer, 1):
            call("result_scalar", self._pointer, name.encode(), byref(value))
            self.scalars[name] = value.value
            self.units[name], self.meanings[name] = unit, meaning
        self.remarks = list_remarks("result_remarks", self._pointer)

    def _series(self, name, rows):
        numbers = (c_double * rows)()
        call("result_series", self._pointer, name.encode(), numbers, rows)
        return array.array("d", numbers)


def _plain_key(key):
    """The name of a key as the library compares it."""
    encoded(key, "the name of a key")
    return key.strip().lower()


def _checked(case):
    """A case, where anything else would be taken for one by the library."""
    if not isinstance(case, Case):
        raise TypeError(f"expected a Case, not {type(case).__name__}")
    return case


def run_cases(cases, threads=None):
    """Run cases in threads; their results in order. An error is raised when its turn comes."""
    with concurrent.futures.ThreadPoolExecutor(threads or os.cpu_count()) as pool:
        yield from pool.map(Case.run, map(_checked, cases))


def _axis(key, values):
    """Values of a key of a sweep, checked before anything is run: each stands for one coordinate."""
    values = values.tolist() if hasattr(values, "tolist") else values
    group = _plain_key(key).partition(".")[0]
    if group in ("output", "sweep"):
        raise UsageError(f"sweep: keys of &{group} cannot be swept")
    if isinstance(values, (str, bytes)) or not hasattr(values, "__iter__"):
        raise TypeError(f"sweep: give {key} a list of values")
    values = [value.tolist() if hasattr(value, "tolist") else value for value in values]
    if not values:
        raise UsageError(f"sweep: {key} has no values")
    if any(isinstance(value, (list, tuple)) for value in values):
        raise UsageError(f"sweep: the values of {key} must be numbers or texts, not lists, which cannot be coordinates; set lists in "
                         "cases of your own and run them by run_cases")
    return values


def run(deck, set=None, sweep=None, threads=None):
    """Run a deck, given by its path or as a `Case`, with all cases of its sweep, or of `sweep`: a grid of values by key.

    With xarray a dataset, whose coordinates are the keys that vary: the axes of a grid, otherwise along `case`; series have the axis
    `cam_angle` [rad] beside. Without it a list of (values of the keys that vary, result). Keys that vary cannot be in `set`.
    """
    if sweep:
        sweep = {key: _axis(key, values) for key, values in sweep.items()}
        both = {_plain_key(key) for key in sweep} & {_plain_key(key) for key in set or ()}
        if both:
            raise UsageError(f"{min(both)} is in set and in sweep: give it in one of them")
    case = deck.copy() if isinstance(deck, Case) else Case(deck)
    case.set_all(set or {})
    if sweep:
        places = []
        for values in itertools.product(*sweep.values()):
            varied = case.copy()
            varied.set_all(dict(zip(sweep, values)))
            places.append((dict(zip(sweep, values)), varied))
    else:
        places = list(case.sweep())
    results = list(run_cases([made for _, made in places], threads))
    try:
        import xarray
    except ImportError:
        return [(varied, result) for (varied, _), result in zip(places, results)]
    return _dataset(xarray, [varied for varied, _ in places], results)


def _dataset(xarray, varied, results):
    """Results as one dataset."""
    import numpy

    keys = list(varied[0])
    axes = {key: list(dict.fromkeys(values[key] for values in varied)) for key in keys}
    is_grid = bool(keys) and len(varied) == numpy.prod([len(axis) for axis in axes.values()])
    if is_grid:
        dimensions, shape = keys, [len(axes[key]) for key in keys]
        coordinates = dict(axes)
    else:
        dimensions, shape = (["case"], [len(varied)]) if keys else ([], [])
        coordinates = {key: ("case", [values[key] for values in varied]) for key in keys}
    angle = numpy.asarray(results[0].series["cam_angle"])
    coordinates["cam_angle"] = ("cam_angle", angle, {"units": "rad", "long_name": results[0].meanings["cam_angle"]})
    variables = {}
    for kind in ("series", "scalars"):
        for name in dict.fromkeys(name for result in results for name in getattr(result, kind)):
            if name == "cam_angle":
                continue
            rows = [len(angle)] if kind == "series" else []
            absent = numpy.full(rows, numpy.nan) if rows else numpy.nan
            values = numpy.array([getattr(result, kind).get(name, absent) for result in results]).reshape(shape + rows)
            owner = next(result for result in results if name in result.units)
            variables[name] = (dimensions + ["cam_angle"] * len(rows), values,
                               {"units": owner.units[name], "long_name": owner.meanings[name]})
    remarks = numpy.array(["\n".join(result.remarks) for result in results]).reshape(shape)
    variables["remarks"] = (dimensions, remarks)
    return xarray.Dataset(variables, coordinates, {"camroller_version": __version__})


class _Stepped(Handle):
    """What is driven step by step."""

    @property
    def angle(self):
        """Present cam angle [rad]."""
        return getattr(LIBRARY, f"camroller_{self._kind}_angle")(self._pointer)

    @property
    def remarks(self):
        """Remarks on the last step, a list of `Remark`, mostly empty: contact lost, laws outside their ranges, films too thin for them."""
        return [Remark(*texts) for texts in list_texts(f"{self._kind}_remark", 2, self._pointer)]

    def halt(self):
        """The engine has stopped: rollers come to rest, and the next step starts without spin."""
        call(f"{self._kind}_halt", self._pointer)

    _instead = "; save() gives a block of bytes that can be, from which restore() makes another one of the same case"

    def _save(self, size):
        buffer = create_string_buffer(size)
        call(f"{self._kind}_save", self._pointer, buffer, size)
        return buffer.raw


class Simulation(_Stepped):
    """A follower at a cam angle [rad]; lobe 1 is the case's lift, 2 its second lift."""

    _kind = "simulation"

    def __init__(self, case, angle=0.0, lobe=1):
        self._take("simulation_new", _checked(case)._pointer, lobe, angle)

    def step(self, angle, start, end=None):
        """Advance to a cam angle beyond the present one, with `Inputs` at both ends; without `end` they do not change."""
        outcome = Outcome()
        call("simulation_step", self._pointer, angle, byref(start), byref(end or start), byref(outcome))
        return outcome

    def value(self, name):
        """Number at the end of the last step, by the name of a follower's series, or of one of its torques by source, as
        `torque_contact`."""
        value = c_double()
        call("simulation_value", self._pointer, encoded(name, "a name"), byref(value))
        return value.value

    def save(self):
        """A block of bytes, from which `restore` makes the same follower in another process."""
        return self._save(LIBRARY.camroller_simulation_save_size())

    @classmethod
    def restore(cls, case, block):
        """The follower that was saved, of the same case."""
        return cls._make("simulation_restore", _checked(case)._pointer, block, len(block))


class Shaft(_Stepped):
    """All followers of a case with their camshafts and bearings, at the cam angle of the first cam [rad]."""

    _kind = "shaft"

    def __init__(self, case, angle=0.0, threads=1):
        self._take("shaft_new", _checked(case)._pointer, angle, threads)

    @property
    def cams(self):
        """Where each cam stands."""
        cams = [Cam() for _ in range(LIBRARY.camroller_shaft_cams(self._pointer))]
        for number, cam in enumerate(cams, 1):
            call("shaft_cam", self._pointer, number, byref(cam))
        return cams

    def step(self, angle, start, end=None, gas_pressures=None):
        """Advance to a cam angle beyond the present one, with `Inputs` at both ends; `gas_pressures` has a list with one for each cam
        at the start, and one for the end [Pa]."""
        outcome = ShaftOutcome()
        pressures = None
        if gas_pressures is not None:
            cams = LIBRARY.camroller_shaft_cams(self._pointer)
            if [len(row) for row in gas_pressures] != [cams, cams]:
                raise UsageError(f"gas_pressures: give a pressure for each of the {cams} cams at the start, and at the end")
            pressures = (c_double * (2 * cams))(*gas_pressures[0], *gas_pressures[1])
        call("shaft_step", self._pointer, angle, byref(start), byref(end or start), pressures, byref(outcome))
        return outcome

    def follower(self, cam):
        """What the last step gave for the follower of a cam, from 1."""
        outcome = Outcome()
        call("shaft_follower", self._pointer, cam, byref(outcome))
        return outcome

    def value(self, name, cam=0):
        """Number at the end of the last step: of the follower of a cam, from 1, or of the camshafts, 0."""
        value = c_double()
        call("shaft_value", self._pointer, cam, encoded(name, "a name"), byref(value))
        return value.value

    def quantities(self, cam=0):
        """Names, units and meanings of the numbers of a follower, or of the camshafts, 0."""
        return [Quantity(texts) for texts in list_texts("shaft_quantity", 3, self._pointer, cam, least=1)]

    def values(self, cam=0):
        """All numbers at the end of the last step, by name."""
        names = [quantity.name for quantity in self.quantities(cam)]
        numbers = (c_double * len(names))()
        call("shaft_values", self._pointer, cam, numbers, len(names))
        return dict(zip(names, numbers))

    def save(self):
        """A block of bytes, from which `restore` makes the same shaft in another process."""
        return self._save(LIBRARY.camroller_shaft_save_size(self._pointer))

    @classmethod
    def restore(cls, case, block, threads=1):
        """The shaft that was saved, of the same case."""
        return cls._make("shaft_restore", _checked(case)._pointer, block, len(block), threads)
