#!/usr/bin/env python3
"""Draw how a flexible train answers to the speed: spectrum of the spring's surge, its largest force, speed of seating and bounces.

Usage: post/campbell.py FILE [--output DIR] [--name NAME] [--dpi DPI]

FILE is a sweep over the speed alone, of a deck with `&spring_surge`, with its series; cases without are left out. The speed is that of the
camshaft, also where the deck gives that of an engine's crankshaft. In the map (after Campbell 1924) the force of the
spring's modes is taken apart into harmonics of the cam: dashed lines are the natural frequencies of the clamped spring, dotted rays
harmonics; a mode answers where a ray meets its line. Below stand the largest force beside the estimate that a rigid train gives before
a run, and the speed of seating with its range over the cycles, dots for each turn where a motion does not repeat every turn; lines are then
means of the turns. Exit code 2 where the file cannot be used.
"""

import argparse
from pathlib import Path
import sys
import textwrap

import matplotlib

matplotlib.use("Agg")

from matplotlib.colors import LogNorm  # noqa: E402
from matplotlib.patheffects import withStroke  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402
import numpy as np  # noqa: E402

from cases import missing_words, status_of  # noqa: E402
from command import DPI, script, save_figure  # noqa: E402
from quantities import SPEED, camshaft_speed  # noqa: E402
from read import ResultError, read_result  # noqa: E402
from turns import turns_of  # noqa: E402

SHOWN = 3  # decades of force
TITLE = 80  # characters of a line above the figure
RAYS = range(6, 31, 2)
OUTLINE = [withStroke(linewidth=1.5, foreground="#404040")]  # of white words on bright places


def mode_force(result):
    """Force of the spring's modes on the valve [N], cases by angles: k n pi q_n, even modes with the other sign."""
    stiffness = float(result.deck["spring.stiffness_N_m"].values)
    total = 0.0
    for n in range(1, 1 + mode_count(result)):
        total = total - (-1) ** n * stiffness * n * np.pi * result.series[f"spring_mode_{n}"].values
    return total


def mode_count(result):
    """Number of modes in the file."""
    return sum(name.startswith("spring_mode_") for name in result.series)


def mode_frequencies(result):
    """Natural frequencies of the spring with its ends clamped [Hz]: (n/2) sqrt(k/m), Wahl (1963)."""
    stiffness = float(result.deck["spring.stiffness_N_m"].values)
    mass = float(result.deck["spring_surge.mass_kg"].values)
    return [0.5 * n * np.sqrt(stiffness / mass) for n in range(1, 1 + mode_count(result))]


def spectrum(force):
    """Amplitudes of the harmonics of the cam, cases by orders from 1 on, in the unit of the force."""
    return 2.0 * np.abs(np.fft.rfft(force, axis=1))[:, 1:] / force.shape[1]


def draw(result):
    """The three panels."""
    if list(result.sweep) != [SPEED]:
        raise ResultError(f"{result.path}: not a sweep over {SPEED} alone")
    if not mode_count(result) or "surge_force" not in result.summary:
        raise ResultError(f"{result.path}: no series of the spring's modes: the deck needs &spring_surge, the sweep series = 'all'")
    there = np.isfinite(mode_force(result)).all(axis=1)
    if there.sum() < 2:
        raise ResultError(f"{result.path}: {there.sum()} of {result.cases} cases has series of the spring's modes; a map needs two")
    speed = camshaft_speed(result)
    order = np.argsort(speed)
    order = order[there[order]]
    speed = speed[order]
    figure = Figure(figsize=(8.0, 9.6), layout="constrained")
    above, middle, below = figure.subplots(3, 1, sharex=True, height_ratios=(2.2, 1.0, 1.0))
    rays = draw_map(figure, above, result, order, speed)
    draw_force(middle, result, order, speed)
    draw_seating(below, result, order, speed)
    below.set_xlabel("speed of the camshaft [rev/min]")
    below.set_xlim(speed[0], speed[-1])
    figure.suptitle("\n".join(textwrap.fill(line, TITLE) for line in (result.title, ", ".join(left_out(result, there))) if line))
    keep_apart(figure, rays)
    return figure


def keep_apart(figure, labels):
    """Leave out labels that would stand on one below; they come from the lowest on."""
    figure.draw_without_rendering()
    top = -np.inf
    for label in labels:
        box = label.get_window_extent()
        if box.y0 < top:
            label.remove()
        else:
            top = box.y1


def left_out(result, there):
    """How many cases are not drawn and why: parts of a sentence."""
    status = status_of(result)
    bare = int((~there & (status == 0)).sum())
    return missing_words(status) + [f"{bare} of {result.cases} cases have no series"] * (bare > 0)


def draw_map(figure, axes, result, order, speed):
    """Harmonics of the modes' force over speed and frequency; returns the numbers at the rays, from the lowest on."""
    amplitude = spectrum(mode_force(result)[order])
    frequencies = mode_frequencies(result)
    top = 1.15 * frequencies[-1]
    harmonics = np.arange(1, amplitude.shape[1] + 1)
    frequency = speed[:, None] / 60.0 * harmonics
    rows = np.linspace(0.0, top, 400)
    image = np.array([np.exp(np.interp(rows, frequency[i], np.log(np.maximum(amplitude[i], 1e-12)))) for i in range(len(speed))])
    highest = image.max()
    mesh = axes.pcolormesh(speed, rows, image.T, norm=LogNorm(highest / 10.0**SHOWN, highest), cmap="viridis", shading="nearest",
                           rasterized=True)
    figure.colorbar(mesh, ax=axes, label="harmonics of the modes' force [N]")
    for n, natural in enumerate(frequencies, 1):
        axes.axhline(natural, color="white", linestyle="--", linewidth=0.9)
        axes.annotate(f"mode {n}", (speed[0], natural), xytext=(4, 3), textcoords="offset points", color="white",
                      path_effects=OUTLINE)
    labels = []
    for ray in RAYS:
        axes.plot(speed, ray * speed / 60.0, color="white", linestyle=":", linewidth=0.6)
        if ray * speed[-1] / 60.0 < top:
            labels.append(axes.annotate(str(ray), (speed[-1], ray * speed[-1] / 60.0), xytext=(-14, -3), textcoords="offset points",
                                        color="white", path_effects=OUTLINE))
    axes.set_ylim(0.0, top)
    axes.set_ylabel("frequency [Hz]")
    return labels


def of_turns(result, order, words):
    """What a scalar of the train is called: the mean of its turns where one of the cases drawn has several."""
    several = "summary_cycles" in result.summary and (result.summary["summary_cycles"].values[order] > 1).any()
    return f"{words}, mean of the turns" if several else words


def draw_force(axes, result, order, speed):
    """Largest force of the modes beside its estimate."""
    axes.plot(speed, result.summary["surge_force"].values[order], color="#08306b", label=of_turns(result, order, "largest force of mode 1"))
    if "surge_estimate_1" in result.summary:
        axes.plot(speed, result.summary["surge_estimate_1"].values[order], color="#d95f02", linestyle="--",
                  label="the same estimated from a rigid train")
    axes.set_yscale("log")
    axes.set_ylabel("force of mode 1 [N]")
    axes.legend(frameon=False)


def draw_seating(axes, result, order, speed):
    """Speed of seating with its range over the cycles, and bounces."""
    lines = axes.plot(speed, result.summary["seating_speed"].values[order], color="#08306b", label=of_turns(result, order, "speed of seating"))
    axes.fill_between(speed, result.summary["seating_speed_lowest"].values[order], result.summary["seating_speed_highest"].values[order],
                      color="#08306b", alpha=0.25, linewidth=0.0)
    for case, place in zip(order, speed):
        turns = turns_of(result, "seating_speed", case)
        axes.plot(np.full(turns.size, place), turns, color="#08306b", marker="o", markersize=1.5, linestyle="none")
    axes.set_yscale("log")
    axes.set_ylabel("speed of seating [m/s]")
    other = axes.twinx()
    lines += other.plot(speed, result.summary["bounces"].values[order], color="#d95f02", linestyle=":", label="bounces per cycle")
    other.set_ylim(bottom=0, top=max(1.0, 1.1*np.nanmax(result.summary["bounces"].values[order])))
    other.set_ylabel("bounces per cycle")
    other.spines["right"].set_visible(True)
    axes.legend(lines, [line.get_label() for line in lines], frameon=False, loc="upper left")


@script
def main(arguments=None):
    """Command line; returns the exit code."""
    parser = argparse.ArgumentParser(prog="campbell.py", description="draw how a flexible train answers to the speed")
    parser.add_argument("file")
    parser.add_argument("--output", metavar="DIR", help="folder for the figure (default: that of the file)")
    parser.add_argument("--name", help="its name (default: that of the file with _campbell)")
    parser.add_argument("--dpi", type=DPI, default=100, help="pixels per inch (default: 100)")
    options = parser.parse_args(arguments)
    result = read_result(options.file)
    folder = Path(options.output) if options.output else result.path.parent
    target = folder / f"{options.name or result.path.stem + '_campbell'}.png"
    save_figure(draw(result), target, dpi=options.dpi)
    print(f"campbell: {target}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
