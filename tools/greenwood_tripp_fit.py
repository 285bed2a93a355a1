#!/usr/bin/env python3
"""Fit the integrals of Greenwood and Tripp (1970) for src/surface/greenwood_tripp.f90.

    F_n(H) = (2 pi)^(-1/2) int_H^inf (s - H)^n exp(-s^2/2) ds,   n = 1, 3/2, 2, 5/2

is written as exp(-H^2/2) P_n(H)/Q_n(H). The ratio is fitted on 0 <= H <= 8 in high precision so that the largest relative
error is close to the smallest possible one: weighted least squares on Chebyshev points, the weights raised where the error
is large (Lawson's iteration), the denominator of each pass weighting the next one. Needs mpmath.

Prints the coefficients as Fortran declarations and the largest relative error of each fit, evaluated in high precision.
With --table FILE also writes the exact integrals at 60 points, the table of the unit test.
"""
import argparse

import mpmath as mp

mp.mp.dps = 50
ORDERS = {"f1": mp.mpf(1), "f32": mp.mpf(3) / 2, "f2": mp.mpf(2), "f52": mp.mpf(5) / 2}
LIMIT = mp.mpf(8)


def scaled(order, height):
    """F_n(H) exp(H^2/2), a parabolic cylinder function: U(n + 1/2, H) = exp(-H^2/4)/Gamma(n + 1) times the integral."""
    return mp.gamma(order + 1) / mp.sqrt(2 * mp.pi) * mp.exp(height**2 / 4) * mp.pcfu(order + mp.mpf(1) / 2, height)


def solve_pass(points, values, weights, top, bottom):
    """Coefficients that minimise the weighted squares of P - f Q with Q(0) = 1."""
    rows = mp.matrix(len(points), top + bottom + 1)
    right = mp.matrix(len(points), 1)
    for i, (x, f, w) in enumerate(zip(points, values, weights)):
        for k in range(top + 1):
            rows[i, k] = w * x**k
        for k in range(1, bottom + 1):
            rows[i, top + k] = -w * f * x**k
        right[i] = w * f
    solution = mp.lu_solve(rows.T * rows, rows.T * right)
    return list(solution[: top + 1]), [mp.mpf(1)] + list(solution[top + 1 :])


def evaluate(coefficients, x):
    return mp.polyval(coefficients[::-1], x)


def fit(order, top, bottom, passes):
    """Numerator, denominator and the largest relative error."""
    count = 6 * (top + bottom)
    points = [LIMIT * (1 - mp.cos(mp.pi * (2 * i + 1) / (2 * count))) / 2 for i in range(count)]
    points = [mp.mpf(0)] + points + [LIMIT]
    values = [scaled(order, x) for x in points]
    lawson = [mp.mpf(1)] * len(points)
    denominator = [mp.mpf(1)] * len(points)
    best = None
    for _ in range(passes):
        weights = [mp.sqrt(a) / (f * abs(q)) for a, f, q in zip(lawson, values, denominator)]
        p, q = solve_pass(points, values, weights, top, bottom)
        denominator = [evaluate(q, x) for x in points]
        errors = [abs(evaluate(p, x) / d / f - 1) for x, d, f in zip(points, denominator, values)]
        worst = max(errors)
        if best is None or worst < best[2]:
            best = (p, q, worst)
        lawson = [a * (e / worst) + mp.mpf(10) ** -30 for a, e in zip(lawson, errors)]
        mean = sum(lawson) / len(lawson)
        lawson = [a / mean for a in lawson]
    return best


def declaration(name, meaning, coefficients):
    """Fortran text as it stands in the source, four numbers a line."""
    numbers = [mp.nstr(c, 20, min_fixed=1, max_fixed=0) + "_wp" for c in coefficients]
    rows = [", ".join(numbers[i : i + 4]) for i in range(0, len(numbers), 4)]
    head = f"   !> {meaning} exp(H^2/2), powers of H increasing [-]\n"
    return head + f"   real(wp), parameter :: {name}(0:{len(numbers) - 1}) = [ &\n      " + ", &\n      ".join(rows) + "]"


def write_table(path):
    with open(path, "w", encoding="ascii") as table:
        table.write("# F_n(H) = (2 pi)^(-1/2) int_H^inf (s - H)^n exp(-s^2/2) ds, exact to the digits given.\n")
        table.write("# Integrals of Greenwood and Tripp (1970), Proc. Instn Mech. Engrs 185, 625-633; computed as parabolic\n")
        table.write("# cylinder functions with 50 digits by tools/greenwood_tripp_fit.py.\n")
        table.write("H,F1,F32,F2,F52\n")
        for i in range(60):
            height = mp.mpf(repr(round(8 * i / 59, 3)))
            row = [scaled(n, height) * mp.exp(-(height**2) / 2) for n in ORDERS.values()]
            table.write(",".join([mp.nstr(height, 6)] + [mp.nstr(v, 17, min_fixed=1, max_fixed=0) for v in row]) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--top", type=int, default=7, help="degree of the numerator")
    parser.add_argument("--bottom", type=int, default=8, help="degree of the denominator")
    parser.add_argument("--passes", type=int, default=40, help="passes of the fit")
    parser.add_argument("--table", help="write the exact integrals to this file")
    arguments = parser.parse_args()
    for name, order in ORDERS.items():
        p, q, worst = fit(order, arguments.top, arguments.bottom, arguments.passes)
        print(f"   ! {name}: largest relative error {mp.nstr(worst, 2)}")
        title = f"F_{int(order)}" if order == int(order) else f"F_{int(2 * order)}/2"
        print(declaration(f"{name}_top", f"Numerator of {title}", p))
        print(declaration(f"{name}_bottom", f"Denominator of {title}", q))
    if arguments.table:
        write_table(arguments.table)


if __name__ == "__main__":
    main()
