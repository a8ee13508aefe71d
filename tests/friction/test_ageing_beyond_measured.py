"""Time at rest beyond what anybody waited: the logarithm has a validity warning there, though it is still taken."""

import json
import math

import pytest

import stiction as st
from cases import SILICON_ON_SILICON

CONTACT = SILICON_ON_SILICON.replace(ageing_rate=0.02, reference_time="1 s", hold_time="0 s")


def solved(time: str):
    return st.solve(CONTACT.replace(hold_time=time), load="1 mN", model="greenwood_williamson_1966")


def validity_warnings(result) -> list:
    return [
        warning["most"] for warning in json.loads(result.attrs["validity_warnings"]) if warning.get("quantity") == "waiting"
    ]


@pytest.mark.parametrize("time", ["0 s", "1 h", "1 day", "99500 s"])
def test_times_that_were_measured_are_not_warned(time):
    assert validity_warnings(solved(time)) == []


def test_a_year_of_a_contact_that_begins_to_age_after_a_second_is():
    year = solved("1 year")
    assert validity_warnings(year) == [pytest.approx(365.25 * 86400)]
    ratio = float(year["friction_coefficient"] / solved("0 s")["friction_coefficient"])
    assert ratio == pytest.approx(1.0 + 0.02 * math.log(365.25 * 86400), rel=1e-9)


def test_beyond_five_decades_it_is():
    assert validity_warnings(solved("100500 s")) == [pytest.approx(100500.0)]
