"""The command `study` from outside: tables, file, failures."""

import pathlib
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


@pytest.fixture(scope="module")
def done(camroller, tmp_path_factory):
    """A quick study of one case."""
    folder = tmp_path_factory.mktemp("study")
    (folder / "one.nml").write_text(THESIS[:THESIS.index("&sweep")].replace("speed_rpm = 300", "speed_rpm = 600"))
    result = study(camroller, "one.nml", *QUICK, folder=folder)
    assert result.returncode == 0, result.stderr
    return folder / "one_study.h5", result.stdout


def words(dataset):
    """Texts of a column."""
    return [text.decode() for text in dataset]


def test_tables_are_printed(done):
    assert done[1].startswith("References")
    for name in ("rodas5p", "radau5", "dormand_prince", "euler", "no asperities", "one_study.h5: 1 case in "):
        assert name in done[1]
    assert max(map(len, done[1].splitlines())) <= 132


def test_every_row_of_the_file_has_its_columns(done):
    with h5py.File(done[0]) as file:
        assert file.attrs["complete"] == 1
        assert file["deck/text"][()].decode().startswith("! Reference case")
        for table in ("references", "methods", "models"):
            group = file["study"][table]
            assert len({column.shape for column in group.values()}) == 1
            for name, column in group.items():
                assert "long_name" in column.attrs
                assert name == "row" or column.dims[0][0].name == f"/study/{table}/row"


def test_smaller_tolerances_give_smaller_errors_and_estimates_hold(done):
    with h5py.File(done[0]) as file:
        table = file["study/methods"]
        methods = numpy.array(words(table["method"]))
        for method in ("rodas5p", "radau5"):
            rows = methods == method
            errors = table["error_sliding_speed"][rows]
            assert list(table["tolerance"][rows]) == [1e-2, 1e-4, 1e-6]
            assert errors[2] < errors[0] / 10
            assert (errors <= table["estimated_error"][rows] + 1e-8).all()
            assert (table["time"][rows] > 0).all()
        steps = table["step"][methods == "euler"]
        assert numpy.allclose(steps, [1, 0.1])
        assert numpy.isnan(table["tolerance"][methods == "euler"]).all()


def test_a_case_without_a_reference_is_recorded_and_ends_with_its_error(camroller, tmp_path):
    text = (ROOT / "decks/hard/frictionless_contact.nml").read_text(encoding="utf-8")
    text += "&sweep key_1 = 'traction.limiting_coefficient', values_1 = 0.06, 1e-9 /\n&numerics max_cycles = 2 /\n"
    (tmp_path / "deck.nml").write_text(text)
    result = study(camroller, "deck.nml", *QUICK, folder=tmp_path)
    assert result.returncode == 5, result.stderr
    assert "did not become periodic" in result.stderr
    assert result.stdout == "" or "References" in result.stdout


def test_the_deck_is_not_replaced_and_wrong_words_are_refused(camroller, tmp_path):
    (tmp_path / "deck_study.h5").write_text(THESIS)
    for arguments in (["deck_study.h5", "-o", "deck_study.h5"], ["deck.nml", "--repeats", "few"], ["deck.nml", "--series"]):
        result = study(camroller, *arguments, folder=tmp_path)
        assert result.returncode == 2, result.stderr
        assert result.stdout == ""
    assert (tmp_path / "deck_study.h5").read_text() == THESIS


def test_films_over_nodes_tables_and_steps(camroller, tmp_path):
    """More nodes and more accuracy give smaller errors; solved cycles and runs stand in one table."""
    text = (ROOT / "decks/numerical_film.nml").read_text()
    (tmp_path / "one.nml").write_text(text[:text.index("&sweep")].replace("oil_temperature_degC = 25", "oil_temperature_degC = 60"))
    result = study(camroller, "one.nml", "--film", *QUICK, folder=tmp_path)
    assert result.returncode == 0, result.stderr
    assert result.stdout.startswith("Steady films")
    assert max(map(len, result.stdout.splitlines())) <= 132
    with h5py.File(tmp_path / "one_film_study.h5") as file:
        contacts, tables, cycles = (file["study"][name] for name in ("contacts", "film_table", "film_cycle"))
        for name in set(words(contacts["contact"])):
            rows = numpy.array(words(contacts["contact"])) == name
            assert list(contacts["nodes"][rows]) == [33, 65, 129, 257, 513]
            errors = contacts["error_film_min"][rows]
            # second order, with a factor that depends on where between two nodes the film ends and is smallest: nine of ten
            # contacts all over the range of solutions are below 7.9 to 10.4 on these grids; twice that
            assert (errors * contacts["nodes"][rows] ** 2 < 20).all()
        assert words(tables["film"]) == ["dowson_higginson", "numerical", "numerical"]
        errors = tables["error_film_min"][:]
        assert errors[0] > errors[1] > errors[2]
        assert words(cycles["model"]) == 4 * ["solved"] + ["dowson_higginson", "numerical law"]
        errors = cycles["error_mean_film"][:]
        assert errors[2] < errors[0] / 2 and errors[3] < errors[1] / 2
        assert (cycles["time"][:] > 0).all()


def test_films_out_of_range_are_an_error(camroller, tmp_path):
    text = (ROOT / "decks/hard/narrow_contact.nml").read_text()
    (tmp_path / "deck.nml").write_text(text)
    result = study(camroller, "deck.nml", "--film", *QUICK, folder=tmp_path)
    assert result.returncode == 5
    assert "above 1.5 GPa" in result.stderr
    assert not list(tmp_path.glob("*.h5"))
