"""The report: one page that needs nothing else, with what a colleague asks for; a browser shows it."""

import pathlib
import re
import shutil
import subprocess
import sys

import h5py
import pytest

from layout import Layout
from read import read_result
from report import main, page_of
from test_post import write_result

ROOT = pathlib.Path(__file__).resolve().parents[1]
BROWSER = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")


@pytest.fixture(name="page", scope="module")
def fixture_page(tmp_path_factory):
    """Path of a report of nine cases, one of them without a result; its figures take seconds."""
    folder = tmp_path_factory.mktemp("page")
    source = write_result(folder / "nine.h5", title="a <rig> & its oil")
    with h5py.File(source, "a") as file:
        file["summary/status"] = [0, 0, 3, 0, 0, 0, 0, 0, 0]
    target = folder / "report.html"
    assert main([str(source), "-o", str(target)]) == 0
    return target


@pytest.fixture(name="no_figures")
def fixture_no_figures(monkeypatch):
    """Leave the figures out, which take seconds for a page whose words are looked at."""
    monkeypatch.setattr("report.figures_of", lambda result: "")


def test_page_stands_alone(page):
    text = page.read_text(encoding="utf-8")
    assert not re.search(r'(?:src|href)="(?!data:)', text) and "http://" not in re.sub(r"base64,[^\"]*", "", text)
    assert "a &lt;rig&gt; &amp; its oil" in text
    for heading in ("Results", "Remarks", "Figures", "Deck", "How it was made"):
        assert f"<h2>{heading}</h2>" in text
    assert text.count("<figure>") >= 6
    assert len(re.findall(r"<tr><td>", text)) == 8  # of cases with a result


@pytest.mark.usefixtures("no_figures")
def test_page_shows_the_worst_lobe_shape(tmp_path):
    source = write_result(tmp_path / "nine.h5")
    with h5py.File(source, "a") as file:
        file["summary/mean_lobe_2_slip_ratio"] = file["summary/mean_slip_ratio"][()] * 0.0 + 0.777
        file["summary/mean_lobe_2_slip_ratio"].attrs["units"] = "1"
    text = page_of(read_result(source))
    assert "77.7" in text and "mean slip: the worst of all lobe shapes" in text


@pytest.mark.usefixtures("no_figures")
def test_page_is_written_beside_the_file_and_errors_are_one_line(tmp_path, capsys):
    source = write_result(tmp_path / "nine.h5")
    assert main([str(source)]) == 0 and (tmp_path / "nine.html").exists()
    (tmp_path / "none.h5").write_bytes(b"no result")
    for name in ("none.h5", "absent.h5"):
        result = subprocess.run([sys.executable, ROOT / "post/report.py", tmp_path / name], capture_output=True, text=True, check=False)
        assert result.returncode == 2 and result.stderr.count("\n") == 1 and name in result.stderr
    assert not (tmp_path / "none.html").exists() and "report:" in capsys.readouterr().out


@pytest.mark.usefixtures("no_figures")
def test_remarks_of_a_kind_are_one_line_and_estimates_are_told(tmp_path):
    source = write_result(tmp_path / "nine.h5")
    with h5py.File(source, "a") as file:
        texts = [f"lobe 1: the joint lacks {force} N\nlobe 2: the joint lacks {force} N" if force > 5 else "" for force in range(9)]
        texts[8] += "\nthe film is thin"
        if "run/warnings" in file:
            del file["run/warnings"]
        file["run/warnings"] = texts
        for key, words in (("temperature_law", "data_sheet"), ("sae_grade", "5W-30")):
            file.require_group("deck/values")[f"lubricant.{key}"] = words
    page = page_of(read_result(source))
    remarks = re.findall(r"<li>(.*)</li>", page)
    third = "case 6 (speed 900 rev/min, oil temperature 25 °C)"
    of_cases = [f"3 of 9 cases, first {third}: lobe 1: the joint lacks 6 N", f"3 of 9 cases, first {third}: lobe 2: the joint lacks 6 N",
                "case 8 (speed 900 rev/min, oil temperature 95 °C): the film is thin"]
    assert remarks == of_cases
    with h5py.File(source, "a") as file:
        file["deck/remarks"] = ["roller.mass_kg = 9 is unusual", "the film is thin"]
    remarks = re.findall(r"<li>(.*)</li>", page_of(read_result(source)))
    assert remarks == ["roller.mass_kg = 9 is unusual", "the film is thin", *of_cases[:2]]
    estimate = "Pressure-viscosity coefficient: estimated by So and Klaus"
    assert estimate in page and "range of SAE grade 5W-30" in page
    with h5py.File(source, "a") as file:
        file["deck/values/lubricant.pressure_viscosity_coefficient_per_GPa"] = 22.0
        file["deck/values/lubricant.sae_grade"][...] = "none"
    page = page_of(read_result(source))
    assert estimate not in page and "SAE grade" not in page


@pytest.mark.usefixtures("no_figures")
def test_page_has_the_worst_case_of_a_remark_where_the_file_names_it(tmp_path):
    source = write_result(tmp_path / "nine.h5")
    with h5py.File(source, "a") as file:
        file.pop("run/warnings", None)
        file["run/warnings"] = ["", "lost for 2 %", "", "", "lost for 12 %", "lost for 7 %\nwide & far", "", "", "of the deck"]
        file["deck/remarks"] = ["of the deck"]
        group = file.create_group("run/remarks")
        group["worst"], group["worst_case"], group["cases"] = ["lost for 12 %", "wide & far", "of the deck"], [4, 5, 8], [3, 1, 1]
    assert re.findall(r"<li>(.*)</li>", page_of(read_result(source))) == [
        "of the deck", "3 of 9 cases, the worst is case 4 (speed 600 rev/min, oil temperature 60 °C): lost for 12 %",
        "case 5 (speed 600 rev/min, oil temperature 95 °C): wide &amp; far"]


@pytest.mark.usefixtures("no_figures")
def test_page_shows_the_point_and_the_values_given_beside_the_deck(tmp_path):
    source = write_result(tmp_path / "one.h5", speeds=(600.0,), oils=(60.0,), swept=())
    page = page_of(read_result(source))
    assert "<tr><th>speed [rev/min]</th><th>oil temperature [°C]</th>" in page and "<tr><td>600</td><td>60</td>" in page
    assert "beside the deck" not in page
    with h5py.File(source, "a") as file:
        file["deck/overrides"] = ["operating_point.speed_rpm=600", "case.title='a < b'"]
    page = page_of(read_result(source))
    assert "<p>Values given beside the deck, in the place of its own:</p>\n<pre>operating_point.speed_rpm=600\ncase.title=&#x27;a &lt; b&#x27;</pre>" in page


@pytest.mark.usefixtures("no_figures")
def test_defaults_are_those_that_something_uses_and_whole_numbers_have_no_point(tmp_path):
    source = write_result(tmp_path / "nine.h5")
    with h5py.File(source, "a") as file:
        for key, value, unit, given, used in (
                ("numerics.max_cycles", 40, "1", "default", "yes"), ("lift.exponents", 4.0, "1", "default", "yes"),
                ("film.accuracy", 1e-7, "1", "default", "yes"), ("numerics.step_deg", 0.1, "degree", "default", "no"),
                ("masses.valve_kg", 0.05, "kg", "given", "yes"), ("lift.exponents_2", 0.1 + 0.2, "mm", "default", None)):
            data = file.require_group("deck/values").create_dataset(key, data=value)
            data.attrs["units"], data.attrs["given"] = unit, given
            if used:  # files of older programs do not tell
                data.attrs["used"] = used
    page = page_of(read_result(source))
    rows = re.findall("<tr><td class=word>(.*?)</td><td class=word>(.*?)</td><td class=word>(.*?)</td></tr>", page.partition("taken by default")[2])
    assert rows == [("film.accuracy", "1e-07", ""), ("lift.exponents", "4", ""), ("lift.exponents_2", "0.3", "mm"), ("numerics.max_cycles", "40", "")]


@pytest.mark.usefixtures("no_figures")
def test_cases_that_a_partial_file_does_not_have_are_not_computed(tmp_path):
    source = write_result(tmp_path / "nine.h5")
    with h5py.File(source, "a") as file:
        file["summary/status"] = [0, 0, 0, 0, 0, 0, -1, -1, -1]
    page = page_of(read_result(source))
    assert "<p>3 of 9 cases were not computed.</p>" in page and "no result" not in page
    assert Layout([read_result(source)]).common_words() == ["3 of 9 cases were not computed"]
    with h5py.File(source, "a") as file:
        file["summary/status"][0], file["run/messages"] = 5, ["case 0: no film", *[""] * 8]
    page = page_of(read_result(source))
    assert "<p>3 of 9 cases were not computed, 1 of 9 cases have no result; the reasons are among the remarks.</p>" in page
    assert re.findall("<li>(.*)</li>", page) == ["case 0 has no result: no film"]


@pytest.mark.skipif(BROWSER is None, reason="no browser on this machine")
def test_a_browser_shows_every_figure(page):
    script = "<script>onload = () => document.title = [...document.images].filter(i => i.naturalWidth > 100).length + ' shown'</script>"
    looked = page.with_name("looked.html")
    looked.write_text(page.read_text(encoding="utf-8").replace("</body>", script + "</body>"), encoding="utf-8")
    result = subprocess.run([BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=5000", "--dump-dom",
                             looked.as_uri()], capture_output=True, text=True, timeout=120, check=False)
    figures = page.read_text(encoding="utf-8").count("<figure>")
    assert f"<title>{figures} shown</title>" in result.stdout


def test_page_shows_what_is_special_in_the_file_and_counts_missing_rows(page):
    text = page.read_text(encoding="utf-8")
    for name in ("running in", "train", "dampers", "turns"):
        assert f'<img alt="{name}"' in text
    assert "1 of 9 cases have no result; the reasons are among the remarks." in text
