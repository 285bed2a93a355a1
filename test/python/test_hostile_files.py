"""Result files that are damaged or of another shape are told in words: no number of them is shown, nothing breaks down."""

import shutil

import h5py
import numpy
import pytest

from conftest import ROOT, run

USAGE, DECK_ERROR, FILE_ERROR = 2, 3, 6  # exit codes
COARSE = ["--set", "output.angle_step_deg=20", "--set", "numerics.accuracy=1e-3", "--quiet"]
SEAL = 32  # bytes
CASES, ANGLES = 4, 18
EXPORT, SUMMARY, RERUN = ["export", "x.h5"], ["export", "x.h5", "--summary"], ["rerun", "x.h5", "--threads", "2"]
DAMAGED = "it is damaged, its bytes are not those that were written"


@pytest.fixture(scope="module")
def written(camroller, tmp_path_factory):
    """A result as the program wrote it."""
    path = tmp_path_factory.mktemp("hostile") / "r.h5"
    result = run(camroller, "run", ROOT / "decks/thesis.nml", "-o", path, *COARSE, "--set", "sweep.values_1=300,900", "--set",
                 "sweep.values_2=60,95", folder=path.parent)
    assert result.returncode == 0, result.stderr
    return path


@pytest.fixture
def folder(written, tmp_path):
    """A copy of it, `x.h5`."""
    shutil.copy(written, tmp_path / "x.h5")
    return tmp_path


def expect_words(camroller, folder, command, words, code=FILE_ERROR):
    """One line that says what is wrong; nothing of the file is shown, and no words of a library go before it."""
    result = run(camroller, *command, folder=folder)
    assert result.returncode == code, (result.returncode, result.stderr)
    assert words in result.stderr
    assert result.stderr.startswith("camroller: ") and result.stderr.count("\n") == 1
    assert result.stdout == ""


def put(name, value):
    """Exchange a dataset, its attributes kept."""
    def change(file):
        kept = {key: text for key, text in file[name].attrs.items() if key in ("units", "long_name", "source")}
        del file[name]
        file[name] = value
        for key, text in kept.items():
            file[name].attrs[key] = text
    return change


def huge(name, extent):
    """A dataset that says that it is large and holds nothing."""
    def change(file):
        del file[name]
        file.create_dataset(name, shape=(extent,), dtype="i4", chunks=(1000,)).attrs["units"] = "1"
    return change


def attribute(name, key, value):
    """Exchange an attribute."""
    return lambda file: file[name].attrs.__setitem__(key, value)


SHAPES = {
    "two axes of angles": (put("series/cam_angle", numpy.zeros((ANGLES, 2))), EXPORT, "'/series/cam_angle' of 'x.h5' has 2 axes"),
    "a single angle": (put("series/cam_angle", 5.0), EXPORT, "'/series/cam_angle' of 'x.h5' has 0 axes"),
    "texts as angles": (put("series/cam_angle", ["a"]*ANGLES), EXPORT, "'/series/cam_angle' of 'x.h5' holds no numbers"),
    "more angles": (put("series/cam_angle", numpy.zeros(ANGLES + 1)), EXPORT, "does not have as many values as those beside it"),
    "a single case": (put("case", 5), SUMMARY, "'/case' of 'x.h5' has 0 axes"),
    "a single case, again": (put("case", 5), RERUN, "'/case' of 'x.h5' has 0 axes"),
    "two axes of cases": (put("case", numpy.zeros((CASES, 2), int)), RERUN, "'/case' of 'x.h5' has 2 axes"),
    "no case": (put("case", h5py.Empty("i4")), SUMMARY, "'/case' of 'x.h5'"),
    "records as cases": (put("case", numpy.zeros(CASES, [("a", "f8"), ("b", "f8")])), SUMMARY, "'/case' of 'x.h5' holds no numbers"),
    "4 TB of cases": (huge("case", 10**12), SUMMARY, "'/case' of 'x.h5' is damaged: it has fewer values than its size says"),
    "2**31 cases": (huge("case", 2**31), RERUN, "'/case' of 'x.h5' is damaged: it has fewer values than its size says"),
    "10**8 cases": (huge("case", 10**8), SUMMARY, "'/case' of 'x.h5' is damaged: it has fewer values than its size says"),
    "a group as cases": (lambda file: (file.__delitem__("case"), file.create_group("case")), RERUN, "cannot read '/case' of 'x.h5'"),
    "three axes of a series": (put("series/contact_load", numpy.zeros((CASES, ANGLES, 2))), EXPORT, "has 3 axes where a result has 2"),
    "a short series": (put("series/contact_load", numpy.zeros((CASES, 3))), EXPORT, "does not have as many values"),
    "a short series, again": (put("series/contact_load", numpy.zeros((CASES, 3))), RERUN, "has fewer values than the rest"),
    "more cases of a scalar": (put("summary/mean_torque_drive", numpy.zeros(CASES + 1)), SUMMARY, "does not have as many values"),
    "fewer cases of a scalar": (put("summary/status", numpy.zeros(1)), RERUN, "has fewer values than the rest"),
    "a deck of fixed length": (put("deck/text", numpy.bytes_("&case /")), RERUN, "'/deck/text' of 'x.h5' holds texts of fixed length"),
    "a number as deck": (put("deck/text", 7), RERUN, "'/deck/text' of 'x.h5' holds no texts"),
    "two decks": (put("deck/text", ["a", "b"]), RERUN, "'/deck/text' of 'x.h5' has 1 axes"),
    "many values of an attribute": (attribute("/", "format_version", numpy.arange(1000)), EXPORT, "'/:format_version' of 'x.h5' is not one"),
    "many texts of an attribute": (attribute("run", "options", ["a"]*1000), RERUN, "'/run:options' of 'x.h5' is not one value"),
    "many units": (attribute("series/contact_load", "units", ["a"]*1000), EXPORT, "'/series/contact_load:units' of 'x.h5' is not one value"),
    "a number as text": (attribute("run", "commit", 7), RERUN, "'/run:commit' of 'x.h5' holds no texts"),
}


@pytest.mark.parametrize("name", SHAPES)
def test_datasets_of_unexpected_shape_are_refused(camroller, folder, name):
    change, command, words = SHAPES[name]
    with h5py.File(folder / "x.h5", "r+") as file:
        change(file)
    expect_words(camroller, folder, command, words)


def test_a_table_of_a_deck_has_two_columns(camroller, folder):
    run(camroller, "run", ROOT / "decks/tabulated_lift.nml", "-o", "x.h5", *COARSE, folder=folder)
    with h5py.File(folder / "x.h5", "r+") as file:
        assert file["deck/table_lift"].shape[0] == 2
        put("deck/table_lift", numpy.zeros((3, 50)))(file)
    expect_words(camroller, folder, RERUN, "'/deck/table_lift' of 'x.h5' does not have two columns")


@pytest.mark.parametrize("value", [numpy.zeros((2, 2)), 300.0, h5py.Empty("f8")])
def test_a_table_of_cases_has_one_axis(camroller, tmp_path, value):
    with h5py.File(tmp_path / "cases.h5", "w") as file:
        file["operating_point.speed_rpm"] = value
    deck = (ROOT / "decks/thesis.nml").read_text().partition("&sweep")[0]
    (tmp_path / "deck.nml").write_text(deck + "&sweep kind = 'table' table = 'cases.h5' /\n")
    result = run(camroller, "check", "deck.nml", folder=tmp_path)
    assert result.returncode == DECK_ERROR
    assert "'/operating_point.speed_rpm' of 'cases.h5'" in result.stderr


def test_angles_are_computed_again_too(camroller, folder):
    with h5py.File(folder / "x.h5", "r+") as file:
        file["series/cam_angle"][3] += 1
    result = run(camroller, *RERUN, folder=folder)
    assert result.returncode == 7
    assert "  series/cam_angle: in 4 cases" in result.stderr


@pytest.mark.parametrize("command", [EXPORT, SUMMARY, RERUN], ids=" ".join)
@pytest.mark.parametrize("place", [0.0, 0.02, 0.3, 0.6, 0.9, 1.0])
def test_one_changed_bit_is_detected(camroller, folder, command, place):
    """Of the numbers too, which HDF5 does not look at."""
    path = folder / "x.h5"
    content = bytearray(path.read_bytes())
    content[int(place*(len(content) - SEAL - 1))] ^= 1
    path.write_bytes(content)
    expect_words(camroller, folder, command, "" if place == 0.0 else DAMAGED)


@pytest.mark.parametrize("length", [0, 7, 8, 100, 4096, 50000, -SEAL - 8])
def test_a_truncated_file_is_refused(camroller, folder, length):
    path = folder / "x.h5"
    path.write_bytes(path.read_bytes()[:length])
    expect_words(camroller, folder, EXPORT, "cannot read 'x.h5'")


def test_a_file_that_was_changed_on_purpose_is_read(camroller, folder):
    size = (folder / "x.h5").stat().st_size
    with h5py.File(folder / "x.h5", "r+") as file:
        file["summary/status"][0] = 0
    assert size - SEAL - 7 <= (folder / "x.h5").stat().st_size <= size - SEAL
    assert run(camroller, *RERUN, folder=folder).returncode == 0


@pytest.mark.once
def test_an_endless_list_of_objects_is_refused(camroller, folder):
    """HDF5 looks for a text in a heap whose first piece has no length, and stays there."""
    path = folder / "x.h5"
    content = bytearray(path.read_bytes()[:-SEAL])
    found = -1
    while (found := content.find(b"GCOL", found + 1)) >= 0:
        content[found + 16:found + 4096] = bytes(4080)
    path.write_bytes(content)
    expect_words(camroller, folder, RERUN, "cannot read 'x.h5': it is damaged, the HDF5 library does not finish reading it")


@pytest.mark.parametrize("place", [0, 4096, 2**31])
def test_trailing_bytes_of_another_file_are_not_taken_for_a_checksum(camroller, folder, place):
    """A seal of a longer or a shorter file."""
    path = folder / "x.h5"
    content = path.read_bytes()
    path.write_bytes(content[:-SEAL] + content[-SEAL:-SEAL + 8] + place.to_bytes(8, "little") + content[-SEAL + 16:])
    expect_words(camroller, folder, EXPORT, DAMAGED)
