#!/usr/bin/env python3
"""Write the lift tables of the hard decks beside this file, or into the folder given.

All but one are the lift of decks/thesis.nml, 9.5 mm (1 - x^2)^4 with x = (angle - 180)/70, at other distances between the
rows and with noise; `periodic_lift.txt` touches zero and goes on. Noise is normal: the sum of twelve numbers, each uniform
between -1/2 and 1/2, of the generator x <- (1103515245 x + 12345) mod 2^31, so that every machine writes the same tables.
"""

import math
import pathlib
import sys

HALF_ANGLE = 70.0  # deg
MAX_LIFT = 9.5  # mm


def lift(angle):
    """Lift [mm] at a cam angle [deg]."""
    x = (angle - 180.0) / HALF_ANGLE
    return MAX_LIFT * max(0.0, (1.0 - x) * (1.0 + x)) ** 4


def normal_numbers(seed):
    """Endless normal noise with a standard deviation of one."""
    x = seed
    while True:
        total = 0.0
        for _ in range(12):
            x = (1103515245 * x + 12345) % 2**31
            total += x / 2**31 - 0.5
        yield total


def event(step, noise_um=0.0, seed=1):
    """Rows of the event at every `step` degrees, with noise in between; a measured lift is not negative."""
    count = round(2.0 * HALF_ANGLE / step)
    noise = normal_numbers(seed)
    rows = []
    for i in range(count + 1):
        angle = 180.0 - HALF_ANGLE + i * step
        value = lift(angle)
        if 0 < i < count and noise_um > 0.0:
            value = max(0.0, value + 1e-3 * noise_um * next(noise))
        rows.append((angle, value))
    return rows


def periodic():
    """Rows of a full turn: (3 + 0.5 sin(angle)) (1 - cos(angle)) + 0.3 (1 - cos(2 angle)) mm."""
    rows = []
    for i in range(181):
        turn = math.radians(2.0 * i)
        sway = (3.0 + 0.5 * math.sin(turn)) * (1.0 - math.cos(turn))
        rows.append((2.0 * i, sway + 0.3 * (1.0 - math.cos(2.0 * turn))))
    return rows


TABLES = {
    "noisy_lift.txt": ("a row for each half degree, noise of 0.05 um", event(0.5, 0.05, seed=1)),
    "very_noisy_lift.txt": ("a row for each half degree, noise of 2 um", event(0.5, 2.0, seed=2)),
    "coarse_lift.txt": ("a row for each five degrees", event(5.0)),
    "fine_lift.txt": ("a row for each twentieth of a degree", event(0.05)),
    "periodic_lift.txt": ("a full turn without a dwell, a row for each two degrees", periodic()),
}


def main():
    """Write all tables."""
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).parent
    for name, (what, rows) in TABLES.items():
        lines = [f"# Lift of a hard deck: {what}, rounded to 1e-6 mm; written by make_tables.py.",
                 "# cam angle [deg]   lift [mm]"]
        lines += [f"{angle:7.2f} {value:10.6f}" for angle, value in rows]
        (folder / name).write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
