"""A sweep that is killed again and again ends in the same file as one that is left alone."""

import random
import re
import signal
import subprocess
import time

import pytest

from conftest import done, run
from sweeps import GRID, same, write_deck

KILLS = 50
SEED = 20
UNFINISHED = 8


@pytest.fixture(scope="module")
def deck(tmp_path_factory):
    """A deck of 160 cases."""
    return write_deck(tmp_path_factory.mktemp("kills") / "deck.nml", GRID.replace("count_1 = 6", "count_1 = 40"))


@pytest.fixture(scope="module")
def undisturbed(camroller, deck):
    """Its result, and how long it takes."""
    if "debug" in camroller:
        pytest.skip("the moment of a kill has nothing to do with run-time checks")
    start = time.monotonic()
    done(camroller, "sweep", deck, "--quiet", folder=deck.parent)
    return deck.with_suffix(".h5"), time.monotonic() - start


def test_sweep_killed_at_random_moments_can_be_resumed(camroller, deck, undisturbed, tmp_path):
    """Kills between start and end, assembly of the file included; a sweep that got to its end is compared and begun anew."""
    reference, duration = undisturbed
    moments = random.Random(SEED)
    kills = ends = torn = 0
    while kills < KILLS:
        # two thirds of the kills come early, so that what follows has something to go on with
        process = subprocess.Popen([camroller, "sweep", deck, "--resume", "--quiet"], cwd=tmp_path, stderr=subprocess.PIPE)
        try:
            process.wait(timeout=moments.uniform(0.0, duration * moments.choice((0.3, 0.6, 1.2))))
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGKILL)
            kills += 1
        process.communicate()
        assert process.returncode in (0, -signal.SIGKILL)
        torn += bool(list(tmp_path.glob("*.unfinished-*")))
        if (tmp_path / "deck.h5").exists():  # whatever ends it, a file of that name is a complete one
            assert same(reference, tmp_path / "deck.h5")
        if process.returncode == 0 or kills == KILLS:
            done(camroller, "sweep", deck, "--resume", "--quiet", folder=tmp_path)
            assert sorted(path.name for path in tmp_path.iterdir()) == ["deck.h5"]
            assert same(reference, tmp_path / "deck.h5")
            (tmp_path / "deck.h5").unlink()
            ends += 1
    print(f"{kills} kills, {ends} ends compared, {torn} of them while the file was made")


def test_sweep_stopped_by_sigterm_at_random_moments_can_be_resumed(camroller, deck, undisturbed, tmp_path):
    """The same with a signal that can be heeded: what is done is kept, and the exit code says that there is more to do."""
    reference, duration = undisturbed
    moments = random.Random(SEED + 1)
    to_do = []
    for _ in range(10):
        process = subprocess.Popen([camroller, "sweep", deck, "--resume", "--quiet"], cwd=tmp_path, stderr=subprocess.PIPE)
        try:
            process.wait(timeout=moments.uniform(0.0, 0.4 * duration))
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGTERM)
        words = process.communicate()[1].decode()
        if process.returncode == UNFINISHED:
            found = re.search(r"with (no case|(\d+) of 160 cases) to do", words)
            to_do.append(int(found[2] or 0))
        # before it listens the signal ends it at once
        assert process.returncode in (0, UNFINISHED, -signal.SIGTERM)
    done(camroller, "sweep", deck, "--resume", "--quiet", folder=tmp_path)
    assert same(reference, tmp_path / "deck.h5")
    # what was done is not done again
    assert to_do == sorted(to_do, reverse=True) and min(to_do) < 160


def test_killed_shard_can_be_resumed(camroller, deck, undisturbed, tmp_path):
    """Shards that were killed are gone on with one by one."""
    reference, duration = undisturbed
    for shard in ("1/2", "2/2"):
        process = subprocess.Popen([camroller, "sweep", deck, "--shard", shard, "--quiet"], cwd=tmp_path)
        time.sleep(0.3 * duration)
        process.kill()
        process.wait()
    for shard in ("2/2", "1/2"):
        assert run(camroller, "sweep", deck, "--shard", shard, "--resume", "--quiet", folder=tmp_path).returncode == 0
    done(camroller, "merge", deck, "--quiet", folder=tmp_path)
    assert same(reference, tmp_path / "deck.h5")
