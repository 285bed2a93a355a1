"""The recipes of `packaging`: what they ask for is what the program needs."""

import pathlib
import re

import check_recipes
import pytest
from check_recipes import RecipeError, spack_package
from fortran_source import ROOT


def test_the_recipe_for_spack_asks_for_what_the_program_links():
    package = spack_package()
    wanted = {arguments[0].split("+")[0] for name, arguments, _ in package.directives if name == "depends_on"}
    assert wanted == {"c", "fortran", "fpm", "pkgconfig", "hdf5", "openblas"}
    assert ("license", ("MIT",), {}) in package.directives


def test_its_build_line_is_the_one_that_installs(monkeypatch):
    called = []
    monkeypatch.setattr(check_recipes, "run", called.append)
    spack_package()().install(None, pathlib.Path("/made/up"))
    assert [pathlib.Path(word).name for word in called[0]] == ["bash", "install.sh", "up"]


@pytest.mark.parametrize("text", ["class Camroller(Package:\n", "from spack.package import *\ndepend_on('hdf5')\n",
                                  "from spack.package import *\nclass Camroller(Sackage):\n    pass\n"])
def test_a_recipe_that_cannot_be_read_is_refused(tmp_path, monkeypatch, text):
    monkeypatch.setattr(check_recipes, "ROOT", tmp_path)
    (tmp_path / "package.py").write_text(text, encoding="utf-8")
    with pytest.raises(RecipeError, match="package.py"):
        spack_package(tmp_path / "package.py")


def test_the_recipes_run_a_script_that_is_there_and_the_containerfile_copies_what_is_there():
    script = re.search(r"^  script: (\S+)", (ROOT / "packaging/conda/recipe.yaml").read_text(encoding="utf-8"), re.MULTILINE)[1]
    assert (ROOT / script).stat().st_mode & 0o111
    stages = (ROOT / "packaging/Containerfile").read_text(encoding="utf-8")
    copied = re.findall(r"^COPY --from=build /camroller/(\S+)", stages, re.MULTILINE)
    assert copied == ["build/release/bin/camroller", "decks"]
