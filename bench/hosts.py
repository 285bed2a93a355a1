"""What steps of a host cost over a turn of the camshaft: instructions and allocations of one follower in a step of one degree of
crank angle, half a degree of cam angle; instructions of a turn in steps of one degree of cam angle over those of a run of the case, and
over those of the runs of all followers one by one, since a run of a head solves each lobe shape once; processor time of a working cycle of all followers. Instructions and allocations are differences of two runs, so that neither the
start nor the first step counts. The column `before`, instructions of an earlier program, stays as it is in the table.

Usage: hosts.py PREFIX WORK        with the library installed in PREFIX; needs valgrind
"""

from __future__ import annotations

import math
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
TABLE = ROOT / "bench" / "tables" / "hosts.txt"
DECKS = ("decks/thesis.nml", "decks/three_cam_head.nml", "decks/four_cylinder.nml", "decks/dynamics.nml", "decks/lash_adjuster.nml")
#: Steps of a turn, at one degree of crank angle and of cam angle [-]; cam speed [rad/s], that of host_steps.c
TURN, FEW = 720, 360
SPEED = 100.0


def run(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, cwd=ROOT,
                          env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})
    if done.returncode != 0:
        sys.exit(done.stdout + done.stderr)
    return done.stdout + done.stderr


def instructions(*command):
    text = run("valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", *command)
    return int(re.search(r"Collected : (\d+)", text).group(1))


def allocations(*command):
    return int(re.search(r"total heap usage: ([\d,]+) allocs", run("valgrind", *command)).group(1).replace(",", ""))


def turn(count, program, deck, steps, degrees, speed):
    """What is counted over so many steps after the first."""
    return count(program, deck, steps + 1, degrees, speed) - count(program, deck, 1, degrees, speed)


def one_cam_deck(deck, lobe, work):
    """A deck with one cam of a lobe shape of another deck, without its bearings and its engine."""
    text = (ROOT / deck).read_text()
    for shared in re.findall(r"^include = '(.*)'", text, re.MULTILINE):
        text += ((ROOT / deck).parent / shared).read_text()
    groups = dict(re.findall(r"^&(\w+)\n(.*?)^/\n", text, re.MULTILINE | re.DOTALL))
    if lobe == 2:
        groups["lift"] = groups["second_lift"]
    for name in ("second_lift", "cam_bearings", "engine", "sweep"):
        groups.pop(name, None)
    path = work / f"{pathlib.Path(deck).stem}_{lobe}.nml"
    text = "".join(f"&{name}\n{keys}/\n" for name, keys in groups.items())
    path.write_text(text.replace("'tables/", f"'{(ROOT / deck).parent}/tables/"))
    return path


def one_by_one(program, deck, cams, seconds, work):
    """Instructions of the runs of all followers of a camshaft, each as a case of its own."""
    total = 0
    for lobe, count in ((1, cams - seconds), (2, seconds)):
        if count > 0:
            total += count * turn(instructions, program, one_cam_deck(deck, lobe, work), 1, 0.0, SPEED * 30.0 / math.pi)
    return total


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
    print("A turn in steps of one degree of crank angle, half a degree of cam angle, with a ripple of the speed; one thread")
    print(f"{'deck':26}{'cams':>5}{'before':>14}{'instructions':>14}{'allocations':>13}{'turn in 360':>14}{'turn in 360':>14}{'a cycle [s]':>13}")
    print(f"{'':26}{'':5}{'a step, cam':>14}{'a step, cam':>14}{'a step, cam':>13}{'over a run':>14}{'one by one':>14}{'all cams':>13}")
    before = counted_before()
    for deck in DECKS:
        crank = 2.0 if "&engine" in (ROOT / deck).read_text() else 1.0
        speed = crank * SPEED * 30.0 / math.pi
        cycles = [run(program, deck, TURN, 0.5, speed).split() for _ in range(3)]
        cams, second_lobes = (int(word) for word in cycles[0][:2])
        seconds = sorted(float(words[2]) for words in cycles)[1]
        steps = turn(instructions, program, deck, TURN, 0.5, speed)
        few = turn(instructions, program, deck, FEW, 1.0, speed)
        ratio = few / turn(instructions, program, deck, 1, 0.0, speed)
        each = f"{few / one_by_one(program, deck, cams, second_lobes, work):.2f}" if cams > 1 else "-"
        made = turn(allocations, program, deck, TURN, 0.5, speed)
        print(f"{deck:26}{cams:5d}{before.get(deck, '-'):>14}{steps / TURN / cams:14.0f}{made / TURN / cams:13.2f}{ratio:14.2f}{each:>14}"
              f"{seconds:13.3f}", flush=True)


main()
