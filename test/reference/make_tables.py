"""Write the reference tables in test/data again: ``python test/reference/make_tables.py`` (two to three minutes)."""
import pathlib
import time

import numpy as np

import bearing_reference
import film_heat_reference
import heat_reference
import joint_reference
import journal_reference
import kinematics_reference
import roller_problem_reference
from cycle_reference import DEGREE, TORQUES, Point, Train, integrate
from mechanism import skewed_geometry

DATA = pathlib.Path(__file__).resolve().parent.parent / 'data'
ANGLES = (-170, -90, -69, -66, -62, -55, -45, -35, -25, -15, -5, 0, 5, 10, 20, 30, 40, 50, 58, 64, 68, 71, 80, 130)
POINTS = {
    'hot_slow': Point(300.0, 0.01),
    'warm': Point(600.0, 0.0305),
    'cold_fast': Point(900.0, 0.15),
    'source_hot_slow': Point(300.0, 0.01, mode='source'),
    'skewed_reversed': Point(600.0, 0.0305, Train(geometry=skewed_geometry(sense=-1))),
}
SERIES = {'load': 'W', 'sliding_speed': 'V_s', 'roller_spin': 'omega_R', 'film_min': 'h_m', 'film_central': 'h_c',
          'asperity_load': 'W_a', 'real_area': 'A_r', 'film_traction': 'F_h', 'boundary_friction': 'F_b',
          'traction': 'F_t', 'rolling_resistance': 'F_r', 'needle_torque': 'T_B'}
HEADER = """\
# Forces and torques of a roller finger follower over its periodic cycle (test/reference/cycle_reference.py), SI units.
# Cases: hot_slow 300 rev/min, 0.01 Pa s; warm 600, 0.0305; cold_fast 900, 0.15; source_hot_slow as hot_slow with the
# thesis's bookkeeping; skewed_reversed as warm with mechanism and lift "skewed" of kinematics_reference.csv, sense -1.
# Input: Islam (2019) Appendix B, with spring 25 000 N/m, guide clearance 0.02e-3 m, lift 9.5 mm (1-x^2)^4, seat
# stiffness 1e7 N/m; no camshaft bearings; surface film strength 0. The script's docstrings list models and options.
# Rolling resistance after Biboulet and Houpert from the film's load W - W_a, in source_hot_slow after Goksem and
# Hargreaves from the whole load W. Angle 0 deg is the nose.
# film_traction is capped at 0.08 W and lacks the factor 1 - A_r/A_a; boundary_friction is all of it, traction holds
# (1 - A_r/A_a) film_traction and what slip mobilises of boundary_friction.
"""


def series_rows(name, point, slips):
    for angle, slip in zip(ANGLES, slips):
        x = point.state(angle * DEGREE, slip)
        values = [getattr(x, key) for key in SERIES.values()] + [getattr(x, key) for key in TORQUES]
        yield ','.join([name, str(angle)] + [f'{value:.12e}' for value in values])


def agreement(first, second):
    """Largest difference of two solutions: sliding speed relative, mean torques relative to the mean drive torque."""
    torque = max(abs(first.means[key] - second.means[key]) for key in TORQUES) / first.means['drive']
    return np.max(np.abs(first.slip / second.slip - 1)), torque


def write_cycles():
    angles = [a * DEGREE for a in ANGLES]
    rows, means, notes = [], [], []
    for name, point in POINTS.items():
        result = integrate(point, angles, 'Radau', 1e-9)
        slip, torque = agreement(result, integrate(point, angles, 'LSODA', 1e-9))
        notes.append(f'# {name}: Radau and LSODA agree to {slip:.0e} in sliding speed, {torque:.0e} in mean torque; '
                     f'end of cycle = start to {result.closure:.0e}\n')
        rows += series_rows(name, point, result.slip)
        means.append(','.join([name] + [f'{value:.12e}' for value in result.means.values()]))
        columns = list(result.means)
    with open(DATA / 'cycle_reference.csv', 'w', encoding='ascii') as file:
        file.write(HEADER + ''.join(notes) + ','.join(['case', 'angle_deg', *SERIES, *TORQUES]) + '\n')
        file.write('\n'.join(rows) + '\n')
    with open(DATA / 'cycle_reference_means.csv', 'w', encoding='ascii') as file:
        file.write('# Means over cam angle for the cases of cycle_reference.csv: torques [N m]; sliding speed over\n'
                   '# the speed of the contact on the cam, and over the pure-rolling speed [-]; roller spin [rad/s].\n')
        file.write(''.join(notes) + ','.join(['case', *columns]) + '\n' + '\n'.join(means) + '\n')


if __name__ == '__main__':
    start = time.time()
    for task in (lambda: kinematics_reference.write(DATA / 'kinematics_reference.csv'),
                 lambda: joint_reference.write(DATA / 'joint_reference.csv'),
                 lambda: bearing_reference.write(DATA / 'bearing_reference.csv'),
                 lambda: journal_reference.write_steady(DATA / 'finite_bearing.csv'),
                 lambda: journal_reference.write(DATA / 'journal_orbit_reference.csv'),
                 lambda: heat_reference.write(DATA / 'heat_reference.csv'),
                 lambda: film_heat_reference.write(DATA / 'film_heat_reference.csv'),
                 lambda: roller_problem_reference.write(DATA / 'roller_problem_reference.csv'), write_cycles):
        task()
        print(f'{time.time() - start:.0f} s')
