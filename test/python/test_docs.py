"""The API reference: what is done to pages and sources before FORD reads them, and what counts as a broken link."""

import make_docs
from make_docs import COMMA, Pages, lengths_without_commas, link_faults


def test_links_lead_to_html_and_formulas_are_kept_apart():
    pages = Pages()
    text = pages.converted("See [x](../y.md#z), `a.md`, $a_1 < b$ and `$HOME`; 5 $ or 6 $.\n- one\n")
    assert text == "See [x](../y.html#z), `a.md`, FORMULA00000X and `$HOME`; 5 $ or 6 $.\n\n- one\n"
    assert "<math" in pages.filled(text) and "FORMULA" not in pages.filled(text)


def test_commas_inside_a_character_length_are_kept():
    text = "character(len=f(a, g(b, c)) + 1), intent(in) :: x, y\ncharacter(len=*), intent(out) :: z\n"
    assert lengths_without_commas(text) == text.replace("(a, g(b, c))", f"(a{COMMA} g(b{COMMA} c))")


def test_broken_links_missing_anchors_and_files_from_the_network_are_found(tmp_path):
    (tmp_path / "in").mkdir()
    (tmp_path / "good.html").write_text('<h1 id="top">x</h1><a href="in/other.html#there">x</a><a href="https://example.org/">x</a>'
                                        '<a href="#top">x</a><a name="there"></a>', encoding="utf-8")
    (tmp_path / "in/other.html").write_text('<a id="there" href="../good.html#there">x</a>', encoding="utf-8")
    assert link_faults(tmp_path) == []
    (tmp_path / "bad.html").write_text('<a href="none.html">x</a><a href="good.html#none">x</a><img src="none.png">'
                                       '<script src="https://example.org/x.js"></script>', encoding="utf-8")
    assert link_faults(tmp_path) == ["bad.html: good.html#none is not there", "bad.html: https://example.org/x.js needs the network",
                                     "bad.html: none.html is not there", "bad.html: none.png is not there"]


def test_a_docstring_stays_text_where_it_begins_like_metadata_or_holds_asterisks(tmp_path, monkeypatch):
    (tmp_path / "src/a").mkdir(parents=True)
    (tmp_path / "src/a/b.f90").write_text("!> State: W* and `x*y*z`, U*.\n!> In: nothing.\nmodule b\nend module b\n", encoding="utf-8")
    monkeypatch.setattr(make_docs, "ROOT", tmp_path)
    monkeypatch.setattr(make_docs, "STAGE", tmp_path / "stage")
    make_docs.stage_source()
    assert (tmp_path / "stage/src/a/b.f90").read_text(encoding="utf-8") == \
        "!> State&#58; W\\* and `x*y*z`, U\\*.\n!> In: nothing.\nmodule b\nend module b\n"
