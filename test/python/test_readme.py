"""The README says what the program gives."""

import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / 'post'))

from read import read_result  # noqa: E402
from table import table_of  # noqa: E402


def numbers(row):
    """The numbers of a row of a table."""
    return [float(cell) for cell in row.strip('| ').split('|')]


def test_table_is_what_the_reference_deck_gives(camroller, tmp_path):
    result = tmp_path / 'thesis.h5'
    subprocess.run([camroller, 'run', ROOT / 'decks' / 'thesis.nml', '-o', result, '--quiet'], check=True)
    fresh = table_of(read_result(result)).splitlines()
    text = (ROOT / 'README.md').read_text()
    shown = re.search(r'<!-- table: .*?-->\n(.*?)\n<!-- end of table -->', text, re.S).group(1).splitlines()
    assert shown[:2] == fresh[:2]
    assert len(shown) == len(fresh)
    for old, new in zip(shown[2:], fresh[2:]):
        for a, b in zip(numbers(old), numbers(new)):
            # three figures are shown: one unit of the last may turn with the last bits of another machine
            assert abs(a - b) <= 1.01e-2 * abs(b), (old, new)
