"""What every writer says and leaves where the device takes nothing, and where nobody reads."""

import os
import stat
import subprocess

import pytest

from conftest import ROOT, run
from sweeps import EARLIER_RESULT

FILE_ERROR, UNFINISHED = 6, 8  # exit codes
COARSE = ["--set", "output.angle_step_deg=20", "--set", "numerics.accuracy=1e-3"]
ONE = ["--set", "sweep.values_1=300", "--set", "sweep.values_2=60"]
QUICK = ["--set", "sweep.values_1=900", "--set", "sweep.values_2=25"]  # with the slowest decay of a disturbance
DEVICE_FULL = (1, 7)  # the numbers of the device that is always full
# What commands print; those that write a file do so beside
PRINTED = {
    "help": ["help"], "help run": ["help", "run"], "run --help": ["run", "--help"], "version": ["version"], "defaults": ["defaults"],
    "defaults --markdown": ["defaults", "--markdown"], "check": ["check", "deck.nml", *ONE],
    "export": ["export", "result.h5"], "export --summary": ["export", "result.h5", "--summary"],
    "run": ["run", "deck.nml", "-o", "new.h5", *COARSE, *ONE], "sweep": ["sweep", "deck.nml", "-o", "new.h5", *COARSE],
    "sweep --resume": ["sweep", "deck.nml", "-o", "swept.h5", "--resume", *COARSE], "rerun": ["rerun", "result.h5"],
    "study": ["study", "deck.nml", "-o", "new.h5", "--quick", "--repeats", "1", *COARSE, *QUICK],
    "audit": ["audit", "deck.nml", "-o", "new.h5", "--repeats", "1", *COARSE, *ONE],
    "merge": ["merge", "deck.nml", "-o", "parted.h5", "--partial", *COARSE],
    "ehl": ["ehl", "film.nml", "-o", "new.h5", "--set", "sweep.values_1=300", *COARSE],
}


@pytest.fixture(scope="module")
def results(camroller, tmp_path_factory):
    """A folder with decks, a result, a finished sweep and one that was ended by its time."""
    folder = tmp_path_factory.mktemp("full")
    (folder / "deck.nml").write_text((ROOT / "decks/thesis.nml").read_text())
    (folder / "film.nml").write_text((ROOT / "decks/numerical_film.nml").read_text())
    assert run(camroller, "run", "deck.nml", "-o", "result.h5", *COARSE, folder=folder).returncode == 0
    assert run(camroller, "sweep", "deck.nml", "-o", "swept.h5", *COARSE, folder=folder).returncode == 0
    ended = ["--threads", "1", "--set", "sweep.wall_time_limit_s=1e-6"]
    assert run(camroller, "sweep", "deck.nml", "-o", "parted.h5", *COARSE, *ended, folder=folder).returncode == UNFINISHED
    return folder


@pytest.fixture(scope="module")
def full(results):
    """A device that is full, made for this test."""
    path = results / "full"
    try:
        os.mknod(path, stat.S_IFCHR | 0o600, os.makedev(*DEVICE_FULL))
        with path.open("w"):
            pass
    except OSError:
        pytest.skip("only root can make a device, and only where the file system takes some")
    return path


@pytest.fixture
def disk(tmp_path):
    """A small disk of two megabytes."""
    path = tmp_path / "disk"
    path.mkdir()
    mount = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=2m", "tmpfs", str(path)], capture_output=True, check=False)
    if mount.returncode:
        pytest.skip("a small disk can only be mounted by root")
    yield path
    subprocess.run(["umount", str(path)], check=True)


def leave(disk, room):
    """Fill a disk up to some room, in bytes."""
    free = os.statvfs(disk)
    (disk / "filling").write_bytes(bytes(free.f_bavail*free.f_frsize - room))


@pytest.mark.parametrize("name", sorted(PRINTED))
def test_a_full_standard_output_is_an_error(camroller, results, full, name):
    with full.open("w") as output:
        finished = run(camroller, *PRINTED[name], folder=results, stdout=output)
    assert finished.returncode == FILE_ERROR, finished.stderr
    assert "camroller: cannot write to standard output: No space left on device\n" in finished.stderr
    assert not [path.name for path in results.iterdir() if ".unfinished-" in path.name]


def test_a_full_standard_output_keeps_the_result_file(camroller, results, full, tmp_path):
    """The file was complete before anything was printed."""
    with full.open("w") as output:
        run(camroller, "run", results / "deck.nml", "-o", "new.h5", *COARSE, folder=tmp_path, stdout=output)
    assert "are the same to the last bit" in run(camroller, "rerun", "new.h5", folder=tmp_path).stdout


def test_a_full_error_unit_changes_no_exit_code(camroller, results, full):
    with full.open("w") as output:
        words = [camroller, "check", "none.nml"]
        assert subprocess.run(words, cwd=results, stdout=subprocess.PIPE, stderr=output, check=False).returncode == FILE_ERROR


@pytest.mark.parametrize("name", ["help", "export", "defaults", "check"])
def test_a_closed_standard_output_is_an_error(camroller, results, name):
    finished = run(camroller, *PRINTED[name], folder=results, preexec_fn=lambda: os.close(1))
    assert finished.returncode == FILE_ERROR
    assert "camroller: cannot write to standard output: " in finished.stderr


def test_no_file_is_opened_as_a_closed_standard_output(camroller, results, tmp_path):
    """A file that is opened where the output was would get what is printed."""
    words = ["run", results / "deck.nml", "-o", "new.h5", *COARSE]
    finished = run(camroller, *words, folder=tmp_path, preexec_fn=lambda: [os.close(number) for number in (0, 1)])
    assert finished.returncode == FILE_ERROR
    assert "are the same to the last bit" in run(camroller, "rerun", "new.h5", folder=tmp_path).stdout


@pytest.mark.parametrize("ignored", [False, True])
@pytest.mark.parametrize("name", ["help", "export", "defaults", "check", "run"])
def test_a_closed_pipe_is_no_error(camroller, results, name, ignored):
    """`camroller help | head -1`, whether the caller ignores the signal or not: quiet, and the work is done."""
    reading, writing = os.pipe()
    os.close(reading)
    finished = run(camroller, *PRINTED[name], folder=results, stdout=writing, restore_signals=not ignored)
    os.close(writing)
    assert finished.returncode == 0
    assert "camroller: " not in finished.stderr


@pytest.mark.parametrize("what", ["--series", "--summary"])
@pytest.mark.parametrize("part", [0.0, 0.5, 0.99])
def test_a_table_on_a_full_disk_leaves_the_earlier_one(camroller, results, disk, what, part):
    printed = run(camroller, "export", "result.h5", what, folder=results).stdout
    size, earlier = len(printed), printed + "earlier\n"
    target = disk / "folder" / "table.csv"
    target.parent.mkdir()
    target.write_text(earlier)
    leave(disk, 4096*int(part*size/4096))
    finished = run(camroller, "export", "result.h5", what, "-o", target, folder=results)
    assert finished.returncode == FILE_ERROR
    assert finished.stderr == f"camroller: cannot write '{target}': No space left on device\n"
    assert target.read_text() == earlier
    assert os.listdir(target.parent) == ["table.csv"]


def test_a_table_is_what_is_printed(camroller, results, tmp_path):
    printed = run(camroller, "export", "result.h5", folder=results).stdout
    assert run(camroller, "export", "result.h5", "-o", tmp_path / "table.csv", folder=results).returncode == 0
    assert (tmp_path / "table.csv").read_text() == printed
    assert printed.count("\n") == 2 + 18


@pytest.mark.parametrize("command", ["study", "audit", "ehl", "merge"])
def test_a_file_on_a_full_disk_leaves_the_earlier_one(camroller, results, disk, command):
    target = disk / "folder" / "new.h5"
    target.parent.mkdir()
    earlier = EARLIER_RESULT
    if command == "merge":  # replaces a partial file of the same study alone
        run(camroller, *PRINTED[command], folder=results)
        earlier = (results / "parted.h5").read_bytes()
    target.write_bytes(earlier)
    leave(disk, 4096)
    words = [str(target) if word == "new.h5" else word for word in PRINTED[command]]
    if command == "merge":
        for part in results.glob("parted.h5.part-rank-*"):
            target.with_name(part.name.replace("parted", "new")).symlink_to(part)
        words = [*PRINTED[command][:3], str(target), *PRINTED[command][4:]]
    before = sorted(os.listdir(target.parent))
    finished = run(camroller, *words, folder=results)
    assert finished.returncode == FILE_ERROR
    assert f"cannot write '{target}': " in finished.stderr
    assert target.read_bytes() == earlier
    assert sorted(os.listdir(target.parent)) == before


def test_a_sweep_stopped_by_a_full_disk_can_be_resumed(camroller, results, disk):
    leave(disk, 8192)
    words = ["sweep", results / "deck.nml", "-o", "new.h5", *COARSE]
    finished = run(camroller, *words, folder=disk)
    assert finished.returncode == FILE_ERROR
    assert "No space left on device" in finished.stderr
    assert not (disk / "new.h5").exists()
    (disk / "filling").unlink()
    finished = run(camroller, *words, "--resume", folder=disk)
    assert finished.returncode == 0, finished.stderr
    assert os.listdir(disk) == ["new.h5"]
