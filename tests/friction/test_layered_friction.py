"""Tangential laws that know a film and its body as one: first yield, and peeling; single asperities and sums of them."""

import importlib
import math

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.interpolate import CubicSpline

import stiction as st
from refusals import refusal
from stiction.engine import summation
from stiction.engine.heights import gaussian
from stiction.engine.summation import scattered
from stiction.laws.film.layered import elastic
from stiction.laws.joining import Law, states
from stiction.laws.tangential.hamilton_1983 import shear_at_yield
from stiction.laws.tangential.shared.coated_strength import _norms_at
from stiction.records.registry import AsperityLaw, TangentialLaw, find, resolve_options
from stiction.solvers.layered.bodies import bodies_of
from stiction.solvers.layered.compliance import Layer
from stiction.solvers.layered.first_yield import ANGLES, PLACES, norms
from stiction.solvers.layered.shear import shear_compliance
from stiction.solvers.layered.stresses import Stresses
from stiction.solvers.layered.waves import CoatedBody
from stiction.solving.choice import Choice
from stiction.solving.problem import problem_of
from tables import REFERENCE, groups, without_adhesion

PLAIN = "greenwood_williamson_1966"
FILM = {"n_E": 1.0, "n_H": 1.0, "tau": 1.0, "film_aspect": 1.0}
OF_LIKE_BODIES = [("layered_first_yield", "hertz", "hamilton_1983"), ("layered_peeling", "jkr", "savkoor_briggs_1977")]


@pytest.mark.parametrize(("p", "felt"), [(0.0, 0.0), (1.0, 0.5), (1e14, 1.0), (1e16, 1.0), (1e40, 1.0)])
def test_norms_of_film_and_body_are_read_within_their_table(p, felt):
    """N of film and body at p = (a/t)^(1/2): as tabled at p = 0, 1 and without end, the body's as far as it is felt; what
    stands in memory behind the table is not looked at."""
    memory = np.full((3, PLACES.size, ANGLES.size), np.nan)
    memory[0], memory[1] = 2.0 + PLACES[:, None], 5.0 + PLACES[:, None]
    at = (p - 1.0) / (p + 1.0)
    weak, strong = (_norms_at(p, memory[:2], 7, strength, 1.0) for strength in (1e-3, 1e3))
    assert weak == pytest.approx((2.0 + at) / 1e-3, rel=1e-8)
    assert strong == pytest.approx(max((2.0 + at) / 1e3, felt * (5.0 + at)), rel=1e-8)


def joined(asperity, tangential, given, **options):
    """The elastic segment of the film law with a tangential law, at its own groups."""
    law = find(asperity, AsperityLaw)
    whole = Law(law, find(tangential, TangentialLaw), resolve_options([law], options))
    return whole.join(elastic(given.resolved(), whole), given, body="film")


def forces(regime, u):
    """Resistance (n,) at the coordinates u (n,)."""
    return states(regime, u)[:, 4:].sum(axis=1)


def sums(given, tangential, asperity, film="layered", h=(2.0, 1.0, 0.0, -1.0)):
    choice = Choice(PLAIN, asperity, tangential, film)
    return problem_of(given, choice).on_grid(np.array(h))["friction_force"]


@pytest.mark.parametrize(("key", "asperity", "parent"), OF_LIKE_BODIES)
def test_ends(key, asperity, parent):
    """No film, one of the body's own material, and one without end, in its own groups times n_E: the half-space's law."""
    rng, n = np.random.default_rng(5), 6
    given = {
        "theta": 10.0 ** rng.uniform(0, 3, n),
        "lam": 10.0 ** rng.uniform(1, 4, n),
        "nu": 0.25,
        "n_E": 6.0,
        "n_H": 1.5,
        "tau": 1.0,
    }
    none = groups(**given | {"tau": 0.0, "film_aspect": 0.0})
    like = groups(
        **given | {"n_E": 1.0, "n_H": 1.0, "film_aspect": 10.0 ** rng.uniform(-2, 2, n), "film_nu": 0.25, "layer_nu": 0.25}
    )
    thick = groups(
        **given | {"tau": 1e9, "film_aspect": 1e9, "film_nu": 0.4, "layer_nu": 0.4, "film_K_beta": 8 / 3 * 1.6 / 0.6}
    )
    for one, half_space, unit in ((none, none.substrate(), 1.0), (like, like.substrate(), 1.0), (thick, thick.film(), 6.0)):
        expected = unit * sums(half_space, parent, asperity, None)
        assert (expected > 0.0).all()
        assert_allclose(sums(one, key, asperity), expected, rtol=6e-3 if key == "layered_first_yield" else 1e-5)


@pytest.mark.parametrize(("n_E", "n_H", "aspect"), [(0.1, 0.3, 0.4), (0.1, 3.0, 0.02), (6.0, 1.0, 1.0), (6.0, 10.0, 0.1)])
def test_first_yield_of_one_asperity(n_E, n_H, aspect):
    """The traction under which the von Mises stress of film or body, solved at this very radius, is its yield stress; nothing
    from where the load alone makes it so."""
    eta, k, nu = 0.4, 2.8, 0.3
    given = without_adhesion(groups(**FILM | {"n_E": n_E, "n_H": n_H, "film_aspect": aspect}, nu=nu, hardness_to_yield=k))
    given = given.with_changes(hardness_group=np.array([eta]))
    regime = joined("hertz", "layered_first_yield", given)
    end = regime.branch[0, 0]
    for share in (0.15, 0.5, 0.8, 0.95):
        u = np.array([share * end])
        _, _, load, area, _, _ = states(regime, u)[0]
        radius = math.sqrt(area) / aspect
        whole = Stresses((Layer.of(1.0, n_E, nu, nu),), CoatedBody(n_E, nu, nu), radius)
        mean = k * load / (eta * area)  # over the body's yield stress
        traction = k * forces(regime, u)[0] / (eta * area)
        direction = np.array([math.atan2(traction, mean)])
        *film, body = norms(whole, direction)[:, 0] * math.hypot(mean, traction)
        assert max(max(film) / n_H, body) == pytest.approx(1.0, rel=1e-2)
    assert forces(regime, np.array([1.001 * end]))[0] == 0.0
    assert forces(regime, np.array([0.9999 * end]))[0] > 0.0


def test_hamilton_beside_it():
    """On a film like its body the curve of one asperity, kinks and all, is Hamilton's: by his stresses, place by place."""
    eta, k, nu = 1.3, 2.5, 0.3
    given = without_adhesion(groups(**FILM, nu=nu, hardness_to_yield=k)).with_changes(hardness_group=np.array([eta]))
    regime = joined("hertz", "layered_first_yield", given)
    end = regime.branch[0, 0]
    x, z = np.meshgrid(np.linspace(-1.0, 1.0, 401), np.linspace(0.0, 0.8, 161))
    for share in (0.3, 0.7, 0.9, 0.97, 0.99):
        u = np.array([share * end])
        _, _, load, area, _, _ = states(regime, u)[0]
        expected = shear_at_yield(1.5 * k * load / (eta * area), nu, x, z).min()
        assert 1.5 * k * forces(regime, u)[0] / (eta * area) == pytest.approx(expected, rel=2e-3, abs=1e-2)


@pytest.mark.parametrize(("n_E", "aspect", "zeta"), [(0.1, 1.0, 1.0), (8.0, 0.5, 0.3), (0.3, 3.0, 1.0)])
def test_peeling_by_trying_radii(n_E, aspect, zeta, monkeypatch):
    """The largest shear force with a radius of equilibrium at the load that was there, by the energies themselves: at every
    radius that of the sphere with a punch on top, by the table's own method, and of the tangential spring, by differences."""
    monkeypatch.syspath_prepend(str(REFERENCE))
    independent = importlib.import_module("make_layered")
    theta, nu = 3.0, 0.3
    given = groups(theta=theta, nu=nu, **FILM | {"n_E": n_E, "film_aspect": aspect}, peeling=zeta)
    regime = joined("jkr", "layered_peeling", given)
    (bodies,), _ = bodies_of(given.resolved())
    coarse = np.linspace(0.4, 4.8, 30)  # over sqrt(R sigma)
    load, _, stiffness, _ = zip(*(independent.solve(1.0, n_E, nu, nu, one / aspect) for one in coarse), strict=True)
    a = np.linspace(0.4, 4.8, 30001)
    P_H = CubicSpline(coarse, n_E * np.array(load) * coarse**3)(a)  # over K R^(1/2) sigma^(3/2)
    S = CubicSpline(coarse, np.array(stiffness) * 1.5 * n_E * coarse)
    S_T = CubicSpline(coarse, [8.0 * one / shear_compliance(bodies, one / aspect)[0] for one in coarse])  # over K
    for u in regime.edges[0, 0] * np.array([1.1, 1.25, 1.4]):
        _, _, P, _, _, _ = states(regime, np.array([u]))[0]
        # Work of adhesion 1/theta on the area pi a^2: d/da of the energies released, at fixed forces.
        normal = (P_H - P) ** 2 * S(a, 1) / (2.0 * S(a) ** 2)
        left = 2.0 * math.pi * a / theta - normal
        square = 2.0 * left * S_T(a) ** 2 / (zeta * S_T(a, 1))
        assert forces(regime, np.array([u]))[0] == pytest.approx(math.sqrt(square.max()), rel=2e-3)


def test_peeling_of_a_contact_drawn_apart():
    """Nothing holds where the load alone tears it off; on either side of it something does, as smooth as it comes."""
    given = groups(theta=3.0, **FILM | {"n_E": 0.2})
    regime = joined("jkr", "layered_peeling", given, branch="unloading")
    u = np.linspace(regime.edges[0, 0], 3.0, 2000)
    loads = np.array([states(regime, np.array([one]))[0, 2] for one in u])
    held = np.array([forces(regime, np.array([one]))[0] for one in u])
    torn = loads.argmin()
    assert 0 < torn and held.argmin() == pytest.approx(torn, abs=2) and held.min() < 2e-3 * held.max()
    assert held[0] > 0.0 and (np.diff(held[torn + 3 :]) > 0.0).all()
    inner = regime.edges[0, 1:-1]
    assert np.abs(inner - u[torn]).min() < 0.01


@pytest.mark.parametrize(("key", "asperity"), [one[:2] for one in OF_LIKE_BODIES])
def test_sums_converge(key, asperity, monkeypatch):
    """The engine's nodes against 160, to what the records say."""
    rng, n = np.random.default_rng(11), 200
    which = rng.integers(0, 3, n)
    given = groups(
        theta=10.0 ** rng.uniform(0, 3, n), lam=10.0 ** rng.uniform(0, 4, n), n_E=np.array([0.1, 2.0, 8.0])[which],
        n_H=10.0 ** rng.uniform(-0.5, 0.7, n), tau=rng.uniform(0.1, 3.0, n), film_aspect=10.0 ** rng.uniform(-2, 1, n),
        peeling=rng.uniform(0.1, 1.0, n),
    )  # fmt: skip
    h = rng.uniform(-3.0, 4.0, n)
    found = problem_of(given, Choice(PLAIN, asperity, key, "layered"))
    shipped = scattered(found.regimes, h, gaussian()).sum(axis=0)
    monkeypatch.setattr(summation, "_COUNTS", np.array([160, 160]))
    monkeypatch.setattr(summation, "_RULES", summation._make_rules(np.array([160, 160])))
    best = scattered(found.regimes, h, gaussian()).sum(axis=0)
    assert_allclose(shipped[:, 3:].sum(axis=1), best[:, 3:].sum(axis=1), rtol=find(key, TangentialLaw).accuracy)


@pytest.mark.parametrize(("key", "asperity", "parent"), OF_LIKE_BODIES)
def test_what_they_go_with(key, asperity, parent):
    """With films that solve film and body as one, with bare contacts, and with films of half-spaces as the half-space's law."""
    given = groups(theta=20.0, lam=50.0, **FILM | {"n_E": 0.3, "n_H": 0.5})
    assert_allclose(sums(given, key, asperity, "sequential"), sums(given, parent, asperity, "sequential"), rtol=1e-12)
    with refusal("tangential"):
        sums(given, parent, asperity)
    with refusal("tangential"):
        sums(given, key, asperity, "finkin_1969")


def test_two_coated_bodies():
    """Alike, they are one against a rigid plane between them; unlike, the weaker decides."""
    both = {"films": 2.0, "coated_share": 0.5, "coated_nu": 0.3, "counter_nu": 0.3, "layer_nu": 0.3}
    for key, asperity, _ in OF_LIKE_BODIES:
        one = groups(theta=20.0, lam=50.0, **FILM | {"n_E": 4.0, "film_aspect": 0.5})
        two = groups(theta=20.0, lam=50.0, **FILM | {"n_E": 4.0, "film_aspect": 1.0}, **both)
        assert_allclose(sums(two, key, asperity), sums(one, key, asperity), rtol=1e-9)
    unlike = groups(theta=20.0, lam=50.0, **FILM | {"n_E": 4.0}, **both | {"coated_share": 0.3, "counter_nu": 0.2})
    swapped = groups(theta=20.0, lam=50.0, **FILM | {"n_E": 4.0}, **both | {"coated_share": 0.7, "coated_nu": 0.2})
    swapped = swapped.with_changes(nu=unlike.nu)
    for key, asperity, _ in OF_LIKE_BODIES:
        assert_allclose(sums(unlike, key, asperity), sums(swapped, key, asperity), rtol=1e-9)


def test_a_stiff_film_cracks_under_little_load():
    """Steel under 0.5 um of a hard, stiff film: the asperity law says elastic, and the film is strained beyond its yield
    stress."""
    rough = st.Roughness(asperity_height_deviation="48 nm", asperity_radius="50 um", asperity_density="1.7e10 1/m^2")
    film = {"youngs_modulus": "600 GPa", "poissons_ratio": 0.2, "hardness": "12 GPa"}
    coating = st.Coating(material=film, thickness="0.5 um", bodies="first")
    steel = "hardened_steel_52100"
    coated = st.Contact(
        first=steel, second=steel, work_of_adhesion=0.0, nominal_area="1 mm^2", roughness=rough, coating=coating
    )
    found = st.solve(coated, load="1 N", model=PLAIN, film="layered", tangential="layered_first_yield")
    assert 0.0 < float(found["friction_coefficient"]) < 10.0
    assert {"layered", "layered_first_yield"} <= {part for name in ("film", "tangential") for part in [found.attrs.get(name)]}
