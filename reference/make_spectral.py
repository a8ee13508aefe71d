"""Theories of Gaussian rough surfaces, with numpy, scipy and mpmath. Takes 9 s.

The summits are summed straight from the covariances of a Gaussian surface and its derivatives, in the principal curvatures,
without Nayak's variables; the ellipse is found from the curvatures by root finding. In double precision, so good to 1e-9 or
better, not to 15 digits; except `mccool_1986` and `ciavarella_greenwood_paggi_2008`, with mpmath (16 digits), and the two
tables of Persson, by finite differences in the diffusion equation (3e-7 elastic, 1e-6 elastic-plastic).

- `summits.csv` of `mccool_1986`, `bush_gibson_thomas_1975`, `greenwood_2006`: number, mean height, deviation and radius of
  the summits of Gaussian surfaces with these spectral moments, any consistent units: `density`, `mean_height`, `deviation`,
  `radius`
- `bush_gibson_thomas_1975.csv`: `load`, `area` per asperity at `h` from the mean of the summits
- `greenwood_2006.csv`: the same
- `mccool_1986.csv`: `area_over_load`, A E* h'/(A_0 p) of Greenwood and Williamson's sum on a surface of this bandwidth alpha
- `ciavarella_greenwood_paggi_2008.csv`: `load`, `area` per asperity
- `persson_2001.csv`: `area` over the nominal at `pressure` over E* h'
- `persson_2001_elastoplastic.csv`: shares of the nominal area, `elastic` and `plastic`, at H over E* h' and nominal pressure
  over H (`share`)
- `pastewka_robbins_2014.csv`: `ratio`, 1 at the border of sticking, of surfaces in SI units
"""

import csv
import math
from pathlib import Path

import numpy as np
from mpmath import mp, mpf
from numpy.polynomial.legendre import leggauss
from scipy.linalg import solve_banded
from scipy.optimize import brentq
from scipy.special import ellipe, ellipk, erfc

mp.dps = 30
HERE = Path(__file__).parent
ALPHAS = (1.6, 2.0, 5.0, 50.0)


def write(name, header, rows):
    with (HERE / f"{name}.csv").open("w", newline="", encoding="utf-8") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(header)
        for row in rows:
            out.writerow([mp.nstr(v, 16) if isinstance(v, mpf) else repr(float(v)) for v in row])


def panels(low, high, count, nodes):
    x, w = leggauss(nodes)
    ends = np.linspace(low, high, count + 1)
    half = np.diff(ends)[:, None] / 2
    return (ends[:-1, None] + half * (1 + x)).ravel(), (half * w).ravel()


def summit_density(z, k1, k2, m0, m2, m4):
    """Summits per area, dz, dk1 and dk2 at principal curvatures k1 > k2 > 0.

    Covariance of z, z_xx and z_yy; z_xy is independent, of variance m4/3. The second derivatives' volume element is
    (k1 - k2) dk1 dk2 d(angle), the angle over pi. Gradient zero: 1/(2 pi m2); determinant k1 k2.
    """
    covariance = np.array([[m0, -m2, -m2], [-m2, m4, m4 / 3], [-m2, m4 / 3, m4]])
    inverse = np.linalg.inv(covariance)
    v = (z, -k1, -k2)
    form = sum(inverse[i, j] * v[i] * v[j] for i in range(3) for j in range(3))
    at_axes = np.exp(-form / 2) / math.sqrt((2 * math.pi) ** 3 * np.linalg.det(covariance)) / math.sqrt(2 * math.pi * m4 / 3)
    return math.pi * (k1 - k2) * k1 * k2 * at_axes / (2 * math.pi * m2)


def over_summits(m0, m2, m4, low, weights):
    """Int dz dk1 dk2 density * weight(z, k1, b) over z > low; k2 = b k1. weights: functions, b enters by its index."""
    scale = math.sqrt(m4)
    root, wb = panels(0, 1, 4, 16)
    b, wb = root**4, wb * 4 * root**3
    k, wk = panels(0, 9 * scale, 30, 12)
    rest = math.sqrt(m0 - 1.5 * m2 * m2 / m4)
    total = np.zeros(len(weights))
    for i, one in enumerate(b):
        mean = 1.5 * m2 / m4 * k * (1 + one) / 2  # of z at these curvatures
        start = max(low, -40 * math.sqrt(m0))
        first = np.maximum(start, mean - 11 * rest)
        last = np.maximum(first, np.maximum(mean + 11 * rest, first + 6 * rest))
        y, wy = panels(0, 1, 6, 20)
        z = first[:, None] + (last - first)[:, None] * y**2
        wz = (last - first)[:, None] * wy * 2 * y
        density = summit_density(z, k[:, None], one * k[:, None], m0, m2, m4) * wz * (wk * k)[:, None] * wb[i]
        for j, weight in enumerate(weights):
            total[j] += np.sum(density * weight(z, k[:, None], i, one))
    return total, b


def ellipse(b):
    """e^2 = 1 - (b/a)^2, K and E of Hertz's ellipse between principal curvatures of ratio b."""

    def ratio(m):
        K, E = ellipk(m), ellipe(m)
        return (K - E) / (E / (1 - m) - K) - b  # A/B

    m = brentq(ratio, 1e-9, 1 - 1e-15, xtol=1e-16, rtol=1e-15) if b < 1 - 1e-8 else 0.0
    return m, ellipk(m), ellipe(m)


def hertz_ellipse(b):
    """Load over E* w^(3/2) k1^(-1/2) and area over w / k1 of an asperity with curvatures k1 and b k1."""
    m, K, E = ellipse(b)
    axes2 = 2 * E / ((1 + b) * K)  # b^2 of the ellipse: w E / (K kappa), over w / k1
    long = math.sqrt(axes2 / (1 - m))
    return 2 * math.pi / 3 * long / K, math.pi * long * math.sqrt(axes2)


def moments_of(alpha):
    """R = 50 and the moments of a surface whose summits have this radius and the deviation 1 (checked by `summits`)."""
    R = 50.0
    c = 1 + 16 / math.pi - 3 * math.sqrt(3)
    m4 = 9 * math.pi / (64 * R * R)
    m0 = 1 / (1 - c / alpha)
    m2 = math.sqrt(m0 * m4 / alpha)
    return R, m0, m2, m4


def summits():
    for alpha in ALPHAS:
        _, m0, m2, m4 = moments_of(alpha)
        weights = [lambda z, k, i, b: 1.0, lambda z, k, i, b: z, lambda z, k, i, b: z * z, lambda z, k, i, b: k * (1 + b) / 2]
        (N, z1, z2, k1), _ = over_summits(m0, m2, m4, -math.inf, weights)
        yield [m0, m2, m4, N, z1 / N, math.sqrt(z2 / N - (z1 / N) ** 2), N / k1]


def elliptic(kind):
    """Load and area per asperity at h from the mean of the summits, over K sqrt(R) sigma^1.5 and pi R sigma, sigma = 1."""
    root, _ = panels(0, 1, 4, 16)
    shapes = [hertz_ellipse(b) if kind == "ellipse" else (4 / 3 * b**-0.25, math.pi * b**-0.5) for b in root**4]
    for alpha in ALPHAS:
        R, m0, m2, m4 = moments_of(alpha)
        (N, z1), _ = over_summits(m0, m2, m4, -math.inf, [lambda z, k, i, b: 1.0, lambda z, k, i, b: z])
        for h in (-1.0, 0.0, 1.0, 2.0, 4.0):
            d = h + z1 / N

            def load(z, k, i, b, d=d):
                return shapes[i][0] * np.maximum(z - d, 0) ** 1.5 / np.sqrt(k)

            def area(z, k, i, b, d=d):
                return shapes[i][1] * np.maximum(z - d, 0) / k

            (P, A), _ = over_summits(m0, m2, m4, d, [load, area])
            if kind == "sphere":
                check_with_closed_density(P, A, d, m0, m2, m4)
            yield [N * R, h, P / (N * 4 / 3 * math.sqrt(R)), A / (N * math.pi * R)]


def check_with_closed_density(P, A, d, m0, m2, m4):
    """The density of height and g = sqrt(k1 k2), the mean curvature integrated out: g^3 exp(g^2/2 - ...) erfc(...)."""
    s = math.sqrt(m4 / 3)
    rho2 = m2 * m2 / (m0 * 2 * s * s)
    g, wg = panels(0, 14, 60, 12)
    y, wy = panels(0, 3.5, 40, 12)
    z = (d / math.sqrt(m0) + y * y)[:, None]
    steep = 1 + 1 / (2 * (1 - rho2))
    centre = math.sqrt(2 * rho2) * z / (3 - 2 * rho2)
    density = g**3 * np.exp(g * g / 2 - 1.5 * z * z / (3 - 2 * rho2)) * erfc((g - centre) * math.sqrt(steep / 2))
    density *= math.sqrt(math.pi / (2 * steep)) * s * s / (2 * math.pi * m2 * 2 * math.pi * math.sqrt(2 * (1 - rho2)))
    over = np.maximum(z * math.sqrt(m0) - d, 0)
    weight = density * wg * (wy * 2 * y)[:, None]
    assert abs(np.sum(weight * 4 / 3 * over**1.5 / np.sqrt(g * s)) / P - 1) < 1e-9
    assert abs(np.sum(weight * math.pi * over / (g * s)) / A - 1) < 1e-9


def F(n, h):
    return mp.gamma(n + 1) * mp.exp(-h * h / 4) * mp.pcfd(-n - 1, h) / mp.sqrt(2 * mp.pi)


def mccool():
    """A E* h' / (A0 p) of Greenwood and Williamson's sum on a surface of this alpha."""
    for alpha in (2, 5, 10, 50):
        for h in (1, 2, 3, 4):
            m0, m4 = mpf(1), mpf(1)
            m2 = mp.sqrt(m0 * m4 / alpha)
            N, R = m4 / m2 / (6 * mp.pi * mp.sqrt(3)), mpf(3) / 8 * mp.sqrt(mp.pi / m4)
            sigma = mp.sqrt((1 - mpf("0.8968") / alpha) * m0)
            area = mp.pi * N * R * sigma * F(mpf(1), mpf(h))
            pressure = mpf(4) / 3 * N * mp.sqrt(R) * sigma**1.5 * F(mpf(3) / 2, mpf(h))
            yield [mpf(alpha), mpf(h), area * mp.sqrt(2 * m2) / pressure]


def diffused(hardness, share, cells=1600, steps=3000):
    """Elastic and plastic shares by Crank-Nicolson on dP/dG = P'' over 0..1 (pressure over H), G = 1/(8 hardness^2).

    The first steps are implicit Euler, against the spike. What flows out at 1 is plastic.
    """
    dp, dG = 1 / cells, 1 / (8 * hardness**2) / steps
    P = np.zeros(cells - 1)
    P[round(share * cells) - 1] = 1 / dp
    plastic = 0.0
    for step in range(steps):
        for theta, part in [(1.0, 0.25)] * 4 if step < 4 else [(0.5, 1.0)]:
            r = part * dG / dp**2
            bands = np.outer([-theta * r, 1 + 2 * theta * r, -theta * r], np.ones(cells - 1))
            second = np.concatenate([P[1:], [0]]) + np.concatenate([[0], P[:-1]]) - 2 * P
            new = solve_banded((1, 1), bands, P + (1 - theta) * r * second)
            plastic += part * dG * (theta * new[-1] + (1 - theta) * P[-1]) / dp
            P = new
    return P.sum() * dp, plastic


def elastic():
    """The same with the upper boundary too far to matter; pressure over E* h', area over the nominal area."""
    for pressure in (0.01, 0.05, 0.1, 0.2, 0.5, 1.0):
        yield [pressure, sum(diffused(4.0, pressure / 4, cells=3200, steps=2000))]


def elastic_plastic():
    for hardness in (0.15, 0.4, 1.0, 2.0):
        for share in (0.0625, 0.25, 0.75):
            yield [hardness, share, *diffused(hardness, share)]


def ciavarella():
    """x - h = 0.94640... (4/3) N R sigma sqrt(sigma/R) sqrt(A_n)/sigma F_3/2(x); the number is a double integral."""
    inner = mp.quad(lambda x: mp.quad(lambda y: 4 * (1 - x) * (1 - y) / mp.sqrt(x * x + y * y), [0, x, 1]), [0, 1])
    sinking = inner / mp.pi  # mean of 1 / (pi distance) over pairs of points of the unit square
    for density, sharpness, width in ((0.04, 0.03, 100.0), (0.04, 0.03, 20000.0), (0.1, 0.1, 1e6)):
        for h in (-6.0, -2.0, 0.0, 2.0, 4.0):
            B = sinking * 4 / 3 * mpf(density) * mpf(sharpness) * mpf(width)
            low, high = mpf(h), mpf(h) + 1
            while high - h < B * F(mpf(3) / 2, high):
                high += 1
            for _ in range(110):
                middle = (low + high) / 2
                low, high = (middle, high) if middle - h < B * F(mpf(3) / 2, middle) else (low, middle)
            yield [density, sharpness, width, h, F(mpf(3) / 2, low), F(mpf(1), low)]


def pastewka():
    """From numbers in SI units: sigma, R, N, E*, w, range."""
    for sigma, R, N, E, w, reach in (
        (48e-9, 50e-6, 1.7e10, 115e9, 1.0, 0.3e-9),
        (5e-9, 1e-6, 1e13, 2e6, 0.05, 0.5e-9),
        (1e-6, 20e-6, 2e9, 1e6, 0.05, 1e-9),
    ):
        m4 = 9 * math.pi / (64 * R * R)
        m2 = m4 / (6 * math.pi * math.sqrt(3) * N)
        slope, curvature = math.sqrt(2 * m2), math.sqrt((m4 + m4 + 2 * m4 / 3) / 4)  # of (z_xx + z_yy)/2
        ratio = slope * E * reach / (2 * w) * (slope**2 / (curvature * reach)) ** (2 / 3)
        theta = 4 / 3 * E * sigma**1.5 / (w * math.sqrt(R))
        yield [theta, N * R * sigma, (R * w * w / (E * E * reach**3)) ** (1 / 3), ratio]


if __name__ == "__main__":
    write("summits", ["m0", "m2", "m4", "density", "mean_height", "deviation", "radius"], summits())
    write("bush_gibson_thomas_1975", ["roughness_parameter", "h", "load", "area"], elliptic("ellipse"))
    write("greenwood_2006", ["roughness_parameter", "h", "load", "area"], elliptic("sphere"))
    write("mccool_1986", ["alpha", "h", "area_over_load"], mccool())
    write("persson_2001_elastoplastic", ["hardness", "share", "elastic", "plastic"], elastic_plastic())
    write("persson_2001", ["pressure", "area"], elastic())
    write(
        "ciavarella_greenwood_paggi_2008",
        ["roughness_parameter", "sharpness", "nominal_width", "h", "load", "area"],
        ciavarella(),
    )
    write("pastewka_robbins_2014", ["theta", "roughness_parameter", "tabor_parameter", "ratio"], pastewka())
