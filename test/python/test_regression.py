"""Results of the shipped decks: key results and counters against a stored table, which `make bless` writes anew; extremes against series."""

import csv
import os
import pathlib
import subprocess

import h5py
import numpy
import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
TABLE = ROOT / "test/data/regression.csv"
# A film by numerical solution takes as long as all others together and has tests of its own; as printed, the spring is too weak,
# and rounding decides after how many cycles without contact the roller is periodic
ELSEWHERE = ("numerical_film", "thesis_as_printed")
# Flexible trains take turns from rest on: few cases, and errors that are seen to change all the same. With an adjuster rounding decides
# after how many turns the motion is taken for periodic: at 1e-3 that alone is 1e-3 of an extreme
CHANGES = {deck: ("--set", f"sweep.values_1={speeds}", "--set", f"numerics.tolerance={tolerance}")
           for deck, speeds, tolerance in (("dynamics", "900,2900", "1e-3"), ("lash_adjuster", "900", "1e-4"),
                                          ("flexible_friction", "900", "1e-4"))}
DECKS = sorted(path.stem for path in (ROOT / "decks").glob("*.nml") if path.stem not in ELSEWHERE)
RESULTS = ("mean_torque_drive", "mean_torque_friction", "mean_torque_contact", "min_film_thickness_min",
           "max_hertz_pressure", "max_sliding_speed", "revolution_slip", "dynamic_load_max", "lift_error_min", "seating_speed",
           "joint_force_min", "surge_force", "work_damping", "plunger_lowest", "chamber_pressure_max", "leak_volume")
COUNTERS = ("counter_evaluations", "counter_steps", "counter_rejected", "counter_cycles")
# Five times what the build with run-time checks and the optimised one differ by at most, in the largest sliding speed
RELATIVE = 1.2e-6
# Rounding can decide whether a step is taken; at least, where the builds differ by six rejected steps in a case of sliding joints
COUNTS, LEAST_COUNT = 0.02, 10
# The same for a flexible train, in which rounding decides about steps at impacts: its largest tolerance; half as much again as what the
# builds differ by, a turn more of six
RELATIVE_FLEXIBLE, COUNTS_FLEXIBLE = 1e-3, 0.25
HEADER = """# Key results and counters of the decks in `decks`, one row a quantity and case, in the units of result files.
# Source: this program; written by `make bless`. A change here is a change of results and needs a reason.
"""


@pytest.fixture(scope="module")
def folder(camroller, tmp_path_factory):
    """Result files of all decks."""
    path = tmp_path_factory.mktemp("decks")
    for deck in DECKS:
        subprocess.run([camroller, "run", ROOT / "decks" / f"{deck}.nml", "-o", path / f"{deck}.h5", "--quiet", *CHANGES.get(deck, ())],
                       check=True, capture_output=True)
    return path


def measure(folder):
    """Rows of the table."""
    rows = []
    for deck in DECKS:
        with h5py.File(folder / f"{deck}.h5") as file:
            for name in RESULTS + COUNTERS:
                if name in file["summary"]:
                    rows += [(deck, case, name, float(value)) for case, value in enumerate(file["summary"][name][...].ravel())]
    return rows


def stored():
    """Rows of the stored table."""
    lines = [line for line in TABLE.read_text().splitlines() if not line.startswith("#")]
    return [(row["deck"], int(row["case"]), row["quantity"], float(row["value"])) for row in csv.DictReader(lines)]


def bless(rows):
    """Write the table."""
    lines = [f"{deck},{case},{name},{value:.10g}\n" for deck, case, name, value in rows]
    TABLE.write_text(HEADER + "deck,case,quantity,value\n" + "".join(lines))


def test_results_and_counters_are_those_of_the_table(folder):
    rows = measure(folder)
    if os.environ.get("BLESS"):
        bless(rows)
    known = {row[:3]: row[3] for row in stored()}
    assert set(known) == {row[:3] for row in rows}
    for deck, case, name, value in rows:
        relative, counts = (RELATIVE_FLEXIBLE, COUNTS_FLEXIBLE) if deck in CHANGES else (RELATIVE, COUNTS)
        share = counts if name in COUNTERS else relative
        assert value == pytest.approx(known[deck, case, name], rel=share, abs=LEAST_COUNT if name in COUNTERS else 0), (deck, case, name)


def check_enclosed(path, accuracy):
    """Rows of a series are beyond its extremes by no more than these are said to be off, or the accuracy: over the range of the series,
    of a torque over that of the friction torque at least; films by the rows with contact."""
    with h5py.File(path) as file:
        summary = file["summary"]
        promised = numpy.maximum(summary["estimated_error_of_extremes"][...], accuracy)
        friction = summary["max_torque_friction"][...] - summary["min_torque_friction"][...]
        for name, series in file["series"].items():
            # the energy residual is rounding
            if f"min_{name}" not in summary or name == "energy_residual":
                continue
            low, high = summary[f"min_{name}"][...], summary[f"max_{name}"][...]
            extent = numpy.maximum(high - low, friction if series.attrs["units"] == "N m" else 0)
            allowed = promised * extent + 1e-9 * numpy.maximum(abs(low), abs(high))
            values = series[...]
            with_contact = numpy.where(values > 0, values, numpy.inf) if "film_thickness" in name or name.endswith("film_ratio") else values
            assert (values.max(axis=1) - high <= allowed).all() and (low - with_contact.min(axis=1) <= allowed).all(), name


@pytest.mark.parametrize("deck", DECKS)
def test_extremes_enclose_the_series(folder, deck):
    """By the methods of the decks, which control their errors."""
    check_enclosed(folder / f"{deck}.h5", 1e-3 if deck in CHANGES else 1e-4)


def test_extremes_enclose_the_series_by_steps_of_a_fixed_length(camroller, tmp_path):
    """Extremes are looked for between the points of the means, whatever the method."""
    path = tmp_path / "fixed_steps.h5"
    subprocess.run([camroller, "run", ROOT / "test/data/fixed_steps/deck.nml", "-o", path, "--quiet"], check=True, capture_output=True)
    check_enclosed(path, 1e-4)
