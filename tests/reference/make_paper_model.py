"""Writes paper_model_own.csv, asperity.csv, unloading.csv, pull_off.csv and parts.csv (see README.md).

python make_paper_model.py [file ...]       # all files when none is named
python make_paper_model.py --check OTHER.csv    # compare a table of the same columns with these equations
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
KINDS = [(reading, coated) for reading in ("corrected", "published") for coated in (False, True)]


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
            for reading, coated in KINDS:
                film = (n_E, n_H, tau) if coated else None
                values = evaluate(reading, *map(exact, law), film and tuple(map(exact, film)))
                yield [reading, *law, *(film or ("", "", "")), *values]

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
    # two and three crossings of slip and yield in the corrected reading, three in the published one
    (1, 22.8725, 0.499, 3),
    (300, 5522.02, 0.45, 4),
    (10, 907.748, 0.3, 2.8),
]


def asperity():
    def rows():
        for reading in ("corrected", "published"):
            for theta, lam, nu, k in ASPERITIES:
                law = Law(*(exact(v) for v in (theta, lam, nu, k)), reading == "published")
                crossings = law.crossings(law.u0, law.u1)
                for fraction in ("0.0625", "0.25", "0.5", "0.75", "0.9375"):
                    x = law.u0**4 + mpf(fraction) * (law.u1**4 - law.u0**4)
                    x = mpf(float(x))
                    u = mp.root(x, 4)
                    ends = law.u0**4, law.u1**4, law.w1, law.plastic_load(law.w1), law.K_beta, len(crossings)
                    here = x, law.w(u), law.load(u), law.slip_limited(u), law.yield_(u)
                    yield [reading, theta, lam, nu, k, *ends, *here]

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


# --- 3. unloading.csv, pull_off.csv ---------------------------------------------------------------

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


def pull_off():
    ratios = ["0.1", "0.2", "0.3", "0.5", "0.75", "1", "1.25", "1.5", "2", "2.38", "2.5", "3", "4"]
    write("pull_off.csv", ["inverse_delta_c", "theta", "largest_tension", "h"], ([r, *fuller_tabor(mpf(r))] for r in ratios))


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


FILES = {maker.__name__: maker for maker in (paper_model_own, asperity, unloading, pull_off, parts)}

if __name__ == "__main__":
    if sys.argv[1:2] == ["--check"]:
        check(sys.argv[2])
    else:
        for name in sys.argv[1:] or FILES:
            FILES[name]()
