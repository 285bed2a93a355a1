"""An FMU of the engine's valve trains, driven by FMPy.

    camroller fmu engine.nml -o engine.fmu
    python engine_host_fmu.py engine.fmu
"""

import sys

import fmpy
import numpy

description = fmpy.read_model_description(sys.argv[1])
speed = next(float(variable.start) for variable in description.modelVariables if variable.name == "speed")
turn = 2 * numpy.pi / speed
times = numpy.linspace(0, turn, 361)
ripple = 0.02 * speed * numpy.sin(4 * speed * times)
# the change over a step makes torques follow the speed to second order
slopes = numpy.append(numpy.diff(speed + ripple) / numpy.diff(times), 0.0)
signals = numpy.array(list(zip(times, speed + ripple, slopes)), dtype=[("time", "f8"), ("speed", "f8"), ("speed_slope", "f8")])
result = fmpy.simulate_fmu(sys.argv[1], stop_time=turn, step_size=turn / 360, output_interval=turn / 360, input=signals,
                           output=["mean_torque_friction", "torque_drive", "cam[1].contact_load"])
print(f"friction {numpy.mean(result['mean_torque_friction'][1:]):.6f} N m over a turn, "
      f"largest load {numpy.max(result['cam[1].contact_load']):.0f} N")
