"""Validity warnings of a result: as text, as data, and of all that answers."""

import json
import math

import numpy as np
import pytest
import xarray

import stiction as st
from stiction.laws.validity import warnings_about, warnings_of, with_warnings
from stiction.records.claims import Validity
from stiction.records.validity_warning import ValidityWarning

BARE = {"theta": 100, "lam": 10}
COATED = {"theta": 100, "lam": 10, "n_E": 0.5, "n_H": 20, "tau": 2, "film_aspect": 0.3, "shear_strength": 0.05}
HALLING = {"model": "greenwood_williamson_1966", "tangential": "bowden_tabor_1943", "film": "halling_1979"}


def test_composites_chosen_by_option_answer_too():
    """Jonsson & Hogmark is claimed for films 1.8 to 12.9 times as hard as the substrate; its record says so."""
    found = st.solve(st.Indices(**COATED), separation=1, hardness="jonsson_hogmark_1984", **HALLING)
    assert "n_H" in [warning.quantity for warning in warnings_of(found)] and "hardness" in found.attrs["outside_validity"]
    assert {"jonsson_hogmark_1984", "gao_chiu_lee_1992", "halling_1979"} <= set(found.attrs["sources"].split())
    inside = st.solve(st.Indices(**COATED | {"n_H": 5}), separation=1, hardness="jonsson_hogmark_1984", **HALLING)
    assert "n_H" not in [warning.quantity for warning in warnings_of(inside)]
    other = st.solve(st.Indices(**COATED), separation=1, modulus="bec_2006", **HALLING)
    assert "bec_2006" in other.attrs["sources"].split() and "gao_chiu_lee_1992" not in other.attrs["sources"].split()


def test_a_warning_is_text_and_numbers(tmp_path):
    """The paper claims separations of -4 sigma and more; -6 is half as far again."""
    found = st.solve(st.Indices(**BARE), separation=[0.0, -5.0, -6.0])
    warning = next(one for one in warnings_of(found) if one.quantity == "mean_separation")
    assert (warning.quantity, warning.least, warning.most, warning.outside, warning.points) == (
        "mean_separation",
        -6.0,
        -5.0,
        2,
        3,
    )
    assert warning.low == -4.0 and warning.beyond == pytest.approx(0.5)
    assert str(warning) in found.attrs["outside_validity"]
    data = next(one for one in json.loads(found.attrs["validity_warnings"]) if one["quantity"] == "mean_separation")
    assert data["quantity"] == "mean_separation" and data["beyond"] == pytest.approx(0.5) and data["high"] is None
    found.to_netcdf(tmp_path / "found.nc", engine="h5netcdf")
    with xarray.open_dataset(tmp_path / "found.nc") as again:
        assert warnings_of(again) == warnings_of(found) and warning in warnings_of(again)


def test_how_far_beyond():
    assert ValidityWarning("", "theta", 2.0, 5.0, 10.0).beyond == pytest.approx(0.8)
    assert ValidityWarning("", "theta", 2.0, 5.0, high=1.0).beyond == pytest.approx(4.0)
    assert ValidityWarning("", "tau", -3.0, -1.0, 0.0).beyond == pytest.approx(3.0)
    assert ValidityWarning("words only").as_data() == {"why": "words only", "kind": "assumption"}
    with pytest.raises(ValueError, match="a warning is impossible, "):
        ValidityWarning("", kind="great")


RANGE = "no claim is made beyond"


def claim(low, high):
    """These values of theta are claimed."""
    return Validity("theta", low, high, RANGE)


def test_the_ends_of_a_range_are_inside_it():
    contact = st.Indices(theta=st.axis("theta", [9.0, 10.0, 20.0, 21.0, 25.0]), lam=10.0)
    (warning,) = warnings_about(contact, [claim(10.0, 20.0)], {})
    assert (warning.outside, warning.points, warning.least, warning.most) == (3, 5, 9.0, 25.0)
    assert not warnings_about(st.Indices(theta=10.0, lam=10.0), [claim(10.0, 20.0), claim(5.0, 10.0)], {})


def test_only_what_is_outside_is_said_to_be():
    contact = st.Indices(theta=st.axis("theta", [1.0, 15.0, 21.0, 25.0]), lam=10.0)
    (warning,) = warnings_about(contact, [claim(0.5, 20.0)], {})
    assert (warning.outside, warning.points, warning.least, warning.most) == (2, 4, 21.0, 25.0)
    assert "is 21 to 25 in 2 of 4 points, valid range 0.5 to 20" in str(warning)


def test_where_it_is_outside_is_said_of_two_points_and_not_of_one():
    for points, where in (([30.0, 15.0], "in 1 of 2 points"), ([30.0], "here")):
        contact = st.Indices(theta=st.axis("theta", points), lam=10.0)
        (warning,) = warnings_about(contact, [claim(10.0, 20.0)], {})
        assert f" is 30 {where}, valid range 10 to 20" in str(warning)


def test_how_far_beyond_is_told_of_the_worst_end():
    """10 to 20 is left on both sides: 5 is half of 10 below, 50 is 1.5 times 20 above; and the other way round."""
    assert ValidityWarning("", "theta", 5.0, 50.0, 10.0, 20.0).beyond == pytest.approx(1.5)
    assert ValidityWarning("", "theta", 1.0, 21.0, 10.0, 20.0).beyond == pytest.approx(0.9)


def test_warnings_are_added_to_those_that_a_result_has():
    found = st.solve(st.Indices(**BARE), separation=-6.0)
    own = warnings_of(found)
    more = with_warnings(found, [ValidityWarning("words only")])
    assert own and warnings_of(more) == [*own, ValidityWarning("words only")]
    assert more.attrs["outside_validity"] == f"{found.attrs['outside_validity']}; words only"


@pytest.mark.parametrize(
    ("least", "most", "low", "high"),
    [(0.4, math.inf, 0.0, 0.3), (-math.inf, -2.0, 0.0, 1.0), (math.inf, math.inf, 0.0, 0.3), (math.nan, math.nan, 0.0, 0.3),
     (3.0, 5.0, 10.0, math.inf), (1.2, 2.0, -math.inf, 1.0)],
)  # fmt: skip
def test_infinite_and_missing_ends_survive_in_a_file(tmp_path, least, most, low, high):
    """Write strict JSON, which has no infinity, and read the same warning back, also from a netCDF file."""
    warning = ValidityWarning("too steep", "rms_slope", least, most, low, high, 1, 2)
    data = with_warnings(xarray.Dataset(), [warning])

    def refuse(word):
        raise AssertionError(word)

    json.loads(data.attrs["validity_warnings"], parse_constant=refuse)
    data.to_netcdf(tmp_path / "result.nc", engine="h5netcdf")
    with xarray.open_dataset(tmp_path / "result.nc", engine="h5netcdf") as again:
        (read,) = warnings_of(again)
    assert str(read) == str(warning)
    assert np.array_equal([read.least, read.most, read.low, read.high], [least, most, low, high], equal_nan=True)


@pytest.mark.parametrize("gone", (["low", "high"], ["least", "most"], ["least", "high", "beyond"]))
def test_missing_and_open_ends_are_read_back(gone):
    """A warning with no range, with values that are infinite or no numbers, and one of which fields are left out."""
    for ends in (
        {},
        {"least": -math.inf, "most": math.inf},
        {"least": 1.0, "most": 2.0, "low": 3.0},
        {"most": 5.0, "high": 4.0},
    ):
        warning = ValidityWarning("why", "theta", **ends, outside=1, points=2)
        data = json.loads(json.dumps(warning.as_data(), allow_nan=False))
        assert repr(ValidityWarning.from_data(data)) == repr(warning) and str(warning).endswith(": why")
        left = ValidityWarning.from_data({name: value for name, value in data.items() if name not in gone})
        default = ValidityWarning("why", "theta")
        assert all(repr(getattr(left, name)) == repr(getattr(default, name)) for name in gone if name != "beyond")
        assert "theta" in str(left) or "index" in str(left)
