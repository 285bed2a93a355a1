"""The harness of the fuzz campaigns tells good endings from faults."""

import pathlib
import stat
import time

import pytest
from harness import Limits, Tally, attempt


def ending_of(folder, body, limits=Limits(seconds=20.0)):
    """Ending of a shell script in the place of the program."""
    program = folder / "program"
    program.write_text(f"#!/bin/sh\n{body}\n", encoding="utf-8")
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    return attempt(str(program), ["check", "x"], folder, limits)


@pytest.mark.parametrize(("body", "kind", "is_fault"), [
    ("exit 0", "0 fine", False),
    ("echo 'camroller: no' >&2; exit 3", "3 deck or table", False),
    ("exit 3", "code 3 without words", True),
    ("echo 'camroller: internal' >&2; exit 70", "code 70", True),
    ("kill -SEGV $$", "signal SIGSEGV", True),
    ("echo 'Fortran runtime error: end of record' >&2; exit 2", "backtrace", True),
    ("echo 'HDF5-DIAG: Error detected' >&2; echo 'camroller: no' >&2; exit 6", "words of a library", True),
    ("printf '\\001\\377' >&2; exit 3", "words that are no text", True),
])
def test_endings_are_told_apart(tmp_path, body, kind, is_fault):
    ending = ending_of(tmp_path, body)
    assert (ending.kind, ending.is_fault) == (kind, is_fault)


def test_a_hang_ends_with_all_it_started(tmp_path):
    ending = ending_of(tmp_path, "sleep 600 & echo $! > child; wait", Limits(seconds=1.0))
    assert (ending.kind, ending.is_fault) == ("hang", True)
    child = int((tmp_path / "child").read_text())
    state = pathlib.Path(f"/proc/{child}/stat")
    # A process that was killed goes once it is given the processor
    for _ in range(100):
        try:
            if state.read_text().split()[2] == "Z":
                return
        except (FileNotFoundError, ProcessLookupError):
            return
        time.sleep(0.1)
    pytest.fail("the child of a program that hangs goes on")


def test_limits_reach_the_program(tmp_path):
    ending = ending_of(tmp_path, "ulimit -v; ulimit -c", Limits(address_space=2**30))
    assert ending.output.split() == [str(2**20), "0"]


def test_counts_and_faults_are_shown(tmp_path):
    tally = Tally()
    for number, body in enumerate(("exit 0", "exit 0", "exit 1")):
        tally.add("check", f"case {number}", ending_of(tmp_path, body))
    text = tally.text()
    assert "check                    0 fine                                2" in text
    assert "FAULT check: code 1 after" in text and "case 2" in text
    assert text.endswith("3 runs, 1 faults")
