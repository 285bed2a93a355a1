"""Periodic states of a flexible valve train: slow, plain, independent of the solver it checks.

Equations of `doc/theory.md`, flexible train, written again with complex numbers in the plane of `mechanism.py` (pivot at rest at 0,
cam's centre at D), for the train of Islam's Appendix B as `cycle_reference.Train` has it. Radau of `scipy.integrate` integrates state
and integrals together between the edges of the lift, without their Jacobian and without stops where contacts part, from rest turn
after turn until one closes. `python test/reference/train_reference.py` writes `test/data/train_reference.csv` again (an hour).
"""
import cmath
import math
import pathlib
from dataclasses import dataclass, field
from types import SimpleNamespace

import numpy as np
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from scipy.optimize import brentq, fsolve

import contact_laws as laws
from cycle_reference import DEGREE, Train
from mechanism import base_angle, closed_form, thesis_geometry

AMBIENT, POLYTROPIC = 1e5, 1.4
INTEGRALS = ('drive', 'contact', 'needle', 'guide', 'damping', 'gallery', 'leak', 'float')


@dataclass(frozen=True)
class Adjuster:
    diameter: float = 10e-3
    volume: float = 0.3e-6
    gap: float = 5e-6
    leak_length: float = 8e-3
    plunger_mass: float = 12e-3
    spring_stiffness: float = 800.0
    check_area: float = 3e-6
    discharge: float = 0.7
    crack: float = 5e3
    full: float = 20e3
    transition: float = 0.2e3
    supply: float = 0.2e6
    air: float = 0.01
    oil_modulus: float = 1.4e9
    density: float = 850.0
    lowest: float = -1.5e-3
    highest: float = 1.0e-3
    stop_stiffness: float = 5e7
    stop_damping: float = 1.0


@dataclass(frozen=True)
class Flexible:
    """What a flexible train has beside a rigid one."""
    train: Train = field(default_factory=Train)
    finger_stiffness: float = 5e7
    contact_damping: float = 0.2
    pad_stiffness: float = 5e7
    pad_damping: float = 0.2
    seat_stiffness: float = 5e7
    seat_damping: float = 1.0
    lash: float = 0.0
    spring_mass: float = 0.036
    modes: int = 5
    spring_damping: float = 0.01
    finger_centre: float = 20e-3
    adjuster: Adjuster = None


def dot(a, b):
    return a.real * b.real + a.imag * b.imag


def cross(a, b):
    return a.real * b.imag - a.imag * b.real


class Table:
    """Logarithm of a function of the film ratio by a spline through points of it, to 1e-11."""
    LOW, STEP = -8.0, 0.01

    def __init__(self, function):
        places = self.LOW + self.STEP * np.arange(3801)
        self.c = CubicSpline(places, [math.log(function(x)) for x in places]).c.T[:, ::-1].tolist()

    def __call__(self, x):
        i = int((x - self.LOW) / self.STEP)
        d = x - self.LOW - i * self.STEP
        c = self.c[i]
        return math.exp(c[0] + d * (c[1] + d * (c[2] + d * c[3])))


HEIGHT_52, HEIGHT_2 = Table(laws.height_integral_52), Table(laws.height_integral_2)
# (1 + a cos)^16 cos, integrated from -pi/2 to pi/2
SHEAR = [math.comb(16, n) * math.sqrt(math.pi) * math.gamma(0.5 * n + 1) / math.gamma(0.5 * n + 1.5) for n in range(17)]


class Point:
    """A flexible train at one speed and viscosity."""

    def __init__(self, rpm, eta0, flexible):
        self.omega, self.eta0, self.f = rpm * math.pi / 30, eta0, flexible
        t = flexible.train
        g = self.g = t.geometry
        self.t = t
        self.r_R = g.r_R
        inner = g.r_R - t.roller_wall
        self.I_R = 0.5 * t.roller_mass * (g.r_R**2 + inner**2)
        self.r_p = inner - t.needle_radius
        self.I_C = t.finger_mass * g.B**2
        self.guide = eta0 * math.pi * t.stem_diameter * t.guide_length / t.guide_clearance
        self.c_H = 1.5287e-10 * (226.4e9 / t.E)**0.9 / t.width**0.8
        self.gamma_B = base_angle(g)
        self.chi_h = g.chi
        self.u_h, self.u_v = cmath.exp(-1j * self.chi_h), cmath.exp(-1j * g.chi)
        n = range(1, flexible.modes + 1)
        m = flexible.spring_mass if flexible.modes else 0.0
        self.m_s = m
        self.w = [i * math.pi * math.sqrt(t.stiffness / m) for i in n] if m else []
        self.s = [(-1)**(i + 1) / (i * math.pi) for i in n]
        self.m_N = t.valve_mass - sum(2 * m / (i * math.pi)**2 for i in n)
        self.modes0 = 8 if flexible.adjuster else 5
        self.size = self.modes0 + 2 * flexible.modes
        self.y0 = 0.0
        if flexible.adjuster:
            a = flexible.adjuster
            self.A_p = math.pi * a.diameter**2 / 4
            self.G = math.pi * a.diameter * a.gap**3 / (12 * eta0 * a.leak_length)
            self.c_pl = eta0 * math.pi * a.diameter * a.leak_length / a.gap
            self.F_s0 = 0.0
        self.rest()

    # statics of the base circle
    def rest(self):
        t, f = self.t, self.f
        W = t.base_load
        delta = self.c_H * W**0.9 + W / f.finger_stiffness

        def at_rest(gamma, y):
            """Geometry, force of the pad and lift where the finger is, which a soft seat lets sink."""
            d, _, arm, *_ = self.touch(math.pi, gamma, 0.0, y, 0.0)
            F_p = W * cross(arm, d.n) / (self.g.B * math.sin(gamma + self.g.chi))
            return d, F_p, -(t.stiffness * t.precompression - F_p) / (f.seat_stiffness + t.stiffness)

        def misfit(unknown):
            gamma, y = self.gamma_B + 1e-6 * unknown[0], 1e-6 * unknown[1]
            d, F_p, x = at_rest(gamma, y)
            return [1e6 * (d.delta - delta), 1e6 * (self.pad_gap(gamma, y, x) - F_p / f.pad_stiffness)]

        if f.lash:
            self.start = [self.gamma_B, 0.0, -t.stiffness * t.precompression / (f.seat_stiffness + t.stiffness)]
            return
        a, b = fsolve(misfit, [0.0, 0.0], xtol=1e-9)
        gamma, y = self.gamma_B + 1e-6 * a, 1e-6 * b
        self.y0 = y
        d, F_p, x = at_rest(gamma, y)
        self.start = [gamma, 0.0, x]
        if f.adjuster:
            F_A = -(W * dot(self.u_h, d.n) + F_p)
            self.F_s0 = F_A - f.adjuster.supply * self.A_p + f.adjuster.spring_stiffness * y

    def initial(self):
        state = np.zeros(self.size + len(INTEGRALS))
        state[:3] = self.start
        if self.f.adjuster:
            state[5], state[7] = self.y0, self.f.adjuster.supply
        return state

    def pad_gap(self, gamma, y, x):
        return self.g.B * (math.cos(self.gamma_B + self.g.chi) - math.cos(gamma + self.g.chi)) - y - x - self.f.lash

    def touch(self, theta, gamma, gd, y, yd):
        """Nearest point of the pitch curve; everything about it."""
        g, eps = self.g, self.g.sense
        arm = g.A * cmath.exp(1j * (gamma + g.lam))
        z, zd = y * self.u_h + arm - g.D, yd * self.u_h + 1j * gd * arm
        phi = theta
        for _ in range(20):
            k = closed_form(g, math.remainder(phi, 2 * math.pi))
            e = cmath.exp(1j * (k.gamma + g.lam))
            turn = cmath.exp(1j * eps * (phi - theta))
            n = turn * (g.A * (1 + eps * k.gamma1) * e - g.D) / k.M
            away = z - turn * (g.A * e - g.D)
            delta = -dot(n, away)
            along = 1j * eps * n
            step = dot(along, away) / (k.M * (1 - k.pitch_curvature * delta))
            phi += step
            if abs(step) < 1e-13:
                break
        w = zd + 1j * eps * self.omega * z
        d = SimpleNamespace(delta=delta, n=n, along=along, S=dot(along, w), deltad=-dot(n, w), phi=phi)
        return d, k, arm, z, zd

    def series(self, delta):
        """Load of the line contact in series with the finger."""
        if delta <= 0:
            return 0.0
        c, k = self.c_H, self.f.finger_stiffness
        u = min((delta / c)**(1 / 9), (delta * k)**0.1)
        for _ in range(40):
            step = (c * u**9 + u**10 / k - delta) / (9 * c * u**8 + 10 * u**9 / k)
            u -= step
            if abs(step) < 1e-15 * u:
                break
        return u**10

    def share(self, W, R, V_e, b):
        t, area = self.t, 2 * b * self.t.width
        U, G, E = self.eta0 * V_e / (t.E * R), t.alpha * t.E, t.E
        h0 = R * 2.65 * U**0.70 * G**0.54 * (1 / (E * R * t.width))**-0.13
        square = laws.ROUGHNESS_PRODUCT**2
        load = 8 * math.sqrt(2) / 15 * math.pi * square * math.sqrt(laws.ROUGHNESS_OVER_TIP) * E * area

        def ratio(W_h):
            return h0 * W_h**-0.13 / t.roughness

        def excess(W_a):
            if W_a >= W:
                return -W
            r = ratio(W - W_a)
            return (load * HEIGHT_52(r) if r < 29.9 else 0.0) - W_a

        if ratio(W) > 29.0:
            W_a, A_r = 0.0, 0.0
        else:
            first = excess(0.0)
            W_a = 0.0 if first < 1e-15 * W else brentq(excess, 0.0, min(W, first * 1.0000001), xtol=1e-16 * W, rtol=1e-14)
            A_r = math.pi**2 * square * area * HEIGHT_2(ratio(W - W_a))
        h_c = R * 3.06 * U**0.69 * G**0.56 * ((W - W_a) / (E * R * t.width))**-0.10
        return W_a, A_r, area, h_c

    def friction(self, W, R, V_c, V_s, omega_rel):
        t = self.t
        V_e = abs(V_c - 0.5 * V_s)
        b, _ = laws.hertz(W, R, t.width, t.E)
        W_a, A_r, area, h_c = self.share(W, R, V_e, b)
        p = 4 / math.pi * (W - W_a) / (area - A_r)
        a = t.alpha * p / 16
        total = 0.0
        for c in reversed(SHEAR):
            total = total * a + c
        newtonian = V_s * t.width / h_c * b * self.eta0 * total
        limit = t.traction_limit * W
        F_t = (1 - A_r / area) * limit * math.tanh(newtonian / limit) \
            + t.boundary_friction * W_a * math.tanh(V_s / t.mobilising_speed)
        F_r = laws.rolling_biboulet(self.eta0, V_e, t.E, R, W - W_a, t.width)
        F_r *= W / (F_r**8 + W**8)**0.125
        return F_t, F_r, t.needle_friction * W * self.r_p * math.tanh(omega_rel / (0.01 * self.omega))

    def oil(self, p):
        a = self.f.adjuster
        oil, air = (1 - a.air) * math.exp(-p / a.oil_modulus), a.air * (AMBIENT / (AMBIENT + p))**(1 / POLYTROPIC)
        v = oil + air
        return v, v / (oil / a.oil_modulus + air / (POLYTROPIC * (AMBIENT + p)))

    def work(self, p):
        a, q = self.f.adjuster, 1 - 1 / POLYTROPIC
        return (1 - a.air) * a.oil_modulus * (1 - math.exp(-p / a.oil_modulus)) \
            + a.air * AMBIENT * ((1 + p / AMBIENT)**q - 1) / q

    def evaluate(self, theta, state):
        """Rates over time, and everything else."""
        f, t, g, eps, omega = self.f, self.t, self.g, self.g.sense, self.omega
        gamma, gd, x, xd, V_s = state[:5]
        a = f.adjuster
        y, yd, p = state[5:8] if a else (self.y0, 0.0, 0.0)
        d, k, arm, z, zd = self.touch(theta, gamma, gd, y, yd)
        W_e = self.series(d.delta)
        W = W_e * max(0.0, 1 + f.contact_damping * d.deltad)
        R, S = k.R, d.S
        V_roll, V_c = S - omega * self.r_R, S * R / self.r_R
        omega_R = (V_roll - V_s) / self.r_R
        omega_rel = omega_R - eps * gd
        F_t, F_r, T_B = self.friction(W, R, V_c, V_s, omega_rel) if W > 1e-9 else (0.0, 0.0, 0.0)
        T1 = F_t + F_r * (2 * R / self.r_R - 1)
        force = W * d.n - T1 * d.along
        # pad and seat
        delta_p, sine = self.pad_gap(gamma, y, x), math.sin(gamma + g.chi)
        deltad_p = g.B * sine * gd - yd - xd
        F_pe = f.pad_stiffness * max(0.0, delta_p)
        F_p = F_pe * max(0.0, 1 + f.pad_damping * deltad_p)
        F_se = f.seat_stiffness * max(0.0, -x)
        F_s = F_se * max(0.0, 1 - f.seat_damping * xd)
        q, qd = state[self.modes0:self.size:2], state[self.modes0 + 1:self.size:2]
        pull = self.m_s * sum(s * (w * w * u + 2 * f.spring_damping * w * v) for s, w, u, v in zip(self.s, self.w, q, qd))
        xdd = (F_p + F_s - t.stiffness * (x + t.precompression) - self.guide * xd + pull) / self.m_N
        # finger and plunger
        moment = cross(arm, force) + eps * T_B - F_p * g.B * sine
        turn = gamma + g.lam + self.chi_h
        j, j1 = -f.finger_centre * math.sin(turn), -f.finger_centre * math.cos(turn)
        m_F = t.finger_mass
        e = SimpleNamespace(W=W, d=d, x=x, check=0.0, Q_l=0.0, gallery=0.0)
        losses_oil = 0.0
        rates = np.empty(self.size + len(INTEGRALS))
        if a:
            v, K = self.oil(p)
            dp = a.supply - p
            X = min(1.0, max(0.0, (dp - a.crack) / a.full))
            e.check = X * X * (3 - 2 * X)
            Q_cv = a.discharge * a.check_area * e.check * math.sqrt(2 * v / a.density) * dp / (dp * dp + a.transition**2)**0.25
            e.Q_l = self.G * (p - a.supply)
            pd = K / (a.volume + self.A_p * y) * (Q_cv - e.Q_l - self.A_p * yd)
            low, high = max(0.0, a.lowest - y), max(0.0, y - a.highest)
            stop_e = a.stop_stiffness * (low - high)
            stop = a.stop_stiffness * (low * max(0.0, 1 - a.stop_damping * yd) - high * max(0.0, 1 + a.stop_damping * yd))
            F_hyd = p * self.A_p + self.F_s0 - a.spring_stiffness * y - self.c_pl * yd
            axial = dot(self.u_h, force) + F_p + F_hyd + stop - m_F * j1 * gd * gd
            mass = m_F + a.plunger_mass
            ydd, gdd = np.linalg.solve([[mass, m_F * j], [m_F * j, self.I_C]], [axial, moment])
            e.joint = F_hyd + stop - a.plunger_mass * ydd
            P, P_s = self.work(p), self.work(a.supply)
            e.gallery = (Q_cv * P_s - e.Q_l * P_s) / v
            losses_oil = (e.Q_l * (P - P_s) + Q_cv * (P_s - P)) / v + self.c_pl * yd * yd - (stop - stop_e) * yd
            rates[5:8] = yd, ydd, pd
        else:
            ydd, gdd = 0.0, moment / self.I_C
            e.joint = -(dot(self.u_h, force) + F_p) + m_F * (j * gdd + j1 * gd * gd)
        spin = ((F_t - F_r) * self.r_R - T_B) / self.I_R
        zdd = ydd * self.u_h + (1j * gdd - gd * gd) * arm
        Sd = dot(d.along, zdd + 2j * eps * omega * zd - omega**2 * z) + k.pitch_curvature * S * d.deltad / (1 - k.pitch_curvature * d.delta)
        rates[:5] = gd, gdd, xd, xdd, Sd - self.r_R * spin
        rates[self.modes0:self.size:2] = qd
        rates[self.modes0 + 1:self.size:2] = [-w * w * u - 2 * f.spring_damping * w * v - 2 * s * xdd
                                              for s, w, u, v in zip(self.s, self.w, q, qd)]
        h_N, h_F = eps * cross(d.n, z), dot(d.n, z) - self.r_R
        damping = (W - W_e) * d.deltad + (F_p - F_pe) * deltad_p - (F_s - F_se) * xd + losses_oil \
            + self.m_s * f.spring_damping * sum(w * v * v for w, v in zip(self.w, qd))
        rigid = g.lift(math.remainder(theta, 2 * math.pi))
        e.rigid = rigid
        rates[self.size:] = [omega * (W * h_N + T1 * h_F + 2 * F_r * R), F_t * V_s + F_r * (2 * V_c - V_s), T_B * omega_rel,
                             self.guide * xd * xd, damping, e.gallery, e.Q_l, float(rigid > 0 and W <= 0)]
        return rates, e

    def slope(self, theta, state):
        return self.evaluate(theta, state.tolist())[0] / self.omega

    def scales(self):
        one = [1e-5 / self.g.A, 0.1 / self.g.A, 1e-5, 0.1, 0.01]
        if self.f.adjuster:
            one += [1e-5, 0.1, 1e6]
        return np.array(one + [1e-4, 0.3] * self.f.modes + [0.1, 0.01, 0.01, 0.01, 0.01, 0.1, 1e-9, 1.0])

    def turn(self, state, tolerance, method='Radau', watch=None):
        edge = self.g.lift.half_angle
        state = np.array(state, float)
        state[self.size:] = 0.0
        evaluations = 0
        knots = [-math.pi, -edge, edge, math.pi]
        for begin, end in zip(knots[:-1], knots[1:]):
            run = solve_ivp(self.slope, (begin, end), state, method=method, rtol=1e-13, atol=tolerance * self.scales(),
                            max_step=5 * DEGREE, first_step=1e-6, dense_output=watch is not None)
            if not run.success:
                raise ArithmeticError(run.message)
            evaluations += run.nfev + run.njev * self.size
            if watch is not None:
                watch.append((begin, end, run))
            state = run.y[:, -1]
        return state, evaluations

    def periodic(self, tolerance, closure=1e-4, cycles=40, method='Radau', report=False):
        state = self.initial()
        scales = self.scales()[:self.size]
        for i in range(cycles):
            end, evaluations = self.turn(state, tolerance, method)
            distance = np.max(np.abs(end - state)[:self.size] / scales)
            if report:
                print(f'  turn {i + 1}: {distance:.1e}, {evaluations} evaluations', flush=True)
            state = end
            if distance < closure:
                break
        return state, i + 1, distance

    def measure(self, state, tolerance, method='Radau', samples=200000):
        """Extremes and means of a turn from this state."""
        watch = []
        end, _ = self.turn(state, tolerance, method, watch)
        o = {name: end[self.size + i] for i, name in enumerate(INTEGRALS)}
        m = {f'mean_{name}': o[name] / (2 * math.pi) for name in ('drive', 'contact', 'needle', 'guide', 'damping', 'gallery')}
        m['loss'] = sum(m[f'mean_{name}'] for name in ('contact', 'needle', 'guide', 'damping'))
        turn = 2 * math.pi / self.omega
        m['leak_volume'], m['float_share'] = o['leak'], o['float'] / turn
        top = self.g.lift.height
        rows = []
        for begin, end_, run in watch:
            n = int(samples * (end_ - begin) / (2 * math.pi))
            places = np.unique(np.concatenate([np.linspace(begin, end_, n), run.t]))
            states = run.sol(places)
            for place, s in zip(places, states.T):
                e = self.evaluate(place, s.tolist())[1]
                mode = abs(s[self.modes0]) if self.modes0 < self.size else 0.0
                plunger = (s[5], s[7]) if self.f.adjuster else (0.0, 0.0)
                rows.append((place, e.W, e.rigid, s[2], s[3], e.joint, mode, e.check, *plunger))
        r = np.array(rows).T
        place, W, rigid, x, xd, joint, q1, check, y, p = r
        # Part of each interval in which a straight line between its ends is below zero
        pull, size = np.maximum(-joint, 0.0), np.abs(joint)
        below = (pull[1:] + pull[:-1]) / np.maximum(size[1:] + size[:-1], np.finfo(float).tiny)
        m['tension_share'] = np.sum(np.diff(place) * below) / (2 * math.pi)
        i = np.argmax(W)
        m.update(load_max=W[i], load_max_angle=place[i] / DEGREE, load_min=W[rigid >= 0.25 * top].min(), lift_error_min=(x - rigid).min(),
                 lift_error_max=(x - rigid).max(), joint_min=joint.min(), surge=self.t.stiffness * math.pi * q1.max(),
                 y_min=y.min(), y_max=y.max(), p_max=p.max(), W_min60=W[abs(place) < math.pi / 3].min(),
                 check_share=np.trapezoid((check > 0) * 1.0, place) / (2 * math.pi))
        down = np.nonzero((x[:-1] > 0) & (x[1:] <= 0))[0]
        up = np.nonzero((x[:-1] <= 0) & (x[1:] > 0))[0]
        m['crossings'] = [(round(place[i] / DEGREE, 4), float(xd[i] + (xd[i + 1] - xd[i]) * x[i] / (x[i] - x[i + 1]))) for i in down]
        m['seating'] = max([-v for _, v in m['crossings']], default=0.0)
        m['lifts_off'] = len(up)
        m['losses_of_contact'] = int(np.sum((W[:-1] > 0) & (W[1:] <= 0)))
        return m


FIXED, ADJUSTER = Flexible(), Flexible(adjuster=Adjuster())
CASES = {'fixed_300': (300, FIXED), 'fixed_900': (900, FIXED), 'fixed_1500': (1500, FIXED), 'fixed_2500': (2500, FIXED),
         'fixed_2900': (2900, FIXED), 'fixed_3000': (3000, FIXED), 'adjuster_300': (300, ADJUSTER), 'adjuster_900': (900, ADJUSTER),
         'adjuster_2500': (2500, ADJUSTER), 'reversed_900': (900, Flexible(train=Train(geometry=thesis_geometry(sense=-1)))),
         'softseat_1500': (1500, Flexible(seat_stiffness=1e6, seat_damping=0.05)), 'lash_900': (900, Flexible(lash=1e-4))}
COLUMNS = ('load_max', 'lift_error_min', 'lift_error_max', 'seating', 'joint_min', 'tension_share', 'float_share', 'losses_of_contact',
           'surge', 'mean_drive', 'loss', 'mean_damping', 'mean_needle', 'y_min', 'y_max', 'p_max', 'leak_volume')


def row(name):
    rpm, flexible = CASES[name]
    point = Point(rpm, 0.01, flexible)
    # A finger with lash rattles and has no periodic state: its first turn
    start = point.initial() if flexible.lash else point.periodic(1e-6, 1e-5)[0]
    measures = point.measure(start, 1e-6, samples=30000)
    return ','.join([name] + [f'{float(measures[column]):.9e}' for column in COLUMNS]) + '\n'


def write(path):
    with open(path, 'w', encoding='ascii') as file:
        file.write('# Periodic states of a flexible train (test/reference/train_reference.py), SI units: decks/dynamics.nml (fixed)\n'
                   '# and decks/lash_adjuster.nml at the speeds in rev/min that the names have, 0.01 Pa s. Means are torques.\n'
                   '# The first turned the other way (reversed), with a soft seat, and the first turn with lash, as in decks/hard.\n'
                   '# Tolerance of a step 1e-6 of the sizes in `Point.scales`, a turn ends within 1e-5 of where it began.\n')
        file.write(','.join(['case', *COLUMNS]) + '\n')
        file.writelines(map(row, CASES))


if __name__ == '__main__':
    write(pathlib.Path(__file__).resolve().parent.parent / 'data/train_reference.csv')
