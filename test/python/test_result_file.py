"""The result file as other programs see it, and what is left where it cannot be written."""

import fnmatch
import os
import pathlib
import re
import resource
import signal
import subprocess
import time

import h5py
import numpy
import pytest
import xarray

from conftest import done
from sweeps import EARLIER_RESULT

ROOT = pathlib.Path(__file__).resolve().parents[2]
DECK = ROOT / "decks/thesis.nml"
ANGLE_STEP = 5.0  # degree
CASES = 9
FILE_ERROR = 6  # exit code


def run(camroller, target, **options):
    """Run the deck with few angles."""
    command = [camroller, "run", str(DECK), "-o", str(target), "--set", f"output.angle_step_deg={ANGLE_STEP}", "--quiet"]
    return subprocess.run(command, capture_output=True, text=True, stdin=subprocess.DEVNULL, check=False, **options)


@pytest.fixture(scope="module")
def result_file(camroller, tmp_path_factory):
    """A result file with all nine cases."""
    target = tmp_path_factory.mktemp("results") / "thesis.h5"
    finished = run(camroller, target)
    assert finished.returncode == 0, finished.stderr
    assert os.listdir(target.parent) == [target.name]
    return target


def objects(file):
    """All objects of a file by name."""
    found = {}
    file.visititems(lambda name, thing: found.update({name: thing}))
    return found


def test_file_is_marked_complete(result_file):
    with h5py.File(result_file) as file:
        assert file.attrs["format"] == "camroller result"
        assert file.attrs["format_version"] == 1
        assert file.attrs["complete"] == 1
        assert "(case, cam_angle)" in file.attrs["axes"]
        assert set(file) == {"case", "series", "summary", "sweep", "deck", "run"}


def test_axes_are_case_and_angle(result_file):
    with h5py.File(result_file) as file:
        angle = file["series/cam_angle"]
        assert angle.attrs["units"] == "degree"
        assert numpy.array_equal(angle[:], numpy.arange(0, 360, ANGLE_STEP))
        assert file["case"][:].tolist() == list(range(CASES))
        for name, dataset in file["series"].items():
            if name == "cam_angle":
                continue
            assert dataset.shape == (CASES, angle.size), name
            assert [list(axis.keys()) for axis in dataset.dims] == [["case"], ["cam_angle"]], name
            assert dataset.dims[0][0] == file["case"] and dataset.dims[1][0] == angle, name
        for group in ("summary", "sweep"):
            for name, dataset in file[group].items():
                assert dataset.shape == (CASES,), name
                assert list(dataset.dims[0].keys()) == ["case"], name


def test_every_quantity_has_unit_meaning_and_scope(result_file):
    with h5py.File(result_file) as file:
        for group in ("series", "summary"):
            assert len(file[group]) > 1
            for name, dataset in file[group].items():
                for attribute in ("units", "long_name", "source"):
                    assert isinstance(dataset.attrs[attribute], str) and dataset.attrs[attribute], (name, attribute)


def test_every_case_has_numbers(result_file):
    with h5py.File(result_file) as file:
        assert file["summary/status"][:].tolist() == [0] * CASES
        for group in ("series", "summary"):
            for name, dataset in file[group].items():
                # a speed at which something that never happens would happen is infinite
                assert numpy.isfinite(dataset[:]).all() or name.endswith("_speed") and numpy.isposinf(dataset[:]).all(), name


def test_deck_and_run_are_kept(result_file):
    with h5py.File(result_file) as file:
        assert file["deck/text"].asstr()[()].rstrip() == DECK.read_text().rstrip()
        values = file["deck/values"]
        assert values["output.angle_step_deg"][()] == ANGLE_STEP
        assert {dataset.attrs["given"] for dataset in values.values()} == {"given", "default"}
        # the needles are plain ones, the method has steps of its own, the sweep is a grid of lists
        idle = {key for key, dataset in values.items() if dataset.attrs["used"] == "no"}
        assert {"needle_bearing.pin_law", "numerics.step_deg", "sweep.seed", "sweep.scale_1"} < idle
        assert {dataset.attrs["used"] for dataset in values.values()} == {"yes", "no"} and "film.law" not in idle
        assert values["numerics.max_cycles"].dtype.kind == "i" and values["spring.stiffness_N_m"].dtype.kind == "f"
        for name in ("program", "version", "commit", "compiler", "options", "date", "command"):
            assert file["run"].attrs[name], name
        assert sorted(file["sweep"]) == ["operating_point.oil_temperature_degC", "operating_point.speed_rpm"]
        speeds = file["sweep/operating_point.speed_rpm"]
        assert set(speeds[:]) == {300.0, 600.0, 900.0}
        assert speeds.attrs["units"]


def test_xarray_opens_it_as_netcdf(result_file):
    with xarray.open_dataset(result_file, engine="h5netcdf", group="series") as series:
        assert series["contact_load"].dims == ("case", "cam_angle")
        assert series["contact_load"].attrs["units"] == "N"
        assert float(series["contact_load"].sel(cam_angle=180.0)[0]) > 0
        assert set(series.coords) == {"cam_angle"}, "the scale of the cases is in the root"
    with xarray.open_dataset(result_file, engine="h5netcdf", group="summary") as summary:
        assert dict(summary.sizes) == {"case": CASES}
    with xarray.open_datatree(result_file, engine="h5netcdf") as tree:
        assert set(tree["series/contact_load"].coords) == {"case", "cam_angle"}
        assert set(tree["sweep"].to_dataset().sizes) == {"case"}


def test_runs_differ_in_nothing_but_date_and_command(camroller, result_file, tmp_path):
    assert run(camroller, tmp_path / "again.h5").returncode == 0
    with h5py.File(result_file) as first, h5py.File(tmp_path / "again.h5") as second:
        some, others = objects(first), objects(second)
        assert list(some) == list(others)
        for name, thing in some.items():
            if isinstance(thing, h5py.Dataset):
                value, other = numpy.asarray(thing[()]), numpy.asarray(others[name][()])
                same = numpy.array_equal(value, other) if thing.dtype.kind == "O" else value.tobytes() == other.tobytes()
                assert same, name
            for attribute, value in thing.attrs.items():
                if name == "run" and attribute in ("date", "command"):
                    continue
                if attribute not in ("DIMENSION_LIST", "REFERENCE_LIST"):
                    assert value == others[name].attrs[attribute], (name, attribute)


def expect_failure(finished, target, words):
    """A clear message on one line, the exit code of file errors, no trace beside the earlier file."""
    assert finished.returncode == FILE_ERROR, finished.stderr
    assert words in finished.stderr
    assert finished.stderr.startswith("camroller: ") and finished.stderr.count("\n") == 1
    assert target.read_bytes() == EARLIER_RESULT
    assert os.listdir(target.parent) == [target.name]


@pytest.mark.parametrize("limit", [10_000, 700_000])
def test_a_limit_on_file_sizes_is_an_error(camroller, tmp_path, limit):
    target = tmp_path / "old.h5"
    target.write_bytes(EARLIER_RESULT)
    finished = run(camroller, target, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)))
    expect_failure(finished, target, f"cannot write '{target}': File too large")


@pytest.mark.parametrize("room", [0, 300, 600, 900])
def test_a_full_disk_is_an_error(camroller, tmp_path, room):
    disk = tmp_path / "disk"
    disk.mkdir()
    mount = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=2m", "tmpfs", str(disk)], capture_output=True, check=False)
    if mount.returncode:
        pytest.skip("a small disk can only be mounted by root; limits on file sizes are tested instead")
    try:
        target = disk / "folder" / "old.h5"
        target.parent.mkdir()
        target.write_bytes(EARLIER_RESULT)
        (disk / "filling").write_bytes(bytes(2**21 - 2**13 - 1024 * room))
        finished = run(camroller, target)
        expect_failure(finished, target, "No space left on device")
    finally:
        subprocess.run(["umount", str(disk)], check=True)


def test_a_file_of_a_newer_format_is_refused(camroller, result_file, tmp_path):
    newer = tmp_path / "newer.h5"
    newer.write_bytes(result_file.read_bytes())
    with h5py.File(newer, "a") as file:
        file.attrs.modify("format_version", file.attrs["format_version"] + 1)
    finished = subprocess.run([camroller, "export", newer], capture_output=True, text=True, check=False)
    assert finished.returncode == FILE_ERROR and "written by a newer camroller" in finished.stderr


@pytest.mark.parametrize("place, words", [
    ("no/such/folder/a.h5", "there is no folder 'no/such/folder/'"),
    ("/proc/a.h5", "cannot write '/proc/a.h5': "),
    ("/", "it is a folder"),
])
def test_a_path_that_cannot_be_written_is_an_error(camroller, place, words):
    finished = run(camroller, place)
    assert finished.returncode == FILE_ERROR
    assert words in finished.stderr


def test_a_file_keeps_the_permissions_of_the_one_it_replaces(camroller, tmp_path):
    """Of a result, which HDF5 creates, and of a table."""
    coarse = ["--point", "speed_rpm=600", "--set", "output.angle_step_deg=20", "--quiet"]
    for name, arguments in (("r.h5", ["run", DECK, *coarse]), ("r.csv", ["export", "r.h5"])):
        words = [camroller, *arguments, "-o", name]
        for mode in (None, 0o600, 0o664):
            if mode is not None:
                (tmp_path / name).chmod(mode)
            subprocess.run(words, cwd=tmp_path, check=True, timeout=60)
            assert mode is None or (tmp_path / name).stat().st_mode & 0o777 == mode


def test_a_killed_run_leaves_the_earlier_file(camroller, tmp_path):
    target = tmp_path / "old.h5"
    target.write_bytes(EARLIER_RESULT)
    command = [camroller, "run", str(DECK), "-o", str(target), "--set", "output.angle_step_deg=0.002"]
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as running:
        until = time.monotonic() + 20.0
        while not any(".unfinished-" in name for name in os.listdir(tmp_path)) and time.monotonic() < until:
            time.sleep(0.001)
        running.kill()
    assert running.returncode == -signal.SIGKILL, "it ended before it could be killed"
    assert target.read_bytes() == EARLIER_RESULT


def rows_of_page():
    """Patterns of paths and their axes, in the order of the page: the first that fits a dataset is its row."""
    lines = (ROOT / "doc/result_file.md").read_text(encoding="utf-8").splitlines()
    for line in lines:
        if line.startswith("| `/"):
            paths, axes = (cell.strip() for cell in line.split("|")[1:3])
            for path in re.findall(r"`(/[^`]*)`", paths):
                yield path, tuple(axes.split(", ")) if axes != "-" else None


def axes_of(data):
    """Names of the dimensions."""
    if data.is_scale:
        return (data.name.rpartition("/")[2],)
    return tuple(dimension[0].name.rpartition("/")[2] if len(dimension) else "-" for dimension in data.dims)


def test_a_result_may_have_the_longest_name_that_a_file_can_have(camroller, tmp_path):
    name = 252 * "x" + ".h5"
    done(camroller, "run", DECK, "--no-sweep", "-o", name, "--quiet", folder=tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == [name]


@pytest.mark.once
def test_page_of_the_result_file_has_every_dataset_with_its_axes(camroller, tmp_path):
    table = tmp_path / "points.txt"
    table.write_text('operating_point.speed_rpm "measured.torque [N m]"\n300 1\n900 -\n')
    profiles = tmp_path / "profiles.nml"
    profiles.write_text((ROOT / "decks/heated_contact.nml").read_text() + "\n&ehl\n   profiles = .true.\n/\n")
    measured = tmp_path / "measured.nml"
    text = (ROOT / "decks/thesis.nml").read_text()
    measured.write_text(text[:text.index("&sweep")] + "&sweep\n   kind = 'table'\n   table = 'points.txt'\n/\n")
    commands = [("run", ROOT / "decks/tribofilm.nml", "--set", "sweep.values_1=900"), ("run", measured), ("ehl", ROOT / "decks/three_cam_head.nml", "--set", "sweep.values_1=1500", "--set", "sweep.count_2=2"),
                ("run", ROOT / "decks/lash_adjuster.nml", "--set", "sweep.values_1=2350", "--set", "numerics.accuracy=1e-2"),
                ("run", ROOT / "decks/tabulated_lift.nml", "--set", "mechanism.contact_width_mm=0.2"),
                ("run", profiles, "--set", "sweep.values_1=900", "--set", "sweep.values_2=25", "--set", "output.angle_step_deg=10"),
                ("run", ROOT / "decks/four_cylinder.nml", "--point", "speed_rpm=2000"),
                ("run", DECK, "--no-sweep", "--set", "effects.select=needed"),
                ("run", DECK, "--set", "sweep.values_1=300,3000", "--set", "sweep.values_2=95", "--set", "case.contact_policy=stop")]
    rows = list(rows_of_page())
    unused = {path for path, _ in rows}
    for number, (command, deck, *options) in enumerate(commands):
        target = tmp_path / f"{number}.h5"
        subprocess.run([camroller, command, deck, "-o", target, "--quiet", *options], stdin=subprocess.DEVNULL, capture_output=True, check=False)
        with h5py.File(target) as file:
            for name, data in objects(file).items():
                if isinstance(data, h5py.Dataset):
                    path, axes = next(row for row in rows if fnmatch.fnmatchcase("/" + name, row[0]))
                    assert axes is None or axes_of(data) == axes, name
                    unused.discard(path)
                    if path.endswith("/*") and axes:
                        assert ("source" in data.attrs) == (path not in ("/sweep/*", "/measured/*")), name
                        assert {"units", "long_name"} <= set(data.attrs), name
                        assert not data.attrs["long_name"].startswith("its"), name
    assert not unused
