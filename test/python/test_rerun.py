"""Files computed again from what is stored in them."""

import shutil

import h5py
import pytest

from sweeps import ROOT, done, run, write_deck

FILE, DIFFERENCE = 6, 7


@pytest.fixture(scope="module")
def folder(camroller, tmp_path_factory):
    """A result of a sweep with values beside the deck, its deck gone."""
    path = tmp_path_factory.mktemp("rerun")
    deck = write_deck(path / "deck.nml", "key_1 = 'operating_point.speed_rpm' values_1 = 300, 400, 500, 600")
    done(camroller, "sweep", deck, "--set", "operating_point.oil_temperature_degC=71", "--set", "sweep.series=chosen",
         "--set", "sweep.series_cases=2", "--quiet", folder=path)
    deck.unlink()
    return path


def test_rerun_gives_the_same_bits(camroller, folder):
    for threads in (1, 3):
        result = done(camroller, "rerun", "deck.h5", "--threads", threads, folder=folder)
        assert result.stdout.startswith("deck.h5: 4 cases are the same to the last bit, in ")


def test_differences_are_reported(camroller, folder, tmp_path):
    shutil.copy(folder / "deck.h5", tmp_path / "changed.h5")
    with h5py.File(tmp_path / "changed.h5", "r+") as file:
        file["summary/mean_torque_drive"][3] *= 1 + 1e-15
        file["series/contact_load"][2, 7] += 1
        file["run"].attrs["commit"] = "another"
    result = run(camroller, "rerun", "changed.h5", folder=tmp_path)
    assert result.returncode == DIFFERENCE
    assert "changed.h5: 2 of 4 cases differ\n" in result.stderr
    assert "  summary/mean_torque_drive: in 1 case, at most by " in result.stderr
    assert "e-15 of its value, in case 3\n" in result.stderr or "e-16 of its value, in case 3\n" in result.stderr
    assert "  series/contact_load: in 1 case" in result.stderr
    assert "  commit: 'another' made the file, this is '" in result.stderr


@pytest.mark.parametrize("deck", ["tabulated_lift", "three_cam_head"])
def test_tables_are_in_the_file(camroller, tmp_path, deck):
    """Decks that name tables, computed again where there is neither deck nor table."""
    done(camroller, "run", ROOT / f"decks/{deck}.nml", "--set", "output.angle_step_deg=10", "--set", "numerics.accuracy=1e-3",
         "--quiet", folder=tmp_path)
    assert " the same to the last bit" in done(camroller, "rerun", f"{deck}.h5", folder=tmp_path).stdout


def test_a_table_of_cases_is_in_the_file(camroller, tmp_path):
    table = tmp_path / "cases.csv"
    table.write_text("operating_point.speed_rpm, film.law\n312.3456789012345678, 'moes'\n0.1e3, 'dowson_higginson'\n")
    deck = write_deck(tmp_path / "deck.nml", "kind = 'table' table = 'cases.csv'")
    done(camroller, "sweep", deck, "--quiet", folder=tmp_path)
    table.unlink()
    assert "2 cases are the same to the last bit" in done(camroller, "rerun", "deck.h5", folder=tmp_path).stdout


def test_profiles_are_compared(camroller, tmp_path):
    """Pressure, film and friction across the contact; files without series too."""
    done(camroller, "run", ROOT / "decks/numerical_film.nml", "-o", "run.h5", "--quiet", "--set", "ehl.profiles=.true.", "--set",
         "ehl.accuracy=0.1", "--set", "output.angle_step_deg=40", "--set", "sweep.values_1=300", "--set", "sweep.values_2=60,90",
         "--set", "output.series=.false.", folder=tmp_path)
    assert "2 cases are the same to the last bit" in done(camroller, "rerun", "run.h5", folder=tmp_path).stdout
    with h5py.File(tmp_path / "run.h5", "r+") as file:
        file["ehl/pressure"][1, 3, 60] *= 1 + 1e-15
        file["ehl/x"][1, 60] += 1
    result = run(camroller, "rerun", "run.h5", folder=tmp_path)
    assert result.returncode == DIFFERENCE
    assert "run.h5: 1 of 2 cases differs\n" in result.stderr
    assert "  ehl/pressure: in 1 case, at most by " in result.stderr
    assert "  ehl/x: in 1 case, at most by " in result.stderr
    with h5py.File(tmp_path / "run.h5", "r+") as file:
        del file["ehl"]
    assert "  ehl: in 2 cases, a number in only one of the files, in case " in run(camroller, "rerun", "run.h5", folder=tmp_path).stderr


def test_a_choice_of_effects_is_compared(camroller, tmp_path):
    """Which effects took part, and their estimates, stand in a group of their own."""
    deck = write_deck(tmp_path / "deck.nml", "key_1 = 'operating_point.speed_rpm' values_1 = 300, 900")
    done(camroller, "run", deck, "--set", "effects.select=needed", "--quiet", folder=tmp_path)
    assert "2 cases are the same to the last bit" in done(camroller, "rerun", "deck.h5", folder=tmp_path).stdout
    with h5py.File(tmp_path / "deck.h5", "r+") as file:
        file["effects/bound"][1] += 1
    result = run(camroller, "rerun", "deck.h5", folder=tmp_path)
    assert result.returncode == DIFFERENCE
    assert "  effects/bound: in 1 case, at most by " in result.stderr


def test_files_that_are_no_results_are_refused(camroller, tmp_path):
    with h5py.File(tmp_path / "other.h5", "w") as file:
        file["x"] = 1
    assert run(camroller, "rerun", "other.h5", folder=tmp_path).returncode == FILE
    assert run(camroller, "rerun", "none.h5", folder=tmp_path).returncode == FILE
