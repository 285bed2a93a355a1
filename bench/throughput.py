#!/usr/bin/env python3
"""Cases in a second, and what they cost beside the solver: threads, processes, shards, size of the study.

Usage: make bench-batch      rewrites bench/tables/throughput.txt and .png and the table in doc/notes/batch.md; ten minutes at most, on an
                             idle machine
       bench/throughput.py --cases 100 --sizes 100,1000 --repeats 1 --output FOLDER

The deck is decks/thesis.nml at accuracy 1e-3 over speed and temperature, summaries only. Threads, processes by MPI and shards take
turns, and the shortest of the runs counts. Shards share nothing at all, so what two of them gain at the same time is what the
machine has to give. More threads or processes than cores say nothing and are not run. Time outside the solver is counted
in instructions, by valgrind where it is there. Sizes that would take longer than the minutes left are left out, and named.
"""

from __future__ import annotations

import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]
PROGRAM = ROOT / "build/release/bin/camroller"
MPI_PROGRAM = ROOT / "build/mpi/bin/camroller-mpi"
TABLES = ROOT / "bench/tables"
PAGE = ROOT / "doc/notes/batch.md"
LIKE_THESIS = "&numerics accuracy = 1e-3 /\n"
ENVIRONMENT = os.environ | {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OPENBLAS_NUM_THREADS": "1"}
# Times to open a file and read a column by h5py, and to open the summary by xarray [s], libraries being loaded. In a process of its
# own: the peak memory of a process that is started here is never less than what this one has, so it stays small.
OPENING = """
import sys, time, h5py, xarray
for _ in range(2):
    start = time.monotonic()
    with h5py.File(sys.argv[1]) as file:
        file["summary/mean_torque_drive"][()]
    middle = time.monotonic()
    xarray.open_dataset(sys.argv[1], group="summary", engine="h5netcdf").close()
print(middle - start, time.monotonic() - middle)
"""
MEGABYTE = 1e6


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


def clear(folder: pathlib.Path) -> None:
    """Remove results and parts."""
    for path in folder.glob("out.h5*"):
        path.unlink()


def measure(commands: list[list[str]], folder: pathlib.Path) -> tuple[float, float, float]:
    """Run commands at the same time: wall time [s], processor time [s], peak memory of the largest process [MB]."""
    clear(folder)
    start = time.monotonic()
    running = {subprocess.Popen(command, cwd=folder, env=ENVIRONMENT, stdout=subprocess.DEVNULL,
                                stderr=subprocess.DEVNULL).pid for command in commands}
    processor = memory = 0.0
    while running:
        process, status, usage = os.wait4(-1, 0)
        if process not in running:
            continue
        if status:
            raise SystemExit(f"throughput: exit status {status} of {' '.join(commands[0])}")
        running.discard(process)
        processor += usage.ru_utime + usage.ru_stime
        memory = max(memory, usage.ru_maxrss * 1024 / MEGABYTE)
    return time.monotonic() - start, processor, memory


def sweep(deck: pathlib.Path, threads: int, *more: str) -> list[str]:
    """The command for one process."""
    return [str(PROGRAM), "sweep", str(deck), "-o", "out.h5", "--threads", str(threads), "--quiet", *more]


def ranks(deck: pathlib.Path, number: int) -> list[str]:
    """The command for several processes of one thread."""
    return ["mpirun", "--oversubscribe", "--bind-to", "none", "-n", str(number), str(MPI_PROGRAM), *sweep(deck, 1)[1:]]


def ways(deck: pathlib.Path) -> dict[tuple[str, int], list[list[str]]]:
    """Commands for each kind and number of workers, 1, 2, 4 ... to the number of cores."""
    found = {}
    number = 1
    while number <= len(os.sched_getaffinity(0)):
        found["threads", number] = [sweep(deck, number)]
        if MPI_PROGRAM.is_file() and shutil.which("mpirun"):
            found["processes by MPI", number] = [ranks(deck, number)]
        found["shards", number] = [sweep(deck, 1, "--shard", f"{i + 1}/{number}") for i in range(number)]
        number *= 2
    return found


def scaling(folder: pathlib.Path, cases: int, repeats: int) -> list[tuple[str, int, float, float]]:
    """Kind, number of workers, shortest wall and processor time [s]."""
    commands = ways(write_deck(folder, cases))
    times: dict = {way: [] for way in commands}
    for turn in range(repeats):
        for way, command in commands.items():
            say(f"turn {turn + 1} of {repeats}, {way[1]} {way[0]}")
            times[way].append(measure(command, folder))
    return [(*way, min(r[0] for r in rows), min(r[1] for r in rows)) for way, rows in times.items()]


def growth(folder: pathlib.Path, sizes: list[int], deadline: float) -> tuple[list[dict], list[int]]:
    """Cost of studies of several sizes in all cores; sizes that there was no time for."""
    rows, left_out, wall_of_case = [], [], 0.01
    for size in sizes:
        if time.monotonic() + 1.2 * size * wall_of_case > deadline:
            left_out.append(size)
            continue
        say(f"{size} cases")
        repeats = 5 if size <= 1000 else 2 if size <= 10000 else 1
        runs = [measure([sweep(write_deck(folder, size), len(os.sched_getaffinity(0)))], folder) for _ in range(repeats)]
        wall, processor, memory = (min(run[i] for run in runs) for i in range(3))
        wall_of_case = wall / size
        row = {"size": size, "wall": wall, "processor": processor, "memory": memory, "file": (folder / "out.h5").stat().st_size}
        row |= opening(folder / "out.h5")
        rows.append(row)
    return rows, left_out


def opening(path: pathlib.Path) -> dict[str, float]:
    """Time to open a file and read a column by h5py, and to open the whole summary by xarray [s]."""
    words = subprocess.run([sys.executable, "-c", OPENING, str(path)], capture_output=True, text=True, check=True).stdout.split()
    return {"h5py": float(words[0]), "xarray": float(words[1])}


def bytes_of_part(folder: pathlib.Path, cases: int) -> float:
    """Bytes that a case takes in a part file."""
    measure([sweep(write_deck(folder, cases), 1, "--shard", "1/2")], folder)
    return sum(path.stat().st_size for path in folder.glob("out.h5.part-*")) / (cases // 2)


def outside_share(folder: pathlib.Path) -> tuple[float, float] | None:
    """Instructions of a further case of a sweep, and the part of them not spent in running it, counted by valgrind."""
    if not shutil.which("valgrind"):
        return None
    say("instructions")
    few, many = 16, 80
    (total, solver), (few_total, few_solver) = (count_instructions(write_deck(folder, cases), folder) for cases in (many, few))
    return (total - few_total) / (many - few), 1 - (solver - few_solver) / (total - few_total)


def count_instructions(deck: pathlib.Path, folder: pathlib.Path) -> tuple[int, int]:
    """Instructions of a sweep in one thread, and those of them spent in running cases."""
    output = folder / "callgrind.out"
    clear(folder)
    subprocess.run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={output}", *sweep(deck, 1)], cwd=folder,
                   env=ENVIRONMENT, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    text = subprocess.run(["callgrind_annotate", "--inclusive=yes", "--threshold=100", str(output)], capture_output=True, text=True,
                          check=True).stdout
    found = {}
    for name, pattern in (("all", "PROGRAM TOTALS"), ("solver", "__camroller_run_MOD_run_next_case")):
        line = next((line for line in text.splitlines() if pattern in line), None)
        if line is None:
            raise SystemExit(f"throughput: valgrind tells nothing of {pattern}")
        found[name] = int(line.split()[0].replace(",", ""))
    return found["all"], found["solver"]


def circumstances(folder: pathlib.Path) -> list[str]:
    """Program, machine and compiler."""
    words = subprocess.run([str(PROGRAM), "version"], capture_output=True, text=True, check=True).stdout.splitlines()
    cpu = next((line.split(":")[1].strip() for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines()
                if line.startswith("model name")), "unknown processor")
    return [f"# program:  {words[0]}, {words[1]}",
            f"# machine:  {len(os.sched_getaffinity(0))} cores of {re.sub(r' +[0-9]+-Core.*| Processor', '', cpu)}, "
            f"load {os.getloadavg()[0]:.1f} at the start",
            f"# compiler: {words[2]}",
            f"# device:   {shutil.disk_usage(folder).free / 1e9:.0f} GB free"]


def say(words: str) -> None:
    """What is being done, for whoever waits."""
    print(f"throughput: {words}", file=sys.stderr, flush=True)


def scaling_lines(rows: list, cases: int, repeats: int) -> list[str]:
    """The table of threads, processes and shards."""
    lines = [f"# {cases} cases, shortest of {repeats} runs that took turns; speed-up over one of the same kind",
             f"# {'workers':<20} {'wall [s]':>9} {'cases/s':>9} {'speed-up':>9} {'processor [s]':>14} {'cases/(s core)':>15}"]
    alone = {kind: wall for kind, number, wall, _ in rows if number == 1}
    for kind, number, wall, processor in rows:
        lines.append(f"{f'{kind}, {number}':<22} {wall:9.2f} {cases / wall:9.0f} {alone[kind] / wall:9.2f} {processor:14.2f} "
                     f"{cases / processor:15.0f}")
    return lines


def growth_lines(rows: list[dict], left_out: list[int]) -> list[str]:
    """The table of sizes."""
    lines = ["# cost of a case as the study grows, all cores; h5py: opens the file, reads a column; xarray: opens the summary",
             f"#{'cases':>8} {'wall [s]':>9} {'processor [s]':>14} {'a case [ms]':>12} {'memory [MB]':>12} {'file [MB]':>10} "
             f"{'bytes/case':>11} {'h5py [s]':>9} {'xarray [s]':>11}"]
    for row in rows:
        size = row["size"]
        lines.append(f"{size:9d} {row['wall']:9.2f} {row['processor']:14.2f} {1e3 * row['processor'] / size:12.3f} "
                     f"{row['memory']:12.1f} {row['file'] / MEGABYTE:10.2f} {row['file'] / size:11.0f} {row['h5py']:9.3f} "
                     f"{row['xarray']:11.3f}")
    return lines + [f"# {size} cases: no time left for them" for size in left_out]


def put_into_page(lines: list[str]) -> None:
    """Replace the table in the page on many cases."""
    begin, end = "<!-- table: bench/tables/throughput.txt -->\n```\n", "\n```\n<!-- end of table -->"
    before, rest = PAGE.read_text(encoding="utf-8").split(begin)
    PAGE.write_text(before + begin + "\n".join(lines) + end + rest.split(end)[1], encoding="utf-8")


def draw(rows: list, sizes: list[dict], target: pathlib.Path) -> None:
    """Speed over workers, cost and size of a case over the size of the study."""
    import matplotlib
    matplotlib.use("Agg")
    matplotlib.rcParams.update({"font.size": 9.0, "axes.spines.top": False, "axes.spines.right": False})
    from matplotlib.figure import Figure
    figure = Figure(figsize=(10.0, 3.2), layout="constrained")
    speed, cost, space = figure.subplots(1, 3)
    numbers = sorted({row[1] for row in rows})
    for marker, kind in zip("os^", dict.fromkeys(row[0] for row in rows)):
        times = [(number, wall) for of_kind, number, wall, _ in rows if of_kind == kind]
        speed.plot([n for n, _ in times], [times[0][1] / wall for _, wall in times], marker=marker, markersize=5, label=kind)
    speed.plot(numbers, numbers, color="grey", linewidth=0.8, linestyle="--", label="as many times as fast")
    speed.set(xlabel="workers", ylabel="times as fast as one of them", xticks=numbers, ylim=(0, 1.05 * max(numbers)))
    speed.legend(frameon=False, fontsize=8, loc="lower right")
    x = [row["size"] for row in sizes]
    cost.semilogx(x, [1e3 * row["processor"] / row["size"] for row in sizes], marker="o", markersize=5)
    cost.set(xlabel="cases of the study", ylabel="processor time of a case [ms]")
    cost.set_ylim(0, 1.15 * cost.get_ylim()[1])
    space.loglog(x, [row["memory"] for row in sizes], marker="o", markersize=5, label="memory of the process")
    space.loglog(x, [row["file"] / MEGABYTE for row in sizes], marker="s", markersize=5, label="result file")
    space.set(xlabel="cases of the study", ylabel="megabytes")
    space.legend(frameon=False, fontsize=8)
    figure.savefig(target, dpi=110)


def main() -> int:
    """Command line; returns the exit code."""
    parser = argparse.ArgumentParser(description="cases in a second, and what they cost beside the solver")
    parser.add_argument("--cases", type=int, default=2000, help="cases for threads, processes and shards")
    parser.add_argument("--sizes", default="100,1000,10000,100000", help="sizes of studies")
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--minutes", type=float, default=10.0, help="time for all of it")
    parser.add_argument("--output", type=pathlib.Path, default=TABLES, help="folder of the table and the figure")
    options = parser.parse_args()
    deadline = time.monotonic() + 60 * options.minutes
    folder = pathlib.Path(tempfile.mkdtemp(prefix="camroller-bench-"))
    try:
        lines = ["# Cases of decks/thesis.nml at accuracy 1e-3 over speed and temperature, summaries only", *circumstances(folder)]
        rows = scaling(folder, options.cases, options.repeats)
        lines += scaling_lines(rows, options.cases, options.repeats)
        share = outside_share(folder)
        lines.append("# instructions were not counted: there is no valgrind" if share is None else
                     f"# instructions of a further case: {share[0] / 1e6:.1f} million, {100 * share[1]:.1f} % of them outside the solver")
        lines.append(f"# a case takes {bytes_of_part(folder, 1000):.0f} bytes in a part file")
        sizes, left_out = growth(folder, [int(word) for word in options.sizes.split(",")], deadline)
        lines += growth_lines(sizes, left_out)
        options.output.mkdir(parents=True, exist_ok=True)
        draw(rows, sizes, options.output / "throughput.png")
        (options.output / "throughput.txt").write_text("\n".join(lines) + "\n")
        if options.output == TABLES:
            put_into_page(lines)
        print("\n".join(lines))
    finally:
        shutil.rmtree(folder)
    return 0


if __name__ == "__main__":
    sys.exit(main())
