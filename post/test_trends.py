"""Measured trends against made-up friction."""

import h5py
import numpy as np
import pytest

import trends
from read import ResultError

NAMES = ["mean_torque_friction", "mean_torque_bearings", "mean_torque_contact", "mean_torque_needle", "mean_torque_needle_drag",
         "revolution_slip", "min_slip_ratio", "max_slip_ratio"]


def made_up():
    """All zero, by sample, speed and temperature."""
    return {name: np.zeros((trends.SAMPLES, len(trends.SPEEDS), len(trends.TEMPERATURES))) for name in NAMES}


def row(data, words, pin=None):
    """Which samples show the first trend with these words, and which clearly."""
    return next((values, clearly) for _, trend, values, clearly in trends.find_trends(data, pin or data) if words in trend)


def shown(data, words, pin=None):
    """Which samples show the first trend with these words."""
    return row(data, words, pin)[0]


def test_cases_are_samples_times_points(tmp_path):
    trends.write_cases(tmp_path)
    rows = (tmp_path / "cases.txt").read_text().splitlines()
    assert len(rows) == 1 + trends.SAMPLES * 9
    assert rows[0].split()[2:] == [key for key, *_ in trends.RANGES + trends.CHOICES]
    deck = (tmp_path / "trends.nml").read_text()
    assert "&needle_drag" in deck and deck.count("&sweep") == 1
    first, second = (row.split() for row in rows[1:3])
    assert (float(first[1]), float(second[1])) == (25.0, 60.0) and first[2:] == second[2:]
    pin = (tmp_path / "pin.nml").read_text()
    assert "kind = 'journal'" in pin and "&needle_drag" not in pin and "pin_cases.txt" in pin
    headings, *cases = (row.split() for row in (tmp_path / "pin_cases.txt").read_text().splitlines())
    assert len(cases) == len(rows) - 1 and headings[-len(trends.PIN_RANGES):] == [key for key, *_ in trends.PIN_RANGES]
    # the same samples, in all that both trains have
    column = headings.index("valve_tip.pad_radius_mm")
    assert [case[column] for case in cases] == [row.split()[rows[0].split().index("valve_tip.pad_radius_mm")] for row in rows[1:]]


def test_samples_fill_their_ranges():
    values = trends.samples()
    for column, (key, low, high, _, _) in zip(values.T, trends.RANGES):
        assert low <= column.min() and column.max() <= high, key
        # an even spread leaves a hundredth of a range at either end
        assert column.min() < low + 0.05 * (high - low) and column.max() > high - 0.05 * (high - low), key
    assert np.array_equal(values, trends.samples())
    for column, (_, names, _) in zip(np.array(trends.choices()).T, trends.CHOICES):
        counts = [(column == name).sum() for name in names]
        assert max(counts) - min(counts) <= 2


def test_friction_of_the_train_is_without_bearings():
    data = made_up()
    data["mean_torque_friction"][:] = [3.0, 2.0, 1.5]
    data["mean_torque_bearings"][:] = [2.0, 1.5, 0.5]
    data["mean_torque_friction"][0] = [3.0, 2.0, 2.5]
    assert shown(data, "friction without camshaft bearings rises from 60").all()
    with_bearings = shown(data, "all friction, with camshaft bearings")
    assert with_bearings[0] and not with_bearings[1:].any()


def test_friction_at_the_interface_is_that_of_the_contact():
    data = made_up()
    data["mean_torque_friction"][:] = [1.0, 2.0, 3.0]
    data["mean_torque_contact"][:] = [1.0, 1.0, 0.5]
    data["mean_torque_contact"][2, 2] = [1.0, 1.0, 1.1]
    assert not shown(data, "friction of cam on roller rises").any()
    assert list(np.flatnonzero(shown(data, "the same at any of 300, 600 and 900"))) == [2]


def test_a_rise_is_clear_above_its_size_and_everywhere_at_all_speeds():
    data = made_up()
    data["mean_torque_friction"][:] = [3.0, 1.0, 1.01]
    data["mean_torque_friction"][4:, :] = [3.0, 1.0, 1.2]
    data["mean_torque_friction"][7, 1] = [3.0, 1.0, 0.9]
    some, clearly = row(data, "friction without camshaft bearings rises from 60")
    assert some.all() and not clearly[:4].any() and clearly[4:].all()
    everywhere, clearly = row(data, "the same at 300, 600 and 900 rev/min at once")
    assert list(np.flatnonzero(~everywhere)) == [7] and clearly.sum() == trends.SAMPLES - 5


def test_friction_that_falls_by_half_does_change():
    data = made_up()
    data["mean_torque_contact"][:, :, 1:] = [1.0, 0.5]
    data["mean_torque_contact"][1, :, 2] = 0.91
    data["mean_torque_contact"][2, :, 2] = 1.09
    data["mean_torque_contact"][3, :, 2] = 1.11
    data["mean_torque_friction"][:] = data["mean_torque_contact"]
    data["mean_torque_friction"][:2, :, 2] += 0.1
    assert list(np.flatnonzero(shown(data, "hardly changes"))) == [1, 2]
    assert list(np.flatnonzero(shown(data, "both at once there"))) == [1]


def test_a_plain_pin_is_compared_with_needles_of_the_same_sample():
    data, pin = made_up(), made_up()
    data["mean_torque_needle"][:] = 2.0
    data["mean_torque_needle_drag"][:] = 1.0
    pin["mean_torque_needle"][:] = 4.0
    pin["mean_torque_needle"][5] = 1.0
    pin["mean_torque_needle"][6, 0, 0] = 1.0
    assert list(np.flatnonzero(shown(data, "a plain pin loses less", pin))) == [5, 6]
    assert list(np.flatnonzero(shown(data, "the same at all nine points", pin))) == [5]


def test_band_is_work_of_contact_and_bearing_over_a_turn():
    data = made_up()
    data["mean_torque_contact"][:, 2, 0] = 0.30 / (2 * np.pi)
    data["mean_torque_needle"][3, 2, 0] = 0.05 / (2 * np.pi)
    data["mean_torque_needle_drag"][4, 2, 0] = 0.50 / (2 * np.pi)
    assert list(np.flatnonzero(shown(data, "0.32 to 0.70"))) == [3]


def test_the_page_has_each_trend_for_a_roller_that_sticks_too():
    creeping, sticking = made_up(), made_up()
    spread = np.linspace(0.0, 0.1, trends.SAMPLES)[:, None, None]
    creeping["revolution_slip"][:] = [3.0, 2.0, 1.0] + spread
    sticking["revolution_slip"][:] = [3.0, 2.0, 2.5] + spread
    sticking["revolution_slip"][:, 0, 2] = spread[:, 0, 0]
    for data in (creeping, sticking):
        data["mean_torque_contact"][:] = 1.0
    text = trends.page(creeping, sticking, creeping)
    assert "slip falls with oil temperature at every speed | 100 % | 100 % | 0 % |" in text
    assert "at 95 °C in 1, 0 and 0 % of the sets" in text


def test_a_correlation_is_shown_at_all_points_and_counts_beyond_twice_its_error():
    values, data = trends.samples(), made_up()
    column = values[:, [key for key, *_ in trends.RANGES].index("surface.cam_roughness_um")]
    noise = np.random.default_rng(1).permutation(trends.SAMPLES)
    data["revolution_slip"][:, 0, 0] = -column
    data["revolution_slip"][:, 0, 1] = column
    data["revolution_slip"][:, 2, 2] = noise
    row = next(row for row in trends.find_monotonies(data) if row[0] == "Duffy 1993")
    assert row[3][0, 0] == pytest.approx(-1.0) and row[3][0, 1] == pytest.approx(1.0)
    assert abs(row[3][2, 2]) < 2 * trends.correlation_error() == pytest.approx(2 / np.sqrt(127))
    assert np.isnan(row[3]).sum() == 6
    assert np.argwhere(trends.comes_out(row[2], row[3])).tolist() == [[0, 0]]
    text = "\n".join(trends.tell_monotonies(data, made_up()))
    assert "| Duffy 1993 | roughness lowers slip | 300 | -1.00 | +1.00 | - | - | - | - | 1 of 9 points | 0 of 9 points |" in text
    assert text.count("rev/min") == 1 and text.count(" | 900 | ") == len(trends.find_monotonies(data)) and "0.09 (" in text


def test_the_deciding_coefficient_is_found():
    values = trends.samples()
    column = [key for key, *_ in trends.RANGES].index("stem_seal.lip_force_N")
    words = trends.where_it_lies(values[:, column] > 10.0)
    assert words.startswith("`stem_seal.lip_force_N` 1")
    assert trends.where_it_lies(np.ones(trends.SAMPLES, dtype=bool)) == "-"
    zone = np.array(trends.choices())[:, 1] == "rigid_to_elastic"
    assert trends.where_it_lies(zone) == "`traction.sheared_zone` 'rigid_to_elastic' in 100 %"
    few = np.zeros(trends.SAMPLES, dtype=bool)
    few[:3] = True
    assert trends.where_it_lies(few) == "too few to say"


def test_another_number_of_cases_is_refused(tmp_path):
    path = tmp_path / "few.h5"
    with h5py.File(path, "w") as file:
        file.attrs["complete"] = 1
        file.create_group("series")
        file["summary/status"] = np.zeros(4, dtype=int)
        for name in NAMES:
            file[f"summary/{name}"] = np.zeros(4)
    with pytest.raises(ResultError, match="4 cases"):
        trends.read_data(path)


def test_a_share_has_its_sampling_error():
    quarter = np.zeros(100, dtype=bool)
    quarter[:25] = True
    assert trends.share(quarter) == "25 ± 4 %" and trends.share(quarter[:25]) == "100 %"
