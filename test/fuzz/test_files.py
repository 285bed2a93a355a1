"""A small fixed part of the campaign of damaged files, and that the campaign notices what it is there to notice."""

import dataclasses

import fuzz_files
import pytest
from harness import Ending, campaign

# One of each kind of damage by turns; seeds whose files crashed, hung or passed in silence before they were checked
CASES = 24
SEED = 11


@pytest.fixture(scope="module")
def bases(camroller, tmp_path_factory):
    """The files that are damaged."""
    return fuzz_files.make_bases(camroller, tmp_path_factory.mktemp("bases"))


def test_damaged_files_end_in_words(camroller, bases, tmp_path):
    (tmp_path / "table.nml").write_text(fuzz_files.table_deck())
    tally = campaign(range(CASES), lambda number: fuzz_files.try_file(camroller, bases, number, SEED, tmp_path))
    assert not tally.faults, tally.text()
    kinds = {label.split(",")[0] for label, _ in tally.counts}
    assert kinds >= {"sealed bytes", "bytes", "shape"}
    assert sum(count for (_, kind), count in tally.counts.items() if kind == "6 file") > CASES


def test_other_numbers_in_silence_are_a_fault(bases):
    good = Ending("0 fine", False, 0, 0.1, bases[0].outputs["export"], "")
    other = dataclasses.replace(good, output=good.output.replace("1", "2"))
    assert not fuzz_files.judge(good, "export", "sealed bytes", "", bases[0]).is_fault
    assert fuzz_files.judge(other, "export", "sealed bytes", "", bases[0]).is_fault
    assert fuzz_files.judge(other, "export", "shape", "case: longer", bases[0]).is_fault
    assert not fuzz_files.judge(other, "export", "bytes", "", bases[0]).is_fault
