"""Units of results and of tables, against a table of SI units and dimensions of its own and against physics.

A unit attribute is read here by a small parser; each quantity must have the dimension that its name stands for, in SI, and the
identities between quantities must hold for the numbers as their attributes say they are meant.
"""

import math
import pathlib
import re
import subprocess

import h5py
import numpy
import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
DECKS = ("thesis", "three_cam_head", "tabulated_lift")
COARSE = ("--set", "output.angle_step_deg=5")
# Numbers of a file against each other: sums of a few hundred values in double precision
ROUND_OFF = 1e-12

# Unit: factor to SI, powers of metre, kilogram, second, kelvin; radians count as numbers.
# Source: Bureau International des Poids et Mesures, The International System of Units, 9th edition (2019), tables 2 to 8.
UNITS = {
    "1": (1, (0, 0, 0, 0)), "rad": (1, (0, 0, 0, 0)), "degree": (math.pi / 180, (0, 0, 0, 0)),
    "m": (1, (1, 0, 0, 0)), "mm": (1e-3, (1, 0, 0, 0)), "um": (1e-6, (1, 0, 0, 0)),
    "kg": (1, (0, 1, 0, 0)), "s": (1, (0, 0, 1, 0)), "K": (1, (0, 0, 0, 1)), "degC": (1, (0, 0, 0, 1)),
    "N": (1, (1, 1, -2, 0)), "J": (1, (2, 1, -2, 0)), "W": (1, (2, 1, -3, 0)), "kW": (1e3, (2, 1, -3, 0)),
    "Pa": (1, (-1, 1, -2, 0)), "kPa": (1e3, (-1, 1, -2, 0)), "bar": (1e5, (-1, 1, -2, 0)), "MPa": (1e6, (-1, 1, -2, 0)),
    "GPa": (1e9, (-1, 1, -2, 0)), "Hz": (1, (0, 0, -1, 0)), "rpm": (2 * math.pi / 60, (0, 0, -1, 0)),
}
NUMBER, LENGTH, AREA, FORCE = (0, 0, 0, 0), (1, 0, 0, 0), (2, 0, 0, 0), (1, 1, -2, 0)
SPEED, RATE, PRESSURE, TORQUE, POWER = (1, 0, -1, 0), (0, 0, -1, 0), (-1, 1, -2, 0), (2, 1, -2, 0), (2, 1, -3, 0)
STATISTIC = "(mean_|min_|max_)?"
# What each name stands for; a quantity must fit exactly one line, so that a new one needs a line here.
DIMENSIONS = {
    rf"{STATISTIC}(valve_lift|equivalent_radius|hertz_half_width|film_thickness_(min|central))": LENGTH,
    rf"{STATISTIC}(valve_velocity|(cam_surface|rolling|roller_surface|sliding|entrainment)_speed)": SPEED,
    rf"{STATISTIC}(contact_load|asperity_load|traction|friction_(hydrodynamic|boundary|boundary_mobilised|rolling|contact))": FORCE,
    rf"{STATISTIC}roller_spin": RATE,
    rf"{STATISTIC}(slip_ratio|film_ratio|asperity_friction_share)": NUMBER,
    rf"{STATISTIC}hertz_pressure": PRESSURE,
    rf"{STATISTIC}real_contact_area": AREA,
    rf"{STATISTIC}torque_(geometric|contact|needle|guide|bearings|roller_inertia|friction|drive)": TORQUE,
    rf"{STATISTIC}energy_residual": POWER,
    r"power_(contact|needle|guide|bearings|friction)": POWER,
    r"work_(contact|needle|guide|bearings|friction)": TORQUE,
    r"spring_margin|margin_(event|base_circle|pivot|seat)|min_event_contact_load|adjuster_force": FORCE,
    r"contact_loss_speed|margin_(event|base_circle|pivot)_speed|pump_up_speed|train_frequency": RATE,
    r"cam_angle|(estimated_error|margin_(event|base_circle|pivot))_angle": NUMBER,
    r"revolution_slip|lost_contact_share|outside_film_range_share|relative_energy_residual|estimated_error(_of_means|_of_extremes)?": NUMBER,
    r"entrainment_reversals|counter_(evaluations|jacobians|steps|rejected|cycles)|periodicity|status|film_table_error|load_factor": NUMBER,
}
# The same for files of `ehl`, whose places across the contact are in half widths of the dry contact, and of `study`
EHL_DIMENSIONS = {
    r"angle|node|x|asperity_share(_formula)?": NUMBER,
    r"film|film_(min|central)(_formula)?|half_width": LENGTH,
    r"pressure|peak_pressure": PRESSURE,
    r"load|(boundary_friction|rolling_resistance|shear)(_formula)?|traction": FORCE,
    r"sliding_speed": SPEED,
    r"torque_(contact|drive|friction)": TORQUE,
    r"energy_residual": POWER,
}
STUDY_DIMENSIONS = {
    r"case|row|status|setting|steps|evaluations|error_.*|estimated_error": NUMBER,
    r"time": (0, 0, 1, 0),
}
# Angles are the only quantities that are not in SI
IN_DEGREES = r"(.*_)?angle|step"


def parse(text):
    """Factor to SI and dimension of a unit such as `N m`, `m s-1`, `m2`, `kg/m3`."""
    factor, powers, sign = 1.0, (0, 0, 0, 0), 1
    for part in text.replace("/", " / ").split():
        if part == "/":
            sign = -1
            continue
        match = re.fullmatch(r"([A-Za-z]+|1)(-?\d+)?", part)
        assert match and match[1] in UNITS, f"no known unit: {part} in {text!r}"
        power = sign * int(match[2] or 1)
        factor *= UNITS[match[1]][0]**power
        powers = tuple(a + power * b for a, b in zip(powers, UNITS[match[1]][1]))
    return factor, powers


def one_case(path, source, **groups):
    """A deck without its sweep, with other values for some groups."""
    text = (ROOT / f"decks/{source}.nml").read_text()
    text = re.sub(r"^&sweep\n.*?^/\n", "", text, flags=re.M | re.S)
    for group, body in groups.items():
        text = re.sub(rf"^&{group}\n.*?^/\n", "", text, flags=re.M | re.S) + f"&{group}\n{body}\n/\n"
    path.write_text(text)
    return path


@pytest.fixture(scope="module", params=DECKS)
def results(request, camroller, tmp_path_factory):
    """The result file of a deck."""
    target = tmp_path_factory.mktemp(request.param) / "result.h5"
    subprocess.run([camroller, "run", ROOT / f"decks/{request.param}.nml", "-o", target, "--quiet", *COARSE], check=True,
                   capture_output=True, stdin=subprocess.DEVNULL, timeout=300)
    with h5py.File(target) as file:
        yield file


def test_unit_names_are_read_as_dimensions():
    assert parse("N m") == (1, TORQUE) == parse("J")
    assert parse("W") == parse("J s-1") == (1, POWER) == parse("N m s-1")
    assert parse("m s-1") == parse("m/s") == (1, SPEED)
    assert parse("kW")[0] == 1000 and parse("kg/m3")[1] == (-3, 1, 0, 0) and parse("1/GPa")[0] == pytest.approx(1e-9)
    with pytest.raises(AssertionError):
        parse("furlong")


def check_units(file, groups, dimensions):
    """Every number of some groups has the dimension of its name, in SI."""
    for group in groups:
        for name, dataset in file[group].items():
            if dataset.dtype.kind == "O":  # words
                continue
            first = name.replace("lobe_2_", "")  # the second lobe shape has what the first has
            fitting = [dimension for pattern, dimension in dimensions.items() if re.fullmatch(pattern, first)]
            assert len(fitting) == 1, f"{group}/{name}: {len(fitting)} lines of the table of dimensions above fit, not one"
            factor, dimension = parse(dataset.attrs["units"])
            assert dimension == fitting[0], f"{group}/{name} in {dataset.attrs['units']}"
            expected = math.pi / 180 if re.fullmatch(IN_DEGREES, first) else 1
            assert factor == pytest.approx(expected, rel=ROUND_OFF), f"{group}/{name} in {dataset.attrs['units']}"


def test_every_quantity_has_the_unit_of_its_dimension(results):
    check_units(results, ("series", "summary"), DIMENSIONS)


def test_every_quantity_of_the_numerical_film_has_the_unit_of_its_dimension(camroller, tmp_path):
    target = tmp_path / "ehl.h5"
    deck = one_case(tmp_path / "deck.nml", "numerical_film")
    subprocess.run([camroller, "ehl", deck, "-o", target, "--quiet"], check=True, capture_output=True, stdin=subprocess.DEVNULL,
                   timeout=300)
    with h5py.File(target) as file:
        check_units(file, ("ehl",), EHL_DIMENSIONS)
        ehl = {name: dataset[...] for name, dataset in file["ehl"].items()}
        width = float(file["deck/values/mechanism.contact_width_mm"][()]) / 1000
        carried = numpy.trapezoid(ehl["pressure"], ehl["x"][:, None, :], axis=-1) * ehl["half_width"] * width
        # asperities carry the rest; the rule of the solution and the trapezoidal one differ by some permille on 129 nodes
        numpy.testing.assert_allclose(carried, ehl["load"] * (1 - ehl["asperity_share"]), rtol=1e-2)
        assert numpy.all(numpy.max(ehl["pressure"], axis=-1) <= ehl["peak_pressure"] * (1 + ROUND_OFF))


def test_every_quantity_of_a_study_has_the_unit_of_its_dimension(camroller, tmp_path):
    target = tmp_path / "study.h5"
    deck = one_case(tmp_path / "deck.nml", "thesis")
    subprocess.run([camroller, "study", deck, "--quick", "--repeats", "1", "-o", target, "--quiet"], check=True, capture_output=True,
                   stdin=subprocess.DEVNULL, timeout=300)
    with h5py.File(target) as file:
        check_units(file, [f"study/{group}" for group in file["study"]], STUDY_DIMENSIONS)


def test_every_key_has_the_unit_in_its_name(results):
    """The last words of a key, as in `stiffness_N_m`, against its attribute."""
    last_words = {"N_m": "N/m", "Pa_s": "Pa s", "kg_m2": "kg m2", "kg_m3": "kg/m3", "m_s": "m/s", "per_GPa": "1/GPa", "per_K": "1/K"}
    last_words |= {unit: unit for unit in UNITS if unit not in ("1", "rad", "degree", "K", "J", "W", "kW")} | {"deg": "degree"}
    for group in ("deck/values", "sweep"):
        for name, dataset in results.get(group, {}).items():
            key = name.split(".")[1]
            fitting = [words for words in last_words if key.endswith("_" + words)]
            expected = last_words[max(fitting, key=len)] if fitting else "1"
            assert parse(dataset.attrs["units"]) == parse(expected), f"{group}/{name} in {dataset.attrs['units']}"


def test_quantities_agree_with_each_other_in_their_units(results):
    """Definitions, with each number in SI by its attribute."""

    def si(path):
        dataset = results[path]
        return parse(dataset.attrs["units"])[0] * dataset[...]

    def value(key):
        """Value of the sweep's axis or of the deck, one for each case."""
        if f"sweep/{key}" in results:
            return si(f"sweep/{key}")
        return parse(results[f"deck/values/{key}"].attrs["units"])[0] * float(results[f"deck/values/{key}"][()])

    def same(left, right, tolerance=ROUND_OFF):
        numpy.testing.assert_allclose(left, right, rtol=tolerance, atol=tolerance * numpy.max(numpy.abs(right)))

    series = {name: si(f"series/{name}") for name in results["series"]}
    summary = {name: si(f"summary/{name}") for name in results["summary"]}
    speed = numpy.broadcast_to(value("operating_point.speed_rpm"), results["case"].shape)
    turn = 2 * math.pi
    for name in [name for name in summary if name.startswith("power_")]:
        loss = name.removeprefix("power_")
        same(summary[name], summary[f"mean_torque_{loss}"] * speed)
        same(summary[f"work_{loss}"], summary[f"mean_torque_{loss}"] * turn)
    same(series["cam_angle"][-1] + series["cam_angle"][1], turn)
    same(series["torque_drive"], sum(series[f"torque_{part}"] for part in ("geometric", "friction", "roller_inertia")))
    width, load = value("mechanism.contact_width_mm"), series["contact_load"]
    same(0.5 * math.pi * series["hertz_pressure"] * series["hertz_half_width"] * width, load)
    roughness = math.hypot(value("surface.cam_roughness_um"), value("surface.roller_roughness_um"))
    same(series["film_ratio"], series["film_thickness_min"] / roughness)
    same(series["slip_ratio"], series["sliding_speed"] / series["rolling_speed"])
    same(series["roller_surface_speed"], series["cam_surface_speed"] - series["sliding_speed"])
    same(series["entrainment_speed"], 0.5 * (series["cam_surface_speed"] + series["roller_surface_speed"]))
    same(series["rolling_speed"] - series["sliding_speed"], series["roller_spin"] * value("roller.radius_mm"))
    same(series["asperity_friction_share"] * series["friction_contact"], numpy.abs(series["friction_boundary_mobilised"]))
    # the lift has jumps in its higher derivatives, across which the spline through 5 degrees is good to some percent
    slope = numpy.gradient(series["valve_lift"], series["cam_angle"], axis=-1) * speed[:, None]
    same(series["valve_velocity"], slope, 0.05)
    same(summary["max_valve_lift"], numpy.max(series["valve_lift"], axis=-1), 1e-3)
    # the area of touching asperities is less than that of the contact, and they bear less than their hardness at most
    area = 2 * series["hertz_half_width"] * width
    assert numpy.all(series["real_contact_area"] <= area) and numpy.all(series["asperity_load"] <= series["contact_load"])
    # the losses are what is left of the drive torque over a turn, the balance of energy closes
    assert numpy.all(numpy.abs(series["energy_residual"]) <= 1e-10 * summary["power_friction"][:, None])
    largest = numpy.maximum(-summary["min_energy_residual"], summary["max_energy_residual"])
    same(summary["relative_energy_residual"], largest / summary["power_friction"])
    # without friction and inertia of the roller the load of the event falls with the square of the speed, to none at this one
    assert numpy.all((summary["contact_loss_speed"] > speed) == (summary["spring_margin"] > 0))


# Number of units in one metre and in one pascal
LENGTHS = {"m": 1, "mm": 1000, "um": 1000000}
PRESSURES = {"Pa": 1, "kPa": 1 / 1000, "bar": 1 / 100000, "MPa": 1 / 1000000}


def table(path, unit_per_si, scale):
    """Write one turn of a smooth hump as a table in a unit: angle in degrees, largest value `scale` in SI."""
    rows = [(angle, scale * max(0.0, math.cos(math.radians(angle - 180)))**4) for angle in range(0, 361, 2)]
    path.write_text("".join(f"{angle} {value * unit_per_si:.15e}\n" for angle, value in rows))


def run_table(camroller, folder, deck, key, unit, name):
    """Series of a case whose table is in a unit."""
    target = folder / f"{name}_{unit}.h5"
    subprocess.run([camroller, "run", deck, "-o", target, "--quiet", *COARSE, "--set", f"{key}={unit}"], check=True,
                   capture_output=True, stdin=subprocess.DEVNULL, timeout=300)
    with h5py.File(target) as file:
        return {name: file[f"series/{name}"][...] for name in ("valve_lift", "contact_load", "torque_drive")}


def allowed(key):
    """Names of a unit as the page of the deck lists them."""
    page = (ROOT / "doc/deck.md").read_text()
    lines = [re.search(r"one of ([^|]*)\|", line)[1] for line in page.splitlines() if line.startswith(f"| `{key}`")]
    return [re.findall(r"'(\w+)'", line) for line in lines]


@pytest.mark.parametrize("key, units", [("table_unit", LENGTHS), ("pressure_unit", PRESSURES)])
def test_every_unit_of_tables_is_tested_in_this_file(key, units):
    assert allowed(key) and all(set(names) == set(units) for names in allowed(key))


def test_lift_tables_in_every_unit_are_the_same_lift(camroller, tmp_path):
    found = {}
    for unit, per_metre in LENGTHS.items():
        table(tmp_path / "lift.txt", per_metre, 8.0e-3)
        deck = one_case(tmp_path / "deck.nml", "thesis", lift="law = 'table'\ntable = 'lift.txt'")
        found[unit] = run_table(camroller, tmp_path, deck, "lift.table_unit", unit, "lift")
        # rows are found anew, through a spline that may smooth nothing
        assert numpy.max(found[unit]["valve_lift"]) == pytest.approx(8.0e-3, rel=1e-9)
    for unit in LENGTHS:
        for name, values in found[unit].items():
            # tables of 16 digits in other units differ by their last digit
            numpy.testing.assert_allclose(values, found["m"][name], rtol=0, atol=1e-9 * numpy.max(numpy.abs(values)), err_msg=unit)


def test_pressure_tables_in_every_unit_are_the_same_pressure(camroller, tmp_path):
    largest, diameter = 2.0e5, 28.0e-3
    found = {}
    for unit, per_pascal in PRESSURES.items():
        table(tmp_path / "pressure.txt", per_pascal, largest)
        gas = "table = 'pressure.txt'\nvalve_diameter_mm = 28"
        deck = one_case(tmp_path / "deck.nml", "three_cam_head", gas_force=gas)
        found[unit] = run_table(camroller, tmp_path, deck, "gas_force.pressure_unit", unit, "gas")
    table(tmp_path / "pressure.txt", 0, largest)
    deck = one_case(tmp_path / "deck.nml", "three_cam_head", gas_force=gas)
    without = run_table(camroller, tmp_path, deck, "gas_force.pressure_unit", "bar", "none")
    # at full lift the gas presses against the valve with pressure times area, through a finger of nearly two to one
    force = largest * math.pi / 4 * diameter**2
    gain = numpy.max(found["Pa"]["contact_load"] - without["contact_load"])
    assert 1.2 * force < gain < 2.5 * force
    for unit in PRESSURES:
        for name, values in found[unit].items():
            numpy.testing.assert_allclose(values, found["Pa"][name], rtol=0, atol=1e-9 * numpy.max(numpy.abs(values)), err_msg=unit)
