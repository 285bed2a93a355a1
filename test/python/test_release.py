"""What a release consists of: one version everywhere, a citation file that is valid, a list of changes that begins with the version."""

import re
import tomllib

import pytest
from cffconvert.cli.create_citation import create_citation
from fortran_source import ROOT
from jsonschema.exceptions import ValidationError

VERSION = tomllib.loads((ROOT / "fpm.toml").read_text(encoding="utf-8"))["version"]
HEADING = re.compile(r"^## (\d+\.\d+\.\d+)(?:, (not yet released|\d{4}-\d{2}-\d{2}))?$")


def test_the_citation_file_follows_the_schema_and_gives_a_reference():
    citation = create_citation(str(ROOT / "CITATION.cff"), None)
    citation.validate()
    assert "title = {camroller: friction" in citation.as_bibtex()


def test_a_citation_file_without_title_is_refused(tmp_path):
    text = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    (tmp_path / "CITATION.cff").write_text(re.sub(r"^title:.*\n", "", text, flags=re.MULTILINE), encoding="utf-8")
    with pytest.raises(ValidationError, match="title"):
        create_citation(str(tmp_path / "CITATION.cff"), None).validate()


def versions():
    """Every place that states the version of this release, and what it states."""
    places = {"CITATION.cff": r"^version: (\S+)$", "src/base/version.f90": r'version_text = "([^"]+)"'}
    places |= {"packaging/spack/package.py": r'^ +version\("([^"]+)"\)$', "packaging/conda/recipe.yaml": r"^  version: (\d\S*)$"}
    places |= {str(path.relative_to(ROOT)): r'^version = "([^"]+)"$' for path in ROOT.glob("*/fpm.toml")}
    return {name: re.findall(pattern, (ROOT / name).read_text(encoding="utf-8"), re.MULTILINE) for name, pattern in places.items()}


@pytest.mark.parametrize("place", versions())
def test_every_place_states_the_version_of_the_manifest(place):
    assert versions()[place] == [VERSION]


def test_changelog_begins_with_this_version_and_descends():
    headings = [line for line in (ROOT / "CHANGELOG.md").read_text(encoding="utf-8").splitlines() if line.startswith("## ")]
    found = [HEADING.match(line) for line in headings]
    assert all(found), headings
    assert found[0][1] == VERSION
    numbers = [tuple(map(int, match[1].split("."))) for match in found]
    assert numbers == sorted(set(numbers), reverse=True)
    assert not any(match[2] == "not yet released" for match in found[1:])
