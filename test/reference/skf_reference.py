#!/usr/bin/env python3
"""Friction of a needle bearing by SKF's model, written down as the catalogue has it: numbers for test_skf_bearing.f90.

Usage: test/reference/skf_reference.py      prints load, spin, kinematic viscosity, torques of rolling and sliding
"""

import math


def moments(load, spin, viscosity, inner_radius, needle_radius, rolling, sliding, geometry, replenishment, boundary, film):
    """Torques of rolling and sliding [N m]: load [N], spin [rad/s], kinematic viscosity [m^2/s], radii [m], SKF's constants."""
    bore, outside = 2e3 * (inner_radius - 2 * needle_radius), 2e3 * inner_radius
    mean, speed, nu = (bore + outside) / 2, abs(spin) * 30 / math.pi, viscosity * 1e6
    heat = 1 / (1 + 1.84e-9 * (speed * mean) ** 1.28 * nu**0.64)
    starvation = math.exp(-replenishment * nu * speed * (bore + outside) * math.sqrt(geometry / (2 * (outside - bore))))
    weight = math.exp(-2.6e-8 * (speed * nu) ** 1.4 * mean)
    by_rolling = heat * starvation * rolling * mean**2.41 * load**0.31 * (nu * speed) ** 0.6
    by_sliding = (weight * boundary + (1 - weight) * film) * sliding * mean * load
    return by_rolling * 1e-3, by_sliding * 1e-3


if __name__ == "__main__":
    for load, spin, viscosity in ((300, 80, 150e-6), (1500, 300, 10e-6), (60, 600, 1000e-6), (2000, 5, 8e-6)):
        parts = moments(load, spin, viscosity, 6.1e-3, 0.99e-3, 2.13e-6, 0.0015, 6.2, 3e-8, 0.12, 0.02)
        print(load, spin, viscosity, *(f"{part:.15e}" for part in parts))
