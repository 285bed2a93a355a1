"""Decks and tables as people's programs write them: marks, encodings, headings; and where mistakes are said to be."""

import pathlib
import re
import shutil
import subprocess

import h5py
import pytest

from conftest import ROOT, run

THESIS = (ROOT / "decks/thesis.nml").read_text(encoding="utf-8")
TABULATED = (ROOT / "decks/tabulated_lift.nml").read_text(encoding="utf-8")
LIFT = (ROOT / "decks/tables/polynomial_lift.txt").read_text(encoding="utf-8")
ROWS = "".join(line for line in LIFT.splitlines(keepends=True) if line.strip() and not line.startswith(("#", "!")))
DECK, FILE = 3, 6


def check(camroller, path, *options):
    """Check a deck."""
    return run(camroller, "check", path, *options)


def check_table(camroller, folder, table):
    """Check a deck with a lift table."""
    (folder / "tables").mkdir()
    (folder / "tables/polynomial_lift.txt").write_text(table, encoding="utf-8")
    (folder / "deck.nml").write_text(TABULATED, encoding="utf-8")
    return check(camroller, folder / "deck.nml"), f"{folder}/tables/polynomial_lift.txt"


@pytest.mark.parametrize("text", [THESIS, THESIS.replace("\n", "\r\n"), THESIS.replace("\n", "\r"), "! \u00fc\n" + THESIS])
def test_a_byte_order_mark_is_skipped(camroller, tmp_path, text):
    path = tmp_path / "deck.nml"
    path.write_bytes(b"\xef\xbb\xbf" + text.encode("utf-8"))
    assert check(camroller, path).returncode == 0
    assert subprocess.run([camroller, "check", "-"], input=path.read_bytes(), capture_output=True, check=False).returncode == 0
    path.write_bytes(b"\xef\xbb\xbf&rolle mass_kg = 1 /\n")
    assert f"{path}:1:1: unknown group &rolle; did you mean 'roller'?" in check(camroller, path).stderr


@pytest.mark.parametrize(("content", "words"), [
    (THESIS.encode("utf-16"), "is a text in UTF-16; save it in UTF-8"),
    (THESIS.encode("utf-16-be"), "is not a text file: it contains bytes that do not occur in text"),
    (b"\x89HDF\r\n\x1a\n" + bytes(range(1, 256))*4, "is not a text file: it contains bytes that do not occur in text"),
    (b"\x7fELF\x02\x01\x01" + b"\x90"*400, "is not a text file: it contains bytes that do not occur in text"),
])
def test_a_binary_deck_is_refused_without_quoting_it(camroller, tmp_path, content, words):
    path = tmp_path / "deck.nml"
    path.write_bytes(content)
    result = check(camroller, path)
    assert result.returncode == FILE
    assert result.stderr == f"camroller: '{path}' {words}\n"


@pytest.mark.parametrize(("old", "new", "is_told"), [
    ("mass_kg = 0.0088", "mass_kg = 0.0088\u00a0", True), ("mass_kg = 0.0088", "mass_kg =\u00a00.0088", True),
    ("mass_kg = 0.0088", "mass_kg = 0.0088  ! 8.8\u00a0g", False), ("title = '", "title = '8.8\u00a0g, ", False)])
def test_a_no_break_space_is_told_but_in_texts_and_comments(camroller, tmp_path, old, new, is_told):
    assert old in THESIS
    (tmp_path / "deck.nml").write_text(THESIS.replace(old, new), encoding="utf-8")
    result = check(camroller, tmp_path / "deck.nml")
    assert result.returncode == (DECK if is_told else 0), result.stderr
    assert ("of this line is a no-break space, which looks like a blank and is none" in result.stderr) == is_told


def test_messages_are_readable_for_a_deck_in_another_encoding(camroller, tmp_path):
    path = tmp_path / "deck.nml"
    path.write_bytes(b"! gr\xf6\xdfe\n" + THESIS.encode("utf-8"))
    result = check(camroller, path)
    assert result.returncode == DECK and "! gr??e" in result.stderr
    path.write_bytes(b"&roller gr\xf6\xdfe = 1 /\n")
    assert "gr??e" in check(camroller, path).stderr


@pytest.mark.parametrize("heading", [
    "angle lift\n", "cam angle [deg], lift [mm]\n", "# a comment\n\nangle_deg;lift_mm\n", '"Angle";"Lift 1"\n', "lift\n", "phi s 1 2 3\n"])
def test_a_heading_of_a_table_is_skipped(camroller, tmp_path, heading):
    result, table = check_table(camroller, tmp_path, heading + ROWS)
    assert result.returncode == 0, result.stderr
    pathlib.Path(table).write_text(ROWS, encoding="utf-8")
    assert result.stdout == check(camroller, tmp_path / "deck.nml").stdout


@pytest.mark.parametrize(("heading", "words"), [
    ("cam_angle [deg], valve_lift [mm]\n", ""), ("Cam angle [deg];Valve lift [mm]\n", ""), ("cam_angle [deg] valve_lift [mm]\n", ""),
    ("phi [deg], h [furlong]\n", ""), ("cam_angle valve_lift\n", ""),
    ("cam_angle [rad], valve_lift [mm]\n", "'rad', not angles in degrees"), ("phi [rad] s [mm]\n", "'rad', not angles in degrees"),
    ("crank_angle [deg], lift [mm]\n", "'crank_angle', not cam_angle in its first column"),
    ("Crank angle; lift\n", "'crank_angle', not cam_angle in its first column"),
    ("cam_angle [deg], roller_lift [mm]\n", "'roller_lift', not valve_lift in its second column"),
    ("polar_angle [deg], cam_radius [mm]\n", "'polar_angle', not cam_angle in its first column"),
    ("angle, lift [um]\n", "'um', not 'mm'"), ("cam_angle, valve_lift [m]\n", "'m', not 'mm'"),
    ("cam_angle_deg, valve_lift_mm\n", ""), ("cam_angle (deg) valve_lift (mm)\n", ""), ("cam_angle_deg valve_lift_um\n", "'um', not 'mm'"),
    ("cam_angle(deg);valve_lift(um)\n", "'um', not 'mm'"), ("a_rad s_mm\n", "'rad', not angles in degrees"), ("phi_m h_m\n", ""),
    ("crank_angle_deg, lift_mm\n", "'crank_angle', not cam_angle in its first column"),
])
def test_a_heading_that_says_something_else_than_the_deck_is_refused(camroller, tmp_path, heading, words):
    result, _ = check_table(camroller, tmp_path, heading + ROWS)
    assert result.returncode == (DECK if words else 0), result.stderr
    assert (f"the heading of the table has {words}" in result.stderr) == bool(words)
    assert result.stderr.count("the heading of the table") == bool(words)


@pytest.mark.parametrize(("heading", "words"), [
    ("cam_angle [deg], pressure [bar]\n", ""), ("angle, p\n", ""), ("cam_angle [deg], pressure [MPa]\n", "'MPa', not 'bar'"),
    ("cam_angle_deg pressure_MPa\n", "'MPa', not 'bar'"), ("cam_angle_deg pressure_of_cylinder_kpa\n", "'kPa', not 'bar'"),
    ("cam_angle_deg pressure_bar\n", ""), ("cam_angle (deg), pressure (MPa)\n", "'MPa', not 'bar'"),
    ("crank_angle [deg], pressure [bar]\n", "'crank_angle', not cam_angle in its first column"),
    ("cam_angle, valve_lift\n", "'valve_lift', not pressure in its second column")])
def test_a_heading_of_a_table_of_pressure_is_checked(camroller, tmp_path, heading, words):
    shutil.copytree(ROOT / "decks/tables", tmp_path / "tables")
    shutil.copy(ROOT / "decks/three_cam_head.nml", tmp_path / "deck.nml")
    (table,) = (tmp_path / "tables").glob("*pressure*")
    rows = [line for line in table.read_text().splitlines(keepends=True) if line[:1] in "0123456789- "]
    table.write_text(heading + "".join(rows))
    result = check(camroller, tmp_path / "deck.nml")
    assert result.returncode == (DECK if words else 0), result.stderr
    assert (f"the heading of the table has {words}" in result.stderr) == bool(words)


@pytest.mark.parametrize(("table", "line", "words"), [
    ("nan nan\n" + ROWS, 1, "'nan' is no finite number"),
    ("inf 0\n" + ROWS, 1, "'inf' is no finite number"),
    ("0 zero\n" + ROWS, 1, "'zero' is no finite number"),
    ("angle lift\nangle lift\n" + ROWS, 2, "'angle' is no finite number"),
    (ROWS + "angle lift\n", ROWS.count("\n") + 1, "'angle' is no finite number"),
])
def test_a_line_of_words_in_another_place_is_a_mistake(camroller, tmp_path, table, line, words):
    result, path = check_table(camroller, tmp_path, table)
    assert result.returncode == DECK
    assert f"{path}:{line}:1: {words}" in result.stderr or f"{path}:{line}:3: {words}" in result.stderr


def test_every_mistake_of_a_table_is_counted(camroller, tmp_path):
    result, path = check_table(camroller, tmp_path, "\n".join(f"{i} x" for i in range(100)))
    assert result.returncode == DECK
    lines = result.stderr.splitlines()
    assert lines[0] == f"camroller: 100 mistakes in {path}"
    assert lines[1].startswith(f"{path}:1:3: 'x' is no finite number")
    assert lines[-1] == "... and 80 more"


def test_a_table_with_too_few_rows_is_named_in_the_message(camroller, tmp_path):
    result, path = check_table(camroller, tmp_path, "".join(ROWS.splitlines(keepends=True)[:5]))
    assert result.stderr == f"camroller: {path}: the table has 5 of at least 8 rows\n"


def test_mistakes_in_the_deck_and_in_set_values_are_counted_separately(camroller, tmp_path):
    path = tmp_path / "deck.nml"
    path.write_text(THESIS.replace("mass_kg", "mas_kg"), encoding="utf-8")
    result = check(camroller, path, "--set", "film.law=moess", "--set", "nothing=1")
    assert result.stderr.splitlines()[0] == \
        f"camroller: 1 mistake in {path}, 2 in values given beside the deck (--set)"
    result = check(camroller, ROOT / "decks/thesis.nml", "--set", "film.law=moess", "--set", "nothing=1")
    assert result.stderr.splitlines()[0] == "camroller: 2 mistakes in values given beside the deck (--set)"


def test_mistakes_in_a_table_of_cases_name_its_lines(camroller, tmp_path):
    shutil.copy(ROOT / "decks/thesis.nml", tmp_path / "deck.nml")
    text = THESIS[:THESIS.index("&sweep")] + "&sweep\n kind = 'table'\n table = 'cases.csv'\n/\n"
    (tmp_path / "deck.nml").write_text(text, encoding="utf-8")
    table = tmp_path / "cases.csv"
    table.write_text("# cases\nroller.mass_kg, film.law\n0.01, moes\n\n-1, moes\n0.02, moess\n", encoding="utf-8")
    errors = check(camroller, tmp_path / "deck.nml").stderr
    assert f"2 mistakes in {table}" in errors
    assert f"{table}:5: value 2 of roller.mass_kg: 'mass_kg' must be" in errors
    assert f"{table}:6: value 3 of film.law: 'law' must be" in errors
    table.write_text("roller.mass_kg, film.law\n0.01, moes\n0.01\n", encoding="utf-8")
    assert f"{table}:3: this row has 1 column, the heading has 2\n" in check(camroller, tmp_path / "deck.nml").stderr
    table.write_text("roller.mass_kg\n", encoding="utf-8")
    assert f"{table}: the table has no cases" in check(camroller, tmp_path / "deck.nml").stderr


@pytest.mark.parametrize(("text", "words"), [
    ("600 60\n900 60\n", ":1: the first line of a table of cases holds the names of its columns, as operating_point.speed_rpm, and no numbers"),
    ("operating_point.speed_rpm, measured.torque [N m]\n600, 0.1\n", ":1: a name with a blank, as 'measured.torque [N m]', stands in quotes"),
])
def test_a_table_of_cases_without_names_says_what_belongs_there(camroller, tmp_path, text, words):
    (tmp_path / "cases.csv").write_text(text, encoding="utf-8")
    deck = re.sub(r"&sweep.*", "&sweep kind = 'table' table = 'cases.csv' /\n", THESIS, flags=re.S)
    (tmp_path / "deck.nml").write_text(deck, encoding="utf-8")
    result = check(camroller, tmp_path / "deck.nml")
    assert result.returncode == DECK and words in result.stderr


@pytest.mark.parametrize(("text", "words"), [
    ("operating_point.speed_rpm;operating_point.oil_temperature_degC\n600,5;60\n900;60\n",
     ":2: '600,5' has a comma, which parts no columns in the heading; decimals have a point"),
    ("operating_point.speed_rpm,operating_point.oil_temperature_degC\n600,5,60\n900,60\n",
     ":2: this row has 3 columns, the heading has 2; a comma parts columns, decimals have a point"),
    ("operating_point.speed_rpm, measured.torque [N m]\n600, 0.1\n900, 0.2\n", ":1: a name with a blank"),
])
def test_a_table_of_cases_has_one_mistake_for_one_reason(camroller, tmp_path, text, words):
    (tmp_path / "cases.csv").write_text(text, encoding="utf-8")
    deck = re.sub(r"&sweep.*", "&sweep kind = 'table' table = 'cases.csv' /\n", THESIS, flags=re.S)
    (tmp_path / "deck.nml").write_text(deck, encoding="utf-8")
    errors = check(camroller, tmp_path / "deck.nml").stderr
    assert words in errors and errors.count("cases.csv:") == 1


NAMES = ("operating_point.speed_rpm", "operating_point.oil_temperature_degC", '"measured.torque [N mm]"')


@pytest.mark.parametrize(("mark", "row", "words"), [
    (";", "600,5;60;", "'600,5' has a comma, which parts no columns in the heading; decimals have a point"),
    (" ", "600,5 60", "'600,5' has a comma, which parts no columns in the heading; decimals have a point"),
    (";", "600;60;", "column 3 is empty: measured.torque [N mm] needs a value; '-' stands where nothing was measured"),
    (",", "600, ,60", "column 2 is empty: operating_point.oil_temperature_degC needs a value"),
    (",", ",60,41", "column 1 is empty: operating_point.speed_rpm needs a value"),
    (";", "600;60;41;", "column 4 is empty"),
    (";", "600;60;41; # a comment", "column 4 is empty"),
    (",", "600 60, 41", "',' parts columns, as in the heading; there is none before '60', and a text with a blank stands in quotes"),
    ("\t", "600\t\t60", "this row has 2 columns, the heading has 3"),
    (";", "600,60,41", "this row has 1 column, the heading has 3"),
])
def test_an_empty_cell_of_a_table_of_cases_moves_no_other(camroller, tmp_path, mark, row, words):
    """What parts the names parts the values; a decimal comma never becomes a column in silence."""
    path = tmp_path / "cases.csv"
    path.write_text(mark.join(NAMES) + f"\n700{mark}60{mark}-\n{row}\n", encoding="utf-8")
    deck = re.sub(r"&sweep.*", "&sweep kind = 'table' table = 'cases.csv' /\n", THESIS, flags=re.S)
    (tmp_path / "deck.nml").write_text(deck, encoding="utf-8")
    result = check(camroller, tmp_path / "deck.nml")
    shown_row = row.replace("\t", " ")
    assert result.returncode == DECK
    assert result.stderr == f"camroller: {path}:3: {words}\n    3 | {shown_row}\n"
    # names and rows that all end so have no empty column, and lines of nothing else are none
    if mark != "\t":
        path.write_text(mark.join(NAMES) + f"{mark}\n700{mark}60{mark}-{mark}\n{mark}{mark}{mark}\n700{mark}80{mark}-\n", encoding="utf-8")
        result = check(camroller, tmp_path / "deck.nml")
        assert result.returncode == 0 and "is valid: 2 cases" in result.stdout, result.stderr


def test_a_column_without_a_name_is_a_mistake(camroller, tmp_path):
    (tmp_path / "cases.csv").write_text(",operating_point.speed_rpm\n0,600\n", encoding="utf-8")
    deck = re.sub(r"&sweep.*", "&sweep kind = 'table' table = 'cases.csv' /\n", THESIS, flags=re.S)
    (tmp_path / "deck.nml").write_text(deck, encoding="utf-8")
    assert "cases.csv:1: column 1 is empty\n" in check(camroller, tmp_path / "deck.nml").stderr


def test_a_comment_in_a_table_of_cases_begins_with_its_word(camroller, tmp_path):
    """Anywhere else its sign is a part of the word; nothing is cut off in silence."""
    (tmp_path / "cases.csv").write_text("# a title!\ncase.title operating_point.speed_rpm ! names\nrun#3 600 # the first\n"
                                        "'run #4' 700 !\n\"it's #5!\" 800\n", encoding="utf-8")
    deck = re.sub(r"&sweep.*", "&sweep kind = 'table' table = 'cases.csv' /\n", THESIS, flags=re.S)
    (tmp_path / "deck.nml").write_text(deck + "&output angle_step_deg = 10 /\n", encoding="utf-8")
    subprocess.run([camroller, "sweep", "deck.nml", "--quiet"], cwd=tmp_path, check=True, capture_output=True)
    with h5py.File(tmp_path / "deck.h5") as file:
        assert [text.decode() for text in file["sweep/case.title"]] == ["run#3", "run #4", "it's #5!"]
        assert list(file["sweep/operating_point.speed_rpm"]) == [600, 700, 800]


def test_text_that_is_no_utf8_is_refused_with_its_line(camroller, tmp_path):
    """A result holds its deck, and readers of the file take UTF-8 alone."""
    path = tmp_path / "deck.nml"
    lines = THESIS.splitlines()
    lines.insert(4, "! geprüft")
    path.write_bytes("\n".join(lines).encode("latin-1"))
    result = check(camroller, path)
    assert result.returncode == DECK and f"{path}:5:7: byte 7 of this line is no UTF-8" in result.stderr
    path.write_bytes("\n".join(lines).encode("utf-8"))
    assert check(camroller, path).returncode == 0
    (tmp_path / "cases.csv").write_bytes("# geprüft\noperating_point.speed_rpm\n600\n".encode("latin-1"))
    path.write_text(re.sub(r"&sweep.*", "&sweep kind = 'table' table = 'cases.csv' /\n", THESIS, flags=re.S), encoding="utf-8")
    assert f"{tmp_path / 'cases.csv'}:1: byte 7 of this line is no UTF-8" in check(camroller, path).stderr
    words = subprocess.run([camroller, "check", "decks/thesis.nml", "--set", b"case.title=gepr\xfcft"], cwd=ROOT, capture_output=True,
                           check=False)
    assert words.returncode == DECK and b"the value is no UTF-8" in words.stderr
    # a byte that continues nothing, a character cut off, written too long, half a pair, beyond the last one
    for wrong in (b"\x80", b"\xe2\x82", b"\xe0\x80\xaf", b"\xed\xa0\x80", b"\xf4\x90\x80\x80"):
        path.write_bytes(THESIS.encode() + b"! " + wrong)
        result = subprocess.run([camroller, "check", path], cwd=ROOT, capture_output=True, check=False)
        assert result.returncode == DECK and b"byte 3 of this line" in result.stderr
    path.write_bytes(THESIS.encode() + "! é € 𝛼 \ud7ff\U0010ffff".encode())
    assert check(camroller, path).returncode == 0


@pytest.mark.parametrize(("options", "words", "keys"), [
    (["mechanism.pivot_to_cam_mm=60"], "no closed triangle on the base circle: mechanism.pivot_to_roller_mm = 20.8, "
     "mechanism.pivot_to_cam_mm = 60 and mechanism.base_radius_mm + roller.radius_mm = 18 + 8.5",
     ["mechanism.pivot_to_roller_mm = 20.8", "mechanism.base_radius_mm = 18", "roller.radius_mm = 8.5"]),
    (["mechanism.valve_axis_angle_deg=-120"], "the triangle's angle at the pivot, 56.5324 deg",
     ["mechanism.roller_arm_angle_deg = -3.5"]),
    (["lift.max_lift_mm=30"], "smaller than roller.radius_mm = 8.5", ["mechanism.base_radius_mm = 18", "roller.radius_mm = 8.5"]),
    (["spring.precompression_mm=0.01"], "the closed spring holds 0.25 N", ["spring.stiffness_N_m = 25000"]),
])
def test_a_message_on_impossible_geometry_has_values_keys_and_lines(camroller, tmp_path, options, words, keys):
    path = ROOT / "decks/thesis.nml"
    changes = [word for option in options for word in ("--set", option)]
    for command in (["check", path], ["run", path, "-o", tmp_path / "x.h5"]):
        result = run(camroller, *command, *changes)
        assert result.returncode in (DECK, 4)
        lines = [line for line in result.stderr.splitlines() if not line.startswith("remark: ")]  # on numbers that are unusual
        assert words in lines[0]
        for key in keys:
            number = next(int(line.split(":")[1]) for line in lines[1:] if line.startswith(f"{path}:") and line.endswith(key))
            name, value = key.split(".", 1)[1].split(" = ")
            assert THESIS.splitlines()[number - 1].split("!")[0].split("=")[0].strip() == name
            assert float(THESIS.splitlines()[number - 1].split("!")[0].split("=")[1]) == float(value)
        if options[0].split("=")[0] in lines[0].split("; ")[0]:
            assert f"override: {options[0]}" in lines


def test_numbers_beyond_the_bounds_of_their_unit_are_refused(camroller):
    for option, words in {
        "materials.cam_modulus_GPa=1e-310": "'cam_modulus_GPa' must be from 1e-12 to 1000000, not 1e-310",
        "materials.cam_modulus_GPa=1e300": "'cam_modulus_GPa' must be from 1e-12 to 1000000, not 1e300",
        "output.angle_step_deg=1e-310": "'angle_step_deg' must be from 1e-9 to 100000, not 1e-310",
        "cam_bearings.diameter_mm=1e300": "'diameter_mm' must be from 1e-9 to 1000000, not 1e300",
        "cam_bearings.cam_positions_mm=-1e300": "'cam_positions_mm' must be 0, or from 1e-9 to 1000000 in size, not -1e300",
        "lift.exponents=50000": "'exponents' must be from 1 to 200, not 50000",
    }.items():
        result = check(camroller, ROOT / "decks/thesis.nml", "--set", option)
        assert result.returncode == DECK
        assert words in result.stderr


def test_reading_a_deck_leaks_no_memory(camroller):
    """With a sweep, and a value beside the deck that is wrong, so that nothing is computed."""
    valgrind = shutil.which("valgrind")
    if not valgrind:
        pytest.skip("valgrind is not there")
    result = subprocess.run([valgrind, "--leak-check=full", "--errors-for-leak-kinds=definite", "--error-exitcode=99", "-q", camroller,
                             "check", "decks/thesis.nml", "--set", "nothing=1"], cwd=ROOT, capture_output=True, text=True,
                            stdin=subprocess.DEVNULL, timeout=300)
    assert result.returncode == DECK, result.stderr
