#!/usr/bin/env python3
"""Compare measured trends of valve trains with what the model gives over the plausible ranges of uncertain coefficients.

    python post/trends.py --cases FOLDER         writes FOLDER/trends.nml and pin.nml with their tables of cases, to be run
    python post/trends.py FILE.h5 STICKING.h5 PIN.h5 --page doc/trends.md --figure doc/figures/trends.png

Each sample is one set of coefficients within the ranges of `RANGES` and of choices from `CHOICES`, spread evenly by a Sobol sequence; each
is run at nine points, 300 to 900 rev/min and oil at 25 to 95 degC. Nothing is fitted: the page says for which part of the samples a trend
comes out, and in which part of each range those samples lie that show it. STICKING.h5 has the same cases with stick-slip, PIN.h5 those of
pin.nml: a plain pin with an oil film, of `PIN_RANGES`, in place of the needles. Exit code 2 where a file cannot be used.
"""

from __future__ import annotations

import argparse
from pathlib import Path
import sys

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams.update({"font.size": 9.0, "axes.spines.top": False, "axes.spines.right": False})

from matplotlib.figure import Figure  # noqa: E402
from matplotlib.ticker import FixedLocator, NullLocator, ScalarFormatter  # noqa: E402
import numpy as np  # noqa: E402
from scipy.stats import qmc, spearmanr  # noqa: E402

from command import script, save_figure, write_text  # noqa: E402
from read import ResultError, read_result  # noqa: E402

BASE = Path(__file__).resolve().parent.parent / "decks/sliding_joints.nml"
SPEEDS, TEMPERATURES = (300.0, 600.0, 900.0), (25.0, 60.0, 95.0)
SAMPLES, SEED = 128, 1
# Key, smallest and largest value, equal ratios, why this range
RANGES = [
    ("valve_tip.friction_coefficient", 0.02, 0.15, False, "polished and coated to rough steel, boundary lubricated"),
    ("valve_tip.decay_speed_m_s", 0.02, 2.0, True, "mixed friction from creeping on to fully mixed"),
    ("valve_tip.pad_radius_mm", 4.0, 20.0, False, "flat pads to sharp ones; sets how far the pad slides"),
    ("stem_seal.lip_force_N", 1.0, 15.0, False, "seals of small valves to stiff ones"),
    ("stem_seal.viscous_drag_N_s_m", 0.0, 15.0, False, "at 0.01 Pa s, with the oil's viscosity"),
    ("guide_side_load.friction_coefficient", 0.01, 0.15, False, "film to boundary friction in the guide"),
    ("finger_pivot.friction_coefficient", 0.02, 0.15, False, "as at the tip"),
    ("needle_bearing.friction_coefficient", 0.001, 0.01, True, "new full-complement needles to a poor bearing"),
    ("needle_drag.viscous_factor", 3.0, 16.0, False, "little oil to a flooded bearing"),
    ("asperity.boundary_coefficient", 0.05, 0.2, False, "friction modifiers to base oil"),
    ("surface.cam_roughness_um", 0.07, 0.5, True, "polished to ground; the roller has 0.14"),
    ("bearing_asperity.roughness_um", 0.2, 1.0, True, "run-in to turned journals and bearings, both together"),
    ("bearing_asperity.boundary_coefficient", 0.05, 0.15, False, "friction modifiers to base oil"),
    ("cam_bearings.radial_clearance_um", 20.0, 50.0, False, "new to worn"),
]
# Key, names, why: laws as well founded as each other, each as often
CHOICES = [
    ("film.law", ("dowson_higginson", "pan_hamrock", "masjedi_khonsari", "moes"), "published regressions of the film of a line contact"),
    ("traction.sheared_zone", ("hertz", "rigid_to_elastic"), "strip of the film that is sheared on lightly loaded base circles"),
]
# Of the plain pin, in the place of all of `NEEDLES`
PIN_RANGES = [
    ("needle_bearing.friction_coefficient", 0.05, 0.15, False, "steel on bronze or coated steel, boundary lubricated"),
    ("needle_bearing.pin_radial_clearance_um", 10.0, 40.0, False, "new to worn"),
    ("needle_bearing.pin_roughness_um", 0.1, 0.5, True, "polished to ground, bore and pin together"),
]
NEEDLES = ("needle_bearing.friction_coefficient", "needle_drag.viscous_factor")
BAIR = (0.32, 0.70)  # J per turn: 18 % of 1.75 to 3.9 J
HARDLY = 0.10  # relative change up to which friction "hardly changes" [-]
CLEAR = 0.05  # relative change from which a rise or fall counts as clear [-]
DUFFY = 0.20  # largest sliding on the base circle [-]
TICKS = (5, 10, 20, 50, 100, 200, 500, 1000)  # N mm
FEWEST = 8  # samples on either side from which on their coefficients are compared


def label(key):
    """A key with its group in words."""
    group, name = key.split(".")
    return f"`{group}.{name}`"


def points():
    """Where each sample lies in each range and choice, from 0 to 1: columns of `RANGES`, `CHOICES` and `PIN_RANGES`."""
    return qmc.Sobol(len(RANGES) + len(CHOICES) + len(PIN_RANGES), scramble=True, rng=SEED).random(SAMPLES)


def scale(columns, ranges):
    """Values within ranges, one row for each sample."""
    return np.array([low * (high / low)**column if is_ratio else low + (high - low) * column
                     for column, (_, low, high, is_ratio, _) in zip(columns, ranges)]).T


def samples():
    """Coefficients of every sample, one row each."""
    return scale(points().T[:len(RANGES)], RANGES)


def pin_samples():
    """Coefficients of the plain pin of every sample, one row each."""
    return scale(points().T[-len(PIN_RANGES):], PIN_RANGES)


def choices():
    """Chosen names of every sample, one row each."""
    columns = points().T[len(RANGES):len(RANGES) + len(CHOICES)]
    return [[names[int(u * len(names))] for u, (_, names, _) in zip(row, CHOICES)] for row in columns.T]


def write_table(path, keys, rows):
    """Table of cases: rows times operating points, the temperature fastest."""
    lines = [" ".join(["operating_point.speed_rpm", "operating_point.oil_temperature_degC", *keys])]
    for row in rows:
        words = [word if isinstance(word, str) else f"{word:.9g}" for word in row]
        lines += [" ".join([f"{speed:.9g}", f"{temperature:.9g}", *words]) for speed in SPEEDS for temperature in TEMPERATURES]
    write_text(path, "\n".join(lines) + "\n")


def write_cases(folder):
    """Decks of all cases and their tables, with needles and with a plain pin."""
    base = BASE.read_text(encoding="utf-8")
    deck = base[base.index("&case"):base.index("&sweep")].replace("'long_full_sommerfeld'", "'finite'")
    deck += "&bearing_asperity\n   roughness_um = 0.5\n   modulus_GPa = 110\n   boundary_coefficient = 0.1\n/\n\n"
    deck += "&output\n   series = .false.\n/\n\n"
    needles = deck + "&needle_drag\n   pitch_diameter_mm = 10.22\n/\n\n"
    bearing = deck[deck.index("&needle_bearing"):deck.index("&cam_bearings")]
    pin = deck.replace(bearing, "&needle_bearing\n   kind = 'journal'\n   friction_coefficient = 0.1\n   pin_width_mm = 9\n"
                       "   pin_radial_clearance_um = 20\n   pin_roughness_um = 0.3\n   pin_modulus_GPa = 180\n/\n\n")
    for name, text, table in (("trends.nml", needles, "cases.txt"), ("pin.nml", pin, "pin_cases.txt")):
        write_text(folder / name, "! Made by post/trends.py from decks/sliding_joints.nml.\n\n" + text
                   + f"&sweep\n   kind = 'table'\n   table = '{table}'\n/\n")
    keys, chosen = [key for key, *_ in RANGES], [key for key, *_ in CHOICES]
    write_table(folder / "cases.txt", keys + chosen, [[*row, *names] for row, names in zip(samples(), choices())])
    kept = [i for i, key in enumerate(keys) if key not in NEEDLES]
    write_table(folder / "pin_cases.txt", [keys[i] for i in kept] + chosen + [key for key, *_ in PIN_RANGES],
                [[*row[kept], *names, *pin] for row, names, pin in zip(samples(), choices(), pin_samples())])


def as_points(values):
    """Values of all cases by sample, speed and temperature."""
    return np.asarray(values, dtype=float).reshape(-1, len(SPEEDS), len(TEMPERATURES))


def rises(start, end):
    """Whether something rises from start to end at all, and clearly."""
    return end > start, end > (1 + CLEAR) * start


def falls(start, end):
    """Whether something falls from start to end at all, and clearly."""
    return end < start, end < (1 - CLEAR) * start


def everywhere(shown):
    """Whether a trend shows at every speed."""
    return tuple(np.all(values, axis=1) for values in shown)


def work_of_roller(data):
    """Mean torque of contact and roller bearing [N m], by sample, speed and temperature."""
    return data["mean_torque_contact"] + data["mean_torque_needle"] + data["mean_torque_needle_drag"]


def find_trends(data, pin):
    """Source, trend, which samples show it, which clearly (None where the trend has no size).

    `data` and `pin` have arrays by sample, speed and temperature, `pin` those of the train with a plain pin.
    """
    friction = data["mean_torque_friction"]
    train = friction - data["mean_torque_bearings"]
    contact, roller = data["mean_torque_contact"], work_of_roller(data)
    cold, warm, hot = 0, 1, 2
    return [
        *trends_of_interface(contact, roller),
        ("Mufti and Priest 2003", "friction without camshaft bearings rises from 60 to 95 °C at 300 rev/min",
         *rises(train[:, 0, warm], train[:, 0, hot])),
        ("", "the same at 600 rev/min", *rises(train[:, 1, warm], train[:, 1, hot])),
        ("", "the same at 300, 600 and 900 rev/min at once", *everywhere(rises(train[:, :, warm], train[:, :, hot]))),
        ("", "all friction, with camshaft bearings, rises from 60 to 95 °C at 300 rev/min",
         *rises(friction[:, 0, warm], friction[:, 0, hot])),
        ("", "the same at 300, 600 and 900 rev/min at once", *everywhere(rises(friction[:, :, warm], friction[:, :, hot]))),
        ("", "friction without camshaft bearings rises from 25 to 95 °C at 300 rev/min", *rises(train[:, 0, cold], train[:, 0, hot])),
        ("", "friction without camshaft bearings at 95 °C falls from 300 to 900 rev/min", *falls(train[:, 0, hot], train[:, 2, hot])),
        ("", "the same with camshaft bearings", *falls(friction[:, 0, hot], friction[:, 2, hot])),
        *trends_of_slip(data),
        *trends_of_rigs(train, roller, work_of_roller(pin)),
    ]


def trends_of_interface(contact, roller):
    """Trends of the friction of cam and roller."""
    cold, warm, hot = 0, 1, 2
    return [
        ("Bhutta and others 2023", "friction of cam on roller rises from 60 to 95 °C at 300 rev/min",
         *rises(contact[:, 0, warm], contact[:, 0, hot])),
        ("", "the same at any of 300, 600 and 900 rev/min",
         *(np.any(values, axis=1) for values in rises(contact[:, :, warm], contact[:, :, hot]))),
        ("", "friction of cam on roller and of the roller bearing rises from 60 to 95 °C at 300 rev/min",
         *rises(roller[:, 0, warm], roller[:, 0, hot])),
        ("", "the same from 25 to 95 °C", *rises(roller[:, 0, cold], roller[:, 0, hot])),
    ]


def trends_of_slip(data):
    """Trends of the slip of the roller."""
    slip, largest = data["revolution_slip"], data["max_slip_ratio"]
    cold, warm, hot = 0, 1, 2
    steps = zip(falls(slip[:, :, cold], slip[:, :, warm]), falls(slip[:, :, warm], slip[:, :, hot]))
    return [
        ("Khurram and others 2015, 2020; Duffy 1993", "slip falls with oil temperature at every speed",
         *(np.all(first & second, axis=1) for first, second in steps)),
        ("Khurram and others 2015, 2020", "negative slip somewhere in the turn of the hot engine, 95 °C",
         np.any(data["min_slip_ratio"][:, :, hot] < 0, axis=1), None),
        ("", "slip falls again at very high speed: at 25 °C from 600 to 900 rev/min", *falls(slip[:, 1, cold], slip[:, 2, cold])),
        ("Duffy 1993", "slip at 25 °C grows from 300 to 900 rev/min", *rises(slip[:, 0, cold], slip[:, 2, cold])),
        ("", "slip at 60 °C grows from 300 to 900 rev/min", *rises(slip[:, 0, warm], slip[:, 2, warm])),
        ("", f"largest slip in the turn, on the base circle as a rule, is at most {100 * DUFFY:.0f} % at all speeds at 25 °C",
         np.all(largest[:, :, cold] <= DUFFY, axis=1), None),
        ("", "the same at 60 °C", np.all(largest[:, :, warm] <= DUFFY, axis=1), None),
    ]


def trends_of_rigs(train, roller, pin):
    """Work and trends of other rigs: `train` is friction without camshaft bearings, `roller` of contact and roller bearing, `pin` the same
    with a plain pin.
    """
    cold, warm, hot = 0, 1, 2
    work = 2 * np.pi * roller
    in_band = (work >= BAIR[0]) & (work <= BAIR[1])
    others = train - roller
    same = np.abs(roller[:, :, hot] - roller[:, :, warm]) <= HARDLY * roller[:, :, warm]
    more = others[:, :, hot] > others[:, :, warm]
    smaller = falls(roller, pin)
    return [
        ("Bair and others 1986", "contact and roller bearing take 0.32 to 0.70 J a turn at 900 rev/min and 25 °C", in_band[:, 2, cold], None),
        ("", "the same at any of the points at 60 °C", np.any(in_band[:, :, warm], axis=1), None),
        ("Pushrod tester", f"with thinner oil, 60 to 95 °C at 300 rev/min, friction of cam and roller hardly changes (within {100 * HARDLY:.0f} %)",
         same[:, 0], None),
        ("", "friction of the other elements rises there", *rises(others[:, 0, warm], others[:, 0, hot])),
        ("", "both at once there", same[:, 0] & more[:, 0], None),
        ("", "both at once at 900 rev/min", same[:, 2] & more[:, 2], None),
        ("", "a plain pin loses less than needles, contact and bearing, at 300 rev/min and 25 °C", *(values[:, 0, cold] for values in smaller)),
        ("", "the same at 300 rev/min and 95 °C", *(values[:, 0, hot] for values in smaller)),
        ("", "the same at 900 rev/min and 60 °C", *(values[:, 2, warm] for values in smaller)),
        ("", "the same at all nine points", *(np.all(values, axis=(1, 2)) for values in smaller)),
    ]


def find_monotonies(data):
    """Source, trend, its sign, rank correlation of the slip with a coefficient over all samples, by speed and temperature."""
    return [
        ("Khurram and others 2015, 2020", "friction modifiers and anti-wear agents, which change the boundary coefficient, raise slip: a lower "
         "coefficient, more slip", -1, correlations("asperity.boundary_coefficient", data["revolution_slip"])),
        ("Duffy 1993", "roughness lowers slip", -1, correlations("surface.cam_roughness_um", data["revolution_slip"])),
    ]


def correlations(key, values):
    """Rank correlation of values by sample, speed and temperature with a coefficient, at each point; not-a-number where none differs."""
    column = samples()[:, [key for key, *_ in RANGES].index(key)]
    return np.array([[spearmanr(column, series).statistic if np.ptp(series) > 0 else np.nan for series in row] for row in
                     np.moveaxis(values, 0, -1)])


def correlation_error():
    """Standard error of a rank correlation over the samples where there is none."""
    return 1 / np.sqrt(SAMPLES - 1)


def comes_out(sign, values):
    """Points at which a correlation has the sign of the trend and is at least twice its error."""
    return sign * values >= 2 * correlation_error()


def tell_monotonies(data, sticking):
    """Lines of the page: trends over the sets, at all points."""
    lines = ["", f"Rank correlation of the slip of the turn with a coefficient over the sets. Without any, its standard error is {correlation_error():.2f} "
             f"($1/\\sqrt{{n - 1}}$, $n = {SAMPLES}$); a trend comes out where the", "correlation has its sign and is at least twice that. Elsewhere it does "
             "not differ from none, or has the other sign.", "",
             "| source | trend over the sets | rev/min | 25 °C | 60 °C | 95 °C | if it sticks: 25 °C | 60 °C | 95 °C | comes out at | if it sticks |",
             "|---|---|---|---|---|---|---|---|---|---|---|"]
    for (source, trend, sign, values), (*_, then) in zip(find_monotonies(data), find_monotonies(sticking)):
        counts = [f"{comes_out(sign, each).sum()} of {each.size} points" for each in (values, then)]
        for i, speed in enumerate(SPEEDS):
            words, ends = ((source, trend), counts) if i == 0 else (("", ""), ("", ""))
            numbers = ["-" if np.isnan(value) else f"{value:+.2f}" for value in (*values[i], *then[i])]
            lines.append("| " + " | ".join([*words, f"{speed:.0f}", *numbers, *ends]) + " |")
    return lines


def share(shown):
    """Part of the samples and its standard error, in percent."""
    part = shown.mean()
    error = 100 * np.sqrt(part * (1 - part) / shown.size)
    return f"{100 * part:.0f} %" if error == 0 else f"{100 * part:.0f} ± {error:.0f} %"


def where_it_lies(shown):
    """Coefficients and choices that differ most between the samples that show a trend and the others, as ranges of the middle 80 %."""
    if shown.all() or not shown.any():
        return "-"
    counts = shown.sum(), (~shown).sum()
    if min(counts) < FEWEST:
        return "too few to say"
    words = []
    for place, column, (key, *_) in zip(points().T, samples().T, RANGES):
        # Standard error of the difference of two means of evenly spread numbers, which vary by 1/12
        shift = abs(place[shown].mean() - place[~shown].mean()) / np.sqrt((1 / counts[0] + 1 / counts[1]) / 12)
        first, last = np.quantile(column[shown], [0.1, 0.9])
        words.append((shift, f"{label(key)} {first:.2g} to {last:.2g}"))
    for column, (key, names, _) in zip(np.array(choices()).T, CHOICES):
        for name in names:
            has = column == name
            spread = np.sqrt(has.mean() * (1 - has.mean()) * (1 / counts[0] + 1 / counts[1]))
            # Of two names each says as much as the other: the one that is more frequent
            if len(names) == 2 and has[shown].mean() < has[~shown].mean():
                continue
            shift = abs(has[shown].mean() - has[~shown].mean()) / spread
            words.append((shift, f"{label(key)} '{name}' in {100 * has[shown].mean():.0f} %"))
    return "; ".join(text for shift, text in sorted(words, reverse=True)[:3] if shift >= 3) or "all over the ranges"


def read_data(path):
    """Scalars of all cases as arrays by sample, speed and temperature; a loss that a train does not have is 0."""
    result = read_result(path, with_series=False)
    names = ["mean_torque_friction", "mean_torque_bearings", "mean_torque_contact", "mean_torque_needle", "mean_torque_needle_drag",
             "revolution_slip", "min_slip_ratio", "max_slip_ratio"]
    found = {}
    for name in names:
        if name == "mean_torque_needle_drag" and name not in result.summary:
            found[name] = np.zeros_like(found["mean_torque_needle"])
            continue
        values = np.asarray(result.summary[name].values, dtype=float)
        if values.size != SAMPLES * len(SPEEDS) * len(TEMPERATURES):
            raise ResultError(f"{path}: {values.size} cases, not those that --cases writes")
        found[name] = as_points(values)
    missing = sum(not np.isfinite(values).all() for values in found["mean_torque_friction"])
    if missing:
        raise ResultError(f"{path}: {missing} samples have a case without a result")
    return found


def tell_ranges():
    """Lines of the page: what is varied."""
    lines = ["| coefficient | from | to | range |", "|---|---|---|---|"]
    for key, low, high, is_ratio, why in RANGES:
        lines.append(f"| {label(key)} | {low:g} | {high:g} | {why}{'; logarithmic' if is_ratio else ''} |")
    lines += ["", "| law | each as often | of |", "|---|---|---|"]
    lines += [f"| {label(key)} | {', '.join(names)} | {why} |" for key, names, why in CHOICES]
    lines += ["", "The same sets with a plain pin in the place of needles (`kind = 'journal'`, 9 mm wide) have", "",
              "| coefficient of the pin | from | to | range |", "|---|---|---|---|"]
    for key, low, high, is_ratio, why in PIN_RANGES:
        lines.append(f"| {label(key)} | {low:g} | {high:g} | {why}{'; logarithmic' if is_ratio else ''} |")
    return lines


NOT_COMPARED = """## Trends that are not compared

| source | trend | why not |
|---|---|---|
| Khurram and others 2020 | viscosity index improvers reduce slip in hot oil at high speed | one oil is computed, at its viscosity without shear thinning |
| Duffy 1993 | sliding during the event up to 8 %, largest at high acceleration | results have the extremes of the whole turn, which as a rule lie on the base circle |
| Duffy 1993 | axial thrust doubles the slip on the base circle | an axial force is not in the model; a tilt (`&roller_profile`) loads the roller's ends |
| Bair and others 1986 | flat followers | not in the model |
| Pushrod tester | oils with less sulfur lose less | chemistry of the oil enters through coefficients alone |
| Lee and Patterson 1994, 1995 | friction of a pushrod train is mixed; slip on flank and base circle | a regime and places, in a train with other loads; no change that could be compared |
| Umar, Mufti and Khurram 2018 | flash temperature lowers film and friction, mainly at high speed, little in roller trains | computed with `&heat` (`doc/effects.md`), not varied here |
| Li and others 2023 | slip is largest at the start of a start-up | a model; the speed is constant here |
| Alakhramsing 2018 | rolling friction is the main loss of the contact, the pin's is higher | a model, of a heavily loaded fuel pump; `decks/plain_pin.nml` has such a pin |
| Bhutta and others 2023 | a treated surface lowers the friction | the roughness and chemistry of the treated roller are not told |""".splitlines()

SOURCES = """## Sources

All were read as abstracts only: oils, speeds, surfaces and what exactly a sensor measured are not known here, and a trend may hold in a part of
their conditions only.

- Alakhramsing, S. S. and others (2018): Proc. IMechE Part J 232.
- Bair, S., Griffioen, J. A. and Winer, W. O. (1986): J. Tribology 108, 478. The band is 18 % of the loss of flat followers, 1.75 to 3.9 J a turn.
- Bhutta, M. U. and others (2023): Materials 16, 3431. Friction at the interface of cam and roller, in an engine.
- Duffy, P. E. (1993): SAE Technical Paper 930691. Roller tappets in a rig; the definition of its sliding is not known.
- Khurram, M., Mufti, R. A. and others (2015, 2020): Tribology International. End-pivoted roller fingers in an engine.
- Lee, J. and Patterson, D. J. (1994, 1995): SAE Technical Papers 940589 and 951039.
- Li and others (2023): Lubricants 11, 361.
- Mufti, R. A. and Priest, M. (2003): J. Tribology 125, 628. Torque of whole camshafts, bearings included; the abstract names no kind of
  follower.
- Pushrod tester of practical size with roller followers: Transactions of the Japan Society of Mechanical Engineers.
- Umar, M., Mufti, R. A. and Khurram, M. (2018): Tribology International.
""".splitlines()


def page(data, sticking, pin):
    """The page in Markdown; `sticking` has the same cases with stick-slip, `pin` those with a plain pin."""
    lines = ["# Measured trends", "",
             "Trends that others measured on valve trains, with rollers as far as their abstracts name the follower, and for what fraction of the plausible",
             "coefficients the model reproduces them. Trends are compared and not numbers, because the rigs differ from the train computed here. Nothing is",
             "fitted. The sources were read as abstracts only.",
             "`make trends` (`post/trends.py`) makes this page.", "",
             f"There are {SAMPLES} sets of coefficients and laws, distributed uniformly over the ranges below. Each is computed at nine points: 300, 600 and",
             "900 rev/min of the camshaft, oil at 25, 60 and 95 °C. All other values are those of `decks/sliding_joints.nml`, with drag of the needles, and",
             "camshaft bearings of finite width in mixed friction.", "",
             *tell_ranges()]
    rests = [100 * (sticking["revolution_slip"][:, i, 2] == 0).mean() for i in range(len(SPEEDS))]
    lines += ["", "## Results", "",
              f"A trend counts as clear where the change is more than {100 * CLEAR:.0f} %. ± is the standard error of a share of {SAMPLES} independent sets; "
              "where no set or all of them show a",
              f"trend, up to {300 / SAMPLES:.0f} % of the sets within the ranges may do otherwise (95 %).", "",
              "Where friction of asperities suffices to hold the roller, the default law lets it creep, in proportion to",
              "`asperity.mobilising_speed_m_s`. The column \"if it sticks\" is of the same cases with `asperity.mobilisation = 'stick_slip'`, whose roller",
              f"does not slip at all there: at 95 °C in {rests[0]:.0f}, {rests[1]:.0f} and {rests[2]:.0f} % of the sets at 300, 600 and 900 rev/min. A "
              "real contact has its elastic creep",
              "in between, which is not computed. Trends of slip whose two numbers differ rest on the creep.", "",
              "| source | trend | sets that show it | clearly | if it sticks | their coefficients, as far as they differ from the others (middle 80 %) |",
              "|---|---|---|---|---|---|"]
    for (source, trend, shown, clearly), (_, _, then, _) in zip(find_trends(data, pin), find_trends(sticking, pin)):
        lines.append(f"| {source} | {trend} | {share(shown)} | {'-' if clearly is None else share(clearly)} | {100 * then.mean():.0f} % "
                     f"| {where_it_lies(shown)} |")
    lines += tell_monotonies(data, sticking)
    lines += ["", *tell_levels(data, pin), "", "![Friction torque over oil temperature](figures/trends.png)", "",
              "*Mean friction torque over the oil temperature, one line for each set: above without camshaft bearings, below that of cam on roller and",
              "roller bearing alone. Orange if it rises from 60 to 95 °C.*", "", *NOT_COMPARED, "", *SOURCES, ""]
    return "\n".join(lines)


def tell_levels(data, pin):
    """Lines of the page: how far the trends of the pushrod tester are missed, and how much the shear decides about slip."""
    roller, other = work_of_roller(data), work_of_roller(pin)
    change, ratio = roller[:, 0, 2] / roller[:, 0, 1], other / roller
    zones = np.array(choices())[:, 1]
    cold = [", ".join(f"{value:.2f}" for value in np.median(data["revolution_slip"][zones == name, :, 0], axis=0))
            for name in CHOICES[1][1]]
    missed = ["Neither the rise that Bhutta and others report nor the constancy of the pushrod tester comes out within these ranges."]
    return [f"Friction of contact and roller bearing at 300 rev/min and 95 °C over that at 60 °C: {change.min():.2f} to {change.max():.2f}, median "
            f"{np.median(change):.2f}.", *(missed if change.max() < 1 - HARDLY else []), "",
            f"With a plain pin over that with needles, at 300 rev/min: {quartiles(ratio[:, 0, 0])} at 25 °C, {quartiles(ratio[:, 0, 1])} at 60 °C, {quartiles(ratio[:, 0, 2])} at 95 °C "
            "(quartiles).",
            f"Slip of the turn at 25 °C and 300, 600 and 900 rev/min, medians: {cold[0]} with `sheared_zone = 'hertz'`, {cold[1]} with",
            "`'rigid_to_elastic'`."]


def quartiles(values):
    """First to third quartile as text."""
    first, last = np.quantile(values, [0.25, 0.75])
    return f"{first:.2g} to {last:.2g}"


def draw(data):
    """Friction over temperature, a panel for each speed, without camshaft bearings and of the roller alone."""
    figure = Figure(figsize=(8.4, 5.4), layout="constrained")
    rows = figure.subplots(2, len(SPEEDS), sharey="row", sharex=True)
    what = ((1e3 * (data["mean_torque_friction"] - data["mean_torque_bearings"]), "mean friction torque\nwithout camshaft bearings [N mm]"),
            (1e3 * work_of_roller(data), "cam on roller and\nroller bearing alone [N mm]"))
    for panels, (values, name) in zip(rows, what):
        for i, (panel, speed) in enumerate(zip(panels, SPEEDS)):
            rising = values[:, i, 2] > values[:, i, 1]
            for shown, colour, order in ((~rising, "#9a9a9a", 1), (rising, "#d55e00", 2)):
                for row in values[shown, i]:
                    panel.plot(TEMPERATURES, row, color=colour, linewidth=0.6, alpha=0.7, zorder=order)
            panel.plot(TEMPERATURES, np.median(values[:, i], axis=0), color="#111111", linewidth=1.8, zorder=3, label="median")
            panel.set_title(f"{speed:.0f} rev/min: {100 * rising.mean():.0f} % of the sets rise", fontsize=9.0)
            panel.set_xticks(TEMPERATURES)
            panel.set_yscale("log")
            panel.yaxis.set_major_locator(FixedLocator(TICKS))
            panel.yaxis.set_minor_locator(NullLocator())
            panel.yaxis.set_major_formatter(ScalarFormatter())
        panels[0].set_ylabel(name)
    for panel in rows[-1]:
        panel.set_xlabel("oil temperature [°C]")
    rows[0][0].legend(frameon=False)
    return figure


@script
def main(arguments=None):
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file", nargs="?", type=Path, help="result file of the cases")
    parser.add_argument("sticking", nargs="?", type=Path, help="that of the same cases with asperity.mobilisation = 'stick_slip', for the page")
    parser.add_argument("pin", nargs="?", type=Path, help="that of pin.nml, the same train with a plain pin, for the page")
    parser.add_argument("--cases", type=Path, metavar="FOLDER", help="write decks and tables of the cases there")
    parser.add_argument("--page", type=Path, help="page to write")
    parser.add_argument("--figure", type=Path, help="figure to write")
    options = parser.parse_args(arguments)
    if options.cases:
        write_cases(options.cases)
        return
    if options.file is None:
        parser.error("give a result file, or --cases")
    data = read_data(options.file)
    if options.page:
        if options.pin is None:
            parser.error("the page needs all three result files")
        write_text(options.page, page(data, read_data(options.sticking), read_data(options.pin)))
    if options.figure:
        save_figure(draw(data), options.figure, dpi=110)


if __name__ == "__main__":
    sys.exit(main())
