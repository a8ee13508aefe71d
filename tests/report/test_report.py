"""The report of a case: it says what `solve` and `compare` say, holds all of itself, and never runs what somebody wrote."""

import base64
import json
import re
import tomllib
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

import stiction as st
from cases import STEEL_ON_STEEL
from report.page import Page
from stiction.cli import app
from stiction.quantities.errors import InputError
from stiction.records.sources import bibliography
from stiction.report import html_report
from stiction.report.html_report import as_html, case_as_html, write_report
from stiction.report.html_words import letters
from stiction.report.prediction_pictures import prediction_figure
from stiction.studies.report_data import collect_report_data

EXAMPLES = sorted((Path(__file__).parents[2] / "examples").glob("*.toml"))
# Without a working load nothing is compared: the quickest report there is.
SEVERAL = (
    STEEL_ON_STEEL.replace('"1 mm^2"', '["1 mm^2", "2 mm^2"]')
    + '[solve]\nmodel = "soft_coating_2015"\nload = ["0.1 N", "1 N"]\n'
)
OXIDISED = (
    re.sub("interfacial_shear_strength = .*", 'interface = "oxidised metal"', STEEL_ON_STEEL) + '[solve]\nload = ["1 N"]\n'
)
SCRIPT = "<script>alert(1)</script>"


@pytest.fixture(scope="module", params=EXAMPLES, ids=lambda path: path.stem)
def reported(request, tmp_path_factory):
    """An example whose model is named, what its report says as data, and its page."""
    folder = tmp_path_factory.mktemp("report")
    case, path = folder / request.param.name, folder / "report.html"
    case.write_text(named_model(request.param.read_text(encoding="utf-8")), encoding="utf-8")
    record = write_report(case, path)
    html = path.read_text(encoding="utf-8")
    return case, record, html, Page(html)


def named_model(text):
    """The case, by the model of its friction where it names none: of a prediction there is a test of its own."""
    if re.search(r"^model = ", text, re.MULTILINE) or "[indices]" in text:
        return text
    if "[contact.coating]" in text and "interface = " in text:
        return text.replace("[solve]\n", '[solve]\nmodel = "rough_on_film"\n')
    model = "greenwood_williamson_1966" if re.search("^interfac", text, re.MULTILINE) else "soft_coating_2015"
    return text.replace("[solve]\n", f'[solve]\nmodel = "{model}"\n')


def test_without_a_model_the_prediction_answers(tmp_path):
    """Headline, table and JSON have the median and interval that `predict` gives."""
    case = small(tmp_path, STEEL_ON_STEEL + '[solve]\nload = ["0.1 N", "1 N", "10 N"]\n')
    record = write_report(case, tmp_path / "report.html")
    found = st.predict(case, load="1 N")
    assert record["answer"]["friction_coefficient"] == pytest.approx(found.friction_coefficient.item(), rel=1e-9)
    text = " ".join(Page((tmp_path / "report.html").read_text(encoding="utf-8")).text.split())
    low, high = (
        f"{float(f'{found[name].item():.2g}'):g}" for name in ("friction_coefficient_low", "friction_coefficient_high")
    )
    assert f"90% interval {low} to {high}" in text and letters(found.attrs["regime"]) in text


@pytest.mark.parametrize(("ranges", "counted"), [("", "in"), ("[uncertainty]\nranges = false\n", "not in")])
def test_inputs_say_what_the_answer_counts_and_where_the_strength_comes_from(tmp_path, ranges, counted):
    """The ranges of materials are drawn unless the case says otherwise; the strength is that of the state that it names."""
    write_report(small(tmp_path, OXIDISED + ranges), tmp_path / "report.html")
    text = " ".join(Page((tmp_path / "report.html").read_text(encoding="utf-8")).text.split())
    ranged = re.findall(r", (not in|in) the interval of μ", text)
    assert ranged and set(ranged) == {counted}
    assert "interface oxidised metal the case" in text
    assert "the stated interface" in text and "interface.shear" not in text.split("Curves")[0]


def test_numbers_under_the_histogram_do_not_run_into_each_other(tmp_path):
    """Draws of mu over less than two decades: the labels of matplotlib's own small ticks would lie on each other."""
    figure = prediction_figure(st.predict(small(tmp_path, OXIDISED.replace("hardened_steel_52100", "copper", 1))))
    figure.canvas.draw()
    axis = figure.axes[0].xaxis
    assert not any(one.get_text() for one in axis.get_ticklabels(minor=True))
    boxes = sorted(one.get_window_extent().extents[[0, 2]].tolist() for one in axis.get_ticklabels() if one.get_text())
    assert len(boxes) >= 2 and all(one[1] < other[0] for one, other in pairwise(boxes))


def small(folder, text=SEVERAL, name="case.toml"):
    case = folder / name
    case.write_text(text, encoding="utf-8")
    return case


def check_form(html, page):
    """What holds for every page: it loads nothing, runs nothing, and is read by those who do not see it."""
    assert html.startswith("<!DOCTYPE html>")
    assert len(page.ids) == len(set(page.ids))
    assert not page.named("script", "link", "iframe", "object", "embed", "base", "form")
    for name, attributes in page.elements:
        assert not [one for one in attributes if one.startswith("on")], (name, attributes)
        assert attributes.get("src", "data:image/png;base64,").startswith("data:image/png;base64,")
        if href := attributes.get("href"):
            known = href.startswith("#") and href[1:] in page.ids
            assert known or href.startswith(("data:", "https://doi.org/")), href
            assert name == "a" or not href.startswith("https:"), (name, href)
    assert not re.search(r"@import|url\((?!#)", html)
    assert all(one.get("aria-label") for one in page.named("svg")) and all(one.get("alt") for one in page.named("img"))
    assert all(one.get("scope") in ("row", "col") for one in page.named("th"))
    levels = [int(name[1]) for name, _ in page.elements if re.fullmatch(r"h[1-6]", name)]
    assert levels[0] == 1 and levels.count(1) == 1
    assert all(later - earlier <= 1 for earlier, later in pairwise(levels))


def test_a_page_holds_all_of_itself(reported):
    _, _, html, page = reported
    check_form(html, page)
    assert page.named("svg") and "prefers-color-scheme: dark" in html and "@media print" in html
    assert "default-src 'none'" in page.named("meta")[1]["content"]


def test_it_says_what_solve_and_compare_say(reported):
    path, record, _, page = reported
    case = st.read_case(path)
    at = record["working_load"]
    here = st.solve(case.subject, load=at, **case.choice.arguments())
    mu = float(here["friction_coefficient"])
    assert record["friction_coefficient"] == pytest.approx(mu, rel=1e-12)
    assert f"μ {mu:.4g}" in page.text
    told = st.compare(case.subject, load=at)
    for name in told["model"].values[np.isfinite(told["friction_coefficient_at_load"].values)]:
        assert str(name) in page.text
    for word in (
        "Question.",
        record["question"],
        record["answer_in_words"],
        f"stiction {st.__version__}",
        f"numpy {np.__version__}",
    ):
        assert " ".join(word.split()) in page.text


def test_the_case_is_in_it_to_the_letter(reported):
    path, _, _, page = reported
    text = path.read_text(encoding="utf-8")
    assert " ".join(text.split()) in page.text
    saved = next(one["href"] for one in page.named("a") if one.get("download") == "case.toml")
    assert base64.b64decode(saved.partition("base64,")[2]).decode() == text


def test_sources_are_those_of_the_result(reported):
    path, record, _, page = reported
    case = st.read_case(path)
    data = st.solve_case(case)
    assert set(data.attrs["sources"].split()) <= set(record["sources"])
    # What is beyond them is named in the numbers of the materials.
    said = " ".join(map(str, (getattr(case.subject, "first", ""), getattr(case.subject, "coating", ""))))
    assert all(f"[{key}]" in said for key in set(record["sources"]) - set(data.attrs["sources"].split()))
    saved = next(one["href"] for one in page.named("a") if one.get("download") == "sources.bib")
    bibtex = base64.b64decode(saved.partition("base64,")[2]).decode()
    assert all(bibliography()[key] in bibtex for key in record["sources"])


def test_every_warning_is_beside_the_number(reported):
    path, record, _, page = reported
    validity_warnings = [one for one in record["validity_warnings"] if one.get("quantity")]
    case = st.read_case(path)
    here = st.solve(case.subject, load=record["working_load"], **case.choice.arguments())
    assert len(record["validity_warnings"]) == len(json.loads(here.attrs["validity_warnings"]))
    for one in validity_warnings:
        assert one["why"] in page.text


def test_what_is_uncertain_is_in_the_answer(reported):
    """The ends of the band at the working load, and mu with the digits that they leave; or that nothing is known of it."""
    path, record, _, page = reported
    case = st.read_case(path)
    if not case.uncertain:
        assert "No input of the case is uncertain" in page.text
        return
    alone = st.solve_case(replace(case, separation=None, load=np.array([record["working_load"]])))
    ends = alone["friction_coefficient_quantile"].values[[0, -1], 0]
    # From 0.08 to 0.32 half the width is 0.12: two places after the point.
    assert record["friction_coefficient_rounded"] == f"{record['friction_coefficient']:.2f}"
    assert f"the uncertain inputs give {ends[0]:.2g} to {ends[1]:.2g}" in page.text


def test_the_same_case_gives_the_same_page(tmp_path):
    case = st.read_case(small(tmp_path))
    assert case_as_html(case, SEVERAL) == case_as_html(case, SEVERAL)


def test_nothing_that_was_written_is_run(tmp_path):
    hostile = f"</title></pre>-->{SCRIPT}<img src=x onerror=alert(1)>$\\\\frac{{"
    text = SEVERAL.replace('first = "hardened_steel_52100"', 'first = "evil"', 1)
    own = f'[materials.evil]\npreset = "silver"\nname = "{hostile}"\nsource = "{hostile}"\n'
    text = f'title = "{hostile}"  # {SCRIPT}\n{text}\n{own}'
    text += 'hardness = "0.3 GPa"\n'
    case = small(tmp_path, text, "<b onclick=alert(1)>.toml")
    write_report(case, tmp_path / "report.html")
    html = (tmp_path / "report.html").read_text(encoding="utf-8")
    page = Page(html)
    check_form(html, page)
    assert page.text.count(SCRIPT) >= 4  # the title, the material, its source, the comment: all of them to be read
    assert not page.named("b") and str(tmp_path) not in html


def test_hostile_names_in_pictures(tmp_path):
    """Where numbers are several, a dimension that the user names is drawn."""
    text = SEVERAL.replace('["1 mm^2", "2 mm^2"]', '{ values = ["1 mm^2", "2 mm^2"], along = "x_script" }')
    write_report(small(tmp_path, text), tmp_path / "report.html")
    html = (tmp_path / "report.html").read_text(encoding="utf-8")
    check_form(html, Page(html))


def test_a_scan_is_told_with_what_was_done_to_it(tmp_path):
    waves = st.SelfAffine(hurst=0.8, rolloff=4e-6, shortest=1e-6, deviation=40e-9)
    scan = st.gaussian_surface((48, 48), (20e-6, 20e-6), waves, seed=5)
    np.save(tmp_path / "ground.npy", scan.heights)
    text = STEEL_ON_STEEL[: STEEL_ON_STEEL.index("[contact.roughness]")].replace('"1 mm^2"', '"400 um^2"')
    text += '[contact.roughness]\nfirst = { file = "ground.npy", size = "20 um", unit = "m" }\nlongest = "15 um"\n'
    case = small(tmp_path, text + '[solve]\nseparation = [3.5]\nmodel = "greenwood_williamson_1966"\ntangential = "none"\n')
    read = st.read_case(case)
    html = as_html(replace_without_comparison(collect_report_data(read, case.read_text())), "case.toml", "stiction report")
    page = Page(html)
    check_form(html, page)
    for words in ("ground.npy", "levelled: least-squares plane removed", "15 µm", "Measured surfaces", read.measured.method):
        assert words in page.text
    assert str(tmp_path) not in html
    assert len([one for one in page.named("svg", "img")]) >= 5  # map, spectrum and asperities among them


def replace_without_comparison(findings):
    """The same without all models, whose pictures other tests look at."""
    return replace(findings, comparison=None, not_compared="left out here")


def test_a_case_that_does_not_press_says_so(tmp_path):
    text = (
        STEEL_ON_STEEL.replace('"0.1 J/m^2"', '"1 J/m^2"').replace('"48 nm"', '"3 nm"')
        + '[solve]\nmodel = "soft_coating_2015"\nseparation = [4]\n'
    )
    record = write_report(small(tmp_path, text), tmp_path / "report.html")
    page = Page((tmp_path / "report.html").read_text(encoding="utf-8"))
    assert record["friction_coefficient"] is None and "no load is compressive" in record["answer_in_words"]
    assert "μ is not defined" in page.text and "Models are not compared: no load of the case is above 0" in page.text


def test_tables_and_cases_in_python(tmp_path):
    tables = tomllib.loads(SEVERAL)
    record = st.write_report(tables, tmp_path / "one.html")
    assert record["versions"]["stiction"] == st.__version__
    assert "asperity_radius" in Page((tmp_path / "one.html").read_text()).text
    html = case_as_html(st.read_case(small(tmp_path)), "")
    assert "has no file" in html


@pytest.mark.parametrize("name", ["report.toml", "report", "folder.html", "missing/../case.toml"])
def test_a_place_where_no_report_can_be(tmp_path, name):
    (tmp_path / "folder.html").mkdir()
    with pytest.raises(InputError, match=r"ends in \.html"):
        write_report(small(tmp_path), tmp_path / name)


def test_the_old_report_stays_until_the_new_one_is_finished(tmp_path, monkeypatch):
    case, out = small(tmp_path), tmp_path / "report.html"
    out.write_text("old")
    monkeypatch.setattr(html_report, "as_html", lambda *given: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        write_report(case, out)
    assert out.read_text() == "old" and sorted(one.name for one in tmp_path.iterdir()) == ["case.toml", "report.html"]
    monkeypatch.undo()
    write_report(case, out)
    assert out.read_text().startswith("<!DOCTYPE html>")
    assert sorted(one.name for one in tmp_path.iterdir()) == ["case.toml", "report.html"]


def test_the_command(tmp_path):
    case, out = small(tmp_path), tmp_path / "new" / "report.html"
    done = CliRunner().invoke(app, ["report", str(case), "--out", str(out), "--json"])
    assert done.exit_code == 0, done.output
    assert json.loads(done.stdout)["file"] == str(out) and out.exists()
    for words in (["--out", "x.txt"], [], ["--out", str(out), "--load", "1 N"], ["--out", str(out), "--load", "-1 N"]):
        bad = CliRunner().invoke(app, ["report", str(case), *words])
        assert bad.exit_code == 2 and bad.stderr.count("\n") == 1, (words, bad.output)


def test_that_a_case_is_read_is_shown_while_it_is(tmp_path):
    said = []

    def progress(text):
        said.append(text)
        return iter

    with pytest.raises(InputError):
        write_report({"contact": {"first": "hardened_steel_52100"}}, tmp_path / "report.html", progress=progress)
    assert said == ["Reading the case"]


def test_the_first_page_is_the_card_with_the_main_inputs_and_one_line_of_validity(tmp_path):
    """What is printed before the first page break: card, pictures, inputs, validity; a named model has its number as large."""
    case = small(tmp_path, OXIDISED.replace('"1 mm^2"', '"0.01 cm^2"'))
    write_report(case, tmp_path / "report.html")
    first, second, appendix = (tmp_path / "report.html").read_text(encoding="utf-8").split('<div class="page"></div>')
    assert 'class="card"' in first and first.count("<svg") == 3 and first.count('scope="row"') == 7
    assert "mu against load." in first and "Samples of mu" not in first  # though the case has one load
    assert first.count("0.01 cm²") == 2 and "1 mm²" not in first  # as the case states it, in the question and the inputs
    assert ">Next<" in first and first.count("Validity.</strong>") == 1
    assert "Why" in second and "Models compared" in second and "Inputs" in appendix and "Sources" in appendix
    named = small(tmp_path, OXIDISED + 'model = "greenwood_williamson_1966"\n', "named.toml")
    record = write_report(named, tmp_path / "named.html")
    page = (tmp_path / "named.html").read_text(encoding="utf-8")
    sizes = re.findall(r'<span style="font-size:2em[^>]*>(.*?)</span>', page)
    assert len(sizes) == 2 and record["friction_coefficient_rounded"] in sizes[0] and "by greenwood_williamson_1966" in page
    assert sizes[1] == f"μ = {st.predict(named, load='1 N').friction_coefficient.item():.2g}"


def test_a_pdf_where_a_browser_is(tmp_path, monkeypatch):
    case = small(tmp_path, OXIDISED)
    if html_report._browser():
        write_report(case, tmp_path / "report.pdf")
        assert (tmp_path / "report.pdf").read_bytes().startswith(b"%PDF-")
        assert sorted(path.name for path in tmp_path.iterdir()) == ["case.toml", "report.pdf"]
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr(html_report, "installed", lambda name: False)
    result = CliRunner().invoke(app, ["report", str(case), "--out", str(tmp_path / "none.pdf")])
    assert result.exit_code == 2 and result.stderr.count("\n") == 1 and "Chromium" in result.stderr


@pytest.mark.parametrize(("rough", "words"), [('rms_height = "0.2 um", ', "Sq and finish"), ("", "finish")])
def test_numbers_of_a_finish_are_told_as_drawn_from_it(tmp_path, rough, words):
    finished = re.sub(r"\[contact.roughness\]\n(\w+ = .*\n)+", f'roughness = {{ {rough}finish = "ground" }}\n', OXIDISED)
    write_report(small(tmp_path, finished), tmp_path / "report.html")
    text = " ".join(Page((tmp_path / "report.html").read_text(encoding="utf-8")).text.split())
    assert text.count(f"drawn from the stated {words} ") == 4
