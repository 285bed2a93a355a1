"""Read free-form Fortran as far as our checks need it: statements with their line numbers and comments.

No parser: a statement is a line with its continuations joined, comments taken off and character literals blanked.
"""

from __future__ import annotations

import dataclasses
import pathlib

ROOT = pathlib.Path(__file__).resolve().parent.parent
SUFFIXES = {".f90", ".F90"}


@dataclasses.dataclass(frozen=True)
class Statement:
    """One statement, lower case, literals replaced by empty ones."""

    line: int
    last_line: int
    text: str
    comment: str


def sources(*folders: str, root: pathlib.Path = ROOT) -> list[pathlib.Path]:
    """All Fortran files below the folders, sorted."""
    found = []
    for folder in folders:
        found += [p for p in (root / folder).rglob("*") if p.suffix in SUFFIXES]
    return sorted(found)


def split_line(line: str) -> tuple[str, str]:
    """Code with literals emptied, and the comment with its `!`."""
    code = []
    quote = ""
    for i, char in enumerate(line):
        if quote:
            if char == quote:
                quote = ""
                code.append(char)
        elif char in "'\"":
            quote = char
            code.append(char)
        elif char == "!":
            return "".join(code), line[i:]
        else:
            code.append(char)
    return "".join(code), ""


def statements(text: str) -> list[Statement]:
    """The statements of a source text in order; comments of continued lines are joined."""
    found = []
    parts: list[str] = []
    comments: list[str] = []
    first = 0
    for number, line in enumerate(text.splitlines(), 1):
        if line.lstrip().startswith("#"):
            continue
        code, comment = split_line(line)
        code = code.strip()
        if not code:
            if parts and comment:
                comments.append(comment)
            continue
        if not parts:
            first = number
            comments = []
        parts.append(code.lstrip("&").rstrip("&").strip() if parts or code.endswith("&") else code)
        if comment:
            comments.append(comment)
        if code.endswith("&"):
            continue
        joined = " ".join(parts).lower()
        for piece in joined.split(";"):
            if piece.strip():
                found.append(Statement(first, number, piece.strip(), " ".join(comments)))
        parts = []
    return found
