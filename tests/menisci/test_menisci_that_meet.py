"""When menisci of neighbours meet: the wetted area, summed here over all that are bridged, be they in contact or not."""

import json
import math

import pytest
from scipy.integrate import quad

import stiction as st
from refusals import refusal

SIGMA, RADIUS, DENSITY = 1e-8, 1e-6, 1e13
SURFACE = st.Roughness(asperity_height_deviation=SIGMA, asperity_radius=RADIUS, asperity_density=DENSITY)
DRY = st.Contact(
    first="silicon", second="silicon", roughness=SURFACE, nominal_area="0.01 mm^2", interfacial_shear_strength="100 MPa"
)


def humid(humidity: float) -> st.Liquid:
    return st.Liquid(relative_humidity=humidity, contact_angle_first="10 deg", contact_angle_second="10 deg")


def warned(result, quantity: str) -> float | None:
    """The value that has a validity warning, None without one."""
    found = [warning for warning in json.loads(result.attrs["validity_warnings"]) if warning.get("quantity") == quantity]
    return found[0]["most"] if found else None


def wetted(liquid: st.Liquid, separation: float) -> float:
    """Share of the nominal area under liquid: a ring of 2 pi R times the gap that is still bridged, of a sphere that is cut off
    or does not touch, over Gaussian heights."""

    def ring(z):
        bridged = liquid.height + min(z * SIGMA - separation, 0.0)
        return 2.0 * math.pi * RADIUS * bridged * math.exp(-0.5 * z * z) / math.sqrt(2.0 * math.pi)

    first, touching = (separation - liquid.height) / SIGMA, separation / SIGMA
    return DENSITY * sum(quad(ring, *ends, epsabs=0.0, epsrel=1e-12)[0] for ends in ((first, touching), (touching, 12.0)))


@pytest.mark.parametrize("humidity", [0.97, 0.98, 0.99])
def test_liquid_that_would_cover_the_surface_has_a_warning(humidity):
    """Few asperities touch, and most of them are bridged: what touches says nothing of the wetted area."""
    liquid = humid(humidity)
    result = st.solve(DRY.replace(liquid=liquid), separation=2.5 * SIGMA, model="greenwood_williamson_1966")
    expected = wetted(liquid, 2.5 * SIGMA)
    assert expected > 0.3 and float(result["touching_asperities"]) < 0.01 * DENSITY * 1e-8
    assert warned(result, "meniscus_coverage") == pytest.approx(expected, rel=1e-9)


def test_a_little_liquid_is_not():
    liquid = humid(0.9)
    result = st.solve(DRY.replace(liquid=liquid), separation=2.5 * SIGMA, model="greenwood_williamson_1966")
    assert wetted(liquid, 2.5 * SIGMA) < 0.05 and warned(result, "meniscus_coverage") is None


def test_elastic_rings_count_at_least_where_they_touch():
    """Their pull in contact is less than Laplace's pressure on the ring: all that touch count with the whole ring."""
    liquid = humid(0.95)
    rough = DRY.replace(roughness=SURFACE.replace(asperity_density=1e14), liquid=liquid)
    result = st.solve(rough, separation=-3 * SIGMA, model="greenwood_williamson_1966", meniscus="hertzian_meniscus")
    touching = float(result["touching_asperities"]) / 1e-8
    assert warned(result, "meniscus_coverage") >= 2.0 * math.pi * RADIUS * liquid.height * touching * (1 - 1e-9)


@pytest.mark.parametrize("law", ["equilibrium_meniscus", "hertzian_meniscus"])
def test_a_law_of_menisci_asks_a_dry_contact_for_its_liquid(law):
    with refusal("liquid", law):
        st.solve(DRY, load="1 mN", model="greenwood_williamson_1966", meniscus=law)
