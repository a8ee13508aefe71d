"""The form follows the records: every number is asked, and every place of a slider is allowed."""

import pytest

from stiction.contact.contact import Contact, Indices
from stiction.contact.materials import Material
from stiction.quantities.table import QUANTITIES
from stiction.quantities.units import to_si
from stiction.surfaces.roughness import Roughness
from stiction.web.fields import as_written, example_cases, first_case, numbers_of, parts_of, value_at, with_value_at
from stiction.web.query import Query, solved


def _numbers(tables):
    for part in parts_of(tables):
        yield from numbers_of(part)


@pytest.mark.parametrize(
    ("tables", "record", "path"),
    [
        (first_case(), Contact, ("contact",)),
        (first_case(), Roughness, ("contact", "roughness")),
        (first_case(), Material, ("contact", "coating", "material")),
        ({"indices": {}}, Indices, ("indices",)),
    ],
)
def test_every_number_of_a_record_is_asked(tables, record, path):
    asked = {one.path[-1] for one in _numbers(tables) if one.path[:-1] == path}
    assert asked == {name for name in record.model_fields if name in QUANTITIES}


def test_a_field_that_a_record_gets_is_asked_by_itself(monkeypatch):
    import stiction.web.fields as fields

    class More(Contact):
        equilibrium_distance: float | None = None

    monkeypatch.setattr(fields, "Contact", More)
    assert ("contact", "equilibrium_distance") in {one.path for one in _numbers(first_case())}


@pytest.mark.parametrize("tables", [first_case(), {"indices": {}}], ids=["contact", "indices"])
def test_every_end_of_a_slider_is_allowed(tables):
    for one in _numbers(tables):
        value = one.si(one.quantity.example)
        knob = one.knob(value)
        assert knob.low < knob.place(value) < knob.high or one.quantity.name in ("n_f", "films", "coated_share", "peeling")
        for place in (knob.low, knob.high):
            written = one.written(one.text(knob.value(place)))
            assert to_si(written, one.quantity.name) == pytest.approx(knob.value(place), rel=1e-3, abs=1e-12)


def test_text_and_slider_mean_the_same():
    sigma = next(one for one in _numbers(first_case()) if one.path[-1] == "asperity_height_deviation")
    assert sigma.written(sigma.text(48e-9)) == "48 nm" and sigma.si("48 nm") == 48e-9 and sigma.si("48") is None


@pytest.mark.parametrize(
    ("given", "text"),
    [
        ({"median": "1 J/m^2", "factor": 3}, "1 J/m² within a factor 3"),
        ({"low": "30 nm", "high": "70 nm"}, "30 nm to 70 nm"),
        (["48 nm", "60 nm"], '["48 nm", "60 nm"]'),
        ({"values": [1.5, 2], "along": "a"}, '{ values = [1.5, 2], along = "a" }'),
        ("48 nm", "48 nm"),
        ("0.1 um", "0.1 µm"),
    ],
)
def test_a_list_and_a_distribution_stand_in_a_field_and_units_have_their_signs(given, text):
    sigma = next(one for one in _numbers(first_case()) if one.path[-1] == "asperity_height_deviation")
    assert as_written(given) == text and sigma.written(text) == given
    assert sigma.written("{ median = ") == "{ median = " and as_written(None) == "" and as_written(True) == "true"
    assert as_written(sigma.written("[2020-01-01]")) == '["2020-01-01"]'


@pytest.mark.parametrize(
    ("given", "moved"),
    [
        ("48 nm", "60 nm"),
        ("48 nm +/- 10 %", "60 nm +/- 10 %"),
        ("48 nm +/- 4.8 nm", "60 nm +/- 10 %"),
        ({"median": "48 nm", "factor": 3}, {"median": "60 nm", "factor": 3}),
        ({"low": "36 nm", "high": "60 nm"}, {"low": "45 nm", "high": "75 nm"}),
    ],
)
def test_a_slider_moves_an_uncertain_number_with_its_error(given, moved):
    sigma = next(one for one in _numbers(first_case()) if one.path[-1] == "asperity_height_deviation")
    assert sigma.si(given) == pytest.approx(48e-9) and sigma.moved(given, 60e-9) == moved


def test_every_example_of_the_menu_is_predicted():
    for title, tables in example_cases().items():
        assert solved(Query(tables)).is_prediction, title


def test_what_stands_at_a_place():
    tables = {"contact": {"first": "silver", "roughness": {"asperity_radius": "1 um"}}}
    changed = with_value_at(tables, ("contact", "first", "hardness"), "1 GPa")
    assert changed["contact"]["first"] == {"preset": "silver", "hardness": "1 GPa"} and tables["contact"]["first"] == "silver"
    assert (
        value_at(changed, ("contact", "first", "hardness")) == "1 GPa"
        and value_at(tables, ("contact", "first", "hardness")) is None
    )
    assert with_value_at(changed, ("contact", "first", "hardness"), None)["contact"]["first"] == {"preset": "silver"}
    assert with_value_at(tables, ("solve", "load", "start"), None) == tables
