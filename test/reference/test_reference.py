"""Quick checks that the reference itself is right: ``pytest test/reference`` (seconds)."""
import math
import pathlib

import numpy as np
import pytest
from mpmath import mp, mpf
from scipy.integrate import quad
from scipy.optimize import brentq
from scipy.special import erfc, k0

import bearing_reference
import contact_laws as laws
import heat_reference
import journal_reference
import pivot
from cycle_reference import Point, Train, integrate
from kinematics_reference import DIGITS, Construction, exact
from mechanism import closed_form, skewed_geometry, thesis_geometry
from roller_problem_reference import loss
from train_reference import Adjuster, Flexible
from train_reference import Point as TrainPoint

EVERY = [(maker, sense) for maker in (thesis_geometry, skewed_geometry) for sense in (1, -1)]


@pytest.mark.parametrize('maker, sense', EVERY)
def test_closed_formulas_agree_with_construction(maker, sense):
    with mp.workdps(DIGITS):
        geometry = exact(maker, sense)
        for angle in ('-0.77', '0.31'):
            theta = mpf(angle) * geometry.lift.half_angle
            built, closed = Construction(geometry).quantities(theta), closed_form(geometry, theta, mp)
            for name, value in vars(closed).items():
                if hasattr(built, name):
                    assert abs(getattr(built, name) - value) < mpf(10)**-40 * (1 + abs(value)), name


@pytest.mark.parametrize('maker, sense', EVERY)
def test_roller_neither_penetrates_nor_slips(maker, sense):
    with mp.workdps(DIGITS):
        geometry = exact(maker, sense)
        k = Construction(geometry).quantities(mpf('0.5'))
        tiny = mpf(10)**-40
        assert abs(k.penetration) < tiny
        assert abs(k.V_roll - geometry.r_R * k.turning - k.V_c) < tiny          # both surfaces pass the contact alike
        assert abs(k.h_F - sense * k.gamma1 * k.h_t - k.V_roll) < tiny
        assert abs(k.R * (k.V_roll / geometry.r_R + 1) - k.V_c) < tiny          # relative spin times R


@pytest.mark.parametrize('maker, sense', EVERY)
def test_moments_follow_from_forces_as_vectors(maker, sense):
    """Place the film's forces on both bodies where they act and take moments: the formulas of cycle_reference."""
    geometry = maker(sense=sense)
    theta, W, F_t, F_r, T_B = 0.37, 300.0, 4.0, 1.5, 0.01
    k = closed_form(geometry, theta)
    s = k.gamma + geometry.lam
    centre = geometry.A * np.array([math.cos(s), math.sin(s)])
    opening = np.array([-centre[1], centre[0]])
    cam_at_centre = sense * np.array([centre[1], geometry.D - centre[0]])
    t = (cam_at_centre - k.gamma1 * opening) / k.M                 # the cam runs past the roller's centre along t
    n = sense * np.array([-t[1], t[0]])
    contact, cam_centre = centre - geometry.r_R * n, centre - n / k.pitch_curvature
    couple = 2 * F_r * k.R                                         # load times the offset of its line of action
    on_roller = [((F_t - F_r) * t, contact), (W * n + couple / geometry.r_R * t, centre)]
    on_cam = [(-(F_t + F_r) * t, contact), (-W * n + couple * k.cam_curvature * t, cam_centre)]

    def moment(forces, about):
        return sum((p - about)[0] * f[1] - (p - about)[1] * f[0] for f, p in forces)

    total = sum(f for f, _ in on_roller)
    assert total == pytest.approx(-sum(f for f, _ in on_cam), abs=1e-11)
    spin = sense * moment(on_roller, centre) - T_B
    assert spin == pytest.approx((F_t - F_r) * geometry.r_R - T_B, rel=1e-12)
    finger = moment([(total, centre)], np.zeros(2)) + sense * T_B
    tangential = F_t + F_r * (2 * k.R / geometry.r_R - 1)
    assert finger == pytest.approx(W * k.h_W + sense * (tangential * k.h_t + T_B), rel=1e-12)
    drive = sense * moment(on_cam, np.array([geometry.D, 0.0]))
    assert drive == pytest.approx(W * k.h_W * k.gamma1 + tangential * k.h_F + couple, rel=1e-12)


@pytest.mark.parametrize('film_ratio', [0.0, 0.7, 1.9, 3.3])
def test_height_integrals_agree_with_quadrature(film_ratio):
    for n, value in ((2, laws.height_integral_2(film_ratio)), (2.5, laws.height_integral_52(film_ratio))):
        integral = quad(lambda s, n=n: (s - film_ratio)**n * math.exp(-0.5 * s * s), film_ratio, film_ratio + 12,
                        epsabs=0, epsrel=1e-12)[0]
        assert value == pytest.approx(integral / math.sqrt(2 * math.pi), rel=1e-11)
    by_parts = 0.5 * (1 + film_ratio**2) * erfc(film_ratio / math.sqrt(2))
    by_parts -= film_ratio * math.exp(-0.5 * film_ratio**2) / math.sqrt(2 * math.pi)
    assert laws.height_integral_2(film_ratio) == pytest.approx(by_parts, rel=1e-11)


def test_film_shear_agrees_with_adaptive_quadrature():
    V_s, h_c, b, L, eta0, alpha, peak = 0.01, 1e-7, 5e-5, 0.0137, 0.03, 2.2e-8, 0.65e9
    integral = quad(lambda x: laws.cameron(eta0, alpha, peak * math.sqrt(1 - x * x)), -1, 1, epsrel=1e-12)[0]
    force = V_s * L / h_c * b * integral
    assert laws.newtonian_shear(V_s, h_c, b, L, eta0, alpha, peak) == pytest.approx(force, rel=1e-10)


@pytest.mark.parametrize('geometry', [thesis_geometry(), thesis_geometry(sense=-1), skewed_geometry(sense=-1)])
def test_power_balance_closes_at_every_angle(geometry):
    """Torque on the cam, losses and change of stored energy by separate routes; the spin is arbitrary."""
    point = Point(900.0, 0.15, Train(geometry=geometry))
    for theta in np.linspace(-1.3, 1.3, 27):
        for V_s in (1e-4, 0.05, -0.02):
            x = point.state(theta, V_s)
            k, t, omega = x.k, point.train, point.omega
            losses = x.F_t * V_s + x.F_r * (2 * x.V_c - V_s) + x.T_B * x.omega_rel + x.F_g * omega * k.l1
            at_valve = t.stiffness * (k.l + t.precompression) - point.seat(k.l) + t.valve_mass * omega**2 * k.l2
            stored = (omega * k.l1 * at_valve + point.I_f * omega**3 * k.gamma1 * k.gamma2
                      + point.I_R * x.omega_R * x.spin_rate)
            assert x.drive * omega == pytest.approx(losses + stored, abs=1e-12 * (1 + abs(stored)))
            assert x.drive == pytest.approx(x.sum, abs=1e-13)


def test_geometric_torque_stores_its_work():
    """Work of the geometric torque between two angles is the change of spring, seat and kinetic energy."""
    point = Point(600.0, 0.0305, Train(geometry=skewed_geometry()))
    t, omega = point.train, point.omega

    def energy(theta):
        k = closed_form(t.geometry, theta)
        seat = point.S0 * point.seat_lift / 3 * (1 - min(k.l / point.seat_lift, 1.0))**3
        return (0.5 * t.stiffness * (k.l + t.precompression)**2 + seat + 0.5 * t.valve_mass * (omega * k.l1)**2
                + 0.5 * point.I_f * (omega * k.gamma1)**2)

    def torque(theta):
        k = closed_form(t.geometry, theta)
        return point.valve_moment(k) * k.gamma1

    work = quad(torque, -1.0, 0.4, points=point.stops()[1:3], epsabs=1e-14, epsrel=1e-13, limit=200)[0]
    assert work == pytest.approx(energy(0.4) - energy(-1.0), rel=1e-12)


def test_base_circle_has_the_adjusters_load_in_source_mode():
    point = Point(300.0, 0.01, mode='source')
    assert point.state(math.pi, 0.01).W == pytest.approx(64.0, rel=1e-13)


def test_two_solvers_agree_on_a_cycle():
    point = Point(300.0, 0.01, mode='source')
    radau, lsoda = (integrate(point, [0.0, 0.7], method, rtol) for method, rtol in (('Radau', 1e-6), ('LSODA', 1e-7)))
    assert radau.slip == pytest.approx(lsoda.slip, rel=1e-6)
    assert radau.means['contact'] == pytest.approx(lsoda.means['contact'], rel=1e-6)
    assert abs(radau.means['geometric']) < 1e-5 * radau.means['drive']


def test_roller_problem_gives_the_stated_loss():
    assert loss('a', 'Radau', 1e-8)[0] == pytest.approx(5.4713973743e-2, rel=1e-9)


def test_speeds_at_which_the_train_parts():
    """The numbers of `test_margins.f90`."""
    lost, opened, pumped, adjuster = pivot.speeds(3001)
    assert lost == pytest.approx(2937.17, abs=0.006)
    assert opened == pytest.approx(2470.90, abs=0.006)
    assert pumped == pytest.approx(2357.51, abs=0.006)
    assert adjuster == pytest.approx(26.3802, abs=6e-5)


@pytest.mark.parametrize('u', (-1.3, -0.02, 0.4, 2.0))
def test_moving_line_of_heat_is_the_sum_of_what_it_gave_off(u):
    assert abs(heat_reference.line_by_time(u) / (math.exp(-u) * k0(abs(u))) - 1) < 1e-9


def test_rise_under_a_fast_band_is_two_thirds_of_its_largest():
    largest = 2 / math.sqrt(math.pi) * math.sqrt(2 / 1e7)          # half space under constant flux, 2 q sqrt(t/(pi k rho c))
    assert abs(heat_reference.band_mean(1e7) / (2 / 3 * largest) - 1) < 1e-5


def test_rigid_limit_of_the_rolling_resistance_is_1_4705():
    """Isoviscous film between rigid surfaces with Reynolds' exit: F/(E' R L) = 1.4705 sqrt(U2 W), with x = sqrt(2 R h0) tan(g)."""
    def first(g):
        return g / 2 + math.sin(2 * g) / 4

    def second(g):
        return 3 * g / 8 + math.sin(2 * g) / 4 + math.sin(4 * g) / 32

    def pressure(g, exit_):
        return first(g) - first(-math.pi / 2) - (second(g) - second(-math.pi / 2)) / math.cos(exit_)**2
    end = brentq(lambda g: pressure(g, g), 0.1, 1.2)
    load = quad(lambda g: pressure(g, end) / math.cos(g)**2, -math.pi / 2 + 1e-9, end)[0]
    shear = abs(quad(lambda g: 1 - (math.cos(g) / math.cos(end))**2, -math.pi / 2, end)[0]) / 2
    assert abs(6 * math.sqrt(2) * shear / math.sqrt(12 * load) - 1.4705) < 5e-5


@pytest.mark.parametrize('e', (0.1, 0.6, 0.95))
def test_film_forces_of_bearings_are_the_closed_forms(e):
    """Ocvirk (1952) and Sommerfeld (1904): eta omega R L^3/(4 c^2) e sqrt(16 e^2 + pi^2 (1 - e^2))/(1 - e^2)^2 and so on."""
    r, c, width = bearing_reference.DIAMETER / 2, bearing_reference.CLEARANCE, bearing_reference.WIDTH
    short = r * width**3 / (4 * c * c) * e * math.sqrt(16 * e * e + math.pi**2 * (1 - e * e)) / (1 - e * e)**2
    assert abs(math.hypot(*bearing_reference.film_force('short_ocvirk', e)) / short - 1) < 1e-10
    long = 12 * math.pi * r * width * (r / c)**2 * e / ((2 + e * e) * math.sqrt(1 - e * e))
    assert abs(math.hypot(*bearing_reference.film_force('long_full_sommerfeld', e)) / long - 1) < 1e-10


@pytest.mark.parametrize('law', ('short_ocvirk', 'long_full_sommerfeld'))
@pytest.mark.parametrize('e', (0.1, 0.6, 0.95))
def test_film_torque_on_the_journal_is_shear_and_half_the_moment_of_the_load(law, e):
    """Moments of the film about the middle between both centres: journal and bearing share that of the load, c e times its part across."""
    r, c, width = bearing_reference.DIAMETER / 2, bearing_reference.CLEARANCE, bearing_reference.WIDTH
    shear = 2 * math.pi * r**3 * width / c / math.sqrt(1 - e * e)
    beside = c * e / 2 * bearing_reference.film_force(law, e)[1]
    assert abs(bearing_reference.film_torque(law, e) / (shear + beside) - 1) < 1e-10


@pytest.mark.parametrize('width_ratio', (0.1, 0.5, 1.0))
def test_velocity_of_journals_of_finite_width_is_near_that_of_reynolds_equation(width_ratio):
    """The fit of journal_motion.f90: size within 11 %, direction within 4 degrees; the grid itself is within 1 %."""
    for e in (0.02, 0.4, 0.75, 0.9, 0.96):
        for degrees in range(0, 181, 30):
            squeeze = math.radians(degrees)
            velocity = journal_reference.fitted_velocity(e, journal_reference.film_force(e, squeeze, width_ratio), width_ratio)
            assert abs(np.linalg.norm(velocity) - 1) < 0.12, (e, degrees)
            off = math.atan2(velocity[1], velocity[0]) - squeeze
            assert abs(math.sin(off)) < math.sin(math.radians(4)) and math.cos(off) > 0, (e, degrees)


def test_table_of_finite_bearings_is_what_a_coarser_grid_gives():
    """The widest error of a grid half as fine is 0.24 % of the load."""
    table = pathlib.Path(__file__).resolve().parent.parent / 'data' / 'finite_bearing.csv'
    rows = [line.split(',') for line in table.read_text().splitlines()[3:]]
    assert [(float(row[0]), float(row[1])) for row in rows] == journal_reference.STEADY
    for width_ratio, e, load, attitude in ((float(x) for x in row) for row in rows):
        found, angle = journal_reference.steady_load(e, width_ratio)
        assert abs(found / load - 1) < 3e-3 and abs(math.degrees(angle) - attitude) < 0.05, (width_ratio, e)


def test_film_of_a_narrow_bearing_is_that_of_the_short_one():
    for e, squeeze in ((0.2, 0.5), (0.6, 2.0), (0.8, 3.0)):
        found = journal_reference.film_force(e, squeeze, 0.02)
        short = journal_reference.short_force((e, 0.0), (math.cos(squeeze), math.sin(squeeze)), 0.02)
        assert np.linalg.norm(found - short) < 5e-3 * np.linalg.norm(short)


def test_a_short_film_at_rest_is_that_of_ocvirk():
    e = 0.7
    force = journal_reference.short_force((e, 0.0), (0.0, -0.5 * e), 0.5)
    assert math.isclose(math.hypot(*force), 0.25 * e * math.sqrt(16 * e**2 + math.pi**2 * (1 - e**2)) / (1 - e**2)**2, rel_tol=1e-12)


@pytest.mark.parametrize('adjuster', [None, Adjuster()])
def test_a_flexible_train_at_rest_stays_and_carries_the_base_circle_load(adjuster):
    point = TrainPoint(1e-3, 0.01, Flexible(adjuster=adjuster))
    state = point.initial()
    rates, everything = point.evaluate(math.pi, state.tolist())
    # Without speed there is no film, so friction alone turns the finger: that of the needles, 1e-4 of the load's moment
    assert abs(everything.W / 64 - 1) < 1e-6 and abs(rates[3]) < 1e-3
    # Both numbers were found with the arms of the rigid train, from which the finger is 1e-4 rad away
    assert abs(state[2] + 3.44813551e-6) < 2e-12
    assert abs(point.y0 + 0.193165e-6) < 1e-10
