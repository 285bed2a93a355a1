"""A small fixed part of the campaign of mutated decks, with the program under test."""

import pathlib

import pytest
from fuzz_decks import mutated, try_case
from harness import Limits

# Drawn once; the campaign itself is `make fuzz`.
SEED = 13
CASES = range(24)


def test_a_case_is_drawn_from_its_seed_and_number_alone():
    assert mutated(1, 7) == mutated(1, 7)
    assert mutated(1, 7)[0] != mutated(2, 7)[0]
    assert len({mutated(1, number)[0] for number in range(50)}) > 45


@pytest.mark.parametrize("number", CASES)
def test_a_mutated_deck_ends_with_words(camroller, number):
    endings = try_case([pathlib.Path(camroller)], SEED, number, Limits(seconds=120.0))
    assert [(label, case, ending.kind, ending.errors[:2000]) for label, case, ending in endings if ending.is_fault] == []
