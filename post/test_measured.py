"""Measured points beside results: made-up points with known offsets come back as bias, root mean square and worst point."""

import re

import h5py
import numpy as np
import pytest

from plot import main
from measured import compare, draw_comparison, read_table
from read import ResultError, read_result
from test_post import write_result


@pytest.fixture(name="nine")
def fixture_nine(tmp_path):
    return write_result(tmp_path / "nine.h5")


def write_table(path, heading, rows):
    path.write_text("\n".join(["# a rig", heading, *(", ".join(f"{value:.12g}" for value in row) for row in rows)]), encoding="utf-8")
    return path


def test_offset_over_the_cam_angle_is_the_bias(nine, tmp_path, capsys):
    result = read_result(nine)
    curve = 1e3 * result.series["torque_drive"].values[4]
    offsets = np.where(result.cam_angle == 100.0, 9.0, 2.0)
    table = write_table(tmp_path / "rig.csv", "cam angle [deg], torque [N mm]", zip(result.cam_angle, curve + offsets))
    found = compare(read_table(table), result, [4])
    assert found.differences == pytest.approx(offsets, abs=1e-6)
    assert main([str(nine), "--measured", str(table), "--cases", "4"]) == 0
    words = capsys.readouterr().out
    assert f"{len(curve)} points, bias {offsets.mean():.2f} N mm, rms {np.sqrt((offsets ** 2).mean()):.2f} N mm" in words
    assert re.search(r"worst 9(\.00)? N mm at cam angle 100 deg", words)
    assert (tmp_path / "nine_measured.png").read_bytes().startswith(b"\x89PNG")


def test_the_case_is_named_and_has_series(nine, tmp_path, capsys):
    table = write_table(tmp_path / "rig.csv", "cam angle [deg], torque [N m]", [(180.0, 1.0), (100.0, 2.0)])
    with h5py.File(nine, "a") as file:
        for name in file["series"]:
            if name != "cam_angle":
                file[f"series/{name}"][:5] = np.nan
    assert main([str(nine), "--measured", str(table)]) == 0
    words = capsys.readouterr().out
    assert "rig.csv less " in words and "nine.h5, case 5 (speed_rpm=600, oil_temperature_degC=95): 2 points, bias " in words
    figure = draw_comparison(read_table(table), read_result(nine), [5], compare(read_table(table), read_result(nine), [5]))
    assert figure.axes[0].get_title().startswith("made up, case 5 (speed_rpm=600, oil_temperature_degC=95) and rig.csv\n")
    assert main([str(nine), "--measured", str(table), "--cases", "0-4"]) == 2
    assert "no series of these cases in the file" in capsys.readouterr().err


def test_between_the_points_of_the_series_the_line_counts(nine, tmp_path):
    result = read_result(nine)
    curve = result.series["torque_friction"].values[0]
    table = write_table(tmp_path / "rig.csv", "cam angle [deg], friction torque [N m]", [(357.5, 0.5 * (curve[-1] + curve[0]))])
    assert compare(read_table(table), result, [0]).differences == pytest.approx([0.0], abs=1e-9)


@pytest.mark.parametrize("angle, turn", [("cam", 360.0), ("crank", 720.0)])
def test_points_outside_of_a_turn_are_drawn_on_the_curve(nine, tmp_path, angle, turn):
    with h5py.File(nine, "a") as file:
        file["summary/crank_turns"], file["summary/crank_angle_at_nose"] = np.full(9, 2.0), np.full(9, 470.0)
    table = read_table(write_table(tmp_path / "rig.csv", f"{angle} angle [deg], torque [N m]", [(-90.0, 1.0), (10.0, 2.0), (turn + 30.0, 3.0)]))
    result = read_result(nine)
    axes = draw_comparison(table, result, [0], compare(table, result, [0])).axes[0]
    drawn = next(line for line in axes.lines if line.get_label() == "measured")
    assert list(drawn.get_xdata()) == [turn - 90.0, 10.0, 30.0] and list(drawn.get_ydata()) == [1.0, 2.0, 3.0]


def test_the_speed_of_measured_points_names_its_shaft(nine, tmp_path):
    with h5py.File(nine, "a") as file:
        file["deck/values/engine.given_speed"], file["summary/crank_turns"] = "crankshaft", np.full(9, 2.0)
    table = read_table(write_table(tmp_path / "rig.csv", "speed [rpm], temperature [degC], mean torque [N mm]", [(300.0, 60.0, 30.0)]))
    result = read_result(nine)
    assert draw_comparison(table, result, range(9), compare(table, result, range(9))).axes[0].get_xlabel() == "crankshaft speed [rev/min]"


@pytest.mark.parametrize("option", [["--figure", "slip"], ["--angles", "cycle"]])
def test_options_of_other_figures_beside_measured_points_are_refused(nine, tmp_path, capsys, option):
    table = write_table(tmp_path / "rig.csv", "cam angle [deg], torque [N m]", [(180.0, 1.0)])
    assert main([str(nine), "--measured", str(table), *option]) == 2
    assert "leave out --figure and --angles" in capsys.readouterr().err


def test_angles_in_radians_and_a_mark_of_byte_order_change_nothing(nine, tmp_path, capsys):
    result = read_result(nine)
    table = write_table(tmp_path / "rig.csv", "cam angle [rad], torque [N m]", [(np.pi, 1.0)])
    table.write_bytes(b"\xef\xbb\xbf" + table.read_bytes().partition(b"\n")[2])
    found = compare(read_table(table), result, [0])
    assert found.computed == pytest.approx(result.series["torque_drive"].values[0][result.cam_angle == 180.0])
    assert main([str(nine), "--measured", str(table)]) == 0
    words = capsys.readouterr().out
    assert ": 1 point, bias" in words and "at cam angle 180.0 deg" in words


@pytest.mark.parametrize("heading, row", [
    ("cam angle [deg]\ttorque [N m]", "180\t1.5"), ("cam angle [deg], torque [N m]", "180\t1.5"),
    ("cam angle [deg]\ttorque [N m]", "180, 1.5"), ("cam angle [deg]  torque [N m]", "  180   1.5 "),
    ('"cam angle [deg]"\t"torque [N m]"', "180 \t 1.5"), ("cam angle [deg]; torque [N m]", "180;1.5"),
])
def test_columns_are_parted_by_commas_or_white_space(tmp_path, heading, row):
    (tmp_path / "rig.csv").write_text(f"{heading}\n{row}\n", encoding="utf-8")
    table = read_table(tmp_path / "rig.csv")
    assert {name: list(values) for name, values in table.columns.items()} == {"cam angle": [180.0], "torque": [1.5]}
    assert table.units == {"cam angle": "deg", "torque": "N m"}


def test_crank_angle_goes_by_the_engine(nine, tmp_path):
    table = write_table(tmp_path / "rig.csv", "crank angle [deg], torque [N m]", [(470.0, 0.0), (110.0, 0.0)])
    with pytest.raises(ResultError, match="crank angles need the group &engine"):
        compare(read_table(table), read_result(nine), [0])
    with h5py.File(nine, "a") as file:
        file["summary/crank_turns"] = np.full(9, 2.0)
        file["summary/crank_angle_at_nose"] = np.full(9, 470.0)
    result = read_result(nine)
    curve = result.series["torque_drive"].values[0]
    found = compare(read_table(table), result, [0])
    # 470 degrees of crank angle are the nose at 180, 110 degrees are half a turn of the camshaft away
    assert found.computed == pytest.approx([curve[result.cam_angle == 180.0][0], curve[0]])
    figure = draw_comparison(read_table(table), result, [0], found)
    assert figure.axes[0].get_xlabel() == "crank angle from the firing dead centre of cylinder 1 [deg]"
    # no point is behind the legend
    assert figure.axes[0].get_legend() is None and len(figure.legends) == 1
    assert main([str(nine), "--measured", str(table)]) == 0


def test_operating_points_find_their_cases(nine, tmp_path, capsys):
    result = read_result(nine)
    torque = 1e3 * result.summary["mean_torque_friction"].values
    rows = [(300.0, 25.0, torque[0] + 5.0), (900.0, 95.0, torque[8] - 1.0), (1200.0, 95.0, 7.0)]
    table = write_table(tmp_path / "rig.csv", "speed [rpm], temperature [degC], mean torque [N mm]", rows)
    assert main([str(nine), "--measured", str(table)]) == 0
    words = capsys.readouterr().out
    assert re.search(r"2 points, bias 2(\.00)? N mm", words)
    assert re.search(r"worst 5(\.00)? N mm at 300 rev/min, 25 degC; 1 point has no case", words)


POINTS = "speed [rpm], temperature [degC], mean torque [N mm]"


@pytest.fixture(name="two_laws")
def fixture_two_laws(tmp_path):
    """Two speeds with each of two film laws, the second with a torque of 1 N mm more; no case at 600 rev/min and 60 degC."""
    path = write_result(tmp_path / "laws.h5", points=2 * [(300.0, 25.0), (600.0, 25.0), (300.0, 60.0)], step=15.0)
    with h5py.File(path, "a") as file:
        file["sweep/film.law"] = np.array(3 * ["moes"] + 3 * ["pan_hamrock"], dtype="S12")
        file["summary/mean_torque_friction"][3:] += 1e-3
    return path


def test_operating_points_are_compared_with_chosen_cases_only(two_laws, tmp_path, capsys):
    torque = 1e3 * read_result(two_laws).summary["mean_torque_friction"].values
    table = write_table(tmp_path / "rig.csv", POINTS, [(300.0, 25.0, torque[0] + 5.0), (600.0, 25.0, torque[1] + 5.0)])
    assert main([str(two_laws), "--measured", str(table)]) == 2
    assert capsys.readouterr().err == (f"plot.py: {two_laws}: 2 cases are at 300 rev/min, 25 degC: case 0 (law=moes), "
                                       "case 3 (law=pan_hamrock); choose with --cases\n")
    for law, bias in (("moes", "5"), ("pan_hamrock", "4")):
        assert main([str(two_laws), "--measured", str(table), "--cases", f"law={law}"]) == 0
        assert re.search(rf"2 points, bias {bias}(\.00)? N mm, rms {bias}(\.00)? N mm", capsys.readouterr().out)
    assert main([str(two_laws), "--measured", str(table), "--cases", "1"]) == 0
    assert "1 point, bias" in (words := capsys.readouterr().out) and "1 point has no case" in words


def test_operating_points_have_a_line_for_each_combination_of_other_keys(two_laws, tmp_path):
    result = read_result(two_laws)
    torque = 1e3 * result.summary["mean_torque_friction"].values
    table = read_table(write_table(tmp_path / "rig.csv", POINTS, [(300.0, 25.0, torque[0])]))
    # the second speed of the first law and both of the second are at no point of the table twice
    figure = draw_comparison(table, result, [0, 1, 4], compare(table, result, [0, 1, 4]))
    lines = {line.get_label(): (line.get_xdata(), line.get_ydata()) for line in figure.axes[0].lines if len(line.get_xdata())}
    for label, cases in (("computed, 25 degC, law=moes", [0, 1]), ("computed, 25 degC, law=pan_hamrock", [4])):
        assert list(lines[label][0]) == [300.0, 600.0][2 - len(cases):] and list(lines[label][1]) == pytest.approx(torque[cases])
    assert sorted(label for label in lines if "computed" in label) == ["computed, 25 degC, law=moes", "computed, 25 degC, law=pan_hamrock"]
    assert list(lines["measured, 25 degC"][0]) == [300.0]


@pytest.mark.parametrize(("text", "words"), [
    ("cam angle, torque\n1, 2\n", "a heading is a name with its unit"),
    ("cam angle [deg], torque [N m]\n1, x\n", "line 2 is not of numbers"),
    ("# a rig\n\ncam angle [deg], torque [N m]\n# first\n1, 2\n3, x\n", "line 6 is not of numbers"),
    ("cam angle [deg], torque [N m]\n1, 2\n3, nan\n", "rig.csv: line 3: only finite numbers are allowed, not 3, nan"),
    ("cam angle [deg]\ttorque [N m]\n180\t1,5\n", "line 2 is not of numbers: 180\t1,5; a comma parts columns, decimals have a point"),
    ("cam angle [deg]; torque [N m]\n0; 0,1\n", "line 2 is not of numbers: 0; 0,1; a comma parts columns, decimals have a point"),
    ("cam angle [deg], torque [N m]\n0, 0,1\n", "line 2 has 3 of 2 columns; a comma parts columns, decimals have a point"),
    ("cam angle [deg]\ttorque\n180\t1.5\n", "a heading is a name with its unit"),
    ("cam angle [deg]\ttorque [N m]\n180\t\n", "line 2 has 1 of 2 columns"),
    ("cam angle [turns], torque [N m]\n1, 2\n", "the unit of 'cam angle' has to be deg, degree, degrees, ° or rad, not turns"),
    ("cam angle [deg], torque [N m]\n1\n", "line 2 has 1 of 2 columns"),
    ("cam angle [deg], torque [kg]\n1, 2\n", "has to be N m or N mm"),
    ("cam angle [deg], torque [N m], torque [N mm]\n1, 2, 3\n", "two columns are called 'torque'"),
    ("speed [rpm], cam angle [deg], torque [N m]\n300, 1, 2\n", "the column 'speed' is not compared beside cam angle, torque: leave it out"),
    ("cam angle [deg], crank angle [deg], torque [N m]\n1, 2, 3\n", "the column 'crank angle' is not compared"),
    ("speed [rpm], temperature [degC], torque [N m], load [N]\n300, 25, 2, 3\n", "the column 'load' is not compared"),
    ("lift [mm], torque [N m]\n1, 2\n", "the columns have to be an angle"),
    ("cam angle [deg], torque [N m]\n", "a heading and rows"),
])
def test_tables_that_are_none_are_told_in_one_line(nine, tmp_path, capsys, text, words):
    path = tmp_path / "rig.csv"
    path.write_text(text, encoding="utf-8")
    assert main([str(nine), "--measured", str(path)]) == 2
    message = capsys.readouterr().err
    assert words in message and message.count("\n") == 1


@pytest.mark.parametrize("heading, words", [
    ("speed [1/s], temperature [degC], mean torque [N mm]", "the unit of 'speed' has to be rpm or rev/min or 1/min, not 1/s"),
    ("speed [rpm], temperature [K], mean torque [N mm]", "the unit of 'temperature' has to be degC or °C, not K"),
    ("speed [rpm], temperature [degC], load [N]", "one column has to be a torque, not none"),
    ("speed [rpm], oil [degC], torque [N mm]", "there is speed, oil, torque"),
])
def test_units_and_columns_that_are_not_meant_are_told(nine, tmp_path, heading, words):
    table = write_table(tmp_path / "rig.csv", heading, [(300.0, 60.0, 30.0)])
    with pytest.raises(ResultError, match=re.escape(words)):
        compare(read_table(table), read_result(nine), [0])


def test_a_friction_torque_of_operating_points_is_one(nine, tmp_path):
    result = read_result(nine)
    computed = 1e3 * result.scalar("mean_torque_friction").values[0]
    table = write_table(tmp_path / "rig.csv", "speed [rev/min], temperature [°C], friction torque [N mm]", [
        (result.value_of("operating_point.speed_rpm", 0), result.value_of("operating_point.oil_temperature_degC", 0), computed + 3.0)])
    assert compare(read_table(table), result, [0]).differences == pytest.approx([3.0])
