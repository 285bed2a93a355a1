#!/usr/bin/env python3
"""Print a table of a result file: one row a case, in Markdown.

Usage: post/table.py FILE [--columns NAME,NAME,...]

Columns are swept keys first, then scalars of the summary: by default mean friction torque of each source, mean slip ratio, peak
Hertz pressure and smallest film. Three significant figures, engineering units.
"""

from __future__ import annotations

import argparse
import sys

from read import ResultError, read_result

# Scalar of the summary, heading, factor from SI
COLUMNS = [
    ('mean_torque_contact', 'contact [N mm]', 1e3),
    ('mean_torque_needle', 'roller bearing [N mm]', 1e3),
    ('mean_torque_guide', 'guide [N mm]', 1e3),
    ('mean_torque_bearings', 'cam bearings [N mm]', 1e3),
    ('mean_torque_friction', 'all friction [N mm]', 1e3),
    ('mean_slip_ratio', 'mean slip [%]', 1e2),
    ('max_hertz_pressure', 'peak pressure [GPa]', 1e-9),
    ('min_film_thickness_min', 'smallest film [um]', 1e6),
]


def figure(value: float) -> str:
    """Three significant figures without an exponent."""
    text = f'{value:#.3g}'
    return f'{value:.0f}' if 'e' in text else text.rstrip('.')


def plain(value) -> str:
    """A swept value as a deck would have it."""
    return f'{value:g}' if isinstance(value, float) else str(value)


def table_of(result, columns=None) -> str:
    """The table as Markdown."""
    chosen = [c for c in COLUMNS if c[0] in result.summary] if columns is None else [(c, c, 1.0) for c in columns]
    missing = [name for name, _, _ in chosen if name not in result.summary]
    if missing:
        raise ResultError(f'no such scalar in the summary: {", ".join(missing)}')
    keys = list(result.sweep)
    rows = [[key.split('.')[-1] for key in keys] + [heading for _, heading, _ in chosen]]
    rows.append(['---'] * len(rows[0]))
    for case in range(result.cases):
        row = [plain(result.value_of(key, case)) for key in keys]
        rows.append(row + [figure(float(result.summary[name].values[case]) * factor) for name, _, factor in chosen])
    return '\n'.join('| ' + ' | '.join(row) + ' |' for row in rows)


def main(arguments=None) -> int:
    """Command line; returns the exit code."""
    parser = argparse.ArgumentParser(description='print a table of a result file in Markdown')
    parser.add_argument('file')
    parser.add_argument('--columns', help='scalars of the summary, separated by commas, in SI units')
    options = parser.parse_args(arguments)
    try:
        print(table_of(read_result(options.file), options.columns.split(',') if options.columns else None))
    except ResultError as problem:
        print(f'table.py: {problem}', file=sys.stderr)
        return 2
    return 0


if __name__ == '__main__':
    sys.exit(main())
