"""The hardening sphere of Ghaednia et al. 2019, from its equations in pascals and metres: mpmath, 30 digits. Takes 28 s.

Eq. (26) is corrected. Nothing of the package is imported; what the law shares with the elastic-plastic ones of
make_elastic_plastic.py (the contact behind the groups, Hertz, and the sums over Gaussian heights) is taken from there. Each
row is a contact in dimensionless groups, what the other body is, one displacement w with load and area of one asperity there,
and one separation h with the sums: 10 contacts, both values of `other_body`, 6 displacements of each.

- `ghaednia_2019.csv`: `load`, `area` at `w`; `load_sum`, `area_sum` at `h`
"""

import csv
import random

from make_elastic_plastic import HERE, contact, hertz, sums
from mpmath import cos, exp, findroot, mp, mpf, pi, sqrt

INPUTS = ("theta", "lam", "nu", "hardness_to_yield", "sharpness", "hardening")


def ghaednia_2019(c, e, other_body):
    """E* = R = 1. e = E_t/E; E = 2 (1 - nu^2) E* between bodies alike, (1 - nu^2) E* against a rigid one."""
    e, nu, S = mpf(e), c["nu"], c["Y"]
    E = {"alike": 2, "rigid": 1}[other_body] * (1 - nu**2)
    C = mpf("1.295") * exp(mpf("0.736") * nu)
    dc = (pi * C * S / 2) ** 2
    Fc = mpf(4) / 3 * (C * pi * S / 2) ** 3
    B = mpf("0.14") * exp(23 * S)

    def radius(d):
        ae = sqrt(d)
        ap = pi * C * S / 2 * sqrt(d / dc * (d / dc / mpf("1.9")) ** B)
        if e == 0:
            return ap
        upsilon = -2 * sqrt(E / S) * e ** (1 - (d - dc)) / ((4 - 3 * exp(-2 * sqrt(E / S) * e)) * (1 - e))
        return ae + (ap - ae) * exp(upsilon)

    start, wide = mpf("1.9") * dc, mpf(0)
    if radius(start) < 1:  # the limiting hardness is held from where the contact is first as wide as the sphere
        last = next(n for n in range(1, 1001) if radius(start + (1 - start) * n / 1000) >= 1)
        ends = (start + (1 - start) * (last - 1) / 1000, start + (1 - start) * last / 1000)
        wide = findroot(lambda d: radius(d) - 1, ends, solver="anderson", tol=mpf(10) ** -25)

    def law(d):
        if d <= start:
            return hertz(d)
        r, a = d / dc, radius(d)
        H = 1 if d >= wide else mpf("2.84") - mpf("0.92") * (1 - cos(pi * a))
        Fp = Fc * (exp(-(r ** (mpf(5) / 12)) / 4) * r ** mpf("1.5") + 4 * H / C * (1 - exp(-(r ** (mpf(5) / 9)) / 25)) * r)
        return Fp + (hertz(d)[0] - Fp) * (1 - exp(-mpf("3.3") * e)), pi * a**2

    return law, [start, wide] if wide else [start]


def rows():
    rng = random.Random(19)
    for number in range(10):
        given = {
            "theta": float(f"{10 ** rng.uniform(0.5, 4):.3g}"),
            "lam": float(f"{10 ** rng.uniform(-1, 4):.3g}"),
            "nu": (0.0, 0.12, 0.2, 0.25, 0.3, 0.3, 0.33, 0.35, 0.45, 0.499)[number],
            "hardness_to_yield": round(rng.uniform(2, 3.5), 2),
            "sharpness": float(f"{10 ** rng.uniform(-2.5, -1):.3g}"),
            "hardening": (0.0, 0.0, 1e-5, 1e-3, 3e-3, 0.01, 0.02, 0.1, 0.5, 0.95)[number],
        }
        if number == 3:  # sharp: both a = R and omega = R within the heights
            given |= {"theta": 30.0, "lam": 1.0, "sharpness": 0.45}
        c = contact(*(given[name] for name in INPUTS[:-1]))
        sigma, K = c["sigma"], mpf(4) / 3
        h = round(rng.uniform(-1.0, 3.5), 2) if number != 3 else -3.0
        for other_body in ("alike", "rigid"):
            law, kinks = ghaednia_2019(c, given["hardening"], other_body)
            summed = sums(law, kinks, c, mpf(h))
            for over_yield in (0.7, 1.4, 3.0, 8.0, 70.0, 300.0):
                w = float(over_yield * kinks[0] / sigma)
                load, area = law(mpf(w) * sigma)
                values = (w, load / (K * sigma ** mpf("1.5")), area / (pi * sigma), h)
                values += (summed[0] / (K * sigma ** mpf("1.5")), summed[1] / (pi * sigma))
                row = [repr(given[name]) for name in INPUTS] + [other_body]
                yield row + [mp.nstr(mpf(one), 17, strip_zeros=True) for one in values]


if __name__ == "__main__":
    with (HERE / "ghaednia_2019.csv").open("w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow([*INPUTS, "other_body", "w", "load", "area", "h", "load_sum", "area_sum"])
        table.writerows(rows())
