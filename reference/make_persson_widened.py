"""The widened area of Persson by mpmath, in thirty digits, from the equations as they are printed in the docstring of the law.

- `persson_widened.csv`: `area` over the nominal at `pressure` and `hardness` (0: none) over E* h', of Nayak's `alpha`
"""

import csv
from pathlib import Path

from mpmath import erf, log, mp, mpf, sqrt

mp.dps = 30


def area(pressure: str, alpha: str, hardness: str):
    """A/A0."""
    p, c = mpf(pressure), mpf("0.617") - mpf("0.041") * log(mpf(alpha))
    elastic = erf(sqrt(2) * p * (1 + c * (1 - sqrt(erf(sqrt(2) * p)))))
    if mpf(hardness) == 0:
        return elastic
    return min((elastic ** mpf("3.5") + (p / mpf(hardness)) ** mpf("3.5")) ** (1 / mpf("3.5")), mpf(1))


if __name__ == "__main__":
    rows = [(p, a, h) for a in ("2", "10", "100") for h in ("0", "0.6", "0.05") for p in ("0.001", "0.01", "0.04", "0.3")]
    with Path(__file__).with_name("persson_widened.csv").open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(("pressure", "alpha", "hardness", "area"))
        table.writerows((*row, mp.nstr(area(*row), 17)) for row in rows)
