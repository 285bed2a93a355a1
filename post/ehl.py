#!/usr/bin/env python3
"""Draw a cycle of solved contacts: pressure and film at some angles, and the film over the cycle beside a formula's.

Usage: post/ehl.py FILE_ehl.h5 [FILE.h5] --output FIGURE.png [--case N] [--angles 125 150 180 205]
       FILE_ehl.h5 comes from `camroller ehl`, FILE.h5 from `camroller run` on a deck with the same cases
"""

from __future__ import annotations

import argparse
import sys

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy


def draw(path: str, formula: str | None, case: int, angles: list[float], output: str) -> None:
    """Profiles on the left, the cycle on the right."""
    figure, axes = plt.subplots(2, 2, figsize=(12, 7), layout="constrained")
    with h5py.File(path) as file:
        group = file["ehl"]
        turn, x = group["angle"][:], group["x"][case]
        for angle in angles:
            i = int(numpy.argmin(numpy.abs(turn - angle)))
            place = 1e6 * x * group["half_width"][case, i]
            axes[0, 0].plot(place, group["pressure"][case, i] / 1e6, label=f"{turn[i]:.0f} deg")
            axes[1, 0].plot(place, 1e6 * group["film"][case, i], label=f"{turn[i]:.0f} deg")
        reach = 2.5e6 * group["half_width"][case].max()
        axes[0, 1].plot(turn, 1e6 * group["film_min"][case], "k", label="numerical, smallest")
        axes[0, 1].plot(turn, 1e6 * group["film_central"][case], "k--", label="numerical, central")
        axes[1, 1].semilogy(turn, numpy.abs(group["sliding_speed"][case]), "k", label="numerical, with squeeze")
        top = 3e6 * group["film_central"][case].max()
    if formula:
        with h5py.File(formula) as file:
            degrees = numpy.degrees(file["series/cam_angle"][:]) if file["series/cam_angle"].attrs["units"] == "rad" \
                else file["series/cam_angle"][:]
            axes[0, 1].plot(degrees, 1e6 * file["series/film_thickness_min"][case], "C3", label="formula, smallest")
            axes[0, 1].plot(degrees, 1e6 * file["series/film_thickness_central"][case], "C3--", label="formula, central")
            axes[1, 1].semilogy(degrees, numpy.abs(file["series/sliding_speed"][case]), "C3", label="formula")
    axes[0, 0].set(ylabel="pressure [MPa]", xlim=(-reach, reach))
    axes[1, 0].set(ylabel="film [um]", xlabel="place across the contact, inlet on the left [um]", xlim=(-reach, reach), ylim=(0, top))
    axes[0, 1].set(ylabel="film [um]")
    axes[1, 1].set(ylabel="sliding speed [m/s]", xlabel="cam angle, full lift at 180 [deg]")
    for axis in axes.flat:
        axis.legend(fontsize=8)
        axis.grid(alpha=0.3)
    figure.savefig(output, dpi=90)


def main(arguments=None) -> int:
    """Command line; returns the exit code."""
    parser = argparse.ArgumentParser(description="draw a cycle of solved contacts")
    parser.add_argument("file")
    parser.add_argument("formula", nargs="?")
    parser.add_argument("--output", required=True)
    parser.add_argument("--case", type=int, default=0)
    parser.add_argument("--angles", type=float, nargs="+", default=[90.0, 125.0, 150.0, 180.0, 205.0])
    options = parser.parse_args(arguments)
    draw(options.file, options.formula, options.case, options.angles, options.output)
    return 0


if __name__ == "__main__":
    sys.exit(main())
