"""Where the instructions of a case go: counted by valgrind for each part of it, beside the counts of an earlier program.

Usage: case_cost.py PROGRAM TABLE WORK        rewrites TABLE; the column `before` stays as it is there, or is this count where there is none

Counts are inclusive ones of the procedures named in PARTS, over the cases of a run in one thread. What else a process does, its start and
the making of its file, is not divided by them.
"""

from __future__ import annotations

import math
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
# Part of a case and the procedures whose inclusive counts make it
PARTS = {
    "case": ["case_loop_MOD_compute_cases._omp_fn.0"],
    "deck to case": ["deck_MOD_make_sweep_case"],
    "integration": ["cycle_MOD_integrate_cycle"],
    "means, errors": ["case_result_MOD_take_statistics"],
    "extremes": ["case_result_MOD_search_extremes"],
    "result": ["case_result_MOD_make_result"],
    ". camshaft": ["camshaft_statistics_MOD_mean_bearing_torque", "camshaft_statistics_MOD_search_camshaft"],
    ". margins": ["margins_MOD_find_margins"],
    ". summary": ["summary_MOD_make_summary"],
    "contacts": ["contact_MOD_solve_at_speeds", "contact_MOD_solve_contact"],
}
EIGHT_CAMS = [
    "cam_bearings.bearing_positions_mm=0,80,160,240,320",
    "cam_bearings.cam_positions_mm=20,60,100,140,180,220,260,300",
    "cam_bearings.cam_phases_deg=0,0,270,270,90,90,180,180",
]
ONE_POINT = ["sweep.values_1=600", "sweep.values_2=60"]


def runs(work: pathlib.Path):
    """Name, command, deck, number of cases and settings of each run."""
    for accuracy in ("1e-3", "1e-4", "1e-6"):
        yield f"thesis.nml, accuracy {accuracy}", "sweep", "thesis.nml", 9, [f"numerics.accuracy={accuracy}"]
    yield "eight cams of one shape", "sweep", "thesis.nml", 9, ["numerics.accuracy=1e-3", *EIGHT_CAMS]
    yield "four_cylinder.nml, 16 cams", "sweep", "four_cylinder.nml", 6, [
        "numerics.accuracy=1e-3", "sweep.values_1=1000,3000,6000", "sweep.values_2=40,120"]
    yield "three_cam_head.nml", "sweep", "three_cam_head.nml", 9, ["numerics.accuracy=1e-3"]
    yield "lift table of 2800 rows", "sweep", "tabulated_lift.nml", 1, [
        "numerics.accuracy=1e-3", f"lift.table={write_lift(work)}"]
    yield "thesis.nml with series", "run", "thesis.nml", 9, ["numerics.accuracy=1e-3"]
    yield "numerical_film.nml", "sweep", "numerical_film.nml", 1, ["numerics.accuracy=1e-3", *ONE_POINT]


def write_lift(work: pathlib.Path) -> pathlib.Path:
    """A lift curve of 2800 rows: a power law with exponent 4, 9.5 mm high, 70 degrees to each side."""
    path = work / "lift.txt"
    places = (140.0 * i / 2799 - 70.0 for i in range(2800))
    path.write_text("".join(f"{180.0 + place:.9f} {9.5 * (1.0 - (place / 70.0) ** 2) ** 4:.12f}\n" for place in places))
    return path


def count(program: pathlib.Path, command: str, deck: str, settings: list[str], work: pathlib.Path) -> tuple[dict[str, float], float]:
    """Instructions of each part, and of the whole run."""
    profile = work / "callgrind.out"
    options = [word for setting in settings for word in ("--set", setting)]
    if command == "sweep":
        options += ["--threads", "1"]
    # of a measurement that was stopped
    for left in work.glob("case_cost.h5.part-*"):
        left.unlink()
    done = subprocess.run(
        ["valgrind", "--tool=callgrind", f"--callgrind-out-file={profile}", program, command, ROOT / "decks" / deck, *options, "--quiet",
         "-o", work / "case_cost.h5"], capture_output=True, text=True, check=False, env=os.environ | {"OPENBLAS_NUM_THREADS": "1"})
    total = re.search(r"Collected : (\d+)", done.stderr)
    if done.returncode != 0 or total is None:
        sys.exit(done.stdout + done.stderr)
    costs = inclusive(profile)
    return ({part: sum(cost for name, cost in costs.items() if any(word in name for word in words)) for part, words in PARTS.items()},
            float(total.group(1)))


def inclusive(profile: pathlib.Path) -> dict[str, float]:
    """Instructions of calls of each procedure from others, with all that they call."""
    names, costs, caller, callee, is_call = {}, {}, "", "", False
    for line in profile.open():
        kind, _, rest = line.rstrip().partition("=")
        if kind in ("fn", "cfn"):
            number, name = re.match(r"\((\d+)\)\s*(.*)", rest).groups()
            names[number] = name or names[number]
            if kind == "fn":
                caller = names[number]
            else:
                callee = names[number]
        elif kind == "calls":
            is_call = True
        elif is_call:
            is_call = False
            if family(caller) != family(callee):
                costs[callee] = costs.get(callee, 0.0) + float(line.split()[1])
    return costs


def family(name: str) -> str:
    """Name of a procedure without what the compiler adds to copies of it; calls inside a family count once."""
    return re.sub(r"\.(constprop|isra|part|cold)\.\d+", "", name).replace("solve_at_speeds", "solve_contact")


def main():
    program, table, work = (pathlib.Path(word).resolve() for word in sys.argv[1:4])
    work.mkdir(parents=True, exist_ok=True)
    before = {}
    if table.exists():
        for line in table.read_text().splitlines():
            found = re.match(r"(.{30})(.{16})\s+([\d.]+)", line)
            if found:
                before[found.group(1).strip(), found.group(2).strip()] = float(found.group(3))
    lines = ["# Million instructions of a case by part, in one thread; start and file: those of the whole run beside its cases",
             f"{'# run':30}{'part':16}{'before':>10}{'now':>10}{'now/before':>12}"]
    for name, command, deck, cases, settings in runs(work):
        parts, total = count(program, command, deck, settings, work)
        values = {part: value / cases for part, value in parts.items()} | {"start and file": total - parts["case"]}
        for part, value in values.items():
            now = value / 1e6
            then = before.get((name, part), now)
            ratio = now / then if then > 0.0 else math.nan
            lines.append(f"{name:30}{part:16}{then:10.3f}{now:10.3f}{ratio:12.2f}")
        print("\n".join(lines[-len(values):]), flush=True)
    table.write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
