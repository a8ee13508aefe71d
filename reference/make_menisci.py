"""Pull of menisci, from the energy of the liquid and from exact menisci: mpmath, 20 digits. Takes 6 s.

Loads are over K R^(1/2) sigma^(3/2), displacements over sigma; `load_sum` is the sum over Gaussian heights at the separation
`h`. The ring around a Hertz contact: the energy 2 gamma_L c (area of contact + integral of 1 - gap/(2 r c) over the ring) by
the closed form of Hertz's gap, integrated over the ring up to the gap 2 r c and differentiated numerically by the
displacement. Exact menisci: surfaces of the total curvature 1/r between a sphere and a flat, in the angle of their tangent,
by quadrature; the filling angle is that at which they span the gap. `force` is over 4 pi R gamma_L c, `gap` over 2 r c,
`height` is 2 r c/R.

- `equilibrium_meniscus.csv`: `load` at `w`, `load_sum` at `h`
- `hertzian_meniscus.csv`: `load` at `w`
- `exact_menisci.csv` of `equilibrium_meniscus`: `force` at `height`, `gap`, `angle_first`, `angle_second`
"""

import csv
from pathlib import Path

from mpmath import mp, mpf

mp.dps = 20
HERE = Path(__file__).parent
CASES = [(mpf(index), mpf(height)) for index in ("0.3", "40") for height in ("0.02", "0.5", "3")]


def phi(z):
    return mp.exp(-z * z / 2) / mp.sqrt(2 * mp.pi)


def in_balance(share):
    """The pull over 2 pi/theta_m where the asperity touches does not change, or is that of `share` of w over the height."""

    def pull(w, height):
        return max(1 + w / height, mpf(0)) if w < 0 else share(w / height)

    return pull


def gap(m, y):
    """Hertz's gap at m contact radii over 2 r c, where the displacement is y times that."""
    root = mp.sqrt(m * m - 1)
    return y / mp.pi * (root + (m * m - 2) * mp.atan(root))


def edge(y):
    """Outer radius of the ring, in contact radii."""
    return mp.findroot(lambda m: gap(m, y) - 1, mp.sqrt(1 + 2 / y) if y < 10 else 1 + mpf("0.9") * y ** (-mpf(2) / 3))


def energy(y):
    """Over 2 gamma_L c pi R 2 r c."""
    return y + mp.quad(lambda m: (1 - gap(m, y)) * 2 * m * y, [1, edge(y)])


def of_ring(y):
    return mpf(1) if y == 0 else mp.diff(energy, y, h=mpf("1e-7") * y) / 2


def summed(pull, height, h):
    places = [-height, 0, height / 10, height, *(mpf(top) for top in (2, 5, 12) if top > height)]
    return mp.quad(lambda w: pull(w, height) * phi(h + w), places)


def rows(share, sums):
    pull = in_balance(share)
    for index, height in CASES:
        unit = -2 * mp.pi / index
        for w in (-height, -height / 2, -height / 10, mpf(0), height / 10, height, 10 * height):
            yield [index, height, w, unit * pull(w, height), "", ""]
        for h in sums:
            yield [index, height, "", "", h, unit * summed(pull, height, mpf(h))]


def exact(height, gap, first, second):
    """Force over 4 pi R gamma_L c of a sphere of radius 1."""
    c = (mp.cos(first) + mp.cos(second)) / 2
    r, D = height / (2 * c), gap * height

    def spanned(psi):
        start, rho = psi + first, mp.sin(psi)
        held = rho * mp.sin(start) + rho**2 / (2 * r)  # the same at every height: the force over 2 pi gamma_L

        def rise(angle):
            sine = mp.sin(angle)
            radius = r * (mp.sqrt(sine**2 + 2 * held / r) - sine)
            return sine / (1 / r + sine / radius)

        return mp.quad(rise, [start, mp.pi - second]) - D - (1 - mp.cos(psi)), held

    guess = mp.sqrt(2 * (height - D))
    psi = mp.findroot(lambda psi: spanned(psi)[0], (guess * mpf("0.9"), guess))
    return spanned(psi)[1] / (2 * c)


def exact_rows():
    for first, second in (("0", "0"), ("30", "60"), ("60", "0")):
        for height in ("1e-2", "1e-4", "1e-6"):
            for gap in ("0", "0.5"):
                angles = mp.radians(mpf(first)), mp.radians(mpf(second))
                yield [mpf(height), mpf(gap), *angles, exact(mpf(height), mpf(gap), *angles)]


COLUMNS = ["meniscus_index", "meniscus_height", "w", "load", "h", "load_sum"]
TABLES = {
    "equilibrium_meniscus": (COLUMNS, rows(lambda y: mpf(1), ("-1", "0.5", "2", "4"))),
    "hertzian_meniscus": (COLUMNS, rows(of_ring, ())),
    "exact_menisci": (["height", "gap", "angle_first", "angle_second", "force"], exact_rows()),
}

if __name__ == "__main__":
    for name, (columns, table) in TABLES.items():
        with (HERE / f"{name}.csv").open("w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(columns)
            writer.writerows([[mp.nstr(mpf(one), 15) if one != "" else "" for one in row] for row in table])
