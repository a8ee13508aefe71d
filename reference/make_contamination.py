"""Variance of the force of asperities whose strength differs: mpmath, 20 digits. Takes a second.

Hertz's asperities under Gaussian heights: `variance` is (c eta tau_0/H)^2 times the integral of w^2 over the heights that
touch, w being the area over pi R sigma.

- `independent_junctions.csv`: `variance` at `h`, for one asperity
"""

import csv
from pathlib import Path

from mpmath import mp, mpf

mp.dps = 20


def second_moment(h):
    return mp.quad(lambda w: w**2 * mp.exp(-((h + w) ** 2) / 2) / mp.sqrt(2 * mp.pi), [0, 1, 3, 8, 14])


if __name__ == "__main__":
    with (Path(__file__).parent / "independent_junctions.csv").open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["hardness_group", "shear_strength", "strength_variation", "h", "variance"])
        for eta, strength, c in (("0.5", "0.1", "0.3"), ("4", "0.01", "1.5")):
            for h in ("-1", "0", "1.5", "3"):
                variance = (mpf(c) * mpf(eta) * mpf(strength)) ** 2 * second_moment(mpf(h))
                writer.writerow([eta, strength, c, h, mp.nstr(variance, 15)])
