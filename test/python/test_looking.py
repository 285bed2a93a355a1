"""What a person looks at before and after a run: the drawing, facts of a case, the table, one point of a sweep, exports."""

import json
import re
import subprocess
import xml.etree.ElementTree

import h5py
import numpy as np
import pytest

from conftest import ROOT, done


def test_drawing_is_to_scale(camroller, tmp_path):
    path = tmp_path / "mechanism.svg"
    done(camroller, "check", "decks/thesis.nml", "--draw", path)
    drawing = xml.etree.ElementTree.parse(path).getroot()
    space = "{http://www.w3.org/2000/svg}"
    circles = [{key: float(circle.get(key)) for key in ("cx", "cy", "r")} for circle in drawing.iter(space + "circle")]
    # a tenth of a millimetre is one unit, given to a tenth: base circle 18 mm, 31.5 mm from the pivot; rollers of 8.5 mm
    base = next(circle for circle in circles if circle["r"] == 180)
    assert np.hypot(base["cx"], base["cy"]) == pytest.approx(315, abs=0.1)
    rollers = [circle for circle in circles if circle["r"] == 85]
    assert len(rollers) == 2
    assert {round(np.hypot(roller["cx"], roller["cy"])) for roller in rollers} == {208}
    # one roller touches the base circle, the other is away by the lift
    distances = sorted(np.hypot(roller["cx"] - base["cx"], roller["cy"] - base["cy"]) for roller in rollers)
    assert distances[0] == pytest.approx(265, abs=0.2) and distances[1] > 300
    # the contour of the cam touches its base circle and nowhere enters it
    contour = next(part.get("d") for part in drawing.iter(space + "path") if part.get("d").endswith("Z"))
    points = np.array(re.findall(r"(-?[\d.]+) (-?[\d.]+)", contour), dtype=float)
    radii = np.hypot(points[:, 0] - base["cx"], points[:, 1] - base["cy"])
    assert radii.min() == pytest.approx(180, abs=0.1) and radii.max() > 210
    words = " ".join(text.text for text in drawing.iter(space + "text"))
    for name in ("valve_axis_angle", "roller_arm_angle", "pivot_to_cam_mm = 31.5", "base_radius_mm = 18", "10 mm"):
        assert name in words


def curves_of(path):
    """Colour and points of each curve of a drawing of a lift, upwards positive, four panels from lift to jerk."""
    space = "{http://www.w3.org/2000/svg}"
    parts = [part for part in xml.etree.ElementTree.parse(path).getroot().iter(space + "path") if part.get("fill") == "none"]
    found = [(part.get("stroke"), np.array(part.get("d")[1:].split(), dtype=float).reshape(-1, 2) * [1, -1]) for part in parts]
    each = len(found) // 4
    return [dict(found[each * panel:each * (panel + 1)]) for panel in range(4)]


def test_drawing_of_a_noisy_lift_has_its_rows_and_the_smoothed_curve(camroller, tmp_path):
    path = tmp_path / "lift.svg"
    done(camroller, "check", "decks/hard/noisy_table.nml", "--draw-lift", path)
    grey, blue, orange = "#aaaaaa", "#1f4e8c", "#e07b00"
    lift, _, acceleration, jerk = curves_of(path)
    assert set(lift) == set(jerk) == {grey, blue, orange}
    # the height of the curve of the case is half to nine tenths of the panel's 150
    assert np.ptp(lift[blue][:, 1]) == pytest.approx(100, abs=1)
    assert np.abs(np.interp(lift[grey][:, 0], *lift[orange].T) - lift[grey][:, 1]).max() < 0.3
    # noise makes the curve through all rows jerk to and fro, the smoothed one hardly
    assert np.abs(np.diff(jerk[blue][:, 1])).sum() > 20 * np.abs(np.diff(jerk[orange][:, 1])).sum()
    assert np.abs(np.diff(acceleration[grey][:, 1])).sum() > 2 * np.abs(np.diff(acceleration[orange][:, 1])).sum()
    done(camroller, "check", "decks/thesis.nml", "--draw-lift", path)
    assert [set(panel) for panel in curves_of(path)] == 4 * [{blue}]


def test_check_prints_facts_of_the_deck(camroller):
    text = done(camroller, "check", "decks/four_cylinder.nml").stdout
    for words in (r"oil at 90 degC: 11\.\d mPa s, .* \(estimated by So and Klaus", r"composite roughness: 0\.17 um",
                  r"smallest cam radius [\d.]+ mm at [\d.]+ deg", r"largest pressure angle [\d.]+ deg", r"ramps below 0\.1 mm",
                  r"second lobe: contact load up to \d+ N, pressure up to 0?\.?\d+", r"contact is lost above \d+ rev/min"):
        assert re.search(words, text), words
    assert "?" not in text.split("&case")[0]


def test_check_tells_no_film_ratio_of_a_contact_that_is_lost(camroller):
    text = done(camroller, "check", "decks/hard/contact_loss_3200_rpm.nml").stdout
    assert re.search(r"film ratio [\d.]+ and more, without contact for [\d.]+ % of the cycle\n", text)
    assert re.search(r"film ratio [\d.]+ to [\d.]+\n", done(camroller, "check", "decks/thesis.nml").stdout)


def test_check_tells_the_margins_without_friction_from_the_load_with_it(camroller):
    """A stem seal in cold oil lifts the follower off its cam, which the margins do not know."""
    deck = (ROOT / "decks/thesis.nml").read_text() + "&stem_seal lip_force_N = 5 viscous_drag_N_s_m = 3 reference_viscosity_Pa_s = 0.01 /\n"
    text = done(camroller, "check", "-", "--no-sweep", "--set", "operating_point.oil_temperature_degC=-20",
                "--set", "operating_point.speed_rpm=300", input=deck).stdout
    told = re.search(r"smallest load of the event (\d+) N, .*, all without friction; smallest load of the event with friction 0 N", text)
    assert told and int(told[1]) > 300, text


@pytest.mark.once
def test_check_foretells_the_size_of_a_sweep(camroller, tmp_path):
    speeds = "sweep.values_1=" + ",".join(str(300 + i) for i in range(400))
    text = done(camroller, "check", "decks/thesis.nml", "--set", speeds, "--set", "sweep.values_2=60,95").stdout
    done(camroller, "sweep", "decks/thesis.nml", "--set", speeds, "--set", "sweep.values_2=60,95", "-o", tmp_path / "s.h5", "-q")
    told = re.findall(r"([\d.]+) MB more for the result file|'camroller sweep' about ([\d.]+) MB", text)
    # two digits, nine of 800 cases, and what frames a case in a part
    for number in (told[0][0], told[1][1]):
        assert (tmp_path / "s.h5").stat().st_size == pytest.approx(1e6 * float(number), rel=0.12)


def test_check_foretells_the_size_of_a_small_file(camroller, tmp_path):
    """What every file has: the deck, names, units and meanings."""
    values = ["--set", "sweep.values_1=600", "--set", "sweep.values_2=60,95"]
    text = done(camroller, "check", "decks/thesis.nml", *values).stdout
    told = re.search(r"'camroller run' writes about ([\d.]+) MB with the series of every case, 'camroller sweep' about ([\d.]+) MB", text)
    for command, number in zip(("run", "sweep"), told.groups()):
        done(camroller, command, "decks/thesis.nml", *values, "-o", tmp_path / "s.h5", "-q")
        assert (tmp_path / "s.h5").stat().st_size == pytest.approx(1e6 * float(number), rel=0.1), command


def test_check_says_where_a_bearing_law_is_outside_its_range(camroller):
    text = done(camroller, "check", "decks/thesis.nml", "--no-sweep").stdout
    assert "width over diameter 0.87, law 'long_full_sommerfeld', which is for bearings wider than 2 diameters; 'finite'" in text
    text = done(camroller, "check", "decks/four_cylinder.nml", "--no-sweep").stdout
    assert "width over diameter 0.708, law 'finite'\n" in text


def test_the_law_of_a_deck_that_names_none_is_for_usual_bearings(camroller, tmp_path):
    deck = tmp_path / "deck.nml"
    deck.write_text((ROOT / "decks/thesis.nml").read_text().replace("   law = 'long_full_sommerfeld'\n", ""))
    text = done(camroller, "check", deck, "--no-sweep").stdout
    assert "width over diameter 0.87, law 'finite'\n" in text and "wider than 2 diameters" not in text


@pytest.mark.parametrize(("values", "words"), [
    ([], "event from 110.0 to 250.0 deg"),
    (["lift.max_lift_mm=5", "lift.opening_half_angle_deg=180"], "event from 0.0 to 360.0 deg"),
])
def test_the_event_is_told_from_its_start_to_its_end(camroller, values, words):
    assert f"lobe: {words}" in done(camroller, "check", "decks/thesis.nml", "--no-sweep", *(w for v in values for w in ("--set", v))).stdout


def test_check_and_result_show_the_finger_that_is_assumed(camroller, tmp_path):
    """Its inertia moves the limits of contact and joint, so that nobody should have to guess it."""
    words = ["--no-sweep", "--set", "masses.finger_kg=0.05"]
    text = done(camroller, "check", "decks/thesis.nml", *words).stdout
    assert "finger: inertia about its pivot 6.3e-5 kg m2, as if all of its mass were at the pad; real ones have less" in text
    assert re.search(r"finger_inertia_kg_m2 = (6\.30\d+|6\.3)e-5 +! default\n *finger_centre_mm = 20 +! default", text, re.I), text
    done(camroller, "run", "decks/thesis.nml", "-o", tmp_path / "assumed.h5", "--quiet", *words)
    given = ["--set", "masses.finger_inertia_kg_m2=2e-5"]
    text = done(camroller, "check", "decks/thesis.nml", *words, *given).stdout
    assert "finger: inertia about its pivot 2e-5 kg m2; centre of mass 20 mm from it" in text
    # The radius of gyration is less than the usual 20 mm
    text = done(camroller, "check", "decks/thesis.nml", *words, "--set", "masses.finger_inertia_kg_m2=5e-6").stdout
    assert "centre of mass 10 mm from it" in text and re.search(r"finger_centre_mm = (10|10\.0+\d*|9\.9+\d*) +! default", text), text
    with h5py.File(tmp_path / "assumed.h5") as file:
        inertia, centre = (file[f"deck/values/masses.{key}"] for key in ("finger_inertia_kg_m2", "finger_centre_mm"))
        assert inertia[()] == pytest.approx(0.05 * 0.0355**2, rel=1e-14) and centre[()] == pytest.approx(20, rel=1e-14)
        assert inertia.attrs["given"] == centre.attrs["given"] == "default"
        margin = file["summary/margin_pivot_speed"][0]
    # A finger without a mass has no joint, and no centre of mass
    deck = (ROOT / "decks/thesis.nml").read_text().replace("finger_kg = 0.0418", "finger_inertia_kg_m2 = 5.3e-5\n")
    assert "finger_centre_mm" not in done(camroller, "check", "-", "--no-sweep", input=deck).stdout
    # In a sweep each case assumes its own
    done(camroller, "sweep", "decks/thesis.nml", "-o", tmp_path / "sweep.h5", "--quiet", "--set", "sweep.key_1=masses.finger_kg", "--set",
         "sweep.values_1=0.05,0.04", "--set", "sweep.values_2=60")
    with h5py.File(tmp_path / "sweep.h5") as file:
        assert file["summary/margin_pivot_speed"][0] != file["summary/margin_pivot_speed"][1]
    assert margin > 0


def test_a_lift_out_of_reach_names_all_that_may_be_wrong(camroller):
    values = {"pivot_to_roller_mm": 17.5, "pivot_to_pad_mm": 30, "pivot_to_cam_mm": 28, "roller_arm_angle_deg": -3, "valve_axis_angle_deg": 75,
              "base_radius_mm": 16}
    words = [word for key, value in values.items() for word in ("--set", f"mechanism.{key}={value}")]
    told = done(camroller, "check", "decks/thesis.nml", "--no-sweep", *words, "--set", "roller.radius_mm=7.5", code=4).stderr
    assert "the finger cannot reach the lift of 8.9" in told and "its pad stands at 135 deg from the valve's axis" in told
    for key in ("pivot_to_pad_mm", "valve_axis_angle_deg", "roller_arm_angle_deg", "base_radius_mm"):
        assert f"override: mechanism.{key}={values[key]}" in told
    assert "max_lift_mm" in told


def test_the_hollow_is_that_in_which_the_grinding_wheel_must_fit(camroller):
    """Where the acceleration has a corner between two quarters of a degree."""
    values = ["lift.law=segments", "lift.max_lift_mm=8.5", "lift.segment_angles_deg=0,5,20,25.1,29.9,75,110,125,135,142",
              "lift.segment_accelerations=0,1,1,20,20,-10,-10,18,1,0", "mechanism.base_radius_mm=22"]
    words = ["check", "decks/thesis.nml", "--no-sweep", *(w for v in values for w in ("--set", v))]
    told = float(re.search(r"hollow flanks of ([\d.]+) mm", done(camroller, *words).stdout)[1])
    # three digits are printed
    done(camroller, *words, "--set", f"mechanism.grinding_wheel_radius_mm={0.996 * told}")
    result = subprocess.run([camroller, *words, "--set", f"mechanism.grinding_wheel_radius_mm={1.004 * told}"], capture_output=True,
                            text=True, cwd=ROOT, check=False)
    assert "hollow flank: the cam's radius of curvature is" in result.stderr


def test_smallest_cam_radius_is_that_of_the_series(camroller, tmp_path):
    text = done(camroller, "check", "decks/thesis.nml", "--no-sweep").stdout
    told = float(re.search(r"smallest cam radius ([\d.]+) mm", text)[1])
    done(camroller, "run", "decks/thesis.nml", "-o", tmp_path / "a.h5", "--no-sweep", "--quiet", "--set", "output.angle_step_deg=0.25")
    with h5py.File(tmp_path / "a.h5") as file:
        curvature = 1 / file["series/equivalent_radius"][0] - 1 / 0.0085
    # three digits are printed
    assert told == pytest.approx(1e3 / curvature.max(), rel=2e-3)


def test_run_ends_with_a_table_of_results(camroller, tmp_path):
    text = done(camroller, "run", "decks/thesis.nml", "-o", tmp_path / "a.h5").stdout
    lines = text.splitlines()
    assert lines[0].split()[:2] == ["speed_rpm", "oil_temperature_degC"] and "peak pressure" in lines[0]
    with h5py.File(tmp_path / "a.h5") as file:
        torque = 1e3 * file["summary/mean_torque_friction"][()]
    for row, value in zip(lines[2:11], torque, strict=True):
        assert float(row.split()[6]) == pytest.approx(value, rel=5e-3)
    assert done(camroller, "run", "decks/thesis.nml", "-o", tmp_path / "a.h5", "--quiet").stdout == ""


def test_the_table_has_the_worst_lobe_shape(camroller, tmp_path):
    deck = ["decks/four_cylinder.nml", "--no-sweep", "--set", "second_lift.max_lift_mm=4", "--set", "second_lift.opening_half_angle_deg=45"]
    text = done(camroller, "run", *deck, "-o", tmp_path / "a.h5").stdout
    note = "mean slip, peak pressure, smallest film, film ratio: the worst of all lobe shapes"
    assert note in text
    with h5py.File(tmp_path / "a.h5") as file:
        of = {name: values[0] for name, values in file["summary"].items() if values.dtype.kind == "f"}
    shown = list(map(float, text.splitlines()[2].split()[-4:]))
    # of this deck the first shape has the larger pressure, the second one the rest; three digits are printed
    assert of["max_lobe_2_hertz_pressure"] < of["max_hertz_pressure"] and of["min_lobe_2_film_ratio"] < 0.9 * of["min_film_ratio"]
    assert shown == pytest.approx([1e2 * of["mean_lobe_2_slip_ratio"], 1e-9 * of["max_hertz_pressure"],
                                   1e6 * of["min_lobe_2_film_thickness_min"], of["min_lobe_2_film_ratio"]], rel=5e-3)
    # at this speed the second shape alone loses contact: films are those of the angles in contact
    text = done(camroller, "run", *deck, "--set", "operating_point.speed_rpm=6000", "-o", tmp_path / "b.h5").stdout
    with h5py.File(tmp_path / "b.h5") as file:
        of = {name: values[0] for name, values in file["summary"].items() if values.dtype.kind == "f"}
    assert of["lost_contact_share"] == 0 < of["lobe_2_lost_contact_share"] and of["min_lobe_2_film_ratio"] > 0
    films = [1e6 * min(of["min_film_thickness_min"], of["min_lobe_2_film_thickness_min"]),
             min(of["min_film_ratio"], of["min_lobe_2_film_ratio"])]
    assert list(map(float, text.splitlines()[2].split()[-2:])) == pytest.approx(films, rel=5e-3)
    assert note not in done(camroller, "run", "decks/thesis.nml", "--no-sweep", "-o", tmp_path / "c.h5").stdout


def test_point_selects_one_case_of_a_sweep(camroller, tmp_path):
    done(camroller, "run", "decks/thesis.nml", "-o", tmp_path / "all.h5", "--quiet")
    done(camroller, "run", "decks/thesis.nml", "-o", tmp_path / "one.h5", "--quiet", "--point", "speed_rpm=600",
         "--point", "operating_point.oil_temperature_degC=60")
    with h5py.File(tmp_path / "all.h5") as many, h5py.File(tmp_path / "one.h5") as one:
        assert one["case"].shape == (1,)
        assert one["summary/mean_torque_friction"][0] == many["summary/mean_torque_friction"][4]
    # what is stored is the one case
    assert "1 case is the same to the last bit" in done(camroller, "rerun", tmp_path / "one.h5").stdout


@pytest.mark.once
def test_deck_from_the_standard_input(camroller, tmp_path):
    deck = (ROOT / "decks/thesis.nml").read_text(encoding="utf-8")
    done(camroller, "run", "-", "-o", tmp_path / "a.h5", "--quiet", input=deck)
    done(camroller, "run", "decks/thesis.nml", "-o", tmp_path / "b.h5", "--quiet")
    with h5py.File(tmp_path / "a.h5") as one, h5py.File(tmp_path / "b.h5") as other:
        assert (one["summary/mean_torque_drive"][()] == other["summary/mean_torque_drive"][()]).all()
    result = done(camroller, "check", "-", input=deck.replace("radius_mm = 8.5", "radius_mm = -1"), code=3)
    assert "standard input:" in result.stderr
    # one byte more than is read
    result = done(camroller, "check", "-", input=deck + "\n" * (2**26 + 1 - len(deck.encode())), code=6)
    assert "the standard input is too large for a deck: more than 64 MB" in result.stderr


def test_export_selects_columns_and_formats(camroller, tmp_path):
    path = tmp_path / "a.h5"
    done(camroller, "run", "decks/thesis.nml", "-o", path, "--quiet")
    text = done(camroller, "export", path, "--summary", "--columns", "mean_torque_friction,min_film_ratio", "--format", "plain").stdout
    lines = text.splitlines()
    assert lines[0].split(",")[-2:] == ["mean_torque_friction [N m]", "min_film_ratio [1]"] and len(lines) == 10
    table = json.loads(done(camroller, "export", path, "--summary", "--format", "json").stdout)
    with h5py.File(path) as file:
        column = next(column for column in table["columns"] if column["name"] == "mean_torque_friction")
        assert column["values"] == list(file["summary/mean_torque_friction"][()]) and column["unit"] == "N m"
    series = done(camroller, "export", path, "--case", 2, "--columns", "contact_load").stdout.splitlines()
    assert series[0] == "cam_angle,contact_load" and len(series) == 722
    result = done(camroller, "export", path, "--columns", "contact_lod", code=2)
    assert "did you mean 'contact_load'?" in result.stderr


def test_export_writes_infinite_speeds_as_text_and_missing_numbers_as_null(camroller, tmp_path):
    path = tmp_path / "a.h5"
    done(camroller, "run", "decks/thesis.nml", "-o", path, "--quiet", "--point", "speed_rpm=300")
    path.write_bytes(path.read_bytes()[:-32])  # without the seal of the numbers as they were
    with h5py.File(path, "r+") as file:
        for name, value in (("contact_loss_speed", np.inf), ("spring_margin", -np.inf), ("margin_event", np.nan)):
            file[f"summary/{name}"][0] = value
    text = done(camroller, "export", path, "--summary", "--format", "json").stdout
    table = json.loads(text, parse_constant=lambda word: pytest.fail(f"{word} is no JSON"))
    values = {column["name"]: column["values"][0] for column in table["columns"]}
    assert [values[name] for name in ("contact_loss_speed", "spring_margin", "margin_event")] == ["Infinity", "-Infinity", None]


def test_study_of_laws_refuses_an_output_file(camroller, tmp_path):
    words = done(camroller, "study", "decks/thesis.nml", "--laws", "-o", tmp_path / "x.h5", code=2).stderr
    assert "'study' does not take '--laws' together with '--output'" in words and not (tmp_path / "x.h5").exists()


def test_study_of_laws_shows_the_range_that_runs_give(camroller, tmp_path):
    text = done(camroller, "study", "decks/thesis.nml", "--laws", "--set", "sweep.values_1=600", "--set", "sweep.values_2=60").stdout
    slips = {}
    for law in ("dowson_higginson", "pan_hamrock", "masjedi_khonsari", "moes"):
        done(camroller, "run", "decks/thesis.nml", "-o", tmp_path / "a.h5", "--quiet", "--point", "speed_rpm=600",
             "--point", "oil_temperature_degC=60", "--set", f"film.law={law}")
        with h5py.File(tmp_path / "a.h5") as file:
            slips[law] = 100 * file["summary/mean_slip_ratio"][0]
        row = next(line.replace(">", " ").split() for line in text.splitlines() if re.match(rf"[> ] {law}\*? ", line))
        # three digits are printed
        assert float(row[4]) == pytest.approx(slips[law], rel=5e-3), law
    low, high = min(slips.values()), max(slips.values())
    told = re.findall(r"([\d.e-]+) to ([\d.e-]+)", next(line for line in text.splitlines() if "range of 4 laws" in line))[3]
    assert [float(value) for value in told] == pytest.approx([low, high], rel=5e-3)
    assert "> dowson_higginson" in text


def test_study_of_laws_marks_those_that_run_has_a_remark_on(camroller):
    values = [w for value in ("sweep.values_1=300", "sweep.values_2=95", "materials.hardness_GPa=7") for w in ("--set", value)]
    text = done(camroller, "study", "decks/thesis.nml", "--laws", *values).stdout
    lines = text.splitlines()
    rows = {line[2:].split()[0]: line[2:].split()[1:] for line in lines if re.match(r"[> ] [a-z_]+[*+ ]+ [\d ]", line)}
    assert {"dowson_higginson*", "masjedi_khonsari_rough*+", "moes"} <= set(rows)
    assert "  * outside its published range; a remark of 'camroller run' with it says how far" in lines
    assert "  + left out of the range: film.law 'masjedi_khonsari_rough' and asperity.law 'greenwood_tripp' do not go together" in text
    slips = [float(row[3]) for name, row in rows.items() if "+" not in name]
    told = re.findall(r"([\d.e-]+) to ([\d.e-]+)", next(line for line in lines if "range of 4 laws" in line))[3]
    assert [float(value) for value in told] == [min(slips), max(slips)] and float(rows["masjedi_khonsari_rough*+"][3]) > max(slips)
    # each in its column
    assert len({len(line) for line in lines if re.match(r"[> ] [a-z_]+[*+ ]+ [\d ]", line)}) == 1
    fitting = done(camroller, "study", "decks/thesis.nml", "--laws", *values, "--set", "asperity.law=zhao_maietta_chang").stdout
    assert "range of 5 laws" in fitting and "left out" not in fitting


def test_study_of_laws_ends_with_the_code_of_a_case_without_a_result(camroller):
    values = ["--set", "case.contact_policy=stop", "--set", "sweep.values_1=300,3000", "--set", "sweep.values_2=25"]
    words = done(camroller, "study", "decks/thesis.nml", "--laws", *values, code=4).stderr
    assert words.startswith("camroller: 1 of 2 cases has no result: case 1 (operating_point.speed_rpm=3000, operating_point.oil_")


def test_study_of_laws_ends_with_the_code_of_the_deck_s_own_law(camroller):
    """A law behind it in the table has a result."""
    short = ["--set", "numerics.tolerance=1e-5", "--set", "numerics.periodicity=1e-8", "--set", "numerics.max_cycles=1"]
    result = done(camroller, "study", "decks/hard/contact_loss_3200_rpm.nml", "--laws", *short, code=5)
    lines = result.stdout.splitlines()
    own = next(i for i, line in enumerate(lines) if line.startswith("> "))
    assert "did not become periodic" in lines[own] and "did not become periodic" in result.stderr
    assert any(re.search(r" \d", line) and "periodic" not in line for line in lines[own + 1:])


def test_study_of_laws_says_that_a_solved_film_has_no_law(camroller):
    deck = (ROOT / "decks/thesis.nml").read_text() + "&ehl /\n"
    text = done(camroller, "study", "-", "--laws", "--set", "sweep.values_1=600", "--set", "sweep.values_2=60", input=deck).stdout
    assert text.splitlines()[-1] == "  the film of the deck itself is solved, by &ehl, and follows none of these laws"
    assert not any(line.startswith("> ") for line in text.splitlines())


def test_pressure_and_film_of_a_profiled_roller_are_those_along_it_wherever_they_are_shown(camroller, tmp_path):
    deck = ["bench/all_effects.nml", "--no-sweep"]
    lines = done(camroller, "run", *deck, "-o", tmp_path / "a.h5").stdout.splitlines()
    with h5py.File(tmp_path / "a.h5") as file:
        pressure = 1e-9 * file["summary/max_axial_pressure_max"][0]
        film = 1e6 * file["summary/min_film_thickness_axial_min"][0]
        assert pressure > 1.1e-9 * file["summary/max_hertz_pressure"][0] and film < 0.97e6 * file["summary/min_film_thickness_min"][0]
    # three digits are printed; pressure, smallest film, film ratio come last
    assert [float(word) for word in lines[2].split()[-3:-1]] == pytest.approx([pressure, film], rel=5e-3)
    told = re.search(r"pressure up to ([\d.]+) GPa", done(camroller, "check", *deck).stdout)
    assert float(told[1]) == pytest.approx(pressure, rel=5e-3)
    row = next(line for line in done(camroller, "study", deck[0], "--laws").stdout.splitlines() if line.startswith("> ")).split()
    assert float(row[-2]) == pytest.approx(film, rel=5e-3)


def test_study_of_laws_shows_the_worst_of_several_lobe_shapes(camroller, tmp_path):
    point = ["decks/four_cylinder.nml", "--set", "sweep.values_1=1000", "--set", "sweep.values_2=90", "--set",
             "second_lift.max_lift_mm=10.5"]
    text = done(camroller, "study", *point, "--laws").stdout
    done(camroller, "run", *point, "-o", tmp_path / "a.h5", "--quiet")
    with h5py.File(tmp_path / "a.h5") as file:
        scalars = {name: [file[f"summary/{first}{lobe}{last}"][0] for lobe in ("", "lobe_2_")] for name, first, last in (
            ("slip", "mean_", "slip_ratio"), ("film", "min_", "film_thickness_min"), ("ratio", "min_", "film_ratio"))}
    row = next(line for line in text.splitlines() if line.startswith("> ")).split()
    assert float(row[5]) == pytest.approx(100 * max(scalars["slip"], key=abs), rel=5e-3)
    assert float(row[6]) == pytest.approx(1e6 * min(scalars["film"]), rel=5e-3)
    assert float(row[7]) == pytest.approx(min(scalars["ratio"]), rel=5e-3)
    assert scalars["film"][0] > 1.01 * scalars["film"][1], "the film of the second shape can be told from the first's by three digits"
    assert text.splitlines()[-1] == "  outside its range, mean slip, smallest film, film ratio: the worst of all lobe shapes"
    assert "worst" not in done(camroller, "study", "decks/thesis.nml", "--laws", "--set", "sweep.values_1=600", "--set",
                               "sweep.values_2=60").stdout


def test_selftest_passes_and_names_the_build(camroller):
    text = done(camroller, "selftest").stdout
    assert "all 6 numbers agree" in text and "commit" in text and "GCC" in text
