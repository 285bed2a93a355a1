"""Common to all scripts: exit codes, and the writing of files."""

import argparse
import os
from pathlib import Path
import sys
import tempfile

import h5py

from read import ResultError

CLOSED_PIPE = 141  # exit code of a program that a closed pipe ends: 128 and the number of the signal


def run(main, name):
    """Exit code of `main`. A closed pipe ends it quietly; what cannot be used, read or written is one line and code 2."""
    try:
        code = main()
        sys.stdout.flush()
    except BrokenPipeError:
        _forget_output()
        return CLOSED_PIPE
    except (ResultError, OSError) as problem:
        _forget_output()
        print(f"{name}: {one_line(problem)}", file=sys.stderr)
        return 2
    return code


def _forget_output():
    """What is not written yet goes nowhere, so that the interpreter does not complain of it at its end."""
    try:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except (OSError, ValueError):
        pass


def one_line(problem):
    """An exception in one line."""
    return next(iter(str(problem).splitlines()), "") or type(problem).__name__


def save_figure(figure, target, **options):
    """Write a figure, whole or not at all, into a folder that is made where it is not there."""
    target = Path(target)
    kinds = figure.canvas.get_supported_filetypes()
    kind = target.suffix[1:].lower()
    if kind not in kinds:
        raise ResultError(f"{target}: no kind of figure; there is {', '.join('.' + known for known in sorted(kinds))}")
    write_file(target, lambda beside: figure.savefig(beside, format=kind, **options))


def write_file(target, write):
    """Let `write` write a file under another name beside the target, then give it its name."""
    target, beside = Path(target), None
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        if target.exists() and not target.is_file():
            raise ResultError(f"{target}: cannot be written: not a regular file")
        if target.is_file() and h5py.is_hdf5(target):
            raise ResultError(f"{target}: not written: it is an HDF5 file")
        handle, beside = tempfile.mkstemp(dir=target.parent, prefix=f".{target.name}.")
        os.close(handle)
        write(beside)
        os.chmod(beside, 0o666 & ~_mask())
        os.replace(beside, target)
    except OSError as error:
        raise ResultError(f"{target}: cannot be written: {error.strerror or one_line(error)}") from None
    finally:
        if beside and os.path.exists(beside):
            os.unlink(beside)


def _mask():
    """Permissions that new files do not get."""
    mask = os.umask(0)
    os.umask(mask)
    return mask


def whole_number(low, high):
    """Type of an option that takes a whole number within bounds."""
    def check(text):
        try:
            value = int(text)
        except ValueError:
            value = None
        if value is None or not low <= value <= high:
            raise argparse.ArgumentTypeError(f"'{text}' is not a whole number from {low} to {high}")
        return value
    return check


DPI = whole_number(20, 1200)
