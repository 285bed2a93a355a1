"""The layer check finds what it is there to find."""

import pytest
from check_layers import main, read_table
from fortran_source import ROOT

TABLE = """<!-- folders -->
| folder | holds | may use |
|---|---|---|
| `app` | the program | all |
| `src/deck` | decks | base, case |
| `src/case` | cases | base, numerics |
| `src/numerics` | roots | base |
| `src/base` | kinds | nothing |
<!-- end of folders -->
"""


def write(root, files, table=TABLE):
    """Write modules: path without suffix -> names of used modules."""
    (root / "app").mkdir()
    (root / "CONTRIBUTING.md").write_text(table, encoding="utf-8")
    for path, used in files.items():
        target = root / f"{path}.f90"
        target.parent.mkdir(parents=True, exist_ok=True)
        uses = "".join(f"   use camroller_{name}, only : x\n" for name in used)
        target.write_text(f"module camroller_{target.stem}\n{uses}   implicit none\nend module\n", encoding="utf-8")


def faults(root, capsys):
    """Exit code and lines on the error unit, without those on rights that the few files of a test do not use."""
    code = main(["--root", str(root)])
    return code, [line for line in capsys.readouterr().err.splitlines() if "which none of its files does" not in line]


def test_use_of_a_lower_folder_passes(tmp_path, capsys):
    write(tmp_path, {"src/base/kinds": [], "src/numerics/roots": ["kinds"], "src/case/model": ["roots", "film"],
                     "src/case/film": ["kinds"], "src/deck/deck": ["model", "film", "kinds"], "src/capi": ["deck", "roots"]})
    assert faults(tmp_path, capsys) == (0, [])


@pytest.mark.parametrize(("user", "used"), [
    ("base/a", "numerics/b"), ("numerics/a", "case/film"), ("case/film", "deck/b"), ("deck/a", "numerics/b"), ("base/a", "deck/b")])
def test_use_of_a_higher_folder_fails_with_its_line(tmp_path, capsys, user, used):
    name = used.split("/")[1]
    write(tmp_path, {f"src/{user}": [name], f"src/{used}": []})
    code, lines = faults(tmp_path, capsys)
    assert code == 1
    assert lines == [f"src/{user}.f90:2: {user.split('/')[0]} may not use camroller_{name} of {used.split('/')[0]}"]


def test_use_of_the_app_fails(tmp_path, capsys):
    write(tmp_path, {"app/cli": [], "src/case/a": ["cli"]})
    code, lines = faults(tmp_path, capsys)
    assert code == 1
    assert "case may not use camroller_cli of app" in lines[0]


def test_a_right_that_no_file_uses_is_reported(tmp_path, capsys):
    write(tmp_path, {"src/base/kinds": [], "src/numerics/roots": [], "src/case/model": ["kinds", "roots"], "src/deck/deck": ["model"]})
    assert main(["--root", str(tmp_path)]) == 1
    assert capsys.readouterr().err.splitlines() == [f"CONTRIBUTING.md: folder '{folder}' may use 'base', which none of its files does"
                                                    for folder in ("deck", "numerics")]


def test_a_circle_of_files_is_reported(tmp_path, capsys):
    write(tmp_path, {"src/case/a": ["b"], "src/case/b": ["c"], "src/case/c": ["a"]})
    code, lines = faults(tmp_path, capsys)
    assert code == 1
    assert lines == ["circle: src/case/a.f90 -> src/case/b.f90 -> src/case/c.f90 -> src/case/a.f90"]


def test_a_folder_missing_from_the_table_fails(tmp_path, capsys):
    write(tmp_path, {"src/misc/a": []})
    code, lines = faults(tmp_path, capsys)
    assert code == 1
    assert lines == ["src/misc/a.f90: folder 'misc' is not in the table of folders of CONTRIBUTING.md"]


def test_a_row_that_names_a_row_above_it_fails(tmp_path, capsys):
    write(tmp_path, {}, TABLE.replace("| base |\n", "| base, deck, gone |\n"))
    code, lines = faults(tmp_path, capsys)
    assert code == 1
    assert [line.split("'")[3] for line in lines] == ["deck", "gone"]


def test_use_in_strings_and_comments_is_ignored(tmp_path, capsys):
    write(tmp_path, {"src/deck/deck": []})
    text = "module camroller_kinds\n! use camroller_deck\ncharacter(40) :: a = 'use camroller_deck'\nend module\n"
    (tmp_path / "src/base").mkdir()
    (tmp_path / "src/base/kinds.f90").write_text(text, encoding="utf-8")
    assert faults(tmp_path, capsys)[1] == []


def test_no_folder_has_more_than_fifteen_files():
    counts = {name: len(list((ROOT / "src" / name).glob("*.f90"))) for name in read_table(ROOT) if name != "app"}
    assert max(counts.values()) <= 15 and min(counts.values()) > 0, counts


def test_layers_of_this_project_pass(capsys):
    assert main([]) == 0, capsys.readouterr().err
