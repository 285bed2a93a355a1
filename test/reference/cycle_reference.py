"""One cycle of a roller finger follower at one operating point: slow, plain, independent of the solver it checks.

Equation numbers are those of Islam (2019), *Tribological study of friction in roller follower valve train considering
effects of asperity interaction and roller sliding*; kinematics in ``mechanism.py``, laws in ``contact_laws.py``.

Consistent mode (energy closes): pure rolling V_roll = omega (M - r_R), exact arm of the load, boundary friction as
far as slip mobilises it, rolling resistance after Biboulet and Houpert from the film's load W - W_a. With the tangential force T' = F_t + F_r
(2 R/r_R - 1) on the roller (the pressure that balances the rolling shear -F_r of each surface acts through both centres
of curvature):

    finger    W h_W + sense (T' h_t + T_B) = M_spring - M_seat + M_valve + M_finger + F_g B_s
    roller    I_R domega_R/dt = (F_t - F_r) r_R - T_B
    cam       T_drive = W h_W gamma' + T' h_F + 2 F_r R

Source mode (the thesis's bookkeeping): pure rolling V_roll = V_c (13), arm with the normal parallel to the valve
(16), load without friction, all of the boundary friction in the contact's torque F h_F (40), rolling resistance after
Goksem and Hargreaves (39) from the whole load, needle torque T_B omega_R/omega on top. In both modes the roller's own balance holds the
mobilised boundary friction and the rolling resistance.

Cap of the film's traction: lim tanh(F/lim), lim = 0.08 W. Needle: T_B = mu_p W r_p tanh(spin/(0.01 omega)), spin
relative to the finger. Mobilised boundary friction: F_b tanh(V_s/v_b). Seat: S0 (1 - l/l_s)^2 for l < l_s,
l_s = 2 S0/K_s, S0 what is left of the spring's preload beside the adjuster's force at the valve.
"""
import math
from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import contact_laws as laws
from mechanism import Geometry, closed_form, thesis_geometry

DEGREE = math.pi / 180


@dataclass(frozen=True)
class Train:
    """Everything but the operating point; defaults are Islam's Appendix B, with two entries corrected by a factor
    of ten (spring stiffness, guide clearance) and two assumed (lift, seat stiffness).
    """
    geometry: Geometry = thesis_geometry()
    width: float = 0.0137
    E: float = laws.reduced_modulus(170e9, 0.28, 204e9, 0.29)
    roughness: float = 0.14e-6 * math.sqrt(2)
    alpha: float = 2.2e-8
    stiffness: float = 25000.0
    precompression: float = 0.0084
    base_load: float = 64.0
    seat_stiffness: float = 1e7
    valve_mass: float = 0.0432
    finger_mass: float = 0.0418
    roller_mass: float = 0.0088
    roller_wall: float = 0.0024
    needle_radius: float = 0.00099
    needle_friction: float = 0.0015
    boundary_friction: float = 0.2
    film_shear_strength: float = 0.0
    mobilising_speed: float = 1e-3
    traction_limit: float = 0.08
    guide_length: float = 0.036
    stem_diameter: float = 0.005
    guide_clearance: float = 0.02e-3


class Point:
    """A train at one speed and viscosity; ``state(theta, V_s)`` gives every force and torque."""

    def __init__(self, rpm, eta0, train=Train(), mode='consistent'):
        self.rpm, self.eta0, self.train, self.mode = rpm, eta0, train, mode
        self.omega = rpm * math.pi / 30
        t, geometry = train, train.geometry
        self.r_R = geometry.r_R
        inner = geometry.r_R - t.roller_wall
        self.I_R = 0.5 * t.roller_mass * (geometry.r_R**2 + inner**2)
        self.I_f = t.finger_mass * geometry.B**2
        self.r_p = inner - t.needle_radius
        self.guide = eta0 * math.pi * t.stem_diameter * t.guide_length / t.guide_clearance
        closed = closed_form(geometry, math.pi)
        self.S0 = t.stiffness * t.precompression - t.base_load * self.arm(closed) / closed.B_s
        self.seat_lift = 2 * self.S0 / t.seat_stiffness

    @property
    def consistent(self):
        return self.mode == 'consistent'

    def arm(self, k):
        return k.h_W if self.consistent else k.h_W_parallel

    def seat(self, lift):
        """What the closed valve's seat still carries."""
        return self.S0 * (1 - lift / self.seat_lift)**2 if lift < self.seat_lift else 0.0

    def valve_moment(self, k):
        """Moments that press the roller on the cam, Islam (17)-(22), less the seat's."""
        t = self.train
        at_valve = t.stiffness * (k.l + t.precompression) - self.seat(k.l) + t.valve_mass * self.omega**2 * k.l2
        return at_valve * k.B_s + self.I_f * self.omega**2 * k.gamma2

    def load_share(self, x):
        """Part of the load on the asperities: W_a that agrees with the film left by W - W_a; sets the film too."""
        t, area = self.train, 2 * x.b * self.train.width

        def films(W_a):
            return laws.film(self.eta0, abs(x.V_e), t.alpha, t.E, x.R, x.W - W_a, t.width)

        def excess(W_a):
            if W_a >= x.W:
                return -x.W
            return laws.asperities(films(W_a)[0] / t.roughness, area, t.E)[0] - W_a

        x.W_a = 0.0 if excess(0.0) < 1e-20 * x.W else brentq(excess, 0.0, x.W, xtol=1e-17 * x.W, rtol=1e-15)
        x.h_m, x.h_c = films(x.W_a)
        x.A_a, x.A_r = area, laws.asperities(x.h_m / t.roughness, area, t.E)[1]

    def contact(self, k, V_s, W):
        """Contact forces at a given load."""
        t = self.train
        x = SimpleNamespace(k=k, W=W, V_s=V_s, R=k.R)
        x.V_c = self.omega * k.V_c
        x.V_roll = self.omega * k.V_roll if self.consistent else x.V_c
        x.V_e = x.V_c - 0.5 * V_s
        x.omega_R = (x.V_roll - V_s) / self.r_R
        x.b, x.p_max = laws.hertz(W, k.R, t.width, t.E)
        self.load_share(x)
        pressure = 4 / math.pi * (W - x.W_a) / (x.A_a - x.A_r)
        newtonian = laws.newtonian_shear(V_s, x.h_c, x.b, t.width, self.eta0, t.alpha, pressure)
        limit = t.traction_limit * W
        x.F_h = limit * math.tanh(newtonian / limit)
        x.F_b = t.film_shear_strength * x.A_r + t.boundary_friction * x.W_a
        x.F_t = (1 - x.A_r / x.A_a) * x.F_h + x.F_b * math.tanh(V_s / t.mobilising_speed)
        if self.consistent:
            x.F_r = laws.rolling_biboulet(self.eta0, abs(x.V_e), t.E, k.R, W - x.W_a, t.width)
        else:
            x.F_r = laws.rolling_goksem(self.eta0, abs(x.V_e), t.alpha, t.E, k.R, W, t.width)
        x.omega_rel = x.omega_R - self.train.geometry.sense * k.gamma1 * self.omega
        spin = x.omega_rel if self.consistent else x.omega_R
        x.T_B = t.needle_friction * W * self.r_p * math.tanh(spin / (0.01 * self.omega))
        x.T_tangential = x.F_t + x.F_r * (2 * k.R / self.r_R - 1)
        return x

    def state(self, theta, V_s):
        """All forces and torques at one angle and sliding speed, load and load share solved to round-off."""
        k = closed_form(self.train.geometry, theta)
        moment = self.valve_moment(k)
        F_g = self.guide * self.omega * k.l1
        if self.consistent:
            sense = self.train.geometry.sense

            def improved(W):
                x = self.contact(k, V_s, W)
                return (moment + F_g * k.B_s - sense * (x.T_tangential * k.h_t + x.T_B)) / k.h_W

            x = self.contact(k, V_s, fixed_point(improved, moment / k.h_W))
        else:
            x = self.contact(k, V_s, moment / self.arm(k))
        x.F_g, x.moment = F_g, moment
        x.spin_rate = ((x.F_t - x.F_r) * self.r_R - x.T_B) / self.I_R
        self.torques(x)
        return x

    def torques(self, x):
        """Contributions to the drive torque and, in consistent mode, their sum by two other routes."""
        k, omega = x.k, self.omega
        x.geometric = x.moment * k.gamma1
        x.guide = x.F_g * k.l1
        if self.consistent:
            V_f = x.V_c - x.V_s
            x.contact = (x.F_t * x.V_s + x.F_r * (x.V_c + V_f)) / omega
            x.needle = x.T_B * x.omega_rel / omega
            x.inertia = self.I_R * x.omega_R * x.spin_rate / omega
            x.drive = x.W * k.h_W * k.gamma1 + x.T_tangential * k.h_F + 2 * x.F_r * k.R
            x.sum = x.geometric + x.contact + x.needle + x.guide + x.inertia
        else:
            x.F = (1 - x.A_r / x.A_a) * abs(x.F_h) + x.F_b + x.F_r
            x.contact, x.needle, x.inertia = x.F * k.h_F, x.T_B * x.omega_R / omega, 0.0
            x.drive = x.sum = x.geometric + x.contact + x.needle + x.guide

    def slope(self, theta, y):
        """d/dtheta of the sliding speed and of the integrals whose means are wanted."""
        x = self.state(theta, y[0])
        k = x.k
        V_roll1 = self.omega * (k.V_roll1 if self.consistent else k.V_c1)
        slip = V_roll1 - self.r_R * x.spin_rate / self.omega
        return np.array([slip] + [getattr(x, name) for name in TORQUES]
                        + [x.V_s / x.V_c, x.V_s / x.V_roll, x.omega_R])

    def jacobian(self, theta, y):
        """Only the sliding speed feeds back; central difference."""
        step = 1e-5 * (abs(y[0]) + 1e-3 * self.train.mobilising_speed)
        up, down = y.copy(), y.copy()
        up[0] += step
        down[0] -= step
        matrix = np.zeros((len(y), len(y)))
        matrix[:, 0] = (self.slope(theta, up) - self.slope(theta, down)) / (2 * step)
        return matrix

    def balanced_slip(self, theta):
        """Sliding speed at which the torques on the roller balance, its change of speed included."""
        V_roll = self.omega * closed_form(self.train.geometry, theta).V_roll

        def change(V_s):
            return self.slope(theta, [V_s])[0]

        return brentq(change, -0.5 * V_roll, 0.999 * V_roll, xtol=1e-16, rtol=1e-14)

    def stops(self):
        """Angles where a derivative of the data jumps: edges of the event and of the seat's unloading."""
        lift = self.train.geometry.lift
        edge = lift.half_angle

        def left(theta):
            return lift(theta) - self.seat_lift

        return [-edge, brentq(left, -edge, 0.0, xtol=1e-15), brentq(left, 0.0, edge, xtol=1e-15), edge]


TORQUES = ('drive', 'geometric', 'contact', 'needle', 'guide', 'inertia')


def fixed_point(function, start):
    """Root of function(x) = x by secants; the function hardly depends on x."""
    x0, f0 = start, function(start)
    x1 = f0
    for _ in range(20):
        f1 = function(x1)
        if abs(f1 - x1) <= 2e-15 * abs(x1):
            return f1
        slope = (f1 - f0) / (x1 - x0)
        x0, f0, x1 = x1, f1, x1 + (f1 - x1) / (1 - slope)
    if abs(f1 - x1) > 1e-13 * abs(x1):
        raise ArithmeticError('load does not converge')
    return f1


def march(point, y, angles, method, rtol):
    """Carry the state from the first angle to the last, stopping at every one; state at each angle, evaluations."""
    scale = np.array([1e-4] + [1e-3] * len(TORQUES) + [1e-3, 1e-3, 1.0])
    states, evaluations = [y], 0
    for begin, end in zip(angles[:-1], angles[1:]):
        run = solve_ivp(point.slope, (begin, end), y, method=method, jac=point.jacobian, rtol=rtol, atol=rtol * scale,
                        max_step=2 * DEGREE, first_step=min(1e-6, 0.1 * (end - begin)))
        if not run.success:
            raise ArithmeticError(run.message)
        y, evaluations = run.y[:, -1], evaluations + run.nfev
        states.append(y)
    return states, evaluations


def integrate(point, angles, method='Radau', rtol=1e-10):
    """Sliding speed at the given angles [rad] and the means over the periodic cycle.

    A first half cycle starts at the nose, where sliding forgets its past fastest, from the balance there; its end is
    the start of the cycle that counts. On the base circle of a cold engine the roller needs most of the dwell to
    settle, so the balance there is no periodic start. ``closure`` is the difference between end and start, relative.
    """
    stops = point.stops()
    y = np.zeros(len(TORQUES) + 4)
    y[0] = point.balanced_slip(0.0)
    states, _ = march(point, y, [0.0] + [a for a in stops if a > 0] + [math.pi], method, rtol)
    y = np.zeros(len(y))
    y[0] = states[-1][0]
    knots = sorted(set(list(angles) + stops + [-math.pi, math.pi]))
    states, evaluations = march(point, y, knots, method, rtol)
    slips = {angle: state[0] for angle, state in zip(knots, states)}
    names = TORQUES + ('slip_of_contact_speed', 'slip_of_rolling_speed', 'roller_speed')
    means = {name: float(value) for name, value in zip(names, states[-1][1:] / (2 * math.pi))}
    return SimpleNamespace(slip=np.array([slips[a] for a in angles]), means=means, evaluations=evaluations,
                           closure=abs(states[-1][0] - y[0]) / max(map(abs, slips.values())))
