"""Shared by the tests of figures: nothing is paid for with each file and picture that no test looks at."""

import contextlib

from matplotlib.figure import Figure
import pytest

MOST_DOTS = 40  # per inch [1/inch]


@pytest.fixture(autouse=True)
def fixture_cheap(monkeypatch):
    """Coarse pictures, and no process that watches each reading, of which there would be thousands: programs that tests start have
    one, and one of them is ended by it."""
    save = Figure.savefig
    monkeypatch.setattr(Figure, "savefig", lambda figure, *words, dpi=MOST_DOTS, **options:
                        save(figure, *words, dpi=min(dpi, MOST_DOTS), **options))
    monkeypatch.setattr("read._time_limit", lambda path: contextlib.nullcontext())
