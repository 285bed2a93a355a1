"""The commands of the README, the reader of Fortran sources and the set-up."""

import pathlib
import subprocess
import sys

import pytest
from fortran_source import ROOT, statements
from readme_commands import commands_of, main


def test_only_sh_blocks_hold_commands():
    text = "```sh\nmake run\n```\ntext `make no`\n```\nmake neither\n```\n```fortran\nuse x\n```\n```sh\nmake test\n```\n"
    assert commands_of(text) == ["make run", "make test"]


def test_remarks_and_continued_lines_are_understood():
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


@pytest.mark.skipif(not (ROOT / ".venv/requirements.done").exists(), reason="not set up by tools/setup.sh")
def test_set_up_repeats_without_work():
    """Where everything is there, nothing is said and nothing is fetched."""
    result = subprocess.run([ROOT / "tools/setup.sh"], capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL)
    assert (result.returncode, result.stdout, result.stderr) == (0, "", "")


def run_set_up(folder, apt_get=None):
    """Run the set-up on a machine without gfortran but with MPI, with the given text as apt-get."""
    for name in ("bash", "dirname", "env", "tr", "sed", "head", "tail", "mkdir", "git", "make", "gcc", "pkg-config"):
        found = subprocess.run(["bash", "-c", f"command -v {name}"], capture_output=True, text=True, check=False).stdout
        if found.strip():
            (folder / name).symlink_to(pathlib.Path(found.strip()))
    (folder / "python3").symlink_to(pathlib.Path(sys.executable).resolve())
    scripts = {"id": "echo 0", "apt-get": apt_get, "mpifort": "", "mpirun": ""}
    for name, text in scripts.items():
        if text is not None:
            (folder / name).write_text(f"#!{folder}/bash\n{text}\n", encoding="utf-8")
            (folder / name).chmod(0o755)
    environment = {"PATH": str(folder), "HOME": str(folder)}
    return subprocess.run([ROOT / "tools/setup.sh"], env=environment, capture_output=True, text=True, check=False,
                          stdin=subprocess.DEVNULL)


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
