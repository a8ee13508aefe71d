"""n-point asperities counted on simulated profiles, with standard errors; numpy and scipy only.

Gaussian profiles with exponential autocorrelation, 100 blocks of 1e6 points with fixed seeds; an error is that of the mean of
the blocks, from 1e-4 of the value upwards: judge in errors. Loads and areas are sums over the asperities found, in metres and
pascals, of Hertz's formulas; spacing and correlation of the points come from the peaks of the surface's profile by adaptive
integrals and root finding.

- `hariri_zu_ben_mrad_2006.csv`: `value` with its standard `error`, of the `quantity` named
"""

import csv
import math
from functools import partial
from pathlib import Path

import numpy as np
from scipy.integrate import dblquad
from scipy.optimize import brentq
from scipy.signal import lfilter

HERE = Path(__file__).parent
BLOCKS, POINTS = 100, 1_000_000
HEADER = ("quantity", "density", "correlation", "level", "points", "height", "value", "error")


def profile(rho, seed):
    rng = np.random.default_rng(seed)
    noise = rng.standard_normal(POINTS)
    noise[1:] *= math.sqrt(1.0 - rho * rho)
    return lfilter([1.0], [1.0, -rho], noise)


def rows_of(y, level):
    """Points in each row above the level and its height over it: by the running count of the points below."""
    below = np.flatnonzero(y <= level)
    gap = np.diff(below) - 1
    has = gap > 0
    starts = below[:-1][has] + 1
    # the point that ends a row is below the level: it does not change the largest
    return gap[has], np.maximum.reduceat(y[: below[-1] + 1], starts) - level if len(starts) else np.zeros(0)


def averages(rho, count, seed):
    """Mean and error over the blocks of what count(profile) finds, a dictionary."""
    blocks = [count(profile(rho, [seed, block])) for block in range(BLOCKS)]
    for name in blocks[0]:
        values = np.array([block[name] for block in blocks])
        yield name, values.mean(), values.std(ddof=1) / math.sqrt(BLOCKS)


def steps_down(rho, weight):
    """Int over both steps down from a peak, d1 and d2 > 0, of their Gaussian density times weight(d1 + d2)."""
    variance, r = 2.0 * (1.0 - rho), (1.0 - rho) / 2.0
    scale = math.sqrt(variance)

    def density(a, b):
        form = (a * a - 2 * r * a * b + b * b) / (2 * (1 - r * r))
        return math.exp(-form) / (2 * math.pi * math.sqrt(1 - r * r)) * weight(scale * (a + b))

    return dblquad(density, 0.0, 12.0, 0.0, 12.0, epsabs=1e-12)[0]


def peaks(rho):
    """Share of the points that are peaks, and the mean of 2 y0 - y-1 - y1 there."""
    share = steps_down(rho, lambda total: 1.0)
    return share, steps_down(rho, lambda total: total) / share


def sampling(sigma, R, N):
    """Deviation of the surface, correlation and spacing of the points, and height of the summits' mean over the mean plane.

    From the peaks of a profile per length and their mean curvature (Rice; Nayak); moments in McCool's way, 0.8968 as printed.
    """
    m4 = (3.0 / (8.0 * R)) ** 2 * math.pi
    m2 = m4 / (6.0 * math.pi * math.sqrt(3.0) * N)
    m0 = sigma**2 + 0.8968 * m2**2 / m4
    per_length, curvature = math.sqrt(m4 / m2) / (2.0 * math.pi), math.sqrt(math.pi * m4 / 2.0)

    def missing(rho):
        share, drop = peaks(rho)
        spacing = share / per_length
        return math.sqrt(m0) * drop / spacing**2 / curvature - 1.0

    rho = brentq(missing, 1e-6, 0.995, xtol=1e-9)
    return math.sqrt(m0), rho, peaks(rho)[0] / per_length, 4.0 * m2 / math.sqrt(math.pi * m4)


def found_on(y):
    """Rates per point on a profile of deviation 1: (quantity, level, n, largest height) -> value."""
    drop = 2.0 * y[1:-1] - y[:-2] - y[2:]
    top = (y[1:-1] > y[:-2]) & (y[1:-1] > y[2:])
    found = {("peaks", "", "", ""): top.mean(), ("peak_curvature", "", "", ""): drop[top].mean()}
    for level in (-1.0, 0.0, 1.0, 2.0):
        m, t = rows_of(y, level)
        found["rows", level, "", ""] = len(m) / POINTS
        found["points_above", level, "", ""] = m.sum() / POINTS
        found["mean_height", level, "", ""] = t.mean()
        for n in (3, 4, 7):
            found["rows_of_n", level, n, ""] = (m == n - 2).sum() / POINTS
            found["rows_of_n_up_to", level, n, 0.5] = ((m == n - 2) & (t < 0.5)).sum() / POINTS
    return found


SIGMA, RADIUS, MODULUS = 48e-9, 50e-6, 115e9  # the last is E*


def carried_by(y, N, deviation, spacing, summits):
    """Load and area per asperity of the surface, in the package's units: (quantity, h, "", "") -> value."""
    found = {}
    for h in (-1.0, 0.0, 1.0, 2.0):
        m, t = rows_of(deviation * y, h * SIGMA + summits)
        chord = (m + 1) * spacing
        radius = chord**2 / (8.0 * t)
        per_area = 1.0 / (chord * POINTS * spacing)  # each found on one line: per length, over its width
        pressure = np.sum(per_area * 4.0 / 3.0 * MODULUS * np.sqrt(radius) * t**1.5)
        share = np.sum(per_area * math.pi * radius * t)
        found["load", h, "", ""] = pressure / (N * 4.0 / 3.0 * MODULUS * math.sqrt(RADIUS) * SIGMA**1.5)
        found["area", h, "", ""] = share / (N * math.pi * RADIUS * SIGMA)
    return found


def main():
    out = []
    for rho in (0.0, 0.3, 0.7, 0.95):
        for (quantity, *where), value, error in averages(rho, found_on, round(1000 * rho)):
            out.append((quantity, "", rho, *where, value, error))
    for density in (0.0405, 0.045, 0.06, 0.2):
        N = density / (RADIUS * SIGMA)
        deviation, rho, spacing, summits = sampling(SIGMA, RADIUS, N)
        carry = partial(carried_by, N=N, deviation=deviation, spacing=spacing, summits=summits)
        for (quantity, *where), value, error in averages(rho, carry, round(1e5 * density)):
            out.append((quantity, density, rho, *where, value, error))
    with (HERE / "hariri_zu_ben_mrad_2006.csv").open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(HEADER)
        writer.writerows([f"{v:.7g}" if isinstance(v, float) else v for v in row] for row in out)


if __name__ == "__main__":
    main()
