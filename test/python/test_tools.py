"""The commands of the README, the reader of Fortran sources and the set-up."""

import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys

import pytest
from fortran_source import ROOT, statements
from planted_faults import faults
from readme_commands import commands_of, main


def test_commands_are_taken_from_sh_blocks_only():
    text = "```sh\nmake run\n```\ntext `make no`\n```\nmake neither\n```\n```fortran\nuse x\n```\n```sh\nmake test\n```\n"
    assert commands_of(text) == ["make run", "make test"]


def test_comments_and_continued_lines_of_commands_are_read():
    text = "```sh\n# all of it\nmake run  # quick\ncamroller run a.nml \\\n  -o b.h5\n\n```\n"
    assert commands_of(text) == ["make run", "camroller run a.nml -o b.h5"]


def test_a_failing_command_counts_and_the_next_one_runs(tmp_path, capfd):
    page = tmp_path / "page.md"
    page.write_text("```sh\nfalse\necho again\ntrue\n```\n", encoding="utf-8")
    assert main(["--run", "--skip", "true", str(page)]) == 1
    output = capfd.readouterr().out.splitlines()
    assert output[-2:] == ["again", "1 passed, 1 failed"]


def test_statements_are_joined_and_strings_emptied():
    found = statements("a = 'x ! y' // & ! one\n   \"it's\" ! two\nb = 1; c = 2\n! alone\n")
    assert [(s.line, s.last_line, s.text) for s in found] == [
        (1, 2, "a = '' // \"\""), (3, 3, "b = 1"), (3, 3, "c = 2")]
    assert found[0].comment == "! one ! two"


def test_signals_are_heeded_by_what_tests_start_from_a_run_that_ignores_them():
    """As in a run started by nohup; what they start inherits it from them."""
    numbers = [signal.SIGHUP, signal.SIGINT, signal.SIGTERM]
    text = f"import signal, conftest\nassert all(signal.getsignal(n) != signal.SIG_IGN for n in {[int(n) for n in numbers]})"
    done = subprocess.run([sys.executable, "-c", text], cwd=ROOT / "test", capture_output=True, text=True, check=False,
                          preexec_fn=lambda: [signal.signal(number, signal.SIG_IGN) for number in numbers])
    assert done.returncode == 0, done.stderr


@pytest.mark.skipif(not (ROOT / ".venv/requirements.done").exists(), reason="not set up by tools/setup.sh")
def test_set_up_does_nothing_the_second_time():
    """Where everything is there, nothing is said and nothing is fetched."""
    result = subprocess.run([ROOT / "tools/setup.sh"], capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL)
    assert (result.returncode, result.stdout, result.stderr) == (0, "", "")


def run_set_up(top, apt_get=None, has_mpi=True, has_gfortran=False):
    """Run the set-up in a folder of its own on a machine where only these are there, with the given text as apt-get."""
    folder = top / "bin"
    folder.mkdir()
    (top / "tools").mkdir(exist_ok=True)
    (top / "tools/setup.sh").write_bytes((ROOT / "tools/setup.sh").read_bytes())
    (top / "tools/setup.sh").chmod(0o755)
    for name in ("bash", "dirname", "env", "tr", "sed", "head", "tail", "tee", "mkdir", "ln", "cmp", "git", "make", "gcc", "pkg-config", "grep",
                 "sha256sum", "timeout", "mv", "rm", "tar", "gzip", "cat", "ldd"):
        found = subprocess.run(["bash", "-c", f"command -v {name}"], capture_output=True, text=True, check=False).stdout
        if found.strip():
            (folder / name).symlink_to(pathlib.Path(found.strip()))
    (folder / "python3").symlink_to(pathlib.Path(sys.executable).resolve())
    scripts = {"id": "echo 0", "apt-get": apt_get}
    scripts |= {"mpifort": "", "mpirun": ""} if has_mpi else {}
    scripts |= {"cmake": ""} | ({"gfortran": ""} if has_gfortran else {})
    for name, text in scripts.items():
        if text is not None:
            (folder / name).write_text(f"#!{folder}/bash\n{text}\n", encoding="utf-8")
            (folder / name).chmod(0o755)
    environment = {"PATH": str(folder), "HOME": str(folder)}
    return subprocess.run([top / "tools/setup.sh"], env=environment, capture_output=True, text=True, check=False,
                          stdin=subprocess.DEVNULL)


def test_a_process_starts_without_the_libraries_of_files_on_web_servers(camroller):
    if not (ROOT / "build/pkgconfig/libhdf5.a").is_file():
        pytest.skip("HDF5 has no static libraries here")
    libraries = subprocess.run(["ldd", camroller], capture_output=True, text=True, check=True).stdout
    assert "libgfortran" in libraries and "libhdf5" not in libraries and "libcurl" not in libraries


def test_set_up_names_what_is_missing(tmp_path):
    result = run_set_up(tmp_path)
    assert result.returncode == 1
    assert "gfortran" in result.stderr
    assert "install them and repeat" in result.stderr


def test_set_up_installs_only_what_is_missing(tmp_path):
    result = run_set_up(tmp_path, f'echo "$@" >> {tmp_path}/calls')
    calls = (tmp_path / "calls").read_text(encoding="utf-8").splitlines()
    assert calls == ["update -qq", "install -y --no-install-recommends gfortran"]
    assert result.returncode == 1
    assert "still missing after the installation: gfortran" in result.stderr


def test_set_up_shows_why_an_installation_failed(tmp_path):
    result = run_set_up(tmp_path, "echo no space left >&2; exit 100")
    assert result.returncode == 1
    assert "no space left" in result.stderr
    assert "type: apt-get update && apt-get install" in result.stderr


def with_python_tools(top):
    """A folder in which the Python tools are there."""
    (top / "requirements.txt").touch()
    (top / ".venv/bin").mkdir(parents=True)
    (top / ".venv/bin/python").symlink_to(sys.executable)
    (top / ".venv/requirements.done").write_text(f"# {top / '.venv'}\n", encoding="utf-8")


def test_set_up_makes_the_tools_again_in_a_moved_checkout(tmp_path):
    """Commands of a virtual environment name the folder where it was made."""
    before = tmp_path / "before"
    before.mkdir()
    with_python_tools(before)
    (before / ".venv/bin/fpm").write_text(f"#!{before}/.venv/bin/python\n", encoding="utf-8")
    after = before.rename(tmp_path / "after")
    result = run_set_up(after, has_gfortran=True)
    assert "setup: installing the tools of requirements.txt in .venv\n" in result.stdout
    assert not (after / ".venv/bin/fpm").exists()


@pytest.fixture(name="release")
def a_release(tmp_path):
    """A folder where test-drive is to be fetched: from a repository on disk, or out of an archive that a stand-in downloads."""
    with_python_tools(tmp_path)
    source = tmp_path / "archive/tblite-0.7.0/subprojects/test-drive"
    (source / "src").mkdir(parents=True)
    for name in ("fpm.toml", "src/testdrive.F90", "src/testdrive_version.f90"):
        (source / name).write_text(f"contents of {name}\n", encoding="utf-8")
    subprocess.run("git init -q && git add -A && git -c user.name=a -c user.email=a@b commit -qm x && git tag v9.9.9 && "
                   "sha256sum fpm.toml src/* > ../../../../sums", shell=True, cwd=source, check=True)
    (source / ".git").rename(tmp_path / "repository")
    (tmp_path / "fpm.toml").write_text(f'test-drive.git = "{tmp_path}/repository"\ntest-drive.tag = "v9.9.9"\n', encoding="utf-8")
    (tmp_path / "tools").mkdir()
    (tmp_path / "sums").rename(tmp_path / "tools/test-drive.sha256")
    unearth = tmp_path / ".venv/bin/unearth"
    unearth.write_text('#!/bin/bash\nfolder=${@: -2:1}\necho "${@: -1}" > asked\n'
                       'tar -czf "$folder/tblite-0.7.0.tar.gz" -C archive tblite-0.7.0\n', encoding="utf-8")
    unearth.chmod(0o755)
    return tmp_path


@pytest.mark.parametrize("source", ["repository", "archive"])
def test_set_up_takes_the_test_library_from_git_or_else_out_of_an_archive(release, source):
    if source == "archive":
        (release / "repository").rename(release / "gone")
    result = run_set_up(release, has_gfortran=True)
    assert (result.returncode, result.stdout) == (0, "setup: fetching test-drive v9.9.9\n"), result.stderr
    assert (release / "asked").exists() == (source == "archive")
    target = release / "build/dependencies/test-drive"
    assert (target / "src/testdrive.F90").read_text(encoding="utf-8") == "contents of src/testdrive.F90\n"
    assert subprocess.run(["git", "rev-parse", "--verify", "-q", "HEAD"], cwd=target, check=False, capture_output=True).returncode == 0


def test_set_up_takes_the_archive_where_git_gives_another_copy(release):
    subprocess.run("git clone -q repository copy && cd copy && echo x >> src/testdrive.F90 && "
                   "git -c user.name=a -c user.email=a@b commit -qam y && git push -q origin HEAD:other && git tag -f v9.9.9 && "
                   "git push -qf origin v9.9.9", shell=True, cwd=release, check=True, capture_output=True)
    result = run_set_up(release, has_gfortran=True)
    assert result.returncode == 0 and "this copy of test-drive is another one" in result.stderr
    assert (release / "build/dependencies/test-drive/src/testdrive.F90").read_text(encoding="utf-8") == "contents of src/testdrive.F90\n"


def test_set_up_refuses_a_test_library_of_other_content(release):
    (release / "repository").rename(release / "gone")
    (release / "archive/tblite-0.7.0/subprojects/test-drive/src/testdrive.F90").write_text("other\n", encoding="utf-8")
    result = run_set_up(release, has_gfortran=True)
    assert result.returncode == 1 and "cannot fetch test-drive v9.9.9, neither by git nor from PyPI" in result.stderr
    assert not (release / "build/dependencies/test-drive").exists()


def test_set_up_goes_on_without_open_mpi(tmp_path):
    """It is asked for once, apart from what has to be there; that it cannot be had is said and is no error."""
    with_python_tools(tmp_path)
    (tmp_path / "build/dependencies/test-drive/src").mkdir(parents=True)
    (tmp_path / "build/dependencies/test-drive/src/testdrive.F90").touch()
    result = run_set_up(tmp_path, f'echo "$@" >> {tmp_path}/calls; echo no such package >&2; exit 100', has_mpi=False,
                        has_gfortran=True)
    assert result.returncode == 0, result.stderr
    assert "goes on without the program for many nodes" in result.stdout and "no such package" in result.stderr
    assert (tmp_path / "calls").read_text(encoding="utf-8") == "update -qq\n"
    again = subprocess.run([tmp_path / "tools/setup.sh"], env={"PATH": str(tmp_path / "bin"), "HOME": str(tmp_path)},
                           capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL)
    assert (again.returncode, again.stdout, again.stderr) == (0, "", "")


@pytest.mark.parametrize(("node", "lines", "code"), [
    ("echo 8 passed, 0 failed", ["12 passed, 0 failed"], 0),
    ("echo 7 passed, 1 failed; exit 1", ["11 passed, 1 failed"], 1),
    ("exit 1", ["4 passed, 1 failed"], 1),
    ("sleep 0.1; kill -KILL $$", ["4 passed, 1 failed"], 1),
    ("echo no root here; exit 77", ["skipped: timeout --kill-after=20 300 slurm/one_node.sh: no root here", "4 passed, 0 failed"], 0),
])
def test_ci_counts_failed_checks_and_names_those_that_cannot_run(tmp_path, node, lines, code):
    """`.ci/run` over stand-ins: a set-up, two tests that pass, stages without counts, a Slurm that does as told."""
    stand_ins = {"tools/setup.sh": "true", "slurm/one_node.sh": node, ".venv/bin/python": "true"}
    for name, text in stand_ins.items():
        (tmp_path / name).parent.mkdir(parents=True)
        (tmp_path / name).write_text(f"#!/usr/bin/env bash\n{text}\n", encoding="utf-8")
        (tmp_path / name).chmod(0o755)
    (tmp_path / "Makefile").write_text("test:\n\t@echo 2 passed, 0 failed\ncheck docs recipes:\n\t@true\n", encoding="utf-8")
    (tmp_path / ".ci").mkdir()
    (tmp_path / ".ci/run").write_bytes((ROOT / ".ci/run").read_bytes())
    result = subprocess.run(["bash", tmp_path / ".ci/run"], capture_output=True, text=True, check=False)
    assert result.stdout.splitlines()[-len(lines):] == lines
    assert result.returncode == code


def test_files_that_contain_the_commit_are_recompiled(tmp_path):
    """Objects made from the former commit are removed, with the names that fpm gives them in both programs."""
    objects = [tmp_path / "build/gfortran_1/camroller/src_base_version.f90.o",
               tmp_path / "bench/build/gfortran_2/bench/.._src_base_version.f90.o"]
    for path in [*objects, tmp_path / "tools/write_commit.sh"]:
        path.parent.mkdir(parents=True)
        path.touch()
    (tmp_path / "tools/write_commit.sh").write_bytes((ROOT / "tools/write_commit.sh").read_bytes())
    subprocess.run(["bash", tmp_path / "tools/write_commit.sh"], check=True, capture_output=True)
    assert [path for path in objects if path.exists()] == []


def test_objects_of_moved_sources_are_not_linked(tmp_path):
    """fpm leaves the object of a source that was moved in its library, beside the new one."""
    folder = tmp_path / "build/gfortran_1/camroller"
    for name in ("tools/write_commit.sh", "src/base/words.f90", "build/gfortran_1/camroller/src_base_words.f90.o",
                 "build/gfortran_1/camroller/src_io_words.f90.o", "build/gfortran_2/camroller/libcamroller.a"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).touch()
    (tmp_path / "tools/write_commit.sh").write_bytes((ROOT / "tools/write_commit.sh").read_bytes())
    subprocess.run(["bash", tmp_path / "tools/write_commit.sh"], check=True, capture_output=True)
    assert [path.name for path in folder.iterdir()] == ["src_base_words.f90.o"]
    assert list((tmp_path / "build/gfortran_2/camroller").iterdir()) == []


def test_clean_keeps_what_was_fetched_and_results(tmp_path):
    kept = ["build/cache.toml", "build/dependencies/a", "build/pkgconfig/hdf5.pc", "build/without-open-mpi", "results/a.h5"]
    built = ["build/cmake/Makefile", "build/cmake-tests/Makefile", "build/cmake.lock", "build/wheel/Makefile", "build/gfortran_1/a.o",
             "build/scratch-1-a", "build/test.log", "bench/build/a.o"]
    for name in kept + built:
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).touch()
    subprocess.run(["make", "-f", ROOT / "Makefile", "clean"], cwd=tmp_path, check=True, capture_output=True)
    assert sorted(str(path.relative_to(tmp_path)) for path in tmp_path.rglob("*") if path.is_file()) == kept
    assert len(list((tmp_path / "build").iterdir())) == 4


def test_the_list_of_planted_faults_fits_the_sources():
    """Each text stands once in its file, what replaces it leaves no line too long for the compiler, and the test that is to fail is there
    and is not the stored table of results."""
    suites = (ROOT / "test/main.f90").read_text()
    assert len(faults()) >= 20
    for fault in faults():
        text = (ROOT / fault["file"]).read_text()
        assert text.count(fault["old"]) == 1, fault["name"]
        assert max(map(len, text.replace(fault["old"], fault["new"]).splitlines())) <= 132, fault["name"]
        if "suite" in fault:
            assert f'"{fault["suite"]}"' in suites and fault["suite"] != "regression"
        else:
            files, _, pattern = fault["pytest"].partition(" -k ")
            texts = "\n".join((ROOT / file).read_text() for file in files.split())
            assert re.search(rf"^def test_\w*{pattern}", texts, re.MULTILINE), fault["name"]


def test_code_of_a_file_that_is_gone_leaves_the_library(tmp_path):
    """Two libraries, one of which has what a deleted file had been compiled to; what else is in it stays. fpm itself is replaced."""
    for folder in ("tools", ".venv/bin", "src/base", "build/old/camroller", "build/new/camroller"):
        (tmp_path / folder).mkdir(parents=True)
    shutil.copy(ROOT / "tools/fpm", tmp_path / "tools/fpm")
    (tmp_path / ".venv/bin/fpm").symlink_to("/bin/true")
    (tmp_path / "src/base/kinds.f90").touch()
    kept = ["src_base_kinds.f90.o", "build_dependencies_test-drive_src_testdrive.F90.o"]
    for build, members in (("new", kept), ("old", [*kept, "src_base_moved.f90.o"])):
        for member in members:
            (tmp_path / member).touch()
        subprocess.run(["ar", "-rs", f"build/{build}/camroller/libcamroller.a", *members], cwd=tmp_path, check=True,
                       capture_output=True)
    subprocess.run(["tools/fpm", "build"], cwd=tmp_path, check=True)
    for build in ("new", "old"):
        listed = subprocess.run(["ar", "t", f"build/{build}/camroller/libcamroller.a"], cwd=tmp_path, check=True, capture_output=True, text=True)
        assert listed.stdout.split() == kept


def test_files_of_tests_alone_are_compiled_with_less_optimisation(tmp_path):
    """The compiler is replaced by one that prints what it is told."""
    compiler = tmp_path / "gfortran"
    compiler.write_text('#!/bin/sh\nprintf "%s\\n" "$@"\n')
    compiler.chmod(0o755)
    flags = ["-g1", "-O3", "-flto=auto", "-ffat-lto-objects", "-Dtext=a b"]
    told = {}
    for source in ("test/main.f90", "test/contact/test_film.f90", "src/contact/film.f90", "app/main.f90", "build/dependencies/test/x.f90"):
        words = subprocess.run([ROOT / "tools/gfortran", "-c", source, *flags], check=True, capture_output=True, text=True,
                               env=os.environ | {"PATH": f"{tmp_path}:{os.environ['PATH']}"}).stdout.splitlines()
        assert words[:2] == ["-c", source]
        told[source] = words[2:]
    assert [source for source, words in told.items() if words == ["-g1", "-Og", "-Dtext=a b"]] == ["test/main.f90", "test/contact/test_film.f90"]
    assert [words for source, words in told.items() if not source.startswith("test/")] == [flags]*3
