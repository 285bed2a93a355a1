"""Decks and tables of a megabyte, whatever is in them, are read or refused with words of a length to be read.

Reading takes a time that grows as the size. What grows as its square takes minutes to hours here with run-time checks (100 kB of
`&` took over 100 s), what grows as the size a second or two: the limit of a minute tells them apart on any machine.
"""

import itertools

import pytest

from conftest import ROOT, run

THESIS = (ROOT / "decks/thesis.nml").read_text(encoding="utf-8")
MEGABYTE = 2**20
LIMIT = 60.0


def filled(piece):
    """A megabyte of a piece."""
    return piece*(MEGABYTE//len(piece))


def numbered(form):
    """A megabyte of different pieces."""
    text = []
    size = 0
    for number in itertools.count():
        text.append(form.format(number))
        size += len(text[-1])
        if size > MEGABYTE:
            return "".join(text)


LARGE = {
    "wrong lines": THESIS + filled("nothing of this kind\n"),
    "wrong keys": "&roller\n" + numbered("wrong_{} = 1\n") + "/\n",
    "keys of a group that is there twice": THESIS + "&roller\n" + numbered("wrong_{} = 1\n") + "/\n",
    "the same key": "&roller\n" + filled("mass_kg = 1\n") + "/\n",
    "ampersands": filled("&"),
    "groups": numbered("&g{} /\n"),
    "the same group": filled("&roller /\n"),
    "open groups": numbered("&g{}\n"),
    "slashes": THESIS + filled("/"),
    "one word on a line": "&roller " + filled("a") + " = 1 /",
    "one name of a group": "&" + filled("a"),
    "words on one line": "&roller mass_kg = " + filled("a ") + "/",
    "numbers on one line": "&roller mass_kg = " + filled("1, ") + "/",
    "digits": "&roller mass_kg = " + filled("1") + " /",
    "numbers on many lines": "&roller mass_kg = " + filled("1,\n") + "/",
    "brackets": "&roller " + filled("a(") + "/",
    "indexed keys": "&roller " + filled("a(1) = 2 ") + "/",
    "equals signs": "&roller " + filled("=") + "/",
    "quotes": "&roller " + filled("'") + "/",
    "open quotes": "&roller " + filled("mass_kg = '\n") + "/",
    "quoted text": "&case title = '" + filled("a") + "' /",
    "blanks": THESIS + filled(" "),
    "blank lines": THESIS + filled("\n"),
    "a comment": THESIS + "!" + filled("a"),
    "commas": "&roller mass_kg = " + filled(",") + "/",
    "umlauts": "&roller mass_kg = " + filled("\u00fc") + "/",
}


def read(camroller, path, *options):
    """Check a deck within the limit."""
    return run(camroller, "check", path, *options, timeout=LIMIT)


@pytest.mark.parametrize("name", LARGE)
def test_a_deck_of_a_megabyte_is_read_or_refused_with_a_short_message(camroller, tmp_path, name):
    deck = tmp_path / "large.nml"
    deck.write_text(LARGE[name], encoding="utf-8")
    result = read(camroller, deck)
    assert result.returncode == (0 if name in ("blanks", "blank lines", "a comment") else 3), result.stderr
    assert len(result.stderr) < 20000
    assert all(len(line) < 4000 for line in result.stderr.splitlines())


@pytest.mark.once
def test_a_long_list_of_a_sweep_is_read(camroller, tmp_path):
    deck = tmp_path / "long.nml"
    values = ", ".join(str(300 + number/100) for number in range(MEGABYTE//16))
    deck.write_text(THESIS[:THESIS.index("&sweep")] + f"&sweep\n key_1 = 'operating_point.speed_rpm'\n values_1 = {values}\n/\n",
                    encoding="utf-8")
    result = read(camroller, deck)
    assert result.returncode == 0, result.stderr
    assert f"{MEGABYTE//16} cases" in result.stdout
    last = values.rsplit(", ", 1)[1]
    deck.write_text(deck.read_text(encoding="utf-8").replace(f", {last}\n/", f", {last}, 300.0\n/"), encoding="utf-8")
    assert "value 300.0 of operating_point.speed_rpm is there twice" in read(camroller, deck).stderr


def test_the_first_mistakes_are_shown_and_the_others_counted(camroller, tmp_path):
    deck = tmp_path / "wrong.nml"
    deck.write_text(THESIS + "nothing\n"*4000, encoding="utf-8")
    result = read(camroller, deck)
    assert result.returncode == 3
    lines = result.stderr.splitlines()
    assert lines[0] == f"camroller: 4000 mistakes in {deck}"
    assert lines[-1] == "... and 3980 more"
    first = THESIS.count("\n") + 1
    assert [line.split(":")[1] for line in lines if line.startswith(f"{deck}:")] == [str(first + i) for i in range(20)]


def test_for_a_long_line_the_text_around_the_mistake_is_shown(camroller, tmp_path):
    deck = tmp_path / "long.nml"
    deck.write_text("&roller" + 3000*" " + "\u00fc"*300 + " mas_kg = 1 " + 3000*"b" + " /\n", encoding="utf-8")
    lines = read(camroller, deck).stderr.splitlines()
    place = next(number for number, line in enumerate(lines) if "'mas_kg'" in line)
    source, caret = lines[place + 1:place + 3]
    assert len(source) < 200
    assert source.split("| ")[1].startswith("...") and source.endswith("...")
    assert source[caret.index("^"):caret.rindex("^") + 1] == "mas_kg"


@pytest.mark.once
def test_a_table_of_a_megabyte_is_refused_with_a_short_message(camroller, tmp_path):
    deck = (ROOT / "decks/tabulated_lift.nml").read_text(encoding="utf-8")
    (tmp_path / "tables").mkdir()
    path = tmp_path / "deck.nml"
    path.write_text(deck, encoding="utf-8")
    for text in (filled("1 x\n"), filled("1 1\n"), "1 1\n" + filled("a"), filled("1 ")):
        (tmp_path / "tables/polynomial_lift.txt").write_text(text, encoding="utf-8")
        result = read(camroller, path)
        assert result.returncode == 3
        assert len(result.stderr) < 20000
        assert f"{tmp_path}/tables/polynomial_lift.txt:" in result.stderr
