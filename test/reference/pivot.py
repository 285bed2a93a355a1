"""Speeds at which roller, pivot joint and lash adjuster of Islam's valve train part, from bodies in motion: slow, plain.

Nothing of `mechanism.py` but its dimensions and the lift is used: pad, roller centre and centre of mass are placed as points in the
plane for a cam angle, velocities and accelerations are differences, and the contact's normal is that of the roller centre's path seen
from the cam. Forces follow from the balance of the finger's moments about the pivot and of its momentum along the adjuster's axis,
without friction. Inputs beside Islam's Appendix B: stiffness 25 000 N/m, lift 9.5 mm (1 - x^2)^4, seat stiffness 1e7 N/m, finger of
41.8 g (its inertia taken at the pad), centre of mass 20 mm from the pivot on the roller arm, adjuster parallel to the valve.
"""
import cmath
import math

from mechanism import base_angle, thesis_geometry

STIFFNESS, COMPRESSION, BASE_LOAD, SEAT_STIFFNESS = 25000.0, 0.0084, 64.0, 1e7
VALVE_MASS, FINGER_MASS, CENTRE = 0.0432, 0.0418, 0.020
STEP = 1e-4  # of the differences [rad]
RPM = 30 / math.pi


def dot(a, b):
    """Dot product of vectors written as complex numbers."""
    return (a.conjugate() * b).real


def cross(a, b):
    """Cross product of vectors written as complex numbers."""
    return (a.conjugate() * b).imag


class Bodies:
    """The train at one cam angle: contact load and pivot force as static part and part that goes with the speed squared."""

    def __init__(self, theta, geometry=thesis_geometry(), tilt=0.0):
        self.geometry = geometry
        valve = cmath.exp(-1j * geometry.chi)                      # closing direction of the valve
        axis = cmath.exp(-1j * (geometry.chi + tilt))               # adjuster's axis, towards the cam
        angles = [self.finger(theta + k * STEP) for k in (-1, 0, 1)]
        gamma, acceleration = angles[1], (angles[0] - 2 * angles[1] + angles[2]) / STEP**2
        centres = [CENTRE * cmath.exp(1j * (a + geometry.lam)) for a in angles]
        momentum = FINGER_MASS * dot(axis, centres[0] - 2 * centres[1] + centres[2]) / STEP**2
        roller = geometry.A * cmath.exp(1j * (gamma + geometry.lam))
        seen = [self.from_cam(theta + k * STEP) for k in (-1, 1)]
        along = cmath.exp(-1j * geometry.sense * theta) * (seen[1] - seen[0])
        normal = 1j * along / abs(along)
        if dot(normal, roller - geometry.D) < 0:
            normal = -normal                                        # outwards
        pad = geometry.B * cmath.exp(1j * gamma)
        lifts = [geometry.lift(theta + k * STEP) for k in (-1, 0, 1)]
        self.lift = lifts[1]
        inertia = VALVE_MASS * (lifts[0] - 2 * lifts[1] + lifts[2]) / STEP**2
        arm = cross(roller, normal)                                 # moments that open count positive
        rest = arm_ratio(self, theta)
        seat_force = STIFFNESS * COMPRESSION - BASE_LOAD * rest
        self.seat_lift = 2 * seat_force / SEAT_STIFFNESS
        seat = seat_force * max(0.0, 1 - self.lift / self.seat_lift)**2
        tips = STIFFNESS * (self.lift + COMPRESSION) - seat, inertia
        turns = 0.0, FINGER_MASS * geometry.B**2 * acceleration
        self.load = [(turn - tip * cross(pad, valve)) / arm for tip, turn in zip(tips, turns)]
        self.pivot = [-(load * dot(axis, normal) + tip * dot(axis, valve)) for load, tip in zip(self.load, tips)]
        self.pivot[1] += momentum

    def finger(self, theta):
        """gamma: the pad's height along the valve's axis follows the lift."""
        g = self.geometry
        return math.acos(math.cos(base_angle(g) + g.chi) - g.lift(theta) / g.B) - g.chi

    def from_cam(self, theta):
        """Roller centre in the cam's frame, from the cam's centre."""
        g = self.geometry
        return cmath.exp(1j * g.sense * theta) * (g.A * cmath.exp(1j * (self.finger(theta) + g.lam)) - g.D)


def arm_ratio(bodies, theta):
    """Force on the tip over contact load on the base circle: arms about the pivot, the normal through both centres."""
    g = bodies.geometry
    gamma = base_angle(g)
    roller = g.A * cmath.exp(1j * (gamma + g.lam))
    normal = (roller - g.D) / abs(roller - g.D)
    return -cross(roller, normal) / cross(g.B * cmath.exp(1j * gamma), cmath.exp(-1j * g.chi))


def speeds(points=7001):
    """Cam speeds [rev/min] of lost contact, opened joint and pump-up, and the adjuster's force [N]."""
    adjuster = Bodies(math.pi).pivot[0]
    lowest = [math.inf] * 3
    for i in range(points):
        bodies = Bodies(-1.2 + 2.4 * i / (points - 1))
        if bodies.lift <= bodies.seat_lift:
            continue
        parts = bodies.load, bodies.pivot, (bodies.pivot[0] - adjuster, bodies.pivot[1])
        for k, (static, inertia) in enumerate(parts):
            if inertia < 0:
                lowest[k] = min(lowest[k], math.sqrt(-static / inertia) * RPM)
    return (*lowest, adjuster)


if __name__ == '__main__':
    print('contact lost %.2f, joint opens %.2f, adjuster pumps up %.2f rev/min; adjuster %.4f N' % speeds())
