#!/usr/bin/env python3
"""Print a table of a result file: one row a case, in Markdown.

Usage: post/table.py FILE [--columns NAME,NAME,...] [--cases WHICH]... [--rows N | --all]

Columns are swept keys first, then scalars of the summary: by default mean friction torque of each source, mean slip ratio, peak
Hertz pressure and smallest film. Units stand in the headings and suit the values, rotational speeds are in rev/min; three
significant figures, whole numbers in full. Cases that are no grid, and chosen ones, have their number in the first column. Exit
code 2 where the file or a name cannot be used.
"""

from __future__ import annotations

import argparse
import difflib
import sys

import numpy as np

from command import run, whole_number
from layout import chosen_cases
from read import ResultError, read_result
from units import factor, fitting_unit, number, with_unit

# Scalar of the summary, heading, unit
COLUMNS = [
    ('mean_torque_contact', 'contact', 'N mm'),
    ('mean_torque_needle', 'roller bearing', 'N mm'),
    ('mean_torque_guide', 'guide', 'N mm'),
    ('mean_torque_damping', 'damping', 'N mm'),
    ('mean_torque_bearings', 'cam bearings', 'N mm'),
    ('mean_torque_friction', 'all friction', 'N mm'),
    ('mean_slip_ratio', 'mean slip', '%'),
    ('max_hertz_pressure', 'peak pressure', 'GPa'),
    ('min_film_thickness_min', 'smallest film', 'um'),
]
MOST_ROWS = 50


def plain(value) -> str:
    """A swept value as a deck would have it."""
    return f'{value:g}' if isinstance(value, float) else str(value)


def column_of(result, name, cases, heading=None, unit=None) -> list[str]:
    """Heading and cells of a scalar in the unit given, or in one that suits its values."""
    if name not in result.summary:
        near = difflib.get_close_matches(name, result.summary, 3) or [other for other in result.summary if name in other][:3]
        raise ResultError(f'{result.path}: no scalar {name} in the summary' + (f'; there is {", ".join(near)}' if near else ''))
    quantity = result.scalar(name)
    if quantity.values.dtype.kind not in 'fiu':
        return [heading or name, *(str(quantity.values[case]) for case in cases)]
    values = quantity.values[cases]
    scale = factor(quantity.units, unit) if unit else None
    if scale is None:
        unit, scale = fitting_unit(name, quantity.units, values)
    cells = [str(value) if values.dtype.kind in 'iu' and scale == 1.0 else number(value * scale) for value in values]
    return [with_unit(heading or name, unit), *cells]


def table_of(result, columns=None, selections=(), rows=None) -> str:
    """The table as Markdown, of the first so many rows, and lines on what is not in it."""
    chosen = [c for c in COLUMNS if c[0] in result.summary] if columns is None else [(c, None, None) for c in columns]
    if not chosen:
        raise ResultError(f'{result.path}: none of the usual scalars in the summary; choose with --columns')
    cases = chosen_cases(result, selections)
    if not cases:
        raise ResultError('no case is left: see --cases')
    shown = np.array(cases[:rows])
    last = [key.split('.')[-1] for key in result.sweep]
    made = [['case', *map(str, shown)]] if selections or not result.is_grid() else []
    made += [[name if last.count(name) == 1 else key, *(plain(result.value_of(key, case)) for case in shown)]
             for key, name in zip(result.sweep, last)]
    made += [column_of(result, name, shown, heading, unit) for name, heading, unit in chosen]
    head, *body = (list(row) for row in zip(*made))
    lines = ['| ' + ' | '.join(row) + ' |' for row in (head, ['---'] * len(head), *body)]
    return '\n'.join(lines + left_out(result, cases, len(shown)))


def left_out(result, cases, count) -> list[str]:
    """Lines below the table: how many rows are left out, and which of those shown have no result."""
    lines = []
    if count < len(cases):
        lines.append(f'{len(cases) - count} of {len(cases)} cases are left out: --all prints them, --cases chooses.')
    failed = [(case, reason) for case, reason in result.failed_cases() if case in set(cases[:count])]
    lines += [f'Case {case} has no result: {reason}'.rstrip(': ') for case, reason in failed]
    return [''] + lines if lines else []


def main(arguments=None) -> int:
    """Command line; returns the exit code."""
    parser = argparse.ArgumentParser(prog='table.py', description='print a table of a result file in Markdown')
    parser.add_argument('file')
    parser.add_argument('--columns', help='scalars of the summary, separated by commas')
    parser.add_argument('--cases', action='append', default=[], metavar='WHICH',
                        help='only these cases: numbers from 0 as in 0,2-4, values as in speed_rpm=300,600 or a range as in '
                             'speed_rpm=300:600; given more than once, a case must fit all')
    limit = parser.add_mutually_exclusive_group()
    limit.add_argument('--rows', type=whole_number(1, 10**9), default=MOST_ROWS, help=f'most rows (default: {MOST_ROWS})')
    limit.add_argument('--all', action='store_true', help='all rows')
    options = parser.parse_args(arguments)
    try:
        columns = [name.strip() for name in options.columns.split(',') if name.strip()] if options.columns else None
        result = read_result(options.file, with_series=False)
        print(table_of(result, columns, options.cases, None if options.all else options.rows))
    except ResultError as problem:
        print(f'table.py: {problem}', file=sys.stderr)
        return 2
    return 0


if __name__ == '__main__':
    sys.exit(run(main, 'table.py'))
