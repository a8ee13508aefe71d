"""The parts that `solve` reports, by state, by body, by limit and beyond the film: read from its result, and compared with sums
that know nothing of how the package puts them together. Closed forms are those of exponential heights of density exp(-(z + 1)):
Int f(w) phi(h + w) dw = exp(-(h + 1)) Int f(w) exp(-w) dw."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.special import gamma, gammaincc

import stiction as st
from stiction.laws.asperity import hertz, jkr
from stiction.laws.joining import coordinates_at_area
from tables import FILM_COLUMNS, GROUP_COLUMNS, column, groups, read

PARTS = [row for row in read("parts.csv") if row["h"]]
STATES = ("elastic", "plastic")


def upper(power, low, high=math.inf):
    """Int_low^high w^power exp(-w) dw."""
    end = gammaincc(power + 1.0, high) if high < math.inf else 0.0
    return gamma(power + 1.0) * (gammaincc(power + 1.0, low) - end)


# ---- the 2015 model against reference/parts.csv


def of_row(row):
    """The row's numbers, and what `solve` says of it."""
    value = {name: float(text) for name, text in row.items() if text}
    titles = GROUP_COLUMNS | FILM_COLUMNS
    indices = st.Indices(**{name: value[title] for name, title in titles.items() if title in value})
    return value, st.solve(indices, separation=value["h"])


@pytest.mark.parametrize("row", PARTS, ids=lambda row: f"{row['theta']}/{row['lambda']}/{row['n_E'] or 'bare'}")
def test_parts_of_the_paper_s_model(row):
    """Sums by group of asperities at 30 digits: what `solve` says of each state, body and limit is made of whole groups."""
    value, found = of_row(row)
    bodies = ("film", "substrate")
    assert_allclose(found["touching_asperities"], value["touching_asperities"], rtol=1e-10)
    size = abs(value["load"]) + sum(abs(value[f"{body}_{state}_load"]) for body in bodies for state in STATES)
    size += abs(value["film_held_load"])
    for state in STATES:
        expected = sum(value[f"{body}_{state}_load"] for body in bodies)
        assert_allclose(found[f"load_{state}"], expected, rtol=0.0, atol=1e-10 * size)
    assert_allclose(found["contact_area_elastic"] + found["contact_area_plastic"], value["area"], rtol=1e-10)
    limits = {}
    resisting = "film_elastic", "film_held", "substrate_elastic"
    for limit, name in (("slip", "friction_slip_limited"), ("yield", "friction_yield_limited")):
        limits[limit] = [value.get(f"{group}_friction_{limit}", 0.0) for group in resisting]
        assert_allclose(found[name], sum(limits[limit]), rtol=1e-10, atol=1e-10 * value["friction"])
    assert_allclose(found["friction_force"], value["friction"], rtol=1e-10)
    assert ("load_film" in found) == ("n_E" in value)
    if "n_E" not in value:
        return
    by_group = np.add(limits["slip"], limits["yield"])
    parts = {"film": ("film_elastic", "film_plastic", "film_held"), "substrate": ("substrate_elastic", "substrate_plastic")}
    for body, names in parts.items():
        assert_allclose(found[f"load_{body}"], sum(value[f"{name}_load"] for name in names), rtol=0.0, atol=1e-10 * size)
    assert_allclose(found["friction_film"], by_group[0] + by_group[1], rtol=1e-10, atol=1e-10 * value["friction"])
    assert_allclose(found["friction_substrate"], by_group[2], rtol=1e-10, atol=1e-10 * value["friction"])


def test_the_rows_have_something_of_every_part():
    """Else what is swapped or left out would not be seen."""
    for limit in ("slip", "yield"):
        sums = [sum(float(row[name] or 0.0) for name in row if name.endswith(f"friction_{limit}")) for row in PARTS]
        assert max(sums) > 0.0
    coated = [row for row in PARTS if row["n_E"]]
    assert max(column(coated, "film_held_load")) > 0.0 and max(column(coated, "substrate_elastic_asperities")) > 0.0


# ---- by state, in closed form


@pytest.mark.parametrize("h", (-0.5, 1.5))
def test_elastic_and_plastic_parts(h):
    """Theory 7, theta -> inf at fixed eta: P = w^(3/2) and x = w up to w1 = eta^2, then P = 2 eta w and x = 2 w."""
    eta, theta = 0.9, 1e30
    indices = st.Indices(theta=theta, lam=eta**4 * theta**2 / (18.0 * math.pi**2))
    found = st.solve(indices, separation=h, heights="exponential")
    expected = {
        "touching_asperities": 1.0,
        "load_elastic": upper(1.5, 0.0, eta**2),
        "load_plastic": 2.0 * eta * upper(1.0, eta**2),
        "contact_area_elastic": upper(1.0, 0.0, eta**2),
        "contact_area_plastic": 2.0 * upper(1.0, eta**2),
    }
    for name, value in expected.items():
        assert_allclose(found[name], math.exp(-(h + 1.0)) * value, rtol=1e-9, err_msg=name)


def test_elastic_plastic_parts():
    """Kogut & Etsion 2002, over critical interferences w_c: P/P_c = 1.03 x^1.425 and A/A_c = 0.93 x^1.136 from 1 to 6, then
    1.40 x^1.263 and 0.94 x^1.146 to 110, beyond which is next to nothing here; below 1 as Hertz has it."""
    nu, theta, lam, h = 0.3, 40.0, 200.0, 0.0
    eta = math.sqrt(math.pi) * (18.0 * lam) ** 0.25 / math.sqrt(theta)
    w_c = (2.0 / 3.0 * (0.454 + 0.41 * nu) * eta) ** 2
    assert 110.0 * w_c > 30.0
    found = st.solve(
        st.Indices(theta=theta, lam=lam, nu=nu), separation=h, heights="exponential",
        model="greenwood_williamson_1966", asperity="kogut_etsion_2002",
    )  # fmt: skip

    def fitted(factor, power, low, high, unit):
        return factor * w_c ** (unit - power) * upper(power, low * w_c, high * w_c)

    expected = {
        "load_elastic": upper(1.5, 0.0, w_c),
        "contact_area_elastic": upper(1.0, 0.0, w_c),
        "load_elastic_plastic": fitted(1.03, 1.425, 1.0, 6.0, 1.5) + fitted(1.40, 1.263, 6.0, 110.0, 1.5),
        "contact_area_elastic_plastic": fitted(0.93, 1.136, 1.0, 6.0, 1.0) + fitted(0.94, 1.146, 6.0, 110.0, 1.0),
    }
    for name, value in expected.items():
        assert_allclose(found[name], math.exp(-(h + 1.0)) * value, rtol=1e-9, err_msg=name)


# ---- films


@pytest.mark.parametrize("aspect", (0.5, 1.1, 1.5))
def test_shares_beyond_the_film(aspect):
    """Hertz's asperities on a film of thickness tau sigma = 2 sigma and modulus n_E: the film carries n_E w^(3/2) up to w = tau
    and what it did there beyond, the substrate (w - tau)^(3/2). The contact radius is the film's thickness at w = aspect^2.
    Friction is of the interface, and goes with the area w."""
    tau, n_E, h, bound = 2.0, 0.4, 0.5, aspect**2
    indices = st.Indices(theta=1e8, lam=1e12, n_E=n_E, n_H=1.0, tau=tau, film_aspect=aspect, film_nu=0.3, shear_strength=0.1)
    found = st.solve(
        indices, separation=h, heights="exponential", model="greenwood_williamson_1966", film="sequential",
        tangential="bowden_tabor_1943",
    )  # fmt: skip
    film, held, substrate = n_E * upper(1.5, 0.0, tau), n_E * tau**1.5 * math.exp(-tau), gamma(2.5) * math.exp(-tau)
    beyond = n_E * upper(1.5, min(bound, tau), tau)
    touching = math.exp(-(h + 1.0))
    assert_allclose(found["load_film"], touching * (film + held), rtol=1e-10)
    assert_allclose(found["load_substrate"], touching * substrate, rtol=1e-10)
    assert_allclose(found["touching_asperities"], touching, rtol=1e-10)
    assert_allclose(found["contact_area"], touching, rtol=1e-10)
    assert_allclose(found["load_share_beyond_film"], beyond / (film + held + substrate), rtol=1e-10, atol=1e-15)
    assert_allclose(found["friction_share_beyond_film"], (1.0 + bound) * math.exp(-bound), rtol=1e-10)


@pytest.mark.parametrize("law", (hertz, jkr))
def test_the_coordinate_of_a_contact_area(law):
    """Areas over pi R sigma: x = w = u^2 of Hertz, x = u^4 of Johnson, Kendall & Roberts; to the last digits, near and far."""
    power = 2 if law is hertz else 4
    area = np.array([0.7, 3.0, 40.0, 9e4])
    options = {} if law is hertz else {"branch": "loading"}
    (segment,) = law.RECORD.segments(groups(np.full(4, 30.0)), **options)
    found = coordinates_at_area(segment, area)
    assert_allclose(found, area ** (1.0 / power), rtol=1e-14)
    nearer = coordinates_at_area(segment, 1e-9)  # nowhere that small, of JKR on loading
    assert_allclose(nearer, 10 ** (-4.5) if law is hertz else segment.edges[:, 0], rtol=1e-14)
