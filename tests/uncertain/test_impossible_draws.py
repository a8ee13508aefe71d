"""Draws whose result is impossible, above the nominal area or the hardness, are in no band; how many there are is said."""

from pathlib import Path

import numpy as np
import pytest

import stiction as st
from stiction.case.read import parse_case
from stiction.laws.validity import warnings_of
from stiction.report.views.run import uncertain_notes
from stiction.studies.uncertainty import drawing

# Surfaces of an elastomer under a tenth of a millinewton, from rough to smooth: the smoothest would touch all over.
HEIGHTS = [0.5e-6, 0.4e-6, 0.3e-6, 0.12e-6]
STRENGTH, LOAD, AREA = 1e5, 1e-4, 1e-6


def case(heights, model="fuller_tabor_1975", **contact):
    rough = {"asperity_radius": "20 um", "asperity_density": "2e10 1/m^2", "asperity_height_deviation": heights}
    body = {"youngs_modulus": "2 MPa", "poissons_ratio": 0.49, "hardness": "15 MPa"}
    given = {"first": body, "second": "silicon", "nominal_area": "1 mm^2", "work_of_adhesion": "40 mJ/m^2", "roughness": rough}
    solve = {"load": "0.1 mN", "model": model}
    tables = {"contact": given | {"interfacial_shear_strength": "0.1 MPa"} | contact, "solve": solve}
    return tables | {"uncertainty": {"count": 64}}


@pytest.fixture(autouse=True)
def beside_the_case(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def samples(*values, unit="m"):
    Path("measured.csv").write_text("\n".join(map(str, values)))
    return {"samples": "measured.csv", "unit": unit}


def alone(height):
    """Friction of one surface, and its contact area over the nominal one."""
    found = st.solve_case(parse_case(case(f"{height} m"))).squeeze()
    return float(found["friction_coefficient"]), float(found["contact_area"]) / AREA


def test_the_smoothest_surface_is_impossible():
    assert [alone(height)[1] > 1.0 for height in HEIGHTS] == [False, False, False, True]


def test_a_band_ends_at_the_nominal_area():
    """The strength on all of the nominal area is the most that the interface resists."""
    data = st.solve_case(parse_case(case(samples(*HEIGHTS)))).squeeze()
    band = data["friction_coefficient_quantile"].values
    assert band[-1] <= STRENGTH * AREA / LOAD < alone(HEIGHTS[-1])[0]
    assert band[[0, -1]] == pytest.approx([alone(HEIGHTS[0])[0], alone(HEIGHTS[2])[0]], rel=1e-9)
    assert data["contact_area_quantile"].values.max() <= AREA
    assert data.attrs["impossible_draws"] == pytest.approx(0.25, abs=0.02)
    reasons = [warning.why for warning in warnings_of(data)]
    excluded = (
        "25% of the samples exceed nominal area or hardness and are excluded: the interval of mu is computed from the others"
    )
    assert excluded in reasons
    assert any("excluded from the band as impossible: 0.25 of the samples" in note for note in uncertain_notes(data))


def test_few_are_counted_and_no_warning_is_made_of_them():
    data = st.solve_case(parse_case(case(samples(*HEIGHTS[:3] * 12, HEIGHTS[3])))).squeeze()
    assert 0.0 < data.attrs["impossible_draws"] < 0.05
    assert not [one for one in warnings_of(data) if "excluded" in one.why]


def test_where_most_are_impossible_there_is_no_band():
    data = st.solve_case(parse_case(case(samples(HEIGHTS[0], *HEIGHTS[3:] * 3)))).squeeze()
    assert np.isnan(data["friction_coefficient_quantile"].values).all()
    assert any("no interval is given" in one.why for one in warnings_of(data))


def test_where_all_are_possible_nothing_is_said():
    data = st.solve_case(parse_case(case(samples(*HEIGHTS[:3])))).squeeze()
    assert data.attrs["impossible_draws"] == 0.0 and not [one for one in warnings_of(data) if "excluded" in one.why]


def test_draws_above_the_hardness():
    """Elastic spheres under the mean pressure of E* (sigma/R)^(1/2)/3 and more pass the hardness of the softest of these."""
    body = {"youngs_modulus": "210 GPa", "poissons_ratio": 0.3}
    hard = samples(8, 6, 5, 0.3, unit="GPa")
    tables = case("0.05 um", "greenwood_williamson_1966", first=body | {"hardness": hard})
    tables["solve"]["load"] = "1 N"
    tables["contact"]["second"] = body | {"hardness": "9 GPa"}
    data = st.solve_case(parse_case(tables)).squeeze()
    assert data.attrs["impossible_draws"] == pytest.approx(0.25, abs=0.02)


def test_samples_that_yield_above_their_hardness_have_no_result_and_the_others_are_solved_together(monkeypatch):
    """Searching for each of many such samples by halves took minutes."""
    body = {"youngs_modulus": "10 GPa", "poissons_ratio": 0.3, "hardness": "100 MPa", "material_class": "polymer"}
    tables = case("0.5 um", "kogut_etsion_2004", first=body | {"yield_stress": {"low": "50 MPa", "high": "150 MPa"}})
    del tables["contact"]["work_of_adhesion"]
    found, attempts = parse_case(tables), []
    solve = drawing.evaluate_many
    monkeypatch.setattr(drawing, "evaluate_many", lambda *given, **more: (attempts.append(1), solve(*given, **more))[1])
    levels = np.linspace(0.01, 0.99, 50)[:, None]
    area = drawing.draw(found, levels, [drawing.Variant(found.choice)], names=("contact_area",)).tables["contact_area"][:, 0]
    assert (np.isnan(area) == (50.0 + 100.0 * levels[:, 0] > 100.0)).all() and attempts == [1]
    tables["contact"]["first"] = body | {"yield_stress": f"{50.0 + 100.0 * levels[3, 0]} MPa"}
    assert area[3] == pytest.approx(st.solve_case(parse_case(tables))["contact_area"].item(), rel=1e-9)


def test_a_swept_number_may_count_for_samples_only():
    """The yield stress is that of the harder body, but the softer one in the other half of the samples; fuzz seed 9004407."""
    body = {"youngs_modulus": "10 GPa", "poissons_ratio": 0.3, "hardness": "100 MPa", "material_class": "polymer"}
    swept = body | {"hardness": {"low": "99 MPa", "high": "103 MPa"}, "yield_stress": ["30 MPa", "60 MPa"]}
    tables = case("0.5 um", "kogut_etsion_2004", first=swept, second=body)
    del tables["contact"]["work_of_adhesion"]
    data = st.solve_case(parse_case(tables))
    quantiles = data["contact_area_quantile"].squeeze()
    assert quantiles.dims == ("quantile", "yield_stress") and np.isfinite(quantiles).all()
    low, high = quantiles.transpose("yield_stress", "quantile").values
    np.testing.assert_allclose(high, low, rtol=1e-9)  # under this load nothing yields
