"""A journal bearing whose asperities share the load: eccentricity, smallest film, parts of load and torque.

Film pressures and asperity pressures are integrated numerically over the bearing as they stand in the literature, the
eccentricity is found by bisection on `1 - e`; nothing is shared with the solver. SI units.
"""
import functools
import math

from scipy.integrate import quad
from scipy.optimize import brentq

DIAMETER, WIDTH, CLEARANCE, VISCOSITY, SPEED = 26e-3, 18e-3, 0.05e-3, 0.01, 30.0
ROUGHNESS, MODULUS, COEFFICIENT, PRODUCT, RATIO = 0.5e-6, 110e9, 0.1, 0.04, 0.01
LOADS = {'long_full_sommerfeld': (300.0, 700.0, 1500.0), 'short_ocvirk': (800.0, 4000.0, 20000.0)}


def integral(function, low, high, points=None):
    return quad(function, low, high, epsabs=0, epsrel=1e-12, limit=500, points=points)[0]


@functools.lru_cache(maxsize=None)
def summits(H):
    """F_5/2 of Greenwood and Tripp by its definition; nothing beyond 8, as their law is used."""
    if H > 8:
        return 0.0
    return integral(lambda s: (s - H)**2.5 * math.exp(-s * s / 2), H, H + 12) / math.sqrt(2 * math.pi)


def film_force(law, e):
    """Parts of the film's force along and across the line of centres, over eta omega."""
    r = DIAMETER / 2
    if law == 'short_ocvirk':
        # p = 3 eta omega/c^2 (L^2/4 - z^2) e sin(phi)/(1 + e cos(phi))^3 over the converging half; mean over the width L^2/6
        scale = 3 / CLEARANCE**2 * WIDTH**3 / 6 * r

        def pressure(phi):
            return e * math.sin(phi) / (1 + e * math.cos(phi))**3
        near = [math.pi - 5 * math.sqrt(1 - e)]
        along = -integral(lambda phi: pressure(phi) * math.cos(phi), 0, math.pi, near)
        across = integral(lambda phi: pressure(phi) * math.sin(phi), 0, math.pi, near)
        return scale * along, scale * across
    # p = 6 eta omega (r/c)^2 e (2 + e cos) sin/((2 + e^2)(1 + e cos)^2) all round; the part along the line vanishes
    scale = 6 * (r / CLEARANCE)**2 * WIDTH * r

    def across_part(phi):
        return e * (2 + e * math.cos(phi)) * math.sin(phi)**2 / ((2 + e * e) * (1 + e * math.cos(phi))**2)
    return 0.0, 2 * scale * integral(across_part, 0, math.pi, [math.pi - 5 * math.sqrt(1 - e)])


def film_torque(law, e):
    """Torque on the journal over eta omega."""
    petroff = 2 * math.pi * (DIAMETER / 2)**3 * WIDTH / CLEARANCE
    if law == 'short_ocvirk':
        # shear on the journal, eta U/h + h/2 dp/dx: the second part is h/2 times the slope of the pressure times the width
        def beside(phi):
            h = 1 + e * math.cos(phi)
            return e * h / 2 * (math.cos(phi) / h**3 + 3 * e * math.sin(phi)**2 / h**4)
        near = [math.pi - 5 * math.sqrt(1 - e)]
        return petroff / math.sqrt(1 - e * e) + DIAMETER / 2 * WIDTH**3 / (2 * CLEARANCE) * integral(beside, 0, math.pi, near)
    return petroff * 2 * (1 + 2 * e * e) / ((2 + e * e) * math.sqrt(1 - e * e))


def asperity_force(gap):
    """Force of the asperities along the line of centres and sum of their normal forces, at 1 - e = gap."""
    scale = 8 * math.sqrt(2) / 15 * math.pi * PRODUCT**2 * math.sqrt(RATIO) * MODULUS * WIDTH * DIAMETER / 2
    reach = 8 * ROUGHNESS / CLEARANCE - gap
    if reach <= 0:
        return 0.0, 0.0
    last = 2 * math.asin(math.sqrt(min(reach / (2 * (1 - gap)), 1)))

    def pressure(psi):
        return summits(CLEARANCE / ROUGHNESS * (gap + 2 * (1 - gap) * math.sin(psi / 2)**2))
    return (2 * scale * integral(lambda psi: pressure(psi) * math.cos(psi), 0, last), 2 * scale * integral(pressure, 0, last))


def bearing(law, load):
    """Eccentricity, smallest film [m], load of asperities [N], torque, boundary torque [N m]."""
    def carried(log_gap):
        gap = math.exp(log_gap)
        along, across = (VISCOSITY * SPEED * force for force in film_force(law, 1 - gap))
        return math.hypot(along + asperity_force(gap)[0], across) / load - 1
    gap = math.exp(brentq(carried, math.log(1e-5), math.log(0.5), xtol=1e-13, rtol=1e-14))
    pressed, normal = asperity_force(gap)
    boundary = COEFFICIENT * normal * DIAMETER / 2
    torque = VISCOSITY * SPEED * film_torque(law, 1 - gap) + boundary
    return 1 - gap, gap * CLEARANCE, pressed, torque, boundary


def write(path):
    with open(path, 'w', encoding='ascii') as file:
        file.write('# A journal bearing with asperities (test/reference/bearing_reference.py), SI units: law, load,\n'
                   '# eccentricity, smallest film, load of asperities along the line of centres, torque, boundary torque.\n'
                   f'# Diameter {DIAMETER}, width {WIDTH}, clearance {CLEARANCE}, viscosity {VISCOSITY}, {SPEED} rad/s; roughness\n'
                   f"# {ROUGHNESS}, E' {MODULUS:g}, coefficient {COEFFICIENT}, product {PRODUCT}, ratio {RATIO}.\n"
                   'law,load,eccentricity,film,asperity_load,torque,boundary_torque\n')
        for law, loads in LOADS.items():
            for load in loads:
                file.write(','.join([law, f'{load:g}'] + [f'{value:.12e}' for value in bearing(law, load)]) + '\n')
