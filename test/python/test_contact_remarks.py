"""Remarks on a contact that is beyond what the model describes: no film to speak of, bodies that yield, pressure at one place."""

import pathlib
import re
import subprocess

import h5py
import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]


def remarks(camroller, folder, *settings, deck="decks/thesis.nml"):
    """What a run without a sweep says beside its table."""
    options = [word for setting in settings for word in ("--set", setting)]
    result = subprocess.run([camroller, "run", deck, "--no-sweep", "-o", folder / "result.h5", *options], cwd=ROOT,
                            capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stderr
    return result.stderr


def test_a_film_far_below_the_roughness_gives_a_remark(camroller, tmp_path):
    text = remarks(camroller, tmp_path, "film.law=moes", "operating_point.speed_rpm=50", "operating_point.oil_temperature_degC=140",
                   "surface.cam_roughness_um=1")
    share, least = re.search(r"below 0\.1 of the roughness for ([\d.]+) % of the cycle, down to ([\d.]+) at", text).groups()
    assert 50 < float(share) <= 100 and 0.005 < float(least) < 0.02
    assert "without &asperity" not in text


def test_hot_oil_of_the_thesis_gives_none(camroller, tmp_path):
    assert "of the roughness" not in remarks(camroller, tmp_path, "operating_point.oil_temperature_degC=95")


@pytest.mark.parametrize("roughness, temperature", [(2, 25), (1, 25), (0.5, 60), (0.14, 95)])
def test_asperities_beside_the_dry_contact_are_told_as_the_solved_contact_has_them(camroller, tmp_path, roughness, temperature):
    """Within a quarter of the part that the solved contact gives them where it is larger by more than 0.05."""
    settings = (f"surface.cam_roughness_um={roughness}", f"surface.roller_roughness_um={roughness}",
                f"operating_point.oil_temperature_degC={temperature}")
    text = remarks(camroller, tmp_path, *settings)
    told = re.search(r"for (\d+) % of the cycle those beside it would carry load too, and all of them about (\d+) % of it at the "
                     r"same film, in the place of (\d+) %", text)
    assert told, text
    cycle, spread, strip = (int(number)/100 for number in told.groups())
    options = [word for setting in settings for word in ("--set", setting)]
    deck = tmp_path / "one.nml"
    deck.write_text(f"include = '{ROOT / 'decks/thesis.nml'}', without = 'sweep'\n", encoding="utf-8")
    subprocess.run([camroller, "ehl", deck, "-o", tmp_path / "ehl.h5", *options], capture_output=True, check=True)
    with h5py.File(tmp_path / "ehl.h5") as file:
        solved, formula = (file[f"ehl/asperity_share{name}"][0] for name in ("", "_formula"))
    larger = solved - formula > 0.05
    assert abs(cycle - larger.mean()) < 0.15
    assert abs(strip/formula[larger].mean() - 1) < 0.1
    assert abs(spread/solved[larger].mean() - 1) < 0.25


@pytest.mark.parametrize("settings", [
    ("operating_point.oil_temperature_degC=25",), ("operating_point.oil_temperature_degC=60",),
    # The contact solved at each place has less on asperities that yield than the strip
    ("operating_point.oil_temperature_degC=95", "asperity.law=zhao_maietta_chang", "materials.hardness_GPa=8"),
])
def test_asperities_that_hardly_touch_beside_the_dry_contact_give_none(camroller, tmp_path, settings):
    assert "in the strip of the dry contact alone" not in remarks(camroller, tmp_path, *settings)


@pytest.mark.parametrize("settings, words", [
    (("mechanism.contact_width_mm=2", "spring.stiffness_N_m=200000"), "GPa; even the hard steel of roller bearings stands 4 GPa"),
    (("materials.hardness_GPa=0.5",), "GPa; from 0.3 GPa on, 0.6 of materials.hardness_GPa, the softer body yields"),
    (("materials.hardness_GPa=7",), None),
    ((), None),
])
def test_a_pressure_at_which_bodies_yield_gives_a_remark(camroller, tmp_path, settings, words):
    text = remarks(camroller, tmp_path, "lubricant.pressure_law=roelands", *settings)
    assert words in text if words else "which is elastic here" not in text and "ISO 76" not in text


def test_the_pressure_is_that_where_the_load_along_the_roller_is_largest(camroller, tmp_path):
    deck = tmp_path / "tilted.nml"
    deck.write_text((ROOT / "decks/thesis.nml").read_text(encoding="utf-8") + "\n&roller_profile tilt_mrad = 0.2 /\n", encoding="utf-8")
    assert "the pressure goes up to 1.08 GPa" in remarks(camroller, tmp_path, "operating_point.oil_temperature_degC=95", deck=deck)


@pytest.mark.parametrize("crown, slices, words", [(500, 41, None), (500, 201, None), (12, 41, r"the contact is as short as 0\.\d+ mm \(effective length\)")])
def test_a_contact_nearly_as_wide_as_long_gives_a_remark(camroller, tmp_path, crown, slices, words):
    deck = tmp_path / "crowned.nml"
    deck.write_text((ROOT / "decks/thesis.nml").read_text(encoding="utf-8") + f"\n&roller_profile profile = 'crowned' crown_radius_mm = {crown} /\n",
                    encoding="utf-8")
    text = remarks(camroller, tmp_path, f"roller_profile.slices={slices}", deck=deck)
    assert re.search(words, text) if words else "the contact is as short as" not in text, text


@pytest.mark.parametrize("deck, settings, words", [
    ("decks/thesis.nml", (), None),
    # half of the turns are lost, and the roller still rolls
    ("decks/hard/cold_start_minus_20.nml", (), None),
    ("decks/hard/stuck_roller.nml", (), r"^\S*remark: the roller hardly turns: in a turn of the cam it slips by 100 % of the turns"),
    ("decks/three_cam_head.nml", ("needle_bearing.friction_coefficient=0.5",), r"lobe 2: the roller hardly turns: .* it slips by "),
])
def test_a_roller_that_does_not_turn_gives_a_remark(camroller, tmp_path, deck, settings, words):
    text = remarks(camroller, tmp_path, *settings, deck=deck)
    assert re.search(words, text, re.MULTILINE) if words else "hardly turns" not in text, text


def test_a_boundary_law_that_is_held_at_its_bound_says_so(camroller, tmp_path):
    """A straight line of the temperature takes friction to nothing at 95 degC; with a modifier the coefficient is another one."""
    law = """
&boundary_law
   reference_speed_m_s = 0.1 reference_temperature_degC = 40 change_per_decade = 0.03 change_per_K = -0.001 lowest_speed_m_s = 1e-5
/
"""
    deck = tmp_path / "law.nml"
    deck.write_text((ROOT / "decks/thesis.nml").read_text(encoding="utf-8") + law, encoding="utf-8")
    point = ("operating_point.oil_temperature_degC=95", "operating_point.speed_rpm=300")
    told = "the law of &boundary_law goes beyond boundary_law."
    assert told + "smallest_coefficient = 0, at which" in remarks(camroller, tmp_path, *point, "asperity.boundary_coefficient=0.12", deck=deck)
    assert told + "largest_coefficient = 0.3, at" in remarks(camroller, tmp_path, *point, "asperity.boundary_coefficient=0.5", deck=deck)
    assert told not in remarks(camroller, tmp_path, *point, "boundary_law.change_per_K=-0.0001", "asperity.boundary_coefficient=0.2",
                               "boundary_law.change_per_decade=0.01", deck=deck)


@pytest.mark.parametrize(("law", "words"), [
    ("law = 'logarithmic' reference_speed_m_s = 0.1 reference_temperature_degC = 25 change_per_decade = 0.01 lowest_speed_m_s = 1e-3 "
     "change_per_K = {}", r"all round below boundary_law\.lowest_speed_m_s \(0\.001\)"),
    ("law = 'table' speed_points_m_s = 0.001, 1 temperature_points_degC = 25, 95 coefficient_points = 0.18, 0.2, {}, 0.1",
     r"all round below the first speed of the table of &boundary_law \(0\.001\)")])
def test_a_roller_slower_than_a_boundary_law_has_speeds_for_is_told_what_is_left_of_it(camroller, tmp_path, law, words):
    """The speed changes nothing there, but the temperature does: the remark must not say that the law does nothing."""
    slips = []
    for number in ("-2e-3", "-1e-3") if "per_K" in law else ("0.06", "0.12"):
        deck = tmp_path / "law.nml"
        deck.write_text((ROOT / "decks/thesis.nml").read_text(encoding="utf-8") + "\n&boundary_law " + law.format(number) + " /\n",
                        encoding="utf-8")
        text = remarks(camroller, tmp_path, "operating_point.oil_temperature_degC=95", deck=deck)
        assert re.search(words + ": the boundary coefficient does not depend on the speed there", text), text
        with h5py.File(tmp_path / "result.h5") as file:
            slips.append(file["summary/revolution_slip"][()].ravel()[0])
    assert slips[0] > 1.1 * slips[1]


HOT = ("between cam and roller, ", "where they touch, ", "falls exponentially", "of the profiles")


def heated(folder, groups):
    """The deck with heat and more groups."""
    path = folder / "deck.nml"
    path.write_text((ROOT / "decks/heated_contact.nml").read_text(encoding="utf-8") + groups, encoding="utf-8")
    return path


def test_films_and_surfaces_far_from_what_is_given_say_so(camroller, tmp_path):
    deck = heated(tmp_path, """&boundary_law law = 'table' speed_points_m_s = 0.001, 1 temperature_points_degC = 80, 100
        coefficient_points = 0.1, 0.1, 0.12, 0.12 /""")
    point = ("operating_point.speed_rpm=2500", "operating_point.oil_temperature_degC=95", "asperity.boundary_coefficient=0.1")
    braked = (*point, "needle_bearing.friction_coefficient=0.3")
    assert re.search(r"between cam and roller, 16\d[.\d]* degC, is 7\d[.\d]* K above all points that are given, 25 to 95 degC: the visc",
                     remarks(camroller, tmp_path, *braked, deck=deck))
    text = remarks(camroller, tmp_path, *braked, "heat.cam_conductivity_W_m_K=3", "heat.roller_conductivity_W_m_K=3", deck=deck)
    assert "where they touch, " in text and "nearest temperature in the table of &boundary_law" in text
    assert not any(words in remarks(camroller, tmp_path, *point, deck=deck) for words in HOT)


def test_profiles_say_that_a_place_is_far_from_what_is_given(camroller, tmp_path):
    deck = heated(tmp_path, "&ehl profiles = .true. / &output angle_step_deg = 20 /")
    text = remarks(camroller, tmp_path, "operating_point.speed_rpm=2000", "needle_bearing.friction_coefficient=0.3", deck=deck)
    assert "in the profiles the oil temperature between cam and roller, " in text
    assert not any(words in remarks(camroller, tmp_path, "operating_point.speed_rpm=900", deck=deck) for words in HOT)


def test_a_deck_with_heat_is_told_none_of_this(camroller, tmp_path):
    result = subprocess.run([camroller, "run", "decks/heated_contact.nml", "-o", tmp_path / "result.h5"], cwd=ROOT, capture_output=True,
                            text=True, check=True)
    assert not any(words in result.stderr for words in HOT)


def test_a_film_that_carries_little_is_judged_by_what_it_carries(camroller, tmp_path):
    """Asperities of a hard surface carry nine tenths and more of the load; the film's law is evaluated far below its range, all round."""
    text = remarks(camroller, tmp_path, "materials.hardness_GPa=8", "asperity.law=zhao_maietta_chang", "operating_point.speed_rpm=300",
                   "operating_point.oil_temperature_degC=95")
    assert "outside its published range for 100 % of the cycle, in the event and on the base circle" in text
