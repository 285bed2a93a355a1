"""Figure and table of an audit."""

import h5py
import numpy as np
import pytest

import plot_audit
from plot_audit import effects, main, read_audit, table


@pytest.fixture(name="path")
def made_up(tmp_path):
    """An audit of two cases and two effects, one run of which failed."""
    with h5py.File(tmp_path / "made_audit.h5", "w") as file:
        audit = file.create_group("study/audit")
        audit["case"] = np.repeat([0.0, 1.0], 3)
        audit["run"] = np.array(2 * ["listed", "without", "without"], dtype="S8")
        audit["effect"] = np.array(2 * ["", "asperity", "valve_guide"], dtype="S20")
        audit["status"] = np.array([0, 0, 0, 0, 0, 5.0])
        for name in ("mean_torque", "minimum_film", "slip"):
            audit["change_" + name] = np.array([0, -0.25, 0.01, 0, -0.5, np.nan])
            audit["estimate_" + name] = np.array([np.nan, 0.5, np.inf, np.nan, 0.6, 1.797e308])
        audit["time_share"] = np.array([0, 0.3, 0.0, 0, 0.5, np.nan])
        audit["is_left_out"] = np.array([np.nan, 0, 1, np.nan, 0, 0])
    return tmp_path / "made_audit.h5"


def test_the_table_spans_the_cases_that_have_a_result(path):
    audit = read_audit(path)
    assert effects(audit) == ["asperity", "valve_guide"]
    lines = table(audit).splitlines()
    assert lines[2].startswith("| asperity | -50 to -25 % |") and lines[2].endswith("| 40 % | 2 of 2 |")
    assert lines[3].endswith("| 0 % | 0 of 1 |")
    assert lines[4:] == ["", "1 of 4 runs without an effect has no result."]


def test_cases_without_a_result_are_counted(path, tmp_path, capsys, monkeypatch):
    """A case that fails as it is counts as one, whatever becomes of its runs without an effect, which are compared with nothing."""
    with h5py.File(path, "a") as file:
        audit = file["study/audit"]
        audit["status"][3:] = [5.0, 0.0, 5.0]
        for name in ("change_mean_torque", "change_minimum_film", "change_slip", "time_share"):
            audit[name][3:] = np.nan
    audit = read_audit(path)
    assert effects(audit) == ["asperity", "valve_guide"] and table(audit).endswith("| 0 of 1 |\n\n1 of 2 cases has no result.")
    figures = []
    monkeypatch.setattr(plot_audit, "save_figure", lambda figure, *_, **__: figures.append(figure))
    assert main([str(path), "--output", str(tmp_path)]) == 0
    assert figures[0].get_suptitle() == "1 of 2 cases has no result, 3 of 6 changes have no bound beforehand"


def test_small_and_huge_changes_are_plain_numbers_and_none_is_drawn_as_one(path):
    audit = read_audit(path)
    audit["change_mean_torque"][:] = [0, -1.0, 0, 0, 1.4e3, 0]
    audit["time_share"][:] = [0, -0.003, 0, 0, -0.003, 0]
    assert table(audit).splitlines()[2].startswith("| asperity | -100 to 140000 % |") and "| 0 % | 2 of 2 |" in table(audit)
    assert "1 of 9 changes are below 1e-07 and drawn there" in plot_audit.draw(audit).get_suptitle()


def test_a_time_that_the_machine_disturbed_does_not_hide_the_others(path):
    audit = {name: np.tile(values, 4) for name, values in read_audit(path).items()}
    figure = plot_audit.draw(audit)
    assert "not shown" not in figure.get_suptitle()
    assert "median of the time saved" in [text.get_text() for text in figure.legends[0].get_texts()]
    audit["time_share"][1] = -5.78
    figure = plot_audit.draw(audit)
    assert figure.axes[3].get_xlim()[0] > -500 and "1 of 12 times beyond" in figure.get_suptitle()


def test_a_figure_is_drawn(path, tmp_path, capsys):
    assert main([str(path), "--output", str(tmp_path / "figures"), "--name", "drawn"]) == 0
    assert (tmp_path / "figures/drawn.png").stat().st_size > 10000
    assert main([str(path), "--table"]) == 0
    assert "valve guide" in capsys.readouterr().out


def test_what_is_no_audit_is_refused(tmp_path, capsys):
    with h5py.File(tmp_path / "other.h5", "w"):
        pass
    assert main([str(tmp_path / "other.h5")]) == 2
    assert "not an audit" in capsys.readouterr().err
