#!/usr/bin/env python3
"""What oil beside the dry contact is worth on a base circle: rolling resistance and slip, with the load along the roller by its film.

Usage: test/reference/oiled_slices.py PROGRAM      prints the table of doc/theory.md, section 5.1

The program takes the load along the roller from the dry contact. Here the slices, each with the same laws for a line contact (Moes,
Biboulet and Houpert, the strip from rigid to elastic contacts), carry what makes their film less their elastic approach as wide as the
gap; slices do not see each other. Data are those of decks/thesis.nml; speeds, load and radius are those that the program finds.
"""

import pathlib
import subprocess
import sys
import tempfile

import h5py
import numpy as np
from scipy.optimize import brentq

DECK = pathlib.Path(__file__).resolve().parents[2] / "decks/thesis.nml"
LENGTH, VISCOSITY, PRESSURE_VISCOSITY = 13.7e-3, {25: 0.15, 60: 0.0305}, 22e-9
MODULUS = 2 / ((1 - 0.28**2) / 170e9 + (1 - 0.29**2) / 204e9)
# torque of the needles over the load, over the roller's radius [-]
NEEDLES = 0.0015 * (8.5 - 2.4 - 0.99) / 8.5
ANGLES, WEIGHTS = (np.polynomial.legendre.leggauss(24)[0] + 1) * np.pi / 4, np.polynomial.legendre.leggauss(24)[1] * np.pi / 4
PLACES = np.linspace(-LENGTH / 2, LENGTH / 2, 1601)
LOADS = np.exp(np.linspace(np.log(1e-9), np.log(1e-3), 4000))  # per length over E' R
PROFILES = [("none", "", 0 * PLACES)]
PROFILES += [(f"tilt {tilt} mrad", f"&roller_profile tilt_mrad = {tilt} /", (PLACES + LENGTH / 2) * tilt * 1e-3)
             for tilt in (0.05, 0.1, 0.2, 0.5)]
PROFILES += [(f"crown {radius} m", f"&roller_profile profile = 'crowned' crown_radius_mm = {radius}e3 /", PLACES**2 / (2 * radius))
             for radius in (10, 3)]


def film(speed, load):
    """Central film over R (Moes 1992)."""
    root = np.sqrt(2 * speed)
    m, viscous = load / root, PRESSURE_VISCOSITY * MODULUS * (2 * speed)**0.25
    rigid_iso, elastic_iso = 3 / m, 2.621 * m**-0.2
    rigid_piezo, elastic_piezo = 1.287 * viscous**(2 / 3), 1.311 * m**-0.125 * viscous**0.75
    s = (7 + 8 * np.exp(-2 * elastic_iso / rigid_iso)) / 5
    return root * ((rigid_iso**(7 / 3) + elastic_iso**(7 / 3))**(3 * s / 7)
                   + (rigid_piezo**-3.5 + elastic_piezo**-3.5)**(-2 * s / 7))**(1 / s)


def shear(speed, load, height, radius):
    """Shear over viscosity and sliding speed, per length (doc/theory.md, section 10)."""
    half_width, peak = radius * np.sqrt(8 * load / np.pi), MODULUS * np.sqrt(load / (2 * np.pi))
    rigidity = 4.0347 * speed / load**2
    thick = 16 * np.log1p(PRESSURE_VISCOSITY * peak / np.sqrt(1 + rigidity) / 16)
    relief = 0.62**2 + (thick / 4.2)**4.2
    pressure = peak * np.sqrt(relief / (relief + rigidity))
    strip = half_width * np.sqrt(1 + 1.0144 * np.pi / 4 * height / load * rigidity / (rigidity + 4.0347 / (2 * 2.3**2)))
    mean = ((1 + PRESSURE_VISCOSITY * pressure[:, None] * np.cos(ANGLES) / 16)**16 * np.cos(ANGLES) * WEIGHTS).sum(1)
    return 2 * strip * mean / (height * radius)


def resistance(speed, load, radius):
    """Rolling resistance per length (Biboulet and Houpert 2010)."""
    m = load / np.sqrt(2 * speed)
    return MODULUS * radius * load**1.5 * 1.4 / m / (1 + ((1.4 / 1.45) * np.sqrt(m))**10)**0.1


def balance(sliding, gap, load, radius, cam_speed, viscosity):
    """Shear less resistance and needles, and the resistance, of slices that carry by their film [N]."""
    speed = viscosity * (cam_speed - sliding / 2) / (MODULUS * radius)
    half_width = radius * np.sqrt(8 * LOADS / np.pi)
    approach = 2 * LOADS * radius / np.pi * (1 + 2 * np.log(2 * LENGTH / half_width))
    width = film(speed, LOADS) * radius - approach  # falls with the load

    def of_slices(offset):
        return np.exp(np.interp(-(offset + gap), -width, np.log(LOADS)))

    offset = brentq(lambda c: np.trapezoid(of_slices(c), PLACES) * MODULUS * radius - load, width[-1], width[5])
    loads = of_slices(offset)
    drag = np.trapezoid(resistance(speed, loads, radius), PLACES)
    force = np.trapezoid(shear(speed, loads, film(speed, loads), radius), PLACES) * viscosity * sliding
    return force - drag - NEEDLES * load, drag


def main(program: str) -> None:
    print("profile, rev/min, degC: slip of the program and by the film; rolling resistance [N] of the program and by the film")
    for revolutions, temperature in ((300, 25), (900, 25), (900, 60)):
        for name, group, gap in PROFILES:
            with tempfile.TemporaryDirectory() as folder:
                deck = pathlib.Path(folder) / "deck.nml"
                deck.write_text(DECK.read_text() + f"\n{group}\n")
                subprocess.run([program, "run", deck, "--no-sweep", "--quiet", "-o", deck.with_suffix(".h5"), "--set", "film.law=moes",
                                "--set", "traction.sheared_zone=rigid_to_elastic", "--set", f"operating_point.speed_rpm={revolutions}",
                                "--set", f"operating_point.oil_temperature_degC={temperature}"], check=True, capture_output=True)
                with h5py.File(deck.with_suffix(".h5")) as file:
                    row = np.argmin(np.abs(file["series/cam_angle"][:] - 10))
                    load, radius, cam_speed, rolling, slip, drag = (float(file[f"series/{series}"][0][row]) for series in (
                        "contact_load", "equivalent_radius", "cam_surface_speed", "rolling_speed", "slip_ratio", "friction_rolling"))
            facts = (gap, load, radius, cam_speed, VISCOSITY[temperature])
            sliding = brentq(lambda v, facts=facts: balance(v, *facts)[0], 1e-7, 1.5 * rolling)
            print(f"{name:15s} {revolutions} {temperature}: {slip:.3f} {sliding / rolling:.3f}; {drag:.3f} "
                  f"{balance(sliding, *facts)[1]:.3f}", flush=True)


if __name__ == "__main__":
    main(sys.argv[1])
