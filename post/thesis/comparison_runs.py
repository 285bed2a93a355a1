"""Runs that the comparison with the source thesis is made from, and their values ordered by speed and oil temperature.

Each run is a deck with a few keys set otherwise. `make comparison` makes them; nothing here starts the program.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from read import Result, ResultError, read_result

SPEEDS = (300.0, 600.0, 900.0)  # rev/min of the camshaft
TEMPERATURES = (25.0, 60.0, 95.0)  # degree Celsius
SPEED_KEY = "operating_point.speed_rpm"
TEMPERATURE_KEY = "operating_point.oil_temperature_degC"
OPEN = "case.energy=source"


@dataclass(frozen=True)
class Run:
    """A deck of decks/ with settings; `words` say in the page what is different."""

    name: str
    deck: str
    settings: tuple = ()
    words: str = ""


MAIN = [Run("thesis", "thesis"), Run("thesis_source", "thesis_source"), Run("thesis_as_printed", "thesis_as_printed")]
CHOICES = [
    Run("open_energy", "thesis", (OPEN,), "losses added up as in the source (`energy = 'source'`)"),
    Run("parallel_arm", "thesis", (OPEN, "spring.load_arm=parallel"), "and `load_arm = 'parallel'`"),
    Run("thesis_spin", "thesis", (OPEN, "roller.spin=thesis"), "and `spin = 'thesis'`"),
    Run("full_boundary", "thesis", (OPEN, "asperity.boundary=full"), "and `boundary = 'full'`"),
    Run("goksem_rolling", "thesis", (OPEN, "traction.rolling_law=goksem_hargreaves"),
        "and `rolling_law = 'goksem_hargreaves'`"),
    Run("rolling_apart", "thesis", (OPEN, "traction.in_roller_balance=.false."),
        "and `in_roller_balance = .false.`"),
]
SMOOTH = ("surface.cam_roughness_um=0.099", "surface.roller_roughness_um=0.099")
SMOOTHER = [Run("thesis_smoother", "thesis", SMOOTH), Run("thesis_source_smoother", "thesis_source", SMOOTH)]
# Nothing of it settles: whatever is there after a turn is taken as periodic
FIXED_STEP = Run("fixed_step", "thesis_source",
                 ("numerics.method=euler", "numerics.step_deg=1", "numerics.periodicity=1"))
RUNS = [*MAIN, *CHOICES, *SMOOTHER, FIXED_STEP]


def command_lines():
    """Name of each run and what follows `camroller run` for it."""
    for run in RUNS:
        yield " ".join([run.name, f"decks/{run.deck}.nml", *(f"--set {setting}" for setting in run.settings)])


class Points:
    """The nine operating points of one run: arrays (speed, oil temperature) and (speed, oil temperature, cam angle)."""

    def __init__(self, result: Result):
        failed = result.failed_cases()
        if failed:
            raise ResultError(f"{result.path}: case {failed[0][0]} has no result: {failed[0][1]}")
        places = {(result.value_of(SPEED_KEY, case), result.value_of(TEMPERATURE_KEY, case)): case
                  for case in range(result.cases)}
        try:
            self._cases = np.array([[places[speed, warmth] for warmth in TEMPERATURES] for speed in SPEEDS])
        except KeyError as missing:
            raise ResultError(f"{result.path}: no case at {missing} rev/min and degree Celsius") from None
        self._result = result
        self.angle = result.cam_angle  # degree

    def scalar(self, name):
        """A scalar of the summary, in its SI unit, (speed, oil temperature)."""
        return self._result.summary[name].values[self._cases]

    def series(self, name):
        """A series, in its SI unit, (speed, oil temperature, cam angle)."""
        return self._result.series[name].values[self._cases]

    def within(self, *ranges):
        """Mask of the cam angles inside one of the ranges of degrees, both ends included."""
        return np.any([(self.angle >= low) & (self.angle <= high) for low, high in ranges], axis=0)

    def torque(self, source):
        """Mean torque of one source of friction [N m]."""
        return self.scalar(f"mean_torque_{source}")

    def share(self, source):
        """Part of one source in the mean friction torque [-]."""
        return self.torque(source) / self.torque("friction")


def read_runs(folder):
    """All runs by name; ResultError where one is missing or has failed."""
    return {run.name: Points(read_result(Path(folder) / f"{run.name}.h5")) for run in RUNS}
