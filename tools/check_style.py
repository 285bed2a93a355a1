#!/usr/bin/env python3
"""Check the written rules of CONTRIBUTING.md that a script can check.

Usage: tools/check_style.py [--root DIR]

Everywhere: no name after `only` that stands nowhere else, files within 500 lines, procedures within 60 lines of code (`only` itself,
`implicit none`, width of lines, tabs and blanks at their ends are the linter's). In src and app: one module a file, named after it
with our prefix, `private` at its top, a unit in brackets on every real declaration, no comment on an argument of a private procedure that only
repeats its name or type, and no write into a text, which ends the program where the
text is too short (src/base/number_text.f90 has the routines for that; a unit is known by its name, `...unit` or `*`); no print and
no unit for output or errors, whose text is lost without an error where the disk is full (src/files/streams.f90 has the routines for that).
In src: no stop. In src but for the folders that write results, threads run side by side: no function whose text has the length it finds, since gfortran
keeps that length in a static variable of the caller.

A rule is broken on purpose with a comment `style: <rule> because <reason>` on the line or the line above.
"""

from __future__ import annotations

import argparse
import pathlib
import re
import sys

from fortran_source import ROOT, Statement, sources, statements

PREFIX = "camroller"
FILE_LIMIT = 500
PROCEDURE_LIMIT = 60
# Folders whose files one thread calls at a time: there a function may return a text of any length.
ONE_THREAD = ("hdf5", "output", "parts", "batch", "look")

PROCEDURE = re.compile(
    r"^(?:(?:pure|impure|elemental|recursive|module|(?:real|integer|logical|character|complex|type)\s*\([^)]*\)|"
    r"real|integer|logical)\s+)*(subroutine|function)\s+(\w+)")
END_PROCEDURE = re.compile(r"^end\s*(subroutine|function)\b")
PROGRAM_UNIT = re.compile(r"^(module|program)\s+(?!procedure\b|subroutine\b|function\b)(\w+)$")
REAL = re.compile(r"^(?:real|complex)\s*(?:\([^)]*\))?\s*(?:,.*)?::")
UNIT = re.compile(r"\[[^\[\]]+\]|\bunits? (?:as|of|in) ")
WRITE = re.compile(r"^(?:if\s*\(.*\)\s*)?write\s*\(\s*(?:unit\s*=\s*)?([^,)]*)")
UNIT_NUMBER = re.compile(r"^(?:[\w%]*unit|\*|\d+)\s*$")
IMPORTS = re.compile(r"^use\b.*\bonly\s*:\s*(.*)$")
# What stands before the kind of a number
DIGITS = re.compile(r"\b\d[\d.]*_(?=[a-z])")
# An argument that is no real; words of a comment that say nothing
ARGUMENT = re.compile(r"^(?:(?:type|class)\s*\((\w+)\)|integer|logical|character\s*\([^)]*\)).*\bintent\b.*::\s*(\w+)(?:\(.*\))?$")
ARTICLES = {"a", "an", "the", "its"}
EXCUSE = re.compile(r"style:\s*(\w+)\s+because\s+\S")


class Report:
    """Faults of one file, less those that are excused beside the line."""

    def __init__(self, name: str, lines: list[str]):
        self.name = name
        self.lines = lines
        self.faults: list[str] = []

    def add(self, line: int, rule: str, text: str) -> None:
        """Note a fault, unless the line or the one above says why the rule is broken."""
        for number in (line, line - 1):
            if 1 <= number <= len(self.lines):
                match = EXCUSE.search(self.lines[number - 1])
                if match and match[1] == rule:
                    return
        self.faults.append(f"{self.name}:{line}: {text} [{rule}]")


def check_lines(report: Report) -> None:
    """Length of the file."""
    if len(report.lines) > FILE_LIMIT:
        report.add(1, "length", f"{len(report.lines)} lines in one file; the limit is {FILE_LIMIT}")


def check_procedures(report: Report, code: list[Statement]) -> None:
    """Lines of code of each procedure, without comments, blank lines and the procedures it contains."""
    filled = {n for n, line in enumerate(report.lines, 1) if line.strip() and not line.lstrip().startswith("!")}
    stack: list[list] = []
    interface = False
    for statement in code:
        text = statement.text
        if re.match(r"^(abstract\s+)?interface\b", text):
            interface = True
        elif re.match(r"^end\s*interface\b", text):
            interface = False
        elif interface:
            continue
        elif END_PROCEDURE.match(text) and stack:
            start, name, inner = stack.pop()
            length = len([n for n in filled if start <= n <= statement.last_line]) - inner
            if length > PROCEDURE_LIMIT:
                report.add(start, "procedure", f"{name} has {length} lines of code; the limit is {PROCEDURE_LIMIT}")
            if stack:
                stack[-1][2] += length + inner
        elif not text.startswith("end") and (match := PROCEDURE.match(text)):
            stack.append([statement.line, match[2], 0])


def check_units(report: Report, code: list[Statement]) -> None:
    """A unit in brackets, or where to find it, in the comment on a real declaration or above it.

    One comment may speak for several declarations that follow each other.
    """
    shared = ""
    last_line = 0
    for statement in code:
        if not REAL.match(statement.text) or "procedure" in statement.text:
            continue
        above = ""
        number = statement.line - 1
        while number >= 1 and report.lines[number - 1].lstrip().startswith("!"):
            above += report.lines[number - 1]
            number -= 1
        if above or last_line != statement.line - 1:
            shared = above
        last_line = statement.last_line
        if not UNIT.search(statement.comment + shared):
            report.add(statement.line, "unit", "a real without its unit in brackets")


def check_echoes(report: Report, code: list[Statement]) -> None:
    """No comment of one line on an argument of a private procedure whose words are those of the argument's name or type alone."""
    public = {name for s in code if s.text.startswith("public") for name in re.findall(r"\w+", s.text)}
    inside: list[str] = []
    for statement in code:
        if END_PROCEDURE.match(statement.text) and inside:
            inside.pop()
        elif not statement.text.startswith("end") and (match := PROCEDURE.match(statement.text)):
            inside.append(match[2])
        if not inside or public.intersection(inside) or not (match := ARGUMENT.match(statement.text)):
            continue
        above = [line.strip() for line in report.lines[max(statement.line - 3, 0):statement.line - 1]]
        if above[-1].startswith("!> ") and not above[0].startswith("!"):
            said = set(re.findall(r"[a-z0-9]+", above[-1].lower())) - ARTICLES
            known = set(re.findall(r"[a-z0-9]+", f"{match[1]} {match[2]}".replace("_", " ")))
            if {word.removesuffix("s") for word in said} <= {word.removesuffix("s") for word in known}:
                report.add(statement.line - 1, "echo", "a comment that repeats the name or type of an argument")


def check_statements(report: Report, code: list[Statement], folder: str) -> None:
    """Rules on single statements."""
    for statement in code:
        text = statement.text
        if folder == "src" and re.match(r"^(?:if\s*\(.*\)\s*)?(?:error\s+)?stop\b(?!\s*=)", text):
            report.add(statement.line, "stop", "stop in the library")
        if folder in ("src", "app") and re.match(r"^(?:if\s*\(.*\)\s*)?(?:print\b(?!\s*=)|write\s*\(\s*\*\s*,)", text):
            report.add(statement.line, "print", "the library prints, or the program past camroller_streams")
        if folder in ("src", "app") and re.search(r"\b(?:output|error)_unit\b", text):
            report.add(statement.line, "output", "text that is lost without an error where the disk is full; take print_lines, "
                       "print_text or tell")
        if folder in ("src", "app") and (match := WRITE.match(text)) and not UNIT_NUMBER.match(match[1]):
            report.add(statement.line, "write", "a number is written into a text; take number_text or another of its module")


def check_imports(report: Report, code: list[Statement]) -> None:
    """No name after `only` that the file does not use; operators and assignments may be used without their name.

    A module that is public as a whole gives on what it uses.
    """
    if any(statement.text == "public" for statement in code):
        return
    used = set()
    for statement in code:
        if not IMPORTS.match(statement.text):
            used.update(re.findall(r"\w+", DIGITS.sub(" ", statement.text)))
    for statement in code:
        if match := IMPORTS.match(statement.text):
            names = [item.split("=>")[0].strip() for item in match[1].split(",") if "(" not in item]
            for name in sorted(set(names) - used):
                report.add(statement.line, "import", f"{name} is imported and not used")


def check_lengths(report: Report, code: list[Statement]) -> None:
    """No function with a text of any length as its result."""
    result = ""
    for statement in code:
        if match := re.match(r"^(?!end).*\bfunction\s+(\w+)\s*\([^)]*\)(?:.*\bresult\s*\(\s*(\w+)\s*\))?", statement.text):
            result = match[2] or match[1]
        elif re.match(r"^end\s*function\b", statement.text):
            result = ""
        elif result and re.match(rf"^character\s*\(\s*len\s*=\s*:.*::.*\b{result}\b", statement.text):
            report.add(statement.line, "text", "a function whose text has any length is not safe in threads")


def check_units_of_program(report: Report, code: list[Statement], path: pathlib.Path, folder: str) -> None:
    """One program unit a file with the right name; `private` in modules."""
    found = [(s.line, match[1], match[2]) for s in code if (match := PROGRAM_UNIT.match(s.text))]
    if len(found) != 1:
        report.add(1, "module", f"{len(found)} modules or programs in one file; one is right")
        return
    line, kind, name = found[0]
    if folder in ("src", "app") and kind == "module" and path.stem != PREFIX and name != f"{PREFIX}_{path.stem}":
        report.add(line, "name", f"module {name} in {path.name}; {PREFIX}_{path.stem} is right")
    if kind == "module" and not any(s.text == "private" for s in code):
        report.add(line, "private", "no private at the top of the module")


def check_file(path: pathlib.Path, root: pathlib.Path) -> list[str]:
    """All faults of one file."""
    text = path.read_text(encoding="utf-8")
    short = path.relative_to(root)
    folder = short.parts[0]
    report = Report(str(short), text.splitlines())
    code = statements(text)
    check_lines(report)
    check_procedures(report, code)
    check_statements(report, code, folder)
    check_imports(report, code)
    check_units_of_program(report, code, path, folder)
    if folder in ("src", "app"):
        check_units(report, code)
        check_echoes(report, code)
    if folder == "src" and len(short.parts) > 2 and short.parts[1] not in ONE_THREAD:
        check_lengths(report, code)
    return report.faults


def main(arguments=None) -> int:
    """Command line; returns the exit code."""
    parser = argparse.ArgumentParser(description="check the rules of style that a script can check")
    parser.add_argument("--root", type=pathlib.Path, default=ROOT, help="top folder of the project")
    root = parser.parse_args(arguments).root.resolve()
    files = sources("src", "app", "test", "example", root=root)
    faults = [fault for path in files for fault in check_file(path, root)]
    for fault in faults:
        print(fault, file=sys.stderr)
    print(f"style: {len(files)} files, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
