#!/usr/bin/env python3
"""Print what heat does to solved contacts, beside the formulas of `&heat`: a table in Markdown, one row a case.

Usage: post/film_heat.py HEATED.h5 ISOTHERMAL.h5
       both from `camroller run` on the same cases with `&ehl profiles = .true.`; the second with `inlet_law` and `contact` of
       `&heat` set to 'none'. A dash where a contact was not solved.
"""

from __future__ import annotations

import argparse
import sys

import numpy as np

from command import script
from ehl import mean_over_dry_contact
from layout import POINT
from read import ResultError, opened
from units import number

HEADINGS = ("speed [rev/min]", "oil [°C]", "mean rise over the dry contact, largest: formulas [K]", "solved [K]", "largest rise, solved [K]",
            "film taken by the inlet's heat, mean and largest: formula [%]", "solved [%]")


def read(path: str) -> dict[str, np.ndarray]:
    """Swept values, and series and planes by case."""
    with opened(path, "a file of solved contacts") as file:
        try:
            data = {name: file[f"ehl/{name}"][:] for name in ("x", "film_central")}
            cases = data["film_central"].shape[0]
            data |= {key.rpartition(".")[2]: np.full(cases, file["deck/values"][key][()]) for key in POINT if key in file.get("deck/values", {})}
            data |= {key.rpartition(".")[2]: values[:] for key, values in file.get("sweep", {}).items()}
            if "film_rise" in file["ehl"]:
                data["solved_rise"] = file["ehl/film_rise"][:]
            for name in ("film_temperature_rise", "inlet_heat_factor"):
                if name in file["series"]:
                    data[name] = file[f"series/{name}"][:]
        except KeyError as missing:
            raise ResultError(f"{path}: no profiles of solved contacts in it") from missing
    return data


def rows(heated: dict[str, np.ndarray], isothermal: dict[str, np.ndarray]) -> list[list[str]]:
    """The table's cells."""
    if not {"solved_rise", "film_temperature_rise", "inlet_heat_factor"} <= set(heated):
        raise ResultError("the first file has no contacts with heat")
    if heated["film_central"].shape != isothermal["film_central"].shape:
        raise ResultError("the files have different cases")
    for key in heated.keys() & isothermal.keys() & {"speed_rpm", "oil_temperature_degC"}:
        if not np.array_equal(heated[key], isothermal[key]):
            raise ResultError(f"the files have different values of {key}")
    table = []
    for case, (warm, cold) in enumerate(zip(heated["film_central"], isothermal["film_central"])):
        row = [number(heated[key][case]) if key in heated else "" for key in ("speed_rpm", "oil_temperature_degC")]
        formula = 100.0 * (1.0 - heated["inlet_heat_factor"][case])
        touching = (warm > 0.0) & (cold > 0.0)  # nowhere where contacts were not solved
        local, mean, taken = "-", "-", "-"
        if touching.any():
            place, rise = heated["x"][case], heated["solved_rise"][case][touching]
            local, mean = number(rise.max()), number(mean_over_dry_contact(place, rise).max())
            taken = mean_and_largest(100.0 * (1.0 - warm[touching] / cold[touching]))
        table.append([*row, number(heated["film_temperature_rise"][case].max()), mean, local, mean_and_largest(formula), taken])
    return table


def mean_and_largest(percent: np.ndarray) -> str:
    """Both, with the digits that tell films apart."""
    return f"{percent.mean():.1f}, {percent.max():.1f}"


@script
def main(arguments=None) -> None:
    """Command line."""
    parser = argparse.ArgumentParser(prog="film_heat.py", description=__doc__.splitlines()[0])
    parser.add_argument("heated")
    parser.add_argument("isothermal")
    options = parser.parse_args(arguments)
    for row in (HEADINGS, ["---"] * len(HEADINGS), *rows(read(options.heated), read(options.isothermal))):
        print("| " + " | ".join(row) + " |")


if __name__ == "__main__":
    sys.exit(main())
