"""Camshafts with several cams against followers run alone and statics worked out here.

Each lobe shape is run alone, without a camshaft. What a camshaft must give follows from these runs: torques of the followers by
shifting and adding, loads of the bearings by the geometry of `test/reference/mechanism.py` and the balance of forces and moments,
their friction by Sommerfeld's closed form, its mean by a uniform sum over the turn.
"""

import math
import pathlib
import re
import subprocess
import sys

import h5py
import numpy
import pytest
from scipy.optimize import brentq

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "test/reference"))
from mechanism import Geometry, PolynomialLift, closed_form  # noqa: E402

STEP = 1.0  # degrees between reported angles
SPEED, VISCOSITY = 100 * math.pi, 0.02  # rad/s, Pa s
JOURNAL = {"diameter": 23e-3, "width": 20e-3, "radial_clearance": 47.5e-6}
LIFTS = {1: (9.5e-3, 70.0), 2: (6.0e-3, 60.0)}  # largest lift [m], half angle [degrees]
# Torques of the same cycle at angles that differ by the rounding of a turn, where the steepest changes in some hundredths of a degree
ROUND_OFF = 1e-9
# The slope of the pitch curve is a central difference over 2e-5 rad
DIFFERENCE = 1e-7


def deck(path, rotation, lifts, bearings=""):
    """The valve train of `decks/thesis.nml` with other lobes and an oil of its own."""
    text = (ROOT / "decks/thesis.nml").read_text()
    for group in ("operating_point", "lift", "second_lift", "lubricant", "cam_bearings", "numerics", "sweep"):
        text = re.sub(rf"^&{group}\n.*?^/\n", "", text, flags=re.M | re.S)
    text = re.sub(r"^   rotation = .*\n", "", text, flags=re.M).replace("&mechanism\n", f"&mechanism\n   rotation = '{rotation}'\n")
    text += f"&operating_point\nspeed_rpm = {SPEED * 30 / math.pi!r}\noil_temperature_degC = 60\n/\n"
    text += f"&lubricant\ntemperature_law = 'direct'\nviscosity_Pa_s = {VISCOSITY}\npressure_viscosity_coefficient_per_GPa = 22\n/\n"
    for group, number in zip(("lift", "second_lift"), lifts):
        largest, half = LIFTS[number]
        text += (f"&{group}\nlaw = 'power'\nexponents = 4\nmax_lift_mm = {largest * 1000!r}\n"
                 f"opening_half_angle_deg = {half}\nclosing_half_angle_deg = {half}\n/\n")
    if bearings:
        text += (f"&cam_bearings\nlaw = 'long_full_sommerfeld'\ndiameter_mm = {JOURNAL['diameter'] * 1e3!r}\n"
                 f"width_mm = {JOURNAL['width'] * 1e3!r}\nradial_clearance_um = {JOURNAL['radial_clearance'] * 1e6!r}\n{bearings}\n/\n")
    # a tolerance given by hand: an accuracy may have both shapes integrated again where one of them misses it
    path.write_text(text + f"&numerics\ntolerance = 1e-5\n/\n&output\nangle_step_deg = {STEP}\n/\n")
    return path


def run(camroller, path):
    """Series and summary of the one case of a deck."""
    target = path.with_suffix(".h5")
    done = subprocess.run([camroller, "run", path, "-o", target, "--quiet"], capture_output=True, text=True, stdin=subprocess.DEVNULL,
                          timeout=300, check=False)
    assert done.returncode == 0, done.stderr
    with h5py.File(target) as file:
        found = {name: file[f"series/{name}"][...].ravel() for name in file["series"]}
        found["summary"] = {name: float(file[f"summary/{name}"][0]) for name in file["summary"]}
        keys = ("pivot_to_roller_mm", "pivot_to_pad_mm", "pivot_to_cam_mm", "roller_arm_angle_deg", "valve_axis_angle_deg",
                "base_radius_mm")
        found["mechanism"] = {key: float(file[f"deck/values/mechanism.{key}"][()]) for key in keys}
        found["roller_radius"] = float(file["deck/values/roller.radius_mm"][()]) / 1000
    return found


@pytest.fixture(scope="module", params=["away_from_pivot", "towards_pivot"])
def alone(request, camroller, tmp_path_factory):
    """Sense of rotation, and the follower of each lobe shape run alone."""
    folder = tmp_path_factory.mktemp(request.param)
    return request.param, {lobe: run(camroller, deck(folder / f"lobe_{lobe}.nml", request.param, [lobe])) for lobe in LIFTS}


def shifted(series, phase):
    """Series of a cam whose event follows by an angle [degrees]."""
    return numpy.roll(series, round(phase / STEP))


def cam_forces(rotation, lobe, follower):
    """Force on the cam at every angle, in a frame whose x axis runs from the pivot to the cam centre and whose y axis is a quarter
    turn from it the way the finger turns as it opens the valve; shape (angles, 2) [N].

    The centre of the roller draws the pitch curve on the cam; the load acts along its normal, the friction along its tangent.
    """
    values, degree = follower["mechanism"], math.pi / 180
    r_roller = follower["roller_radius"]
    sense = {"away_from_pivot": 1, "towards_pivot": -1}[rotation]
    largest, half = LIFTS[lobe]
    geometry = Geometry(A=values["pivot_to_roller_mm"] / 1e3, B=values["pivot_to_pad_mm"] / 1e3, D=values["pivot_to_cam_mm"] / 1e3,
                        lam=values["roller_arm_angle_deg"] * degree, chi=values["valve_axis_angle_deg"] * degree,
                        r_B=values["base_radius_mm"] / 1e3, r_R=r_roller, lift=PolynomialLift(largest, half * degree), sense=sense)

    def roller(theta):
        """Roller centre seen from the cam centre, as a complex number, where the cam stands still and the follower goes round it."""
        arm = closed_form(geometry, theta).gamma + geometry.lam
        return (geometry.A * complex(math.cos(arm), math.sin(arm)) - geometry.D) * complex(math.cos(theta), sense * math.sin(theta))

    forces = numpy.empty((follower["contact_load"].size, 2))
    for i, angle in enumerate(follower["cam_angle"]):
        theta = (angle - 180) * degree
        # turned back into the standing frame
        back = complex(math.cos(theta), -sense * math.sin(theta))
        along = (roller(theta + 1e-5) - roller(theta - 1e-5)) * back
        along /= abs(along)
        outwards = -1j * along * sense
        centre = roller(theta) * back
        assert (outwards * centre.conjugate()).real > 0
        load = follower["contact_load"][i]
        rolling = follower["friction_rolling"][i]
        # both rolling resistances and the couple that they make, taken up at the roller's centre
        radius = follower["equivalent_radius"][i]
        tangential = follower["traction"][i] + rolling * (2 * radius / r_roller - 1)
        # the cam's surface, which drives the roller, runs against the way of the roller around the cam
        force = -(load * outwards - tangential * along)
        forces[i] = force.real, force.imag
        # the cam's own equilibrium: moment about its centre, against its turning, is what the drive torque balances
        contact = centre - r_roller * outwards
        moment = sense * (contact.conjugate() * force).imag
        expected = follower["torque_drive"][i] - 2 * rolling * radius
        assert abs(moment - expected) < 1e-6 * numpy.max(numpy.abs(follower["torque_drive"])), angle
    return forces


def sommerfeld_torque(load):
    """Friction torque of a long bearing with a full film, Sommerfeld (1904), after Hamrock, Schmid and Jacobson (2004), chapter 11."""
    radius, clearance = JOURNAL["diameter"] / 2, JOURNAL["radial_clearance"]
    shear = VISCOSITY * SPEED * radius * JOURNAL["width"] * radius / clearance
    number = load * clearance / radius / shear
    e = brentq(lambda e: 12 * math.pi * e - number * (2 + e * e) * math.sqrt(1 - e * e), 0, 1 - 1e-15, xtol=1e-16, rtol=1e-14)
    return shear * 4 * math.pi * (1 + 2 * e * e) / ((2 + e * e) * math.sqrt(1 - e * e)) * radius


def bearing_torque(places, cams, forces):
    """Torque of all bearings; each span between two of them is a beam of its own, in balance of forces and moments."""
    loads = numpy.zeros((len(places), *forces[0].shape))
    for span in range(len(places) - 1):
        for place, force in zip(cams, forces):
            if places[span] < place < places[span + 1]:
                matrix = [[1, 1], [places[span], places[span + 1]]]
                shares = numpy.linalg.solve(matrix, [1, place])
                loads[span] += shares[0] * force
                loads[span + 1] += shares[1] * force
    return sum(numpy.array([sommerfeld_torque(size) for size in numpy.hypot(*load.T)]) for load in loads)


SHAFTS = {
    "one cam, nearer to the second bearing": dict(places=[0, 60], cams=[45], phases=[0], lobes=[1], angles=[0]),
    "one cam in the wider of two spans": dict(places=[0, 20, 80], cams=[35], phases=[0], lobes=[1], angles=[0]),
    "two shapes, the second later": dict(places=[0, 60], cams=[20, 45], phases=[0, 100], lobes=[1, 2], angles=[0, 0]),
    "two shapes, the second earlier": dict(places=[0, 60], cams=[20, 45], phases=[0, -50], lobes=[1, 2], angles=[0, 0]),
    "followers at two angles on one span": dict(places=[0, 60], cams=[20, 45], phases=[0, 40], lobes=[1, 1], angles=[0, 60]),
    "three cams on three spans": dict(places=[0, 30, 70, 120], cams=[12, 60, 85], phases=[0, 120, -75], lobes=[1, 2, 1],
                                      angles=[0, -35, 80]),
}


@pytest.fixture(scope="module", params=SHAFTS)
def shaft(request, alone, camroller, tmp_path_factory):
    """A camshaft as run, and as put together from the followers alone."""
    rotation, followers = alone
    data = SHAFTS[request.param]
    words = {"bearing_positions_mm": "places", "cam_positions_mm": "cams", "cam_phases_deg": "phases", "cam_lobes": "lobes",
             "follower_angles_deg": "angles"}
    bearings = "\n".join(f"{key} = {', '.join(map(str, data[word]))}" for key, word in words.items())
    path = deck(tmp_path_factory.mktemp("shaft") / "shaft.nml", rotation, sorted(set(data["lobes"])), bearings)
    return run(camroller, path), rotation, followers, data


def put_together(rotation, followers, data, sign=1):
    """Torque of the bearings from the followers alone; `sign` -1 has the followers stand on the other side."""
    forces = []
    for phase, lobe, angle in zip(data["phases"], data["lobes"], data["angles"]):
        turn = sign * math.radians(angle)
        turned = cam_forces(rotation, lobe, followers[lobe]) @ [[math.cos(turn), math.sin(turn)], [-math.sin(turn), math.cos(turn)]]
        forces.append(numpy.stack([shifted(turned[:, 0], phase), shifted(turned[:, 1], phase)], axis=1))
    return bearing_torque([place / 1e3 for place in data["places"]], [place / 1e3 for place in data["cams"]], forces)


def test_torques_of_the_followers_are_those_of_each_alone_shifted_and_added(shaft):
    found, _, followers, data = shaft
    for name in ("torque_geometric", "torque_contact", "torque_needle", "torque_guide", "torque_roller_inertia"):
        expected = sum(shifted(followers[lobe][name], phase) for phase, lobe in zip(data["phases"], data["lobes"]))
        numpy.testing.assert_allclose(found[name], expected, rtol=0, atol=ROUND_OFF * numpy.max(numpy.abs(expected)), err_msg=name)
        mean = sum(followers[lobe]["summary"][f"mean_{name}"] for lobe in data["lobes"])
        assert found["summary"][f"mean_{name}"] == pytest.approx(mean, rel=ROUND_OFF, abs=1e-15), name
    numpy.testing.assert_array_equal(found["contact_load"], followers[data["lobes"][0]]["contact_load"])


def test_bearing_forces_balance_the_forces_on_the_cams(shaft):
    found, rotation, followers, data = shaft
    expected = put_together(rotation, followers, data)
    numpy.testing.assert_allclose(found["torque_bearings"], expected, rtol=DIFFERENCE)


def test_mean_bearing_torque_equals_a_uniform_sum_over_the_turn(shaft):
    found, _, _, _ = shaft
    # kinks where a valve leaves its seat cost the sum a share of the square of its step
    assert found["summary"]["mean_torque_bearings"] == pytest.approx(numpy.mean(found["torque_bearings"]), rel=1e-5)


def test_side_of_the_followers_changes_the_bearing_torque(alone):
    rotation, followers = alone
    data = SHAFTS["followers at two angles on one span"]
    change = put_together(rotation, followers, data) - put_together(rotation, followers, data, sign=-1)
    assert numpy.max(numpy.abs(change)) > 1e-3 * numpy.mean(put_together(rotation, followers, data))


@pytest.mark.parametrize(("law", "width", "words"), [
    ("long_full_sommerfeld", 24, "knows the oil that leaves at the sides of bearings up to 1 diameter wide"),
    ("long_full_sommerfeld", 23, None), ("short_ocvirk", 24, None), ("finite", 24, "covers widths from 0.1 to 1 diameter"),
])
def test_heat_of_a_bearing_is_refused_where_its_side_flow_is_not_known(camroller, law, width, words):
    """One complaint and no more: the law of finite width has its own."""
    done = subprocess.run([camroller, "check", "decks/warm_bearings.nml", "--no-sweep", "--set", f"cam_bearings.law={law}", "--set",
                           f"cam_bearings.width_mm={width}"], capture_output=True, text=True, cwd=ROOT, check=False)
    if words is None:
        assert done.returncode == 0, done.stderr
    else:
        assert done.returncode == 3 and words in done.stderr and done.stderr.count("diameter") == 1, done.stderr


@pytest.mark.parametrize("key", ["cam_phases_deg", "follower_angles_deg"])
def test_angles_that_do_not_begin_with_the_first_cam_are_refused(camroller, key):
    """Nothing else says what they would count from; one of 35 degrees turned the shaft against the pull of its belt."""
    found = subprocess.run([camroller, "check", ROOT / "decks/three_cam_head.nml", "--set", f"cam_bearings.{key}=35, 120, 240"],
                           capture_output=True, text=True, stdin=subprocess.DEVNULL, timeout=60, check=False)
    assert found.returncode == 3
    assert f"'{key}' must begin with 0: its angles count from the first cam's" in found.stderr


def test_a_remark_names_bearing_and_camshaft_of_a_thin_film(camroller, tmp_path):
    values = ("lubricant.viscosity_at_40_degC_mm2_s=8", "lubricant.viscosity_at_100_degC_mm2_s=2", "cam_bearings.bearing_series=.true.",
              "operating_point.speed_rpm=600", "output.angle_step_deg=0.5")
    done = subprocess.run([camroller, "run", "decks/four_cylinder.nml", "--no-sweep", "-o", tmp_path / "a.h5",
                           *(word for value in values for word in ("--set", value))], capture_output=True, text=True, cwd=ROOT, check=True)
    found = re.search(r"the film of bearing (\d) of camshaft (\d) goes down to ([\d.]+) um, below 0.5 for ([\d.]+) % of the turn", done.stderr)
    assert found, done.stderr
    with h5py.File(tmp_path / "a.h5") as file:
        films = {name: file["series"][name][0] for name in file["series"] if name.endswith("film_min") and "bearing" in name}
    named = films[f"camshaft_{found[2]}_bearing_{found[1]}_film_min"]
    # bearings that stand alike have the same film but for rounding
    assert named.min() == pytest.approx(min(film.min() for film in films.values()), rel=1e-6)
    # two digits are printed
    assert float(found[3]) == pytest.approx(1e6 * named.min(), rel=0.06)
    assert float(found[4]) == pytest.approx(100 * (named < 0.5e-6).mean(), rel=0.06)


@pytest.mark.once
def test_a_cam_midway_between_two_bearings_loads_each_with_half_of_its_force(camroller, tmp_path):
    """The contact load is largest short of full lift, where the seal's friction reverses and no torque turns."""
    path = tmp_path / "midway.nml"
    left_out = "'sweep', 'lift', 'cam_bearings', 'asperity', 'needle_bearing', 'valve_guide'"
    path.write_text(f"""include = '{ROOT}/decks/thesis.nml', without = {left_out}
&operating_point
speed_rpm = 1500
oil_temperature_degC = 47
/
&roller
mass_kg = 0.01
/
&masses
valve_kg = 0.056
finger_kg = 0.035
/
&spring
stiffness_N_m = 30000
precompression_mm = 9.5
base_circle_load_N = 55
/
&lift
law = 'cycloidal'
max_lift_mm = 6.5
opening_half_angle_deg = 76
/
&cam_bearings
diameter_mm = 23
width_mm = 10
radial_clearance_um = 47.5
bearing_positions_mm = 0, 60
cam_positions_mm = 30
bearing_series = .true.
/
&stem_seal
lip_force_N = 5
viscous_drag_N_s_m = 5
reference_viscosity_Pa_s = 0.01
/
""")
    found = run(camroller, path)
    summary = found["summary"]
    # The cam's force has the contact load and, at right angles to it, the traction with the rolling resistance
    largest = math.hypot(summary["max_contact_load"], numpy.abs(found["friction_contact"]).max())
    for bearing in (1, 2):
        # Errors of extremes are 1e-4 of the accuracy here; without rows at the crest half of 3e-3 of the load was missing
        assert summary["max_contact_load"] * (1 - 1e-6) < 2 * summary[f"max_bearing_{bearing}_load"] < largest * (1 + 1e-6)


@pytest.mark.once
@pytest.mark.parametrize(("name", "speed", "temperature"), [
    ("four_cylinder", 2000, 120),  # largest friction of the second camshaft 0.02 degrees behind the end of an event
    ("four_cylinder", 6000, 120),  # least friction in a dip of 0.2 degrees in which no torque of a follower turns
    ("three_cam_head", 1200, 95),  # largest load of a bearing behind the end of an event
])
def test_extremes_of_a_camshaft_are_those_of_closely_spaced_series(camroller, tmp_path, name, speed, temperature):
    """To twice the error that the result states, which is relative to the range of a series."""
    path = tmp_path / "close.h5"
    done = subprocess.run([camroller, "run", ROOT / f"decks/{name}.nml", "-o", path, "--quiet", "--point", f"speed_rpm={speed}",
                           "--point", f"oil_temperature_degC={temperature}", "--set", "output.angle_step_deg=0.02", "--set",
                           "cam_bearings.bearing_series=.true."], capture_output=True, text=True, stdin=subprocess.DEVNULL,
                          timeout=300, check=False)
    assert done.returncode == 0, done.stderr
    compared = 0
    with h5py.File(path) as file:
        summary = file["summary"]
        allowed = 2 * summary["estimated_error_of_extremes"][0]
        for quantity in file["series"]:
            if f"min_{quantity}" not in summary or quantity == "energy_residual":
                continue
            values = file[f"series/{quantity}"][...]
            least, largest = (summary[f"{end}_{quantity}"][0] for end in ("min", "max"))
            beyond = max(least - values.min(), values.max() - largest)
            assert beyond <= allowed * (largest - least), quantity
            compared += 1
    assert compared > 20
