"""The schema of decks and what the source takes of a deck agree: every key is taken, and nothing is taken that is no key."""

import pathlib
import re
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
TAKEN = re.compile(r'(?:take|get_word|find_value|is_known|is_wrong|get_list)\((?:\w+%)*settings, (?:trim\()?(?:"(\w+)"|(\w+)(?:\(i\))?)\)?, '
                   r'"(\w+)"')
# arguments behind the name of a key that is bound to a variable, the variable included
BOUND = {"number": 3, "whole_number": 3, "yes_or_no": 2, "choice": 3, "text": 2, "numbers": 3, "whole_numbers": 3}
LINE = re.compile(rf'^ *call keys%(group|{"|".join(BOUND)})\("?(\w+)"?, (.*)\)$', re.MULTILINE)
# what compares values of a deck and makes nothing of them
ONLY_COMPARE = {"deck_relations.f90", "deck_remarks.f90", "deck_bounds.f90"}


def source(folder):
    """Text of all files of a folder, statements joined."""
    for path in sorted((ROOT / folder).rglob("*.f90")):
        yield path.name, re.sub(r"&\s*\n\s*&?", "", path.read_text())


@pytest.fixture(scope="module")
def schema(camroller):
    """Keys that the program lists, by group; without those of the sweep, whose names have numbers."""
    text = subprocess.run([camroller, "defaults"], capture_output=True, text=True, check=True).stdout
    groups, group = {}, None
    for line in text.splitlines():
        if match := re.match(r"!?\s*&(\w+)", line):
            group = groups.setdefault(match[1], set())
        elif group is not None and (match := re.match(r"\s*!?\s*(\w+)\s*=", line)):
            group.add(match[1])
    groups.pop("sweep")
    return groups


def arguments(text):
    """Arguments without a name."""
    text = re.sub(r'"[^"]*"(//"[^"]*")*', "text", text)
    while text != (text := re.sub(r"[(\[][^()\[\]]*[)\]]", "", text)):
        pass
    return [argument for argument in text.split(",") if "=" not in argument]


def bound():
    """Keys that stand in one line with their variables: group, or none where several groups share the line, and key."""
    for _, text in source("src"):
        names = dict(re.findall(r'(\w+) = "(\w+)"', text))
        for procedure in re.split(r"\n   end subroutine", text):
            group = None
            for kind, name, rest in LINE.findall(procedure):
                if kind == "group":
                    group = names.get(name, name)
                elif len(arguments(rest)) >= BOUND[kind]:
                    yield group, name


@pytest.fixture(scope="module")
def taken(schema):
    """Keys that the source takes, by group; where the group is a variable, of every group that has the key."""
    groups = {}
    keys = list(bound())
    assert len(keys) > 200
    for group, key in keys:
        for named in [group] if group else [group for group in schema if key in schema[group]]:
            groups.setdefault(named, set()).add(key)
    for name, text in source("src"):
        if name in ONLY_COMPARE:
            continue
        for literal, variable, key in TAKEN.findall(text):
            named = [literal] if literal else [group for group in schema if key in schema[group]]
            assert named, f"{variable}.{key} is taken, and no group has it"
            for group in named:
                groups.setdefault(group, set()).add(key)
    return groups


def test_every_key_of_the_schema_is_read_into_a_case(schema, taken):
    assert len(schema) >= 20 and sum(map(len, schema.values())) >= 100
    assert {f"{group}.{key}" for group in schema for key in schema[group] - taken.get(group, set())} == set()


def test_every_key_that_is_read_is_in_the_schema(schema, taken):
    assert {f"{group}.{key}" for group in taken for key in taken[group] - schema.get(group, set()) if group != "sweep"} == set()
