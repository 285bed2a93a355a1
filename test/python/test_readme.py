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
    """The numbers of a row of a table; a range is two."""
    return [float(number) for cell in row.strip('| ').split('|') for number in cell.split(' to ')]


def compare(name, fresh):
    """The table of that name in the README beside the program's."""
    text = (ROOT / 'README.md').read_text()
    shown = re.search(rf'<!-- {name}: .*?-->\n(.*?)\n<!-- end of {name} -->', text, re.S).group(1).splitlines()
    assert shown[:2] == fresh[:2]
    assert len(shown) == len(fresh)
    for old, new in zip(shown[2:], fresh[2:]):
        for a, b in zip(numbers(old), numbers(new), strict=True):
            # three figures are shown: one unit of the last may turn with the last bits of another machine
            assert abs(a - b) <= 1.01e-2 * abs(b), (old, new)


def test_table_is_what_the_reference_deck_gives(camroller, tmp_path):
    result = tmp_path / 'thesis.h5'
    subprocess.run([camroller, 'run', ROOT / 'decks' / 'thesis.nml', '-o', result, '--quiet'], check=True)
    compare('table', table_of(read_result(result)).splitlines())


def test_ranges_over_film_laws_are_what_the_program_gives(camroller, tmp_path):
    result = tmp_path / 'laws.h5'
    laws = re.search(r'--set "(sweep.values_3=.*?)"', (ROOT / 'README.md').read_text())[1]
    subprocess.run([camroller, 'run', ROOT / 'decks' / 'thesis.nml', '-o', result, '--quiet', '--set', 'sweep.key_3=film.law',
                    '--set', laws], check=True)
    compare('laws', table_of(read_result(result), ['mean_torque_friction', 'mean_slip_ratio', 'min_film_thickness_min'],
                             over=['film.law'], take='range').splitlines())
