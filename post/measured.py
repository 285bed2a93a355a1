"""Measured points beside computed results: read from a table, compared, drawn.

A table has one heading with units in brackets, as `cam angle [deg], torque [N m]`, `crank angle [deg], torque [N m]` or
`speed [rpm], temperature [degC], mean torque [N mm]`. Crank angles count from the firing dead centre of cylinder 1, as
`engine.full_lift_deg` does. Angles, in degrees or radians, are compared with the drive torque over one turn of the camshaft, or
with the friction torque where the column is called so; operating points with the mean friction torque of the one chosen case that has the same
speed and temperature, which is the mean of the drive torque as well. Differences are measured less computed. Columns that are not
compared are refused: a speed beside an angle chooses no case. Commas, semicolons or white space part the columns.
"""

from dataclasses import dataclass
from pathlib import Path
import re
import textwrap

from matplotlib.figure import Figure
import numpy as np

from layout import line_style
from quantities import given_shaft
from read import ResultError
from units import factor, number

ANGLES = ("cam angle", "crank angle")
DEGREES = {"deg": 1.0, "degree": 1.0, "degrees": 1.0, "°": 1.0, "rad": 180.0 / np.pi}  # in a unit of an angle
POINT = {"speed": ("rpm", "rev/min", "1/min"), "temperature": ("degC", "°C")}  # with the units that they may have
KEYS = {"speed": "operating_point.speed_rpm", "temperature": "operating_point.oil_temperature_degC"}
TONES = ["#08306b", "#7cc0ea", "#d55e00", "#1b7837", "#54278f", "0.4"]  # of temperatures
TITLE = 90  # characters of a line above a figure
SAME = 1e-6  # relative difference of two operating points that are one
AFTER_UNIT = re.compile(r'(?<=\])"?\s+')  # parts a heading without commas
ON_COMMAS = "; a comma parts columns, decimals have a point"  # as the program says of its own tables
HEADING = re.compile(r"^\s*(.*?)\s*\[\s*(.*?)\s*\]\s*$")


@dataclass
class Table:
    """Columns of measured values by name, angles in degrees, with the units of their headings."""

    path: Path
    columns: dict
    units: dict


@dataclass
class Comparison:
    """Measured and computed values at the same places, in one unit."""

    places: list
    measured: np.ndarray
    computed: np.ndarray
    unit: str
    left_out: int = 0

    @property
    def differences(self):
        """Measured less computed."""
        return self.measured - self.computed

    def words(self):
        """Bias, root mean square and the worst point in one line."""
        worst = int(np.argmax(np.abs(self.differences)))
        line = (f"{points(len(self.measured))}, bias {number(self.differences.mean(), 3)} {self.unit}, rms "
                f"{number(np.sqrt((self.differences ** 2).mean()), 3)} {self.unit}, worst "
                f"{number(self.differences[worst], 3)} {self.unit} at {self.places[worst]}")
        return line + (f"; {points(self.left_out)} {'has' if self.left_out == 1 else 'have'} no case" if self.left_out else "")


def points(count):
    """A number of points in words."""
    return f"{count} point" + "s" * (count != 1)


def read_table(path):
    """Read a table; raise ResultError with one line where it is none."""
    path = Path(path)
    try:
        lines = [(place, line) for place, line in enumerate(path.read_text(encoding="utf-8-sig").splitlines(), 1)
                 if line.strip() and not line.lstrip().startswith("#")]
    except (OSError, UnicodeDecodeError) as error:
        raise ResultError(f"{path}: cannot be read: {getattr(error, 'strerror', None) or 'no text in UTF-8'}") from None
    if len(lines) < 2:
        raise ResultError(f"{path}: a table has a heading and rows")
    heading = lines[0][1]
    parts = ";" if ";" in heading else ","
    names, units = [], {}
    for cell in heading.split(parts) if parts in heading else AFTER_UNIT.split(heading.strip()):
        found = HEADING.match(cell.strip('" '))
        if not found:
            raise ResultError(f"{path}: a heading is a name with its unit, as 'torque [N m]', not '{cell.strip()}'")
        names.append(found[1].lower())
        if names[-1] in units:
            raise ResultError(f"{path}: two columns are called '{names[-1]}'")
        units[names[-1]] = found[2]
    rows = []
    for place, line in lines[1:]:
        advice = ON_COMMAS if "," in line else ""
        try:
            rows.append([float(cell) for cell in line.split(parts if parts in line else None)])
        except ValueError:
            raise ResultError(f"{path}: line {place} is not of numbers: {line.strip()}{advice}") from None
        if len(rows[-1]) != len(names):
            raise ResultError(f"{path}: line {place} has {len(rows[-1])} of {len(names)} columns{advice}")
        if not np.isfinite(rows[-1]).all():
            raise ResultError(f"{path}: line {place}: only finite numbers are allowed, not {line.strip()}; leave out rows without a value")
    columns = dict(zip(names, np.array(rows).T))
    for name in set(ANGLES) & set(columns):
        if units[name] not in DEGREES:
            raise ResultError(f"{path}: the unit of '{name}' has to be {', '.join(list(DEGREES)[:-1])} or rad, not {units[name]}")
        columns[name] = DEGREES[units[name]] * columns[name]
    return Table(path, columns, units)


def is_over_angle(table):
    """Are the measured values over an angle?"""
    return any(name in table.columns for name in ANGLES)


def cases_for(table, result, cases):
    """The chosen cases that values are compared with: over an angle the first that has series; ResultError where none has."""
    if not is_over_angle(table):
        return cases
    there = result.cases_with_series()
    found = [case for case in cases if case in there]
    if not found:
        raise ResultError(f"{result.path}: no series of these cases in the file, which values over an angle are compared with")
    return found[:1]


def swept_words(result, case, keys):
    """Values that swept keys have in a case, as `law=moes, radius_mm=9.5`."""
    values = ((key.rpartition(".")[2], result.value_of(key, case)) for key in keys)
    return ", ".join(f"{name}={value:.6g}" if isinstance(value, float) else f"{name}={value}" for name, value in values)


def case_words(table, result, cases):
    """Which of several cases values over an angle are compared with, behind the name of the result."""
    if result.cases == 1 or not is_over_angle(table):
        return ""
    values = swept_words(result, cases[0], result.sweep)
    return f", case {cases[0]}" + (f" ({values})" if values else "")


def compare(table, result, cases):
    """Measured values beside the computed ones of the cases of a result; of the only one where they are over an angle."""
    if is_over_angle(table):
        return compare_angles(table, result, cases[0])
    if set(POINT) <= set(table.columns):
        return compare_points(table, result, cases)
    raise ResultError(f"{table.path}: the columns have to be an angle ({' or '.join(ANGLES)}) and a torque, or "
                      f"{', '.join(POINT)} and a mean torque; there is {', '.join(table.columns)}")


def need_all(table, *used):
    """ResultError where a table has a column that is not compared."""
    spare = [name for name in table.columns if name not in used]
    if spare:
        raise ResultError(f"{table.path}: the column '{spare[0]}' is not compared beside {', '.join(used)}: leave it out"
                          + ("; --cases chooses the case" if is_over_angle(table) else ""))


def torque_of(table):
    """Name of the column of a torque."""
    found = [name for name in table.columns if "torque" in name]
    if len(found) != 1:
        raise ResultError(f"{table.path}: one column has to be a torque, not {', '.join(found) or 'none'}")
    return found[0]


def compare_angles(table, result, case):
    """Torque over the angle."""
    angle_name = next(name for name in ANGLES if name in table.columns)
    torque_name = torque_of(table)
    need_all(table, angle_name, torque_name)
    series = "torque_friction" if "friction" in torque_name else "torque_drive"
    if series not in result.series:
        raise ResultError(f"{result.path}: no {series} over the angle in it")
    angle = cam_angle(result, case, table.columns[angle_name]) if angle_name == "crank angle" else table.columns[angle_name]
    curve = result.series[series].values[case] * unit_factor(table, torque_name)
    computed = np.interp(np.mod(angle, 360.0), np.append(result.cam_angle, result.cam_angle[0] + 360.0), np.append(curve, curve[0]))
    places = [f"{angle_name} {number(value, 4)} deg" for value in table.columns[angle_name]]
    return Comparison(places, table.columns[torque_name], computed, table.units[torque_name])


def cam_angle(result, case, crank):
    """Cam angle of a crank angle after the firing dead centre of cylinder 1."""
    if "crank_turns" not in result.summary:
        raise ResultError(f"{result.path}: crank angles need the group &engine in the deck")
    turns = result.scalar("crank_turns").values[case]
    return 180.0 + (crank - result.scalar("crank_angle_at_nose").values[case]) / turns


def unit_factor(table, name):
    """What SI values are multiplied with for the unit of a column."""
    found = factor("N m", table.units[name])
    if found is None:
        raise ResultError(f"{table.path}: the unit of '{name}' has to be N m or N mm, not {table.units[name]}")
    return found


def compare_points(table, result, cases):
    """Mean torque of operating points; ResultError where several of the cases are at one."""
    for name, units in POINT.items():
        if table.units[name] not in units:
            raise ResultError(f"{table.path}: the unit of '{name}' has to be {' or '.join(units)}, not {table.units[name]}")
    name = torque_of(table)
    need_all(table, *POINT, name)
    scale = unit_factor(table, name)
    torque = result.scalar("mean_torque_friction").values
    measured, computed, places, left_out = [], [], [], 0
    for speed, temperature, value in zip(*(table.columns[column] for column in (*POINT, name))):
        wanted = {"speed": speed, "temperature": temperature}
        found = [case for case in cases if np.isfinite(torque[case])
                 and all(abs(result.value_of(KEYS[key], case) - place) <= SAME * max(1.0, abs(place)) for key, place in wanted.items())]
        if not found:
            left_out += 1
            continue
        places.append(f"{number(speed, 4)} rev/min, {number(temperature, 4)} degC")
        if len(found) > 1:
            raise ResultError(f"{result.path}: {len(found)} cases are at {places[-1]}: {_named(result, found)}; choose with --cases")
        measured.append(value)
        computed.append(scale * torque[found[0]])
    if not measured:
        raise ResultError(f"{table.path}: none of its points is a chosen case of {result.path}")
    return Comparison(places, np.array(measured), np.array(computed), table.units[name], left_out)


def _named(result, cases, most=3):
    """Some cases, each with the values of the swept keys that are no operating point."""
    words = [f"case {case} ({values})" if (values := swept_words(result, case, _others(result))) else f"case {case}" for case in cases]
    return ", ".join(words[:most]) + (" ..." if len(words) > most else "")


def _others(result):
    """Swept keys that are no operating point."""
    return [key for key in result.sweep if key not in KEYS.values()]


def draw_comparison(table, result, cases, comparison):
    """Figure with the computed curve or points of the cases and the measured ones."""
    figure = Figure(figsize=(7.5, 4.6), layout="constrained")
    axes = figure.subplots()
    if is_over_angle(table):
        angle_name = next(name for name in ANGLES if name in table.columns)
        torque_name = torque_of(table)
        series = "torque_friction" if "friction" in torque_name else "torque_drive"
        case, angle, turn = cases[0], result.cam_angle, 360.0
        if angle_name == "crank angle":
            turns = result.scalar("crank_turns").values[case]
            turn = 360.0 * turns
            angle = np.mod(result.scalar("crank_angle_at_nose").values[case] + turns * (angle - 180.0), turn)
        order = np.argsort(angle)
        axes.plot(angle[order], result.series[series].values[case][order] * unit_factor(table, torque_name), color="#08306b",
                  label="computed")
        axes.plot(np.mod(table.columns[angle_name], turn), comparison.measured, "o", markersize=4, markerfacecolor="none", color="#d55e00",
                  label="measured")
        axes.set_xlabel(f"{angle_name}{' from the firing dead centre of cylinder 1' if angle_name == 'crank angle' else ''} [deg]")
        axes.set_ylabel(f"{torque_name} [{comparison.unit}]")
    else:
        _draw_points(axes, result, table, cases, comparison)
    axes.axhline(0.0, color="0.6", linewidth=0.7, zorder=0)
    axes.grid(True, color="0.9", linewidth=0.6)
    # Beside the axes: no place within them is free of points for certain
    figure.legend(loc="outside lower center", ncols=2, frameon=False)
    words = f"{result.title}{case_words(table, result, cases)} and {table.path.name}", comparison.words()
    axes.set_title("\n".join(textwrap.fill(line, TITLE) for line in words), fontsize="medium")
    return figure


def _draw_points(axes, result, table, cases, comparison):
    """Mean torque over speed: a colour for each temperature, a line for each combination of the other swept keys."""
    torque = result.scalar("mean_torque_friction").values * unit_factor(table, torque_of(table))
    speeds, temperatures = ({case: result.value_of(KEYS[name], case) for case in cases} for name in POINT)
    lines = {}
    for case in sorted(cases, key=speeds.get):
        lines.setdefault((temperatures[case], swept_words(result, case, _others(result))), []).append(case)
    drawn = sorted(set(temperatures.values()))
    styles = list(dict.fromkeys(others for _, others in lines))
    for (temperature, others), of_line in sorted(lines.items()):
        axes.plot([speeds[case] for case in of_line], torque[of_line], linestyle=line_style(styles.index(others)), marker=".",
                  color=TONES[drawn.index(temperature) % len(TONES)],
                  label=", ".join(filter(None, [f"computed, {temperature:g} degC", others])))
    for place, temperature in enumerate(drawn):
        of_it = np.abs(table.columns["temperature"] - temperature) <= SAME * max(1.0, abs(temperature))
        axes.plot(table.columns["speed"][of_it], table.columns[torque_of(table)][of_it], "o", markerfacecolor="none",
                  color=TONES[place % len(TONES)], label=f"measured, {temperature:g} degC" if of_it.any() else None)
    axes.set_xlabel(f"{given_shaft(result)} speed [rev/min]".strip())
    axes.set_ylabel(f"mean friction torque [{comparison.unit}]")
