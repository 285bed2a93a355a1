"""One page about a result file, to be sent to a colleague: deck, remarks, table, figures, what was assumed.

    python post/report.py results/thesis.h5                  writes results/thesis.html
    python post/report.py results/thesis.h5 -o report.html

The page needs no other file and no network: figures are in it. Exit code 0 if it was written, 2 if a file cannot be used.
"""

import argparse
import base64
import html
import io
from pathlib import Path
import re
import sys

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams.update({"font.size": 9.0, "axes.spines.top": False, "axes.spines.right": False, "svg.hashsalt": "camroller",
                            "hatch.linewidth": 0.6, "hatch.color": "white"})

import numpy as np  # noqa: E402

from cases import failure_lines, failures, missing_words, status_of  # noqa: E402
from command import script, words_as_they_are, write_text  # noqa: E402
from figures import draw  # noqa: E402
from layout import Layout, TooMany  # noqa: E402
from quantities import Missing  # noqa: E402
from read import opened, read_result, text_of  # noqa: E402
from table import column_of, keys_of, swept_texts, usual_columns, worst_of_lobes  # noqa: E402
from units import key_words, unit_words, with_unit  # noqa: E402

SHOWN = ["mean_torque", "mean_slip", "pressure", "film_ratio", "friction_sources", "drive_torque", "slip",
         "running_in", "train", "dampers", "turns"]  # as far as the file has what they need
MOST_ROWS = 60
NUMBER = re.compile(r"\b(?<!lobe )[-+]?\d[\d.]*(?:e[-+]?\d+)?")  # the number of a lobe tells remarks apart
STYLE = """body { font-family: sans-serif; max-width: 60em; margin: 2em auto; padding: 0 1em; color: #222; }
table { border-collapse: collapse; font-size: 0.9em; } th, td { padding: 0.2em 0.5em; text-align: right; border-bottom: 1px solid #ddd; }
th { vertical-align: bottom; } img { max-width: 100%; } pre { background: #f6f6f6; padding: 1em; overflow-x: auto; font-size: 0.85em; }
td.word, th.word { text-align: left; } figure { margin: 1.5em 0; break-inside: avoid; }
@media print { body { font-size: 0.75em; margin: 0; } }"""


@script
def main(arguments=None):
    """Command line; returns the exit code."""
    options = parser().parse_args(arguments)
    result = read_result(options.file)
    target = Path(options.output) if options.output else result.path.with_suffix(".html")
    result.need_results()
    page = page_of(result)
    write_text(target, page)
    print(f"report: {target}")
    return 0


def parser():
    """Options of the command line."""
    made = argparse.ArgumentParser(prog="report.py", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    made.add_argument("file", metavar="FILE", help="result file")
    made.add_argument("-o", "--output", metavar="PAGE.html", help="page to write (default: the file's name with .html)")
    return made


def page_of(result):
    """The whole page."""
    parts = [("Results", table_of(result)), ("Remarks", remarks_of(result)), ("Figures", figures_of(result)),
             ("What was assumed", defaults_of(result)), ("Deck", deck_of(result)),
             ("How it was made", facts_of(result))]
    body = "\n".join(f"<h2>{title}</h2>\n{text}" for title, text in parts if text)
    title = html.escape(result.title)
    return (f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{title}</title>\n<style>\n{STYLE}\n</style></head>\n'
            f"<body>\n<h1>{title}</h1>\n<p>{html.escape(str(result.path.name))}, {result.cases} "
            f"case{'s' if result.cases > 1 else ''}, camroller {html.escape(result.run.get('version', '?'))}</p>\n{body}\n</body></html>\n")


def rows_to_html(heading, rows, words=0):
    """A table; the first columns hold words."""
    def cells(kind, row):
        marked = (f'<{kind}{" class=word" if place < words else ""}>{html.escape(cell)}</{kind}>' for place, cell in enumerate(row))
        return f"<tr>{''.join(marked)}</tr>"
    return "<table>\n" + "\n".join([cells("th", heading), *(cells("td", row) for row in rows)]) + "\n</table>"


def table_of(result):
    """Mean torques, slip, pressure and film of every case."""
    cases = list(range(min(result.cases, MOST_ROWS)))
    failed = {case for case, _ in result.failed_cases()}
    cases = [case for case in cases if case not in failed]
    units = {key: (result.sweep[key] if key in result.sweep else result.deck[key]).units for key in keys_of(result)}
    columns = [[with_unit(key_words(key, unit), unit_words(unit)), *swept_texts(result, key, cases)] for key, unit in units.items()]
    worst, line = worst_of_lobes(result)
    columns += [column_of(worst, name, [[case] for case in cases], '', words, unit) for name, words, unit in usual_columns(result)]
    text = rows_to_html([column[0] for column in columns], list(zip(*(column[1:] for column in columns))))
    text += f"<p>{line}</p>" if line else ""
    if failed:
        reasons = "; the reasons are among the remarks" if failures(result, range(result.cases)) else ""
        text += f"<p>{', '.join(missing_words(status_of(result)))}{reasons}.</p>"
    return text + (f"<p>and {result.cases - MOST_ROWS} more cases</p>" if result.cases > MOST_ROWS else "")


def remarks_of(result):
    """Remarks on the deck; of the cases, the worst of each kind with the number of cases that have one; failures."""
    with opened(result.path) as file:
        of_deck = [text_of(text) for text in file["deck/remarks"][()]] if "deck/remarks" in file else []
        rows, chosen = (worst_remarks(file["run/remarks"]), "the worst is") if "run/remarks" in file else (first_remarks(file), "first")
    lines = [f"<li>{html.escape(line)}</li>" for line in of_deck]
    for line, case, cases in [row for row in rows if row[0] not in of_deck][:MOST_ROWS]:
        named = case_named(result, case)
        where = "" if result.cases == 1 else f"{named}: " if cases == 1 else f"{cases} of {result.cases} cases, {chosen} {named}: "
        lines.append(f"<li>{html.escape(where + line)}</li>")
    lines += [f"<li>{html.escape(line)}</li>" for line in failure_lines(result, range(result.cases), MOST_ROWS)]
    return f"<ul>\n{chr(10).join(lines)}\n</ul>" if lines else "<p>None.</p>"


def case_named(result, case):
    """A case by its number and what varies: `case 2 (speed 600 rev/min, oil temperature 95 °C)`."""
    varied = [f"{key_words(key, axis.units)} {text} {unit_words(axis.units)}".rstrip() for key, axis in result.sweep.items()
              for text in swept_texts(result, key, [case])]
    return f"case {case} ({', '.join(varied)})" if varied else f"case {case}"


def worst_remarks(group):
    """Text, case and number of cases of the worst remark of each kind, as the program found them."""
    return [(text_of(text), int(case), int(cases)) for text, case, cases in zip(*(group[name][()] for name in ("worst", "worst_case", "cases")))]


def first_remarks(file):
    """The same of files of older programs, which do not tell the worst: the first of those that differ in their numbers only."""
    kinds = {}
    for case, text in enumerate(file["run/warnings"][()] if "run/warnings" in file else []):
        for line in filter(None, map(str.strip, text_of(text).splitlines())):
            kinds.setdefault(NUMBER.sub("#", line), {}).setdefault(case, line)
    return [(*next((line, case) for case, line in found.items()), len(found)) for found in kinds.values()]


def deck_of(result):
    """Text of the deck, below the values that the command gave beside it."""
    with opened(result.path) as file:
        beside = [text_of(text) for text in file["deck/overrides"][()]] if "deck/overrides" in file else []
    given = "<p>Values given beside the deck, in the place of its own:</p>\n<pre>" + html.escape("\n".join(beside)) + "</pre>\n" if beside else ""
    return f"{given}<pre>{html.escape(result.deck_text)}</pre>"


def figures_of(result):
    """Figures that the file has the numbers for, as drawings within the page."""
    layout, found = Layout([result]), []
    for name in SHOWN:
        try:
            figure = draw(name, layout)
        except (Missing, TooMany):
            continue
        drawing = io.BytesIO()
        words_as_they_are(figure)
        figure.savefig(drawing, format="svg", metadata={"Date": None})
        coded = base64.b64encode(drawing.getvalue()).decode()
        found.append(f'<figure><img alt="{name.replace("_", " ")}" src="data:image/svg+xml;base64,{coded}"></figure>')
    return "\n".join(found)


def defaults_of(result):
    """Values that the deck does not give, of keys that are used."""
    with opened(result.path) as file:
        group = file["deck/values"] if "deck/values" in file else {}
        rows = [(key, value_words(data[()]), "" if text_of(data.attrs.get("units", "")) == "1" else text_of(data.attrs["units"]))
                for key, data in group.items() if text_of(data.attrs.get("given", "")) == "default" and text_of(data.attrs.get("used", "")) != "no"]
    return estimates_of(result) + ("<p>Values that the deck does not give and that were taken by default:</p>\n" + rows_to_html(
        ["key", "value", "unit"], rows, words=3) if rows else "")


def value_words(value):
    """A value of the deck: numbers with as many digits as a deck has, whole ones without a point."""
    return f"{value:.15g}" if isinstance(value, np.floating) else text_of(value)


def estimates_of(result):
    """What follows from the kind of oil, and not from its data."""
    words = {key.removeprefix("lubricant."): str(quantity.values) for key, quantity in result.deck.items() if key.startswith("lubricant.")}
    lines = []
    if words.get("sae_grade", "none") != "none" and words.get("temperature_law") == "data_sheet":
        lines.append(f"Viscosity: the middle of the range of SAE grade {words['sae_grade']}, no data of one oil.")
    if words.get("temperature_law") in ("walther", "data_sheet") and not words.keys() & {"pressure_viscosity_coefficient_per_GPa",
                                                                                          "roelands_index"}:
        lines.append("Pressure-viscosity coefficient: estimated by So and Klaus (1980) from viscosity and density.")
    return "".join(f"<p>{html.escape(line)}</p>\n" for line in lines)


def facts_of(result):
    """Program, build, command."""
    return rows_to_html(["fact", "value"], sorted(result.run.items()), words=2)


if __name__ == "__main__":
    sys.exit(main())
