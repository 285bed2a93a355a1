"""Bearing of the roller: what a run writes against the model computed once more."""

import importlib.util
import pathlib
import subprocess

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
CONSTANTS = {"friction_coefficient": 0.12, "skf_rolling_factor": 2.13e-6, "skf_sliding_factor": 0.0015, "skf_geometry_factor": 6.2,
             "skf_replenishment_factor": 6e-8, "skf_film_coefficient": 0.03}
# of decks/thesis.nml: oil temperatures [degC], viscosities [Pa s]; density [kg/m^3] at 15 degC and expansion [1/K] as they are
# where the deck gives none; inner radius of the roller and radius of a needle [m]
VISCOSITIES, DENSITY, EXPANSION = {25: 0.15, 60: 0.0305, 95: 0.01}, 870.0, 0.00065
INNER, NEEDLE = 8.5e-3 - 2.4e-3, 0.99e-3


def test_needles_by_the_skf_model(camroller, tmp_path):
    """On the base circle, where the finger stands still, so that the spin of the roller is that of its bearing."""
    place = ROOT / "test/reference/skf_reference.py"
    spec = importlib.util.spec_from_file_location(place.stem, place)
    reference = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(reference)
    values = [f"needle_bearing.{key}={value}" for key, value in {"kind": "needles_skf", **CONSTANTS}.items()]
    subprocess.run([camroller, "run", ROOT / "decks/thesis.nml", "--quiet", "-o", tmp_path / "r.h5",
                    *(word for value in values for word in ("--set", value))], check=True)
    with h5py.File(tmp_path / "r.h5") as result:
        angle = result["series/cam_angle"][()]
        base = np.flatnonzero(np.abs(angle - 180) > 80)
        assert base.size > 300
        for case in range(result["series/torque_needle"].shape[0]):
            speed = result["sweep/operating_point.speed_rpm"][case] * np.pi / 30
            temperature = result["sweep/operating_point.oil_temperature_degC"][case]
            viscosity = VISCOSITIES[round(temperature)] / (DENSITY * (1 - EXPANSION * (temperature - 15)))
            for place in base[::20]:
                load, spin, torque = (result[f"series/{name}"][case, place] for name in ("contact_load", "roller_spin", "torque_needle"))
                expected = sum(reference.moments(load, spin, viscosity, INNER, NEEDLE, CONSTANTS["skf_rolling_factor"],
                                                 CONSTANTS["skf_sliding_factor"], CONSTANTS["skf_geometry_factor"],
                                                 CONSTANTS["skf_replenishment_factor"], CONSTANTS["friction_coefficient"],
                                                 CONSTANTS["skf_film_coefficient"]))
                # the sign is whole from a fifth of the cam's speed on; powers of large numbers: a hundred roundings
                assert abs(spin) > 0.2 * speed
                assert np.isclose(torque * speed, expected * abs(spin), rtol=3e-14, atol=0), (case, angle[place])
