"""Numbers read back from terminal, CSV, HTML and written cases: each is that of a closed form, in every study.

Persson (2001) without adhesion: mu = tau_0 A_n erf(sqrt(2) p/(E* h'))/P, of the summits h'^2 = sqrt(3)/(64 N R^2).
"""

import csv
import math
import tomllib

import numpy as np
import pytest
from scipy.stats import norm
from typer.testing import CliRunner

from report.page import Page
from stiction.cli import app

STRENGTH, AREA, LOADS = 200e6, 1e-6, (0.5, 2.0)
_MODULUS = 210e9 / (2.0 * (1.0 - 0.3**2))
_SLOPE = math.sqrt(math.sqrt(3.0) / (64.0 * 1.7e10 * 50e-6**2))
BODY = '{ youngs_modulus = "210 GPa", poissons_ratio = 0.3, hardness = "7.3 GPa" }'
CASE = f"""
[contact]
first = {BODY}
second = {BODY}
nominal_area = "1 mm^2"
interfacial_shear_strength = "200 +/- 20 MPa"
[contact.roughness]
asperity_height_deviation = "48 nm"
asperity_radius = "50 um"
asperity_density = "1.7e10 1/m^2"
[solve]
load = ["0.5 N", "2 N"]
model = "persson_2001"
[uncertainty]
count = 256
"""


def area(load):
    return AREA * math.erf(math.sqrt(2.0) * load / AREA / (_MODULUS * _SLOPE))


def mu(load, strength=STRENGTH):
    return strength * area(load) / load


@pytest.fixture
def run(tmp_path, no_pictures):
    """Run a command on the case with more text, and return what it prints, each line in words, and its folder."""
    (tmp_path / "case.toml").write_text(CASE, encoding="utf-8")

    def called(command, *options, more="", case=CASE):
        (tmp_path / "case.toml").write_text(case + more, encoding="utf-8")
        done = CliRunner().invoke(app, [command, str(tmp_path / "case.toml"), "--out", str(tmp_path / "out"), *options])
        assert done.exit_code == 0, done.output
        return [line.split() for line in done.output.splitlines()], tmp_path / "out"

    return called


def table(path):
    lines = [line for line in path.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    return list(csv.DictReader(lines))


def test_run(run):
    lines, out = run("run")
    for load, row in zip(LOADS, table(out / "curve.csv"), strict=True):
        printed = next(line for line in lines if len(line) == 4 and line[0] == f"{load:g}")
        exact = [load, 1e12 * area(load), 1e3 * mu(load) * load, mu(load)]  # N, um^2, mN
        np.testing.assert_allclose([float(word) for word in printed], exact, rtol=5.1e-4)
        read = [float(row[name]) for name in ("load [N]", "contact_area [m^2]", "friction_force [N]", "friction_coefficient")]
        np.testing.assert_allclose(read, [load, area(load), mu(load) * load, mu(load)], rtol=1e-9)
        for share in (5, 25, 50, 75, 95):
            quantile = mu(load) * (1.0 + 0.1 * norm.ppf(share / 100.0))
            assert float(row[f"friction_coefficient_q{share:02d}"]) == pytest.approx(quantile, rel=0.03)


def test_compare(run):
    lines, out = run("compare", "--all", "--load", "2 N")
    printed = next(line for line in lines if line[:1] == ["persson_2001"])
    assert float(printed[1]) == pytest.approx(mu(2.0), rel=0.05)
    (row,) = [row for row in table(out / "compare_at_load.csv") if row["model"] == "persson_2001"]
    assert float(row["friction_coefficient"]) == pytest.approx(mu(2.0), rel=1e-9)
    curve = [row for row in table(out / "compare.csv") if row["model"] == "persson_2001"]
    pressed = [row for row in curve if math.isfinite(float(row["load [N]"])) and float(row["load [N]"]) > 0.0]
    assert pressed
    for row in pressed:
        assert float(row["friction_coefficient"]) == pytest.approx(mu(float(row["load [N]"])), rel=1e-9)


def test_sensitivity(run):
    """The friction goes with the strength, and falls with the root of either modulus; the area knows no strength."""
    lines, out = run("sensitivity")
    rows = {(float(row["load [N]"]), row["number"]): row for row in table(out / "log_sensitivities.csv")}
    words = {
        "interfacial_shear_strength": "interfacial shear strength",
        "first.youngs_modulus": "Young's modulus of first body",
    }
    for name, of_mu, of_area in (("interfacial_shear_strength", 1.0, 0.0), ("first.youngs_modulus", -0.5, -0.5)):
        printed = next(line for line in lines if line[:-2] == words[name].split() and "%" not in line[-1])
        assert [float(word) for word in printed[-2:]] == pytest.approx([of_mu, of_area], abs=1e-3)
        for load in LOADS:
            read = [float(rows[load, name][f"{one}_log_sensitivity"]) for one in ("friction_coefficient", "contact_area")]
            assert read == pytest.approx([of_mu, of_area], abs=1e-5)


def test_design(run):
    case = CASE.replace("200 +/- 20 MPa", "200 MPa").replace('["0.5 N", "2 N"]', '"2 N"')
    more = """
[design]
objective = { target = "friction_coefficient", value = 0.05 }
validity = "any"
[design.choose]
interfacial_shear_strength = { low = "20 MPa", high = "1 GPa" }
"""
    lines, out = run("design", more=more, case=case)
    strength = 0.05 * 2.0 / area(2.0)
    printed = next(line for line in lines if line[-1:] == ["met"])
    assert printed[1] == "MPa" and float(printed[0]) == pytest.approx(1e-6 * strength, rel=5.1e-4)
    assert float(printed[2]) == pytest.approx(0.05, rel=5.1e-4)
    (row,) = table(out / "design.csv")
    assert float(row["interfacial_shear_strength [Pa]"]) == pytest.approx(strength, rel=1e-6)
    written = tomllib.loads((out / "designed.toml").read_text(encoding="utf-8"))["contact"]["interfacial_shear_strength"]
    assert written.endswith(" Pa") and float(written.split()[0]) == pytest.approx(strength, rel=1e-6)


def test_fit(run, tmp_path):
    loads = np.geomspace(0.1, 10.0, 6)
    rows = "\n".join(f"{load:.17g},{mu(load, 123.4e6):.17g},1e-4" for load in loads)
    data = tmp_path / "mu.csv"
    data.write_text(f"load [N],friction_coefficient,friction_coefficient_error\n{rows}\n", encoding="utf-8")
    free = '[fit.free]\ninterfacial_shear_strength = { low = "20 MPa", high = "1 GPa" }\n'
    lines, out = run("fit", "--data", str(data), more=free, case=CASE.replace("200 +/- 20 MPa", "200 MPa"))
    printed = next(line for line in lines if line[:1] == ["interfacial_shear_strength"])
    # chi^2 rises by 3.84 where the strength is 1.96 of its standard errors off
    spread = 1.96 * 1e-4 / math.sqrt(sum(mu(load, 1.0) ** 2 for load in loads))
    assert [float(printed[at]) for at in (1, 3, 5)] == pytest.approx(
        [123.4, *(123.4 + 1e-6 * np.array([-1, 1]) * spread)], rel=1e-3
    )
    (row,) = table(out / "parameters.csv")
    assert any(float(word) == pytest.approx(123.4e6, rel=1e-5) for word in row.values() if word.replace(".", "").isdigit())
    written = tomllib.loads((out / "fitted.toml").read_text(encoding="utf-8"))["contact"]["interfacial_shear_strength"]
    assert float(written.split()[0]) == pytest.approx(123.4e6, rel=1e-5)


def test_report(tmp_path):
    (tmp_path / "case.toml").write_text(CASE, encoding="utf-8")
    done = CliRunner().invoke(app, ["report", str(tmp_path / "case.toml"), "--out", str(tmp_path / "r.html"), "--load", "2 N"])
    assert done.exit_code == 0, done.output
    text = Page((tmp_path / "r.html").read_text(encoding="utf-8")).text
    for shown in (f"μ {mu(2.0):.4g}", f"{1e12 * area(2.0):.4g} µm²", f"{1e3 * 2.0 * mu(2.0):.4g} mN"):
        assert shown in text, shown
