"""The command `audit` and the choice of effects from outside: table, file, decisions."""

import h5py
import numpy
import pytest

from conftest import ROOT, run

THESIS = (ROOT / "decks/thesis.nml").read_text()
NAMES = ["asperity", "needle_bearing", "valve_guide", "cam_bearings", "rolling_resistance", "roller_equation"]


@pytest.fixture(scope="module", name="folder")
def with_deck(tmp_path_factory):
    """A folder with decks of one and of two cases: cold oil, where asperities hardly matter, and hot oil."""
    folder = tmp_path_factory.mktemp("audit")
    one = THESIS[:THESIS.index("&sweep")].replace("speed_rpm = 300", "speed_rpm = 900")
    (folder / "one.nml").write_text(one)
    (folder / "two.nml").write_text(one + "&sweep\n   key_1 = 'operating_point.oil_temperature_degC'\n   values_1 = 25, 95\n/\n")
    return folder


def words(dataset):
    """Texts of a column."""
    return [text.decode() for text in dataset]


def test_an_audit_has_a_run_without_each_effect(camroller, folder):
    result = run(camroller, "audit", "one.nml", "--repeats", "1", folder=folder)
    assert result.returncode == 0, result.stderr
    assert max(map(len, result.stdout.splitlines())) <= 132
    assert "changes are within their estimates" in result.stdout
    with h5py.File(folder / "one_audit.h5") as file:
        table = file["study/audit"]
        runs, effects = words(table["run"]), words(table["effect"])
        assert [effect for run, effect in zip(runs, effects) if run == "without"] == NAMES
        assert runs[0] == "listed" and runs[1] == "needed" and "none" in runs and "alone" in runs
        assert (table["status"][()] == 0).all()
        change = dict(zip(zip(runs, effects), table["change_mean_torque"][()]))
        assert change["listed", ""] == 0.0
        assert -0.9 < change["without", "cam_bearings"] < -0.3
        left_out = dict(zip(zip(runs, effects), table["is_left_out"][()]))
        assert left_out["without", "asperity"] == 1 and left_out["without", "needle_bearing"] == 0


def test_an_estimate_without_a_bound_is_infinite(camroller, tmp_path):
    """In the table of an audit and in `/effects` of a run, where it was the largest number that there is."""
    text = (ROOT / "decks/sliding_joints.nml").read_text()
    (tmp_path / "deck.nml").write_text(text[:text.index("&sweep")])
    for command in (["audit", "deck.nml", "--repeats", "1", "-o", "audit.h5"],
                    ["run", "deck.nml", "--set", "effects.select=needed", "-o", "run.h5"]):
        result = run(camroller, *command, folder=tmp_path)
        assert result.returncode == 0, result.stderr
    with h5py.File(tmp_path / "audit.h5") as audit, h5py.File(tmp_path / "run.h5") as whole:
        # an audit goes by it whatever decides about the effects of a run
        assert audit["deck/values/effects.negligible"].attrs["used"] == "yes"
        columns = [data for name, data in audit["study/audit"].items() if name.startswith("estimate_")]
        scalars = [data for name, data in whole["effects"].items() if "_estimate_" in name]
        assert len(columns) == 3 and len(scalars) > 3
        for data in (*columns, *scalars):
            assert "infinite where there is no bound" in data.attrs["long_name"], data.name
            assert numpy.nanmax(data[()][~numpy.isinf(data[()])], initial=0.0) < 10.0, data.name
        for found in (columns, scalars):
            assert any(numpy.isposinf(data[()]).any() for data in found)


def test_an_audit_ends_with_the_code_of_a_case_without_a_result(camroller, folder):
    result = run(camroller, "audit", "one.nml", "--repeats", "1", "--quiet", "-o", "lost.h5", "--set", "case.contact_policy=stop",
                 "--set", "operating_point.speed_rpm=3000", folder=folder)
    assert result.returncode == 4 and result.stderr.startswith("camroller: contact is lost for ") and not (folder / "lost.h5").exists()
    (folder / "fast.nml").write_text((folder / "two.nml").read_text().replace("oil_temperature_degC'", "speed_rpm'").replace("25, 95", "600, 3000"))
    result = run(camroller, "audit", "fast.nml", "--repeats", "1", "--quiet", "--set", "case.contact_policy=stop", folder=folder)
    assert result.returncode == 4
    assert result.stderr.startswith("camroller: 1 of 2 cases has no result: case 1 (operating_point.speed_rpm=3000): contact is lost for ")
    with h5py.File(folder / "fast_audit.h5") as file:
        assert set(file["study/audit/status"][file["study/audit/case"][()] == 0]) == {0}


def test_an_audit_keeps_all_cams_without_their_bearings(camroller, folder):
    """Runs of one cam and of two that do the same: torques of two are twice those of one, effect by effect."""
    tables = []
    for name, cams in (("single", "30"), ("double", "20, 40")):
        result = run(camroller, "audit", "one.nml", "--repeats", "1", "--set", f"cam_bearings.cam_positions_mm={cams}",
                     "-o", f"{name}.h5", folder=folder)
        assert result.returncode == 0, result.stderr
        with h5py.File(folder / f"{name}.h5") as file:
            table = {column: file["study/audit"][column][()] for column in ("mean_torque", "minimum_film", "slip", "status")}
            runs = list(zip(words(file["study/audit/run"]), words(file["study/audit/effect"])))
        assert (table["status"] == 0).all()
        tables.append({key: [table[name][row] for name in ("mean_torque", "minimum_film", "slip")] for row, key in enumerate(runs)})
    single, double = tables
    without = [key for key in single if key[0] in ("none", "alone") or key == ("without", "cam_bearings")]
    assert len(without) > 4
    for key in without:
        # twice one and the same number, up to rounding
        assert double[key][0] == pytest.approx(2 * single[key][0], rel=1e-12), key
        assert double[key][1:] == single[key][1:], key


@pytest.mark.once
def test_an_audit_takes_the_friction_of_bearings_from_two_lobe_shapes(camroller, tmp_path):
    deck = [str(ROOT / "decks/three_cam_head.nml"), "--set", "operating_point.speed_rpm=600"]
    for command in (["audit", *deck, "--repeats", "1", "-o", "audit.h5"], ["run", *deck, "-o", "run.h5"]):
        result = run(camroller, *command, folder=tmp_path)
        assert result.returncode == 0, result.stderr
    with h5py.File(tmp_path / "audit.h5") as file, h5py.File(tmp_path / "run.h5") as whole:
        table = file["study/audit"]
        row = list(zip(words(table["run"]), words(table["effect"]))).index(("without", "cam_bearings"))
        friction, bearings = (whole[f"summary/mean_torque_{name}"][0] for name in ("friction", "bearings"))
        # bearings change no other torque
        assert table["change_mean_torque"][row] == pytest.approx(-bearings / friction, rel=1e-9)
        assert table["change_minimum_film"][row] == 0 and table["change_slip"][row] == 0


def test_file_has_the_choice_of_effects_and_no_numbers_where_an_effect_is_left_out(camroller, folder):
    result = run(camroller, "run", "two.nml", "--set", "effects.select=needed", folder=folder)
    assert result.returncode == 0, result.stderr
    listed = run(camroller, "run", "two.nml", "-o", "listed.h5", folder=folder)
    assert listed.returncode == 0, listed.stderr
    with h5py.File(folder / "two.h5") as file, h5py.File(folder / "listed.h5") as other:
        effects = file["effects"]
        assert effects["asperity_used"][()].tolist() == [0, 1]
        assert numpy.isnan(file["series/asperity_load"][0]).all() and (file["series/asperity_load"][1] > 0).any()
        assert (effects["bound"][()] <= 1e-3).all()
        assert words(effects["reasons"])[0].startswith("asperity            left out ")
        assert set(file["summary"]) == set(other["summary"]) and "effects" not in other
        torque = [data["summary/mean_torque_friction"][()] for data in (file, other)]
        assert numpy.allclose(*torque, rtol=1e-3, atol=0)


def test_a_single_case_has_no_dataset_for_effects_left_out(camroller, folder):
    assert run(camroller, "run", "one.nml", "--set", "effects.select=needed", folder=folder).returncode == 0
    with h5py.File(folder / "one.h5") as file:
        assert "asperity_load" not in file["series"] and "mean_asperity_load" not in file["summary"]


def test_check_prints_which_effects_are_left_out(camroller, folder):
    result = run(camroller, "check", "two.nml", "--set", "effects.select=needed", folder=folder)
    assert result.returncode == 0, result.stderr
    assert result.stdout.count("asperity            left out") == 1 and result.stdout.count("asperity            kept") == 1
    assert "film ratio from" in result.stdout
    assert "left out" not in run(camroller, "check", "two.nml", folder=folder).stdout


SLOW_AND_HOT = ["operating_point.speed_rpm=200", "operating_point.oil_temperature_degC=95", "effects.select=needed"]


def with_rubbing_bearings(text, cams=""):
    """A deck with bearings of the camshaft that take most of the friction in slow, hot oil."""
    return text[:text.index("&cam_bearings")] + f"""
&cam_bearings law = 'finite' diameter_mm = 23 width_mm = 18 radial_clearance_um = 40 bearing_positions_mm = 0, 60
   {cams or "cam_positions_mm = 30"} /
&bearing_asperity roughness_um = 0.5 modulus_GPa = 110 boundary_coefficient = 0.1 /
"""


@pytest.mark.parametrize("cams", ["", "cam_positions_mm = 20, 40 cam_phases_deg = 0, 90"])
def test_gas_force_stays_where_bearings_feel_it(camroller, tmp_path, cams):
    """Rubbing bearings with three quarters of the friction lose a quarter of it without the gas, the contact nearly nothing."""
    (tmp_path / "deck.nml").write_text(with_rubbing_bearings(THESIS, cams) + f"""
&gas_force table = '{ROOT / "decks/tables/cylinder_pressure.txt"}' valve_diameter_mm = 28 /
&effects select = 'needed' /
""")
    settings = [word for setting in SLOW_AND_HOT for word in ("--set", setting)]
    for name, extra in (("needed", []), ("listed", ["--set", "effects.select=listed"])):
        result = run(camroller, "run", "deck.nml", *settings, *extra, "-o", f"{name}.h5", "--quiet", folder=tmp_path)
        assert result.returncode == 0, result.stderr
    torques = []
    for name in ("needed", "listed"):
        with h5py.File(tmp_path / f"{name}.h5") as file:
            torques.append(file["summary/mean_torque_friction"][0])
    assert torques[0] == pytest.approx(torques[1], rel=1e-3)
    printed = run(camroller, "check", "deck.nml", *settings, folder=tmp_path).stdout
    estimate = next(line for line in printed.splitlines() if "gas_force   " in line).split()[3:]
    assert estimate[0] == "large" or float(estimate[0]) > 0.24, estimate


def test_asperities_stay_where_wear_is_asked_for(camroller, folder):
    (folder / "wear.nml").write_text((folder / "one.nml").read_text() + "&wear cam_rate_mm3_N_m = 2e-7 roller_rate_mm3_N_m = 5e-7 /\n"
                                     "&effects select = 'needed' negligible = 0.1 /\n")
    assert run(camroller, "run", "wear.nml", "-o", "wear.h5", folder=folder).returncode == 0
    with h5py.File(folder / "wear.h5") as file:
        assert "cam_wear_per_turn" in file["series"] or "cam_wear_per_turn" in file["summary"]


def test_a_film_law_stays_where_its_range_decides(camroller, folder):
    """The simpler law would be outside its range and end the run."""
    deck = with_rubbing_bearings(THESIS).replace("'dowson_higginson'", "'moes' range_policy = 'stop'")
    (folder / "film.nml").write_text(deck + "&effects select = 'needed' negligible = 0.1 /\n")
    settings = [word for setting in SLOW_AND_HOT for word in ("--set", setting)]
    assert run(camroller, "run", "film.nml", *settings, "-o", "film.h5", folder=folder).returncode == 0
    failed = run(camroller, "run", "film.nml", *settings, "--set", "film.law=dowson_higginson", "-o", "x.h5", folder=folder)
    assert failed.returncode != 0 and "range_policy = 'stop'" in failed.stderr
    warned = run(camroller, "run", "film.nml", *settings, "--set", "film.range_policy=warn", "-o", "y.h5", folder=folder)
    assert "outside its published range" in warned.stderr and "has put this law in the place of the deck's, since film_law" in warned.stderr
