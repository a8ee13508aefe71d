"""Elastic-plastic asperities without adhesion, from their published equations in pascals and metres: mpmath, 30 digits. 20 s.

Nothing of the package is imported. Each row is a contact in dimensionless groups, one displacement w with the load and area
of one asperity there, and one separation h with the sums over Gaussian heights: 8 contacts, 6 displacements of each. The
dimensional contact behind the groups has R = 1, E* = 1, so K = 4/3, sigma = sharpness^2 and, by the definitions
theta = K sigma^(3/2)/(gamma R^(1/2)), lambda = pi^2 R H^4 sigma/(18 K^2 gamma^2): gamma, then H.

- `zhao_maietta_chang_2000.csv`: `load`, `area` at `w`; `load_sum`, `area_sum` at `h`
- `kogut_etsion_2002.csv`: the same
- `jackson_green_2005.csv`: the same
- `brizmer_kligerman_etsion_2006.csv`: the same
"""

import csv
import random
from pathlib import Path

from mpmath import exp, log, mp, mpf, pi, quad, sqrt

mp.dps = 30
HERE = Path(__file__).parent
INPUTS = ("theta", "lam", "nu", "hardness_to_yield", "sharpness")


def contact(theta, lam, nu, k, sharpness):
    """R = E* = 1; sigma, H, Y."""
    K, sigma = mpf(4) / 3, mpf(sharpness) ** 2
    gamma = K * sigma ** mpf("1.5") / mpf(theta)
    H = (mpf(lam) * 18 * K**2 * gamma**2 / (pi**2 * sigma)) ** mpf("0.25")
    return {"sigma": sigma, "H": H, "Y": H / mpf(k), "nu": mpf(nu)}


def hertz(d):
    return mpf(4) / 3 * d ** mpf("1.5"), pi * d


def zhao_maietta_chang_2000(c):
    k = mpf("0.4")
    d1 = (3 * pi * k * c["H"] / 4) ** 2
    d2 = 54 * d1

    def law(d):
        if d <= d1:
            return hertz(d)
        if d >= d2:
            return 2 * pi * d * c["H"], 2 * pi * d
        xi = (d - d1) / (d2 - d1)
        area = pi * d * (1 - 2 * xi**3 + 3 * xi**2)
        pressure = c["H"] * (1 - (1 - k) * (log(d2) - log(d)) / (log(d2) - log(d1)))
        return pressure * area, area

    return law, (d1, d2)


def kogut_etsion_2002(c):
    K_H = mpf("0.454") + mpf("0.41") * c["nu"]
    dc = (pi * K_H * c["H"] / 2) ** 2
    Pc, Ac = mpf(2) / 3 * K_H * c["H"] * pi * dc, pi * dc

    def law(d):
        r = d / dc
        if r <= 1:
            return Pc * r ** mpf("1.5"), Ac * r
        if r <= 6:
            return Pc * mpf("1.03") * r ** mpf("1.425"), Ac * mpf("0.93") * r ** mpf("1.136")
        if r <= 110:
            return Pc * mpf("1.40") * r ** mpf("1.263"), Ac * mpf("0.94") * r ** mpf("1.146")
        return Pc * 3 / K_H * r, Ac * 2 * r

    return law, (dc, 6 * dc, 110 * dc)


def jackson_green_2005(c):
    C = mpf("1.295") * exp(mpf("0.736") * c["nu"])
    dc = (pi * C * c["Y"] / 2) ** 2
    Pc = mpf(4) / 3 * (C * pi * c["Y"] / 2) ** 3
    B = mpf("0.14") * exp(23 * c["Y"])

    def law(d):
        r = d / dc
        if r <= mpf("1.9"):
            return hertz(d)
        area = pi * d * (r / mpf("1.9")) ** B
        H = mpf("2.84") * (1 - exp(-mpf("0.82") * sqrt(area / pi) ** mpf("-0.7")))
        soft = 4 * H / C * (1 - exp(-(r ** (mpf(5) / 9)) / 25)) * r
        return Pc * (exp(-(r ** (mpf(5) / 12)) / 4) * r ** mpf("1.5") + soft), area

    return law, (mpf("1.9") * dc,)


def brizmer_kligerman_etsion_2006(c):
    nu = c["nu"]
    held = max(nu, mpf("0.2"))
    slip_limited = (pi * (mpf("1.234") + mpf("1.256") * nu) * c["Y"] / 2) ** 2
    dc = slip_limited * (mpf("6.82") * held - mpf("7.83") * (held**2 + mpf("0.0586")))
    Lc = mpf(4) / 3 * slip_limited ** mpf("1.5") * (mpf("8.88") * held - mpf("10.13") * (held**2 + mpf("0.089")))
    beta, alpha = mpf("0.174") + mpf("0.08") * nu, mpf("0.25") + mpf("0.125") * nu

    def law(d):
        r = d / dc
        if r <= 1:
            return Lc * r ** mpf("1.5"), pi * d
        return Lc * r ** mpf("1.5") * (1 - exp(1 / (1 - r**beta))), pi * d * (1 + exp(1 / (1 - r**alpha)))

    return law, (dc,)


def sums(law, kinks, c, h):
    """Over Gaussian heights: Int law(sigma w) phi(h + w) dw, in pieces that double from the last kink on."""
    sigma = c["sigma"]
    ends = [mpf(0), *(k / sigma for k in kinks)]
    while ends[-1] < 30:
        ends.append(max(2 * ends[-1], mpf("1e-3")))
    ends = [one for one in ends if one < 30] + [mpf(30)]
    fine = [ends[0]]
    for one in ends[1:]:  # no piece longer than half of sigma: phi is as good as entire on it
        parts = int((one - fine[-1]) / mpf("0.5")) + 1
        start = fine[-1]
        fine += [start + (one - start) * (i + 1) / parts for i in range(parts)]
    weight = 1 / sqrt(2 * pi)
    return [quad(lambda w, q=q: law(sigma * w)[q] * weight * exp(-((h + w) ** 2) / 2), fine) for q in (0, 1)]


def rows(model, seed):
    rng = random.Random(seed)
    for number in range(8):
        given = {
            "theta": float(f"{10 ** rng.uniform(0.5, 4):.3g}"),
            "lam": float(f"{10 ** rng.uniform(-1, 4):.3g}"),
            "nu": (0.0, 0.12, 0.2, 0.25, 0.3, 0.35, 0.45, 0.499)[number],
            "hardness_to_yield": round(rng.uniform(2, 3.5), 2),
            "sharpness": float(f"{10 ** rng.uniform(-3, -1.3):.3g}"),
        }
        c = contact(*(given[name] for name in INPUTS))
        law, kinks = model(c)
        sigma, K = c["sigma"], mpf(4) / 3
        h = round(rng.uniform(-1.0, 3.5), 2)
        load_sum, area_sum = sums(law, kinks, c, mpf(h))
        for over_yield in (0.7, 1.4, 3.0, 8.0, 70.0, 300.0):
            w = float(over_yield * kinks[0] / sigma)
            load, area = law(mpf(w) * sigma)
            values = (w, load / (K * sigma ** mpf("1.5")), area / (pi * sigma), h)
            values += (load_sum / (K * sigma ** mpf("1.5")), area_sum / (pi * sigma))
            yield [repr(given[name]) for name in INPUTS] + [mp.nstr(mpf(one), 17, strip_zeros=True) for one in values]


if __name__ == "__main__":
    laws = zhao_maietta_chang_2000, kogut_etsion_2002, jackson_green_2005, brizmer_kligerman_etsion_2006
    for seed, model in enumerate(laws):
        with (HERE / f"{model.__name__}.csv").open("w", newline="") as file:
            table = csv.writer(file, lineterminator="\n")
            table.writerow([*INPUTS, "w", "load", "area", "h", "load_sum", "area_sum"])
            table.writerows(rows(model, seed))
