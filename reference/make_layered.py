"""A rigid sphere on a bonded film, and a coated body pressed by an elastic one: numpy. 30 s.

The compliance of each wave is that of six equations: displacements and tractions of a film on a half-space in plane strain,
from stress functions (a + b z) exp(-z) + (c + d z) exp(z). The integral equation is solved on Gauss-Legendre points of the
contact (Nystrom), six points and more in a thickness; good to 1e-8, `edge` to 1e-6.

- `layered.csv`: `share` (of the film in the compliance of the surfaces that meet), `ratio` (plane-strain modulus of the film
  over that of the body below), `nu`, `nu_below`, `radius` (of the contact over the thickness); `load` E_P = 3PR/(4a^3),
  `approach` D = delta R/a^2, `stiffness` E_S = (dP/d delta)/(2a) over the modulus of the surfaces that meet, and `edge`
  B = (dS/da)/2, a difference of S.
"""

import csv
from itertools import pairwise
from pathlib import Path

import numpy as np

NAMES = ("share", "ratio", "nu", "nu_below", "radius", "load", "approach", "stiffness", "edge")


def mode(z, nu, mu):
    """u_x, u_z, s_xz and s_zz of a wave of k = 1 at the depth z; columns: exp(-z), z exp(-z), exp(z), z exp(z).

    A stress function F(z) cos x: s_zz = -F cos x, s_xz = F' sin x, s_xx = F'' cos x; plane strain gives u_x and u_z.
    """
    down, up = np.exp(-z), np.exp(z)
    F = np.array([down, z * down, up, z * up])
    F1 = np.array([-down, (1 - z) * down, up, (1 + z) * up])
    F2 = np.array([down, (z - 2) * down, up, (z + 2) * up])
    F3 = np.array([-down, (3 - z) * down, up, (z + 3) * up])
    # 2 mu e_xx = (1 - nu) s_xx - nu s_zz; u_x = Integral e_xx dx, a sine.
    u_x = ((1 - nu) * F2 + nu * F) / (2 * mu)
    # 2 mu g_xz/2 = s_xz: du_x/dz + du_z/dx = s_xz/mu, u_z a cosine: -u_z = F'/mu - du_x/dz.
    u_z = ((1 - nu) * F3 + nu * F1) / (2 * mu) - F1 / mu
    return np.array([u_x, u_z, F1, -F])


def compliance(x, ratio, nu, nu_below):
    """u k E1/(2 p) of the wave of x = k t, thickness x at k = 1; E1 = 1."""
    mu = (1 - nu) / 2  # E1 = 1 = 2 mu/(1 - nu)
    mu_below = np.inf if ratio == 0 else (1 - nu_below) / (2 * ratio)
    equations, right = np.zeros((6, 6)), np.zeros(6)
    # Columns that grow with depth are scaled by exp(-x), else the equations lose digits.
    scale = np.array([1.0, 1.0, np.exp(-x), np.exp(-x)])
    top, bottom = mode(0.0, nu, mu) * scale, mode(x, nu, mu) * scale
    below = mode(0.0, nu_below, mu_below)[:, :2]
    equations[:2, :4] = top[2:]
    right[1] = -1.0  # s_zz = -p
    equations[2:, :4], equations[2:, 4:] = bottom, -below
    if ratio == 0:  # nothing moves, the tractions are what they are
        equations[2:4, 4:] = 0.0
        equations[4:] = 0.0
        equations[4, 4] = equations[5, 5] = 1.0
    solution = np.linalg.solve(equations, right)
    return top[1] @ solution[:4] / 2.0


def waves(radius):
    nodes, weights = [], []
    ends = [0.0, 0.01, 0.03, 0.1, 0.3, 0.7, 1.5, *np.arange(3.0, 16.1, 1.0)]
    for low, high in pairwise(ends):
        t, w = np.polynomial.legendre.leggauss(int(20 + 1.3 * (high - low) * radius))
        nodes.append(low + (high - low) * (t + 1) / 2)
        weights.append(w * (high - low) / 2)
    return np.concatenate(nodes), np.concatenate(weights)


def solve(share, ratio, nu, nu_below, radius):
    """Load, approach and stiffness; and what the load is made of: points s, their weights and g there."""
    x, weights = waves(radius)
    c = 1 - share + share * np.array([compliance(one, ratio, nu, nu_below) for one in x])
    k, m = radius * x, 2 / np.pi * radius * weights * (c - 1)
    count = int(30 + 6 * radius)
    t, w = np.polynomial.legendre.leggauss(2 * count)
    s, w = t[count:], w[count:]
    cosines = np.cos(np.outer(k, s))
    kernel = (cosines * m[:, None]).T @ cosines
    flat, square = np.linalg.solve(np.eye(count) + kernel * w, np.stack([np.ones(count), s**2], axis=1)).T
    at_edge = (m * np.cos(k)) @ cosines * w
    approach = (1 - at_edge @ square) / (1 - at_edge @ flat)
    return 1.5 * (approach * (w @ flat) - w @ square), approach, w @ flat, (s, w, approach * flat - square)


def row(share, ratio, nu, nu_below, radius):
    load, approach, stiffness, _ = solve(share, ratio, nu, nu_below, radius)
    step = 1e-4
    wider, narrower = (
        radius * factor * solve(share, ratio, nu, nu_below, radius * factor)[2] for factor in (1 + step, 1 - step)
    )
    return share, ratio, nu, nu_below, radius, load, approach, stiffness, (wider - narrower) / (2 * step * radius)


def main():
    rng = np.random.default_rng(13)
    cases = [
        (1.0, ratio, 0.3, 0.3, radius) for ratio in (0.05, 0.1, 0.5, 2.0, 10.0) for radius in (0.1, 0.5, 1.0, 2.0, 5.0, 20.0)
    ]
    for _ in range(60):
        share = 1.0 if rng.random() < 0.6 else rng.uniform(0.05, 1.0)
        cases.append((share, 10 ** rng.uniform(-1.7, 1.7), *rng.uniform(0.0, 0.49, 2), 10 ** rng.uniform(-1.7, 1.7)))
    with Path(__file__).with_name("layered.csv").open("w", newline="", encoding="utf-8") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(NAMES)
        for one in cases:
            out.writerow([f"{value:.10g}" for value in row(*[float(f"{value:.4g}") for value in one])])


if __name__ == "__main__":
    main()
