#!/usr/bin/env python3
"""Cases in a second, and what they cost beside the solver: threads, processes, size of the study.

Usage: bench/throughput.py > bench/tables/throughput.txt      needs `make build mpi`; ten minutes on an idle machine

The deck is decks/thesis.nml at accuracy 1e-3 over speed and temperature, summaries only. What is compared is measured in turns,
and the shortest of the runs counts. Time outside the solver is counted in instructions, by valgrind where it is
there.
"""

from __future__ import annotations

import argparse
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]
PROGRAM = ROOT / "build/release/bin/camroller"
MPI_PROGRAM = ROOT / "build/mpi/bin/camroller-mpi"
LIKE_THESIS = "&numerics accuracy = 1e-3 /\n"
ENVIRONMENT = os.environ | {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OPENBLAS_NUM_THREADS": "1"}


def write_deck(folder: pathlib.Path, cases: int) -> pathlib.Path:
    """The reference deck with a sample of so many cases."""
    text = (ROOT / "decks/thesis.nml").read_text()
    path = folder / f"thesis_{cases}.nml"
    path.write_text(f"""{text[:text.index("&sweep")]}{LIKE_THESIS}&sweep
   kind = 'sobol' cases = {cases} seed = 0
   key_1 = 'operating_point.speed_rpm' from_1 = 300 to_1 = 3000
   key_2 = 'operating_point.oil_temperature_degC' from_2 = 40 to_2 = 120
/
""")
    return path


def measure(command: list[str], folder: pathlib.Path) -> tuple[float, float, int]:
    """Wall time [s], processor time [s], peak memory of one process [kB]."""
    for path in folder.glob("out.h5*"):
        path.unlink()
    start = time.monotonic()
    process = subprocess.Popen(command, cwd=folder, env=ENVIRONMENT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, _, usage = os.wait4(process.pid, 0)
    return time.monotonic() - start, usage.ru_utime + usage.ru_stime, usage.ru_maxrss


def best(commands: dict[str, list[str]], folder: pathlib.Path, repeats: int) -> dict[str, tuple[float, float, int]]:
    """Smallest times of several commands that take turns."""
    found: dict[str, list] = {name: [] for name in commands}
    for _ in range(repeats):
        for name, command in commands.items():
            found[name].append(measure(command, folder))
    return {name: (min(r[0] for r in rows), min(r[1] for r in rows), max(r[2] for r in rows)) for name, rows in found.items()}


def sweep(deck: pathlib.Path, threads: int) -> list[str]:
    """The command for one process."""
    return [str(PROGRAM), "sweep", str(deck), "-o", "out.h5", "--threads", str(threads), "--quiet"]


def ranks(deck: pathlib.Path, number: int) -> list[str]:
    """The command for several processes of one thread."""
    return ["mpirun", "--oversubscribe", "--bind-to", "none", "-n", str(number), str(MPI_PROGRAM), "sweep", str(deck), "-o",
            "out.h5", "--threads", "1", "--quiet"]


def main() -> int:
    """Command line; returns the exit code."""
    parser = argparse.ArgumentParser(description="cases in a second, and what they cost beside the solver")
    parser.add_argument("--cases", type=int, default=2000, help="cases for threads and processes")
    parser.add_argument("--sizes", default="100,1000,10000,100000", help="sizes of studies")
    parser.add_argument("--repeats", type=int, default=5)
    options = parser.parse_args()
    folder = pathlib.Path(tempfile.mkdtemp(prefix="camroller-bench-"))
    try:
        print(f"decks/thesis.nml at accuracy 1e-3, summaries only; {os.cpu_count()} cores; load {os.getloadavg()[0]:.1f} at the start")
        deck = write_deck(folder, options.cases)
        commands = {"1 thread": sweep(deck, 1), "2 threads": sweep(deck, 2)}
        if MPI_PROGRAM.is_file() and shutil.which("mpirun"):
            commands |= {"1 process": ranks(deck, 1), "2 processes": ranks(deck, 2)}
        found = best(commands, folder, options.repeats)
        print(f"\n{options.cases} cases, shortest of {options.repeats} runs that took turns\n")
        print("                wall [s]  cases/s  speed-up  processor [s]  cases/s and core")
        for name, (wall, processor, _) in found.items():
            base = found["1 thread" if "thread" in name else "1 process"][0]
            print(f"{name:14} {wall:9.2f} {options.cases / wall:8.0f} {base / wall:9.2f} {processor:14.2f} {options.cases / processor:16.0f}")
        print("\nOne thread, cost of a case as the study grows\n")
        print("   cases  processor [s]  per case [ms]  peak memory [MB]  file [MB]  bytes/case")
        for size in (int(word) for word in options.sizes.split(",")):
            _, processor, memory = measure(sweep(write_deck(folder, size), 1), folder)
            file = (folder / "out.h5").stat().st_size
            print(f"{size:8} {processor:14.2f} {1e3 * processor / size:14.3f} {memory / 1024:17.1f} {file / 1e6:10.2f} {file / size:11.0f}",
                  flush=True)
        share = outside_share(folder)
        if share is not None:
            print(f"\nInstructions outside the solver, with summaries: {100 * share:.1f} % of those of a further case")
    finally:
        shutil.rmtree(folder)
    return 0


def outside_share(folder: pathlib.Path) -> float | None:
    """Part of the instructions of a further case of a sweep that is not spent in running it, counted by valgrind."""
    if not shutil.which("valgrind"):
        return None
    (total, solver), (few_total, few_solver) = (count_instructions(write_deck(folder, cases), folder) for cases in (48, 16))
    return 1 - (solver - few_solver) / (total - few_total)


def count_instructions(deck: pathlib.Path, folder: pathlib.Path) -> tuple[int, int]:
    """Instructions of a sweep in one thread, and those of them spent in running cases."""
    output = folder / "callgrind.out"
    for path in folder.glob("out.h5*"):
        path.unlink()
    subprocess.run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={output}", *sweep(deck, 1)], cwd=folder,
                   env=ENVIRONMENT, check=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    text = subprocess.run(["callgrind_annotate", "--inclusive=yes", "--threshold=100", str(output)], capture_output=True, text=True,
                          check=True).stdout
    total = solver = 0
    for line in text.splitlines():
        count = line.strip().split(" ")[0].replace(",", "")
        if "PROGRAM TOTALS" in line:
            total = int(count)
        if "__camroller_run_MOD_run_case" in line and not solver:
            solver = int(count)
    return total, solver


if __name__ == "__main__":
    sys.exit(main())
