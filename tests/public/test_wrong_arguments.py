"""Public functions refuse arguments of wrong types and shapes in one line that names the argument; found by `make fuzz`."""

import math
from decimal import Decimal

import numpy as np
import pytest
import xarray

import stiction as st

MAP = st.HeightMap(np.random.default_rng(1).normal(0.0, 1e-8, (16, 16)), (1e-5, 1e-5))
CASE = {"indices": {"theta": 40, "lam": 10}, "solve": {"separation": [0.5]}}
SPECTRUM = {"hurst": 0.8, "rolloff": "2 um", "shortest": "1.5 um", "deviation": "10 nm"}
ARRAY = np.ones((2, 3))
DATASET = xarray.Dataset({"load": 1.0})


def _made(**moments):
    return st.non_gaussian_surface((16, 16), (1e-5, 1e-5), st.SelfAffine(**SPECTRUM), 1, **moments)


@pytest.mark.parametrize(
    ("field", "call"),
    [
        ("scan", lambda: st.asperities("1 nm")),
        ("scan", lambda: st.prepared(b"x")),
        ("scan", lambda: st.analyse([])),
        ("form", lambda: st.prepared(MAP, form=5)),
        ("form", lambda: st.prepared(MAP, form=True)),
        ("fill", lambda: st.prepared(MAP, fill=[])),
        ("methods", lambda: st.resolution_study(MAP, methods=ARRAY)),
        ("choice", lambda: st.resolution_study(MAP, choice=ARRAY)),
        ("choice", lambda: st.solve_case(CASE, choice=math.nan)),
        ("choice", lambda: st.solve_case(CASE, choice=0)),
        ("choice", lambda: st.slide_case(CASE, choice=ARRAY)),
        ("result", lambda: st.summary(1.5)),
        ("names", lambda: st.interfaces(math.inf)),
        ("keys", lambda: st.models(np.array("x"))),
        ("first.surface_energy", lambda: st.work_of_adhesion({1: 2}, "silver", interfacial=0.0)),
        ("material", lambda: st.material(ARRAY)),
        ("output", lambda: st.predict_value(ARRAY)),
        ("level", lambda: st.predict(CASE, level=np.array([]))),
        ("height_distribution", lambda: st.height_distribution({})),
        ("hurst", lambda: st.SelfAffine(**SPECTRUM | {"hurst": ARRAY})),
        ("dimensions", lambda: st.SelfAffine(**SPECTRUM, dimensions=[])),
        ("skewness", lambda: _made(skewness="1 nm", kurtosis=3.0)),
        ("kurtosis", lambda: _made(skewness=0.5, kurtosis=10**400)),
        ("shape", lambda: st.gaussian_surface(16, (1e-5, 1e-5), st.SelfAffine(**SPECTRUM), 1)),
        ("spectrum", lambda: st.gaussian_surface((16, 16), (1e-5, 1e-5), "flat", 1)),
        ("heights", lambda: st.HeightMap([[1.0], [1.0, 2.0]], (1e-5, 1e-5))),
        ("heights", lambda: st.HeightMap(DATASET, (1e-5, 1e-5))),
        ("keys", lambda: st.models([["jkr"]])),
        ("what", lambda: st.cite([["hertz_1882"]])),
        ("what", lambda: st.cite(1.0)),
        ("what", lambda: st.cite(xarray.DataArray([1.0]))),
        ("scans", lambda: st.combined_spectrum(np.float64(1.0))),
        ("load", lambda: st.axis("load", DATASET)),
        ("dimension", lambda: st.axis("load", [1.0], np.ones(2))),
        ("youngs_modulus", lambda: st.Material(youngs_modulus=DATASET, poissons_ratio=0.3, hardness="1 GPa")),
        ("height_distribution.exponent", lambda: st.height_distribution("weibull", exponent=Decimal("nan"))),
    ],
)
def test_a_wrong_argument_is_named_in_one_line(field, call):
    with pytest.raises(st.InputError) as error:
        call()
    assert error.value.field == field and len(str(error.value).splitlines()) == 1


def test_a_map_as_an_xarray_is_prepared_and_searched_as_the_map_itself():
    labelled = MAP.to_xarray()
    np.testing.assert_array_equal(st.prepared(labelled).heights, st.prepared(MAP).heights)
    assert st.asperities(labelled).radius == pytest.approx(st.asperities(MAP).radius, rel=1e-9)
