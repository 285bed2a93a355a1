"""Runs from outside: what is written, what is said, and what stays where something fails."""

import csv
import io
import os
import pty
import re
import subprocess
import time

import h5py
import numpy
import pytest
import xarray

from conftest import ROOT, done, run

THESIS = ROOT / "decks/thesis.nml"
USAGE, DECK, DOMAIN, CONVERGENCE, FILE, DIFFERENCE = 2, 3, 4, 5, 6, 7
COARSE = ["--set", "output.angle_step_deg=5"]


def one_case(path, *changes):
    """The reference deck without its sweep, with some of its text replaced."""
    text = THESIS.read_text()
    text = text[:text.index("&sweep")]
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    path.write_text(text)
    return path


@pytest.fixture(scope="module")
def thesis(camroller, tmp_path_factory):
    """Result of the reference deck, coarse."""
    folder = tmp_path_factory.mktemp("thesis")
    result = run(camroller, "run", THESIS, *COARSE, folder=folder)
    assert result.returncode == 0, result.stderr
    assert result.stdout.splitlines()[-1].startswith("thesis.h5: 9 cases in ")
    return folder / "thesis.h5"


def test_cases_stand_in_the_order_of_the_sweep(thesis):
    with h5py.File(thesis) as file:
        assert list(file["sweep/operating_point.speed_rpm"]) == [300] * 3 + [600] * 3 + [900] * 3
        assert list(file["sweep/operating_point.oil_temperature_degC"]) == [25, 60, 95] * 3
        assert file["series/contact_load"].shape == (9, 72)
        assert list(file["summary/status"]) == [0] * 9


def test_file_has_its_deck_and_the_facts_of_its_run(camroller, thesis):
    with h5py.File(thesis) as file:
        assert file["deck/text"][()].decode() == THESIS.read_text()
        values = file["deck/values"]
        assert values["output.angle_step_deg"][()] == 5
        assert values["output.angle_step_deg"].attrs["given"] in ("given", b"given")
        assert values["spring.seat_stiffness_N_m"][()] == 1e7
        assert values["spring.seat_stiffness_N_m"].attrs["given"] in ("default", b"default")
        assert values["lubricant.viscosity_points_Pa_s"][()].decode() == "0.15, 0.0305, 0.01"
        command = file["run"].attrs["command"]
        assert str(THESIS) in (command if isinstance(command, str) else command.decode())


def test_quiet_prints_nothing(camroller, tmp_path):
    result = run(camroller, "run", one_case(tmp_path / "deck.nml"), *COARSE, "--quiet", folder=tmp_path)
    assert (result.returncode, result.stdout, result.stderr) == (0, "", "")
    assert (tmp_path / "deck.h5").exists()


def test_export_gives_the_numbers_of_the_file(camroller, thesis, tmp_path):
    result = run(camroller, "export", thesis, "--case", 4, folder=tmp_path)
    assert result.returncode == 0, result.stderr
    rows = list(csv.reader(io.StringIO(result.stdout)))
    column = rows[0].index("contact_load")
    with h5py.File(thesis) as file:
        numbers = [float(row[column]) for row in rows[2:]]
        assert numpy.array_equal(numbers, file["series/contact_load"][4])
    summary = run(camroller, "export", thesis, "--summary", "-o", "summary.csv", folder=tmp_path)
    assert (summary.returncode, summary.stdout) == (0, ""), summary.stderr
    assert len((tmp_path / "summary.csv").read_text().splitlines()) == 2 + 9


def test_export_of_a_missing_case_is_an_error(camroller, thesis, tmp_path):
    assert run(camroller, "export", thesis, "--case", 9, folder=tmp_path).returncode == USAGE


@pytest.mark.parametrize("changes, code, words", [
    ([("pivot_to_cam_mm = 31.5", "pivot_to_cam_mm = 60")], DOMAIN, "no closed triangle"),
    ([("max_lift_mm = 9.5", "max_lift_mm = 25")], DOMAIN, "cam undercut"),
    ([("stiffness_N_m = 25000", "stiffness_N_m = 2500")], DECK, "seat"),
    ([("radius_mm = 8.5", "radius_mm = -8.5")], DECK, "must be above 0"),
], ids=["no triangle", "too much lift", "adjuster stronger than spring", "negative length"])
def test_a_run_without_results_keeps_the_earlier_file(camroller, tmp_path, changes, code, words):
    deck = one_case(tmp_path / "deck.nml", *changes)
    earlier = b"\x89HDF\r\n\x1a\n of an earlier camroller result"
    (tmp_path / "deck.h5").write_bytes(earlier)
    result = run(camroller, "run", deck, folder=tmp_path)
    assert result.returncode == code, result.stderr
    assert words in result.stderr
    assert result.stdout == ""
    assert sorted(path.name for path in tmp_path.iterdir()) == ["deck.h5", "deck.nml"]
    assert (tmp_path / "deck.h5").read_bytes() == earlier
    checked = run(camroller, "check", deck, folder=tmp_path)
    assert checked.returncode == code
    assert words in checked.stderr


def test_a_case_that_fails_does_not_end_the_others(camroller, tmp_path):
    deck = one_case(tmp_path / "deck.nml")
    deck.write_text(deck.read_text() + "&sweep key_1 = 'mechanism.pivot_to_cam_mm' values_1 = 31.5, 60, 31 /\n")
    result = run(camroller, "run", deck, *COARSE, folder=tmp_path)
    assert result.returncode == DOMAIN
    assert "1 of 3 cases has no result: case 1 (mechanism.pivot_to_cam_mm=60): " in result.stderr
    with h5py.File(tmp_path / "deck.h5") as file:
        assert list(file["summary/status"]) == [0, DOMAIN, 0]
        assert numpy.isnan(file["series/contact_load"][1]).all()
        assert numpy.isfinite(file["series/contact_load"][2]).all()


@pytest.mark.parametrize("output", ["no_such_folder/x.h5", "deck.nml/x.h5", "/proc/x.h5", "."])
def test_paths_that_cannot_be_written_are_errors(camroller, tmp_path, output):
    deck = one_case(tmp_path / "deck.nml")
    result = run(camroller, "run", deck, "-o", output, *COARSE, folder=tmp_path)
    assert result.returncode == FILE, result.stderr
    assert result.stderr.startswith("camroller: ")
    assert [path.name for path in tmp_path.iterdir()] == ["deck.nml"]


def test_the_deck_is_not_replaced(camroller, tmp_path):
    deck = one_case(tmp_path / "deck.nml")
    text = deck.read_text()
    assert run(camroller, "run", deck, "-o", deck, folder=tmp_path).returncode == USAGE
    assert deck.read_text() == text


def test_names_can_be_swept(camroller, tmp_path):
    deck = one_case(tmp_path / "deck.nml")
    deck.write_text(deck.read_text() + "&sweep key_1 = 'film.law' values_1 = 'moes', 'pan_hamrock' /\n")
    result = run(camroller, "run", deck, *COARSE, folder=tmp_path)
    assert result.returncode == 0, result.stderr
    with h5py.File(tmp_path / "deck.h5") as file:
        assert [name.decode() for name in file["sweep/film.law"][()]] == ["moes", "pan_hamrock"]
        assert (file["series/film_thickness_min"][0] != file["series/film_thickness_min"][1]).any()


@pytest.mark.once
def test_a_long_run_shows_progress_on_a_terminal_only(camroller, tmp_path):
    deck = one_case(tmp_path / "deck.nml")
    deck.write_text(deck.read_text() + "&sweep key_1 = 'operating_point.speed_rpm' from_1 = 300 to_1 = 420 count_1 = 9001 /\n")
    command = [camroller, "run", str(deck), *COARSE]
    words = b" of 9001 cases"
    master, slave = pty.openpty()
    start = time.monotonic()
    with subprocess.Popen(command, cwd=tmp_path, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=slave) as process:
        os.close(slave)
        seen = b""
        try:
            while words not in seen and (block := os.read(master, 4096)):
                seen += block
        except OSError:
            pass
        process.terminate()
        os.close(master)
    assert words in seen
    # As long again, and as much once more, without a terminal
    with (tmp_path / "log").open("wb") as log:
        with subprocess.Popen(command, cwd=tmp_path, stdin=subprocess.DEVNULL, stdout=log, stderr=log) as process:
            time.sleep(2 * (time.monotonic() - start))
            assert process.poll() is None
            process.terminate()
    assert words not in (tmp_path / "log").read_bytes()


def test_contacts_are_solved_over_the_cycle(camroller, tmp_path):
    """Pressure and film across the contact, compared again by `rerun`."""
    path = tmp_path / "ehl.h5"
    arguments = ["ehl", "decks/numerical_film.nml", "-o", path, "--set", "sweep.values_1=300", "--set", "sweep.values_2=60"]
    done(camroller, *arguments)
    with h5py.File(path) as file:
        group = file["ehl"]
        assert (group["film"][0].min(axis=1) <= 1.01 * group["film_min"][0]).all()
    with h5py.File(path, "r+") as file:
        file["ehl/traction"][0, 7] += 1
    again = run(camroller, "rerun", path, folder=tmp_path)
    assert again.returncode == DIFFERENCE
    lines = [line for line in again.stderr.splitlines() if line.startswith("  ") and ":" in line]
    assert lines[0].startswith("  ehl/traction: in 1 case, at most by ") and "ehl/" not in "".join(lines[1:])


@pytest.mark.once
def test_heat_is_left_out_of_solved_contacts_and_of_the_formulas_beside_them(camroller, tmp_path):
    """At 900 rev/min and 25 degC heat in the inlet takes a tenth of the central film by its formula."""
    point = ["--set", "sweep.values_1=900", "--set", "sweep.values_2=25"]
    deck = tmp_path / "hot.nml"
    deck.write_text((ROOT / "decks/numerical_film.nml").read_text() + "\n&heat oil_conductivity_W_m_K = 0.14 /\n")
    for name, path in (("hot", deck), ("plain", ROOT / "decks/numerical_film.nml")):
        done(camroller, "ehl", path, *point, "-o", tmp_path / f"{name}.h5")
    with h5py.File(tmp_path / "hot.h5") as hot, h5py.File(tmp_path / "plain.h5") as plain:
        for quantity in ("film_central", "film_central_formula", "traction"):
            assert (hot["ehl"][quantity][...] == plain["ehl"][quantity][...]).all(), quantity


SMALL = ["--set", "sweep.values_1=300", "--set", "sweep.values_2=60"]


@pytest.mark.parametrize(("command", "change", "code", "words"), [
    ("ehl", "mechanism.contact_width_mm=1", DOMAIN, "above 1.5 GPa at cam angle "),
    ("run", "mechanism.contact_width_mm=1", DOMAIN, "above 1.5 GPa"),
    ("ehl", "lubricant.pressure_viscosity_coefficient_per_GPa=80", DOMAIN, "times peak pressure above 35 at cam angle "),
    ("run", "lubricant.pressure_viscosity_coefficient_per_GPa=80", DOMAIN, "times peak pressure above 35")])
def test_numerical_films_outside_their_range_are_an_error_and_no_file(camroller, tmp_path, command, change, code, words):
    """A contact too heavy, an oil too stiff."""
    path = tmp_path / "beyond.h5"
    result = run(camroller, command, ROOT / "decks/numerical_film.nml", "-o", path, *SMALL, "--set", change, folder=tmp_path)
    assert result.returncode == code, result.stderr
    assert words in result.stderr
    assert list(tmp_path.iterdir()) == []


def test_a_higher_accuracy_takes_more_nodes(camroller, tmp_path):
    """65 and 129 nodes differ by 2.9e-3 in the slip there, 129 and 257 by 1.2e-3; the file keeps every other node of 257."""
    path = tmp_path / "ehl.h5"
    result = run(camroller, "ehl", ROOT / "decks/numerical_film.nml", "-o", path, "--set", "sweep.values_1=900", "--set",
                 "sweep.values_2=95", "--set", "ehl.accuracy=2.5e-3", folder=tmp_path)
    assert result.returncode == 0, result.stderr
    line = next(line.split() for line in result.stdout.splitlines() if line.startswith("   0 "))
    assert float(line[6]) <= 0.25 and float(line[7]) <= 0.25 and line[9] == "257"
    with h5py.File(path) as file:
        assert file["ehl/pressure"].shape == (1, 720, 129)


def test_a_failed_case_of_ehl_has_no_numbers_and_the_others_do(camroller, tmp_path):
    path = tmp_path / "two.h5"
    study = ["--set", "sweep.values_1=300", "--set", "sweep.key_2=mechanism.contact_width_mm", "--set", "sweep.values_2=13.7, 1", "--set",
             "operating_point.oil_temperature_degC=60"]
    result = run(camroller, "ehl", ROOT / "decks/numerical_film.nml", "-o", path, *study, folder=tmp_path)
    assert result.returncode == DOMAIN, result.stderr
    with h5py.File(path) as file:
        for name in set(file["ehl"]) - {"angle", "node"}:
            values = file["ehl"][name][()]
            assert numpy.isfinite(values[0]).all(), name
            assert numpy.isnan(values[1]).all(), name
        assert list(file["summary/status"]) == [0, DOMAIN]
        messages = [text.decode() for text in file["run/messages"]]
    assert messages[0] == "" and messages[1].startswith("case 1 (operating_point.speed_rpm=300, mechanism.contact_width_mm=1): ehl: ")
    lines = result.stderr.splitlines()
    assert lines[1:] == ["all remarks are in /deck/remarks of the result file", f"camroller: 1 of 2 cases has no result: {messages[1]}"]
    assert "unusual" in lines[0]
    sweep = run(camroller, "sweep", ROOT / "decks/numerical_film.nml", "-o", path, "--resume", *study, folder=tmp_path)
    assert sweep.returncode == FILE and "it holds the solved contacts of 'camroller ehl'" in sweep.stderr


@pytest.mark.parametrize("policy, speeds, status", [("stop", "300,3000", [0, DOMAIN]), ("warn", "3000", [0])])
@pytest.mark.once
def test_contacts_that_are_lost_are_told_as_of_a_run(camroller, tmp_path, policy, speeds, status):
    """Without the film: by the margins and the angles of the rigid train."""
    values = ["--set", f"case.contact_policy={policy}", "--set", f"sweep.values_1={speeds}", "--set", "sweep.values_2=95", *COARSE]
    told = {}
    for command in ("run", "ehl"):
        result = run(camroller, command, THESIS, "-o", f"{command}.h5", *values, folder=tmp_path)
        assert result.returncode == status[-1], result.stderr
        with h5py.File(tmp_path / f"{command}.h5") as file:
            assert list(file["summary/status"]) == status
            texts = file["run/messages" if policy == "stop" else "run/warnings"][-1].decode().splitlines()
        lines = [line for line in result.stderr.splitlines() if "contact is lost for 2.81 % of the cycle at 3000 rev/min" in line]
        told[command] = [text for text in texts if "contact is lost" in text] + lines
    assert told["run"] == told["ehl"] and len(told["run"]) == 2
    again = run(camroller, "rerun", "ehl.h5", folder=tmp_path)
    assert again.returncode == 0 and "the same to the last bit" in again.stdout


def test_every_lobe_shape_is_solved_and_opens_in_xarray(camroller, tmp_path):
    """Both lobe shapes of a camshaft, in two tables and two groups."""
    path = tmp_path / "ehl.h5"
    text = (ROOT / "decks/three_cam_head.nml").read_text().replace("= 'tables/", f"= '{ROOT}/decks/tables/")
    (tmp_path / "deck.nml").write_text(text[:text.index("&sweep")])
    result = run(camroller, "ehl", "deck.nml", "-o", path, "--set", "operating_point.oil_temperature_degC=90", folder=tmp_path)
    assert result.returncode == 0, result.stderr
    assert [line.split()[:2] for line in result.stdout.splitlines() if line.startswith("   0 ")] == [["0", "1"], ["0", "2"]] * 2
    with xarray.open_datatree(path, engine="h5netcdf", phony_dims="sort") as tree:
        first, second = tree["ehl"], tree["ehl/second_lift"]
        for lobe in (first, second):
            assert lobe["pressure"].dims == lobe["film"].dims == ("case", "angle", "node")
            assert lobe["x"].dims == ("case", "node")
            assert all(lobe[name].dims == ("case", "angle") for name in ("film_min", "shear", "rolling_resistance_formula"))
            assert float(abs(lobe["energy_residual"]).max()) < 1e-9
        assert float(abs(first["load"] / second["load"] - 1).max()) > 0.05


def test_threads_of_the_linear_algebra_change_no_bit(camroller, tmp_path):
    """With their number the library rounds otherwise, so that the program takes one."""
    for threads in (1, 2):
        done(camroller, "run", "decks/numerical_film.nml", "-o", tmp_path / f"{threads}.h5", "--quiet", *SMALL, "--set",
             "output.angle_step_deg=40", "--set", "ehl.accuracy=0.1", "--set", "ehl.profiles=.true.",
             env=os.environ | {"OPENBLAS_NUM_THREADS": str(threads)})
    with h5py.File(tmp_path / "1.h5") as one, h5py.File(tmp_path / "2.h5") as two:
        for name in ("ehl/pressure", "ehl/film", "series/sliding_speed"):
            assert one[name][()].tobytes() == two[name][()].tobytes(), name


def test_a_run_writes_profiles_where_the_deck_asks(camroller, tmp_path):
    """Pressure and film of a run, over its own angles, with its load and slip; a case beyond solutions keeps its result."""
    path = tmp_path / "run.h5"
    arguments = ["run", "decks/numerical_film.nml", "-o", path, *SMALL, "--set", "output.angle_step_deg=2"]
    done(camroller, *arguments)
    with h5py.File(path) as file:
        assert "ehl" not in file
    done(camroller, *arguments, "--set", "ehl.profiles=.true.")
    with h5py.File(path) as file:
        assert file["ehl/pressure"].shape[:2] == file["series/contact_load"].shape == (1, 180)
        for mine, run in (("load", "contact_load"), ("sliding_speed", "sliding_speed")):
            assert numpy.allclose(file["ehl"][mine][0], file["series"][run][0], rtol=1e-12, atol=0)
        # the table is within one per cent of solutions; asperities at each place take some of the film's load
        assert numpy.allclose(file["ehl/film_min"][0], file["series/film_thickness_min"][0], rtol=0.03)


def test_solved_contacts_say_which_groups_and_loads_they_leave_out(camroller, tmp_path):
    """Means are over the angles with a film: none is below the smallest of it."""
    path = tmp_path / "solved.h5"
    result = run(camroller, "ehl", ROOT / "decks/hard/light_base_circle_load.nml", "-o", path, folder=tmp_path)
    smallest, mean = result.stdout.splitlines()[3].split()[2:4]
    assert float(mean) > float(smallest)
    with h5py.File(path) as file:
        load, peak = (file[f"ehl/{name}"][0] for name in ("load", "peak_pressure"))
        told = file["run/warnings"][0].decode()
    part = float(told.partition("the film is not solved for ")[2].split()[0])
    # In the file at 720 angles, between the steps
    assert abs(part - 100 * numpy.mean((load > 0) & ~(peak > 0))) < 1
    for deck, words in (("tribofilm", "&running_in is left out: "), ("dynamics", "&dynamics is left out: ")):
        done(camroller, "ehl", ROOT / f"decks/{deck}.nml", "-o", path, "--set", "sweep.values_1=900")
        with h5py.File(path) as file:
            assert words in file["run/warnings"][0].decode()


SMOOTH = re.sub(r"&asperity.*?^/$", "", (ROOT / "decks/numerical_film.nml").read_text(), flags=re.DOTALL | re.MULTILINE)


@pytest.mark.parametrize(("options", "words"), [
    ((300, 60, "lubricant.pressure_law=barus"), "the law 'barus' of viscosity over pressure holds to about 0.1 GPa"),
    ((30, 95), "the film between cam and roller is below 0.1 of the roughness for 100 % of the cycle"),
    ((900, 60, "traction.limiting_coefficient=0.003"), "traction.limit = 'mean' holds the shear of the film to 0.003 of the load"),
    ((300, 60, "film.range_policy=stop"), "film.range_policy=stop has no effect on solved contacts"),
    ((300, 60, "film.law=moes"), "has no effect in a run: it is used without &ehl, or with ehl.profiles = .true., or with effects.select = 'needed', "
     "or by 'camroller ehl'")])
@pytest.mark.once
def test_solved_contacts_have_the_remarks_on_films_of_a_run(camroller, tmp_path, options, words):
    speed, temperature, *others = options
    (tmp_path / "smooth.nml").write_text(SMOOTH)
    done = [camroller, "ehl", tmp_path / "smooth.nml", "-o", tmp_path / "x.h5"]
    for option in (f"sweep.values_1={speed}", f"sweep.values_2={temperature}", *others):
        done += ["--set", option]
    result = subprocess.run(done, capture_output=True, text=True, check=True)
    assert words in result.stderr
    assert ("below 0.1 of the roughness" in result.stderr) == (speed == 30)


@pytest.mark.parametrize(("deck", "words"), [("tribofilm", "between new surfaces"), ("dynamics", "at the speeds of a rigid one")])
def test_profiles_of_a_run_have_no_torques_and_say_what_is_not_in_them(camroller, tmp_path, deck, words):
    path = tmp_path / "run.h5"
    text = (ROOT / f"decks/{deck}.nml").read_text() + "\n&ehl\n   profiles = .true.\n/\n"
    (tmp_path / "deck.nml").write_text(text)
    done(camroller, "run", tmp_path / "deck.nml", "-o", path, "--set", "sweep.values_1=900", "--set", "output.angle_step_deg=10")
    with h5py.File(path) as file:
        assert words in file["run/warnings"][0].decode()
        assert "traction" in file["ehl"] and not {"torque_drive", "energy_residual"} & set(file["ehl"])


@pytest.mark.parametrize("heat", ["film", "none"])
def test_angles_of_profiles_that_are_not_solved_are_named_and_have_no_numbers(camroller, tmp_path, heat):
    """Oil that 3000 rev/min shear at -20 degC: film and temperature find no common state at some angles, while the isothermal film is
    found. At the others the temperature is one that the oil of a contact has: where mixtures of temperatures were not held above the
    lowest one, an iteration ran away to 2e13 K, and with run-time checks the program ended."""
    text = (ROOT / "decks/heated_contact.nml").read_text() + "\n&ehl\n   profiles = .true.\n/\n"
    (tmp_path / "deck.nml").write_text(text)
    isothermal = ("--set", "heat.inlet_law=none", "--set", "heat.contact=none") if heat == "none" else ()
    told = done(camroller, "run", "deck.nml", "-o", "run.h5", "--set", "sweep.values_1=3000", "--set", "sweep.values_2=-20",
                "--set", "output.angle_step_deg=4.5", *isothermal, folder=tmp_path).stderr
    with h5py.File(tmp_path / "run.h5") as file:
        data = {name: values[0] for name, values in file["ehl"].items() if isinstance(values, h5py.Dataset) and values.ndim > 1}
        angles = file["ehl/angle"][:]
    lost = numpy.isnan(data["peak_pressure"])
    for name, values in data.items():
        if name not in ("load", "sliding_speed", "x"):
            assert (numpy.isnan(values) == (lost if values.ndim == 1 else lost[:, None])).all(), name
    assert numpy.isfinite(data["load"]).all() and numpy.isfinite(data["sliding_speed"]).all()
    assert lost.any() == (heat == "film") and not lost.all()
    if heat == "film":
        assert (f"profiles have no numbers at some angles: the iteration of film, pressure and temperature did not end at {lost.sum()} of "
                f"80 angles, first at cam angle {angles[lost][0]:.3f} deg; isothermal profiles, with inlet_law = 'none' and "
                "contact = 'none' in &heat, need that of film and pressure alone\n") in told
        assert numpy.nanmax(data["film_rise"]) < 1000.0


def test_of_several_cases_that_with_most_angles_of_profiles_missing_is_told(camroller, tmp_path):
    text = (ROOT / "decks/heated_contact.nml").read_text() + "\n&ehl\n   profiles = .true.\n/\n"
    (tmp_path / "deck.nml").write_text(text)
    done(camroller, "run", "deck.nml", "-o", "run.h5", "--set", "sweep.values_1=3000,4000", "--set", "sweep.values_2=-20", "--set",
         "output.angle_step_deg=10", folder=tmp_path)
    with h5py.File(tmp_path / "run.h5") as file:
        missing = numpy.isnan(file["ehl/peak_pressure"][:]).sum(axis=1)
        worst = [case for text, case in zip(file["run/remarks/worst"].asstr(), file["run/remarks/worst_case"]) if "profiles have" in text]
    assert missing.min() > 0 and missing[0] != missing[1]
    assert worst == [missing.argmax()]


def test_a_film_beyond_its_table_is_not_one_outside_a_published_range(camroller, tmp_path):
    (tmp_path / "deck.nml").write_text(f"include = '{ROOT}/decks/hard/light_base_circle_load.nml'\n&ehl\n/\n")
    result = run(camroller, "run", "deck.nml", "-o", "run.h5", "--set", "film.range_policy=stop", folder=tmp_path)
    assert result.returncode == 4 and "the film is beyond the table of solved contacts for 6" in result.stderr


def test_friction_that_nearly_lifts_the_roller_off_ends_with_words(camroller, tmp_path):
    """The last step to the balance took more than all of the load there, and its root was no number."""
    deck = ROOT / "test/data/lifted_roller/deck.nml"
    result = run(camroller, "run", deck, "-o", tmp_path / "a.h5")
    assert result.returncode == 4 and "contact is lost for 0.57" in result.stderr
