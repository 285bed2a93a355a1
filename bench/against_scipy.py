#!/usr/bin/env python3
"""Error and time of scipy's solve_ivp on the compiled right-hand sides: LSODA, BDF and Radau.

Usage: against_scipy.py LIBRARY FOLDER_OF_DECKS SET [TASK...]       lines of a table on the output; SET is roller or trains

Same right-hand side, stops, largest step, allowed error and output angles as in `against_cvode`. Each segment between stops
is one call of solve_ivp, since it knows no stop times. BDF and Radau get the compiled Jacobian of one component and of trains; LSODA is
faster without.
"""

from __future__ import annotations

import ctypes
import math
import platform
import statistics
import sys
import time
import warnings

import numpy as np
import scipy
from scipy.integrate import solve_ivp

SETS = ("roller", "trains")
METHODS = {"roller": ("LSODA", "BDF", "Radau"), "trains": ("LSODA", "Radau")}
TOLERANCES = [10.0**-k for k in range(1, 10)]
RUNS = 3
LARGEST_STEP = math.radians(10.0)
# Processor time of a run beyond which it is not repeated [s]
LONG = 0.03
# Processor time of a run beyond which a method gets no tighter tolerance [s], error below which it gets none either [-]
PATIENCE = {"roller": 0.5, "trains": 5.0}
ENOUGH = 1.0e-8

Reals = ctypes.POINTER(ctypes.c_double)


class Task:
    """One cycle to be computed, as the library holds it."""

    def __init__(self, library: ctypes.CDLL, number: int):
        self.library = library
        self.number = number
        name = ctypes.create_string_buffer(32)
        library.bench_name(ctypes.c_int(number), name)
        self.name = name.value.decode()
        sizes = [ctypes.c_int() for _ in range(3)]
        library.bench_sizes(ctypes.c_int(number), *(ctypes.byref(size) for size in sizes))
        self.components, stops, angles = (size.value for size in sizes)
        self.stops, self.angles = np.empty(stops), np.empty(angles)
        self.first_state, self.scale = np.empty(self.components), np.empty(self.components)
        library.bench_data(ctypes.c_int(number), *(array.ctypes.data_as(Reals) for array in (
            self.stops, self.angles, self.first_state, self.scale)))
        self.calls = 0

    def rate(self):
        """The right-hand side as solve_ivp wants it, with as little Python around it as can be."""
        number = self.number
        if self.components == 1:
            compiled = self.library.bench_rate_1

            def single(angle, state):
                self.calls += 1
                return (compiled(number, angle, state[0]),)
            return single

        compiled = self.library.bench_rate
        room = (ctypes.c_double * self.components)
        state_room, rate_room = room(), room()

        def several(angle, state):
            self.calls += 1
            state_room[:] = state
            compiled(number, angle, state_room, rate_room)
            return rate_room[:]
        return several

    def slope(self):
        """Jacobian."""
        number = self.number
        if self.components == 1:
            compiled = self.library.bench_slope
            return lambda angle, state: np.array([[compiled(number, angle, state[0])]])

        matrix = np.empty((self.components, self.components))

        def several(angle, state):
            self.library.bench_jacobian(ctypes.c_int(number), ctypes.c_double(angle),
                                        np.ascontiguousarray(state).ctypes.data_as(Reals), matrix.ctypes.data_as(Reals))
            return matrix.T.copy()
        return several

    def errors(self, states: np.ndarray) -> tuple[float, float]:
        """Errors of sliding speed and mean loss."""
        flat = np.ascontiguousarray(states.T)
        slip, loss = ctypes.c_double(), ctypes.c_double()
        self.library.bench_errors(ctypes.c_int(self.number), flat.ctypes.data_as(Reals), ctypes.byref(slip), ctypes.byref(loss))
        return slip.value, loss.value


def load(path: str, decks: str, kind: str) -> list[Task]:
    """Tasks of the library."""
    library = ctypes.CDLL(path)
    library.bench_rate_1.restype = library.bench_slope.restype = ctypes.c_double
    library.bench_rate_1.argtypes = library.bench_slope.argtypes = [ctypes.c_int, ctypes.c_double, ctypes.c_double]
    library.bench_rate.argtypes = [ctypes.c_int, ctypes.c_double, Reals, Reals]
    number = library.bench_open(decks.encode(), ctypes.c_int(len(decks)), ctypes.c_int(SETS.index(kind)))
    if number < 0:
        sys.exit("against_scipy: the tasks cannot be made")
    return [Task(library, i) for i in range(number)]


def solve(task: Task, method: str, tolerance: float) -> tuple[np.ndarray, int]:
    """One cycle: states at the output angles, Jacobians."""
    task.library.bench_accuracy(ctypes.c_int(task.number), ctypes.c_double(tolerance))
    states = np.empty((task.components, task.angles.size))
    state, rate = task.first_state, task.rate()
    options = {"jac": task.slope()} if method != "LSODA" and task.components != 2 else {}
    jacobians = begin = 0
    for start, stop in zip(task.stops[:-1], task.stops[1:]):
        end = int(np.searchsorted(task.angles, stop, side="right"))
        wanted = task.angles[begin:end]
        if end == begin or wanted[-1] < stop:
            wanted = np.append(wanted, stop)
        run = solve_ivp(rate, (start, stop), state, method=method, t_eval=wanted, rtol=1e-13, atol=tolerance * task.scale,
                        max_step=LARGEST_STEP, **options)
        if not run.success:
            raise ArithmeticError(run.message)
        states[:, begin:end] = run.y[:, :end - begin]
        state, begin = run.y[:, -1], end
        jacobians += run.njev
    return states, jacobians


def climb(task: Task, method: str, patience: float) -> None:
    """A line for each tolerance."""
    for tolerance in TOLERANCES:
        times = []
        try:
            for _ in range(RUNS):
                task.calls = 0
                start = time.process_time()
                states, jacobians = solve(task, method, tolerance)
                times.append(time.process_time() - start)
                if times[-1] > LONG:
                    break
        except ArithmeticError as error:
            print(f"# failed: {task.name} {method} {tolerance:.2e} {error}")
            continue
        slip, loss = task.errors(states)
        print(f"{task.name:24s} {method:16s}{tolerance:10.2e}{slip:10.2e}{loss:10.2e}{task.calls:9d}{jacobians:7d}{0:8d}{0:8d}"
              f"{1e6 * statistics.median(times):12.2f}{1e6 * min(times):12.2f}", flush=True)
        if times[-1] > patience or max(slip, loss) < ENOUGH:
            break


def main() -> None:
    """Measure all tasks, or those named."""
    library, decks, kind, *names = sys.argv[1:]
    warnings.filterwarnings("ignore", message="At least one element of `rtol`")
    print("# One cycle and its sliding speed at 720 angles by scipy's solve_ivp: error and time over tolerance")
    print(f"# scipy {scipy.__version__}, Python {platform.python_version()}; the right-hand side is compiled")
    print("# task, solver, tolerance [-], error of sliding speed [-], error of mean loss [-], evaluations, Jacobians, -, -, "
          "median time [us], smallest time [us]")
    for task in load(library, decks, kind):
        if not names or any(task.name.startswith(name) for name in names):
            for method in METHODS[kind]:
                climb(task, method, PATIENCE[kind])


if __name__ == "__main__":
    main()
