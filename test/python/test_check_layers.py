"""The layer check finds what it is there to find."""

import pytest
from check_layers import MAY_USE, PHYSICS_BESIDE, PHYSICS_FLOORS, main


def write(root, files):
    """Write modules: path without suffix -> names of used modules."""
    (root / "app").mkdir()
    for path, used in files.items():
        target = root / f"{path}.f90"
        target.parent.mkdir(parents=True, exist_ok=True)
        uses = "".join(f"   use camroller_{name}, only : x\n" for name in used)
        target.write_text(f"module camroller_{target.stem}\n{uses}   implicit none\nend module\n", encoding="utf-8")


def faults(root, capsys):
    """Exit code and lines on the error unit."""
    code = main(["--root", str(root)])
    return code, capsys.readouterr().err.splitlines()


def test_downward_arrows_pass(tmp_path, capsys):
    write(tmp_path, {"src/base/kinds": [], "src/numerics/roots": ["kinds"], "src/physics/film": ["roots", "hertz"],
                     "src/physics/hertz": ["kinds"], "src/solver/model": ["film"], "src/io/deck": ["model", "film"],
                     "src/capi": ["deck", "roots"]})
    assert faults(tmp_path, capsys) == (0, [])


@pytest.mark.parametrize(("user", "used"), [
    ("base/a", "numerics/b"), ("numerics/a", "physics/film"), ("physics/film", "solver/b"), ("physics/film", "io/b"),
    ("solver/a", "io/b"), ("io/a", "numerics/b"), ("base/a", "io/b")])
def test_an_arrow_up_fails_with_its_place(tmp_path, capsys, user, used):
    name = used.split("/")[1]
    write(tmp_path, {f"src/{user}": [name], f"src/{used}": []})
    code, lines = faults(tmp_path, capsys)
    assert code == 1
    assert lines == [f"src/{user}.f90:2: {user.split('/')[0]} may not use camroller_{name} of {used.split('/')[0]}"]


def test_nothing_uses_the_app(tmp_path, capsys):
    write(tmp_path, {"app/cli": [], "src/solver/a": ["cli"]})
    code, lines = faults(tmp_path, capsys)
    assert code == 1
    assert "solver may not use camroller_cli of app" in lines[0]


@pytest.mark.parametrize(("user", "used"), [
    ("lift", "kinematics"), ("hertz", "film"), ("film", "traction"), ("film", "asperity"), ("lubricant", "lift"),
    ("film", "needle"), ("needle", "roller"), ("needle", "guide"), ("roller", "torque")])
def test_an_arrow_up_inside_physics_fails(tmp_path, capsys, user, used):
    write(tmp_path, {f"src/physics/{user}": [used], f"src/physics/{used}": []})
    code, lines = faults(tmp_path, capsys)
    assert code == 1
    assert lines[0].startswith(f"src/physics/{user}.f90:2: camroller_{used} ")


@pytest.mark.parametrize(("user", "used"), [
    ("lift", "lubricant"), ("needle", "lubricant"), ("torque", "guide"), ("roller", "traction"), ("film", "hertz")])
def test_an_arrow_down_inside_physics_passes(tmp_path, capsys, user, used):
    write(tmp_path, {f"src/physics/{user}": [used], f"src/physics/{used}": []})
    assert faults(tmp_path, capsys) == (0, [])


def test_a_circle_is_named(tmp_path, capsys):
    write(tmp_path, {"src/solver/a": ["b"], "src/solver/b": ["c"], "src/solver/c": ["a"]})
    code, lines = faults(tmp_path, capsys)
    assert code == 1
    assert lines == ["circle: src/solver/a.f90 -> src/solver/b.f90 -> src/solver/c.f90 -> src/solver/a.f90"]


def test_new_files_and_folders_have_to_be_placed(tmp_path, capsys):
    write(tmp_path, {"src/physics/novelty": [], "src/misc/a": []})
    code, lines = faults(tmp_path, capsys)
    assert code == 1
    assert any("novelty.f90: has no floor" in line for line in lines)
    assert any("'misc' is no layer" in line for line in lines)


def test_names_in_strings_and_comments_are_no_arrows(tmp_path, capsys):
    write(tmp_path, {"src/io/deck": []})
    text = "module camroller_kinds\n! use camroller_deck\ncharacter(40) :: a = 'use camroller_deck'\nend module\n"
    (tmp_path / "src/base").mkdir()
    (tmp_path / "src/base/kinds.f90").write_text(text, encoding="utf-8")
    assert faults(tmp_path, capsys) == (0, [])


def test_the_tables_agree_with_themselves():
    names = [name for floor in PHYSICS_FLOORS for name in floor] + sorted(PHYSICS_BESIDE)
    assert len(names) == len(set(names))
    assert all(used <= set(MAY_USE) for used in MAY_USE.values())


def test_this_project_keeps_its_layers(capsys):
    assert main([]) == 0, capsys.readouterr().err
