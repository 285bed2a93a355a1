"""The theory page names procedures, tests and deck keys: they exist."""

import pathlib
import re

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = (ROOT / "doc/theory.md").read_text(encoding="utf-8")


def section(number):
    """Text of a section of the page."""
    return PAGE[PAGE.index(f"\n## {number}. "):PAGE.index(f"\n## {number + 1}. ")]


ROWS = re.findall(r"^\| \((\d+)\) \| (.+) \| (.+) \| (.+) \|$", section(21), re.MULTILINE)
# As `camroller defaults --markdown` prints it, which test_cli.py compares
DECK = (ROOT / "doc/deck.md").read_text(encoding="utf-8")


def squeeze(text):
    """Text of a Fortran file with continued strings and lines joined."""
    return re.sub(r'"\s*(//)?\s*&\s*&?\s*"', "", text)


def test_every_numbered_equation_has_a_row():
    assert [int(row[0]) for row in ROWS] == list(range(1, 47))


@pytest.mark.parametrize("number, what, where, test", ROWS, ids=[row[0] for row in ROWS])
def test_files_procedures_and_tests_of_a_row_exist(number, what, where, test):
    if where.startswith("not used"):
        assert test == "-"
        return
    text = None
    for name in re.findall(r"`([^`]+)`", where):
        if name.endswith(".f90"):
            paths = list((ROOT / "src").rglob(name))
            assert len(paths) == 1, name
            text = paths[0].read_text(encoding="utf-8")
        else:
            assert re.search(rf"\b{name}\b", text), f"{name} is not in the file before it"
    suite, claim = re.fullmatch(r"`(test_\w+)`: (.+)", test).groups()
    files = list((ROOT / "test").glob(f"*/{suite}.f90"))
    assert len(files) == 1, suite
    assert f'"{claim}"' in squeeze(files[0].read_text(encoding="utf-8"))
    assert f"use {suite}, only" in (ROOT / "test/main.f90").read_text(encoding="utf-8")


def test_deck_keys_exist():
    named = re.findall(r"`(\w+)\.(\w+)`", section(22))
    assert len(named) > 30
    groups = {part.partition("\n")[0]: set(re.findall(r"^\| `(\w+)` \|", part, re.MULTILINE)) for part in DECK.split("\n## &")[1:]}
    assert [f"{group}.{key}" for group, key in named if key not in groups.get(group, ())] == []


def text_and_references():
    """The page on one line, as far as its references, and these."""
    text, _, references = PAGE.partition("\n## 24. ")
    return re.sub(r"\s+", " ", text), re.sub(r"\n +", " ", references).split("\n- ")[1:]


def is_cited(text, entry):
    """Does a text name the first author of an entry, and soon its year? Of a standard its number."""
    head = entry.partition(":")[0]
    if (found := re.match(r"(?:de |van )?([A-Z][\w-]*)[^()]*\((\d{4})\)", head)) is None:
        return head in text
    return re.search(rf"\b{found[1]}\b[^.;]{{0,90}}\b{found[2]}\b", text) is not None


def test_works_in_the_references_are_cited():
    text, entries = text_and_references()
    assert len(entries) > 70 and [entry for entry in entries if not is_cited(text, entry)] == []
    assert not is_cited(text, "Dyson, A. (1981): Another.") and not is_cited(text, "ISO 1: One.")


def test_cited_works_are_in_the_references():
    """`Author (year)`, or `(Author year)`; all authors that the text names are at the beginning of one entry, before its year."""
    text, entries = text_and_references()
    name = r"(?:de |van )?[A-Z][\w-]*[a-z]"
    authors = rf"({name}(?:(?:, | and ){name})*)(?: and others)?"
    cited = set(re.findall(rf"{authors} \((\d{{4}})\)", text))
    for inside in re.findall(r"\(([^()]*)\)", text):
        cited.update(re.findall(rf"{authors} (1[89]\d\d|20\d\d)\b", inside))
    assert len(cited) > 50
    heads = {(entry.partition(")")[0][-4:], entry.partition("(")[0]) for entry in entries}
    assert sorted((names, year) for names, year in cited if not any(
        year == other and all(part in head for part in re.findall(r"[A-Z][\w-]+", names)) for other, head in heads)) == []
