"""Shared by all Python tests: the program under test."""

import os
import pathlib

import pytest

ROOT = pathlib.Path(__file__).resolve().parent.parent


@pytest.fixture(scope="session")
def camroller() -> str:
    """Path of the program: from the environment variable CAMROLLER, else the optimised build."""
    path = pathlib.Path(os.environ.get("CAMROLLER", ROOT / "build/release/bin/camroller"))
    assert path.is_file(), f"{path} is missing: `make build` or `make test`"
    return str(path)


def pytest_collection_modifyitems(items):
    """Mark what starts the program, so that it can be repeated with the other build."""
    for item in items:
        if "camroller" in getattr(item, "fixturenames", ()):
            item.add_marker("program")
