"""Direct geometric construction of the finger follower's kinematics in high precision.

Nothing here uses the closed formulas: positions of the roller centre are placed in a frame fixed to the cam, the
contact point is put one roller radius along the normal of the path they trace, and every speed and curvature follows
from those positions by numerical differentiation with mpmath. The cam's own curvature is that of the constructed
profile, the rolling speed comes from equal velocities of the two bodies at the contact.

Sources of what is constructed: Dyson (1980), Tribology International 13, 121-132; Islam (2019),
thesis, equations (1)-(11). Coordinates and the meaning of ``sense`` are those of ``mechanism.py``.
"""
from types import SimpleNamespace

from mpmath import mp, mpf

from mechanism import base_angle, skewed_geometry, thesis_geometry

DIGITS = 50
COLUMNS = ('geometry', 'sense', 'angle_deg', 'lift', 'lift_1', 'lift_2', 'gamma', 'gamma_1', 'gamma_2', 'pitch_speed',
           'pitch_radius', 'cam_radius', 'pitch_curvature', 'cam_curvature', 'equivalent_radius', 'contact_speed',
           'rolling_speed', 'rolling_speed_1', 'arm_normal', 'arm_friction', 'arm_tangent')


def exact(maker, sense):
    """A geometry with mpmath numbers."""
    return maker(number=mpf, sense=sense, degree=mp.pi / 180)


def turn(angle, point):
    """A point turned counter-clockwise about the origin."""
    c, s = mp.cos(angle), mp.sin(angle)
    return c * point[0] - s * point[1], s * point[0] + c * point[1]


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1]


def cross(a, b):
    return a[0] * b[1] - a[1] * b[0]


def difference(a, b):
    return a[0] - b[0], a[1] - b[1]


def rate(path, theta, order=1):
    """Derivative of a plane curve, component by component."""
    return tuple(mp.diff(lambda t, i=i: path(t)[i], theta, order) for i in (0, 1))


class Construction:
    """Moving points of one mechanism; cam speed is one radian per second."""

    def __init__(self, geometry):
        self.geometry = geometry
        self.centre = (geometry.D, mpf(0))
        self.base = base_angle(geometry, mp)
        # The pad moves along the valve; its distance from C across the fixed direction is B cos(gamma + chi).
        self.closed = geometry.B * mp.cos(self.base + geometry.chi)

    def gamma(self, theta):
        """The angle at which the pad has followed the valve by its lift, Islam (6)."""
        across = self.closed - self.geometry.lift(theta)
        return mp.acos(across / self.geometry.B) - self.geometry.chi

    def roller(self, theta):
        """Roller centre in space."""
        s = self.gamma(theta) + self.geometry.lam
        return self.geometry.A * mp.cos(s), self.geometry.A * mp.sin(s)

    def pitch(self, theta):
        """Roller centre in the frame that turns with the cam."""
        return turn(self.geometry.sense * theta, difference(self.roller(theta), self.centre))

    def normal(self, theta):
        """Outward normal of the pitch curve in the cam's frame."""
        velocity = rate(self.pitch, theta)
        speed = mp.sqrt(dot(velocity, velocity))
        sense = self.geometry.sense
        return sense * velocity[1] / speed, -sense * velocity[0] / speed

    def profile(self, theta):
        """Contact point in the cam's frame: it traces the cam's surface."""
        normal, centre = self.normal(theta), self.pitch(theta)
        return tuple(centre[i] - self.geometry.r_R * normal[i] for i in (0, 1))

    def curvature(self, path, theta):
        """Signed curvature of a curve run through in the rolling direction, positive where convex."""
        first, second = rate(path, theta), rate(path, theta, 2)
        return self.geometry.sense * cross(first, second) / mp.sqrt(dot(first, first))**3

    def normal_in_space(self, theta):
        return turn(-self.geometry.sense * theta, self.normal(theta))

    def rolling(self, theta):
        """Roller's absolute spin times its radius when both surfaces move alike at the contact."""
        n = self.normal_in_space(theta)
        t = (self.geometry.sense * n[1], -self.geometry.sense * n[0])
        return dot(difference(self.cam_velocity(theta), rate(self.roller, theta)), t)

    def contact(self, theta):
        """Contact point in space."""
        n, centre = self.normal_in_space(theta), self.roller(theta)
        return tuple(centre[i] - self.geometry.r_R * n[i] for i in (0, 1))

    def cam_velocity(self, theta):
        """Velocity of the cam's material at the contact point, in space."""
        arm = difference(self.contact(theta), self.centre)
        return self.geometry.sense * arm[1], -self.geometry.sense * arm[0]

    def quantities(self, theta):
        """Every kinematic quantity at one cam angle, in the notation of ``mechanism.closed_form``."""
        k, r_R, sense = SimpleNamespace(theta=theta), self.geometry.r_R, self.geometry.sense
        k.l, k.l1, k.l2 = (mp.diff(self.geometry.lift, theta, i) for i in (0, 1, 2))
        k.gamma, k.gamma1, k.gamma2 = (mp.diff(self.gamma, theta, i) for i in (0, 1, 2))
        velocity = rate(self.pitch, theta)
        k.M = mp.sqrt(dot(velocity, velocity))
        k.pitch_curvature = self.curvature(self.pitch, theta)
        k.cam_curvature = self.curvature(self.profile, theta)
        k.R = 1 / (k.cam_curvature + 1 / r_R)
        n = self.normal_in_space(theta)
        t = (sense * n[1], -sense * n[0])
        along = turn(sense * theta, t)                       # the tangent in the cam's frame, against the roller's path
        k.V_c = -dot(rate(self.profile, theta), along)
        k.V_roll = self.rolling(theta)
        k.V_roll1 = mp.diff(self.rolling, theta)
        centre = self.roller(theta)
        opening = (-centre[1], centre[0])                    # velocity of R for a unit opening speed of the finger
        k.h_W, k.h_t = dot(opening, n), sense * dot(opening, t)
        k.h_F = dot(self.cam_velocity(theta), t)
        k.penetration = dot(difference(self.cam_velocity(theta), rate(self.roller, theta)), n)
        k.turning = sense * cross(n, rate(self.normal_in_space, theta))      # of the normal, in the roller's sense
        return k


def angles(sense, half_angle_deg):
    """Cam angles [deg] inside the event and one on the base circle; uneven, so that no symmetry is hit by chance."""
    inside = ['-0.97', '-0.81', '-0.62', '-0.47', '-0.23', '0', '0.19', '0.41', '0.66', '0.87']
    return [mpf('-120')] + [mpf(x) * half_angle_deg for x in inside]


def rows():
    with mp.workdps(DIGITS):
        for name, maker, half_angle in (('thesis', thesis_geometry, 70), ('skewed', skewed_geometry, 55)):
            for sense in (1, -1):
                construction = Construction(exact(maker, sense))
                for angle in angles(sense, half_angle):
                    k = construction.quantities(angle * mp.pi / 180)
                    values = (angle, k.l, k.l1, k.l2, k.gamma, k.gamma1, k.gamma2, k.M, 1 / k.pitch_curvature,
                              1 / k.cam_curvature, k.pitch_curvature, k.cam_curvature, k.R, k.V_c, k.V_roll, k.V_roll1,
                              k.h_W, k.h_F, k.h_t)
                    yield [name, str(sense)] + [mp.nstr(v, 17, min_fixed=0, max_fixed=0) for v in values]


HEADER = """\
# Kinematics of an end-pivoted roller finger follower by direct construction with 50 digits (test/reference).
# Compare: Dyson (1980) Tribology International 13, 121-132; Islam (2019) thesis, equations (1)-(11).
# Lift in m, its derivatives per rad of cam angle; angles gamma in rad; radii and arms in m, curvatures in 1/m;
# speeds divided by the cam speed, in m/rad; _1 and _2 are derivatives with respect to the cam angle (0 deg: nose).
# thesis: A 20.8, B 35.5, D 31.5 mm, lambda -3.5, chi 37.5 deg, r_B 18, r_R 8.5 mm;
#         lift 9.5 mm (1-x^2)^4, x = angle/70 deg
# skewed: A 24, B 42, D 37 mm, lambda 5, chi 30 deg, r_B 17, r_R 9 mm; lift 9 mm (1-x^2)^3 (1+0.1 x), x = angle/55 deg
# sense +1: the cam's surface moves away from the pivot at the contact, g = 1 + gamma_1; sense -1: g = 1 - gamma_1.
# Flanks are nearly straight in places: judge curvatures on the scale 1/r_R, and pitch_radius, cam_radius through them.
"""


def write(path):
    with open(path, 'w', encoding='ascii') as file:
        file.write(HEADER + ','.join(COLUMNS) + '\n')
        for row in rows():
            file.write(','.join(row) + '\n')


if __name__ == '__main__':
    import pathlib
    write(pathlib.Path(__file__).parent.parent / 'data' / 'kinematics_reference.csv')
