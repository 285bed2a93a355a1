"""Run the program on hostile input within limits, say how it ended, and count the endings.

`attempt` runs one command in a process group of its own with a time limit and limits of address space and file size;
`classify` names the ending. An ending is good where the exit code is a documented one and words on the error unit go with
every code but 0; everything else is a fault: a signal, a hang, a backtrace of the run-time library, an undocumented code, an
error without words, words of a library in front of ours, words that are no text.
"""

from __future__ import annotations

import collections
import concurrent.futures
import dataclasses
import os
import pathlib
import re
import resource
import signal
import subprocess
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]

# As `camroller help` lists them; 70 is a mistake in the program and always a fault.
CODES = {0: "fine", 2: "command line", 3: "deck or table", 4: "impossible values", 5: "no convergence", 6: "file",
         7: "a rerun differs", 8: "stopped before the end", 9: "too little memory"}
BACKTRACE = re.compile(r"^(Program received signal|Backtrace for this error|At line \d+ of file|Fortran runtime error|"
                       r"Error termination\.|ERROR STOP|STOP )|AddressSanitizer|runtime error: ", re.MULTILINE)
LIBRARY = re.compile(r"HDF5-DIAG|double free|corrupted|malloc\(\)|free\(\)|munmap_chunk|OpenBLAS|Segmentation fault")
MEGABYTE = 2**20


@dataclasses.dataclass(frozen=True)
class Limits:
    """What one run may take."""

    seconds: float = 20.0
    address_space: int = 4096*MEGABYTE
    file_size: int = 256*MEGABYTE


@dataclasses.dataclass(frozen=True)
class Ending:
    """How a run ended."""

    kind: str
    is_fault: bool
    code: int | None
    seconds: float
    output: str
    errors: str


def classify(code: int | None, errors: str) -> tuple[str, bool]:
    """Name of an ending and whether it is a fault; the code is None after a hang, negative after a signal."""
    if code is None:
        return "hang", True
    if code < 0:
        return f"signal {signal.Signals(-code).name}", True
    if BACKTRACE.search(errors):
        return "backtrace", True
    if LIBRARY.search(errors):
        return "words of a library", True
    if code not in CODES:
        return f"code {code}", True
    if code and not errors.strip():
        return f"code {code} without words", True
    if any(ord(char) < 32 and char not in "\n\t\r" or char == "\ufffd" for char in errors):
        return "words that are no text", True
    return f"{code} {CODES[code]}", False


def attempt(program: str, arguments: list, folder: pathlib.Path, limits: Limits = Limits(), **variables: str) -> Ending:
    """One run of the program in a folder; what it leaves running is ended."""
    def restrict():
        resource.setrlimit(resource.RLIMIT_AS, (limits.address_space, limits.address_space))
        resource.setrlimit(resource.RLIMIT_FSIZE, (limits.file_size, limits.file_size))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    start = time.monotonic()
    # one thread for the linear algebra: each other one asks for address space of its own
    process = subprocess.Popen([program, *map(str, arguments)], cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, preexec_fn=restrict, start_new_session=True,
                               env=os.environ | {"OPENBLAS_NUM_THREADS": "1", "LC_ALL": "C.UTF-8"} | variables)
    try:
        output, errors = process.communicate(timeout=limits.seconds)
        code = process.returncode
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        output, errors = process.communicate()
        code = None
    errors = errors.decode("utf-8", errors="replace")
    kind, is_fault = classify(code, errors)
    return Ending(kind, is_fault, code, time.monotonic() - start, output.decode("utf-8", errors="replace"), errors)


class Tally:
    """Endings counted by a label, e.g. the program and command, and by kind; faults kept with what led to them."""

    def __init__(self):
        self.counts: collections.Counter = collections.Counter()
        self.faults: list[tuple[str, str, Ending]] = []

    def add(self, label: str, case: str, ending: Ending) -> None:
        """Count one ending; `case` says how to get it again."""
        self.counts[label, ending.kind] += 1
        if ending.is_fault:
            self.faults.append((label, case, ending))

    def text(self) -> str:
        """The table of counts, then the faults with the first lines of their words."""
        lines = [f"{label:<24} {kind:<32} {count:6d}" for (label, kind), count in sorted(self.counts.items())]
        for label, case, ending in self.faults:
            words = "\n   | ".join(line[:160] for line in ending.errors.splitlines()[:8])
            lines.append(f"FAULT {label}: {ending.kind} after {ending.seconds:.1f} s: {case}\n   | {words}")
        lines.append(f"{sum(self.counts.values())} runs, {len(self.faults)} faults")
        return "\n".join(lines)


def campaign(cases, work, jobs: int = os.cpu_count() or 1) -> Tally:
    """Do `work(case)` for all cases, `jobs` at a time; each gives (label, case in words, ending) triples."""
    tally = Tally()
    with concurrent.futures.ThreadPoolExecutor(max_workers=jobs) as pool:
        for done in pool.map(work, cases):
            for label, words, ending in done:
                tally.add(label, words, ending)
    return tally
