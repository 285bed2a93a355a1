"""Heat in a line contact: mean rise under a moving band, film that a warm inlet leaves, temperature of a sheared film.

Everything is integrated numerically as it stands in the literature and solved by bisection; nothing is shared with the
solver. SI units.
"""
import math

from scipy.integrate import quad
from scipy.optimize import brentq
from scipy.special import k0e

PECLETS = (1e-4, 2e-3, 4e-3, 0.05, 0.5, 1.9, 2.1, 8.0, 60.0, 2000.0)
REFERENCE_PRESSURE, REFERENCE_EXPONENT = 1 / 5.1e-9, 9.67     # Roelands
STEEL = (46.0, 46.0 / (7850.0 * 460.0))                       # conductivity, diffusivity
CERAMIC = (25.0, 25.0 / (3200.0 * 700.0))


def band_mean(peclet):
    """Mean rise over q b/k under a band of half width b, speed V, with peclet = V b/kappa.

    A line source that moves over a half space makes q/(pi k) exp(-u) K_0(|u|) at the distance u = V x/(2 kappa) ahead
    (Carslaw and Jaeger 1959, 10.3); pairs of places in the band at the distance u weigh peclet - |u|.
    """
    def pairs(u):
        return (peclet - u) * (1 + math.exp(-2 * u)) * k0e(u)
    ends = [0, *(peclet * part for part in (1e-6, 1e-3, 0.1) if part), peclet]
    if peclet > 50:
        ends = [0, 1e-5, 1e-2, 1, 20, peclet]
    total = sum(quad(pairs, low, high, epsabs=0, epsrel=1e-13, limit=500)[0] for low, high in zip(ends, ends[1:]))
    return 2 * total / (math.pi * peclet**2)


def line_by_time(u):
    """exp(-u) K_0(|u|) as the sum of what the line gave off before: 1/2 int exp(-(2 u + s)^2/(4 s)) ds/s."""
    def rate(z):
        return math.exp(-(2 * u + math.exp(z))**2 / (4 * math.exp(z)))
    return 0.5 * quad(rate, -30, 12, epsabs=0, epsrel=1e-12, limit=500)[0]


def inlet(law, L, pressure, slip):
    """Factor on the film: Murch and Wilson (1975); Gupta and others (1992)."""
    if law == 'murch_wilson':
        return 3.94 / (3.94 + L**0.62)
    return (1 - 13.2 * pressure * L**0.42) / (1 + 0.213 * (1 + 2.23 * slip**0.83) * L**0.64)


def viscosity(law, eta0, alpha, index, pressure):
    """Barus; Cameron; Roelands with a given index."""
    if law == 'barus':
        return eta0 * math.exp(alpha * pressure)
    if law == 'cameron':
        return eta0 * (1 + alpha * pressure / 16)**16
    exponent = math.log(eta0) + REFERENCE_EXPONENT
    return eta0 * math.exp(exponent * ((1 + pressure / REFERENCE_PRESSURE)**index - 1))


def film_temperature(law, eyring, V_s):
    """Rise of a film between steel and ceramic, and its shear over the area, with a limit of 0.08 of the mean pressure.

    eta0 = 0.03 Pa s falling by Vogel's law with the pole 150 K below; p0 = 0.6 GPa; b = 60 um; h = 0.2 um; speeds 3 m/s -+ V_s/2.
    """
    eta0, fall, pole, alpha, index = 0.03, 0.045, 150.0, 2.0e-8, 0.65
    p0, b, h, k_oil, pressure_fall = 0.6e9, 60e-6, 0.2e-6, 0.14, 0.002
    limit = 0.08 * math.pi / 4 * p0
    surfaces = 0.0
    for (conductivity, diffusivity), speed in ((STEEL, 3 + V_s / 2), (CERAMIC, 3 - V_s / 2)):
        surfaces += conductivity / (b * band_mean(speed * b / diffusivity))

    def shear(rise):
        eta = eta0 * math.exp(-fall * rise / (1 + rise / pole))
        warm = alpha * math.exp(-pressure_fall * rise) if law != 'roelands' else alpha

        def stress(phi):
            newton = viscosity(law, eta, warm, index, p0 * math.cos(phi)) * V_s / h
            return math.cos(phi) * (eyring * math.asinh(newton / eyring) if eyring else newton)
        free = quad(stress, 0, math.pi / 2, epsabs=0, epsrel=1e-13, limit=200)[0]
        return limit * math.tanh(free / limit)
    gain = V_s * (1 / surfaces + h / (12 * k_oil))
    rise = brentq(lambda x: x - gain * shear(x), 0, gain * shear(0), xtol=1e-13, rtol=1e-14)
    return rise, shear(rise)


def write(path):
    with open(path, 'w', encoding='ascii') as file:
        file.write('# Heat in a line contact (test/reference/heat_reference.py); the script says which inputs. Rows: band,\n'
                   '# V b/kappa and mean rise over q b/k; law of the inlet, L, p_H/E\', S and factor; law of the viscosity,\n'
                   '# Eyring stress or 0, V_s, rise and mean shear stress, SI units.\n'
                   'row,first,second,third,fourth\n')
        for peclet in PECLETS:
            file.write(f'band,{peclet:.12g},{band_mean(peclet):.12e},0,0\n')
        for law in ('murch_wilson', 'gupta'):
            for L, pressure, slip in ((0.1, 0.003, 0), (1, 0.003, 0), (0.02, 0.001, 0.3), (5, 0.004, -1.5)):
                file.write(f'{law},{L},{pressure},{slip},{inlet(law, L, pressure, abs(slip)):.12e}\n')
        for law in ('barus', 'cameron', 'roelands'):
            for eyring in (0, 5e6):
                for V_s in (1e-3, 0.05, 2.0):
                    rise, stress = film_temperature(law, eyring, V_s)
                    file.write(f'{law}{"_eyring" if eyring else ""},{eyring:g},{V_s},{rise:.12e},{stress:.12e}\n')
