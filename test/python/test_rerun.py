"""Files computed again from what is stored in them."""

import re
import shutil

import h5py
import pytest

from conftest import ROOT, done, run
from sweeps import write_deck

USAGE, DOMAIN, FILE, DIFFERENCE = 2, 4, 6, 7


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
    told = re.search(r"mean_torque_drive: in 1 case, at most by (\S+) of its value \((\S+) in the file, (\S+) now\), in case 3\n", result.stderr)
    assert 1e-16 < float(told[1]) < 1.3e-15
    with h5py.File(folder / "deck.h5") as file, h5py.File(tmp_path / "changed.h5") as changed:
        name = "summary/mean_torque_drive"
        assert (float(told[2]), float(told[3])) == (changed[name][3], file[name][3]), "the numbers as they are, every digit"
    first, second = (result.stderr.index(f"  {name}: in 1 case") for name in ("series/contact_load", "summary/mean_torque_drive"))
    assert first < second, "the largest difference is told first"
    assert "  commit: 'another' made the file, this is '" in result.stderr


def test_a_number_of_a_series_is_compared_with_the_largest(camroller, folder, tmp_path):
    """Rounding of a number near zero is nothing beside the series: a change there of itself comes behind a smaller one of a mean."""
    shutil.copy(folder / "deck.h5", tmp_path / "changed.h5")
    with h5py.File(tmp_path / "changed.h5", "r+") as file:
        file["summary/mean_torque_drive"][2] *= 1 + 1e-9
        series = file["series/torque_drive"][2]
        series[8] *= 1 + 1e-13
        largest = abs(series).max()
        series[7] += 1e-12*largest
        file["series/torque_drive"][2] = series
    told = run(camroller, "rerun", "changed.h5", folder=tmp_path).stderr
    names = re.findall(r"\n  (\S+): in 1 case, at most by (\S+) of its (value|largest value) ", told)
    assert [(name, size) for name, _, size in names] == [("summary/mean_torque_drive", "value"), ("series/torque_drive", "largest value")]
    assert abs(float(names[1][1])/1e-12 - 1) < 0.05, "that of row 7, in two digits"


def test_a_default_that_made_the_file_and_is_another_now_is_named(camroller, folder, tmp_path):
    """A file of a version whose defaults were others: its values say so, and its numbers are another law's. Without it, not a word."""
    shutil.copy(folder / "deck.h5", tmp_path / "old.h5")
    with h5py.File(tmp_path / "old.h5", "r+") as file:
        file["summary/mean_torque_drive"][0] *= 2
        names = {name for name, item in file["deck/values"].items() if item.attrs["given"] == "default"}
    assert "which the deck does not give" not in run(camroller, "rerun", "old.h5", folder=tmp_path).stderr
    assert {"spring.seat_stiffness_N_m", "film.range_policy"} <= names
    with h5py.File(tmp_path / "old.h5", "r+") as file:
        file["deck/values/spring.seat_stiffness_N_m"][()] = 2e7
        file["deck/values/film.range_policy"][()] = "stop"
    told = run(camroller, "rerun", "old.h5", folder=tmp_path).stderr
    assert ("\n  spring.seat_stiffness_N_m, which the deck does not give: the default was 2e7 when the file was made, and is 1e7 now\n"
            in told)
    assert ("\n  film.range_policy, which the deck does not give: the default was 'stop' when the file was made, and is 'warn' now\n"
            in told)
    assert told.index("film.range_policy") < told.index("summary/mean_torque_drive")


def test_the_same_build_is_claimed_only_where_its_sources_are_known(camroller, folder, tmp_path):
    shutil.copy(folder / "deck.h5", tmp_path / "changed.h5")
    with h5py.File(tmp_path / "changed.h5", "r+") as file:
        file["summary/mean_torque_drive"][3] *= 2
        commit = file["run"].attrs["commit"]
    result = run(camroller, "rerun", "changed.h5", folder=tmp_path)
    assert result.returncode == DIFFERENCE
    claimed = "\n  the same version, commit, compiler and options made the file\n"
    doubted = ("\n  the same version, compiler and options made the file; whether the same sources did is not known, since the commit of both "
               f"is '{commit}'\n")
    named = commit.rpartition("-")[2] not in ("unknown", "changed")
    assert (claimed in result.stderr, doubted in result.stderr) == (named, not named)


def rewrite(file, name, number, value):
    """Give one case another value."""
    values = file[name][()]
    values[number] = value
    file[name][...] = values


@pytest.mark.parametrize("change, words", [
    (lambda file: rewrite(file, "run/warnings", 2, "another"), "1 of 4 cases differs\n  run/warnings: in 1 case, another text, first in case 2\n"),
    (lambda file: file.__delitem__("run/warnings"), "4 of 4 cases differ\n  run/warnings: in 4 cases, another text, first in case 0\n"),
    (lambda file: file["summary/mean_torque_drive"].attrs.__setitem__("units", "N mm"),
     "4 of 4 cases differ\n  summary/mean_torque_drive (unit): in 4 cases, another text, first in case 0\n"),
    (lambda file: file["series/contact_load"].attrs.__setitem__("units", "kN"),
     "1 of 4 cases differs\n  series/contact_load (unit): in 1 case, another text, first in case 2\n"),
    (lambda file: file["summary"].create_dataset("more", data=[1.0] * 4),
     "4 of 4 cases differ\n  summary/more: in 4 cases, a number in only one of the files, in case 0\n"),
    (lambda file: file["series"].create_dataset("more", data=[[0.5] * 36] * 4),
     "1 of 4 cases differs\n  series/more: in 1 case, a number in only one of the files, in case 2\n"),
])
def test_words_units_and_what_is_only_in_the_file_are_compared(camroller, folder, tmp_path, change, words):
    shutil.copy(folder / "deck.h5", tmp_path / "x.h5")
    with h5py.File(tmp_path / "x.h5", "r+") as file:
        change(file)
    for threads in (1, 4):
        result = run(camroller, "rerun", "x.h5", "--threads", threads, folder=tmp_path)
        assert result.returncode == DIFFERENCE and "x.h5: " + words in result.stderr


@pytest.mark.parametrize("change, words", [
    (lambda file: rewrite(file, "sweep/operating_point.speed_rpm", 0, 301),
     "1 of 4 cases differs\n  sweep/operating_point.speed_rpm: in 1 case, at most by 0.0033 of its value (301 in the file, 300 now), in case 0\n"),
    (lambda file: rewrite(file, "case", slice(None), [3, 2, 1, 0]), "4 of 4 cases differ\n  case: in 4 cases, at most by 1 of its value (3 in the file, 0 now), in case 0\n"),
])
def test_cases_are_compared_with_those_of_the_deck(camroller, folder, tmp_path, change, words):
    shutil.copy(folder / "deck.h5", tmp_path / "x.h5")
    with h5py.File(tmp_path / "x.h5", "r+") as file:
        change(file)
    result = run(camroller, "rerun", "x.h5", folder=tmp_path)
    assert result.returncode == DIFFERENCE and "x.h5: " + words in result.stderr


def test_swept_words_are_compared_with_those_of_the_deck(camroller, tmp_path):
    deck = write_deck(tmp_path / "deck.nml", "key_1 = 'film.law' values_1 = 'moes', 'dowson_higginson'")
    done(camroller, "sweep", deck, "--quiet", folder=tmp_path)
    assert "2 cases are the same" in done(camroller, "rerun", "deck.h5", folder=tmp_path).stdout
    with h5py.File(tmp_path / "deck.h5", "r+") as file:
        rewrite(file, "sweep/film.law", 1, "moes")
    result = run(camroller, "rerun", "deck.h5", folder=tmp_path)
    assert result.returncode == DIFFERENCE
    assert "1 of 2 cases differs\n  sweep/film.law: in 1 case, another text, first in case 1\n" in result.stderr


def test_cases_without_a_result_are_compared(camroller, tmp_path):
    """Their messages, and that they have no numbers; some laws have scalars that others do not have."""
    deck = write_deck(tmp_path / "deck.nml", "key_1 = 'mechanism.pivot_to_cam_mm' values_1 = 60, 31.5 key_2 = 'cam_bearings.law' "
                      "values_2 = 'long_full_sommerfeld', 'finite'")
    assert run(camroller, "sweep", deck, "--set", "sweep.series=all", "--quiet", folder=tmp_path).returncode == DOMAIN
    assert "4 cases are the same to the last bit" in done(camroller, "rerun", "deck.h5", folder=tmp_path).stdout
    for name, value, words in (("summary/mean_torque_drive", 1, "a number in only one of the files, in case 1\n"),
                               ("series/contact_load", 1, "a number in only one of the files, in case 1\n"),
                               ("run/messages", "another", "another text, first in case 1\n")):
        shutil.copy(tmp_path / "deck.h5", tmp_path / "x.h5")
        with h5py.File(tmp_path / "x.h5", "r+") as file:
            rewrite(file, name, 1, value)
        result = run(camroller, "rerun", "x.h5", folder=tmp_path)
        assert result.returncode == DIFFERENCE and f"x.h5: 1 of 4 cases differs\n  {name}: in 1 case, {words}" in result.stderr


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


def write_swept_tables(folder):
    """A deck whose cases name tables, one of them with an apostrophe, and one that is not there."""
    text = (ROOT / "decks/tabulated_lift.nml").read_text().partition("&sweep")[0]
    (folder / "tables").mkdir()
    table = (ROOT / "decks/tables/polynomial_lift.txt").read_text()
    (folder / "tables/polynomial_lift.txt").write_text(table)
    (folder / "tables/it's.txt").write_text("cam_angle [deg], valve_lift [mm]\n" + table)
    (folder / "deck.nml").write_text(text + """&output angle_step_deg = 20 /
&numerics accuracy = 1e-3 /
&sweep key_1 = 'lift.table' values_1 = 'tables/polynomial_lift.txt', 'tables/it''s.txt', 'tables/none.txt'
   key_2 = 'operating_point.speed_rpm' values_2 = 300, 600 /
""")
    return folder / "deck.nml"


def test_tables_of_cases_are_in_the_file(camroller, tmp_path):
    """What is in the folder does not matter: neither the tables, which have changed, nor one that was not there."""
    assert run(camroller, "sweep", write_swept_tables(tmp_path), "-o", "x.h5", "--quiet", folder=tmp_path).returncode == 3
    for name in ("it's.txt", "none.txt"):
        (tmp_path / "tables" / name).write_text("0 0\n")
    assert "6 cases are the same to the last bit" in done(camroller, "rerun", "x.h5", folder=tmp_path).stdout
    shutil.rmtree(tmp_path / "tables")
    assert "6 cases are the same to the last bit" in done(camroller, "rerun", "x.h5", folder=tmp_path).stdout
    with h5py.File(tmp_path / "x.h5") as file:
        assert [name.decode() for name in file["sweep/lift.table"][::2]] == ["tables/polynomial_lift.txt", "tables/it's.txt",
                                                                           "tables/none.txt"]
        assert file["deck"].attrs["tables_lift"] == 2 and "table_lift_2" not in file["deck"]


def test_a_file_without_the_tables_of_its_cases_is_refused(camroller, tmp_path):
    run(camroller, "sweep", write_swept_tables(tmp_path), "-o", "x.h5", "--quiet", folder=tmp_path)
    with h5py.File(tmp_path / "x.h5", "r+") as file:
        del file["deck"].attrs["tables_lift"]
    result = run(camroller, "rerun", "x.h5", folder=tmp_path)
    assert result.returncode == FILE
    assert "'x.h5' does not hold 'tables/it's.txt', a table that cases name in 'lift.table', and cannot be computed again" in result.stderr


def test_cases_without_a_result_now_are_told_with_their_message(camroller, folder, tmp_path):
    shutil.copy(folder / "deck.h5", tmp_path / "changed.h5")
    with h5py.File(tmp_path / "changed.h5", "r+") as file:
        text = file["deck/text"][()].decode()
        assert "pivot_to_cam_mm" in text
        del file["deck/text"]
        file["deck/text"] = re.sub(r"pivot_to_cam_mm *= *[0-9.]+", "pivot_to_cam_mm = 60", text)
    result = run(camroller, "rerun", "changed.h5", "--threads", 1, folder=tmp_path)
    assert result.returncode == DIFFERENCE
    assert re.search(r"  summary/status: in 4 cases, at most by 1 of its value \(0 in the file, [1-9] now\), in case 0\n", result.stderr)
    assert "  4 cases have no result now, first case 0: case 0 (operating_point.speed_rpm=300): " in result.stderr
    for _ in range(5):
        assert run(camroller, "rerun", "changed.h5", "--threads", 4, folder=tmp_path).stderr == result.stderr, "in any order"


def test_a_file_with_an_apostrophe_in_its_name(camroller, tmp_path):
    (tmp_path / "cases.csv").write_text("operating_point.speed_rpm\n300\n400\n")
    done(camroller, "sweep", write_deck(tmp_path / "deck.nml", "kind = 'table' table = 'cases.csv'"), "-o", "it's.h5", "--quiet",
         "--set", "case.title=it's", folder=tmp_path)
    assert "2 cases are the same to the last bit" in done(camroller, "rerun", "it's.h5", folder=tmp_path).stdout
    with h5py.File(tmp_path / "it's.h5") as file:
        assert file["deck/values/case.title"][()].decode() == "it's"


@pytest.mark.parametrize("command, options, words", [
    ("study", ["--quick", "--repeats", 1, "--set", "output.angle_step_deg=20"], "with a table in /study and no cases that could be exported or computed again; 'python post/plot_study.py'"),
    ("audit", ["--repeats", 1], "with a table in /study and no cases that could be exported or computed again; 'python post/plot_audit.py'"),
    ("ehl", ["--set", "output.angle_step_deg=40"], "with solved contacts in /ehl and no series and scalars that could be exported"),
])
@pytest.mark.once
def test_files_of_other_commands_are_told_apart(camroller, tmp_path, command, options, words):
    deck = write_deck(tmp_path / "deck.nml", "key_1 = 'operating_point.speed_rpm' values_1 = 900")
    done(camroller, command, deck, "-o", "x.h5", "--quiet", *options, folder=tmp_path)
    for arguments in (["export", "x.h5"], ["export", "x.h5", "--summary"], *([] if command == "ehl" else [["rerun", "x.h5"]])):
        result = run(camroller, *arguments, folder=tmp_path)
        assert result.returncode == USAGE and result.stdout == ""
        assert f"'x.h5' is a file of 'camroller {command}', {words}" in result.stderr
    if command == "ehl":
        assert "1 case is the same to the last bit" in done(camroller, "rerun", "x.h5", folder=tmp_path).stdout


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
