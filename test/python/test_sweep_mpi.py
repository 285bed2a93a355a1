"""Sweeps shared by processes: the same file from 1, 2 and 4 of them, and what is left of one of them that dies."""

import os
import pathlib
import shutil
import signal
import subprocess
import time

import pytest

from conftest import ROOT, done, run
from sweeps import GRID, same, write_deck

PROGRAM = ROOT / "build/mpi/bin/camroller-mpi"
SERIAL = ROOT / "build/release/bin/camroller"
DECK, FILE, UNFINISHED = 3, 6, 8

pytestmark = pytest.mark.skipif(not PROGRAM.is_file() or not shutil.which("mpirun"), reason="no Open MPI here")
ENVIRONMENT = os.environ | {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMP_NUM_THREADS": "1"}


def by(ranks):
    """The program in several processes."""
    return ["mpirun", "--oversubscribe", "-n", str(ranks), str(PROGRAM)]


@pytest.fixture(scope="module")
def deck(tmp_path_factory):
    """A deck of 48 cases."""
    return write_deck(tmp_path_factory.mktemp("mpi") / "deck.nml", GRID.replace("count_1 = 6", "count_1 = 12"))


@pytest.fixture(scope="module")
def reference(deck):
    """Its result in one thread of one process."""
    done(str(SERIAL), "sweep", deck, "--threads", 1, "--quiet", folder=deck.parent)
    return deck.with_suffix(".h5")


@pytest.mark.parametrize("ranks", [1, 2, 4])
def test_number_of_processes_changes_no_bit(deck, reference, tmp_path, ranks):
    result = done(by(ranks), "sweep", deck, folder=tmp_path, env=ENVIRONMENT)
    assert result.stdout.count("deck.h5: 48 cases in ") == 1
    assert [path.name for path in tmp_path.iterdir()] == ["deck.h5"]
    assert same(reference, tmp_path / "deck.h5")


def test_a_mistake_is_printed_by_one_process(tmp_path):
    deck = write_deck(tmp_path / "deck.nml", "kind = 'sobol'")
    result = run(by(2), "sweep", deck, folder=tmp_path, env=ENVIRONMENT)
    assert result.returncode == DECK
    assert result.stderr.count("camroller: ") == 1


def test_results_survive_a_process_that_dies(tmp_path):
    """The others end with it; what all of them had done is gone on with by another number of processes, and by the program
    without MPI."""
    deck = write_deck(tmp_path / "deck.nml", GRID.replace("count_1 = 6", "count_1 = 500"))
    done(str(SERIAL), "sweep", deck, "-o", "reference.h5", "--quiet", folder=tmp_path)
    sweep = subprocess.Popen([*by(4), "sweep", str(deck)], cwd=tmp_path, env=ENVIRONMENT, stdout=subprocess.PIPE,
                             stderr=subprocess.PIPE)
    deadline = time.monotonic() + 60
    while len(list(tmp_path.glob("*.part-*"))) < 2 and time.monotonic() < deadline:
        time.sleep(0.002)
    os.kill(victim(tmp_path), signal.SIGKILL)
    sweep.communicate(timeout=60)
    assert sweep.returncode != 0
    assert not (tmp_path / "deck.h5").exists()
    again = run(by(2), "sweep", deck, "--resume", "--set", "sweep.wall_time_limit_s=1e-3", folder=tmp_path, env=ENVIRONMENT)
    assert again.returncode == UNFINISHED, again.stderr
    done(str(SERIAL), "sweep", deck, "--resume", folder=tmp_path)
    assert same(tmp_path / "reference.h5", tmp_path / "deck.h5")


def victim(folder):
    """The process that writes the last part file in a folder."""
    part = sorted(folder.glob("*.part-*"))[-1]
    for links in pathlib.Path("/proc").glob("[0-9]*/fd"):
        try:
            if any(os.readlink(link) == str(part) for link in links.iterdir()):
                return int(links.parent.name)
        except OSError:
            continue
    raise AssertionError(f"nobody writes {part}")
