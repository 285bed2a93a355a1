"""What a step of a host costs: instructions and allocations of one follower in a step of one degree of crank angle, and processor
time of a working cycle of all followers. Instructions and allocations are differences of two runs, so that the start does not count.
The column `before`, instructions of an earlier program, stays as it is in the table.

Usage: hosts.py PREFIX WORK        with the library installed in PREFIX; needs valgrind
"""

from __future__ import annotations

import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
TABLE = ROOT / "bench" / "tables" / "hosts.txt"
DECKS = ("decks/thesis.nml", "decks/three_cam_head.nml", "decks/four_cylinder.nml", "decks/dynamics.nml", "decks/lash_adjuster.nml")
STEPS = (20, 60)
CYCLE = 720


def run(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, cwd=ROOT,
                          env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})
    if done.returncode != 0:
        sys.exit(done.stdout + done.stderr)
    return done.stdout + done.stderr


def count(program, deck, steps, work):
    """Instructions and allocations of a run, and its number of cams."""
    text = run("valgrind", "--tool=callgrind", f"--callgrind-out-file={work}/callgrind", program, deck, steps)
    instructions = int(re.search(r"Collected : (\d+)", text).group(1))
    cams = int(re.search(r"^(\d+) [\d.]+$", text, re.MULTILINE).group(1))
    text = run("valgrind", program, deck, steps)
    allocations = int(re.search(r"total heap usage: ([\d,]+) allocs", text).group(1).replace(",", ""))
    return instructions, allocations, cams


def counted_before():
    """Instructions of each deck in the column `before`."""
    found = re.findall(r"^(decks/\S+) +\d+ +(\d+)", TABLE.read_text(), re.MULTILINE)
    return {deck: int(number) for deck, number in found}


def main():
    prefix, work = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
    work.mkdir(parents=True, exist_ok=True)
    program = work / "host_steps"
    run("gcc", "-O2", "-std=c11", ROOT / "bench" / "host_steps.c", f"-I{prefix}/include", f"-L{prefix}/lib", "-lcamroller", "-lm",
        f"-Wl,-rpath,{prefix}/lib", "-o", program)
    print("One degree of crank angle, half a degree of cam angle, with a ripple of the speed; one thread")
    print(f"{'deck':26}{'cams':>5}{'before':>14}{'instructions':>14}{'allocations':>13}{'a cycle [s]':>13}")
    print(f"{'':26}{'':5}{'a step, cam':>14}{'a step, cam':>14}{'a step, cam':>13}{'all cams':>13}")
    before = counted_before()
    for deck in DECKS:
        few, many = (count(program, deck, steps, work) for steps in STEPS)
        pairs = (STEPS[1] - STEPS[0]) * few[2]
        times = sorted(float(run(program, deck, CYCLE).split()[1]) for _ in range(3))
        print(f"{deck:26}{few[2]:5d}{before.get(deck, '-'):>14}{(many[0] - few[0]) / pairs:14.0f}{(many[1] - few[1]) / pairs:13.1f}"
              f"{times[1]:13.3f}")


main()
