"""How every script ends: with files that are none, closed pipes, folders that are not there or cannot be."""

import os
import pathlib
import subprocess
import sys

import h5py
from matplotlib.figure import Figure
from matplotlib.text import Text
import numpy as np
import pytest

import command
import ehl
import ehl_map
import plot
import plot_audit
import plot_study
import plot_sweep
import report
import table
import test_ehl
import test_plot_audit
import test_plot_study
import thesis_comparison
from test_cases import without_series
from test_post import write_result

HERE = pathlib.Path(__file__).resolve().parent
PNG = b"\x89PNG\r\n\x1a\n"
SCRIPTS = {"plot": (plot, ["--figure", "load"]), "table": (table, []),
           "plot_sweep": (plot_sweep, ["--quantity", "mean_torque_drive"]),
           "plot_study": (plot_study, []), "plot_audit": (plot_audit, []), "ehl": (ehl, ["--output", "OUT/x.png"]),
           "ehl_map": (ehl_map, ["OUT/x.png"]), "thesis_comparison": (thesis_comparison, ["--page", "OUT/page.md"])}
made_ehl, made_audit, made_study = (module.made_up for module in (test_ehl, test_plot_audit, test_plot_study))


@pytest.fixture(name="good")
def fixture_good(tmp_path, made_ehl, made_audit, made_study):
    """A file that suits each script."""
    sweep = write_result(tmp_path / "grid.h5", step=30.0)
    with h5py.File(sweep, "a") as file:
        file["summary/status"] = np.zeros(9, dtype="i4")
    values = np.random.default_rng(1).random((20, 12)) + 0.5
    np.savetxt(tmp_path / "map.txt", values)
    return {"plot": sweep, "table": sweep, "plot_sweep": sweep, "plot_study": made_study, "plot_audit": made_audit, "ehl": made_ehl,
            "ehl_map": tmp_path / "map.txt"}


fixture_ehl = pytest.fixture(name="made_ehl")(getattr(made_ehl, "__wrapped__", None) or made_ehl._fixture_function)
fixture_audit = pytest.fixture(name="made_audit")(getattr(made_audit, "__wrapped__", None) or made_audit._fixture_function)
fixture_study = pytest.fixture(name="made_study")(getattr(made_study, "__wrapped__", None) or made_study._fixture_function)


def ended(name, path, folder, capsys):
    """Exit code and lines on the screen of a script with a file."""
    module, arguments = SCRIPTS[name]
    arguments = [argument.replace("OUT", str(folder)) for argument in arguments]
    if name in ("plot", "plot_sweep", "plot_study", "plot_audit"):
        arguments += ["--output", str(folder)]
    code = module.main([str(path), *arguments])
    return code, capsys.readouterr().err


def no_such_file(path):
    path.unlink(missing_ok=True)


def text_file(path):
    path.write_text("speed, torque\n1, x\n")


def empty_file(path):
    path.write_bytes(b"")


def folder(path):
    path.unlink()
    path.mkdir()


def other_hdf5(path):
    with h5py.File(path, "w") as file:
        file["x"] = 1


def truncated(path):
    path.write_bytes(path.read_bytes()[:path.stat().st_size // 2])


def groups_for_datasets(path):
    """The names are there, and what they name is of another kind."""
    with h5py.File(path, "w") as file:
        for name in ("series/cam_angle", "series/contact_load", "summary/status", "summary/mean_torque_drive", "sweep/a.x",
                     "study/audit/run", "study/references/case", "study/methods/case", "ehl/load", "ehl/film_min"):
            file.create_group(name)
        file.attrs["complete"] = 1


def single_numbers(path):
    """Single numbers where there should be one for each case."""
    with h5py.File(path, "w") as file:
        for name in ("series/cam_angle", "series/contact_load", "summary/status", "summary/mean_torque_drive", "sweep/a.x",
                     "study/audit/run", "study/references/case", "study/methods/method", "ehl/load", "ehl/film_min"):
            file[name] = 1.0
        file.attrs["complete"] = 1


@pytest.mark.parametrize("spoil", [no_such_file, text_file, empty_file, folder, other_hdf5, truncated, groups_for_datasets,
                                   single_numbers])
@pytest.mark.parametrize("name", SCRIPTS)
def test_a_file_that_cannot_be_used_is_one_line_and_code_2(good, tmp_path, capsys, name, spoil):
    path = good.get(name, tmp_path / "no")
    if name == "thesis_comparison":
        (tmp_path / "runs").mkdir()
        path = write_result(tmp_path / "runs/thesis.h5", step=30.0)
    spoil(path)
    if (name, spoil) == ("ehl_map", truncated):
        path.write_text(path.read_text()[:-30])  # every whole row is a table
    code, said = ended(name, path.parent if name == "thesis_comparison" else path, tmp_path / "new", capsys)
    assert code == 2 and said.count("\n") == 1 and said.startswith(name + ".py: ") and len(said) < 400
    assert not list((tmp_path / "new").glob("*"))


@pytest.mark.parametrize("name", [name for name in SCRIPTS if name not in ("table", "thesis_comparison")])
def test_a_folder_that_is_not_there_is_made_and_what_is_in_the_way_named(good, tmp_path, capsys, name):
    assert ended(name, good[name], tmp_path / "new/deep", capsys) == (0, "")
    assert list((tmp_path / "new/deep").glob("*.png")) and not list((tmp_path / "new/deep").glob(".*"))
    (tmp_path / "taken").write_text("")
    code, said = ended(name, good[name], tmp_path / "taken", capsys)
    assert code == 2 and said.count("\n") == 1 and "cannot be written" in said
    assert (tmp_path / "taken").read_text() == ""


@pytest.mark.parametrize("arguments", [["table.py", "FILE", "--all"], ["thesis/thesis_comparison.py", "--runs"],
                                       ["plot.py", "FILE", "--figure", "load"], ["plot_sweep.py", "FILE"]])
def test_a_closed_pipe_ends_quietly(good, tmp_path, arguments):
    words = [str(good["table"]) if word == "FILE" else word for word in arguments]
    reading, writing = os.pipe()
    os.close(reading)
    with os.fdopen(writing, "w") as pipe:
        done = subprocess.run([sys.executable, HERE / words[0], *words[1:]], stdout=pipe, stderr=subprocess.PIPE, text=True,
                              timeout=120, cwd=tmp_path, check=False, env={**os.environ, "MPLCONFIGDIR": str(tmp_path / "config")})
    assert done.stderr == "" and done.returncode == command.CLOSED_PIPE


def test_a_figure_is_written_whole_or_not_at_all(tmp_path):
    class Breaks(Figure):
        """A figure whose writing breaks in the middle."""
        def savefig(self, target, **_):
            """Some bytes, then an error."""
            pathlib.Path(target).write_bytes(b"half")
            raise OSError(28, "No space left on device")

    (tmp_path / "x.png").write_bytes(PNG)
    with pytest.raises(command.ResultError, match="cannot be written: No space left on device"):
        command.save_figure(Breaks(), tmp_path / "x.png")
    assert (tmp_path / "x.png").read_bytes() == PNG and [path.name for path in tmp_path.iterdir()] == ["x.png"]


def test_a_result_is_not_overwritten_by_a_figure_or_a_page(good, capsys):
    before = good["ehl"].read_bytes()
    assert ehl.main([str(good["ehl"]), "--output", str(good["ehl"])]) == 2
    assert "no kind of figure" in capsys.readouterr().err
    with pytest.raises(command.ResultError, match="of another kind"):
        command.write_text(good["ehl"], "x")
    assert good["ehl"].read_bytes() == before


@pytest.mark.parametrize("kind", ["png", "pdf", "svg"])
@pytest.mark.parametrize("there", [b"&case\n  title = 'mine'\n/\n", b"#!/usr/bin/env python3\n", b"# Notes\n", b"GIF89a"])
def test_only_a_file_of_its_kind_is_replaced(tmp_path, there, kind):
    """A deck, a source, notes or another picture at the name of a figure stay; an earlier figure and an empty file do not."""
    figure, target = Figure(), tmp_path / f"x.{kind}"
    target.write_bytes(there)
    with pytest.raises(command.ResultError, match="not written: the file there is of another kind"):
        command.save_figure(figure, target)
    assert target.read_bytes() == there and list(tmp_path.iterdir()) == [target]
    target.write_bytes(b"")
    for _ in range(2):
        command.save_figure(figure, target)
    assert target.stat().st_size > 500 and list(tmp_path.iterdir()) == [target]


def test_every_script_refuses_a_target_of_another_kind(good, tmp_path, capsys):
    targets = {"ehl": "x", "ehl_map": "x", "plot": "grid_load", "plot_sweep": "grid_curves", "plot_audit": "made_audit",
               "plot_study": "made_study_work_precision"}
    places = {tmp_path / f"out/{made}.png" for made in targets.values()}
    (tmp_path / "out").mkdir()
    for place in places:
        place.write_text("&case /\n")
    for name in targets:
        code, said = ended(name, good[name], tmp_path / "out", capsys)
        assert code == 2 and said.count("\n") == 1 and "of another kind" in said, name
    assert set((tmp_path / "out").iterdir()) == places and {place.read_text() for place in places} == {"&case /\n"}


def test_pages_replace_their_own_kind_alone_and_links_stay(good, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(report, "figures_of", lambda result: "")  # which take seconds
    page, link = tmp_path / "page.html", tmp_path / "link.html"
    link.symlink_to(page)
    for _ in range(2):
        assert report.main([str(good["plot"]), "-o", str(link)]) == 0
    assert link.is_symlink() and page.read_text(encoding="utf-8").startswith("<!DOCTYPE html>")
    page.write_text("# Notes\n")
    assert report.main([str(good["plot"]), "-o", str(link)]) == 2 and "link.html: not written" in capsys.readouterr().err
    assert page.read_text() == "# Notes\n"


def test_a_target_that_is_no_regular_file_is_refused(tmp_path):
    os.mkfifo(tmp_path / "pipe.png")
    with pytest.raises(command.ResultError, match="not a regular file"):
        command.write_file(tmp_path / "pipe.png", lambda beside: None)


@pytest.mark.parametrize("name, dpi", [("plot", "0"), ("plot", "-5"), ("plot", "1e9"), ("plot_sweep", "100000")])
def test_dots_per_inch_have_bounds(good, capsys, name, dpi):
    with pytest.raises(SystemExit) as end:
        SCRIPTS[name][0].main([str(good[name]), "--dpi", dpi])
    assert end.value.code == 2 and "whole number from 20 to 1200" in capsys.readouterr().err


def test_files_of_a_sweep_without_series_do_for_every_script_that_reads_results(tmp_path, capsys):
    path = without_series(write_result(tmp_path / "grid.h5", step=30.0))
    for module, arguments in ((table, []), (plot, ["--figure", "mean_torque"]), (plot_sweep, ["--quantity", "mean_torque_drive"])):
        assert module.main([str(path), *arguments]) == 0
    assert capsys.readouterr().err == ""


def test_reading_that_never_ends_is_ended_with_a_line(good):
    program = "import sys, time, read; read.LONGEST_READ = 0.1; read.SLOWEST_READ = 1e9\n" \
              "with read.opened(sys.argv[1]): time.sleep(60)"
    done = subprocess.run([sys.executable, "-c", program, good["table"]], cwd=HERE, capture_output=True, text=True, timeout=50,
                          check=False)
    assert done.returncode != 0 and done.stderr.count("\n") == 1 and "goes in circles" in done.stderr


def test_dollars_in_titles_are_no_formulas(tmp_path, monkeypatch, capsys):
    """What would be a formula, right or wrong, is drawn letter by letter; numbers along logarithmic axes stay powers of ten."""
    drawn, save = [], Figure.savefig
    monkeypatch.setattr(Figure, "savefig", lambda figure, *args, **options: (drawn.append(figure), save(figure, *args, **options)))
    monkeypatch.setattr(report, "SHOWN", report.SHOWN[:1])  # the one that is looked at
    table_of_rig = tmp_path / "a$b$.csv"
    table_of_rig.write_text("speed [rpm], temperature [degC], mean torque [N mm]\n300, 25, 100\n", encoding="utf-8")
    scripts = ((plot, ["--figure", "dampers"]), (plot, ["--measured", str(table_of_rig)]),
               (plot_sweep, ["--quantity", "mean_torque_drive"]), (report, []))
    # the right formula with one script: each sets the same of a text, whatever stands in it
    for title, drawing in (("$x_1^{2$", scripts), ("$x_1^2$", scripts[:1])):
        path = without_series(write_result(tmp_path / "grid.h5", step=30.0, title=title), kept=range(9))
        for module, arguments in drawing:
            drawn.clear()
            assert module.main([str(path), *arguments]) == 0, capsys.readouterr().err
            texts = [text for text in drawn[0].findobj(Text) if title in text.get_text()]
            assert texts and not any(text.get_parse_math() for text in texts)
            powers = [text for text in drawn[0].findobj(Text) if text.get_text().startswith(command.POWER)]
            assert all(text.get_parse_math() for text in powers) and ("dampers" not in arguments or powers)
