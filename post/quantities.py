"""What can be drawn: which series or scalar, under which name and in which unit for people."""

from dataclasses import dataclass

import numpy as np

from read import ResultError
from units import factor


class Missing(Exception):
    """No file holds the series that a figure needs."""


@dataclass(frozen=True)
class Curve:
    """A series over the cam angle."""

    title: str
    series: str
    unit: str
    whole_cycle: bool = False  # in a single figure; else the event
    scale: str = "linear"
    touching: bool = False  # means nothing where the roller does not touch the cam
    least_top: float = 0.0  # of the values axis, in the unit


CURVES = {
    "lift": Curve("valve lift", "valve_lift", "mm"),
    "load": Curve("contact load", "contact_load", "N"),
    "pressure": Curve("Hertz pressure", "hertz_pressure", "GPa"),
    "entrainment": Curve("entrainment speed", "entrainment_speed", "m/s"),
    "film": Curve("minimum film", "film_thickness_min", "um", scale="log", touching=True),
    "friction": Curve("contact friction", "friction_contact", "N"),
    "boundary_share": Curve("boundary part of friction", "asperity_friction_share", "%", touching=True, least_top=1.0),
    "rolling": Curve("rolling friction", "friction_rolling", "N", whole_cycle=True),
    "slip": Curve("slip ratio", "slip_ratio", "%", whole_cycle=True, scale="log"),
    "friction_torque": Curve("friction torque", "torque_friction", "N m"),
    "total_torque": Curve("drive torque", "torque_drive", "N m"),
}
OVERVIEW = ["load", "entrainment", "film", "friction", "boundary_share", "rolling", "slip", "total_torque"]
# Summary name, words, colour, hatch
SOURCES = [("mean_torque_contact", "cam/roller contact", "#08306b", ""),
           ("mean_torque_bearings", "cam bearings", "#d55e00", "///"),
           ("mean_torque_needle", "needle bearing", "#7cc0ea", ""),
           ("mean_torque_guide", "valve guide", "#f0e442", "xxx")]
# Series, words, colour in each file, line style, line width: the thin line of the whole lies on the broad one of the geometric part
TORQUES = [("torque_geometric", "geometric", ("#7cc0ea", "#8fd19e", "#c9b3e6"), "-", 3.0),
           ("torque_friction", "friction", ("#d55e00", "#e6a100", "#b5179e"), "--", 1.4),
           ("torque_drive", "drive: all together", ("#08306b", "#1b7837", "#54278f"), "-", 1.1)]


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


def has_series(layout, name):
    """Whether at least one file has the series."""
    return any(name in layout.results[number].series for number in layout.files)


def need_series(layout, *names):
    """Missing with the names, unless at least one file has each of them."""
    absent = [name for name in names if not has_series(layout, name)]
    if absent:
        raise Missing(f"no {' or '.join(absent)} in the file" + ("s" if len(layout.files) > 1 else ""))
