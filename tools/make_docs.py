#!/usr/bin/env python3
"""Make the API reference and the pages as HTML: build/docs/index.html. Options of FORD are in fpm.toml, [extra.ford].

Usage: make docs

FORD reads copies, in build/docs-source, in which what its Markdown does not know is written as it does; formulas become MathML,
and the style sheet comes from a Python package, so that the result needs no network. Every warning and every broken link is a fault.
Exit code 0, or 1 with the faults.
"""

from __future__ import annotations

import html.parser
import importlib.util
import pathlib
import re
import shutil
import subprocess
import sys
import tomllib
import urllib.parse

import latex2mathml.converter

from fortran_source import ROOT

STAGE, OUTPUT = ROOT / "build/docs-source", ROOT / "build/docs"
FOLDERS = {"": "Pages", "doc": "Documentation", "doc/notes": "Engineering notes", "bench": "Benchmarks"}
CODE = re.compile(r"(^```.*?^```[ \t]*$|(?<!`)`[^`\n]+`(?!`))", re.MULTILINE | re.DOTALL)
FORMULA = re.compile(r"\$\$(.+?)\$\$|(?<![\w\\$])\$(?! )([^$]+?)(?<! )\$(?!\w)", re.DOTALL)
LINK = re.compile(r"(\]\((?!\w+:)[^)\s#]+)\.md\b")
LIST_AFTER_TEXT = re.compile(r"^(?!(?:[-*] |\d+\. |\||#|<|\s|```))(.+)\n(?=(?:[-*]|\d+\.) )", re.MULTILINE)
LENGTH = re.compile(r"\bcharacter\((?=len=\w+\()", re.IGNORECASE)
# FORD ends a length at its first comma; this looks like one, and is made one when FORD is done
COMMA = "\N{SINGLE LOW-9 QUOTATION MARK}"
WARNING = re.compile(r"^(?:Warning|Error)\b.*(?:\n {4,}.*|\n'.*)*", re.MULTILINE)


class Pages:
    """Markdown as FORD takes it; formulas are put in their places when FORD is done."""

    def __init__(self) -> None:
        self.formulas: list[str] = []

    def formula(self, match: re.Match) -> str:
        """A word in the place of a formula."""
        display = match[1] is not None
        text = latex2mathml.converter.convert(match[1] or match[2], display="block" if display else "inline")
        self.formulas.append(text)
        return f"FORMULA{len(self.formulas) - 1:05d}X"

    def converted(self, text: str) -> str:
        """A page with links to HTML, formulas by number, and an empty line before every list."""
        pieces = CODE.split(text)
        for at in range(0, len(pieces), 2):
            pieces[at] = LINK.sub(r"\1.html", FORMULA.sub(self.formula, pieces[at]))
        return LIST_AFTER_TEXT.sub(r"\1\n\n", "".join(pieces))

    def filled(self, text: str) -> str:
        """HTML with its formulas."""
        return re.sub(r"FORMULA(\d{5})X", lambda match: self.formulas[int(match[1])], text)


def lengths_without_commas(text: str) -> str:
    """A source whose lengths of texts hold no comma."""
    for match in LENGTH.finditer(text):
        end, depth = match.end(), 1
        while depth:
            depth += {"(": 1, ")": -1}.get(text[end], 0)
            end += 1
        text = text[:match.end()] + text[match.end():end].replace(",", COMMA) + text[end:]
    return text


def stage_source() -> None:
    """Copy the source; first words with a colon would be metadata, `*` emphasis, commas in a length its end."""
    for path in sorted((ROOT / "src").rglob("*.f90")):
        lines = path.read_text(encoding="utf-8").splitlines()
        for at, line in enumerate(lines):
            if doc := re.match(r"(\s*!> ?)(.*)", line):
                words = "".join(piece if odd % 2 else piece.replace("*", "\\*") for odd, piece in enumerate(CODE.split(doc[2])))
                first = at == 0 or not re.match(r"\s*!>", lines[at - 1])
                lines[at] = doc[1] + (re.sub(r"^([\w-]+):", r"\1&#58;", words) if first else words)
        write(STAGE / path.relative_to(ROOT), lengths_without_commas("\n".join(lines) + "\n"))


def stage_pages(pages: Pages) -> None:
    """Copy the pages, each with its title, and list those of a folder in its index."""
    sources = [ROOT / "CONTRIBUTING.md", ROOT / "CHANGELOG.md", *(ROOT / "doc").glob("*.md"), *(ROOT / "doc/notes").glob("*.md"),
               ROOT / "bench/README.md"]
    lists: dict[str, list[str]] = {folder: [] for folder in FOLDERS}
    for path in sorted(sources):
        text, short = path.read_text(encoding="utf-8"), path.relative_to(ROOT)
        title = re.search(r"^# (.+)$", text, re.MULTILINE)[1].replace("`", "")
        write(STAGE / "pages" / short, f"---\ntitle: {title}\n---\n{pages.converted(text.replace(f'# {title}', '', 1))}")
        lists[str(short.parent).removeprefix(".")].append(f"- [{title}]({short.stem}.html)")
    for folder in FOLDERS:
        inner = [f"- [{title}]({pathlib.PurePath(other).relative_to(folder)}/index.html)" for other, title in FOLDERS.items()
                 if other and str(pathlib.PurePath(other).parent).removeprefix(".") == folder]
        write(STAGE / "pages" / folder / "index.md", "\n".join([f"---\ntitle: {FOLDERS[folder]}\n---\n", *lists[folder], *inner]))
    front = pages.converted((ROOT / "README.md").read_text(encoding="utf-8"))
    write(STAGE / "README.md", re.sub(r"(\]\(|(?:src|href)=\")(?=(?:doc|bench|CONTRIBUTING|CHANGELOG)\b)", r"\1page/", front))


def write(path: pathlib.Path, text: str) -> None:
    """Write a file and the folders above it."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def run_ford() -> list[str]:
    """Run FORD on the copies; its warnings."""
    manifest = tomllib.loads((ROOT / "fpm.toml").read_text(encoding="utf-8"))
    shutil.copy(ROOT / "fpm.toml", STAGE)
    done = subprocess.run([pathlib.Path(sys.executable).parent / "ford", "README.md", "--config", f"version = '{manifest['version']}'"],
                          cwd=STAGE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, stdin=subprocess.DEVNULL)
    faults = [" ".join(warning.split()) for warning in WARNING.findall(done.stdout)]
    return faults or ([done.stdout] if done.returncode else [])


def finish(pages: Pages) -> None:
    """Put the formulas, the figures and the style sheet where the pages look for them."""
    for folder in ("doc", "bench"):
        shutil.copytree(ROOT / folder, OUTPUT / "page" / folder, dirs_exist_ok=True,
                        ignore=shutil.ignore_patterns("*.md", "*.py", "*.f90", "*.sh", "*.toml", "__pycache__", "build", "results"))
    bootstrap = pathlib.Path(importlib.util.find_spec("bootstrap").submodule_search_locations[0])
    for name in ("css/bootstrap.min.css", "js/bootstrap.bundle.min.js"):
        shutil.copy(bootstrap / name, OUTPUT / name)
    for path in OUTPUT.rglob("*.html"):
        text = path.read_text(encoding="utf-8")
        up = "../" * (len(path.relative_to(OUTPUT).parts) - 1)
        text = re.sub(r'"https://[^"]*/((?:css|js)/bootstrap[\w.]*)"[^>]*?(rel="stylesheet")?\s*(?:integrity[^>]*)?>', rf'"{up}\1" \2>', text)
        text = re.sub(r'<script[^>]*mathjax.*?</script>', "", text, flags=re.IGNORECASE | re.DOTALL)
        text = re.sub(r'#moduleprocedure-[^"]*', "", text)  # FORD sets no such anchors
        path.write_text(pages.filled(text).replace(COMMA, ","), encoding="utf-8")


class Reader(html.parser.HTMLParser):
    """Links and anchors of a page."""

    def __init__(self) -> None:
        super().__init__()
        self.links: set[str] = set()
        self.anchors: set[str] = set()

    def handle_starttag(self, tag, attrs):
        """Take what a tag links to and what it is called."""
        for name, value in attrs:
            if value and name in ("href", "src"):
                self.links.add(value)
            elif value and (name == "id" or (tag, name) == ("a", "name")):
                self.anchors.add(value)


def link_faults(folder: pathlib.Path) -> list[str]:
    """Links to files or anchors that are not there, and scripts, pictures or styles that would come over the network."""
    read = {}
    for path in sorted(folder.rglob("*.html")):
        read[path.resolve()] = reader = Reader()
        reader.feed(path.read_text(encoding="utf-8"))
    faults = []
    for path, reader in read.items():
        for link in sorted(reader.links):
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc:
                if re.search(r"\.(?:css|js)\b", link):
                    faults.append(f"{path.relative_to(folder.resolve())}: {link} needs the network")
                continue
            target = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path
            # a browser looks for the name as it is written, then for the one that the escapes stand for
            anchors = {parts.fragment, urllib.parse.unquote(parts.fragment)}
            if not target.is_file() or (parts.fragment and target in read and not anchors & read[target].anchors):
                faults.append(f"{path.relative_to(folder.resolve())}: {link} is not there")
    return faults


def main() -> int:
    """Everything; returns the exit code."""
    for folder in (STAGE, OUTPUT):
        shutil.rmtree(folder, ignore_errors=True)
    pages = Pages()
    stage_source()
    stage_pages(pages)
    faults = run_ford()
    if OUTPUT.is_dir():
        finish(pages)
        faults += link_faults(OUTPUT)
    for fault in faults:
        print(fault, file=sys.stderr)
    print(f"docs: {sum(1 for _ in OUTPUT.rglob('*.html'))} pages in {OUTPUT.relative_to(ROOT)}, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
