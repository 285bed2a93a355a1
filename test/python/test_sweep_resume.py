"""Going on with a sweep: what is there already is told apart by its content, and no result is lost or taken for another."""

import re
import shutil
import signal
import subprocess
import time

import h5py
import pytest

from conftest import ROOT, done, run
from sweeps import GRID, same, write_deck

DECK, DOMAIN, FILE, UNFINISHED = 3, 4, 6, 8
CASES = 24
# ends a sweep after its first case or cases
STOP = ["--threads", 1, "--set", "sweep.wall_time_limit_s=1e-3"]
COARSE = ["--set", "output.angle_step_deg=10", "--set", "numerics.accuracy=1e-3", "--quiet"]


@pytest.fixture(scope="module")
def deck(tmp_path_factory):
    """A deck of 24 cases."""
    return write_deck(tmp_path_factory.mktemp("resume") / "deck.nml")


@pytest.fixture(scope="module")
def reference(camroller, deck):
    """Its result."""
    done(camroller, "sweep", deck, "--quiet", folder=deck.parent)
    return deck.with_suffix(".h5")


def partial_file(camroller, deck, folder):
    """A file of what a stopped sweep had done, its part files gone; the number of cases that it has."""
    assert run(camroller, "sweep", deck, *STOP, folder=folder).returncode == UNFINISHED
    done(camroller, "merge", deck, "--partial", folder=folder)
    for part in folder.glob("*.part-*"):
        part.unlink()
    with h5py.File(folder / "deck.h5") as file:
        return list(file["summary/status"]).count(0)


def test_a_partial_file_is_marked_as_such(camroller, deck, reference, tmp_path):
    there = partial_file(camroller, deck, tmp_path)
    assert 0 < there < CASES
    with h5py.File(tmp_path / "deck.h5") as file, h5py.File(reference) as whole:
        assert (file.attrs["complete"], file.attrs["missing_cases"]) == (0, CASES - there)
        assert (whole.attrs["complete"], "missing_cases" in whole.attrs) == (1, False)
        assert "-1 where it was not computed" in str(file["summary/status"].attrs["long_name"])


def test_parts_beside_any_file_are_an_error_without_resume(camroller, deck, reference, tmp_path):
    """Whatever has the name of the result: nothing, a partial file or a result of the same sweep."""
    assert run(camroller, "sweep", deck, *STOP, folder=tmp_path).returncode == UNFINISHED
    for there in ("nothing", "a partial file", "a result"):
        if there == "a partial file":
            done(camroller, "merge", deck, "--partial", folder=tmp_path)
        elif there == "a result":
            shutil.copy(reference, tmp_path / "deck.h5")
        before = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
        result = run(camroller, "sweep", deck, folder=tmp_path)
        assert result.returncode == FILE
        assert "exists from an unfinished sweep; continue it with --resume, or remove deck.h5.part-*" in result.stderr
        assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == before, there


def test_a_sweep_continues_after_a_partial_file_was_made(camroller, deck, reference, tmp_path):
    there = partial_file(camroller, deck, tmp_path)
    result = done(camroller, "sweep", deck, "--resume", folder=tmp_path)
    assert result.stdout.startswith(f"deck.h5: {CASES} cases in ")
    assert f"'deck.h5' has {there} of {CASES} cases, and their part files are gone: all cases are computed" in result.stderr
    assert same(reference, tmp_path / "deck.h5")


def test_a_sweep_continues_after_a_partial_file_of_an_earlier_version(camroller, deck, reference, tmp_path):
    """Whatever its attribute says, a file in which a case has not been computed is not complete."""
    partial_file(camroller, deck, tmp_path)
    with h5py.File(tmp_path / "deck.h5", "r+") as file:
        file.attrs["complete"] = 1
        del file.attrs["missing_cases"]
    done(camroller, "sweep", deck, "--resume", folder=tmp_path)
    assert same(reference, tmp_path / "deck.h5")


def test_resume_continues_from_the_parts_of_a_partial_file(camroller, deck, reference, tmp_path):
    stopped = run(camroller, "sweep", deck, *STOP, folder=tmp_path)
    done(camroller, "merge", deck, "--partial", folder=tmp_path)
    further = run(camroller, "sweep", deck, "--resume", *STOP, folder=tmp_path)
    assert further.returncode == UNFINISHED
    assert left(further) < left(stopped)
    done(camroller, "sweep", deck, "--resume", folder=tmp_path)
    assert same(reference, tmp_path / "deck.h5")


def left(result):
    """Cases to do, as a sweep that was stopped tells."""
    return int(re.search(r"with (\d+) of \d+ cases to do", result.stderr)[1])


def test_a_partial_file_can_be_read_and_computed_again(camroller, deck, reference, tmp_path):
    there = partial_file(camroller, deck, tmp_path)
    rows, complete = (done(camroller, "export", path, "--summary", folder=tmp_path).stdout.splitlines() for path in ("deck.h5", reference))
    assert len(rows) == len(complete)
    assert sum(row == other for row, other in zip(rows[-CASES:], complete[-CASES:])) == there
    again = done(camroller, "rerun", "deck.h5", folder=tmp_path)
    noun = "case is" if there == 1 else "cases are"
    assert again.stdout.startswith(f"deck.h5: {there} {noun} the same to the last bit, {CASES - there} ")
    with h5py.File(tmp_path / "deck.h5", "r+") as file:
        file["summary/mean_torque_drive"][0] *= 1 + 1e-15
    assert f"deck.h5: 1 of {there} " in run(camroller, "rerun", "deck.h5", folder=tmp_path).stderr


def test_a_partial_file_does_not_replace_a_complete_one(camroller, deck, reference, tmp_path):
    shutil.copy(reference, tmp_path / "deck.h5")
    done(camroller, "sweep", deck, "--shard", "2/3", "--quiet", folder=tmp_path)
    result = run(camroller, "merge", deck, "--partial", folder=tmp_path)
    assert result.returncode == FILE
    assert "'deck.h5' exists with all cases, and a partial file would replace it" in result.stderr
    assert same(reference, tmp_path / "deck.h5")


def test_a_partial_file_replaces_no_result_of_another_study(camroller, deck, reference, tmp_path):
    shutil.copy(reference, tmp_path / "deck.h5")
    other = ["--set", "roller.mass_kg=0.012"]
    done(camroller, "sweep", deck, *other, "--shard", "2/3", "--quiet", folder=tmp_path)
    result = run(camroller, "merge", deck, *other, "--partial", folder=tmp_path)
    assert result.returncode == FILE
    assert "'deck.h5' exists and is not a result of this sweep" in result.stderr
    assert "\na partial file does not replace it; move it away first\n" in result.stderr
    assert same(reference, tmp_path / "deck.h5")


def test_resume_does_not_replace_a_result_that_came_while_the_file_was_written(camroller, reference, tmp_path):
    """Stopped while the parts are joined; where it was too fast to be stopped, the parts are put there again."""
    long = write_deck(tmp_path / "long.nml", GRID.replace("count_1 = 6", "count_1 = 60"))
    for shard in ("1/2", "2/2"):
        done(camroller, "sweep", long, "-o", "x.h5", "--shard", shard, "--quiet", folder=tmp_path)
    parts = {path: path.read_bytes() for path in tmp_path.glob("x.h5.part-*")}
    for _ in range(20):
        for path, content in parts.items():
            path.write_bytes(content)
        sweep = subprocess.Popen([camroller, "sweep", long, "-o", "x.h5", "--resume", "--quiet"], cwd=tmp_path, stderr=subprocess.PIPE,
                                 text=True)
        while sweep.poll() is None and not list(tmp_path.glob("x.h5.unfinished-*")):
            pass
        sweep.send_signal(signal.SIGSTOP)
        is_caught = bool(list(tmp_path.glob("x.h5.unfinished-*"))) and not (tmp_path / "x.h5").exists()
        if is_caught:
            shutil.copy(reference, tmp_path / "x.h5")
        sweep.send_signal(signal.SIGCONT)
        words = sweep.communicate(timeout=300)[1]
        if is_caught:
            break
        (tmp_path / "x.h5").unlink()
    assert is_caught and sweep.returncode == FILE and "'x.h5' exists and is not a result of this sweep: " in words
    assert same(reference, tmp_path / "x.h5") and all(path.exists() for path in parts)


def test_resume_does_not_replace_a_result_that_came_meanwhile(camroller, deck, reference, tmp_path):
    long = write_deck(tmp_path / "long.nml", GRID.replace("count_1 = 6", "count_1 = 60"))
    sweep = subprocess.Popen([camroller, "sweep", long, "-o", "x.h5", "--resume", "--threads", "1", "--quiet"], cwd=tmp_path,
                             stderr=subprocess.PIPE, text=True)
    while not list(tmp_path.glob("x.h5.part-*")):
        time.sleep(0.001)
    shutil.copy(reference, tmp_path / "x.h5")
    words = sweep.communicate(timeout=300)[1]
    assert sweep.returncode == FILE
    assert "'x.h5' exists and is not a result of this sweep: " in words and "\nit came while the cases were computed, and " in words
    assert same(reference, tmp_path / "x.h5")
    assert sorted(path.name for path in tmp_path.glob("x.h5*")) == ["x.h5", "x.h5.part-rank-0"]
    (tmp_path / "x.h5").rename(tmp_path / "other.h5")
    again = done(camroller, "sweep", long, "-o", "x.h5", "--resume", folder=tmp_path)
    assert again.stdout.startswith("x.h5: 240 cases in ")


def message(result):
    """The error that a command ended with."""
    return next(line for line in result.stderr.splitlines() if line.startswith("camroller: "))


@pytest.mark.parametrize("values, code", [("60, 31.5, 61, 31", DOMAIN), ("61, 60", DOMAIN)])
def test_resume_of_a_finished_sweep_repeats_its_exit_code(camroller, tmp_path, values, code):
    deck = write_deck(tmp_path / "deck.nml", f"key_1 = 'mechanism.pivot_to_cam_mm' values_1 = {values}")
    first = run(camroller, "sweep", deck, folder=tmp_path)
    before = (tmp_path / "deck.h5").read_bytes()
    again = run(camroller, "sweep", deck, "--resume", folder=tmp_path)
    assert (first.returncode, again.returncode) == (code, code)
    assert "cases have no result; the first is case 0 (" in first.stderr
    assert message(again) == message(first)
    assert again.stdout == "deck.h5 is there with all cases\n"
    assert (tmp_path / "deck.h5").read_bytes() == before


@pytest.mark.parametrize("spelling", ["values_1 = 300,600 , 9e2", "values_1 = 300.0\n  600, 900,", "values_1 = 3d2 600 +900."])
def test_resume_goes_by_values_and_not_by_their_spelling(camroller, tmp_path, spelling):
    """Numbers, lists, texts and a default that is given; the last digit counts."""
    sweep = "key_1 = 'operating_point.speed_rpm' {} key_2 = 'film.law' values_2 = 'moes', \"dowson_higginson\""
    deck = write_deck(tmp_path / "deck.nml", sweep.format("values_1 = 300, 600, 900"))
    assert run(camroller, "sweep", deck, *STOP, folder=tmp_path).returncode == UNFINISHED
    write_deck(deck, sweep.format(spelling).replace('"', "'"))
    given = ["--set", "numerics.accuracy=1.0e-03", "--set", "sweep.seed=1", "--set", "sweep.wall_time_limit_s=1e-3"]
    assert run(camroller, "sweep", deck, *given, "--threads", 1, "--resume", folder=tmp_path).returncode == UNFINISHED
    write_deck(deck, sweep.format("values_1 = 300, 600, 900.0000000000001"))
    other = run(camroller, "sweep", deck, "--resume", folder=tmp_path)
    assert other.returncode == FILE
    assert "'sweep.values_1 = 300, 600, 900' is now 'sweep.values_1 = 300, 600, 900.0000000000001'" in other.stderr


@pytest.mark.parametrize("rows, code", [
    ("3e2 'moes' 1.0\n600.0 moes -\n900 moes 2.5\n", UNFINISHED),
    ("300 moes 1\n600 moes 3\n900 moes 2.50\n", FILE),
    ("300 moes 1\n600 moes -\n900 dowson_higginson 2.50\n", FILE),
])
def test_resume_goes_by_values_of_a_table_of_cases(camroller, tmp_path, rows, code):
    heading = 'operating_point.speed_rpm film.law "measured.torque [N m]"\n'
    (tmp_path / "cases.txt").write_text(heading + "300 moes 1\n600 moes -\n900 moes 2.50\n")
    deck = write_deck(tmp_path / "deck.nml", "kind = 'table' table = 'cases.txt' series = 'chosen' series_cases = 2*1, 2")
    assert run(camroller, "sweep", deck, *STOP, folder=tmp_path).returncode == UNFINISHED
    (tmp_path / "cases.txt").write_text(heading + rows)
    again = run(camroller, "sweep", deck, *STOP, "--resume", "--set", "sweep.series_cases=1 1 2", folder=tmp_path)
    assert again.returncode == code, again.stderr


@pytest.mark.parametrize("change, words", [
    ("roller.mass_kg=0.012", "its deck, a table or a value of --set differs: 'roller.mass_kg = 0.0088' is now 'roller.mass_kg = 0.012'\n"),
    ("sweep.count_1=7", "its deck, a table or a value of --set differs: 'sweep.count_1 = 6' is now 'sweep.count_1 = 7'\n"),
    ("build", "commit: 'another' made the file, this is '"),
])
def test_resume_does_not_replace_a_result_of_another_study(camroller, deck, reference, tmp_path, change, words):
    shutil.copy(reference, tmp_path / "deck.h5")
    options = ["--set", change]
    if change == "build":
        options = []
        with h5py.File(tmp_path / "deck.h5", "r+") as file:
            file["run"].attrs["commit"] = "another"
            file["run"].attrs["study"] = "0123456789ABCDEF"
    before = (tmp_path / "deck.h5").read_bytes()
    result = run(camroller, "sweep", deck, *options, "--resume", folder=tmp_path)
    assert result.returncode == FILE
    assert "'deck.h5' exists and is not a result of this sweep" in result.stderr and words in result.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["deck.h5"]
    assert (tmp_path / "deck.h5").read_bytes() == before


WEAR = "&wear cam_rate_mm3_N_m = 1e-8 roller_rate_mm3_N_m = 1e-8 /\n"


@pytest.mark.parametrize("change, words", [
    (lambda text: text.partition("&sweep")[0], "sweep.kind = 'grid' is gone\n"),
    (lambda text: text + WEAR, "'wear.cam_rate_mm3_N_m = 1e-8' is new\n"),
    (lambda text: text.replace("dowson_higginson", "moes"), "film.law = 'dowson_higginson' is now film.law = 'moes'\n"),
], ids=["gone", "new", "changed"])
def test_resume_tells_which_line_of_a_deck_is_new_gone_or_changed(camroller, deck, reference, tmp_path, change, words):
    """A key that one deck alone has is not set against another key; a line with quotes gets no more of them."""
    (tmp_path / "deck.nml").write_text(change(deck.read_text()))
    shutil.copy(reference, tmp_path / "deck.h5")
    result = run(camroller, "sweep", "deck.nml", "--resume", folder=tmp_path)
    assert result.returncode == FILE
    assert "its deck, a table or a value of --set differs: " + words in result.stderr


def test_resume_tells_that_a_result_of_one_case_had_no_sweep(camroller, deck, tmp_path):
    done(camroller, "run", deck, "--no-sweep", "--quiet", folder=tmp_path)
    result = run(camroller, "sweep", deck, "--resume", folder=tmp_path)
    assert result.returncode == FILE
    assert "its deck, a table or a value of --set differs: sweep.kind = 'grid' is new\n" in result.stderr


@pytest.mark.parametrize("content", [b"", b"my notes\n", b"hdf5"])
def test_resume_does_not_replace_a_file_that_is_no_result(camroller, deck, tmp_path, content):
    path = tmp_path / "deck.h5"
    path.write_bytes(content)
    if content == b"hdf5":
        with h5py.File(path, "w") as file:
            file["x"] = 1
    before = path.read_bytes()
    result = run(camroller, "sweep", deck, "--resume", folder=tmp_path)
    assert result.returncode == FILE
    assert f"'deck.h5' exists and is {'no earlier result of camroller' if content else 'not a result of this sweep'}" in result.stderr
    assert path.read_bytes() == before


def test_replacing_an_earlier_result_gives_a_message(camroller, deck, reference, tmp_path):
    """Without --resume a new result takes the place of an older one, as with `run`; of another study that is said at once."""
    shutil.copy(reference, tmp_path / "deck.h5")
    again = done(camroller, "sweep", deck, folder=tmp_path)
    assert "replaced" not in again.stderr
    other = done(camroller, "sweep", deck, "--set", "roller.mass_kg=0.012", folder=tmp_path)
    assert "remark: 'deck.h5' exists and is not a result of this sweep" in other.stderr
    assert "it is replaced when all cases are done" in other.stderr


@pytest.fixture(name="tables")
def fixture_tables(tmp_path):
    """A folder with decks of three speeds that name a table of lift, one of pressure, one of the lift of the second lobe shape."""
    shutil.copytree(ROOT / "decks/tables", tmp_path / "decks/tables")
    lift = "law = 'table'\n   table = 'tables/polynomial_lift.txt'\n   table_unit = 'mm'\n"
    for name in ("tabulated_lift", "three_cam_head"):
        text = (ROOT / f"decks/{name}.nml").read_text()
        text = text[:text.index("&sweep")] if "&sweep" in text else text
        (tmp_path / f"decks/{name}.nml").write_text(text + SPEEDS)
        start = text.find("&second_lift")
        if start > 0:
            second = text[:start] + f"&second_lift\n   {lift}" + text[text.index("/", start):]
            (tmp_path / "decks/two_lifts.nml").write_text(second + SPEEDS)
    return tmp_path


SPEEDS = "&sweep\n   key_1 = 'operating_point.speed_rpm'\n   values_1 = 500, 600, 700\n/\n"


@pytest.mark.parametrize("deck, group", [("tabulated_lift", "lift"), ("two_lifts", "second_lift"), ("three_cam_head", "gas_force")])
def test_a_table_that_changed_is_refused(camroller, tables, deck, group):
    """The last digit of one number; a comment is none."""
    study = ["sweep", f"decks/{deck}.nml", "-o", "x.h5", *COARSE]
    assert run(camroller, *study, *STOP, folder=tables).returncode == UNFINISHED
    table = table_of(tables / f"decks/{deck}.nml", group)
    before = table.read_text()
    table.write_text("# a comment more\n" + before)
    assert run(camroller, *study, *STOP, "--resume", folder=tables).returncode in (0, UNFINISHED)
    table.write_text(changed(before))
    result = run(camroller, *study, "--resume", folder=tables)
    assert result.returncode == FILE, result.stderr
    assert f"table of &{group} with checksum" in result.stderr or "not a result of this sweep" in result.stderr
    table.write_text(before)
    done(camroller, *study, "--resume", folder=tables)
    table.write_text(changed(before))
    finished = run(camroller, *study, "--resume", folder=tables)
    assert finished.returncode == FILE
    assert f"its deck, a table or a value of --set differs: 'table of &{group} with checksum " in finished.stderr


def table_of(deck, group):
    """The table that a group of a deck names."""
    text = deck.read_text()
    text = text[text.index(f"&{group}\n"):]
    return deck.parent / text[text.index("table ="):].split("'")[1]


def changed(text):
    """A table with another number in the middle: a lift or pressure that is larger by a thousandth."""
    lines = text.splitlines()
    rows = [i for i, line in enumerate(lines) if line.strip() and line.strip()[0] not in "#!"]
    top = max(rows, key=lambda i: float(lines[i].replace(",", " ").split()[1]))
    x, y = lines[top].replace(",", " ").split()[:2]
    lines[top] = f"{x} {float(y) * 1.001:.9g}"
    return "\n".join(lines) + "\n"


def test_a_table_that_only_some_cases_use_is_part_of_the_study(camroller, tables):
    """A key that names a table can vary; each of its tables belongs to the study."""
    table = table_of(tables / "decks/tabulated_lift.nml", "lift")
    other = table.with_name("other.dat")
    other.write_text(table.read_text())
    sweep = f"&sweep key_1 = 'lift.table' values_1 = '{table.name}', '{other.name}' wall_time_limit_s = 1e-3 /\n"
    text = (tables / "decks/tabulated_lift.nml").read_text().replace("tables/polynomial_lift.txt", "polynomial_lift.txt")
    (table.parent / "swept.nml").write_text(text.replace(SPEEDS, sweep))
    study = ["sweep", table.parent / "swept.nml", "-o", "x.h5", "--threads", 1, *COARSE]
    assert run(camroller, *study, folder=tables).returncode == UNFINISHED
    other.write_text(changed(other.read_text()))
    result = run(camroller, *study, "--resume", folder=tables)
    assert result.returncode == FILE
    assert "table of &lift with checksum" in result.stderr


def test_a_table_that_changes_during_a_sweep_is_an_error(camroller, tables):
    """Which case had the old one and which the new one would not be known."""
    table = table_of(tables / "decks/tabulated_lift.nml", "lift")
    shutil.copy(table, table.with_name("other.txt"))
    sweep = (f"&sweep key_1 = 'lift.table' values_1 = '{table}', '{table.with_name('other.txt')}' "
             "key_2 = 'operating_point.speed_rpm' from_2 = 400 to_2 = 900 count_2 = 500 /\n")
    deck = tables / "decks/swept.nml"
    deck.write_text((tables / "decks/tabulated_lift.nml").read_text().replace(SPEEDS, sweep))
    process = subprocess.Popen([camroller, "sweep", deck, "-o", "x.h5", "--threads", "1", *COARSE], cwd=tables, stderr=subprocess.PIPE)
    while not list(tables.glob("x.h5.part-*")):
        time.sleep(0.001)
    table.with_name("other.txt").write_text(changed(table.read_text()))
    process.send_signal(signal.SIGTERM)
    words = process.communicate(timeout=60)[1].decode()
    assert process.returncode == FILE
    assert "a table that the cases name has changed while they were computed" in words
    assert not (tables / "x.h5").exists()


def test_a_changed_table_of_cases_is_refused_after_the_sweep_is_done(camroller, tmp_path):
    table = tmp_path / "cases.csv"
    table.write_text("operating_point.speed_rpm\n300\n400\n")
    deck = write_deck(tmp_path / "deck.nml", "kind = 'table' table = 'cases.csv'")
    done(camroller, "sweep", deck, folder=tmp_path)
    table.write_text("operating_point.speed_rpm\n300\n401\n")
    assert run(camroller, "sweep", deck, "--resume", folder=tmp_path).returncode == FILE


@pytest.mark.parametrize("deck", ["tabulated_lift", "three_cam_head", "cases"])
def test_the_folder_of_the_deck_does_not_matter(camroller, tables, deck):
    """The same study from another folder, by an absolute path, as a copy elsewhere, with its table named in another way."""
    if deck == "cases":
        (tables / "decks/cases.csv").write_text("operating_point.speed_rpm\n500\n600\n700\n")
        write_deck(tables / "decks/cases.nml", "kind = 'table' table = 'cases.csv'")
    study = [*COARSE, "--set", "sweep.checkpoint_s=5"]
    assert run(camroller, "sweep", f"decks/{deck}.nml", "-o", "x.h5", *study, *STOP, folder=tables).returncode == UNFINISHED
    shutil.copytree(tables / "decks", tables / "copy")
    (tables / "elsewhere").mkdir()
    group, name = {"tabulated_lift": ("lift", None), "three_cam_head": ("gas_force", None), "cases": ("sweep", "cases.csv")}[deck]
    path = tables / "copy" / name if name else table_of(tables / f"copy/{deck}.nml", group)
    for where, folder, more in ((tables / f"decks/{deck}.nml", tables, []), (f"../decks/{deck}.nml", tables / "elsewhere", []),
                                (f"copy/{deck}.nml", tables, []),
                                (f"decks/{deck}.nml", tables, ["--set", f"{group}.table={path.resolve()}"])):
        result = run(camroller, "sweep", where, "-o", tables / "x.h5", *study, *STOP, "--resume", *more, folder=folder)
        assert result.returncode in (0, UNFINISHED), result.stderr
    done(camroller, "sweep", tables / f"copy/{deck}.nml", "-o", tables / "x.h5", *study, "--resume", folder=folder)
