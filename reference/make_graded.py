"""The graded film of docs/theory.md, section 5.3, written out a second time with numpy: trapezoidal sums. Takes ten seconds.

Six contacts, three separations each, added up by the trapezoidal rule over two million depths: good to some parts in 10^7
where the resistance jumps, and of the load to some in 10^8, where a plateau has its ends. Film and substrate may differ in
the ratio of hardness to yield stress (`film_k`).

- `graded.csv`: `load`, `area`, `friction` at `h`
"""

import csv
from pathlib import Path

import numpy as np

HERE = Path(__file__).parent
NAMES = ("theta", "lam", "nu", "film_nu", "k", "film_k", "n_E", "n_H", "tau", "film_aspect", "n_g")
SEPARATIONS = (-2.0, 0.5, 3.0)
# theta, lambda, nu_s, nu_c, k_s, k_c, n_E, n_H, tau, t/sqrt(R sigma), n_g
LAWS = {
    "soft": (40.0, 10.0, 0.3, 0.35, 2.8, 3.0, 0.5, 0.3, 2.0, 0.08, 1.0),
    "stiff but soft": (3.0, 30.0, 0.25, 0.25, 2.8, 2.8, 2.5, 0.4, 1.0, 0.5, 0.6),
    "hard": (200.0, 5.0, 0.3, 0.2, 2.8, 2.8, 4.0, 12.0, 0.3, 0.3, 1.0),
    "sticky": (0.3, 1e-2, 0.45, 0.4, 2.5, 3.0, 0.3, 2.0, 3.0, 2.0, 1.5),
    "four stages": (1e4, 1e7, 0.3, 0.3, 2.8, 2.8, 0.5, 0.1, 0.35, 0.02, 1.0),
    "thin": (1e3, 1e2, 0.1, 0.3, 3.0, 2.8, 0.2, 0.05, 0.02, 0.01, 1.0),
}


def film_share(zeta, nu):
    """(S5.12)"""
    bracket = (1 - 2 * nu) * zeta * np.log1p(1 / zeta**2) - zeta / (1 + zeta**2)
    return 2 / np.pi * np.arctan(zeta) + bracket / (2 * np.pi * (1 - nu))


def by_hand(law, h):
    """Load, area and resistance (3,) at the separation h."""
    theta, lam, nu_s, nu_c, k_s, k_c, n_E, n_H, tau, aspect, n_g = law
    eta = np.sqrt(np.pi) * (18 * lam) ** 0.25 / np.sqrt(theta)
    S = np.sqrt(6 * np.pi)

    def contact(u):
        """(S5.11), (S5.15)"""
        x = u**4
        share = film_share(aspect / np.sqrt(x), (nu_s + nu_c) / 2)
        kappa = 1 + (n_E - 1) * share
        load = kappa * x**1.5 - S * np.sqrt(n_g * kappa / theta) * x**0.75
        return x, share, load, x - 2 / 3 * S * np.sqrt(n_g / (theta * kappa)) * u

    low, high = 0.01, 10.0
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if contact(middle)[3] < 0 else (low, middle)
    deepest = (max(12.0 - h, 1.0) + 10 * theta ** (-2 / 3)) ** 0.25
    x, share, P_el, w = contact(np.linspace(high, deepest, 2_000_001))
    w[0] = 0.0
    n_Y = n_H * k_s / k_c
    c, m = (n_Y / n_E, 2) if n_H < 1 else (n_H / (n_Y * np.sqrt(n_E)), 1)
    fade = np.exp(-c * (w / tau) ** m)
    chi = 1 + (n_H - 1) * fade
    rho = P_el / (eta * chi * x)
    xi = np.clip((np.clip(rho, 0, None) ** 2 - 1) / (54 * 0.4**2 - 1), 0, 1)
    f = 3 * xi**2 - 2 * xi**3
    P_e = np.minimum(P_el, eta * chi * x)
    P = (1 - f) * P_e + f * (2 * eta * chi * w - 2 * np.pi * n_g / theta)
    first = np.argmax(P > 0) if np.any(P > 0) else len(P)
    P[first:] = np.maximum.accumulate(P[first:])
    A = (1 - f) * x + 2 * f * w
    K_beta_s, K_beta_c = (8 / 3 * (2 - nu) / (1 - nu) for nu in (nu_s, nu_c))
    K_beta, nu = K_beta_s + (K_beta_c - K_beta_s) * share, nu_s + (nu_c - nu_s) * share
    slip_limited = 4 / np.sqrt(K_beta) * np.sqrt(2 * np.pi * n_g / theta * P_e + 3 * (np.pi * n_g / theta) ** 2)
    n, p, q = (1 - 2 * nu) / (2 * np.pi), 3 * (4 + nu) / 16, 9 * nu / 16
    strength = eta * x / np.pi * (1 / k_s + (n_H / k_c - 1 / k_s) * fade)
    a, b, d = p**2 + q**2 - p * q, 3 * n * (p - q) * P_e, 3 * n**2 * P_e**2 - strength**2
    discriminant = b**2 - 4 * a * d
    yield_limited = np.where(discriminant >= 0, np.maximum((-b + np.sqrt(np.maximum(discriminant, 0))) / (2 * a), 0), 0)
    T = (1 - f) * np.minimum(slip_limited, yield_limited)
    density = np.exp(-((h + w) ** 2) / 2) / np.sqrt(2 * np.pi)
    return np.array([np.trapezoid(value * density, w) for value in (P, A, T)])


if __name__ == "__main__":
    with (HERE / "graded.csv").open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["name", *NAMES, "h", "load", "area", "friction"])
        for name, law in LAWS.items():
            for h in SEPARATIONS:
                table.writerow([name, *law, h, *(f"{value:.12g}" for value in by_hand(law, h))])
