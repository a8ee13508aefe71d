"""Shares of the variance of mu against plain Monte Carlo in two loops, on three contacts."""

from dataclasses import replace

import numpy as np
import pytest

import stiction as st
from stiction.case.read import case_in
from stiction.studies.prediction.levels import COLUMNS, Levels
from stiction.studies.prediction.mixture import Mixture
from stiction.studies.prediction.predict import draws_of, with_uncertain
from stiction.studies.prediction.sampled_case import SampledCase

ROUGH = {"asperity_height_deviation": 2e-7, "asperity_radius": 2e-5, "asperity_density": 1e10}
GROUND = {"first": {"finish": "ground"}, "second": {"finish": "polished"}}
OUTER, INNER = 400, 100
CONTACTS = {
    "metal": ({"first": "copper", "second": "copper", "roughness": ROUGH, "interface": "oxidised metal"}, 10.0),
    "polymer": ({"first": "pmma", "second": "soda_lime_glass", "roughness": GROUND, "interface": "dry polymer"}, 10.0),
    "adhesive": (
        {"first": "pdms", "second": "soda_lime_glass", "roughness": ROUGH, "interface": "elastomer", "work_of_adhesion": 0.03},
        0.1,
    ),
}


def two_loops(mixture, possible, part, rng):
    """Return the mean over all other numbers of the variance of ln mu by this part: its total index, times the variance.

    possible: rows of the inputs that can be.
    """
    rows = np.repeat(rng.choice(possible, size=OUTER), INNER)
    columns = {name: np.repeat(rng.random(OUTER), INNER) for names in COLUMNS.values() for name in names}
    if part == "inputs":
        rows = rng.choice(possible, size=OUTER * INNER)
    columns |= {name: rng.random(OUTER * INNER) for name in COLUMNS[part]}
    mu = mixture.samples(Levels(np.zeros((len(rows), 0)), columns), rows).force[:, 0]
    return np.mean(np.var(np.log(mu).reshape(OUTER, INNER), axis=1, ddof=1))


@pytest.mark.parametrize("name", CONTACTS)
def test_shares_are_those_of_two_loops(name):
    fields, load = CONTACTS[name]
    contact = st.Contact(**fields, nominal_area=1e-4)
    case = with_uncertain(replace(case_in({"contact": contact, "solve": {"load": ["1 N"]}}), load=np.array([load])))
    levels = draws_of(case)
    mixture = Mixture.of(SampledCase(case, np.array([load]), levels.inputs))
    rng = np.random.default_rng(7)
    possible = np.flatnonzero(np.isfinite(mixture.samples(levels, np.arange(len(levels))).force[:, 0]))
    variances = {part: two_loops(mixture, possible, part, rng) for part in COLUMNS}
    expected = {part: variance / sum(variances.values()) for part, variance in variances.items()}
    shares = st.predict(contact, load=load).attrs["shares"]
    found = {part: shares.get(part, 0.0) for part in COLUMNS} | {
        "inputs": sum(share for one, share in shares.items() if one not in COLUMNS)
    }
    assert found == pytest.approx(expected, abs=0.05)
    assert max(expected, key=expected.get) == max(found, key=found.get)


def test_a_contact_that_is_pressed_flat_has_no_sources_of_uncertainty():
    """Its mu is tau_0 A_n/P; only a strength of one number, known to 2.5 %, varies from sample to sample."""
    body = st.Material(youngs_modulus=629e6, poissons_ratio=0.33, hardness=60e6)
    contact = st.Contact(
        first=body, second=body, roughness={"finish": "wafer", "mean_height": 2.82e-6}, nominal_area=6.24e-5,
        interfacial_shear_strength=1.3e5, work_of_adhesion=0.386,
    )  # fmt: skip
    found = st.predict(contact, load=3116.0)
    assert float(found.friction_coefficient) == pytest.approx(1.3e5 * 6.24e-5 / 3116.0, rel=1e-3)
    assert float(found.friction_coefficient_high / found.friction_coefficient_low) == pytest.approx(1.05, rel=2e-3)
    assert found.attrs["shares"] == {} and found.attrs["next_step"] == ""
