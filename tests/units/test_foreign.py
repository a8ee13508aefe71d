"""Values as pandas and pint hold them: read like text with the same unit, and never without it."""

import numpy as np
import pandas as pd
import pint
import pytest
import xarray

import stiction as st
from refusals import refusal
from stiction.quantities.units import to_si

UNITS = pint.UnitRegistry()  # the user's own, not that of this package
ROUGHNESS = {"asperity_height_deviation": "48 nm", "asperity_radius": "50 um", "asperity_density": "1.7e10 1/m^2"}


def contact(**changes) -> st.Contact:
    given = {"first": "iron", "second": "iron", "work_of_adhesion": "0.1 J/m^2", "nominal_area": "1 mm^2"}
    return st.Contact(**given | {"roughness": ROUGHNESS} | changes)


@pytest.mark.parametrize(
    ("given", "name", "text"),
    [
        (UNITS.Quantity(5, "um"), "thickness", "5 um"),
        (UNITS("48 nm"), "asperity_height_deviation", "48 nm"),
        (1.7e10 / UNITS.meter**2, "asperity_density", "1.7e10 1/m^2"),
        (UNITS.Quantity(50, "mJ/m^2"), "work_of_adhesion", "50 mJ/m^2"),
        (UNITS.Quantity(3, "kgf"), "load", "3 kgf"),
        (UNITS.Quantity(30, "percent"), "poissons_ratio", "30 %"),
        (UNITS.Quantity(0.3, ""), "poissons_ratio", "0.3"),
        (UNITS.Quantity(0.3, "mm/m"), "poissons_ratio", "0.3 mm/m"),
    ],
)
def test_a_pint_quantity_is_read_like_its_text_to_the_last_digit(given, name, text):
    assert to_si(given, name) == to_si(text, name)


def test_arrays_and_lists_of_quantities():
    np.testing.assert_array_equal(to_si(UNITS.Quantity([1, 2], "mN"), "load"), [1e-3, 2e-3])
    np.testing.assert_array_equal(to_si([UNITS("1 mN"), "2 mN", 3e-3], "load"), [1e-3, 2e-3, 3e-3])
    array = xarray.DataArray(UNITS.Quantity([1.0, 2.0], "mN"), dims=("test",))
    found = to_si(array, "load")
    assert found.dims == ("test",) and found.values.tolist() == [1e-3, 2e-3]


@pytest.mark.parametrize(
    ("given", "name"),
    [
        (UNITS.Quantity(1, "N"), "thickness"),
        (UNITS.Quantity(1, ""), "thickness"),
        (UNITS.Quantity(1, "m"), "poissons_ratio"),
        (UNITS.Quantity([1, 2], "s"), "load"),
        ([UNITS.Quantity(1, "s")], "load"),
    ],
)
def test_a_quantity_of_another_dimension_is_refused(given, name):
    with refusal(name):
        to_si(given, name)
    with refusal("asperity_radius"):
        st.Roughness(**ROUGHNESS | {"asperity_radius": UNITS.Quantity(1, "N")})


def test_what_is_normalised_takes_no_unit():
    groups = st.Indices(theta=40, lam=10)
    with refusal("load", "1 newton"):
        st.solve(groups, load=UNITS.Quantity(1, "N"))
    for given in ({"h": UNITS.Quantity(1, "N"), "theta": 40}, {"h": 1.0, "theta": UNITS.Quantity(1, "N")}):
        with pytest.raises(st.InputError):
            st.evaluate(lam=10, **given)


def test_a_contact_of_quantities_is_that_of_texts():
    rough = st.Roughness(
        asperity_height_deviation=UNITS("48 nm"), asperity_radius=UNITS("50 um"), asperity_density=1.7e10 / UNITS.meter**2
    )
    assert contact(roughness=rough, nominal_area=UNITS("1 mm^2")) == contact()


def test_loads_from_a_column_of_a_table():
    expected = st.solve(contact(), load=["0.1 N", "1 N"])
    for given in (pd.Series([0.1, 1.0]), pd.Series(["0.1 N", "1 N"], dtype=object), UNITS.Quantity([0.1, 1.0], "N")):
        xarray.testing.assert_identical(st.solve(contact(), load=given), expected)
    table = pd.DataFrame({"load": [0.1, 1.0], "specimen": ["a", "b"]}).set_index("specimen")
    found = st.solve(contact(), load=table["load"])
    assert found["friction_coefficient"].dims == ("specimen",) and found["specimen"].values.tolist() == ["a", "b"]
    np.testing.assert_array_equal(found["friction_coefficient"].values, expected["friction_coefficient"].values)
    np.testing.assert_array_equal(st.solve(st.Indices(theta=40, lam=10), load=pd.Series([1e-3]))["load"], [1e-3])


def test_a_column_is_a_number_of_a_contact():
    """Along its index, or under the name of the quantity where that has none."""
    plain = contact(work_of_adhesion=pd.Series([0.1, 0.2]))
    assert plain.work_of_adhesion.dims == ("work_of_adhesion",) and plain.work_of_adhesion.values.tolist() == [0.1, 0.2]
    batches = pd.Index(["old", "new"], name="batch")
    named = contact(
        work_of_adhesion=pd.Series(["0.1 J/m^2", "0.2 J/m^2"], index=batches), nominal_area=pd.Series([1e-6, 2e-6], batches)
    )
    found = st.solve(named, load="1 N")
    assert found["friction_coefficient"].dims == ("batch",) and found["batch"].values.tolist() == ["old", "new"]
    alone = st.solve(contact(work_of_adhesion=0.2, nominal_area=2e-6), load="1 N")
    assert float(found["friction_coefficient"][1]) == pytest.approx(float(alone["friction_coefficient"]), rel=1e-13)
    with refusal("work_of_adhesion", "-0.2"):
        contact(work_of_adhesion=pd.Series([0.1, -0.2]))
