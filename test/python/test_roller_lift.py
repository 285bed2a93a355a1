"""A lift of the roller in the place of the valve's: both tables of one cam come to the same results."""

import pathlib
import subprocess

import h5py
import numpy as np
import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
# decks/tabulated_lift.nml [mm, rad]
ARM, PAD, CAM, BASE, ROLLER = 20.8, 35.5, 31.5, 18.0, 8.5
ARM_ANGLE, AXIS = np.radians(-3.5), np.radians(37.5)


def roller_lift(valve_lift):
    """Distance of the roller's centre from the cam's beyond that on the base circle, by the law of cosines."""
    closed = np.arccos((ARM**2 + CAM**2 - (BASE + ROLLER) ** 2) / (2 * ARM * CAM))
    pad = np.arccos(np.cos(closed - ARM_ANGLE + AXIS) - valve_lift / PAD)
    angle = pad - AXIS + ARM_ANGLE
    return np.sqrt(ARM**2 + CAM**2 - 2 * ARM * CAM * np.cos(angle)) - BASE - ROLLER


def write_table(path, change):
    angle, lift = np.loadtxt(ROOT / "decks/tables/polynomial_lift.txt").T
    values = change(lift)
    values[[0, -1]] = 0.0
    np.savetxt(path, np.column_stack([angle, values]), fmt="%.12f")
    return path


def summary(camroller, folder, *values):
    target = folder / "a.h5"
    words = [camroller, "run", "decks/tabulated_lift.nml", "-o", str(target), "--quiet", *(w for v in values for w in ("--set", v))]
    result = subprocess.run(words, capture_output=True, text=True, cwd=ROOT, check=False)
    assert result.returncode == 0, result.stderr
    with h5py.File(target) as file:
        return {name: data[0] for name, data in file["summary"].items() if data.dtype.kind == "f"}


def test_both_lifts_of_one_cam_are_the_same(camroller, tmp_path):
    valve = write_table(tmp_path / "valve.txt", lambda lift: lift)
    roller = write_table(tmp_path / "roller.txt", roller_lift)
    first = summary(camroller, tmp_path, f"lift.table={valve}")
    second = summary(camroller, tmp_path, f"lift.table={roller}", "lift.table_kind=roller_lift")
    # twelve decimals of a millimetre are written: the second derivative knows them to 1e-8
    for name in ("max_valve_lift", "max_contact_load", "mean_torque_friction", "max_hertz_pressure", "contact_loss_speed"):
        assert second[name] == pytest.approx(first[name], rel=1e-6), name
    assert second["max_valve_lift"] == pytest.approx(9.2e-3, rel=1e-6)


def test_a_lift_that_no_roller_can_have_is_a_mistake(camroller, tmp_path):
    table = write_table(tmp_path / "far.txt", lambda lift: 4.0 * lift)
    result = subprocess.run([camroller, "check", "decks/tabulated_lift.nml", "--set", f"lift.table={table}", "--set",
                             "lift.table_kind=roller_lift"], capture_output=True, text=True, cwd=ROOT, check=False)
    assert result.returncode == 3 and "the roller cannot be so far from the cam" in result.stderr
