"""The graded film meets what is required of it (docs/theory.md, 5.3), over the whole range of indices."""

import itertools
import math
from dataclasses import replace

import numba
import numpy as np
import pytest
from numba.np.unsafe.ndarray import to_fixed_tuple

from refusals import refusal
from stiction.engine import heights, summation, vectorised
from stiction.laws.asperity import roy_chowdhury_ghosh_1994
from stiction.laws.film import graded
from stiction.laws.film.shared import graded_law
from stiction.laws.joining import Law
from stiction.laws.tangential import soft_coating_2015
from stiction.solving.choice import Choice
from stiction.solving.problem import problem_of
from tables import groups

GAUSSIAN = heights.gaussian()
ALONG = graded_law.along
SHARP = Law(roy_chowdhury_ghosh_1994.RECORD, soft_coating_2015.RECORD, {"branch": "loading"})  # with the jump at yield
MANY = 26  # parameters of the law
END = 9.0  # u; depths of more than 6000 sigma are of no use


def random_laws(count, seed):
    """Substrate, film and the film's groups over the whole range of inputs."""
    rng = np.random.default_rng(seed)
    theta, lam = 10 ** rng.uniform(-3, 8, count), 10 ** rng.uniform(-6, 8, count)
    nu, k = rng.uniform(0, 0.499, count), rng.uniform(1.5, 4, count)
    n_E, n_H = 10 ** rng.uniform(-2, 2, count), 10 ** rng.uniform(-2, 2, count)
    tau = np.where(rng.random(count) < 0.03, 0.0, 10 ** rng.uniform(-6, 3, count))
    film_aspect = np.where(tau > 0, 10 ** rng.uniform(-3, 3, count), 0.0)
    film = groups(theta * n_E, lam * n_H**4 / n_E**2, rng.uniform(0, 0.499, count), rng.uniform(1.5, 4, count))
    return groups(theta, lam, nu, k), film, n_E, n_H, tau, film_aspect


def separations(count, seed):
    return np.random.default_rng(seed).uniform(-6, 8, count)


def sums(regimes, h):
    """Touching, load, area, resistance (n, 4) of all regimes together, and the sizes of their terms."""
    parts = summation.scattered(regimes, h, GAUSSIAN)
    parts[:, :, 3] += parts[:, :, 4]
    return parts[:, :, :4].sum(axis=0), np.abs(parts[:, :, :4]).sum(axis=0)


def assert_same(regimes, expected, h, tolerance, factors=1.0):
    (found, size), (wanted, _) = sums(regimes, h), sums(expected, h)
    assert np.all(np.abs(found - factors * wanted) <= tolerance * (size + 1e-3 * size[:, 2:3]) + 1e-300)


@numba.njit
def _evaluate(parameters, u, out):
    for i in range(u.shape[0]):
        row = to_fixed_tuple(parameters[i], MANY)
        for j in range(u.shape[1]):
            state = ALONG(u[i, j], *row)
            for q in range(6):
                out[i, j, q] = state[q]


def states(regimes, u):
    """What the asperities of the laws are at the coordinates u (n, m): (n, m, 6), as a regime's `along` returns it."""
    out = np.empty((*u.shape, 6))
    _evaluate(np.stack(np.broadcast_arrays(*regimes[0].parameters), axis=1), u, out)
    return out


def segments(regimes, law):
    """(first, last, state, body) of all segments of one law, from shallow to deep."""
    found = []
    for regime in regimes:
        edges = regime.edges[law]
        found += [(a, b, regime.state, regime.body) for a, b in itertools.pairwise(edges) if b > a]
    return sorted(found)


def test_arctangent_and_logarithm():
    v = np.concatenate([[0.0], np.logspace(-12, 12, 2001), [np.tan(np.pi / 8), 1.0]])
    found = np.array([vectorised.arctan(value) for value in v])
    assert np.abs(found - np.arctan(v)).max() < 4e-16
    z = np.concatenate([np.logspace(-20, 200, 3001), np.linspace(0.3, 3.0, 500)])
    found = np.array([vectorised.log_quotient(value) for value in z])
    np.testing.assert_allclose(found, np.log1p(z) / z, rtol=1e-15)
    assert vectorised.log_quotient(0.0) == 1.0


def test_gao_modulus_in_numbers():
    """K_eff/K_s for n_E = 0.5, nu = 0.3 at t/a = 0.1, 0.3, 1, 3, 10: four digits of an independent evaluation."""
    found = [1.0 - 0.5 * graded_law.modulus_share(1.0 / ratio, 0.3)[0] for ratio in (0.1, 0.3, 1.0, 3.0, 10.0)]
    np.testing.assert_allclose(found, [0.9585, 0.9045, 0.7753, 0.6221, 0.5385], atol=6e-5)
    assert graded_law.modulus_share(0.0, 0.3)[0] == 1.0
    for v in (0.01, 0.7, 1.3, 40.0):
        shares = [graded_law.modulus_share(v * np.exp(step), 0.2)[0] for step in (-1e-5, 1e-5)]
        assert abs(graded_law.modulus_share(v, 0.2)[1] - (shares[1] - shares[0]) / 2e-5) < 1e-9


@pytest.mark.parametrize(("n_E", "n_H", "expected"), [
    (0.5, 0.5, [0.500, 0.611, 0.697, 0.816, 0.932, 0.991]),
    (0.5, 0.2, [0.200, 0.276, 0.345, 0.464, 0.641, 0.839]),
    (2.5, 0.5, [0.500, 0.524, 0.548, 0.591, 0.665, 0.775]),
])  # fmt: skip
def test_bhattacharya_nix_hardness_in_numbers(n_E, n_H, expected):
    """H_eff/H_s at w/tau = 0, 1/4, 1/2, 1, 2, 4 with exponent 1: three digits of an independent evaluation."""
    tau = 3.0
    linear, square = graded.fading_rates(*np.array([[n_E], [n_H], [n_H], [tau]]), m_soft=1)
    depths = tau * np.array([0.0, 0.25, 0.5, 1.0, 2.0, 4.0])
    found = [1.0 + (n_H - 1.0) * graded_law.fading(w, linear[0], square[0]) for w in depths]
    np.testing.assert_allclose(found, expected, atol=6e-4)


def test_no_difference_no_film():
    substrate, _, _, _, tau, film_aspect = random_laws(1500, 1)
    one = np.ones(1500)
    film = graded.graded_regimes(substrate, substrate, one, one, tau, film_aspect)
    assert_same(film, graded.bare_regimes_with_transition(substrate), separations(1500, 1), 1e-9)


def test_no_thickness_is_the_substrate():
    substrate, film, n_E, n_H, tau, _ = random_laws(1500, 2)
    bare, h = graded.bare_regimes_with_transition(substrate), separations(1500, 2)
    assert_same(graded.graded_regimes(substrate, film, n_E, n_H, 0 * tau, 0 * tau), bare, h, 1e-9)
    mild = np.clip(n_E, 0.3, 3.0), np.clip(n_H, 0.3, 3.0)
    far = []
    for thickness in (1e-3, 1e-5, 1e-7):
        regimes = graded.graded_regimes(substrate, film, *mild, thickness + 0 * tau, thickness / 10 + 0 * tau)
        found, size = sums(regimes, h)
        far.append(np.quantile(np.abs(found - sums(bare, h)[0])[:, 1:3] / (size[:, 1:3] + 1e-290), 0.95))
    assert far[0] > 5 * far[1] > 25 * far[2] and far[2] < 1e-4


def test_great_thickness_is_the_film_in_its_own_indices():
    substrate, film, n_E, n_H, _, _ = random_laws(1500, 3)
    never = np.full(1500, np.inf)
    regimes = graded.graded_regimes(substrate, film, n_E, n_H, never, never)
    factors = np.stack([np.ones(1500), n_E, np.ones(1500), n_E], axis=1)
    assert_same(regimes, graded.bare_regimes_with_transition(film), separations(1500, 3), 1e-9, factors)


def test_other_work_of_adhesion_of_a_thick_film():
    substrate, _, n_E, n_H, _, _ = random_laws(500, 4)
    n_g, never = np.full(500, 1.7), np.full(500, np.inf)
    theta, lam = substrate.theta * n_E / n_g, substrate.lam * n_H**4 / (n_E * n_g) ** 2
    film = groups(theta, lam, substrate.nu, substrate.hardness_to_yield)
    regimes = graded.graded_regimes(substrate, film, n_E, n_H, never, never, n_g)
    factors = np.stack([np.ones(500), n_E, np.ones(500), n_E], axis=1)
    assert_same(regimes, graded.bare_regimes_with_transition(film), separations(500, 4), 1e-9, factors)


def test_bare_with_transition_is_the_published_law_at_both_ends():
    """The same elastic asperity; deep enough, the same plastic one."""
    substrate = random_laws(1000, 5)[0]
    lam = 1e8 * np.maximum(substrate.theta, 1.0) ** 2
    hard = groups(substrate.theta, lam, substrate.nu, substrate.hardness_to_yield)
    h = separations(1000, 5)
    assert_same(graded.bare_regimes_with_transition(hard)[:1], SHARP.regimes(hard)[:1], np.maximum(h, -2.0), 1e-9)
    soft = groups(10 ** np.linspace(0, 8, 50), 1e-3)
    regimes = graded.bare_regimes_with_transition(soft)
    deep = states(regimes, np.full((50, 1), 8.0))[:, 0]
    np.testing.assert_allclose(deep[:, 2], 2 * soft.eta * deep[:, 0] - 2 * np.pi / soft.theta, rtol=1e-12)
    np.testing.assert_allclose(deep[:, 3], 2 * deep[:, 0], rtol=1e-12)


def test_area_without_adhesion_is_that_of_zhao_maietta_and_chang():
    """A/w = 1 + 3 xi^2 - 2 xi^3 over omega/omega_1 from 1/0.16 (mean pressure = H) to 54."""
    eta = 0.7
    theta = np.array([1e8])
    law = groups(theta, eta**4 * theta**2 / (18 * np.pi**2))
    w = np.linspace(1.001, 0.999 * 54 * 0.16, 40) * eta**2
    found = states(graded.bare_regimes_with_transition(law), w[None, :] ** 0.25)[0]
    xi = (w / eta**2 - 1.0) / (54 * 0.16 - 1.0)
    np.testing.assert_allclose(found[:, 3] / found[:, 0], 1 + 3 * xi**2 - 2 * xi**3, rtol=2e-3)


@pytest.mark.parametrize("exponents", [(2, 1), (1, 2)])
def test_load_is_continuous_and_rises_once_it_is_compressive(exponents):
    count = 3000
    regimes = graded.graded_regimes(*random_laws(count, 6), 1.0, exponents)
    parameters = np.stack(np.broadcast_arrays(*regimes[0].parameters), axis=1)
    start = np.array([graded_law.coordinate(1e-12 * row[0] ** (2 / 3), *row) for row in parameters])
    u = start[:, None] * (np.maximum(END, 2 * start) / start)[:, None] ** np.linspace(0, 1, 4000)
    found = states(regimes, u)
    assert np.all(np.isfinite(found))
    w, load = found[:, :, 0], found[:, :, 2]
    assert np.all(np.diff(w, axis=1) > 0)
    drop = np.where(load[:, :-1] > 0, load[:, :-1] - load[:, 1:], 0.0)
    assert np.all(drop <= 1e-5 * np.abs(load[:, :-1]))  # shallow falls between two samples of the search remain
    assert np.mean(np.any(drop > 1e-9 * np.abs(load[:, :-1]), axis=1)) < 2e-3
    edges = np.concatenate([regime.edges for regime in regimes], axis=1).clip(start[:, None] * (1 + 1e-9), END)
    before, after = states(regimes, edges * (1 - 1e-12)), states(regimes, edges * (1 + 1e-12))
    size = np.abs(before[:, :, 2]) + parameters[:, :1]
    # A passage to plasticity can be as narrow as 1e-6 of u.
    assert np.all(np.abs(after - before)[:, :, 2] <= 1e-5 * size)
    assert np.quantile(np.abs(after - before)[:, :, 2] / size, 0.99) < 1e-9


def test_sums_are_finite_and_areas_positive_everywhere():
    count = 4000
    laws, h = random_laws(count, 7), separations(count, 7)
    regimes = graded.graded_regimes(*laws)
    found = summation.scattered(regimes, h, GAUSSIAN)
    assert np.all(np.isfinite(found)) and np.all(found[:, :, [0, 2, 3, 4]] >= -1e-25)
    touching = [0.5 * math.erfc(z / math.sqrt(2)) for z in h]
    np.testing.assert_allclose(found[:, :, 0].sum(axis=0), touching, rtol=1e-9)


def test_soft_film_on_a_hard_substrate_goes_through_the_four_stages_of_the_paper():
    theta, lam, n_E, n_H, tau = np.array([[1e4], [1e7], [0.5], [0.1], [0.35]])
    nu, k = np.array([0.3]), np.array([2.8])
    substrate, film = groups(theta, lam, nu, k), groups(theta * n_E, lam * n_H**4 / n_E**2, nu, k)
    regimes = graded.graded_regimes(substrate, film, n_E, n_H, tau, 0.05 * tau)
    order = []
    for _, _, state, body in segments(regimes, 0):
        if (body, state) not in order[-1:]:
            order.append((body, state))
    wanted = [("film", "elastic"), ("film", "plastic"), ("substrate", "elastic"), ("substrate", "plastic")]
    assert [stage for stage in order if stage != ("substrate", "plastic")][:3] == wanted[:3], order
    assert order[-1] == wanted[3]


def test_segments_of_all_parts_cover_every_depth_once():
    regimes = graded.graded_regimes(*random_laws(500, 8))
    for law in range(500):
        found = segments(regimes, law)
        assert all(this[1] == following[0] for this, following in itertools.pairwise(found))
        bodies = [body for *_, body in found]
        assert bodies == sorted(bodies)  # film, then substrate


def cut_finely(regime):
    """The same regime with every segment cut into 32 and, closer and closer, towards both ends: a kink or a square root that
    was missed is then felt in a small part only. Narrow segments in 8, or not at all: parts would be too narrow for h + w."""
    ends = 10.0 ** np.arange(-4, -1)
    parts = np.unique(np.concatenate([[0, 1], ends, 1 - ends, np.linspace(0, 1, 33)]))
    low, high = regime.edges[:, :-1, None], regime.edges[:, 1:, None]
    width = high / np.maximum(low, 1e-100) - 1
    shares = np.where(width > 1e-3, parts, np.where(width > 1e-7, np.minimum(np.arange(parts.size) / 8, 1), parts == 1))
    cut = np.where(high > 1e6, low * (1 + np.maximum(width, 0)) ** shares, low + (high - low) * shares)
    cut[:, :, [0, -1]] = np.concatenate([low, high], axis=2)
    return replace(regime, edges=cut.reshape(len(cut), -1))


@pytest.mark.parametrize("coated", [True, False])
def test_sums_are_as_good_as_the_record_says(coated):
    """Over the whole range, thinnest films included, against finely cut segments."""
    count = 4000
    laws, h = random_laws(count, 11), separations(count, 11)
    regimes = graded.graded_regimes(*laws) if coated else graded.bare_regimes_with_transition(laws[0])
    (found, _), (expected, size) = sums(regimes, h), sums([cut_finely(regime) for regime in regimes], h)
    size[:, 1] += 1e-3 * size[:, 2]  # the load's terms cancel within a regime too
    errors = np.max(np.abs(found - expected) / (size + 1e-280), axis=1)
    assert errors.max() < (graded.RECORD.accuracy if coated else 1e-10)
    assert np.mean(errors > 1e-10) <= 3e-4


def test_grid_agrees_with_single_separations():
    laws = random_laws(60, 9)
    regimes = graded.graded_regimes(*laws)
    h = np.linspace(-4, 6, 100)
    found = summation.on_grid(regimes, h, GAUSSIAN)
    single = summation.scattered(regimes, np.tile(h, 60), GAUSSIAN, np.repeat(np.arange(60), 100))
    single = single.reshape(4, 60, 100, 5).transpose(0, 1, 3, 2)
    size = np.abs(single[:, :, 1:2]) + single[:, :, 2:3]
    assert np.all(np.abs(found - single) <= 1e-8 * np.where(np.arange(5)[:, None] == 1, size, np.abs(single)) + 1e-25)


def test_bad_input_is_refused():
    substrate, film, *others = random_laws(3, 10)
    with refusal("m_soft", "3", "1", "2"):
        graded.graded_regimes(substrate, film, *others, exponents=(3, 1))
    problem = problem_of(substrate, Choice(options={"variant": "published", "transition": "gradual"}))
    with refusal("transition", "gradual", "jump"):
        assert problem.regimes
