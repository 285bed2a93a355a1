"""What the pages name is there: targets of make, files, folders, links."""

import pathlib
import re

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "doc").rglob("*.md")), *sorted((ROOT / "bench").glob("*.md"))]
SPAN = re.compile(r"(?<!`)`([^`\n]+)`(?!`)")
BLOCK = re.compile(r"^```[a-z]*[ \t]*\n(.*?)^```[ \t]*$", re.MULTILINE | re.DOTALL)
FILE = re.compile(r"(?<![\w<*./-])[\w./-]+\.(?:f90|py|sh|md|nml|csv|txt|toml|png|h)(?![\w*.])")
FOLDER = re.compile(r"(?<![\w/.-])((?:src|app|test|post|tools|bench|doc|decks|slurm|mpi|example|include)(?:/[\w-]+)*)/?$")
# folders that git does not hold, and names that a page makes up for its reader
MADE = re.compile(r"^(?:results|build|\.venv)/|^(?:a|FILE|DECK|cases|earlier)\.\w+$")


def code_of(text):
    """What a page sets as code: words between single backquotes, lines of blocks."""
    blocks = BLOCK.findall(text)
    return [*SPAN.findall(BLOCK.sub("", text)), *(line for block in blocks for line in block.splitlines())]


def targets_of(pieces):
    """Targets of make in pieces of code that begin with make, and of those in brackets behind a word."""
    found = set()
    for piece in pieces:
        if words := re.match(r"make((?: +[a-z][a-z-]*(?![\w=]))+)", piece.strip()):
            found |= set(words[1].split())
    return found


def files_of(pieces):
    """Files and folders in pieces of code."""
    found = set()
    for piece in pieces:
        found |= {name for name in FILE.findall(piece) if not MADE.search(name)}
        found |= {match[1] for match in [FOLDER.match(piece)] if match}
    return found


def links_of(text):
    """Pages and figures that a page links to."""
    return {link.split("#")[0] for link in re.findall(r"\]\(([^)\s]+)\)", text) if "://" not in link and not link.startswith("#")}


def targets_of_make():
    """Targets of the Makefile."""
    return set(re.findall(r"^([a-z][a-z-]*):(?!=)", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE))


@pytest.fixture(name="tree", scope="module")
def a_tree():
    """Every file and folder of the project, with / before each part of its path."""
    tops = [top for top in ROOT.iterdir() if top.name not in ("build", "results", ".venv", ".git")]
    files = [path for top in tops for path in (top, *top.rglob("*"))]
    return {f"/{path.relative_to(ROOT)}" for path in files}


def is_there(name, tree):
    """Is it a path, or the end of one, as `deck/deck.f90` is of `src/deck/deck.f90`?"""
    return any(path.endswith("/" + name.rstrip("/").removeprefix("../").removeprefix("./")) for path in tree)


def test_what_a_page_names_is_found():
    text = "`make run` and ```sh\n```\n\n```sh\nmake check-style  # so\nsrc/deck/deck.f90\n```\n`results/a.md` [x](y.md#z) `doc/b.md`\n"
    assert targets_of(code_of(text)) == {"run", "check-style"}
    assert files_of(code_of(text)) == {"src/deck/deck.f90", "doc/b.md"}
    assert links_of(text) == {"y.md"}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_everything_named_is_there(page, tree):
    text = page.read_text(encoding="utf-8")
    pieces = code_of(text)
    missing = [f"make {target}" for target in sorted(targets_of(pieces) - targets_of_make())]
    missing += [name for name in sorted(files_of(pieces)) if not is_there(name, tree)]
    missing += [link for link in sorted(links_of(text)) if not (page.parent / link).exists()]
    assert missing == []


def test_help_lists_every_target():
    """All but the parts of `check` and what writes the commit for others."""
    listed = re.findall(r"^([a-z-]+):.*## ", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE)
    inner = {name for name in targets_of_make() if name.startswith("check-")} | {"commit"}
    assert sorted({*listed} | inner) == sorted(targets_of_make()) and not inner & {*listed}


def test_the_table_of_throughput_is_the_one_that_was_measured():
    text = (ROOT / "doc/notes/batch.md").read_text(encoding="utf-8")
    shown = re.search(r"<!-- table: (\S+) -->\n```\n(.*?)```\n<!-- end of table -->", text, re.DOTALL)
    assert shown[2] == (ROOT / shown[1]).read_text(encoding="utf-8")


def test_every_folder_of_the_source_is_in_the_table_of_folders():
    text = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    table = re.search(r"<!-- folders -->\n(.*?)<!-- end of folders -->", text, re.DOTALL)[1]
    listed = re.findall(r"^\| `([\w/]+)` \|", table, re.MULTILINE)
    folders = {str(path.parent.relative_to(ROOT)) for path in (ROOT / "src").rglob("*.f90")} - {"src"}
    assert sorted(listed) == sorted(folders | {"app"})
