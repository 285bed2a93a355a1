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
    """The numbers of a row of a table as they are printed; a range is two."""
    return [number.strip() for cell in row.strip('| ').split('|') for number in cell.split(' to ')]


def unit_of_last_digit(number):
    """What the last printed digit of a number counts."""
    return 10.0 ** -len(number.partition('.')[2])


def is_same(shown, fresh):
    """Are two numbers as printed the same but for one unit of the last digit, which may turn with the last bits of another machine?"""
    return abs(float(shown) - float(fresh)) <= 1.01 * max(unit_of_last_digit(shown), unit_of_last_digit(fresh))


def compare(name, fresh):
    """The table of that name in the README beside the program's."""
    text = (ROOT / 'README.md').read_text()
    shown = re.search(rf'<!-- {name}: .*?-->\n(.*?)\n<!-- end of {name} -->', text, re.S).group(1).splitlines()
    assert shown[:2] == fresh[:2]
    assert len(shown) == len(fresh)
    for old, new in zip(shown[2:], fresh[2:]):
        assert all(is_same(*pair) for pair in zip(numbers(old), numbers(new), strict=True)), (old, new)


def test_one_unit_of_the_last_digit_is_all_that_may_differ():
    assert is_same('53.3', '53.4') and is_same('0.0999', '0.100') and is_same('9.99', '10.0') and is_same('133', '134')
    assert not (is_same('53.3', '53.5') or is_same('0.0168', '0.0170') or is_same('133', '135'))


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
