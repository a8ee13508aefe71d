"""Published films and composites against numbers that the package did not produce, and what their abstracts say of them."""

from dataclasses import replace

import numpy as np
import pytest

from refusals import refusal
from stiction.engine import heights, summation
from stiction.engine.compiled import formula
from stiction.laws import joining as law
from stiction.laws.asperity import chang_etsion_bogy_1987, hertz
from stiction.laws.film import chang_1997, finkin_1969, halling_1979, liu_neville_reuben_2002, ogilvy_1993
from stiction.laws.segment import TangentialResistance
from stiction.records.registry import TangentialLaw, composites_of, records
from stiction.solving.choice import Choice
from stiction.solving.problem import problem_of
from tables import assert_near, column, groups, read

GAUSSIAN = heights.gaussian()
LOAD, AREA, SLIP, TEAR = 1, 2, 3, 4
SHEAR = 0.1  # shear strength of the interface over the hardness of the substrate

MODULI, HARDNESSES = composites_of("modulus"), composites_of("hardness")


@formula
def sheared(u, w, load, area, strength):
    return strength * area, 0.0


INTERFACE = TangentialLaw(
    key="interface", title="", grade="B", sources=(), verified="", interfacial=True,
    tangential_resistance=lambda segment, groups: TangentialResistance(sheared, (SHEAR * groups.eta,)),
)  # fmt: skip


@formula
def half_the_load(u, w, load, area):
    return 0.0, 0.5 * load


IN_SUBSTRATE = TangentialLaw(
    key="in_substrate", title="", grade="B", sources=(), verified="",
    tangential_resistance=lambda part, groups: TangentialResistance(half_the_load, ()) if part.state == "elastic" else None,
)  # fmt: skip

CHANG = law.Law(chang_etsion_bogy_1987.RECORD)


def sums(regimes, h):
    """The five sums (regimes, n, 5), of each law at its own separation."""
    return summation.scattered(regimes, np.broadcast_to(h, len(regimes[0].edges)), GAUSSIAN)


def table(name, **more):
    rows = read(name)
    names = [key for key in ("theta", "lam", "nu", "n_E", "n_H", "n_g", "tau", "film_aspect", "film_nu") if key in rows[0]]
    film = {"n_E": 1.0, "n_H": 1.0, "tau": 1.0}
    return rows, groups(**film | {key: column(rows, key) for key in names}), column(rows, "h")


# film over substrate 0.5, Poisson's ratios 0.3: E/E_s against thickness over contact radius
MODULUS_TABLE = {
    "gao_chiu_lee_1992": (0.9585, 0.9045, 0.7753, 0.6221, 0.5385),
    "bec_2006": (0.9435, 0.8618, 0.7200, 0.6037, 0.5364),
    "perriot_barthel_2004": (0.9616, 0.8742, 0.6961, 0.5689, 0.5167),
}


@pytest.mark.parametrize("key", MODULI)
def test_moduli_of_a_film_half_as_stiff(key):
    found = [MODULI[key].value(0.5, xi, 0.3, 0.3) for xi in (0.1, 0.3, 1.0, 3.0, 10.0)]
    assert found == pytest.approx(MODULUS_TABLE[key], abs=5.1e-5)


# (n_E, n_H): H/H_s against depth over thickness, with m = 1 for a soft film
HARDNESS_TABLE = {
    (0.5, 0.5): (0.500, 0.611, 0.697, 0.816, 0.932, 0.991),
    (0.5, 0.2): (0.200, 0.276, 0.345, 0.464, 0.641, 0.838),
    (1.5, 0.5): (0.500, 0.540, 0.577, 0.642, 0.743, 0.868),
    (2.5, 0.5): (0.500, 0.524, 0.548, 0.591, 0.665, 0.775),
}


@pytest.mark.parametrize(("n_E", "n_H"), HARDNESS_TABLE)
def test_hardness_of_bhattacharya_and_nix(n_E, n_H):
    hardness = HARDNESSES["bhattacharya_nix_1988"]
    c = float(hardness.constants(np.array(n_E), np.array(n_H), np.array(n_H)))
    found = [hardness.value(n_H, v, c, 1.0) for v in (0.0, 0.25, 0.5, 1.0, 2.0, 4.0)]
    assert found == pytest.approx(HARDNESS_TABLE[n_E, n_H], abs=5.1e-4)


@pytest.mark.parametrize("key", MODULI)
def test_moduli_against_independent_evaluation(key):
    for row in read(f"{key}.csv"):
        given = [float(row[name]) for name in ("n_E", "thickness_over_radius", "film_nu", "nu")]
        assert MODULI[key].value(*given) == pytest.approx(float(row["value"]), rel=1e-13)


@pytest.mark.parametrize("key", HARDNESSES)
def test_hardnesses_against_independent_evaluation(key):
    for row in read(f"{key}.csv"):
        n_H, v, n_E, m = (float(row[name]) for name in ("n_H", "depth_over_thickness", "n_E", "exponent"))
        c = float(HARDNESSES[key].constants(np.array(n_E), np.array(n_H), np.array(n_H)))
        assert HARDNESSES[key].value(n_H, v, c, m) == pytest.approx(float(row["value"]), rel=1e-13)


@pytest.mark.parametrize("n", [0.02, 0.5, 1.0, 30.0])
def test_composites_are_film_at_the_surface_and_substrate_far_below(n):
    for modulus in MODULI.values():
        assert modulus.value(n, 0.0, 0.2, 0.45) == pytest.approx(1.0, rel=1e-12)
        assert modulus.value(n, np.inf, 0.2, 0.45) == pytest.approx(n, rel=1e-12)
    for hardness in HARDNESSES.values():
        assert hardness.value(n, 0.0, 0.5, 2.0) == pytest.approx(n, rel=1e-12)
        assert hardness.value(n, 1e200, 0.5, 2.0) == pytest.approx(1.0, rel=1e-12)


@pytest.mark.parametrize("key", [key for key, one in HARDNESSES.items() if one.landmarks])
@pytest.mark.parametrize("exponent", [1.0, 2.0])
def test_landmarks_part_the_fading_of_the_film_alike_whatever_its_constant(key, exponent):
    """Where an integral over the depth is cut: between two of them the film's share of the hardness falls by half at most,
    and beyond the last it is nothing to speak of."""
    constant = np.array([0.02, 0.5, 1.0, 30.0])
    depths = HARDNESSES[key].landmarks(constant, np.full(4, exponent))
    share = np.array([[1.0 - HARDNESSES[key].value(0.0, v, c, exponent) for v in (0.0, *row)]
                      for c, row in zip(constant, depths, strict=True)])  # fmt: skip
    np.testing.assert_allclose(share - share[:1], 0.0, atol=1e-14)
    assert (np.diff(share[0]) <= 0.0).all() and (np.diff(share[0]) > -0.51).all() and share[0, -1] < 1e-4


FIRST_YIELD = 15  # among the parameters of a regime


def halling(row_groups, choice, tangential=None):
    return halling_1979.regimes(row_groups, law.Law(hertz.RECORD, tangential), *choice)


def test_halling_against_independent_sums():
    rows, given, h = table("halling_1979.csv")
    choices = [(row["modulus"], row["hardness"], row["soft_film_exponent"]) for row in rows]
    for choice in dict.fromkeys(choices):
        mine = np.array([other == choice for other in choices])
        regimes = halling(given[mine], choice)
        found = sums(regimes, h[mine]).sum(axis=0)
        assert_near(regimes[0].parameters[FIRST_YIELD], column(rows, "first_yield")[mine], 1e-13, what=f"{choice} first yield")
        assert_near(found[:, LOAD], column(rows, "load")[mine], 1e-10, what=f"{choice} load")
        assert_near(found[:, AREA], column(rows, "area")[mine], 1e-10, what=f"{choice} area")


DEFAULTS = tuple(values[0] for values in halling_1979.RECORD.options.values())


def plastic_sum(eta, h, stiff=1.0):
    """Load and area by quadrature on a fine grid: Hertz of a modulus to (eta/stiff)^2, then eta (2 w - w_c)."""
    w_c = (eta / stiff) ** 2
    w = np.linspace(0.0, 14.0, 400001)
    weight = np.exp(-((h + w) ** 2) / 2) / np.sqrt(2 * np.pi)
    area = np.where(w < w_c, w, 2 * w - w_c)
    return np.trapezoid(weight * np.where(w < w_c, stiff * w**1.5, eta * area), w), np.trapezoid(weight * area, w)


@pytest.mark.parametrize(
    ("tau", "aspect", "n_E", "n_H", "alone"),
    [(1.0, 1.0, 1.0, 1.0, (1.0, 1.0)), (0.0, 0.0, 0.2, 0.3, (1.0, 1.0)), (1e-9, 1e-9, 0.2, 0.3, (1.0, 1.0)),
     (1e9, 1e9, 0.2, 0.3, (0.2, 0.3)), (1e9, 1e9, 5.0, 3.0, (5.0, 3.0))],
)  # fmt: skip
def test_halling_is_the_substrate_or_the_film_alone_in_the_limits(tau, aspect, n_E, n_H, alone):
    given = groups(theta=100.0, lam=1.0, n_E=n_E, n_H=n_H, tau=tau, film_aspect=aspect)
    found = sums(halling(given, DEFAULTS), 0.5).sum(axis=0)[0]
    expected = plastic_sum(given.eta[0] * alone[1], 0.5, alone[0])
    assert found[[LOAD, AREA]] == pytest.approx(expected, rel=2e-7)


def test_halling_has_no_jump_and_splits_its_bodies_at_the_thickness():
    rng = np.random.default_rng(1)
    n = 200
    film = {"n_E": 10 ** rng.uniform(-2, 2, n), "n_H": 10 ** rng.uniform(-2, 2, n), "tau": 10 ** rng.uniform(-3, 2, n)}
    theta, lam = 10 ** rng.uniform(-1, 6, n), 10 ** rng.uniform(-4, 8, n)
    given = groups(theta=theta, lam=lam, film_aspect=film["tau"] * 0.1, **film)
    for choice in zip(("gao_chiu_lee_1992", "bec_2006"), ("kao_byrne_1981", "jonsson_hogmark_1984"), "12", strict=True):
        elastic, _, plastic, _ = regimes = halling(given, choice)
        w_c = elastic.parameters[FIRST_YIELD]
        at_end, at_start = law.states(elastic, np.sqrt(w_c)), law.states(plastic, w_c)
        assert_near(at_start[:, 2:4], at_end[:, 2:4], 1e-12)
        # nowhere before is the mean pressure above the hardness
        for part in (0.999, 0.5, 0.1):
            before = law.states(elastic, part * np.sqrt(w_c))
            flowing = law.states(plastic, part**2 * w_c)
            assert np.all(before[:, 2] / before[:, 3] <= flowing[:, 2] / flowing[:, 3] * (1 + 1e-12))
        assert [regime.body for regime in regimes] == ["film", "substrate"] * 2
        for regime in regimes:
            w = regime.edges**2 if regime.state == "elastic" else regime.edges
            real = w[:, -1] > w[:, 0]
            ends = (w[:, -1] <= given.tau * (1 + 1e-12)) if regime.body == "film" else (w[:, 0] >= given.tau * (1 - 1e-12))
            assert np.all(ends[real])


def test_halling_friction_is_shear_strength_over_effective_hardness():
    """Soft film, plastic asperities: between the film's value and Bowden and Tabor's; falls with load, rises with thickness."""
    tau = np.array([0.05, 0.5, 5.0])
    given = groups(theta=1e4, lam=1.0, n_E=0.5, n_H=0.2, tau=tau, film_aspect=0.1 * tau)
    regimes = halling(given, DEFAULTS, INTERFACE)
    mu = []
    for h in (3.0, 1.0, -1.0):
        total = sums(regimes, h).sum(axis=0)
        mu.append(total[:, SLIP] / total[:, LOAD])
    assert np.all((np.array(mu) > SHEAR) & (np.array(mu) < SHEAR / 0.2))
    assert np.all(np.diff(mu, axis=0) < 0.0) and np.all(np.diff(mu, axis=1) > 0.0)


def test_finkin_against_independent_sums():
    rows, given, h = table("finkin_1969.csv")
    bounds = np.array([row["bound"] for row in rows])
    for bound in finkin_1969.BOUNDS:
        mine = bounds == bound
        regimes = finkin_1969.regimes(given[mine], law.Law(hertz.RECORD), bound)
        found = sums(regimes, h[mine])
        assert_near(found[:, :, LOAD].sum(axis=0), column(rows, "load")[mine], 1e-11, what=bound)
        assert_near(found[:, :, AREA].sum(axis=0), column(rows, "area")[mine], 1e-11, what=bound)
        beyond = sum(part[:, AREA] for part, regime in zip(found, regimes, strict=True) if not regime.in_half_space)
        assert_near(beyond, column(rows, "area_beyond")[mine], 1e-11, what=bound)


@pytest.mark.parametrize(("bound", "powers"), [("compressible", (0.5, -0.5)), ("incompressible", (1.0, -2 / 3))])
def test_finkin_friction_goes_as_powers_of_thickness_and_load(bound, powers):
    """f ~ t^(1/2) P^(-1/2) or t P^(-2/3), one asperity, constant shear strength."""

    def friction(aspect, w):
        given = groups(theta=100.0, lam=1.0, n_E=0.01, n_H=1.0, tau=1.0, film_aspect=aspect)
        last = finkin_1969.regimes(given, law.Law(hertz.RECORD, INTERFACE), bound)[-1]
        state = law.states(last, np.array([w]))[0]
        return state[4] / state[2], state[2]

    at, load = friction(0.1, 2.0)
    deeper, more = friction(0.1, 3.0)
    assert np.log(deeper / at) / np.log(more / load) == pytest.approx(powers[1], abs=1e-12)
    thicker, less = friction(0.2, 2.0)
    at_the_same_load = thicker * (load / less) ** powers[1]
    assert np.log(at_the_same_load / at) / np.log(2.0) == pytest.approx(powers[0], abs=1e-12)


@pytest.mark.parametrize(("bound", "k"), [("incompressible", 12.0), ("incompressible_frictionless", 3.0)])
def test_the_incompressible_layer_keeps_its_volume(bound, k):
    """Independent of the closed forms: what the pressure squeezes out, (1/r) d/dr(r q) with q = -(t^3/kG) dp/dr, is the
    indentation delta - r^2/2R, on a grid; and the pressure adds up to the load."""
    t, G, R, delta = 0.01, 1.0, 1.0, 0.02
    a = np.sqrt(4 * R * delta)
    r = np.linspace(0.0, a, 4001)
    p = k * G * (a**2 - r**2) ** 2 / (32 * R * t**3)
    flow = -(t**3) / (k * G) * np.gradient(p, r, edge_order=2)
    sunk = np.gradient(r * flow, r, edge_order=2)[5:-5] / r[5:-5]
    assert np.max(np.abs(sunk - (delta - r[5:-5] ** 2 / (2 * R)))) < 1e-5 * delta
    nu = 0.499
    n_E = G * 2 / (1 - nu) / 0.75  # K = 1, R sigma = 1
    given = groups(nu=nu, n_E=n_E, n_H=1.0, tau=1.0, film_aspect=t)
    assert finkin_1969.stiffness(given, bound)[0] * delta**3 == pytest.approx(np.trapezoid(2 * np.pi * r * p, r), rel=1e-6)


@pytest.mark.parametrize("film", [chang_1997, liu_neville_reuben_2002], ids=lambda film: film.RECORD.key)
def test_plastic_films_against_independent_sums(film):
    rows, given, h = table(f"{film.RECORD.key}.csv")
    regimes = film.regimes(given, CHANG)
    found = sums(regimes, h)
    assert_near(found[:, :, LOAD].sum(axis=0), column(rows, "load"), 1e-10, what="load")
    assert_near(found[:, :, AREA].sum(axis=0), column(rows, "area"), 1e-10, what="area")
    under = sum(part[:, AREA] for part, regime in zip(found, regimes, strict=True) if regime.body == "substrate")
    assert_near(under, column(rows, "substrate_area"), 1e-10, what="area of the substrate")
    touching = sum(part[:, 0] for part, regime in zip(found, regimes, strict=True) if regime.touching)
    assert_near(touching, sums([law.Law(hertz.RECORD).join(hertz.elastic(np.full(len(h), np.inf)), given)], h)[0, :, 0], 1e-11)


def test_load_is_continuous_where_the_film_is_cut_through():
    given = groups(theta=50.0, lam=3.0, n_E=1.0, n_H=0.4, tau=np.array([0.1, 1.0, 7.0]))
    alone, rim, under, *_ = chang_1997.regimes(given, CHANG)
    at = law.states(alone, given.tau)
    beyond = law.states(rim, np.zeros(3)) + law.states(under, np.zeros(3))
    assert_near(beyond[:, 2:4], at[:, 2:4], 1e-14)


def lam_of(psi, theta=1e3):
    """lambda of a plasticity index psi = (E*/H) sqrt(sigma/R), that is eta = (3/4) pi/psi."""
    return (0.75 * np.pi / psi) ** 4 * theta**2 / (18 * np.pi**2)


def film_groups(psi, tau, theta=1e3, n_H=0.3):
    return groups(theta=theta, lam=lam_of(psi, theta), n_E=1.0, n_H=n_H, tau=tau)


def test_what_changs_abstract_says():
    """Area and load are less sensitive to the coating at a high plasticity index; a thin coating stiffens a lightly loaded
    contact."""
    h, tau = np.array([1.0, 2.5, 2.51]), np.array([0.1, 0.5, 2.0])
    bare, coated = {}, {}
    for psi in (0.5, 5.0):
        uncoated = CHANG.regimes(groups(theta=1e3, lam=lam_of(psi)))
        bare[psi] = summation.on_grid(uncoated, h, GAUSSIAN).sum(axis=0)
        coated[psi] = summation.on_grid(chang_1997.regimes(film_groups(psi, tau, n_H=0.6), CHANG), h, GAUSSIAN).sum(axis=0)
    for quantity in (LOAD, AREA):
        change = {psi: np.log(coated[psi][:, quantity] / bare[psi][:, quantity]) for psi in bare}
        assert np.all(np.abs(change[5.0]) < 0.2 * np.abs(change[0.5]))
    spread = {psi: np.ptp(np.log(coated[psi][:, LOAD]), axis=0) for psi in bare}
    assert np.all(spread[5.0] < 0.2 * spread[0.5])
    stiffness = {name: one[0.5][:, LOAD, 1] - one[0.5][:, LOAD, 2] for name, one in (("bare", bare), ("coated", coated))}
    assert stiffness["coated"][0] > stiffness["bare"][0]


def friction_at(load, psi, tau, tangential, theta=100.0, n_H=0.2):
    """Friction coefficients at a load for films of several thicknesses, under the adhesion of Liu, Neville and Reuben."""
    h = np.linspace(-2.5, 4.5, 281)
    regimes = liu_neville_reuben_2002.regimes(film_groups(psi, tau, theta, n_H), replace(CHANG, tangential=tangential))
    sums = summation.on_grid(regimes, h, GAUSSIAN).sum(axis=0)
    friction = sums[:, SLIP] + sums[:, TEAR]
    return np.array([np.interp(load, one[LOAD][::-1], own[::-1]) for one, own in zip(sums, friction, strict=True)]) / load


def test_what_the_abstract_of_liu_neville_and_reuben_says():
    """Friction rises with the thickness at a plasticity index above 0.5, and as a very thin film gets thinner at 0.25 and light
    load: so it does if the interface is what is sheared. If only the substrate resists, it falls with thickness at both."""
    tau = np.array([0.02, 0.1, 0.3, 0.6, 1.0, 1.5])
    for psi in (1.0, 2.5):
        assert np.all(np.diff(friction_at(0.03, psi, tau, INTERFACE)) > 0.0)
    assert np.all(np.diff(friction_at(0.03, 0.25, tau, INTERFACE)) < 0.0)
    for psi in (0.25, 2.5):
        assert np.all(np.diff(friction_at(0.03, psi, tau, IN_SUBSTRATE)) < 0.0)


def test_without_adhesion_liu_is_chang():
    given = groups(theta=1e9, lam=1e20, n_E=1.0, n_H=0.3, tau=np.array([0.2, 3.0]))
    one, other = (sums(film.regimes(given, CHANG), 1.0).sum(axis=0) for film in (chang_1997, liu_neville_reuben_2002))
    assert_near(other[:, [LOAD, AREA]], one[:, [LOAD, AREA]], 1e-6)


def test_film_resists_only_where_the_interface_does():
    given = film_groups(0.5, 3.0)
    on_film = sums(chang_1997.regimes(given, replace(CHANG, tangential=IN_SUBSTRATE)), 1.0).sum(axis=0)
    under = sums(replace(CHANG, tangential=IN_SUBSTRATE).regimes(given), 4.0).sum(axis=0)
    assert_near(on_film[:, TEAR], under[:, TEAR], 1e-11)
    interface = sums(chang_1997.regimes(given, replace(CHANG, tangential=INTERFACE)), 1.0).sum(axis=0)
    assert_near(interface[:, SLIP], SHEAR * given.eta * interface[:, AREA], 1e-13)


def test_ogilvys_film_is_not_felt_and_shears_over_the_bare_contact():
    given = groups(theta=100.0, lam=1e-9, n_E=0.1, n_H=0.1, tau=5.0)
    bare = sums(CHANG.regimes(given), 1.0).sum(axis=0)
    found = sums(ogilvy_1993.regimes(given, law.Law(chang_etsion_bogy_1987.RECORD, INTERFACE)), 1.0).sum(axis=0)
    assert found[:, :3] == pytest.approx(bare[:, :3], rel=1e-14)
    K_H = 0.454 + 0.41 * 0.3
    assert found[:, SLIP] / found[:, LOAD] == pytest.approx(SHEAR / K_H, rel=1e-3)  # Bowden & Tabor: s over the pressure


@pytest.mark.parametrize("film", [halling_1979, finkin_1969, ogilvy_1993], ids=lambda film: film.RECORD.key)
def test_other_friction_than_that_of_the_interface_is_refused(film):
    given = groups(n_E=1.0, n_H=1.0, tau=1.0, film_aspect=1.0)
    with refusal("tangential", film.RECORD.key):
        problem_of(given, Choice("chang_etsion_bogy_1988", film=film.RECORD.key))


@pytest.mark.parametrize("author", ["dayson", "finkin", "halling", "kato", "ravindran", "ogilvy", "chang", "liu"])
def test_every_film_of_the_papers_introduction_computes(author):
    """And the one of Ravindran and others, of the same years."""
    assert [one for one in records() if one.key.startswith(author) and one.kind == "film"]
