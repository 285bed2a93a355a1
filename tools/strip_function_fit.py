#!/usr/bin/env python3
"""Find the polynomials of `strip_function` in src/axial/strip.f90, and the error of those that stand there.

Usage: strip_function_fit.py [SOURCE]

F(t) = 4/pi int_0^1 sqrt(1 - x^2) asinh(t/x) dx is integrated with 25 digits. Above t = 1, F - ln(4 sqrt(e) t) is a polynomial of 1/t^2;
below, F/t is p + q ln(1/t) with polynomials p and q of t^2: least squares at Chebyshev's places of these. Prints their coefficients,
their largest error and that of SOURCE, and the values that the test of the function expects.
"""

from __future__ import annotations

import pathlib
import re
import sys

import mpmath as mp

mp.mp.dps = 40
NEAR, FAR = 10, 11
PLACES = 80
# Of the test "the function of a strip is the mean over its semi-ellipse, and its slope"
TESTED = ("0.02", "0.2", "0.7", "0.999", "1.001", "1.5", "4", "30")


def function(t):
    """F(t), x being the sine of an angle."""
    return 4 / mp.pi * mp.quad(lambda a: mp.cos(a) ** 2 * mp.asinh(t / mp.sin(a)), [0, mp.atan(t), mp.pi / 2])


def squares():
    """Chebyshev's places between 0 and 1."""
    return [(1 + mp.cos(mp.pi * (2 * i + 1) / (2 * PLACES))) / 2 for i in range(PLACES)]


def fit():
    """Coefficients by the names in the source."""
    places = squares()
    rows = [[z**j for j in range(NEAR)] + [-mp.log(mp.sqrt(z)) * z**j for j in range(NEAR)] for z in places]
    near = mp.lu_solve(mp.matrix(rows), mp.matrix([function(mp.sqrt(z)) / mp.sqrt(z) for z in places]))
    rows = [[z ** (j + 1) for j in range(FAR)] for z in places]
    far = mp.lu_solve(mp.matrix(rows), mp.matrix([function(1 / mp.sqrt(z)) - far_part(1 / mp.sqrt(z)) for z in places]))
    return {"far_powers": list(far), "near_powers": list(near[:NEAR]), "near_logs": list(near[NEAR:])}


def far_part(t):
    """What F tends to far away."""
    return mp.log(4 * t) + mp.mpf(1) / 2


def read(source):
    """Coefficients in the source."""
    text = pathlib.Path(source).read_text(encoding="utf-8")
    found = {}
    for name in ("far_powers", "near_powers", "near_logs"):
        block = re.search(rf"{name}\(\*\) = \[(.*?)\]", text, re.DOTALL).group(1)
        found[name] = [mp.mpf(number) for number in re.findall(r"(-?[\d.]+e[+-]\d+)_wp", block)]
    return found


def largest_error(coefficients):
    """Largest relative error between 1e-3 and 1e3."""
    worst = mp.mpf(0)
    for i in range(121):
        t = mp.mpf(10) ** (mp.mpf(i - 60) / 20)
        if t > 1:
            value = far_part(t) + sum(c * t ** (-2 * j - 2) for j, c in enumerate(coefficients["far_powers"]))
        else:
            p, q = (sum(c * t ** (2 * j) for j, c in enumerate(coefficients[name])) for name in ("near_powers", "near_logs"))
            value = t * (p - q * mp.log(t))
        worst = max(worst, abs(value / function(t) - 1))
    return mp.nstr(worst, 2)


def main():
    source = sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent / "src" / "axial" / "strip.f90"
    fitted = fit()
    for name, coefficients in fitted.items():
        print(name, *(mp.nstr(c, 16, min_fixed=1, max_fixed=0) for c in coefficients))
    print("largest error of these:", largest_error(fitted))
    print("largest error of the source:", largest_error(read(source)))
    print("expected by the test:", *(mp.nstr(function(mp.mpf(t)), 16) for t in TESTED))


if __name__ == "__main__":
    main()
