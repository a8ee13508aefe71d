"""The table of common units says the same as pint, exactly."""

from fractions import Fraction

import pint
import pytest

from stiction.quantities.table import rows_of_table
from stiction.quantities.units import to_si

ROWS = list(rows_of_table("units.csv"))


@pytest.fixture(scope="module")
def registry():
    return pint.UnitRegistry(non_int_type=Fraction)


@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"{row['unit']} in {row['si_unit'] or 'parts'}")
def test_a_factor_is_that_of_pint(row, registry):
    unit = "1" + row["unit"] if row["unit"].startswith("/") else row["unit"]
    exact = registry.Quantity(Fraction(1), registry.parse_units(unit)).to(row["si_unit"] or "dimensionless").magnitude
    assert Fraction(row["factor"]) == exact


def test_each_unit_has_one_row():
    assert len({(row["unit"], row["si_unit"]) for row in ROWS}) == len(ROWS)


def test_a_common_unit_is_read_without_pint(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "pint", None)  # importing it raises ImportError
    assert to_si("48 nm", "asperity_height_deviation") == 4.8e-8
