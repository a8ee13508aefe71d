"""Single asperities that are elastic, or plastic in a closed form, in pascals and metres: mpmath, 30 digits. Takes seconds.

R = E* = 1 and K = 4/3, with sigma, the work of adhesion and the hardness that belong to the groups. JKR's contact radius at a
displacement is found by bisection on the stable side, and so is the radius at which the mean pressure is the hardness. Each row
is a contact in dimensionless groups, the options of the law, and one displacement w with load and area of one asperity there.

- `hertz.csv`: `load`, `area` at `w`
- `dmt.csv`: the same; Hertz's load less 2 pi gamma R
- `jkr.csv`: the same, with `branch` down to the displacement at which it lets go
- `chang_etsion_bogy_1987.csv`: the same, from below to far beyond the critical interference
- `roy_chowdhury_ghosh_1994.csv`: the same, from below to far beyond the onset of plastic flow, with `branch`
"""

import csv

from make_elastic_plastic import HERE, contact, hertz
from mpmath import mp, mpf, pi, sqrt

K = mpf(4) / 3
# theta, lambda, nu: soft and sticky to hard and dry.
CONTACTS = (
    ("0.5", "3", "0.3"),
    ("4", "0.02", "0.45"),
    ("40", "10", "0.3"),
    ("700", "2e3", "0.2"),
    ("1e5", "1e4", "0"),
)
SHARPNESS = "0.01"  # of no influence here: what scales sigma against R


class Sphere:
    """R = E* = 1; scales of the groups."""

    def __init__(self, theta, lam, nu):
        values = contact(theta, lam, nu, 1, SHARPNESS)
        self.sigma, self.H, self.nu = values["sigma"], values["H"], mpf(nu)
        self.force = K * self.sigma ** mpf("1.5")
        self.gamma = self.force / mpf(theta)

    def jkr_displacement(self, a):
        return a**2 - sqrt(8 * pi * self.gamma * a / (3 * K))

    def jkr_load(self, a):
        return K * a**3 - sqrt(6 * pi * self.gamma * K * a**3)

    @property
    def detached(self):
        """The contact radius at the least displacement: d(displacement)/da = 0, so 2 a = sqrt(2 pi gamma/(3 K a))."""
        return (pi * self.gamma / (6 * K)) ** (mpf(1) / 3)

    def jkr(self, d):
        a = self.bisect(lambda a: self.jkr_displacement(a) - d, self.detached)
        return self.jkr_load(a), pi * a**2

    def onset(self):
        """The displacement at which the mean pressure of JKR's contact is the hardness."""
        a = self.bisect(lambda a: self.jkr_load(a) - self.H * pi * a**2, self.detached)
        return self.jkr_displacement(a)

    @staticmethod
    def bisect(excess, low):
        high = 2 * low
        while excess(high) < 0:
            low, high = high, 2 * high
        for _ in range(110):
            middle = (low + high) / 2
            low, high = (middle, high) if excess(middle) < 0 else (low, middle)
        return (low + high) / 2


def dry(sphere, branch):
    return [sphere.sigma * mpf(w) for w in ("1e-3", "0.2", "1", "9")]


def critical(sphere):
    """Chang, Etsion and Bogy: K_H H, and omega_c = (pi K_H H/(2 E*))^2 R."""
    pressure = (mpf("0.454") + mpf("0.41") * sphere.nu) * sphere.H
    return pressure, (pi * pressure / 2) ** 2


def around_critical(sphere, branch):
    return [critical(sphere)[1] * mpf(part) for part in ("0.01", "0.9", "1.1", "6", "300")]


def from_contact(sphere, branch, middle):
    """From where the contact is made or lost on a branch, to beyond the displacement `middle`."""
    start = mpf(0) if branch == "loading" else sphere.jkr_displacement(sphere.detached)
    span = max(middle - start, sphere.sigma / 10)
    return [start + span * mpf(part) for part in ("0.01", "0.3", "0.9", "1.2", "7", "100")]


def dmt(sphere, d):
    load, area = hertz(d)
    return load - 2 * pi * sphere.gamma, area


def chang_etsion_bogy(sphere, d):
    """Hertz, then the mean pressure K_H H on pi R omega (2 - omega_c/omega)."""
    pressure, at = critical(sphere)
    area = pi * d * (2 - at / d)
    return hertz(d) if d < at else (pressure * area, area)


def roy_chowdhury(sphere, d):
    """JKR up to the onset, then the hardness on 2 pi R omega less 2 pi gamma R."""
    return sphere.jkr(d) if d < sphere.onset() else (2 * pi * (sphere.H * d - sphere.gamma), 2 * pi * d)


BRANCHES = ("loading", "unloading")
# Key -> number of inputs, branches, displacements, load and area.
LAWS = {
    "hertz": (0, (), dry, lambda sphere, d: hertz(d)),
    "dmt": (1, (), dry, dmt),
    "jkr": (1, BRANCHES, lambda sphere, branch: from_contact(sphere, branch, sphere.sigma), Sphere.jkr),
    "chang_etsion_bogy_1987": (3, (), around_critical, chang_etsion_bogy),
    "roy_chowdhury_ghosh_1994": (
        2, BRANCHES, lambda sphere, branch: from_contact(sphere, branch, sphere.onset()), roy_chowdhury,
    ),
}  # fmt: skip


def rows(inputs, branches, displacements, state):
    for given in CONTACTS:
        sphere = Sphere(*(float(value) for value in given))
        for branch in branches or ("",):
            for d in displacements(sphere, branch):
                w = float(d / sphere.sigma)  # the input of the row is a double
                load, area = state(sphere, mpf(w) * sphere.sigma)
                values = repr(w), *(mp.nstr(one, 17) for one in (load / sphere.force, area / (pi * sphere.sigma)))
                yield [*given[:inputs], *([branch] if branch else []), *values]


if __name__ == "__main__":
    for key, (inputs, branches, *law) in LAWS.items():
        with (HERE / f"{key}.csv").open("w", newline="", encoding="utf-8") as file:
            table = csv.writer(file, lineterminator="\n")
            table.writerow([*("theta", "lam", "nu")[:inputs], *(["branch"] if branches else []), "w", "load", "area"])
            table.writerows(rows(inputs, branches, *law))
