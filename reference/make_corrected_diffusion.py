"""Persson's theory with a corrected diffusion, and the area of a surface with weak attraction. Takes 5 s.

- `yang_persson_2008.csv`: `area` over the nominal at `pressure` over E* h', from the differential equation for the variance,
  stepped from full contact by an integrator of order 8 to 1e-13; nothing is turned into an integral over q
- `wang_muser_2017.csv`: the same
- `xu_zhu_xiao_zhou_2024.csv`: the same, its equation by bisection in 30 digits
- `pastewka_robbins_2014_area.csv`: load per nominal area of `area_fraction`, from the pressures in the spots and on their rims
  in SI units: `reduced_pressure` is it over E* h'
- `persson_tosatti_2001.csv`: `ratio` of the elastic energy of flattening the roughness, at most, to the work of adhesion, from
  moments in SI units
- `effective_adhesion.csv` of `persson_tosatti_2001` (criterion): `ratio` of that energy to what adhesion gains on the area of
  the rough face, and the effective work of adhesion over the work of adhesion, `effective`
"""

import csv
import math
from pathlib import Path

from mpmath import mp, mpf
from scipy.integrate import solve_ivp
from scipy.special import erf

mp.dps = 30
HERE = Path(__file__).parent
PRESSURES = (0.001, 0.01, 0.05, 0.1, 0.2, 0.3, 0.5, 1.0, 2.0)


def write(name, header, rows):
    with (HERE / f"{name}.csv").open("w", newline="", encoding="utf-8") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(header)
        out.writerows([mp.nstr(v, 16) if isinstance(v, mpf) else repr(float(v)) for v in row] for row in rows)


def yang_persson(A):
    return 0.45 + 0.55 * A * A


def wang_muser(A):
    return 5 / 9 - 2 / 9 * A**2 + (11 / 9 - 5 / 9) * A**4


def stepped(factor):
    """dV/dV_c = factor(A), A = erf(p/sqrt(2 V)), in units of p^2; contact is full to 1e-16 up to V = 0.01."""
    for p in PRESSURES:
        end = 0.25 / p**2
        start = min(0.01, end)
        found = solve_ivp(
            lambda t, V: [factor(erf(1 / math.sqrt(2 * V[0])))], (start, end), [start], method="DOP853", rtol=1e-13, atol=1e-15
        )
        yield [p, erf(1 / math.sqrt(2 * found.y[0, -1]))]


def xu():
    """A = erf(p / sqrt(2 (g + (1 - g) A) V_c)), V_c = 1/4."""
    g = mpf("0.45")
    for p in PRESSURES:
        low, high = mpf(0), mpf(1)
        for _ in range(100):
            A = (low + high) / 2
            low, high = (A, high) if mp.erf(mpf(p) / mp.sqrt(2 * (g + (1 - g) * A) / 4)) > A else (low, A)
        yield [p, low]


def attracted():
    """sigma, R, N, E*, w, range in SI units, none of which sticks.

    Spots as wide as 4 h'/h'' on average have the rims on which eq. (10) has the two pressures cancel, as wide for any load:
    the share of the rims' area is that which makes them cancel there, and the stress on them is w / range.
    """
    for sigma, R, N, E, w, reach in (
        (48e-9, 50e-6, 1.7e10, 115e9, 1.0, 0.3e-9),
        (20e-9, 5e-6, 4e11, 2e9, 0.05, 0.4e-9),
        (20e-9, 5e-6, 4e11, 2e9, 1e-9, 0.4e-9),
    ):
        m4 = 9 * math.pi / (64 * R * R)
        m2 = m4 / (6 * math.pi * math.sqrt(3) * N)
        slope, curvature = math.sqrt(2 * m2), math.sqrt(2 * m4 / 3)
        rims = (curvature * reach / slope**2) ** (2 / 3)  # area of the rims over that of the spots
        area = 0.03
        pressure = area * (slope * E / 2 - rims * w / reach)
        theta = 4 / 3 * E * sigma**1.5 / (w * math.sqrt(R))
        yield [theta, N * R * sigma, (R * w * w / (E * E * reach**3)) ** (1 / 3), area, pressure / (E * slope)]


def flattened():
    """sigma, R, N, E*, w in SI units: the elastic energy of flattening the roughness, at most, over the work of adhesion.

    Yields theta, N R sigma, this ratio, sqrt(sigma/R) and the rms gradient.
    """
    deficit = 1 + 16 / math.pi - 3 * math.sqrt(3)
    for sigma, R, N, E, w in (
        (5e-9, 10e-6, 1e12, 2.6e6, 0.05),
        (50e-9, 2e-6, 5e11, 2.6e6, 0.09),
        (48e-9, 50e-6, 1.7e10, 115e9, 1.0),
    ):
        m4 = 9 * math.pi / (64 * R * R)
        m2 = m4 / (6 * math.pi * math.sqrt(3) * N)
        m0 = sigma**2 + deficit * m2 * m2 / m4
        theta, slope = 4 / 3 * E * sigma**1.5 / (w * math.sqrt(R)), math.sqrt(2 * m2)
        yield [theta, N * R * sigma, E * math.sqrt(m0) * slope / 4 / w, math.sqrt(sigma / R), slope]


def effective():
    """The surfaces of `flattened`: adhesion gains w per area of the rough face, 1 + slope^2/2 of the nominal area."""
    for theta, density, ratio, sharpness, slope in flattened():
        gain = 1 + slope**2 / 2
        yield [theta, density, sharpness, ratio / gain, gain - ratio]


if __name__ == "__main__":
    write("yang_persson_2008", ["pressure", "area"], stepped(yang_persson))
    write("wang_muser_2017", ["pressure", "area"], stepped(wang_muser))
    write("xu_zhu_xiao_zhou_2024", ["pressure", "area"], xu())
    header = ["theta", "roughness_parameter", "tabor_parameter", "area_fraction", "reduced_pressure"]
    write("pastewka_robbins_2014_area", header, attracted())
    write("persson_tosatti_2001", ["theta", "roughness_parameter", "ratio"], [row[:3] for row in flattened()])
    write("effective_adhesion", ["theta", "roughness_parameter", "sharpness", "ratio", "effective"], effective())
