"""Stresses under a sphere dragged over a bonded film, and the tangential stiffness of such a contact: numpy. 20 s.

Every wave is a set of equations solved by itself: six along the wave (`make_layered.mode`), three across it. Stresses are sums
of plane waves over all directions, turned into the frame of the place one by one: no Bessel functions. The pressure is that of
`make_layered.solve`. The stiffness is that of the least energy among tractions (1 - r^2)^(n - 1/2) and their second harmonics
r^2 (1 - r^2)^(n - 1/2), n = 0 to 6, whose transforms are Sonine's.

- `layered_stresses.csv` of `layered_first_yield`: `ratio`, `nu`, `nu_below`, `radius` as in `layered.csv`, place `r`, `theta`,
  `z` over the
  contact radius, `below` 1 in the body and 0 in the film, and the stresses x, y, z, xy, yz, xz over the mean pressure: `p_`
  under pressure, `q_` under a traction in the direction x that is as large. To 1e-8.
- `layered_shear.csv` of `layered_peeling`: the same bodies, and `K_beta`, 4/3 of the modulus of the body without a film times
  beta in
  T = 8 a delta/beta. To 1e-5.
"""

import csv
import math
from itertools import pairwise
from pathlib import Path

import numpy as np
from make_layered import mode, solve

NAMES = ("x", "y", "z", "xy", "yz", "xz")


def wave(x, depth, ratio, nu, nu_below):
    """Of the wave k = 1 on a film of thickness x: s_xx, s_yy, s_zz, s_xz at the depth under pressure cos and under shear cos,
    and s_yz, s_xy under shear across; displacements of the surface under shear along and across, film's shear modulus 1."""
    mu_below = (1 - nu_below) / (1 - nu) / ratio
    scale = np.array([1.0, 1.0, np.exp(-x), np.exp(-x)])
    top, bottom, below = mode(0.0, nu, 1.0) * scale, mode(x, nu, 1.0) * scale, mode(0.0, nu_below, mu_below)[:, :2]
    equations = np.zeros((6, 6))
    equations[:2, :4], equations[2:, :4], equations[2:, 4:] = top[2:], bottom, -below
    # Shear cos is the wave of shear sin moved by a quarter: s_xz = -1 at the surface, with u_x and s_xz now cosines.
    right = np.array([[0.0, -1.0], [-1.0, 0.0], [0, 0], [0, 0], [0, 0], [0, 0]])
    found = np.linalg.solve(equations, right)
    in_film = depth <= x
    here = mode(depth, nu, 1.0) * scale if in_film else mode(depth - x, nu_below, mu_below)[:, :2]
    part, poisson = (found[:4], nu) if in_film else (found[4:], nu_below)
    _, _, s_xz, s_zz = here @ part
    z = depth if in_film else depth - x
    down, up = np.exp(-z), np.exp(z) if in_film else 0.0
    second = np.array([down, (z - 2) * down, up, (z + 2) * up]) * scale if in_film else np.array([down, (z - 2) * down])
    s_xx = second @ part
    s_yy = poisson * (s_xx + s_zz)
    # v = (a exp(-z) + b exp(z - x)) cos, below c exp(x - z): shear -1 on the surface, v and its shear continuous.
    e = np.exp(-x)
    a, b, c = np.linalg.solve([[-1, e, 0], [e, 1, -1], [-e, 1, mu_below]], [-1, 0, 0])
    if in_film:
        across = -a * np.exp(-depth) + b * np.exp(depth - x), -(a * np.exp(-depth) + b * np.exp(depth - x))
    else:
        across = -mu_below * c * np.exp(x - depth), -mu_below * c * np.exp(x - depth)
    surface = (top @ found[:4])[0, 1], a + b * e
    # What goes as sin under the shear that goes as cos has changed its sign.
    return (s_xx[0], s_yy[0], s_zz[0], s_xz[0]), (-s_xx[1], -s_yy[1], -s_zz[1], s_xz[1]), across, surface


def stresses(case, place):
    ratio, nu, nu_below, radius = case
    r, theta, z, below = place
    _, _, _, (s, w, g) = solve(1.0, *case)
    g = g / (2 * (w @ g))
    most = 32.0 / z
    nodes = []
    for low, high in pairwise([0.0, 0.01 * radius, 0.1 * radius, 0.5 * radius, 2.0 * radius, most]):
        t, weight = np.polynomial.legendre.leggauss(int(24 + 1.2 * (high - low)))
        nodes.append((low + (high - low) * (t + 1) / 2, (high - low) * weight / 2))
    k, weight = map(np.concatenate, zip(*nodes, strict=True))
    P = np.cos(np.outer(k, s)) @ (w * g)
    phi = 2 * np.pi * np.arange(2 * int(20 + most * r)) / (2 * int(20 + most * r))
    c, d = np.cos(phi), np.sin(phi)
    x_here = r * math.cos(theta) * c + r * math.sin(theta) * d
    out = np.zeros((2, 6))
    for one, q in zip(k, weight * k * P, strict=True):
        depth = one * z * (1 + (1e-12 if below else -1e-12))
        pressed, along, across, _ = wave(one / radius, depth, ratio, nu, nu_below)
        cos, sin = np.cos(one * x_here), np.sin(one * x_here)
        for row, (plane, out_of, n_cos, n_sin, factor, side) in enumerate(
            [(pressed, 0.0, cos, sin, np.ones_like(c), 0.0), (along, across, sin, cos, c, -d)]
        ):
            xx, yy, zz = (value * n_cos * factor for value in plane[:3])
            xz = plane[3] * n_sin * factor
            yz, xy = (out_of[0] * cos * side, out_of[1] * sin * side) if row else (0.0, 0.0)
            turned = (
                xx * c * c + yy * d * d - 2 * xy * c * d,
                xx * d * d + yy * c * c + 2 * xy * c * d,
                zz,
                (xx - yy) * c * d + xy * (c * c - d * d),
                xz * d + yz * c,
                xz * c - yz * d,
            )
            out[row] += q * np.array([value.mean() for value in turned])
    return out


def bessel_half(order, k):
    """j_order(k)."""
    from scipy.special import spherical_jn

    return spherical_jn(order, k)


def shear(case):
    ratio, nu, nu_below, radius = case
    most, count = 4000.0, 7
    panels = np.concatenate([[0.0, 0.01, 0.1, 1.0], np.arange(4.0, most + 1.0, 4.0)])
    t, weight = np.polynomial.legendre.leggauss(14)
    half = np.diff(panels)[:, None] / 2
    k, weight = (panels[:-1, None] + half * (t + 1)).ravel(), (half * weight).ravel()
    film = np.array([1 - nu, 1.0])
    compliances = np.tile(film, (k.size, 1))
    for at in np.flatnonzero(k / radius < 20.0):
        compliances[at] = wave(k[at] / radius, 0.0, ratio, nu, nu_below)[3]
    # (1 - r^2)^(n - 1/2) has k^(-n) j_n(k), its second harmonic with r^2 k^(-n) j_(n + 2)(k), both but for one factor.
    Q0 = np.array([bessel_half(n, k) / k**n for n in range(count)])
    Q2 = np.array([bessel_half(n + 2, k) / k**n for n in range(count)])
    along, across = np.vstack([Q0, -Q2]), np.vstack([Q0, Q2])
    energy = (along * (weight * compliances[:, 0])) @ along.T + (across * (weight * compliances[:, 1])) @ across.T
    # The tail: sin^2/k^2 of n = 0, whose mean is 1/(2 k^2).
    tail = 0.5 / most
    for i, j, sign in ((0, 0, 1), (count, count, 1), (0, count, -1)):  # j_2 is as -j_0 there
        energy[i, j] += tail * (film[0] * (1 if i == j else -sign) + film[1] * (1 if i == j else sign))
        energy[j, i] = energy[i, j]
    whole = np.array([2.0**-n / math.gamma(n + 1.5) * math.sqrt(math.pi) / 2 for n in range(count)] + [0.0] * count)
    stiffness = whole @ np.linalg.solve(
        energy, whole
    )  # 2/(pi (C_L + C_T)) on a half-space, in units of the film's shear modulus
    beta_film = 2 / (math.pi * stiffness)
    return 8.0 / 3.0 / (ratio * (1 - nu)) * beta_film  # mu = E'(1 - nu)/2, K = 4/3 E'_below


def main():
    rng = np.random.default_rng(21)
    here = Path(__file__)
    cases = [(0.2, 0.3, 0.3, 1.0), (5.0, 0.3, 0.3, 1.0)]
    cases += [
        (round(10 ** rng.uniform(-1.5, 1.5), 3), *rng.uniform(0, 0.5, 2).round(3), round(10 ** rng.uniform(-0.7, 0.6), 3))
        for _ in range(8)
    ]
    with here.with_name("layered_stresses.csv").open("w", newline="", encoding="utf-8") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(
            [
                "ratio",
                "nu",
                "nu_below",
                "radius",
                "r",
                "theta",
                "z",
                "below",
                *(f"{part}_{name}" for part in "pq" for name in NAMES),
            ]
        )
        for case in cases:
            for below, share in ((0, rng.uniform(0.3, 1.0)), (0, 1.0), (1, 1.0), (1, rng.uniform(1.0, 2.0))):
                place = round(rng.uniform(0.0, 1.3), 3), round(rng.uniform(0.0, 6.0), 3), round(share, 3) / case[3], below
                out.writerow([*case, *place, *(f"{value:.10g}" for value in stresses(case, place).ravel())])
    cases += [
        (round(10 ** rng.uniform(-2, 2), 3), *rng.uniform(0, 0.5, 2).round(3), round(10 ** rng.uniform(-1.5, 1.0), 3))
        for _ in range(10)
    ]
    with here.with_name("layered_shear.csv").open("w", newline="", encoding="utf-8") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["ratio", "nu", "nu_below", "radius", "K_beta"])
        out.writerows([*case, f"{shear(case):.8g}"] for case in cases)


if __name__ == "__main__":
    main()
