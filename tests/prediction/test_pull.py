"""The pull of adhesion, against maps solved with adhesion."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest

import stiction as st


def script():
    path = Path(__file__).parents[2] / "validation" / "adhesion.py"
    spec = importlib.util.spec_from_file_location("adhesion", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("ratio", [20.0, 7.0, 3.0, 1.0])
def test_adhesion_raises_the_area_as_on_a_solved_map(ratio):
    """From light adhesion to faces that jump into contact; the sum over asperities alone has 6 where the map has 40."""
    solved, predicted = script().rises(4, 5e-6, ratio, points=128)
    assert np.log(predicted) == pytest.approx(np.log(solved), rel=0.35)
    assert np.log(predicted).mean() == pytest.approx(
        np.log(solved).mean(), rel=0.25
    )  # two standard deviations of validation/adhesion.py


def test_the_energy_of_a_wave_is_that_of_a_sine():
    """E* q h^2/8 for the amplitude h (Johnson 1985: work of pressing a sine flat), and the slope q h/sqrt(2)."""
    q, amplitude = 2.0 * np.pi * 3.0 / 10e-6, 50e-9
    heights = amplitude * np.sin(q * np.arange(64) * 10e-6 / 64) * np.ones((64, 1))
    energy, slope = script().energy_and_slope(heights, 10e-6)
    assert energy == pytest.approx(2e6 / (1 - 0.49**2) * q * amplitude**2 / 8.0, rel=1e-9)
    assert slope == pytest.approx(q * amplitude / 2**0.5, rel=1e-9)


def test_the_area_of_a_sticky_contact_grows_with_the_load():
    """As the load vanishes, adhesion alone presses the surfaces together, and the area tends to a constant."""
    sticky = st.Contact(
        first="natural_rubber", second="soda_lime_glass", roughness={"finish": "moulded", "rms_height": "0.5 um"},
        work_of_adhesion="30 mJ/m^2", interfacial_shear_strength="20 kPa", nominal_area="1 cm^2",
    )  # fmt: skip
    area = st.predict(sticky, load=np.geomspace(1e-4, 10.0, 16)).contact_area.values
    assert (np.diff(area) > -0.01 * area[:-1]).all() and area[3] < 1.5 * area[0]
