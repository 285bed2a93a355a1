"""Common to all scripts: exit codes, and the writing of files."""

import argparse
import functools
import os
from pathlib import Path
import sys
import tempfile

from matplotlib.text import Text

from read import ResultError

POWER = r"$\mathdefault{"  # begins a number along a logarithmic axis
CLOSED_PIPE = 141  # exit code of a program that a closed pipe ends: 128 and the number of the signal


def script(main):
    """Decorator of the `main` of a script: a closed pipe ends it quietly; what cannot be used, read or written is one line and code 2."""
    @functools.wraps(main)
    def run(arguments=None):
        try:
            code = main(arguments)
            sys.stdout.flush()
        except BrokenPipeError:
            _forget_output()
            return CLOSED_PIPE
        except (ResultError, OSError) as problem:
            _forget_output()
            print(f"{Path(main.__code__.co_filename).name}: {one_line(problem)}", file=sys.stderr)
            return 2
        return code or 0
    return run


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
    words_as_they_are(figure)
    write_file(target, lambda beside: figure.savefig(beside, format=kind, **options))


def words_as_they_are(figure):
    """Let no `$` in titles and values of decks, names of files and the like begin a formula; powers of ten along axes are formulas."""
    for text in figure.findobj(Text):
        if "$" in text.get_text() and not text.get_text().startswith(POWER):
            text.set_parse_math(False)


def write_text(target, text):
    """Write a page or a table, whole or not at all."""
    write_file(target, lambda beside: Path(beside).write_text(text, encoding="utf-8"))


def write_file(target, write):
    """Let `write` write a file under another name beside the target, then give it its name; where that is a link, to what it names.

    A file is replaced only where it is empty or begins as the new one does: a deck, a result or a table that is read is never lost.
    """
    place, beside = Path(os.path.realpath(target)), None
    try:
        if place.parent.exists() and not place.parent.is_dir():
            raise ResultError(f"{target}: cannot be written: {target.parent} is a file and no folder")
        place.parent.mkdir(parents=True, exist_ok=True)
        if place.exists() and not place.is_file():
            raise ResultError(f"{target}: cannot be written: not a regular file")
        handle, beside = tempfile.mkstemp(dir=place.parent, prefix=f".{place.name}.")
        os.close(handle)
        write(beside)
        if place.exists() and _beginning(place) not in (b"", _beginning(beside)):
            raise ResultError(f"{target}: not written: the file there is of another kind; give another name, or remove it first")
        os.chmod(beside, 0o666 & ~_mask())
        os.replace(beside, place)
    except OSError as error:
        raise ResultError(f"{target}: cannot be written: {error.strerror or one_line(error)}") from None
    finally:
        if beside and os.path.exists(beside):
            os.unlink(beside)


def _beginning(path):
    """What tells kinds of files apart: the first line of a text, the first four bytes of anything else."""
    with open(path, "rb") as file:
        start = file.read(200)
    line = start.partition(b"\n")[0]
    return line if line and all(32 <= byte < 127 for byte in line) else start[:4]


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


class ONCE(argparse.Action):
    """An option that lists names and is given once: of several, argparse would take the last in silence."""

    def __call__(self, parser, namespace, values, option_string=None):
        if getattr(namespace, self.dest) is not None:
            parser.error(f"{option_string} is given more than once: list its names in one, separated by commas")
        setattr(namespace, self.dest, values)


def names_of(text, option):
    """Names of a list separated by commas; None where the option is not given."""
    if text is None:
        return None
    names = list(dict.fromkeys(filter(None, map(str.strip, text.split(",")))))
    if not names:
        raise ResultError(f"{option} names nothing: it takes names separated by commas, not '{text}'")
    return names


def take_over(take, over):
    """Value of several cases that count as one, the largest where not given; ResultError where none do."""
    if take and not over:
        raise ResultError(f"--take {take} is of several cases that count as one: give with --over the keys that they differ in")
    return take or "largest"


DPI = whole_number(20, 1200)
