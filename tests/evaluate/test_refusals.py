"""What a user can give by mistake to `solve`, `unload` and `evaluate` is refused in one line that names it."""

import math

import numpy as np
import pytest
import xarray

import stiction as st
from stiction.engine.summation import _slices

CONTACT = st.Indices(theta=40.0, lam=10.0)
PLAIN = {"model": "greenwood_williamson_1966"}

# What is no number, or none without a unit.
NO_NUMBERS = {
    "complex": np.array([1.0 + 2.0j]),
    "labelled, complex": xarray.DataArray(1.0 + 2.0j),
    "true": True,
    "labelled, true": xarray.DataArray([True, False], dims="x"),
    "bytes": b"1",
    "a date": np.datetime64("2020-01-01"),
    "too large": 10**400,
    "one too large": [1.0, 10**400],
    "labelled, one too large": xarray.DataArray(np.array([1, 10**400], dtype=object), dims="x"),
    "labelled, text": xarray.DataArray(["a", "b"], dims="x"),
    "a set": {1.0, 2.0},
    "rows of unlike lengths": [[1.0], [1.0, 2.0]],
    "text with a unit": "1 nm",
}
# As the indices are read alone; `evaluate` takes any shape.
NO_POINTS = NO_NUMBERS | {
    "two dimensions without names": [[1.0, 2.0], [3.0, 4.0]],
    "labelled, not a number": xarray.DataArray([1.0, math.nan], dims="x"),
    "labelled, of a unit": xarray.DataArray([1.0], dims="x", attrs={"units": "mN"}),
    "a dimension that is no text": xarray.DataArray([1.0, 2.0], dims=(3,)),
}


def refused(field, call, *given, **named):
    """What is refused, and in one line that begins with the field."""
    with pytest.raises(st.InputError) as caught:
        call(*given, **named)
    said = str(caught.value)
    assert said.startswith(f"{field}: ") and ("; allowed: " in said or "; not supported" in said) and "\n" not in said
    return said


@pytest.mark.parametrize("what", NO_POINTS)
def test_points_of_indices(what):
    value = NO_POINTS[what]
    refused("mean_separation", st.solve, CONTACT, separation=value, **PLAIN)
    refused("load", st.solve, CONTACT, load=value, **PLAIN)
    refused("min_separation", st.unload, CONTACT, min_separation=value, separation_increase=0.0, **PLAIN)
    refused("max_load", st.unload, CONTACT, max_load=value, separation_increase=0.0, **PLAIN)
    refused("separation_increase", st.unload, CONTACT, min_separation=0.0, separation_increase=value, **PLAIN)


@pytest.mark.parametrize("value", ([1.0, [2.0, 3.0]], [[1e-9, 2e-9]], np.zeros((2, 2)), True, 1j, [None], {1.0}))
def test_points_of_a_contact(value):
    surface = {"asperity_height_deviation": "48 nm", "asperity_radius": "50 um", "asperity_density": "1.7e10 1/m^2"}
    contact = st.Contact(first="silver", second="silver", nominal_area="1 mm^2", work_of_adhesion="0.1 J/m^2",
                         roughness=st.Roughness(**surface))  # fmt: skip
    refused("mean_separation", st.solve, contact, separation=value, **PLAIN)
    refused("load", st.solve, contact, load=value, **PLAIN)


@pytest.mark.parametrize("value", ("0.5", 1, [0.5], np.float32(0.5), xarray.DataArray([1, 2], dims="x", attrs={"units": "1"})))
def test_points_that_will_do(value):
    """Numbers as text are what the command line has."""
    assert np.isfinite(st.solve(CONTACT, separation=value, **PLAIN)["load"].values).all()


@pytest.mark.parametrize("what", NO_NUMBERS)
def test_numbers_of_evaluate(what):
    value = NO_NUMBERS[what]
    refused("h", st.evaluate, value, 40.0, 10.0)
    refused("theta", st.evaluate, 0.0, value, 10.0)


@pytest.mark.parametrize("nothing", ([], xarray.DataArray(np.zeros((2, 0)), dims=("a", "b"))))
def test_nothing_is_drawn_apart_from_nowhere(nothing):
    refused("min_separation", st.unload, CONTACT, min_separation=nothing, separation_increase=0.1, **PLAIN)
    refused("separation_increase", st.unload, CONTACT, min_separation=0.0, separation_increase=nothing, **PLAIN)


@pytest.mark.parametrize("threads", (0, -1, 1.5, "2", True, None, math.nan, [2]))
@pytest.mark.parametrize("points", ({"separation": 0.0}, {"load": 0.1}))
@pytest.mark.parametrize("model", ("greenwood_williamson_1966", "bush_gibson_thomas_1975"))
def test_threads(threads, points, model):
    contact = st.Indices(theta=40.0, lam=10.0, sharpness=0.01, roughness_parameter=0.05)
    said = refused("threads", st.solve, contact, threads=threads, model=model, **points)
    assert said.endswith("allowed: a whole number, 1 or more")
    refused("threads", st.evaluate, 0.0, 40.0, 10.0, threads=threads)


@pytest.mark.parametrize(("size", "threads"), ((5, 10**9), (7, 3), (0, 4), (1, 1)))
def test_no_more_slices_than_places(size, threads):
    shares = _slices(size, threads)
    assert len(shares) <= max(size, 1) and len(shares) <= threads
    assert [at for share in shares for at in range(size)[share]] == list(range(size))


@pytest.mark.parametrize(
    "value", (3, ["jkr"], [], {}, True, math.nan, np.array(["a", "b"]), xarray.DataArray([1.0, 2.0], dims="x"))
)
@pytest.mark.parametrize("name", ("asperity", "tangential", "film", "presliding", "variant", "options"))
def test_laws_and_options_are_text(name, value):
    coated = st.Indices(theta=40.0, lam=10.0, n_E=1.0, n_H=1.0, tau=1.0)
    for contact in (CONTACT, coated):
        refused(name, st.solve, contact, separation=0.0, **{name: value})


@pytest.mark.parametrize("value", (3, [], {}, True, math.nan, np.zeros(2), xarray.DataArray([1.0, 2.0], dims="x")))
def test_heights_are_a_distribution_or_its_name(value):
    text = refused("heights", st.solve, CONTACT, separation=0.0, heights=value)
    assert text.startswith(f"heights: {type(value).__name__!r}; allowed: ")


def test_a_film_law_that_nobody_knows_is_refused_without_a_film_too():
    assert "graded" in refused("film", st.solve, CONTACT, separation=0.0, film="no_such")


def test_laws_without_an_option_are_each_named_once():
    said = refused("foo", st.solve, CONTACT, separation=0.0, foo="bar")
    assert said.count("soft_coating_2015") == 1 and "roy_chowdhury_ghosh_1994" in said


@pytest.mark.parametrize("name", ([], {}, np.zeros(2), 3, None, "thet"))
def test_an_axis_is_of_a_quantity(name):
    refused("axis", st.axis, name, [1.0, 2.0])


def test_dimensions_are_named_by_text():
    refused("dimension", st.axis, "theta", [1.0, 2.0], 3)
    refused("theta", st.Indices, theta=xarray.DataArray([1.0, 2.0], dims=(3,)), lam=10.0)
