"""Bands over what is uncertain: against quantiles in closed form, with the error of their sampling, and how they are told."""

import csv
import io
import json

import numpy as np
import pytest
import scipy.stats
import xarray
from matplotlib.collections import LineCollection
from rich.console import Console
from typer.testing import CliRunner

import stiction as st
from refusals import refusal
from stiction import cli
from stiction.case.read import parse_case
from stiction.report.pictures import curve_figure, uncertainty_figure
from stiction.report.views.run import band_lines
from stiction.solving.choice import Choice
from stiction.solving.pointwise import REASONS, solve_batch
from stiction.studies.case_results import solve_case
from stiction.studies.uncertainty import drawing
from stiction.studies.uncertainty.bands import levels, quantiles
from stiction.studies.uncertainty.drawing import Variant, draw, scrambled

# Exponential heights and elastic asperities: mu is tau_0 R^(1/2)/(E* sigma^(1/2)) times a number, at every load.
POWER_LAW = {
    "first": {"youngs_modulus": "200 GPa", "poissons_ratio": 0.3, "hardness": "100 GPa"},
    "second": {"youngs_modulus": "200 GPa", "poissons_ratio": 0.3, "hardness": "100 GPa"},
    "nominal_area": "1 mm^2",
    "interfacial_shear_strength": {"median": "20 MPa", "factor": 2},
    "roughness": {
        "asperity_height_deviation": "50 nm",
        "asperity_radius": {"median": "50 um", "factor": 1.5},
        "asperity_density": "1.6e10 1/m^2",
        "height_distribution": "exponential",
    },
}
SOLVE = {"load": ["10 mN", "1 N"], "model": "greenwood_williamson_1966"}
# ln mu = ln tau_0 + ln R/2: its standard deviation.
DEVIATION = np.hypot(np.log(2.0), 0.5 * np.log(1.5))


def case(contact=None, solve=None, **tables):
    return parse_case({"contact": {**POWER_LAW, **(contact or {})}, "solve": {**SOLVE, **(solve or {})}, **tables})


def test_mu_of_stated_values_outside_its_interval_is_said():
    """mu of this coated contact is largest near lam = 1140: nearly all samples around it give less."""
    indices = {"theta": 2.2, "n_E": 4.74, "n_H": 0.0847, "tau": 10.4}
    told = [
        solve_case(
            parse_case({"indices": indices | {"lam": lam}, "solve": {"load": [1e-3]}, "uncertainty": {"coverage": 0.5}})
        ).attrs["outside_validity"]
        for lam in ({"median": 1140.0, "factor": 3.0}, {"median": 3000.0, "factor": 1.1})
    ]
    assert "stated values lies outside its interval" in told[0] and "stated values" not in told[1]


def test_bands_of_a_power_law_are_those_of_a_log_normal():
    data = solve_case(case(uncertainty={"count": 4096}))
    nominal = data["friction_coefficient"].values
    exact = nominal * np.exp(DEVIATION * scipy.stats.norm.ppf([0.05, 0.25, 0.5, 0.75, 0.95]))[:, None]
    assert data["friction_coefficient_quantile"].dims == ("quantile", "load")
    assert data["quantile"].values.tolist() == pytest.approx([0.05, 0.25, 0.5, 0.75, 0.95])
    error = data["friction_coefficient_quantile_error"].values
    assert np.all(np.abs(data["friction_coefficient_quantile"].values - exact) < 4.0 * error)
    assert np.all(error < 0.02 * exact) and np.all(error > 0.0)


def test_the_band_of_one_load_is_a_bar_in_every_picture():
    data = solve_case(case(solve={"load": "1 N"}, uncertainty={"count": 64}))
    lowest, highest = data["friction_coefficient_quantile"].values[[0, -1]].ravel()
    for figure in (uncertainty_figure(data), curve_figure(data, "")):
        bars = [one for one in figure.axes[0].collections if isinstance(one, LineCollection) and one.get_linewidth()[0] > 4.0]
        ends = np.concatenate([one.get_segments()[0][:, 1] for one in bars])
        assert ends.min() == pytest.approx(lowest) and ends.max() == pytest.approx(highest)
        bottom, top = figure.axes[0].get_ylim()
        assert bottom < lowest and highest < top


def test_no_quantile_is_cut_off_at_the_edge_of_the_terminal():
    """As wide as they come: mu of 1e-7 takes nine letters, a load with a prefix twelve."""
    loads = ["199.5 mN", "316.2 mN"]
    data = solve_case(case({"interfacial_shear_strength": {"median": "21.3 Pa", "factor": 2}}, {"load": loads}))
    printed = Console(file=io.StringIO(), width=80)
    for line in band_lines(data):
        printed.print(line)
    text = printed.file.getvalue()
    for value in data["friction_coefficient_quantile"].values.ravel():
        assert f"{value:.4g}" in text.split(), text
    assert "…" not in text and all(name in text for name in ("P = 199.5 mN", "95%"))
    assert max(map(len, text.splitlines())) <= 80


def test_the_error_of_the_sampling_is_as_large_as_it_says():
    """Over 60 seeds: how far quantiles of a sum of two normal numbers are from the exact ones, over the error told."""
    shares = levels(0.9)
    exact = np.sqrt(2.0) * scipy.stats.norm.ppf(shares)
    off = []
    for seed in range(60):
        values = scipy.stats.norm.ppf(scrambled(2, 512, seed, 8)).sum(axis=-1)
        found, error = quantiles(values, shares)
        off.append((found - exact) / error)
    assert 0.6 < np.sqrt(np.mean(np.square(off))) < 1.6


def test_the_same_seed_is_the_same_to_the_bit_and_another_is_not():
    one, again, other = (solve_case(case(uncertainty={"count": 64, "seed": seed})) for seed in (3, 3, 4))
    name = "friction_coefficient_quantile"
    np.testing.assert_array_equal(one[name], again[name])
    assert not np.allclose(one[name], other[name], rtol=1e-6)


def test_coverage_decides_the_ends():
    narrow, wide = (solve_case(case(uncertainty={"count": 1024, "coverage": share})) for share in (0.6, 0.98))
    ends = scipy.stats.norm.ppf([0.01, 0.99]) * DEVIATION
    found = np.log(wide["friction_coefficient_quantile"].values[[0, -1], 0] / wide["friction_coefficient"].values[0])
    np.testing.assert_allclose(found, ends, rtol=0.15)
    assert narrow["quantile"].values[[0, -1]] == pytest.approx([0.2, 0.8])


def test_other_numbers_may_be_several():
    both = solve_case(case({"nominal_area": ["1 mm^2", "4 mm^2"]}, uncertainty={"count": 64}))
    assert both["friction_coefficient_quantile"].dims == ("quantile", "nominal_area", "load")
    one = solve_case(case({"nominal_area": "4 mm^2"}, uncertainty={"count": 64}))
    np.testing.assert_allclose(both["friction_coefficient_quantile"][:, 1], one["friction_coefficient_quantile"], rtol=1e-9)


def test_separations_over_a_sigma_that_is_drawn_give_bands_of_the_load():
    """At a separation over sigma, load goes as sigma^(3/2) and mu as sigma^(-1/2)."""
    rough = {
        **POWER_LAW["roughness"],
        "asperity_radius": "50 um",
        "asperity_height_deviation": {"median": "50 nm", "factor": 1.2},
    }
    contact = {"roughness": rough, "interfacial_shear_strength": "20 MPa"}
    content = {"contact": {**POWER_LAW, **contact}, "solve": {"separation": [1.0, 2.0], "model": SOLVE["model"]}}
    data = solve_case(parse_case(content))
    ratio = data["load_quantile"].values / data["load"].values
    exact = np.exp(1.5 * np.log(1.2) * scipy.stats.norm.ppf(data["quantile"].values))
    np.testing.assert_allclose(ratio, np.stack([exact, exact], axis=1), rtol=0.03)
    low, high = (data["friction_coefficient_quantile"].values[at] / data["friction_coefficient"].values for at in (0, -1))
    np.testing.assert_allclose([low, high], [[exact[0] ** (1 / 3)] * 2, [exact[-1] ** (1 / 3)] * 2], rtol=0.02)


def test_what_is_drawn_in_many_steps_is_as_in_one(monkeypatch):
    """At most so many points are solved at once: of four rows a step, at two loads each."""
    found, steps = case(), []
    shares = scrambled(2, 16, 0)[0]
    whole = draw(found, shares, [Variant(found.choice)])
    monkeypatch.setattr(drawing, "_AT_ONCE", 8)
    parts = draw(found, shares, [Variant(found.choice)], progress=lambda each: steps.extend(each) or each)
    assert [len(rows) for _, rows in steps] == [4, 4, 4, 4]
    for name, table in whole.tables.items():
        np.testing.assert_allclose(parts.tables[name], table, rtol=1e-9)


def test_without_anything_uncertain_there_are_no_bands():
    plain = case({"interfacial_shear_strength": "20 MPa", "roughness": {**POWER_LAW["roughness"], "asperity_radius": "50 um"}})
    assert "quantile" not in solve_case(plain).dims


def test_contacts_that_are_refused_are_left_out_and_said():
    """The model knows no surfaces of few asperities, N R sigma: these are lost, and no others."""
    rough = {"asperity_height_deviation": "50 nm", "asperity_radius": "50 um", "asperity_density":
             {"low": "5e9 1/m^2", "high": "3e10 1/m^2"}}  # fmt: skip
    content = {"contact": {**POWER_LAW, "roughness": rough, "interfacial_shear_strength": "20 MPa"},
               "solve": {"load": "1 N", "model": "hariri_zu_ben_mrad_2006"}, "uncertainty": {"count": 256}}  # fmt: skip
    found = parse_case(content)
    drawn = draw(found, scrambled(1, 256, 0)[0], [Variant(found.choice)], names=("friction_coefficient",))
    mu, density = drawn.tables["friction_coefficient"][:, 0], scrambled(1, 256, 0)[0][:, 0] * 2.5e10 + 5e9
    lost = np.isnan(mu)
    assert 0.05 < lost.mean() < 0.5 and density[lost].max() < density[~lost].min()
    alone = parse_case({**content, "contact": {**content["contact"], "roughness": {**rough, "asperity_density": "2e10 1/m^2"}}})
    nearest = int(np.argmin(np.abs(density - 2e10)))
    assert mu[nearest] == pytest.approx(float(solve_case(alone)["friction_coefficient"][0]), rel=0.02)
    data = solve_case(found)
    assert "of the samples have no result" in data.attrs["outside_validity"]
    assert json.loads(data.attrs["validity_warnings_of_points"])[
        "the contact is invalid: one of its numbers is out of bounds, or the model does not converge"
    ] == pytest.approx(lost.mean(), abs=0.03)


def test_of_contacts_solved_together_the_others_are_as_alone():
    rough = st.Roughness(asperity_height_deviation="50 nm", asperity_radius="50 um",
                         asperity_density=st.axis("asperity_density", [5e9, 2.5e10, 2e10, 1e9]))  # fmt: skip
    steel = {"youngs_modulus": 2e11, "poissons_ratio": 0.3, "hardness": 7e9}
    contact = st.Contact(first=steel, second=steel, roughness=rough, nominal_area=1e-6, interfacial_shear_strength=2e7)
    choice = Choice("hariri_zu_ben_mrad_2006")
    together = solve_batch(contact, choice, load=1.0)
    assert together.validity_warnings[1][[0, 3]].tolist() == [1, 1] and not together.validity_warnings[1][1] & 1
    for at, density in ((1, 2.5e10), (2, 2e10)):
        alone = solve_batch(contact.replace(roughness=rough.replace(asperity_density=density)), choice, load=1.0)
        for name in ("friction_coefficient", "contact_area", "mean_separation"):
            assert together.variables[name][1][at] == pytest.approx(float(alone.variables[name][1]), rel=1e-9)
    assert np.isnan(together.variables["contact_area"][1][[0, 3]]).all()
    with refusal("roughness_parameter", "0.0025", "0.03965"):
        solve_batch(contact.replace(roughness=rough.replace(asperity_density=1e9)), choice, load=1.0)


def test_a_map_is_solved_once_and_has_no_band(tmp_path):
    spectrum = st.SelfAffine(hurst=0.8, rolloff=10e-6, shortest=3e-6, deviation=8e-9)
    np.save(tmp_path / "scan.npy", st.gaussian_surface((32, 32), (40e-6, 40e-6), spectrum, seed=1).heights)
    scan = {"file": str(tmp_path / "scan.npy"), "size": "40 um", "unit": "m"}
    data = solve_case(case({"roughness": {"first": scan}}, {"load": "0.1 N", "model": "boundary_elements"}))
    assert "quantile" not in data.dims and "no interval is given" in data.attrs["outside_validity"]


def test_a_number_beside_a_scan_is_not_uncertain(tmp_path):
    spectrum = st.SelfAffine(hurst=0.8, rolloff=10e-6, shortest=3e-6, deviation=8e-9)
    np.save(tmp_path / "scan.npy", st.gaussian_surface((32, 32), (40e-6, 40e-6), spectrum, seed=1).heights)
    scan = {"file": str(tmp_path / "scan.npy"), "size": "40 um", "unit": "m"}
    other = {"asperity_height_deviation": "5 +/- 1 nm", "asperity_radius": "50 um", "asperity_density": "1e11 1/m^2"}
    with refusal("contact.roughness.second.asperity_height_deviation", "5 nm ± 1 nm"):
        case({"roughness": {"first": scan, "second": other}})


ADHESIVE = {
    "first": "hardened_steel_52100",
    "second": "hardened_steel_52100",
    "work_of_adhesion": {"median": "50 mJ/m^2", "factor": 2},
    "nominal_area": "1 mm^2",
    "interfacial_shear_strength": {"median": "200 MPa", "factor": 1.5},
    "roughness": {
        "asperity_height_deviation": "48 nm",
        "asperity_radius": "50 um",
        "asperity_density": "1.7e10 1/m^2",
    },
}


def test_the_band_is_drawn():
    data = solve_case(case(uncertainty={"count": 64}))
    (axes,) = uncertainty_figure(data, "title").axes
    lines = {line.get_label(): line.get_ydata() for line in axes.lines}
    np.testing.assert_array_equal(lines["at nominal inputs"], data["friction_coefficient"])
    np.testing.assert_array_equal(lines["median"], data["friction_coefficient_quantile"][2])
    low = axes.collections[0].get_paths()[0].vertices[:, 1].min()
    assert low == pytest.approx(float(data["friction_coefficient_quantile"][0].min()))


TEXT = """
title = "two numbers"
[contact]
first = "hardened_steel_52100"
second = "hardened_steel_52100"
nominal_area = "1 mm^2"
interfacial_shear_strength = "200 +/- 20 MPa"
work_of_adhesion = "10 mJ/m^2"
[contact.roughness]
asperity_height_deviation = "48 nm"
asperity_radius = {low = "40 um", high = "60 um"}
asperity_density = "1.7e10 1/m^2"
[solve]
load = ["0.1 N", "1 N"]
model = "greenwood_williamson_1966"
[uncertainty]
count = 64
"""


def run(tmp_path, *words):
    path = tmp_path / "case.toml"
    path.write_text(TEXT, encoding="utf-8")
    result = CliRunner().invoke(cli.app, [words[0], str(path), *map(str, words[1:])])
    assert result.exit_code == 0, (result.output, result.exception)
    return result.stdout


def test_run_tells_draws_and_writes_the_bands(tmp_path):
    shown = run(tmp_path, "run", "--details", "--out", tmp_path / "out")
    assert "interfacial_shear_strength: 200 MPa ± 20 MPa" in shown and "95%" in shown
    assert (tmp_path / "out" / "uncertainty.png").exists()
    band = json.loads(run(tmp_path, "run", "--json"))["variables"]["friction_coefficient_quantile"]
    assert band["dims"] == ["quantile", "load"]
    with xarray.open_dataset(tmp_path / "out" / "curve.nc", engine="h5netcdf") as again:
        np.testing.assert_array_equal(again["friction_coefficient_quantile"], band["values"])
    with (tmp_path / "out" / "curve.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    assert len(rows) == 2 and float(rows[1]["friction_coefficient_q95"]) == band["values"][-1][1]
    wider = json.loads(run(tmp_path, "run", "--json", "--ranges"))
    assert "hardened_steel_52100.youngs_modulus" in wider["attrs"]["uncertain_inputs"]


def test_the_error_of_a_quantile_is_the_scatter_of_the_parts_over_the_root_of_their_number():
    """Parts that say 0 to 7, each of all of its points: their variance is 6, of eight that are independent 6/8."""
    values = np.broadcast_to(np.arange(8.0)[:, None], (8, 50))
    whole, error = quantiles(values, np.array([0.25, 0.5]))
    assert error == pytest.approx(np.sqrt(6.0 / 8.0)) and whole == pytest.approx([1.75, 3.5], abs=0.3)


def test_quantiles_are_of_those_that_are_known_while_these_are_half():
    values = np.arange(800.0).reshape(8, 100)
    values[:, 60:] = np.nan
    known = np.sort(values[np.isfinite(values)])
    whole, error = quantiles(values, np.array([0.5]))
    assert whole[0] == pytest.approx(np.quantile(known, 0.5)) and np.isfinite(error[0])
    values[:, 40:] = np.nan
    assert np.isnan(quantiles(values, np.array([0.5]))[0]).all()


@pytest.mark.parametrize("why", REASONS[:2])
def test_points_of_which_nothing_is_known_are_told_whatever_the_reason(why, monkeypatch):
    monkeypatch.setattr(drawing.Draws, "shares", lambda found: {why: 0.25})
    assert "25% of the samples" in solve_case(case(uncertainty={"count": 64})).attrs["outside_validity"]
