"""Composites of film and substrate, and films summed over Gaussian heights: mpmath, tanh-sinh cut at every kink, 25 digits.
20 s.

Equations as the records of the models state them; loads over K R^(1/2) sigma^(3/2), areas over pi R sigma, per asperity.
Modulus or hardness of film and substrate together, over the substrate's:

- `gao_chiu_lee_1992.csv`: `value`, the modulus, at `n_E`, `thickness_over_radius`, `film_nu`, `nu`
- `bec_2006.csv`: the same
- `perriot_barthel_2004.csv`: the same
- `bhattacharya_nix_1988.csv`: `value`, the hardness, at `n_H`, `depth_over_thickness`, `n_E`, `exponent`
- `jonsson_hogmark_1984.csv`: the same
- `kao_byrne_1981.csv`: the same

Films summed at h = -1, 1, 3:

- `halling_1979.csv`: `load`, `area`; `first_yield`, the least w of a plastic asperity
- `finkin_1969.csv`: `load`, `area`; `area_beyond`, of asperities outside of the law's range
- `chang_1997.csv`: `load`, `area`, `substrate_area`; the substrate is that of Chang, Etsion and Bogy 1987
- `liu_neville_reuben_2002.csv`: the same, with the adhesion 2 pi n_g/theta of each asperity that touches
- `ogilvy_1993.csv`: `load`, `area`, `friction` over the same bare substrate, with the film's `shear_strength` over the
  substrate's hardness on the whole area
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


def double(text):
    return mpf(float(text))


def total(function, h, cuts):
    """Integral over the depth of an asperity of function(depth) times the density of heights, cut where it has kinks."""
    ends = sorted({mpf(0), *(one for one in cuts if 0 < one < 30), *(mpf(n) / 2 for n in range(1, 25)), mpf(30)})
    density = lambda w: mp.exp(-((h + w) ** 2) / 2) / mp.sqrt(2 * mp.pi)  # noqa: E731
    return mp.fsum(mp.quad(lambda w: function(w) * density(w), piece) for piece in pairwise(ends))


def hardness_group(theta, lam):
    """pi H sqrt(R/sigma)/K."""
    return mp.sqrt(mp.pi) * (18 * lam) ** mpf("0.25") / mp.sqrt(theta)


# Moduli: film over substrate n, thickness over radius xi, Poisson's ratios of film and substrate.


def gao(n, xi, film, substrate):
    phi_1 = 2 / mp.pi * mp.atan(xi) + xi / mp.pi * mp.log((1 + xi**2) / xi**2)
    nu = 1 - (1 - substrate) * (1 - film) / (1 - (1 - phi_1) * film - phi_1 * substrate)
    inner = (1 - 2 * nu) * xi * mp.log((1 + xi**2) / xi**2) - xi / (1 + xi**2)
    return 1 + (n - 1) * (2 / mp.pi * mp.atan(xi) + inner / (2 * mp.pi * (1 - nu)))


def bec(n, xi, film, substrate):
    return 1 / (2 * xi / (mp.pi + 2 * xi) / n + mp.pi / (mp.pi + 2 * xi))


def perriot(n, xi, film, substrate):
    log = mp.log10(1 / n)
    k0 = mpf(10) ** (mpf("-0.093") + mpf("0.792") * log + mpf("0.05") * log**2)
    return n + (1 - n) / (1 + (k0 * xi) ** mpf("1.27"))


MODULI = {"gao_chiu_lee_1992": gao, "bec_2006": bec, "perriot_barthel_2004": perriot}


# Hardnesses: film over substrate n, depth over thickness v, moduli n_E, exponent m; yield stresses as the hardnesses.


def bhattacharya(n, v, n_E, m):
    c = n / n_E if n < 1 else 1 / mp.sqrt(n_E)
    return 1 + (n - 1) * mp.exp(-c * v**m)


def jonsson(n, v, n_E, m):
    C = mpf(1) if n < mpf("6.3") else mpf("0.5")
    ratio = C / (7 * v)
    return n if ratio >= 1 else 1 + (n - 1) * (2 * ratio - ratio**2)


def kao(n, v, n_E, m):
    return n if v <= mpf("0.18") else 1 + (n - 1) * mpf("0.18") / v


HARDNESSES = {"bhattacharya_nix_1988": bhattacharya, "jonsson_hogmark_1984": jonsson, "kao_byrne_1981": kao}


def composites():
    for key, modulus in MODULI.items():
        ratios, widths, bodies = ("0.1", "0.5", "3"), ("0.03", "0.3", "1", "4", "50"), (("0.3", "0.3"), ("0.45", "0.2"))
        rows = [
            {"n_E": n, "thickness_over_radius": xi, "film_nu": film, "nu": nu}
            for n, xi, (film, nu) in product(ratios, widths, bodies)
        ]
        write(f"{key}.csv", [row | {"value": modulus(*(double(cell) for cell in row.values()))} for row in rows])
    for key, hardness in HARDNESSES.items():
        rows = [
            {"n_H": n, "depth_over_thickness": v, "n_E": n_E, "exponent": m}
            for n, v, n_E, m in product(("0.2", "0.5", "4", "8"), ("0.05", "0.16", "0.5", "2", "9"), ("0.5", "2.5"), ("1", "2"))
        ]
        write(f"{key}.csv", [row | {"value": hardness(*(double(cell) for cell in row.values()))} for row in rows])


def halling():
    """Elastic to the first depth at which the mean pressure is the hardness, then P = H (2 w - w_c)."""
    rows = []
    film = {"nu": "0.3", "film_nu": "0.4"}
    cases = (("gao_chiu_lee_1992", "bhattacharya_nix_1988", "2"), ("bec_2006", "jonsson_hogmark_1984", "2"),
             ("perriot_barthel_2004", "kao_byrne_1981", "2"), ("gao_chiu_lee_1992", "bhattacharya_nix_1988", "1"))  # fmt: skip
    groups = (
        ("100", "1", "0.5", "0.3", "0.5", "0.1"),
        ("1000", "3e6", "0.3", "0.2", "1.5", "2"),
        ("50", "20", "2", "3", "1", "1"),
    )
    for (modulus, hardness, soft), (theta, lam, n_E, n_H, tau, aspect) in product(cases, groups):
        given = {"theta": theta, "lam": lam, "n_E": n_E, "n_H": n_H, "tau": tau, "film_aspect": aspect, **film}
        g = {key: double(cell) for key, cell in given.items()}
        eta, m = hardness_group(g["theta"], g["lam"]), int(soft) if g["n_H"] < 1 else 3 - int(soft)
        stiff = lambda w: MODULI[modulus](g["n_E"], g["film_aspect"] / mp.sqrt(w), g["film_nu"], g["nu"]) * mp.sqrt(w)  # noqa: E731, B023
        hard = lambda w: eta * HARDNESSES[hardness](g["n_H"], w / g["tau"], g["n_E"], m)  # noqa: E731, B023
        low = eta**2 * mpf("1e-8")
        while stiff(low) < hard(low):
            low *= mpf("1.02")
        w_c = mp.findroot(lambda w: stiff(w) - hard(w), (low / mpf("1.02"), low), solver="anderson", tol=1e-40)  # noqa: B023
        of_film = (g["tau"] * mpf(part) for part in (mpf(1) / 7, "0.18", "0.25", "1", "3"))
        kinks = (w_c, w_c / 50, g["film_aspect"] ** 2, *of_film)
        for separation in SEPARATIONS:
            h = double(separation)
            load = total(lambda w: stiff(w) * w if w < w_c else hard(w) * (2 * w - w_c), h, kinks)  # noqa: B023
            area = total(lambda w: w if w < w_c else 2 * w - w_c, h, kinks)  # noqa: B023
            rows.append({"modulus": modulus, "hardness": hardness, "soft_film_exponent": soft, **given, "h": separation,
                         "first_yield": w_c, "load": load, "area": area})  # fmt: skip
    write("halling_1979.csv", rows)


def finkin():
    rows = []
    for (bound, k), (n_E, nu, aspect), separation in product(
        (("compressible", 0), ("incompressible", 12), ("incompressible_frictionless", 3)),
        (("0.01", "0.3", "0.2"), ("0.001", "0.45", "1.5")), SEPARATIONS,
    ):  # fmt: skip
        n, v, t, h = (double(cell) for cell in (n_E, nu, aspect, separation))
        # K = 1, R sigma = 1: E' of the film is (3/4) n; with E = E' (1 - nu^2)
        E = mpf(3) / 4 * n * (1 - v**2)
        G, M = E / (2 * (1 + v)), E * (1 - v) / ((1 + v) * (1 - 2 * v))
        load = (lambda w: mp.pi * M * w**2 / t) if k == 0 else (lambda w: mp.pi * k * G * (4 * w) ** 3 / (96 * t**3))  # noqa: B023
        wide = 2 if k == 0 else 4
        rows.append({"bound": bound, "n_E": n_E, "film_nu": nu, "film_aspect": aspect, "h": separation,
                     "load": total(load, h, ()), "area": total(lambda w: wide * w, h, ()),  # noqa: B023
                     "area_beyond": total(lambda w: wide * w if wide * w > t**2 else 0, h, (t**2 / wide,))})  # noqa: B023  # fmt: skip
    write("finkin_1969.csv", rows)


def plastic_films():
    """A plastic film over the substrate of Chang, Etsion & Bogy 1987; the adhesion is 2 pi n_g/theta for each that touches."""
    for key, adhesive in (("chang_1997", False), ("liu_neville_reuben_2002", True)):
        rows = []
        groups = (
            ("100", "10", "0.3", "0.4", "1.5", "0.7"),
            ("30", "1e5", "0.2", "0.2", "0.3", "1"),
            ("2000", "1e6", "0.45", "0.8", "4", "2"),
        )
        for (theta, lam, nu, n_H, tau, n_g), separation in product(groups, SEPARATIONS):
            given = {"theta": theta, "lam": lam, "nu": nu, "n_H": n_H, "tau": tau, "n_g": n_g, "h": separation}
            g = {name: double(cell) for name, cell in given.items()}
            eta, K_H = hardness_group(g["theta"], g["lam"]), mpf("0.454") + mpf("0.41") * g["nu"]
            w_c, t = (mpf(2) / 3 * K_H * eta) ** 2, g["tau"]
            pull = 2 * mp.pi * g["n_g"] / g["theta"] if adhesive else 0

            def substrate(w):
                area = w if w < w_c else 2 * w - w_c  # noqa: B023
                return (w ** mpf("1.5"), area) if w < w_c else (K_H * eta * area, area)  # noqa: B023

            def load(w):
                under, inner = substrate(w - t) if w > t else (0, 0)  # noqa: B023
                return under + eta * g["n_H"] * (2 * w - inner) - pull  # noqa: B023

            cuts = (t, t + w_c / 100, t + w_c / 10, t + w_c)
            h = g["h"]
            rows.append(given | {"load": total(load, h, cuts), "area": total(lambda w: 2 * w, h, ()),
                                 "substrate_area": total(lambda w: substrate(w - t)[1] if w > t else 0, h, cuts)})  # noqa: B023  # fmt: skip
        write(f"{key}.csv", rows)


def ogilvy():
    """The bare substrate of Chang, Etsion & Bogy 1987; the film's shear strength on all of its area."""
    rows = []
    for (theta, lam, nu, strength), separation in product(
        (("100", "10", "0.3", "0.05"), ("30", "1e5", "0.2", "0.3"), ("2000", "1e6", "0.45", "0.01")), SEPARATIONS
    ):
        h, eta = double(separation), hardness_group(double(theta), double(lam))
        K_H = mpf("0.454") + mpf("0.41") * double(nu)
        w_c = (mpf(2) / 3 * K_H * eta) ** 2
        load = total(lambda w: w ** mpf("1.5") if w < w_c else K_H * eta * (2 * w - w_c), h, (w_c / 100, w_c))  # noqa: B023
        area = total(lambda w: w if w < w_c else 2 * w - w_c, h, (w_c,))  # noqa: B023
        rows.append({"theta": theta, "lam": lam, "nu": nu, "shear_strength": strength, "h": separation,
                     "load": load, "area": area, "friction": double(strength) * eta * area})  # fmt: skip
    write("ogilvy_1993.csv", rows)


if __name__ == "__main__":
    ogilvy()
    composites()
    finkin()
    plastic_films()
    halling()
