"""Shear of the film in contacts that are nearly rigid: against solved contacts, and what is said of it."""

import re

import h5py
import numpy as np
import pytest
from conftest import ROOT, done

DECK = ROOT / "decks/thesis.nml"
COLD = ["--no-sweep", "--set", "film.law=moes", "--set", "lubricant.temperature_points_degC=-20,40,100", "--set",
        "lubricant.viscosity_points_Pa_s=8,0.08,0.009", "--set", "operating_point.oil_temperature_degC=-20", "--set",
        "numerics.accuracy=1e-3"]


@pytest.mark.once
def test_shear_of_a_nearly_rigid_contact_is_that_of_the_solved_one(camroller, tmp_path):
    """On the base circle, at the slip that the solved contact has; formulas of shear and film are off together, by 15 % here."""
    for zone, low, high in (("hertz", 1.5, 2.5), ("rigid_to_elastic", 0.8, 1.2)):
        done(camroller, "ehl", DECK, "-o", f"{zone}.h5", "--quiet", "--set", "sweep.values_1=300,600", "--set", "sweep.values_2=25",
             "--set", "film.law=moes", "--set", f"traction.sheared_zone={zone}", "--set", "output.angle_step_deg=10", folder=tmp_path)
        with h5py.File(tmp_path / f"{zone}.h5") as file:
            base = np.abs(file["ehl/angle"][:] - 180) > 75
            ratios = (file["ehl/shear_formula"][:] / file["ehl/shear"][:])[:, base]
        assert ratios.size > 100
        assert low < ratios.min() and ratios.max() < high, (zone, ratios.min(), ratios.max())


def remarks(camroller, tmp_path, *options):
    """Remarks of a run of the deck."""
    return done(camroller, "run", DECK, "-o", "x.h5", *options, folder=tmp_path).stderr


def test_a_nearly_rigid_contact_over_the_strip_of_the_dry_one_has_a_remark(camroller, tmp_path):
    words = "where the contact is nearly rigid: the shear of the film over the strip of the dry contact is "
    cold = remarks(camroller, tmp_path, *COLD)
    assert words in cold and "traction.sheared_zone = 'rigid_to_elastic'" in cold
    assert words not in remarks(camroller, tmp_path, *COLD, "--set", "traction.sheared_zone=rigid_to_elastic")
    assert words not in remarks(camroller, tmp_path, "--no-sweep", "--set", "operating_point.oil_temperature_degC=95"), "it rolls"


def test_the_remark_on_shear_weighs_by_time(camroller, tmp_path):
    """Where contact opens at 3200 rev/min the strip of the dry contact is next to nothing, and so is its shear."""
    text = remarks(camroller, tmp_path, "--no-sweep", "--set", "film.law=moes", "--set", "operating_point.speed_rpm=3200",
                   "--set", "operating_point.oil_temperature_degC=60")
    found = re.search(r"is there, on average, about ([\d.e+]+) times too large, and slip is off with it", text)
    assert found and 1.3 < float(found[1]) < 3, text


def test_the_heat_of_the_shear_is_spread_over_the_strip_that_is_sheared(camroller, tmp_path):
    """On the base circle at 0 degC a film is warmer than its surfaces by h/(12 k) times the power of the shear over the area that
    it warms: that of the dry contact, or 2 sqrt(b^2 + 1.0144 2 R h) wide (doc/theory.md, section 10; k = 0.14 W/(m K))."""
    (tmp_path / "hot.nml").write_text(DECK.read_text() + "\n&heat inlet_law = 'none' /\n")
    for zone, part in (("hertz", 0.0), ("rigid_to_elastic", 1.0144)):
        done(camroller, "run", "hot.nml", "--no-sweep", "-o", "x.h5", "--quiet", "--set", "film.law=moes", "--set",
             f"traction.sheared_zone={zone}", "--set", "operating_point.speed_rpm=900", "--set",
             "operating_point.oil_temperature_degC=0", folder=tmp_path)
        with h5py.File(tmp_path / "x.h5") as file:
            base = np.abs(file["series/cam_angle"][:] - 180) > 100
            film, rise, flash, shear, sliding, half_width, radius = (file[f"series/{name}"][0][base] for name in (
                "film_thickness_central", "film_temperature_rise", "flash_temperature_rise", "friction_hydrodynamic", "sliding_speed",
                "hertz_half_width", "equivalent_radius"))
        area = film * np.abs(shear * sliding) / (12 * 0.14 * (rise - flash))
        wanted = 2 * np.sqrt(half_width**2 + part * 2 * radius * film) * 13.7e-3
        # M is 0.12 here, so that the strip is 0.13 % narrower than in the rigid limit
        assert area == pytest.approx(wanted, rel=3e-3), zone


def test_the_limit_of_a_film_without_pressure_and_a_roller_that_turns_backwards_have_remarks(camroller, tmp_path):
    """At 900 rev/min the film of the base circle is 0.05 mm thick: 8 % of its load of 64 N is a stress of 0.04 MPa."""
    liquid, backwards = "at mean stresses below 1 MPa, down to 0.", "the roller turns backwards in its finger for "
    wide = ["--set", "traction.sheared_zone=rigid_to_elastic", "--set", "operating_point.speed_rpm=900"]
    text = remarks(camroller, tmp_path, *COLD, *wide)
    assert liquid in text and backwards in text
    text = remarks(camroller, tmp_path, *COLD, *wide, "--set", "traction.limit=local", "--set", "traction.limiting_stress_MPa=3")
    assert liquid not in text
    with h5py.File(tmp_path / "x.h5") as file:
        base = np.abs(file["series/cam_angle"][:] - 180) > 100
        slip = file["series/slip_ratio"][0][base]
    assert np.abs(slip - 0.89).max() < 0.03, "a rigid contact whose rolling resistance alone holds its roller slips by 0.89"


def test_a_law_for_smooth_surfaces_does_not_stand_for_one_of_rough_ones(camroller, tmp_path):
    text = remarks(camroller, tmp_path, "--no-sweep", "--set", "film.law=masjedi_khonsari_rough", "--set",
                   "asperity.law=masjedi_khonsari", "--set", "materials.hardness_GPa=8", "--set", "spring.base_circle_load_N=180",
                   "--set", "mechanism.contact_width_mm=5", "--set", "spring.precompression_mm=25")
    assert "sigma/R up to 4.93e-5" in text and "cover" not in text.partition("sigma/R")[2].partition("\n")[0]


def test_hot_oil_in_a_bearing_and_a_roller_slower_than_a_law_have_remarks(camroller, tmp_path):
    text = done(camroller, "run", ROOT / "decks/warm_bearings.nml", "--no-sweep", "-o", "x.h5", "--set",
                "operating_point.oil_temperature_degC=95", "--set", "belt_pull.force_N=1500", "--set",
                "bearing_asperity.roughness_um=1", "--set", "bearing_asperity.boundary_coefficient=0.15", folder=tmp_path).stderr
    assert "the oil temperature in a camshaft bearing, 169.96 degC, is 74.96 K above" in text
    (tmp_path / "deck.nml").write_text(DECK.read_text().partition("&sweep")[0] + """&boundary_law law = 'table'
  speed_points_m_s = 0.01, 1 temperature_points_degC = 20, 100 coefficient_points = 0.05, 0.1, 0.05, 0.1 /
""")
    slow = ["--set", "operating_point.oil_temperature_degC=95", "--set", "numerics.accuracy=1e-3"]
    text = done(camroller, "run", "deck.nml", "-o", "x.h5", *slow, folder=tmp_path).stderr
    assert "all round below the first speed of the table of &boundary_law (0.01)" in text
    text = done(camroller, "run", "deck.nml", "-o", "x.h5", *slow, "--set", "boundary_law.speed_points_m_s=1e-4,1", folder=tmp_path).stderr
    assert "all round below" not in text
