"""The table of contacts with known friction: complete, with sources, and enough to build each contact."""

import importlib.util
import math
from collections import Counter
from pathlib import Path

import pytest

from stiction.contact.interfaces import interface
from stiction.contact.materials import material_names
from stiction.surfaces.finishes import finish_names

FOLDER = Path(__file__).parents[2] / "validation" / "contacts"


def script():
    spec = importlib.util.spec_from_file_location("contacts", FOLDER / "contacts.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


contacts = script()
ROWS = contacts.rows()
COLUMNS = [
    "id", "class", "first", "second", "film", "film_thickness_m", "interface", "in_scope", "environment", "load_N",
    "nominal_area_m2", "geometry", "finish_first", "finish_second", "work_of_adhesion_J_m2", "mu_low", "mu_high", "which",
    "grade", "sources", "note",
]  # fmt: skip
# What the design asks for, by class.
WANTED = {
    "clean copper", "oxidised copper", "steel dry", "oxidised steel", "steel lubricated", "PTFE", "nylon", "polyethylene",
    "DLC dry", "DLC humid", "silver film on steel", "lead film on steel", "gold contact", "silicon with native oxide",
    "silicon with monolayer", "PDMS on glass", "rubber", "ice", "graphite", "MoS2", "diamond", "alumina", "silicon carbide",
    "sapphire", "mica", "head and disk", "TiN", "PMMA",
}  # fmt: skip


def test_the_table_is_as_wide_and_as_long_as_it_was_meant():
    assert list(ROWS[0]) == COLUMNS
    assert len({row["id"] for row in ROWS}) == len(ROWS) >= 60
    assert {row["class"] for row in ROWS} >= WANTED
    scored = [row for row in ROWS if row["in_scope"] == "yes"]
    assert len(scored) >= 60 and len({row["class"] for row in scored}) >= 24
    assert Counter(row["grade"] for row in ROWS)["C"] <= len(ROWS) // 10


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row["id"])
def test_a_row(row):
    low, high, load, area = (float(row[name]) for name in ("mu_low", "mu_high", "load_N", "nominal_area_m2"))
    assert 0 < low <= high < 20 and 0 < load < 100 and 0 < area <= 1e-4
    assert row["in_scope"] in ("yes", "no") and row["which"] in ("static", "kinetic")
    assert row["geometry"] in ("stated", "load stated", "convention")
    assert {row["finish_first"], row["finish_second"]} <= set(finish_names())
    assert bool(row["film"]) == bool(row["film_thickness_m"])
    keys = row["sources"].split(";")
    assert set(keys) <= contacts.sources().keys()
    assert (row["grade"] == "C") == (keys == ["memory"])
    if row["grade"] == "A":  # a measurement, of which more was read than a chart
        assert any(contacts.sources()[key]["seen"] in ("abstract", "data") for key in keys)


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row["id"])
def test_a_contact_can_be_made_of_a_row_and_allows_its_interface(row):
    contact = contacts.contact_of(row)
    groups = contact.indices()
    assert 0.02 < float(groups.roughness_parameter) < 0.2
    assert math.isfinite(contact.plasticity_index)
    meeting = contact.first if contact.coating is None else contact.coating.material
    assert interface(row["interface"]).allows(meeting, contact.second)


def test_every_body_is_a_preset_and_every_source_is_used():
    named = {row[name] for row in ROWS for name in ("first", "second", "film") if row[name]}
    assert named <= set(material_names())
    assert {key for row in ROWS for key in row["sources"].split(";")} == contacts.sources().keys()
    for key, source in contacts.sources().items():
        assert source["what"] and bool(source["address"]) == (key != "memory")
        assert source["seen"] in ("page", "passage", "abstract", "data", "quoted", "memory")


# Numbers as the pages print them: (row, low, high).
@pytest.mark.parametrize(
    ("name", "low", "high"),
    [
        ("copper_vacuum", 2.2, 16),  # J. Lubrication Technology 89(4):425: "2.2 to over 16"
        ("silicon_wafers", 0.30, 0.40),  # Dunkin and Kim 1996
        ("polysilicon_ots", 0.13 - 0.01, 0.13 + 0.01),  # 0.13 +/- 0.01
        ("polysilicon_oxide", 2.3 - 0.8, 2.3 + 0.8),
        ("lead_film_on_copper", 0.03, 0.08),
        ("nylon_on_steel", 0.30, 0.50),  # 0.30-0.50 and 0.32-0.45
        ("steel_thick_oxide", 0.27, 0.39),  # thick oxide film, sulfide film
    ],
)
def test_ranges_are_those_printed(name, low, high):
    (row,) = (row for row in ROWS if row["id"] == name)
    assert (float(row["mu_low"]), float(row["mu_high"])) == pytest.approx((low, high), rel=1e-9)


@pytest.mark.parametrize(("name", "pressure"), [("mos2_on_steel_light", 200e6), ("mos2_on_steel_heavy", 1500e6)])
def test_mos2_is_what_its_regression_gives(name, pressure):
    """24.8 MPa/p + 0.001 (Singer et al. 1990), at the ends of the pressures of the abstract."""
    (row,) = (row for row in ROWS if row["id"] == name)
    assert float(row["mu_low"]) <= 24.8e6 / pressure + 0.001 <= float(row["mu_high"])
    assert float(row["load_N"]) / float(row["nominal_area_m2"]) == pytest.approx(pressure, rel=0.02)
