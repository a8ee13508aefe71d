"""Films on one body and on both: moduli of two bodies in series, against sums in SI units that are written out here.

Nothing of the package is used on the expected side: the composite of Gao, Chiu and Lee is restated from their equations, the
asperity is Hertz's, and heights are summed by trapezoids.
"""

import numpy as np
import pytest

import stiction as st
from stiction.contact.indices import Groups
from stiction.laws.composite.gao_chiu_lee_1992 import modulus_share
from stiction.laws.film.shared.graded_law import stiffness
from stiction.laws.film.shared.two_bodies import TwoBodies
from stiction.quantities.errors import InputError

SIGMA, RADIUS, DENSITY, AREA = 1e-7, 2e-5, 1e10, 1e-8
ROUGH = {"asperity_height_deviation": SIGMA, "asperity_radius": RADIUS, "asperity_density": DENSITY}
HARD = 1e13  # Pa: nothing yields
STIFF = {"youngs_modulus": 200e9, "poissons_ratio": 0.28, "hardness": HARD}
COMPLIANT = {"youngs_modulus": 60e9, "poissons_ratio": 0.41, "hardness": HARD}
RIGID = {"youngs_modulus": 1e20, "poissons_ratio": 0.3, "hardness": HARD}
PLAIN = {"model": "greenwood_williamson_1966", "tangential": "bowden_tabor_1943"}


def contact(first, second, film, thickness, bodies, **more):
    coating = {"material": film, "thickness": thickness, "bodies": bodies}
    given = {"interfacial_shear_strength": 1e7, "nominal_area": AREA, "roughness": ROUGH, "coating": coating}
    return st.Contact(first=first, second=second, **given | more)


def plane(body):
    """E' = E/(1 - nu^2)."""
    return body["youngs_modulus"] / (1 - body["poissons_ratio"] ** 2)


def gao(film, body, xi):
    """E' of a coated half-space [Pa] at xi = t/a; I0, I1 and nu as in the paper."""
    ones, nu_f, nu_s = 2 / np.pi * np.arctan(xi), film["poissons_ratio"], body["poissons_ratio"]
    log = np.log((1 + xi**2) / xi**2)
    share = ones + xi / np.pi * log
    nu = 1 - (1 - nu_s) * (1 - nu_f) / (1 - (1 - share) * nu_f - share * nu_s)
    weight = ones + ((1 - 2 * nu) * xi * log - xi / (1 + xi**2)) / (2 * np.pi * (1 - nu))
    return plane(body) + (plane(film) - plane(body)) * weight


def summed(one, d):
    """N A_n times the integral of a load [N] of displacements [m] over Gaussian heights."""
    omega = np.linspace(0.0, 9 * SIGMA, 200001)[1:]
    weight = np.exp(-(((d + omega) / SIGMA) ** 2) / 2) / (np.sqrt(2 * np.pi) * SIGMA)
    return DENSITY * AREA * np.trapezoid(one(omega) * weight, omega)


def layered(first, second, film, thickness, bodies):
    """Load [N] of one asperity whose contact has the sum of both compliances."""

    def load(omega):
        a = np.sqrt(RADIUS * omega)
        half = thickness / 2 if bodies == "both" else thickness
        compliance = sum(
            1 / (gao(film, body, half / a) if bodies in (name, "both") else plane(body))
            for name, body in (("first", first), ("second", second))
        )
        return 4 / 3 / compliance * np.sqrt(RADIUS) * omega**1.5

    return load


MODULI = (2e9, 60e9, 1e12)


@pytest.mark.parametrize("bodies", ["both", "first", "second"])
@pytest.mark.parametrize("modulus", MODULI)
def test_halling_has_both_bodies_in_series(bodies, modulus):
    film = {"youngs_modulus": modulus, "poissons_ratio": 0.2, "hardness": HARD}
    for thickness in (3e-8, 4e-7, 5e-6):
        given = STIFF, COMPLIANT, film, thickness, bodies
        found = st.solve(contact(*given), separation=0.5 * SIGMA, film="halling_1979", **PLAIN)
        assert float(found["load"]) == pytest.approx(summed(layered(*given), 0.5 * SIGMA), rel=2e-6)


@pytest.mark.parametrize("bodies", ["both", "first", "second"])
def test_the_graded_film_has_both_bodies_in_series(bodies):
    """Hardly any adhesion. It takes the mean of Poisson's ratios instead, which are alike here."""
    first, second = ({**body, "poissons_ratio": 0.3} for body in (STIFF, COMPLIANT))
    for modulus in MODULI:
        film = {"youngs_modulus": modulus, "poissons_ratio": 0.3, "hardness": HARD}
        given = first, second, film, 4e-7, bodies
        found = st.solve(
            contact(*given, work_of_adhesion=1e-9), separation=0.5 * SIGMA, model="soft_coating_2015", film="graded"
        )
        assert float(found["load"]) == pytest.approx(summed(layered(*given), 0.5 * SIGMA), rel=1e-5)


@pytest.mark.parametrize("bodies", ["both", "first", "second"])
def test_a_film_like_its_bodies_is_not_felt(bodies):
    with_film = contact(STIFF, STIFF, STIFF, 4e-7, bodies)
    bare = st.Contact(first=STIFF, second=STIFF, nominal_area=AREA, roughness=ROUGH, interfacial_shear_strength=1e7)
    found = st.solve(with_film, separation=0.0, film="halling_1979", **PLAIN)
    assert float(found["load"]) == pytest.approx(float(st.solve(bare, separation=0.0, **PLAIN)["load"]), rel=1e-9)


def foundation(modulus, nu, thickness):
    """Load [N] of one asperity on a layer: its confined modulus M times the strain."""
    confined = modulus * (1 - nu) / ((1 + nu) * (1 - 2 * nu))
    return lambda omega: np.pi * confined * RADIUS * omega**2 / thickness


@pytest.mark.parametrize("bodies", ["both", "first", "second"])
@pytest.mark.parametrize("body", [RIGID, COMPLIANT], ids=["rigid", "compliant"])
def test_finkin_takes_the_modulus_of_the_layer_itself(bodies, body):
    """On one body or both, the same total thickness carries the same: as layers in series, or as one."""
    film = {"youngs_modulus": 1e8, "poissons_ratio": 0.45, "hardness": 1e7}
    for other in (body, RIGID):
        found = st.solve(contact(body, other, film, 4e-7, bodies), separation=0.5 * SIGMA, film="finkin_1969", **PLAIN)
        assert float(found["load"]) == pytest.approx(summed(foundation(1e8, 0.45, 4e-7), 0.5 * SIGMA), rel=1e-6)


def test_two_incompressible_layers_do_not_shear_where_they_meet():
    """Two layers of t/2, each free to slip at the plane of symmetry: t^3/12 of flow for a gradient and a modulus of 1, by
    integrating the velocity of each; as one layer of t that sticks to both."""
    z = np.linspace(0.0, 0.5, 100001)
    velocity = (0.5**2 - z**2) / 2  # at rest on the body, z = 1/2, without shear on the plane of symmetry, z = 0
    assert 2 * np.trapezoid(velocity, z) == pytest.approx(1 / 12, rel=1e-9)
    film = {"youngs_modulus": 1e8, "poissons_ratio": 0.49, "hardness": 1e7}
    loads = {
        (bodies, bound): float(
            st.solve(contact(RIGID, RIGID, film, 4e-8, bodies), separation=0.0, film="finkin_1969", bound=bound, **PLAIN)[
                "load"
            ]
        )
        for bodies in ("both", "first")
        for bound in ("incompressible", "incompressible_frictionless")
    }
    assert loads["both", "incompressible_frictionless"] == pytest.approx(loads["both", "incompressible"], rel=1e-12)
    assert loads["both", "incompressible"] == pytest.approx(loads["first", "incompressible"], rel=1e-9)
    assert loads["first", "incompressible_frictionless"] == pytest.approx(loads["first", "incompressible"] / 4, rel=1e-12)


def test_slope_and_bounds_of_the_stiffness():
    """The slope by differences; between its bounds everywhere, also where the film is between two unlike bodies."""
    rng = np.random.default_rng(3)
    n = 300
    share, film = rng.uniform(0.02, 0.98, n), 10.0 ** rng.uniform(-2, 2, n)
    films = rng.integers(1, 3, n).astype(float)
    nus = rng.uniform(0.0, 0.49, (3, n))
    bodies = TwoBodies(film * share, film * (1 - share), share, films, *nus)
    least, greatest = bodies.bounds()
    for i in range(n):
        nu = (nus[0, i] + nus[1, i]) / 2, (nus[0, i] + nus[2, i]) / 2
        row = (least[i], greatest[i], 0.7, film[i] * share[i], film[i] * (1 - share[i]), share[i], films[i], *nu)
        for u in 10.0 ** rng.uniform(-2, 2, 10):
            at, slope, _ = stiffness(u, row)
            assert least[i] * (1 - 1e-12) <= at <= greatest[i] * (1 + 1e-12)
            below, above = (stiffness(u * np.exp(step), row)[0] for step in (-1e-5, 1e-5))
            assert slope == pytest.approx((above - below) / 2e-5, rel=1e-6, abs=1e-8)
        weights = [modulus_share(0.7 * u * u, one)[0] for one in nu]
        compliance = share[i] / (1 + (film[i] * share[i] - 1) * weights[0])
        rest = (1 - share[i]) / (1 + (film[i] * (1 - share[i]) - 1) * weights[1]) if films[i] == 2 else 1 - share[i]
        assert at == pytest.approx(1 / (compliance + rest), rel=1e-12)


def test_groups_know_the_film_itself():
    """E'_f over E* from n_E, against the moduli."""
    film = {"youngs_modulus": 5e9, "poissons_ratio": 0.2, "hardness": 1e9}
    for bodies in ("both", "first", "second"):
        groups, _ = Groups.of(contact(STIFF, COMPLIANT, film, 1e-7, bodies).indices())
        together = 1 / (1 / plane(STIFF) + 1 / plane(COMPLIANT))
        assert groups.film_modulus == pytest.approx(plane(film) / together, rel=1e-12)
    assert Groups.of(st.Indices(theta=1, lam=1, n_E=0.3, n_H=1, tau=1))[0].film_modulus == pytest.approx(0.3, rel=1e-15)
    alike = st.Indices(theta=1, lam=1, n_E=0.3, n_H=1, tau=1, films=2)
    assert Groups.of(alike)[0].film_modulus == pytest.approx(0.6, rel=1e-15)


@pytest.mark.parametrize(
    ("more", "line"),
    [({"films": 1.5}, "films: 1.5; allowed: 1 or 2"),
     ({"films": 2, "coated_share": 1.0}, "coated_share: 1.0; allowed: below 1"),
     ({"coated_share": 0.5, "n_E": 2.5}, "n_E: 2.5; allowed: at most 1/(1 - coated_share)")],
)  # fmt: skip
def test_films_that_cannot_be(more, line):
    with pytest.raises(InputError) as caught:
        st.Indices(**{"theta": 1, "lam": 1, "n_E": 0.3, "n_H": 1, "tau": 1} | more)
    assert str(caught.value).startswith(line)
