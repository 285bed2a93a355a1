#!/usr/bin/env python3
"""Hostile files: results that were damaged or made over into another shape, given to every command that reads HDF5.

Usage: test/fuzz/fuzz_files.py [--cases N] [--seed S] [--program PATH]... [--only NUMBER]

Four kinds by turns: bytes changed in a file as the program wrote it; the same in a file whose seal is gone, as a program that
changes files leaves it; pieces cut off, put in or moved; objects of another type, rank or extent, made with h5py. A run is at
fault where the harness says so, and where a file that differs from the one that was written gives other numbers and exit code 0.
Without a seal a changed number cannot be told from the one that was written: those are counted by themselves.
"""

from __future__ import annotations

import argparse
import dataclasses
import pathlib
import random
import subprocess
import sys
import tempfile

import h5py
import numpy
from harness import ROOT, Ending, Limits, attempt, campaign

# What one run may take: a result of two cases needs 0.2 s and 100 MB
LIMITS = Limits(seconds=30.0)
PROGRAMS = [ROOT / "build/release/bin/camroller", ROOT / "build/debug/bin/camroller"]
SEAL = 32  # bytes
COARSE = ["--set", "output.angle_step_deg=20", "--set", "numerics.accuracy=1e-3", "--quiet"]
# Decks of the files that are damaged, with what is varied
BASES = {
    "thesis": ["run", "thesis.nml", "--set", "sweep.values_1=300,900", "--set", "sweep.values_2=60"],
    "cams": ["run", "three_cam_head.nml"],
    "lift": ["run", "tabulated_lift.nml", "--set", "output.compression=on"],
    "sweep": ["sweep", "thesis.nml", "--threads", "1", "--set", "sweep.values_1=300,900", "--set", "sweep.values_2=60,95", "--set",
              "sweep.series=chosen", "--set", "sweep.series_cases=1"],
}
FILE_ERROR = 6  # exit code
BROKEN = "it is damaged, the HDF5 library does not finish reading it"
TABLE_DECK = "&sweep kind = 'table' table = 'damaged.h5' /\n"


@dataclasses.dataclass
class Base:
    """A file that is damaged: its bytes, and what the commands say of it."""

    name: str
    content: bytes
    outputs: dict


def commands(file: str) -> dict[str, list[str]]:
    """Every command that reads an HDF5 file."""
    return {"export": ["export", file], "export --summary": ["export", file, "--summary"],
            "rerun": ["rerun", file, "--threads", "1", "--quiet"], "check": ["check", "table.nml"]}


def table_deck() -> str:
    """A deck whose cases are those of a damaged file."""
    return (ROOT / "decks/thesis.nml").read_text(encoding="utf-8").partition("&sweep")[0] + TABLE_DECK


def make_bases(program: str, folder: pathlib.Path) -> list[Base]:
    """Run the decks; keep the files and what is exported from them."""
    (folder / "table.nml").write_text(table_deck(), encoding="utf-8")
    bases = []
    for name, (command, path, *options) in BASES.items():
        target = folder / f"{name}.h5"
        target.unlink(missing_ok=True)
        subprocess.run([program, command, str(ROOT / "decks" / path), "-o", str(target), *COARSE, *options], check=True)
        outputs = {label: subprocess.run([program, *words], check=False, capture_output=True, text=True).stdout
                   for label, words in commands(str(target)).items() if label.startswith("export")}
        bases.append(Base(name, target.read_bytes(), outputs))
    return bases


def change_bytes(content: bytearray, draw: random.Random) -> str:
    """Change a few bytes; half of the time in the first 16 KiB, where HDF5 keeps what everything hangs on."""
    words = []
    for _ in range(draw.choice([1, 1, 2, 4, 16])):
        place = draw.randrange(min(len(content), 16384) if draw.random() < 0.5 else len(content))
        value = draw.choice([draw.randrange(256), 0, 255, content[place] ^ (1 << draw.randrange(8))])
        words.append(f"{place}: {content[place]} to {value}")
        content[place] = value
    return ", ".join(words)


def change_pieces(content: bytearray, draw: random.Random) -> str:
    """Cut, put in, move or blank a piece."""
    first = draw.randrange(len(content))
    length = min(draw.choice([1, 8, 100, 4096]), len(content) - first)
    kind = draw.choice(["end cut", "piece cut", "piece put in", "piece moved", "zeros", "ones"])
    piece = content[first:first + length]
    if kind == "end cut":
        del content[first:]
    elif kind == "piece cut":
        del content[first:first + length]
    elif kind == "piece put in":
        content[first:first] = piece
    elif kind == "piece moved":
        other = draw.randrange(len(content) - length + 1)
        content[other:other + length] = piece
    else:
        content[first:first + length] = (b"\x00" if kind == "zeros" else b"\xff") * length
    return f"{kind}, {length} bytes at {first}"


def replacement(old: numpy.ndarray, draw: random.Random):
    """Another value in the place of a dataset's, and what it is."""
    shape = old.shape
    choices = {
        "one axis more": numpy.zeros((*shape, 3)),
        "an axis of one more": numpy.zeros((*shape, 1)),
        "a single number": numpy.float64(1.5),
        "no value": h5py.Empty("f8"),
        "nothing along the axis": numpy.zeros((0, *shape[1:])),
        "shorter": numpy.zeros([max(n - 1, 0) for n in shape]),
        "longer": numpy.ones([n + 5 for n in shape]),
        "texts": numpy.full(shape, "x", dtype=object),
        "texts of fixed length": numpy.full(shape, b"abc"),
        "whole numbers": numpy.full(shape, 7, dtype="i8"),
        "small numbers": numpy.full(shape, 1, dtype="u1"),
        "complex numbers": numpy.zeros(shape, complex),
        "records": numpy.zeros(shape, [("a", "f8"), ("b", "i4")]),
        "long numbers": numpy.zeros(shape, numpy.longdouble),
        "truth values": numpy.zeros(shape, bool),
        "nine axes": numpy.zeros((1,)*9),
    }
    name = draw.choice(sorted(choices))
    return choices[name], name


def change_shape(path: pathlib.Path, draw: random.Random) -> str:
    """Give one object of a file another type, rank or extent; or remove or exchange it."""
    with h5py.File(path, "r+") as file:
        names = []
        file.visit(names.append)
        important = ["case", "series/cam_angle", "summary/status", "deck/text", "series", "run", "summary", "sweep", "deck"]
        name = draw.choice([one for one in important if one in file] if draw.random() < 0.5 else names)
        thing, kind = file[name], draw.choice(["value", "value", "value", "attribute", "huge", "gone", "group", "link"])
        if kind == "attribute" and len(thing.attrs):
            attribute = draw.choice(sorted(one for one in thing.attrs))
            value, words = replacement(numpy.zeros(draw.choice([(), (3,), (1000,)])), draw)
            del thing.attrs[attribute]
            thing.attrs[attribute] = value
            return f"{name}:{attribute}: {words}"
        if isinstance(thing, h5py.Group) and kind in ("value", "attribute"):
            kind = "gone"
        kept = {key: value for key, value in thing.attrs.items()
                if key not in ("DIMENSION_LIST", "REFERENCE_LIST", "CLASS", "NAME", "_Netcdf4Dimid")}
        old = thing[()] if isinstance(thing, h5py.Dataset) else None
        if kind in ("value", "attribute"):
            value, words = replacement(numpy.asarray(old), draw)
        del file[name]
        if kind == "gone":
            return f"{name}: gone"
        if kind == "group":
            file.create_group(name)
            return f"{name}: a group"
        if kind == "link":
            file[name] = draw.choice([h5py.SoftLink("/" + name), h5py.SoftLink("/nowhere"), h5py.ExternalLink("none.h5", "/x"),
                                      h5py.ExternalLink(path.name, "/" + name)])
            return f"{name}: a link"
        if kind == "huge":
            rank = max(1, numpy.ndim(old))
            file.create_dataset(name, shape=(draw.choice([10**5, 2**31 - 1, 2**31, 2**40, 2**62]), *[1]*(rank - 1)), dtype="f8",
                                chunks=(64, *[1]*(rank - 1)))
            words = "huge"
        else:
            file[name] = value
        for key, value in kept.items():
            file[name].attrs[key] = value
        return f"{name}: {words}"


def make_file(bases: list[Base], number: int, seed: int, path: pathlib.Path) -> tuple[Base, str, str]:
    """The damaged file of a case; the file it was, the kind of damage, and what was done."""
    draw = random.Random(f"{seed} {number}")
    base = draw.choice(bases)
    content = bytearray(base.content)
    kind = ("sealed bytes", "bytes", "pieces", "shape")[number % 4]
    if kind == "bytes":
        del content[-SEAL:]
    if kind == "pieces" and draw.random() < 0.5:
        del content[-SEAL:]
        kind = "pieces without seal"
    if kind == "shape":
        path.write_bytes(content)
        return base, kind, change_shape(path, draw)
    words = change_pieces(content, draw) if kind.startswith("pieces") else change_bytes(content, draw)
    path.write_bytes(content)
    return base, kind, words


def judge(ending: Ending, label: str, kind: str, words: str, base: Base) -> Ending:
    """An ending as the harness sees it; other numbers without a word are a fault where they could be told.

    Where a file without a seal has the HDF5 library spoil its memory, the C library says so before the program can, which is none.
    """
    without_seal = kind in ("bytes", "pieces without seal")
    if without_seal and ending.kind == "words of a library" and ending.code == FILE_ERROR and BROKEN in ending.errors:
        return dataclasses.replace(ending, kind="6 file, behind words of the C library", is_fault=False)
    if ending.code != 0 or label not in base.outputs or ending.output == base.outputs[label]:
        return ending
    if words.endswith((": gone", ": a group", ": whole numbers", ": small numbers")):
        return dataclasses.replace(ending, kind="0, what was changed on purpose")
    if without_seal:
        return dataclasses.replace(ending, kind="0, other numbers, no seal to tell")
    return dataclasses.replace(ending, kind="0, other numbers in silence", is_fault=True)


def try_file(program: str, bases: list[Base], number: int, seed: int, folder: pathlib.Path) -> list[tuple[str, str, Ending]]:
    """All commands on one damaged file."""
    with tempfile.TemporaryDirectory(dir=folder) as place:
        here = pathlib.Path(place)
        base, kind, words = make_file(bases, number, seed, here / "damaged.h5")
        (here / "table.nml").write_bytes((folder / "table.nml").read_bytes())
        endings = []
        for label, arguments in commands("damaged.h5").items():
            ending = attempt(program, arguments, here, LIMITS)
            endings.append((f"{kind}, {label}", f"case {number} seed {seed}, {base.name}: {words}", judge(ending, label, kind, words, base)))
        return endings


def main() -> int:
    """Command line; returns the exit code."""
    parser = argparse.ArgumentParser(description="damaged result files")
    parser.add_argument("--cases", type=int, default=400)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--program", action="append", help="program to try; both builds by turns where not given")
    parser.add_argument("--only", type=int, help="one case by its number")
    chosen = parser.parse_args()
    programs = chosen.program or [str(path) for path in PROGRAMS if path.is_file()]
    numbers = range(chosen.cases) if chosen.only is None else [chosen.only]
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        bases = {program: make_bases(program, folder) for program in programs}

        def work(number: int) -> list[tuple[str, str, Ending]]:
            """One case; kinds of damage change from case to case, programs from four to four."""
            program = programs[number//4 % len(programs)]
            return try_file(program, bases[program], number, chosen.seed, folder)

        tally = campaign(numbers, work)
    print(tally.text())
    return 1 if tally.faults else 0


if __name__ == "__main__":
    sys.exit(main())
