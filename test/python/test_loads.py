"""Loads from outside: lost contact is said and can be refused, every lobe is in the file, and no number is written that is none."""

import h5py
import numpy
import pytest

from conftest import ROOT, run

DECKS = ROOT / "decks"
DOMAIN = 4
COARSE = ["--set", "output.angle_step_deg=5"]
FAST = ["--set", "sweep.values_1=2000,3600,5000", "--set", "film.law=moes"]
SHARP = ["--set", "film.law=moes", "--set", "second_lift.opening_half_angle_deg=48", "--set", "second_lift.closing_half_angle_deg=48",
         "--set", "second_lift.max_lift_mm=10"]


def remarks_of(path):
    """Remarks of each case."""
    with h5py.File(path) as file:
        return [text.decode() for text in file["run/warnings"][...].ravel()]


def test_a_lift_that_dips_below_zero_gives_numbers(camroller, tmp_path):
    done = run(camroller, "run", DECKS / "tabulated_lift.nml", "--set", "case.energy=source", "--set", "spring.seating=maximum",
               "-o", "r.h5", folder=tmp_path)
    assert done.returncode == 0, done.stderr
    with h5py.File(tmp_path / "r.h5") as file:
        for name, values in file["series"].items():
            assert numpy.isfinite(values[...]).all(), name
        for name, values in file["summary"].items():
            assert not numpy.isnan(values[...]).any(), name
            assert numpy.isfinite(values[...]).all() or name.endswith("_speed"), name


def test_a_result_with_nan_fails_the_comparison_of_rerun(camroller, tmp_path):
    assert run(camroller, "run", DECKS / "tabulated_lift.nml", *COARSE, "-o", "r.h5", folder=tmp_path).returncode == 0
    with h5py.File(tmp_path / "r.h5", "r+") as file:
        file["series/contact_load"][0, 7] = numpy.nan
    again = run(camroller, "rerun", "r.h5", folder=tmp_path)
    assert again.returncode != 0
    assert "series/contact_load" in again.stderr or "seal" in again.stderr or "damaged" in again.stderr, again.stderr


@pytest.mark.parametrize("command", ["run", "sweep"])
def test_loss_of_contact_gives_a_remark_for_every_case_and_one_on_the_screen(camroller, tmp_path, command):
    done = run(camroller, command, DECKS / "thesis.nml", *FAST, *COARSE, "-o", "r.h5", folder=tmp_path)
    assert done.returncode == 0, done.stderr
    lines = [line for line in done.stderr.splitlines() if "contact is lost" in line]
    assert len(lines) == 1, done.stderr
    assert lines[0].startswith("remark on 6 of 9 cases, the worst is case 6 (operating_point.speed_rpm=5000, ")
    assert "of the cycle at 5000 rev/min, at cam angles 159.7 to 201.3 deg; it is lost above 2937 rev/min" in lines[0]
    texts = remarks_of(tmp_path / "r.h5")
    with h5py.File(tmp_path / "r.h5") as file:
        shares = file["summary/lost_contact_share"][...].ravel()
    assert [bool("contact is lost for" in text) for text in texts] == [share > 0 for share in shares]
    # the finger leaves its adjuster before the roller leaves the cam
    assert all("the joint of finger and lash adjuster opens" in text for text in texts[3:])


def test_contact_policy_stop_refuses_the_cases_that_lose_contact(camroller, tmp_path):
    done = run(camroller, "run", DECKS / "thesis.nml", *FAST, *COARSE, "--set", "case.contact_policy=stop", "-o", "r.h5",
               folder=tmp_path)
    assert done.returncode == DOMAIN
    assert "6 of 9 cases have no result" in done.stderr and "(contact_policy = 'stop')" in done.stderr
    with h5py.File(tmp_path / "r.h5") as file:
        assert file["summary/status"][...].ravel().tolist() == [0] * 3 + [DOMAIN] * 6


def test_the_second_lobe_is_in_file_and_remarks(camroller, tmp_path):
    done = run(camroller, "run", DECKS / "three_cam_head.nml", *SHARP, *COARSE, "-o", "r.h5", folder=tmp_path)
    assert done.returncode == 0, done.stderr
    assert "lobe 2: contact is lost for 3.5" in done.stderr and "lobe 1: contact" not in done.stderr
    with h5py.File(tmp_path / "r.h5") as file:
        summary, series = file["summary"], file["series"]
        # the same lift as &lift is at -138 N and loses 3.5 % of the cycle
        assert summary["lobe_2_spring_margin"][...].min() == pytest.approx(-138, abs=1)
        assert summary["lobe_2_lost_contact_share"][...].max() == pytest.approx(0.035, abs=0.001)
        assert summary["min_lobe_2_contact_load"][...].min() == 0
        assert summary["min_contact_load"][...].min() > 50
        assert series["contact_load"].attrs["scope"] in (b"lobe 1", "lobe 1")
        assert series["lobe_2_contact_load"].attrs["scope"] in (b"lobe 2", "lobe 2")
        assert series["torque_drive"].attrs["scope"] in (b"camshaft", "camshaft")
        assert summary["estimated_error"].attrs["scope"] in (b"case", "case")
        lost = series["lobe_2_contact_load"][...].reshape(-1, 72)[-1] == 0
        angles = series["cam_angle"][...][lost]
        assert 160 < angles.min() and angles.max() < 200


def test_series_of_a_single_lobe_have_plain_names(camroller, tmp_path):
    assert run(camroller, "run", DECKS / "tabulated_lift.nml", *COARSE, "-o", "r.h5", folder=tmp_path).returncode == 0
    with h5py.File(tmp_path / "r.h5") as file:
        assert not [name for group in ("series", "summary") for name in file[group] if "lobe" in name]


@pytest.mark.parametrize("lowest", [-0.9, -0.5])
def test_gas_that_lifts_the_closed_valve_is_told(camroller, tmp_path, lowest):
    """Its force on a valve of 60 mm against that of the spring less the adjuster's, at the lever arms of the base circle."""
    angle = numpy.arange(0, 361, 10.0)
    numpy.savetxt(tmp_path / "gas.txt", numpy.c_[angle, lowest * (0.6 - 0.4 * numpy.cos(numpy.radians(angle)))], fmt="%.6f")
    (tmp_path / "deck.nml").write_text((DECKS / "thesis.nml").read_text() + "\n&gas_force table = 'gas.txt' pressure_unit = 'bar'\n"
                                       "valve_diameter_mm = 60 /\n")
    seat = {}
    for name, settings in (("gas", []), ("none", ["--set", "gas_force.valve_diameter_mm=1e-3"])):
        done = run(camroller, "run", "deck.nml", "--no-sweep", "-o", name + ".h5", *COARSE, *settings, folder=tmp_path)
        assert done.returncode == 0, done.stderr
        with h5py.File(tmp_path / (name + ".h5")) as file:
            seat[name] = file["summary/margin_seat"][...].ravel()[0]
    # The valve is closed where the pressure is at its middle and nearer to zero; it opens about the nose at 180 degrees
    with h5py.File(tmp_path / "gas.h5") as file:
        closed = file["series/valve_lift"][...].ravel() <= 0
        place = file["series/cam_angle"][...].ravel()[closed]
        pull = lowest * 1e5 * (0.6 - 0.4 * numpy.cos(numpy.radians(place))).max() * numpy.pi / 4 * 0.06**2
        # rows of half a degree at the search, of five in the series
        assert seat["gas"] == pytest.approx(seat["none"] + pull, abs=abs(pull) * 0.4 * numpy.radians(5))
        assert ("the gas lifts the closed valve off its seat" in remarks_of(tmp_path / "gas.h5")[0]) == (seat["gas"] < 0)
    assert (seat["gas"] < 0) == (lowest < -0.8)


def test_limit_speeds_that_are_never_reached_are_infinite(camroller, tmp_path):
    assert run(camroller, "run", DECKS / "thesis.nml", *COARSE, "-o", "r.h5", folder=tmp_path).returncode == 0
    with h5py.File(tmp_path / "r.h5") as file:
        summary = file["summary"]
        assert numpy.isinf(summary["margin_base_circle_speed"][...]).all()
        rpm = 30 / numpy.pi
        assert summary["margin_event_speed"][...].ravel() * rpm == pytest.approx([2937.17] * 9, abs=0.01)
        assert summary["margin_pivot_speed"][...].ravel() * rpm == pytest.approx([2470.90] * 9, abs=0.01)
        assert summary["pump_up_speed"][...].ravel() * rpm == pytest.approx([2357.51] * 9, abs=0.01)
        assert (summary["margin_event"][...] > 300).all() and summary["spring_margin"][...].ravel() == pytest.approx([64] * 9)
