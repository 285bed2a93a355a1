"""Quantities of the figures: series or scalar, label and unit of display."""

from dataclasses import dataclass

import numpy as np

from read import ResultError, Series
from units import factor

SPEED = "operating_point.speed_rpm"  # of the shaft that `engine.given_speed` names, where there is an engine


class Missing(Exception):
    """No file holds the series that a figure needs."""


@dataclass(frozen=True)
class Curve:
    """A series over the cam angle."""

    title: str
    series: str
    unit: str  # blank: that which suits the values, on an axis that is logarithmic where cases differ much
    whole_cycle: bool = False  # in a single figure; else the event
    scale: str = "linear"
    touching: bool = False  # means nothing where the roller does not touch the cam
    least_top: float = 0.0  # of the values axis, in the unit
    lines: tuple = ()  # values that mean something, in the unit
    floor: float = 0.0  # where a logarithmic axis ends though values are below, in the unit


CURVES = {
    "lift": Curve("valve lift", "valve_lift", "mm"),
    "load": Curve("contact load", "contact_load", "N"),
    "pressure": Curve("Hertz pressure", "hertz_pressure", "GPa"),
    "entrainment": Curve("entrainment speed", "entrainment_speed", "m/s"),
    "acceleration": Curve("valve acceleration", "valve_acceleration", "m/s2"),
    "film": Curve("minimum film", "film_thickness_min", "um", scale="log", touching=True),
    "film_ratio": Curve("film ratio", "film_ratio", "1", scale="log", touching=True, lines=(1.0, 3.0)),
    "load_share": Curve("load carried by asperities", "asperity_load_share", "%", touching=True, least_top=100.0),
    "friction": Curve("contact friction", "friction_contact", "N"),
    "friction_coefficient": Curve("friction coefficient", "friction_coefficient", "1", touching=True),
    "boundary_share": Curve("boundary part of friction", "asperity_friction_share", "%", touching=True, least_top=100.0),
    "rolling": Curve("rolling friction", "friction_rolling", "N", whole_cycle=True),
    "slip": Curve("slip ratio", "slip_ratio", "%", whole_cycle=True, scale="log"),
    "axial_pressure": Curve("largest pressure along the roller", "axial_pressure_max", "GPa"),
    "edge_pressure": Curve("pressure at the end of the roller", "edge_pressure", "GPa"),
    "subsurface_stress": Curve("largest shear stress below the surface", "subsurface_shear_stress", "MPa"),
    "sliding_distance": Curve("sliding distance of a place on the cam", "sliding_distance", "um", touching=True),
    "wear_depth": Curve("depth worn away from the cam", "cam_wear_depth", "", whole_cycle=True),
    "tribofilm": Curve("tribofilm on the cam", "cam_film_thickness", "nm", whole_cycle=True),
    "boundary_coefficient": Curve("boundary coefficient", "boundary_coefficient", "1", touching=True),
    "wear": Curve("wear depth of a turn over specific wear rate", "wear_product", "N/m", touching=True),
    "friction_torque": Curve("friction torque", "torque_friction", "N mm"),  # friction in N mm, drive torque in N m, in every figure
    "total_torque": Curve("drive torque", "torque_drive", "N m"),
}
OVERVIEW = {name: CURVES[name] for name in ("load", "entrainment", "film", "friction", "boundary_share", "rolling", "slip",
                                             "total_torque")}
# A flexible train on one page, beside its load
TRAIN = {
    "load": CURVES["load"],
    "load_error": Curve("load less rigid load", "load_error", "N", lines=(0.0,)),
    "lift_error": Curve("lift less rigid lift", "lift_error", "um"),
    "valve_speed": Curve("valve's speed", "valve_velocity", "m/s", lines=(0.0,)),
    "gap": Curve("gap at the cam", "contact_gap", "um"),
    "joint_force": Curve("pivot's joint", "joint_force", "N", lines=(0.0,)),
    "surge": Curve("spring's first mode", "spring_mode_1", "um"),
    "plunger": Curve("plunger's travel", "plunger_travel", "um"),
    "chamber_pressure": Curve("adjuster's pressure", "chamber_pressure", "MPa"),
}
ADJUSTER = " and lash adjuster"  # words that are said of trains with one
# Summary name, words, colour, hatch
SOURCES = [("mean_torque_contact", "cam/roller contact", "#08306b", ""),
           ("mean_torque_bearings", "cam bearings", "#d55e00", "///"),
           ("mean_torque_needle", "roller bearing", "#7cc0ea", ""),
           ("mean_torque_guide", "valve guide", "#f0e442", "xxx"),
           ("mean_torque_damping", "dampers" + ADJUSTER, "#8a5a9e", "..."),
           ("mean_torque_tip", "valve tip", "#7f3b08", ""),
           ("mean_torque_seal", "stem seal", "#f4b6c2", "///"),
           ("mean_torque_guide_side", "ends of the guide", "#9a8700", "..."),
           ("mean_torque_pivot", "pivot", "#b5179e", ""),
           ("mean_torque_needle_drag", "oil drag of the needles", "#7f7f7f", "xxx"),
           ("mean_torque_shaft_drag", "seals and drive", "#2a9d8f", "...")]
# The same over the cam angle: series, words, colour in each file, line style, line width
PARTS = [(name.replace("mean_", ""), words, (colour.replace("#f0e442", "#9a8700"),), style, 1.4)
         for (name, words, colour, _), style in zip(SOURCES, (
             "-", "--", "-.", ":", (0, (8, 2)), (0, (1, 3)), (0, (6, 1, 1, 1)), (0, (3, 3)), (0, (8, 2, 2, 2)), (0, (2, 1)),
             (0, (12, 2))),
             strict=True)]
# Series, words, colour in each file, line style, line width: the thin line of the whole lies on the broad one of the geometric part
TORQUES = [("torque_geometric", "geometric", ("#7cc0ea", "#8fd19e", "#c9b3e6"), "-", 3.0),
           ("torque_friction", "friction", ("#d55e00", "#e6a100", "#b5179e"), "--", 1.4),
           ("torque_drive", "drive: all together", ("#08306b", "#1b7837", "#54278f"), "-", 1.1)]


LARGEST_SHEAR = 0.300283  # below a line contact over its peak pressure, at 0.78615 half widths (Hertz; Johnson 1985, section 4.4)


def add_derived(result):
    """Add to a result what follows from its series: friction coefficient, load share of asperities, valve acceleration, wear.

    The acceleration is a central difference of the valve's speed, which follows the lift of a rigid train; a flexible one has its own.
    """
    series = result.series
    if "contact_load" not in series:
        return

    def over_load(name):
        load = series["contact_load"].values
        return series[name].values / np.where(load > 0.0, load, np.nan)

    if "friction_contact" in series:
        series["friction_coefficient"] = Series(lambda: over_load("friction_contact"), "1",
                                                "friction of the contact relative to its load")
    if "asperity_load" in series:
        series["asperity_load_share"] = Series(lambda: over_load("asperity_load"), "1", "part of the load on asperities")
    _add_wear(series)
    if "valve_velocity" in series and result.value_of(SPEED, 0) is not None:
        speed = camshaft_speed(result) * np.pi / 30.0  # [rad/s]

        def acceleration():
            values = series["valve_velocity"].values
            slope = (np.roll(values, -1, axis=1) - np.roll(values, 1, axis=1)) / np.radians(2.0 * 360.0 / values.shape[1])
            return slope * speed[:, None]

        series.setdefault("valve_acceleration", Series(acceleration, "m/s2", "acceleration of the valve"))


def given_shaft(result):
    """Shaft whose speed the deck gives; empty without an engine, where there is none but the camshaft."""
    return str(result.value_of("engine.given_speed", 0) or "")


def camshaft_speed(result):
    """Speed of the camshaft in each case [rev/min], whichever shaft's the deck gives; not-a-number for a case that does not tell."""
    speed = np.array([result.value_of(SPEED, case) for case in range(result.cases)], dtype=float)
    return speed / result.scalar("crank_turns").values if given_shaft(result) == "crankshaft" else speed


def _add_wear(series):
    """Shear stress below the surface; how far each place on the cam slides on the roller in a passage, and how much it is worn.

    The contact, 2 b wide, passes a place at the speed V_c of the contact over the cam, while the surfaces slide by V_s: the distance is
    2 b |V_s|/V_c. Archard (1953) has a depth of wear k p s for a pressure p over a distance s, with the specific wear rate k [m2/N]; over
    the width of the contact p s adds up to (W_a/L) |V_s|/V_c, the load per length that asperities carry times V_s/V_c. Times k that is the
    depth of a turn. W/L is 2 b times the mean pressure, pi/4 of the peak.
    """
    peak, half, slide, speed = (series.get(name) for name in ("hertz_pressure", "hertz_half_width", "sliding_speed", "cam_surface_speed"))
    if peak is None:
        return
    # A case with &wear has this and the next one itself
    largest = series.get("axial_pressure_max", peak)  # along the roller, where the deck gives its profile
    series.setdefault("subsurface_shear_stress", Series(lambda: LARGEST_SHEAR * largest.values, "Pa",
                                                        "largest shear stress below the surface, without traction"))
    if half is None or slide is None or speed is None:
        return

    def turns():
        with np.errstate(invalid="ignore", divide="ignore"):
            return np.abs(slide.values) / np.abs(speed.values)

    series.setdefault("sliding_distance", Series(lambda: 2.0 * half.values * turns(), "m",
                                                 "sliding distance of a place on the cam in a passage"))
    if "asperity_load_share" in series:
        series["wear_product"] = Series(lambda: 0.5 * np.pi * peak.values * half.values * turns() * series["asperity_load_share"].values,
                                        "N/m", "depth of wear of a place on the cam in a turn over the specific wear rate")


def values_of(layout, entry, name, unit):
    """Values of a series in one case in a unit for people; None where the file does not have it."""
    quantity = layout.results[entry.file].series.get(name)
    return None if quantity is None else quantity.values[entry.case] * _factor(quantity, name, unit)


def curve_of(layout, entry, curve):
    """Values of a curve, gaps where it means nothing without contact; None where the file does not have it."""
    values = values_of(layout, entry, curve.series, curve.unit)
    load = layout.results[entry.file].series.get("contact_load")
    if values is None or load is None or not curve.touching:
        return values
    return np.where(load.values[entry.case] <= 0.0, np.nan, values)


def mean_of(layout, entry, name, unit):
    """A scalar of one case in a unit for people; None where the file does not have it."""
    result = layout.results[entry.file]
    if name not in result.summary:
        return None
    quantity = result.scalar(name)
    return float(quantity.values[entry.case]) * _factor(quantity, name, unit)


def _factor(quantity, name, unit):
    found = factor(quantity.units, unit)
    if found is None:
        raise ResultError(f"{name} has the unit '{quantity.units}', which cannot be shown in {unit}")
    return found


def source_words(layout, words):
    """Words of a source of friction, without the lash adjuster where no train has one."""
    has_adjuster = any(key.startswith("lash_adjuster.") for number in layout.files
                       for key in (*layout.results[number].deck, *layout.results[number].sweep))
    return words if has_adjuster else words.removesuffix(ADJUSTER)


def has_series(layout, name):
    """Whether at least one file has the series."""
    return any(name in layout.results[number].series for number in layout.files)


def is_nothing(layout, name):
    """Whether a series is zero wherever there is one, as a gap where contact is never lost."""
    return not any(np.any(series[name].values) for series in (layout.results[number].series for number in layout.files) if name in series)


def need_series(layout, *names):
    """Missing with the names, unless at least one file has each of them."""
    absent = [name for name in names if not has_series(layout, name)]
    if absent:
        none_at_all = all(layout.results[number].cases > 1 and not layout.results[number].series for number in layout.files)
        raise Missing(f"no {' or '.join(absent)} in the file" + ("s" if len(layout.files) > 1 else "")
                      + (": a sweep keeps series only with series = 'all' or 'chosen' in &sweep" if none_at_all else ""))
