"""The build with a second compiler: what it takes, and how it ends, with a stand-in for the compiler."""

import second_compiler
from second_compiler import NO_COMPILER, Unit, available, compile_all, runner
from fortran_source import sources


def units_of(folder, **texts):
    """Units with these texts."""
    for name, text in texts.items():
        (folder / f"{name}.f90").write_text(text, encoding="utf-8")
    return {unit.name: unit for unit in (Unit(folder / f"{name}.f90") for name in texts)}


def test_files_that_need_an_external_module_are_left_out(tmp_path):
    units = units_of(tmp_path, c="module c\nuse b\nused = 1\nend module\n", a="module a\nuse, intrinsic :: iso_c_binding\nend module\n",
                     b="module b\nuse :: a, only : x\nend module\n", d="module d\nuse hdf5\nend module\n", e="module e\nuse d\nend module\n")
    assert list(available(units)) == ["a", "b", "c"]


def test_files_left_out_of_the_library_use_hdf5():
    library = {unit.name: unit for unit in map(Unit, sources("src"))}
    left = {name: library[name].uses for name in library.keys() - available(library).keys()}
    outside = set().union(*left.values()) - library.keys()
    assert outside == {"hdf5", "h5ds", "h5lt"} & outside and "hdf5" in outside
    assert all(uses & (outside | left.keys()) for uses in left.values())


def test_a_file_that_does_not_compile_is_counted_and_its_users_are_skipped(tmp_path, monkeypatch):
    monkeypatch.setattr(second_compiler, "ROOT", tmp_path)
    monkeypatch.setattr(second_compiler, "BUILD", tmp_path)
    (tmp_path / "fc").write_text('#!/bin/sh\ncase $2 in */b.f90) echo no good >&2; exit 1;; esac\necho $2 >> asked\n', encoding="utf-8")
    (tmp_path / "fc").chmod(0o755)
    units = units_of(tmp_path, a="module a\nend module\n", b="module b\nuse a\nend module\n", c="module c\nuse b\nend module\n")
    assert compile_all([str(tmp_path / "fc")], units) == ["b.f90: no good\n"]
    assert (tmp_path / "asked").read_text(encoding="utf-8").split() == [str(tmp_path / "a.f90")]


def test_the_runner_has_the_suites_that_compile(tmp_path, monkeypatch):
    monkeypatch.setattr(second_compiler, "BUILD", tmp_path)
    unit, kept, out = runner({"test_film": None, "test_error": None})
    text = unit.path.read_text(encoding="utf-8")
    assert kept == ["error", "film"] and "deck" in out
    assert unit.uses == {"testdrive", "camroller_blas_threads", "test_film", "test_error"}
    assert text.count("new_testsuite(") == 2 and 'new_testsuite("film", collect_film) &\n         ]' in text


def test_a_missing_second_compiler_is_reported(monkeypatch, capsys):
    monkeypatch.setattr(second_compiler.shutil, "which", lambda name: None)
    monkeypatch.delenv("SECOND_FC", raising=False)
    assert second_compiler.main() == NO_COMPILER
    assert "apt-get install flang-22" in capsys.readouterr().out
