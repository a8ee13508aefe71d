"""Round a number to the digits that its uncertainty justifies."""

import math

_MOST = 3  # digits; a measured friction coefficient has no more


def rounded(value: float, ends: list[float]) -> str:
    """Format a value with one to three significant digits, depending on its uncertainty.

    ends: ends of the uncertainty interval; [] for none, which gives two digits. The last digit shown has the decimal place of
    the first digit of half the interval width, or one place further if that first digit is 1. NaN and infinity give "not
    defined", and 0 gives "0".
    """
    if not math.isfinite(value):
        return "not defined"
    if value == 0.0:
        return "0"
    half = 0.5 * (max([value, *ends]) - min([value, *ends]))
    digits = 2
    if half > 1e-12 * abs(value):
        place = _place(half) - (1 if f"{half:e}".startswith("1") else 0)
        digits = min(max(1 + _place(value) - place, 1), _MOST)
    text = f"{value:.{digits}g}"
    if "e" in text and 1e-4 <= abs(value) < 1e5:  # 10 with one digit is formatted as 1e+01
        text = f"{float(text):.0f}"
    missing = digits - len(text.replace(".", "").lstrip("-0"))  # significant zeros at the end, as in 0.30
    return text if "e" in text or missing <= 0 else text + ("" if "." in text else ".") + "0" * missing


def _place(value: float) -> int:
    """Return the decimal exponent of the leading digit of a number."""
    return int(f"{abs(value):e}".partition("e")[2])
