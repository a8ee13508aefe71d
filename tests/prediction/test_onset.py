"""Strength that falls with slip in a prediction: the compact law of efficiency, its limits, and what a case states."""

import csv
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import stiction as st
from refusals import refusal
from stiction.solving.sliding_efficiency import efficiency, spot_radius, spread_of_edges, spread_of_spots
from stiction.studies.prediction.onset import _mismatch

ROWS = Path(__file__).parents[2] / "truth" / "slides.csv"
PAIR = {
    "first": "copper", "second": "copper", "interfacial_shear_strength": "200 MPa", "nominal_area": "1 cm^2",
    "roughness": {"asperity_height_deviation": "0.2 um", "asperity_radius": "20 um", "asperity_density": "1e10 1/m^2"},
}  # fmt: skip


def predicted(**more):
    return st.predict({"contact": PAIR | more, "solve": {"load": "10 N"}, "uncertainty": {"count": 64}})


@pytest.fixture(scope="module")
def solved():
    """Rows of maps that were moved aside and are held out of the fit (truth/slides.py)."""
    with ROWS.open(encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["held"] == "1"]
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0] if name != "design"}


def test_the_law_holds_on_maps_held_out(solved):
    spread = solved["spread"] / solved["length"] / (1.0 - solved["residual"])  # l_c = D_c/(S tau_p (1 - r))
    error = np.log(efficiency(spread, solved["residual"]) / solved["efficiency"])
    assert len(error) > 300 and np.sqrt(np.mean(error**2)) < 0.02 and abs(error).max() < 0.08


def test_by_the_numbers_of_asperities_the_law_holds_within_a_twentieth(solved):
    """The same maps, of which only deviation, radius and density of asperities and the area in contact are known."""
    compliance, share = 0.85, solved["share"]  # S of the law over that of `weakening_length`, nu = 0.3
    edges = np.where(solved["edges"] == 1.0, spread_of_edges(1.0, share), 0.0)
    spread = compliance * np.hypot(spread_of_spots(solved["numbers"], share, solved["density"]), edges)
    found = efficiency(spread / solved["length"] / (1.0 - solved["residual"]), solved["residual"])
    assert np.std(np.log(found / solved["efficiency"])) < 0.05


@pytest.mark.parametrize(("over", "expected"), [(0.3, 0.954), (1.0, 0.858), (3.0, 0.688), (6.0, 0.547), (12.0, 0.414)])
def test_a_single_disc_that_is_no_part_of_the_fit(over, expected):
    """Efficiency of a disc of radius `over` l_c, nu = 0, by an independent solver; its displacement deviates by .0987 a S q."""
    assert efficiency(0.0987 * over, 0.0) == pytest.approx(expected, rel=0.011)


def test_limits():
    """1 where nothing is lost, Griffith's square root for what is large, the residual strength at least."""
    assert efficiency(0.0, 0.3) == 1.0 and efficiency(1e9, 1.0) == 1.0
    assert efficiency(1e-9, 0.3) == pytest.approx(1.0, abs=1e-6)
    assert efficiency(4e4, 0.0) / efficiency(1e4, 0.0) == pytest.approx(0.5, rel=1e-3)
    assert efficiency(1e9, 0.6) == pytest.approx(0.6, rel=1e-3)
    spread = np.geomspace(1e-6, 1e6, 500)
    for residual in (0.0, 0.5, 0.95):
        assert (np.diff(efficiency(spread, residual)) < 0.0).all()


def test_the_radius_of_spots_is_that_of_greenwood_and_williamson():
    """At a separation of one deviation: heights above it exceed it by .525 deviations (Gaussian tables)."""
    share = np.pi * 1e10 * 20e-6 * 0.2e-6 * 0.08332
    assert spot_radius(share, 0.2e-6, 20e-6, 1e10) == pytest.approx(np.sqrt(20e-6 * 0.2e-6 * 0.08332 / 0.15866), rel=1e-3)


def test_a_prediction_without_a_weakening_slip_is_the_sum():
    alone = predicted()
    assert "friction_efficiency" not in alone
    whole = predicted(weakening_slip="1 nm", residual_strength=1.0)
    assert "friction_efficiency" not in whole
    np.testing.assert_array_equal(whole.friction_coefficient, alone.friction_coefficient)
    named = predicted(residual_strength=0.5).attrs["inputs_not_used"]
    assert "residual_strength (weakening_slip is not stated)" in named


def test_friction_falls_with_a_shorter_slip_and_never_leaps():
    slips = np.geomspace(1.0, 1.2, 11)
    found = [predicted(weakening_slip=f"{slip} nm", residual_strength=0.4) for slip in slips]
    mu = np.array([float(one.friction_coefficient[0]) for one in found])
    assert (np.diff(mu) > 0.0).all() and (np.diff(np.log(mu)) < 0.02).all()
    sums = float(predicted().friction_coefficient[0])
    assert 0.4 * sums < mu[0] < 0.95 * sums
    shares = [float(one.friction_efficiency[0]) for one in found]
    assert 0.4 < shares[0] < shares[-1] < 1.0
    long = predicted(weakening_slip="1 mm", residual_strength=0.4)
    assert float(long.friction_coefficient[0]) == pytest.approx(sums, rel=1e-4)


def test_a_slip_needs_a_residual_strength():
    with refusal("residual_strength", "not given", "weakening_slip"):
        st.Contact(**PAIR, weakening_slip="1 nm")


def on_map(seed, hurst, longest, shortest, gradient, periodic=True, points=128, **more):
    """A contact whose nominal area is its map of so many points a side."""
    side = 10e-6
    waves = st.SelfAffine(hurst, side / longest, side / shortest, gradient * side)
    surface = replace(st.gaussian_surface((points, points), (side, side), waves, seed=seed), periodic=periodic)
    pair = {"first": "hardened_steel_52100", "second": "silicon_nitride", "interfacial_shear_strength": "300 MPa"}
    return st.Contact(**pair | {"roughness": surface, "nominal_area": side**2} | more)


@pytest.mark.parametrize(
    ("surface", "more"),
    [
        ((1, 0.8, 4, 16, 2e-3), {"weakening_slip": "2 nm", "residual_strength": 0.3, "second": "hardened_steel_52100"}),
        ((2, 0.8, 4, 16, 2e-3, True, 96), {"weakening_slip": "3 nm", "residual_strength": 0.0}),
        ((5, 0.3, 4, 12, 4e-3, True, 96), {"weakening_slip": "2 nm", "residual_strength": 0.6, "first": "silicon"}),
        (
            (6, 0.8, 4, 16, 2e-3, False),
            {"weakening_slip": "2 nm", "residual_strength": 0.3, "first": "silicon", "second": "silicon"},
        ),
    ],
)
def test_the_interval_holds_what_the_map_itself_gives(surface, more):
    contact = on_map(*surface, **more)
    loads = ["1 mN", "40 mN"]
    solved = st.slide(contact, load=loads, model="boundary_elements")["friction_efficiency"].values
    answer = st.predict(contact, load=loads)
    assert (answer.friction_efficiency_low.values <= solved).all()
    assert (answer.friction_efficiency_high.values >= solved).all()
    like = contact.first == contact.second
    assert (answer.friction_efficiency_high.values < (1.14 if like else 1.25) * answer.friction_efficiency_low.values).all()


def test_unlike_bodies_lose_a_share_that_goes_with_dundurs_parameter():
    """beta of these bodies is (.6 - .2)/(2 (.8 + .6)) = 1/7, with shear moduli of 1 GPa and nu of .2 and .4."""
    soft, hard = (
        st.Material(youngs_modulus=2e9 * (1.0 + nu), poissons_ratio=nu, hardness="1 GPa", material_class="ceramic")
        for nu in (0.4, 0.2)
    )
    assert float(_mismatch((soft, hard))) == pytest.approx(1.0 / 7.0)
    assert float(_mismatch((soft, soft))) == 0.0


def test_a_nominal_area_beyond_its_map_has_ends():
    """The map is known only up to its side: what is wider adds the ends of the whole contact, from the side of the map on."""
    pair = {"weakening_slip": "20 nm", "residual_strength": 0.3}
    shares = [
        float(
            st.predict(on_map(1, 0.8, 4, 16, 2e-3, nominal_area=times * 1e-10, **pair), load=0.01 * times).friction_efficiency
        )
        for times in (1.0, 1.1, 100.0, 1e4)
    ]
    assert (np.diff(shares) < 0.0).all() and shares[0] - shares[1] < 0.01 and shares[3] < 0.75


def test_unlike_bodies_lose_nothing_where_like_bodies_lose_nothing():
    long = {"weakening_slip": "1 mm", "residual_strength": 0.3, "first": "silicon"}
    assert float(st.predict(on_map(5, 0.3, 4, 12, 4e-3, **long), load="10 mN").friction_efficiency) == pytest.approx(
        1.0, rel=1e-3
    )
