"""The page that names a test for each fault that was found names tests that exist."""

import re

from conftest import ROOT


def test_every_test_that_the_page_names_exists():
    page = (ROOT / "doc/notes/robustness.md").read_text().replace("\n", " ")
    python = "".join(path.read_text() for folder in ("test", "post") for path in (ROOT / folder).rglob("test_*.py"))
    fortran = "".join(path.read_text() for path in (ROOT / "test").rglob("test_*.f90"))
    names = re.findall(r"`(test_\w+)`", page)
    titles = re.findall(r'"([^"]+)"', page.split("## Numbers")[1])
    assert len(names) > 40 and len(titles) > 20
    assert not [name for name in names if f"def {name}(" not in python]
    assert not [title for title in titles if f'new_unittest("{title}"' not in fortran]
