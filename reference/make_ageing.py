"""Real area of a contact that creeps at rest: mpmath, 20 digits. Takes a second.

The rate of creep falls exponentially with the area gained, dA/dt = (m/t_c) exp(-(A - 1)/m) over the area at first. The time to
reach an area is the integral of one over the rate, by quadrature; `factor` is the area at which that time is `waiting`, in
cut-off times, by bisection.

- `berthoud_1999.csv`: `factor` at `waiting`, `ageing_rate`
"""

import csv
from pathlib import Path

from mpmath import mp, mpf

mp.dps = 20


def area(m, waited):
    def time(gained):
        return mp.quad(lambda x: mp.exp(x / m) / m, [0, gained / 2, gained])

    high = m
    while time(high) < waited:
        high *= 2
    low = mpf(0)
    for _ in range(70):
        middle = (low + high) / 2
        low, high = (middle, high) if time(middle) < waited else (low, middle)
    return 1 + low


if __name__ == "__main__":
    with (Path(__file__).parent / "berthoud_1999.csv").open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["waiting", "ageing_rate", "factor"])
        for m in ("0.005", "0.02", "0.1"):
            for waited in ("0.001", "1", "60", "3600", "86400"):
                writer.writerow([waited, m, mp.nstr(area(mpf(m), mpf(waited)), 15)])
