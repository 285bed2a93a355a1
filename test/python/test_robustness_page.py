"""Pages that name a test for each fault that was found, or for each promise to hosts, name tests that exist."""

import re

import pytest

from conftest import ROOT


@pytest.mark.parametrize(("name", "first"), [("robustness", "## Numbers"), ("hosts", "## Steps of a follower")])
def test_every_test_that_the_page_names_exists(name, first):
    page = (ROOT / f"doc/notes/{name}.md").read_text().replace("\n", " ")
    python = "".join(path.read_text() for folder in ("test", "post") for path in (ROOT / folder).rglob("test_*.py"))
    fortran = "".join(path.read_text() for path in (ROOT / "test").rglob("test_*.f90"))
    names = re.findall(r"`(test_\w+)`", page)
    titles = re.findall(r'"([^"]+)"', page.split(first)[1])
    assert len(names) > 20 and len(titles) > 20
    assert not [name for name in names if f"def {name}(" not in python]
    assert not [title for title in titles if f'new_unittest("{title}"' not in fortran]
