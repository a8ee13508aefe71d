"""Several scans of one surface as one spectrum, against the closed form of the spectrum they were made from."""

import numpy as np
import pytest

import stiction as st
from stiction.quantities.errors import InputError

TARGET = st.SelfAffine(0.8, "8 um", "100 nm", "10 nm")


def spectrum(q):
    return TARGET(q)  # without SelfAffine's check that a map resolves the shortest wave: scans do not


@pytest.fixture(scope="module")
def scans():
    coarse = st.gaussian_surface((512, 512), ("100 um", "100 um"), spectrum, seed=0)
    wide = st.gaussian_surface((1024, 1024), ("24 um", "24 um"), spectrum, seed=10)
    return coarse, st.HeightMap(wide.heights[:256, :256], (6e-6, 6e-6))  # a window: not periodic


def test_two_scans_give_back_the_spectrum_of_their_surface(scans):
    combined = st.combined_spectrum(scans)
    solid = combined.wavevector < 2 * np.pi / 105e-9  # the surface ends at 100 nm
    ratio = combined.density[solid] / TARGET(combined.wavevector[solid])
    assert 2 * np.pi / combined.wavevector[0] > 30e-6 and 2 * np.pi / combined.wavevector[-1] < 100e-9
    assert abs(np.log(ratio)).mean() < 0.15 and 1.0 < combined.disagreement < 2.0
    for name, accuracy in (("m0", 0.12), ("m2", 0.05), ("m4", 0.12)):  # of waves from a third of the larger size
        assert getattr(combined.moments, name) == pytest.approx(getattr(TARGET.moments, name), rel=accuracy)


def test_a_surface_is_made_from_the_combined_spectrum(scans):
    combined = st.combined_spectrum(scans)
    made = st.gaussian_surface((1024, 1024), ("40 um", "40 um"), combined, seed=1, random_amplitudes=False)
    slope_x, slope_y = (np.gradient(made.heights, 40e-6 / 1024, axis=axis) for axis in (1, 0))
    fine = TARGET.rms_slope * np.sinc(2 * 40 / 1024 / 0.1)  # differences see the shortest waves too small, by no more than this
    assert fine < np.sqrt((slope_x**2 + slope_y**2).mean()) < 1.03 * TARGET.rms_slope


def test_a_scan_with_wrong_heights_is_seen(scans):
    coarse, fine = scans
    wrong = st.HeightMap(1.5 * fine.heights, fine.size)
    assert st.combined_spectrum([coarse, wrong]).disagreement > 1.7 > st.combined_spectrum(scans).disagreement


def test_a_profile_has_a_spectrum_of_one_dimension():
    target = st.SelfAffine(0.8, "8 um", "400 nm", "10 nm", dimensions=1)
    line = st.gaussian_surface((1, 2**16), ("1 um", "3 mm"), target, seed=1)
    combined = st.combined_spectrum([line])
    assert combined.moments.m2 == pytest.approx(target.moments.m2, rel=0.05)
    assert combined.disagreement == 1.0


def test_the_tip_limits_the_short_waves(scans):
    shortest = [2 * np.pi / st.combined_spectrum(scans, tip).wavevector[-1] for tip in (None, "20 um")]
    assert shortest[0] < 0.11e-6 < 0.2e-6 < shortest[1]


@pytest.mark.parametrize(
    ("chosen", "field"),
    [
        (lambda coarse, fine: [], "scans"),
        (lambda coarse, fine: [coarse, st.HeightMap(fine.heights[:1], fine.size)], "scans"),
        (lambda coarse, fine: [coarse, st.HeightMap(fine.heights[:32, :32], (0.1e-6, 0.1e-6))], "scans"),  # a gap
        (
            lambda coarse, fine: [coarse, st.HeightMap(np.where(fine.heights > 2e-8, np.nan, fine.heights), fine.size)],
            "scans[1].heights",
        ),
    ],
)
def test_scans_that_do_not_fit_together_are_refused(scans, chosen, field):
    with pytest.raises(InputError) as error:
        st.combined_spectrum(chosen(*scans))
    assert error.value.field == field
