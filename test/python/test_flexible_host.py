"""A flexible train that a host drives through the C interface: in other processes."""

from __future__ import annotations

import os
import pathlib
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
DECK = ROOT / "decks" / "lash_adjuster.nml"

#: Drive a follower for a turn from where it stands; what comes of it, bit by bit
DRIVE = """
import sys
import camroller

def drive(follower, steps=40):
    numbers = []
    for step in range(steps):
        ends = [camroller.Inputs(60 + 0.1 * i, 360 + 0.05 * i, supply_pressure=2e5 + 1e3 * i) for i in (step, step + 1)]
        outcome = follower.step(follower.angle + 0.15, *ends)
        numbers += [outcome.mean_torque_drive, outcome.estimated_error, *outcome.contact_load, follower.value("lift_error"),
                    follower.value("chamber_pressure")]
    return [number.hex() for number in numbers]

case = camroller.Case(sys.argv[1], set={"operating_point.speed_rpm": 570, "numerics.accuracy": 1e-3})
"""
SAVE = DRIVE + """
follower = camroller.Simulation(case, 2.0)
drive(follower, 5)
open(sys.argv[2], "wb").write(follower.save())
print(drive(follower))
"""
RESTORE = DRIVE + """
print(drive(camroller.Simulation.restore(case, open(sys.argv[2], "rb").read())))
"""


@pytest.fixture(scope="module")
def run(installed_package):
    """Run a script in a process of its own."""

    def made(script, *words):
        done = subprocess.run([sys.executable, "-c", script, *map(str, words)], capture_output=True, text=True, check=False,
                              env={**os.environ, "PYTHONPATH": str(installed_package)})
        assert done.returncode == 0, done.stderr
        return done.stdout

    return made


def test_a_train_saved_in_one_process_goes_on_in_another_with_the_same_bits(run, tmp_path):
    first = run(SAVE, DECK, tmp_path / "block")
    assert "0x" in first and first == run(RESTORE, DECK, tmp_path / "block")


def test_a_struct_of_another_size_is_refused(run):
    script = DRIVE + """
inputs = camroller.Inputs(60.0, 360.0)
inputs.size -= 16
try:
    camroller.Simulation(case, 2.0).step(2.4, inputs)
except camroller.UsageError as error:
    print(error)
"""
    assert "sizeof(camroller_inputs)" in run(script, DECK)


def test_a_supply_pressure_needs_an_adjuster(run):
    script = DRIVE + """
follower = camroller.Simulation(camroller.Case(sys.argv[2]), 2.0)
try:
    follower.step(2.1, camroller.Inputs(60.0, 360.0, supply_pressure=2e5))
except camroller.UsageError as error:
    print(error)
"""
    assert "&lash_adjuster" in run(script, DECK, ROOT / "decks" / "dynamics.nml")
