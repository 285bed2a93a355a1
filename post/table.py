#!/usr/bin/env python3
"""Print a table of a result file: one row a case, in Markdown.

Usage: post/table.py FILE [--columns NAME,NAME,...] [--cases WHICH]... [--over KEY,... [--take WHAT]] [--rows N | --all]

Columns are speed and oil temperature where these are not swept, swept keys, and scalars of the summary: by default mean friction torque of
each source, mean slip ratio, peak pressure and smallest film, these three of the worst lobe shape where a case has several. The peak
pressure is the largest along the roller where the deck gives its profile, else that of Hertz. Units stand in the headings and suit the
values, rotational speeds are in rev/min; three significant figures, whole numbers in full. With `--over` the cases that differ in these
keys only, as speeds of one design, make one row, with the largest, smallest or mean value of each column, or its range. Cases that are no
grid, and chosen ones, have their number in the first column. Exit code 2 where the file or a name cannot be used.
"""

from __future__ import annotations

import argparse
import dataclasses
import re
import sys

import numpy as np

from cases import failure_lines, lost_contact, lost_contact_words, not_computed, not_computed_words, status_of
from command import ONCE, names_of, script, take_over, whole_number
from layout import POINT, TAKEN, chosen_cases, groups_over, some_numbers
from read import ResultError, read_result
from units import distinct_texts, factor, fitting_unit, number, shaft_words, with_unit

# Scalar of the summary, heading, unit; of scalars with one heading the first that a file has counts
COLUMNS = [
    ('mean_torque_contact', 'contact', 'N mm'),
    ('mean_torque_needle', 'roller bearing', 'N mm'),
    ('mean_torque_guide', 'guide', 'N mm'),
    ('mean_torque_damping', 'damping', 'N mm'),
    ('mean_torque_bearings', 'cam bearings', 'N mm'),
    ('mean_torque_tip', 'valve tip', 'N mm'),
    ('mean_torque_seal', 'stem seal', 'N mm'),
    ('mean_torque_guide_side', 'guide ends', 'N mm'),
    ('mean_torque_pivot', 'pivot', 'N mm'),
    ('mean_torque_needle_drag', 'needle drag', 'N mm'),
    ('mean_torque_shaft_drag', 'seals, drive', 'N mm'),
    ('mean_torque_friction', 'all friction', 'N mm'),
    ('fmep_friction', 'friction mean effective pressure', 'kPa'),
    ('mean_torque_gas_damping', 'gas damping', 'N mm'),
    ('mean_slip_ratio', 'mean slip', '%'),
    ('max_axial_pressure_max', 'peak pressure', 'GPa'),
    ('max_hertz_pressure', 'peak pressure', 'GPa'),
    ('min_film_thickness_axial_min', 'smallest film', 'um'),
    ('min_film_thickness_min', 'smallest film', 'um'),
]
MOST_ROWS = 50
# Statistic and series in the name of a scalar; of another lobe shape than the first the series begins with `lobe_2_`
SCALAR = re.compile(r'(min|max|mean)_(.+)')
RANGE = 'range'


def usual_columns(result):
    """Rows of COLUMNS for the scalars that a result has, each heading once."""
    rows = {}
    for name, heading, unit in COLUMNS:
        if name in result.summary:
            rows.setdefault(heading, (name, heading, unit))
    return list(rows.values())


def keys_of(result) -> list[str]:
    """Speed and oil temperature where these are not swept, and the swept keys."""
    return [*(key for key in POINT if key not in result.sweep and result.value_of(key, 0) is not None), *result.sweep]


def swept_texts(result, key, cases) -> list[str]:
    """Values of a swept key in these cases as a deck would have them, with as many digits as it takes to tell them apart."""
    return distinct_texts([result.value_of(key, case) for case in cases], 6)


def worst_of_lobes(result):
    """The result with the worst of all lobe shapes in the usual scalars, and a line that says so, empty where there is one shape.

    The worst is the smallest of what is smallest, else the largest in magnitude.
    """
    worst, headings = {}, []
    for name, heading, _ in usual_columns(result):
        statistic, series = found.groups() if (found := SCALAR.fullmatch(name)) else ('', '')
        others = [other for other in result.summary if re.fullmatch(rf'{statistic}_lobe_\d+_{series}', other)]
        if not others:
            continue
        values = np.array([result.scalar(each).values for each in (name, *others)])
        place = np.argmin(values, axis=0) if statistic == 'min' else np.argmax(np.abs(values), axis=0)
        worst[name] = dataclasses.replace(result.summary[name], values=np.take_along_axis(values, place[None], 0)[0])
        headings.append(heading)
    line = f'{", ".join(headings)}: the worst of all lobe shapes; scalars of the summary have those of each.' if headings else ''
    return dataclasses.replace(result, summary={**result.summary, **worst}), line


def column_of(result, name, groups, take, heading=None, unit=None) -> list[str]:
    """Heading and cells of a scalar, one for each group of cases, in the unit given, or in one that suits its values."""
    quantity = result.scalar(name)
    if quantity.values.dtype.kind not in 'fiu':
        return [heading or name, *(', '.join(dict.fromkeys(str(value) for value in quantity.values[group])) for group in groups)]
    heading = (heading or name) + shaft_words(result.summary, name, quantity.units)
    if take == RANGE:
        return range_of(heading, quantity, groups, unit)
    # A case without a result, which has no number, leaves its group without one
    values = np.array([TAKEN[take](quantity.values[group]) if take else quantity.values[group[0]] for group in groups])
    scale = factor(quantity.units, unit) if unit else None
    if scale is None:
        unit, scale = fitting_unit(name, quantity.units, values)
    cells = [str(value) if values.dtype.kind in 'iu' and scale == 1.0 else number(value * scale) for value in values]
    return [with_unit(heading, unit), *cells]


def range_of(heading, quantity, groups, unit) -> list[str]:
    """Heading and cells of a scalar as `smallest to largest`."""
    ends = np.array([[np.min(quantity.values[group]), np.max(quantity.values[group])] for group in groups])
    scale = factor(quantity.units, unit) if unit else None
    if scale is None:
        unit, scale = fitting_unit(heading, quantity.units, ends)
    return [with_unit(heading, unit), *('-' if np.isnan(pair).any() else ' to '.join(number(value * scale) for value in pair) for pair in ends)]


def table_of(result, columns=None, selections=(), rows=None, over=(), take='') -> str:
    """The table as Markdown, of the first so many rows, and lines on what is not in it."""
    if columns is None:
        result.need_results()
    usual = {row[0]: row for row in usual_columns(result)}
    result, line = worst_of_lobes(result) if columns is None else (result, '')
    chosen = list(usual.values()) if columns is None else \
        [(name, None, usual[name][2] if take == RANGE and name in usual else None) for name in columns]
    if not chosen:
        raise ResultError(f'{result.path}: none of the usual scalars in the summary; choose with --columns')
    cases = chosen_cases(result, selections)
    if not cases:
        raise ResultError('no case is left: see --cases')
    gone, groups = groups_over(result, cases, over)
    shown = groups[:rows]
    keys = keys_of(result)
    last = [key.split('.')[-1] for key in keys]
    made = [['case', *(str(group[0]) for group in shown)]] if not over and (selections or not result.is_grid()) else []
    made += [[name if last.count(name) == 1 else key, *swept_texts(result, key, [group[0] for group in shown])]
             for key, name in zip(keys, last) if key not in gone]
    if over:
        made.append(['cases', *(str(len(group)) for group in shown)])
        chosen = [(name, f'{take} {heading or name}', unit) for name, heading, unit in chosen]
    made += [column_of(result, name, shown, take if over else '', heading, unit) for name, heading, unit in chosen]
    head, *body = (list(row) for row in zip(*made))
    lines = ['| ' + ' | '.join(row) + ' |' for row in (head, ['---'] * len(head), *body)]
    notes = ([line] if line else []) + left_out(result, groups, len(shown), 'rows' if over else 'cases')
    return '\n'.join(lines + ([''] + notes if notes else []))


def left_out(result, groups, count, what) -> list[str]:
    """Lines below the table: how many cases a partial file does not have, how many rows are left out, and which of the cases in those
    shown have no result or lose contact."""
    lines = [f'{not_computed_words(status_of(result))}: the file is partial.'] if not_computed(result) else []
    if count < len(groups):
        lines.append(f'{len(groups) - count} of {len(groups)} {what} are left out: --all prints them, --cases chooses.')
    shown = {case for group in groups[:count] for case in group} - not_computed(result)
    lines += [line[:1].upper() + line[1:] for line in failure_lines(result, shown)]
    return lines + lost_contact_lines(result, sorted(shown))


def lost_contact_lines(result, cases) -> list[str]:
    """A line that names those of some cases that lose contact; none where there is none."""
    of_lobes = {lobe: is_lost[cases] for lobe, is_lost in lost_contact(result).items()}
    lost = [case for case, *is_lost in zip(cases, *of_lobes.values()) if any(is_lost)]
    which = f' ({some_numbers(lost)})' if len(cases) > 1 else ''
    words = ', '.join(lost_contact_words(of_lobes)).capitalize()
    # a flexible train, which alone has a period, flies and lands as it would
    effect = '' if 'period_cycles' in result.summary else ': loads and friction of a rigid train are not realistic there'
    return [f'{words}{which}{effect}.'] if lost else []


@script
def main(arguments=None) -> int:
    """Command line; returns the exit code."""
    parser = argparse.ArgumentParser(prog='table.py', description='print a table of a result file in Markdown')
    parser.add_argument('file')
    parser.add_argument('--columns', action=ONCE, help='scalars of the summary, separated by commas')
    parser.add_argument('--cases', action='append', default=[], metavar='WHICH',
                        help='only these cases: numbers from 0 as in 0,2-4, values as in speed_rpm=300,600 or a range as in '
                             'speed_rpm=300:600; given more than once, a case must fit all')
    parser.add_argument('--over', action=ONCE, help='swept keys, separated by commas: cases that differ in them only make one row')
    parser.add_argument('--take', choices=[*TAKEN, RANGE], help='with --over: value of a row of several cases (default: largest)')
    limit = parser.add_mutually_exclusive_group()
    limit.add_argument('--rows', type=whole_number(1, 10**9), default=MOST_ROWS, help=f'most rows (default: {MOST_ROWS})')
    limit.add_argument('--all', action='store_true', help='all rows')
    options = parser.parse_args(arguments)
    columns = names_of(options.columns, '--columns')
    over = names_of(options.over, '--over') or ()
    result = read_result(options.file, with_series=False)
    print(table_of(result, columns, options.cases, None if options.all else options.rows, over, take_over(options.take, over)))
    return 0


if __name__ == '__main__':
    sys.exit(main())
