"""Manual page and completion, which are made of the program's own table of commands."""

from __future__ import annotations

import re
import shutil
import subprocess

import pytest

from conftest import printed


def complete(script, *words):
    """What bash offers for the last of some words."""
    line = f"source {script}; COMP_WORDS=({' '.join(repr(word) for word in words)}); COMP_CWORD={len(words) - 1}; " \
           "_camroller 2> /dev/null; printf '%s\\n' \"${COMPREPLY[@]}\""
    return printed("bash", "-c", line, folder=script.parent).split()


def test_completion_knows_commands_options_and_files(camroller, tmp_path):
    script = tmp_path / "completion"
    script.write_text(printed(camroller, "help", "--completion"))
    (tmp_path / "deck.nml").write_text("")
    assert complete(script, "camroller", "s") == ["sweep", "study", "selftest"]
    assert complete(script, "camroller", "fmu", "--li") == ["--library"]
    assert complete(script, "camroller", "run", "de") == ["deck.nml"]
    assert complete(script, "camroller", "run", "x.nml", "--output", "de") == ["deck.nml"]
    assert complete(script, "camroller", "help", "fm") == ["fmu"]
    # the commands and options that the program's help lists, all of them and no others
    commands = re.findall(r"^  camroller (\w+)", printed(camroller, "help"), re.MULTILINE)
    assert len(commands) > 10 and sorted(complete(script, "camroller", "")) == sorted(commands)
    for command in commands:
        listed = re.findall(r"^  (?:-\w, )?(--[\w-]+)", printed(camroller, "help", command), re.MULTILINE)
        assert listed and sorted(complete(script, "camroller", command, "--")) == sorted(listed), command


def test_manual_page_is_one_and_names_all_commands(camroller, tmp_path):
    if shutil.which("man") is None or shutil.which("groff") is None:
        pytest.skip("there is no man here")
    page = tmp_path / "camroller.1"
    page.write_text(printed(camroller, "help", "--man"))
    done = subprocess.run(["groff", "-man", "-Tutf8", "-ww", str(page)], capture_output=True, text=True, check=False)
    assert done.returncode == 0 and done.stderr == ""
    for word in ("fmu DECK", "--shard", "EXIT STATUS", "group.key=value"):
        assert word in printed("man", "-l", "-P", "cat", page, env={"MANWIDTH": "200", "PATH": "/usr/bin:/bin"}).replace("‐", "-"), word
