"""Films of no thickness, without end, and like their substrate: every film law becomes what it has to be, or its record says by
how much it is off, and a range of validity is left there."""

import numpy as np
import pytest
from film_limits import QUANTITIES, H, choices, departures, groups_of

import stiction as st
from stiction.laws.validity import warnings_about
from stiction.records.claims import FILM_LIMITS
from stiction.records.registry import FilmLaw, of_kind
from stiction.solving.problem import problem_of

FILMS = of_kind(FilmLaw)
NOTHING = 2e-3  # what hardly any adhesion, and the least thickness, leave
FLAGGED = 0.2  # off by more than this a result has a validity warning
each = pytest.mark.parametrize("limit", FILM_LIMITS)
each_film = pytest.mark.parametrize("key", FILMS)


def said(film, limit, quantity):
    return next((one for one in film.departures if (one.limit, one.quantity) == (limit, quantity)), None)


@each
@each_film
def test_a_film_law_becomes_what_it_has_to_be_or_says_by_how_much_not(key, limit):
    """What is said is what is found over soft and hard films, plastic and elastic contacts: no less, and not much more."""
    for quantity, off in departures(FILMS[key], limit).items():
        low, high = float(np.nanmin(off)), float(np.nanmax(off))
        claim = said(FILMS[key], limit, quantity)
        if claim is None:
            assert -NOTHING <= low and high <= NOTHING, f"{quantity}: {low:+.3f} to {high:+.3f}"
            continue
        assert claim.least - NOTHING <= low and high <= claim.most + NOTHING, f"{quantity}: {low:+.3f} to {high:+.3f}"
        assert min(low, 0.0) <= 0.8 * claim.least + NOTHING or claim.least >= 0.0
        assert claim.most <= 0.0 or np.isinf(claim.most) or high >= 0.8 * claim.most - NOTHING
        assert max(abs(low), high) > NOTHING, "nothing is off"


@each
@each_film
def test_what_is_off_has_a_warning(key, limit):
    """Every contact by itself, at one separation: a validity warning of a film law's own where it is off by more than a
    fifth."""
    film = FILMS[key]
    given = groups_of(limit)
    warned = 0
    for choice in choices(film):
        off = departures(film, limit, [choice])
        worst = np.nanmax([np.abs(np.nan_to_num(off[name][0], posinf=9.9)) for name in off], axis=0)
        whole = given.with_changes(tabor_parameter=np.full(len(given), 2.0), sharpness=np.full(len(given), 0.03),
                                   hardening=np.full(len(given), 0.01))  # fmt: skip
        results = problem_of(whole, choice[0]).on_grid(H)
        for i, j in zip(*np.nonzero(worst > FLAGGED), strict=True):
            one = {name: values[i, j] for name, values in results.items()}
            assert warnings_about(whole[i : i + 1], film.validity, one), (
                f"off by {worst[i, j]:.2f}: {choice[0]}, contact {i}, h = {H[j]}"
            )
            warned += 1
    assert warned or not any(max(-one.least, one.most) > FLAGGED for one in film.departures if one.limit == limit)


def test_records_say_it_where_users_look():
    """As data, in the row and in the page of a model; none of a law that is what it has to be."""
    (row,) = st.models(["sequential"])
    assert len(row["departures"]) == len(FILMS["sequential"].departures) > 2
    assert any(FILM_LIMITS["thin"] in line and "contact_area" in line for line in row["departures"])
    for film in FILMS.values():
        for one in film.departures:
            assert one.limit in FILM_LIMITS and one.quantity in QUANTITIES and one.least <= one.most
    assert not any(FILMS[key].departures for key in ("graded", "halling_1979", "dayson_1971", "layered"))


def test_the_area_of_a_plastic_film_without_thickness_is_twice_that_of_the_elastic_substrate():
    """By hand: Hertz has pi R omega, a contact that is plastic 2 pi R omega. A soft film that is hardly there, on a
    substrate that does not yield, doubles the area under the sequential law; the thin film has a validity warning."""
    given = {"theta": 1e8, "lam": 1e16 * 50.0**4 / (18 * np.pi**2), "n_E": 1.0, "tau": 1e-12, "shear_strength": 0.1}
    laws = {"model": "greenwood_williamson_1966", "asperity": "chang_etsion_bogy_1987", "tangential": "bowden_tabor_1943"}
    coated = st.solve(st.Indices(n_H=1e-6, **given), separation=1.0, film="sequential", **laws)
    z = np.linspace(1.0, 12.0, 400001)
    elastic = np.trapezoid((z - 1.0) * np.exp(-(z**2) / 2) / np.sqrt(2 * np.pi), z)
    assert float(coated["contact_area"]) == pytest.approx(2 * elastic, rel=1e-3)
    assert float(coated["load_share_substrate"]) == pytest.approx(1.0, abs=1e-3)
    assert "load fraction that the substrate carries" in coated.attrs["outside_validity"]


def test_what_the_new_quantities_are():
    """Of one contact by hand: (E*/H) sqrt(sigma/R) of the film against its counterbody, and n_E over t/sqrt(R sigma)."""
    body = {"youngs_modulus": 200e9, "poissons_ratio": 0.3, "hardness": 2e9}
    film = {"youngs_modulus": 80e9, "poissons_ratio": 0.37, "hardness": 0.9e9}
    rough = {"asperity_height_deviation": 1e-7, "asperity_radius": 2e-5, "asperity_density": 1.2e10}
    coating = {"material": film, "thickness": 3e-7, "bodies": "first"}
    contact = st.Contact(first=body, second=body, roughness=rough, nominal_area=1e-6, work_of_adhesion=0.01, coating=coating)
    against = 1 / (0.91 / 200e9 + (1 - 0.37**2) / 80e9)
    assert contact.known("film_plasticity_index") == pytest.approx(against / 0.9e9 * np.sqrt(1e-7 / 2e-5), rel=1e-12)
    assert contact.known("film_stiffness") == pytest.approx(against / (200e9 / 1.82) / (3e-7 / np.sqrt(2e-12)), rel=1e-12)
    assert (
        st.Indices(theta=1, lam=1).known("film_stiffness") is None is st.Indices(theta=1, lam=1).known("film_plasticity_index")
    )
