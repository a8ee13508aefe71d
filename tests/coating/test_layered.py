"""The film law `layered`: the exact sphere as the engine sums it, adhesion by energy, yield, and what it becomes in the end."""

import importlib
import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

import stiction as st
from refusals import outside, refusal
from stiction.engine import summation
from stiction.engine.heights import gaussian
from stiction.engine.summation import scattered
from stiction.laws.film.layered import elastic, regimes
from stiction.laws.film.shared import layered_rows
from stiction.laws.film.shared.layered_rows import coefficients
from stiction.laws.film.shared.layered_yield import Hardness, cut_at_yield
from stiction.laws.joining import Law, coordinates, coordinates_at_area, normal_states
from stiction.records.registry import AsperityLaw, composites_of, find, of_kind, resolve_options
from stiction.solvers.layered.compliance import Layer
from stiction.solvers.layered.curves import curves
from stiction.solvers.layered.sphere import respond
from stiction.solvers.layered.table import curves_of_films
from stiction.solving.choice import Choice
from stiction.solving.problem import problem_of
from tables import REFERENCE, column, groups, random_others, read

PLAIN = "greenwood_williamson_1966"
FILM = {"n_E": 1.0, "n_H": 1.0, "tau": 1.0}
LAWS = [key for key, law in of_kind(AsperityLaw).items() if "Hertz's shape" in law.traits]
each_law = pytest.mark.parametrize("key", LAWS)


def law_of(key, **options):
    law = find(key, AsperityLaw)
    return Law(law, None, resolve_options([law], options))


def rows_as_groups(rows):
    """The table's bodies with a film of the thickness sqrt(R sigma): then a/t is u^2."""
    share, ratio = column(rows, "share"), column(rows, "ratio")
    n_E = share * ratio + 1.0 - share
    nu, nu_below = column(rows, "nu"), column(rows, "nu_below")
    given = FILM | {"n_E": n_E, "film_aspect": 1.0, "film_nu": nu, "layer_nu": nu, "coated_nu": nu_below}
    return groups(nu=nu_below, coated_share=share * ratio / n_E, **given)


def random_contacts(rng, n, **fixed):
    """Groups of n contacts, of asperities that yield somewhere on the way."""
    decades = lambda low, high: 10.0 ** rng.uniform(low, high, n)  # noqa: E731
    drawn = {"theta": decades(0, 3), "lam": decades(-1, 4), "nu": rng.uniform(0.1, 0.49, n)}
    drawn |= {"hardness_to_yield": rng.uniform(1.8, 3.0, n), "n_E": decades(-1.9, 1.9), "n_H": decades(-1, 1)}
    drawn |= {"film_nu": rng.uniform(0.0, 0.49, n), "tau": rng.uniform(0.0, 4.0, n), "film_aspect": decades(-1, 1)}
    return groups(**random_others(rng, n) | drawn | fixed)


def test_area_at_load_and_load_at_approach():
    """Against another solution of the integral equation: 1 %, which is the aim; 0.5 % is what is found."""
    rows = read("layered.csv")
    segment = elastic(rows_as_groups(rows).resolved(), law_of("hertz"))
    u, n_E = np.sqrt(column(rows, "radius")), rows_as_groups(rows).n_E
    w, load = column(rows, "approach") * u**4, n_E * column(rows, "load") * u**6
    at_approach = normal_states(segment, coordinates(segment, w))
    assert_allclose(at_approach[:, 2], load, rtol=5e-3)
    here = normal_states(segment, u)
    # Where the load is P: dA/A = (2/(3 + e)) dP/P, never more than twice the error of the load.
    assert_allclose(here[:, 2], load, rtol=2.5e-3)
    assert_allclose(here[:, 0], w, rtol=5e-3)
    step = 1e-5
    wider, narrower = normal_states(segment, u * (1.0 + step)), normal_states(segment, u * (1.0 - step))
    stiffness = (wider[:, 2] - narrower[:, 2]) / (wider[:, 0] - narrower[:, 0])
    assert_allclose(stiffness, 1.5 * n_E * column(rows, "stiffness") * u**2, rtol=5e-3)
    assert_allclose((wider[:, 0] - narrower[:, 0]) / (2.0 * step * u), here[:, 1], rtol=1e-8)


def test_table_of_materials():
    """The curves that are interpolated between materials, against those of the very pair, at all radii."""
    rng, z = np.random.default_rng(17), np.linspace(-1.0, 1.0, 101)
    ratio, excess = 10.0 ** rng.uniform(-2.2, 2.2, 24), rng.uniform(-1.0, 1.0, 24)
    share = np.where(rng.random(24) < 0.5, 1.0, rng.uniform(0.01, 1.0, 24))
    found = curves_of_films(share, ratio, excess)
    for i in range(24):
        exact = curves((Layer(share[i], ratio[i], excess[i]),))
        difference = (1.0 - z**2) * np.polynomial.polynomial.polyval(z, (found[i] - exact).T)
        assert np.abs(difference).max(axis=1) == pytest.approx([0.0, 0.0, 0.0], abs=6e-3)


@each_law
@pytest.mark.parametrize("end", ["none", "thin", "like", "thick"])
def test_ends(key, end):
    """No film, a very thin one, one of the body's own material: the bare asperity law; a very thick one: that law in the film's
    groups, times n_E."""
    film = {
        "none": {"tau": 0.0, "film_aspect": 0.0},
        "thin": {"tau": 1e-9, "film_aspect": 1e-14},
        "like": {"n_E": 1.0, "n_H": 1.0},
        "thick": {"tau": 1e14, "film_aspect": 1e14},
    }
    given = random_contacts(np.random.default_rng(23), 30, **film[end])
    if end == "like":
        given = given.with_changes(film_nu=given.nu, layer_nu=given.nu)
    choice, h = Choice(PLAIN, key), np.linspace(-3.0, 4.0, 15)
    found = problem_of(given, replace(choice, film="layered")).on_grid(h)
    expected = problem_of(given.film() if end == "thick" else given.substrate(), choice).on_grid(h)
    unit = given.n_E[:, None] if end == "thick" else 1.0
    within = 1e-12 if end == "none" else 2e-6
    assert_allclose(found["contact_area"], expected["contact_area"], rtol=within)
    assert (np.abs(found["load"] - unit * expected["load"]) <= within * unit * np.abs(expected["load"]).max()).all()


def parts_of(key, given, hardness="bhattacharya_nix_1988"):
    """The elastic segment and those that follow, of this asperity law."""
    law, of_depth = law_of(key), Hardness(composites_of("hardness")[hardness], given, 2.0)
    first, following = cut_at_yield(elastic(given, law), law, given, of_depth, np.zeros(len(given)))
    return [first, *following]


@pytest.mark.parametrize(
    "key", [*LAWS, "zhao_maietta_chang_2000 jonsson_hogmark_1984", "zhao_maietta_chang_2000 kao_byrne_1981"]
)
def test_nothing_jumps_but_what_the_asperity_law_says(key):
    """Where one segment gives way to the next load, area and displacement go on, but for reported jumps; and so at w = tau."""
    given = random_contacts(np.random.default_rng(29), 200, lam=10.0 ** np.linspace(2.0, 5.0, 200)).resolved()
    segments = parts_of(key.split()[0], given, *key.split()[1:])
    reported = {jump.segment for jump in find(key.split()[0], AsperityLaw).jumps}
    for number, (before, after) in enumerate(itertools.pairwise(segments), start=1):
        there = (before.edges[:, -1] > before.edges[:, 0]) & (after.edges[:, -1] > after.edges[:, 0])
        end, start = normal_states(before, before.edges[:, -1])[there], normal_states(after, after.edges[:, 0])[there]
        assert there.any()
        assert_allclose(start[:, 0], end[:, 0], rtol=1e-7, atol=1e-9)
        if number not in reported:
            assert_allclose(start[:, 2:], end[:, 2:], rtol=1e-6, atol=1e-9)
    for segment in segments:
        u = coordinates(segment, given.tau)
        inside = (u > segment.edges[:, 0] * (1.0 + 1e-9)) & (u < segment.edges[:, -1] * (1.0 - 1e-9))
        near, far = (normal_states(segment, u * (1.0 + step))[inside, 2:] for step in (1e-12, -1e-12))
        assert_allclose(near, far, rtol=1e-7, atol=1e-9)


@each_law
def test_sums_converge(key, monkeypatch):
    """The engine's own nodes against 160, where films are thin and thick, hard and soft."""
    rng = np.random.default_rng(31)
    given, h = random_contacts(rng, 600, sharpness=1e-3), rng.uniform(-5.0, 5.0, 600)
    found = problem_of(given, Choice(PLAIN, key, film="layered"))
    shipped = scattered(found.regimes, h, gaussian()).sum(axis=0)
    monkeypatch.setattr(summation, "_COUNTS", np.array([160, 160]))
    monkeypatch.setattr(summation, "_RULES", summation._make_rules(np.array([160, 160])))
    best = scattered(found.regimes, h, gaussian()).sum(axis=0)
    assert_allclose(shipped[:, 2], best[:, 2], rtol=1e-7)
    size = np.abs(best[:, 1]) + given.theta ** (-1 / 3) * np.maximum(given.n_E, 1.0) * best[:, 2]
    assert (np.abs(shipped[:, 1] - best[:, 1]) <= 1e-7 * size).all()


@pytest.mark.parametrize(("n_E", "aspect"), [(0.1, 1.0), (8.0, 0.5), (0.3, 3.0)])
def test_adhesion_is_the_least_energy(n_E, aspect, monkeypatch):
    """Radius and load at a displacement against the least of elastic energy less work of adhesion, found by trying radii. At
    one radius the energy is that of the sphere without adhesion and of a flat punch on top, by the table's own method."""
    monkeypatch.syspath_prepend(str(REFERENCE))
    independent = importlib.import_module("make_layered")
    theta, nu = 3.0, 0.3
    a = np.linspace(0.02, 4.0, 4000)  # over sqrt(R sigma), E* of the substrate 1
    coarse = np.linspace(0.02, 4.0, 45)
    load, approach, stiffness, _ = zip(*(independent.solve(1.0, n_E, nu, nu, one / aspect) for one in coarse), strict=True)
    smooth = importlib.import_module("scipy.interpolate").CubicSpline
    P = smooth(coarse, n_E * np.array(load))(a) * a**3  # over K
    D = smooth(coarse, approach)(a) * a**2
    S = smooth(coarse, stiffness)(a) * 1.5 * n_E * a
    stored = np.concatenate([[0.0], np.cumsum(np.diff(D) * (P[1:] + P[:-1]) / 2.0)])
    segment = elastic(groups(theta=theta, nu=nu, film_aspect=aspect, **FILM | {"n_E": n_E}).resolved(), law_of("jkr"))
    for w in (0.3, 1.0, 2.5):
        energy = stored + P * (w - D) + S * (w - D) ** 2 / 2.0 - math.pi * a**2 / theta
        least = np.argmin(np.where(a > 0.8, energy, np.inf))  # narrower, the sphere would pass through the surface
        quadratic = np.polyfit(a[least - 20 : least + 21] - a[least], energy[least - 20 : least + 21], 2)
        best = a[least] - quadratic[1] / (2.0 * quadratic[0])
        _, _, found_load, area = normal_states(segment, coordinates(segment, w))[0]
        assert math.sqrt(area) == pytest.approx(best, rel=2e-3)
        expected = np.interp(best, a, P + S * (w - D))
        assert found_load == pytest.approx(expected, abs=3e-3 * np.interp(best, a, P))


def test_pull_off():
    """Of thick and of thin films, at any moduli: 3/2 pi gamma R at given load, as of any half-space (JKR 1971)."""
    n_E, theta = np.array([0.1, 0.1, 10.0, 10.0]), 2.0
    aspect = np.array([1e4, 1e-6, 1e4, 1e-6])
    given = groups(theta=theta, nu=0.3, film_aspect=aspect, n_g=0.7, **FILM | {"n_E": n_E}).resolved()
    segment = elastic(given, law_of("jkr", branch="unloading"))
    u = segment.edges[:, :1] * np.linspace(1.0, 4.0, 4000)
    loads = np.stack([normal_states(segment, column)[:, 2] for column in u.T], axis=1)
    assert_allclose(loads.min(axis=1), -1.5 * math.pi * 0.7 / theta, rtol=5e-3)


@pytest.mark.parametrize(("n_E", "aspect"), [(0.1, 0.5), (0.1, 2.0), (8.0, 0.5), (8.0, 2.0)])
def test_pull_off_between_is_where_no_radius_is_stable(n_E, aspect, monkeypatch):
    """Of films as thick as the contact is wide: the least load at which the energy of all, that of the load with it, has a
    least anywhere over the radius, by trying loads. Elastic solutions by the table's own method."""
    monkeypatch.syspath_prepend(str(REFERENCE))
    independent = importlib.import_module("make_layered")
    theta, nu = 3.0, 0.3
    coarse, a = np.linspace(0.05, 5.0, 40), np.linspace(0.3, 5.0, 9000)  # over sqrt(R sigma)
    load, approach, stiffness, _ = zip(*(independent.solve(1.0, n_E, nu, nu, one / aspect) for one in coarse), strict=True)
    smooth = importlib.import_module("scipy.interpolate").CubicSpline
    P, D = (smooth(coarse, one) for one in (n_E * np.array(load) * coarse**3, np.array(approach) * coarse**2))
    S = smooth(coarse, np.array(stiffness) * 1.5 * n_E * coarse)(a)
    stored = smooth(a, P(a) * D(a, 1)).antiderivative()(a)

    def holds(pull):
        w = D(a) + (pull - P(a)) / S
        energy = stored + P(a) * (w - D(a)) + S * (w - D(a)) ** 2 / 2.0 - math.pi * a**2 / theta - pull * w
        return ((energy[1:-1] < energy[:-2]) & (energy[1:-1] < energy[2:])).any()

    low, high = -3.0 * math.pi / theta, 0.0
    assert holds(high) and not holds(low)
    for _ in range(30):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if holds(middle) else (middle, high)
    segment = elastic(groups(theta=theta, nu=nu, film_aspect=aspect, **FILM | {"n_E": n_E}).resolved(), law_of("jkr"))
    u = np.linspace(0.55, 2.2, 600)
    least = min(normal_states(segment, np.array([one]))[0, 2] for one in u)
    assert least == pytest.approx(high, rel=5e-3)
    assert abs(least / (-1.5 * math.pi / theta) - 1.0) > 0.01  # not the limit


def test_other_adhesion():
    """DMT's is Hertz's less 2 pi gamma R; contact is made at w = 0 and lost where dw/du = 0."""
    given = random_contacts(np.random.default_rng(37), 50).resolved()
    u = np.linspace(0.3, 2.0, 50)
    plain, outer = (normal_states(elastic(given, law_of(key)), u) for key in ("hertz", "dmt"))
    assert_allclose(plain[:, 2] - outer[:, 2], 2.0 * math.pi * given.n_g / given.theta, rtol=1e-12, atol=1e-12)
    made, lost = (elastic(given, law_of("jkr", branch=branch)) for branch in ("loading", "unloading"))
    assert_allclose(normal_states(made, made.edges[:, 0])[:, 0], 0.0, atol=1e-12)
    last = normal_states(lost, lost.edges[:, 0])
    assert (last[:, 0] < 0.0).all() and (np.abs(last[:, 1]) < 1e-8).all() and lost.lowest == last[:, 0].min()


@pytest.mark.parametrize("key", ["zhao_maietta_chang_2000", "roy_chowdhury_ghosh_1994"])
def test_where_it_yields(key):
    """The mean pressure there is the law's own fraction of the hardness at that depth: of Bhattacharya & Nix, by hand."""
    given = random_contacts(np.random.default_rng(41), 100).resolved()
    whole, first = elastic(given, law_of(key)), parts_of(key, given)[0]
    _, _, load, area = normal_states(first, first.edges[:, -1]).T
    plain = normal_states(elastic(given, law_of("hertz")), first.edges[:, -1])
    soft = given.n_H < 1.0
    c = np.where(soft, given.n_H / given.n_E, 1.0 / np.sqrt(given.n_E))
    chi = 1.0 + (given.n_H - 1.0) * np.exp(-c * (plain[:, 0] / np.maximum(given.tau, 1e-9)) ** np.where(soft, 2, 1))
    share = 0.4 if key.startswith("zhao") else 1.0
    assert_allclose(load / area, share * given.eta * chi, rtol=1e-9)
    before = normal_states(whole, coordinates_at_area(whole, 0.98 * area))
    assert (before[:, 2] < load / area * before[:, 3] * 1.5).all()


@pytest.mark.parametrize(("n_E", "n_H"), [(0.1, 0.1), (0.1, 10.0), (8.0, 0.1), (8.0, 10.0)])
@pytest.mark.parametrize(("key", "share"), [("roy_chowdhury_ghosh_1994", 1.0), ("chang_etsion_bogy_1987", 0.454 + 0.41 * 0.3)])
def test_a_plastic_asperity_bears_the_hardness_at_its_depth(key, share, n_E, n_H):
    """Its mean pressure is the law's share of Bhattacharya and Nix's hardness: the film's where it is hardly pressed, the
    body's where it is pressed through. So a soft film is squeezed out on its body, and a hard one is let down by it: it bears
    less load on its way there."""
    tau, n = 200.0, 60
    eta = 0.02
    lam = (eta * math.sqrt(1e9 / math.pi) / 18.0**0.25) ** 4
    given = groups(theta=1e9 * np.ones(n), lam=lam, nu=0.3, n_E=n_E, n_H=n_H, tau=tau, film_aspect=tau).resolved()
    last = parts_of(key, given)[-1]
    assert last.state == "plastic"
    w = np.geomspace(0.05 * tau, 60.0 * tau, n)
    _, _, load, area = normal_states(last, coordinates(last, w)).T
    c, power = (n_H / n_E, 2) if n_H < 1.0 else (1.0 / math.sqrt(n_E), 1)
    chi = 1.0 + (n_H - 1.0) * np.exp(-c * (w / tau) ** power)
    assert_allclose(load / area, share * eta * chi, rtol=2e-3)
    assert load[-1] / area[-1] == pytest.approx(share * eta, rel=2e-3)
    assert (np.diff(load) > 0.0).all() == (n_H < 1.0)


BODIES = {"first": "hardened_steel_52100", "second": "tungsten", "work_of_adhesion": 0.05, "nominal_area": "1 mm^2"}
ROUGH = st.Roughness(asperity_height_deviation="48 nm", asperity_radius="50 um", asperity_density="1.7e10 1/m^2")


def contact(first, second, bodies, thickness="200 nm", film="silver"):
    coating = st.Coating(material=film, thickness=thickness, bodies=bodies)
    return st.Contact(**BODIES | {"first": first, "second": second}, roughness=ROUGH, coating=coating)


def load_and_area(subject, model=PLAIN):
    found = st.solve(
        subject, separation=["0 nm", "50 nm", "100 nm"], model=model, asperity="zhao_maietta_chang_2000", film="layered"
    )
    return np.array([found["load"].values, found["contact_area"].values])


def test_bodies_may_be_swapped():
    steel, metal = BODIES["first"], "gold"
    assert_allclose(load_and_area(contact(steel, metal, "first")), load_and_area(contact(metal, steel, "second")), rtol=1e-12)
    assert_allclose(load_and_area(contact(steel, metal, "both")), load_and_area(contact(metal, steel, "both")), rtol=1e-9)


@pytest.mark.parametrize("bodies", ["first", "second", "both"])
def test_compliances_of_the_bodies_add(bodies):
    """The groups of a contact lead to the exact sphere between these very bodies."""
    steel, gold, silver = (st.material(name) for name in (BODIES["first"], "gold", "silver"))
    stiffness = [body.youngs_modulus / (1.0 - body.poissons_ratio**2) for body in (steel, gold, silver)]
    first, second, film = stiffness
    nu = silver.poissons_ratio
    if bodies == "both":
        halves = [(film / first, steel), (film / second, gold)]
        pair = tuple(Layer.of(0.5, ratio, nu, body.poissons_ratio) for ratio, body in halves)
        surfaces = film / 2.0
    else:
        coated, other, below = (first, second, steel) if bodies == "first" else (second, first, gold)
        surfaces = 1.0 / (1.0 / film + 1.0 / other)
        pair = (Layer.of(surfaces / film, film / coated, nu, below.poissons_ratio),)
    indices = contact(BODIES["first"], "gold", bodies).indices()
    n = 1
    whole = groups(
        **{name: float(value) for name in type(indices).model_fields if (value := getattr(indices, name)) is not None}
    )
    segment = elastic(whole.resolved(), law_of("hertz"))
    thickness = float(indices.film_aspect) / (2.0 if bodies == "both" else 1.0)
    for radius in (0.1, 1.0, 10.0):
        u = np.full(n, math.sqrt(radius * thickness))
        exact = respond(pair, radius)
        w, _, load, _ = normal_states(segment, u)[0]
        assert w == pytest.approx(exact.approach * u[0] ** 4, rel=4e-3)
        bare = 1.0 / (1.0 / first + 1.0 / second)
        assert load == pytest.approx(exact.load * surfaces / bare * u[0] ** 6, rel=4e-3)


def test_unlike_coated_bodies_are_not_solved_as_one_film_too(monkeypatch):
    """Of three contacts of coated bodies, those of the first are alike: one film, the others two."""
    films = []
    solve = lambda *columns: (films.append(len(columns[0])), curves_of_films(*columns))[1]  # noqa: E731
    monkeypatch.setattr(layered_rows, "curves_of_films", solve)
    given = FILM | {"n_E": 0.2, "film_nu": 0.4, "layer_nu": 0.4, "films": 2.0, "film_aspect": 1.0, "coated_nu": 0.2}
    together = coefficients(groups(**given, coated_share=np.array([0.5, 0.3, 0.5]), counter_nu=np.array([0.2, 0.2, 0.4])))
    assert films == [1]
    for row, (first, nu) in enumerate([(0.5, 0.2), (0.3, 0.2), (0.5, 0.4)]):
        (alone,) = coefficients(groups(**given, coated_share=first, counter_nu=nu))
        assert_allclose(together[row], alone, rtol=1e-9, atol=1e-12)
    pair = tuple(Layer.of(0.5, 0.4 * share, 0.4, below) for share, below in ((0.3, 0.2), (0.7, 0.2)))
    assert_allclose(together[1], curves(pair), rtol=1e-9)


def test_halves_on_like_bodies_are_one_film_on_a_rigid_plane():
    """Each half of the film is pressed against the plane between: one film of half the thickness on a rigid body."""
    common = {"theta": 30.0, "nu": 0.2} | FILM | {"n_E": 0.2, "n_H": 1.0, "film_nu": 0.4}
    both = groups(film_aspect=1.0, films=2.0, **common).resolved()
    one = groups(film_aspect=0.5, **common).resolved()
    assert_allclose(coefficients(both), coefficients(one), rtol=1e-12)
    u = np.array([0.9])
    found = [normal_states(elastic(each, law_of("jkr")), u) for each in (both, one)]
    assert_allclose(found[0], found[1], rtol=1e-12)


def test_what_cannot_be_is_refused():
    with refusal("n_E", "coated_share"):
        given = groups(theta=10.0, **FILM | {"n_E": 3.0, "coated_share": 0.5, "film_aspect": 1.0})
        regimes(given, law_of("hertz"), "bhattacharya_nix_1988", "2")
    with refusal("asperity", "layered", "maugis_1992"):
        problem_of(groups(theta=10.0, **FILM), Choice(PLAIN, "maugis_1992", film="layered"))


# A film softer than its bodies, on asperities so flat that the bodies themselves would not yield.
SOFT = {"youngs_modulus": "82 GPa", "poissons_ratio": 0.37, "hardness": "0.4 GPa"}


@pytest.mark.parametrize(("hardness", "sure"), [("0.4 GPa", False), ("40 GPa", True)])
@pytest.mark.parametrize("laws", [{"film": "layered"}, {"film": "layered", "asperity": "dmt"}])
def test_a_film_that_yields_under_elastic_asperities_has_a_warning(laws, hardness, sure):
    steel = st.material("hardened_steel_52100", hardness="73 GPa")
    contact = st.Contact(
        first=steel, second=steel, work_of_adhesion="1 mJ/m^2", nominal_area="1 mm^2", interfacial_shear_strength="60 MPa",
        coating={"material": SOFT | {"hardness": hardness}, "thickness": "5 um", "bodies": "first"},
        roughness=st.Roughness(asperity_height_deviation="40 nm", asperity_radius="100 um", asperity_density="2e9 1/m^2"),
    )  # fmt: skip
    result = st.solve(contact, load="0.3 N", model=PLAIN, **laws)
    pressure = 0.3 / float(result["contact_area"])
    yields = pressure > 1.1 * contact.coating.material.hardness / 2.8  # a sphere first does at p_m = 1.1 Y (Johnson 1985, 6.2)
    assert contact.plasticity_index < 0.6 and yields != sure
    assert ("film_plasticity_index" in outside(result)) == (not sure)
    result = st.solve(contact, load="0.3 N", model=PLAIN, film="layered", asperity="jackson_green_2005")
    assert "film_plasticity_index" not in outside(result)
