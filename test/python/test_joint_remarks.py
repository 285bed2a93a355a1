"""Remarks on sliding joints whose laws are used far from where they hold: curves without a film, a seal in cold oil."""

import math
import pathlib
import re
import subprocess

import h5py
import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
DECKS = ["decks/sliding_joints.nml", pytest.param("decks/flexible_friction.nml", marks=pytest.mark.once)]
GUIDE = ("guide_side_load.law=stribeck", "guide_side_load.decay_speed_m_s=0.3", "guide_side_load.reference_viscosity_Pa_s=0.01",
         "guide_side_load.reference_load_N=30")
PIVOT = ("finger_pivot.law=stribeck", "finger_pivot.decay_speed_m_s=0.1", "finger_pivot.reference_viscosity_Pa_s=0.01",
         "finger_pivot.reference_load_N=600")


def run(camroller, folder, deck, temperature, *settings):
    """Mean torques of one case [N m] and its remarks."""
    # of a train that bends in half of the time; shares are compared to a percent
    settings = (f"operating_point.oil_temperature_degC={temperature}", "numerics.accuracy=1e-2", *settings)
    words = [word for setting in settings for word in ("--set", setting)]
    result = subprocess.run([camroller, "run", deck, "--no-sweep", "-o", folder / "run.h5", *words], cwd=ROOT, capture_output=True,
                            text=True, check=False)
    assert result.returncode == 0, result.stderr
    with h5py.File(folder / "run.h5") as file:
        return {name[12:]: value[()].ravel()[0] for name, value in file["summary"].items() if name.startswith("mean_torque_")}, result.stderr


@pytest.mark.parametrize("deck", DECKS)
@pytest.mark.parametrize(("group", "settings", "torque"), [
    ("valve_tip", (), "tip"), ("guide_side_load", GUIDE, "guide_side"), ("finger_pivot", PIVOT, "pivot")])
def test_a_curve_without_a_film_that_leaves_no_friction_gives_a_remark(camroller, tmp_path, deck, group, settings, torque):
    """What is left is the torque over that of a constant coefficient, to what friction changes of forces, and its reversal near rest."""
    told = (rf"friction of &{group} has fallen to next to nothing: for ([\d.]+) % of the cycle less than 0\.05 of it is left, and "
            rf"its coefficient is ([\d.e-]+) on average over the sliding.* {group}\.viscous_part_s_m gives that of the film")
    curve, text = run(camroller, tmp_path, deck, 15, *settings)
    share, coefficient = map(float, re.search(told, text).groups())
    # The valve moves for 39 % of the cycle, and is slow where it turns
    assert 20 < share < 39
    constant, other = run(camroller, tmp_path, deck, 15, *settings, f"{group}.law=constant")
    assert coefficient == pytest.approx(0.1 * curve[torque] / constant[torque], rel=0.1) and coefficient < 0.005
    assert f"friction of &{group}" not in other
    assert f"friction of &{group}" not in run(camroller, tmp_path, deck, 15, *settings, f"{group}.viscous_part_s_m=0.02")[1]
    assert f"friction of &{group}" not in run(camroller, tmp_path, deck, 95, *settings)[1]


@pytest.mark.parametrize("deck", DECKS)
def test_a_seal_in_oil_far_from_that_of_its_drag_gives_a_remark(camroller, tmp_path, deck):
    told = (r"the viscous drag of the stem seal takes (\d+) % of the follower's friction: it goes with the viscosity, 15 times "
            r"stem_seal.reference_viscosity_Pa_s here, .* and is 75 N s/m; .*stem_seal.drag_follows = 'constant'")
    torques, text = run(camroller, tmp_path, deck, 25)
    # The lip's friction takes 8 N over the lift of 9.5 mm, up and down
    drag = torques["seal"] - 8 * 2 * 9.5e-3 / (2 * math.pi)
    assert float(re.search(told, text)[1]) == pytest.approx(100 * drag / (torques["friction"] - torques.get("bearings", 0)), abs=1)
    for settings in (("stem_seal.drag_follows=constant",), ("stem_seal.reference_viscosity_Pa_s=0.1",), ("stem_seal.viscous_drag_N_s_m=0.1",)):
        assert "of the stem seal takes" not in run(camroller, tmp_path, deck, 25, *settings)[1], settings
    assert "of the stem seal takes" not in run(camroller, tmp_path, deck, 60)[1]
