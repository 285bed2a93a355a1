"""A stranger's path: every command of the tutorial, in order, and what the page says that they print."""

import os
import pathlib
import re
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = (ROOT / "doc/tutorial.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"^```(sh|text|fortran)\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)


def commands_of(block):
    return [line for line in block.replace("\\\n", " ").splitlines() if line.strip()]


@pytest.mark.skipif(not BLOCKS, reason="no commands")
@pytest.mark.once
def test_every_command_works_and_prints_what_the_page_shows(camroller, tmp_path):
    for name in ("decks", "post", "doc"):
        (tmp_path / name).symlink_to(ROOT / name)
    (tmp_path / "results").mkdir()
    printed, shown = "", 0
    for kind, block in BLOCKS:
        if kind == "sh":
            printed = ""
            for command in commands_of(block):
                command = command.replace("build/release/bin/camroller", camroller).replace(".venv/bin/python", sys.executable)
                result = subprocess.run(["bash", "-c", command], cwd=tmp_path, capture_output=True, text=True, check=False,
                                        stdin=subprocess.DEVNULL, env={**os.environ, "MPLBACKEND": "Agg"})
                assert result.returncode == 0, (command, result.stderr)
                printed += result.stdout + result.stderr
        elif kind == "fortran":
            (tmp_path / block.splitlines()[0].removeprefix("! ")).write_text(block)
        else:
            for line in block.splitlines():
                shown += 1
                assert line in printed, line
    assert shown >= 3
    for made in ("mine.svg", "before_vs_after_slip.png", "engine_friction_sources.png", "engine.html", "mine_measured.png"):
        assert (tmp_path / "results" / made).stat().st_size > 1000
