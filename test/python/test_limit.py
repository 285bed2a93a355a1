"""Limit speeds of a train: `camroller limit`."""

import pathlib
import re
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]


def limits(camroller, deck, *options):
    """Rows of the table: the last words of each limit."""
    done = subprocess.run([camroller, "limit", ROOT / "decks" / deck, *options], capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    assert lines[0].startswith("Lowest speed of the camshaft found at which")
    return [re.split(r"\s{2,}", line.strip())[1:] for line in lines[1:6]], lines[6:]


def test_a_rigid_train_by_its_forces(camroller):
    rows, notes = limits(camroller, "thesis.nml")
    # Numbers of an independent evaluation of the margins
    assert all(abs(float(row[0]) - speed) < 1 for row, speed in zip(rows, [2471, 2357, 2937]))
    assert rows[3:] == [["-"], ["-"]]
    assert "without friction" in notes[0] and not any("unknown" in note for note in notes)


def test_limits_that_the_masses_do_not_give_say_which_key_does(camroller):
    rows, notes = limits(camroller, "three_cam_head.nml")
    assert rows[0] == rows[1] == ["unknown"] and notes[1] == "unknown: limits of the rigid train's pivot need masses.finger_kg"


def test_a_flexible_train_by_runs(camroller):
    rows, notes = limits(camroller, "dynamics.nml", "--to", "1200", "--step", "400", "--set", "numerics.tolerance=1e-3")
    # The vibration of the train unloads the joint at half the speed of the rigid train's forces: 1119 to a finer tolerance
    assert rows[0][0] == "2470.9" and abs(float(rows[0][1]) - 1119) < 15
    assert [row[1] for row in rows[1:]] == ["-", "above 1200", "above 1200", "above 1200"]
    assert re.match(r"speeds in rev/min; the flexible train was tried at \d+ speeds, in steps of 400 and then to 1; contact of the "
                    r"rigid train with the valve off its seat$", notes[0])
    assert notes[1] == "a limit that is passed and regained within a step is not seen: try a smaller --step"


def test_a_limit_that_is_regained_says_where(camroller):
    """The speed of seating passes 0.1 m/s at 1700 rev/min and falls below it again."""
    rows, _ = limits(camroller, "dynamics.nml", "--to", "1900", "--step", "100", "--seating", "0.1", "--set", "numerics.tolerance=1e-3")
    assert abs(float(rows[3][1]) - 1695) < 15 and re.fullmatch(r"regained at 1[78]\d\d(\.\d)?", rows[3][2])


@pytest.mark.once
def test_an_adjuster_that_holds_the_valve_open_has_no_better_limit_of_seating(camroller):
    """And limits passed by a motion without a period are known to some tens of rev/min."""
    rows, notes = limits(camroller, "lash_adjuster.nml", "--to", "2400", "--step", "1200", "--set", "numerics.tolerance=1e-2")
    closes = float(rows[4][1])
    assert 2300 < closes < 2400
    assert rows[3] == ["-", f"above {rows[4][1]}", f"from {rows[4][1]} on it does not close"]
    # The first digits of those found by smaller steps with a finer tolerance, 2354 and 2229
    assert re.fullmatch(r"about 23[3-7]0", rows[0][1]) and re.fullmatch(r"about 22[1-5]0", rows[1][1])
    assert [row[2:] for row in rows[:2]] == [["without a period"]] * 2
    assert sum(note.startswith("about: ") for note in notes) == 1


@pytest.mark.once
def test_a_plunger_on_its_lower_stop_has_no_limit_of_pump_up(camroller):
    rows, _ = limits(camroller, "lash_adjuster.nml", "--to", "1200", "--step", "300", "--set", "lash_adjuster.gap_um=60",
                     "--set", "numerics.tolerance=1e-3")
    assert rows[1][1] == "above 1200"


def test_with_lash_the_joint_counts_in_the_event(camroller):
    """On the base circle lash leaves the joint free at every speed."""
    rows, _ = limits(camroller, "hard/dynamics/mechanical_lash.nml", "--to", "800", "--step", "400")
    assert rows[0] == ["2470.9", "above 800"]


def test_invalid_speeds_are_usage_errors(camroller):
    for option, word in (("--to", "fast"), ("--step", "0"), ("--seating", "-1"), ("--to", "1e9"), ("--to", "")):
        done = subprocess.run([camroller, "limit", ROOT / "decks/thesis.nml", f"{option}={word}"], capture_output=True, text=True)
        assert done.returncode == 2 and f"option '{option}' takes a speed above 0 and up to 100000, not '{word}'" in done.stderr
