"""Figures of a study: what is drawn, what counts as stable, what is refused."""

import h5py
import numpy as np
import pytest

from plot_study import curves, is_stable, main, read_study, time_for


@pytest.fixture(name="path")
def made_up(tmp_path):
    """A study of two cases, a method with two tolerances and two fixed steps, one of which fails."""
    with h5py.File(tmp_path / "made_study.h5", "w") as file:
        study = file.create_group("study")
        study.create_group("models")
        study.create_group("accuracy")
        references = study.create_group("references")
        for name, values in {"case": [0, 1], "status": [0, 0], "speed": [30.0, 60.0], "oil_temperature": [300.0, 300.0],
                             "fastest_decay": [100.0, 200.0]}.items():
            references[name] = np.array(values, dtype=float)
        methods = study.create_group("methods")
        methods["method"] = np.array(2 * ["rodas5p", "rodas5p", "euler", "euler"], dtype="S20")
        nan = np.nan
        for name, values in {"case": [0, 0, 0, 0, 1, 1, 1, 1], "status": [0, 0, 0, 0, 0, 0, 0, 5],
                             "tolerance": 2 * [1e-2, 1e-4, nan, nan], "step": 2 * [nan, nan, 0.1, 1.0],
                             "error_sliding_speed": [1e-2, 1e-4, 1e-1, 9.0, 4e-2, 4e-4, 1e-1, nan],
                             "variation": [1.0, 1.0, 1.01, 7.0, 1.0, 1.0, 1.0, nan],
                             "time": [1e-3, 4e-3, 1e-2, 1e-3, 1e-3, 4e-3, 1e-2, nan],
                             "evaluations": [10.0, 40.0, 100.0, 10.0, 40.0, 40.0, 100.0, nan]}.items():
            methods[name] = np.array(values)
    return tmp_path / "made_study.h5"


def test_curves_are_geometric_means_over_cases_that_are_all_fine(path):
    found = curves(read_study(path)["methods"])
    assert list(found) == ["rodas5p", "euler"]
    assert np.allclose(found["rodas5p"], [[2e-2, 1e-3, 20.0], [2e-4, 4e-3, 40.0]])
    assert len(found["euler"]) == 1
    assert time_for(found["rodas5p"], 1e-3) == pytest.approx(4e-3)
    assert np.isnan(time_for(found["rodas5p"], 1e-6))


def test_chatter_and_failure_are_unstable(path):
    stable = is_stable(read_study(path)["methods"])
    assert list(stable) == [True, True, True, False, True, True, True, False]


def test_three_figures_are_drawn(path, tmp_path):
    assert main([str(path), "--output", str(tmp_path / "figures"), "--name", "x"]) == 0
    assert sorted(file.name for file in (tmp_path / "figures").iterdir()) == [
        "x_cheapest.png", "x_stability.png", "x_work_precision.png"]


def test_a_study_of_films_has_one_figure(tmp_path):
    with h5py.File(tmp_path / "made_film_study.h5", "w") as file:
        study, nan = file.create_group("study"), np.nan
        contacts, cycles = study.create_group("contacts"), study.create_group("film_cycle")
        study.create_group("film_table")
        contacts["contact"] = np.array(["largest load", "largest load", ""], dtype="S20")
        for name, values in {"nodes": [33.0, 65.0, nan], "error_film_min": [4e-2, 1e-2, nan], "cold_time": [1e-4, 4e-4, nan],
                             "warm_time": [1e-5, nan, nan]}.items():
            contacts[name] = np.array(values)
        cycles["model"] = np.array(["solved", "solved", "moes", ""], dtype="S20")
        for name, values in {"nodes": [33.0, 65.0, nan, nan], "step_error": [1e-2, 1e-2, nan, nan], "time": [0.1, 0.2, 0.01, nan],
                             "error_film_min": [1e-1, 2e-2, 2e-1, nan], "error_slip": [1e-1, nan, 2e-1, nan]}.items():
            cycles[name] = np.array(values)
    assert main([str(tmp_path / "made_film_study.h5")]) == 0
    assert [path.name for path in tmp_path.glob("*.png")] == ["made_film_study_work_precision.png"]


def test_a_file_that_is_no_study_is_refused(tmp_path, capsys):
    with h5py.File(tmp_path / "other.h5", "w") as file:
        file["x"] = 1
    assert main([str(tmp_path / "other.h5")]) == 2
    assert "not a study" in capsys.readouterr().err
