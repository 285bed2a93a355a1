"""Numbers and units as people read them."""

import numpy as np
import pytest

from units import bare_name, distinct_texts, factor, fitting_unit, key_words, number, significant


@pytest.mark.parametrize("value, text", [
    (0.0, "0"), (8.4e-5, "8.40e-05"), (974689074.0, "9.75e+08"), (0.0696, "0.0696"), (29.31, "29.3"), (99.97, "100"),
    (2937.17, "2937"), (133.0, "133"), (4.0, "4"), (-1426.3, "-1426"), (-0.5, "-0.500"), (1e6, "1.00e+06"), (999999.0, "999999"),
    (float("nan"), "-"), (float("inf"), "inf")])
def test_a_number_has_three_digits_and_an_exponent_only_where_it_is_tiny_or_huge(value, text):
    assert number(value) == text


def test_a_number_is_within_half_a_unit_of_its_last_digit():
    for value in np.random.default_rng(3).lognormal(0.0, 8.0, 2000):
        assert float(number(value)) == pytest.approx(value, rel=5.01e-3)
        assert float(significant(value)) == pytest.approx(value, rel=5.01e-3)


@pytest.mark.parametrize("value, text", [(99.97, "100"), (9.999, "10.0"), (0.09996, "0.100"), (99.94, "99.9"), (1234.56, "1230")])
def test_rounding_up_adds_no_digit(value, text):
    assert significant(value) == text


@pytest.mark.parametrize("name, unit, values, expected", [
    ("contact_loss_speed", "rad s-1", [307.58], ("rev/min", 30.0 / np.pi)),
    ("max_roller_spin", "rad s-1", [94.7], ("rev/min", 30.0 / np.pi)),
    ("min_film", "m", [4.7e-7, 1e-8], ("um", 1e6)), ("depth", "m", [4e-12], ("pm", 1e12)), ("lift", "m", [9.5e-3], ("mm", 1e3)), ("area", "m2", [4.2e-10], ("um2", 1e12)),
    ("pressure", "Pa", [6.5e8], ("GPa", 1e-9)), ("torque", "N m", [0.0763], ("N mm", 1e3)), ("torque", "N m", [5.1], ("N m", 1.0)),
    ("slip_ratio", "1", [0.3], ("%", 100.0)), ("lost_contact_share", "1", [0.1], ("%", 100.0)), ("error", "1", [1e-5], ("1", 1.0)),
    ("angle", "deg", [135.0], ("deg", 1.0)), ("load", "N", [0.0], ("N", 1.0)), ("load", "N", [np.nan, 764.0], ("N", 1.0)),
    ("other", "m2 K/W", [3.0], ("m2 K/W", 1.0))])
def test_a_unit_suits_the_values(name, unit, values, expected):
    shown, scale = fitting_unit(name, unit, values)
    assert shown == expected[0] and scale == pytest.approx(expected[1])


def test_units_of_other_dimensions_are_not_mixed():
    assert factor("Pa", "GPa") == 1e-9 and factor("m s-1", "m/s") == 1.0
    assert factor("rad s-1", "rev/min") == pytest.approx(9.5492966)
    assert factor("m", "N") is None and factor("J", "N m") is None


@pytest.mark.parametrize("key, unit, words", [
    ("operating_point.speed_rpm", "rpm", "speed"), ("operating_point.oil_temperature_degC", "degC", "oil temperature"),
    ("film.law", "1", "film law"), ("roller.radius_mm", "mm", "roller radius"), ("surface.cam_roughness_um", "um", "cam roughness"),
    ("spring.stiffness_N_m", "N/m", "spring stiffness"), ("lubricant.thermal_expansion_per_K", "1/K", "thermal expansion"),
    ("lift.opening_half_angle_deg", "degree", "opening half angle"), ("wear.cam_rate_mm3_N_m", "mm3/(N m)", "cam rate"),
    ("heat.oil_conductivity_W_m_K", "W/(m K)", "oil conductivity"),
    ("bearing_heat.heat_capacity_J_kg_K", "J/(kg K)", "heat capacity"),
    ("asperity.roughness_product", "1", "asperity roughness product")])
def test_keys_in_words(key, unit, words):
    assert key_words(key, unit) == words


def test_a_name_keeps_what_is_no_unit():
    assert bare_name("pivot_to_cam_mm", "mm") == "pivot_to_cam" and bare_name("boundary", "1") == "boundary"


def test_values_have_the_digits_that_tell_them_apart():
    assert distinct_texts([300.0, 600.0]) == ["300", "600"]
    assert distinct_texts([25000.0, 30000.0]) == ["25000", "30000"]
    assert distinct_texts([532.92141866, 609.3]) == ["532.9", "609.3"]
    assert distinct_texts([1000.01, 1000.02]) == ["1000.01", "1000.02"]


@pytest.mark.parametrize("ending", ["", "_deviation", "_lowest", "_highest"])
def test_shares_over_the_cycles_are_in_per_cent_as_their_means(ending):
    assert fitting_unit(f"float_share{ending}", "1", [0.7]) == ("%", 100.0)
    assert fitting_unit(f"bounces{ending}", "1", [0.7]) == ("1", 1.0)
