#!/usr/bin/env python3
"""Read the recipes of `packaging` with tools that know them, run their build lines, and run the program that these install.

Usage: make recipes, which installs packaging/requirements.txt and sets FPM

The recipe for Spack is executed with stand-ins for what Spack offers to it; its `install` installs. rattler-build reads the recipe for conda,
whose script has to be the one that Spack's runs, and whose tests run with what that has installed; what it would take from a channel comes
from this machine. hadolint reads the Containerfile; the container is built where buildah and the base image are there. Exit code 0, or 1
with what failed.
"""

from __future__ import annotations

import os
import pathlib
import re
import shutil
import subprocess
import sys
import types

from fortran_source import ROOT

PACKAGING, TARGET = ROOT / "packaging", ROOT / "build/recipes"
# What both recipes run: once is enough, since it compiles everything
INSTALL = "packaging/install.sh"


class RecipeError(Exception):
    """A recipe that cannot be read, or whose lines fail."""


def run(command: list | str, **variables: str) -> str:
    """Run a command or a line of the shell; what it prints."""
    done = subprocess.run(command, shell=isinstance(command, str), cwd=ROOT, env=os.environ | variables, text=True, check=False,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL)
    if done.returncode:
        raise RecipeError(f"{command}: exit code {done.returncode}\n{done.stdout[-3000:]}")
    return done.stdout


def spack_package(path: pathlib.Path = PACKAGING / "spack/package.py") -> type:
    """The class of the recipe, with its directives in `directives`."""
    directives: list[tuple[str, tuple, dict]] = []

    def directive(name: str):
        return lambda *arguments, **options: directives.append((name, arguments, options))

    module = types.ModuleType("spack.package")
    names = {name: directive(name) for name in ("version", "depends_on", "conflicts", "license")}
    names |= {"Package": object, "which": lambda name: lambda *arguments: run([shutil.which(name), *map(str, arguments)])}
    vars(module).update(names, __all__=list(names))
    before = {name: sys.modules.get(name) for name in ("spack", "spack.package")}
    sys.modules |= {"spack": types.ModuleType("spack"), "spack.package": module}
    try:
        space: dict = {}
        exec(compile(path.read_text(encoding="utf-8"), str(path), "exec"), space)  # noqa: S102
    except (NameError, SyntaxError, TypeError) as error:
        raise RecipeError(f"{path.relative_to(ROOT)}: {error}") from error
    finally:
        for name, value in before.items():
            if value is None:
                sys.modules.pop(name)
            else:
                sys.modules[name] = value
    package = space["Camroller"]
    package.directives = directives
    return package


def check_installed(prefix: pathlib.Path) -> None:
    """The program below a prefix runs a deck."""
    run([prefix / "bin/camroller", "run", "decks/thesis.nml", "-o", prefix / "thesis.h5", "--quiet"])


def check_spack() -> str:
    """Install as the recipe for Spack does."""
    package, prefix = spack_package(), TARGET / "spack"
    # without optimisation: that the program is right is tested elsewhere, and it is compiled in a third of the time
    os.environ["FFLAGS"] = "-O0"
    package().install(None, prefix)
    check_installed(prefix)
    return "Spack: recipe executed with stand-ins, program installed and run"


def check_conda() -> str:
    """Read the recipe for conda; test what the script that it runs has installed for Spack."""
    from rattler_build import RattlerBuildError, Stage0Recipe, VariantConfig  # pylint: disable=import-outside-toplevel
    variants = VariantConfig.from_yaml("c_compiler: [gcc]\nfortran_compiler: [gfortran]\nc_stdlib: [sysroot]\n")
    try:
        recipe = Stage0Recipe.from_file(str(PACKAGING / "conda/recipe.yaml")).render(variants)[0].recipe
    except RattlerBuildError as error:
        raise RecipeError(f"packaging/conda/recipe.yaml: {error}") from error
    if recipe.build.script != f'{INSTALL} "$PREFIX"':
        raise RecipeError(f"packaging/conda/recipe.yaml: the script is {recipe.build.script!r}, not {INSTALL}, which was run for Spack")
    prefix = TARGET / "spack"
    commands = re.findall(r"^      - (.+)$", (PACKAGING / "conda/recipe.yaml").read_text(encoding="utf-8").split("\ntests:")[1], re.MULTILINE)
    for command in commands:
        run(command, PATH=f"{prefix}/bin:{os.environ['PATH']}")
    return f"conda: recipe rendered by rattler-build, its script is that of Spack's, {len(commands)} tests of it run"


def check_container() -> str:
    """Read the Containerfile; build it where that can be done."""
    run([pathlib.Path(sys.executable).parent / "hadolint", PACKAGING / "Containerfile"])
    base = re.findall(r"^FROM (\S+)", (PACKAGING / "Containerfile").read_text(encoding="utf-8"), re.MULTILINE)
    if not shutil.which("buildah"):
        return "container: Containerfile read by hadolint; not built: no buildah"
    for image in base:
        if subprocess.run(["buildah", "pull", "--policy", "missing", image], capture_output=True, check=False).returncode:
            return f"container: Containerfile read by hadolint; not built: no image {image}"
    run(["buildah", "build", "-f", PACKAGING / "Containerfile", "-t", "camroller", "."])
    return "container: Containerfile read by hadolint, image built; its last line ran the program"


def main() -> int:
    """All recipes; returns the exit code."""
    shutil.rmtree(TARGET, ignore_errors=True)
    faults = 0
    for check in (check_spack, check_conda, check_container):
        try:
            print(check(), flush=True)
        except RecipeError as error:
            print(f"{check.__name__}: {error}", file=sys.stderr)
            faults += 1
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
