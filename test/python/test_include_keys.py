"""Decks that change others: keys of the deck that includes a file replace those of the file, and whole groups can be left out."""

import os
import re
import sys

import h5py
import pytest

from conftest import ROOT, done, printed, run

UNFINISHED = 8
THESIS = (ROOT / "decks/thesis.nml").read_text(encoding="utf-8")
VARIANT = """include = 'base.nml'

&case
   title = 'A lower lift'
/

&operating_point speed_rpm = 900 /  ! one line

&lift
   ! measured
   Max_Lift_mm = 8  ! mm
/

&needle_drag
   pitch_diameter_mm = 14
/
"""


def write(folder, **texts):
    """Files of a deck; returns the path of the first one."""
    for name, text in texts.items():
        (folder / f"{name}.nml").write_text(text, encoding="utf-8")
    return folder / f"{next(iter(texts))}.nml"


def values(camroller, deck, *options):
    """All values that `check` prints, by group and key, with the mark of a default."""
    group, found = "", {}
    for line in done(camroller, "check", deck, *options).stdout.splitlines():
        if line.startswith("&"):
            group = line[1:].strip()
        elif match := re.match(r"   (\w+) = (.*)", line):
            found[f"{group}.{match[1]}"] = " ".join(match[2].split())
    return found


def mistakes(camroller, deck, *options):
    """What is said of a deck with mistakes."""
    return done(camroller, "check", deck, *options, code=3).stderr.replace(f"{deck.parent}/", "")


def test_keys_of_the_including_deck_replace_those_of_the_file(camroller, tmp_path):
    deck = write(tmp_path, deck=VARIANT, base=THESIS)
    plain = THESIS.replace("Data of Islam (2019), closed energy balance", "A lower lift").replace("speed_rpm = 300", "speed_rpm = 900")
    whole = write(tmp_path, whole=plain.replace("max_lift_mm = 9.5", "max_lift_mm = 8") + "\n&needle_drag\n   pitch_diameter_mm = 14\n/\n")
    assert values(camroller, deck) == values(camroller, whole)
    assert values(camroller, deck)["lift.max_lift_mm"] == "8" and values(camroller, deck)["lift.exponents"] == "4"


@pytest.mark.parametrize("first", [True, False])
def test_it_does_not_matter_where_the_line_with_include_stands(camroller, tmp_path, first):
    own = "&lift max_lift_mm = 7 /\n"
    deck = write(tmp_path, deck="include = 'base.nml'\n" + own if first else own + "include = 'base.nml'\n", base=THESIS)
    assert values(camroller, deck)["lift.max_lift_mm"] == "7"


def test_a_file_replaces_keys_of_what_it_includes_and_the_deck_those_of_both(camroller, tmp_path):
    deck = write(tmp_path, deck="include = 'middle.nml'\n&roller radius_mm = 8 /\n",
                 middle="&roller radius_mm = 9 mass_kg = 0.01 /\ninclude = 'base.nml'\n", base=THESIS)
    found = values(camroller, deck)
    assert [found[f"roller.{key}"] for key in ("radius_mm", "mass_kg", "wall_thickness_mm")] == ["8", "0.01", "2.4"]


def test_groups_can_be_left_out(camroller, tmp_path):
    own = "&lift\n   law = 'table'\n   table = 'lift.txt'\n   table_unit = 'mm'\n/\n"
    (tmp_path / "lift.txt").write_text((ROOT / "decks/hard/tables/coarse_lift.txt").read_text())
    deck = write(tmp_path, deck="include = 'middle.nml', without = 'sweep', 'Lift', \"valve_guide\"  ! one case\n" + own,
                 middle="include = 'base.nml'\n&sweep values_1 = 600 /\n", base=THESIS)
    found = values(camroller, deck)
    assert found["lift.law"] == "'table'" and "lift.max_lift_mm" not in found
    assert not [key for key in found if key.startswith(("sweep.", "valve_guide."))]


def test_a_group_to_leave_out_must_be_there(camroller, tmp_path):
    deck = write(tmp_path, deck="include = 'base.nml', without = 'film', 'swep'\n", base="&film\n/\n&sweep\n/\n")
    assert mistakes(camroller, deck).startswith("camroller: deck.nml:1:42: 'base.nml' has no group &swep; it has &film, &sweep\n"
                                                "    1 | include = 'base.nml', without = 'film', 'swep'\n")


@pytest.mark.parametrize("line", ["without = 'sweep'", ", without = ", ", without = sweep", ", without = 'sweep' 'lift' x", ", with = 'a'",
                                  ", without = 'sweep', without = 'lift'", ", without = ''"])
def test_lines_with_include_are_as_they_should_be(camroller, tmp_path, line):
    deck = write(tmp_path, deck=f"include = 'base.nml'{line}\n", base=THESIS)
    if line.startswith("without"):  # the comma is as needless as between the keys of a group
        assert values(camroller, deck)
    else:
        assert "deck.nml:1:1: expected include = 'file', one file in a line, or include = 'file', without = " in mistakes(camroller, deck)


def test_files_beside_each_other_may_not_give_the_same_key(camroller, tmp_path):
    files = {"base": THESIS, "oil": "&film\n   law = 'moes'\n   range_policy = 'stop'\n/\n"}
    both = "include = 'base.nml'\ninclude = 'oil.nml'\n"
    said = mistakes(camroller, write(tmp_path, deck=both, **files))
    assert said == ("camroller: oil.nml:2:4: key 'law' of &film is in 'base.nml' too, and neither file includes the other; give it in "
                    "the file that includes both, or include one of them without the group\n    2 |    law = 'moes'\n      |    ^^^\n")
    for text, law in ((both + "&film law = 'pan_hamrock' /\n", "'pan_hamrock'"),
                      ("include = 'base.nml', without = 'film'\ninclude = 'oil.nml'\n", "'moes'")):
        found = values(camroller, write(tmp_path, deck=text, **files))
        assert found["film.law"] == law and found["film.range_policy"] == "'stop'"


def test_a_file_that_is_included_twice_is_one_mistake(camroller, tmp_path):
    (tmp_path / "base.nml").write_text(THESIS)
    for name in ("one", "two"):
        (tmp_path / f"{name}.nml").write_text("include = 'base.nml'\n")
    for text, words in (("include = 'one.nml'\ninclude = 'two.nml'\n", "base.nml' is included already by '"),
                        ("include = 'base.nml'\ninclude = 'base.nml'\n", "base.nml' is included already; a deck takes a file in once")):
        (tmp_path / "deck.nml").write_text(text)
        result = run(camroller, "check", "deck.nml", folder=tmp_path)
        assert result.returncode == 3 and words in result.stderr and result.stderr.count("base.nml'") < 3, result.stderr


@pytest.mark.parametrize(("text", "words"), [
    ("&roller wall_thickness_mm = 3 / include = 'base.nml'", "include = 'file' stands on a line of its own"),
    ("include 'base.nml'", "include = 'file' stands on a line of its own"),
    ("without = 'sweep'", "include = 'file' stands on a line of its own"),
    ("&roller\n include = 'base.nml'\n/", "unknown key 'include' in &roller; a line include = 'file' stands outside of groups")])
def test_a_line_with_include_in_the_wrong_place_is_told_as_such(camroller, tmp_path, text, words):
    (tmp_path / "deck.nml").write_text(text + "\n")
    result = run(camroller, "check", "deck.nml", folder=tmp_path)
    assert result.returncode == 3 and words in result.stderr, result.stderr


def test_what_is_twice_in_one_file_is_a_mistake(camroller, tmp_path):
    deck = write(tmp_path, deck="include = 'base.nml'\n&film\n   law = 'moes'\n   law = 'moes'\n/\n", base=THESIS)
    assert "deck.nml:4:4: key 'law' is there twice in &film" in mistakes(camroller, deck)
    deck = write(tmp_path, deck="include = 'base.nml'\n&film law = 'moes' /\n&film\n/\n", base=THESIS)
    assert "deck.nml:3:1: group &film is there twice" in mistakes(camroller, deck)
    deck = write(tmp_path, deck="include = 'base.nml'\n&film law = 'moes' /\n", base=THESIS + "&film\n/\n")
    assert f"base.nml:{THESIS.count(chr(10)) + 1}:1: group &film is there twice" in mistakes(camroller, deck)


def test_mistakes_have_the_file_and_line_of_the_value(camroller, tmp_path):
    base = THESIS.replace("pressure_law = 'cameron'", "pressure_law = 'cameroon'").replace("exponents = 4", "exponents = 4000")
    deck = write(tmp_path, deck=VARIANT.replace("pitch_diameter_mm = 14", "pitch_diameter_mm = -4") + "&film law = 'moos' /\n"
                 "&lubricant pressure_viscosity_coefficient_per_GPa = 'x' /\n", base=base)
    said = mistakes(camroller, deck)
    texts = {"deck.nml": deck.read_text().splitlines(), "base.nml": base.splitlines()}
    for file, word in (("deck.nml", "-4"), ("deck.nml", "'moos'"), ("deck.nml", "'x'"), ("base.nml", "'cameroon'"), ("base.nml", "4000")):
        line = next(i for i, text in enumerate(texts[file], 1) if word in text)
        column = texts[file][line - 1].index(word) + 1
        assert f"{file}:{line}:{column}: " in said
        assert f"{line:5} | {texts[file][line - 1]}\n      | {' ' * (column - 1)}^" in said


def test_a_value_that_is_replaced_may_be_wrong(camroller, tmp_path):
    deck = write(tmp_path, deck="include = 'base.nml'\n&film law = 'moes' /\n",
                 base=THESIS.replace("law = 'dowson_higginson'", "law = 'dowson',\n      ! which one?\n      'hamrock'"))
    assert values(camroller, deck)["film.law"] == "'moes'"


def test_a_missing_key_is_told_with_the_group_of_the_deck(camroller, tmp_path):
    deck = write(tmp_path, deck="include = 'base.nml'\n\n&lift law = 'table' /\n", base=THESIS)
    assert "deck.nml:3:1: lift law 'table' needs 'table' in &lift" in mistakes(camroller, deck)


def test_text_in_the_result_is_a_deck_by_itself(camroller, tmp_path):
    """The sweep is that of the base, with the deck's own speeds; it can be run again, continued and rerun without the files."""
    deck = write(tmp_path, deck=VARIANT + "&sweep values_1 = 300, 900 /\n", base=THESIS)
    expected = values(camroller, deck)
    path = tmp_path / "a.h5"
    stop = ["--threads", 1, "--set", "sweep.wall_time_limit_s=1e-3"]
    assert run(camroller, "sweep", deck, "-o", path, "--set", "output.angle_step_deg=5", *stop).returncode == UNFINISHED
    done(camroller, "sweep", deck, "-o", path, "--set", "output.angle_step_deg=5", "--resume")
    with h5py.File(path) as file:
        text = file["deck/text"][()].decode()
        assert list(file["summary/status"]) == [0] * 6
    assert "! mm" in text and "! measured" in text and "9.5\n" not in text and text.count("&lift") == 1
    deck.unlink()
    (tmp_path / "base.nml").unlink()
    assert values(camroller, write(tmp_path, text=text)) == expected
    result = done(camroller, "rerun", path)
    assert "6 cases" in result.stdout, result.stdout


def test_one_case_of_a_sweep_that_the_base_gives(camroller, tmp_path):
    deck = write(tmp_path, deck=VARIANT, base=THESIS)
    path = tmp_path / "a.h5"
    done(camroller, "run", deck, "-o", path, "--quiet", "--no-sweep", "--set", "output.angle_step_deg=5")
    with h5py.File(path) as file:
        assert len(file["summary/status"]) == 1 and "sweep" not in file["deck/text"][()].decode()
    assert run(camroller, "rerun", path).returncode == 0


def test_a_host_gives_such_a_deck_as_text(installed_package, tmp_path):
    """The folder that the paths start at goes with it; cases of the sweep are those of the base."""
    write(tmp_path, base=THESIS)
    words = ("import camroller, sys\n"
             "case = camroller.Case.from_text(\"include = 'base.nml'\\n&roller radius_mm = 8 /\\n&sweep values_1 = 300, 600 /\", sys.argv[1])\n"
             "print(len(list(case.sweep())), case.numbers['roller.radius_mm'])\n")
    found = printed(sys.executable, "-c", words, tmp_path, env={**os.environ, "PYTHONPATH": str(installed_package)})
    assert found.split()[0] == "6" and "8" in found
