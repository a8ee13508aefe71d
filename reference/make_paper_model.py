"""The model of the 2015 paper and its parts, from paper_equations.py: mpmath. Takes about two minutes.

    python make_paper_model.py [file ...]       # all files when none is named
    python make_paper_model.py --check OTHER.csv    # compare a table of the same columns with these equations

- `paper_model_own.csv` of `soft_coating_2015`, `sequential`, `printed`: `load`, `area`, `friction`, `abs_load`; 4 kinds
  (corrected or published variant, bare or coated): 60 random inputs over the whole range (h -6..8, theta 1e-3..1e8, lambda
  1e-6..1e8, nu 0..0.499, H/Y 1.5..4, n_E and n_H 1e-2..1e2, t 0..1e3) and 34 picked beside a kink or a corner
- `asperity.csv` of `soft_coating_2015` (tangential law): one asperity, both readings, five points of the elastic range: `x0`,
  `x1`, `w1`, plastic load at w1, K beta, number of slip = yield crossings between x0 and x1; `x`, `w`, `load`, `slip`, `yield`
- `unloading.csv` of `soft_coating_2015`: corrected, bare, asperities attached down to 4 u^3 = s (x = 0.64963 theta^(-2/3)); as
  the first, and `attached_asperities`
- `fuller_tabor_1975.csv`: elastic JKR asperities on the unloading branch, largest tension over N (3/2) pi gamma R, and h there;
  `inverse_delta_c` = theta^(2/3)/1.94889
- `parts.csv` of `soft_coating_2015`: corrected variant, the same sums by group of asperities, see below

How:

- `paper_equations.py` holds the equations. Elastic integrals run in u = x^(1/4), split at P = 0, at the branch point
  and the zero of the yield force (both roots of a cubic), at u^3 = S/2 (where the slip force touches zero, unloading
  only) and at every crossing of slip and yield; u = u_branch + v^2 takes the square root of the yield force away.
  Crossings: 23000-point scan, near misses searched for a hidden pair, then bisection to all digits. Gauss-Legendre
  with 32 nodes; panels are halved until the sum stands still to 1e-21 of the integral of |integrand|. Plastic
  integrals are closed forms.
- In the corrected variant (2 pi/theta) P + 3 pi^2/theta^2 = (2 pi/theta)(u^3 - S/2)^2 with S = sqrt(6 pi/theta), so
  the slip force has no square root; the unloading forces follow the same formula past pull-off.
- Checked: the number of elastic asperities against Q(h + start) - Q(h + end), all bare rows, to 1e-18; ten bare rows
  (five random, five picked) and three unloading rows against mpmath's tanh-sinh `quad` in x with the formulas as they
  stand, to 1e-14 (its tolerance is absolute: scale tiny integrands first); 160 rows of an earlier independent table
  of this model, largest departure 4.5e-15 (it prints 15 digits); the pull-off against the six values that the model's
  derivation prints. `--check` prints the largest departure.
- Random part of `paper_model_own.csv`: fixed seed, half of the t uniform in 0..8, the rest log-uniform in 8..1e3.
  Picked part: both sides of six tangencies of slip and yield, branch point at x0 (1e-6 and 1e-12 beside it), zero of
  the yield force at x1, h = -6 and -4 with theta 300..1000 and lambda 1e6, t 1e-9 beside the film's w1 on either
  side, t = 0, nu = 0 and .499, corners of the range, and a film like the substrate. Bare rows leave n_E, n_H and t
  empty.

What a test of these must share:

- `abs_load` is the integral of |load integrand|; in the corrected coated variant the film's term n_E |P_c(t)| Q(h+t)
  is one more part. Judge loads against it, not against `load`.
- Published `area`, which the paper does not define as a sum over heights: bare Int_{x0}^{x1} x phi(h+x) dx +
  Int_{w1}^inf 2w phi(h+w) dw; coated the same with the film's law. Corrected coated `area`: the film's law at the
  full displacement.
- Published `friction` has exp(-z^2/2) without 1/sqrt(2 pi); crossed limits give nothing.
- t = 0 is the formula itself: the film is held at P_c(w = 0) = -4 pi/(3 theta_c), so it is not the bare surface.
- At w = w1 the asperity is plastic (so is a film with t = w1; in doubles that side cannot be told, so no row sits
  there).
- Up to three crossings of slip and yield occur, see `asperity.csv` and the tangent rows.
- In `parts.csv` `film_elastic` and `film_plastic` are asperities with w < t, `film_held` what the film keeps under
  asperities with w >= t (they are counted in the substrate groups), `substrate_*` the substrate's own law at h + t;
  film forces already times n_E. On a bare surface everything is substrate. `load` and `friction` are the sums of
  their groups, `touching_asperities` is Q(h); `area` is the total of the film's law (bare: of the substrate's).
"""

import csv
import random
import sys
from pathlib import Path

from mpmath import mp, mpf
from paper_equations import (
    PARTS,
    Law,
    add,
    bare_parts,
    bisect,
    coated_corrected,
    density,
    elastic,
    evaluate,
    exact,
    film_law,
    force,
    integrate,
    plastic,
)

HERE = Path(__file__).parent
DIGITS = 17
INPUTS = ("h", "theta", "lambda", "nu", "H_over_Y")
COATING = ("n_E", "n_H", "t")
KINDS = [(variant, coated) for variant in ("corrected", "published") for coated in (False, True)]


def printed(value):
    return mp.nstr(value, DIGITS, strip_zeros=False) if isinstance(value, mpf) else str(value)


def write(name, header, rows):
    with (HERE / name).open("w", newline="", encoding="utf-8") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(header)
        for row in rows:
            out.writerow([printed(value) for value in row])
            file.flush()


def near(value, relative):
    """A double within rounding of value (1 + relative), so that the printed input is the one used."""
    return float(value * (1 + mpf(relative)))


# --- 1. paper_model_own.csv -----------------------------------------------------------------------


def log_uniform(rng, low, high):
    return float(f"{low * (high / low) ** rng.random():.4g}")


def random_cases(count=60, seed=20150101):
    """(h, theta, lambda, nu, H/Y, n_E, n_H, tau) over the widest range that the package accepts."""
    rng = random.Random(seed)
    for i in range(count):
        tau = round(8 * rng.random(), 3) if i % 2 else log_uniform(rng, 8, 1e3)
        nu, k = round(0.499 * rng.random(), 3), round(1.5 + 2.5 * rng.random(), 2)
        h, theta = round(-6 + 14 * rng.random(), 2), log_uniform(rng, 1e-3, 1e8)
        lam, n_E, n_H = log_uniform(rng, 1e-6, 1e8), log_uniform(rng, 1e-2, 1e2), log_uniform(rng, 1e-2, 1e2)
        yield h, theta, lam, nu, k, n_E, n_H, tau


def film_yield_depth(theta, lam, nu, k, n_E, n_H):
    return film_law(Law(*(exact(v) for v in (theta, lam, nu, k))), exact(n_E), exact(n_H)).w1


def branch_at_start(theta, nu, k):
    """lambda at which the branch point of the yield force lies at x0, the start of contact."""

    def distance(log_lam):
        law = Law(exact(theta), mp.exp(log_lam), exact(nu), exact(k))
        return law.u_branch - law.u0

    return mp.exp(bisect(distance, mpf(-30), mpf(30)))


# (published?, theta, nu, k, two values of eta S^(-2/3) between which the number of crossings changes by two)
TANGENT = [
    (False, 300.0, 0.45, 4.0, "4.5446", "4.5709"),
    (False, 1.0, 0.45, 2.8, "3.408", "3.4277"),
    (False, 40.0, 0.499, 4.0, "4.5446", "4.5709"),
    (True, 1.0, 0.3, 2.8, "5.0699", "5.0992"),
    (True, 40.0, 0.3, 2.8, "5.1582", "5.188"),
    (True, 300.0, 0.4, 2.0, "3.4874", "3.5075"),
]


def tangent_lambda(published, theta, nu, k, low, high):
    """lambda on both sides of the tangency of slip and yield, by bisection on the number of crossings."""

    def lam(scaled):
        eta = scaled * mp.cbrt(6 * mp.pi / exact(theta))
        return (eta * mp.sqrt(exact(theta) / mp.pi)) ** 4 / 18

    def crossings(scaled):
        law = Law(exact(theta), lam(scaled), exact(nu), exact(k), published)
        return len(law.crossings(law.u0, law.u1))

    low, high = mpf(low), mpf(high)
    first = crossings(low)
    while high / low - 1 > mpf(10) ** -10:
        middle = (low + high) / 2
        low, high = (middle, high) if crossings(middle) == first else (low, middle)
    return lam(low), lam(high)


def nasty_cases():
    """Inputs picked to sit beside a kink, a limit or a corner of the range."""
    film = 0.7, 0.6, 2.5
    for published, theta, nu, k, low, high in TANGENT:
        for lam in tangent_lambda(published, theta, nu, k, low, high):
            yield 0.5, theta, near(lam, 0), nu, k, *film
    for theta, nu, k in ((5.0, 0.1, 2.8), (800.0, 0.3, 2.8)):
        lam = branch_at_start(theta, nu, k)
        for relative in (-1e-6, 1e-6, -1e-12):
            yield -1.0, theta, near(lam, relative), nu, k, *film
    # the zero of the yield force at x1: sqrt(3) k (1 - 2 nu) = 2
    for relative in (-1e-9, 1e-3):
        yield 0.0, 30.0, 20.0, near((1 - 2 / (mp.sqrt(3) * mpf("2.8"))) / 2, relative), 2.8, *film
    for h, theta in ((-6.0, 300.0), (-4.0, 550.0), (-6.0, 1000.0), (-4.0, 1e3)):
        yield h, theta, 1e6, 0.3, 2.8, 0.5, 0.8, 2.0
    for relative in (-1e-9, 1e-9):  # film as thick as its yield depth, where its load jumps
        law = 40.0, 10.0, 0.3, 2.8
        yield 0.0, *law, 1.5, 0.5, near(film_yield_depth(*law, 1.5, 0.5), relative)
    yield 1.0, 40.0, 10.0, 0.3, 2.8, 1.5, 0.5, 0.0
    yield -2.0, 2.0, 1e4, 0.3, 2.8, 0.5, 0.8, 0.0
    yield 1.0, 40.0, 10.0, 0.3, 2.8, 0.5, 0.8, 1e-9
    yield 0.0, 3.0, 50.0, 0.0, 1.5, 20.0, 0.3, 1.0
    yield 0.0, 3.0, 50.0, 0.499, 4.0, 0.05, 3.0, 1.0
    yield 8.0, 1e8, 1e8, 0.3, 2.8, 100.0, 100.0, 1000.0
    yield -6.0, 1e-3, 1e-6, 0.3, 2.8, 0.01, 0.01, 8.0
    yield 1.0, 40.0, 10.0, 0.3, 2.8, 1.0, 1.0, 2.0  # film as the substrate


def paper_model_own():
    def rows():
        for *law, n_E, n_H, tau in (*random_cases(), *nasty_cases()):
            for variant, coated in KINDS:
                film = (n_E, n_H, tau) if coated else None
                values = evaluate(variant, *map(exact, law), film and tuple(map(exact, film)))
                yield [variant, *law, *(film or ("", "", "")), *values]

    write("paper_model_own.csv", ["formulation", *INPUTS, *COATING, "load", "area", "friction", "abs_load"], rows())


# --- 2. asperity.csv ------------------------------------------------------------------------------

ASPERITIES = [
    (1, 100, 0.3, 2.8),
    (10, 1, 0.3, 2.8),
    (40, 10, 0.3, 2.8),
    (100, 1000, 0.25, 3),
    (3, 0.01, 0.4, 2.8),
    (1000, 1e6, 0, 1.5),
    (0.05, 2, 0.499, 4),
    (1e5, 1e4, 0.2, 2.8),
    # two and three crossings of slip and yield in the corrected variant, three in the published one
    (1, 22.8725, 0.499, 3),
    (300, 5522.02, 0.45, 4),
    (10, 907.748, 0.3, 2.8),
]


def asperity():
    def rows():
        for variant in ("corrected", "published"):
            for theta, lam, nu, k in ASPERITIES:
                law = Law(*(exact(v) for v in (theta, lam, nu, k)), variant == "published")
                crossings = law.crossings(law.u0, law.u1)
                for fraction in ("0.0625", "0.25", "0.5", "0.75", "0.9375"):
                    x = law.u0**4 + mpf(fraction) * (law.u1**4 - law.u0**4)
                    x = mpf(float(x))
                    u = mp.root(x, 4)
                    ends = law.u0**4, law.u1**4, law.w1, law.plastic_load(law.w1), law.K_beta, len(crossings)
                    here = x, law.w(u), law.load(u), law.slip_limited(u), law.yield_(u)
                    yield [variant, theta, lam, nu, k, *ends, *here]

    write(
        "asperity.csv",
        [
            "formulation",
            *INPUTS[1:],
            "x0",
            "x1",
            "w1",
            "plastic_load_at_w1",
            "K_beta",
            "crossings",
            "x",
            "w",
            "load",
            "slip",
            "yield",
        ],
        rows(),
    )


# --- 3. unloading.csv, fuller_tabor_1975.csv ---------------------------------------------------------------

UNLOADING = [
    (1, 40, 10, 0.3, 2.8),
    (0, 10, 1, 0.3, 2.8),
    (2, 10, 1, 0.3, 2.8),
    (0, 1, 100, 0.3, 2.8),
    (3, 1, 100, 0.3, 2.8),
    (-2, 100, 1000, 0.25, 3.0),
    (1.5, 100, 1e5, 0.25, 3.0),
    (1, 3, 0.01, 0.4, 2.8),
    (4, 5, 500, 0.0, 2.8),
    (0.5, 1000, 1e6, 0.45, 1.5),
    (-4, 300, 1e6, 0.3, 2.8),
    (2, 0.05, 2, 0.499, 4.0),
]


def unloading():
    def rows():
        for h, *numbers in UNLOADING:
            law = Law(*map(exact, numbers))
            total = add(elastic(law, exact(h), law.u_detached, law.u1), plastic(law, exact(h), law.w1))
            yield [h, *numbers, total["load"], total["area"], force(total), total["abs_load"], total["count"]]

    write("unloading.csv", [*INPUTS, "load", "area", "friction", "abs_load", "attached_asperities"], rows())


def fuller_tabor(ratio):
    """(largest tension over N pull-off forces, h there) for 1/Delta_c = theta^(2/3)/1.94889... = ratio."""
    # at detachment u^3 = s/4, so -w = 3 (s/4)^(4/3), and s^2 = 8 pi/(3 theta)
    theta = mp.sqrt(ratio * 3 * mp.cbrt(mpf(8) / 3 * mp.pi / 16) ** 2) ** 3
    law = Law(theta, mpf(1), mpf("0.3"), mpf("2.8"))  # elastic pieces only: lambda, nu and k do not enter
    pull_off = 3 * mp.pi / (2 * theta)

    def tension(h):
        def values(u):
            z = h + law.w(u)
            weight = density(z) * (4 * u**3 - law.s) * law.load(u)
            return [weight, z * weight]

        low = h + law.w(law.u_detached)
        top = mp.sqrt(max(low, mpf(0)) ** 2 + 200) - h
        end = bisect(lambda u: law.w(u) - top, law.u_detached, law.u0 + mp.root(top + 1, 4))
        load, slope = integrate(values, law.u_detached, end)
        return -load / pull_off, slope

    # the tension is one hump in h: scan for the sign change of its slope, then the root
    grid = [mpf(i) / 4 for i in range(-4, 41)]
    slopes = [tension(h)[1] for h in grid]
    best = max(
        (tension(a)[0], a, b) for a, b, p, q in zip(grid, grid[1:], slopes, slopes[1:], strict=False) if (p > 0) != (q > 0)
    )
    h = mp.findroot(lambda v: tension(v)[1], best[1:], solver="anderson", tol=mpf(10) ** -44)
    return theta, tension(h)[0], h


def fuller_tabor_1975():
    ratios = ["0.1", "0.2", "0.3", "0.5", "0.75", "1", "1.25", "1.5", "2", "2.38", "2.5", "3", "4"]
    write(
        "fuller_tabor_1975.csv",
        ["inverse_delta_c", "theta", "largest_tension", "h"],
        ([r, *fuller_tabor(mpf(r))] for r in ratios),
    )


# --- 6. parts.csv ---------------------------------------------------------------------------------

SPLITS = [
    (1, 40, 10, 0.3, 2.8),
    (0, 10, 1, 0.3, 2.8),
    (-1, 1, 100, 0.3, 2.8),
    (2, 100, 1000, 0.25, 3),
    (0.5, 300, 1e6, 0.45, 2.8),
    (1, 40, 10, 0.3, 2.8, 1.5, 0.5, 2),
    (1, 40, 10, 0.3, 2.8, 0.5, 0.8, 2),
    (0, 1, 100, 0.3, 2.8, 0.5, 0.8, 4),
    (-2, 100, 1000, 0.25, 3, 2.5, 0.2, 0.5),
    (-1, 10, 1, 0.3, 2.8, 0.3, 0.1, 6),
    (-3, 300, 1e6, 0.3, 2.8, 20, 3, 0.02),
]


def split(h, theta, lam, nu, k, n_E=None, n_H=None, tau=None):
    """The five groups of asperities, each with all PARTS; groups that a case lacks are zero."""
    law = Law(*map(exact, (theta, lam, nu, k)))
    if n_E is None:
        none = dict.fromkeys(PARTS, mpf(0))
        pieces = bare_parts(law, exact(h))
        return [none, none, none, *pieces], add(*pieces)["area"]
    film = film_law(law, exact(n_E), exact(n_H))
    pieces, held, substrate, outer = coated_corrected(law, film, exact(h), exact(n_E), exact(tau))
    # the asperities of `held` are those of the substrate parts: counted once, there
    return [*pieces, held | {"count": mpf(0)}, *substrate], add(*outer)["area"]


def parts():
    groups = ("film_elastic", "film_plastic", "film_held", "substrate_elastic", "substrate_plastic")
    header = [
        *INPUTS,
        *COATING,
        *(f"{g}_load" for g in groups),
        *(f"{g}_friction_{limit}" for g in (groups[0], *groups[2:4]) for limit in ("slip", "yield")),
        *(f"{g}_asperities" for g in groups if g != "film_held"),
        "load",
        "friction",
        "area",
        "touching_asperities",
    ]

    def rows():
        for case in SPLITS:
            pieces, outer_area = split(*case)
            total = add(*pieces)
            yield [
                *case,
                *[""] * (8 - len(case)),
                *(p["load"] for p in pieces),
                *(pieces[i][limit] for i in (0, 2, 3) for limit in ("slip", "yield")),
                *(pieces[i]["count"] for i in (0, 1, 3, 4)),
                total["load"],
                force(total),
                outer_area,
                total["count"],
            ]

    write("parts.csv", header, rows())


# --- command line ---------------------------------------------------------------------------------


def check(path):
    """Largest departure of a table: load over the integral of |load|, area and friction relative."""
    worst = mpf(0)
    with path.open(newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            film = tuple(exact(row[name]) for name in COATING) if row["n_E"] else None
            law = [exact(row[name]) for name in INPUTS]
            load, area, friction, scale = evaluate(row["formulation"], *law, film)
            wanted = {"load": (load, scale), "area": (area, area), "friction": (friction, friction)}
            for name, (value, size) in wanted.items():
                if row[name] and size:
                    worst = max(worst, abs(mpf(row[name]) - value) / size)
    print(mp.nstr(worst, 3))


FILES = {maker.__name__: maker for maker in (paper_model_own, asperity, unloading, fuller_tabor_1975, parts)}

if __name__ == "__main__":
    if sys.argv[1:2] == ["--check"]:
        check(sys.argv[2])
    else:
        for name in sys.argv[1:] or FILES:
            FILES[name]()
