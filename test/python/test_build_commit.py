"""What a build says it is built of: its commit, and a checksum of sources that are those of no commit, by make and by CMake."""

import os
import re
import shutil
import subprocess

import pytest
from conftest import ROOT, alone_in_cmake, printed

GIT = ("git", "-c", "user.name=a", "-c", "user.email=a@b")
SCRIPT = "tools/write_commit.sh"
NAME = "build_commit.inc"
FORM = re.compile(r"[0-9a-f]{12}(-changed-[0-9a-f]{8})?|unknown-[0-9a-f]{8}")


@pytest.fixture(scope="module", autouse=True)
def quiet_git():
    """Without the repository of a hook, and without the settings of a user."""
    with pytest.MonkeyPatch.context() as patch:
        for name in [name for name in os.environ if name.startswith("GIT_")]:
            patch.delenv(name)
        patch.setenv("GIT_CONFIG_GLOBAL", os.devnull)
        yield


def sources(place):
    """A small project with the script."""
    for name, text in {"src/base/version.f90": "! version\n", "app/main.f90": "! main\n", "include/a.h": "/* a */\n",
                       "fpm.toml": "name = 'a'\n", "README.md": "a\n"}.items():
        (place / name).parent.mkdir(parents=True, exist_ok=True)
        (place / name).write_text(text, encoding="utf-8")
    (place / "tools").mkdir()
    shutil.copy(ROOT / SCRIPT, place / SCRIPT)
    return place


def committed(place):
    """The same with all that is there in a commit."""
    printed("git", "init", "-q", folder=place)
    printed(*GIT, "add", ".", folder=place)
    printed(*GIT, "commit", "-qm", "a", folder=place)
    return place


def mark(place):
    """What the script writes there."""
    file = place.parent / NAME
    printed("bash", place / SCRIPT, file)
    return mark_in(file)


def mark_in(file):
    """What a file says that is built."""
    (found,) = re.findall(r'^character\(len=\*\), parameter :: build_commit = "(.*)"$', file.read_text(encoding="utf-8"), re.MULTILINE)
    return found


def test_the_commit_stands_alone_where_sources_are_those_of_the_commit(tmp_path):
    place = committed(sources(tmp_path / "project"))
    hash_of_commit = printed("git", "rev-parse", "HEAD", folder=place)[:12]
    assert mark(place) == hash_of_commit
    (place / "README.md").write_text("b\n", encoding="utf-8")
    (place / "src/notes.txt").write_text("no source\n", encoding="utf-8")
    (place / "src/base/version.f90").touch()
    assert mark(place) == hash_of_commit


@pytest.mark.parametrize("name", ["src/base/version.f90", "app/main.f90", "include/a.h", "fpm.toml", "src/base/new.f90"])
def test_uncommitted_changes_are_told_apart(tmp_path, name):
    """A changed or a new source, another change of it, the former one again."""
    place = committed(sources(tmp_path / "project"))
    clean = mark(place)
    marks = []
    for text in ("! one\n", "! two\n", "! one\n"):
        (place / name).write_text(text, encoding="utf-8")
        marks.append(mark(place))
    assert all(FORM.fullmatch(found) and found.startswith(f"{clean}-changed-") for found in marks)
    assert marks[0] == marks[2] != marks[1]


@pytest.mark.parametrize("inside", [False, True])
def test_sources_of_an_archive_are_told_apart(tmp_path, inside):
    """Without git, also unpacked inside of a repository that does not know them."""
    if inside:
        committed(sources(tmp_path))
    first, second = sources(tmp_path / "first"), sources(tmp_path / "second")
    assert mark(first) == mark(second)
    (second / "src/base/version.f90").write_text("! another\n", encoding="utf-8")
    assert mark(first) != mark(second)
    assert all(FORM.fullmatch(mark(place)) and mark(place).startswith("unknown-") for place in (first, second))


def test_without_git_and_sources_the_commit_is_unknown(tmp_path):
    (tmp_path / "a/tools").mkdir(parents=True)
    shutil.copy(ROOT / SCRIPT, tmp_path / "a" / SCRIPT)
    assert mark(tmp_path / "a") == "unknown"


def test_the_file_is_written_only_where_it_changes(tmp_path):
    place = committed(sources(tmp_path / "project"))
    mark(place)
    os.utime(tmp_path / NAME, (1, 1))
    mark(place)
    assert (tmp_path / NAME).stat().st_mtime == 1
    (place / "app/main.f90").write_text("! another\n", encoding="utf-8")
    mark(place)
    assert (tmp_path / NAME).stat().st_mtime > 1


@pytest.fixture(scope="module")
def tree(tmp_path_factory):
    """The project's sources in a repository of their own, configured for CMake without HDF5; the generator is that of the tests."""
    place = tmp_path_factory.mktemp("tree") / "project"
    for name in ("src", "app", "include", "fmi", "tools", "example/engine_host"):
        shutil.copytree(ROOT / name, place / name, ignore=shutil.ignore_patterns("__pycache__", "*.mod"))
    for name in ("CMakeLists.txt", "fpm.toml"):
        shutil.copy(ROOT / name, place)
    committed(place)
    printed("cmake", "-G", "Unix Makefiles", "-S", place, "-B", place / "build", "-DCAMROLLER_IO=OFF")
    return place


def test_cmake_finds_the_commit_at_each_build_and_compiles_its_module_again(tree):
    """Only the module that includes it, and only where it changed."""
    def build():
        """Commit, and when the module was compiled, as a build of everything begins."""
        printed("cmake", "--build", tree / "build", "--target", "camroller_commit")
        printed("make", "-C", tree / "build", "src/base/version.o")
        return mark_in(tree / "build/commit" / NAME), (tree / compiled).stat().st_mtime_ns

    compiled = "build/CMakeFiles/camroller_objects.dir/src/base/version.f90.o"
    first = build()
    assert first[0] == printed("git", "rev-parse", "HEAD", folder=tree)[:12]
    assert build() == first
    (tree / "src/base/kinds.f90").open("a").write("! a change\n")
    changed = build()
    assert changed[0].startswith(first[0] + "-changed-") and changed[1] > first[1]
    assert build() == changed
    printed(*GIT, "commit", "-qam", "b", folder=tree)
    second = build()
    assert second[0] == printed("git", "rev-parse", "HEAD", folder=tree)[:12] != first[0]
    assert second[1] > changed[1]


def test_the_module_that_cmake_compiled_has_the_commit(tree):
    printed("cmake", "--build", tree / "build", "--target", "camroller_commit")
    printed("make", "-C", tree / "build", "src/base/version.o")
    module = subprocess.run(["gzip", "-dc"], input=(tree / "build/modules/camroller/camroller_version.mod").read_bytes(),
                            capture_output=True, check=True).stdout.decode()
    assert mark_in(tree / "build/commit" / NAME) in module


def test_the_installed_program_knows_its_commit(cmake_io_prefix, tmp_path):
    with alone_in_cmake():
        printed("bash", ROOT / SCRIPT, tmp_path / NAME)
    expected = mark_in(tmp_path / NAME)
    assert FORM.fullmatch(expected)
    assert f"\ncommit {expected}\n" in printed(cmake_io_prefix / "bin/camroller", "--version")
