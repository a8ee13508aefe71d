"""Contacts with friction in handbooks, the state of the interface stated: range and width of the 90 % interval.

handbook.csv: contacts by their row in validation/contacts/contacts.csv, the published range with source and page, and why one
fails.
"""

import csv
import importlib.util
from pathlib import Path

import pytest

import stiction as st

FOLDER = Path(__file__).parents[2] / "validation" / "contacts"
with Path(__file__).with_name("handbook.csv").open(encoding="utf-8", newline="") as file:
    PRINTED = list(csv.DictReader(file))
KINETIC, WIDEST = 1.33, 10.0  # the static coefficient at most, over the kinetic one; the interval's upper end over its lower


def script():
    spec = importlib.util.spec_from_file_location("contacts", FOLDER / "contacts.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


contacts = script()
ROWS = {row["id"]: row for row in contacts.rows()}


def marked(row):
    marks = [pytest.mark.xfail(reason=row["fails"], strict=True)] if row["fails"] else []
    return pytest.param(row, id=row["id"], marks=marks)


@pytest.mark.parametrize("row", [marked(row) for row in PRINTED])
def test_the_interval_meets_the_handbook_and_is_narrow(row):
    contact = ROWS[row["id"]]
    found = st.predict(contacts.contact_of(contact, interface=contact["interface"]), load=float(contact["load_N"]))
    low, high = found.friction_coefficient_low.item(), found.friction_coefficient_high.item()
    times = KINETIC if contact["which"] == "kinetic" else 1.0
    assert low <= times * float(row["high"]) and high >= float(row["low"])
    assert high < WIDEST * low


def test_nine_of_ten_hold_and_ranges_are_those_of_the_table():
    assert len(PRINTED) >= 24
    assert sum(bool(row["fails"]) for row in PRINTED) <= len(PRINTED) / 10
    for row in PRINTED:
        contact = ROWS[row["id"]]
        assert (row["low"], row["high"]) == (contact["mu_low"], contact["mu_high"])
        assert row["source"] and (row["page"] or row["source"].startswith("From memory"))
