"""Decks that share files: the lines of an included file count as its own, in messages, results and repetitions."""

import h5py

from conftest import ROOT, run


def split_deck(folder, change=("", "")):
    """thesis.nml with its oil in a file of its own, which includes another one."""
    text = (ROOT / "decks/thesis.nml").read_text(encoding="utf-8")
    first, last = text.index("&lubricant"), text.index("&film")
    oil, rest = text[first:last], text[:first] + "include = 'parts/oil.nml'\n" + text[last:]
    (folder / "parts").mkdir()
    (folder / "parts/oil.nml").write_text("! an oil\n" + oil.replace(*change) + 'include = "output.nml"\n', encoding="utf-8")
    (folder / "parts/output.nml").write_text("&output\n   angle_step_deg = 1\n/\n", encoding="utf-8")
    deck = folder / "deck.nml"
    deck.write_text(rest, encoding="utf-8")
    return deck


def test_included_lines_are_part_of_the_deck(camroller, tmp_path):
    deck = split_deck(tmp_path)
    result = run(camroller, "check", deck)
    assert result.returncode == 0, result.stderr
    assert "angle_step_deg = 1\n" in result.stdout and "viscosity_points_Pa_s = 0.15" in result.stdout


def test_result_of_a_split_deck_can_be_repeated_without_the_files(camroller, tmp_path):
    deck = split_deck(tmp_path)
    result = run(camroller, "run", deck, "-o", tmp_path / "a.h5", "--quiet")
    assert result.returncode == 0, result.stderr
    (tmp_path / "parts/oil.nml").unlink()
    with h5py.File(tmp_path / "a.h5") as file:
        assert "viscosity_points_Pa_s" in str(file["deck/text"][()])
    result = run(camroller, "rerun", tmp_path / "a.h5")
    assert result.returncode == 0, result.stderr + result.stdout


def test_a_mistake_in_an_included_file_has_its_file_and_line(camroller, tmp_path):
    deck = split_deck(tmp_path, ("pressure_law = 'cameron'", "pressure_law = 'cameroon'"))
    deck.write_text(deck.read_text(encoding="utf-8").replace("law = 'dowson_higginson'", "law = 'dowson'"), encoding="utf-8")
    result = run(camroller, "check", deck)
    assert result.returncode == 3
    oil = (tmp_path / "parts/oil.nml").read_text(encoding="utf-8").splitlines()
    own = deck.read_text(encoding="utf-8").splitlines()
    line = next(i for i, text in enumerate(oil, 1) if "cameroon" in text)
    assert f"{tmp_path}/parts/oil.nml:{line}:" in result.stderr
    line = next(i for i, text in enumerate(own, 1) if "'dowson'" in text)
    assert f"{deck}:{line}:" in result.stderr
    assert " | " + oil[[("cameroon" in text) for text in oil].index(True)] in result.stderr


def test_missing_file_and_circle_are_mistakes(camroller, tmp_path):
    deck = split_deck(tmp_path)
    (tmp_path / "parts/output.nml").unlink()
    result = run(camroller, "check", deck)
    oil, output = tmp_path / "parts/oil.nml", tmp_path / "parts/output.nml"
    lines = oil.read_text(encoding="utf-8").splitlines()
    assert result.returncode == 3
    assert result.stderr == (f"camroller: {oil}:{len(lines)}:1: there is no file '{output}'\n{len(lines):5} | {lines[-1]}\n"
                             f"      | {'^' * len(lines[-1])}\n")
    output.write_text("include = 'oil.nml'\n", encoding="utf-8")
    result = run(camroller, "check", deck)
    assert result.returncode == 3
    assert result.stderr.startswith(f"camroller: {output}:1:1: '{oil}' includes '{output}', which includes '{oil}'\n")
    assert result.stderr.count("\n") == 3


def test_a_missing_file_is_told_with_the_line_of_the_deck(camroller, tmp_path):
    text = (ROOT / "decks/thesis.nml").read_text(encoding="utf-8")
    (tmp_path / "deck.nml").write_text("include = 'none.nml'\n" + text[text.index("&roller"):], encoding="utf-8")
    result = run(camroller, "check", "deck.nml", folder=tmp_path)
    assert result.returncode == 3
    assert result.stderr == "camroller: deck.nml:1:1: there is no file 'none.nml'\n    1 | include = 'none.nml'\n      | " + "^" * 20 + "\n"


def test_one_line_includes_one_file(camroller, tmp_path):
    deck = split_deck(tmp_path)
    text = deck.read_text(encoding="utf-8")
    for behind, works in (("", True), ("  ! the oil", True), (", 'parts/output.nml'", False), (" garbage", False), ("'", False)):
        deck.write_text(text.replace("'parts/oil.nml'", "'parts/oil.nml'" + behind), encoding="utf-8")
        result = run(camroller, "check", deck)
        assert result.returncode == (0 if works else 3), behind
        assert ("expected include = 'file', one file in a line" in result.stderr) != works


def test_a_deck_that_includes_itself_says_so(camroller, tmp_path):
    text = (ROOT / "decks/thesis.nml").read_text(encoding="utf-8")
    (tmp_path / "deck.nml").write_text("include = './deck.nml'\n" + text, encoding="utf-8")
    result = run(camroller, "check", "deck.nml", folder=tmp_path)
    assert result.returncode == 3
    assert result.stderr.startswith("camroller: ./deck.nml:1:1: './deck.nml' includes itself\n") and result.stderr.count("\n") == 3


def test_more_files_than_may_be_included_are_a_mistake(camroller, tmp_path):
    for i in range(12):
        (tmp_path / f"{i}.nml").write_text(f"include = '{i + 1}.nml'\n", encoding="utf-8")
    result = run(camroller, "check", "0.nml", folder=tmp_path)
    assert result.returncode == 3 and "10.nml:1:1: more than 10 included files\n" in result.stderr


def test_result_does_not_replace_an_included_file(camroller, tmp_path):
    deck = split_deck(tmp_path)
    result = run(camroller, "run", deck, "-o", tmp_path / "parts/oil.nml")
    assert result.returncode != 0 and (tmp_path / "parts/oil.nml").read_text(encoding="utf-8").startswith("! an oil")


def test_the_word_include_inside_a_group_includes_nothing(camroller, tmp_path):
    deck = tmp_path / "deck.nml"
    text = (ROOT / "decks/thesis.nml").read_text(encoding="utf-8")
    deck.write_text(text.replace("&film\n", "&film\n   include = 'film.nml'\n"), encoding="utf-8")
    result = run(camroller, "check", deck)
    assert result.returncode == 3 and "unknown key 'include' in &film" in result.stderr
