"""The line that names the model: terminal, CSV, report and page name every law that answered, in the same words."""

import re
import tomllib

import pytest
from typer.testing import CliRunner

from cases import SILICON_CASE
from report.page import Page
from stiction.cli import app
from stiction.web.query import Query, remarks, solved

CASE = (
    SILICON_CASE
    + """
hold_time = "100 s"
ageing_rate = 0.02
reference_time = "1 s"
strength_variation = 0.5
[contact.liquid]
relative_humidity = 0.6
contact_angle_first = "10 deg"
contact_angle_second = "10 deg"
temperature = "20 degC"
[solve]
load = "1 mN"
model = "greenwood_williamson_1966"
presliding = "mindlin_1949"
"""
)
LAWS = {
    "asperity": "hertz",
    "tangential": "bowden_tabor_1943",
    "ageing": "berthoud_1999",
    "contamination": "independent_junctions",
    "meniscus": "equilibrium_meniscus",
    "presliding": "mindlin_1949",
}
LINE = ", ".join(["greenwood_williamson_1966", *(f"{kind} law {key}" for kind, key in LAWS.items())])


@pytest.fixture(scope="module")
def said(tmp_path_factory):
    """What each place says of the same case, each as one line of text."""
    folder = tmp_path_factory.mktemp("case")
    case = folder / "case.toml"
    case.write_text(CASE, encoding="utf-8")
    ran = CliRunner().invoke(app, ["run", str(case), "--out", str(folder / "out")])
    assert ran.exit_code == 0, ran.output
    reported = CliRunner().invoke(app, ["report", str(case), "--out", str(folder / "report.html")])
    assert reported.exit_code == 0, reported.output
    texts = {
        "terminal": ran.output,
        "csv": (folder / "out" / "curve.csv").read_text(encoding="utf-8"),
        "report": Page((folder / "report.html").read_text(encoding="utf-8")).text,
        "page": "\n".join(remarks(solved(Query(tomllib.loads(CASE), folder)))),
    }
    return {place: " ".join(text.split()) for place, text in texts.items()}


@pytest.mark.parametrize("place", ["terminal", "csv", "report", "page"])
def test_every_law_is_named(said, place):
    assert LINE in said[place]


def test_a_prediction_names_the_laws_of_what_is_stated_beside_the_area(tmp_path):
    case = tmp_path / "case.toml"
    case.write_text(re.sub("hold_time.*\n|ageing_rate.*\n|reference_time.*\n|model = .*\n|presliding.*\n", "", CASE))
    out, page = str(tmp_path / "out"), tmp_path / "report.html"
    said = [CliRunner().invoke(app, ["run", str(case), "--out", out, "--details"]).output]
    CliRunner().invoke(app, ["report", str(case), "--out", str(page)])
    said += [(tmp_path / "out" / "curve.csv").read_text(encoding="utf-8"), Page(page.read_text(encoding="utf-8")).text]
    for text in said:
        assert "; meniscus law equilibrium_meniscus; contamination law independent_junctions" in " ".join(text.split())
