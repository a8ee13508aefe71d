"""A prediction at a single load has a curve around it, and is the prediction without the curve."""

import numpy as np
import pytest

import stiction as st
from stiction.case.read import case_in
from stiction.studies.prediction.around import predict_with_curve

STEEL = {
    "contact": {
        "first": "hardened_steel_52100", "second": "hardened_steel_52100", "interface": "oxidised metal",
        "nominal_area": "1 cm^2", "roughness": {"finish": "ground", "rms_height": "0.4 um"},
    },
    "solve": {"load": "50 N"},
}  # fmt: skip


def test_the_curve_around_a_single_load_leaves_its_prediction_as_it_is():
    case = case_in(STEEL)
    alone = st.predict(case)
    data, curve = predict_with_curve(case)
    for name in alone.data_vars:
        np.testing.assert_allclose(data[name], alone[name], rtol=1e-12, err_msg=name)
    assert data.attrs.keys() == alone.attrs.keys()
    assert data.attrs["regime"] == alone.attrs["regime"] and data.attrs["excluded"] == alone.attrs["excluded"]
    assert data.attrs["shares"] == pytest.approx(alone.attrs["shares"], rel=1e-9)
    assert curve["load"].values[[0, -1]] == pytest.approx([5.0, 500.0])
    assert curve.attrs["working_load"] == 50.0


def test_a_case_with_several_loads_is_its_own_curve():
    data, curve = predict_with_curve(case_in(STEEL | {"solve": {"load": ["10 N", "20 N"]}}))
    assert data is curve and data["load"].size == 2
