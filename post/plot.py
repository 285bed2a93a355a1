"""Draw result files of camroller.

    python post/plot.py results/thesis.h5                        all figures, beside the file
    python post/plot.py results/thesis.h5 --figure overview      one page with everything
    python post/plot.py a.h5 b.h5 --figure slip --format pdf     two runs in one figure
    python post/plot.py results/thesis.h5 --cases speed_rpm=300,600 --cases oil_temperature=95

Needs no display. Colours tell the values of the first swept key apart, panels those of the others,
line styles the files, which go by the titles that their decks give. A figure whose quantities are
not in the files (the effect is not in the case) is left out and a line says so. Exit code 0 if
something was drawn, 2 if a file or an option cannot be used.
"""

import argparse
from pathlib import Path
import sys

import matplotlib

matplotlib.use("Agg")
# Curves of the same file are the same file again: no time stamps, no random names.
matplotlib.rcParams.update({"font.size": 9.0, "axes.spines.top": False, "axes.spines.right": False,
                            "svg.hashsalt": "camroller", "hatch.linewidth": 0.6, "hatch.color": "white"})

from figures import FIGURES, draw  # noqa: E402
from layout import Layout  # noqa: E402
from quantities import Missing  # noqa: E402
from read import ResultError, read_result  # noqa: E402

NO_DATE = {"png": {}, "pdf": {"CreationDate": None}, "svg": {"Date": None}}


def main(arguments=None):
    """Command line; returns the exit code."""
    options = parser().parse_args(arguments)
    try:
        results = [read_result(path) for path in options.files]
        layout = Layout(results, options.cases)
        for result in results:
            for case, reason in result.failed_cases():
                print(f"{result.path}: case {case} has no result: {reason}".rstrip(": "))
        folder = Path(options.output) if options.output else results[0].path.parent
        names = list(FIGURES) if options.figure == "all" else [options.figure]
        drawn = [draw_to_file(name, layout, folder, options) for name in names]
    except ResultError as error:
        print(f"plot.py: {error}", file=sys.stderr)
        return 2
    if not any(drawn):
        print("plot.py: nothing to draw", file=sys.stderr)
        return 2
    return 0


def parser():
    """Options of the command line."""
    made = argparse.ArgumentParser(prog="plot.py", description=__doc__,
                                   formatter_class=argparse.RawDescriptionHelpFormatter)
    made.add_argument("files", nargs="+", metavar="FILE", help="result file; several are drawn over each other")
    made.add_argument("--output", metavar="DIR", help="folder for the figures (default: that of the first file)")
    made.add_argument("--format", choices=list(NO_DATE), default="png", help="kind of file (default: png)")
    made.add_argument("--figure", choices=["all", *FIGURES], default="all", metavar="NAME",
                      help="which figure: all (default), " + ", ".join(FIGURES))
    made.add_argument("--cases", action="append", default=[], metavar="WHICH",
                      help="only these cases: numbers from 0 as in 0,2-4 or values as in speed_rpm=300,600; "
                           "given more than once, a case must fit all")
    made.add_argument("--dpi", type=int, default=130, help="pixels per inch of a PNG (default: 130)")
    made.add_argument("--angles", choices=["event", "cycle"],
                      help="cam angles of the single figures: around the valve event or the whole cycle "
                           "(default: what suits the figure)")
    return made


def draw_to_file(name, layout, folder, options):
    """Draw one figure and write it; False, with a line that says why, where there is nothing to draw."""
    try:
        figure = draw(name, layout, None if options.angles is None else options.angles == "cycle")
    except Missing as reason:
        print(f"{name}: skipped, {reason}")
        return False
    target = folder / f"{common_name(layout.results)}_{name}.{options.format}"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        figure.savefig(target, dpi=options.dpi, metadata=NO_DATE[options.format])
    except OSError as error:
        raise ResultError(f"{target}: cannot be written: {error.strerror or error}") from None
    print(f"{name}: {target}")
    return True


def common_name(results):
    """Beginning of the names of the figures, made from those of the files."""
    names = [result.path.stem for result in results]
    return "_vs_".join(names) if len(names) <= 3 else f"{names[0]}_and_{len(names) - 1}_more"


if __name__ == "__main__":
    sys.exit(main())
