"""The figure of a study: what is drawn, what is refused."""

import h5py
import numpy as np
import pytest

from plot_study import curves, left_out, main, read_study, work_precision

NAN = np.nan


@pytest.fixture(name="path")
def made_up(tmp_path):
    """A study of two cases, a method with two tolerances and two fixed steps, one of which fails."""
    with h5py.File(tmp_path / "made_study.h5", "w") as file:
        table = file.create_group("study/study")
        table["way"] = np.array(2 * ["two methods", "rodas5p", "rodas5p", "euler", "euler"], dtype="S20")
        table["dial"] = np.array(2 * ["reference", "tolerance", "tolerance", "step [deg]", "step [deg]"], dtype="S20")
        for name, values in {"case": 5 * [0] + 5 * [1], "status": 9 * [0] + [5],
                             "setting": 2 * [NAN, 1e-2, 1e-4, 0.1, 1.0],
                             "error_sliding_speed": [1e-10, 1e-2, 1e-4, 1e-1, 9.0, 1e-10, 4e-2, 4e-4, 1e-1, NAN],
                             "error_mean_friction": [NAN, 1e-4, 1e-6, 1e-2, 1.0, NAN, 4e-4, 4e-6, 1e-2, NAN],
                             "time": [1.0, 1e-3, 4e-3, 1e-2, 1e-3, 1.0, 1e-3, 4e-3, 1e-2, NAN],
                             "evaluations": [9.0, 10.0, 40.0, 100.0, 10.0, 9.0, 40.0, 40.0, 100.0, NAN]}.items():
            table[name] = np.array(values, dtype=float)
    return tmp_path / "made_study.h5"


def test_curves_are_geometric_means_over_cases_that_are_all_fine(path):
    found = curves(read_study(path), "error_sliding_speed")
    assert list(found) == ["rodas5p", "euler"]
    assert np.allclose(found["rodas5p"], [[2e-2, 1e-3, 20.0], [2e-4, 4e-3, 40.0]])
    assert len(found["euler"]) == 1
    assert np.allclose(curves(read_study(path), "error_mean_friction")["rodas5p"][:, 0], [2e-4, 2e-6])


def test_a_figure_with_a_curve_for_each_way_in_each_panel(path, tmp_path):
    assert main([str(path), "--output", str(tmp_path / "figures"), "--name", "x"]) == 0
    assert [file.name for file in (tmp_path / "figures").iterdir()] == ["x_work_precision.png"]
    figure = work_precision(read_study(path))
    assert [[line.get_label() for line in axes.lines] for axes in figure.axes] == 3 * [["rodas5p", "euler"]]
    assert figure.get_suptitle().replace("\n", " ") == ("geometric means over 2 cases, 1 of 4 settings not shown, at which a case has no "
                                                        "result (euler)")


def test_cases_and_settings_without_a_result_are_counted(path):
    """Of a case without a reference a study writes that row alone."""
    table = read_study(path)
    table["status"][9] = 0
    assert left_out(table) == [] and work_precision(table).get_suptitle() == "geometric means over 2 cases"
    lost = {name: np.concatenate([values, values[[0, 0]]]) for name, values in table.items()}
    lost["case"][-2:], lost["status"][-2:] = (2, 3), 4
    assert left_out(lost) == ["2 of 4 cases have no result"]
    lost["status"][[2, 7, 9]] = 5  # a setting in both cases, and one of another way in one
    assert left_out(lost)[1] == "2 of 4 settings not shown, at which a case has no result (rodas5p, euler)"
    words = ", ".join(["geometric means over 2 cases", *left_out(lost)])
    assert work_precision(lost).get_suptitle().replace("\n", " ") == words


def test_films_without_evaluations_have_no_panel_of_them(path):
    table = read_study(path)
    table["evaluations"][3] = NAN
    assert len(work_precision(table).axes) == 2


def test_an_axis_of_few_decades_has_plain_numbers_that_do_not_overlap(path):
    figure = work_precision(read_study(path))
    figure.draw_without_rendering()
    for axes in figure.axes:
        labels = [label for label in axes.get_xticklabels(which="both") if label.get_text()]
        boxes = sorted((box.x0, box.x1) for box in (label.get_window_extent() for label in labels))
        assert len(labels) >= 2 and not any("$" in label.get_text() for label in labels)
        assert all(left[1] < right[0] for left, right in zip(boxes, boxes[1:])), [label.get_text() for label in labels]


def test_a_file_that_is_no_study_is_refused(tmp_path, capsys):
    with h5py.File(tmp_path / "other.h5", "w") as file:
        file["x"] = 1
    assert main([str(tmp_path / "other.h5")]) == 2
    assert "not a study" in capsys.readouterr().err


@pytest.mark.parametrize("group, words", [
    ("study/audit", "what `camroller audit` has measured, not a study; post/plot_audit.py draws it"),
    ("ehl", "the solved contacts of `camroller ehl`, not a study; post/ehl.py draws it"),
    ("summary", "the results of a run or sweep, not a study; post/plot.py draws them")])
def test_a_file_of_another_kind_is_named(tmp_path, capsys, group, words):
    with h5py.File(tmp_path / "other.h5", "w") as file:
        file[f"{group}/status"] = [0]
    assert main([str(tmp_path / "other.h5")]) == 2
    assert capsys.readouterr().err.endswith(f"other.h5: {words}\n")


def test_a_file_in_the_place_of_the_folder_is_told(path, tmp_path, capsys):
    (tmp_path / "t.txt").write_text("mine")
    assert main([str(path), "--output", str(tmp_path / "t.txt")]) == 2
    assert f"{tmp_path / 't.txt'} is a file and no folder" in capsys.readouterr().err
