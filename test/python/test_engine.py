"""The engine: cams by cylinder, phases from the firing order, results of followers, camshafts and engine that agree."""

import re

import h5py
import numpy as np
import pytest

from conftest import ROOT, done, run

DECK = ROOT / "decks/four_cylinder.nml"
# means are integrated to the accuracy asked for, 1e-4; these relations hold between numbers of one integration
ROUND_OFF = 1e-10


@pytest.fixture(scope="module", name="result")
def one_point(camroller, tmp_path_factory):
    """Engine at 2000 rev/min of the crankshaft and 90 degC."""
    path = tmp_path_factory.mktemp("engine") / "engine.h5"
    done(camroller, "run", DECK, "-o", path, "--quiet", "--set", "sweep.values_1=2000", "--set", "sweep.values_2=90")
    with h5py.File(path) as file:
        yield {
            "series": {name: data[0] for name, data in file["series"].items() if data.ndim == 2},
            "summary": {name: data[0] for name, data in file["summary"].items() if data.ndim == 1 and data.dtype.kind == "f"},
            "scope": {name: data.attrs["scope"] for name, data in file["series"].items() if "scope" in data.attrs},
            "summary_scope": {name: data.attrs["scope"] for name, data in file["summary"].items() if "scope" in data.attrs},
        }


def test_camshafts_add_up_to_the_engine(result):
    series, summary = result["series"], result["summary"]
    for kind in ("drive", "friction"):
        parts = series[f"camshaft_1_torque_{kind}"] + series[f"camshaft_2_torque_{kind}"]
        assert parts == pytest.approx(series[f"torque_{kind}"], abs=ROUND_OFF * np.abs(series[f"torque_{kind}"]).max())
        parts = summary[f"mean_camshaft_1_torque_{kind}"] + summary[f"mean_camshaft_2_torque_{kind}"]
        assert parts == pytest.approx(summary[f"mean_torque_{kind}"], rel=ROUND_OFF)


def test_a_camshaft_bears_its_own_cams_alone(camroller, tmp_path):
    """Another lift of the exhaust valves changes nothing on the intake camshaft, not in a bit, and each bearing of the other one."""
    series = []
    for lift in (8.6, 7.6):
        path = tmp_path / f"{lift}.h5"
        done(camroller, "run", DECK, "-o", path, "--quiet", "--no-sweep", "--set", f"second_lift.max_lift_mm={lift}",
             "--set", "cam_bearings.bearing_series=.true.", "--set", "output.angle_step_deg=10", "--set", "numerics.accuracy=1e-3")
        with h5py.File(path) as file:
            series.append({name: data[0] for name, data in file["series"].items() if name.startswith("camshaft_")})
    for name, before in series[0].items():
        same = np.array_equal(before, series[1][name])
        assert same == name.startswith("camshaft_1"), name
    assert sum("bearing_" in name for name in series[0]) >= 2 * 5 * 4


def test_fmep_is_work_over_displacement(result):
    summary = result["summary"]
    parts = [summary[f"fmep_{source}"] for source in ("contact", "needle", "guide", "bearings")]
    assert sum(parts) == pytest.approx(summary["fmep_friction"], rel=ROUND_OFF)
    assert summary["fmep_friction"] == pytest.approx(summary["work_friction"] / 1998e-6, rel=ROUND_OFF)
    # of the order of a hundredth of a bar: a slip of units would be far outside
    assert 3e2 < summary["fmep_friction"] < 3e4


def test_speed_is_that_of_the_crankshaft(result):
    # power over mean torque is the speed of the camshaft, half of 2000 rev/min
    summary = result["summary"]
    assert summary["power_friction"] / summary["mean_torque_friction"] == pytest.approx(1000 * 2 * np.pi / 60, rel=ROUND_OFF)
    assert summary["crank_turns"] == 2


def test_torque_repeats_with_every_firing(result):
    # cams of four cylinders are a quarter turn apart, so that geometric torque has harmonics of order 4 only
    torque = result["series"]["torque_drive"]
    assert torque == pytest.approx(np.roll(torque, len(torque) // 4), abs=1e-3 * np.abs(torque).max())
    amplitudes = [result["summary"][f"torque_drive_harmonic_{order}"] for order in range(1, 13)]
    assert max(amplitudes) == amplitudes[3]
    spectrum = 2 / len(torque) * np.abs(np.fft.rfft(torque))
    assert amplitudes == pytest.approx(spectrum[1:13], abs=ROUND_OFF * spectrum.max())


def test_scopes_distinguish_follower_camshaft_and_engine(result):
    scope = {name: value if isinstance(value, str) else value.decode() for name, value in result["scope"].items()}
    assert scope["contact_load"] == "lobe 1" and scope["lobe_2_contact_load"] == "lobe 2"
    assert scope["camshaft_2_torque_drive"] == "camshaft 2" and scope["torque_drive"] == "engine"
    for name in ("fmep_friction", "power_friction", "work_contact", "relative_energy_residual"):
        assert result["summary_scope"][name] in ("engine", b"engine")


def test_firing_order_gives_the_phases(camroller, tmp_path):
    """An engine of one camshaft is the same cams with their phases written down."""
    text = DECK.read_text(encoding="utf-8").replace("shared/", f"{ROOT}/decks/shared/")
    text = text[:text.index("&sweep")]
    one = text.replace("camshafts = 2", "camshafts = 1").replace("cam_cylinders", "cam_lobes = 1, 2, 1, 2, 1, 2, 1, 2\n   cam_cylinders")
    engine = tmp_path / "engine.nml"
    engine.write_text(one, encoding="utf-8")
    # firing order 1 3 4 2: cylinders 1 to 4 fire at 0, 540, 180, 360 degrees; half of it, and 110 less for the exhaust
    phases = [(half + shift) % 360 for half in (0, 270, 90, 180) for shift in (0, -110)]
    plain = one[:one.index("&engine")] + one[one.index("! Intake."):]
    plain = plain.replace("speed_rpm = 2000", "speed_rpm = 1000")
    plain = plain.replace("cam_cylinders = 1, 1, 2, 2, 3, 3, 4, 4", "cam_phases_deg = " + ", ".join(map(str, phases)))
    other = tmp_path / "plain.nml"
    other.write_text(plain, encoding="utf-8")
    values = []
    for deck in (engine, other):
        done(camroller, "run", deck, "-o", tmp_path / "a.h5", "--quiet")
        with h5py.File(tmp_path / "a.h5") as file:
            values.append({name: file["series"][name][0] for name in ("torque_drive", "torque_bearings", "torque_friction")})
    for name, value in values[0].items():
        # phases in radians differ by round-off
        assert value == pytest.approx(values[1][name], rel=1e-9, abs=1e-9 * np.abs(value).max()), name


@pytest.mark.parametrize(("old", "new", "words"), [
    ("firing_order = 1, 3, 4, 2", "firing_order = 1, 3, 4, 4", "must name every cylinder once"),
    ("firing_order = 1, 3, 4, 2", "firing_order = 1, 3, 4, 2 strokes = 3", "'strokes' is 2 or 4"),
    ("firing_order = 1, 3, 4, 2", "firing_order = 1, 3, 2", "3 entries for 4 cylinders"),
    ("full_lift_deg = 470, 250", "full_lift_deg = 470", "1 entries for 2 lobe shapes"),
    ("cam_cylinders = 1, 1, 2, 2, 3, 3, 4, 4", "cam_cylinders = 1, 1, 2, 2, 3, 3, 4", "7 entries for 8 cams"),
    ("cam_cylinders = 1, 1, 2, 2, 3, 3, 4, 4", "cam_cylinders = 1, 1, 2, 2, 3, 3, 4, 5", "the engine has 4 cylinders"),
    ("cam_cylinders = 1, 1, 2, 2, 3, 3, 4, 4", "cam_phases_deg = 0, 0, 0, 0, 0, 0, 0, 0", "follows from the firing order"),
    ("cam_cylinders = 1, 1, 2, 2, 3, 3, 4, 4", "cam_cylinders = 1, 1, 2, 2, 3, 3, 4, 4 cam_lobes = 1, 1, 1, 1, 1, 1, 1, 1",
     "with two camshafts each has one lobe shape"),
])
def test_contradicting_keys_are_refused(camroller, tmp_path, old, new, words):
    text = DECK.read_text(encoding="utf-8").replace("shared/", f"{ROOT}/decks/shared/")
    assert old in text
    deck = tmp_path / "deck.nml"
    deck.write_text(text.replace(old, new), encoding="utf-8")
    result = run(camroller, "check", deck)
    assert result.returncode == 3 and words in result.stderr, result.stderr


def test_remarks_and_facts_state_crankshaft_speeds(camroller, tmp_path):
    """Contact is lost above half the number of turns of the crankshaft: the words say whose turns they are."""
    path = tmp_path / "fast.h5"
    words = done(camroller, "run", DECK, "-o", path, "--set", "sweep.values_1=9000", "--set", "sweep.values_2=90").stderr
    lost = dict(re.findall(r"lobe (\d): contact is lost .* at 9000 rev/min of the crankshaft, .* lost above (\d+) rev/min of the crankshaft",
                           words))
    with h5py.File(path) as file:
        speeds = [file["summary"][name][0] for name in ("contact_loss_speed", "lobe_2_contact_loss_speed")]
    # four digits are shown, by which the lobes are told apart
    assert [float(lost[lobe]) for lobe in ("1", "2")] == pytest.approx([2 * speed * 30 / np.pi for speed in speeds], rel=2e-4)
    assert abs(speeds[0] - speeds[1]) > 1e-2 * speeds[0]
    facts = done(camroller, "check", DECK, "--no-sweep").stdout
    assert "cam speed 1000 rev/min (2000 rev/min of the crankshaft)" in facts
    assert "rev/min of the camshaft" not in facts


@pytest.mark.parametrize("rotation", ["away_from_pivot", "towards_pivot"])
def test_gas_presses_the_valves_of_a_cylinder_at_the_same_crank_angle(camroller, tmp_path, rotation):
    """The torque of an engine against the gas is pressure times area times slope of the lift of each valve, whatever its lobe shape."""
    full_lift, diameter = (470, 250), (30e-3, 26e-3)
    firing = (0, 540, 180, 360)  # of cylinders 1 to 4, by the order 1 3 4 2

    def pressure(crank_angle):
        return 3e5 * np.exp(2 * np.cos(np.radians(crank_angle - 150) / 2) - 2)

    rows = np.arange(0, 361)
    np.savetxt(tmp_path / "pressure.txt", np.c_[rows, pressure(full_lift[0] + 2 * (rows - 180))], fmt="%d %.12e")
    text = DECK.read_text(encoding="utf-8").replace("shared/", f"{ROOT}/decks/shared/")
    text = text[:text.index("&sweep")] + ("&gas_force table = 'pressure.txt' pressure_unit = 'Pa' valve_diameter_mm = 30 "
                                          "second_valve_diameter_mm = 26 /\n")
    series = []
    for scale in (1, 1e-6):
        (tmp_path / "deck.nml").write_text(text, encoding="utf-8")
        done(camroller, "run", tmp_path / "deck.nml", "-o", tmp_path / "r.h5", "--quiet", "--set", f"mechanism.rotation={rotation}",
             "--set", "spring.seat_stiffness_N_m=1e9", "--set", f"gas_force.valve_diameter_mm={30 * scale}",
             "--set", f"gas_force.second_valve_diameter_mm={26 * scale}")
        with h5py.File(tmp_path / "r.h5") as file:
            series.append({name: file["series"][name][...].ravel() for name in ("torque_geometric", "valve_lift", "lobe_2_valve_lift")})
    found = series[0]["torque_geometric"] - series[1]["torque_geometric"]
    cam_angle = np.arange(720) / 2
    crank_angle = full_lift[0] + 2 * (cam_angle - 180)  # from the firing of cylinder 1, whose intake cam is the first one
    expected = np.zeros(720)
    for lobe, name in enumerate(("valve_lift", "lobe_2_valve_lift")):
        ahead = [np.roll(series[0][name], -k) - np.roll(series[0][name], k) for k in (1, 2)]
        slope = (8 * ahead[0] - ahead[1]) / (12 * np.radians(0.5))
        for start in firing:
            own = crank_angle - start
            place = np.rint(((own - full_lift[lobe]) / 2 + 180) * 2).astype(int) % 720
            expected += 2 * pressure(own) * np.pi / 4 * diameter[lobe]**2 * slope[place]  # two valves a cylinder on each camshaft
    # the seat still takes a part of the force over the first micrometre of lift: 5e-4 here, six times that with a seat a tenth as stiff
    assert np.abs(found - expected).max() < 1e-3 * np.abs(expected).max()
