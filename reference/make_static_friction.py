"""Static friction of elastic-plastic asperities on Gaussian heights: mpmath, 30 digits. Takes a minute.

The asperities of make_elastic_plastic.py, in pascals and metres with R = E* = 1, and at each displacement the friction
coefficient as its authors fit it, times the load: the defining integrals, not the authors' formulas of them. Load, area and
friction are per asperity.

- `kogut_etsion_2004.csv`: `load`, `area`, `friction` at `h`
- `cohen_kligerman_etsion_2008.csv`: the same
"""

import csv

from make_elastic_plastic import HERE, brizmer_kligerman_etsion_2006, contact, kogut_etsion_2002, sums
from mpmath import coth, mp, mpf, pi

NAMES = ("theta", "lam", "nu", "hardness_to_yield")
SHARPNESS = "0.01"  # of no influence here: what scales sigma against R
# Contacts from elastic to plastic: Etsion's (sigma/omega_c)^(1/2) is 0.4 to 6.
CONTACTS = (
    ("100", "1e5", "0.3", "2.8"),
    ("1000", "2e4", "0.25", "3"),
    ("200", "100", "0.3", "2.8"),
    ("50", "0.5", "0.4", "2.5"),
)
SEPARATIONS = ("-0.5", "1", "3")


def inception(r):
    """Kogut and Etsion 2003, three digits; r is omega over omega_c."""
    if r > 6:
        return mpf(0)
    if r <= 1:
        return mpf("0.52") * r ** mpf("-0.518")
    return mpf("0.822") - mpf("0.389") * r + mpf("0.085") * r**2 - mpf("0.007") * r**3


def stick(ratio):
    """Brizmer, Kligerman and Etsion 2007; ratio is P over P_c."""
    return mpf("0.27") * coth(mpf("0.27") * ratio ** mpf("0.35"))


def kogut_etsion_2004(c):
    law, kinks = kogut_etsion_2002(c)

    def friction(d):
        return inception(d / kinks[0]) * law(d)[0], mpf(0)

    return law, kinks, friction


def cohen_kligerman_etsion_2008(c):
    law, kinks = brizmer_kligerman_etsion_2006(c)
    critical = law(kinks[0])[0]

    def friction(d):
        load = law(d)[0]
        return stick(load / critical) * load if load else mpf(0), mpf(0)

    return law, kinks, friction


def rows(model):
    for given in CONTACTS:
        c = contact(*(float(value) for value in given), SHARPNESS)
        law, kinks, friction = model(c)
        # A power of r just above nothing: pieces that shrink towards first touch.
        near = [kinks[0] * mpf(10) ** -n for n in range(8, 0, -1)]
        force, area = mpf(4) / 3 * c["sigma"] ** mpf("1.5"), pi * c["sigma"]
        for h in SEPARATIONS:
            load_sum, area_sum = sums(law, kinks, c, mpf(float(h)))
            friction_sum, _ = sums(friction, [*near, *kinks], c, mpf(float(h)))
            yield [*given, h, *(mp.nstr(one, 17) for one in (load_sum / force, area_sum / area, friction_sum / force))]


if __name__ == "__main__":
    for model in (kogut_etsion_2004, cohen_kligerman_etsion_2008):
        with (HERE / f"{model.__name__}.csv").open("w", newline="", encoding="utf-8") as file:
            table = csv.writer(file, lineterminator="\n")
            table.writerow([*NAMES, "h", "load", "area", "friction"])
            table.writerows(rows(model))
