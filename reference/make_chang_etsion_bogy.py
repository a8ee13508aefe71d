"""Asperities of Chang, Etsion and Bogy on Gaussian heights: mpmath, 30 digits. Takes seconds.

w* = w/w_c = psi^2 w/sigma; nu = 0.3; loads over N P_c, areas over N pi R w_c, friction over N P_c, P_c = w_c^(3/2). Normal law:
Chang-Etsion-Bogy 1987. Tangential law: Chang-Etsion-Bogy 1988, first yield on the axis or at the edge, none from w* = 1 on.

- `chang_etsion_bogy.csv` of `chang_etsion_bogy_1988`: `load`, `area`, `friction`, `friction_coefficient` at `psi`, `h`

A table of the compendium this project works from prints P/(N P_c), mu and A/(N A_c) side by side for psi = 0.5, 1, 2, 4 and 8.
Evaluated here, with Q the friction force of 1988:

| psi, h | Q/P, P elastic (Greenwood-Williamson) | Q/P, P of Brizmer et al. | Q/P, P of Chang-Etsion-Bogy 1987 | printed |
|---|---|---|---|---|
| 0.5, 1 | .75436 | .75436 | .75435 | .7543 |
| 1, 1 | .20789 | .20796 | .16074 | .1607 |
| 1, 2 | .31482 | .31484 | .26739 | .2673 |
| 1, 3 | .41212 | .41213 | .37583 | .3758 |
| 2, 1 | .01218 | .01286 | .00939 | .0094 |
| 2, 3 | .04716 | .04805 | .03354 | .0335 |

So the printed mu divides by the load of Chang-Etsion-Bogy 1987, plasticity included (the fourth decimal of .2673 is
cut, not rounded), while the printed P and A columns are those of Brizmer, Kligerman and Etsion (psi = 1, h = 1: P
.07564236, A .08342407; here Chang-Etsion-Bogy gives .09786299 and .09180617). Dividing Q by the printed P does not
give the printed mu.
"""

import csv
from itertools import pairwise
from pathlib import Path

from mpmath import mp, mpf

mp.dps = 30
HERE = Path(__file__).parent
NU = mpf("0.3")
K_H = mpf("0.454") + mpf("0.41") * NU
DEPTH = mpf("0.48")  # of first yield on the axis, over a, for nu = 0.3
PSI, SEPARATIONS = ("0.5", "1", "2"), ("1", "2", "3")

C1 = -1 + mpf(3) / 2 * DEPTH * mp.atan(1 / DEPTH) - DEPTH**2 / (2 * (1 + DEPTH**2))
C3 = 9 * mp.pi**2 / 16 * (2 - NU / 2 + mpf(7) / 8 * NU**2)
C4 = 9 * mp.pi / 4 * (1 - 2 * NU) * (1 - NU / 2)


def load(w):
    """Hertz, then P = A K_H H with P_c = (2/3) K_H H pi R w_c."""
    return w * mp.sqrt(w) if w < 1 else mpf(3) / 2 * area(w)


def area(w):
    return w if w < 1 else w * (2 - 1 / w)


def axis(w):
    return mpf("0.2045") / (K_H * abs(C1)) * mp.sqrt(1 / w - 1)


def edge(w):
    c5 = mpf(3) / 2 * (1 - 2 * NU) ** 2 - mpf("0.56") / (K_H**2 * w)
    return (-C4 + mp.sqrt(C4**2 - 4 * C3 * c5)) / (2 * C3)


def friction(w):
    return min(axis(w), edge(w)) * load(w) if 0 < w < 1 else mpf(0)


def rough(function, psi, h, kinks):
    """Int function(psi^2 s) phi(h + s) ds from the first kink to the last, split at all of them."""

    def value(s):
        return function(mpf(psi) ** 2 * s) * mp.npdf(mpf(h) + s)

    cuts = sorted({*kinks, *(v for v in map(mpf, range(1, 22)) if v < kinks[-1])})
    return sum(mp.quad(value, pair) for pair in pairwise(cuts))


def rows():
    kink = mp.findroot(lambda w: axis(w) - edge(w), (mpf("0.9"), mpf("0.99")), solver="anderson")
    for psi in PSI:
        one = 1 / mpf(psi) ** 2
        for h in SEPARATIONS:
            P = rough(load, psi, h, [mpf(0), one, mpf(22)])
            A = rough(area, psi, h, [mpf(0), one, mpf(22)])
            T = rough(friction, psi, h, [mpf(0), kink * one, one])
            yield [psi, h, "0.3", *(mp.nstr(v, 17, strip_zeros=False) for v in (P, A, T, T / P))]


if __name__ == "__main__":
    with (HERE / "chang_etsion_bogy.csv").open("w", newline="", encoding="utf-8") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["psi", "h", "nu", "load", "area", "friction", "friction_coefficient"])
        out.writerows(rows())
