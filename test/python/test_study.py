"""The command `study` from outside: table, file, failures."""

import pathlib
import re
import subprocess

import h5py
import numpy
import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
THESIS = (ROOT / "decks/thesis.nml").read_text()
QUICK = ["--quick", "--repeats", "1", "--set", "output.angle_step_deg=2"]


def study(camroller, *arguments, folder):
    """Run the program without a terminal."""
    return subprocess.run([camroller, "study", *map(str, arguments)], cwd=folder, capture_output=True, text=True,
                          stdin=subprocess.DEVNULL, timeout=600)


def read(path):
    """Columns of the table."""
    with h5py.File(path) as file:
        table = file["study/study"]
        return {name: numpy.array([text.decode() for text in data]) if data.dtype.kind in "SO" else data[()]
                for name, data in table.items()}


@pytest.fixture(scope="module")
def done(camroller, tmp_path_factory):
    """A quick study of one case."""
    folder = tmp_path_factory.mktemp("study")
    (folder / "one.nml").write_text(THESIS[:THESIS.index("&sweep")].replace("speed_rpm = 300", "speed_rpm = 600"))
    result = study(camroller, "one.nml", *QUICK, folder=folder)
    assert result.returncode == 0, result.stderr
    return folder / "one_study.h5", result.stdout


@pytest.mark.once
def test_turns_of_a_longer_period_are_not_compared(camroller, tmp_path):
    """Two ways may end with different turns: their distance is no error of integration. Round-off decides whether the turns agree with
    those two or four before first: a period of two is about to double here."""
    result = study(camroller, ROOT / "decks/lash_adjuster.nml", *QUICK, "--set", "sweep.values_1=1840", folder=tmp_path)
    assert result.returncode != 0
    assert re.search("no reference: the motion of the train repeats after [24] cycles only", result.stderr)


@pytest.mark.once
def test_turns_of_a_longer_period_of_a_second_lobe_are_not_compared(camroller, tmp_path):
    """The first lobe is so low that its train repeats itself with every turn; the second is that of the deck."""
    (tmp_path / "deck.nml").write_text(f"""include = '{ROOT}/decks/lash_adjuster.nml', without = 'sweep'
&lift max_lift_mm = 4 /
&second_lift law = 'power' max_lift_mm = 9.5 opening_half_angle_deg = 70 exponents = 4 /
&cam_bearings law = 'short_ocvirk' diameter_mm = 25 width_mm = 18 radial_clearance_um = 30
   bearing_positions_mm = 0, 50 cam_positions_mm = 16, 34 cam_lobes = 1, 2 /
""")
    result = study(camroller, "deck.nml", *QUICK, "--set", "operating_point.speed_rpm=1840", folder=tmp_path)
    assert result.returncode != 0
    assert re.search("no reference: the motion of the train repeats after [24] cycles only", result.stderr), result.stderr


def test_a_study_takes_all_effects(camroller, tmp_path):
    """A choice of effects would compare a law with itself."""
    text = THESIS[:THESIS.index("&sweep")] + "&effects select = 'needed' negligible = 0.1 /\n"
    (tmp_path / "deck.nml").write_text(text)
    (tmp_path / "all.nml").write_text(text.replace("needed", "listed"))
    for words in (["--laws"], [*QUICK]):
        needed, listed = (study(camroller, name, *words, "-o", name[:3] + ".h5", folder=tmp_path) if "--laws" not in words else
                          study(camroller, name, *words, folder=tmp_path) for name in ("deck.nml", "all.nml"))
        assert needed.returncode == 0 and "effects.select = 'needed' has no effect here" in needed.stderr, needed.stderr
        assert "has no effect here" not in listed.stderr
        if "--laws" in words:
            assert needed.stdout == listed.stdout
    first, second = (read(tmp_path / name) for name in ("dec.h5", "all.h5"))
    for name in ("error_mean_friction", "error_smallest_film", "evaluations"):
        assert numpy.array_equal(first[name], second[name], equal_nan=True)


@pytest.mark.parametrize("words", [["--quick", "--repeats", "1", "--set", "output.angle_step_deg=20"], ["--laws"]])
def test_a_value_that_the_sweep_varies_has_a_remark(camroller, tmp_path, words):
    (tmp_path / "deck.nml").write_text(THESIS[:THESIS.index("&sweep")]
                                       + "&sweep key_1 = 'operating_point.speed_rpm' values_1 = 300 /\n")
    result = study(camroller, "deck.nml", *words, "--set", "Operating_point.speed_rpm=600", folder=tmp_path)
    assert result.returncode == 0, result.stderr
    assert "remark: 'Operating_point.speed_rpm=600' is not used by the sweep, which varies operating_point.speed_rpm\n" in result.stderr


def test_the_table_is_printed(done):
    lines = done[1].splitlines()
    assert lines[0].startswith("Largest errors over all cases")
    for name in ("two methods", "automatic", "rodas5p", "radau5", "dormand_prince", "euler", "quasi_static",
                 "one_study.h5: 1 case in "):
        assert any(line.startswith(name) for line in lines), name
    assert max(map(len, lines)) <= 132


def first_column(lines):
    """Names in the first column of a table as it is printed, without its head and the line at its end."""
    return {line[:19].rstrip() for line in lines[3:] if line and not line[0].isspace() and ".h5: " not in line}


def test_the_table_of_the_documentation_has_the_methods_of_the_program(done):
    lines = (ROOT / "doc/accuracy_tables.txt").read_text(encoding="utf-8").splitlines()
    assert lines[:3] == done[1].splitlines()[:3] and first_column(lines) == first_column(done[1].splitlines())


def test_every_row_of_the_file_has_its_columns(done):
    with h5py.File(done[0]) as file:
        assert file.attrs["complete"] == 1
        assert file["deck/text"][()].decode().startswith("! Reference case")
        group = file["study/study"]
        assert len({column.shape for column in group.values()}) == 1
        for name, column in group.items():
            assert "long_name" in column.attrs
            assert name == "row" or column.dims[0][0].name == "/study/study/row"


def test_smaller_tolerances_give_smaller_errors_and_estimates_hold(done):
    table = read(done[0])
    for method in ("hermite", "rodas5p", "radau5"):
        rows = table["way"] == method
        errors = table["error_sliding_speed"][rows]
        assert list(table["setting"][rows]) == [1e-2, 1e-4, 1e-6]
        assert errors[2] < errors[0] / 10
        assert (errors <= table["estimated_error"][rows] + 1e-8).all()
        assert (table["time"][rows] > 0).all()
    rows = table["dial"] == "accuracy"
    assert (table["error_sliding_speed"][rows] <= table["setting"][rows]).all()
    assert numpy.allclose(table["setting"][table["way"] == "euler"], [1, 0.1])


@pytest.mark.parametrize(("deck", "point"), [("thesis", (20, 95)), ("four_cylinder", (200, -30))])
def test_a_case_that_no_explicit_method_solves_has_two_implicit_references(camroller, tmp_path, deck, point):
    (tmp_path / "one.nml").write_text(f"include = '{ROOT}/decks/{deck}.nml', without = 'sweep'\n")
    point = [word for name, value in zip(("speed_rpm", "oil_temperature_degC"), point) for word in ("--set", f"operating_point.{name}={value}")]
    result = study(camroller, "one.nml", *QUICK, *point, folder=tmp_path)
    assert result.returncode == 0, result.stderr
    told = "reference by rodas5p and radau5, two implicit methods, since dormand_prince, which is explicit, has no result"
    assert told + ": 1 case\n" in result.stdout and max(map(len, result.stdout.splitlines())) <= 132
    table = read(tmp_path / "one_study.h5")
    reference = table["dial"] == "reference"
    assert list(table["message"][reference]) == [told] and table["error_sliding_speed"][reference][0] < 1e-9
    explicit = table["way"] == "dormand_prince"
    assert (table["status"][explicit] == 5).all()
    steps, allowed = re.search(r"the turn takes more than (\d+) steps, with (\d+) allowed", table["message"][explicit][0]).groups()
    assert int(steps) >= int(allowed)
    automatic = table["way"] == "automatic"
    assert (table["error_sliding_speed"][automatic] <= table["setting"][automatic]).all()


def test_a_case_without_a_reference_is_recorded_and_ends_with_its_error(camroller, tmp_path):
    text = (ROOT / "decks/hard/frictionless_contact.nml").read_text(encoding="utf-8").replace("'../", f"'{ROOT}/decks/")
    text += "&sweep key_1 = 'traction.limiting_coefficient', values_1 = 0.06, 1e-9 /\n&numerics max_cycles = 2 /\n"
    (tmp_path / "deck.nml").write_text(text)
    result = study(camroller, "deck.nml", *QUICK, folder=tmp_path)
    assert result.returncode == 5, result.stderr
    assert "did not become periodic" in result.stderr
    table = read(tmp_path / "deck_study.h5")
    assert list(table["status"][table["dial"] == "reference"]) == [0, 5]
    assert set(table["case"][table["dial"] != "reference"]) == {0}


def test_the_deck_is_not_overwritten_and_invalid_arguments_are_refused(camroller, tmp_path):
    (tmp_path / "deck_study.h5").write_text(THESIS)
    for arguments in (["deck_study.h5", "-o", "deck_study.h5"], ["deck.nml", "--repeats", "few"], ["deck.nml", "--series"]):
        result = study(camroller, *arguments, folder=tmp_path)
        assert result.returncode == 2, result.stderr
        assert result.stdout == ""
    assert (tmp_path / "deck_study.h5").read_text() == THESIS


def test_study_of_films_has_rows_for_accuracies_and_nodes(camroller, tmp_path):
    """More nodes and more accuracy give smaller errors; each model has its own reference."""
    text = (ROOT / "decks/numerical_film.nml").read_text()
    (tmp_path / "one.nml").write_text(text[:text.index("&sweep")].replace("oil_temperature_degC = 25", "oil_temperature_degC = 60"))
    result = study(camroller, "one.nml", "--film", *QUICK, folder=tmp_path)
    assert result.returncode == 0, result.stderr
    assert max(map(len, result.stdout.splitlines())) <= 132
    table = read(tmp_path / "one_film_study.h5")
    rows = table["dial"] != "reference"
    assert list(table["way"][~rows]) == ["numerical film", "solved over cycle"]
    assert list(table["way"][rows]) == ["dowson_higginson", *2 * ["numerical film"], *2 * ["solved over cycle"], "steady film"]
    errors = table["error_sliding_speed"][rows]
    assert errors[0] > errors[1] > errors[2]
    assert errors[5] > errors[3] > errors[4]
    assert (table["time"][rows] > 0).all()


@pytest.mark.once
def test_steady_films_and_those_solved_over_the_cycle_are_both_without_heat(camroller, tmp_path):
    """Heat in the inlet takes 2.5 % of the smallest film here, which is no error of the steady film."""
    text = (ROOT / "decks/heated_contact.nml").read_text()
    (tmp_path / "one.nml").write_text(re.sub("speed_rpm = .*", "speed_rpm = 600", text[:text.index("&sweep")]))
    warm = ["--set", "operating_point.oil_temperature_degC=40"]
    result = study(camroller, "one.nml", "--film", *QUICK, *warm, folder=tmp_path)
    assert result.returncode == 0, result.stderr
    table = read(tmp_path / "one_film_study.h5")
    assert table["error_smallest_film"][list(table["way"]).index("steady film")] < 0.01


def test_films_out_of_range_are_an_error(camroller, tmp_path):
    result = study(camroller, ROOT / "decks/hard/narrow_contact.nml", "--film", *QUICK, folder=tmp_path)
    assert result.returncode == 4
    assert "above 1.5 GPa" in result.stderr
    assert not list(tmp_path.glob("*.h5"))
