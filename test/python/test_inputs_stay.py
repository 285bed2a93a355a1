"""No result replaces what it was computed from, nor anything that is no regular file."""

import os
import shutil
import socket
import stat

import h5py
import pytest

from conftest import ROOT, run
from sweeps import EARLIER_RESULT

USAGE, FILE_ERROR = 2, 6  # exit codes
COARSE = ["--set", "output.angle_step_deg=20", "--set", "numerics.accuracy=1e-3"]
WRITERS = ["run", "sweep", "merge", "study", "audit", "ehl"]
DEVICE_NULL = (1, 3)  # the numbers of the device that swallows everything
SWEEP = "&sweep kind = 'table' table = 'tables/cases.{0}' /\n"
SWEPT_TABLES = ("&sweep kind = 'zip' key_1 = 'gas_force.table' values_1 = 'tables/cylinder_pressure.txt', 'tables/other.txt' "
                "key_2 = 'operating_point.speed_rpm' values_2 = 300, 600 /\n")


@pytest.fixture
def folder(tmp_path):
    """Decks with every kind of table."""
    shutil.copytree(ROOT / "decks/tables", tmp_path / "tables")
    cams = (ROOT / "decks/three_cam_head.nml").read_text().partition("&sweep")[0]
    lift = (ROOT / "decks/tabulated_lift.nml").read_text().partition("&sweep")[0]
    (tmp_path / "tables/cases.csv").write_text("operating_point.speed_rpm\n300\n600\n")
    with h5py.File(tmp_path / "tables/cases.h5", "w") as file:
        file["operating_point.speed_rpm"] = [300.0, 600.0]
    pressure = next((tmp_path / "tables").glob("*pressure*"))
    (tmp_path / "tables/other.txt").write_text(pressure.read_text())
    (tmp_path / "cams.nml").write_text(cams)
    (tmp_path / "lift.nml").write_text(lift)
    (tmp_path / "csv.nml").write_text(lift + SWEEP.format("csv"))
    (tmp_path / "h5.nml").write_text(lift + SWEEP.format("h5"))
    (tmp_path / "swept.nml").write_text(cams + SWEPT_TABLES.replace("cylinder_pressure.txt", pressure.name))
    return tmp_path


def everything(folder):
    """All files of a folder and what is in them."""
    return {path.relative_to(folder): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def refused(camroller, folder, words, target, code):
    """The message of a refusal that changes nothing."""
    before = everything(folder)
    result = run(camroller, *words, "-o", target, folder=folder)
    assert result.returncode == code, result.stderr
    assert result.stdout == "" and result.stderr.startswith("camroller: ") and result.stderr.count("\n") == 1
    assert everything(folder) == before
    return result.stderr


@pytest.mark.parametrize("spelling", ["lift.nml", "./lift.nml", "tables/../lift.nml", "absolute", "link", "hard link", "link to link"])
def test_the_deck_is_not_overwritten_under_any_of_its_names(camroller, folder, spelling):
    target = spelling
    if spelling == "absolute":
        target = folder / "lift.nml"
    elif spelling == "hard link":
        os.link(folder / "lift.nml", folder / target)
    elif "link" in spelling:
        (folder / "one").symlink_to("lift.nml")
        target = "one"
        if spelling == "link to link":
            (folder / "two").symlink_to(folder / "one")
            target = "two"
    words = refused(camroller, folder, ["run", "lift.nml", *COARSE], target, USAGE)
    assert words == f"camroller: '{target}' would replace 'lift.nml', which is read; give another name\n"


@pytest.mark.parametrize("command", WRITERS)
def test_no_command_overwrites_the_deck(camroller, folder, command):
    refused(camroller, folder, [command, "lift.nml", *COARSE], "./lift.nml", USAGE)


@pytest.mark.parametrize("command", WRITERS)
@pytest.mark.parametrize("deck, table", [("lift", "lift"), ("cams", "pressure"), ("csv", "cases.csv"), ("h5", "cases.h5"),
                                         ("swept", "other")])
def test_no_table_is_overwritten(camroller, folder, deck, table, command):
    target = next(path for path in sorted((folder / "tables").iterdir()) if table in path.name)
    assert "which is read" in refused(camroller, folder, [command, f"{deck}.nml", *COARSE], target, USAGE)


def test_a_table_given_by_set_is_not_overwritten(camroller, folder):
    table = next((folder / "tables").glob("*lift*"))
    shutil.copy(table, folder / "mine.txt")
    refused(camroller, folder, ["run", "lift.nml", *COARSE, "--set", "lift.table=mine.txt"], "./mine.txt", USAGE)


@pytest.mark.parametrize("spelling", ["r.h5", "./r.h5", "link.h5"])
def test_export_does_not_overwrite_its_result(camroller, folder, spelling):
    assert run(camroller, "run", "lift.nml", "-o", "r.h5", *COARSE, folder=folder).returncode == 0
    (folder / "link.h5").symlink_to("r.h5")
    refused(camroller, folder, ["export", "r.h5"], spelling, USAGE)
    refused(camroller, folder, ["export", "./r.h5", "--summary"], spelling, USAGE)


def odd_target(folder, kind):
    """Something that is no regular file."""
    path = folder / "odd"
    if kind == "a folder":
        path.mkdir()
    elif kind == "a pipe":
        os.mkfifo(path)
    elif kind == "a socket":
        with socket.socket(socket.AF_UNIX) as server:
            server.bind("odd")  # in the present folder, since the path of a socket is short
    elif kind == "a link that leads nowhere":
        path.symlink_to("nowhere")
    elif kind == "a device":
        try:
            os.mknod(path, stat.S_IFCHR | 0o666, os.makedev(*DEVICE_NULL))
        except PermissionError:
            pytest.skip("only root can make a device")
    return path


@pytest.mark.parametrize("command", [*WRITERS, "export"])
@pytest.mark.parametrize("kind", ["a folder", "a pipe", "a socket", "a link that leads nowhere", "a device", "a link to a device"])
def test_only_regular_files_are_replaced(camroller, folder, command, kind, monkeypatch):
    monkeypatch.chdir(folder)
    path = odd_target(folder, kind.removeprefix("a link to "))
    target = path
    if kind == "a link to a device":
        target = folder / "link"
        target.symlink_to("odd")
        kind = "a device"
    before = path.lstat()
    deck = "lift.nml"
    if command == "export":
        assert run(camroller, "run", "lift.nml", "-o", "r.h5", *COARSE, folder=folder).returncode == 0
        deck = "r.h5"
    words = refused(camroller, folder, [command, deck], target, FILE_ERROR)
    assert words == f"camroller: cannot write '{target}': it is {kind}, and only regular files are replaced\n"
    after = path.lstat()
    assert (after.st_mode, after.st_ino, after.st_rdev) == (before.st_mode, before.st_ino, before.st_rdev)


@pytest.mark.parametrize("command", ["run", "export"])
def test_a_link_is_followed(camroller, folder, command):
    (folder / "store").mkdir()
    (folder / "new").symlink_to("store/old")
    words = ["run", "lift.nml", *COARSE]
    (folder / "store/old").write_bytes(EARLIER_RESULT)
    if command == "export":
        assert run(camroller, *words, "-o", "r.h5", folder=folder).returncode == 0
        words = ["export", "r.h5"]
        (folder / "store/old").write_bytes(b"")
    before = (folder / "store/old").read_bytes()
    assert run(camroller, *words, "-o", "new", folder=folder).returncode == 0
    assert (folder / "new").is_symlink()
    assert os.listdir(folder / "store") == ["old"]
    assert (folder / "store/old").read_bytes() != before


def written(folder):
    """Words that write a file of each kind, before its name: text that `check` and `export` write, results."""
    return {"result": ["run", "lift.nml", *COARSE, "-o"], "another result": ["sweep", "cams.nml", *COARSE, "-o"],
            "series": ["export", "r.h5", "-o"], "summary": ["export", "r.h5", "--summary", "--format", "plain", "-o"],
            "columns": ["export", "r.h5", "--columns", "contact_load", "--format", "json", "-o"],
            "mechanism": ["check", "lift.nml", "--draw"], "lift": ["check", "lift.nml", "--draw-lift"],
            "cam": ["check", "lift.nml", "--cam"], "fmu": ["fmu", "lift.nml", "--library", "lib", "-o"]}


KINDS = {"result": "result", "another result": "result", "series": "exported table", "summary": "exported table",
         "columns": "exported table", "mechanism": "drawing", "lift": "drawing", "cam": "table of a cam", "fmu": "FMU"}


@pytest.mark.parametrize("what", KINDS)
def test_a_file_replaces_an_earlier_one_of_its_kind_alone(camroller, folder, what):
    """What a user has written is not lost, nor an output of another kind, whatever its name."""
    words = written(folder)
    (folder / "lib").mkdir()
    # what tells the machine of a library, for which nothing else is looked at here
    (folder / "lib/camroller_fmi.so").write_bytes(b"\x7fELF" + bytes(14) + b"\x3e" + bytes(13))
    for name, other in (("result", "r.h5"), ("cam", "cam.csv"), ("mechanism", "m.svg"), ("series", "r.csv")):
        assert run(camroller, *words[name], other, folder=folder).returncode == 0
    shutil.copy(folder / "r.h5", folder / "other.h5")
    others = {"csv.nml": "", "other.h5": "result", "cam.csv": "table of a cam", "m.svg": "drawing", "r.csv": "exported table"}
    # a drawing is not written to a file that ends as another kind does
    ending = ".svg" if KINDS[what] == "drawing" else ""
    for other in others if ending else ():
        shutil.copy(folder / other, folder / (other + ending))
    before = everything(folder)
    for name, kind in others.items():
        if kind == KINDS[what]:
            continue
        other = name + ending
        result = run(camroller, *words[what], other, folder=folder)
        assert result.returncode == FILE_ERROR
        assert f"'{other}' exists and is no earlier {KINDS[what]} of camroller, which alone is replaced; give another" in result.stderr
        assert everything(folder) == before
    for _ in range(2):
        result = run(camroller, *words[what], "new", folder=folder)
        assert result.returncode == 0, result.stderr


def test_only_regular_files_are_read_as_results(camroller, tmp_path):
    os.mkfifo(tmp_path / "pipe")
    for command in ("export", "rerun"):
        result = run(camroller, command, "pipe", folder=tmp_path)
        assert (result.returncode, result.stderr) == (FILE_ERROR, "camroller: cannot read 'pipe': it is a pipe\n")
