"""A rough surface on a film by the modulus of a sphere: numpy and scipy. 20 s.

The spectrum of the surface is a sum over 400 waves between two wavevectors that are found from its moments by root finding; the
sphere is that of `make_layered.py`, splined over 24 contact radii; the area is found by bisection. Good to 1e-4.

- `rough_on_film.csv`: `density` N R sigma, `n_E`, `film_nu`, `nu`, `film_aspect` t/sqrt(R sigma), `hardness` of the film and
  `pressure` over E* h'; `modulus` E_eff over E* and `area` over the nominal one
"""

import csv
import math
from pathlib import Path

import numpy as np
from make_layered import solve
from scipy.interpolate import CubicSpline
from scipy.optimize import brentq
from scipy.special import erf

NAMES = ("density", "n_E", "film_nu", "nu", "film_aspect", "hardness", "pressure", "modulus", "area")
HURST = 0.8


def spectrum(density):
    """Wavevectors times sqrt(R sigma), the shares of the mean square gradient, and Nayak's alpha.

    Nayak's summits, R = sigma = 1: 1/R = (8/3) sqrt(m4/pi), N = m4/(6 pi sqrt(3) m2),
    sigma^2 = m0 - (1 + 16/pi - sqrt(27)) m2^2/m4.
    """
    m4 = 9 * math.pi / 64
    m2 = m4 / (6 * math.pi * math.sqrt(3) * density)
    m0 = 1 + (1 + 16 / math.pi - math.sqrt(27)) * m2**2 / m4
    alpha = m0 * m4 / m2**2
    t, weight = np.polynomial.legendre.leggauss(400)

    def waves(log_ratio):
        log = log_ratio * (t - 1) / 2
        share = weight * np.exp(log * (2 - 2 * HURST))
        return np.exp(log), share / share.sum()

    def too_wide(log_ratio):
        k, share = waves(log_ratio)
        return math.log(1.5 * (share / k**2).sum() * (share * k**2).sum() / alpha)

    k, share = waves(brentq(too_wide, 1e-9, 30.0))
    highest = math.sqrt(m4 / m2 / (0.75 * (share * k**2).sum()))
    return k * highest, share, alpha


def row(density, n_E, film_nu, nu, film_aspect, hardness, pressure):
    k, share, alpha = spectrum(density)
    width = 2.06 * n_E**-0.047 / k / film_aspect  # a/t at the whole area
    radii = np.geomspace(0.9 * width.min() * 1e-3**0.086, 1.1 * width.max(), 24)
    curve = CubicSpline(np.log(radii), [math.log(n_E * solve(1.0, n_E, film_nu, nu, one)[0]) for one in radii])
    c = 0.617 - 0.041 * math.log(alpha)

    def modulus(area):
        return math.sqrt((share * np.exp(2 * curve(np.log(width * area**0.086)))).sum())

    def bare(p):
        return erf(math.sqrt(2) * p * (1 + c * (1 - math.sqrt(erf(math.sqrt(2) * p)))))

    elastic = brentq(lambda area: bare(pressure / modulus(area)) - area, 1e-3, 1.0, xtol=1e-14)
    area = min((elastic**3.5 + (pressure / hardness) ** 3.5) ** (1 / 3.5), 1.0)
    return density, n_E, film_nu, nu, film_aspect, hardness, pressure, modulus(elastic), area


CASES = (
    (0.04, 0.1, 0.3, 0.3, 0.5, 1e9, 0.01), (0.04, 0.1, 0.45, 0.2, 2.0, 1e9, 0.05), (0.05, 0.4, 0.3, 0.3, 1.0, 0.2, 0.1),
    (0.08, 3.0, 0.2, 0.35, 0.7, 1e9, 0.03), (0.08, 10.0, 0.3, 0.3, 1.5, 1e9, 0.2), (0.2, 10.0, 0.25, 0.3, 0.3, 0.5, 0.1),
    (0.2, 0.2, 0.48, 0.3, 0.4, 1e9, 0.02), (0.035, 2.0, 0.3, 0.3, 5.0, 0.3, 0.2),
)  # fmt: skip


def main():
    with Path(__file__).with_name("rough_on_film.csv").open("w", newline="", encoding="utf-8") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(NAMES)
        out.writerows([f"{value:.10g}" for value in row(*one)] for one in CASES)


if __name__ == "__main__":
    main()
