"""How numbers stand in tables and on axes: digits, prefixes, and which of many rows are shown."""

import math

import pytest

from stiction.quantities.sampling import spread_rows
from stiction.report.table import prefix, short


@pytest.mark.parametrize(
    ("value", "digits", "text"),
    [(12345.678, 4, "12350"), (0.000123456, 3, "0.000123"), (0.0, 4, "0"), (math.nan, 4, "-"), (math.inf, 4, "-")],
)
def test_a_number_has_a_few_digits(value, digits, text):
    assert short(value, digits) == text


@pytest.mark.parametrize(
    ("quantity", "largest", "per", "unit"),
    [
        ("mean_separation", 3.2e-7, 1e9, "nm"),
        ("load", 0.02, 1e3, "mN"),
        ("contact_area", 2e-10, 1e12, "µm²"),
        ("friction_coefficient", 0.3, 1.0, ""),
        ("load", 0.0, 1.0, "N"),
    ],
)
def test_values_are_multiplied_by_what_their_prefix_stands_for(quantity, largest, per, unit):
    factor, said = prefix(quantity, largest)
    assert factor == pytest.approx(per, rel=1e-12) and said == unit


def test_rows_are_spread_evenly_with_both_ends():
    assert (
        spread_rows(5, 3).tolist() == [0, 2, 4] and spread_rows(2, 12).tolist() == [0, 1] and spread_rows(1, 4).tolist() == [0]
    )
