#!/usr/bin/env python3
"""Compare measured trends of roller valve trains with what the model gives over the plausible ranges of uncertain coefficients.

    python post/trends.py --cases FOLDER         writes FOLDER/trends.nml and FOLDER/cases.txt, the cases to run
    python post/trends.py FILE.h5 STICKING.h5 --page doc/trends.md --figure doc/figures/trends.png

Each sample is one set of coefficients within the ranges of `RANGES`, spread evenly by a Sobol sequence; each is run at nine points,
300 to 900 rev/min and oil at 25 to 95 degC. Nothing is fitted: the page says for which part of the samples a trend comes out, and in which
part of each range those samples lie that show it. STICKING.h5 has the same cases with stick-slip. Exit code 2 where the file cannot be used.
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

from command import run, save_figure, write_text  # noqa: E402
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
BAIR = (0.32, 0.70)  # J per turn
TICKS = (50, 100, 200, 500, 1000)  # N mm
FEWEST = 8  # samples on either side from which on their coefficients are compared


def label(key):
    """A key with its group in words."""
    group, name = key.split(".")
    return f"`{group}.{name}`"


def samples():
    """Coefficients of every sample, one row each."""
    points = qmc.Sobol(len(RANGES), scramble=True, rng=SEED).random(SAMPLES)
    columns = []
    for column, (_, low, high, is_ratio, _) in zip(points.T, RANGES):
        columns.append(low * (high / low)**column if is_ratio else low + (high - low) * column)
    return np.array(columns).T


def write_cases(folder):
    """The deck of all cases and its table, samples times operating points, the temperature fastest."""
    base = BASE.read_text(encoding="utf-8")
    deck = base[base.index("&case"):base.index("&sweep")]
    deck = deck.replace("'dowson_higginson'", "'moes'").replace("'long_full_sommerfeld'", "'finite'")
    deck += "&bearing_asperity\n   roughness_um = 0.5\n   modulus_GPa = 110\n   boundary_coefficient = 0.1\n/\n\n"
    deck += "&needle_drag\n   pitch_diameter_mm = 10.22\n/\n\n&output\n   series = .false.\n/\n\n"
    deck += "&sweep\n   kind = 'table'\n   table = 'cases.txt'\n/\n"
    write_text(folder / "trends.nml", "! Made by post/trends.py from decks/sliding_joints.nml.\n\n" + deck)
    keys = ["operating_point.speed_rpm", "operating_point.oil_temperature_degC"] + [key for key, *_ in RANGES]
    rows = [" ".join(keys)]
    for sample in samples():
        for speed in SPEEDS:
            for temperature in TEMPERATURES:
                rows.append(" ".join(f"{value:.9g}" for value in (speed, temperature, *sample)))
    write_text(folder / "cases.txt", "\n".join(rows) + "\n")


def as_points(values):
    """Values of all cases by sample, speed and temperature."""
    return np.asarray(values, dtype=float).reshape(-1, len(SPEEDS), len(TEMPERATURES))


def find_trends(data):
    """Which samples show each trend: source, trend, one truth value a sample; `data` has arrays by sample, speed and temperature."""
    friction, bearings = data["mean_torque_friction"], data["mean_torque_bearings"]
    train = friction - bearings
    slip, least_slip = data["revolution_slip"], data["min_slip_ratio"]
    work = 2 * np.pi * (data["mean_torque_contact"] + data["mean_torque_needle"] + data["mean_torque_needle_drag"])
    contact = work / (2 * np.pi)
    others = train - contact
    cold, warm, hot = 0, 1, 2
    in_band = (work >= BAIR[0]) & (work <= BAIR[1])
    return [
        ("Bhutta and others 2023; Mufti and Priest 2003", "friction rises from 60 to 95 °C at 300 rev/min, without camshaft bearings",
         train[:, 0, hot] > train[:, 0, warm]),
        ("", "the same with camshaft bearings", friction[:, 0, hot] > friction[:, 0, warm]),
        ("", "the same at 600 rev/min, without camshaft bearings", train[:, 1, hot] > train[:, 1, warm]),
        ("", "at 600 rev/min with camshaft bearings", friction[:, 1, hot] > friction[:, 1, warm]),
        ("", "friction rises from 25 to 95 °C at 300 rev/min, without camshaft bearings", train[:, 0, hot] > train[:, 0, cold]),
        ("Mufti and Priest 2003", "friction at 95 °C falls from 300 to 900 rev/min, without camshaft bearings",
         train[:, 2, hot] < train[:, 0, hot]),
        ("", "the same with camshaft bearings", friction[:, 2, hot] < friction[:, 0, hot]),
        ("Khurram and others 2015, 2020; Duffy 1993", "slip falls with oil temperature at every speed",
         np.all((slip[:, :, cold] > slip[:, :, warm]) & (slip[:, :, warm] > slip[:, :, hot]), axis=1)),
        ("Khurram and others 2015, 2020", "negative slip somewhere in the turn of the hot engine, 95 °C",
         np.any(least_slip[:, :, hot] < 0, axis=1)),
        ("Duffy 1993", "slip at 25 °C grows from 300 to 900 rev/min", slip[:, 2, cold] > slip[:, 0, cold]),
        ("", "slip at 60 °C grows from 300 to 900 rev/min", slip[:, 2, warm] > slip[:, 0, warm]),
        ("Bair and others 1986", "contact and roller bearing take 0.32 to 0.70 J a turn at 900 rev/min and 25 °C", in_band[:, 2, cold]),
        ("", "the same at any of the points at 60 °C", np.any(in_band[:, :, warm], axis=1)),
        ("Pushrod tester with roller follower (Trans. JSME)", "with thinner oil, 60 to 95 °C at 300 rev/min, friction of cam and roller falls "
         "and that of the other elements rises",
         (contact[:, 0, hot] < contact[:, 0, warm]) & (others[:, 0, hot] > others[:, 0, warm])),
    ]


def find_monotonies(data):
    """Source, trend, rank correlation over all samples at one point."""
    slip = data["revolution_slip"]
    rank = {key: i for i, (key, *_) in enumerate(RANGES)}
    values = samples()

    def correlation(key, series):
        return spearmanr(values[:, rank[key]], series).statistic

    return [
        ("Khurram and others 2015, 2020", "friction modifiers and anti-wear agents, which change the boundary coefficient, raise slip: a lower "
         "coefficient, more slip, 300 rev/min, 95 °C", correlation("asperity.boundary_coefficient", slip[:, 0, 2])),
        ("Duffy 1993", "roughness lowers slip, 600 rev/min, 60 °C", correlation("surface.cam_roughness_um", slip[:, 1, 1])),
        ("", "drag of the bearing raises slip, 600 rev/min, 60 °C", correlation("needle_drag.viscous_factor", slip[:, 1, 1])),
    ]


def where_it_lies(shown):
    """Coefficients whose values differ most between the samples that show a trend and the others, as ranges of the middle 80 %."""
    if shown.all() or not shown.any():
        return "-"
    if min(shown.sum(), (~shown).sum()) < FEWEST:
        return "too few to say"
    values = samples()
    words = []
    for column, (key, low, high, is_ratio, _) in zip(values.T, RANGES):
        scaled = np.log(column / low) / np.log(high / low) if is_ratio else (column - low) / (high - low)
        shift = scaled[shown].mean() - scaled[~shown].mean()
        # Standard error of the difference of two means of evenly spread numbers, which vary by 1/12
        error = np.sqrt((1 / shown.sum() + 1 / (~shown).sum()) / 12)
        if abs(shift) < 3 * error:
            continue
        first, last = np.quantile(column[shown], [0.1, 0.9])
        words.append((abs(shift), f"{label(key)} {first:.2g} to {last:.2g}"))
    return "; ".join(text for _, text in sorted(words, reverse=True)[:3]) or "all over the ranges"


def read_data(path):
    """Scalars of all cases as arrays by sample, speed and temperature."""
    result = read_result(path, with_series=False)
    names = ["mean_torque_friction", "mean_torque_bearings", "mean_torque_contact", "mean_torque_needle", "mean_torque_needle_drag",
             "mean_torque_tip", "mean_torque_seal", "mean_torque_guide_side", "mean_torque_pivot", "mean_torque_guide", "revolution_slip",
             "min_slip_ratio"]
    found = {}
    for name in names:
        values = np.asarray(result.summary[name].values, dtype=float)
        if values.size != SAMPLES * len(SPEEDS) * len(TEMPERATURES):
            raise ResultError(f"{path}: {values.size} cases, not those that --cases writes")
        found[name] = as_points(values)
    missing = sum(not np.isfinite(values).all() for values in found["mean_torque_friction"])
    if missing:
        raise ResultError(f"{path}: {missing} samples have a case without a result")
    return found


def page(data, sticking):
    """The page in Markdown; `sticking` has the same cases with stick-slip."""
    lines = ["# Measured trends", "",
             "Trends that others measured on roller valve trains, and for what fraction of the plausible coefficients the model reproduces them. Trends are",
             "compared and not numbers, because the rigs differ from the train computed here. Nothing is fitted. `make trends` (`post/trends.py`) makes",
             "this page.", "",
             f"There are {SAMPLES} sets of coefficients, distributed uniformly over the ranges below. Each is computed at nine points: 300, 600 and 900 rev/min of the",
             "camshaft, oil at 25, 60 and 95 °C. All other values are those of `decks/sliding_joints.nml`, with the film law `moes`, drag of the needles,",
             "and camshaft bearings of finite width in mixed friction.", "",
             "| coefficient | from | to | range |", "|---|---|---|---|"]
    for key, low, high, is_ratio, why in RANGES:
        lines.append(f"| {label(key)} | {low:g} | {high:g} | {why}{'; logarithmic' if is_ratio else ''} |")
    rests = [100 * (sticking["revolution_slip"][:, i, 2] == 0).mean() for i in range(len(SPEEDS))]
    lines += ["", "## Results", "",
              "Where friction of asperities suffices to hold the roller, the default law lets it creep, in proportion to",
              "`asperity.mobilising_speed_m_s`. The column \"if it sticks\" is of the same cases with `asperity.mobilisation = 'stick_slip'`, whose roller",
              f"does not slip at all there: at 95 °C in {rests[0]:.0f}, {rests[1]:.0f} and {rests[2]:.0f} % of the sets at 300, 600 and 900 rev/min. A "
              "real contact has its elastic creep",
              "in between, which is not computed. Trends of slip whose two numbers differ rest on the creep.", "",
              "| source | trend | sets that show it | if it sticks | their coefficients, as far as they differ from the others (middle 80 %) |",
              "|---|---|---|---|---|"]
    for (source, trend, shown), (_, _, then) in zip(find_trends(data), find_trends(sticking)):
        lines.append(f"| {source} | {trend} | {100 * shown.mean():.0f} % | {100 * then.mean():.0f} % | {where_it_lies(shown)} |")
    lines += ["", "| source | trend over the sets | rank correlation | if it sticks |", "|---|---|---|---|"]
    for (source, trend, value), (_, _, then) in zip(find_monotonies(data), find_monotonies(sticking)):
        lines.append(f"| {source} | {trend} | {value:+.2f} | {then:+.2f} |")
    lines += ["", "![Friction torque over oil temperature](figures/trends.png)", "",
              "*Mean friction torque without camshaft bearings over the oil temperature, one line for each set; orange if it rises from 60 to",
              "95 °C.*", "", "## Trends that are not compared", "",
              "- Flash temperature (Umar, Mufti and Khurram 2018): computed with `&heat`, not varied here. Slip during a start-up (Li and others 2023).",
              "- Axial thrust of the roller (Duffy 1993): a tilt loads its ends (`&roller_profile`); an axial force is not in the model.",
              "- A plain pin in place of needles, and rolling friction as the main loss of the contact (Alakhramsing 2018): `decks/plain_pin.nml`. Such a pin",
              "  takes 1 to 7 times the contact's part in oil at 95 °C and half of it at 25 °C.",
              "", "## Sources", "",
              "- Bair, S., Griffioen, J. A. and Winer, W. O. (1986): J. Tribology 108, 478.",
              "- Bhutta, M. U. and others (2023): Materials 16, 3431.",
              "- Duffy, P. E. (1993): SAE Technical Paper 930691.",
              "- Khurram, M., Mufti, R. A. and others (2015, 2020): Tribology International.",
              "- Mufti, R. A. and Priest, M. (2003): J. Tribology 125, 628.", ""]
    return "\n".join(lines)


def draw(data):
    """Friction over temperature, a panel for each speed."""
    figure = Figure(figsize=(8.4, 3.0), layout="constrained")
    panels = figure.subplots(1, len(SPEEDS), sharey=True)
    train = 1e3 * (data["mean_torque_friction"] - data["mean_torque_bearings"])
    for i, (panel, speed) in enumerate(zip(panels, SPEEDS)):
        rises = train[:, i, 2] > train[:, i, 1]
        for shown, colour, order in ((~rises, "#9a9a9a", 1), (rises, "#d55e00", 2)):
            for row in train[shown, i]:
                panel.plot(TEMPERATURES, row, color=colour, linewidth=0.6, alpha=0.7, zorder=order)
        panel.plot(TEMPERATURES, np.median(train[:, i], axis=0), color="#111111", linewidth=1.8, zorder=3, label="median")
        panel.set_title(f"{speed:.0f} rev/min: {100 * rises.mean():.0f} % rise", fontsize=9.0)
        panel.set_xlabel("oil temperature [°C]")
        panel.set_xticks(TEMPERATURES)
        panel.set_yscale("log")
        panel.yaxis.set_major_locator(FixedLocator(TICKS))
        panel.yaxis.set_minor_locator(NullLocator())
        panel.yaxis.set_major_formatter(ScalarFormatter())
    panels[0].set_ylabel("mean friction torque\nwithout camshaft bearings [N mm]")
    panels[0].legend(frameon=False)
    return figure


def main(arguments=None):
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file", nargs="?", type=Path, help="result file of the cases")
    parser.add_argument("sticking", nargs="?", type=Path, help="that of the same cases with asperity.mobilisation = 'stick_slip', for the page")
    parser.add_argument("--cases", type=Path, metavar="FOLDER", help="write deck and table of the cases there")
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
        if options.sticking is None:
            parser.error("the page needs both result files")
        write_text(options.page, page(data, read_data(options.sticking)))
    if options.figure:
        save_figure(draw(data), options.figure, dpi=110)


if __name__ == "__main__":
    sys.exit(run(main, "trends.py"))
