"""The statements of the source thesis as claims that a result either meets or does not.

A claim looks at the nine operating points of one run and gives whether it holds, by the criterion that stands in its
words, and the numbers that decide. Nothing in here knows what the solver gives: reasons for differences are in
comparison_reasons.py.
"""

from dataclasses import dataclass
from typing import Callable

import numpy as np

from comparison_runs import SPEEDS, TEMPERATURES
from units import significant

NOSE = (165.0, 195.0)  # degree
FLANKS = ((116.0, 137.0), (222.0, 242.0))  # degree, as the source names them
EVENT = (110.0, 250.0)  # degree
BASE = ((0.0, 100.0), (260.0, 360.0))  # degree, from 10 degrees beside the event


@dataclass(frozen=True)
class Claim:
    """`check(points)` gives (holds, numbers in words); `name` finds the reasons."""

    name: str
    words: str
    check: Callable


@dataclass(frozen=True)
class Statement:
    """What the source says, in our words, where it says it, and the claims it is split into."""

    title: str
    source: str
    says: str
    claims: tuple


def listed(values, scale=1.0, count=3):
    """Numbers one after the other."""
    return ", ".join(significant(float(value) * scale, count) for value in np.ravel(values))


def percent(value):
    """A share, in per cent with one decimal."""
    return f"{100.0 * float(value):.1f} %"


def band(values, scale=1.0, count=3):
    """From the smallest to the largest."""
    return f"{significant(np.min(values) * scale, count)} to {significant(np.max(values) * scale, count)}"


def rises(values):
    """Whether each value along the first axis is larger than the one before."""
    return bool(np.all(np.diff(values, axis=0) > 0.0))


def falls(values):
    """Whether each value along the first axis is smaller than the one before."""
    return rises(-np.asarray(values))


def by_temperature(values, unit, scale=1.0, count=3):
    """A line for each oil temperature with the values at the three speeds."""
    return "; ".join(f"{warmth:.0f} °C: {listed(values[:, column], scale, count)} {unit}"
                     for column, warmth in enumerate(TEMPERATURES))


def by_speed(values, unit, scale=1.0, count=3):
    """A line for each speed with the values at the three oil temperatures."""
    return "; ".join(f"{speed:.0f} rev/min: {listed(values[row], scale, count)} {unit}"
                     for row, speed in enumerate(SPEEDS))


def largest(points, name, *ranges):
    """Largest magnitude of a series inside ranges of cam angles, (speed, oil temperature)."""
    return np.abs(points.series(name)[..., points.within(*ranges)]).max(axis=-1)


def place_of(points, values):
    """Cam angle of the largest value [degree]."""
    return float(points.angle[np.argmax(values)])


# 1 and 2: pressure and load

def peak_pressure(points):
    pressure = points.scalar("max_hertz_pressure").max()
    return abs(pressure / 0.64e9 - 1.0) <= 0.05, f"{significant(pressure * 1e-9)} GPa"


def load_peaks_at_nose(points):
    place = place_of(points, points.series("contact_load")[0, 0])
    return NOSE[0] <= place <= NOSE[1], f"{place:.0f}°"


def load_falls_at_nose(points):
    load = largest(points, "contact_load", (180.0, 180.0))
    return falls(load), f"{listed(load[:, 0])} N at 25 °C"


def load_rises_on_flanks(points):
    load = largest(points, "contact_load", *FLANKS)
    return rises(load), f"{listed(load[:, 0])} N at 25 °C"


# 3: film

def flanks_entrain_more(points):
    speed = points.series("entrainment_speed")
    flank = speed[..., points.within(*FLANKS)].mean(axis=-1)
    nose = speed[..., points.within(NOSE)].mean(axis=-1)
    return bool(np.all(flank > nose)), f"means at 300 rev/min, 25 °C: {significant(flank[0, 0])} and " \
                                       f"{significant(nose[0, 0])} m/s"


def film_extremes(points):
    film = points.series("film_thickness_min")
    thick, thin = points.angle[film.argmax(axis=-1)], points.angle[film.argmin(axis=-1)]
    on_flank = np.any([(thick >= low) & (thick <= high) for low, high in FLANKS], axis=0)
    at_nose = (thin >= NOSE[0]) & (thin <= NOSE[1])
    return bool(np.all(on_flank & at_nose)), f"thickest at {thick[0, 0]:.0f}°, thinnest at {thin[0, 0]:.0f}°"


def film_rises_with_speed(points):
    film = points.scalar("min_film_thickness_min")
    return rises(film), by_temperature(film, "µm", 1e6)


def film_falls_with_temperature(points):
    film = points.scalar("min_film_thickness_min")
    return falls(film.T), f"{listed(film[0], 1e6)} µm at 300 rev/min"


# 4: share of asperities in the contact's friction

def share_small_when_cold(points):
    share = points.scalar("max_asperity_friction_share")[:, 0]
    return bool(np.all(share < 0.10)), f"largest {percent(share.max())}"


def share_none_on_flanks(points):
    share = largest(points, "asperity_friction_share", *FLANKS)[:, 0]
    return bool(np.all(share < 0.01)), f"largest {percent(share.max())}"


def share_peak(points, row, column):
    """Largest share over the event with its cam angle, and the largest on the flanks."""
    event = points.within(EVENT)
    share = points.series("asperity_friction_share")[row, column, event]
    return share.max(), float(points.angle[event][share.argmax()]), \
        largest(points, "asperity_friction_share", *FLANKS)[row, column]


def share_peaks_at_nose(row, column):
    def check(points):
        peak, place, flank = share_peak(points, row, column)
        return NOSE[0] <= place <= NOSE[1] and flank <= 0.5 * peak, \
            f"largest {percent(peak)} at {place:.0f}°, on the flanks {percent(flank)}"
    return check


def share_at_nose(row, column, stated):
    def check(points):
        share = largest(points, "asperity_friction_share", (180.0, 180.0))[row, column]
        return abs(share - stated) <= 0.10, percent(share)
    return check


def share_falls_with_speed(points):
    share = points.series("asperity_friction_share")[..., points.within(NOSE)].mean(axis=-1)
    return falls(share), "; ".join(
        f"{warmth:.0f} °C: {', '.join(percent(value) for value in share[:, column])}"
        for column, warmth in enumerate(TEMPERATURES))


# 5 and 6: friction force of the contact, rolling friction

def friction_rises_when_cold(points):
    force = points.scalar("mean_friction_contact")[:, 0]
    return rises(force), f"{listed(force)} N"


def friction_falls_when_hot(points):
    force = points.scalar("mean_friction_contact")[:2, 2]
    return falls(force), f"{listed(force)} N"


def friction_rises_when_hot(points):
    force = points.scalar("mean_friction_contact")[1:, 2]
    return rises(force), f"{listed(force)} N"


def friction_falls_on_warming(points):
    force = points.scalar("mean_friction_contact")[:, :2]
    return falls(force.T), by_speed(force, "N")


def rolling_extremes(points):
    force = points.scalar("mean_friction_rolling")
    where = np.unravel_index(force.argmax(), force.shape), np.unravel_index(force.argmin(), force.shape)
    return where == ((2, 0), (0, 2)), f"{band(force)} N"


def rolling_trends(points):
    force = points.scalar("mean_friction_rolling")
    return rises(force) and falls(force.T), by_temperature(force, "N")


# 7: slip

def slip_largest_on_flanks(points):
    flank, nose = largest(points, "slip_ratio", *FLANKS), largest(points, "slip_ratio", NOSE)
    base = largest(points, "slip_ratio", *BASE)
    slips = points.scalar("max_slip_ratio") > 0.01
    holds = (flank > base) & (flank > nose) & slips
    return bool(np.all(holds == slips)), f"at {holds.sum()} of {slips.sum()} points; 25 °C: flanks " \
                                         f"{listed(flank[:, 0], 100.0)} %, base circle {listed(base[:, 0], 100.0)} %"


def slip_small_at_nose(points):
    slip = largest(points, "slip_ratio", NOSE)
    return bool(np.all(slip[0] < 0.01)), f"largest {significant(slip[0].max() * 100.0, 2)} %"


def slip_rises(*columns):
    def check(points):
        slip = points.scalar("mean_slip_ratio")[:, list(columns)]
        return rises(slip), "; ".join(f"{TEMPERATURES[column]:.0f} °C: {listed(slip[:, place], 100.0)} %"
                                      for place, column in enumerate(columns))
    return check


def slip_rises_on_heating(points):
    slip = points.scalar("mean_slip_ratio")
    return rises(slip.T), "; ".join(f"{speed:.0f} rev/min: {listed(row, 100.0)} %" for speed, row in zip(SPEEDS, slip))


def slip_turns_negative(points):
    slip = points.series("slip_ratio")[..., points.within(EVENT)].min(axis=-1)[1:]
    return bool(np.all(slip[:, 0] < -0.01)), f"smallest {listed(slip[:, 0], 100.0)} %"


# 8 and 9: friction torque

def torque_falls(rows, columns):
    def check(points):
        torque = points.torque("friction")[rows, columns]
        return falls(torque.T), by_rows(rows, torque)
    return check


def torque_rises_with_speed(points):
    torque = points.torque("friction")
    return rises(torque), by_temperature(torque * 1e3, "N mm")


def torque_rises_on_heating(points):
    torque = points.torque("friction")[:2, 1:]
    return rises(torque.T), by_rows(slice(0, 2), torque)


def by_rows(rows, torque):
    return "; ".join(f"{speed:.0f} rev/min: {listed(values, 1e3)} N mm" for speed, values in zip(SPEEDS[rows], torque))


def bearing_share(points):
    share = points.share("bearings")[2, 0]
    return abs(share - 0.30) <= 0.10, percent(share)


def bearings_most_when_cold_and_fast(points):
    torque = points.torque("bearings")
    return np.unravel_index(torque.argmax(), torque.shape) == (2, 0), f"{band(torque, 1e3)} N mm"


def small_share(source):
    def check(points):
        share = points.share(source)
        return bool(np.all((share >= 0.006) & (share <= 0.03))), f"{band(share, 100.0)} %"
    return check


def guide_like_needle(points):
    ratio = points.torque("guide") / points.torque("needle")
    return bool(np.all((ratio > 1.0 / 3.0) & (ratio < 3.0))), f"guide over needle {band(ratio, 1.0, 2)}"


# 10: geometric torque

def geometric_parts_equal(points):
    torque = points.series("torque_geometric")
    high, low = torque.max(axis=-1), -torque.min(axis=-1)
    return bool(np.all(np.abs(high / low - 1.0) < 0.01)), f"{significant(high[0, 0])} and {significant(-low[0, 0])} N m"


def geometric_hardly_changes(points):
    high = points.series("torque_geometric").max(axis=-1)
    return bool(np.ptp(high) / high.max() < 0.05), f"peaks {listed(high[:, 0])} N m, the same at each temperature"


# 11: change by sliding and asperities

def contact_changes(points):
    # A roller that rolls without slip on a film without asperities has rolling friction only
    change = points.scalar("mean_friction_contact") / points.scalar("mean_friction_rolling") - 1.0
    return bool(np.all(np.abs(change) > 0.1)), by_temperature(100.0 * change, "%")


# 12: drive torque

def drive_falls_with_speed(points):
    peak = points.series("torque_drive").max(axis=-1)
    return falls(peak), by_temperature(peak, "N m")


def drive_rises_on_heating(points):
    peak = points.series("torque_drive").max(axis=-1)
    return rises(peak.T), "; ".join(f"{speed:.0f} rev/min: {listed(row)} N m" for speed, row in zip(SPEEDS, peak))


STATEMENTS = (
    Statement("Peak pressure", "section on viscosity", "The Hertz pressure goes up to 0.64 GPa. (The "
              "decks' spring constant was chosen by it, since the printed one gives 0.18 GPa: agreement says nothing here.)", (
        Claim("peak_pressure", "largest pressure within 5 % of 0.64 GPa", peak_pressure),)),
    Statement("Contact load", "Fig. 5", "The spring dominates at low speed and loads the nose; inertia relieves the "
                                        "nose and loads the flanks as speed grows.", (
        Claim("load_nose", "at 300 rev/min the largest load is within 15° of the nose", load_peaks_at_nose),
        Claim("load_nose_speed", "the load at the nose falls with speed", load_falls_at_nose),
        Claim("load_flank_speed", "the largest load on the flanks rises with speed", load_rises_on_flanks))),
    Statement("Film", "Figs. 6 and 7", "Entrainment and film are largest on the flanks and smallest at the nose; the "
                                       "film grows with speed and thins with temperature.", (
        Claim("entrainment", "entrainment is faster on the flanks than at the nose", flanks_entrain_more),
        Claim("film_places", "thickest film on a flank, thinnest within 15° of the nose, at all points",
              film_extremes),
        Claim("film_speed", "the thinnest film grows with speed", film_rises_with_speed),
        Claim("film_warmth", "the thinnest film falls with temperature", film_falls_with_temperature))),
    Statement("Share of asperities", "Figs. 9, 11 and 13",
            "Asperities take almost no part in the contact's friction at 25 °C, none of it on the flanks; their "
            "share has its peak at the nose, up to 60 % at 300 rev/min and 60 °C and about 82 % at 95 °C; less at higher "
            "speed.", (
        Claim("share_cold", "below 10 % everywhere at 25 °C", share_small_when_cold),
        Claim("share_flank", "below 1 % on the flanks at 25 °C", share_none_on_flanks),
        Claim("share_shape_60", "300 rev/min, 60 °C: largest of the event within 15° of the nose, on the flanks at most half of "
                                "it", share_peaks_at_nose(0, 1)),
        Claim("share_60", "300 rev/min, 60 °C: at the nose 60 % within 10 points", share_at_nose(0, 1, 0.60)),
        Claim("share_shape_95", "300 rev/min, 95 °C: largest of the event within 15° of the nose, on the flanks at most half of "
                                "it", share_peaks_at_nose(0, 2)),
        Claim("share_95", "300 rev/min, 95 °C: at the nose 82 % within 10 points", share_at_nose(0, 2, 0.82)),
        Claim("share_speed", "the mean share near the nose falls with speed at each temperature",
              share_falls_with_speed))),
    Statement("Friction of the contact", "Figs. 8, 10 and 12",
            "At 25 °C friction grows with speed; at 95 °C its mean falls from 300 to 600 rev/min and grows to 900; "
            "it falls from 25 to 60 °C.", (
        Claim("friction_cold", "mean force at 25 °C rises with speed", friction_rises_when_cold),
        Claim("friction_hot_falls", "mean force at 95 °C falls from 300 to 600 rev/min", friction_falls_when_hot),
        Claim("friction_hot_rises", "mean force at 95 °C rises from 600 to 900 rev/min", friction_rises_when_hot),
        Claim("friction_warming", "mean force falls from 25 to 60 °C at each speed", friction_falls_on_warming))),
    Statement("Rolling friction", "Fig. 14", "Largest at 900 rev/min and 25 °C, smallest at 300 rev/min and 95 °C.", (
        Claim("rolling_places", "extremes of the mean force at these two points", rolling_extremes),
        Claim("rolling_trends", "mean force rises with speed and falls with temperature", rolling_trends))),
    Statement("Slip", "Figs. 15 to 18", "The roller slips most on the flanks, a little on the base circle, and "
                                        "nearly rolls at the nose when slow; slip grows with speed; it turns "
                                        "negative on the flanks where the roller cannot follow.", (
        Claim("slip_flanks", "where slip exceeds 1 %, it is largest on the flanks, not on the base circle (from 10° "
                             "beside the event) or near the nose",
              slip_largest_on_flanks),
        Claim("slip_nose", "below 1 % near the nose at 300 rev/min", slip_small_at_nose),
        Claim("slip_speed_cold", "mean slip rises with speed at 25 °C", slip_rises(0)),
        Claim("slip_speed_warm", "mean slip rises with speed at 60 and at 95 °C", slip_rises(1, 2)),
        Claim("slip_heating", "mean slip rises with temperature at each speed (Fig. 18)", slip_rises_on_heating),
        Claim("slip_negative", "below -1 % somewhere in the event at 600 and 900 rev/min, 25 °C",
              slip_turns_negative))),
    Statement("Mean friction torque", "Figs. 19 and 22",
            "At 300 and 600 rev/min it falls from 25 to 60 °C and grows to 95 °C; at 900 rev/min it falls "
            "throughout. (Fig. 22 has measured values beside it as a picture; the words name no number of them.)", (
        Claim("torque_warming", "falls from 25 to 60 °C at 300 and 600 rev/min",
              torque_falls(slice(0, 2), slice(0, 2))),
        Claim("torque_heating", "rises from 60 to 95 °C at 300 and 600 rev/min", torque_rises_on_heating),
        Claim("torque_speed", "rises with speed at each temperature (Fig. 19)", torque_rises_with_speed),
        Claim("torque_fast", "falls from 25 to 60 to 95 °C at 900 rev/min",
              torque_falls(slice(2, 3), slice(0, 3))))),
    Statement("Other sources of friction", "Fig. 19",
            "The camshaft's bearings take most at 900 rev/min and 25 °C, 30 % of the torque; valve guide and needle "
            "bearing are alike and take 0.6 to 3 % each.", (
        Claim("bearings_place", "bearing torque largest at 900 rev/min and 25 °C", bearings_most_when_cold_and_fast),
        Claim("bearings_share", "30 % of the torque there, within 10 points", bearing_share),
        Claim("guide_share", "guide between 0.6 and 3 % at all points", small_share("guide")),
        Claim("needle_share", "needle bearing between 0.6 and 3 % at all points", small_share("needle")),
        Claim("guide_needle", "guide and needle bearing within a factor of three at all points",
              guide_like_needle))),
    Statement("Geometric torque", "Fig. 21", "Its positive and negative parts are equal; speed hardly changes it, "
                                             "temperature not at all.", (
        Claim("geometric_parts", "both peaks equal within 1 %", geometric_parts_equal),
        Claim("geometric_change", "peaks at all points within 5 %", geometric_hardly_changes))),
    Statement("Change by sliding and asperities", "Fig. 20",
              "Sliding of the roller and asperities change the friction of the contact significantly at the operating points.", (
        Claim("contact_change", "mean force of the contact more than 10 % from that of its rolling friction alone, at all points",
              contact_changes),)),
    Statement("Drive torque", "Fig. 21 and the text below it", "It falls with speed and rises with temperature.", (
        Claim("drive_speed", "its peak falls with speed at each temperature", drive_falls_with_speed),
        Claim("drive_heating", "its peak rises with temperature at each speed", drive_rises_on_heating))),
)


def verdict(held):
    """One word for the claims of a statement: agrees, partly or differs."""
    return "agrees" if all(held) else "partly" if any(held) else "differs"
