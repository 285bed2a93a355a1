"""Measured trends against made-up friction."""

import h5py
import numpy as np
import pytest

import trends
from read import ResultError

NAMES = ["mean_torque_friction", "mean_torque_bearings", "mean_torque_contact", "mean_torque_needle", "mean_torque_needle_drag",
         "mean_torque_tip", "mean_torque_seal", "mean_torque_guide_side", "mean_torque_pivot", "mean_torque_guide", "revolution_slip",
         "min_slip_ratio"]


def made_up():
    """All zero, by sample, speed and temperature."""
    return {name: np.zeros((trends.SAMPLES, len(trends.SPEEDS), len(trends.TEMPERATURES))) for name in NAMES}


def shown(data, words):
    """Which samples show the first trend with these words."""
    return next(values for _, trend, values in trends.find_trends(data) if words in trend)


def test_cases_are_samples_times_points(tmp_path):
    trends.write_cases(tmp_path)
    rows = (tmp_path / "cases.txt").read_text().splitlines()
    assert len(rows) == 1 + trends.SAMPLES * 9
    assert rows[0].split()[2:] == [key for key, *_ in trends.RANGES]
    deck = (tmp_path / "trends.nml").read_text()
    assert "&needle_drag" in deck and "'moes'" in deck and deck.count("&sweep") == 1
    first, second = (np.array(row.split(), dtype=float) for row in rows[1:3])
    assert (first[1], second[1]) == (25.0, 60.0) and np.array_equal(first[2:], second[2:])


def test_samples_fill_their_ranges():
    values = trends.samples()
    for column, (key, low, high, _, _) in zip(values.T, trends.RANGES):
        assert low <= column.min() and column.max() <= high, key
        # an even spread leaves a hundredth of a range at either end
        assert column.min() < low + 0.05 * (high - low) and column.max() > high - 0.05 * (high - low), key
    assert np.array_equal(values, trends.samples())


def test_friction_of_the_train_is_without_bearings():
    data = made_up()
    data["mean_torque_friction"][:] = [3.0, 2.0, 1.5]
    data["mean_torque_bearings"][:] = [2.0, 1.5, 0.5]
    data["mean_torque_friction"][0] = [3.0, 2.0, 2.5]
    assert shown(data, "300 rev/min, without camshaft bearings").all()
    with_bearings = shown(data, "the same with camshaft bearings")
    assert with_bearings[0] and not with_bearings[1:].any()


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
    text = trends.page(creeping, sticking)
    assert "slip falls with oil temperature at every speed | 100 % | 0 % |" in text
    assert "at 95 °C in 1, 0 and 0 % of the sets" in text


def test_the_deciding_coefficient_is_found():
    values = trends.samples()
    column = [key for key, *_ in trends.RANGES].index("stem_seal.lip_force_N")
    words = trends.where_it_lies(values[:, column] > 10.0)
    assert words.startswith("`stem_seal.lip_force_N` 1")
    assert trends.where_it_lies(np.ones(trends.SAMPLES, dtype=bool)) == "-"
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
