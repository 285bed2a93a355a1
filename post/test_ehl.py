"""Figures of solved contacts, on a small made-up file with two lobe shapes and a loss of contact."""

import h5py
import numpy as np
import pytest

import ehl

SERIES = ("half_width", "load", "sliding_speed", "film_min", "film_min_formula", "film_central", "film_central_formula",
          "shear", "shear_formula", "rolling_resistance", "rolling_resistance_formula")


@pytest.fixture(name="path")
def made_up(tmp_path):
    """Two cases, the second of which has no solution; contact is lost at full lift."""
    angle = np.arange(0.0, 360.0, 5.0)
    x = np.linspace(-4.0, 2.0, 31)
    with h5py.File(tmp_path / "made_ehl.h5", "w") as file:
        for name in ("ehl", "ehl/second_lift"):
            group = file.create_group(name)
            group["angle"] = angle
            group["node"] = np.arange(x.size)
            group["x"] = np.array([x, np.full_like(x, np.nan)])
            touching = np.abs(angle - 180.0) > 12.0
            for key in (*SERIES, "torque_drive"):
                row = np.where(touching, 5e-5 if key == "half_width" else 2e-7, 0.0)
                group[key] = np.array([row, np.full_like(row, np.nan)])
            pressure = 5e8 * np.sqrt(np.clip(1 - x**2, 0, None)) * touching[:, None]
            film = (2e-7 + 1e-7 * x**2) * touching[:, None]
            planes = {"pressure": pressure, "film": film}
            if name == "ehl":
                planes["film_rise"] = 5.0 * touching[:, None] * np.exp(-x**2)
            for key, plane in planes.items():
                group[key] = np.array([plane, np.full_like(plane, np.nan)])
    return tmp_path / "made_ehl.h5"


def test_each_lobe_shape_has_its_figures(path, tmp_path):
    assert ehl.main([str(path), "--output", str(tmp_path / "a.png"), "--map", str(tmp_path / "m.png")]) == 0
    assert sorted(file.name for file in tmp_path.glob("*.png")) == ["a.png", "a_second_lift.png", "m.png", "m_second_lift.png"]


def test_no_contact_is_no_film(path):
    data = ehl.read(path, 0)[""]
    assert np.isnan(data["film_min"][36]) and np.isnan(data["film"][36]).all()
    assert np.nanmin(data["film_min"]) > 0


def test_a_case_without_contacts_or_another_file_is_refused(path, tmp_path, capsys):
    assert ehl.main([str(path), "--case", "1", "--output", str(tmp_path / "a.png")]) == 2
    assert "has no solved contacts" in capsys.readouterr().err
    assert ehl.main([str(path), "--case", "2", "--output", str(tmp_path / "a.png")]) == 2
    with h5py.File(tmp_path / "other.h5", "w") as file:
        file["x"] = 1
    assert ehl.main([str(tmp_path / "other.h5"), "--output", str(tmp_path / "a.png")]) == 2
    assert not list(tmp_path.glob("*.png"))


@pytest.mark.parametrize("angle", ["400", "-1", "nan", "x"])
def test_an_angle_outside_of_the_turn_is_refused(path, tmp_path, capsys, angle):
    with pytest.raises(SystemExit) as end:
        ehl.main([str(path), "--output", str(tmp_path / "a.png"), "--angles", "0", angle])
    assert end.value.code == 2 and f"'{angle}' is not an angle of one turn, 0 to 360 degrees" in capsys.readouterr().err
    assert not (tmp_path / "a.png").exists()


def test_the_end_of_the_turn_is_its_beginning():
    angles = np.arange(0.0, 360.0, 5.0)
    assert [ehl.nearest(angles, angle) for angle in (0.0, 4.0, 358.0, 360.0)] == [0, 1, 0, 0]


def swept(path, speed):
    """The file with a speed for its cases."""
    with h5py.File(path, "a") as file:
        file["sweep/operating_point.speed_rpm"] = np.array([speed, speed])
        file["series/cam_angle"] = file["ehl/angle"][:]
        file["series/sliding_speed"] = file["ehl/sliding_speed"][:]
    return path


def test_a_run_of_another_point_is_refused(path, tmp_path, capsys):
    beside = tmp_path / "run.h5"
    beside.write_bytes(path.read_bytes())
    arguments = [str(swept(path, 300.0)), str(swept(beside, 900.0)), "--output", str(tmp_path / "a.png")]
    assert ehl.main(arguments) == 2 and "300" in (told := capsys.readouterr().err) and "900" in told
    assert not list(tmp_path.glob("*.png"))


def at_point(path, **values):
    """The file with values of its deck."""
    with h5py.File(path, "a") as file:
        for key, value in values.items():
            file[f"deck/values/operating_point.{key}"] = value
            file[f"deck/values/operating_point.{key}"].attrs["units"] = {"speed_rpm": "rpm", "oil_temperature_degC": "degC"}[key]
        file["deck/values/case.title"] = "Made up"
        file["series/cam_angle"] = file["ehl/angle"][:]
        file["series/sliding_speed"] = file["ehl/sliding_speed"][:]
    return path


def test_a_run_of_another_point_is_refused_where_nothing_is_swept(path, tmp_path, capsys, monkeypatch):
    beside = tmp_path / "run.h5"
    beside.write_bytes(path.read_bytes())
    arguments = [str(at_point(path, speed_rpm=300.0, oil_temperature_degC=60.0)), str(at_point(beside, speed_rpm=300.0, oil_temperature_degC=90.0)),
                 "--output", str(tmp_path / "a.png")]
    assert ehl.main(arguments) == 2
    assert "oil temperature 60 °C" in (told := capsys.readouterr().err) and "oil temperature 90 °C" in told
    figures = []
    monkeypatch.setattr(ehl, "save_figure", lambda figure, *_, **__: figures.append(figure))
    assert ehl.main([arguments[0], arguments[0], *arguments[2:]]) == 0
    assert figures[0].get_suptitle() == "Made up, case 0, speed 300 rev/min, oil temperature 60 °C, first lobe shape"


def test_a_map_shows_films_of_contacts_beside_a_thick_one_where_contact_is_lost(path):
    data = ehl.read(path, 0)[""]
    data["film_central"][0] = 4e-4
    assert ehl.draw_map(data, "").axes[1].collections[0].norm.vmax == pytest.approx(0.6)


def test_slip_of_profiles_is_called_that_of_their_run(path):
    data = ehl.read(path, 0)[""]
    for names, words in (({"torque_drive"}, "of the run"), (set(), "solved contact")):
        figure = ehl.draw({name: values for name, values in data.items() if name not in names}, None, [180.0], "")
        assert words in [line.get_label() for axis in figure.axes for line in axis.lines]


def test_profiles_are_shown_as_far_as_they_carry_load():
    """A nearly rigid contact carries load at many half widths; an elastic one within one, and has the usual room beside it."""
    place = np.linspace(-20, 5, 501)
    elastic = np.sqrt(np.clip(1 - place**2, 0, None))
    rigid = 0.5 / (1 + place**2)
    data = {"x": place, "half_width": np.array([1e-4, 1e-4, np.nan]), "angle": np.array([0.0, 90.0, 180.0]),
            "pressure": np.array([elastic, rigid, np.full(501, np.nan)])}
    assert ehl.reach_of(data, [0, 180]) == pytest.approx(250)
    # 0.5/(1 + x^2) is 3 % of the largest, 1, at x = 3.96
    assert ehl.reach_of(data, [0, 90, 180]) == pytest.approx(1.1 * 396, rel=0.01)
