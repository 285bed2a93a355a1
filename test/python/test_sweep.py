"""Sweeps: kinds of samples, the same file from threads and shards, stops and continuations, what is refused."""

import json
import os
import re
import signal
import subprocess
import time

import h5py
import numpy
import pytest

from conftest import ROOT, done, run
from sweeps import GRID, same, write_deck

USAGE, DECK, DOMAIN, CONVERGENCE, FILE, UNFINISHED = 2, 3, 4, 5, 6, 8


@pytest.fixture(scope="module")
def deck(tmp_path_factory):
    """A deck of 24 cases."""
    return write_deck(tmp_path_factory.mktemp("sweep") / "deck.nml")


@pytest.fixture(scope="module")
def reference(camroller, deck):
    """Its result in one thread."""
    done(camroller, "sweep", deck, "--threads", 1, "--quiet", folder=deck.parent)
    return deck.with_suffix(".h5")


def parts(folder):
    """Part files in a folder."""
    return sorted(path.name for path in folder.glob("*.part-*"))


def left(result):
    """Cases to do, as a sweep that was stopped tells."""
    return int(re.search(r"with (\d+) of \d+ cases to do", result.stderr)[1])


def test_file_equals_that_of_run(camroller, deck, reference, tmp_path):
    done(camroller, "run", deck, "--set", "output.series=.false.", "--quiet", folder=tmp_path)
    with h5py.File(reference) as sweep, h5py.File(tmp_path / "deck.h5") as single:
        assert list(sweep["summary"]) == list(single["summary"])
        for name in single["summary"]:
            assert sweep["summary"][name][()].tobytes() == single["summary"][name][()].tobytes(), name
        assert list(sweep["run/warnings"]) == list(single["run/warnings"])
        assert len(sweep["series"]) == 0


def test_the_worst_remark_of_each_kind_is_in_the_file_as_told(camroller, tmp_path):
    deck, values = ROOT / "decks/thesis.nml", ("--set", "sweep.values_1=1000,6000,3000", "--set", "sweep.values_2=95", "--set", "output.series=.false.")
    told = done(camroller, "run", deck, *values, "-o", "run.h5", folder=tmp_path).stderr
    for shard in ("2/2", "1/2"):
        done(camroller, "sweep", deck, *values, "-o", "merged.h5", "--shard", shard, "--quiet", folder=tmp_path)
    done(camroller, "merge", deck, *values, "-o", "merged.h5", folder=tmp_path)
    rows = [(text, int(case), int(cases)) for cases, case, text in
            re.findall(r"remark on (\d+) of 3 cases, the worst is case (\d+) \([^)]*\): (.*)\n", told)]
    assert any(text.startswith("contact is lost") and case == 1 and cases == 2 for text, case, cases in rows)
    for name in ("run", "merged"):
        with h5py.File(tmp_path / f"{name}.h5") as file:
            group = file["run/remarks"]
            assert list(zip(group["worst"].asstr(), group["worst_case"], group["cases"])) == rows, name
            assert all(text in file["run/warnings"].asstr()[case].splitlines() for text, case, _ in rows)


def test_remarks_on_the_deck_are_in_the_file_however_it_is_made(camroller, tmp_path):
    deck = write_deck(tmp_path / "deck.nml", "key_1 = 'operating_point.speed_rpm' values_1 = 400, 900")
    values = "--set", "roller.mass_kg=0.9"
    done(camroller, "run", deck, *values, "--quiet", "-o", "run.h5", folder=tmp_path)
    told = done(camroller, "sweep", deck, *values, "-o", "sweep.h5", folder=tmp_path).stderr
    for shard in ("1/2", "2/2"):
        done(camroller, "sweep", deck, *values, "-o", "merged.h5", "--shard", shard, "--quiet", folder=tmp_path)
    done(camroller, "merge", deck, *values, "-o", "merged.h5", folder=tmp_path)
    done(camroller, "sweep", deck, "-o", "usual.h5", folder=tmp_path)
    remark = "roller.mass_kg = 0.9 is unusual: engines have 0.001 to 0.3 kg"
    assert f"remark: {remark}\n" in told and told.endswith("all remarks are in /deck/remarks and /run/warnings of the result file\n")
    for name in ("run", "sweep", "merged"):
        with h5py.File(tmp_path / f"{name}.h5") as file:
            assert list(file["deck/remarks"].asstr()) == [remark]
        assert "the same to the last bit" in done(camroller, "rerun", tmp_path / f"{name}.h5", folder=tmp_path).stdout
    with h5py.File(tmp_path / "usual.h5") as file:
        assert "remarks" not in file["deck"]


@pytest.mark.parametrize("sweep", ["key_1 = 'case.energy' values_1 = 'source', 'consistent' "
                                   "key_2 = 'operating_point.speed_rpm' values_2 = 300, 900",
                                   "key_1 = 'mechanism.pivot_to_cam_mm' values_1 = 60, 31, 31.5"], ids=["quantities", "failure"])
@pytest.mark.parametrize("select", ["listed", "needed"])
def test_run_equals_a_sweep_that_keeps_all_series(camroller, tmp_path, sweep, select):
    """Cases with other quantities than those before, a first case that fails, effects that are left out, and why."""
    deck = write_deck(tmp_path / "deck.nml", f"series = 'all' {sweep}")
    arguments = deck, "--set", f"effects.select={select}", "--quiet"
    codes = [run(camroller, command, *arguments, "-o", f"{command}.h5", folder=tmp_path).returncode for command in ("run", "sweep")]
    assert codes == [DOMAIN if "mechanism" in sweep else 0] * 2
    assert same(tmp_path / "run.h5", tmp_path / "sweep.h5")
    with h5py.File(tmp_path / "run.h5") as file:
        assert ("effects/reasons" in file) == (select == "needed")


@pytest.mark.parametrize("threads", [2, 5])
def test_threads_change_no_bit(camroller, deck, reference, tmp_path, threads):
    result = done(camroller, "sweep", deck, "--threads", threads, folder=tmp_path)
    assert result.stdout.startswith("deck.h5: 24 cases in ")
    assert parts(tmp_path) == []
    assert same(reference, tmp_path / "deck.h5")


def test_many_threads_on_short_and_failing_cases(camroller, tmp_path):
    """Nothing that threads do at the same time may get into a result or a message."""
    deck = write_deck(tmp_path / "deck.nml", "key_1 = 'mechanism.pivot_to_cam_mm' from_1 = 30 to_1 = 60 count_1 = 60 "
                                             "key_2 = 'film.law' values_2 = 'moes', 'dowson_higginson', 'pan_hamrock'")
    for name, threads in (("one.h5", 1), ("many.h5", 8)):
        result = run(camroller, "sweep", deck, "-o", name, "--threads", threads, "--quiet", folder=tmp_path)
        assert result.returncode in (DOMAIN, CONVERGENCE)
    assert same(tmp_path / "one.h5", tmp_path / "many.h5")


def test_as_many_threads_as_are_allowed(camroller, deck, reference, tmp_path):
    """More of them than there are cases; the largest number does not ask too much of the system."""
    done(camroller, "sweep", deck, "--threads", 1024, folder=tmp_path)
    assert same(reference, tmp_path / "deck.h5")


def test_messages_use_the_singular_for_one(camroller, tmp_path):
    deck = write_deck(tmp_path / "deck.nml", "key_1 = 'operating_point.speed_rpm' values_1 = 300")
    assert done(camroller, "sweep", deck, folder=tmp_path).stdout.startswith("deck.h5: 1 case in ")
    assert done(camroller, "rerun", "deck.h5", folder=tmp_path).stdout.startswith("deck.h5: 1 case is the same to the last bit, in ")
    assert done(camroller, "run", deck, folder=tmp_path).stdout.splitlines()[-1].startswith("deck.h5: 1 case in ")
    assert " is valid: 1 case over 1 of operating_point.speed_rpm" in done(camroller, "check", deck, folder=tmp_path).stdout
    failing = run(camroller, "sweep", deck, "-o", "x.h5", "--set", "mechanism.pivot_to_cam_mm=60", folder=tmp_path)
    assert "camroller: 1 of 1 case has no result: case 0 (operating_point.speed_rpm=300): " in failing.stderr


def test_a_table_of_cases_with_too_many_columns_is_refused(camroller, tmp_path):
    """The keys behind the last one that is read would not vary, without a word."""
    keys = ["operating_point.speed_rpm"] * 65
    (tmp_path / "wide.csv").write_text(",".join(keys) + "\n" + ",".join(["300"] * 65) + "\n")
    result = run(camroller, "sweep", write_deck(tmp_path / "deck.nml", "kind = 'table' table = 'wide.csv'"), folder=tmp_path)
    assert result.returncode == DECK
    assert "wide.csv:1: a table of cases has at most 64 columns" in result.stderr


def test_check_prints_time_memory_and_disk_space(camroller, deck):
    lines = done(camroller, "check", deck, folder=deck.parent).stdout.splitlines()
    assert lines[0].endswith("is valid: 24 cases over 6 of operating_point.speed_rpm and 4 of "
                             "operating_point.oil_temperature_degC")
    assert lines[1].startswith("! tried 9 of the cases: ") and " ms each, " in lines[1]
    assert "memory about " in lines[2] and " MB in parts while it runs" in lines[2]


@pytest.mark.once
def test_check_counts_the_memory_of_turns_at_the_tolerance_of_the_case(camroller, tmp_path):
    """Cases are tried with a larger tolerance, whose turns have fewer points; a quarter of the memory was told."""
    words = ["check", "decks/lash_adjuster.nml"]
    told, tried = (float(re.search(r"memory about (\d+) MB", done(camroller, *words, *more).stdout)[1])
                   for more in ([], ["--set", "numerics.tolerance=1e-6"]))
    assert 0.5 * tried < told < 2 * tried


@pytest.mark.once
def test_check_counts_the_memory_that_cases_take(camroller, tmp_path):
    """Numbers of 2e9 cases, and words of 16 letters in quotes."""
    deck = write_deck(tmp_path / "deck.nml", "kind = 'sobol' cases = 100 key_1 = 'operating_point.speed_rpm' from_1 = 300 to_1 = 900")
    words = write_deck(tmp_path / "words.nml", "kind = 'sobol' cases = 100 key_1 = 'film.law' values_1 = 'moes', 'dowson_higginson'")
    assert "memory about 48 GB; " in done(camroller, "check", deck, "--set", "sweep.cases=2000000000", folder=tmp_path).stdout
    assert "memory about 88 GB; " in done(camroller, "check", words, "--set", "sweep.cases=2000000000", folder=tmp_path).stdout


def test_check_of_a_million_cases_checks_some_of_them(camroller, deck):
    result = done(camroller, "check", deck, "--set", "sweep.count_1=250000", folder=deck.parent)
    assert "1000000 cases over 250000 of operating_point.speed_rpm" in result.stdout
    assert ", of which 10000 were checked" in result.stdout


@pytest.mark.parametrize("command", ["run", "sweep", "check"])
def test_set_of_a_swept_key_gives_a_message(camroller, deck, tmp_path, command):
    result = done(camroller, command, deck, "--set", "operating_point.speed_rpm=350", "--set", "roller.mass_kg=0.009", folder=tmp_path)
    assert [line for line in result.stderr.splitlines() if "is not used" in line] == [
        "remark: 'operating_point.speed_rpm=350' is not used by the sweep, which varies operating_point.speed_rpm"]


def test_shards_change_no_bit(camroller, deck, reference, tmp_path):
    runs = [subprocess.Popen([camroller, "sweep", deck, "--shard", f"{i}/3", "--quiet"], cwd=tmp_path) for i in (3, 1, 2)]
    assert [process.wait() for process in runs] == [0, 0, 0]
    assert len(parts(tmp_path)) == 3
    done(camroller, "merge", deck, "--quiet", folder=tmp_path)
    assert parts(tmp_path) == []
    assert same(reference, tmp_path / "deck.h5")


def test_profiles_of_the_cases_whose_series_are_kept(camroller, tmp_path):
    """The same from one thread, from shards, after a stop, and as `run` writes them; the other cases have none."""
    study = [ROOT / "decks/numerical_film.nml", "--quiet", "--set", "ehl.profiles=.true.", "--set", "ehl.accuracy=0.1", "--set",
             "output.angle_step_deg=40", "--set", "sweep.values_1=300,400", "--set", "sweep.values_2=60,90"]
    refused = run(camroller, "sweep", *study, folder=tmp_path)
    assert refused.returncode == DECK
    assert "'ehl.profiles' has no cases" in refused.stderr
    done(camroller, "run", *study, "-o", "run.h5", folder=tmp_path)
    study += ["--set", "sweep.series=chosen", "--set", "sweep.series_cases=0,2"]
    done(camroller, "sweep", *study, "-o", "one.h5", "--threads", 1, folder=tmp_path)
    for shard in ("2/2", "1/2"):
        done(camroller, "sweep", *study, "-o", "shards.h5", "--shard", shard, folder=tmp_path)
    done(camroller, "merge", *study, "-o", "shards.h5", folder=tmp_path)
    limit = ["--set", "sweep.wall_time_limit_s=1e-3"]
    assert run(camroller, "sweep", *study, *limit, "-o", "stopped.h5", "--threads", 1, folder=tmp_path).returncode == UNFINISHED
    done(camroller, "sweep", *study, "-o", "stopped.h5", "--resume", folder=tmp_path)
    assert same(tmp_path / "one.h5", tmp_path / "shards.h5")
    assert same(tmp_path / "one.h5", tmp_path / "stopped.h5")
    with h5py.File(tmp_path / "one.h5") as sweep, h5py.File(tmp_path / "run.h5") as single:
        assert sweep["ehl/pressure"].shape == (4, 9, 129)
        for name in set(single["ehl"]) - {"angle", "node"}:
            for case in (0, 2):
                assert sweep["ehl"][name][case].tobytes() == single["ehl"][name][case].tobytes(), name
            assert numpy.isnan(sweep["ehl"][name][1::2]).all(), name


def test_merge_partial_has_the_cases_computed_so_far(camroller, deck, reference, tmp_path):
    done(camroller, "sweep", deck, "--shard", "2/3", "--quiet", folder=tmp_path)
    result = run(camroller, "merge", deck, folder=tmp_path)
    assert result.returncode == UNFINISHED
    assert "16 of 24 cases are missing, the first is case 0 (operating_point.speed_rpm=400, " in result.stderr
    merge = done(camroller, "merge", deck, "--partial", folder=tmp_path)
    assert "remark on 8 of 8 cases, the worst is case " in merge.stderr and " of 24 cases" not in merge.stderr
    assert len(parts(tmp_path)) == 1
    with h5py.File(tmp_path / "deck.h5") as file, h5py.File(reference) as whole:
        assert list(file["summary/status"]) == [-1] * 8 + [0] * 8 + [-1] * 8
        torque = file["summary/mean_torque_drive"][()]
        assert numpy.isnan(torque[:8]).all()
        assert torque[8:16].tobytes() == whole["summary/mean_torque_drive"][8:16].tobytes()
    other = run(camroller, "export", "deck.h5", "--case", 3, folder=tmp_path)
    assert other.returncode == USAGE and "case 3 has no series, it was not computed: the file is partial" in other.stderr


def test_time_limit_and_resume(camroller, deck, reference, tmp_path):
    result = run(camroller, "sweep", deck, "--set", "sweep.wall_time_limit_s=1e-3", folder=tmp_path)
    assert result.returncode == UNFINISHED
    assert "reached its time limit with " in result.stderr
    assert "of 24 cases to do; continue with --resume" in result.stderr
    assert not (tmp_path / "deck.h5").exists()
    further = run(camroller, "sweep", deck, "--resume", "--set", "sweep.wall_time_limit_s=1e-3", folder=tmp_path)
    assert 0 < left(further) < left(result) < 24
    again = run(camroller, "sweep", deck, folder=tmp_path)
    assert again.returncode == FILE
    assert "continue it with --resume, or remove" in again.stderr
    done(camroller, "sweep", deck, "--resume", folder=tmp_path)
    assert same(reference, tmp_path / "deck.h5")
    finished = done(camroller, "sweep", deck, "--resume", folder=tmp_path)
    assert finished.stdout == "deck.h5 is there with all cases\n"


def test_cases_with_other_quantities_after_a_stop(camroller, tmp_path):
    """What a case has in its summary is numbered anew in each run, and must not be mixed up."""
    deck = write_deck(tmp_path / "deck.nml", "key_1 = 'operating_point.speed_rpm' from_1 = 400 to_1 = 900 count_1 = 6 "
                                             "key_2 = 'case.energy' values_2 = 'source', 'consistent'")
    done(camroller, "sweep", deck, "-o", "reference.h5", "--quiet", folder=tmp_path)
    for _ in range(3):
        assert run(camroller, "sweep", deck, "--resume", "--threads", 1, "--set", "sweep.wall_time_limit_s=1e-3",
                   folder=tmp_path).returncode == UNFINISHED
    done(camroller, "sweep", deck, "--resume", folder=tmp_path)
    assert same(tmp_path / "reference.h5", tmp_path / "deck.h5")


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT, signal.SIGUSR1])
def test_signals_end_it_cleanly(camroller, deck, reference, tmp_path, number):
    process = subprocess.Popen([camroller, "sweep", deck, "--threads", "1"], cwd=tmp_path, stderr=subprocess.PIPE, text=True)
    while not parts(tmp_path):
        time.sleep(0.001)
    process.send_signal(number)
    words = process.communicate(timeout=60)[1]
    assert process.returncode == UNFINISHED, words
    assert "the sweep was stopped with " in words
    done(camroller, "sweep", deck, "--resume", folder=tmp_path)
    assert same(reference, tmp_path / "deck.h5")


@pytest.mark.parametrize("change, words", [
    ("operating_point.speed_rpm=350", "'operating_point.speed_rpm = 300' is now 'operating_point.speed_rpm = 350'"),
    ("sweep.count_1=7", "'sweep.count_1 = 6' is now 'sweep.count_1 = 7'"),
])
def test_a_deck_that_changed_is_refused(camroller, deck, tmp_path, change, words):
    assert run(camroller, "sweep", deck, "--set", "sweep.wall_time_limit_s=1e-3", folder=tmp_path).returncode == UNFINISHED
    result = run(camroller, "sweep", deck, "--resume", "--set", change, folder=tmp_path)
    assert result.returncode == FILE
    assert "the deck has changed since 'deck.h5.part-rank-0' was begun: " + words in result.stderr


def test_a_table_that_changed_is_refused(camroller, tmp_path):
    table = tmp_path / "cases.csv"
    table.write_text("operating_point.speed_rpm\n300\n400\n500\n")
    deck = write_deck(tmp_path / "deck.nml", "kind = 'table' table = 'cases.csv' wall_time_limit_s = 1e-3")
    assert run(camroller, "sweep", deck, folder=tmp_path).returncode == UNFINISHED
    table.write_text("operating_point.speed_rpm\n300\n400\n501\n")
    result = run(camroller, "sweep", deck, "--resume", folder=tmp_path)
    assert result.returncode == FILE
    assert "values of operating_point.speed_rpm 3 with checksum" in result.stderr


def test_a_case_that_fails_is_recorded(camroller, tmp_path):
    deck = write_deck(tmp_path / "deck.nml", "key_1 = 'mechanism.pivot_to_cam_mm' values_1 = 60, 31.5, 61, 31")
    result = run(camroller, "sweep", deck, folder=tmp_path)
    assert result.returncode == DOMAIN
    assert "2 of 4 cases have no result; the first is case 0 (mechanism.pivot_to_cam_mm=60): " in result.stderr
    with h5py.File(tmp_path / "deck.h5") as file:
        assert list(file["summary/status"]) == [DOMAIN, 0, DOMAIN, 0]
        assert b"no closed triangle" in file["run/messages"][2]
        assert list(numpy.isnan(file["summary/mean_torque_drive"])) == [True, False, True, False]


def test_all_cases_fail(camroller, tmp_path):
    deck = write_deck(tmp_path / "deck.nml", "key_1 = 'mechanism.pivot_to_cam_mm' values_1 = 60, 61")
    assert run(camroller, "sweep", deck, folder=tmp_path).returncode == DOMAIN
    with h5py.File(tmp_path / "deck.h5") as file:
        assert list(file["summary/status"]) == [DOMAIN, DOMAIN]


def test_series_of_chosen_cases(camroller, deck, tmp_path):
    done(camroller, "run", deck, "--quiet", folder=tmp_path)
    done(camroller, "sweep", deck, "-o", "some.h5", "--set", "sweep.series=chosen", "--set", "sweep.series_cases=3, 17",
         folder=tmp_path)
    done(camroller, "sweep", deck, "-o", "all.h5", "--set", "sweep.series=all", folder=tmp_path)
    with h5py.File(tmp_path / "deck.h5") as single, h5py.File(tmp_path / "some.h5") as some, h5py.File(tmp_path / "all.h5") as every:
        assert list(some["series"]) == list(single["series"]) == list(every["series"])
        for name in single["series"]:
            values = single["series"][name][()]
            assert every["series"][name][()].tobytes() == values.tobytes()
            if name == "cam_angle":
                continue
            assert some["series"][name][3].tobytes() == values[3].tobytes()
            assert some["series"][name][17].tobytes() == values[17].tobytes()
            assert numpy.isnan(some["series"][name][4]).all()
        assert some["series/contact_load"].chunks == (1, 36)
    kept = done(camroller, "export", "some.h5", "--case", 17, folder=tmp_path)
    assert kept.stdout == done(camroller, "export", "all.h5", "--case", 17, folder=tmp_path).stdout
    other = run(camroller, "export", "some.h5", "--case", 4, folder=tmp_path)
    assert other.returncode == USAGE and other.stdout == ""
    assert "the series of case 4 were not kept: a sweep keeps those that 'sweep.series' and 'sweep.series_cases' say" in other.stderr


def test_a_thousand_cases_can_be_chosen(camroller, tmp_path):
    """The file has the list as a whole, and a list that differs at its end is another study."""
    deck = write_deck(tmp_path / "deck.nml", "key_1 = 'operating_point.speed_rpm' from_1 = 300 to_1 = 900 count_1 = 1001")
    chosen = ",".join(map(str, range(1000)))
    study = ["--set", "sweep.series=chosen", "--set", "sweep.wall_time_limit_s=1e-3", "--quiet"]
    assert run(camroller, "sweep", deck, *study, "--set", f"sweep.series_cases={chosen}", folder=tmp_path).returncode == UNFINISHED
    done(camroller, "merge", deck, "--partial", *study, "--set", f"sweep.series_cases={chosen}", folder=tmp_path)
    with h5py.File(tmp_path / "deck.h5") as file:
        assert file["deck/values/sweep.series_cases"][()].decode() == chosen
    other = run(camroller, "sweep", deck, *study, "--set", f"sweep.series_cases={chosen[:-1]}8", "--resume", folder=tmp_path)
    assert other.returncode == FILE and "'sweep.series_cases = 0, 1, 2, " in other.stderr


def test_a_choice_of_series_that_is_not_used_is_no_mistake(camroller, tmp_path):
    deck = write_deck(tmp_path / "deck.nml", "key_1 = 'operating_point.speed_rpm' values_1 = 300, 400 series_cases = 3, 7, 11")
    result = done(camroller, "check", deck, folder=tmp_path)
    assert "sweep.series_cases = 3, 7, 11 has no effect: it is used with series = 'chosen'; series is 'none'" in result.stderr


@pytest.mark.parametrize("series, has_some", [("all", True), ("none", False)])
def test_a_sweep_does_not_go_by_the_series_of_a_run(camroller, deck, tmp_path, series, has_some):
    words = f"remark: output.series has no effect in a sweep, which writes the series that sweep.series says: '{series}'\n"
    study = ["--set", f"sweep.series={series}", "--set", f"output.series={str(not has_some).lower()}"]
    result = done(camroller, "sweep", deck, *study, folder=tmp_path)
    assert words in result.stderr
    with h5py.File(tmp_path / "deck.h5") as file:
        assert ("cam_angle" in file["series"]) == has_some
    assert words not in done(camroller, "sweep", deck, *study[:2], folder=tmp_path).stderr


def test_texts_and_names_can_be_swept(camroller, tmp_path):
    deck = write_deck(tmp_path / "deck.nml", "key_1 = 'case.title' values_1 = 'a', 'b' key_2 = 'film.law' values_2 = 'moes', "
                                             "'dowson_higginson'")
    done(camroller, "sweep", deck, "--threads", 2, folder=tmp_path)
    with h5py.File(tmp_path / "deck.h5") as file:
        assert list(file["sweep/film.law"]) == [b"moes", b"dowson_higginson"] * 2
        assert file["summary/mean_torque_drive"][0] == file["summary/mean_torque_drive"][2]


def test_zip_pairs_lists_of_equal_length(camroller, tmp_path):
    deck = write_deck(tmp_path / "deck.nml", "kind = 'zip' key_1 = 'operating_point.speed_rpm' values_1 = 300, 500 "
                                             "key_2 = 'film.law' values_2 = 'moes', 'dowson_higginson'")
    done(camroller, "sweep", deck, folder=tmp_path)
    with h5py.File(tmp_path / "deck.h5") as file:
        assert list(file["sweep/operating_point.speed_rpm"]) == [300, 500]
        assert list(file["sweep/film.law"]) == [b"moes", b"dowson_higginson"]


def test_samples_are_those_of_the_seed(camroller, tmp_path):
    keys = ("key_1 = 'operating_point.speed_rpm' from_1 = 300 to_1 = 3000 scale_1 = 'logarithmic' "
            "key_2 = 'operating_point.oil_temperature_degC' from_2 = 40 to_2 = 120 key_3 = 'film.law' "
            "values_3 = 'moes', 'dowson_higginson'")
    found = {}
    for kind in ("latin_hypercube", "sobol", "random"):
        for seed in (1, 2):
            deck = write_deck(tmp_path / "deck.nml", f"kind = '{kind}' cases = 16 seed = {seed} {keys}")
            done(camroller, "sweep", deck, "--quiet", folder=tmp_path)
            with h5py.File(tmp_path / "deck.h5") as file:
                speed = file["sweep/operating_point.speed_rpm"][()]
                law = list(file["sweep/film.law"])
            found[kind, seed] = tuple(speed)
            assert speed.min() >= 300 and speed.max() <= 3000
            if kind != "random":  # one point in each sixteenth, so eight with either law
                place = numpy.log(speed / 300) / numpy.log(10)
                assert sorted((16 * place).astype(int)) == list(range(16))
                assert law.count(b"moes") == 8
    assert len(set(found.values())) == 6


def test_a_measured_column_keeps_its_name_beside_a_scalar_of_that_name(camroller, tmp_path):
    """A table with semicolons, as many programs write them, and a measured quantity that is computed as well."""
    (tmp_path / "cases.csv").write_text('operating_point.speed_rpm;"measured.mean_torque_friction [N mm]";film.law\n'
                                        "600;0.41;'moes'\n900;-;'dowson_higginson'\n")
    done(camroller, "sweep", write_deck(tmp_path / "deck.nml", "kind = 'table' table = 'cases.csv'"), "--quiet", folder=tmp_path)
    lines = done(camroller, "export", "deck.h5", "--summary", folder=tmp_path).stdout.splitlines()
    names, units, first = (line.split(",") for line in lines[:3])
    assert names.count("measured.mean_torque_friction") == names.count("mean_torque_friction") == 1
    place = names.index("measured.mean_torque_friction")
    assert units[place] == "N mm" and float(first[place]) == 0.41
    lines = done(camroller, "export", "deck.h5", "--summary", "--columns", "mean_torque_friction", folder=tmp_path).stdout.splitlines()
    assert lines[0] == "case,operating_point.speed_rpm,film.law,mean_torque_friction" and lines[1].endswith(",N m")
    assert float(lines[2].split(",")[3]) != 0.41
    lines = done(camroller, "export", "deck.h5", "--summary", "--columns", "measured.mean_torque_friction",
                 folder=tmp_path).stdout.splitlines()
    assert lines[0] == "case,operating_point.speed_rpm,film.law,measured.mean_torque_friction" and float(lines[2].split(",")[3]) == 0.41


MEASURED = """operating_point.speed_rpm  "measured.torque [N m]"  measured.run
600   0.41  1
900   -     2
1200  0.35  3
"""


def test_measured_values_go_with_their_cases_into_result_and_export(camroller, tmp_path):
    (tmp_path / "cases.txt").write_text(MEASURED)
    done(camroller, "sweep", write_deck(tmp_path / "deck.nml", "kind = 'table' table = 'cases.txt'"), folder=tmp_path)
    done(camroller, "export", "deck.h5", "--summary", "--format", "json", "-o", "deck.json", folder=tmp_path)
    with h5py.File(tmp_path / "deck.h5") as file:
        torque = file["measured/torque"]
        assert torque.attrs["units"] in ("N m", b"N m") and file["measured/run"].attrs["units"] in ("1", b"1")
        assert numpy.array_equal(torque[()], [0.41, numpy.nan, 0.35], equal_nan=True)
        assert list(file["sweep/operating_point.speed_rpm"]) == [600, 900, 1200] and list(file["sweep"]) == ["operating_point.speed_rpm"]
    rows = json.loads((tmp_path / "deck.json").read_text())
    assert "0.41" in json.dumps(rows)
    # another table of measured values is another study: nothing of the first stays in its result
    (tmp_path / "cases.txt").write_text(MEASURED.replace("0.41", "0.42"))
    again = run(camroller, "sweep", "deck.nml", "--resume", folder=tmp_path)
    assert again.returncode != 0 and "is not a result of this sweep" in again.stderr


@pytest.mark.parametrize("heading, is_told", [("measured.drive_N_mm", True), ("measured.oil_degC", True), ("measured.run", False),
                                              ("measured.drive_N_mm [N mm]", False), ("measured.drive_N_mm [1]", False)])
def test_a_unit_in_the_name_of_a_measured_column_is_told_to_be_none(camroller, tmp_path, heading, is_told):
    (tmp_path / "cases.txt").write_text(f'operating_point.speed_rpm "{heading}"\n600 0.41\n')
    told = done(camroller, "check", write_deck(tmp_path / "deck.nml", "kind = 'table' table = 'cases.txt'"), folder=tmp_path).stderr
    words = f"remark: {heading} counts as without a unit, whatever its name ends with: a unit stands in brackets, as in 'measured.torque [N m]', " \
        "and [1] for none"
    assert (words in told.splitlines()) == is_told and ("counts as without" in told) == is_told


def test_long_names_and_units_of_measured_values_are_in_the_result(camroller, tmp_path):
    name = 64 * "x"
    (tmp_path / "cases.txt").write_text(MEASURED.replace("torque [N m]", name + " [kg m-1 s-2 K-1]"))
    deck = write_deck(tmp_path / "deck.nml", "kind = 'table' table = 'cases.txt'")
    done(camroller, "sweep", deck, folder=tmp_path)
    with h5py.File(tmp_path / "deck.h5") as file:
        assert file[f"measured/{name}"].attrs["units"] in ("kg m-1 s-2 K-1", b"kg m-1 s-2 K-1")
    assert "to the last bit" in done(camroller, "rerun", "deck.h5", folder=tmp_path).stdout


@pytest.mark.parametrize("old, new, words", [
    ("0.41", "x", "cases.txt:2: value 1 of measured.torque [N m] is no number; '-' stands where nothing was measured"),
    ("0.41", "nan", "cases.txt:2: value 1 of measured.torque [N m] is no number"),
    ("measured.run", "measured.torque", "'measured.torque' is there twice"),
    ("measured.run", "measured.", "the name behind 'measured.' consists of letters, digits and underscores"),
    ("operating_point.speed_rpm", "measured.speed_rpm", "the table names no key"),
    ("measured.torque", "measured." + 65 * "x", "xx [N m]': the name behind 'measured.' has 65 letters; the longest has 64"),
    ("[N m]", "[N m", "'measured.torque [N m': behind the name stands nothing but the unit in brackets, as in 'measured.torque [N m]'"),
    ("[N m]", "[N m] per cylinder", "behind the name stands nothing but the unit in brackets"),
    ("[N m]", "[" + 33 * "m" + "]", "the unit has 33 letters; the longest has 32"),
])
def test_mistakes_in_columns_of_measured_values_are_told(camroller, tmp_path, old, new, words):
    (tmp_path / "cases.txt").write_text(MEASURED.replace(old, new))
    result = run(camroller, "sweep", write_deck(tmp_path / "deck.nml", "kind = 'table' table = 'cases.txt'"), folder=tmp_path)
    assert result.returncode == DECK and words in result.stderr
    assert not (tmp_path / "deck.h5").exists()


def test_a_result_is_a_table_of_its_cases(camroller, deck, reference, tmp_path):
    again = write_deck(tmp_path / "again.nml", f"kind = 'table' table = '{reference}'")
    done(camroller, "sweep", again, folder=tmp_path)
    with h5py.File(reference) as first, h5py.File(tmp_path / "again.h5") as second:
        for name in first["summary"]:
            assert first["summary"][name][()].tobytes() == second["summary"][name][()].tobytes(), name


def test_a_result_as_a_table_keeps_what_was_measured(camroller, tmp_path):
    (tmp_path / "cases.txt").write_text(MEASURED)
    done(camroller, "sweep", write_deck(tmp_path / "deck.nml", "kind = 'table' table = 'cases.txt'"), folder=tmp_path)
    done(camroller, "sweep", write_deck(tmp_path / "again.nml", "kind = 'table' table = 'deck.h5'"), folder=tmp_path)
    with h5py.File(tmp_path / "deck.h5") as first, h5py.File(tmp_path / "again.h5") as second:
        assert sorted(first["measured"]) == sorted(second["measured"]) == ["run", "torque"]
        for name in first["measured"]:
            assert first["measured"][name][()].tobytes() == second["measured"][name][()].tobytes()
            assert first["measured"][name].attrs["units"] == second["measured"][name].attrs["units"]


def test_units_of_a_table_in_hdf5_are_those_of_its_keys_or_told(camroller, tmp_path):
    def sweep(speed, torque, name="measured.torque"):
        with h5py.File(tmp_path / "cases.h5", "w") as file:
            for key, unit in (("operating_point.speed_rpm", speed), (name, torque)):
                file[key] = [300.0, 900.0]
                file[key].attrs["units"] = unit
        deck = write_deck(tmp_path / "deck.nml", "kind = 'table' table = 'cases.h5'")
        return run(camroller, "sweep", deck, "-o", "made.h5", folder=tmp_path)

    assert sweep("rpm", "N mm").returncode == 0
    with h5py.File(tmp_path / "made.h5") as file:
        assert file["measured/torque"].attrs["units"] == "N mm"
    assert sweep("rpm", "N mm", "measured.torque [N mm]").returncode == 0
    for words, *given in (("'operating_point.speed_rpm' is in 'rad/s'; the key takes 'rpm'", "rad/s", "N mm"),
                          ("'measured.torque [N m]' has the unit 'N mm' as well", "rpm", "N mm", "measured.torque [N m]"),
                          ("the longest has 32", "rpm", 33 * "m")):
        refused = sweep(*given)
        assert refused.returncode == 3 and words in refused.stderr, refused.stderr
    # a key without a unit, by the sign of the tables of doc/deck.md
    with h5py.File(tmp_path / "cases.h5", "w") as file:
        file["needle_bearing.friction_coefficient"] = [0.002, 0.003]
        file["needle_bearing.friction_coefficient"].attrs["units"] = "-"
    assert run(camroller, "sweep", "deck.nml", "-o", "plain.h5", folder=tmp_path).returncode == 0


@pytest.mark.parametrize("name, values, words", [
    ("oil_temperature_degC", [25.0, 60.0], "cases.h5' is no column of a table of cases"),
    ("operating_point/oil_temperature_degC", [25.0, 60.0], "cases.h5' is no column of a table of cases"),
    ("film.law", numpy.array([b"moes", b"moes"]), "cases.h5' holds texts of fixed length; those that are read have a variable one")])
def test_what_is_no_column_of_a_table_in_hdf5_is_told(camroller, tmp_path, name, values, words):
    with h5py.File(tmp_path / "cases.h5", "w") as file:
        file["operating_point.speed_rpm"] = [300.0, 900.0]
        file[name] = values
    result = run(camroller, "sweep", write_deck(tmp_path / "deck.nml", "kind = 'table' table = 'cases.h5'"), folder=tmp_path)
    assert result.returncode != 0 and words in result.stderr and f"'/{name.split('/')[0]}' of" in result.stderr
    assert not (tmp_path / "deck.h5").exists()


@pytest.mark.parametrize("sweep, words", [
    ("kind = 'sobol' key_1 = 'operating_point.speed_rpm' from_1 = 300 to_1 = 900", "needs 'cases'"),
    ("kind = 'zip' key_1 = 'operating_point.speed_rpm' values_1 = 1, 2 key_2 = 'roller.radius_mm' values_2 = 8", "one length"),
    ("kind = 'table'", "kind = 'table' needs 'table'"),
    ("kind = 'table' table = 'none.csv'", "there is no file"),
    ("kind = 'table' table = 'bad.csv'", "bad.csv:3: this row has 1 column, the heading has 2"),
    ("kind = 'table' table = 'wrong.csv'", "unknown key 'speed'"),
    ("kind = 'table' table = 'bad.csv' key_2 = 'roller.radius_mm' values_2 = 8, 9", "the table names the keys"),
    ("kind = 'table' table = 'bad.csv' values_2 = 8, 9", "there is no 'key_2' for it"),
    ("kind = 'grid' cases = 3 key_1 = 'operating_point.speed_rpm' values_1 = 1, 2", "'cases' is for samples"),
    ("key_1 = 'film.law' from_1 = 1 to_1 = 2 count_1 = 2", "takes names, which have no range"),
    ("key_1 = 'numerics.max_cycles' from_1 = 1 to_1 = 4 count_1 = 3", "takes whole numbers"),
    ("key_1 = 'roller.mass_kg' from_1 = 0 to_1 = 4 count_1 = 3 scale_1 = 'logarithmic'", "needs ends above zero"),
    ("key_1 = 'operating_point.speed_rpm' values_1 = 300, 400 series = 'chosen'", "series = 'chosen' needs 'series_cases'"),
    ("key_1 = 'operating_point.speed_rpm' values_1 = 300, 400 series = 'chosen' series_cases = 1, 100",
     "there is no case 100: the sweep has 2 cases, the first is 0"),
    ("key_1 = 'operating_point.speed_rpm' values_1 = 300, 400 series = 'chosen' series_cases = 200000*1",
     "'series_cases' has more than 100000 values: 200000*1"),
])
def test_invalid_sweeps_are_refused(camroller, tmp_path, sweep, words):
    (tmp_path / "bad.csv").write_text("# two columns\noperating_point.speed_rpm, film.law\n300\n")
    (tmp_path / "wrong.csv").write_text("operating_point.speed\n300\n")
    result = run(camroller, "sweep", write_deck(tmp_path / "deck.nml", sweep), folder=tmp_path)
    assert result.returncode == DECK
    assert words in result.stderr


@pytest.mark.parametrize("option", ["0/3", "4/3", "x/3", "2", "2/"])
def test_impossible_shards_are_refused(camroller, deck, tmp_path, option):
    assert run(camroller, "sweep", deck, "--shard", option, folder=tmp_path).returncode == USAGE


def test_progress_in_a_log_is_plain_lines(camroller, tmp_path):
    deck = write_deck(tmp_path / "deck.nml", GRID.replace("count_1 = 6", "count_1 = 60"))
    result = done(camroller, "sweep", deck, "--log-every", 0, folder=tmp_path)
    lines = [line for line in result.stderr.splitlines() if "left" in line]
    assert lines
    assert all(" of 240 cases, " in line and "/s, " in line and "\r" not in line for line in lines)


def test_progress_on_a_terminal_is_one_line(camroller, tmp_path):
    """Written over again and again, from the first second on, and taken away at the end."""
    deck = write_deck(tmp_path / "deck.nml", GRID.replace("count_1 = 6", "count_1 = 5000"))
    ours, theirs = os.openpty()
    process = subprocess.Popen([camroller, "sweep", deck, "--threads", "1"], cwd=tmp_path, stderr=theirs)
    os.close(theirs)
    shown = b""
    while b" left" not in shown:
        shown += os.read(ours, 4096)
    process.send_signal(signal.SIGTERM)
    while b"camroller: " not in shown:
        shown += os.read(ours, 4096)
    assert process.wait() == UNFINISHED
    os.close(ours)
    assert re.match(rb"\r\d+ of 20000 cases, [\d.]+/s, [\d.]+ (s|min|h) left *\r", shown), shown
    assert re.search(rb"\r {72}\rcamroller: the sweep was stopped with ", shown), shown


def test_a_full_disk_keeps_computed_cases(camroller, deck, reference, tmp_path):
    """A limit on the size of files stands for the device."""
    result = run("bash", "-c", f"ulimit -f 24; exec {camroller} sweep {deck} --threads 1", folder=tmp_path)
    assert result.returncode == FILE, result.stderr
    assert "cannot write 'deck.h5.part-rank-0'" in result.stderr
    assert not (tmp_path / "deck.h5").exists()
    done(camroller, "sweep", deck, "--resume", folder=tmp_path)
    assert same(reference, tmp_path / "deck.h5")


def test_two_processes_do_not_write_one_part(camroller, deck, tmp_path):
    big = write_deck(tmp_path / "deck.nml", GRID.replace("count_1 = 6", "count_1 = 60"))
    first = subprocess.Popen([camroller, "sweep", big, "--threads", "1", "--quiet"], cwd=tmp_path)
    while not parts(tmp_path):
        time.sleep(0.001)
    second = run(camroller, "sweep", big, "--resume", folder=tmp_path)
    third = run(camroller, "sweep", big, folder=tmp_path)
    os.kill(first.pid, signal.SIGKILL)
    first.wait()
    for result in (second, third):
        assert result.returncode == FILE
        assert "another process is writing 'deck.h5.part-rank-0'" in result.stderr
    assert "a sweep of 'deck.h5' is running" in third.stderr and "stopped" not in third.stderr
    assert "exists from an unfinished sweep" in run(camroller, "sweep", big, folder=tmp_path).stderr


def test_a_folder_that_is_not_there_is_named(camroller, deck, tmp_path):
    result = run(camroller, "sweep", deck, "-o", "none/x.h5", folder=tmp_path)
    assert result.returncode == FILE
    assert result.stderr == "camroller: cannot write 'none/x.h5': there is no folder 'none/'\n"
