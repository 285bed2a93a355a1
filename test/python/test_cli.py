"""The program from outside: commands, options, exit codes, where text goes."""

import os
import re
import socket

import pytest

from conftest import ROOT, run

DECKS = sorted((ROOT / "decks").glob("*.nml"))
USAGE, DECK, FILE = 2, 3, 6


def refused(result, code):
    """The message of a refusal; nothing stands on the output unit."""
    assert result.returncode == code, result.stderr
    assert result.stdout == ""
    assert result.stderr.startswith("camroller: ")
    return result.stderr


COMMANDS = ["run", "sweep", "merge", "rerun", "check", "study", "audit", "limit", "ehl", "defaults", "fmu", "export", "version", "selftest",
            "help"]


@pytest.mark.parametrize("command", COMMANDS)
def test_each_command_has_help(camroller, command):
    asked = run(camroller, "help", command)
    assert asked.returncode == 0
    assert asked.stdout.startswith(f"camroller {command}")
    assert run(camroller, command, "--help").stdout == asked.stdout


def test_help_names_every_command(camroller):
    text = run(camroller, "--help").stdout
    assert text == run(camroller, "help").stdout
    assert re.findall(r"^  camroller (\w+)", text, re.MULTILINE) == COMMANDS


def test_version_is_printed(camroller):
    text = run(camroller, "version").stdout
    assert text.startswith("camroller 0.")
    assert run(camroller, "--version").stdout == text


@pytest.mark.parametrize("arguments, words", [
    ([], "no command; see 'camroller help'"),
    (["chck"], "unknown command 'chck'; did you mean 'check'?"),
    (["simulate"], "unknown command 'simulate'; known are 'run', "),
    (["run"], "'run' needs the name of a file"),
    (["check", "--foo", "x"], "'check' has no option '--foo'"),
    (["check", "--quiet", "x"], "'check' has no option '--quiet'"),
    (["run", "x", "-o"], "option '--output' needs a value"),
    (["run", "x", "--set"], "option '--set' needs a value"),
    (["run", "x", "--quiet=yes"], "option '--quiet' takes no value"),
    (["check", "x", "y"], "'check' does not take 'y'"),
    (["export", "x", "--case", "none"], "option '--case' takes the number of a case, from 0, not 'none'"),
    (["export", "x", "--case", "-1"], "option '--case' takes the number of a case, from 0, not '-1'"),
    (["sweep", "x", "-j", "0"], "option '--threads' takes a number of threads, from 1 to 1024, not '0'"),
    (["sweep", "x", "-j", "-1"], "option '--threads' takes a number of threads, from 1 to 1024, not '-1'"),
    (["sweep", "x", "--threads=two"], "option '--threads' takes a number of threads, from 1 to 1024, not 'two'"),
    (["sweep", "x", "--threads", "1.5"], "option '--threads' takes a number of threads, from 1 to 1024, not '1.5'"),
    (["sweep", "x", "--threads="], "option '--threads' takes a number of threads, from 1 to 1024, not ''"),
    (["sweep", "x", "--threads", "100000"], "option '--threads' takes a number of threads, from 1 to 1024, not '100000'"),
    (["rerun", "x", "-j", "99999999999999999999"], "option '--threads' takes a number of threads, from 1 to 1024, not '9"),
    (["study", "x", "--repeats", "0"], "option '--repeats' takes a number of runs, from 1, not '0'"),
    (["sweep", "x", "--log-every", "-1"], "option '--log-every' takes a time in whole seconds, not '-1'"),
    (["sweep", "x", "--shard", "3/2"], "option '--shard' takes a shard and the number of shards, as 2/4, not '3/2'"),
    (["run", "x", "--point", "speed_rpm=600", "--point", "speed_rpm=900"], "'operating_point.speed_rpm' has 2 values, and a point takes"),
    (["run", "x", "--point", "speed_rpm=600", "-s", "operating_point.speed_rpm=900"], "'operating_point.speed_rpm' has 2 values"),
    (["run", "x", "--point", "speed_rpm=600", "--set", "Operating_point.Speed_RPM =700"], "'operating_point.speed_rpm' has 2 values"),
    (["run", "x", "--point", "film.law=moes", "--point", "Film.law='pan_hamrock'"],
     "of a deck with the group &sweep key_1 = 'film.law' values_1 = 'moes', 'pan_hamrock' / and without '--point'"),
    (["run", "x", "--no-sweep", "--set", "Sweep.values_1=900"], "'Sweep.values_1=900' is of &sweep, which '--point' and '--no-sweep' "),
    (["run", "-"], "a deck from the standard input has no name that a file could take: give one by -o FILE"),
    (["sweep", "-", "--quiet"], "a deck from the standard input has no name that a file could take: give one by -o FILE"),
    (["run", "x", "-o", "-"], "'run' does not write to the standard output: give a name by -o FILE"),
    (["check", "x", "--draw", "a.png"], "option '--draw' writes SVG: 'a.png' has another ending than .svg"),
    (["check", "x", "--draw-lift", "a.b/x.svg.pdf"], "option '--draw-lift' writes SVG: 'a.b/x.svg.pdf' has another ending than .svg"),
    (["run", "x", "--no-sweep", "--set", "sweep.values_1=900"], "'sweep.values_1=900' is of &sweep, which '--point' and '--no-sweep' "),
    (["check", "x", "--point", "speed_rpm=600", "--set", " sweep.kind=zip"], "is of &sweep, which '--point' and '--no-sweep' leave out"),
    (["study", "x", "--laws", "--film"], "'study' does not take '--laws' together with '--film'; see 'camroller help study'"),
    (["study", "x", "--quick", "--laws"], "'study' does not take '--laws' together with '--quick'"),
    (["study", "x", "--laws", "--repeats", "2"], "'study' does not take '--laws' together with '--repeats'"),
    (["study", "x", "--laws", "-o", "x.h5"], "'study' does not take '--laws' together with '--output'"),
    (["study", "x", "-q", "--laws"], "'study' does not take '--laws' together with '--quiet'"),
    (["export", "x", "--series", "--summary"], "'export' does not take '--summary' together with '--series'"),
    (["export", "x", "--summary", "--case", "0"], "'export' does not take '--summary' together with '--case'"),
    (["sweep", "x", "-q", "--log-every", "5"], "'sweep' does not take '--log-every' together with '--quiet'"),
    (["rerun", "x", "--log-every", "5", "-q"], "'rerun' does not take '--log-every' together with '--quiet'"),
    (["help", "--man", "--completion"], "'help' does not take '--man' together with '--completion'"),
    (["help", "run", "--man"], "'help' does not take '--man' together with 'COMMAND'"),
    (["help", "run", "--completion"], "'help' does not take '--completion' together with 'COMMAND'"),
    (["run", "x", "-o", "a.h5", "--output=b.h5"], "option '--output' is given twice"),
    (["check", "x", "--draw", "a.svg", "--cam", "a.svg"], "two options name the same file, 'a.svg'"),
    (["help", "me"], "unknown command 'me'"),
    (["defaults", "asperty"], "no group 'asperty'; did you mean 'asperity'?"),
])
def test_invalid_arguments_are_usage_errors(camroller, arguments, words):
    assert words in refused(run(camroller, *arguments), USAGE)


@pytest.mark.parametrize("deck", DECKS, ids=lambda path: path.name)
def test_each_deck_passes_the_check(checked, deck):
    result = checked(deck)
    assert result.returncode == 0, result.stderr
    assert " is valid: " in result.stdout.splitlines()[0]


def test_defaults_are_a_deck(camroller, tmp_path):
    deck = tmp_path / "complete.nml"
    deck.write_text(run(camroller, "defaults").stdout)
    assert run(camroller, "check", deck).returncode == 0


def test_page_of_the_deck_is_up_to_date(camroller):
    assert (ROOT / "doc/deck.md").read_text() == run(camroller, "defaults", "--markdown").stdout, \
        "run: build/release/bin/camroller defaults --markdown > doc/deck.md"


def test_missing_deck_is_a_file_error(camroller):
    assert "there is no file 'no_such.nml'" in refused(run(camroller, "check", "no_such.nml"), FILE)


def test_a_folder_in_place_of_a_deck_is_refused(camroller):
    assert "cannot read 'decks': it is a folder" in refused(run(camroller, "check", "decks"), FILE)


def test_a_socket_or_a_pipe_in_place_of_a_deck_is_refused(camroller, tmp_path):
    with socket.socket(socket.AF_UNIX) as listener:
        listener.bind(str(tmp_path / "socket"))
        assert "cannot read 'socket': it is a socket\n" in refused(run(camroller, "check", "socket", folder=tmp_path), FILE)
    os.mkfifo(tmp_path / "pipe")
    words = "cannot read 'pipe': it is a pipe; only a deck may come by one, as the standard input, whose name is -\n"
    assert words in refused(run(camroller, "check", "pipe", folder=tmp_path), FILE)


def test_mistakes_are_deck_errors(camroller, tmp_path):
    deck = tmp_path / "bad.nml"
    deck.write_text((ROOT / "decks/thesis.nml").read_text().replace("speed_rpm = 300", "speed_rmp = 300")
                    .replace("mass_kg = 0.0088", "mass_kg = heavy"))
    message = refused(run(camroller, "check", deck), DECK)
    assert message.startswith(f"camroller: 2 mistakes in {deck}\n{deck}:")
    assert "unknown key 'speed_rmp' in &operating_point; did you mean 'speed_rpm'?" in message
    assert "    mass_kg = heavy\n" in message.replace(" | ", " ")


@pytest.mark.parametrize("line", ["accuracy = 1e", "accuracy = 1.d", "accuracy = abc", "shear_thinning = 3", "profiles = 'y'"])
def test_values_after_an_unreadable_one_are_still_read(camroller, tmp_path, line):
    deck = tmp_path / "bad.nml"
    text = (ROOT / "decks/numerical_film.nml").read_text()
    assert "accuracy = 0.01" in text
    deck.write_text(text.replace("accuracy = 0.01", line))
    message = refused(run(camroller, "check", deck), DECK)
    assert "mistakes" not in message
    assert f"'{line.split()[0]}' takes" in message


def test_a_table_is_looked_up_relative_to_the_deck(camroller, tmp_path):
    result = run(camroller, "check", ROOT / "decks/tabulated_lift.nml", folder=tmp_path)
    assert result.returncode == 0, result.stderr


def test_binary_file_is_refused(camroller, tmp_path):
    deck = tmp_path / "binary.nml"
    deck.write_bytes(bytes(range(256)) * 8)
    assert "is not a text file" in refused(run(camroller, "check", deck), FILE)


def test_a_load_of_any_size_is_printed_as_a_number(camroller):
    message = refused(run(camroller, "check", "decks/thesis.nml", "--set", "spring.base_circle_load_N=1e12"), DECK)
    assert "lifts the valve off its seat" in message
    message = refused(run(camroller, "check", "decks/thesis.nml", "--set", "spring.precompression_mm=0.01"), DECK)
    assert "holds 0." in message


def test_the_advice_for_two_points_is_a_sweep(camroller, tmp_path):
    """What the message says is put into a deck as it stands there."""
    deck = (ROOT / "decks/thesis.nml").read_text().partition("&sweep")[0]
    (tmp_path / "deck.nml").write_text(deck)
    message = refused(run(camroller, "check", tmp_path / "deck.nml", "--point", "speed_rpm=600", "--point", "speed_rpm=900"), USAGE)
    (tmp_path / "deck.nml").write_text(deck + "&sweep" + message.partition("&sweep")[2].partition(" and without")[0] + "\n")
    result = run(camroller, "check", tmp_path / "deck.nml")
    assert result.returncode == 0, result.stderr
    assert " is valid: 2 cases over 2 of operating_point.speed_rpm" in result.stdout


def test_limits_of_a_rigid_train_say_which_options_they_do_not_use(camroller):
    result = run(camroller, "limit", "decks/thesis.nml", "--to", "3000", "--seating", "0.4")
    assert result.returncode == 0, result.stderr
    assert [line for line in result.stderr.splitlines() if "is not used" in line] == [
        f"remark: {option} is not used: the limits of a train without &dynamics follow from its forces" for option in ("--to", "--seating")]
    assert "is not used" not in run(camroller, "limit", "decks/thesis.nml").stderr
