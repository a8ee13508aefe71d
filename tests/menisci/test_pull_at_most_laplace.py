"""Bound the pull of a liquid between two faces by Laplace's pressure where they do not touch, however many menisci count."""

import numpy as np
import pytest

import stiction as st
from cases import SILICON_ON_SILICON

PLAIN = "greenwood_williamson_1966"
AREA = 1e-8


def humid(humidity, **changes):
    angles = {"contact_angle_first": "10 deg", "contact_angle_second": "10 deg"}
    return SILICON_ON_SILICON.replace(liquid=st.Liquid(relative_humidity=humidity, temperature="20 degC", **angles), **changes)


def laplace(humidity):
    """gamma A_n/r with gamma of IAPWS at 20 C, r = gamma V/(R_g T ln(p_s/p)): so gamma cancels."""
    return 8.314462618 * 293.15 * -np.log(humidity) / 18.05e-6 * AREA


def free_share(result):
    """The share of the nominal area where the solids do not touch."""
    return 1.0 - result["contact_area"].values / AREA


@pytest.mark.parametrize("law", ["equilibrium_meniscus", "hertzian_meniscus"])
@pytest.mark.parametrize("humidity", [0.98, 0.99])
def test_menisci_that_meet_pull_with_laplace_pressure_where_the_solids_do_not_touch(humidity, law):
    """As if each were alone they would pull twice as much. At 4 N a tenth of the area touches."""
    most = laplace(humidity)
    result = st.solve(humid(humidity), load=["0.1 mN", "1 mN", "30 mN", "4 N"], model=PLAIN, meniscus=law)
    assert -result["load_meniscus"].values == pytest.approx(most * free_share(result), rel=1e-9)
    assert result["load"].values == pytest.approx([1e-4, 1e-3, 3e-2, 4.0], rel=1e-9)
    assert free_share(result)[-1] < 0.93
    assert 0.9 * most < float(result["pull_off_force"].max()) <= most * (1.0 + 1e-9)


def test_the_solids_carry_what_the_dry_contact_carries_under_load_and_suction():
    wet = st.solve(humid(0.98), load="1 mN", model=PLAIN)
    dry = st.solve(SILICON_ON_SILICON, load=1e-3 + laplace(0.98) * float(free_share(wet)), model=PLAIN)
    assert float(wet["friction_force"]) == pytest.approx(float(dry["friction_force"]), rel=1e-9)
    assert float(wet["mean_separation"]) == pytest.approx(float(dry["mean_separation"]), rel=1e-9)


def test_at_separations_too():
    result = st.solve(humid(0.98), separation=np.linspace(-1.0, 4.0, 7) * 1e-8, model=PLAIN)
    pull, most = -result["load_meniscus"].values, laplace(0.98) * np.clip(free_share(result), 0.0, 1.0)
    assert (pull <= most * (1.0 + 1e-9)).all()
    assert pull[0] == pytest.approx(most[0], rel=1e-9) and pull[-1] < 0.9 * pull.max()
