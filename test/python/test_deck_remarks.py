"""Remarks on the numbers of a deck: each comes where a number looks like a slip, and none on the decks that are shipped."""

import math
import pathlib
import re
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]


def remarks_of(camroller, deck, *values):
    """Remarks that `check` makes on a deck."""
    words = [camroller, "check", str(deck), *(word for value in values for word in ("--set", value))]
    result = subprocess.run(words, capture_output=True, text=True, cwd=ROOT, check=False)
    assert result.returncode == 0, result.stderr
    return [line for line in result.stderr.splitlines() if line.startswith("remark: ")]


@pytest.mark.parametrize("deck", sorted((ROOT / "decks").glob("*.nml")), ids=lambda path: path.name)
def test_no_remark_on_a_deck_of_an_engine(camroller, deck):
    remarks = remarks_of(camroller, deck)
    if deck.name == "thesis_as_printed.nml":
        # the clearance that the thesis prints is a tenth of the one meant
        assert len(remarks) == 1 and "valve_guide.radial_clearance_um = 2 is unusual" in remarks[0]
    else:
        assert remarks == []


@pytest.mark.parametrize(("values", "words"), [
    (["lubricant.viscosity_points_Pa_s=43,9,2.5"], r"lubricant.viscosity_points_Pa_s = 43 .*did you mean 43 mm\^2/s\?"),
    (["lubricant.viscosity_points_Pa_s=43,9,2.5"], r"9 Pa s at 60 degC is unusual.*did you mean 9 mm\^2/s\?"),
    (["roller.mass_kg=9"], r"roller.mass_kg = 9 .*did you mean 0.009 kg\?"),
    (["materials.cam_modulus_GPa=170000"], r"cam_modulus_GPa = 170000 .*did you mean 170 GPa\?"),
    (["cam_bearings.radial_clearance_um=0.0475"], r"radial_clearance_um = 0.0475 .*did you mean 47.5 um\?"),
    (["asperity.boundary_coefficient=1.2"], r"boundary_coefficient = 1.2 is unusual: engines have 0 to 0.5"),
    (["needle_bearing.friction_coefficient=1.5"], r"friction_coefficient = 1.5 .*did you mean 0.0015\?"),
    (["traction.limiting_coefficient=8"], r"limiting_coefficient = 8 .*did you mean 0.08, which is 8 %\?"),
    (["sweep.values_2=25,363.15"], r"oil_temperature_degC = 363.15 .*did you mean 90 degC, which is 363.15 K\?"),
    (["sweep.values_1=300,600,90000"], r"operating_point.speed_rpm = 90000 is unusual"),
], ids=str)
def test_an_unusual_value_gives_a_remark(camroller, values, words):
    remarks = remarks_of(camroller, "decks/thesis.nml", *values)
    assert any(re.search(words, remark) for remark in remarks), remarks


def refusal_of(camroller, *values):
    """The words with which `check` refuses a deck."""
    words = [camroller, "check", "decks/thesis.nml", *(word for value in values for word in ("--set", value))]
    result = subprocess.run(words, capture_output=True, text=True, cwd=ROOT, check=False)
    assert result.returncode in (3, 4) and result.stderr.startswith("camroller: "), result.stderr
    return result.stderr


@pytest.mark.parametrize(("value", "words"), [
    ("materials.cam_modulus_GPa=170e9", "not 170e9; did you mean 170 GPa?"),
    ("materials.cam_poisson_ratio=28", "not 28; did you mean 0.28, which is 28 %?"),
    ("lubricant.pressure_viscosity_coefficient_per_GPa=22e-9", "not 22e-9; did you mean 22 1/GPa?"),
    ("roller.mass_kg=8.8e6", "not 8.8e6; did you mean 0.0088 kg?"),
    ("lubricant.viscosity_points_Pa_s=0.15, 3.05e7, 0.01", "did you mean 0.0305 Pa s?"),
])
def test_a_value_refused_by_its_range_asks_for_the_one_meant(camroller, value, words):
    assert words in refusal_of(camroller, value)


@pytest.mark.parametrize("value", ["materials.cam_modulus_GPa=-170", "materials.cam_poisson_ratio=0.7", "roller.mass_kg=0",
                                   "surface.cam_roughness_um=1e-9"])
def test_a_refused_value_that_no_unit_explains_asks_for_none(camroller, value):
    assert "did you mean" not in refusal_of(camroller, value)


@pytest.mark.parametrize(("value", "words", "meant"), [
    ("mechanism.pivot_to_roller_mm=0.0208", "no closed triangle", "pivot_to_roller_mm = 0.0208 is unusual: engines have 8 to 60 mm; did you mean 20.8 mm?"),
    ("roller.radius_mm=0.0085", "'wall_thickness_mm' must be below 'radius_mm'", "roller.radius_mm = 0.0085 is unusual: engines have 3 to 30 mm; did you mean 8.5 mm?"),
    ("spring.stiffness_N_m=25", "lifts the valve off its seat", "stiffness_N_m = 25 is unusual: engines have 2000 to 200000 N/m; did you mean 25000 N/m?"),
    ("lift.opening_half_angle_deg=1.2217", "cam undercut", "did you mean 69.9983 degree, which is 1.2217 rad?"),
])
def test_a_slip_of_units_is_named_behind_the_mistake_that_it_makes(camroller, value, words, meant):
    """Geometry and rules between keys refuse the deck; the number that is to blame is named, and none in a deck without such."""
    text = refusal_of(camroller, value)
    assert words in text and meant in text and text.index(words) < text.index(meant)
    assert "remark" not in refusal_of(camroller, "roller.wall_thickness_mm=9")


@pytest.mark.parametrize(("key", "words"), [
    ("lubricant.viscosity_mm2_s", "; did you mean 'viscosity_at_40_degC_mm2_s' or 'viscosity_at_100_degC_mm2_s'?"),
    ("lubricant.viscosity_cSt", "; did you mean 'viscosity_at_40_degC_mm2_s' or 'viscosity_at_100_degC_mm2_s'?"),
    ("lubricant.viscosity_at_100_C_mm2_s", "; did you mean 'viscosity_at_100_degC_mm2_s'?\n"),
    ("lubricant.viscosity_mPa_s", "; did you mean 'viscosity_Pa_s'? Its values are in Pa s\n"),
    ("materials.cam_modulus_MPa", "; did you mean 'cam_modulus_GPa'? Its values are in GPa\n"),
    ("spring.stiffness_N_mm", "; did you mean 'stiffness_N_m'? Its values are in N/m\n"),
    ("roller.mass_g", "; did you mean 'mass_kg'? Its values are in kg\n"),
    ("roller.mas_kg", "; did you mean 'mass_kg'?\n"),
])
def test_the_hint_at_an_unknown_key_leads_to_no_mistake_of_units(camroller, key, words):
    assert words in refusal_of(camroller, f"{key}=1")


@pytest.mark.parametrize(("change", "words"), [
    (lambda angle, lift: (angle, lift / 1000), r"largest lift of 0.0092 mm is unusual.*is 'table_unit' right\?"),
    (lambda angle, lift: (180 + 2 * (angle - 180), lift), r"an event of .* degrees .*crankshaft\?"),
], ids=["metres", "crank degrees"])
def test_a_lift_table_in_wrong_units_gives_a_remark(camroller, tmp_path, change, words):
    text = (ROOT / "decks/tables/polynomial_lift.txt").read_text(encoding="utf-8")
    rows = [tuple(map(float, line.split())) for line in text.splitlines() if line.strip() and line.strip()[0].isdigit()]
    (tmp_path / "lift.txt").write_text("\n".join("{} {}".format(*change(*row)) for row in rows), encoding="utf-8")
    remarks = remarks_of(camroller, "decks/tabulated_lift.nml", f"lift.table={tmp_path / 'lift.txt'}")
    assert any(re.search(words, remark) for remark in remarks), remarks


def test_a_usual_value_gives_no_remark_and_defaults_show_the_range(camroller):
    assert remarks_of(camroller, "decks/thesis.nml", "roller.mass_kg=0.02", "asperity.boundary_coefficient=0.15") == []
    page = subprocess.run([camroller, "defaults", "roller"], capture_output=True, text=True, check=True).stdout
    assert "usually 0.001 to 0.3" in re.sub(r"\s*\n\s*! ", " ", page)


def test_film_range_remark_says_which_group_and_which_law(camroller, tmp_path):
    def remarks(*values):
        words = [camroller, "run", "decks/thesis.nml", "-o", str(tmp_path / "a.h5"), "--no-sweep", *values]
        result = subprocess.run(words, capture_output=True, text=True, cwd=ROOT, check=True)
        return [line for line in result.stderr.splitlines() if "published range" in line]
    (found,) = remarks()
    assert re.search(r"on the base circle, where [\d.]+ % of the follower's friction arises", found)
    assert re.search(r"W\* down to [\d.e-]+, published for 1.5e-5 to 0.0003", found) and "film.law 'moes' covers that" in found
    assert remarks("--set", "film.law=moes") == []


@pytest.mark.parametrize(("law", "count"), [("greenwood_tripp", 1), ("masjedi_khonsari", 0)])
def test_asperities_that_are_foreign_to_a_rough_film_give_one_remark(camroller, tmp_path, law, count):
    values = ("film.law='masjedi_khonsari_rough'", f"asperity.law='{law}'", "materials.hardness_GPa=4")
    said = [remark for remark in remarks_of(camroller, "decks/thesis.nml", *values) if "do not go together" in remark]
    assert len(said) == count
    words = [camroller, "run", "decks/thesis.nml", "-o", str(tmp_path / "a.h5"), "--no-sweep"]
    result = subprocess.run([*words, *(word for value in values for word in ("--set", value))], capture_output=True, text=True,
                            cwd=ROOT, check=True)
    assert result.stderr.count("do not go together") == count


def test_a_law_that_is_varied_gives_the_remark_once(camroller):
    values = ("sweep.values_3='moes', 'masjedi_khonsari_rough'", "sweep.key_3=film.law", "materials.hardness_GPa=4")
    assert len([remark for remark in remarks_of(camroller, "decks/thesis.nml", *values) if "do not go together" in remark]) == 1


def rounded_lift(folder, digit):
    """The lift table of a shipped deck, rounded to so many millimetres."""
    text = (ROOT / "decks/tables/polynomial_lift.txt").read_text(encoding="utf-8")
    rows = [tuple(map(float, line.split())) for line in text.splitlines() if line.strip() and line.strip()[0].isdigit()]
    path = folder / "lift.txt"
    path.write_text("\n".join(f"{angle} {round(lift / digit) * digit:.6f}" for angle, lift in rows), encoding="utf-8")
    return path


def test_a_noisy_lift_table_gives_a_remark_and_a_smoothed_one_does_not(camroller, tmp_path):
    table = rounded_lift(tmp_path, 0.002)
    (found,) = remarks_of(camroller, "decks/tabulated_lift.nml", f"lift.table={table}")
    told = re.search(r"noise of about ([\d.]+) um.*second derivative (-[\d.]+) to ([\d.]+) mm/rad\^2; with smoothing_um = ([\d.]+) in "
                     r"&lift it is (-[\d.]+) to ([\d.]+)", found)
    # rounding to 2 um has an rms of 2/sqrt(12) = 0.58 um; a median of 150 differences knows it to a fifth
    assert float(told[1]) == pytest.approx(0.58, rel=0.3) and told[4] == told[1]
    # 4-5-6-7 polynomial: largest second derivative 7.526 lift/half angle^2
    exact = 7.526 * 9.2 / (74 * 3.14159265 / 180) ** 2
    assert float(told[3]) > 1.1 * exact
    assert float(told[6]) == pytest.approx(exact, rel=0.1)
    assert remarks_of(camroller, "decks/tabulated_lift.nml", f"lift.table={table}", f"lift.smoothing_um={float(told[1]) + 0.05}") == []


def test_check_prints_the_noise_of_a_table(camroller):
    text = subprocess.run([camroller, "check", "decks/tabulated_lift.nml"], capture_output=True, text=True, cwd=ROOT, check=True).stdout
    found = re.search(r"lift table: noise of about ([\d.e-]+) um, smoothing_um = 0; second derivative", text)
    # rounded to 1e-6 mm
    assert float(found[1]) < 0.01


@pytest.mark.parametrize(("given", "words"), [
    ("3.1", None), ("2.0", None), ("3.9", None),
    ("5", r"= 5 is 1.37 of the 3.64 mPa s .* no oil gets thicker by shear"),
    ("1.5", r"= 1.5 is 0.412 of the 3.64 mPa s .* engine oils keep more than 0.45"),
    ("0.0031", r"= 0.0031 is unusual: engines have 1.3 to 8 mPa s; did you mean 3.1 mPa s\?"),
])
def test_the_viscosity_under_shear_is_compared_with_that_of_the_law(camroller, given, words):
    remarks = remarks_of(camroller, "decks/four_cylinder.nml", f"lubricant.hths_viscosity_mPa_s={given}")
    assert remarks == [] if words is None else len(remarks) == 1 and re.search(words, remarks[0]), remarks


def test_check_prints_what_shear_takes_of_the_viscosity(camroller):
    text = subprocess.run([camroller, "check", "decks/four_cylinder.nml", "--no-sweep"], capture_output=True, text=True, cwd=ROOT,
                          check=True).stdout
    found = re.search(r"oil at 150 degC: ([\d.]+) mPa s without shear, HTHS is ([\d.]+) of it.* shear at (\d+) 1/s, HTHS at 1e6", text)
    # Walther's law through 64 and 11 mm2/s at 40 and 100 degC; density falls by 6.5e-4 of that at 15 degC in each degree
    logs = [math.log10(math.log10(value + 0.7)) for value in (64, 11)]
    slope = (logs[0] - logs[1]) / math.log10(373.15 / 313.15)
    hot = (10 ** 10 ** (logs[1] - slope * math.log10(423.15 / 373.15)) - 0.7) * 0.852 * (1 - 6.5e-4 * 135)
    # three and two digits are printed; journals of 24 mm with 30 um turn a thousand times a minute
    assert float(found[1]) == pytest.approx(hot, rel=5e-3) and float(found[2]) == pytest.approx(3.1 / hot, rel=5e-3)
    assert float(found[3]) == pytest.approx(0.012 * 1000 * math.pi / 30 / 30e-6, rel=0.05)
    assert "150 degC" not in subprocess.run([camroller, "check", "decks/thesis.nml", "--no-sweep"], capture_output=True, text=True, cwd=ROOT,
                                            check=True).stdout


@pytest.mark.parametrize("law, deck, words", [
    ("barus", "decks/thesis.nml", "the pressure goes up to 0.65 GPa; the law 'barus' of viscosity over pressure holds to about 0.1 GPa"),
    ("cameron", "decks/thesis.nml", None),
    ("cameron", "decks/hard/pressure_1500_MPa_roelands.nml", "up to 1.5 GPa; the law 'cameron' of viscosity over pressure holds to about 1 GPa"),
    ("roelands", "decks/hard/pressure_1500_MPa_roelands.nml", None),
])
def test_a_pressure_above_the_range_of_the_viscosity_law_gives_a_remark(camroller, tmp_path, law, deck, words):
    result = subprocess.run([camroller, "run", deck, "--set", f"lubricant.pressure_law={law}", "-o", tmp_path / "a.h5"], cwd=ROOT,
                            capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stderr
    found = [line for line in result.stderr.splitlines() if "of viscosity over pressure holds" in line]
    assert not found if words is None else len(found) == 1 and words in found[0]
