"""What heat does to solved contacts, from made-up ones."""

import h5py
import numpy as np
import pytest

import film_heat
from read import ResultError


def made_up():
    """Two cases at four angles: a film that is 2 K warm from -1 to 1 at one angle, and one without solved contacts."""
    place = np.array([[-2.0, -1.0, 0.0, 1.0, 2.0]] * 2)
    films = np.array([[1.0, 1.0, 0.0, 1.0], [np.nan] * 4])
    rise = np.zeros((2, 4, 5))
    rise[0, 1] = [9.0, 2.0, 2.0, 2.0, 0.0]
    rise[0, 2] = 1e3  # without contact
    rise[1] = np.nan
    cold = {"x": place, "film_central": films * 1.25}
    heated = {"x": place, "film_central": films, "solved_rise": rise, "speed_rpm": np.array([300.0, 600.0]),
              "film_temperature_rise": np.array([[0.0, 3.0, 0.0, 1.0]] * 2), "inlet_heat_factor": np.array([[1.0, 0.9, 1.0, 0.9]] * 2)}
    return heated, cold


def test_rows_hold_what_contacts_tell():
    solved, lost = film_heat.rows(*made_up())
    assert solved == ["300", "", "3", "2", "9", "5.0, 10.0", "20.0, 20.0"]
    assert lost == ["600", "", "3", "-", "-", "5.0, 10.0", "-"]


def test_the_mean_reaches_to_the_ends_of_the_dry_contact_between_nodes():
    heated, cold = made_up()
    heated["x"] = np.array([[-2.0, -0.6, 0.0, 0.5, 2.0]] * 2)
    # From -2 to -0.6 along a straight line from 0 to 2, so 10/7 at -1; from 0.5 to 2 back to 0, so 4/3 at 1
    heated["solved_rise"][0, 1] = [0.0, 2.0, 2.0, 2.0, 0.0]
    mean = 0.5 * (0.4 * (2.0 + 10.0 / 7.0) / 2.0 + 1.1 * 2.0 + 0.5 * (2.0 + 4.0 / 3.0) / 2.0)
    assert film_heat.rows(heated, cold)[0][3] == film_heat.number(mean)


def test_speed_and_oil_that_are_not_swept_are_those_of_the_deck(tmp_path):
    heated, _ = made_up()
    with h5py.File(tmp_path / "a.h5", "w") as file:
        file["ehl/x"], file["ehl/film_central"], file["ehl/film_rise"] = heated["x"], heated["film_central"], heated["solved_rise"]
        for name in ("film_temperature_rise", "inlet_heat_factor"):
            file[f"series/{name}"] = heated[name]
        file["sweep/operating_point.speed_rpm"] = [300.0, 600.0]
        file["deck/values/operating_point.speed_rpm"], file["deck/values/operating_point.oil_temperature_degC"] = 900.0, 60.0
    data = film_heat.read(tmp_path / "a.h5")
    assert [row[:2] for row in film_heat.rows(data, data)] == [["300", "60"], ["600", "60"]]


def test_files_that_do_not_belong_together_are_refused():
    heated, cold = made_up()
    with pytest.raises(ResultError, match="no contacts with heat"):
        film_heat.rows(cold, cold)
    with pytest.raises(ResultError, match="different values of speed_rpm"):
        film_heat.rows(heated, cold | {"speed_rpm": np.array([300.0, 900.0])})
    cold["film_central"] = cold["film_central"][:1]
    with pytest.raises(ResultError, match="different cases"):
        film_heat.rows(heated, cold)
