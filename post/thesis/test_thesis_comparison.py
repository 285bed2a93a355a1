"""The page that compares with the source thesis: it is what fresh runs give, and every difference has its reason."""

import os
import pathlib
import re
import subprocess
import sys

import numpy
import pytest

from comparison_claims import STATEMENTS, band, falls, rises, verdict
from comparison_reasons import REASONS, UNEXPLAINED
from comparison_runs import RUNS, Points, command_lines
from units import significant

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "doc/thesis_comparison.md"
SCRIPT = ROOT / "post/thesis/thesis_comparison.py"
UNTESTED = "## The source's step"  # chatter: another number with every rounding
NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d+)?")


def checked_part(text):
    """The page up to the part whose numbers are of no use."""
    assert text.count(UNTESTED) == 1
    return text[:text.index(UNTESTED)]


def digit(number):
    """One in the last printed digit."""
    return 10.0 ** -len(number.partition(".")[2])


def differences(text, other):
    """Lines that differ in words, or in a number by more than one in the last digit printed."""
    lines, others = text.splitlines(), other.splitlines()
    if len(lines) != len(others):
        return [f"{len(lines)} and {len(others)} lines"]
    found = []
    for line, beside in zip(lines, others):
        pairs = zip(NUMBER.findall(line), NUMBER.findall(beside))
        if NUMBER.sub("#", line) != NUMBER.sub("#", beside) or any(
                abs(float(one) - float(two)) > 1.001 * max(digit(one), digit(two)) for one, two in pairs):
            found.append(f"{line}\n{beside}")
    return found


@pytest.fixture(scope="module")
def fresh(tmp_path_factory):
    """The page from runs made now, with the optimised program only: other tests compare both programs."""
    program = os.environ.get("CAMROLLER", str(ROOT / "build/release/bin/camroller"))
    assert pathlib.Path(program).is_file(), f"{program} is missing: `make build` or `make test`"
    folder = tmp_path_factory.mktemp("comparison")
    for line in command_lines():
        name, *arguments = line.split()
        done = subprocess.run([program, "run", *arguments, "-o", str(folder / f"{name}.h5"), "--quiet"], cwd=ROOT,
                              capture_output=True, text=True, stdin=subprocess.DEVNULL, timeout=300)
        assert done.returncode == 0, f"{line}: {done.stderr}"
    page = folder / "page.md"
    done = subprocess.run([sys.executable, SCRIPT, folder, "--page", page], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    return page.read_text(encoding="utf-8")


def test_page_is_what_fresh_runs_give(fresh):
    found = differences(checked_part(PAGE.read_text(encoding="utf-8")), checked_part(fresh))
    assert not found, "`make comparison` and look at what changed:\n" + "\n".join(found)


def test_every_difference_has_its_reason(fresh):
    assert UNEXPLAINED not in fresh


def test_every_statement_has_its_verdict(fresh):
    for number, statement in enumerate(STATEMENTS, 1):
        section = fresh.split(f"## {number}. {statement.title}\n")[1].split("\n## ")[0]
        assert re.search(r"^Verdict: `thesis.nml` (agrees|partly|differs), "
                         r"`thesis_source.nml` (agrees|partly|differs)\.$", section, re.M), statement.title
        assert ("**no**" in section) == ("Why:" in section), statement.title
    assert len(STATEMENTS) == 12


def test_reasons_and_runs_name_what_exists():
    names = [claim.name for statement in STATEMENTS for claim in statement.claims]
    assert len(set(names)) == len(names)
    assert {claim for claim, _ in REASONS} <= set(names)
    assert {deck for _, deck in REASONS} <= {"thesis", "thesis_source", "both"}
    assert len({run.name for run in RUNS}) == len(RUNS)
    assert all((ROOT / f"decks/{run.deck}.nml").is_file() for run in RUNS)


def test_figures_of_the_page_exist_and_are_small():
    figures = re.findall(r"!\[[^]]*\]\(([^)]*)\)", PAGE.read_text(encoding="utf-8"))
    assert figures
    for figure in figures:
        assert (PAGE.parent / figure).stat().st_size < 150_000, figure
    assert (PAGE.parent / "figures/thesis_overview.png").stat().st_size < 300_000


@pytest.mark.parametrize("text, other, differ", [
    ("0.650 GPa", "0.651 GPa", False), ("0.650 GPa", "0.652 GPa", True), ("yes: 188", "no: 188", True),
    ("188 N", "189 N", False), ("188 N", "190 N", True), ("0.0999", "0.100", False), ("a", "a\nb", True),
    ("-0.5 to +0.2 %", "0.5 to +0.2 %", True)])
def test_one_in_the_last_digit_is_let_pass_and_two_are_not(text, other, differ):
    assert bool(differences(text, other)) == differ


def test_verdict_follows_from_the_claims():
    assert [verdict(held) for held in ([True, True], [True, False], [False, False])] == ["agrees", "partly", "differs"]


class MadeUp:
    """Points whose share of asperities is the same at each speed and temperature."""

    def __init__(self, share):
        self.angle = numpy.arange(0.0, 360.0, 0.5)
        self._share = numpy.broadcast_to(share(self.angle - 180.0), (3, 3, self.angle.size))

    def series(self, name):
        """The share."""
        assert name == "asperity_friction_share"
        return self._share

    within = Points.within


def bump(height, place, width):
    """A share with one peak."""
    return lambda angle: height * numpy.exp(-((angle - place) / width) ** 2)


@pytest.mark.parametrize("share, shape, value", [
    (bump(0.60, 0.0, 20.0), True, True),
    (bump(0.60, 10.0, 20.0), True, False),
    # largest near the nose 60 %, but on the way down from a peak on a flank
    (lambda angle: numpy.clip(0.5 - 0.1 / 15.0 * angle, 0.0, 0.67), False, True),
    (lambda angle: 0.55 + 0.05 * numpy.cos(numpy.radians(angle)), False, True),
    (bump(0.60, 40.0, 20.0), False, False)])
def test_the_share_of_asperities_has_to_have_the_shape_that_the_source_shows(share, shape, value):
    claims = {claim.name: claim for statement in STATEMENTS for claim in statement.claims}
    points = MadeUp(share)
    assert claims["share_shape_60"].check(points)[0] == claims["share_shape_95"].check(points)[0] == shape
    assert claims["share_60"].check(points)[0] == value


@pytest.mark.parametrize("contact, holds", [(1.2, True), (0.8, True), (1.05, False)])
def test_the_change_by_sliding_and_asperities_is_one_of_rolling_friction(contact, holds):
    claims = {claim.name: claim for statement in STATEMENTS for claim in statement.claims}
    points = MadeUp(lambda angle: angle)
    forces = {"mean_friction_contact": numpy.full((3, 3), contact), "mean_friction_rolling": numpy.ones((3, 3))}
    points.scalar = forces.get
    assert claims["contact_change"].check(points)[0] == holds


def test_trends_are_strict():
    assert rises([[1.0], [2.0]]) and not rises([[1.0], [1.0]]) and not rises([[1.0, 2.0], [2.0, 1.0]])
    assert falls([[2.0], [1.0]]) and not falls([[1.0], [1.0]])


def test_numbers_have_so_many_digits():
    assert [significant(value) for value in (0.0, 0.00123456, 12.3456, 1234.56, -0.5)] == \
        ["0", "0.00123", "12.3", "1230", "-0.500"]
    assert band([0.002, 0.001], 1e3, 2) == "1.0 to 2.0"


def test_a_missing_file_is_told_in_a_line(tmp_path):
    done = subprocess.run([sys.executable, SCRIPT, tmp_path, "--page", tmp_path / "page.md"], capture_output=True,
                          text=True, timeout=60)
    assert (done.returncode, done.stdout) == (2, "")
    assert re.fullmatch(r"thesis_comparison.py: .*no such file\n", done.stderr)
    assert not (tmp_path / "page.md").exists()
