"""How the program ends: by a signal without a trace, and in any address space that it starts in."""

import ctypes
import os
import pathlib
import resource
import signal
import subprocess
import time

import pytest

from sweeps import EARLIER_RESULT

ROOT = pathlib.Path(__file__).resolve().parents[2]
COARSE = ["--set", "output.angle_step_deg=20", "--set", "numerics.accuracy=1e-3"]
FILM = ["--set", "sweep.values_1=300", *COARSE]
KILOBYTE = 1024
# Where OpenBLAS starts a thread that cannot get its memory, and ends only with it; where it never comes back from linear algebra
# for want of a buffer; and where there is enough for some
SMALL_SPACES = [100_000, 150_000, 200_000, 300_000, 400_000]


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT, signal.SIGHUP, signal.SIGUSR1])
@pytest.mark.parametrize("deck", ["thesis", "three_cam_head"])
def test_a_signal_leaves_nothing_behind(camroller, tmp_path, number, deck):
    """Its own unfinished file goes; the earlier one stays, and those that others write or that have such a name."""
    others = [tmp_path / "new.h5.unfinished-1-0", tmp_path / "new.h5.unfinished-notes"]
    for path in [tmp_path / "new.h5", *others]:
        path.write_bytes(EARLIER_RESULT)
    words = [camroller, "run", str(ROOT / f"decks/{deck}.nml"), "-o", "new.h5", "--set", "output.angle_step_deg=0.002"]
    before = sorted(os.listdir(tmp_path))
    with subprocess.Popen(words, cwd=tmp_path, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as running:
        until = time.monotonic() + 30.0
        while len(os.listdir(tmp_path)) == len(before) and running.poll() is None and time.monotonic() < until:
            time.sleep(0.001)
        running.send_signal(number)
        output, errors = running.communicate(timeout=60)
    assert running.returncode == -number, (running.returncode, errors)
    assert (output, errors) == (b"", b"")
    assert sorted(os.listdir(tmp_path)) == before
    assert all(path.read_bytes() == EARLIER_RESULT for path in [tmp_path / "new.h5", *others])


def test_a_signal_to_a_thread_of_a_library_leaves_nothing_behind(camroller, tmp_path):
    """The system chooses which thread a signal interrupts; meanwhile the one that writes may create its file again."""
    libc = ctypes.CDLL(None)
    words = [camroller, "run", str(ROOT / "decks/thesis.nml"), "-o", "new.h5", "--set", "output.angle_step_deg=0.002"]
    others = 0
    for attempt in range(36):  # one in a hundred found the moment, without the signal being passed on: one of three runs of this test
        with subprocess.Popen(words, cwd=tmp_path, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              env=os.environ | {"OPENBLAS_NUM_THREADS": "2"}) as running:
            until = time.monotonic() + 30.0
            while not os.listdir(tmp_path) and running.poll() is None and time.monotonic() < until:
                pass
            threads = [int(name) for name in os.listdir(f"/proc/{running.pid}/task") if int(name) != running.pid]
            others += len(threads)
            moment = time.perf_counter() + 2e-6 * (attempt * 25 % 36)
            while time.perf_counter() < moment:
                pass
            libc.tgkill(running.pid, (threads or [running.pid])[0], signal.SIGTERM)
            running.communicate(timeout=60)
        assert running.returncode == -signal.SIGTERM
        assert not os.listdir(tmp_path)
    if not others:
        pytest.skip("the linear algebra library has no threads of its own")


def test_an_ignored_signal_stays_ignored(camroller, tmp_path):
    """As `nohup` asks for."""
    words = [camroller, "run", str(ROOT / "decks/thesis.nml"), "-o", "new.h5", "--set", "output.angle_step_deg=0.02", "--quiet"]
    with subprocess.Popen(words, cwd=tmp_path, stdin=subprocess.DEVNULL,
                          preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN)) as running:
        while not os.listdir(tmp_path) and running.poll() is None:
            time.sleep(0.001)
        running.send_signal(signal.SIGHUP)
        assert running.wait(timeout=120) == 0
    assert os.listdir(tmp_path) == ["new.h5"]


@pytest.mark.parametrize("space", SMALL_SPACES)
@pytest.mark.parametrize("words", [["help"], ["check", "none.nml"], ["run", ROOT / "decks/thesis.nml", "-o", "new.h5", *COARSE],
                                   ["run", ROOT / "decks/numerical_film.nml", "-o", "new.h5", *FILM],
                                   ["run", ROOT / "decks/tabulated_lift.nml", "-o", "new.h5", *COARSE],
                                   ["sweep", ROOT / "decks/thesis.nml", "-o", "new.h5", *COARSE, "--threads", "2"]],
                         ids=["help", "an error", "run", "numerical film", "lift table", "sweep"])
def test_the_program_ends_in_a_small_address_space(camroller, tmp_path, space, words):
    def restrict():
        resource.setrlimit(resource.RLIMIT_AS, (space*KILOBYTE, space*KILOBYTE))

    environment = {name: value for name, value in os.environ.items() if name != "OPENBLAS_NUM_THREADS"}
    finished = subprocess.run([camroller, *map(str, words)], cwd=tmp_path, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              check=False, timeout=60, preexec_fn=restrict, env=environment)
    if words[0] not in ("help", "check") and finished.returncode:  # there was not enough for HDF5 or for OpenBLAS, which is said
        assert not os.listdir(tmp_path)
        assert (finished.returncode, finished.stderr.startswith("camroller: too little memory: ")) == (9, True) or \
            (finished.returncode, finished.stderr.startswith("camroller: cannot write ")) == (6, True), finished.stderr
        assert finished.stderr.count("\n") == 1
    else:
        assert finished.returncode == (6 if "none.nml" in words else 0), finished.stderr
