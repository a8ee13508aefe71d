"""Five contacts of Thornton and Ning with dimensions, by quadrature. Takes seconds.

R_p and the residual displacement come from the printed formulas, the load after yield by quadrature of the printed stiffness
dP/d delta; the script stops unless the pressure integrated over the contact gives the same.

- `thornton_ning_1998.csv`: `load`, `area` at `w`, one asperity loaded past yield, lambda for H = the limiting pressure;
  `radius` of the yielded sphere over R; on its way back `w_back`, `load_back`, `area_back`; `pull_off`
"""

import csv
from pathlib import Path

from mpmath import mp, mpf, pi, sqrt

mp.dps = 30
HERE = Path(__file__).parent
# E* (Pa), R (m), work of adhesion (J/m^2), sigma (m), limiting pressure (Pa)
CASES = [("1e9", "1e-5", "0.1", "1e-7", "5e7"), ("1e11", "2e-6", "0.5", "5e-9", "3e9"), ("2e11", "1e-4", "1e-3", "2e-8", "1e9"),
         ("5e6", "1e-4", "0.05", "1e-6", "1e6"), ("1e9", "1e-6", "0.2", "1e-7", "2e7")]  # fmt: skip
BEYOND = ("1.02", "1.3", "2", "4")  # contact radius over that at yield, or at first touch if it has yielded before


def rows(case):
    E, R, gamma, sigma, p_y = map(mpf, case)
    K, Pc = mpf(4) / 3 * E, mpf(3) / 2 * pi * gamma * R
    unit = K * sqrt(R) * sigma ** mpf("1.5")
    theta, lam = K * sigma ** mpf("1.5") / (gamma * sqrt(R)), pi**2 * R * p_y**4 * sigma / (18 * K**2 * gamma**2)

    def centre(a):
        return 2 * E * a / (pi * R) - sqrt(2 * gamma * E / (pi * a))

    def displacement(a):
        return a**2 / R - sqrt(2 * pi * gamma * a / E)

    low, high = mpf(10) ** -14, mpf(1)
    for _ in range(200):  # a_y by bisection
        middle = sqrt(low * high)
        low, high = (middle, high) if centre(middle) < p_y else (low, middle)
    a_y = low
    from_start = p_y < (2 * E**2 * gamma / (pi**2 * R)) ** (mpf(1) / 3)
    touch = (2 * pi * gamma * R**2 / E) ** (mpf(1) / 3)
    assert abs(displacement(touch)) < mpf(10) ** -25 * touch and from_start == (a_y < touch)
    first = max(a_y, touch)

    def jkr(a):
        return K * a**3 / R - sqrt(6 * pi * gamma * K * a**3)

    def stiffness(a):
        root = sqrt(K * a**3 / R)
        return (3 * pi * R * p_y * root - 2 * E * a_y * sqrt(Pc)) / (3 * root - sqrt(Pc))

    def climb(a):
        return stiffness(a) * (2 * a / R - sqrt(pi * gamma / (2 * E * a)))

    def ring(a):
        """JKR's pressure where r^2 > a^2 - a_y^2, by q = sqrt(1 - r^2/a^2): 2 pi r dr = -2 pi a^2 q dq."""
        p0, p1 = 2 * E * a / (pi * R), sqrt(2 * gamma * E / (pi * a))
        return mp.quad(lambda q: (p0 * q - p1 / q) * 2 * pi * a**2 * q, [0, a_y / a])

    for factor in BEYOND:
        a = first * mpf(factor)
        steps = [a_y * (a / a_y) ** (mpf(i) / 8) for i in range(9)]
        load = jkr(a_y) + mp.quad(climb, steps)
        other = pi * p_y * (a**2 - a_y**2) + ring(a)
        assert abs(load - other) < mpf(10) ** -20 * abs(jkr(a)), (case, factor)
        P1 = K * a**3 / R
        R_p = R * P1 / (load + sqrt(4 * Pc * P1))
        # unloading: JKR with R_p, at half way (in radius) from the turning point to where the contact is lost
        lost = (pi * gamma * R_p**2 / (8 * E)) ** (mpf(1) / 3)
        half = (a + lost) / 2
        rest = displacement(a) - (a**2 / R_p - sqrt(2 * pi * gamma * a / E))
        back = rest + half**2 / R_p - sqrt(2 * pi * gamma * half / E)
        P_back = K * half**3 / R_p - sqrt(6 * pi * gamma * K * half**3)
        yield [theta, lam, displacement(a) / sigma, load / unit, a**2 / (R * sigma), R_p / R, back / sigma, P_back / unit,
               half**2 / (R * sigma), mpf(3) / 2 * pi * gamma * R_p / unit]  # fmt: skip


def main():
    header = ["theta", "lambda", "limiting_pressure", "w", "load", "area"]
    header += ["radius", "w_back", "load_back", "area_back", "pull_off"]
    with (HERE / "thornton_ning_1998.csv").open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        for case in CASES:
            for theta, lam, *state in rows(case):
                inputs = [mp.nstr(theta, 17), mp.nstr(lam, 17), "hardness"]
                writer.writerow([*inputs, *(mp.nstr(value, 17) for value in state)])


if __name__ == "__main__":
    main()
