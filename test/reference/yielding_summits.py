"""Load and area of summits that yield, after Zhao, Maietta and Chang (2000), J. Tribol. 122, 86-93, by plain quadrature.

``python test/reference/yielding_summits.py`` writes ``test/data/zhao_maietta_chang.csv`` again (some seconds). Everything in units:
n [1/m2] density, beta [m] tip radius, sigma [m] roughness, E [Pa] modulus of both bodies in series, H [Pa] hardness, so that
nothing of the program's own scaling is in it. The summits' mean height and scatter follow from the spectral moments of the surface
(McCool 1986, Wear 107, 37-60): alpha = m0 m4/m2^2, height 4 sqrt(m0/(pi alpha)), scatter sqrt((1 - 0.8968/alpha) m0), density
m4/(6 sqrt(3) pi m2), tip radius (3/8) sqrt(pi/m4).
"""
import pathlib

import mpmath as mp

mp.mp.dps = 30
DATA = pathlib.Path(__file__).resolve().parent.parent / 'data'
YIELD = mp.mpf('0.4')           # mean pressure over hardness at first yield
RANGE = 54                      # flattening at complete yield over that at first yield
SIGMA = mp.mpf('0.5e-6')
MODULUS = mp.mpf('114e9')       # E' is twice that
CASES = ((0.025, 0.01, 0.01), (0.05, 0.01, 0.005), (0.05, 0.01, 0.01), (0.05, 0.01, 0.03), (0.04, 0.001, 0.02), (0.15, 0.02, 0.001))
RATIOS = (0, 0.25, 0.7, 1, 1.6, 2.5, 4, 6, 7.8)
HEADER = """\
# Summits of one rough surface against a plane that yield (Zhao, Maietta and Chang, 2000, J. Tribol. 122, 86-93): mean pressure over
# E' and part of the surface that touches, by quadrature with 30 digits in test/reference/yielding_summits.py.
product,slenderness,hardness,film_ratio,pressure,area
"""


def surface(product, slenderness):
    """Density, tip radius, mean height and scatter of the summits of a surface with n beta sigma and sigma/beta as given."""
    root_alpha = mp.mpf(product) / (mp.mpf(3) / 8 * mp.sqrt(mp.pi) / (6 * mp.sqrt(3) * mp.pi))
    alpha = root_alpha**2
    radius = SIGMA / mp.mpf(slenderness)
    density = mp.mpf(product) / (radius * SIGMA)
    return density, radius, 4 * SIGMA / mp.sqrt(mp.pi * alpha), SIGMA * mp.sqrt(1 - mp.mpf('0.8968') / alpha)


def summit(flattening, radius, hardness):
    """Force and area of one summit."""
    first = (3 * mp.pi * YIELD * hardness / (4 * MODULUS))**2 * radius
    last = RANGE * first
    if flattening <= first:
        return mp.mpf(4) / 3 * MODULUS * mp.sqrt(radius) * flattening**1.5, mp.pi * radius * flattening
    if flattening >= last:
        return 2 * mp.pi * radius * flattening * hardness, 2 * mp.pi * radius * flattening
    part = (flattening - first) / (last - first)
    area = mp.pi * radius * flattening * (1 - 2 * part**3 + 3 * part**2)
    return area * hardness * (1 - (1 - YIELD) * mp.log(last / flattening) / mp.log(last / first)), area


def row(product, slenderness, relative_hardness, ratio):
    density, radius, height, scatter = surface(product, slenderness)
    hardness = mp.mpf(relative_hardness) * 2 * MODULUS
    first = (3 * mp.pi * YIELD * hardness / (4 * MODULUS))**2 * radius
    gap = mp.mpf(ratio) * SIGMA - height
    top = max(-gap, 0) + 12 * scatter
    ends = sorted({mp.mpf(0), top} | {x for x in (first, RANGE * first) if x < top}
                  | {max(-gap, 0) + k * scatter for k in range(-11, 12) if max(-gap, 0) + k * scatter > 0})
    sums = []
    for which in (0, 1):
        def part(w, which=which):
            return (summit(w, radius, hardness)[which] * mp.exp(-((gap + w) / scatter)**2 / 2)
                    / (mp.sqrt(2 * mp.pi) * scatter))
        sums.append(density * mp.quad(part, ends))
    return sums[0] / (2 * MODULUS), sums[1]


def write(path):
    with open(path, 'w', encoding='ascii') as file:
        file.write(HEADER)
        for case in CASES:
            for ratio in RATIOS:
                values = row(*case, ratio)
                file.write(','.join([*(f'{c:g}' for c in case), f'{ratio:g}', *(mp.nstr(v, 14) for v in values)]) + '\n')


if __name__ == '__main__':
    write(DATA / 'zhao_maietta_chang.csv')
