"""FMUs of both versions of FMI: validated and run by FMPy, which has to give the bits of the library."""

from __future__ import annotations

import concurrent.futures
import ctypes
import math
import os
import pathlib
import shutil
import subprocess
import sys
import zipfile

import fmpy
import fmpy.fmi2
import fmpy.fmi3
import numpy as np
import pytest
from fmpy.validation import validate_fmu

ROOT = pathlib.Path(__file__).resolve().parents[2]
DECK = ROOT / "decks" / "three_cam_head.nml"
VERSIONS = ("2", "3")
STEPS = 40
# Of a sentence that the core tells of a step
CORE_WORDS = b"oil temperature"
ADJUSTER = ["--set", "operating_point.speed_rpm=600", "--set", "numerics.accuracy=1e-3"]


@pytest.fixture(scope="module")
def package(installed_package):
    """The package of Python over the same library."""
    sys.path.insert(0, str(installed_package))
    import camroller
    yield camroller
    sys.path.remove(str(installed_package))


@pytest.fixture(scope="module")
def write(camroller, cmake_prefix, tmp_path_factory):
    """Write an FMU of a deck."""
    place = tmp_path_factory.mktemp("fmu")

    def made(version, deck=DECK, name="head", words=()):
        path = place / f"{name}{version}.fmu"
        if not path.exists():
            done = subprocess.run([camroller, "fmu", str(deck), "-o", str(path), "--fmi", version, "--library",
                                   str(cmake_prefix / "lib" / "camroller"), *words], capture_output=True, text=True, check=False)
            assert done.returncode == 0, done.stderr
        return path

    return made


class Unit:
    """An instance of an FMU, by names of variables."""

    def __init__(self, path, folder, name="one", token=None, messages=None):
        self.description = fmpy.read_model_description(str(path))
        self.numbers = {variable.name: variable.valueReference for variable in self.description.modelVariables}
        if not folder.exists():
            fmpy.extract(str(path), unzipdir=str(folder))
        kind = fmpy.fmi3.FMU3Slave if self.description.fmiVersion == "3.0" else fmpy.fmi2.FMU2Slave
        self.unit = kind(guid=token or self.description.guid, unzipDirectory=str(folder), instanceName=name,
                         modelIdentifier=self.description.coSimulation.modelIdentifier)
        self.is_3 = self.description.fmiVersion == "3.0"
        self.messages, self.statuses = [] if messages is None else messages, []
        self.time = 0.0
        if self.is_3:
            self.unit.instantiate(logMessage=self.hear_3)
        else:
            functions = fmpy.fmi2.fmi2CallbackFunctions()
            functions.logger = fmpy.fmi2.fmi2CallbackLoggerTYPE(self.hear_2)
            functions.allocateMemory = fmpy.fmi2.fmi2CallbackAllocateMemoryTYPE(fmpy.calloc)
            functions.freeMemory = fmpy.fmi2.fmi2CallbackFreeMemoryTYPE(fmpy.free)
            self.unit.instantiate(callbacks=functions)

    def hear_2(self, environment, name, status, category, message):
        self.hear_3(environment, status, category, message)

    def hear_3(self, environment, status, category, message):
        self.messages.append(message.decode())
        self.statuses.append((status, category.decode()))

    def set(self, name, value):
        numbers = [self.numbers[name]]
        if isinstance(value, bool):
            self.unit.setBoolean(numbers, [value])
        elif self.is_3:
            self.unit.setFloat64(numbers, [value])
        else:
            self.unit.setReal(numbers, [value])

    def get(self, name):
        return (self.unit.getFloat64 if self.is_3 else self.unit.getReal)([self.numbers[name]])[0]

    def start(self, **values):
        if self.is_3:
            self.unit.enterInitializationMode(startTime=self.time)
        else:
            self.unit.setupExperiment(startTime=self.time)
            self.unit.enterInitializationMode()
        for name, value in values.items():
            self.set(name, value)
        self.unit.exitInitializationMode()

    def step(self, length):
        self.unit.doStep(currentCommunicationPoint=self.time, communicationStepSize=length)
        self.time += length

    def drive(self, count=10, length=1e-3):
        """Sum of what some steps give."""
        total = 0.0
        for _ in range(count):
            self.step(length)
            total += self.get("mean_torque_drive") + self.get("cam[2].contact_load")
        return total

    def state(self, call, *arguments):
        """A call on states: FMPy has them in other letters for FMI 2."""
        if not self.is_3:
            call = call.replace("FMUState", "FMUstate").replace("deserialize", "deSerialize")
        return getattr(self.unit, call)(*arguments)

    def end(self):
        self.unit.terminate()
        self.unit.freeInstance()


@pytest.mark.parametrize("version", VERSIONS)
def test_fmpy_has_no_findings(write, version):
    path = write(version)
    assert validate_fmu(str(path)) == []
    description = fmpy.read_model_description(str(path))
    by_name = {variable.name: variable for variable in description.modelVariables}
    assert by_name["speed"].causality == "input" and by_name["speed"].unit == "rad s-1"
    assert by_name["cam[3].gas_pressure"].unit == "Pa"
    assert by_name["roller.mass_kg"].causality == "parameter" and float(by_name["roller.mass_kg"].start) == 0.0105
    assert by_name["cam[1].film_thickness_min"].unit == "m"
    assert "film thickness" in by_name["cam[1].film_thickness_min"].description
    bases = {unit.name: unit.baseUnit for unit in description.unitDefinitions}
    # kg, m, s of watts and of pressures; an angle of a parameter in degrees
    assert (bases["W"].kg, bases["W"].m, bases["W"].s, bases["W"].factor) == (1, 2, -3, 1.0)
    assert (bases["GPa"].kg, bases["GPa"].m, bases["GPa"].s, bases["GPa"].factor) == (1, -1, -2, 1e9)
    assert (bases["degree"].rad, bases["rad s-1"].rad, bases["rad s-1"].s) == (1, 1, -1)
    assert bases["degree"].factor == pytest.approx(math.pi / 180, rel=1e-15)
    assert None not in bases.values() and {variable.unit for variable in description.modelVariables} <= {None, *bases}
    with zipfile.ZipFile(path) as archive:
        assert archive.testzip() is None
        names = archive.namelist()
    assert names[0] == "modelDescription.xml"
    assert any(name.endswith("libgfortran.so.5") for name in names) and "resources/gas_force.txt" in names


@pytest.mark.parametrize("version", VERSIONS)
def test_a_run_by_fmpy_has_the_bits_of_the_library(write, package, version):
    path = write(version)
    start = {variable.name: variable.start for variable in fmpy.read_model_description(str(path)).modelVariables}
    speed, temperature = float(start["speed"]), float(start["oil_temperature"])
    length = 2 * math.pi / speed / STEPS
    times = np.arange(STEPS + 1) * length
    ripple = speed * (1 + 0.05 * np.sin(4 * speed * times))
    slopes = np.append(np.diff(ripple) / np.diff(times), 0.0)
    signals = np.array(list(zip(times, ripple, slopes)), dtype=[("time", "f8"), ("speed", "f8"), ("speed_slope", "f8")])
    names = ["cam_angle", "mean_torque_drive", "mean_torque_bearings", "estimated_error", "torque_drive", "cam[2].contact_load",
             "cam[3].slip_ratio"]
    result = fmpy.simulate_fmu(str(path), stop_time=times[-1], step_size=length, output_interval=length, output=names, input=signals)
    shaft = package.Shaft(package.Case(DECK), 0.0)
    rows = []
    for i in range(STEPS):
        h = result["time"][i + 1] - result["time"][i]
        first = float(np.interp(result["time"][i], times, ripple))
        end = first + slopes[i] * h
        outcome = shaft.step(shaft.angle + 0.5 * (first + end) * h, package.Inputs(first, temperature), package.Inputs(end, temperature))
        rows.append((shaft.angle, outcome.mean_torque_drive, outcome.mean_torque_bearings, outcome.estimated_error,
                     shaft.value("torque_drive"), shaft.value("contact_load", 2), shaft.value("slip_ratio", 3)))
    assert len(result) == STEPS + 1
    for name, values in zip(names, zip(*rows)):
        assert result[name][1:].tolist() == list(values), name
    assert all(result[name][0] == 0.0 for name in names)


@pytest.mark.parametrize("version", VERSIONS)
def test_states_are_taken_put_back_and_serialised(write, tmp_path, version):
    unit = Unit(write(version), tmp_path / "unit")
    unit.start()
    unit.drive()
    kept = unit.state("getFMUState")
    block = unit.state("serializeFMUState", kept)
    time = unit.time
    first = unit.drive()
    unit.state("setFMUState", kept)
    unit.time = time
    assert unit.drive() == first
    other = Unit(write(version), tmp_path / "unit", "other")
    other.start()
    again = other.state("deserializeFMUState", block)
    other.state("setFMUState", again)
    other.time = time
    assert other.drive() == first
    with pytest.raises(Exception):
        other.state("deserializeFMUState", block[:-8])
    assert "damaged" in other.messages[-1]
    for one, kept_state in ((unit, kept), (other, again)):
        one.state("freeFMUState", kept_state)
        one.end()


@pytest.mark.parametrize("version", VERSIONS)
def test_parameters_are_keys_of_the_deck_and_pressures_inputs(write, package, tmp_path, version):
    unit = Unit(write(version), tmp_path / "unit")
    unit.start(**{"roller.mass_kg": 0.02, "start_angle": 0.5, "gas_pressure_is_input": True, "cam[2].gas_pressure": 2e5,
                  "cam[2].gas_pressure_slope": 1e7})
    shaft = package.Shaft(package.Case(DECK, set={"roller.mass_kg": 0.02}), 0.5)
    speed, temperature = unit.get("speed"), unit.get("oil_temperature")
    unit.step(1e-3)
    outcome = shaft.step(0.5 + speed * 1e-3, package.Inputs(speed, temperature), gas_pressures=[[0, 2e5, 0], [0, 2e5 + 1e4, 0]])
    assert unit.get("mean_torque_drive") == outcome.mean_torque_drive
    with pytest.raises(Exception):
        unit.set("roller.mass_kg", 0.01)
    assert "before the end of the initialisation" in unit.messages[-1]
    unit.end()


@pytest.mark.parametrize("version", VERSIONS)
def test_a_flexible_train_takes_its_supply_pressure_from_an_input(write, package, tmp_path, version):
    """Only a deck with a lash adjuster has that input; states of the train are serialised."""
    deck = ROOT / "decks" / "lash_adjuster.nml"
    path = write(version, deck, "adjuster", ADJUSTER)
    assert validate_fmu(str(path)) == []
    names = {variable.name for variable in fmpy.read_model_description(str(path)).modelVariables}
    others = {variable.name for variable in fmpy.read_model_description(str(write(version))).modelVariables}
    inputs = {"supply_pressure", "supply_pressure_slope", "supply_pressure_is_input"}
    assert inputs <= names and not inputs & others and "cam[1].chamber_pressure" in names
    unit = Unit(path, tmp_path / "unit")
    unit.start(supply_pressure_is_input=True, supply_pressure=3e5, supply_pressure_slope=-1e7)
    speed, temperature = unit.get("speed"), unit.get("oil_temperature")
    case = package.Case(deck, set={"operating_point.speed_rpm": 600, "numerics.accuracy": 1e-3})
    shaft = package.Shaft(case, 0.0)
    unit.step(1e-3)
    outcome = shaft.step(speed * 1e-3, package.Inputs(speed, temperature, supply_pressure=3e5),
                         package.Inputs(speed, temperature, supply_pressure=2.9e5))
    assert unit.get("mean_torque_drive") == outcome.mean_torque_drive
    assert unit.get("cam[1].chamber_pressure") == shaft.value("chamber_pressure", 1)
    block = unit.state("serializeFMUState", unit.state("getFMUState"))
    unit.set("supply_pressure_slope", 0.0)
    unit.step(30e-3)
    other = Unit(path, tmp_path / "unit", "other")
    other.start(supply_pressure_is_input=True)
    other.state("setFMUState", other.state("deserializeFMUState", block))
    other.time = 1e-3
    other.set("supply_pressure_slope", 0.0)
    other.step(30e-3)
    for name in ("mean_torque_drive", "cam[1].chamber_pressure", "cam[1].lift_error"):
        assert unit.get(name) == other.get(name) != 0.0
    for one in (unit, other):
        one.end()


def spoken(unit):
    """What an FMU has told, but for the remark on the film law of the base circle, whose light load is outside its range."""
    return [message for message in unit.messages if "the film law is outside its published range" not in message]


@pytest.mark.parametrize("version", VERSIONS)
def test_remarks_on_the_deck_are_warnings(write, tmp_path, version):
    unit = Unit(write(version), tmp_path / "unit")
    unit.start()
    assert unit.messages == []
    odd = Unit(write(version), tmp_path / "unit", "odd")
    odd.start(**{"roller.mass_kg": 5.0})
    assert len(odd.messages) == 1 and "roller.mass_kg" in odd.messages[0] and odd.statuses == [(1, "logStatusWarning")]
    odd.drive(1)
    assert {category.name for category in odd.description.logCategories} == {"logStatusError", "logStatusWarning"}
    for one in (unit, odd):
        one.end()


@pytest.mark.parametrize("version", VERSIONS)
def test_remarks_on_steps_are_warnings_once_of_each_kind(write, tmp_path, version):
    """Oil far beyond its points is told of with the first step that has it, and not with the next."""
    unit = Unit(write(version), tmp_path / "unit")
    unit.start()
    unit.step(1e-3)
    before = len(unit.messages)
    unit.set("oil_temperature", 440.0)
    unit.step(1e-3)
    assert len(unit.messages) == before + 1 and "oil temperature, 166.85 degC" in unit.messages[-1]
    assert unit.statuses[-1] == (1, "logStatusWarning")
    unit.step(1e-3)
    assert len(unit.messages) == before + 1
    unit.end()


@pytest.mark.parametrize("version", VERSIONS)
def test_a_parameter_that_changes_which_outputs_there_are_is_refused(write, tmp_path, version):
    """With fewer modes the numbers of those left out were whatever memory held; with more the first step failed."""
    words = [*ADJUSTER, "--set", "spring_surge.modes=2"]
    unit = Unit(write(version, ROOT / "decks" / "dynamics.nml", "surge", words), tmp_path / "unit")
    assert "cam[1].spring_mode_2" in unit.numbers and "cam[1].spring_mode_3" not in unit.numbers
    for modes in (1, 3):
        with pytest.raises(Exception):
            unit.start(**{"spring_surge.modes": modes})
        assert "spring_surge.modes: with such values there are other outputs" in unit.messages[-1] and "--set" in unit.messages[-1]
        with pytest.raises(Exception):
            unit.step(1e-3)
        unit.unit.reset()
    unit.start(**{"spring_surge.modes": 2})
    unit.step(1e-3)
    assert unit.get("cam[1].spring_mode_2") != 0.0
    unit.end()


@pytest.mark.parametrize("version", VERSIONS)
def test_a_choice_of_effects_is_of_runs(write, package, tmp_path, version):
    """An FMU has all effects, which its writing and every start tell."""
    words = ["--set", "effects.select=needed", "--set", "effects.negligible=0.1", "--set", "effects.quantity=slip"]
    unit = Unit(write(version, ROOT / "decks" / "thesis.nml", "choice", words), tmp_path / "unit")
    unit.start()
    unit.step(1e-3)
    remark = "effects.select = 'needed' is of runs"
    assert len(spoken(unit)) == 1 and remark in spoken(unit)[0] and set(unit.statuses) == {(1, "logStatusWarning")}
    case = package.Case(ROOT / "decks" / "thesis.nml", set={"effects.select": "needed", "effects.negligible": 0.1, "effects.quantity": "slip"})
    assert [line for line in case.remarks if remark in line] and not [line for line in case.run().remarks if remark in line]
    outcome = package.Shaft(package.Case(ROOT / "decks" / "thesis.nml"), 0.0).step(
        unit.get("speed") * 1e-3, package.Inputs(unit.get("speed"), unit.get("oil_temperature")))
    assert unit.get("mean_torque_drive") == outcome.mean_torque_drive
    unit.end()


@pytest.mark.parametrize("version", VERSIONS)
def test_parameters_that_fit_only_together_are_taken(write, package, tmp_path, version):
    """A thicker wall needs the thinner needles, which come behind it."""
    deck = ROOT / "decks" / "thesis.nml"
    values = {"roller.wall_thickness_mm": 6.6, "needle_bearing.needle_radius_mm": 0.7}
    unit = Unit(write(version, deck, "thesis"), tmp_path / "unit")
    unit.start(**values)
    shaft = package.Shaft(package.Case(deck, set=values), 0.0)
    unit.step(1e-3)
    outcome = shaft.step(unit.get("speed") * 1e-3, package.Inputs(unit.get("speed"), unit.get("oil_temperature")))
    assert unit.get("mean_torque_drive") == outcome.mean_torque_drive
    unit.end()


@pytest.mark.parametrize("version", VERSIONS)
def test_pressures_that_do_not_count_are_told_once(write, tmp_path, version):
    deck = ROOT / "decks" / "lash_adjuster.nml"
    for name, path, given in (("gas", write(version), {"cam[2].gas_pressure_slope": 1e7}),
                              ("supply", write(version, deck, "adjuster", ADJUSTER), {"supply_pressure": 3e5})):
        parameter = f"{name}_pressure_is_input"
        inputs = [variable for variable in fmpy.read_model_description(str(path)).modelVariables if f"{name}_pressure" in variable.name
                  and variable.causality == "input"]
        assert len(inputs) > 1 and all(f"used where {parameter} is true" in variable.description for variable in inputs)
        unit = Unit(path, tmp_path / name)
        unit.start()
        unit.step(1e-3)
        assert spoken(unit) == []
        for again in range(2):
            for variable, value in given.items():
                unit.set(variable, value)
            unit.step(1e-3)
            unit.step(1e-3)
            assert len(spoken(unit)) == again + 1 and parameter in spoken(unit)[-1] and set(unit.statuses) == {(1, "logStatusWarning")}
            unit.unit.reset()
            unit.time = 0.0
            unit.start()
        unit.unit.reset()
        unit.time = 0.0
        unit.start(**{parameter: True}, **given)
        unit.step(1e-3)
        assert len(spoken(unit)) == 2
        unit.end()


@pytest.mark.parametrize("version", VERSIONS)
def test_outputs_are_calculated_from_the_start_on(write, version):
    """Those with an exact start could be set by an importer before the initialisation."""
    description = fmpy.read_model_description(str(write(version)))
    outputs = {variable.name for variable in description.modelVariables if variable.causality == "output"}
    assert {variable.name for variable in description.modelVariables if variable.initial == "calculated"} == outputs
    assert {unknown.variable.name for unknown in description.initialUnknowns} == outputs
    assert all(variable.start is None for variable in description.modelVariables if variable.causality == "output")


@pytest.mark.parametrize("version", VERSIONS)
def test_after_a_standstill_an_instance_starts_anew(write, tmp_path, version):
    """At the time and the angle at which the engine turns again."""
    unit, new = (Unit(write(version), tmp_path / "unit", name) for name in ("one", "new"))
    unit.start()
    unit.drive(2)
    unit.set("speed", 0.0)
    with pytest.raises(Exception):
        unit.step(1e-3)
    assert "reset the FMU" in unit.messages[-1]
    angle = unit.get("cam_angle")
    unit.unit.reset()
    for one, time in ((unit, 5.0), (new, 0.0)):
        one.time = time
        one.start(start_angle=angle)
    assert unit.drive() == new.drive()
    for one in (unit, new):
        one.end()


@pytest.mark.parametrize("version", VERSIONS)
def test_impossible_inputs_are_errors_with_messages(write, tmp_path, version):
    unit = Unit(write(version), tmp_path / "unit")
    unit.start()
    unit.drive(2)
    for name, value, word in (("speed", 0.0, "stands"), ("speed", -5.0, "backward"), ("speed_slope", -1e6, "above zero"),
                              ("oil_temperature", -1.0, "temperature")):
        before = unit.get(name)
        unit.set(name, value)
        with pytest.raises(Exception):
            unit.step(1e-3)
        assert word in unit.messages[-1], unit.messages
        unit.set(name, before)
    with pytest.raises(Exception):
        unit.unit.doStep(currentCommunicationPoint=0.0, communicationStepSize=1e-3)
    assert "where the one before ended" in unit.messages[-1]
    unit.drive(1)
    wrong = Unit(write(version), tmp_path / "unit", "wrong")
    with pytest.raises(Exception):
        wrong.start(**{"roller.radius_mm": -1.0})
    assert "radius_mm" in wrong.messages[-1]
    for one in (unit, wrong):
        one.unit.freeInstance()


@pytest.mark.parametrize("version", VERSIONS)
def test_instances_in_threads_give_the_same_bits_as_alone(write, tmp_path, version):
    path = write(version)
    units = [Unit(path, tmp_path / "unit", f"number {i}") for i in range(6)]

    def work(i):
        units[i].start(start_angle=0.1 * i)
        return units[i].drive()

    with concurrent.futures.ThreadPoolExecutor(6) as pool:
        together = list(pool.map(work, range(6)))
    for i, unit in enumerate(units):
        unit.unit.reset()
        unit.time = 0.0
        assert work(i) == together[i]
        unit.end()


@pytest.mark.parametrize("version", VERSIONS)
def test_an_instance_with_the_token_of_another_fmu_is_refused(write, tmp_path, version):
    """Numbers of variables of one description mean something else to the resources of another one."""
    other = fmpy.read_model_description(str(write(version, ROOT / "decks" / "lash_adjuster.nml", "adjuster", ADJUSTER))).guid
    for token in (other, fmpy.read_model_description(str(write(version))).guid + "0", "{}"):
        heard = []
        with pytest.raises(Exception):
            Unit(write(version), tmp_path / "unit", token=token, messages=heard)
        assert len(heard) == 1 and "is not that of the FMU" in heard[0]
    unit = Unit(write(version), tmp_path / "unit")
    unit.start()
    unit.end()
    table = tmp_path / "unit" / "resources" / "variables.txt"
    table.write_text(table.read_text().partition("\n")[2])
    heard = []
    with pytest.raises(Exception):
        Unit(write(version), tmp_path / "unit", messages=heard)
    assert heard == ["resources/variables.txt of the FMU is damaged"]


def test_fmus_in_one_process_have_the_core_that_each_brings(write, tmp_path):
    """One that was made by another build of the same version must not go on with the core of the first one."""
    first = Unit(write("3"), tmp_path / "3")
    fmpy.extract(str(write("2")), unzipdir=str(tmp_path / "2"))
    changed = 0
    for path in (tmp_path / "2" / "binaries").rglob("*.so*"):
        assert not path.name.startswith("libcamroller")
        content = path.read_bytes()
        changed += content.count(CORE_WORDS)
        path.write_bytes(content.replace(CORE_WORDS, CORE_WORDS.upper()))
    assert changed > 0
    second = Unit(write("2"), tmp_path / "2")
    for unit, words in ((first, CORE_WORDS), (second, CORE_WORDS.upper())):
        unit.start()
        unit.set("oil_temperature", -1.0)
        with pytest.raises(Exception):
            unit.step(1e-3)
        assert words.decode() in unit.messages[-1]
        unit.unit.freeInstance()


@pytest.fixture(scope="module")
def comma_locale(tmp_path_factory):
    """A locale whose numbers have a comma: the folder that it is in, and its name."""
    if shutil.which("localedef") is None or not pathlib.Path("/usr/share/i18n/locales/de_DE").exists():
        pytest.skip("localedef or the source of a locale is not installed")
    place = tmp_path_factory.mktemp("locales")
    subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", str(place / "de_DE.UTF-8")], check=True, capture_output=True)
    return place, "de_DE.UTF-8"


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.once
def test_numbers_are_whole_under_a_locale_with_a_comma(write, tmp_path, comma_locale, version):
    """In a process of its own: numbers that are read at the start, and a parameter that is set."""
    script = tmp_path / "drive.py"
    script.write_text("""
import locale, pathlib, sys
sys.path.insert(0, sys.argv[1])
import test_fmu
if sys.argv[4]:
    locale.setlocale(locale.LC_ALL, sys.argv[4])
    assert locale.localeconv()["decimal_point"] == ","
unit = test_fmu.Unit(pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3]))
unit.start(**{"roller.mass_kg": 0.0125, "start_angle": 0.5})
names = ("speed", "oil_temperature", "roller.radius_mm")
print(*[unit.get(name).hex() for name in names], unit.drive().hex(), unit.messages)
""")
    place, name = comma_locale
    drives = [subprocess.run([sys.executable, str(script), str(ROOT / "test" / "python"), str(write(version)), str(tmp_path / "unit"), word],
                             capture_output=True, text=True, check=True, env={**os.environ, "LOCPATH": str(place)}).stdout
              for word in ("", name)]
    assert drives[0] == drives[1] and "0x" in drives[0]


@pytest.mark.parametrize("version", VERSIONS)
def test_a_state_is_made_of_bytes_whatever_its_place_held(write, tmp_path, version):
    """The standards have it as an output only."""
    unit = Unit(write(version), tmp_path / "unit")
    unit.start()
    block = unit.state("serializeFMUState", unit.state("getFMUState"))
    call = unit.unit.dll[f"fmi{version}De" + ("serializeFMUState" if version == "3" else "SerializeFMUstate")]
    place = ctypes.c_void_p(0x1234)
    content = (ctypes.c_char * len(block)).from_buffer_copy(bytes(block))
    assert call(ctypes.c_void_p(unit.unit.component), content, ctypes.c_size_t(len(block)), ctypes.byref(place)) == 0
    assert place.value not in (None, 0x1234)
    unit.end()


@pytest.mark.parametrize("version", VERSIONS)
def test_steps_without_length_are_refused_and_the_operating_point_is_no_parameter(write, tmp_path, version):
    unit = Unit(write(version), tmp_path / "unit")
    assert "roller.mass_kg" in unit.numbers and not any(name.startswith("operating_point.") for name in unit.numbers)
    unit.start()
    for length in (math.nan, math.inf, 0.0, -1e-3):
        with pytest.raises(Exception):
            unit.unit.doStep(currentCommunicationPoint=0.0, communicationStepSize=length)
        assert "length" in unit.messages[-1]
    unit.end()


def test_the_library_of_an_fmu_has_one_blas_thread(write, tmp_path):
    words = ("import ctypes, pathlib, sys; sys.path.insert(0, sys.argv[1]); import test_fmu\n"
             "unit = test_fmu.Unit(pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3]))\n"
             "(path,) = pathlib.Path(sys.argv[3]).glob('binaries/*/libopenblas.so*')\n"
             "print(ctypes.CDLL(str(path)).openblas_get_num_threads())")
    done = subprocess.run([sys.executable, "-c", words, str(ROOT / "test" / "python"), str(write("3")), str(tmp_path / "unit")],
                          capture_output=True, text=True, check=True, env={**os.environ, "OPENBLAS_NUM_THREADS": "2"})
    assert done.stdout.split() == ["1"]


def test_both_versions_and_both_writings_are_alike(write, camroller, cmake_prefix, tmp_path):
    again = tmp_path / "head3.fmu"
    subprocess.run([camroller, "fmu", str(DECK), "-o", str(again), "--library", str(cmake_prefix / "lib" / "camroller"), "--quiet"],
                   check=True)
    assert again.read_bytes() == write("3").read_bytes()


def test_remarks_on_the_deck_are_told_where_an_fmu_is_written(camroller, cmake_prefix, tmp_path):
    words = [camroller, "fmu", str(ROOT / "decks" / "thesis.nml"), "-o", str(tmp_path / "x.fmu"), "--library",
             str(cmake_prefix / "lib" / "camroller"), "--set", "effects.select=needed", "--set", "roller.mass_kg=5"]
    told = subprocess.run(words, capture_output=True, text=True, check=True).stderr
    assert "remark: effects.select = 'needed' is of runs" in told and "remark: roller.mass_kg = 5 is unusual" in told
    assert subprocess.run([*words, "--quiet"], capture_output=True, text=True, check=True).stderr == ""


def test_one_cam_and_other_folders(write, camroller, tmp_path):
    """A deck without camshaft bearings; an FMU without a library, which says what to do."""
    path = write("3", ROOT / "decks" / "thesis.nml", "thesis")
    assert validate_fmu(str(path)) == []
    names = {variable.name for variable in fmpy.read_model_description(str(path)).modelVariables}
    assert "cam[1].contact_load" in names and "cam[2].contact_load" not in names and "cam[1].gas_pressure" not in names
    done = subprocess.run([camroller, "fmu", str(DECK), "-o", str(tmp_path / "x.fmu"), "--library", str(tmp_path)],
                          capture_output=True, text=True, check=False)
    assert done.returncode == 6 and "cmake --install" in done.stderr and not (tmp_path / "x.fmu").exists()


def test_the_library_of_an_fmu_shows_the_functions_of_fmi_alone(cmake_prefix):
    library = cmake_prefix / "lib" / "camroller" / "camroller_fmi.so"
    shown = subprocess.run(["nm", "-D", "--defined-only", str(library)], capture_output=True, text=True, check=True).stdout
    names = {line.split()[-1] for line in shown.splitlines()}
    assert all(name.startswith(("fmi2", "fmi3")) for name in names)
    opened = ctypes.CDLL(str(library))
    opened.fmi3GetVersion.restype = opened.fmi2GetVersion.restype = ctypes.c_char_p
    assert opened.fmi3GetVersion() == b"3.0" and opened.fmi2GetVersion() == b"2.0"


# Behind the end of the third, in the program's memory, are letters that are not its own
PLACES = {"file:///tmp/a%20b%C3%A9": b"/tmp/a b\xc3\xa9", "file://host/tmp/100%a/x": b"/tmp/100%a/x", "file:///tmp/a%5\\0XYZ": b"/tmp/a%5",
          "file:///tmp/a%": b"/tmp/a%", "file:///tmp/50% 7/x": b"/tmp/50% 7/x", "file:///tmp/a%+7b": b"/tmp/a%+7b", "/tmp/a": b"/tmp/a"}


@pytest.mark.parametrize("place", PLACES)
def test_place_of_the_resources_is_read_from_its_address(tmp_path, place):
    """A percent sign without two hexadecimal digits is one."""
    source = tmp_path / "place.c"
    source.write_text('#include "fmi_2.c"\nint main(void) {\n   char path[64];\n'
                      f'   path_of("{place}", path, sizeof path);\n   fputs(path, stdout);\n   return 0;\n}}\n')
    program = tmp_path / "place"
    subprocess.run(["gcc", "-std=c11", f"-I{ROOT / 'fmi'}", f"-I{ROOT / 'include'}", "-ffunction-sections", "-Wl,--gc-sections", source,
                    "-o", program], check=True)
    assert subprocess.run([program], check=True, capture_output=True).stdout == PLACES[place]
