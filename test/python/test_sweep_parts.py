"""Part files and unfinished files: known by what they hold, damage is told and mended, several processes do no harm to each other."""

import fcntl
import random
import re
import shutil
import signal
import struct
import subprocess
import time

import h5py
import pytest

from conftest import done, run
from sweeps import GRID, same, write_deck

FILE, UNFINISHED = 6, 8
WORD = 8
# bytes before the words of a record, and what a part file begins with: mark and kind, in the order of this machine's bytes
HEAD, MARK = 24, 0x4361725061727400
# what a lock holds
LOCK = struct.pack("q", 0x436C6F636B727400)


@pytest.fixture(scope="module")
def deck(tmp_path_factory):
    """A deck of 24 cases with two kinds of summaries."""
    return write_deck(tmp_path_factory.mktemp("parts") / "deck.nml",
                      "key_1 = 'operating_point.speed_rpm' from_1 = 400 to_1 = 900 count_1 = 12 "
                      "key_2 = 'case.energy' values_2 = 'source', 'consistent'")


@pytest.fixture(scope="module")
def whole(camroller, deck):
    """Its result, and beside it a folder with the parts of three shards that it is made of."""
    done(camroller, "sweep", deck, "--quiet", folder=deck.parent)
    parts = deck.parent / "parts"
    parts.mkdir()
    for shard in ("1/3", "2/3", "3/3"):
        done(camroller, "sweep", deck, "--shard", shard, "--threads", 1, "--quiet", folder=parts)
    return deck.with_suffix(".h5")


@pytest.fixture(name="parts")
def fixture_parts(whole, tmp_path):
    """A folder with the parts of three shards."""
    for part in (whole.parent / "parts").iterdir():
        shutil.copy(part, tmp_path)
    return tmp_path


def records(path):
    """First byte, kind and length in bytes of every record of a part file."""
    content = path.read_bytes()
    place, found = 0, []
    while place < len(content):
        mark, length = struct.unpack_from("qq", content, place)
        found.append((place, mark - MARK, HEAD + WORD * length))
        place += found[-1][2]
    assert place == len(content)
    return found


def flip(path, place, bit=0):
    """Turn a bit of a file over."""
    content = bytearray(path.read_bytes())
    content[place] ^= 1 << bit
    path.write_bytes(content)


@pytest.mark.parametrize("name", ["deck.h5.part-notes", "deck.h5.part-1", "deck.h5.part-rank-0.bak", "deck.h5.unfinished-notes",
                                  "deck.h5.unfinished-12-0", "deck.h5.part-lock.txt"])
@pytest.mark.parametrize("command", ["sweep", "merge"])
def test_files_of_other_programs_are_not_touched(camroller, deck, whole, parts, name, command):
    content = b"what somebody else has written here, for longer than eight bytes\n"
    (parts / name).write_bytes(content)
    if command == "sweep":
        for part in parts.glob("deck.h5.part-shard-*"):
            part.unlink()
    done(camroller, command, deck, "--quiet", folder=parts)
    assert sorted(path.name for path in parts.iterdir()) == ["deck.h5", name]
    assert (parts / name).read_bytes() == content
    assert same(whole, parts / "deck.h5")


@pytest.mark.parametrize("name", ["deck.h5.part-rank-0", "deck.h5.part-lock"])
def test_a_foreign_file_named_like_a_part_is_an_error(camroller, deck, tmp_path, name):
    (tmp_path / name).write_text("what somebody else has written here\n")
    result = run(camroller, "sweep", deck, "--resume", folder=tmp_path)
    assert result.returncode == FILE
    assert f"'{name}' " in result.stderr and "give it another name" in result.stderr
    assert (tmp_path / name).read_text() == "what somebody else has written here\n"


def test_parts_of_another_sweep_are_not_touched(camroller, deck, parts):
    """A part that has been given the name of one of ours is told by what it says of itself."""
    before = {path.name: path.read_bytes() for path in parts.iterdir()}
    result = run(camroller, "merge", deck, "--set", "roller.mass_kg=0.012", folder=parts)
    assert result.returncode == FILE
    assert "the deck has changed" in result.stderr
    assert {path.name: path.read_bytes() for path in parts.iterdir()} == before


def test_unfinished_files_of_ended_processes_are_removed(camroller, deck, whole, parts):
    """Empty ones, blank ones, and results of ours; not one that a process is writing."""
    contents = {"deck.h5.unfinished-1-0": b"", "deck.h5.unfinished-2-0": b" " * 4096, "deck.h5.unfinished-3-0": bytes(100000)}
    for name, content in contents.items():
        (parts / name).write_bytes(content)
    shutil.copy(whole, parts / "deck.h5.unfinished-4-0")
    shutil.copy(whole, parts / "deck.h5.unfinished-5-0")
    with open(parts / "deck.h5.unfinished-5-0", "rb") as other:
        fcntl.flock(other, fcntl.LOCK_EX)
        done(camroller, "merge", deck, "--quiet", folder=parts)
    assert sorted(path.name for path in parts.iterdir()) == ["deck.h5", "deck.h5.unfinished-5-0"]


def is_hdf5(path):
    """Does a file begin as HDF5 does? The file that tries the folder is gone as soon as it was seen."""
    try:
        return path.read_bytes()[1:4] == b"HDF"
    except FileNotFoundError:
        return False


def test_a_result_that_is_being_written_is_locked(camroller, deck, tmp_path):
    """What another process goes by that removes what is unfinished."""
    big = write_deck(tmp_path / "big.nml", GRID.replace("count_1 = 6", "count_1 = 2000"))  # seconds
    process = subprocess.Popen([camroller, "run", big, "-o", "deck.h5", "--quiet"], cwd=tmp_path)
    while not any(is_hdf5(path) for path in tmp_path.glob("*.unfinished-*")):
        assert process.poll() is None
    try:
        with open(next(tmp_path.glob("*.unfinished-*")), "rb") as file, pytest.raises(BlockingIOError):
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    finally:
        process.kill()
        process.wait()


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT, signal.SIGUSR1])
@pytest.mark.once
def test_a_signal_stops_a_sweep_that_makes_its_file(camroller, tmp_path, number):
    """With the code of a stopped sweep; the unfinished file goes, the parts stay."""
    big = write_deck(tmp_path / "deck.nml", GRID.replace("count_1 = 6", "count_1 = 60") + " series = 'all'")
    for shard in ("1/2", "2/2"):
        done(camroller, "sweep", big, "--shard", shard, "--quiet", folder=tmp_path)
    kept = sorted(tmp_path.iterdir())
    process = subprocess.Popen([camroller, "sweep", big, "--resume", "--quiet"], cwd=tmp_path, stderr=subprocess.PIPE, text=True)
    while not list(tmp_path.glob("*.unfinished-*")):
        assert process.poll() is None
    process.send_signal(number)
    words = process.communicate(timeout=60)[1]
    assert process.returncode == UNFINISHED, words
    assert words.endswith("the sweep was stopped with no case to do, before its file was made; continue with --resume\n")
    assert sorted(tmp_path.iterdir()) == kept
    done(camroller, "sweep", big, "--resume", "--quiet", folder=tmp_path)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["deck.h5", "deck.nml"]


def test_a_signal_stops_a_sweep_that_waits_for_another_one(camroller, deck, parts):
    with open(parts / "deck.h5.part-lock", "wb") as other:
        other.write(LOCK)
        other.flush()
        fcntl.flock(other, fcntl.LOCK_EX)
        process = subprocess.Popen([camroller, "sweep", deck, "--resume"], cwd=parts, stderr=subprocess.PIPE, text=True)
        assert process.stderr.readline() == "waiting for another process that makes 'deck.h5'\n"
        time.sleep(0.05)
        process.send_signal(signal.SIGTERM)
        words = process.communicate(timeout=60)[1]
    assert process.returncode == UNFINISHED, words
    assert "no case to do, before its file was made" in words


def test_three_merges_at_once(camroller, deck, whole, parts, tmp_path_factory):
    """Each ends well and finds or makes the one complete file; nothing else is left. Many rounds, for the moments to differ."""
    for turn in range(5):
        folder = tmp_path_factory.mktemp(f"merges{turn}")
        for part in parts.iterdir():
            shutil.copy(part, folder)
        merges = [subprocess.Popen([camroller, "merge", deck], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
                  for _ in range(3)]
        words = [merge.communicate(timeout=60) for merge in merges]
        assert [merge.returncode for merge in merges] == [0, 0, 0], words
        assert sum(" is there with all cases" in out for out, _ in words) == 2
        assert [path.name for path in folder.iterdir()] == ["deck.h5"]
        assert same(whole, folder / "deck.h5")


def test_partial_merges_beside_a_complete_one(camroller, deck, whole, parts, tmp_path_factory):
    """A partial file never comes after the complete one, whichever process is first."""
    for turn in range(5):
        folder = tmp_path_factory.mktemp(f"partial{turn}")
        for part in parts.iterdir():
            shutil.copy(part, folder)
        merges = [subprocess.Popen([camroller, "merge", deck, "--quiet", *options], cwd=folder, stderr=subprocess.PIPE)
                  for options in (["--partial"], [], ["--partial"])]
        assert [(merge.communicate(timeout=60), merge.returncode)[1] for merge in merges] == [0, 0, 0]
        with h5py.File(folder / "deck.h5") as file:
            assert file.attrs["complete"] == 1
        assert same(whole, folder / "deck.h5")


def test_merge_of_a_complete_result_says_so(camroller, deck, whole, parts):
    shutil.copy(whole, parts)
    for part in parts.glob("*.part-*"):
        part.unlink()
    assert done(camroller, "merge", deck, folder=parts).stdout == "deck.h5 is there with all cases\n"
    (parts / "deck.h5").unlink()
    assert "there is no 'deck.h5.part-*'" in run(camroller, "merge", deck, folder=parts).stderr


def test_a_lock_of_an_ended_process_is_ignored(camroller, deck, whole, parts):
    process = subprocess.Popen([camroller, "merge", deck, "--quiet"], cwd=parts)
    process.kill()
    process.wait()
    (parts / "deck.h5.part-lock").write_bytes(struct.pack("q", 0x436C6F636B727400))
    done(camroller, "merge", deck, "--quiet", folder=parts)
    assert [path.name for path in parts.iterdir()] == ["deck.h5"]
    assert same(whole, parts / "deck.h5")


@pytest.mark.parametrize("content, is_left", [(b"", False), (struct.pack("q", 0x436C6F636B727400), False),
                                              (b"what somebody else has written here\n", True)])
def test_a_lock_left_beside_a_complete_result_is_removed(camroller, deck, whole, tmp_path, content, is_left):
    """A process that is killed between the removal of the last part file and that of its lock leaves both files."""
    shutil.copy(whole, tmp_path)
    (tmp_path / "deck.h5.part-lock").write_bytes(content)
    done(camroller, "sweep", deck, "--resume", "--quiet", folder=tmp_path)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["deck.h5"] + is_left * ["deck.h5.part-lock"]
    if is_left:
        assert (tmp_path / "deck.h5.part-lock").read_bytes() == content
    assert same(whole, tmp_path / "deck.h5")


@pytest.mark.parametrize("record", ["layout", "first cases", "last cases"])
@pytest.mark.parametrize("where", ["mark", "length", "checksum", "words"])
def test_a_flipped_bit_loses_one_record_only(camroller, deck, whole, parts, record, where):
    """Every record behind it counts; what is damaged and what is computed again is said; no number is another."""
    part = sorted(parts.glob("*.part-*"))[0]
    found = records(part)
    cases = [i for i, (_, kind, _) in enumerate(found) if kind == 3]
    layouts = [i for i, (_, kind, _) in enumerate(found) if kind == 2]
    assert len(layouts) == 2 and len(cases) >= 4
    damaged = {"layout": layouts[0], "first cases": cases[0], "last cases": cases[-1]}[record]
    place, _, length = found[damaged]
    flip(part, place + {"mark": 1, "length": WORD, "checksum": 2 * WORD, "words": length // 2}[where], 3)
    result = run(camroller, "merge", deck, folder=parts)
    assert result.returncode == UNFINISHED
    missing = int(re.search(r"(\d+) of 24 cases (is|are) missing", result.stderr)[1])
    assert f"remark: '{part.name}' is damaged: " in result.stderr
    assert 0 < missing < 8
    again = done(camroller, "sweep", deck, "--resume", folder=parts)
    assert f"remark: '{part.name}' is damaged: " in again.stderr
    told = re.search(r"remark: to be computed: (\d+) cases?, (.*)\n", again.stderr)
    assert int(told[1]) == missing == len(numbers(told[2]))
    assert set(numbers(told[2])) <= set(range(8))
    assert same(whole, parts / "deck.h5")
    assert [path.name for path in parts.iterdir()] == ["deck.h5"]


def numbers(words):
    """Cases that words like `0 to 2, 7` name."""
    found = []
    for piece in words.split(", "):
        first, _, last = piece.partition(" to ")
        found += range(int(first), int(last or first) + 1)
    return found


def test_every_case_is_in_one_record(parts):
    cases = []
    for part in parts.glob("deck.h5.part-*"):
        content = part.read_bytes()
        for place, kind, _ in records(part):
            if kind == 3:
                first, count = struct.unpack_from("qq", content, place + HEAD)
                cases += range(first, first + count)
    assert sorted(cases) == list(range(1, 25))


@pytest.mark.parametrize("record", [0, -1])
def test_cases_computed_twice_count_once(camroller, deck, whole, parts, record):
    """A record twice in a part, and a part that was copied beside itself."""
    part = sorted(parts.glob("*.part-*"))[0]
    content = part.read_bytes()
    place, _, length = [found for found in records(part) if found[1] == 3][record]
    part.write_bytes(content + content[place:place + length])
    shutil.copy(sorted(parts.glob("*.part-*"))[record], parts / "deck.h5.part-rank-7")
    assert "24 cases" in done(camroller, "merge", deck, folder=parts).stdout
    assert same(whole, parts / "deck.h5")
    assert [path.name for path in parts.iterdir()] == ["deck.h5"]


def test_flipped_bits_anywhere(camroller, deck, whole, parts):
    """Bits drawn at random, several at a time: the same file in the end, or an error that says which part to remove."""
    draw = random.Random(7)
    originals = {part: part.read_bytes() for part in sorted(parts.glob("*.part-*"))}
    refused = 0
    for _ in range(30):
        for part, content in originals.items():
            part.write_bytes(content)
        for _ in range(draw.randint(1, 4)):
            part = draw.choice(list(originals))
            flip(part, draw.randrange(len(originals[part])), draw.randrange(8))
        result = run(camroller, "sweep", deck, "--resume", "--quiet", folder=parts)
        while result.returncode == FILE:
            name = re.search(r"'(deck.h5.part-[^']*)' (?:is damaged at its beginning|is not a part file)", result.stderr)
            assert name, result.stderr
            (parts / name[1]).unlink()
            refused += 1
            result = run(camroller, "sweep", deck, "--resume", "--quiet", folder=parts)
        assert result.returncode == 0, result.stderr
        assert same(whole, parts / "deck.h5")
        assert [path.name for path in parts.iterdir()] == ["deck.h5"]
        (parts / "deck.h5").unlink()
    assert refused > 0  # the first record of a part is an eighth of it or more


def test_a_damaged_beginning_is_refused(camroller, deck, parts):
    part = sorted(parts.glob("*.part-*"))[1]
    flip(part, 200)
    for command in ("merge", "sweep"):
        result = run(camroller, command, deck, *(["--resume"] if command == "sweep" else []), folder=parts)
        assert result.returncode == FILE
        assert f"'{part.name}' is damaged at its beginning" in result.stderr


def test_a_part_with_incomplete_first_record_is_started_again(camroller, deck, whole, tmp_path):
    """A process that ended while it wrote what its part belongs to has lost nothing."""
    for length in (0, 5, WORD, 30, 2000):
        (tmp_path / "deck.h5.part-rank-0").write_bytes((whole.parent / "parts/deck.h5.part-shard-1-of-3-rank-0").read_bytes()[:length])
        if 0 < length < WORD:
            assert run(camroller, "sweep", deck, "--resume", folder=tmp_path).returncode == FILE
            continue
        done(camroller, "sweep", deck, "--resume", "--quiet", folder=tmp_path)
        assert same(whole, tmp_path / "deck.h5")
        assert [path.name for path in tmp_path.iterdir()] == ["deck.h5"]
        (tmp_path / "deck.h5").unlink()


@pytest.mark.parametrize("shard", ["1/500", "77/500", "500/500"])
def test_more_shards_than_cases_are_refused_in_every_task(camroller, deck, tmp_path, shard):
    result = run(camroller, "sweep", deck, "--shard", shard, "--quiet", folder=tmp_path)
    assert result.returncode == 2 and "500 shards are more than the " in result.stderr and not list(tmp_path.iterdir())
