"""Single asperities under tangential force, one table a law, from dimensional inputs: mpmath, 30 digits. Takes 20 s.

Two equal spheres or a sphere on a rigid flat are reduced here to their radius R, moduli and so on, in SI units; four pairs of
bodies from soft to hard. The groups of the package (theta, lambda, ...) are written beside the forces, which are over
K R^(1/2) sigma^(3/2): `friction`, the tangential force at which one asperity gives way. Savkoor and Briggs: bisection for the
largest T at which the least G_N + zeta G_T over all contact radii is gamma at most. Chang, Etsion and Bogy: bisection on the
von Mises stress at the two places, with the two constants that the authors round. The others from their own formulas.

- `savkoor_briggs_1977.csv`: `friction` at `load`
- `thornton_1991.csv`: the same
- `waters_guduru_2010.csv`: the same
- `chang_etsion_bogy_1988.csv` of `chang_etsion_bogy_1988` (tangential law): `friction` at `w`, of Hertz's asperity
- `kogut_etsion_2003.csv`: `friction` at `w`, `load`
- `brizmer_kligerman_etsion_2007.csv`: `friction` at `load`
- `bowden_tabor_1943.csv`: `friction` at `area`, `load`
- `briscoe_tabor_1978.csv`: the same
- `hurtado_kim_1999.csv`: the same; the strength from a straight line through two points in decades
- `tabor_1959.csv`: the same; the shear force is raised, by bisection, until the interface of the area that has grown gives way
- `junction_growth.csv`: the same, growth ending at the force of full stick
- `mindlin_1949.csv`: the same bodies before they slide: `stiffness`, `displacement` under `force`
"""

import csv
from pathlib import Path

from mpmath import mp, mpf

mp.dps = 30
HERE = Path(__file__).parent
# E, nu, R, sigma, gamma, H, H/Y of a pair of like bodies; soft to hard, smooth to rough.
BODIES = (
    ("210e9", "0.3", "50e-6", "48e-9", "1.0", "7e9", "2.8"),
    ("82e9", "0.37", "200e-6", "10e-9", "2.5", "0.25e9", "3"),
    ("70e9", "0.2", "5e-6", "100e-9", "0.1", "8e9", "2"),
    ("2e6", "0.49", "1e-3", "1e-6", "0.05", "1e6", "3.5"),
)


class Pair:
    """A pair of like bodies, and the scales of its groups."""

    def __init__(self, row):
        self.E, self.nu, self.R, self.sigma, self.gamma, self.H, self.k = map(mpf, row)
        self.E_star = self.E / (2 * (1 - self.nu**2))
        self.K = 4 * self.E_star / 3
        self.beta = 2 * (2 - self.nu) * 2 * (1 + self.nu) / self.E
        self.force = self.K * mp.sqrt(self.R) * self.sigma ** mpf("1.5")
        self.pull_off = 3 * mp.pi * self.gamma * self.R / 2
        self.theta = self.K * self.sigma ** mpf("1.5") / (self.gamma * mp.sqrt(self.R))
        self.lam = mp.pi**2 * self.R * self.H**4 * self.sigma / (18 * self.K**2 * self.gamma**2)
        self.groups = [self.theta, self.lam, self.nu, self.k, self.K * self.beta]

    def hertz(self, omega):
        return self.K * mp.sqrt(self.R) * omega ** mpf("1.5")

    @property
    def omega_c(self):
        """(pi K_H H/(2 E*))^2 R, K_H = 0.454 + 0.41 nu."""
        return (mp.pi * (mpf("0.454") + mpf("0.41") * self.nu) * self.H / (2 * self.E_star)) ** 2 * self.R


def peeling():
    """Bisection for the largest T at which G_N + zeta G_T = gamma still has a contact radius: not the closed form."""
    for pair in map(Pair, BODIES):
        for ratio in ("-0.9", "-0.5", "0", "2", "10"):
            for zeta in (mpf(1), mpf("0.25")):
                P = mpf(ratio) * pair.pull_off

                def release(a, T, pair=pair, P=P, zeta=zeta):
                    cube = pair.K * a**3
                    return (cube / pair.R - P) ** 2 / (6 * mp.pi * cube) + zeta * pair.beta * T**2 / (32 * mp.pi * a**3)

                def steady(T, pair=pair, release=release):
                    """The least release over all radii, at most gamma while there is a contact in balance."""
                    low, high = (mpf("1e-6") * pair.R, 100 * pair.R)
                    golden = (mp.sqrt(5) - 1) / 2
                    for _ in range(90):
                        left, right = high - golden * (high - low), low + golden * (high - low)
                        if release(left, T) < release(right, T):
                            high = right
                        else:
                            low = left
                    return release((low + high) / 2, T) <= pair.gamma

                low, high = mpf(0), 1000 * pair.pull_off
                for _ in range(70):
                    middle = (low + high) / 2
                    low, high = (middle, high) if steady(middle) else (low, middle)
                yield [*pair.groups, zeta, P / pair.force, low / pair.force]


def mixed_mode():
    """At every radius from Hertz's to that at rest: the phase angle at which G_N is its share of the toughness, by bisection,
    and with it G_T and the force; the largest over the radii by golden section, after a search on a grid."""
    for pair in map(Pair, BODIES):
        for ratio in ("-0.5", "0", "2", "10"):
            for zeta in (mpf(1), mpf("0.5"), mpf("0.1")):
                P = mpf(ratio) * pair.pull_off

                def force(a, pair=pair, P=P, zeta=zeta):
                    cube = pair.K * a**3
                    opening = (cube / pair.R - P) ** 2 / (6 * mp.pi * cube)
                    low, high = mpf(0), mp.pi / 2
                    for _ in range(70):  # G_N is all of the toughness without shear, and nothing of it at a right angle
                        psi = (low + high) / 2
                        share = mp.cos(psi) ** 2 * (1 + mp.tan((1 - zeta) * psi) ** 2)
                        low, high = (psi, high) if share * pair.gamma > opening else (low, psi)
                    toughness = pair.gamma * (1 + mp.tan((1 - zeta) * low) ** 2)
                    return mp.sqrt(max(toughness - opening, 0) * 32 * mp.pi * a**3 / pair.beta)

                root = mp.sqrt(6 * mp.pi * pair.gamma * pair.K)
                largest = ((root + mp.sqrt(root**2 + 4 * pair.K / pair.R * P)) / (2 * pair.K / pair.R)) ** (mpf(2) / 3)
                least = (P * pair.R / pair.K) ** (mpf(1) / 3) if P > 0 else largest * mpf("0.2")
                yield [*pair.groups, zeta, P / pair.force, _largest(force, least, largest) / pair.force]


def _largest(value, low, high):
    places = [low + (high - low) * step / 40 for step in range(41)]
    at = max(range(41), key=lambda step: value(places[step]))
    low, high = places[max(at - 1, 0)], places[min(at + 1, 40)]
    golden = (mp.sqrt(5) - 1) / 2
    for _ in range(60):
        left, right = high - golden * (high - low), low + golden * (high - low)
        if value(left) > value(right):
            high = right
        else:
            low = left
    return max(value(low), value(high))


def thornton():
    for pair in map(Pair, BODIES):
        for ratio in ("-0.9", "-0.5", "0", "2", "10"):
            P, G_star = mpf(ratio) * pair.pull_off, 1 / pair.beta
            T = 4 * mp.sqrt((P * pair.pull_off + pair.pull_off**2) * G_star / pair.E_star)
            yield [*pair.groups, P / pair.force, T / pair.force]


def mises(pair, p0, q0, x_side):
    """Von Mises stress over the yield stress on the axis at the depth 0.48 a, or at the trailing edge. Y is 0.354 H, but the
    authors round it: in shear to 0.2045 H on the axis, and 4.5 Y^2 to 0.56 H^2 at the edge."""
    nu = pair.nu
    if x_side:
        sx = (1 - 2 * nu) / 3 * p0 + mp.pi / 8 * (4 + nu) * q0
        sy = -(1 - 2 * nu) / 3 * p0 + 3 * mp.pi / 8 * nu * q0
        return mp.sqrt(sx**2 - sx * sy + sy**2) / (mp.sqrt(mpf("0.56") / mpf("4.5")) * pair.H)
    z = mpf("0.48")
    shear = -1 + mpf(3) / 2 * z * mp.atan(1 / z) - z**2 / (2 * (1 + z**2))
    K_H = mpf("0.454") + mpf("0.41") * nu
    return mp.sqrt((p0 / (K_H * pair.H)) ** 2 + (shear * q0 / (mpf("0.2045") * pair.H)) ** 2)


def first_yield():
    """Bisection for the least mu at which one of the two places yields."""
    for pair in map(Pair, BODIES):
        for ratio in ("0.001", "0.1", "0.5", "0.9", "0.94", "0.97", "0.999"):
            omega = mpf(ratio) * pair.omega_c
            p0 = 2 * pair.E_star / mp.pi * mp.sqrt(omega / pair.R)
            lowest = []
            for x_side in (False, True):
                low, high = mpf(0), mpf(1000)
                for _ in range(90):
                    middle = (low + high) / 2
                    low, high = (middle, high) if mises(pair, p0, middle * p0, x_side) < 1 else (low, middle)
                lowest.append(low)
            yield [*pair.groups, omega / pair.sigma, min(lowest) * pair.hertz(omega) / pair.force]


def kogut_etsion():
    for pair in map(Pair, BODIES):
        P_c = pair.hertz(pair.omega_c)
        for ratio in ("0.0001", "0.1", "0.9999", "1.0001", "2", "4", "5.9999", "6.0001", "50"):
            w = mpf(ratio)
            P = w ** mpf("1.5") if w <= 1 else mpf("1.03") * w ** mpf("1.425") if w < 6 else mpf("1.4") * w ** mpf("1.263")
            mu = mpf("-0.007") * w**3 + mpf("0.085") * w**2 - mpf("0.389") * w + mpf("0.822")
            Q = mpf("0.52") * w ** mpf("0.982") if w <= 1 else mu * P if w < 6 else mpf(0)
            yield [*pair.groups, w * pair.omega_c / pair.sigma, P * P_c / pair.force, Q * P_c / pair.force]


def full_stick():
    for pair in map(Pair, BODIES):
        nu, Y = pair.nu, pair.H / pair.k
        slip_limited = (mp.pi * (mpf("1.234") + mpf("1.256") * nu) * Y / (2 * pair.E_star)) ** 2 * pair.R
        L_c = pair.hertz(slip_limited) * (mpf("8.88") * nu - mpf("10.13") * (nu**2 + mpf("0.089")))
        for ratio in ("1e-6", "0.1", "1", "5", "100", "1e5"):
            P = mpf(ratio) * L_c
            yield [
                *pair.groups,
                P / pair.force,
                P * mpf("0.27") * mp.coth(mpf("0.27") * mpf(ratio) ** mpf("0.35")) / pair.force,
            ]


def interface(alphas):
    for pair in map(Pair, BODIES):
        for share in ("0.01", "0.2"):
            for alpha in alphas:
                for radius, P in (("1e-8", "1e-9"), ("3e-6", "-1e-5"), ("2e-7", "1e-3")):
                    tau, area, load = mpf(share) * pair.H, mp.pi * mpf(radius) ** 2, mpf(P)
                    T = tau * area + (mpf(alpha) * max(load, mpf(0)) if alpha else 0)
                    contact = [area / (mp.pi * pair.R * pair.sigma), load / pair.force, T / pair.force]
                    yield [*pair.groups, mpf(share), *([mpf(alpha)] if alpha else []), *contact]


def dislocations():
    """log10(tau/G) on the straight line through (log10 28, log10 1/43) and (log10 8e4, log10 1/1290), constant outside."""
    ends = [(mp.log10(28), -mp.log10(43)), (mp.log10(80000), -mp.log10(1290))]
    slope = (ends[1][1] - ends[0][1]) / (ends[1][0] - ends[0][0])
    for pair in map(Pair, BODIES):
        G = pair.E / (2 * (1 + pair.nu))
        for burgers in ("0.25e-9", "0.4e-9"):
            for radius, P in (("3e-9", "1e-9"), ("7e-9", "1e-9"), ("2e-7", "-1e-6"), ("1.9e-5", "1e-3"), ("1e-4", "1e-3")):
                a, b = mpf(radius), mpf(burgers)
                place = min(max(mp.log10(a / b), ends[0][0]), ends[1][0])
                T = G * mpf(10) ** (ends[0][1] + slope * (place - ends[0][0])) * mp.pi * a**2
                size = mp.sqrt(pair.R * pair.sigma)
                contact = [a**2 / size**2, mpf(P) / pair.force, T / pair.force]
                yield [*pair.groups, mp.sqrt(pair.sigma / pair.R), size / b, *contact]


def gives_way(strength, area_under, most):
    """Bisection for the shear force T that an interface of this strength bears on the area that T makes, `most` at the most."""
    low, high = mpf(0), most
    for _ in range(110):
        middle = (low + high) / 2
        low, high = (middle, high) if strength * area_under(middle) > middle else (low, middle)
    return low


def growth():
    """p^2 + alpha tau^2 = H^2 of a plastic junction, alpha of a bulk that shears at Y/sqrt(3); pressures above H count as H."""
    for pair in map(Pair, BODIES):
        alpha, A_0 = 3 * pair.k**2, mp.pi * mpf("2e-7") ** 2
        for share in ("0.05", "0.6", "0.97"):
            strength = mpf(share) * pair.H / mp.sqrt(alpha)
            for pressure in ("-0.1", "0.2", "0.7", "0.99", "1", "1.3"):
                P = mpf(pressure) * pair.H * A_0
                bears = min(P, pair.H * A_0)

                def area(T, A_0=A_0, pair=pair, bears=bears, alpha=alpha):
                    plastic = mp.sqrt(bears**2 + alpha * T**2) / pair.H
                    return plastic if bears > 0 and plastic > A_0 else A_0

                T = gives_way(strength, area, 100 * pair.H * A_0)
                contact = [A_0 / (mp.pi * pair.R * pair.sigma), P / pair.force, T / pair.force]
                yield [*pair.groups, strength / pair.H, *contact]


def growth_to_full_stick():
    """A^2 = A_0^2 + (A_s^2 - A_0^2) T^2/T_s^2, A_s the area on which T_s shears the bulk."""
    for row in full_stick():
        *groups, load, stick = row
        pair = next(one for one in map(Pair, BODIES) if one.groups == groups)
        A_0 = (load * pair.force / pair.K * pair.R) ** (mpf(2) / 3) * mp.pi  # Hertz's
        T_s, bulk = stick * pair.force, pair.H / (mp.sqrt(3) * pair.k)
        for share in ("0.001", "0.4", "0.95", "1", "1.7"):
            strength = mpf(share) * bulk
            A_s = T_s / bulk

            def area(T, A_0=A_0, A_s=A_s, T_s=T_s):
                return mp.sqrt(A_0**2 + (A_s**2 - A_0**2) * (T / T_s) ** 2)

            T = gives_way(strength, area, T_s)
            yield [*groups, strength / pair.H, A_0 / (mp.pi * pair.R * pair.sigma), load, T / pair.force]


def presliding():
    for pair in map(Pair, BODIES):
        for omega, mu in (("1e-9", "0.3"), ("2e-8", "1.2")):
            a, P = mp.sqrt(pair.R * mpf(omega)), pair.hertz(mpf(omega))
            for share in ("0.1", "0.7", "1"):
                moved = 3 * mpf(mu) * P * pair.beta / (16 * a) * (1 - (1 - mpf(share)) ** (mpf(2) / 3))
                k_t = 8 * a / pair.beta
                contact = [a**2 / (pair.R * pair.sigma), P / pair.force, mpf(mu), mpf(share) * mpf(mu) * P / pair.force]
                yield [pair.nu, pair.K * pair.beta, *contact, k_t * pair.sigma / pair.force, moved / pair.sigma]


GROUPS = ["theta", "lambda", "nu", "H_over_Y", "K_beta"]
TABLES = {
    "savkoor_briggs_1977": ([*GROUPS, "peeling", "load", "friction"], peeling),
    "thornton_1991": ([*GROUPS, "load", "friction"], thornton),
    "waters_guduru_2010": ([*GROUPS, "peeling", "load", "friction"], mixed_mode),
    "chang_etsion_bogy_1988": ([*GROUPS, "w", "friction"], first_yield),
    "kogut_etsion_2003": ([*GROUPS, "w", "load", "friction"], kogut_etsion),
    "brizmer_kligerman_etsion_2007": ([*GROUPS, "load", "friction"], full_stick),
    "bowden_tabor_1943": ([*GROUPS, "shear_strength", "area", "load", "friction"], lambda: interface([""])),
    "briscoe_tabor_1978": (
        [*GROUPS, "shear_strength", "pressure_coefficient", "area", "load", "friction"],
        lambda: interface(["0.05", "0.5"]),
    ),
    "hurtado_kim_1999": ([*GROUPS, "sharpness", "size_over_burgers", "area", "load", "friction"], dislocations),
    "tabor_1959": ([*GROUPS, "shear_strength", "area", "load", "friction"], growth),
    "junction_growth": ([*GROUPS, "shear_strength", "area", "load", "friction"], growth_to_full_stick),
    "mindlin_1949": (["nu", "K_beta", "area", "load", "mu", "force", "stiffness", "displacement"], presliding),
}

if __name__ == "__main__":
    for key, (header, rows) in TABLES.items():
        with (HERE / f"{key}.csv").open("w", newline="", encoding="utf-8") as file:
            out = csv.writer(file, lineterminator="\n")
            out.writerow(header)
            out.writerows([mp.nstr(value, 17, strip_zeros=False) for value in row] for row in rows())
