"""Journals that move in their bearings: Reynolds' equation over the bearing, orbits by another way.

`film_force` solves Reynolds' equation by finite differences with its boundary condition of no negative pressure; the short
bearing's force is integrated numerically over the angle, and its velocity found by a solver of two equations. Orbits are
integrated by scipy's LSODA or Radau from turn to turn. Nothing is shared with the solver. Places in clearances, velocities in
clearances per radian, loads in `eta omega r L (r/c)^2`.
"""
import math

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import fsolve
from scipy.sparse import csr_matrix
from scipy.sparse.linalg import spsolve

# An orbit: L/D, load of a cam and a belt in unit loads, sense of rotation; asperities as stiffness of a made-up law
WIDTH_RATIO = 0.4
ORBITS = {'light': (0.05, 0.02, 1.0), 'medium': (1.5, 0.4, -1.0), 'heavy': (30.0, 6.0, -1.0)}
ANGLES = tuple(range(0, 360, 15))


def film_force(e, direction, width_ratio, around=240, across=14):
    """Load that the film of a bearing carries which is squeezed with velocity 1 at an angle from the line of centres [rad]."""
    theta = np.arange(around) * 2 * math.pi / around
    step, strip = theta[1], 1 / across
    east, west, here = ((1 - e * np.cos(theta + shift))**3 for shift in (step / 2, -step / 2, 0))
    index = np.arange(around * across).reshape(around, across)
    to_east, to_west, to_side = (np.repeat(h[:, None], across, 1) / d**2
                                 for h, d in ((east, step), (west, step), (here / width_ratio**2, strip)))
    inner = to_side.copy()
    inner[:, 0] *= 2                                                                  # the middle of the bearing is a mirror
    entries = [(index, index, to_east + to_west + 2 * to_side), (index, np.roll(index, -1, 0), -to_east),
               (index, np.roll(index, 1, 0), -to_west), (index[:, :-1], index[:, 1:], -inner[:, :-1]),
               (index[:, 1:], index[:, :-1], -to_side[:, 1:])]
    rows, columns, values = (np.concatenate([entry[i].ravel() for entry in entries]) for i in range(3))
    matrix = csr_matrix((values, (rows, columns)))
    squeeze = np.repeat(12 * np.cos(theta - direction)[:, None], across, 1).ravel()
    full = squeeze > 0
    for _ in range(100):
        pressure = np.zeros(index.size)
        inside = np.flatnonzero(full)
        pressure[inside] = spsolve(matrix[inside][:, inside].tocsc(), squeeze[inside])
        now = np.where(full, pressure > 0, matrix @ pressure < squeeze)
        if (now == full).all():
            break
        full = now
    weights = np.ones(across)
    weights[0] = 0.5
    mean = (pressure.reshape(around, across) * weights).sum(1) * strip
    return np.array([(mean * np.cos(theta)).sum(), (mean * np.sin(theta)).sum()]) * step


# Widths over diameter and eccentricities of `steady_load`
STEADY = [(width_ratio, e) for width_ratio in (0.25, 0.5, 0.75, 0.87, 1.0) for e in (0.3, 0.6, 0.9)]


def steady_load(e, width_ratio, around=240, across=14):
    """Load number and attitude angle [rad] of a bearing under a steady load: seen from half the shaft's speed it is squeezed across."""
    force = 0.5 * e * film_force(e, -math.pi / 2, width_ratio, around, across)
    return math.hypot(*force), abs(math.atan2(force[1], force[0]))


def write_steady(path):
    with open(path, 'w', encoding='ascii') as file:
        file.write("# Journal bearings of finite width under a steady load: Reynolds' equation by finite differences, no negative pressure\n"
                   '# (test/reference/journal_reference.py, 480 x 24 over half the width; a grid half as fine differs by up to 0.2 %).\n'
                   'length_over_diameter,eccentricity,load_number,attitude_deg\n')
        for width_ratio, e in STEADY:
            load, attitude = steady_load(e, width_ratio, 480, 24)
            file.write(f'{width_ratio},{e},{load:.6f},{math.degrees(attitude):.3f}\n')


NODES, WEIGHTS = np.polynomial.legendre.leggauss(40)


def short_force(place, velocity, width_ratio):
    """The same for a short bearing, at any place, by Gauss' rule over the half that is squeezed, in pieces about the thinnest film."""
    middle, thinnest = math.atan2(velocity[1], velocity[0]), math.atan2(place[1], place[0])
    ends = [thinnest + turn + piece for turn in (-2 * math.pi, 0, 2 * math.pi) for piece in (-1, -0.3, 0, 0.3, 1)]
    ends = [middle - math.pi / 2] + sorted(x for x in ends if abs(x - middle) < math.pi / 2) + [middle + math.pi / 2]
    low, high = np.array(ends[:-1])[:, None], np.array(ends[1:])[:, None]
    theta, weights = (low + high) / 2 + (high - low) / 2 * NODES, (high - low) / 2 * WEIGHTS
    x, y = np.cos(theta), np.sin(theta)
    pressure = weights * (velocity[0] * x + velocity[1] * y) / (1 - place[0] * x - place[1] * y)**3
    return 4 * width_ratio**2 * np.array([(pressure * x).sum(), (pressure * y).sum()])


def short_velocity(place, load, width_ratio):
    """Velocity of a short bearing's film under a load."""
    size = math.hypot(*load)
    scale = size / math.hypot(*short_force(place, np.array(load) / size, width_ratio))
    found, _, status, message = fsolve(lambda v: (short_force(place, v * scale, width_ratio) - load) / size,
                                       np.array(load) / size, xtol=1e-13, full_output=True)
    assert status == 1 or np.linalg.norm(short_force(place, found * scale, width_ratio) - load) < 1e-9 * size, message
    return found * scale


def fitted_velocity(e, force, width_ratio):
    """Velocity of a bearing of finite width by the fit, from that of the short one; place along the first axis."""
    along = force / np.linalg.norm(force)
    across = np.array([-along[1], along[0]])
    short = short_velocity((e, 0.0), force, width_ratio)
    xi, eta = e * along[0], e * across[0]
    k = np.array([0.50, 0.26]) + np.array([0.28, 0.27]) * xi + np.array([0.56, 0.27]) * eta**2 \
        - np.array([0.25, 0.165]) * width_ratio
    factors = 1 + k * width_ratio**2 / (1 - xi)
    return factors[0] * (short @ along) * along + factors[1] * (short @ across) * across


def turning_load(cam, pull):
    """Load over the angle: a cam that presses for a third of the turn from a direction that swings, a constant pull."""
    def load(angle):
        press = cam * math.exp(-3 * (1 - math.cos(angle)))
        return np.array([press * math.cos(0.4 * math.sin(angle)) + 0.3 * pull, press * math.sin(0.4 * math.sin(angle)) - pull])
    return load


def orbit(name, method='LSODA', tolerance=1e-8):
    """Places at the angles and torques over `eta omega r^3 L/c`, of the periodic orbit in a short bearing."""
    cam, pull, sense = ORBITS[name]
    load = turning_load(cam, pull)

    def rate(angle, place):
        return short_velocity(place, load(angle), WIDTH_RATIO) + 0.5 * sense * np.array([-place[1], place[0]])

    def turn(start, angles=None):
        return solve_ivp(rate, (0, 2 * math.pi), start, method=method, rtol=tolerance, atol=tolerance * 0.01, t_eval=angles)
    start = np.array([0.1, 0.0])
    for _ in range(20):                                  # Newton's method on the turn, by differences
        end = turn(start).y[:, -1]
        if np.linalg.norm(end - start) < 10 * tolerance:
            break
        slope = np.column_stack([(turn(start + 1e-5 * unit).y[:, -1] - end) / 1e-5 for unit in np.eye(2)])
        start = start - np.linalg.solve(slope - np.eye(2), end - start)
    radians = np.radians(ANGLES)
    places = turn(start, radians).y.T
    torques = [2 * math.pi / math.sqrt(1 - p @ p) + load(a) @ short_velocity(p, load(a), WIDTH_RATIO)
               for a, p in zip(radians, places)]
    return places, np.array(torques)


def write(path):
    with open(path, 'w', encoding='ascii') as file:
        file.write('# Periodic orbits of a journal in a short bearing (test/reference/journal_reference.py): load of cam and pull,\n'
                   '# angle, place in clearances, torque over eta omega r^3 L/c. Loads in eta omega r L (r/c)^2, over the angle a:\n'
                   '# P = cam exp(-3 (1 - cos a)), (P cos(0.4 sin a) + 0.3 pull, P sin(0.4 sin a) - pull).\n'
                   f'# L/D {WIDTH_RATIO}; the shaft turns the other way for medium and heavy.\n')
        notes, rows = [], []
        for name, (cam, pull, sense) in ORBITS.items():
            places, torques = orbit(name)
            others, their_torques = orbit(name, 'Radau', 1e-7)
            notes.append(f'# {name}: LSODA and Radau agree to {np.abs(places - others).max():.0e} in place, '
                         f'{np.abs(torques / their_torques - 1).max():.0e} in torque\n')
            rows += [f'{name},{cam},{pull},{sense},{a},{p[0]:.10e},{p[1]:.10e},{t:.10e}\n'
                     for a, p, t in zip(ANGLES, places, torques)]
        file.writelines(notes)
        file.write('orbit,cam,pull,sense,angle,x,y,torque\n')
        file.writelines(rows)
