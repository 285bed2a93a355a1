"""The package of Python: the wheel is built, installed in an empty environment, and gives the bits of the program."""

from __future__ import annotations

import json
import os
import re
import sys
import tomllib
import venv

import h5py
import numpy as np
import pytest

from conftest import CMAKE_BUILD, CMAKE_FLAGS, ROOT, alone_in_cmake, printed, run
from test_include import split_deck

DECK = ROOT / "decks" / "thesis.nml"

CHECK = """
import ctypes, json, sys
import camroller
from camroller import _library
deck = sys.argv[1]
answers = {}
rows = camroller.run(deck, threads=3)
answers["has_xarray"] = not isinstance(rows, list)
answers["varied"] = [varied for varied, _ in rows]
answers["friction"] = [result.scalars["mean_torque_friction"].hex() for _, result in rows]
answers["slip"] = [[value.hex() for value in result.series["sliding_speed"]] for _, result in rows]
answers["unit"] = rows[0][1].units["mean_torque_friction"]
case = camroller.Case(deck, set={"operating_point.speed_rpm": 600, "film.law": "moes"})
answers["set"] = case.run().scalars["mean_torque_friction"].hex()
answers["number"] = case.numbers["operating_point.speed_rpm"]
answers["swept_remark"] = case.remarks
answers["remark"] = camroller.Case(deck, set={"roller.mass_kg": 5.0, "case.title": "it's"}).remarks
errors = {}
for name, text in {"deck": "&lift law = 3 /", "line": "\\n\\n&nothing a = 1 /"}.items():
    try:
        camroller.Case.from_text(text)
    except camroller.DeckError as error:
        errors[name] = [error.line, error.code, str(error)]
try:
    camroller.Case("no such deck")
except camroller.FileError as error:
    errors["file"] = str(error)
try:
    case.set("roller.radius_mm", -1)
except camroller.DeckError as error:
    errors["value"] = str(error)
follower = camroller.Simulation(case, angle=1.0)
for name, angle, speed in (("backward", 0.5, 60.0), ("standstill", 1.1, 0.0), ("negative", 1.1, -1.0)):
    try:
        follower.step(angle, camroller.Inputs(speed, 333.15))
    except camroller.UsageError as error:
        errors[name] = str(error)
answers["errors"] = errors

def drive(what, turns=1):
    total = 0.0
    for i in range(1, 41):
        outcome = what.step(what.angle + 0.15, camroller.Inputs(60.0, 333.15), camroller.Inputs(61.0, 334.15))
        total += outcome.mean_torque_drive + outcome.torque_friction + outcome.estimated_error
    return total

drive(follower)
block, copy = follower.save(), follower.copy()
sums = [drive(follower), drive(copy), drive(camroller.Simulation.restore(case, block))]
answers["same"] = sums[0] == sums[1] == sums[2]
answers["load"] = follower.value("contact_load")
follower.step(follower.angle + 0.1, camroller.Inputs(60.0, 390.0))
answers["step_remarks"] = [(remark.kind, remark) for remark in follower.remarks]
shaft = camroller.Shaft(camroller.Case(sys.argv[2]), angle=0.0, threads=2)
drive(shaft)
answers["phases"] = [cam.phase for cam in shaft.cams]
answers["camshaft"] = shaft.values()
answers["shaft_remarks"] = [remark.kind for remark in shaft.remarks]
answers["by_name"] = shaft.value("torque_drive")
answers["names"] = [quantity.name for quantity in shaft.quantities(2)]
pressures = [[1e5, 2e5, 3e5], [1e5, 2e5, 3e5]]
answers["pressed"] = shaft.step(shaft.angle + 0.1, camroller.Inputs(60.0, 333.15), gas_pressures=pressures).torque_drive
try:
    shaft.step(shaft.angle + 0.1, camroller.Inputs(60.0, 333.15), gas_pressures=pressures[:1])
except camroller.UsageError as error:
    errors["pressures"] = str(error)
try:
    shaft.quantities(9)
except camroller.UsageError as error:
    errors["cam"] = str(error)
try:
    _library.call("shaft_values", shaft._pointer, 0, (ctypes.c_double * 2)(), 2)
except camroller.UsageError as error:
    errors["room"] = str(error)
inputs = camroller.Inputs(60.0, 333.15)
inputs.gas_pressure = 6e5
steps = [shaft.copy().step(shaft.angle + 0.1, pressed).mean_torque_drive.hex()
         for pressed in (inputs, camroller.Inputs(60.0, 333.15, 6e5), camroller.Inputs(60.0, 333.15))]
answers["gas"] = steps, inputs.gas_pressure, inputs.supply_pressure
joints = camroller.Case(sys.argv[3])
outcome = camroller.Simulation(joints).step(2.0, camroller.Inputs(60.0, 333.15))
answers["sums"] = [[outcome.mean_torque_drive, sum(outcome.mean_torques), outcome.mean_torque_others],
                   [outcome.torque_drive, sum(outcome.torques), outcome.torque_others]]
outcome = camroller.Shaft(joints).step(2.0, camroller.Inputs(60.0, 333.15))
answers["sums"] += [[outcome.mean_torque_drive, sum(outcome.mean_torques) + outcome.mean_torque_bearings, outcome.mean_torque_others],
                    [outcome.torque_drive, sum(outcome.torques) + outcome.torque_bearings, outcome.torque_others]]
place = ctypes.c_void_p(1)
answers["place"] = [_library.LIBRARY.camroller_case_from_file(None, ctypes.byref(place), None), place.value]
print(json.dumps(answers))
"""


@pytest.fixture(scope="module")
def installed(cmake_prefix, tmp_path_factory):
    """An environment with the wheel and nothing else: its Python, and the folder of its packages."""
    place = tmp_path_factory.mktemp("wheel")
    with alone_in_cmake():
        printed(sys.executable, "-m", "pip", "wheel", "--no-build-isolation", "--no-deps", "--no-index", "-w", place,
                "-C", f"build-dir={CMAKE_BUILD}", "-C", f"cmake.define.{CMAKE_FLAGS}", ROOT / "python")
    (wheel,) = place.glob("*.whl")
    assert wheel.name.startswith("camroller-") and "-py3-none-linux_" in wheel.name
    venv.create(place / "empty", with_pip=True)
    python = place / "empty" / "bin" / "python"
    printed(python, "-m", "pip", "install", "--no-index", "--no-deps", wheel)
    (packages,) = (place / "empty").glob("lib/python*/site-packages")
    return python, packages


@pytest.fixture(scope="module")
def answers(installed):
    clean = {name: value for name, value in os.environ.items() if not name.startswith(("PYTHON", "LD_"))}
    return json.loads(printed(installed[0], "-c", CHECK, DECK, ROOT / "decks" / "three_cam_head.nml", ROOT / "decks" / "sliding_joints.nml",
                              env=clean))


def test_results_have_the_bits_of_the_program(answers, cmake_io_prefix, tmp_path):
    # bits are the same within one set of compiler options, here those with which tests build by CMake
    camroller = cmake_io_prefix / "bin/camroller"
    printed(camroller, "run", DECK, "-o", tmp_path / "deck.h5", "--quiet")
    with h5py.File(tmp_path / "deck.h5") as file:
        friction = np.asarray(file["summary/mean_torque_friction"])
        slip = np.asarray(file["series/sliding_speed"])
    assert not answers["has_xarray"] and answers["unit"] == "N m"
    assert [float.fromhex(word) for word in answers["friction"]] == friction.ravel().tolist()
    assert [[float.fromhex(word) for word in row] for row in answers["slip"]] == slip.reshape(friction.size, -1).tolist()
    assert answers["varied"][5] == {"operating_point.speed_rpm": 600.0, "operating_point.oil_temperature_degC": 95.0}
    printed(camroller, "run", DECK, "-o", tmp_path / "one.h5", "--quiet", "--point", "speed_rpm=600", "--set", "film.law='moes'")
    with h5py.File(tmp_path / "one.h5") as file:
        assert float.fromhex(answers["set"]) == np.asarray(file["summary/mean_torque_friction"]).item()
    assert answers["number"] == 600.0
    assert answers["swept_remark"] == []
    assert [text.split()[0] for text in answers["remark"]] == ["roller.mass_kg"]


def test_errors_are_exceptions_with_the_line_of_the_deck(answers):
    errors = answers["errors"]
    assert errors["deck"][:2] == [1, 3] and "takes one text in quotes" in errors["deck"][2]
    assert errors["line"][0] == 3
    assert "no such deck" in errors["file"] and "radius_mm" in errors["value"]
    assert "backward" in errors["backward"] and "halt" in errors["standstill"] and "positive" in errors["negative"]
    assert "each of the 3 cams" in errors["pressures"] and "there is no cam 9" in errors["cam"]
    assert "room for fewer numbers" in errors["room"]
    assert answers["place"] == [2, None]


def test_torques_by_source_add_up_and_pressures_count_where_they_are_set(answers):
    for drive, listed, others in answers["sums"]:
        assert others > 1e-4 * drive > 0 and listed + others == pytest.approx(drive, rel=1e-12)
    steps, gas, supply = answers["gas"]
    assert steps[0] == steps[1] != steps[2] and gas == 6e5 and supply is None


def test_steps_have_remarks(answers):
    far = [words for kind, words in answers["step_remarks"] if kind == "oil far from its points"]
    assert len(far) == 1 and far[0].startswith("the oil temperature, 116.85 degC, is 21.85 K above")
    assert "oil far from its points" not in answers["shaft_remarks"]


def test_copies_and_saved_states_continue_with_the_same_bits(answers):
    assert answers["same"] and answers["load"] > 0.0


def test_a_shaft_has_its_cams_and_names(answers):
    assert np.allclose(answers["phases"], np.radians([0, 120, 240]))
    assert answers["by_name"] == answers["camshaft"]["torque_drive"]
    assert {"contact_load", "film_thickness_min", "hertz_pressure", "slip_ratio"} <= set(answers["names"])
    assert answers["pressed"] != answers["by_name"]


def test_a_dataset_has_swept_keys_as_coordinates_beside_numpy(installed):
    """In this environment, where numpy has its own OpenBLAS, used before and after."""
    words = """
import numpy as np
np.linalg.inv(np.eye(300) + 1.0)
import camroller, sys
data = camroller.run(sys.argv[1], sweep={"operating_point.speed_rpm": [300, 900], "film.law": ["moes", "dowson_higginson"]}, threads=2)
assert data.mean_torque_friction.dims == ("operating_point.speed_rpm", "film.law"), data
assert data.sliding_speed.dims[-1] == "cam_angle" and data.cam_angle.attrs["units"] == "rad"
one = camroller.Case(sys.argv[1], set={"operating_point.speed_rpm": 900, "film.law": "moes"}).run()
assert one.scalars["mean_torque_friction"] == float(data.mean_torque_friction.sel({"operating_point.speed_rpm": 900, "film.law": "moes"}))
assert np.array_equal(np.asarray(one.series["contact_load"]), data.contact_load[1, 0])
case = camroller.Case(sys.argv[1])
camroller.run(case, set={"roller.mass_kg": 0.02})
assert case.numbers["roller.mass_kg"] != 0.02
np.linalg.inv(np.eye(300) + 1.0)
print("fine")
"""
    done = printed(sys.executable, "-c", words, DECK, env={**os.environ, "PYTHONPATH": str(installed[1])})
    assert done.strip() == "fine"


def test_the_wheel_contains_all_libraries_that_it_needs(installed):
    folder = installed[1] / "camroller" / "lib"
    needed = printed("ldd", next(folder.glob("libcamroller_bundle.so.*")))
    for name in ("libgfortran.so.5", "libquadmath.so.0", "libopenblas.so.0"):
        assert f"{name} => {folder}/{name}" in needed, needed


def test_declared_functions_agree_with_the_header(installed):
    words = """
import re, sys
from camroller import _library
header = set(re.findall(r"\\bcamroller_(\\w+)\\(", open(sys.argv[1]).read()))
declared = set(_library.CALLS) | set(_library.PLAIN)
assert declared <= header, declared - header
"""
    printed(installed[0], "-c", words, ROOT / "include" / "camroller.h")


def in_python(installed, words, *arguments, **variables):
    """What a script prints in this environment, where numpy is."""
    return printed(sys.executable, "-c", words, DECK, *arguments,
                   env={**os.environ, "PYTHONPATH": str(installed[1]), **variables}).split()


def test_copies_by_the_module_copy_are_copies_and_nothing_is_pickled(installed):
    """A second object over the same thing of the library would free it twice."""
    words = """
import camroller, copy, gc, pickle, sys
case = camroller.Case(sys.argv[1])
result = case.run()
inputs = camroller.Inputs(60.0, 333.15)
for what in (case, camroller.Simulation(case, 0.0), camroller.Shaft(case, 0.0)):
    for made in (copy.copy(what), copy.deepcopy([what])[0]):
        assert type(made) is type(what) and made._pointer.value != what._pointer.value
        if made is not case and hasattr(made, "step"):
            assert made.step(0.1, inputs).mean_torque_drive == what.copy().step(0.1, inputs).mean_torque_drive
    del made
    gc.collect()
    try:
        pickle.dumps(what)
    except TypeError as error:
        assert "cannot be pickled" in str(error), error
    else:
        raise SystemExit("pickled")
for attempt in (copy.copy, copy.deepcopy, pickle.dumps):
    try:
        attempt(result)
    except TypeError as error:
        assert "copied" in str(error) or "pickled" in str(error), error
    else:
        raise SystemExit("a result was copied")
print("fine")
"""
    assert in_python(installed, words) == ["fine"]


def test_values_of_numpy_texts_with_a_mark_and_wrong_ones(installed):
    words = """
import camroller, numpy as np, sys
text = open(sys.argv[1]).read()
folder = sys.argv[2]
case = camroller.Case.from_text("\\ufeff" + text, folder)
case.set("operating_point.speed_rpm", np.int64(700))
assert case.numbers["operating_point.speed_rpm"] == 700.0
case.set("operating_point.speed_rpm", np.float32(700.5))
assert case.numbers["operating_point.speed_rpm"] == 700.5
case.set("cam_bearings.bearing_series", np.bool_(True))
case.set("cam_bearings.bearing_positions_mm", np.array([0.0, 61.0]))
case.check()
for attempt, kind in ((lambda: case.set("operating_point.speed_rpm\\0", 1), camroller.UsageError),
                      (lambda: case.set("case.title", "a\\0b"), camroller.UsageError),
                      (lambda: camroller.Case.from_text(text + "\\0 nonsense", folder), camroller.UsageError),
                      (lambda: camroller.Case("a\\0b"), camroller.UsageError),
                      (lambda: case.set("operating_point.speed_rpm", None), TypeError)):
    try:
        attempt()
    except kind:
        continue
    raise SystemExit("taken")
try:
    camroller.Case.from_text(text.encode(), folder)
except TypeError as error:
    assert "must be a str, not bytes" in str(error), error
camroller.run_cases = None
for values, kind in (([[0, 60], [0, 61]], camroller.UsageError), ([], camroller.UsageError), ("moes", TypeError), (5, TypeError)):
    try:
        camroller.run(case, sweep={"cam_bearings.bearing_positions_mm": values})
    except kind as error:
        assert "sweep" in str(error)
    else:
        raise SystemExit("a sweep of lists was run")
try:
    camroller.run(case, sweep={" Output.angle_step_deg": [0.5, 1]})
except camroller.UsageError as error:
    assert "keys of &output cannot be swept" in str(error), error
else:
    raise SystemExit("a sweep of angles was run")
print("fine")
"""
    assert in_python(installed, words, DECK.parent) == ["fine"]


def test_what_is_no_case_is_refused(installed):
    """The library would take the memory of anything for a case."""
    words = """
import camroller, sys
case = camroller.Case(sys.argv[1])
result, follower = case.run(), camroller.Simulation(case)
for wrong in (result, follower, sys.argv[1], None):
    for attempt in (lambda: camroller.Simulation(wrong), lambda: camroller.Simulation.restore(wrong, b"x" * 10),
                    lambda: camroller.Shaft(wrong), lambda: camroller.Shaft.restore(wrong, b"x" * 10),
                    lambda: list(camroller.run_cases([wrong]))):
        try:
            attempt()
        except TypeError as error:
            assert "expected a Case, not " + type(wrong).__name__ in str(error), error
        else:
            raise SystemExit("taken")
print("fine")
"""
    assert in_python(installed, words) == ["fine"]


def test_keys_that_fit_only_together_are_set_at_once(installed):
    words = """
import camroller, sys
values = {"cam_bearings.cam_positions_mm": [0, 50], "cam_bearings.cam_phases_deg": [0, 180], "cam_bearings.cam_lobes": [1, 2],
          "cam_bearings.follower_angles_deg": [0, 0]}
case = camroller.Case(sys.argv[2], set=values)
assert len(camroller.Shaft(case).cams) == 2
text = open(sys.argv[2]).read()
assert len(camroller.Shaft(camroller.Case.from_text(text, sys.argv[3], set=values)).cams) == 2
for key, value in values.items():
    try:
        camroller.Case(sys.argv[2]).set(key, value)
    except camroller.DeckError:
        continue
    raise SystemExit("one alone is taken")
before = case.numbers
try:
    case.set_all({"roller.mass_kg": 0.02, "roller.radius_mm": -1})
except camroller.DeckError:
    assert case.numbers == before
print("fine")
"""
    assert in_python(installed, words, DECK.with_name("three_cam_head.nml"), DECK.parent) == ["fine"]


def test_a_value_that_the_sweep_replaces_is_refused(installed):
    words = """
import camroller, sys
key = "operating_point.speed_rpm"
case = camroller.Case(sys.argv[1], set={" Operating_Point.SPEED_rpm": 777})
assert case.run().scalars and case.numbers[key] == 777.0
for attempt in (lambda: camroller.run(sys.argv[1], set={key: 777}), lambda: camroller.run(case), lambda: next(case.copy().sweep())):
    try:
        attempt()
    except camroller.UsageError as error:
        assert key in str(error) and "sweep" in str(error), error
    else:
        raise SystemExit("not used, and not told")
assert len(camroller.run(case, sweep={"film.law": ["moes"]})) > 0
try:
    camroller.run(sys.argv[1], set={key: 777}, sweep={key.upper(): [700, 900]})
except camroller.UsageError as error:
    assert "in set and in sweep" in str(error), error
else:
    raise SystemExit("given twice")
print("fine")
"""
    assert in_python(installed, words) == ["fine"]


def test_torques_by_source_have_names(installed):
    words = """
import camroller, sys
case = camroller.Case(sys.argv[2])
follower, shaft, inputs = camroller.Simulation(case), camroller.Shaft(case), camroller.Inputs(60.0, 333.15)
outcome = follower.step(2.0, inputs)
shaft.step(2.0, inputs)
others = ("torque_drive", "torque_friction", "torque_bearings")
names = [name for name in shaft.values() if name.startswith("torque_") and name not in others]
assert {"torque_tip", "torque_seal", "torque_pivot", "torque_contact"} <= set(names), names
torques = {name: follower.value(name) for name in names}
assert torques == {name: shaft.value(name, 1) for name in names}
assert torques["torque_contact"] == outcome.torques[1] and torques["torque_tip"] > 0.0
assert abs(sum(torques.values()) - outcome.torque_drive) < 1e-12
print("fine")
"""
    assert in_python(installed, words, DECK.with_name("sliding_joints.nml")) == ["fine"]


@pytest.mark.once
def test_mistakes_after_a_change_have_their_places_in_included_files(installed, camroller, tmp_path):
    """Also in a case of the sweep, whose deck is without the lines of its sweep: the places that the program names."""
    deck = split_deck(tmp_path)
    text = deck.read_text(encoding="utf-8")
    first = text.index("&sweep")
    last = text.index("/\n", first) + 2
    deck.write_text(text[first:last] + text[:first] + text[last:], encoding="utf-8")
    values = {"lift.law": "table", "lubricant.temperature_law": "direct", "traction.shear_law": "eyring"}
    words = """
import camroller, json, sys
case = camroller.Case(sys.argv[2])
varied = next(case.sweep())[1]
varied.set("roller.mass_kg", 0.02)
messages = []
for made in (case, varied):
    try:
        made.set_all(json.loads(sys.argv[3]))
    except camroller.DeckError as error:
        messages.append(str(error).split())
print(*sum(messages, []))
"""
    said = run(camroller, "check", deck, *[f"--set={key}='{value}'" for key, value in values.items()])
    expected = said.stderr[:said.stderr.index("\nremark:")].removeprefix("camroller: ").split()
    assert f"{tmp_path}/parts/oil.nml:2:1:" in expected and expected.count("|") == 6
    assert in_python(installed, words, deck, json.dumps(values)) == expected * 2


def test_the_library_of_the_package_has_one_blas_thread(installed):
    words = """
import camroller, ctypes, pathlib
(path,) = pathlib.Path(camroller.__file__).parent.glob("lib/libopenblas.so*")
print(ctypes.CDLL(str(path)).openblas_get_num_threads())
"""
    assert in_python(installed, words, OPENBLAS_NUM_THREADS="2") == ["1"]


def test_the_wheel_leaves_the_folder_of_make_install_alone():
    """Where CMake keeps settings: with those of the wheel no program is built, and runtime libraries go beside those of the system."""
    settings = tomllib.loads((ROOT / "python" / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["scikit-build"]
    folder = (ROOT / "python" / settings["build-dir"]).resolve()
    commands = printed("make", "-n", "install", "PREFIX=/nowhere")
    (installed,) = re.findall(r"-S \. -B (\S+)", commands)
    (described,) = re.findall(r"cmake -S \. -B (\S+)", (ROOT / "doc" / "hosts.md").read_text(encoding="utf-8"))
    assert installed == described
    assert folder.parent == ROOT / "build" and folder not in (ROOT / installed, CMAKE_BUILD)


def test_make_install_gives_all_settings_of_the_wheel_anew():
    """In a folder that was configured for a wheel."""
    settings = tomllib.loads((ROOT / "python" / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["scikit-build"]
    commands = printed("make", "-n", "install", "PREFIX=/nowhere")
    assert set(settings["cmake"]["define"]) <= set(re.findall(r"-D(\w+)=", commands))
