"""The map of the paper's claims, against arithmetic on made-up surfaces and against the numbers of theory 6."""

from pathlib import Path

import numpy as np
import pytest

import stiction as st
from stiction.studies.paper import claims as claims
from stiction.studies.paper import layered as paper_layered
from stiction.studies.paper.claims import CLAIMS, VARIANTS, ClaimMap, Curves, Surfaces, claim_map, summary, surfaces_at, where
from stiction.studies.paper.figures import PANELS, panel_curves

H = claims._H


def test_a_load_is_found_where_it_is_first_carried_after_the_largest_tension():
    load = np.where(H > 0.0, -np.sin(np.pi * H / 4.0), -H)  # tension, largest at h = 2; then load = -h
    curves = Curves(load[None], 2.0 * load[None], 3.0 + load[None])
    area, friction = curves.at(np.array([1.52]))
    np.testing.assert_allclose([area[0], friction[0]], [3.04, 4.52], rtol=1e-12)
    assert np.isnan(curves.at(np.array([4.1]))[0][0])  # nowhere carried
    assert np.isnan(curves.at(np.array([-0.5]))[0][0])  # no compressive load


@pytest.mark.parametrize("variant, bare, coated", [("published", 0.82277, 0.07774), ("corrected", 0.25270, 0.04525)])
def test_surfaces_are_those_of_the_paper(variant, bare, coated):
    """mu at h = 1 of theory 6, theta = 40, lambda = 10: bare, and n_E = 1.5, n_H = 0.5, tau = 2."""
    found = surfaces_at(40.0, np.array([10.0]), variant)
    at = int(np.argmin(np.abs(H - 1.0)))
    mu = [curves.friction_force / curves.load for curves in (found.bare, found.films)]
    assert mu[0][0, 0, 0, 0, at] == pytest.approx(bare, abs=6e-6)
    assert mu[1][0, 1, 1, 0, at] == pytest.approx(coated, abs=6e-6)


def made_up(mu_bare, mu_films, area_films=None):
    """Surfaces that all carry load exp(-h) with the given friction coefficients, constant in load."""
    load = np.exp(-H) * np.ones((1, 1, 1, 1, 1))
    films = np.broadcast_to(load, (1, 3, 3, 5, H.size))
    area = films if area_films is None else area_films[..., None] * films
    return Surfaces(Curves(load, load, mu_bare * load), Curves(films, area, mu_films[..., None] * films))


def test_claims_hold_where_their_definition_says_so():
    mu = np.full((1, 3, 3, 5), 0.3)
    mu[:, 0] = 2.0
    area = np.ones((1, 3, 3, 5))
    area[..., 0] = 1.5
    shares = {claim.key: claim.judge(made_up(1.0, mu, area)) for claim in CLAIMS}
    assert {key: float(share[0]) for key, (share, _) in shares.items()} == {"a": 1, "b": 1, "c": 1, "d": 1, "e": 1}
    worst = {key: float(number[0]) for key, (_, number) in shares.items()}
    assert worst == pytest.approx({"a": 0.3, "b": 0.0, "c": 2.0, "d": 1.0, "e": 1.5})


def test_claims_fail_in_the_share_of_cases_that_break_them():
    mu = np.full((1, 3, 3, 5), 0.3)
    mu[0, 1, 0, 0] = 0.6  # one of 30 stiff films
    judged = {claim.key: claim.judge(made_up(1.0, mu)) for claim in CLAIMS}
    assert judged["a"][0][0] == pytest.approx(29 / 30) and judged["a"][1][0] == pytest.approx(0.6)
    assert judged["b"][0][0] == 0.5 and judged["b"][1][0] == pytest.approx(0.3)
    assert judged["c"][0][0] == 0.0 and judged["e"][0][0] == 0.0


def test_without_friction_or_load_nothing_compares():
    surfaces = made_up(0.0, np.zeros((1, 3, 3, 5)))
    judged = {claim.key: claim.judge(surfaces) for claim in CLAIMS}
    assert all(np.isnan(judged[key][0][0]) and np.isnan(judged[key][1][0]) for key in "abcd")
    tension = Surfaces(*(Curves(-one.load, one.load, one.load) for one in (surfaces.bare, surfaces.films)))
    assert all(np.isnan(claim.judge(tension)[0][0]) for claim in CLAIMS)


def plane(side):
    return ClaimMap(np.geomspace(1, 1e4, side), np.geomspace(1e-3, 1e4, side), np.empty(0), np.empty(0))


def test_where_names_the_bounds_that_tell_best():
    grid = plane(15)
    theta, lam = np.meshgrid(grid.theta, grid.lam, indexing="ij")
    assert where(grid, theta > 0) == "everywhere" and where(grid, theta < 0) == "nowhere"
    assert where(grid, theta == theta[0, 0]).startswith("theta < 1.4 (true of 100%)")
    assert where(grid, theta > 10.5) == "theta > 10 (true of 100%)"
    both = where(grid, (theta > 10.5) & (lam < 1.1))
    assert both.startswith("theta > 10, lambda < ") and both.endswith("(true of 100%)")
    assert where(grid, lam * theta**-2.0 > 1e-2).startswith("eta > ")
    single = np.zeros(theta.shape, dtype=bool)
    single[3, 3] = True
    assert where(grid, single) == "almost nowhere" and where(grid, ~single) == "almost everywhere"


def test_the_map_covers_both_readings_and_its_summary_adds_up():
    theta = np.array([3.0, 40.0, 1000.0])
    found = claim_map(theta, np.array([0.1, 10.0]))
    assert found.share.shape == found.worst.shape == (len(CLAIMS), len(VARIANTS), 3, 2)
    rows = summary(found, 40.0, 10.0)
    assert [(row["claim"], row["variant"]) for row in rows] == [(claim.key, one) for claim in CLAIMS for one in VARIANTS]
    for row in rows:
        parts = ("holds_for_all", "holds_for_some", "holds_for_none", "not_comparable")
        assert sum(row[part] for part in parts) == pytest.approx(1.0)
        at, variant = "abcde".index(row["claim"]), VARIANTS.index(row["variant"])
        assert row["share_here"] == found.share[at, variant, 1, 1]


def test_the_page_states_the_definitions_and_the_whole_map():
    page = (Path(__file__).parents[2] / "docs" / "explanation" / "claims.md").read_text(encoding="utf-8")
    for claim in CLAIMS:
        assert f"| ({claim.key}) | {claim.says} | {claim.number} | {'<' if claim.below else '>'} {claim.bound:g} |" in page
    for row in summary(claim_map(), 40.0, 10.0):
        shares = (row[part] for part in ("holds_for_all", "holds_for_some", "holds_for_none", "not_comparable"))
        cells = [
            f"({row['claim']})",
            row["variant"],
            *(f"{share:.0%}" for share in shares),
            row["where_all"],
            row["where_none"],
        ]
        assert f"| {' | '.join(cells)} |" in page


def test_surfaces_whose_film_is_solved():
    """The uncoated one peels as Savkoor and Briggs have it; films without end are the film alone, and those of no thickness the
    body."""
    lam, films = np.array([10.0]), [np.array([one]) for one in (1.5, 0.5, 2.0)]
    bare = surfaces_at(40.0, lam, "layered").bare
    h = H[::20]
    alone = st.solve(st.Indices(theta=40.0, lam=10.0), separation=h, model="greenwood_williamson_1966",
                     asperity="roy_chowdhury_ghosh_1994", tangential="savkoor_briggs_1977")  # fmt: skip
    np.testing.assert_allclose(bare.friction_force[0, 0, 0, 0, ::20], alone["friction_force"].values, rtol=1e-9)
    thick = paper_layered.totals(40.0, lam, h, (*films[:2], np.array([1e9])))
    film = st.Indices(theta=40.0 * 1.5, lam=10.0 * (0.5**2 / 1.5) ** 2)
    half_space = st.solve(film, separation=h, model="greenwood_williamson_1966", asperity="roy_chowdhury_ghosh_1994")
    np.testing.assert_allclose(thick[0][0], 1.5 * half_space["load"].values, rtol=1e-4)
    np.testing.assert_allclose(thick[1][0], half_space["contact_area"].values, rtol=1e-4)
    thin = paper_layered.totals(40.0, lam, h, (*films[:2], np.array([1e-9])))
    np.testing.assert_allclose(thin[0][0], alone["load"].values, rtol=1e-4)
    found = panel_curves(PANELS[0], 40.0, 10.0, "layered")
    whole = surfaces_at(40.0, lam, "layered").films
    np.testing.assert_allclose(found.coated["load"].sel(n_E=1.5).values, whole.load[0, 1, 1, 0], rtol=1e-9)
    np.testing.assert_allclose(found.coated["friction_force"].sel(n_E=1.5).values, whole.friction_force[0, 1, 1, 0], rtol=1e-9)
    assert "film solved as a layer" in found.caption
