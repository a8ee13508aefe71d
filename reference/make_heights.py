"""Sums over heights in closed form: mpmath, 30 digits; checked against quadrature. Takes seconds.

F_n(h) = Int_h^inf (z - h)^n f(z) dz for standardised heights (mean 0, standard deviation 1): Gaussian, exponential (density
exp(-(z+1)), z >= -1), Weibull (shape 2, and the double nearest 3.4).

- `greenwood_williamson_1966.csv`: `F_n` at `heights`, `shape`, `n`, `h`
- `rough_dmt.csv`: Int_0^inf (w^(3/2) - 2 pi/theta) phi(h+w) dw, `load`, and `area`, `touching_asperities`
"""

import csv
from pathlib import Path

from mpmath import mp, mpf

mp.dps = 30
HERE = Path(__file__).parent
ORDERS = ("0", "0.5", "1", "1.5", "2", "2.5")
SEPARATIONS = tuple(str(i / 2) for i in range(-8, 13))
DMT = [
    ("-2", "1"),
    ("-2", "100"),
    ("0", "0.1"),
    ("0", "10"),
    ("0", "40"),
    ("1", "5"),
    ("1", "1000"),
    ("3", "2"),
    ("3", "40"),
    ("5", "1e6"),
]


def gaussian(n, h):
    """Parabolic cylinder function: F_n = n! exp(-h^2/4) D_{-n-1}(h) / sqrt(2 pi)."""
    return mp.gamma(n + 1) * mp.exp(-h * h / 4) * mp.pcfd(-n - 1, h) / mp.sqrt(2 * mp.pi)


def exponential(n, h):
    """Density exp(-(z+1)), z >= -1: n! exp(-(h+1)); an incomplete gamma function where h < -1."""
    depth = max(-1 - h, mpf(0))
    return mp.exp(-1 - h) * mp.gammainc(n + 1, depth) if depth else mp.gamma(n + 1) * mp.exp(-1 - h)


def weibull(shape):
    """x of density shape x^(shape-1) exp(-x^shape), standardised: z = (x - mean)/deviation; by quadrature."""
    mean = mp.gamma(1 + 1 / shape)
    deviation = mp.sqrt(mp.gamma(1 + 2 / shape) - mean**2)

    def integral(n, h):
        start = mean + deviation * h

        def value(x):
            density = shape * x ** (shape - 1) * mp.exp(-(x**shape))
            return ((x - start) / deviation) ** n * density

        low = max(start, mpf(0))
        ends = [low + mpf(i) / 2 for i in range(11)]
        return mp.quad(value, [*ends, low + 10, low + 20, mp.inf])

    return integral


def check(function, density, low):
    """Closed form against quadrature, to 20 digits, at a few points."""
    for n, h in ((mpf(0), mpf(1)), (mpf("1.5"), mpf(-2)), (mpf("2.5"), mpf("0.5"))):
        start = max(h, low)
        points = [start + mpf(i) / 2 for i in range(41)]
        direct = mp.quad(lambda z, n=n, h=h: (z - h) ** n * density(z), [*points, mp.inf])
        assert abs(direct / function(n, h) - 1) < mpf(10) ** -20, (n, h)


def write(name, header, rows):
    with (HERE / name).open("w", newline="", encoding="utf-8") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(header)
        for row in rows:
            out.writerow([mp.nstr(v, 17, strip_zeros=False) if isinstance(v, mpf) else v for v in row])


def greenwood_williamson():
    for name, shape, function, orders in (
        ("gaussian", "", gaussian, ORDERS),
        ("exponential", "", exponential, ORDERS),
        ("weibull", "2", weibull(mpf(2)), ("0", "1", "1.5")),
        ("weibull", "3.4", weibull(mpf(3.4)), ("0", "1", "1.5")),
    ):
        for h in SEPARATIONS:
            for n in orders:
                yield [name, shape, n, h, function(mpf(n), mpf(h))]


def dmt():
    """A3 on a rough surface: P = Int (w^(3/2) - 2 pi/theta) phi(h + w) dw, w >= 0; area Int w phi."""
    for h, theta in DMT:
        z, adhesion = mpf(h), 2 * mp.pi / mpf(theta)
        count = gaussian(mpf(0), z)
        yield [h, theta, gaussian(mpf(3) / 2, z) - adhesion * count, gaussian(mpf(1), z), count]


if __name__ == "__main__":
    check(gaussian, lambda z: mp.exp(-z * z / 2) / mp.sqrt(2 * mp.pi), -mp.inf)
    check(exponential, lambda z: mp.exp(-z - 1), mpf(-1))
    write("greenwood_williamson_1966.csv", ["heights", "shape", "n", "h", "F_n"], greenwood_williamson())
    write("rough_dmt.csv", ["h", "theta", "load", "area", "touching_asperities"], dmt())
