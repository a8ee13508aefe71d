"""Predictions of many contacts together are those of each alone."""

import re
from pathlib import Path

import numpy as np
import pytest
from xarray import DataArray

import stiction as st
from refusals import refusal
from stiction.case.read import as_case
from stiction.quantities.units import to_si
from stiction.studies.prediction import many
from stiction.studies.prediction.many import predict_many

ROUGH = {"asperity_height_deviation": "0.2 um", "asperity_radius": "20 um", "asperity_density": "1e10 1/m^2"}
BARE = {"first": "copper", "second": "hardened_steel_52100", "nominal_area": "1 cm^2", "roughness": ROUGH}
SILVER = {"coating": {"material": "silver", "bodies": "second", "thickness": "1 um"}}
STICKY = {"first": "pdms", "second": "soda_lime_glass", "work_of_adhesion": "40 mJ/m^2"}
OXIDISED = BARE | {"interface": "oxidised metal"}
CONTACTS = {
    "bare": (OXIDISED, "asperity_height_deviation", ["0.1 um", "0.2 um", "0.6 um"]),
    "stated": (BARE, "interfacial_shear_strength", ["10 MPa", "50 MPa"]),
    "film": (BARE | {"first": "hardened_steel_52100"} | SILVER, "thickness", ["0.5 um", "2 um"]),
    "adhesive film": (
        BARE | {"first": "hardened_steel_52100", "work_of_adhesion": "0.5 J/m^2"} | SILVER,
        "work_of_adhesion",
        ["0.3 J/m^2", "1 J/m^2"],
    ),
    "adhesive": (BARE | STICKY, "work_of_adhesion", ["20 mJ/m^2", "50 mJ/m^2"]),
    "softer body changes": (BARE | {"first": {"preset": "copper"}}, "hardness", ["1 GPa", "20 GPa"]),
}
PLACES = {
    "asperity_height_deviation": ("roughness",),
    "thickness": ("coating",),
    "hardness": ("first",),
}


def with_value(contact, name, value):
    if not (place := PLACES.get(name, ())):
        return contact | {name: value}
    return contact | {place[0]: {**contact[place[0]], name: value}}


@pytest.mark.parametrize("kind", CONTACTS)
def test_a_row_of_many_is_the_prediction_of_one(kind):
    contact, name, values = CONTACTS[kind]
    solve = {"load": ["1 N", "10 N"]}
    found_many = st.predict({"contact": with_value(contact, name, values), "solve": solve})
    assert found_many.sizes == {name: len(values), "load": 2}
    for at, value in enumerate(values):
        one = st.predict({"contact": with_value(contact, name, value), "solve": solve})
        for end in ("_low", "", "_high"):
            found = found_many[f"friction_coefficient{end}"].isel({name: at}).values
            np.testing.assert_allclose(
                found, one[f"friction_coefficient{end}"].values, rtol=1e-3
            )  # where it adheres the faint adhesion is one for all


def test_a_stated_number_of_samples_is_used_and_said():
    contact, name, values = CONTACTS["bare"]
    content = {"solve": {"load": "1 N"}, "uncertainty": {"count": 64}}
    found = st.predict(content | {"contact": with_value(contact, name, values)})
    one = st.predict(content | {"contact": with_value(contact, name, values[0])})
    assert found.attrs["draws"] == one.sizes["sample"] == 64
    np.testing.assert_allclose(found["friction_coefficient_low"].values[0], one["friction_coefficient_low"].values, rtol=1e-3)


@pytest.mark.parametrize("kind", ["bare", "stated"])
def test_contacts_along_sample_are_no_draws(kind):
    """As those of a sweep whose points are a list or drawn: each is its own prediction, whatever their dimension is called."""
    contact, name, values = CONTACTS[kind]
    case, found = as_case({"contact": with_value(contact, name, values[0]), "solve": {"load": "1 N"}}), {}
    for dim in ("sample", "place"):
        array = DataArray([to_si(value, name) for value in values], dims=dim)
        numbers = {("contact", *PLACES.get(name, ()), name): array}
        ((region, _, solved),) = predict_many(case, numbers, np.array([1.0]))
        dims, found[dim], _ = solved.variables["friction_coefficient"]
        assert dims == (dim, "load") and region[dim] == slice(0, len(values))
    np.testing.assert_array_equal(found["sample"], found["place"])
    assert kind == "bare" or len(np.unique(found["sample"])) == len(values)  # bare: all is plastic, whatever the heights


@pytest.mark.parametrize("kind", CONTACTS)
def test_contacts_that_all_answer_are_not_divided(kind, monkeypatch):
    """A law that refuses each of them is left out, as of one contact: to bisect them would solve each alone."""
    contact, name, values = CONTACTS[kind]
    together, sizes = many._together, []

    def counted(case, numbers, *rest):
        sizes.append(next(iter(numbers.values())).size)
        return together(case, numbers, *rest)

    monkeypatch.setattr(many, "_together", counted)
    st.predict({"contact": with_value(contact, name, values), "solve": {"load": ["1 N"]}})
    assert sizes == [len(values)]


def test_a_contact_that_is_refused_leaves_the_others():
    """1 N on 1e-11 m^2 presses with more than any hardness."""
    areas = ["1 cm^2", "1e-11 m^2", "2 cm^2"]
    found = st.predict({"contact": BARE | {"nominal_area": areas}, "solve": {"load": ["1 N"]}})
    assert np.isfinite(found.friction_coefficient.values.ravel()).tolist() == [True, False, True]
    assert found.attrs["refused"] == 1 and found.attrs["why_refused"].startswith("load: '1 N'")
    with refusal("load", "1 N", "9.43 mN"):
        st.predict({"contact": BARE | {"nominal_area": ["1e-11 m^2", "2e-11 m^2"]}, "solve": {"load": ["1 N"]}})


def test_a_swept_number_of_the_harder_body_leaves_the_same_prediction():
    """The yield stress of a harder body changes nothing, whether its hardness is uncertain or not."""
    soft = {"youngs_modulus": "87 MPa", "poissons_ratio": 0.39, "hardness": "3.6 MPa"}
    hard = {"youngs_modulus": "8.7 GPa", "poissons_ratio": 0.23, "hardness": {"low": "0.8 GPa", "high": "0.82 GPa"}}
    hard |= {"yield_stress": {"values": ["266 MPa", "531 MPa"], "along": "place"}}
    contact = BARE | {"first": hard, "second": soft}
    mu = st.predict({"contact": contact, "solve": {"load": ["10 N"]}, "uncertainty": {}}).friction_coefficient
    assert mu.sizes["place"] == 2 and float(mu.min()) > 0.0
    np.testing.assert_allclose(mu.isel(place=0), mu.isel(place=1), rtol=1e-12)


def test_loads_that_do_not_press_are_left_out_of_a_sweep():
    """They make no other point refuse: all others are solved at once."""
    contact = with_value(OXIDISED, "asperity_height_deviation", ["0.1 um", "0.2 um"])
    found = st.predict({"contact": contact, "solve": {"load": ["-1 N", "1 N", "0 N", "10 N"]}})
    pressed = st.predict({"contact": contact, "solve": {"load": ["1 N", "10 N"]}})
    np.testing.assert_allclose(found["friction_coefficient"][:, [1, 3]], pressed["friction_coefficient"], rtol=1e-12)
    assert np.isnan(found["friction_coefficient"][:, [0, 2]]).all() and found.attrs["refused"] == 4
    with refusal("load", "0", "> 0 N"):
        st.predict({"contact": contact, "solve": {"load": ["-1 N", "0 N"]}})


def test_arrays_of_python_are_predicted_too():
    sigma = st.axis("asperity_height_deviation", ["0.1 um", "0.2 um"])
    contact = st.Contact(**{**BARE, "interface": "oxidised metal", "roughness": ROUGH | {"asperity_height_deviation": sigma}})
    found = st.predict(contact, load="10 N")
    alone = st.predict(st.Contact(**BARE, interface="oxidised metal"), load="10 N")
    assert found.friction_coefficient[1].item() == pytest.approx(alone.friction_coefficient.item(), rel=1e-9)


def test_the_attributes_of_an_array_of_contacts_are_those_that_predict_lists():
    """`start.md` prints the regime of a contact; an array of contacts has none, as the docstring and that page state."""
    swept = {"contact": OXIDISED | {"nominal_area": ["1 cm^2", "2 cm^2"]}, "solve": {"load": "1 N"}}
    listed, if_refused = st.predict.__doc__.split("With array parameters")[1].split("Raises")[0].split("If there are such")
    assert set(st.predict(swept).attrs) == set(re.findall(r"`(\w+)`", listed))
    some_refused = swept | {"solve": {"load": ["1 N", "0 N"]}}
    assert set(st.predict(some_refused).attrs) == set(re.findall(r"`(\w+)`", listed + if_refused))
    page = (Path(__file__).parents[2] / "docs" / "start.md").read_text(encoding="utf-8")
    assert "but no `regime`, `next_step`\nand `shares`" in page


def test_separations_are_refused_with_what_to_do():
    with refusal("solve.separation", "load"):
        st.predict({"contact": BARE | {"nominal_area": ["1 cm^2", "2 cm^2"]}, "solve": {"separation": [1.0, 2.0]}})


def test_an_answer_does_not_depend_on_the_number_of_loads():
    """Before, more than 200 loads were answered without the errors on benchmark surfaces, and so with a false interval."""
    steel = {"youngs_modulus": "100 GPa", "poissons_ratio": 0.3, "hardness": "20 GPa"}
    rough = {"asperity_height_deviation": "0.2 um", "asperity_radius": "20 um", "asperity_density": "1e10 1/m^2"}
    contact = st.Contact(first=steel, second=steel, nominal_area="1 cm^2", interfacial_shear_strength="5 MPa", roughness=rough)
    few, many = (st.predict(contact, load=np.linspace(10.0, 11.0, count)).isel(load=0) for count in (2, 1501))
    for name in ("friction_coefficient", "friction_coefficient_low", "friction_coefficient_high", "contact_area"):
        assert float(many[name]) == pytest.approx(float(few[name]), rel=1e-12)
