"""Sensitivity of a case: exact exponents of power laws, exact indices of their logarithms, and elasticities of sums that are
made here from the formulas alone."""

import json
import math

import numpy as np
import pytest
import scipy.stats
from scipy.integrate import quad
from scipy.optimize import brentq
from test_bands import ADHESIVE, POWER_LAW, SOLVE, TEXT, case
from typer.testing import CliRunner

import stiction as st
from collisions import collisions
from stiction import cli
from stiction.quantities.errors import InputError
from stiction.report import view
from stiction.report.sensitivity_pictures import sensitivity_figure
from stiction.report.table import Table
from stiction.report.view import in_short
from stiction.report.views.sensitivity import indices_table, log_sensitivities_table, sensitivity_view
from stiction.studies.case_results import solve_case

S_TAU, S_R = np.log(2.0), 0.5 * np.log(1.5)  # deviations of ln mu by its two inputs


@pytest.fixture(scope="module")
def of_power_law():
    with np.errstate(all="raise", under="ignore"):
        return st.sensitivity({"contact": POWER_LAW, "solve": SOLVE}, models=[])


def test_a_power_law_has_its_exact_exponents(of_power_law):
    """mu is tau_0 R^(1/2) E*^(-1) sigma^(-1/2) Gamma(2)/Gamma(5/2) ...; 1/E* is the sum of two terms that are alike."""
    nu = 2.0 * 0.3**2 / (1.0 - 0.3**2)  # -d ln(1 - nu^2)/d ln nu
    exact = {
        "interfacial_shear_strength": 1.0, "asperity_radius": 0.5, "asperity_height_deviation": -0.5, "asperity_density": 0.0,
        "nominal_area": 0.0, "first.youngs_modulus": -0.5, "second.youngs_modulus": -0.5, "first.poissons_ratio": -0.5 * nu,
        "second.poissons_ratio": -0.5 * nu, "first.hardness": 0.0, "second.hardness": 0.0,
    }  # fmt: skip
    assert set(of_power_law["number"].values) == set(exact)
    for name, exponent in exact.items():
        found = of_power_law.sel(number=name)
        np.testing.assert_allclose(found["friction_coefficient_log_sensitivity"], exponent, atol=2e-8)
        area = exponent - (name == "interfacial_shear_strength")
        np.testing.assert_allclose(found["contact_area_log_sensitivity"], area, atol=2e-8)


def test_indices_of_a_power_law_are_the_shares_of_its_variance(of_power_law):
    exact = np.array([S_TAU**2, S_R**2]) / (S_TAU**2 + S_R**2)
    assert of_power_law["input"].values.tolist() == ["interfacial_shear_strength", "asperity_radius"]
    for order in ("first", "total"):
        found = of_power_law[f"friction_coefficient_{order}_order"].values
        np.testing.assert_allclose(found, np.stack([exact, exact], axis=1), atol=0.03)
        low, high = (of_power_law[f"friction_coefficient_{order}_order_{end}"].values for end in ("low", "high"))
        np.testing.assert_allclose((low + high) / 2.0, found)
        assert np.all(np.abs(found - exact[:, None]) < high - low) and np.all(high - low < 0.05)
    np.testing.assert_allclose(of_power_law["contact_area_total_order"].values[:, 0], [0.0, 1.0], atol=0.01)


def test_effects_of_a_power_law_are_those_of_its_quantiles(of_power_law):
    """ln mu is a sum: every step from one level to the one two thirds further is the same, and does not depend on the other."""
    step = scipy.stats.norm.ppf(0.025 + 0.95 * 2.0 / 3.0) - scipy.stats.norm.ppf(0.025)
    found = of_power_law["friction_coefficient_effect"].values[:, 0]
    np.testing.assert_allclose(found, np.array([S_TAU, S_R]) * step / (2.0 / 3.0), rtol=1e-9)
    np.testing.assert_allclose(of_power_law["friction_coefficient_effect_deviation"], 0.0, atol=1e-9)


def gaussian_sums(h):
    """Greenwood & Williamson 1966, eqs 5 and 6 with Gaussian heights: integrals of (z - h)^(3/2) and (z - h)."""
    density = lambda z: math.exp(-0.5 * z * z) / math.sqrt(2.0 * math.pi)  # noqa: E731
    return [quad(lambda z, n=n: (z - h) ** n * density(z), h, h + 12.0, epsabs=0.0, epsrel=1e-12)[0] for n in (1.5, 1.0)]


def independent_mu(values, load=1.0):
    """The friction coefficient of elastic spheres of an interface of constant strength, from the formulas alone."""
    e_star = 1.0 / sum((1.0 - values[f"nu{i}"] ** 2) / values[f"E{i}"] for i in (1, 2))
    count = values["N"] * values["A"]
    per_load = count * 4.0 / 3.0 * e_star * values["R"] ** 0.5 * values["sigma"] ** 1.5
    h = brentq(lambda h: math.log(per_load * gaussian_sums(h)[0] / load), -1.0, 7.0, xtol=1e-13, rtol=1e-14)
    return values["tau"] * count * math.pi * values["R"] * values["sigma"] * gaussian_sums(h)[1] / load


def test_elasticities_are_central_differences_of_an_independent_evaluation():
    rough = {"asperity_height_deviation": "50 nm", "asperity_radius": "50 um", "asperity_density": "1.6e10 1/m^2"}
    second = {"youngs_modulus": "80 GPa", "poissons_ratio": 0.2, "hardness": "100 GPa"}
    contact = {**POWER_LAW, "second": second, "roughness": rough, "interfacial_shear_strength": "20 MPa"}
    data = st.sensitivity({"contact": contact, "solve": {**SOLVE, "load": "1 N"}}).isel(load=0)
    names = {"tau": "interfacial_shear_strength", "R": "asperity_radius", "sigma": "asperity_height_deviation",
             "N": "asperity_density", "A": "nominal_area", "E1": "first.youngs_modulus", "E2": "second.youngs_modulus",
             "nu1": "first.poissons_ratio", "nu2": "second.poissons_ratio"}  # fmt: skip
    nominal = {"tau": 20e6, "R": 50e-6, "sigma": 50e-9, "N": 1.6e10, "A": 1e-6, "E1": 200e9, "E2": 80e9, "nu1": 0.3, "nu2": 0.2}
    assert float(data["friction_coefficient"]) == pytest.approx(independent_mu(nominal), rel=1e-9)
    for key, name in names.items():
        up, down = (independent_mu(nominal | {key: nominal[key] * math.exp(step)}) for step in (1e-3, -1e-3))
        found = data.sel(number=name)
        assert float(found["friction_coefficient_log_sensitivity"]) == pytest.approx(math.log(up / down) / 2e-3, abs=1e-6), name
        assert float(found["friction_coefficient_log_sensitivity_error"]) < 1e-4


def test_without_anything_uncertain_there_are_elasticities_only():
    data = st.sensitivity(case({"interfacial_shear_strength": "20 MPa", "roughness": ADHESIVE["roughness"]}))
    assert "input" not in data.dims and "friction_coefficient_log_sensitivity" in data
    assert len(sensitivity_figure(data).axes) == 1


def test_the_model_is_an_input():
    """ln mu is ln tau_0 and a number of each model: the variance of the model is that of two numbers as likely."""
    rough = {"asperity_height_deviation": "50 nm", "asperity_radius": "50 um", "asperity_density": "1.6e10 1/m^2"}
    factor = {"median": "20 MPa", "factor": 1.1}
    contact = {**POWER_LAW, "roughness": rough, "interfacial_shear_strength": factor}
    content = {"contact": contact, "solve": {"load": "1 N", "model": "greenwood_williamson_1966"}}
    names = ["greenwood_williamson_1966", "persson_2001"]
    data = st.sensitivity(content, models=names).isel(load=0)
    one, other = (
        float(solve_case(case({"roughness": rough, "interfacial_shear_strength": "20 MPa"}, {"load": "1 N", "model": name}))[
            "friction_coefficient"
        ][0]) for name in names
    )  # fmt: skip
    of_model, of_tau = (0.5 * math.log(one / other)) ** 2, math.log(1.1) ** 2
    assert data["input"].values.tolist() == ["interfacial_shear_strength", "model"]
    found = data["friction_coefficient_total_order"].values
    np.testing.assert_allclose(found, np.array([of_tau, of_model]) / (of_tau + of_model), atol=0.02)
    assert json.loads(data.attrs["models"]) == {name: 0.5 for name in names}


def test_the_way_of_finding_asperities_is_an_input(tmp_path):
    spectrum = st.SelfAffine(hurst=0.8, rolloff=10e-6, shortest=1e-6, deviation=8e-9)
    made = st.gaussian_surface((128, 128), (40e-6, 40e-6), spectrum, seed=1)
    np.save(tmp_path / "scan.npy", made.heights)
    scan = {"file": str(tmp_path / "scan.npy"), "size": "40 um", "unit": "m"}
    contact = {**POWER_LAW, "roughness": {"first": scan}, "interfacial_shear_strength": {"median": "20 MPa", "factor": 1.2}}
    content = {"contact": contact, "solve": {**SOLVE, "load": "1 N"}}
    data = st.sensitivity(content, models=[]).isel(load=0)
    assert data["input"].values.tolist() == ["interfacial_shear_strength", "asperity_method"]
    plain = case({**contact, "interfacial_shear_strength": "20 MPa"}, {"load": "1 N"})
    each = np.log(solve_case(plain)["friction_coefficient_by_method"].values[:, 0])
    variance = np.array([math.log(1.2) ** 2, each.var()])
    np.testing.assert_allclose(data["friction_coefficient_total_order"], variance / variance.sum(), atol=0.03)
    assert "asperity_radius" not in data["number"].values  # it was measured


def test_pictures_and_tables_rank_what_matters(of_power_law):
    table = indices_table(of_power_law)
    assert [row[0] for row in table.rows] == ["interfacial shear strength", "asperity radius"]
    assert table.rows[0][1] == f"{float(of_power_law['friction_coefficient_total_order'][0, 0]):.2f}"
    assert log_sensitivities_table(of_power_law).rows[0][1] == "+1"
    indices, over_load, screening, slopes = sensitivity_figure(of_power_law).axes
    assert [text.get_text() for text in indices.get_yticklabels()] == ["interfacial shear strength", "asperity radius"]
    assert screening.get_xlabel() == r"mean size of the effect on ln $\mu$"
    widths = sorted(patch.get_width() for patch in indices.patches[:2])
    assert widths == pytest.approx(sorted(of_power_law["friction_coefficient_total_order"].values[:, 0]))
    assert len(over_load.lines) == 2 and len(screening.texts) == 2 and slopes.patches[0].get_width() == pytest.approx(1.0)


def test_a_picture_of_one_load_has_no_empty_quarter_and_no_text_on_another(of_power_law):
    for data, panels in ((of_power_law, 4), (of_power_law.isel(load=[0]), 3)):
        with np.errstate(all="ignore"):
            figure = sensitivity_figure(data)
            assert collisions(figure) == []
        assert len(figure.axes) == panels and all(axes.has_data() for axes in figure.axes)
    indices, screening, slopes = figure.axes
    assert indices.get_position().width > 1.5 * screening.get_position().width and slopes.get_position().x0 > 0.4


def test_at_most_nine_loads_are_asked_with_the_working_load():
    loads = {"start": "1 mN", "stop": "10 N", "count": 30, "spacing": "log"}
    data = st.sensitivity({"contact": POWER_LAW, "solve": {**SOLVE, "load": loads}, "uncertainty": {"count": 64}}, models=[])
    assert data.sizes["load"] == 9 and data.attrs["working_load"] in data["load"].values


def test_separations_tell_of_the_load():
    solve = {"separation": [1.0, 2.0], "model": SOLVE["model"]}
    data = st.sensitivity({"contact": POWER_LAW, "solve": solve, "uncertainty": {"count": 64}}, models=[])
    found = data["load_log_sensitivity"].sel(number=["asperity_radius", "asperity_height_deviation", "asperity_density"])
    np.testing.assert_allclose(found, [[0.5] * 2, [1.5] * 2, [1.0] * 2], atol=1e-8)


@pytest.mark.parametrize(
    ("changes", "given", "message"),
    [
        (
            {"nominal_area": ["1 mm^2", "2 mm^2"]},
            {},
            "nominal_area: 2 numbers, 1 mm^2 to 2 mm^2; allowed: one number, or an uncertain one",
        ),
        ({}, {"models": ["nothing"]}, "model: 'nothing'; allowed: "),
        ({}, {"models": "persson_2001"}, "models: 'persson_2001'; allowed: a list of names"),
        ({}, {"load": "-1 N"}, "load"),
        ({}, {"progress": 3}, "progress: 3; allowed: a function"),
    ],
)
def test_what_is_wrong_is_one_line(changes, given, message):
    with pytest.raises(InputError) as error:
        st.sensitivity(case(changes), **given)
    assert message in str(error.value) and "\n" not in str(error.value)


def test_the_command_writes_its_files_and_json(tmp_path):
    path = tmp_path / "case.toml"
    path.write_text(TEXT, encoding="utf-8")
    words = ["sensitivity", str(path), "--models", "none", "--out", str(tmp_path / "out")]
    result = CliRunner().invoke(cli.app, words)
    assert result.exit_code == 0, (result.output, result.exception)
    assert "interfacial shear strength" in result.stdout and "input raised by 1 %" in result.stdout
    names = {"sensitivity.csv", "log_sensitivities.csv", "sensitivity.nc", "sensitivity.png"}
    assert {one.name for one in (tmp_path / "out").iterdir()} == names
    found = json.loads(CliRunner().invoke(cli.app, [*words[:4], "--json"]).stdout)
    assert found["variables"]["friction_coefficient_total_order"]["dims"] == ["input", "load"]
    refused = CliRunner().invoke(cli.app, ["sensitivity", str(path), "--models", "nothing"])
    assert refused.exit_code == 2 and refused.stderr.startswith("stiction: model: 'nothing'; allowed: ")


def test_the_error_of_an_elasticity_is_what_the_extrapolation_changes():
    """ln y = 2 s + 7 s^3, s = ln x: the narrower difference is off by 7 (width/2)^2, the extrapolated one by nothing."""
    from stiction.studies.sensitivity.log_sensitivities import _STENCIL, _WIDTH, _slopes

    y = np.exp(2.0 * _STENCIL + 7.0 * _STENCIL**3)
    slope, error = _slopes(y, 1)
    np.testing.assert_allclose([slope[0], error[0]], [2.0, 7.0 * (0.5 * _WIDTH) ** 2], rtol=1e-9)


def test_numbers_are_those_that_were_given():
    from stiction.case.read import parse_case
    from stiction.studies.sensitivity.log_sensitivities import numbers_of

    assert set(numbers_of(parse_case({"indices": {"theta": 40, "lam": 10}, "solve": {"load": [0.01]}}))) == {"theta", "lam"}
    of_presets = numbers_of(parse_case({"contact": {**ADHESIVE, "first": "silver", "second": "gold"}, "solve": SOLVE}))
    assert not [name for name in of_presets if "surface_energy" in name]  # a contact has its work of adhesion


def test_more_points_are_more_trajectories(monkeypatch):
    from stiction.studies.sensitivity import run as sensitivity

    asked, drawn = [], sensitivity.trajectories
    monkeypatch.setattr(sensitivity, "trajectories", lambda *given: asked.append(given) or drawn(*given))
    for count in (64, 256):
        st.sensitivity({"contact": POWER_LAW, "solve": SOLVE, "uncertainty": {"count": count}}, models=[])
    assert [given[1] for given in asked] == [8, 16]


def test_every_method_with_every_model_is_drawn_as_often():
    from stiction.studies.sensitivity.run import METHOD_INPUT, MODEL_INPUT, _Variation

    variation = _Variation(["x"], ["first", "second"], ["a", "b", "c"], [])
    assert variation.inputs == ["x", METHOD_INPUT, MODEL_INPUT]
    shares = np.array([[0.9, method, model] for method in (0.0, 0.49, 0.51, 0.999) for model in (0.1, 0.49, 0.51, 0.79, 0.81)])
    wanted = [3 * method + model for method in (0, 0, 1, 1) for model in (0, 1, 1, 2, 2)]
    assert variation.rows(shares).tolist() == wanted


@pytest.mark.parametrize("at", [0, 4, 17, 29, 30])
def test_the_working_load_is_among_the_nine(at):
    from dataclasses import dataclass

    from stiction.studies.sensitivity.run import _at_few_loads

    @dataclass
    class Loads:
        load: np.ndarray

    loads = np.geomspace(0.1, 100.0, 31)
    kept = _at_few_loads(Loads(loads), loads[at]).load
    assert kept.size == 9 and loads[at] in kept and (np.diff(kept) > 0.0).all()
    assert len(set(kept) & set(loads[[0, 4, 8, 11, 15, 19, 22, 26, 30]])) >= 8


STEEL = {"youngs_modulus": "210 GPa", "poissons_ratio": 0.3, "hardness": "7 GPa", "material_class": "metal"}
ROUGH = {"asperity_height_deviation": "48 nm", "asperity_radius": "50 um", "asperity_density": "1.7e10 1/m^2"}


def predicted_case(strength="200 MPa", radius="50 um"):
    contact = {"first": STEEL, "second": STEEL, "nominal_area": "1 mm^2", "interfacial_shear_strength": strength}
    rough = ROUGH | {"asperity_radius": radius}
    return {"title": "Two bodies", "contact": contact | {"roughness": rough}, "solve": {"load": "1 N"}}


def test_elasticities_of_a_prediction_are_differences_of_predictions():
    """Mu goes with the strength that is stated, and with the radius as two predictions beside it say."""
    data = st.sensitivity(predicted_case())
    found = data["friction_coefficient_log_sensitivity"]
    assert float(found.sel(number="interfacial_shear_strength")) == pytest.approx(1.0, abs=1e-6)
    ends = [st.predict(predicted_case(radius=f"{50.0 * math.exp(step)!r} um")) for step in (-0.05, 0.05)]
    low, high = (float(one.friction_coefficient.item()) for one in ends)
    assert float(found.sel(number="asperity_radius")) == pytest.approx(math.log(high / low) / 0.1, rel=0.03)
    assert sensitivity_figure(data).get_suptitle() == "Two bodies\nprediction"


def test_a_stated_error_is_shown_and_the_strength_has_one_name():
    """Near the strength of the body, the scatter of the interface adds to its stated error; both are one input."""
    case = predicted_case("160 +/- 16 MPa")
    soft = {"youngs_modulus": "115 GPa", "poissons_ratio": 0.34, "hardness": "0.9 GPa"}
    case["contact"] |= {"second": soft, "roughness": {"finish": "ground", "rms_height": "0.2 um"}}
    data = st.sensitivity(case)
    assert "interface" not in data["input"].values and data["input"].values[0] == "interfacial_shear_strength"
    *_, uncertain = sensitivity_view(data).parts()
    assert uncertain.rows == [("uncertain", "interfacial shear strength 160 MPa ± 16 MPa")]


def test_a_short_answer_has_both_tables_and_then_every_range_of_the_materials():
    """Six ranges take five lines; both tables are shortened for them, and are kept where the files are named too."""
    contact = {"first": "copper", "second": "hardened_steel_52100", "interface": "oxidised metal", "nominal_area": "1 cm^2"}
    contact["roughness"] = {"rms_height": "0.2 um", "finish": "ground"}
    data = st.sensitivity({"contact": contact, "solve": {"load": "10 N"}}, ranges=True)
    _, shares, slopes, uncertain, _ = in_short(sensitivity_view(data).parts())
    assert len(shares.rows) == 2 and len(slopes.rows) == 4
    assert uncertain.rows[0][1].startswith("Young's modulus of copper 115 GPa to 130 GPa; ")
    assert uncertain.rows[0][1].count(";") == 5
    data = st.sensitivity({"contact": contact, "solve": {"load": "10 N", "model": "persson_2001"}}, ranges=True)
    parts = [*in_short(sensitivity_view(data).parts(), written=True)]
    assert [len(part.rows) for part in parts if isinstance(part, Table)] == [4, 4]
    assert str(parts[0]).startswith("excluded: 100% of the samples, pressure above hardness")


def test_an_answer_that_fits_is_laid_out_once(monkeypatch):
    layouts, fitting = [], view._fitting
    monkeypatch.setattr(view, "_fitting", lambda parts, rows, *rest: layouts.append(rows) or fitting(parts, rows, *rest))
    assert [*in_short(["first", "second"])] == ["first", "second", "Details: --details"]
    assert layouts == [5]
    assert [*in_short(["first", "long\n" * 20])] == ["first", "Details: --details"]
    assert layouts == [5, 5, 4, 3]


def test_the_numbers_of_a_named_interface_are_among_the_sensitivities():
    """mu is alpha plus tau_0 over the pressure: with both it doubles. On hard bodies alpha is most of it."""
    case = predicted_case()
    del case["contact"]["interfacial_shear_strength"]
    silicon = {"first": "silicon", "second": "silicon", "interface": "monolayer"}
    found = st.sensitivity({**case, "contact": case["contact"] | silicon})["friction_coefficient_log_sensitivity"]
    alpha, tau = (
        float(found.sel(number=f"interface.{name}")) for name in ("pressure_coefficient", "interfacial_shear_strength")
    )
    assert alpha > 0.8 and 0.0 < tau < 0.2 and alpha + tau == pytest.approx(1.0, abs=0.03)


def test_the_heights_beside_a_finish_are_among_the_sensitivities():
    """They replace sigma, R and N, which the user did not state, and are stepped as two predictions beside them say."""
    case = predicted_case()

    def rough(first=10.0, second=8.0):
        bodies = {"first": {"rms_height": f"{first!r} nm"}, "second": {"mean_height": f"{second!r} nm"}}
        return {name: body | {"finish": "polished"} for name, body in bodies.items()}

    case["contact"] |= {"interfacial_shear_strength": "200 MPa", "roughness": rough()}
    found = st.sensitivity(case)["friction_coefficient_log_sensitivity"]
    assert not {"asperity_height_deviation", "asperity_radius", "asperity_density"} & set(found["number"].values)
    for name, body, nominal in (("rms_height", "first", 10.0), ("mean_height", "second", 8.0)):
        mu = []
        for step in (-0.05, 0.05):
            case["contact"]["roughness"] = rough(**{body: nominal * math.exp(step)})
            mu.append(st.predict(case).friction_coefficient.item())
        assert float(found.sel(number=name)) == pytest.approx(math.log(mu[1] / mu[0]) / 0.1, rel=1e-3)


def test_one_per_cent_changes_mu_as_printed_also_where_mu_is_steep():
    """Copper on copper has junctions that grow: 1 % of the strength of its oxide is 4 % of mu, and 20 % a factor of 11."""
    contact = {"first": "copper", "second": "copper", "interface": "oxidised metal", "nominal_area": "1 cm^2"}
    contact["roughness"] = {"rms_height": "0.2 um", "finish": "ground"}
    state, mu = st.Contact(**contact).interface, []
    for times in (0.99, 1.01):
        strength, ends = state.shear_strength * times, [end * times for end in state.range["shear_strength"]]
        moved = state.replace(shear_strength=strength, range=state.range | {"shear_strength": tuple(ends)})
        mu.append(st.predict(st.Contact(**contact | {"interface": moved}), load="10 N").friction_coefficient.item())
    data = st.sensitivity({"contact": contact, "solve": {"load": "10 N"}})
    slope = float(data["friction_coefficient_log_sensitivity"].sel(number="interface.shear_strength"))
    assert slope == pytest.approx(50.0 * math.log(mu[1] / mu[0]), rel=0.1)
    assert f"{slope:+.2g}" in [row[1] for row in log_sensitivities_table(data).rows]
