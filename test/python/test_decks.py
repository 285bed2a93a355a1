"""The decks that come with the program: readable by others, made as they say."""

import pathlib
import re
import subprocess

import f90nml
import numpy
import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
DECKS = sorted((ROOT / "decks").glob("*.nml"))


@pytest.mark.parametrize("path", DECKS, ids=lambda path: path.name)
def test_f90nml_reads_each_deck(path):
    text = path.read_text()
    deck = f90nml.reads(text)
    assert list(deck) == [line[1:].split()[0] for line in text.splitlines() if line.startswith("&")]
    assert deck["case"]["title"]
    assert "\ninclude = " in text or deck["roller"]["radius_mm"] > 5


def test_there_are_decks():
    assert {"thesis.nml", "thesis_source.nml", "thesis_as_printed.nml", "tabulated_lift.nml",
            "three_cam_head.nml"} <= {path.name for path in DECKS}


def given(name, base):
    """Keys of a deck that includes another one and gives no more than these."""
    text = (ROOT / "decks" / name).read_text()
    assert re.findall("^include.*", text, flags=re.MULTILINE) == [f"include = '{base}'"]
    deck = f90nml.reads(text)
    return {f"{group}.{key}" for group in deck for key in deck[group]}


def test_the_thesis_decks_differ_only_in_the_keys_listed():
    bookkeeping = {"case.title", "case.energy", "spring.load_arm", "roller.spin", "asperity.boundary",
                   "traction.rolling_law", "traction.in_roller_balance"}
    assert given("thesis_source.nml", "thesis.nml") == bookkeeping
    assert given("thesis_as_printed.nml", "thesis_source.nml") == {
        "case.title", "spring.stiffness_n_m", "spring.seating", "cam_bearings.radial_clearance_um",
        "valve_guide.radial_clearance_um"}


def test_lift_table_follows_its_formula():
    angle, lift = numpy.loadtxt(ROOT / "decks/tables/polynomial_lift.txt").T
    u = numpy.where(angle <= 180, (angle - 106) / 74, (262 - angle) / 82)
    assert numpy.abs(lift - 9.2 * (35 * u**4 - 84 * u**5 + 70 * u**6 - 20 * u**7)).max() <= 0.51e-6


def test_pressure_table_follows_its_formula():
    angle, pressure = numpy.loadtxt(ROOT / "decks/tables/cylinder_pressure.txt").T
    distance = numpy.minimum(abs(angle - 60), 360 - abs(angle - 60))
    assert numpy.abs(pressure - 0.15 - 50 / (1 + (distance / 12) ** 2)).max() <= 0.51e-4


@pytest.mark.parametrize("deck", [path.name for path in DECKS] + ["hard/short_event.nml", "hard/noisy_table_smoothed.nml"])
def test_what_check_prints_is_a_deck(camroller, deck, tmp_path):
    """Every key with its value, defaults too: keys that exclude each other are not both there."""
    first = subprocess.run([camroller, "check", ROOT / "decks" / deck, "--no-sweep"], capture_output=True, text=True, check=False)
    assert first.returncode == 0, first.stderr
    again = tmp_path / "again.nml"
    again.write_text(re.sub(r"'([./]*tables/[^']*)'", lambda match: f"'{(ROOT / 'decks' / deck).parent / match[1]}'", first.stdout))
    printed = subprocess.run([camroller, "check", again], capture_output=True, text=True, check=False).stdout
    values, values_again = ([line.split("!")[0].rstrip() for line in text.splitlines()] for text in (again.read_text(), printed))
    assert values == values_again
    # a folder cannot be written to: the deck is read, and nothing computed
    second = subprocess.run([camroller, "run", again, "-o", tmp_path], capture_output=True, text=True, check=False)
    assert second.returncode == 6, second.stderr
