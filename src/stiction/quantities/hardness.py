"""Convert results of hardness tests, such as "700 HV" or "60 HRC", into the mean pressure of a plastic contact.

A Vickers number is the force in kgf divided by the area of the imprint's facets in mm^2 (ISO 6507-1). The mean pressure is the
force divided by the projected area, which is sin(136 deg / 2) times the area of the facets. So 1 HV is
9.80665 MPa / sin 68 deg = 10.577 MPa (ISO 14577-1: HV = 0.0945 H_IT).

A Brinell number is the force in kgf divided by the area in mm^2 of the spherical imprint of a ball of diameter D (ISO 6506-1).
For imprint diameters d = 0.24 to 0.60 D the mean pressure is 1.5 to 11 % above this number. We take d = 0.375 D, where the
slope of the ball at the edge of the imprint equals that of a Vickers pyramid: 1 HB is 10.178 MPa.

Rockwell C numbers are not defined as a force divided by an area. We use HV = (223 HRC + 14500) / (100 - HRC), a common formula
of unknown origin. It agrees with the table for non-austenitic steels (ASTM E140, table 1) to 1.4 % from 35 to 68 HRC. Grade B.
"""

import math
import re

from stiction.quantities.errors import InputError

VICKERS = 9.80665e6 / math.sin(math.radians(68.0))  # Pa
_IMPRINT = 0.375  # d/D
BRINELL = 9.80665e6 * 2.0 * (1.0 - math.sqrt(1.0 - _IMPRINT**2)) / _IMPRINT**2  # Pa
_SOFTEST, _HARDEST = 20.0, 68.0  # HRC, range of the table
_SCALE = re.compile(r"HV(?:\s*/?\s*\d+(?:\.\d+)?)?|HRC|HRB|HRA|HB[WS]?|HK", re.IGNORECASE)


def from_hardness_test(number: float, unit: str, text: str) -> float | None:
    """Return the result of a hardness test as a pressure [Pa], or None if the unit is not a hardness scale.

    - number: the measured number, such as 700
    - unit: the scale, such as "HV", "HB" or "HRC"; the test force in "HV0.5" is ignored
    - text: the whole input as the user wrote it, for the error message

    Raises InputError for an unsupported scale and for Rockwell C numbers outside 20 to 68.
    """
    if not _SCALE.fullmatch(unit):
        return None
    scale = unit.upper()
    if scale.startswith("HV"):
        return number * VICKERS
    if scale.startswith("HB"):
        return number * BRINELL
    if scale == "HRC":
        if not _SOFTEST <= number <= _HARDEST:
            raise InputError("hardness", text, f'{_SOFTEST:g} to {_HARDEST:g} HRC, or another scale: "7 GPa", "700 HV"')
        return (223.0 * number + 14500.0) / (100.0 - number) * VICKERS
    raise InputError("hardness", text, 'pressure, Vickers, Brinell or Rockwell C: "7 GPa", "700 HV", "200 HB", "60 HRC"')
