"""A closed-form problem for the roller's spin equation, to compare integrators on: full statement, reference losses.

Mechanism: ``mechanism.thesis_geometry()`` with sense +1 (Islam, 2019, Appendix B): A 20.8, B 35.5, D 31.5 mm, lambda
-3.5 deg, chi 37.5 deg, r_B 18, r_R 8.5 mm; lift l = 0.0095 (1 - x^2)^4 m, x = theta/70 deg, zero outside. Kinematics
l, l', l'', gamma', gamma'', M, R, V_c, h_W, B_s = B sin(gamma + chi) as in ``mechanism.closed_form`` (V_c and M times
omega are speeds).

Constants: width L 0.0137 m; E' from 170 GPa, 0.28 and 204 GPa, 0.29; sigma 0.14e-6 sqrt(2) m; alpha 2.2e-8 1/Pa; spring
25 000 N/m precompressed 0.0084 m; valve 0.0432 kg; finger inertia 0.0418 kg B^2; roller 0.0088 kg, wall 0.0024 m, so
r_i = r_R - 0.0024, I_R = 0.0088 (r_R^2 + r_i^2)/2; needle radius 0.00099 m, r_p = r_i - 0.00099.

Given omega and eta0, with omega_R the absolute spin of the roller:

    W_event = [(k (l + delta) + m_v omega^2 l'') B_s + I_f omega^2 gamma'']/h_W
    W   = max(64 + s^2 (3 - 2 s) (W_event - 64), 0),  s = min(l/1e-4 m, 1)
    V_s = omega (M - r_R) - r_R omega_R                     sliding speed
    V_e = max(|omega V_c - V_s/2|, 1e-6 m/s)                entrainment speed
    U = eta0 V_e/(E' R),  G = alpha E',  W* = W/(E' R L)
    h_m = 2.65 R U^0.70 G^0.54 W*^-0.13,  h_c = 3.06 R U^0.69 G^0.56 W*^-0.10
    b = sqrt(8 W R/(pi L E')),  p_max = 2 W/(pi b L)
    W_a = min(c 4.4086e-5 (4 - h_m/sigma)^6.804, W) for h_m < 4 sigma, else 0
          with c = (8 sqrt 2/15) pi 0.04^2 sqrt(0.01) E' 2 b L
    F_N = V_s L/h_c int_{-b}^{b} eta0 (1 + alpha p/16)^16 dx,
          p = p_max cos(phi), x = b sin(phi), 16-point Gauss-Legendre in phi
    F_t = 0.08 W tanh(F_N/(0.08 W)) + 0.2 W_a tanh(V_s/0.01 m/s)
    F_r = 4.318 (G U)^0.658 W*^0.0126 L R/alpha
    T_B = 0.0015 W r_p tanh(omega_R/(1 rad/s))
    I_R domega_R/dt = (F_t - F_r) r_R - T_B
    dloss/dt        = F_t V_s + T_B omega_R

Start at theta = -180 deg with omega_R = omega (M - r_R)/r_R and loss = 0; wanted is the loss after two cycles [J].  The
fastest decay is the largest r_R dF_t/dV_s times r_R/I_R met on the way.

Cases: a) 0.01 Pa s, 300 rev/min; b) 0.0305 Pa s, 600 rev/min; c) 0.15 Pa s, 900 rev/min. The lift has an edge at
+-70 deg and the load's blending one where l = 1e-4 m: stop there. Integrators that may choose their steps freely
jump whole events, because the roller is steady on the base circle.
"""
import math

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import contact_laws as laws
from mechanism import closed_form, thesis_geometry

CASES = {'a': (0.01, 300.0), 'b': (0.0305, 600.0), 'c': (0.15, 900.0)}
GEOMETRY = thesis_geometry()
WIDTH, ALPHA, SIGMA = 0.0137, 2.2e-8, 0.14e-6 * math.sqrt(2)
MODULUS = laws.reduced_modulus(170e9, 0.28, 204e9, 0.29)
INNER = GEOMETRY.r_R - 0.0024
INERTIA = 0.5 * 0.0088 * (GEOMETRY.r_R**2 + INNER**2)
NODES, WEIGHTS = np.polynomial.legendre.leggauss(16)
COSINES = np.cos(0.5 * math.pi * NODES)
WEIGHTED = 0.5 * math.pi * WEIGHTS * COSINES


def load(k, omega):
    """Contact load, blended from the adjuster's 64 N into the event's."""
    event = ((25000.0 * (k.l + 0.0084) + 0.0432 * omega**2 * k.l2) * k.B_s
             + 0.0418 * GEOMETRY.B**2 * omega**2 * k.gamma2) / k.h_W
    s = min(k.l / 1e-4, 1.0)
    return max(64.0 + s * s * (3 - 2 * s) * (event - 64.0), 0.0)


def forces(k, W, eta0, omega, omega_R):
    """Sliding speed, traction, rolling resistance, needle torque."""
    R, r_R = k.R, GEOMETRY.r_R
    V_s = omega * k.V_roll - r_R * omega_R
    V_e = max(abs(omega * k.V_c - 0.5 * V_s), 1e-6)
    h_m, h_c = laws.film(eta0, V_e, ALPHA, MODULUS, R, W, WIDTH)
    b, p_max = laws.hertz(W, R, WIDTH, MODULUS)
    c = 8 * math.sqrt(2) / 15 * math.pi * 0.04**2 * math.sqrt(0.01) * MODULUS * 2 * b * WIDTH
    W_a = min(c * 4.4086e-5 * max(4 - h_m / SIGMA, 0.0)**6.804, W)
    F_N = V_s * WIDTH / h_c * b * float(WEIGHTED @ laws.cameron(eta0, ALPHA, p_max * COSINES))
    F_t = 0.08 * W * math.tanh(F_N / (0.08 * W)) + 0.2 * W_a * math.tanh(V_s / 0.01)
    F_r = laws.rolling_goksem(eta0, V_e, ALPHA, MODULUS, R, W, WIDTH)
    return V_s, F_t, F_r, 0.0015 * W * (INNER - 0.00099) * math.tanh(omega_R)


def rates(theta, y, eta0, omega):
    """d/dtheta of the roller's spin and of the loss."""
    k = closed_form(GEOMETRY, theta)
    W = load(k, omega)
    V_s, F_t, F_r, T_B = forces(k, W, eta0, omega, y[0])
    return np.array([((F_t - F_r) * GEOMETRY.r_R - T_B) / INERTIA, F_t * V_s + T_B * y[0]]) / omega


def jacobian(theta, y, eta0, omega):
    step = 1e-6 * 1e-2 * omega
    change = (rates(theta, [y[0] + step, 0], eta0, omega) - rates(theta, [y[0] - step, 0], eta0, omega)) / (2 * step)
    return np.array([[change[0], 0.0], [change[1], 0.0]])


def loss(case, method='Radau', rtol=1e-9):
    """Loss over two cycles [J] and the fastest decay [1/s] met at the accepted steps."""
    eta0, rpm = CASES[case]
    omega, turn = rpm * math.pi / 30, 2 * math.pi
    edge = GEOMETRY.lift.half_angle
    blend = brentq(lambda a: GEOMETRY.lift(a) - 1e-4, 0.0, edge, xtol=1e-15)
    once = [-math.pi, -edge, -blend, 0.0, blend, edge]
    knots = once + [a + turn for a in once] + [math.pi + turn]
    y = np.array([omega * closed_form(GEOMETRY, -math.pi).V_roll / GEOMETRY.r_R, 0.0])
    decay = 0.0
    for begin, end in zip(knots[:-1], knots[1:]):
        shift = 0.0 if end <= math.pi else turn                # the lift law does not repeat itself
        run = solve_ivp(rates, (begin - shift, end - shift), y, method=method, jac=jacobian, args=(eta0, omega),
                        rtol=rtol, atol=[rtol * 1e-3 * omega, rtol * 1e-3], max_step=math.radians(2), first_step=1e-7)
        if not run.success:
            raise ArithmeticError(run.message)
        y = run.y[:, -1]
        decay = max([decay] + [-jacobian(t, run.y[:, i], eta0, omega)[0, 0] * omega for i, t in enumerate(run.t)][::5])
    return y[1], decay


def write(path):
    with open(path, 'w', encoding='ascii') as file:
        file.write('# Spin problem of test/reference/roller_problem_reference.py: loss over two cycles, fastest decay\n'
                   '# Radau with relative tolerance 1e-10 and edges as stops; LSODA agrees to 1e-9.\n'
                   'case,viscosity_pa_s,speed_rpm,loss_j,fastest_decay_1_s\n')
        for case, (eta0, rpm) in CASES.items():
            value, decay = loss(case, rtol=1e-10)
            file.write(f'{case},{eta0!r},{rpm!r},{value:.12e},{decay:.2e}\n')


if __name__ == '__main__':
    for name in CASES:
        print(name, *(f'{x:.12e}' for x in loss(name)))
