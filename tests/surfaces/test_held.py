"""Maps as other packages hold them, taken over and given back: the same heights at the same places."""

import sys

import numpy as np
import pint
import pytest
import xarray

import stiction as st
from refusals import refusal
from stiction.surfaces.held import as_height_map

HEIGHTS = np.random.default_rng(3).normal(size=(12, 16)) * 1e-9  # rows along y
SIZE = (3e-6, 8e-6)


def surface(**changes) -> st.HeightMap:
    return st.HeightMap(**{"heights": HEIGHTS, "size": SIZE, "name": "made", "history": ("made",)} | changes)


def same(found: st.HeightMap, expected: st.HeightMap) -> None:
    np.testing.assert_allclose(found.heights, expected.heights, rtol=1e-14)
    np.testing.assert_allclose(found.size, expected.size, rtol=1e-12)


@pytest.mark.parametrize("profile", [False, True])
def test_there_and_back(profile):
    """Missing points stay missing; rows stay along y."""
    heights = HEIGHTS.copy()
    heights[0, 5] = np.nan
    one = surface(heights=heights[:1], size=(SIZE[1] / 16, SIZE[1])) if profile else surface(heights=heights)
    labelled = one.to_xarray()
    assert labelled.dims == (("x",) if profile else ("y", "x")) and labelled.attrs["units"] == "m"
    np.testing.assert_allclose(labelled["x"].values, np.arange(16) * 0.5e-6)
    same(as_height_map(labelled), one)
    pytest.importorskip("SurfaceTopography")
    topography = one.to_topography()
    assert topography.unit == "m" and topography.physical_sizes == ((SIZE[1],) if profile else (SIZE[1], SIZE[0]))
    if profile:
        topography = surface(
            heights=HEIGHTS[:1], size=(SIZE[1] / 16, SIZE[1])
        ).to_topography()  # it takes lines without gaps only
        same(as_height_map(topography), surface(heights=HEIGHTS[:1], size=(SIZE[1] / 16, SIZE[1])))
    else:
        same(as_height_map(topography), one)


def test_a_topography_has_x_first_and_a_unit():
    library = pytest.importorskip("SurfaceTopography")
    topography = library.Topography(HEIGHTS.T * 1e9, (8.0e3, 3.0e3), unit="nm")
    same(as_height_map(topography), surface())
    line = library.UniformLineScan(HEIGHTS[0] * 1e6, 8.0, unit="um")
    same(as_height_map(line), surface(heights=HEIGHTS[:1], size=(0.5e-6, 8e-6)))
    with refusal("scan", "unit"):
        as_height_map(library.Topography(HEIGHTS.T, (8e-6, 3e-6)))


def test_units_and_order_of_a_labelled_array():
    places = {"x": ("x", np.arange(16) * 0.5, {"units": "um"}), "y": ("y", -np.arange(12) * 250.0, {"units": "nm"})}
    array = xarray.DataArray(HEIGHTS.T * 1e9, dims=("x", "y"), coords=places, attrs={"units": "nm"})
    same(as_height_map(array), surface())
    units = pint.UnitRegistry()
    same(as_height_map(array.copy(data=units.Quantity(HEIGHTS.T * 1e9, "nm"))), surface())


def test_an_array_and_its_size():
    same(as_height_map((HEIGHTS, ("3 um", "8 um"))), surface())
    same(as_height_map((HEIGHTS, "8 um")), surface(size=(6e-6, 8e-6)))  # square pixels
    same(as_height_map([HEIGHTS[0], 8e-6]), surface(heights=HEIGHTS[:1], size=(0.5e-6, 8e-6)))
    one = surface()
    assert as_height_map(one) is one


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (HEIGHTS, "scan: 'ndarray'; allowed: a HeightMap"),
        ("scan.npy", "scan: 'str'; allowed: a HeightMap"),
        ((HEIGHTS, "8 N"), "scan.size: '8 N'"),
        ((HEIGHTS, (1e-6, 1e-6, 1e-6)), "scan.size: (1e-06, 1e-06, 1e-06)"),
        ((HEIGHTS[None], 1e-6), "scan.heights: array of shape"),
        ((HEIGHTS * 1e9, "8 um"), "scan: 'an array: peak to valley"),  # heights in nm, taken for m
        ((HEIGHTS[:4], "8 um"), "scan: an array of 4 x 16 points; allowed: at least 8"),
        ((np.ones((16, 16)), "8 um"), "scan: an array: constant heights"),
        (xarray.DataArray(HEIGHTS, dims=("y", "x")), "scan.y: not given; allowed: a coordinate"),
        (
            xarray.DataArray(HEIGHTS[0], dims="x", coords={"x": np.arange(16.0) ** 2}),
            "scan.x: steps from 1 to 29; allowed: equally spaced",
        ),
        (xarray.DataArray(HEIGHTS[0], dims="x", coords={"x": ("x", np.arange(16), {"units": "N"})}), "scan.x: 'N'"),
        (xarray.DataArray(HEIGHTS[0], dims="x", coords={"x": np.arange(16.0)}), "scan.units of x: not given"),
        (
            xarray.DataArray(HEIGHTS[0], dims="x", coords={"x": ("x", np.arange(16), {"units": "um"})}),
            "scan.units of heights: not given",
        ),
        (xarray.DataArray(HEIGHTS[None], dims=("a", "y", "x")), "scan: DataArray of shape"),
    ],
)
def test_what_is_no_map_is_one_line(given, said):
    with pytest.raises(st.InputError) as error:
        as_height_map(given)
    assert str(error.value).startswith(said)


def test_without_the_library_it_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "SurfaceTopography", None)
    with refusal("topography", "stiction[scans]"):
        surface().to_topography()
