"""Keys that are used only under a choice: an idle key changes no bit of a result and has a remark, a used one changes it."""

import hashlib
import pathlib
import re
import subprocess

import h5py
import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]

# another value for each key of the table; none where a key has no other value to try
VALUES = {
    "lift.max_lift_mm": "9.4", "lift.opening_half_angle_deg": "71", "lift.closing_half_angle_deg": "72", "lift.exponents": "5",
    "lift.segment_angles_deg": "0, 20, 40, 70, 120, 140", "lift.segment_accelerations": "0, 1, 0.1, -0.5, 0.9, 0",
    "lift.table": "fine_lift.txt", "lift.table_kind": "roller_lift", "lift.table_unit": "um",
    "lift.table_nose_angle_deg": "181", "lift.smoothing_um": "5",
    "lubricant.viscosity_Pa_s": "0.02", "lubricant.temperature_points_degC": "25, 61, 95",
    "lubricant.viscosity_points_Pa_s": "0.15, 0.031, 0.01", "lubricant.viscosity_at_40_degC_mm2_s": "66",
    "lubricant.viscosity_at_100_degC_mm2_s": "11.5", "lubricant.viscosity_index": "150", "lubricant.sae_grade": "0W-20",
    "lubricant.density_kg_m3": "850", "lubricant.thermal_expansion_per_K": "0.0007", "lubricant.roelands_index": "0.7",
    "film.law": "moes", "asperity.roughness_product": "0.05", "asperity.roughness_over_tip_radius": "0.02",
    "asperity.mobilising_speed_m_s": "0.002", "asperity.boundary_coefficient": "0.21",
    "traction.eyring_stress_MPa": "6", "traction.limiting_stress_MPa": "3",
    "roller_profile.crown_radius_mm": "4000", "roller_profile.design_load_N": "900", "roller_profile.end_drop_um": "2",
    "boundary_law.reference_speed_m_s": "0.2", "boundary_law.reference_temperature_degC": "90",
    "boundary_law.change_per_decade": "0.02", "boundary_law.change_per_K": "-0.0003", "boundary_law.lowest_speed_m_s": "0.002",
    "boundary_law.speed_points_m_s": "0.01, 0.2", "boundary_law.temperature_points_degC": "20, 120",
    "boundary_law.coefficient_points": "0.11, 0.13, 0.1, 0.12",
    "needle_bearing.needle_radius_mm": "1.1", "needle_bearing.pin_law": "short_ocvirk", "needle_bearing.pin_width_mm": "8",
    "needle_bearing.pin_radial_clearance_um": "25", "needle_bearing.pin_roughness_um": "0.4",
    "needle_bearing.pin_modulus_GPa": "170", "needle_bearing.pin_roughness_product": "0.05",
    "needle_bearing.pin_roughness_over_tip_radius": "0.02",
    "needle_bearing.skf_rolling_factor": "2e-6", "needle_bearing.skf_sliding_factor": "0.002",
    "needle_bearing.skf_geometry_factor": "5", "needle_bearing.skf_replenishment_factor": "6e-8",
    "needle_bearing.skf_film_coefficient": "0.03",
    **{f"{group}.{key}": value for group in ("valve_tip", "guide_side_load", "finger_pivot") for key, value in
       (("decay_speed_m_s", "0.4"), ("viscous_part_s_m", "0.02"), ("reference_viscosity_Pa_s", "0.02"), ("reference_load_N", "200"))},
    "stem_seal.reference_viscosity_Pa_s": "0.02", "stem_seal.drag_follows": "viscosity",
    "bearing_heat.heat_capacity_J_kg_K": "1900", "cam_bearings.cam_cylinders": None,
    "gas_force.second_valve_diameter_mm": "20",
    "dynamics.seat_damping_s_m": "2", "dynamics.seat_restitution_speed_m_s": "0.4",
    "effects.negligible": "0.05", "effects.quantity": "minimum_film",
    "mechanism.adjuster_tilt_deg": "5", "masses.finger_centre_mm": "21", "spring.seat_stiffness_N_m": "2e6",
    "ehl.shear_thinning": ".false.", "ehl.flow_factors": ".true.", "heat.oil_heat_capacity_J_kg_K": "1900",
    "heat.limit_fall_per_K": "0.002", **{f"heat.{body}_{key}": value for body in ("cam", "roller") for key, value in
                                         (("conductivity_W_m_K", "40"), ("density_kg_m3", "7000"), ("heat_capacity_J_kg_K", "400"))},
    "numerics.step_deg": "0.05", "numerics.periodicity": "0.5", "sweep.series_cases": None,
    "sweep.seed": None, **{f"sweep.{key}_{number}": None for key in ("count", "scale") for number in range(1, 9)},
}

STRIBECK = """   law = 'stribeck' friction_coefficient = 0.1 decay_speed_m_s = 0.3 viscous_part_s_m = 0.01
   reference_viscosity_Pa_s = 0.01 reference_load_N = 300 /
"""
JOINTS = f"&valve_tip pad_radius_mm = 8{STRIBECK}&guide_side_load guide_length_mm = 36 tip_height_mm = 25 stem_axis_mm = 34" \
         f"{STRIBECK}&finger_pivot ball_radius_mm = 5{STRIBECK}" \
         "&stem_seal lip_force_N = 8 viscous_drag_N_s_m = 5 reference_viscosity_Pa_s = 0.01 /\n"
# keys of the table that are used, by what makes them so
SUMMITS = "asperity.roughness_product asperity.roughness_over_tip_radius"
BOUNDARY = f"film.law {SUMMITS} asperity.mobilising_speed_m_s"
POWER = "lift.max_lift_mm lift.opening_half_angle_deg lift.exponents"
POINTS = "lubricant.temperature_points_degC lubricant.viscosity_points_Pa_s"
SHEET = "lubricant.viscosity_at_100_degC_mm2_s lubricant.density_kg_m3 lubricant.thermal_expansion_per_K"
NEEDLES = "needle_bearing.needle_radius_mm"
SKF = " ".join(key for key in VALUES if key.startswith("needle_bearing.skf"))
PINS = " ".join(key for key in VALUES if key.startswith("needle_bearing.pin"))
GAS = "&gas_force table = 'cylinder_pressure.txt' valve_diameter_mm = 28 /\n"
CURVES = " ".join(key for key in VALUES if re.match("valve_tip|guide_side_load|finger_pivot", key))
TABLE = " ".join(key for key in VALUES if re.match(r"lift\.(table|smoothing)", key))
LOGARITHM = " ".join(key for key in VALUES if re.match("boundary_law.*(reference|change|lowest)", key))
SPEEDS = " ".join(key for key in VALUES if re.match("boundary_law.*points", key))

COEFFICIENT = " asperity.boundary_coefficient"
# The scene with a table in its place
TABULATED = "logarithmic roller, table of boundary friction, Euler"
# The scene in which the moment of inertia of the finger is known and its mass is not
MASSLESS, TILT = "finger without a mass", " mechanism.adjuster_tilt_deg masses.finger_centre_mm"
# That with the larger one of both forces on the closed valve, which has no seat
JUMP, SEAT = "needles by SKF's model", " spring.seat_stiffness_N_m"
HEAT = " ".join(key for key in VALUES if key.startswith("heat.") and "oil" not in key)
# What profiles of a warm film depend on; a run without them does not depend on these with `contact = 'none'`
WARM, PROFILED = "profiles of a warm film", f"film.law lubricant.density_kg_m3 lubricant.thermal_expansion_per_K {HEAT} " \
    "heat.oil_heat_capacity_J_kg_K ehl.shear_thinning ehl.flow_factors"

# name: values beside decks/thesis.nml, further groups, keys of the table that are used
SCENES = {
    "points of viscosity, power law, needles": (["asperity.film_shear_strength_MPa=1"], "", [BOUNDARY, POWER, POINTS, NEEDLES]),
    "data sheet, two half angles, Eyring": (
        ["operating_point.speed_rpm=2500", "lift.law=polynomial_345", "lubricant.temperature_law=data_sheet",
         "lubricant.viscosity_at_40_degC_mm2_s=64", "lubricant.viscosity_at_100_degC_mm2_s=11", "lubricant.pressure_law=roelands",
         "lubricant.roelands_index=0.6", "traction.shear_law=eyring", "traction.eyring_stress_MPa=5",
         "asperity.mobilisation=stick_slip"], "",
        ["film.law", SUMMITS, "lift.max_lift_mm lift.opening_half_angle_deg lift.closing_half_angle_deg", SHEET,
         "lubricant.viscosity_at_40_degC_mm2_s lubricant.roelands_index traction.eyring_stress_MPa", NEEDLES]),
    "grade, segments, constant joints, regression of the asperities": (
        ["lift.law=segments", "lift.segment_angles_deg=0, 20, 40, 80, 120, 140", "lift.segment_accelerations=0, 1, 0, -0.5, 1, 0",
         "film.law=masjedi_khonsari_rough", "asperity.law=masjedi_khonsari", "materials.hardness_GPa=7",
         "lubricant.temperature_law=data_sheet", "lubricant.sae_grade=5W-30"],
        JOINTS.replace("stribeck", "constant").replace("drag_N_s_m = 5", "drag_N_s_m = 5 drag_follows = 'constant'"),
        ["film.law asperity.mobilising_speed_m_s lift.max_lift_mm lift.segment_angles_deg lift.segment_accelerations",
         "lubricant.sae_grade stem_seal.drag_follows", SHEET.split(maxsplit=1)[1], NEEDLES]),
    "lift table, viscosity index, Stribeck": (
        ["lift.law=table", "lift.table=coarse_lift.txt", "lubricant.temperature_law=data_sheet",
         "lubricant.viscosity_at_100_degC_mm2_s=11", "lubricant.viscosity_index=160"], JOINTS,
        [BOUNDARY, TABLE, SHEET, "lubricant.viscosity_index stem_seal.drag_follows stem_seal.reference_viscosity_Pa_s",
         CURVES, NEEDLES]),
    "direct viscosity, local limit, pin, crown, logarithmic boundary law, choice of effects": (
        ["lubricant.temperature_law=direct", "lubricant.viscosity_Pa_s=0.03", "traction.limit=local",
         "traction.limiting_stress_MPa=2", "needle_bearing.kind=journal", "needle_bearing.friction_coefficient=0.1",
         "needle_bearing.pin_width_mm=9", "needle_bearing.pin_radial_clearance_um=20", "needle_bearing.pin_roughness_um=0.3",
         "needle_bearing.pin_modulus_GPa=180", "effects.select=needed", "effects.negligible=1e-6"],
        "&heat contact = 'mean' viscosity_fall_per_K = 0.03 /\n&roller_profile profile = 'crowned' crown_radius_mm = 3000 /\n"
        "&boundary_law reference_speed_m_s = 0.1 reference_temperature_degC = 100 change_per_decade = 0.01 change_per_K = -0.0002\n"
        "lowest_speed_m_s = 0.001 /\n",
        [BOUNDARY, POWER, HEAT, "lubricant.viscosity_Pa_s traction.limiting_stress_MPa roller_profile.crown_radius_mm", PINS, LOGARITHM,
         "effects.negligible effects.quantity"]),
    TABULATED: (
        ["operating_point.speed_rpm=2000", "numerics.method=euler", "numerics.tolerance=1e-4", "numerics.periodicity=1e-9"],
        "&roller_profile profile = 'logarithmic' design_load_N = 800 /\n&heat /\n"
        "&boundary_law law = 'table' speed_points_m_s = 0.01, 0.1 temperature_points_degC = 20, 100\n"
        "coefficient_points = 0.11, 0.12, 0.1, 0.11 /\n",
        [BOUNDARY, POWER, POINTS, NEEDLES, SPEEDS, HEAT, "roller_profile.design_load_N roller_profile.end_drop_um",
         "numerics.step_deg numerics.periodicity"]),
    JUMP: (
        ["case.energy=source", "spring.seating=maximum", "needle_bearing.kind=needles_skf", "needle_bearing.friction_coefficient=0.12", "needle_bearing.skf_rolling_factor=2.13e-6",
         "needle_bearing.skf_sliding_factor=0.0015", "needle_bearing.skf_geometry_factor=6.2"], "&heat contact = 'none' /\n&bearing_heat /\n",
        [BOUNDARY, POWER, POINTS, NEEDLES, SKF, "lubricant.density_kg_m3 lubricant.thermal_expansion_per_K",
         "bearing_heat.heat_capacity_J_kg_K"]),
    "gas on the valves of two lobe shapes": (
        ["cam_bearings.cam_lobes=1, 2", "cam_bearings.cam_positions_mm=20, 40", "cam_bearings.cam_phases_deg=0, 100"],
        GAS + "&second_lift max_lift_mm = 9 opening_half_angle_deg = 70 exponents = 4 /\n",
        [BOUNDARY, POWER, POINTS, NEEDLES, "gas_force.second_valve_diameter_mm"]),
    "seat with a damping": ([], GAS + "&dynamics /\n", [BOUNDARY, POWER, POINTS, NEEDLES, "dynamics.seat_damping_s_m"]),
    "seat with a restitution": (
        [], "&dynamics seat_restitution = 0.4 /\n", [BOUNDARY, POWER, POINTS, NEEDLES, "dynamics.seat_restitution_speed_m_s"]),
    MASSLESS: ([], "", [BOUNDARY, POWER, POINTS, NEEDLES]),
    "numerical film": ([], "&ehl accuracy = 0.1 /\n", [BOUNDARY.removeprefix("film.law "), POWER, POINTS, NEEDLES]),
    "numerical film with heat": (
        [], "&ehl accuracy = 0.1 /\n&heat contact = 'none' /\n", [BOUNDARY.removeprefix("film.law "), POWER, POINTS, NEEDLES]),
    "profiles of an isothermal film": (
        ["output.angle_step_deg=20", "traction.shear_law=eyring", "traction.eyring_stress_MPa=5"],
        "&ehl accuracy = 0.1 profiles = .true. /\n",
        [BOUNDARY, POWER, POINTS, NEEDLES, "ehl.shear_thinning ehl.flow_factors traction.eyring_stress_MPa"]),
    WARM: (
        ["output.angle_step_deg=20", "traction.shear_law=eyring", "traction.eyring_stress_MPa=5"],
        "&ehl accuracy = 0.1 profiles = .true. /\n&heat contact = 'none' /\n",
        [BOUNDARY, POWER, POINTS, NEEDLES, PROFILED, "traction.eyring_stress_MPa"]),
}


def used_in(*scenes):
    """Keys of the table that are used in scenes."""
    return {key for scene in scenes for keys in [*SCENES[scene][2], TILT * (scene != MASSLESS), SEAT * (scene != JUMP),
                                           COEFFICIENT * (scene != TABULATED)] for key in keys.split()}


def run(camroller, deck, command, *values):
    """What a command prints on standard error, with other values."""
    words = [word for value in values for word in ("--set", value)]
    where = ["--output", str(deck.with_suffix(".h5")), "--quiet"] if command == "run" else []
    done = subprocess.run([camroller, command, str(deck), "--no-sweep", *where, *words], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stderr


def numbers_of(camroller, deck, *values):
    """A sum over every number of a result."""
    run(camroller, deck, "run", *values)
    total = hashlib.sha256()

    def add(name, item):
        if isinstance(item, h5py.Dataset) and item.dtype.kind in "fi" and not name.startswith("deck"):
            total.update(name.encode() + item[()].tobytes())

    with h5py.File(deck.with_suffix(".h5")) as file:
        file.visititems(add)
    return total.hexdigest()


def test_every_row_of_the_table_is_tried(camroller):
    page = subprocess.run([camroller, "defaults", "--markdown"], capture_output=True, text=True, check=True).stdout
    found, group = set(), None
    for line in page.splitlines():
        if heading := re.match(r"## &(\w+)", line):
            group = heading[1]
        elif (row := re.match(r"\| `(\w+)`", line)) and re.search("; used with", line) and group != "second_lift":
            found.add(f"{group}.{row[1]}")
    assert found == set(VALUES)
    assert used_in(*SCENES) == {key for key, value in VALUES.items() if value}


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.once
def test_an_idle_key_changes_nothing_and_a_used_one_does(camroller, tmp_path, scene):
    values, groups, _ = SCENES[scene]
    used = used_in(scene)
    deck = tmp_path / "deck.nml"
    text = (ROOT / "decks/thesis.nml").read_text() + groups
    if scene == MASSLESS:
        text = re.sub(r"finger_kg = \S+", "finger_inertia_kg_m2 = 5.3e-5", text)
    if "lubricant.roelands_index" in used:
        text = text.replace("pressure_viscosity_coefficient_per_GPa = 22", "")
    for table in (ROOT / "decks/hard/tables").glob("*_lift.txt"):
        (tmp_path / table.name).write_bytes(table.read_bytes())
    (tmp_path / "cylinder_pressure.txt").write_bytes((ROOT / "decks/tables/cylinder_pressure.txt").read_bytes())
    deck.write_text(text)
    present = re.findall(r"^&(\w+)", text, re.M) + ["effects", "numerics"]
    accuracy = [] if "numerics.method=euler" in values else ["numerics.accuracy=1e-2"]
    values = ["operating_point.oil_temperature_degC=50", "output.angle_step_deg=5", *accuracy, *values]
    # a mistake, not an idle key: two half angles of the power law, and what takes the place of another number of a data sheet
    refused = "lift.closing_half_angle_deg " + "lubricant.viscosity_index lubricant.sae_grade lubricant.viscosity_at_40_degC_mm2_s " \
        "lubricant.viscosity_at_100_degC_mm2_s" * ("lubricant.temperature_law=data_sheet" in values)
    idle = [f"{key}={value}" for key, value in VALUES.items() if value and key.split(".")[0] in present
            and key not in used and key not in refused.split() and not any(given.startswith(f"{key}=") for given in values)]
    base = numbers_of(camroller, deck, *values)
    assert numbers_of(camroller, deck, *values, *idle) == base
    remarks = run(camroller, deck, "check", *values, *idle)
    for key in (word.split("=")[0] for word in idle):
        assert re.search(rf"remark: {key} = .* has no effect( in a run)?: it is used with", remarks), key
    for key in sorted(used - used_in(*list(SCENES)[:list(SCENES).index(scene)]) | set(PROFILED.split() * (scene == WARM))):
        assert numbers_of(camroller, deck, *values, f"{key}={VALUES[key]}") != base, key
    profiled = [key for key in PROFILED.split() if key in used and not any(given.startswith(f"{key}=") for given in values)]
    remarks = run(camroller, deck, "check", *values, *[f"{key}={VALUES[key]}" for key in profiled])
    assert not [key for key in profiled if re.search(rf"remark: {key} = .* has no effect", remarks)]


def test_a_default_of_an_idle_key_needs_no_remark(camroller):
    def remarks(value):
        return run(camroller, ROOT / "decks/thesis.nml", "check", value)
    assert "no effect" not in remarks("numerics.step_deg=1.0") and "numerics.step_deg = 2 has no effect" in remarks("numerics.step_deg=2")


def test_keys_that_act_through_a_number_have_no_effect_where_it_is_zero(camroller, tmp_path):
    text = (ROOT / "decks/thesis.nml").read_text()
    deck = tmp_path / "deck.nml"
    deck.write_text(text + "&stem_seal lip_force_N = 8 drag_follows = 'constant' reference_viscosity_Pa_s = 0.01 /\n&bearing_heat /\n")

    def remarks(*values):
        return re.findall(r"(\S+ = \S+ has no effect.*)", run(camroller, deck, "check", *values))
    drag = "stem_seal.drag_follows = 'constant' has no effect: it is used with viscous_drag_N_s_m > 0"
    viscosity = "stem_seal.reference_viscosity_Pa_s = 0.01 has no effect: it is used with drag_follows = 'viscosity'; drag_follows "
    capacity = "bearing_heat.heat_capacity_J_kg_K = 1900 has no effect: it is used with oil_share > 0"
    assert remarks() == [drag, viscosity + "is 'constant'"]
    assert remarks("stem_seal.drag_follows=viscosity") == [viscosity + "has no effect itself"]
    assert remarks("stem_seal.drag_follows=viscosity", "stem_seal.viscous_drag_N_s_m=2") == []
    assert remarks("stem_seal.viscous_drag_N_s_m=2") == [viscosity + "is 'constant'"]
    assert capacity not in remarks("bearing_heat.heat_capacity_J_kg_K=1900")
    idle = remarks("bearing_heat.heat_capacity_J_kg_K=1900", "bearing_heat.oil_share=0", "lubricant.density_kg_m3=860")
    assert capacity in idle and any(line.startswith("lubricant.density_kg_m3 = 860 has no effect") for line in idle)


@pytest.mark.parametrize(("sweep", "words"), [
    ("kind = 'sobol' cases = 4 key_1 = 'operating_point.speed_rpm' from_1 = 300 to_1 = 900 count_1 = 5",
     "sweep.count_1 = 5 has no effect: it is used with kind = 'grid' or 'zip'; kind is 'sobol'"),
    ("key_1 = 'film.law' values_1 = 'moes' key_2 = 'operating_point.speed_rpm' values_2 = 300, 900 scale_2 = 'logarithmic'",
     "sweep.scale_2 = 'logarithmic' has no effect: it is used with from_2"),
    ("key_1 = 'operating_point.speed_rpm' values_1 = 300, 900 seed = 7",
     "sweep.seed = 7 has no effect: it is used with kind = 'latin_hypercube', 'sobol' or 'random'; kind is 'grid'"),
    ("kind = 'random' seed = 7 cases = 4 key_3 = 'operating_point.speed_rpm' from_3 = 300 to_3 = 900 scale_3 = 'logarithmic'", None),
    ("key_8 = 'operating_point.speed_rpm' from_8 = 300 to_8 = 900 count_8 = 3 scale_8 = 'logarithmic'", None),
])
def test_a_key_of_a_sweep_without_effect_has_a_remark(camroller, tmp_path, sweep, words):
    text = (ROOT / "decks/thesis.nml").read_text()
    (tmp_path / "deck.nml").write_text(f"{text[:text.index('&sweep')]}&sweep {sweep} /\n")
    done = subprocess.run([camroller, "check", "deck.nml"], cwd=tmp_path, capture_output=True, text=True, check=True)
    assert [line for line in done.stderr.splitlines() if "no effect" in line] == ([f"remark: {words}"] if words else [])


@pytest.mark.parametrize(("values", "message"), [
    (["sweep.key_1=needle_bearing.pin_width_mm", "sweep.values_1=8,9"],
     "'needle_bearing.pin_width_mm' has no effect: it is used with kind = 'journal'; kind is 'needles'"),
    (["sweep.key_1=lift.smoothing_um", "sweep.values_1=0,5"], "it is used with law = 'table'; law is 'power'"),
    (["sweep.key_1=lubricant.density_kg_m3", "sweep.values_1=850,870"], "it is used with temperature_law = 'walther' or 'data_sheet', or"),
    (["sweep.key_1=asperity.boundary_coefficient", "sweep.values_1=0.1,0.2"], None),
    # 'camroller ehl' takes the same deck
    (["sweep.key_1=ehl.flow_factors", "sweep.values_1=.true.,.false."], None),
    # where the choice varies too, some cases may use the key
    (["sweep.key_1=traction.eyring_stress_MPa", "sweep.values_1=4,5", "sweep.key_2=traction.shear_law",
      "sweep.values_2='newtonian','eyring'", "traction.eyring_stress_MPa=5"], None),
])
def test_a_sweep_of_a_key_that_no_case_uses_is_refused(camroller, values, message):
    words = [word for value in values for word in ("--set", value)]
    deck = ROOT / ("decks/numerical_film.nml" if "ehl" in values[0] else "decks/thesis.nml")
    done = subprocess.run([camroller, "check", str(deck), *words], capture_output=True, text=True, check=False)
    if message:
        assert done.returncode == 3 and message in done.stderr and done.stderr.count("no effect") == 1
    else:
        assert done.returncode == 0 and "no effect" not in done.stderr


def test_a_table_of_boundary_friction_takes_the_place_of_the_coefficient(camroller, tmp_path):
    """The coefficient is not needed then, and changes no number: not with a tribofilm, whose scale of errors is what it changes, nor in
    the runs without the law, which have the mean of the table within its bounds."""
    table = "&boundary_law law = 'table' speed_points_m_s = 0.01, 0.1 temperature_points_degC = 20, 100\n" \
        "coefficient_points = 0.11, 0.12, 0.1, 0.4 largest_coefficient = 0.15 /\n"
    text = (ROOT / "decks/tribofilm.nml").read_text().partition("&sweep")[0]
    bare = re.sub(r"boundary_coefficient = \S+", "", text)
    given, deck = tmp_path / "given.nml", tmp_path / "deck.nml"
    given.write_text(text + table)
    deck.write_text(bare + table)
    coarse = ["output.angle_step_deg=10", "running_in.places=36", "running_in.accuracy=0.01"]
    assert numbers_of(camroller, deck, *coarse) == numbers_of(camroller, given, *coarse)
    assert "boundary_coefficient" not in run(camroller, deck, "check")
    told = "remark: asperity.boundary_coefficient = 0.2 has no effect: it is used without &boundary_law, or with boundary_law.law = " \
        "'logarithmic'; boundary_law.law is 'table'"
    assert told in run(camroller, given, "check").splitlines()
    swept = ["--set", "boundary_law.law=table"]
    given.write_text(text + table + "&sweep key_1 = 'asperity.boundary_coefficient' values_1 = 0.1, 0.2 /\n")
    refused = subprocess.run([camroller, "check", str(given), *swept], capture_output=True, text=True, check=False)
    assert refused.returncode == 3 and "'asperity.boundary_coefficient' has no effect: it is used without &boundary_law" in refused.stderr
    given.write_text(text + table + "&sweep key_1 = 'asperity.boundary_coefficient' values_1 = 0.1, 0.2 key_2 = 'boundary_law.law' "
                     "values_2 = 'table' /\n")
    assert subprocess.run([camroller, "check", str(given)], capture_output=True, check=False).returncode == 0
    deck.write_text(bare)
    refused = subprocess.run([camroller, "check", str(deck)], capture_output=True, text=True, check=False)
    assert refused.returncode == 3
    assert "friction of asperities without boundary law 'table' needs 'boundary_coefficient' in &asperity" in refused.stderr
