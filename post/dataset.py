"""A result file as an xarray dataset whose coordinates are the swept keys.

    from dataset import open_dataset                       # with post/ on the path of Python
    cases = open_dataset("results/sweep.h5")
    cases.mean_slip_ratio.sel(speed_rpm=600)               # of a grid each swept key is a dimension
    cases.mean_slip_ratio.max("speed_rpm")                 # the worst over all speeds

Scalars of the summary and series over the cam angle together, in SI, with units and meanings as attributes. Of a grid each swept key is
a dimension, in the order of its values; of any other set of cases the keys are coordinates along `case`. A key has its last part as its
name, or the whole key where two have the same last part. Columns of a table of cases that hold measured values are variables whose names
begin with `measured_`. What happens over hours of running or from turn to turn has a dimension of its own beside the cases and names
that begin with `running_in_` or `turns_`. Solved contacts (`/ehl`) are not read.
"""

import numpy as np
import xarray

from read import read_result


def open_dataset(path, with_series=True):
    """Read a file; raise ResultError with one line if it is none."""
    result = read_result(path, with_series)
    last = [key.rpartition(".")[2] for key in result.sweep]
    names = {key: name if last.count(name) == 1 else key for key, name in zip(result.sweep, last)}
    groups = [(result.summary, "", ["case"]), (result.series, "", ["case", "cam_angle"]), (result.measured, "measured_", ["case"]),
              (result.history, "running_in_", ["case", "running_time_part"]), (result.turns, "turns_", ["case", "turn"])]
    cases = xarray.Dataset(
        {prefix + name: (dimensions, values, _attributes(quantity))
         for quantities, prefix, dimensions in groups for name, quantity in quantities.items() for values in [quantity.values]
         if np.ndim(values) == len(dimensions) and len(values) == result.cases},
        {names[key]: ("case", quantity.values, _attributes(quantity)) for key, quantity in result.sweep.items()},
        {"title": result.title, "deck": result.deck_text, **result.run})
    if result.series:
        cases = cases.assign_coords(cam_angle=("cam_angle", result.cam_angle, {"units": "degree"}))
    if not names or not result.is_grid():
        return cases.assign_coords(case=np.arange(result.cases))
    return cases.set_index(case=list(names.values())).unstack("case") if len(names) > 1 else \
        cases.swap_dims(case=next(iter(names.values()))).sortby(next(iter(names.values())))


def _attributes(quantity):
    return {name: text for name, text in (("units", quantity.units), ("long_name", quantity.long_name)) if text}
