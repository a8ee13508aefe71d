"""Writes synthetic_boundary_film.csv: numbers that nobody measured, to show the format and to try the comparison on.

    python validation/make_synthetic.py

Friction of a boundary film, T = tau0 A + alpha P, on the area of an elastic Gaussian surface after Persson (2001),
A = A_n erf(sqrt2 p/(E* h')), with scatter of 5 % from one value to the next. The package is not used.
"""

import math
from pathlib import Path

import numpy as np

SIGMA, RADIUS, DENSITY = 20e-9, 100e-6, 2.0e10  # as in synthetic_boundary_film.toml
MODULUS, NOMINAL = 210e9 / (1 - 0.3**2) / 2, 1e-6
STRENGTH, COEFFICIENT = 200e6, 0.05
LOADS = [0.01, 0.03, 0.1, 0.3, 1.0, 3.0]  # N
SCATTER = 0.05


def main() -> None:
    gradient = math.sqrt(math.sqrt(3) / (64 * DENSITY * RADIUS**2))
    drawn = np.random.default_rng(2017).normal(size=len(LOADS))
    lines = [
        "# SYNTHETIC: made by make_synthetic.py, measured by nobody",
        "load [N],friction_coefficient,friction_coefficient_error",
    ]
    for load, one in zip(LOADS, drawn, strict=True):
        area = NOMINAL * math.erf(math.sqrt(2) * load / NOMINAL / (MODULUS * gradient))
        mu = STRENGTH * area / load + COEFFICIENT
        lines.append(f"{load:g},{mu * (1 + SCATTER * one):.4f},{SCATTER * mu:.4f}")
    Path(__file__).with_name("synthetic_boundary_film.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
