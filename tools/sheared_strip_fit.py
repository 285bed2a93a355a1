#!/usr/bin/env python3
"""Find the constants of `sheared_strip` in src/contact/traction.f90 from contacts that were solved numerically.

Usage: sheared_strip_fit.py PROGRAM DECK WORK [--decks N] [--seed S] [--check S2]

DECK is decks/thesis.nml. N variants of it without asperities, with random oils, speeds, loads, widths and moduli, are run by
`run` and `ehl`; each contact of them is one row: the shear of its film over `eta_0 V_s 2 b L/h`, with the film that was solved.
Least squares of the logarithm find the constants; half as many variants of another seed check them. Prints the constants and
the errors by M = W*/sqrt(2 U) and alpha p_0 of the dry contact. Variants that take longer than SECONDS are left out.
"""

from __future__ import annotations

import argparse
import pathlib
import random
import re
import subprocess

import h5py
import numpy as np
from scipy.optimize import least_squares

# Gauss-Legendre quadrature over the half ellipse of pressure, as src/contact/contact_rule.f90
NODES, WEIGHTS = np.polynomial.legendre.leggauss(24)
HEIGHTS = np.cos(np.pi / 4 * (1 + NODES))
WEIGHTS = np.pi / 4 * WEIGHTS * HEIGHTS
# Of the rigid contact with constant viscosity: pressure and width of the strip
PRESSURE, WIDTH = 4.0347, 1.0144 * np.pi / 4
M_BOUNDS = (0, 0.3, 1, 2, 3, 5, 10, 100)
STRESS_BOUNDS = (0, 2, 4, 7, 50)
ROUND = (0.62, 4.2, 4.2, 2.3)
SECONDS = 60


def relative_viscosity(law: str, alpha: float, eta: float):
    """Viscosity over that without pressure, a function of the pressure [Pa]."""
    if law == "cameron":
        return lambda p: (1 + alpha * p / 16) ** 16
    if law == "barus":
        return lambda p: np.exp(alpha * p)
    index = alpha / (5.1e-9 * (np.log(eta) + 9.67))
    return lambda p: np.exp((np.log(eta) + 9.67) * ((1 + 5.1e-9 * p) ** index - 1))


def draw(generator: random.Random) -> dict[str, str]:
    """Values of one variant."""
    factor = 10 ** generator.uniform(-0.7, 1.3)
    speeds = sorted(round(10 ** generator.uniform(1.8, 3.4)) for _ in range(2))
    return {
        "lubricant.pressure_law": generator.choice(["cameron", "barus", "roelands"]),
        "lubricant.pressure_viscosity_coefficient_per_GPa": f"{generator.uniform(3, 26):.1f}",
        "lubricant.viscosity_points_Pa_s": ",".join(f"{factor * eta:.6f}" for eta in (0.15, 0.0305, 0.01)),
        "mechanism.contact_width_mm": f"{generator.uniform(6, 24):.2f}",
        "materials.cam_modulus_GPa": f"{generator.uniform(80, 230):.0f}",
        "spring.base_circle_load_N": f"{generator.uniform(20, 250):.0f}",
        "sweep.values_1": f"{speeds[0]},{speeds[1] + 1}",
        "sweep.values_2": "25,95",
        "film.law": "moes",
        "traction.limiting_coefficient": "1e3",
        "output.angle_step_deg": "5",
        "numerics.accuracy": "1e-3",
    }


def solve(program: pathlib.Path, deck: pathlib.Path, work: pathlib.Path, values: dict[str, str]) -> list[dict]:
    """Rows of one variant."""
    options = [word for key, value in values.items() for word in ("--set", f"{key}={value}")]
    for command in ("run", "ehl"):
        # cases without a result have no numbers in the file
        try:
            subprocess.run([program, command, deck, "-o", work / f"{command}.h5", "--quiet", *options], check=False,
                           capture_output=True, timeout=SECONDS)
        except subprocess.TimeoutExpired:
            return []
    rows = []
    with h5py.File(work / "run.h5") as run, h5py.File(work / "ehl.h5") as file:
        solved, series = file["ehl"], run["series"]
        length = 1e-3 * float(values["mechanism.contact_width_mm"])
        cam, roller = 1e9 * float(values["materials.cam_modulus_GPa"]), 204e9
        modulus = 2 / ((1 - 0.28**2) / cam + (1 - 0.29**2) / roller)
        alpha = 1e-9 * float(values["lubricant.pressure_viscosity_coefficient_per_GPa"])
        etas = dict(zip((25, 60, 95), map(float, values["lubricant.viscosity_points_Pa_s"].split(",")), strict=True))
        for case, celsius in enumerate(run["sweep/operating_point.oil_temperature_degC"]):
            eta = etas[round(float(celsius))]
            viscosity = relative_viscosity(values["lubricant.pressure_law"], alpha, eta)
            for angle in range(0, 360, 10):
                i = np.argmin(abs(series["cam_angle"][:] - angle))
                j = np.argmin(abs(solved["angle"][:] - angle))
                load, slip = solved["load"][case, j], solved["sliding_speed"][case, j]
                shear, film, half_width = (solved[name][case, j] for name in ("shear", "film_central", "half_width"))
                radius, rolling = series["equivalent_radius"][case, i], series["rolling_speed"][case, i]
                if not load > 0 or not abs(load / series["contact_load"][case, i] - 1) < 1e-3 or not abs(slip) > 1e-10:
                    continue
                speed = eta * abs(rolling - slip / 2) / (modulus * radius)
                group = load / (modulus * radius * length)
                rows.append({
                    "rigidity": PRESSURE * speed / group**2, "film": film / radius / group, "viscosity": viscosity, "alpha": alpha,
                    "peak": 2 * load / (np.pi * half_width * length), "shear": shear * film / (eta * slip * 2 * half_width * length)})
    return [row for row in rows if row["shear"] > 0]


def shear(constants, row: dict) -> float:
    """The shear of the strip, in the unit of the rows."""
    part, thick, power, fade = constants
    thickening = np.log(row["viscosity"](row["peak"] / np.sqrt(1 + row["rigidity"])))
    pressure = 1 / np.sqrt(1 + row["rigidity"] / (part**2 + (thickening / thick) ** power))
    width = np.sqrt(1 + WIDTH * row["film"] * row["rigidity"] / (row["rigidity"] + PRESSURE / (2 * fade**2)))
    return width * float((WEIGHTS * row["viscosity"](row["peak"] * pressure * HEIGHTS)).sum())


def dry_shear(row: dict) -> float:
    """The same of the dry contact's strip."""
    return float((WEIGHTS * row["viscosity"](row["peak"] * HEIGHTS)).sum())


def show(constants, rows: list[dict]) -> None:
    """Factors between formulas and solutions by M and alpha p_0."""
    print(" M             alpha p_0  contacts  strip           dry contact")
    for low, high in zip(M_BOUNDS, M_BOUNDS[1:]):
        for bottom, top in zip(STRESS_BOUNDS, STRESS_BOUNDS[1:]):
            chosen = [row for row in rows if low <= (PRESSURE / 2 / row["rigidity"]) ** 0.5 < high
                      and bottom <= row["alpha"] * row["peak"] < top]
            if chosen:
                strip, dry = ([formula / row["shear"] for formula, row in zip(formulas, chosen)] for formulas in (
                    [shear(constants, row) for row in chosen], [dry_shear(row) for row in chosen]))
                print(f" {low:3g} to {high:3g}    {bottom:2g} to {top:2g}   {len(chosen):7d}  {min(strip):5.2f} to {max(strip):5.2f}"
                      f"  {min(dry):6.2f} to {max(dry):5.2f}")


def main() -> None:
    """Variants, constants, tables."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("deck", type=pathlib.Path)
    parser.add_argument("work", type=pathlib.Path)
    parser.add_argument("--decks", type=int, default=20, help="variants that constants are found from")
    parser.add_argument("--seed", type=int, default=1, help="seed of these")
    parser.add_argument("--check", type=int, default=77, help="seed of those that check them")
    arguments = parser.parse_args()
    arguments.work.mkdir(parents=True, exist_ok=True)
    smooth = arguments.work / "smooth.nml"
    smooth.write_text(re.sub(r"&asperity.*?\n/", "", arguments.deck.read_text(), flags=re.DOTALL))
    found, held_out = ([row for _ in range(count) for row in solve(arguments.program, smooth, arguments.work, draw(generator))]
                       for count, generator in ((arguments.decks, random.Random(arguments.seed)),
                                                (arguments.decks // 2, random.Random(arguments.check))))
    best = least_squares(lambda constants: [np.clip(np.log(shear(constants, row) / row["shear"]), -1.5, 1.5) for row in found], ROUND,
                         loss="soft_l1", f_scale=0.1).x
    print(f"constants found from {len(found)} contacts: {', '.join(f'{value:.3f}' for value in best)}; as in the source: {ROUND}")
    show(ROUND, found)
    print(f"{len(held_out)} others, with the constants of the source")
    show(ROUND, held_out)


if __name__ == "__main__":
    main()
