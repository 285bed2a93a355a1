"""Friction of the sliding joints of Islam's valve train, from two bodies in motion: slow, plain.

Valve and finger are free bodies. Their accelerations and the speeds at which their surfaces slide over each other are differences of
places in the plane (50 figures, steps of 1e-12 rad); nothing of the arms and speeds of `mechanism.py` is used but its dimensions and
the lift. The forces between them follow from the six equations of Newton and Euler, the finger's taken about its centre of mass:

    valve along its axis, across it, moment about the middle of its tip: tip force, both ends of the guide
    finger in x, in y, moment about its centre of mass: contact load, both parts of the ball's force

Friction acts at each place against the sliding there, with a coefficient of 0.1 (tip), 0.08 (guide's ends), 0.12 (ball) and 8 N at the
seal; its direction is tanh(speed/1 mm/s). The contact of cam and roller has no friction. Inputs beside Islam's Appendix B: stiffness
25 000 N/m, lift 9.5 mm (1 - x^2)^4, seat stiffness 1e7 N/m, finger of 41.8 g with its inertia taken at the pad and its centre of mass
20 mm from the pivot on the roller arm; pad of 8 mm, ball of 5 mm, guide of 36 mm with the tip 25 mm above it, stem's axis 34 mm from the
pivot; 600 rev/min.
"""
import mpmath as mp

from mechanism import base_angle, skewed_geometry, thesis_geometry

mp.mp.dps = 50
MM = mp.mpf(1) / 1000
STIFFNESS, COMPRESSION, BASE_LOAD, SEAT_STIFFNESS = 25000, mp.mpf('8.4') * MM, 64, mp.mpf(10)**7
VALVE_MASS, FINGER_MASS, CENTRE = mp.mpf('0.0432'), mp.mpf('0.0418'), 20 * MM
MU_TIP, MU_GUIDE, MU_BALL, SEAL = mp.mpf('0.1'), mp.mpf('0.08'), mp.mpf('0.12'), 8
PAD, BALL, GUIDE, TIP, STEM = 8 * MM, 5 * MM, 36 * MM, 25 * MM, 34 * MM
REVERSAL = MM
SPEED = 20 * mp.pi
STEP = mp.mpf(10)**-12
DEGREE = mp.pi / 180
ANGLES = (-69.5, -66, -60, -52, -45, -35, -25, -15, -5, -0.2, 0, 0.4, 5, 10, 20, 30, 40, 50, 58, 64, 68, 69.9)
COLUMNS = ('lift', 'lift_slope', 'lift_curvature', 'load', 'tip_force', 'tip_speed', 'tip_friction', 'upper_force', 'lower_force', 'seal_friction', 'guide_friction',
           'pivot_force', 'torque_tip', 'torque_seal', 'torque_guide', 'torque_pivot')


def dot(a, b):
    return mp.re(mp.conj(a) * b)


def cross(a, b):
    return mp.im(mp.conj(a) * b)


def unit(angle):
    return mp.expj(angle)


class Train:
    """Places over the cam angle, x from the pivot to the cam's centre, as complex numbers."""

    def __init__(self, geometry):
        self.g = geometry
        self.up = unit(-geometry.chi)           # along the valve's axis, towards the cam
        self.out = 1j * self.up                 # across it, away from the pivot
        self.gamma_0 = base_angle(geometry, mp)
        roller, pad = self.roller(None), geometry.B * unit(self.gamma_0)
        normal = (roller - geometry.D) / abs(roller - geometry.D)
        self.seat_force = STIFFNESS * COMPRESSION + BASE_LOAD * cross(roller, normal) / cross(pad, self.up)

    def gamma(self, theta):
        """The pad's height along the valve's axis falls by the lift."""
        g = self.g
        return mp.acos(mp.cos(self.gamma_0 + g.chi) - g.lift(theta) / g.B) - g.chi

    def roller(self, theta):
        return self.g.A * unit((self.gamma_0 if theta is None else self.gamma(theta)) + self.g.lam)

    def rate(self, place, theta):
        """Change of a place with time."""
        return (place(theta + STEP) - place(theta - STEP)) / (2 * STEP) * SPEED

    def acceleration(self, place, theta):
        return (place(theta + STEP) - 2 * place(theta) + place(theta - STEP)) / STEP**2 * SPEED**2

    def normal(self, theta):
        """Across the path of the roller's centre as the cam sees it, outwards."""
        def seen(t):
            return unit(self.g.sense * t) * (self.roller(t) - self.g.D)
        along = unit(-self.g.sense * theta) * (seen(theta + STEP) - seen(theta - STEP))
        normal = 1j * along / abs(along)
        return normal if dot(normal, self.roller(theta) - self.g.D) > 0 else -normal

    def touch(self, theta):
        """Contact of pad and tip, as a point of the finger now: it goes with the finger."""
        gamma = self.gamma(theta)
        return lambda t: unit(self.gamma(t) - gamma) * (self.g.B * unit(gamma) - PAD * self.up)

    def forces(self, theta):
        g, up, out = self.g, self.up, self.out
        lift = g.lift(theta)
        seat_lift = 2 * self.seat_force / SEAT_STIFFNESS
        seat = self.seat_force * (1 - lift / seat_lift)**2 if lift < seat_lift else mp.mpf(0)
        valve_speed = self.rate(lambda t: g.lift(t), theta)
        sliding = dot(out, self.rate(self.touch(theta), theta))
        turning = self.rate(lambda t: self.gamma(t), theta)
        tip_way, valve_way, ball_way = (mp.tanh(v / REVERSAL) for v in (sliding, valve_speed, turning * BALL))
        place, centre = self.touch(theta)(theta), CENTRE * unit(self.gamma(theta) + g.lam)
        pull = FINGER_MASS * self.acceleration(lambda t: CENTRE * unit(self.gamma(t) + g.lam), theta)
        spin = (FINGER_MASS * g.B**2 - FINGER_MASS * CENTRE**2) * self.acceleration(self.gamma, theta)
        inertia = VALVE_MASS * self.acceleration(lambda t: g.lift(t), theta)
        offset, height, normal, roller = dot(out, place) - STEM, TIP - lift, self.normal(theta), self.roller(theta)
        # valve with the force F of the finger on its tip, opening positive; friction S = MU_TIP F tip_way outwards
        side = MU_TIP * tip_way
        guide = valve_way * MU_GUIDE * (abs((height + GUIDE) * side + offset) + abs(height * side + offset)) / GUIDE
        force = (STIFFNESS * (lift + COMPRESSION) - seat + inertia + SEAL * valve_way) / (1 - guide)
        lower = (height * side + offset) * force / GUIDE
        upper = -side * force - lower
        # finger: load W along the normal at the roller, ball's force (x, y) at the pivot with its friction moment
        on_pad = force * up - side * force * out
        friction = mp.mpf(0)
        for _ in range(60):
            # x, y and moment about the centre of mass
            matrix = mp.matrix([[mp.re(normal), 1, 0], [mp.im(normal), 0, 1],
                                [cross(roller - centre, normal), mp.im(centre), -mp.re(centre)]])
            right = mp.matrix([mp.re(pull - on_pad), mp.im(pull - on_pad),
                               spin - cross(place - centre, on_pad) + friction])
            load, x, y = mp.lu_solve(matrix, right)
            friction = MU_BALL * BALL * ball_way * mp.hypot(x, y)
        torques = [force * side * sliding / SPEED, SEAL * valve_way * valve_speed / SPEED,
                   guide * force * valve_speed / SPEED, friction * turning / SPEED]
        return [*g.lift.derivatives(theta)[:3], load, force, sliding, side * force, abs(upper), abs(lower), SEAL * valve_way, guide * force, mp.hypot(x, y), *torques]


GEOMETRIES = {'thesis': thesis_geometry, 'skewed': skewed_geometry}


def rows(name, sense):
    train = Train(GEOMETRIES[name](mp.mpf, sense, DEGREE))
    for angle in ANGLES:
        if abs(angle) * DEGREE < train.g.lift.half_angle:
            yield name, sense, angle, train.forces(mp.mpf(angle) * DEGREE)


def write(path):
    with open(path, 'w', encoding='ascii') as file:
        file.write('# Sliding joints of a valve train (test/reference/joint_reference.py), SI units; the script says which inputs.\n')
        file.write(','.join(['case', 'angle_deg', *COLUMNS]) + '\n')
        for name, sense in (('thesis', 1), ('skewed', 1), ('skewed', -1)):
            for _, _, angle, values in rows(name, sense):
                label = name + ('' if sense > 0 else '_reversed')
                file.write(','.join([label, str(angle)] + [mp.nstr(value, 13) for value in values]) + '\n')
