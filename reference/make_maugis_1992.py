"""Maugis's equations as printed, in his units, at given contact radii A: mpmath, 30 digits. Takes seconds.

The ring's m = c/a is found by bisection at a given A, the fold (dD/dA = 0, where the contact is lost in unloading) by golden
section.

- `maugis_1992.csv`: `load`, `area` at `w`; five contact radii (no kind), and where it tears off in unloading
  ("fold"); `branch` is empty where the contact is not stable
"""

import csv
from pathlib import Path

from mpmath import mp, mpf, pi

mp.dps = 30
HERE = Path(__file__).parent
TABOR = ("0.01", "0.1", "0.3", "0.7", "1", "2", "5", "20", "100")
THETA = ("0.1", "40")
RADII = ("0.1", "0.7", "1.5", "3", "10")


def state(A, lam):
    """D and P in Maugis's units; sqrt(m^2 - 1) by bisection, for what is 1 in the first equation grows with it."""
    low, high = mpf(10) ** -15, mpf(10) ** 15
    for _ in range(200):
        t = mp.sqrt(low * high)
        m = mp.sqrt(1 + t * t)
        bent = t + (m * m - 2) * mp.atan(t)
        value = lam * A * A / 2 * bent + mpf(4) / 3 * lam**2 * A * (t * mp.atan(t) - m + 1)
        low, high = (t, high) if value < 1 else (low, t)
    return A * A - mpf(4) / 3 * A * lam * t, A**3 - lam * A * A * (t + m * m * mp.atan(t))


def fold(lam):
    """A at the least D, by golden section in log A between 0.01 and 2; None if D still falls at 0.01."""
    low, high = mp.log(mpf("0.01")), mp.log(mpf(2))
    ratio = (mp.sqrt(5) - 1) / 2

    def D(at):
        return state(mp.exp(at), lam)[0]

    if D(low) < D(low + mpf("0.01")):
        return None
    for _ in range(75):
        one, two = high - ratio * (high - low), low + ratio * (high - low)
        low, high = (low, two) if D(one) < D(two) else (one, high)
    return mp.exp((low + high) / 2)


def main():
    # the stress is the largest of Lennard-Jones, sigma_0 = 16 gamma/(9 sqrt(3) epsilon); here gamma = epsilon = R = E* = 1
    stress, K = 16 / (9 * mp.sqrt(3)), mpf(4) / 3
    lambda_over_tabor = 2 * stress * (1 / (pi * K**2)) ** (mpf(1) / 3)
    with (HERE / "maugis_1992.csv").open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["kind", "tabor_parameter", "theta", "branch", "w", "load", "area"])
        for tabor in TABOR:
            lam = lambda_over_tabor * mpf(float(tabor))
            points = [("", mpf(A)) for A in RADII]
            at = fold(lam)
            points += [("fold", at)] if at else []
            for kind, A in points:
                D, P = state(A, lam)
                for theta in THETA:
                    g = (pi / mpf(float(theta))) ** (mpf(1) / 3)
                    row = (D * g * g, P * g**3, A * A * g * g)
                    branch = "unloading" if at is None or A >= at else ""
                    writer.writerow([kind, tabor, theta, branch, *(mp.nstr(value, 17) for value in row)])


if __name__ == "__main__":
    main()
