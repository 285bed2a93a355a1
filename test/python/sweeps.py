"""Shared by the tests of sweeps: a deck that is quick to compute, comparison of files bit by bit."""

import functools
import pathlib

import h5py
import numpy

from conftest import ROOT

THESIS = ROOT / "decks/thesis.nml"
GRID = ("key_1 = 'operating_point.speed_rpm' from_1 = 400 to_1 = 900 count_1 = 6 "
        "key_2 = 'operating_point.oil_temperature_degC' values_2 = 40, 60, 80, 100")
# what a result may replace: how an earlier one begins, and what it says of itself
EARLIER_RESULT = b"\x89HDF camroller result"
# facts of the run itself, and references between objects, whose bits are addresses
NOT_COMPARED = {"date", "command", "REFERENCE_LIST", "DIMENSION_LIST"}


def write_deck(path, sweep=GRID):
    """The reference deck with few output angles, little accuracy and another sweep."""
    text = THESIS.read_text()
    text = text[:text.index("&sweep")]
    path.write_text(f"{text}&output angle_step_deg = 10 /\n&numerics accuracy = 1e-3 /\n&sweep\n   {sweep}\n/\n")
    return path


def content(path):
    """Every object of a file: bytes or texts of its values, and its attributes; read once, for a reference is compared many times."""
    state = pathlib.Path(path).stat()
    return _content(path, state.st_ino, state.st_mtime_ns, state.st_size)


@functools.lru_cache(maxsize=4)
def _content(path, *_state):
    found = {}

    def note(name, thing):
        values = None
        if isinstance(thing, h5py.Dataset):
            array = numpy.asarray(thing[()])
            values = array.tolist() if array.dtype == object else array.tobytes()
        found[name] = (values, {key: str(thing.attrs[key]) for key in thing.attrs if key not in NOT_COMPARED})

    with h5py.File(path) as file:
        note("/", file)
        file.visititems(note)
    return found


def same(one, other):
    """Do two files hold the same, in the same order, to the last bit?"""
    first, second = content(one), content(other)
    assert list(first) == list(second)
    for name, thing in first.items():
        assert thing == second[name], name
    return True
