"""Draw the mechanism of `decks/thesis.nml` to scale: doc/figures/mechanism.svg, for doc/theory.md.

    .venv/bin/python doc/figures/mechanism.py [FILE]

Complex numbers are points in mm with the pivot C at the origin; the drawing is turned so that the valve opens downwards.
"""

import cmath
import math
from pathlib import Path
import sys

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams.update({"font.size": 10.0, "mathtext.fontset": "dejavuserif", "svg.hashsalt": "mechanism"})

from matplotlib.figure import Figure  # noqa: E402
from matplotlib.patches import Arc, Circle, FancyArrowPatch, Polygon  # noqa: E402
import numpy as np  # noqa: E402

A, B, D = 20.8, 35.5, 31.5
LAMBDA, CHI = math.radians(-3.5), math.radians(37.5)
BASE, ROLLER, PAD = 18.0, 8.5, 6.0  # the radius of the pad is not a key of a deck
LIFT, HALF_ANGLE, EXPONENT = 9.5, math.radians(70.0), 4
SHOWN = math.radians(-32.0)  # cam angle from full lift
TURN = cmath.exp(1j * (0.5 * math.pi + CHI))  # turns the valve's closing direction upwards
CAM, FINGER, STEEL = "#d9e6f2", "#f3e3c7", "#e4e4e4"


def angle_of_finger(theta):
    """Angle gamma [rad] at a cam angle from full lift [rad], theory equations (8) and (9)."""
    base = math.acos((A**2 + D**2 - (BASE + ROLLER)**2) / (2 * A * D)) - LAMBDA
    lift = LIFT * max(0.0, 1 - (theta / HALF_ANGLE)**2)**EXPONENT
    return math.acos(math.cos(base + CHI) - lift / B) - CHI


def path_of_roller(theta):
    """Centre of the roller seen from the cam [mm]."""
    return cmath.exp(1j * theta) * (A * cmath.exp(1j * (angle_of_finger(theta) + LAMBDA)) - D)


def contact(theta):
    """Contact point on the cam, in its own axes [mm]."""
    step = 1e-5
    along = path_of_roller(theta + step) - path_of_roller(theta - step)
    sides = [path_of_roller(theta) + side * ROLLER * 1j * along / abs(along) for side in (1, -1)]
    return min(sides, key=abs)


def xy(*points):
    """Points as two lists, turned as drawn."""
    turned = [TURN * point for point in points]
    return [point.real for point in turned], [point.imag for point in turned]


def draw(axes):
    """The whole sketch."""
    gamma = angle_of_finger(SHOWN)
    cam_centre, pad, roller = D + 0j, B * cmath.exp(1j * gamma), A * cmath.exp(1j * (gamma + LAMBDA))
    back = cmath.exp(-1j * SHOWN)
    touch = cam_centre + back * contact(SHOWN)
    profile = [cam_centre + back * contact(theta) for theta in np.linspace(-math.pi, math.pi, 721)]
    axes.add_patch(Polygon(np.transpose(xy(*profile)), closed=True, facecolor=CAM, edgecolor="#204a73", linewidth=1.6, zorder=2))
    draw_parts(axes, pad, roller)
    draw_lines(axes, cam_centre, pad, roller, touch)
    draw_angles(axes, cam_centre, gamma)
    draw_names(axes, cam_centre, pad, roller, touch)


def draw_parts(axes, pad, roller):
    """Finger, roller, pad, valve, adjuster, base circle."""
    x, y = xy(0, roller, pad)
    axes.plot(x, y, color="#a5813c", linewidth=19, solid_capstyle="round", solid_joinstyle="round", zorder=0.5)
    axes.plot(x, y, color=FINGER, linewidth=17, solid_capstyle="round", solid_joinstyle="round", zorder=0.6)
    tip = TURN * pad - 1j * PAD
    axes.add_patch(Circle(xy(pad)[0] + xy(pad)[1], PAD, facecolor=FINGER, edgecolor="#a5813c", linewidth=1, zorder=0.7))
    stem = [(tip.real - 2.5, tip.imag), (tip.real + 2.5, tip.imag), (tip.real + 2.5, -33), (tip.real - 2.5, -33)]
    axes.add_patch(Polygon(stem, closed=True, facecolor=STEEL, edgecolor="#555555", zorder=0.4))
    axes.add_patch(Polygon([(-5, -5), (5, -5), (5, -33), (-5, -33)], closed=True, facecolor=STEEL, edgecolor="#555555", zorder=0.4))
    axes.add_patch(Circle((0, 0), 5, facecolor=STEEL, edgecolor="#555555", zorder=0.65))
    centre = TURN * roller
    axes.add_patch(Circle((centre.real, centre.imag), ROLLER, facecolor="white", edgecolor="#222222", linewidth=1.6, zorder=2.5))
    axes.add_patch(Circle((centre.real, centre.imag), ROLLER - 2.4, fill=False, edgecolor="#222222", linewidth=0.7, zorder=2.6))
    middle = TURN * D
    axes.add_patch(Circle((middle.real, middle.imag), BASE, fill=False, edgecolor="#204a73", linewidth=1, linestyle=(0, (5, 3)),
                          zorder=3))


def draw_lines(axes, cam_centre, pad, roller, touch):
    """Lengths, axes, contact normal and tangent."""
    for end, name, shift in ((roller, "$A$", 2.0j), (cam_centre, "$D$", 2.2 + 1.2j), (pad, "$B$", -3.0j)):
        axes.plot(*xy(0, end), color="black", linewidth=1.1, zorder=4)
        share = {"$A$": 0.5, "$D$": 0.72, "$B$": 0.86}[name]
        at = TURN * end * share + shift
        axes.text(at.real, at.imag, name, ha="center", va="center", fontsize=12, zorder=6)
    valve = TURN * pad
    axes.plot([valve.real, valve.real], [-36.5, 6], color="#555555", linewidth=0.8, linestyle="-.", zorder=4)
    axes.text(valve.real + 4, -30, "valve's\naxis", ha="left", va="top", fontsize=8.5)
    axes.plot([0, 0], [0, 31], color="#555555", linewidth=0.8, linestyle="-.", zorder=4)
    axes.text(1, 31, "parallel to the\nvalve's axis", ha="left", va="top", fontsize=8.5)
    normal = (touch - roller) / abs(touch - roller)
    axes.plot(*xy(roller - 16 * normal, touch + 22 * normal), color="#b3261e", linewidth=0.9, linestyle=(0, (6, 3)), zorder=4)
    axes.plot(*xy(touch - 12j * normal, touch + 12j * normal), color="#b3261e", linewidth=0.9, linestyle=(0, (2, 2)), zorder=4)
    start, end = TURN * (touch + 12 * normal), TURN * (touch + 0.5 * normal)
    arrow(axes, start, end, "#b3261e")
    axes.text(start.real - 2.6, start.imag - 3, "$W$", color="#b3261e", fontsize=12, zorder=6)


def arrow(axes, start, end, colour, bend=0.0):
    """An arrow from one point to another."""
    axes.add_patch(FancyArrowPatch((start.real, start.imag), (end.real, end.imag), arrowstyle="-|>", mutation_scale=12, color=colour,
                                   connectionstyle=f"arc3,rad={bend}", linewidth=1.4, shrinkA=0, shrinkB=0, zorder=5))


def draw_angles(axes, cam_centre, gamma):
    """The angles gamma, lambda and chi at the pivot, the senses of rotation."""
    first = 90.0 + math.degrees(CHI)
    for low, high, size, name, at in ((first, first + math.degrees(gamma), 9.5, r"$\gamma$", 12.0),
                                      (90.0, first, 14.0, r"$\chi$", 16.5)):
        axes.add_patch(Arc((0, 0), 2 * size, 2 * size, theta1=low, theta2=high, color="black", linewidth=1, zorder=5))
        middle = math.radians(0.5 * (low + high))
        axes.text(at * math.cos(middle), at * math.sin(middle), name, ha="center", va="center", fontsize=13, zorder=6)
    arms = [first + math.degrees(gamma + LAMBDA), first + math.degrees(gamma)]
    axes.add_patch(Arc((0, 0), 36, 36, theta1=arms[0], theta2=arms[1], color="black", linewidth=2.4, zorder=5))
    middle = 18 * cmath.exp(1j * math.radians(0.5 * sum(arms)))
    axes.annotate(r"$-\lambda$", (middle.real, middle.imag), (-16, -14), fontsize=12, zorder=6,
                  arrowprops={"arrowstyle": "-", "linewidth": 0.7})
    middle = TURN * cam_centre
    turn = [middle + 12.5 * cmath.exp(1j * math.radians(degrees)) for degrees in (165, 85)]
    arrow(axes, turn[0], turn[1], "#204a73", bend=-0.4)
    axes.text(turn[1].real + 1.4, turn[1].imag, r"$\omega$, $\epsilon = 1$", color="#204a73", fontsize=12, va="center", zorder=6)


def draw_names(axes, cam_centre, pad, roller, touch):
    """Named points, radii, parts."""
    for point, name, shift in ((0, "C", 2.6 - 2.2j), (cam_centre, "O", 2.6 + 1.5j), (roller, "R", 2.2 - 2.4j), (pad, "V", -2.6 - 2.2j)):
        at = TURN * point
        axes.plot(at.real, at.imag, "o", color="black", markersize=4, zorder=6)
        axes.text(at.real + shift.real, at.imag + shift.imag, name, ha="center", va="center", fontsize=12, weight="bold", zorder=7)
    centre, middle = TURN * roller, TURN * cam_centre
    for start, length, degrees, name, shift in ((middle, BASE, 20, "$r_B$", 1.8j), (centre, ROLLER, 232, "$r_R$", 2.2 + 0.2j)):
        end = start + length * cmath.exp(1j * math.radians(degrees))
        arrow(axes, start, end, "black")
        at = 0.5 * (start + end) + shift
        axes.text(at.real, at.imag, name, ha="center", va="center", fontsize=12, zorder=7)
    spot = TURN * touch
    axes.annotate("contact", (spot.real, spot.imag), (-46, 5.5), fontsize=9, arrowprops={"arrowstyle": "-", "linewidth": 0.7}, zorder=7)
    turn = [centre + 4.6 * cmath.exp(1j * math.radians(degrees)) for degrees in (95, 195)]
    arrow(axes, turn[0], turn[1], "#222222", bend=0.45)
    axes.text(turn[1].real + 2.9, turn[1].imag + 2.0, r"$\omega_R$", fontsize=12, ha="center", va="center", zorder=7)
    for x, y, words in ((6.5, -20, "lash\nadjuster"), (-47, -25, "valve"), (-8.5, -8.6, "finger"), (-27, 44.5, "cam")):
        axes.text(x, y, words, fontsize=9, ha="left", va="center", style="italic", zorder=7)


def main():
    """Write the figure."""
    target = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).with_suffix(".svg")
    figure = Figure(figsize=(6.4, 7.2))
    axes = figure.add_axes((0, 0, 1, 1))
    draw(axes)
    axes.set(xlim=(-54, 22), ylim=(-37, 48.5), aspect="equal")
    axes.axis("off")
    figure.savefig(target, metadata={"Date": None} if target.suffix == ".svg" else None, dpi=110)


if __name__ == "__main__":
    main()
