"""An engine that drives its valve trains, from Python: sixteen followers on two camshafts, one step for each two degrees of crank
angle, with the pressure of the cylinders from here. It needs the wheel of camroller alone.

    python engine_host.py engine.nml
"""

import math
import sys

import camroller

CYCLE = 4 * math.pi
FIRING_ORDER = [1, 3, 4, 2]
STEP = math.radians(2)


# %% The host: speed and pressure over the crank angle [rad]
def cam_angle(crank):
    """The first cam has full lift 470 degrees after the firing dead centre of cylinder 1."""
    return math.pi + 0.5 * (crank - math.radians(470))


def inputs(crank):
    """2000 rev/min of the crank with the ripple of four cylinders."""
    return camroller.Inputs(speed=2000 * math.pi / 60 * (1 - 0.02 * math.cos(2 * crank)), oil_temperature=363.15)


def cylinder_pressure(crank):
    """Gauge pressure at the crank angle after the firing dead centre of a cylinder [Pa]."""
    angle = (crank + CYCLE / 2) % CYCLE - CYCLE / 2
    if abs(angle) >= math.pi:
        return 0.0
    volume = 0.1 + 0.45 * (1 - math.cos(angle))
    burnt = 0.5 * (1 + math.tanh((angle - math.radians(12)) / math.radians(10)))
    return 1e5 * (volume**-1.32 * (1 + 1.5 * burnt * (1 + math.cos(angle))) - 1)


def pressures(crank):
    """At the valve of each cam: two cams for each cylinder on each of two camshafts."""
    return [cylinder_pressure(crank - FIRING_ORDER.index(cam // 2 % 4 + 1) * CYCLE / 4) for cam in range(16)]


# %% One cycle
case = camroller.Case(sys.argv[1])
shaft = camroller.Shaft(case, cam_angle(0.0), threads=2)
steps = round(CYCLE / STEP)
mean = 0.0
for i in range(steps):
    begin, end = i * STEP, (i + 1) * STEP
    outcome = shaft.step(cam_angle(end), inputs(begin), inputs(end), [pressures(begin), pressures(end)])
    mean += outcome.mean_torque_friction / steps
print(f"friction {mean:.6f} N m, of which bearings at the end {outcome.torque_bearings:.6f} N m")
print(f"cam 9 at the end: {shaft.value('contact_load', cam=9):.1f} N, film {shaft.value('film_thickness_min', cam=9) * 1e9:.0f} nm")

# %% The periodic cycle without pressure
print(f"run of the case: friction {case.run().scalars['mean_torque_friction']:.6f} N m")
