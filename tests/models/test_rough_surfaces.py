"""Rough-surface models against independent integrals, printed tables and limits.

Sections 0, C and E name the compendium of published models this project works from; "theory" is docs/theory.md. The tables in
reference are described there.
"""

import math
from itertools import pairwise

import numpy as np
import pytest
from numpy.polynomial.legendre import leggauss
from numpy.testing import assert_allclose
from scipy.optimize import minimize_scalar

from stiction.engine.heights import empirical, exponential_heights, gaussian, weibull
from stiction.engine.summation import on_grid, scattered
from stiction.laws.rough_surface import (
    chang_etsion_bogy_1988,
    fuller_tabor_1975,
    greenwood_williamson_1966,
    rough_dmt,
    soft_coating_2015,
)
from stiction.solving.choice import Choice
from stiction.solving.evaluate import evaluate
from stiction.solving.problem import problem_of
from tables import FILM_COLUMNS, assert_near, column, groups, groups_of, read

pytestmark = pytest.mark.usefixtures("always_grid")
WAYS = ("scattered", "on_grid")


def regimes_of(module, given, **options):
    return problem_of(given, Choice(module.RECORD.key, options=options)).regimes


def sums(module, given, h, way="scattered", heights=None, **options):
    """Sums of each regime (regimes, n, 5): law i at h[i], whichever way it is computed."""
    regimes = regimes_of(module, given, **options)
    heights = heights or gaussian()
    h = np.asarray(h, dtype=float)
    if way == "scattered":
        return scattered(regimes, h, heights)
    return np.stack([np.diagonal(one, axis1=0, axis2=2).T for one in on_grid(regimes, h, heights)])


def F_rows(shape_of_heights, n):
    key, _, shape = shape_of_heights.partition(" ")
    return [row for row in read("greenwood_williamson_1966.csv") if (row["heights"], row["shape"], row["n"]) == (key, shape, n)]


DISTRIBUTIONS = {
    "gaussian": gaussian(),
    "exponential": exponential_heights(),
    "weibull 2": weibull(2.0),
    "weibull 3.4": weibull(3.4),
}


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("key", DISTRIBUTIONS)
def test_greenwood_williamson(key, way):
    """Count F_0, area F_1 and load F_(3/2) of reference/greenwood_williamson_1966.csv."""
    for place, n in ((0, "0"), (2, "1"), (1, "1.5")):
        rows = F_rows(key, n)
        assert len(rows) == 21
        h = column(rows, "h")
        found = sums(greenwood_williamson_1966, groups(np.ones(h.size)), h, way, DISTRIBUTIONS[key])[0, :, place]
        assert_allclose(found, column(rows, "F_n"), rtol=1e-10)


GAUSSIAN_F = [  # h, F_0, F_1, F_(3/2): table E1, Gaussian
    (0.0, 0.5, 0.3989423, 0.4300200),
    (0.5, 0.3085375, 0.1977966, 0.1952036),
    (1.0, 0.1586553, 0.0833155, 0.0756682),
    (1.5, 6.680720e-2, 2.930679e-2, 2.463948e-2),
    (2.0, 2.275013e-2, 8.490703e-3, 6.648178e-3),
    (3.0, 1.349898e-3, 3.821543e-4, 2.639676e-4),
    (4.0, 3.167124e-5, 7.145258e-6, 4.439155e-6),
]


@pytest.mark.parametrize("way", WAYS)
def test_greenwood_williamson_printed_digits(way):
    """Table E1, to its seven digits."""
    h, count, area, load = np.array(GAUSSIAN_F).T
    found = sums(greenwood_williamson_1966, groups(np.ones(h.size)), h, way)[0]
    assert_allclose(found[:, [0, 2, 1]], np.stack([count, area, load], axis=1), rtol=4e-7)


def test_exponential_heights_make_area_proportional_to_load():
    """Greenwood & Williamson 1966: with exponential heights P/A = Gamma(5/2) at every separation."""
    h = np.linspace(-1.0, 10.0, 12)
    found = sums(greenwood_williamson_1966, groups(np.ones(h.size)), h, heights=exponential_heights())[0]
    assert_allclose(found[:, 1] / found[:, 2], math.gamma(2.5), rtol=1e-11)


def test_empirical_heights():
    """Measured heights under Greenwood & Williamson: a plain sum over the frequency polygon, in numpy."""
    heights = empirical(np.random.default_rng(23).gumbel(size=4000), cells=25)
    h = np.linspace(-1.0, 2.0, 13)
    found = sums(greenwood_williamson_1966, groups(np.ones(h.size)), h, heights=heights)[0]
    t, weight = leggauss(60)
    expected = np.zeros((h.size, 2))
    for i, low in enumerate(h):
        ends = np.concatenate([[low], heights.knots[heights.knots > low]])
        for a, b in pairwise(ends):
            v = (b - a) ** 0.5 * (1.0 + t) / 2.0  # z = a + v^2
            z, step = a + v * v, (b - a) ** 0.5 * weight * v
            mass = step * np.interp(z, heights.knots, heights.shape[2:])
            expected[i] += [np.sum(mass * (z - low)), np.sum(mass * (z - low) ** 1.5)]
    assert_allclose(found[:, [2, 1]], expected, rtol=1e-10)


@pytest.mark.parametrize("way", WAYS)
def test_rough_dmt(way):
    """reference/rough_dmt.csv; the load against the sum of its two terms."""
    rows = read("rough_dmt.csv")
    h, theta, load, area, count = (column(rows, name) for name in ("h", "theta", "load", "area", "touching_asperities"))
    found = sums(rough_dmt, groups(theta), h, way)[0]
    assert_near(found[:, 1], load, 1e-10, np.abs(load) + 4 * math.pi / theta * count)
    assert_near(found[:, 2], area, 1e-10)
    assert_near(found[:, 0], count, 1e-10)


def tension(h, theta):
    return -float(sums(fuller_tabor_1975, groups(np.array([theta])), [h], branch="unloading")[0, 0, 1])


def test_fuller_tabor_pull_off():
    """reference/fuller_tabor_1975.csv: the largest tension over N times (3/2) pi gamma R, and where."""
    rows = read("fuller_tabor_1975.csv")
    assert len(rows) == 13
    for theta, largest, at in zip(*(column(rows, name) for name in ("theta", "largest_tension", "h")), strict=True):
        best = minimize_scalar(lambda h: -tension(h, theta), bounds=(at - 1.0, at + 1.0), options={"xatol": 1e-9})  # noqa: B023
        assert -best.fun / (1.5 * math.pi / theta) == pytest.approx(largest, rel=1e-10)
        assert best.x == pytest.approx(at, abs=2e-6)


PULL_OFF = [(0.1, 0.99384), (0.5, 0.81231), (1.0, 0.50465), (2.0, 0.14398), (2.38, 0.08220), (3.0, 0.02994)]


@pytest.mark.parametrize(("inverse_delta_c", "largest"), PULL_OFF)
def test_fuller_tabor_pull_off_printed_digits(inverse_delta_c, largest):
    """Theory 7 and table E4: theta^(2/3)/1.94889 and Fuller & Tabor's curve."""
    theta = (inverse_delta_c * 1.94889) ** 1.5
    scan = [tension(h, theta) / (1.5 * math.pi / theta) for h in np.linspace(-1.0, 6.0, 701)]
    assert max(scan) == pytest.approx(largest, abs=2e-5)  # the grid misses the top by up to 1e-5


def test_fuller_tabor_starts_and_ends():
    """JKR asperities hold down to w = -1.94889 theta^(-2/3) and touch at w = 0 (theory 7): counts are Q(h) at those."""
    theta = np.array([0.1, 3.0, 50.0])
    for h in (-1.0, 0.5, 2.0):
        place = np.full(3, h)
        on, off = (sums(fuller_tabor_1975, groups(theta), place, branch=branch)[0, :, 0] for branch in ("loading", "unloading"))
        assert_allclose(on, math.erfc(h / math.sqrt(2.0)) / 2.0, rtol=1e-12)
        expected = [math.erfc((h - 1.94889 * one ** (-2 / 3)) / math.sqrt(2.0)) / 2.0 for one in theta]
        assert_allclose(off, expected, rtol=5e-6 * 30)  # 1.94889 has six digits


@pytest.mark.parametrize("way", WAYS)
def test_unloading(way):
    """reference/unloading.csv: the corrected bare surface, asperities attached until they snap off."""
    rows = read("unloading.csv")
    found = sums(soft_coating_2015, groups_of([row | {"n_E": ""} for row in rows]), column(rows, "h"), way, branch="unloading")
    count, load, area, slip_limited, yield_limited = found.sum(axis=0).T
    assert_near(load, column(rows, "load"), 1e-10, column(rows, "abs_load"))
    assert_near(area, column(rows, "area"), 1e-10)
    assert_near(slip_limited + yield_limited, column(rows, "friction"), 1e-10)
    assert_near(count, column(rows, "attached_asperities"), 1e-10)


def ceb_groups(psi, nu=0.3):
    """Groups with omega_c = sigma/psi^2: omega_c = ((2/3) K_H eta)^2 and eta = sqrt(pi) 18^(1/4) lambda^(1/4) at theta = 1."""
    eta = 1.5 / ((0.454 + 0.41 * nu) * np.asarray(psi))
    return groups(1.0, (eta / (math.sqrt(math.pi) * 18**0.25)) ** 4, nu)


@pytest.mark.parametrize("way", WAYS)
def test_chang_etsion_bogy(way):
    """reference/chang_etsion_bogy.csv: over N P_c, N pi R w_c and N P_c, P_c = w_c^(3/2)."""
    rows = read("chang_etsion_bogy.csv")
    psi = column(rows, "psi")
    count, load, area, slip_limited, yield_limited = (
        sums(chang_etsion_bogy_1988, ceb_groups(psi), column(rows, "h"), way).sum(axis=0).T
    )
    assert_near(load * psi**3, column(rows, "load"), 1e-10)
    assert_near(area * psi**2, column(rows, "area"), 1e-10)
    assert_near((slip_limited + yield_limited) * psi**3, column(rows, "friction"), 1e-10)
    assert_near((slip_limited + yield_limited) / load, column(rows, "friction_coefficient"), 1e-10)
    assert_near(count, [math.erfc(h / math.sqrt(2.0)) / 2.0 for h in column(rows, "h")], 1e-12)


CEB_MU = [  # psi, h, mu: table C5, column CEB (C2); the last digit of some is cut, not rounded
    (0.5, 1, 0.7543), (0.5, 3, 1.0306), (1, 1, 0.1607), (1, 2, 0.2673), (1, 3, 0.3758), (2, 1, 0.0094), (2, 2, 0.0193),
    (2, 3, 0.0335), (4, 2, 0.0012), (8, 3, 0.0001),
]  # fmt: skip


@pytest.mark.parametrize(("psi", "h", "mu"), CEB_MU)
def test_chang_etsion_bogy_printed_digits(psi, h, mu):
    _, load, _, slip_limited, yield_limited = sums(chang_etsion_bogy_1988, ceb_groups([psi]), [h]).sum(axis=0)[0]
    assert (slip_limited + yield_limited) / load == pytest.approx(mu, abs=1.01e-4)


GROUPS_OF_ASPERITIES = {  # column prefix in parts.csv -> labels of the regimes that make it, on a coated surface
    "film_elastic": ("film", "elastic"),
    "film_plastic": ("film", "plastic"),
    "film_held": ("film", "held"),
    "substrate_elastic": ("substrate", "elastic"),
    "substrate_plastic": ("substrate", "plastic"),
}


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("coated", (False, True))
def test_parts(coated, way):
    """reference/parts.csv: the same sums by what answers (body), how (state) and what limits friction."""
    rows = [row for row in read("parts.csv") if bool(row["n_E"]) == coated]
    assert len(rows) == (6 if coated else 5)
    given, h = groups_of(rows), column(rows, "h")
    regimes = regimes_of(soft_coating_2015, given)
    found = sums(soft_coating_2015, given, h, way)
    whole = np.abs(column(rows, "load")) + sum(np.abs(column(rows, f"{name}_load")) for name in GROUPS_OF_ASPERITIES)
    for name, (body, state) in GROUPS_OF_ASPERITIES.items():
        body = body if coated or body == "film" else "bare"
        part = np.array([(regime.body, regime.state) == (body, state) for regime in regimes])
        assert part.any() or not column(rows, f"{name}_load").any()
        _, load, _, slip_limited, yield_limited = found[part].sum(axis=0).T
        assert_near(load, column(rows, f"{name}_load"), 1e-10, whole, name)
        for kind, value in (("slip", slip_limited), ("yield", yield_limited)):
            if f"{name}_friction_{kind}" in rows[0]:
                assert_near(value, column(rows, f"{name}_friction_{kind}"), 1e-10, what=f"{name} {kind}")
            else:
                assert "plastic" in name and not value.any()
    counts = {}
    for name, (body, state) in GROUPS_OF_ASPERITIES.items():
        if name == "film_held":
            continue  # asperities that have pressed the film through are counted in the substrate's groups
        body = body if coated or body == "film" else "bare"
        in_group = np.array([(regime.body, regime.state) == (body, state) for regime in regimes])
        if body == "film":  # of the film, those with w < t: the regimes that bear a load of their own
            in_group &= np.array([not _beyond(regime, given) for regime in regimes])
        counts[name] = found[in_group, :, 0].sum(axis=0)
        assert_near(counts[name], column(rows, f"{name}_asperities"), 1e-10, what=name)
    touching = np.array([regime.touching for regime in regimes])
    assert_near(found[touching, :, 0].sum(axis=0), column(rows, "touching_asperities"), 1e-10)
    assert_near(found[..., 2].sum(axis=0), column(rows, "area"), 1e-10)
    assert_near(found[..., 3:].sum(axis=(0, 2)), column(rows, "friction"), 1e-10)
    assert_near(found[..., 1].sum(axis=0), column(rows, "load"), 1e-10, whole)


def _beyond(regime, given) -> bool:
    """Whether a film regime lies beyond the film's thickness: there its force is multiplied by nothing."""
    *_, force, _, _ = regime.parameters  # of joined regimes the last five are those of Weights
    return regime.state != "held" and not np.any(force)


def test_parts_are_not_counted_twice():
    """Regimes that touch partition the asperities, on every coated surface: their count is Q(h)."""
    rng = np.random.default_rng(29)
    n = 300
    film = {"n_E": 10 ** rng.uniform(-2, 2, n), "n_H": 10 ** rng.uniform(-2, 2, n), "tau": rng.uniform(0, 8, n)}
    given = groups(10 ** rng.uniform(-3, 8, n), 10 ** rng.uniform(-6, 8, n), rng.uniform(0, 0.499, n), **film)
    h = rng.uniform(-6, 8, n)
    areas = []
    for aspect in (np.inf, 0.3):
        limited = groups(given.theta, given.lam, given.nu, **film, film_aspect=aspect)
        regimes = regimes_of(soft_coating_2015, limited)
        touching = np.array([regime.touching for regime in regimes])
        found = scattered(regimes, h, gaussian())
        assert_near(found[touching, :, 0].sum(axis=0), np.array([math.erfc(z / math.sqrt(2.0)) / 2.0 for z in h]), 1e-10)
        assert all(regime.in_half_space for regime in regimes) == np.isinf(aspect)
        areas.append(found[..., 2].sum(axis=0))
    assert_near(areas[1], areas[0], 1e-10)  # marking asperities beyond the half-space moves no sum


@pytest.mark.parametrize(("film", "published", "corrected"), [  # theory 6: theta = 40, lambda = 10, mu at h = 1
    ({}, 0.82277, 0.25270),
    ({"n_E": 1.5, "n_H": 0.5, "tau": 2.0}, 0.07774, 0.04525),
    ({"n_E": 1.5, "n_H": 0.5, "tau": 6.0}, 0.07489, 0.04299),
    ({"n_E": 0.5, "n_H": 0.8, "tau": 2.0}, 2.5705, 0.90979),
])  # fmt: skip
def test_friction_coefficients_of_the_figures(film, published, corrected):
    for variant, mu in (("published", published), ("corrected", corrected)):
        found = evaluate(1.0, 40.0, 10.0, **film, variant=variant)
        assert found.friction_force / found.load == pytest.approx(mu, abs=5.1e-6 if mu < 2 else 5.1e-5)


@pytest.mark.parametrize(("theta", "lam", "h", "literal", "consistent"), [  # table 0.2.4: elastic, plastic, total
    (10, 1, -1, (0.17958, 0.13457, 0.31415), (0.99763, 0.13457, 1.13220)),
    (10, 1, 0, (-0.00011, 0.00716, 0.00705), (0.24336, 0.00716, 0.25052)),
    (10, 1, 1, (-0.00469, 0.00015, -0.00454), (0.01675, 0.00015, 0.01690)),
    (10, 1, 2, (None, None, -0.00047), (None, None, -0.00194)),
    (1, 100, 0, (None, None, -0.00007), (None, None, -1.51691)),
    (1, 100, 1, (None, None, -0.00000), (None, None, -0.55306)),
    (100, 100, 0, (0.22122, 0.14445, 0.36567), (0.31720, 0.14445, 0.46165)),
    (100, 100, 1, (0.03588, 0.00885, 0.04473), (0.06446, 0.00885, 0.07331)),
])  # fmt: skip
def test_elastic_and_plastic_loads(theta, lam, h, literal, consistent):
    for variant, expected in (("published", literal), ("corrected", consistent)):
        given = groups(float(theta), float(lam))
        regimes = regimes_of(soft_coating_2015, given, variant=variant)
        found = sums(soft_coating_2015, given, [h], variant=variant)[:, 0, 1]
        by_state = [sum(found[[regime.state == state for regime in regimes]]) for state in ("elastic", "plastic")]
        for value, printed in zip([*by_state, sum(by_state)], expected, strict=True):
            assert printed is None or value == pytest.approx(printed, abs=5.1e-6)


def plain_sum(f, low, high, h):
    """Int_low^high f(w) phi(h + w) dw by Gauss-Legendre on short panels, w = low + v^2."""
    t, weight = leggauss(40)
    ends = np.linspace(0.0, math.sqrt(min(high, low + 12.0) - low), 60)
    v = (ends[:-1, None] + np.diff(ends)[:, None] * (1.0 + t) / 2.0).ravel()
    step = (np.diff(ends)[:, None] * weight / 2.0).ravel() * 2.0 * v
    w = low + v * v
    return float(np.sum(step * f(w) * np.exp(-((h + w) ** 2) / 2.0))) / math.sqrt(2.0 * math.pi)


@pytest.mark.parametrize("eta", (0.5, 1.0, 2.0))
@pytest.mark.parametrize("h", (-1.0, 0.0, 2.0))
def test_limit_without_adhesion(eta, h):
    """Theory 7: theta -> inf at fixed eta (lambda = eta^4 theta^2/(18 pi^2)): P = w^(3/2) up to w1 = eta^2, then 2 eta w; no
    friction, for nothing adheres."""
    theta = 1e30
    found = evaluate(h, theta, eta**4 * theta**2 / (18.0 * math.pi**2))
    load = plain_sum(lambda w: w**1.5, 0.0, eta**2, h) + plain_sum(lambda w: 2.0 * eta * w, eta**2, math.inf, h)
    area = plain_sum(lambda w: w, 0.0, eta**2, h) + plain_sum(lambda w: 2.0 * w, eta**2, math.inf, h)
    assert found.load == pytest.approx(load, rel=1e-9)
    assert found.contact_area == pytest.approx(area, rel=1e-9)
    assert found.friction_force < 1e-10 * found.load


def test_friction_fades_with_adhesion():
    """Theory 7: friction -> 0 at fixed eta as theta -> inf; slip resistance falls as theta^(-1/2)."""
    theta = 10.0 ** np.array([8.0, 12.0, 16.0])
    friction = evaluate(0.0, theta, theta**2).friction_force
    assert_allclose(friction[:-1] / friction[1:], 1e2, rtol=0.01)


@pytest.mark.parametrize("h", (-2.0, 0.0, 2.0))
def test_limit_of_a_thick_film(h):
    """Theory 7: tau -> inf gives the film's bare law times n_E, in the film's own indices (theory 4), in the corrected
    variant; without n_E (D4) as published."""
    theta, lam, n_E, n_H = 40.0, 10.0, 0.5, 0.8
    film = {"n_E": n_E, "n_H": n_H, "tau": 1e3}
    for variant, factor in (("corrected", n_E), ("published", 1.0)):
        coated = evaluate(h, theta, lam, **film, variant=variant)
        alone = evaluate(h, theta * n_E, lam * n_H**4 / n_E**2, variant=variant)
        assert coated.friction_force == pytest.approx(factor * alone.friction_force, rel=1e-10)
        assert coated.contact_area == pytest.approx(float(alone.contact_area), rel=1e-10)
        if variant == "corrected":
            assert coated.load == pytest.approx(float(factor * alone.load), rel=1e-10)
        else:  # as printed, the substrate's plastic integral starts at w1, however thick the film (D5)
            first = groups(theta, lam)
            plastic = sums(soft_coating_2015, first, [h], variant="published")[1, 0, 1]
            assert coated.load == pytest.approx(float(alone.load) + plastic, rel=1e-10)


def test_film_of_the_substrate_with_no_thickness():
    """As the corrected film is defined, none is left but the adhesion of its first touch: -4 pi/(3 theta) Q(h)."""
    h, theta, lam = np.linspace(-2.0, 3.0, 6), 40.0, 10.0
    bare = evaluate(h, theta, lam)
    coated = evaluate(h, theta, lam, n_E=1.0, n_H=1.0, tau=0.0)
    touching = np.array([math.erfc(one / math.sqrt(2.0)) / 2.0 for one in h])
    assert_allclose(coated.load, bare.load - 4.0 * math.pi / (3.0 * theta) * touching, rtol=1e-10, atol=1e-14)


def test_columns_of_the_film():
    """The tables' names of the film's groups are those of stiction.evaluate."""
    assert list(FILM_COLUMNS) == ["n_E", "n_H", "tau"]
