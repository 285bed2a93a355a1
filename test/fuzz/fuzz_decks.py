#!/usr/bin/env python3
"""Mutated decks for both programs: every run ends with a documented exit code and words.

Usage: test/fuzz/fuzz_decks.py [--cases N] [--seed S] [--program PATH ...] [--keep DIR]

Each case takes a shipped deck and changes it in one to four places: bytes, lines, numbers, keys, names, quotes, encodings, huge
lines, tables. It goes through `camroller check`, every sixth also through `run` with few points, in the program
with run-time checks and the optimised one. A case is drawn from seed and number alone, so that
`--seed S --only NUMBER` gives it again; faults leave their deck in DIR.
"""

from __future__ import annotations

import argparse
import pathlib
import random
import re
import shutil
import sys
import tempfile

from harness import MEGABYTE, ROOT, Limits, attempt, campaign

PROGRAMS = [ROOT / "build/debug/bin/camroller", ROOT / "build/release/bin/camroller"]
DECKS = sorted((ROOT / "decks").glob("*.nml")) + sorted((ROOT / "decks/hard").glob("*.nml"))
NUMBER = re.compile(rb"(?<![\w.])[-+]?(?:\d+\.?\d*|\.\d+)(?:[edED][-+]?\d+)?(?![\w.])")
NUMBERS = [b"0", b"-1", b"1e-310", b"1e-308", b"1e308", b"1e309", b"-1e300", b"1e300", b"1e-300", b"nan", b"inf", b"1e-30", b"1e30",
           b"1e99999999999", b"2147483647", b"2147483648", b"-2147483648", b"9223372036854775808", b"1d3", b"1.e", b".", b"1,2,3",
           b"3*1", b"99999*1", b"0*", b"1e-12", b"1e12", b"1e6", b"1e-6", b"1e3", b"1e-3", b"", b"1 2", b"0x10", b"1_8", b"1e0"]
PIECES = [b"&", b"/", b"=", b"!", b"'", b'"', b",", b"*", b"(1)", b"%", b"&end", b"\x00", b"\t", b"\r", b"\x1b[31m", b"\xff", b"\xc3",
          b"\xef\xbb\xbf", b"\xe2\x82\xac", b"\n", b"\n\n/\n", b"&sweep\n", b"&ehl /\n", b"&asperity /\n", b"&valve_guide /\n", b"$",
          b"\x7f", b" ", b"\xc2\xa0", b"1", b".true.", b"'table'"]
BLANK = b" \t\r\n"


def number_near(chance: random.Random, text: bytes) -> bytes:
    """A number changed by a factor, or an odd one."""
    if chance.random() < 0.15:
        return chance.choice(NUMBERS)
    try:
        value = float(text.lower().replace(b"d", b"e"))
    except ValueError:
        return chance.choice(NUMBERS)
    factor = chance.choice([0.0, -1.0, 0.5, 2.0, 0.9, 1.1, 10.0, 0.1, 100.0, 0.01, 1e3, 1e-3, 1e6, 1e-6])
    if value == int(value) and abs(value) < 1e9 and b"." not in text and chance.random() < 0.7:
        return b"%d" % int(value*factor)
    return b"%.12g" % (value*factor)


def change_numbers(chance: random.Random, deck: bytes) -> bytes:
    """One number of the deck."""
    found = [match for match in NUMBER.finditer(deck)]
    if not found:
        return deck
    match = chance.choice(found)
    return deck[:match.start()] + number_near(chance, match[0]) + deck[match.end():]


def change_bytes(chance: random.Random, deck: bytes) -> bytes:
    """Some bytes anywhere: replaced, removed, put in."""
    data = bytearray(deck)
    for _ in range(chance.choice([1, 1, 2, 8])):
        place = chance.randrange(len(data) + 1)
        kind = chance.randrange(4)
        if kind == 0 and place < len(data):
            data[place] = chance.randrange(256)
        elif kind == 1 and place < len(data):
            data[place] ^= 1 << chance.randrange(8)
        elif kind == 2:
            del data[place:place + chance.choice([1, 1, 3, 40])]
        else:
            data[place:place] = chance.choice(PIECES)
    return bytes(data)


def change_lines(chance: random.Random, deck: bytes) -> bytes:
    """Lines left out, doubled, swapped, joined, cut off."""
    lines = deck.split(b"\n")
    one, other = chance.randrange(len(lines)), chance.randrange(len(lines))
    kind = chance.randrange(6)
    if kind == 0:
        del lines[one]
    elif kind == 1:
        lines.insert(other, lines[one])
    elif kind == 2:
        lines[one], lines[other] = lines[other], lines[one]
    elif kind == 3:
        lines[one] += b" " + (lines.pop(one + 1) if one + 1 < len(lines) else b"")
    elif kind == 4:
        lines = lines[:one + 1]
    else:
        lines[one:one + 1] = lines[one:one + 1]*chance.choice([2, 30, 3000])
    return b"\n".join(lines)


def change_keys(chance: random.Random, deck: bytes) -> bytes:
    """A word of the deck: a letter more or less, in another case, another word of it."""
    words = [match for match in re.finditer(rb"[A-Za-z_]\w+", deck)]
    if not words:
        return deck
    match = chance.choice(words)
    word = match[0]
    place = chance.randrange(len(word))
    new = chance.choice([word[:place] + word[place + 1:], word[:place] + b"x" + word[place:], word.swapcase(),
                         chance.choice(words)[0], word*chance.choice([2, 100]), b""])
    return deck[:match.start()] + new + deck[match.end():]


def change_names(chance: random.Random, deck: bytes) -> bytes:
    """A quoted text: another one of any deck, or something odd."""
    found = [match for match in re.finditer(rb"'[^'\n]*'", deck)]
    if not found:
        return deck
    match = chance.choice(found)
    names = re.findall(rb"'[^'\n]*'", chance.choice(DECKS).read_bytes())
    odd = [b"''", b"'", b'"x"', b"'/dev/zero'", b"'/'", b"'.'", b"'deck.nml'", b"'" + b"a"*600 + b"'", b"x", b"'\xff'", b"''''"]
    new = chance.choice(names) if names and chance.random() < 0.6 else chance.choice(odd)
    return deck[:match.start()] + new + deck[match.end():]


def change_encoding(chance: random.Random, deck: bytes) -> bytes:
    """The same text as other programs write it."""
    text = deck.decode("utf-8", errors="replace")
    return chance.choice([b"\xef\xbb\xbf" + deck, text.encode("utf-16"), text.encode("utf-16-le"), text.encode("utf-32"),
                          deck.replace(b"\n", b"\r\n"), deck.replace(b"\n", b"\r"), deck + b"\x1a", deck.replace(b" ", b"\xc2\xa0"),
                          deck.replace(b"'", b"\xe2\x80\x99"), deck.replace(b".", b","), deck.upper()])


def change_size(chance: random.Random, deck: bytes) -> bytes:
    """Something huge somewhere."""
    place = chance.randrange(len(deck) + 1)
    piece = chance.choice([*PIECES, b"a", b"1 ", b"a = 1\n", b"&a /\n", b"a(", b"1,", b"'x' "])
    size = chance.choice([1000, 30000, MEGABYTE])
    return deck[:place] + piece*(size//max(1, len(piece))) + deck[place:]


def change_table(chance: random.Random, deck: bytes) -> bytes:
    """Another kind of file in the place of a table, or a table where none was."""
    return deck + chance.choice([b"&gas_force table = 'table.txt' valve_diameter_mm = 30 /\n",
                                 b"&second_lift law = 'table' table = 'table.txt' /\n",
                                 b"&sweep kind = 'table' table = 'table.txt' /\n",
                                 b"&sweep kind = 'table' table = 'deck.nml' /\n"])


CHANGES = [change_numbers, change_numbers, change_numbers, change_bytes, change_lines, change_keys, change_names, change_encoding,
           change_size, change_table]


def mutated(seed: int, number: int) -> tuple[bytes, pathlib.Path, bytes]:
    """A deck, the folder of the deck that it was made from, and a table beside it."""
    chance = random.Random(f"{seed} {number}")
    path = chance.choice(DECKS)
    deck = path.read_bytes()
    # every other deck has other numbers alone: it comes further than one that is no deck
    changes = chance.choices(CHANGES if number % 2 else [change_numbers], k=chance.choice([1, 1, 1, 2, 2, 3, 4]))
    for change in changes:
        deck = change(chance, deck)
    source = chance.choice(sorted((ROOT / "decks/tables").glob("*.txt")))
    table = chance.choice([change_numbers, change_bytes, change_lines, change_size, change_encoding])(chance, source.read_bytes())
    return deck, path.parent, table


def prepare(folder: pathlib.Path, seed: int, number: int) -> None:
    """The files of a case."""
    deck, source, table = mutated(seed, number)
    shutil.copytree(source / "tables", folder / "tables", ignore=shutil.ignore_patterns("*.py"))
    shutil.copytree(ROOT / "decks", folder / "decks", ignore=shutil.ignore_patterns("hard", "tables"))
    # decks include others, from the folder of decks or from the one below it
    (folder / "deck.nml").write_bytes(re.sub(rb"(?<=include = ')(?:\.\./)?(?=\w)", b"decks/", deck))
    (folder / "table.txt").write_bytes(table)
    if number % 5 == 0:  # a table of the deck is odd, not the deck alone
        for path in (folder / "tables").glob("*.txt"):
            path.write_bytes(table)


def try_case(programs: list[pathlib.Path], seed: int, number: int, limits: Limits, keep: pathlib.Path | None = None):
    """All runs of one case."""
    results = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        prepare(folder, seed, number)
        commands = [["check", "deck.nml"]]
        if number % 6 == 0:
            commands.append(["run", "deck.nml", "-o", "x.h5", "--quiet", "--set", "output.angle_step_deg=5"])
        for command in commands:
            for program in programs:
                ending = attempt(str(program), command, folder, limits)
                label = f"{command[0]} {program.parents[1].name}"
                results.append((label, f"--seed {seed} --only {number}", ending))
        if keep and any(ending.is_fault for _, _, ending in results):
            shutil.copytree(folder, keep / f"{seed}-{number}", dirs_exist_ok=True)
    return results


def main(arguments=None) -> int:
    """Command line; returns the exit code."""
    parser = argparse.ArgumentParser(description="mutated decks for both programs")
    parser.add_argument("--cases", type=int, default=300, help="number of decks")
    parser.add_argument("--seed", type=int, default=1, help="what the decks are drawn from")
    parser.add_argument("--only", type=int, help="one deck by its number")
    parser.add_argument("--program", type=pathlib.Path, nargs="+", default=PROGRAMS, help="programs to try")
    parser.add_argument("--seconds", type=float, default=60.0, help="time limit of a run")
    parser.add_argument("--keep", type=pathlib.Path, help="folder for the decks of faults")
    options = parser.parse_args(arguments)
    numbers = range(options.cases) if options.only is None else [options.only]
    limits = Limits(seconds=options.seconds)
    tally = campaign(numbers, lambda number: try_case(options.program, options.seed, number, limits, options.keep))
    print(f"decks, seed {options.seed}:\n{tally.text()}")
    return 1 if tally.faults else 0


if __name__ == "__main__":
    sys.exit(main())
