"""Closed-form kinematics of an end-pivoted roller finger follower.

The formulas are those of Dyson (1980, Tribology International 13, 121-132) as used in Islam's thesis (2019,
*Tribological study of friction in roller follower valve train considering effects of asperity interaction and roller
sliding*), equations (1)-(11), derived again here, with the exact arms and the exact pure-rolling speed added.

Names: O cam centre, C finger pivot, R roller centre, V centre of the valve pad. A = CR, B = CV, D = CO. ``gamma``
is the angle from CO to CV, ``s = gamma + lam`` the angle from CO to CR. Coordinates: C is the origin, O lies at
(D, 0), the finger opens the valve counter-clockwise. ``sense = +1``: the cam turns clockwise, so that its surface moves
away from the pivot at the contact; ``sense = -1``: the opposite. A dash is d/dtheta, theta the angle the cam has
turned (time angle).

Tangential speeds and the roller's spin are positive in the direction of normal rolling; speeds are per unit cam speed
(metres per radian). SI units, radians. Every function takes the module that supplies sin, cos, acos and sqrt
(``math`` or ``mpmath``), so the same lines run in double and in high precision.
"""
import math
from dataclasses import dataclass, replace
from types import SimpleNamespace


@dataclass(frozen=True)
class PolynomialLift:
    """Lift ``height (1 - x^2)^power (1 + skew x)``, x = theta/half_angle, zero outside |x| < 1."""
    height: object
    half_angle: object
    power: int = 4
    skew: object = 0

    def derivatives(self, theta):
        """Lift and its first three derivatives with respect to the cam angle [m]."""
        x = theta / self.half_angle
        if abs(x) >= 1:
            return (0 * x,) * 4
        n, k, q = self.power, self.skew, 1 - x * x
        f = q**n
        f1 = -2 * n * x * q**(n - 1)
        f2 = -2 * n * q**(n - 1) + 4 * n * (n - 1) * x**2 * q**(n - 2)
        f3 = 12 * n * (n - 1) * x * q**(n - 2) - 8 * n * (n - 1) * (n - 2) * x**3 * q**(n - 3)
        v = 1 + k * x
        values = (f * v, k * f + v * f1, 2 * k * f1 + v * f2, 3 * k * f2 + v * f3)
        return tuple(self.height * value / self.half_angle**i for i, value in enumerate(values))

    def __call__(self, theta):
        return self.derivatives(theta)[0]


@dataclass(frozen=True)
class Geometry:
    """Lengths [m] and fixed angles [rad] of the mechanism, its lift law and its sense of rotation."""
    A: object
    B: object
    D: object
    lam: object
    chi: object
    r_B: object
    r_R: object
    lift: PolynomialLift
    sense: int = 1

    def reversed(self):
        return replace(self, sense=-self.sense)


def thesis_geometry(number=float, sense=1, degree=math.pi / 180):
    """Geometry of Islam's Appendix B; the lift is assumed, since the thesis shows it as a picture only."""
    mm = number(1) / 1000
    return Geometry(A=number('20.8') * mm, B=number('35.5') * mm, D=number('31.5') * mm, lam=number('-3.5') * degree,
                    chi=number('37.5') * degree, r_B=18 * mm, r_R=number('8.5') * mm,
                    lift=PolynomialLift(number('9.5') * mm, 70 * degree), sense=sense)


def skewed_geometry(number=float, sense=1, degree=math.pi / 180):
    """A made-up geometry with hollow flanks and an asymmetric lift, in which the sense of rotation cannot hide."""
    mm = number(1) / 1000
    return Geometry(A=24 * mm, B=42 * mm, D=37 * mm, lam=5 * degree, chi=30 * degree, r_B=17 * mm, r_R=9 * mm,
                    lift=PolynomialLift(9 * mm, 55 * degree, power=3, skew=number('0.1')), sense=sense)


def base_angle(geometry, fn=math):
    """gamma on the base circle, Islam (8): the triangle COR with side r_B + r_R opposite to C."""
    A, D = geometry.A, geometry.D
    return fn.acos((A * A + D * D - (geometry.r_B + geometry.r_R)**2) / (2 * A * D)) - geometry.lam


def closed_form(geometry, theta, fn=math):
    """All kinematic quantities at one cam angle.

    g   = 1 + sense gamma'                                          turning rate of the finger seen from the cam
    M   speed of R over the cam, Islam (3); L2 as (2) with the cosine that is missing there
    pitch_curvature = L2/M^3, cam_curvature = 1/R_c (1), R = r_R - r_R^2 L2/M^3 (10), V_c = M - r_R L2/M^2 (11)
    V_roll = M - r_R        peripheral speed r_R omega_R of the roller in pure rolling, omega_R its absolute spin
    h_W, h_t                arms of the contact's normal and of the tangent through R about the pivot C
    h_F                     arm of the contact's tangent about the cam centre O
    """
    A, B, D, r_R, sense = geometry.A, geometry.B, geometry.D, geometry.r_R, geometry.sense
    k = SimpleNamespace(theta=theta)
    k.l, k.l1, k.l2, l3 = geometry.lift.derivatives(theta)
    gamma_B = base_angle(geometry, fn)
    psi = fn.acos(fn.cos(gamma_B + geometry.chi) - k.l / B)
    sin_psi, cos_psi = fn.sin(psi), fn.cos(psi)
    k.gamma = psi - geometry.chi
    k.gamma1 = k.l1 / (B * sin_psi)
    k.gamma2 = (k.l2 / B - cos_psi * k.gamma1**2) / sin_psi
    gamma3 = (l3 / B + sin_psi * k.gamma1**3 - 3 * cos_psi * k.gamma1 * k.gamma2) / sin_psi
    k.B_s = B * sin_psi

    s = k.gamma + geometry.lam
    sin_s, cos_s = fn.sin(s), fn.cos(s)
    g, g1, g2 = 1 + sense * k.gamma1, sense * k.gamma2, sense * gamma3
    M = fn.sqrt(A**2 * g**2 - 2 * A * D * g * cos_s + D**2)
    L2 = A**2 * g**3 - A * D * k.gamma2 * sin_s + D**2 - A * D * g * (1 + g) * cos_s
    M1 = (A**2 * g * g1 - A * D * (g1 * cos_s - g * k.gamma1 * sin_s)) / M
    L21 = (3 * A**2 * g**2 * g1 - A * D * (gamma3 * sin_s + k.gamma2 * k.gamma1 * cos_s)
           - A * D * (g1 * (1 + 2 * g) * cos_s - g * (1 + g) * k.gamma1 * sin_s))
    k.M, k.L2 = M, L2
    k.pitch_curvature = L2 / M**3
    k.cam_curvature = k.pitch_curvature / (1 - r_R * k.pitch_curvature)
    k.R = r_R - r_R**2 * k.pitch_curvature
    k.V_c = M - r_R * L2 / M**2
    k.V_c1 = M1 - r_R * (L21 / M**2 - 2 * L2 * M1 / M**3)
    k.V_roll = M - r_R
    k.V_roll1 = M1
    k.h_W = A * D * sin_s / M
    k.h_W_parallel = A * fn.sin(psi + geometry.lam)
    k.h_t = A * (D * cos_s - A * g) / M
    k.h_F = (D**2 + A**2 * g - A * D * (1 + g) * cos_s) / M - r_R
    return k
