"""Laws of the lubricated cam/roller contact, each written out plainly in double precision.

Line contact of full length L, reduced modulus 2/E' = (1-nu1^2)/E1 + (1-nu2^2)/E2.  SI units.
Equation numbers are those of Islam (2019), *Tribological study of friction in roller follower valve train considering
effects of asperity interaction and roller sliding*.
"""
import math

import numpy as np
from scipy.special import pbdv

ROUGHNESS_PRODUCT = 0.04      # eta beta sigma, Greenwood and Tripp
ROUGHNESS_OVER_TIP = 0.01     # sigma/beta
NODES, WEIGHTS = np.polynomial.legendre.leggauss(40)
TRAPEZOID = 0.04              # step of the sum in height_integral_52
V2 = (TRAPEZOID * np.arange(-80, 81))**2
V6 = V2**3


def reduced_modulus(E1, nu1, E2, nu2):
    """E' of Islam (28)."""
    return 2 / ((1 - nu1**2) / E1 + (1 - nu2**2) / E2)


def hertz(W, R, L, E):
    """Half width b and peak pressure of a Hertz line contact, Islam (23), (24) with L the full length."""
    b = math.sqrt(8 * W * R / (math.pi * L * E))
    return b, 2 * W / (math.pi * b * L)


def cameron(eta0, alpha, pressure):
    """Viscosity at pressure, Cameron's power law, in the thesis after Chu and Cameron (1962)."""
    return eta0 * (1 + alpha * pressure / 16)**16


def film(eta0, V_e, alpha, E, R, load, L):
    """Minimum film of Dowson and Higginson (29) and central film of Dowson and Toyoda (30)."""
    U, G, W = eta0 * V_e / (E * R), alpha * E, load / (E * R * L)
    return R * 2.65 * U**0.70 * G**0.54 * W**-0.13, R * 3.06 * U**0.69 * G**0.56 * W**-0.10


def height_integral_2(H):
    """F_2 of Islam (36) by the parabolic cylinder function: 2 exp(-H^2/4) D_-3(H)/sqrt(2 pi).

    The same by parts, (1 + H^2) erfc(H/sqrt 2)/2 - H exp(-H^2/2)/sqrt(2 pi), cancels at large H; a test compares both.
    """
    return 2 * math.exp(-0.25 * H * H) * pbdv(-3, H)[0] / math.sqrt(2 * math.pi)


def height_integral_52(H):
    """F_5/2 of Islam (36): with s = H + v^2 the integrand is even and entire, made for the trapezoidal rule."""
    total = TRAPEZOID * float(np.sum(V6 * np.exp(-V2 * (H + 0.5 * V2))))
    return math.exp(-0.5 * H * H) * total / math.sqrt(2 * math.pi)


def asperities(film_ratio, area, E):
    """Load and real area of touching asperities, Greenwood and Tripp (1970), Islam (34), (35) made consistent."""
    if film_ratio > 30:
        return 0.0, 0.0
    square = ROUGHNESS_PRODUCT**2
    load = 8 * math.sqrt(2) / 15 * math.pi * square * math.sqrt(ROUGHNESS_OVER_TIP) * E * area
    return load * height_integral_52(film_ratio), math.pi**2 * square * area * height_integral_2(film_ratio)


def newtonian_shear(V_s, h_c, b, L, eta0, alpha, peak):
    """Shear force of the film over the Hertz zone, Islam (33): x = b sin(phi), p = peak cos(phi), Gauss-Legendre."""
    phi = 0.5 * math.pi * NODES
    viscosity = cameron(eta0, alpha, peak * np.cos(phi))
    return V_s * L / h_c * b * 0.5 * math.pi * float(np.sum(WEIGHTS * viscosity * np.cos(phi)))


def rolling_goksem(eta0, V_e, alpha, E, R, W, L):
    """Rolling resistance of each surface, Goksem and Hargreaves (1978), Islam (39) with L the full length."""
    return 4.318 * (alpha * eta0 * V_e / R)**0.658 * (W / (E * R * L))**0.0126 * L * R / alpha


def rolling_biboulet(eta0, V_e, E, R, load, L):
    """Rolling resistance of each surface, Biboulet and Houpert (2010), doi 10.1243/13506501JET790.

    Joins the rigid limit 1.4 sqrt(2U W) and the elastic limit 1.45 (2U)^(3/4), both times E' R L.
    """
    speed, w = 2 * eta0 * V_e / (E * R), load / (E * R * L)
    M = w / math.sqrt(speed)
    moment = M**-1.5 * 1.4 * math.sqrt(M) / (1 + (1.4 / 1.45 * math.sqrt(M))**10)**0.1
    return E * R * L * w**1.5 * moment
