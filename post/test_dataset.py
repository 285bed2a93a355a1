"""Result files as datasets with the swept keys as coordinates."""

import h5py
import numpy as np
import pytest

from dataset import open_dataset
from read import ResultError, read_result
from test_cases import ZIP
from test_post import write_result


def test_of_a_grid_each_swept_key_is_a_dimension(tmp_path):
    path = write_result(tmp_path / "grid.h5")
    result, cases = read_result(path), open_dataset(path)
    for case in range(result.cases):
        place = {"speed_rpm": result.value_of("operating_point.speed_rpm", case),
                 "oil_temperature_degC": result.value_of("operating_point.oil_temperature_degC", case)}
        chosen = cases.sel(place)
        assert chosen.mean_slip_ratio.item() == result.summary["mean_slip_ratio"].values[case]
        assert (chosen.contact_load.values == result.series["contact_load"].values[case]).all()
    slip = result.summary["mean_slip_ratio"].values.reshape(3, 3)
    assert sorted(cases.mean_slip_ratio.max("oil_temperature_degC").values) == sorted(slip.max(1))
    assert cases.contact_load.attrs["units"] == result.series["contact_load"].units
    assert cases.cam_angle.values.tolist() == result.cam_angle.tolist()


def test_of_other_cases_the_keys_are_coordinates_along_them(tmp_path):
    cases = open_dataset(write_result(tmp_path / "zip.h5", points=ZIP), with_series=False)
    assert cases.mean_slip_ratio.dims == ("case",)
    assert cases.speed_rpm.values.tolist() == [speed for speed, _ in ZIP]
    assert np.isfinite(cases.mean_slip_ratio.sel(case=1))


def test_measured_columns_are_variables_of_their_cases(tmp_path):
    path = write_result(tmp_path / "zip.h5", points=ZIP)
    with h5py.File(path, "a") as file:
        file["measured/torque"] = [0.1 * case for case in range(len(ZIP))]
        file["measured/torque"].attrs["units"] = "N m"
    torque = open_dataset(path).measured_torque
    assert torque.dims == ("case",) and torque.attrs["units"] == "N m"
    assert torque.sel(case=1).item() == 0.1


def test_what_is_no_result_is_told(tmp_path):
    (tmp_path / "text.h5").write_text("no")
    with pytest.raises(ResultError, match="not an HDF5 file"):
        open_dataset(tmp_path / "text.h5")


def test_hours_and_turns_have_a_dimension_of_their_own(tmp_path):
    path = write_result(tmp_path / "grid.h5")
    result, cases = read_result(path), open_dataset(path)
    chosen = cases.sel(speed_rpm=result.value_of("operating_point.speed_rpm", 4), oil_temperature_degC=result.value_of(
        "operating_point.oil_temperature_degC", 4))
    for name, values, dimension in (("running_in_roller_film", result.history["roller_film"].values, "running_time_part"),
                                    ("turns_seating_speed", result.turns["seating_speed"].values, "turn")):
        assert chosen[name].dims == (dimension,) and np.array_equal(chosen[name].values, values[4], equal_nan=True)
