"""Draw result files of camroller.

    python post/plot.py results/thesis.h5                        all figures, beside the file
    python post/plot.py results/thesis.h5 --figure overview      one page with everything
    python post/plot.py a.h5 b.h5 --figure slip --format pdf     two runs in one figure
    python post/plot.py results/thesis.h5 --cases speed_rpm=300,600 --cases oil_temperature=80:100
    python post/plot.py results/thesis.h5 --measured rig.csv   measured points beside the first file, with bias and rms

Needs no display. Colours distinguish the values of the first swept key, panels those of the others;
cases that are no grid (lists side by side, tables, samples) have a label each, and have to be chosen
where they are too many. Families of colours and line styles distinguish files, which are named by the titles
that their decks give, with speed and oil temperature where these differ and no file sweeps them.
A figure whose quantities are not in the files (the effect is not in the case) is left out and a line says so.
A file of a sweep without series has no curves over the cam angle, but bar charts of its means and what happens over hours or turns;
plot_sweep.py draws how any summary answers to what the sweep varies. Exit code 0 if something was
drawn, 2 if a file or an option cannot be used.
"""

import argparse
from pathlib import Path
import sys

import matplotlib

matplotlib.use("Agg")
# Curves of the same file are the same file again: no time stamps, no random names.
matplotlib.rcParams.update({"font.size": 9.0, "axes.spines.top": False, "axes.spines.right": False,
                            "svg.hashsalt": "camroller", "hatch.linewidth": 0.6, "hatch.color": "white"})

from cases import failure_lines, not_computed_words, status_of  # noqa: E402
from command import DPI, script, save_figure  # noqa: E402
from figures import FIGURES, WITHOUT_SERIES, draw  # noqa: E402
from layout import Layout, chosen_cases  # noqa: E402
from measured import case_words, cases_for, compare, draw_comparison, read_table  # noqa: E402
from quantities import Missing  # noqa: E402
from read import ResultError, read_result  # noqa: E402

NO_DATE = {"png": {}, "pdf": {"CreationDate": None}, "svg": {"Date": None}}


@script
def main(arguments=None):
    """Command line; returns the exit code."""
    options = parser().parse_args(arguments)
    results = [read_result(path) for path in options.files]
    if options.measured:
        if options.figure or options.angles:
            raise ResultError("--measured draws a figure of its own, over the whole turn: leave out --figure and --angles")
        return draw_measured(results[0], options)
    layout = Layout(results, options.cases)
    for line in remarks(results, layout):
        print(line)
    folder = Path(options.output) if options.output else results[0].path.parent
    wanted = options.figure or "all"
    names = list(FIGURES) if wanted == "all" else [wanted]
    if not any(result.series for result in results) and wanted == "all":
        print(f"no series in {', '.join(str(result.path) for result in results)}, so no curves are drawn: plot_sweep.py draws "
              "other summaries, and series = 'all' or 'chosen' in &sweep keeps the series")
        names = list(WITHOUT_SERIES)
    drawn = [draw_to_file(name, layout, folder, options) for name in names]
    if not any(drawn):
        print("plot.py: nothing to draw", file=sys.stderr)
        return 2
    return 0


def draw_measured(result, options):
    """Draw measured points beside a result, and print how far they are apart."""
    cases = chosen_cases(result, options.cases)
    if not cases:
        raise ResultError("no case is left to draw: see --cases")
    table = read_table(options.measured)
    cases = cases_for(table, result, cases)
    comparison = compare(table, result, cases)
    folder = Path(options.output) if options.output else result.path.parent
    target = folder / f"{result.path.stem}_measured.{options.format}"
    save_figure(draw_comparison(table, result, cases, comparison), target, dpi=options.dpi, metadata=NO_DATE[options.format])
    print(f"{table.path} less {result.path}{case_words(table, result, cases)}: {comparison.words()}")
    print(f"measured: {target}")
    return 0


def remarks(results, layout):
    """Lines on what is not drawn: cases without a result, of many the first only, and without series."""
    for result, chosen in zip(results, layout.chosen):
        for line in (not_computed_words(status_of(result)), *failure_lines(result, chosen)):
            if line:
                yield f"{result.path}: {line}"
    yield from layout.remarks


def parser():
    """Options of the command line."""
    made = argparse.ArgumentParser(prog="plot.py", description=__doc__,
                                   formatter_class=argparse.RawDescriptionHelpFormatter)
    made.add_argument("files", nargs="+", metavar="FILE", help="result file; several are drawn over each other")
    made.add_argument("--output", metavar="DIR", help="folder for the figures (default: that of the first file)")
    made.add_argument("--format", choices=list(NO_DATE), default="png", help="kind of file (default: png)")
    made.add_argument("--figure", choices=["all", *FIGURES], metavar="NAME",
                      help="which figure: all (default), " + ", ".join(FIGURES))
    made.add_argument("--cases", action="append", default=[], metavar="WHICH",
                      help="only these cases: numbers from 0 as in 0,2-4, values as in speed_rpm=300,600 or a range "
                           "as in speed_rpm=300:600; given more than once, a case must fit all")
    made.add_argument("--measured", metavar="TABLE.csv",
                      help="measured values with a heading as 'cam angle [deg], torque [N m]', 'crank angle [deg], torque [N m]' or "
                           "'speed [rpm], temperature [degC], mean torque [N mm]', columns parted by commas, semicolons or white "
                           "space, crank angles from the firing dead centre of cylinder 1: drawn with the first file, over an "
                           "angle with its first chosen case that has series, operating points with the one chosen case at each; prints "
                           "bias, root mean square and the worst point of measured less computed")
    made.add_argument("--dpi", type=DPI, default=130, help="pixels per inch of a PNG (default: 130)")
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
    save_figure(figure, target, dpi=options.dpi, metadata=NO_DATE[options.format])
    print(f"{name}: {target}")
    return True


def common_name(results):
    """Beginning of the names of the figures, made from those of the files."""
    names = [result.path.stem for result in results]
    return "_vs_".join(names) if len(names) <= 3 else f"{names[0]}_and_{len(names) - 1}_more"


if __name__ == "__main__":
    sys.exit(main())
