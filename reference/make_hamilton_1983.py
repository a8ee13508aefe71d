"""Stresses below a pressed and a sheared Hertz contact, summed from point loads: 25 digits. Takes 90 s.

No formula of Hamilton's: Boussinesq's and Cerruti's point loads summed over the contact, 64 Gauss radii by 200 angles, as in
Johnson, Contact Mechanics (1985), sections 3.2 and 3.6. Over p0 = q0 and a; pressure and traction (in the direction +x)
sqrt(1 - r^2); z into the half-space, tension positive. With r = sin t the integrand is smooth in t (Gauss-Legendre) and
periodic in the angle (equal steps).

- `hamilton_1983.csv`: six stresses, `xx` to `xz`, at nine places of a contact, pressed (over p0) and dragged (over q0); lengths
  over a; nu = 0, 0.3, 0.5
"""

import csv
from pathlib import Path

import numpy as np
from mpmath import mp, mpf

mp.dps = 25
HERE = Path(__file__).parent
PLACES = (
    ("0", "0", "0.5"),
    ("0.01", "0", "0.4"),
    ("0.003", "-0.004", "0.75"),
    ("0.4", "0.3", "0.5"),
    ("-0.8", "0.2", "0.375"),
    ("-1", "0", "0.375"),
    ("0", "1", "0.5"),
    ("1.25", "-0.75", "0.5"),
    ("-2", "3", "1.5"),
)
NUS = ("0", "0.3", "0.5")
RADII, ANGLES = 64, 200


def normal(x, y, z, nu):
    R = mp.sqrt(x * x + y * y + z * z)
    c, d = 1 - 2 * nu, (2 * R + z) / (R**3 * (R + z) ** 2)
    ring = z / R**3 - 1 / (R * (R + z))
    return (
        -3 * x * x * z / R**5 + c * (ring + x * x * d),
        -3 * y * y * z / R**5 + c * (ring + y * y * d),
        -3 * z**3 / R**5,
        -3 * x * y * z / R**5 + c * x * y * d,
        -3 * y * z * z / R**5,
        -3 * x * z * z / R**5,
    )


def tangential(x, y, z, nu):
    R = mp.sqrt(x * x + y * y + z * z)
    c, d = 1 - 2 * nu, 1 / (R**3 * (R + z) ** 2) + 2 / (R**2 * (R + z) ** 3)
    e = 1 / (R * (R + z) ** 2)
    return (
        -3 * x**3 / R**5 + c * (x / R**3 - 3 * x * e + x**3 * d),
        -3 * x * y * y / R**5 + c * (x / R**3 - x * e + x * y * y * d),
        -3 * x * z * z / R**5,
        -3 * x * x * y / R**5 + c * (-y * e + x * x * y * d),
        -3 * x * y * z / R**5,
        -3 * x * x * z / R**5,
    )


def gauss(count):
    """Nodes and weights on (0, pi/2), polished from doubles."""
    for start in np.polynomial.legendre.leggauss(count)[0]:
        node = mpf(float(start))
        for _ in range(2):
            value, before = mp.legendre(count, node), mp.legendre(count - 1, node)
            slope = count * (node * value - before) / (node * node - 1)
            node -= value / slope
        yield (node + 1) * mp.pi / 4, mp.pi / 4 * 2 / ((1 - node * node) * slope * slope)


def main():
    circle = [(mp.cospi(mpf(2 * i) / ANGLES), mp.sinpi(mpf(2 * i) / ANGLES)) for i in range(ANGLES)]
    # sqrt(1 - r^2) r dr = cos(t)^2 sin(t) dt, over the 2 pi of the point loads.
    radii = [(mp.sin(t), weight * mp.cos(t) ** 2 * mp.sin(t) / ANGLES) for t, weight in gauss(RADII)]
    with (HERE / "hamilton_1983.csv").open("w", newline="", encoding="utf-8") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["part", "nu", "x", "y", "z", "xx", "yy", "zz", "xy", "yz", "xz"])
        for part, point in (("pressed", normal), ("dragged", tangential)):
            for nu in NUS:
                for place in PLACES:
                    x, y, z = (mpf(float(one)) for one in place)
                    total = [mpf(0)] * 6
                    for r, weight in radii:
                        for cos, sin in circle:
                            for at, one in enumerate(point(x - r * cos, y - r * sin, z, mpf(float(nu)))):
                                total[at] += weight * one
                    shown = [mp.nstr(one, 16) if abs(one) > mpf("1e-16") else "0" for one in total]
                    out.writerow([part, nu, *place, *shown])


if __name__ == "__main__":
    main()
