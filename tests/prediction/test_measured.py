"""A prediction that knows measured friction, against the closed form of normal numbers."""

import math
import tomllib

import numpy as np
import pytest
from scipy.stats import norm, t
from typer.testing import CliRunner

import stiction as st
from refusals import refusal
from stiction.cli import app
from stiction.report.answer import answer_lines, confidence_in

SPREAD = math.log(2.5) / norm.ppf(0.95)  # of ln tau_0
CASE = """
[contact]
first = { youngs_modulus = "1000 GPa", poissons_ratio = 0.3, hardness = "0.1 GPa", material_class = "polymer" }
second = { youngs_modulus = "1000 GPa", poissons_ratio = 0.3, hardness = "100 GPa", material_class = "ceramic" }
nominal_area = "1 cm^2"
[contact.interface]
interfacial_shear_strength = "5 MPa"
range = { interfacial_shear_strength = ["2 MPa", "12.5 MPa"] }
[contact.roughness]
asperity_height_deviation = "0.2 um"
asperity_radius = "20 um"
asperity_density = "1e10 1/m^2"
[solve]
load = ["1 N", "3 N"]
"""


@pytest.fixture
def case(tmp_path):
    path = tmp_path / "case.toml"
    path.write_text(CASE, encoding="utf-8")
    return path


def series(folder, text):
    path = folder / "measured.csv"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize("error", [0.02, 0.2])
def test_normal_numbers_are_averaged_by_their_variances(error, case, tmp_path):
    """ln mu is normal about ln(5 MPa/100 MPa); a measured ln mu, normal too, draws it to itself by its share of precision."""
    data = series(tmp_path, f"load [N],friction_coefficient,friction_coefficient_error\n1,0.07,{0.07 * error}\n")
    found = st.predict(case, load="3 N", measured=data)
    precision = SPREAD**-2 + error**-2
    mean = (math.log(0.05) / SPREAD**2 + math.log(0.07) / error**2) / precision
    for end, score in (("_low", -1.645), ("", 0.0), ("_high", 1.645)):
        expected = math.exp(mean + score / math.sqrt(precision))
        assert found[f"friction_coefficient{end}"].item() == pytest.approx(expected, rel=0.02 + 0.1 * error)
    assert found.strength[0] == pytest.approx(found.friction_coefficient.item() * 1e8, rel=0.02)
    assert not found.warnings


def test_the_scatter_of_three_values_is_their_error(case, tmp_path):
    values = 0.06 * np.exp(np.array([-0.2, 0.0, 0.2]))
    rows = "\n".join(f"{load},{value}" for load, value in zip((1, 2, 3), values, strict=True))
    found = st.predict(case, load="1 N", measured=series(tmp_path, f"load [N],friction_coefficient\n{rows}\n"))
    precision = SPREAD**-2 + 3.0 / 0.2**2
    mean = (math.log(0.05) / SPREAD**2 + 3.0 * math.log(0.06) / 0.2**2) / precision
    assert found.friction_coefficient.item() == pytest.approx(math.exp(mean), rel=0.03)


def test_friction_beyond_what_the_contact_allows_is_said(case, tmp_path):
    found = st.predict(case, load="1 N", measured=series(tmp_path, "load [N],friction_coefficient\n1,3\n"))
    assert "contradicts the stated contact" in found.warnings[0] and confidence_in(found) == "low"


def test_one_draw_makes_no_interval(case, tmp_path):
    """Values that no line of draws meets: their errors are taken larger, and the interval keeps a width."""
    data = "load [N],friction_coefficient,friction_coefficient_error\n1,0.06,0.00001\n2,0.05,0.00001\n"
    found = st.predict(case, load="1 N", measured=series(tmp_path, data))
    assert found.friction_coefficient_high / found.friction_coefficient_low > 1.005
    assert any("contradicts" in text or "times larger" in text for text in found.warnings)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("load [N],contact_area [um^2]\n1,3\n", "solve.model"),
        ("load [N],friction_coefficient\n1,0\n", "above 0"),
        ("load [N],friction_coefficient,nominal_area [mm^2]\n1,0.1,2\n", "solve.model"),
    ],
)
def test_what_cannot_be_used_is_refused(text, said, case, tmp_path):
    result = CliRunner().invoke(app, ["fit", str(case), "--data", str(series(tmp_path, text))])
    assert result.exit_code == 2 and said in result.output and len(result.output.strip().splitlines()) == 1


def test_the_command_gives_the_strength_and_what_keeps_the_measurement(case, tmp_path):
    data = series(tmp_path, "load [N],friction_coefficient\n1,0.07\n2,0.07\n3,0.072\n")
    result = CliRunner().invoke(app, ["fit", str(case), "--data", str(data)], env={"COLUMNS": "120"})
    assert result.exit_code == 0 and len(result.stdout.splitlines()) <= 15
    said = " ".join(result.stdout.split())
    assert "3 values: interface strength" in said and "for other loads repeat this command with --load LOAD" in said


FREE = CASE.replace("[contact.interface]", "").replace("range = ", "# ") + "[fit.free]\n"
DATA = "load [N],friction_coefficient,friction_coefficient_error\n1,0.05,0.001\n2,0.05,0.001\n"


@pytest.mark.parametrize(
    ("free", "expected"),
    [  # all contacts are plastic: mu = tau_0/H, so that 0.05 is met by 5 MPa on 100 MPa
        ('interfacial_shear_strength = { low = "1 MPa", high = "50 MPa" }', 5e6),
        ('first.hardness = { low = "30 MPa", high = "300 MPa" }', 1e8),
    ],
)
@pytest.mark.usefixtures("no_pictures")
def test_free_numbers_are_found_where_no_model_is_named(free, expected, case, tmp_path):
    case.write_text(FREE + free + "\n", encoding="utf-8")
    data = series(tmp_path, DATA)
    found = st.fit(case, data).isel(parameter=0)
    assert found["low"] < expected < found["high"] and found["value"].item() == pytest.approx(expected, rel=0.02)
    assert found["high"] / found["low"] < 1.2
    result = CliRunner().invoke(app, ["fit", str(case), "--data", str(data), "--out", str(tmp_path / "out")])
    assert result.exit_code == 0 and len(result.stdout.splitlines()) <= 15, result.output
    assert "mu = 0.05 " in result.stdout
    again = st.predict(tmp_path / "out" / "fitted.toml", load="1 N")  # evenly between the ends that were found
    assert again.friction_coefficient.item() == pytest.approx(0.05, rel=0.03)


def test_a_number_that_the_data_do_not_tell_is_said(case, tmp_path):
    case.write_text(FREE + 'second.youngs_modulus = { low = "900 GPa", high = "1100 GPa" }\n', encoding="utf-8")
    found = st.fit(case, series(tmp_path, DATA))
    assert "second.youngs_modulus" in found.attrs["verdict"]


@pytest.mark.parametrize(
    ("table", "field"),
    [
        ('[fit]\nmodels = ["persson_2001"]\n[fit.free]\n', "fit.models"),
        ("[fit]\npredict = { nominal_area = '2 cm^2' }\n[fit.free]\n", "fit.predict"),
        (
            "[fit.free]\nfirst.hardness = { low = '30 MPa', high = '300 MPa', each_sample = true }\n",
            "fit.free.first.hardness.each_sample",
        ),
    ],
)
def test_what_a_fit_of_the_prediction_cannot_do_asks_for_a_model(table, field, case, tmp_path):
    free = "interfacial_shear_strength = { low = '1 MPa', high = '50 MPa' }\n"
    case.write_text(FREE.replace("[fit.free]\n", table) + free, encoding="utf-8")
    with refusal(field, "solve.model"):
        st.fit(case, series(tmp_path, DATA))


def test_a_named_model_without_free_numbers_is_refused(case, tmp_path):
    case.write_text(CASE + 'model = "greenwood_williamson_1966"\n', encoding="utf-8")
    with refusal("fit", "[fit.free]"):
        st.fit(case, series(tmp_path, DATA))


@pytest.mark.parametrize("slope", ["", "pressure_coefficient = 0.1"])
def test_the_answer_offers_no_line_that_loses_the_measurement(slope, tmp_path):
    """A case with the interval of the strength alone has no correlation with hardness and growth: mu is as wide as before."""
    path = tmp_path / "case.toml"
    path.write_text(CASE.replace("[contact.interface]", f"[contact.interface]\n{slope}"), encoding="utf-8")
    data = series(tmp_path, "load [N],friction_coefficient\n1,0.12\n")
    measured = dict(answer_lines(st.predict(path, load="1 N", measured=data)))["measured"]
    assert "interface strength" in measured and "low =" not in measured
    assert ("pressure coefficient 0.1" in measured) is bool(slope)


def test_the_answer_prints_the_fitted_pressure_coefficient(tmp_path):
    """The state alone gives 0.12 (0.05 to 0.28); a measured mu that is high raises it, and is nearly its upper end."""
    data = series(tmp_path, "load [N],friction_coefficient\n1,0.2\n")
    contact = {**tomllib.loads(CASE)["contact"], "interface": "boundary lubricant"}
    found = st.predict({"contact": contact, "solve": {"load": ["1 N"]}}, measured=data)
    middle, low, high = found.attrs["pressure_coefficient"]
    assert 0.12 < middle < high < 0.2 / 0.8 and low > 0.0
    assert f"pressure coefficient {middle:.2g} (" in dict(answer_lines(found))["measured"]


@pytest.mark.parametrize(("mu", "warns"), [(0.05, ""), (0.14, "outside the interval predicted"), (1.5, "contradicts")])
def test_a_measurement_beyond_the_prediction_is_said(mu, warns, tmp_path):
    """The prediction of this contact is tau_0/H = 0.05, 0.02 to 0.125, by the range of its strength."""
    path = tmp_path / "case.toml"
    path.write_text(CASE, encoding="utf-8")
    found = st.predict(path, load="1 N", measured=series(tmp_path, f"load [N],friction_coefficient\n1,{mu}\n"))
    said = [text for text in found.warnings if "measured friction" in text]
    assert len(said) == bool(warns) and all(warns in text for text in said)


@pytest.mark.parametrize(("load", "far"), [("1 N", False), ("3 N", False), ("40 N", True), ("20 mN", True)])
def test_a_load_far_from_the_measured_ones_is_said_and_not_sure(load, far, tmp_path):
    path = tmp_path / "case.toml"
    path.write_text(CASE, encoding="utf-8")
    data = series(tmp_path, "load [N],friction_coefficient\n1,0.12\n2,0.12\n2,0.121\n")
    found = st.predict(path, load=load, measured=data)
    assert any("far from the measured loads" in text for text in found.warnings) is far
    assert not far or confidence_in(found) != "high"


def test_a_fit_predicts_another_load_as_precisely_as_the_fitted_one(tmp_path):
    """The written case loses which strength goes with which hardness; the fit at another load does not."""
    contact = {
        "first": "gold_film", "second": "gold_film", "nominal_area": "25 um^2",
        "interfacial_shear_strength": {"low": "50 MPa", "high": "400 MPa", "spacing": "log"},
        "roughness": {"rms_height": "5 nm", "finish": "sputtered film"},
    }  # fmt: skip
    file = tmp_path / "relay.csv"
    file.write_text("load [uN],friction_coefficient,friction_coefficient_error\n100,0.37,0.03\n", encoding="utf-8")
    width = {}
    for load in ("100 uN", "1 mN"):
        answer = st.predict({"contact": contact, "solve": {"load": "100 uN"}}, load=load, measured=file)
        width[load] = float(answer.friction_coefficient_high / answer.friction_coefficient_low)
    ends = dict(zip(("low", "high"), (f"{float(answer[end][0])!r} Pa" for end in ("low", "high")), strict=True))
    pasted = contact | {"interfacial_shear_strength": {**ends, "spacing": "log"}}
    alone = st.predict({"contact": pasted, "solve": {"load": "1 mN"}})
    assert width["1 mN"] < 1.3 * width["100 uN"] < (alone.friction_coefficient_high / alone.friction_coefficient_low).item()


def with_strength(low, high):
    """The case with a range of strengths, evenly over its logarithm, in place of its interface."""
    stated = '[contact.interface]\ninterfacial_shear_strength = "5 MPa"\n'
    table = f'[contact.interfacial_shear_strength]\nlow = "{low}"\nhigh = "{high}"\nspacing = "log"\n'
    return CASE.replace(stated, table).replace("range = ", "# ")


@pytest.mark.parametrize(("errors", "quantile"), [("", t(2).ppf(0.95)), (",0.0032", norm.ppf(0.95))])
def test_an_error_from_few_values_is_that_of_student(errors, quantile, case, tmp_path):
    """The strength is nearly free, so that mu is the mean of the values, give or take its own error."""
    head = "load [N],friction_coefficient" + (",friction_coefficient_error" if errors else "")
    mu = np.array([0.0468, 0.05, 0.0532])
    data = series(tmp_path, "\n".join([head, *(f"1,{value}{errors}" for value in mu)]))
    case.write_text(with_strength("1 MPa", "20 MPa"), encoding="utf-8")
    found = st.fit(case, data)
    error = 0.0032 / 0.05 if errors else np.std(np.log(mu), ddof=1)
    point = found.isel(load=0)
    half = 0.5 * math.log(point.friction_coefficient_high.item() / point.friction_coefficient_low.item())
    assert half == pytest.approx(quantile * error / math.sqrt(3.0), rel=0.06)


def test_a_strength_beyond_that_of_the_body_is_bound_from_below_only(case, tmp_path):
    """The body shears at H/(2.8 sqrt(3)): what is stated beyond it changes nothing, and is not printed as if measured."""
    case.write_text(with_strength("1 MPa", "20 GPa"), encoding="utf-8")
    found = st.fit(case, series(tmp_path, "load [N],friction_coefficient\n1,0.2\n1,0.21\n1,0.19\n"))
    assert "bound interfacial_shear_strength only from below" in found.attrs["verdict"]
    assert found["high"].item() < 1.1 * 1e8 / (2.8 * math.sqrt(3.0))


def test_a_measurement_updates_a_height_beside_a_finish(case, tmp_path):
    """The height is sampled as a part of the surface, and is no parameter of its own."""
    rough = 'asperity_height_deviation = "0.2 um"\nasperity_radius = "20 um"\nasperity_density = "1e10 1/m^2"\n'
    case.write_text(CASE.replace(rough, 'finish = "ground"\nrms_height = "0.2 +/- 0.05 um"\n'), encoding="utf-8")
    found = st.fit(case, series(tmp_path, DATA))
    assert "parameter" not in found.dims and found.friction_coefficient.isel(load=0).item() == pytest.approx(0.05, rel=0.05)
