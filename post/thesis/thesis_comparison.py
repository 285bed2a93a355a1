"""Compare the results with what the source thesis reports: make `doc/thesis_comparison.md`.

    python post/thesis/thesis_comparison.py --runs                              list the runs, a line each
    python post/thesis/thesis_comparison.py results/comparison --page PAGE.md   write the page from the files of these runs

`make comparison` does both. Verdicts follow from the criteria in comparison_claims.py, numbers from the files, and
reasons are printed where a claim does not hold. Exit code 0, or 2 if a file cannot be used or the page cannot be
written.
"""

import argparse
from pathlib import Path
import sys

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))  # the scripts of all figures and tables

from command import script, write_text
from comparison_claims import STATEMENTS, verdict
from comparison_reasons import reason
from comparison_runs import command_lines, read_runs
from comparison_tables import as_printed, both_decks, each_choice, fixed_step, magnitudes, table

DECKS = ("thesis", "thesis_source")
SHOWN = {"thesis": "`thesis.nml`", "thesis_source": "`thesis_source.nml`", "thesis_smoother":
        "`thesis.nml`, 0.14 µm together",
         "thesis_source_smoother": "`thesis_source.nml`, 0.14 µm together"}
HEAD = """# Comparison with the source

Islam (2019), *Tribological study of friction in roller follower valve train considering effects of asperity
interaction and roller sliding*, chapter 3, makes statements that can be checked; its figures are pictures, so most
of them are trends. Each is split into claims with a criterion, and each claim is checked against two runs:
`thesis.nml`, with a closed energy balance, and `thesis_source.nml`, with the bookkeeping of the source. A statement
*agrees* if all of its claims hold, *differs* if none does, and agrees *partly* otherwise. Nothing is tuned to fit.
`make comparison` makes this page; numbers and verdicts come from the runs.

Flanks are cam angles of 116 to 137 and 222 to 242 degrees, as the source names them; *near the nose* is within 15
degrees of it.
""".splitlines()


@script
def main(arguments=None):
    """Command line; returns the exit code."""
    parser = argparse.ArgumentParser(prog="thesis_comparison.py", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?", help="folder of the result files")
    parser.add_argument("--runs", action="store_true", help="list the runs: name, deck and settings")
    parser.add_argument("--page", help="file to write")
    options = parser.parse_args(arguments)
    if options.runs:
        print("\n".join(command_lines()))
        return 0
    if not options.folder or not options.page:
        parser.error("a folder and --page, or --runs")
    text = "\n".join(page(read_runs(options.folder)))
    write_text(options.page, text)
    return 0


def page(runs):
    """All lines of the page."""
    yield from HEAD
    yield from overview(runs)
    for number, statement in enumerate(STATEMENTS, 1):
        yield from section(number, statement, runs)
    for part in (both_decks, each_choice, magnitudes, as_printed, fixed_step):
        yield from part(runs)


def verdict_of(statement, points):
    """Verdict on one statement for one run."""
    return verdict([claim.check(points)[0] for claim in statement.claims])


def overview(runs):
    """Verdicts on all statements."""
    yield from ["", "## Verdicts", ""]
    yield from table(["", "statement", *SHOWN.values()],
                     [[str(number), statement.title, *(verdict_of(statement, runs[name]) for name in SHOWN)]
                      for number, statement in enumerate(STATEMENTS, 1)])
    yield from ["", "The source does not say whether its roughness of 0.14 µm is that of each surface or of both "
                    "together. The decks take the first; the last two columns take the second.", ""]


def section(number, statement, runs):
    """One statement with its claims, verdicts and reasons."""
    yield from [f"## {number}. {statement.title}", "", f"Source, {statement.source}: {statement.says}", ""]
    rows, reasons = [], {}
    for claim in statement.claims:
        cells = []
        for deck in DECKS:
            holds, numbers = claim.check(runs[deck])
            cells.append(f"{'yes' if holds else '**no**'}: {numbers}")
            if not holds:
                reasons.setdefault((claim.words, reason(claim.name, deck, runs)), []).append(SHOWN[deck])
        rows.append([claim.words, *cells])
    yield from table(["claim", *(SHOWN[deck] for deck in DECKS)], rows)
    verdicts = ", ".join(f"{SHOWN[deck]} {verdict_of(statement, runs[deck])}" for deck in DECKS)
    yield from ["", f"Verdict: {verdicts}.", ""]
    if reasons:
        yield from ["Why:", "",
                    *(f"- *{words}* ({', '.join(decks)}): {text}" for (words, text), decks in reasons.items()),
            ""]


if __name__ == "__main__":
    sys.exit(main())
