"""The hard decks: each says why it is hard, and its tables are those of their script."""

import pathlib
import re
import subprocess
import sys

import f90nml
import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDER = ROOT / "decks/hard"
DECKS = sorted(FOLDER.glob("*.nml"))
# Flexible trains have a suite of their own
DYNAMIC = sorted((FOLDER / "dynamics").glob("*.nml"))
# Cams that cannot be made: `check` has to say so
IMPOSSIBLE = {"short_undercut.nml": "cam undercut", "very_noisy_table.nml": "cam undercut"}
DOMAIN = 4


def test_there_are_hard_decks():
    assert len(DECKS) >= 24


@pytest.mark.parametrize("path", DECKS + DYNAMIC, ids=lambda path: path.name)
def test_each_deck_says_why_it_is_hard(path):
    assert path.read_text().startswith("! Hard because ")
    assert f90nml.read(path)["case"]["title"]


@pytest.mark.parametrize("path", DECKS + DYNAMIC, ids=lambda path: path.name)
def test_each_deck_gives_what_differs_from_its_base(path):
    """A group that it takes from its base has no key with the base's value."""
    base, without = re.search(r"^include = '([./a-z_]+\.nml)', without = (.*)$", path.read_text(), flags=re.MULTILINE).groups()
    deck, common = f90nml.read(path), f90nml.read(path.parent / base)
    assert "'sweep'" in without
    assert [(group, key) for group in deck if f"'{group}'" not in without for key, value in deck[group].items()
            if common.get(group, {}).get(key) == value] == []


def test_the_tables_are_those_of_their_script(tmp_path):
    subprocess.run([sys.executable, FOLDER / "tables/make_tables.py", tmp_path], check=True)
    made = {path.name: path.read_text() for path in tmp_path.glob("*.txt")}
    assert made == {path.name: path.read_text() for path in (FOLDER / "tables").glob("*.txt")}


@pytest.mark.parametrize("path", DECKS, ids=lambda path: path.name)
def test_each_deck_is_valid_or_says_why_not(path, camroller):
    done = subprocess.run([camroller, "check", path], capture_output=True, text=True)
    if path.name in IMPOSSIBLE:
        assert done.returncode == DOMAIN
        assert IMPOSSIBLE[path.name] in done.stderr and " at cam angle " in done.stderr
    else:
        assert done.returncode == 0, done.stderr


def test_each_deck_is_in_the_lists_of_the_tests():
    for name in ("test_hard_cases", "test_hard_ehl"):
        text = (FOLDER.parents[1] / f"test/verification/{name}.f90").read_text(encoding="utf-8")
        assert [path.stem for path in DECKS if f'"{path.stem}"' not in text] == []
    text = (FOLDER.parents[1] / "test/verification/test_hard_dynamics.f90").read_text(encoding="utf-8")
    assert DYNAMIC and [path.stem for path in DYNAMIC if f'"{path.stem}"' not in text] == []
