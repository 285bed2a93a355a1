"""Tables of results and of sweeps."""

import re

import h5py
import numpy as np
import pytest

from read import read_result
import report
from table import COLUMNS, MOST_ROWS, main, table_of
from test_cases import ZIP, without_series
from test_post import SPEED, write_result


@pytest.fixture(name="grid")
def a_sweep(tmp_path):
    """A sweep of 60 cases without series."""
    path = without_series(write_result(tmp_path / "grid.h5", speeds=tuple(np.linspace(300, 900, 12)),
                                       oils=(25.0, 40.0, 60.0, 80.0, 95.0), step=30.0))
    with h5py.File(path, "a") as file:
        for name, unit, value in (("contact_loss_speed", "rad s-1", 307.5795), ("estimated_error", "1", 8.4e-5),
                                  ("max_hertz_pressure", "Pa", 974689074.0), ("counter_steps", "1", 133.0)):
            file[f"summary/{name}"] = np.full(60, value)
            file[f"summary/{name}"].attrs["units"] = unit
    return path


def rows(text):
    """Cells of the table, row by row, without the line below the headings."""
    lines = [[cell.strip() for cell in line.strip("|").split("|")] for line in text.splitlines() if line.startswith("|")]
    return lines[:1] + lines[2:]


def test_numbers_are_neither_nought_nor_endless_and_speeds_are_in_rev_min(grid):
    names = ["contact_loss_speed", "estimated_error", "max_hertz_pressure", "counter_steps", "status"]
    head, first, *_ = rows(table_of(read_result(grid), names))
    assert head[2:] == ["contact_loss_speed [rev/min]", "estimated_error", "max_hertz_pressure [GPa]", "counter_steps", "status"]
    assert first[2:] == ["2937", "8.40e-05", "0.975", "133", "0"]


def test_limits_of_speed_name_the_shaft_where_the_deck_has_the_speed_of_the_crankshaft(grid):
    names = ["contact_loss_speed", "max_hertz_pressure"]
    with h5py.File(grid, "a") as file:
        file["summary/crank_turns"] = np.full(60, 2.0)
        file["summary/crank_turns"].attrs["units"] = "1"
    assert rows(table_of(read_result(grid), names))[0][2:] == ["contact_loss_speed of the camshaft [rev/min]", "max_hertz_pressure [GPa]"]
    over = rows(table_of(read_result(grid), names, over=("oil_temperature_degC",), take="range"))[0]
    assert "contact_loss_speed of the camshaft [rev/min]" in " ".join(over)


def test_a_long_table_is_cut_and_says_so(grid, capsys):
    assert main([str(grid)]) == 0
    text = capsys.readouterr().out
    assert len(rows(text)) == 1 + MOST_ROWS and f"{60 - MOST_ROWS} of 60 cases are left out" in text
    assert main([str(grid), "--all"]) == 0
    text = capsys.readouterr().out
    assert len(rows(text)) == 61 and "left out" not in text
    assert main([str(grid), "--rows", "3", "--cases", "speed=300"]) == 0
    text = capsys.readouterr().out
    assert len(rows(text)) == 4 and "2 of 5 cases are left out" in text


def test_cases_that_are_no_grid_have_their_number(tmp_path):
    head, *body = rows(table_of(read_result(write_result(tmp_path / "zip.h5", points=ZIP, step=30.0))))
    assert head[:3] == ["case", "speed_rpm", "oil_temperature_degC"]
    assert [row[:3] for row in body] == [["0", "300", "25"], ["1", "600", "60"], ["2", "900", "95"]]


def test_the_table_of_a_grid_has_the_units_of_its_headings(tmp_path):
    result = read_result(write_result(tmp_path / "nine.h5", step=15.0))
    head, first, *_ = rows(table_of(result))
    assert head[:2] == ["speed_rpm", "oil_temperature_degC"]
    shown = [column for column in COLUMNS if column[0] in result.summary]
    assert head[2:] == [f"{heading} [{unit}]" for _, heading, unit in shown] and len(shown) > 4
    torque = result.summary["mean_torque_contact"].values[0]
    assert float(first[head.index("contact [N mm]")]) == pytest.approx(1e3 * torque, rel=5.01e-3)


def test_a_single_operating_point_is_in_the_table(tmp_path):
    path = write_result(tmp_path / "one.h5", speeds=(2500.0,), oils=(60.0,), swept=(), step=30.0)
    head, first = rows(table_of(read_result(path)))
    assert head[:3] == ["speed_rpm", "oil_temperature_degC", "contact [N mm]"] and first[:2] == ["2500", "60"]
    path = write_result(tmp_path / "oils.h5", oils=(62.5,), swept=(SPEED,), step=30.0)
    head, *body = rows(table_of(read_result(path)))
    assert head[:3] == ["oil_temperature_degC", "speed_rpm", "contact [N mm]"]
    assert [row[:2] for row in body] == [["62.5", "300"], ["62.5", "600"], ["62.5", "900"]]
    head, first = rows(table_of(read_result(path), ["mean_slip_ratio"], over=["speed_rpm"], take="largest"))
    assert head == ["oil_temperature_degC", "cases", "largest mean_slip_ratio [%]"] and first[:2] == ["62.5", "3"]


def test_failed_cases_have_dashes_and_a_reason(grid, capsys):
    with h5py.File(grid, "a") as file:
        file["summary/status"][2] = 3
        file["summary/estimated_error"][2] = np.nan
        file["run/messages"] = np.array(["", "", "no periodic state"] + 57 * [""], dtype="S20")
    assert main([str(grid), "--columns", "estimated_error", "--rows", "3"]) == 0
    text = capsys.readouterr().out
    assert [row[-1] for row in rows(text)[1:]] == ["8.40e-05", "8.40e-05", "-"]
    assert "Case 2 has no result: no periodic state" in text


def test_cases_that_were_not_computed_are_one_line(grid, capsys):
    with h5py.File(grid, "a") as file:
        file["summary/status"][3:] = -1
        file["summary/status"][1] = 3
        file["run/messages"] = np.array(["", "no periodic state"] + 58 * [""], dtype="S20")
    for options in ([], ["--all"]):
        assert main([str(grid), "--columns", "estimated_error", *options]) == 0
        text = capsys.readouterr().out
        assert "57 of 60 cases were not computed: the file is partial.\n" in text
        assert [line for line in text.splitlines() if "no result" in line] == ["Case 1 has no result: no periodic state"]


def test_a_film_that_is_not_there_is_no_thin_one(grid):
    with h5py.File(grid, "a") as file:
        for name, unit, value in (("min_film_thickness_min", "m", 2.5e-7), ("min_film_ratio", "1", 1.25)):
            file[f"summary/{name}"] = np.full(60, value)
            file[f"summary/{name}"].attrs["units"] = unit
            file[f"summary/{name}"][1] = 0.0
    body = rows(table_of(read_result(grid), ["min_film_thickness_min", "min_film_ratio"]))[1:]
    assert [row[-2:] for row in body[:3]] == [["0.250", "1.25"], ["-", "-"], ["0.250", "1.25"]]
    ranges = rows(table_of(read_result(grid), ["min_film_ratio"], over=["speed_rpm"], take="range"))[1:]
    assert {row[-1] for row in ranges} == {"-", "1.25 to 1.25"}


def test_words_in_the_summary_are_printed_as_they_are(grid):
    with h5py.File(grid, "a") as file:
        file["summary/contact"] = np.array(60 * ["lost at 180 deg"], dtype="S20")
    assert rows(table_of(read_result(grid), ["contact"]))[1][-1] == "lost at 180 deg"


@pytest.mark.parametrize("arguments, words", [
    (["--columns", "spring_margn"], "no scalar spring_margn in the summary; there is spring_margin"),
    (["--columns", "limits"], "does not have one value for each of 60 cases"), (["--cases", "60"], "has the cases 0 to 59"),
    (["--cases", "speed=1"], "no case is left")])
def test_what_cannot_be_printed_is_one_line_and_code_2(grid, capsys, arguments, words):
    with h5py.File(grid, "a") as file:
        file["summary/spring_margin"] = np.ones(60)
        file["summary/limits"] = np.ones((60, 2))
    assert main([str(grid), *arguments]) == 2
    captured = capsys.readouterr()
    assert words in captured.err and captured.err.count("\n") == 1 and captured.out == ""


@pytest.mark.parametrize("arguments", [["--rows", "0"], ["--rows", "x"], ["--rows", "3", "--all"]])
def test_wrong_options_are_refused(grid, arguments):
    with pytest.raises(SystemExit) as end:
        main([str(grid), *arguments])
    assert end.value.code == 2


def test_keys_of_one_name_are_told_apart(tmp_path):
    path = write_result(tmp_path / "zip.h5", points=ZIP, step=30.0)
    with h5py.File(path, "a") as file:
        for group in ("film", "asperity"):
            file[f"sweep/{group}.law"] = np.array(["x", "y", "z"], dtype="S1")
    head = rows(table_of(read_result(path)))[0]
    assert {"film.law", "asperity.law", SPEED.split(".")[1]} <= set(head)


def test_rows_over_speeds_have_the_worst_of_them(tmp_path):
    path = write_result(tmp_path / "grid.h5", without=())
    result = read_result(path)
    slip = 100.0 * result.summary["mean_slip_ratio"].values.reshape(3, 3)
    for take, function in (("largest", np.max), ("smallest", np.min), ("mean", np.mean)):
        head, *body = rows(table_of(result, ["mean_slip_ratio"], over=["speed_rpm"], take=take))
        assert head == ["oil_temperature_degC", "cases", f"{take} mean_slip_ratio [%]"]
        assert [row[:2] for row in body] == [["25", "3"], ["60", "3"], ["95", "3"]]
        assert [float(row[2]) for row in body] == pytest.approx(function(slip, axis=0), rel=6e-3)


def test_rows_over_speeds_have_the_range_of_them(tmp_path):
    path = write_result(tmp_path / "grid.h5", without=())
    result = read_result(path)
    slip = 100.0 * result.summary["mean_slip_ratio"].values.reshape(3, 3)
    head, *body = rows(table_of(result, ["mean_slip_ratio"], over=["speed_rpm"], take="range"))
    assert head == ["oil_temperature_degC", "cases", "range mean_slip_ratio [%]"]
    ends = [[float(end) for end in row[2].split(" to ")] for row in body]
    assert ends == [pytest.approx([low, high], rel=6e-3) for low, high in zip(slip.min(0), slip.max(0))]


def test_a_row_with_a_case_without_result_has_no_number(tmp_path, capsys):
    path = write_result(tmp_path / "grid.h5")
    with h5py.File(path, "a") as file:
        file["summary/mean_slip_ratio"][4] = np.nan
    head, *body = rows(table_of(read_result(path), ["mean_slip_ratio"], over=["oil_temperature_degC"], take="largest"))
    assert [row[2] for row in body][1] == "-" and all(float(row[2]) >= 0 for row in (body[0], body[2]))
    assert main([str(path), "--over", "colour"]) == 2
    assert "'colour' is not one of the swept keys" in capsys.readouterr().err


def test_several_lobe_shapes_show_the_worst(grid, capsys):
    scalars = {"min_film_thickness_min": ("m", 1e-7), "min_lobe_2_film_thickness_min": ("m", 0.0),
               "max_lobe_2_hertz_pressure": ("Pa", 2.01e9), "mean_lobe_2_slip_ratio": ("1", 0.0)}
    head, first, *_ = rows(table_of(read_result(grid)))
    before = dict(zip(head, first))
    with h5py.File(grid, "a") as file:
        for name, (unit, value) in scalars.items():
            file[f"summary/{name}"] = np.full(60, value)
            file[f"summary/{name}"].attrs["units"] = unit
    assert main([str(grid)]) == 0
    text = capsys.readouterr().out
    head, first, *_ = rows(text)
    after = dict(zip(head, first))
    # no film where the second shape loses contact
    assert [value for name, value in after.items() if name.startswith("smallest film")] == ["-"]
    assert after["peak pressure [GPa]"] == "2.01" and after["mean slip [%]"] == before["mean slip [%]"]
    assert "mean slip, peak pressure, smallest film: the worst of all lobe shapes" in text
    # asked for by name, a scalar is that of its shape
    assert main([str(grid), "--columns", "max_hertz_pressure,max_lobe_2_hertz_pressure"]) == 0
    text = capsys.readouterr().out
    assert rows(text)[1][2:] == ["0.975", "2.01"] and "lobe shapes" not in text


def test_one_lobe_shape_says_nothing_of_several(grid):
    assert "lobe shapes" not in table_of(read_result(grid))


def test_peak_pressure_is_that_along_the_roller_where_there_is_one(grid):
    """As in the program's own table."""
    assert "peak pressure [GPa]" in rows(table_of(read_result(grid)))[0]
    with h5py.File(grid, "a") as file:
        file["summary/max_axial_pressure_max"] = np.full(60, 1.25e9)
        file["summary/max_axial_pressure_max"].attrs["units"] = "Pa"
    result = read_result(grid)
    head, first, *_ = rows(table_of(result))
    assert head.count("peak pressure [GPa]") == 1 and first[head.index("peak pressure [GPa]")] == "1.25"
    shown = re.search(r"<table>.*?</table>", report.table_of(result), re.S)[0]
    assert shown.count("peak pressure") == 1 and ">1.25<" in shown and "0.975" not in shown


def test_a_scalar_chosen_by_name_has_its_name_and_not_the_heading_of_the_worst_lobe_shape(grid):
    with h5py.File(grid, "a") as file:
        for name, value in (("min_film_thickness_min", 2e-7), ("min_lobe_2_film_thickness_min", 1e-7)):
            file[f"summary/{name}"] = np.full(60, value)
            file[f"summary/{name}"].attrs["units"] = "m"
    head, first, *_ = rows(table_of(read_result(grid), ["min_film_thickness_min"], over=["speed_rpm"], take="range"))
    assert (head[-1], first[-1]) == ("range min_film_thickness_min [um]", "0.200 to 0.200")
    head, first, *_ = rows(table_of(read_result(grid), over=["speed_rpm"], take="range"))
    assert dict(zip(head, first))["range smallest film [um]"] == "0.100 to 0.100"


def test_swept_values_that_differ_late_are_told_apart(tmp_path):
    path = write_result(tmp_path / "near.h5", points=((300.0, 25.0), (300.0000001, 25.0), (900.0, 25.0)), step=30.0)
    shown = {"300.0000001", "300", "900"}
    assert {row[0] for row in rows(table_of(read_result(path)))[1:]} == shown
    assert set(re.findall(r"<td>([\d.]+)</td><td>25</td>", report.table_of(read_result(path)))) == shown


def test_rows_with_lost_contact_are_named(grid):
    assert "contact" not in table_of(read_result(grid), ["estimated_error"], rows=5)
    with h5py.File(grid, "a") as file:
        file["summary/lobe_2_lost_contact_share"] = np.where(np.isin(np.arange(60), (2, 4, 30)), 0.1, 0.0)
    text = table_of(read_result(grid), ["estimated_error"], rows=5)
    assert "Contact of lobe 2 is lost in 2 of 5 cases (2, 4): loads and friction of a rigid train are not realistic there." in text
    assert "Contact" not in table_of(read_result(grid), ["estimated_error"], rows=2)
    with h5py.File(grid, "a") as file:
        file["summary/period_cycles"] = np.ones(60)
    assert "Contact of lobe 2 is lost in 2 of 5 cases (2, 4)." in table_of(read_result(grid), ["estimated_error"], rows=5)


def test_of_many_failures_the_first_are_told(grid):
    with h5py.File(grid, "a") as file:
        file["summary/status"][:20] = 5
        file["run/messages"] = [f"case {case}: no film" if case < 20 else "" for case in range(60)]
    lines = [line for line in table_of(read_result(grid)).splitlines() if "no result" in line]
    assert lines == [*(f"Case {case} has no result: no film" for case in range(5)), "15 more cases have no result"]


@pytest.mark.parametrize("options, words", [
    (["--take", "mean"], "table.py: --take mean is of several cases that count as one: give with --over the keys that they differ in"),
    (["--columns", ","], "table.py: --columns names nothing: it takes names separated by commas, not ','"),
])
def test_options_that_would_do_nothing_are_refused(grid, capsys, options, words):
    assert main([str(grid), *options]) == 2
    assert capsys.readouterr().err.strip() == words


def test_a_list_of_names_is_given_once(grid, capsys):
    with pytest.raises(SystemExit) as end:
        main([str(grid), "--over", "speed_rpm", "--over", "oil_temperature_degC"])
    assert end.value.code == 2 and "--over is given more than once: list its names in one" in capsys.readouterr().err
