"""Plastic films of one's own asperity, summed over Gaussian heights: mpmath, tanh-sinh cut at every kink, 25 digits. 40 s.

Equations as the files of the models state them; loads and friction over K R^(1/2) sigma^(3/2), areas over pi R sigma, per
asperity, at h = -1, 1, 3; the shear strength of the interface is `shear_strength` over the substrate's hardness:

- `dayson_1971.csv`: `load`, `area`, `friction`, `bared_area`, of the substrate; from the mean depth of Gaussian heights beyond
  a height, phi(h) - h (1 - Phi(h)), in closed form
- `ravindran_ramasamy_laddha_1980.csv`: `load`, `area`, `friction`
- `kato_1981.csv`: `load`, `area`, `friction`; the pressure's integral with complex lengths, so that one formula holds before
  and after the film is pressed through
"""

import csv
from itertools import pairwise, product
from pathlib import Path

from mpmath import mp, mpf

mp.dps = 25
HERE = Path(__file__).parent
SEPARATIONS = ("-1", "1", "3")


def write(name, rows):
    """Numbers given are the doubles nearest to what is printed; those computed have 17 digits."""
    with (HERE / name).open("w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        table.writeheader()
        for row in rows:
            table.writerow({key: cell if isinstance(cell, str) else mp.nstr(cell, 17) for key, cell in row.items()})


def total(function, h, cuts):
    """Integral over the depth of an asperity of function(depth) times the density of heights, cut where it has kinks."""
    ends = sorted({mpf(0), *(one for one in cuts if 0 < one < 30), *(mpf(n) / 2 for n in range(1, 25)), mpf(30)})
    density = lambda w: mp.exp(-((h + w) ** 2) / 2) / mp.sqrt(2 * mp.pi)  # noqa: E731
    return mp.fsum(mp.quad(lambda w: function(w) * density(w), piece) for piece in pairwise(ends))


def depth(h):
    """Mean depth of Gaussian heights beyond h."""
    return mp.exp(-(h**2) / 2) / mp.sqrt(2 * mp.pi) - h * mp.erfc(h / mp.sqrt(2)) / 2


def cases(names, groups):
    """Rows of all groups at all separations: what is written, the numbers, and pi H sqrt(R/sigma)/K."""
    for texts, separation in product(groups, SEPARATIONS):
        given = dict(zip(names, texts, strict=True)) | {"h": separation}
        numbers = {name: mpf(float(text)) for name, text in given.items()}
        eta = mp.sqrt(mp.pi) * (18 * numbers["lam"]) ** mpf("0.25") / mp.sqrt(numbers["theta"])
        yield given, numbers, eta


def dayson():
    names = ("theta", "lam", "hardness_to_yield", "n_H", "tau", "shear_strength")
    groups = (
        ("100", "10", "2.8", "0.4", "0.5", "0.02"),
        ("30", "1e5", "3", "0.05", "2", "0.001"),
        ("2000", "1e6", "1.7", "0.8", "0.1", "0.2"),
    )
    rows = []
    for pressure, (given, g, eta) in product(("film_hardness", "substrate_hardness"), list(cases(names, groups))):
        p = g["n_H"] if pressure == "film_hardness" else 1
        whole, bared = 2 * depth(g["h"]), 2 * depth(g["h"] + g["tau"])
        metal = 1 / (mp.sqrt(3) * g["hardness_to_yield"])
        friction = eta * (g["shear_strength"] * (whole - bared) + metal * bared)
        rows.append({"rim_pressure": pressure, **given, "load": eta * (p * (whole - bared) + bared), "area": whole,
                     "friction": friction, "bared_area": bared})  # fmt: skip
    write("dayson_1971.csv", rows)


def ravindran():
    """mu of one asperity is given and its load is sought: tau_0 A = mu(W) W."""
    names = ("theta", "lam", "n_H", "tau", "shear_strength", "film_friction_constant")
    groups = (
        ("100", "10", "0.3", "0.4", "0.05", "0.003"),
        ("30", "1e5", "0.05", "2", "0.01", "0.08"),
        ("2000", "1e6", "0.6", "0.05", "0.2", "0.3"),
    )
    rows = []
    for given, g, eta in cases(names, groups):
        s, n, C, tau = g["shear_strength"], g["n_H"], g["film_friction_constant"], g["tau"]

        def load(w):
            """Of mu = tau_0 A/W: W^(2/3) = tau_0 A/(C t)^(1/3), where mu is between the bounds."""
            sheared = s * eta * 2 * w  # noqa: B023
            return min(max((sheared / (C * tau) ** (mpf(1) / 3)) ** mpf("1.5"), n * eta * 2 * w), eta * 2 * w)  # noqa: B023

        middle = lambda w: (s * eta * 2 * w) ** mpf("1.5") / mp.sqrt(C * tau) / (2 * eta * w)  # noqa: E731, B023
        cuts = [(bound / middle(mpf(1))) ** 2 for bound in (n, mpf(1))]
        area = total(lambda w: 2 * w, g["h"], ())
        rows.append({**given, "load": total(load, g["h"], cuts), "area": area, "friction": s * eta * area})
    write("ravindran_ramasamy_laddha_1980.csv", rows)


def kato():
    names = ("theta", "lam", "hardness_to_yield", "n_H", "tau", "film_aspect", "shear_strength")
    groups = (
        ("100", "10", "2.8", "0.2", "0.5", "0.05", "0.05"),
        ("30", "1e5", "3", "0.05", "2", "0.4", "0.01"),
        ("2000", "1e6", "1.7", "0.8", "0.1", "0.003", "0.2"),
        ("500", "100", "2.8", "0.1", "4", "2", "0.02"),
    )
    rows = []
    for given, g, eta in cases(names, groups):
        tau, n = g["tau"], g["n_H"]
        hill = 4 * n / (mp.sqrt(3) * g["hardness_to_yield"]) * tau / g["film_aspect"]  # 4 k_f sqrt(R/sigma) over H
        m = (1 - n) / hill

        def load(w):
            """P over H, lengths over sqrt(R sigma): H_f a^2 and the integral of r^2 2 k_f/s from c to a."""
            gap = tau - w if w != tau else mp.eps * tau  # noqa: B023
            a, b = mp.sqrt(2 * w), mp.sqrt(mp.mpc(2 * gap))
            outer = mp.atan(a / b)
            inner = outer - m * b  # noqa: B023
            c = b * mp.tan(inner) if w > tau or inner.real > 0 else mpf(0)  # noqa: B023
            inner = inner if c != 0 else mpf(0)
            return (2 * w * n + hill * (a - c - b * (outer - inner))).real  # noqa: B023

        width = mp.sqrt(2 * tau)
        first = mp.findroot(lambda u: u - m * width * mp.cos(u), (mpf(0), mp.pi / 2), solver="anderson")  # noqa: B023
        w_c = tau * mp.sin(first) ** 2
        near = [tau + sign * tau / mpf(10) ** power for sign in (-1, 1) for power in (1, 2, 3, 4)]
        cuts = (w_c / 100, w_c / 10, w_c, *near, tau, 2 * tau, 5 * tau, 20 * tau)
        area = total(lambda w: 2 * w, g["h"], ())
        rows.append({**given, "load": eta * total(load, g["h"], cuts), "area": area,
                     "friction": g["shear_strength"] * eta * area})  # fmt: skip
    write("kato_1981.csv", rows)


if __name__ == "__main__":
    dayson()
    ravindran()
    kato()
