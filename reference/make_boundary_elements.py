"""A wave in one direction pressed on a flat, in closed form: mpmath, 30 digits. Takes no time.

h = a cos(2 pi x/wavelength): of the area (2/pi) arcsin((p/p*)^(1/2)) touches under the mean pressure p, p* = pi E* a/wavelength
(Westergaard 1939; Johnson 1985, section 13.2), at the largest pressure 2 (p p*)^(1/2).

- `boundary_elements.csv`: `share` of p*, `area`, `largest` over p*
"""

import csv
from pathlib import Path

from mpmath import asin, mp, mpf, pi, sqrt

mp.dps = 30
HERE = Path(__file__).parent
NAME = "boundary_elements"


def main() -> None:
    with (HERE / f"{NAME}.csv").open("w", encoding="utf-8", newline="") as file:
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(("share", "area", "largest"))
        for share in ("0.05", "0.2", "0.5", "0.8"):
            p = mpf(share)
            rows.writerow((share, *(mp.nstr(value, 17) for value in (2 / pi * asin(sqrt(p)), 2 * sqrt(p)))))


if __name__ == "__main__":
    main()
