"""From rest to sliding: closed forms of one asperity and of exponential heights, sums written out, and bounds."""

import math

import numpy as np
import pytest
from mpmath import mp, mpf
from numpy.testing import assert_allclose
from scipy.optimize import minimize_scalar
from scipy.special import gamma, gammainc

import stiction as st
from refusals import refusal
from stiction.contact.indices import Groups, stiffness_group
from stiction.engine.compiled import formula
from stiction.laws.joining import coordinates
from stiction.laws.presliding.mindlin_1949 import force, loss_share, slip_share, stiffness
from stiction.laws.presliding.shared.partial_slip import _slipping
from stiction.records.registry import AsperityLaw, TangentialLaw, find

PLAIN = "greenwood_williamson_1966"
COULOMB = {"model": PLAIN, "tangential": "briscoe_tabor_1978"}  # of no strength without pressure: T = f P
F, NU = 0.3, 0.3
M = 3.0 / 16.0 * F * stiffness_group(NU)  # sliding displacement over w, of Hertz's asperity


def coulomb(**more):
    return st.Indices(**{"theta": 1e3, "lam": 1e6, "nu": NU, "shear_strength": 0.0, "pressure_coefficient": F} | more)


# One asperity -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("s", "share", "lost"), [(0.1, 0.146185, 0.0005131), (0.5, 0.646447, 0.0727922), (0.9, 0.968377, 0.5239613)]
)
def test_the_table_of_the_docstring(s, share, lost):
    assert slip_share(s) == pytest.approx(share, abs=5.1e-7) and loss_share(s) == pytest.approx(lost, abs=5.1e-8)
    assert force(s * 0.25, 1.0, 1.0, 1.0 / 6.0, 8.0) * 6.0 == pytest.approx(
        share, abs=5.1e-7
    )  # slides at 3 f P beta/(16 a) = 1/4
    assert loss_share(1.0) == pytest.approx(0.8) and loss_share(3.0) == pytest.approx(0.8 + 4.0 * 2.0)


@pytest.mark.parametrize("s", ["1e-9", "0.001", "0.0999", "0.1001", "0.3", "0.77", "0.9999"])
def test_energy_of_a_cycle_of_one_asperity(s):
    """Mindlin & Deresiewicz 1953: (9 f^2 P^2 beta/(80 a)) {1 - (1-q)^(5/3) - (5/6) q [1 + (1-q)^(2/3)]} between forces
    of +-q f P with beta = 1/G*, here over f P times the sliding displacement 3 f P beta/(16 a); and Masing's loop."""
    mp.dps = 40
    s = mpf(s)
    q = 1 - (1 - s) ** mpf("1.5")
    closed = mpf(24) / 5 * (1 - (1 - q) ** (mpf(5) / 3) - mpf(5) / 6 * q * (1 + (1 - q) ** (mpf(2) / 3)))
    loop = 8 * mp.quad(lambda x: 1 - (1 - x) ** mpf("1.5"), [0, s]) - 4 * s * q
    assert float(abs(loop / closed - 1)) < 1e-9
    assert loss_share(float(s)) == pytest.approx(float(closed), rel=3e-12)
    assert slip_share(float(s)) == pytest.approx(float(q), rel=1e-14)


@formula
def half_the_load(u, w, load, area):
    return 0.5 * load, 0.0


@pytest.mark.parametrize("kept", [1.0, 0.2])
def test_one_asperity_carries_nothing_without_strength_and_what_is_kept_beyond(kept):
    """Slides at 3 T beta/(16 a), here of T = f P: (force, energy lost) at displacements below it and beyond it."""
    slipping = _slipping(half_the_load, 0)
    load, area, compliance = 0.8, 0.25, 0.3
    slides_at = 1.5 * 0.5 * load / stiffness(area, compliance)
    for s in (0.3, 2.0):
        carried, lost = slipping(1.0, 1.0, load, area, compliance, s * slides_at, kept)
        assert carried == pytest.approx(0.5 * load * (slip_share(s) if s < 1.0 else kept))
        assert lost == pytest.approx(0.5 * load * slides_at * loss_share(s))
    assert slipping(1.0, 1.0, 0.0, area, compliance, 0.1, kept) == (0.0, 0.0)
    assert slipping(1.0, 1.0, -1.0, area, compliance, 0.1, kept) == (0.0, 0.0)


# Rough surfaces ---------------------------------------------------------------------------------------------------------


def test_exponential_heights():
    """F = f P (1 - exp(-delta/m)), all that follows from it, and every one of these at any separation."""
    moved = np.array([1e-4, 0.01, 0.1, 0.3, 1.0, 4.0])
    found = st.slide(coulomb(), separation=[-0.5, 0.5, 2.5], heights="exponential", displacement=moved, **COULOMB)
    friction = F * found["load"].values[:, None]
    carried = friction * -np.expm1(-moved / M)
    assert_allclose(found["tangential_force"], carried, rtol=1e-9)
    assert_allclose(found["sticking_share"], 1.0 - carried / friction, rtol=1e-9)  # area and load in one proportion
    lost = 8.0 * friction * (moved - M * -np.expm1(-moved / M)) - 4.0 * moved * carried
    assert_allclose(found["energy_loss"][:, 1:], lost[:, 1:], rtol=1e-8)
    assert_allclose(found["energy_loss"][:, 0], friction[:, 0] * 2.0 / 3.0 * M * (moved[0] / M) ** 3, rtol=1e-3)
    assert_allclose(found["sliding_displacement"], M * math.log(100.0), rtol=1e-9)
    assert_allclose(found["tangential_stiffness"], friction[:, 0] / M, rtol=1e-10)
    assert_allclose(found["largest_tangential_force"], found["friction_force"], rtol=1e-14)
    assert_allclose(found["largest_friction_coefficient"], F, rtol=1e-10)


@pytest.mark.parametrize("heights", ["gaussian", "weibull"])
def test_any_heights_under_coulombs_law(heights):
    """Jaeger 1998: the force is f times the load less that of the surfaces delta/m farther apart."""
    chosen = st.height_distribution(heights, **({"exponent": 2.0} if heights == "weibull" else {}))
    moved = np.array([0.0, 0.003, 0.1, 0.5, 1.5])
    found = st.slide(coulomb(), separation=0.3, heights=chosen, displacement=moved, **COULOMB)
    apart = st.solve(coulomb(), separation=0.3 + moved / M, heights=chosen, **COULOMB)
    load, area = apart["load"].values, apart["contact_area"].values
    assert_allclose(found["tangential_force"], F * (load[0] - load), rtol=1e-9, atol=1e-14)
    assert_allclose(found["sticking_share"], area / area[0], rtol=1e-9)  # where the farther surfaces touch, nothing slips


def test_what_slips_does_not_stick():
    """Asperities without strength and those that slide: a contact that shear has moved far enough sticks nowhere."""
    given, laws = st.Indices(theta=200.0, lam=30.0), {"model": "chang_etsion_bogy_1988"}
    found = st.slide(given, separation=1.0, displacement=[0.0, 0.01, 100.0], residual_strength=0.5, **laws)
    share = found["sticking_share"].values
    assert 0.0 < share[1] < share[0] < 1.0 and share[2] == 0.0
    bare = st.solve(given, separation=1.0, **laws)
    assert share[0] == pytest.approx(float(bare["contact_area_elastic"] / bare["contact_area"]), rel=1e-9)


@pytest.mark.parametrize("kept", [0.0, 0.4, 0.9])
def test_where_asperities_let_go(kept):
    """Of what has slid a share is kept: incomplete gamma functions, and their largest value."""

    def carried(x):  # over f P; x = delta/m
        slid = gammainc(2.5, x)
        return kept * slid + (1.0 - slid) - math.exp(-x)

    moved = np.array([0.01, 0.1, 0.4, 0.9])
    found = st.slide(coulomb(), separation=0.5, heights="exponential", displacement=moved, residual_strength=kept, **COULOMB)
    friction = float(found["friction_force"])
    assert_allclose(found["tangential_force"] / friction, [carried(one / M) for one in moved], rtol=1e-9)
    assert gamma(2.5) * float(found["touching_asperities"]) == pytest.approx(friction / F, rel=1e-9)
    peak = minimize_scalar(lambda x: -carried(x), bounds=(0.1, 8.0), method="bounded", options={"xatol": 1e-10})
    assert float(found["largest_tangential_force"]) / friction == pytest.approx(-peak.fun, rel=1e-9)
    assert float(found["sliding_displacement"]) == pytest.approx(M * peak.x, rel=1e-5)
    assert "energy_loss" not in found and f"{kept:g} of its strength" in found.attrs["sliding"]
    assert -peak.fun < 1.0


def laws():
    for asperity, tangential in (
        ("hertz", "kogut_etsion_2003"), ("zhao_maietta_chang_2000", "tabor_1959"), ("jkr", "savkoor_briggs_1977"),
        ("brizmer_kligerman_etsion_2006", "junction_growth"), ("roy_chowdhury_ghosh_1994", "soft_coating_2015"),
    ):  # fmt: skip
        yield pytest.param(asperity, tangential, id=f"{asperity}-{tangential}")


@pytest.mark.parametrize("kept", [1.0, 0.25])
@pytest.mark.parametrize(("asperity", "tangential"), list(laws()))
def test_sums_written_out(asperity, tangential, kept):
    """Cattaneo and Mindlin's curve of every asperity with the strength of its law, by trapezoids that know no kinks."""
    given = st.Indices(theta=30.0, lam=50.0, shear_strength=0.1, nu=0.25)
    moved = np.array([0.02, 0.15, 0.6])
    found = st.slide(
        given, separation=0.4, displacement=moved, residual_strength=kept, model=PLAIN, asperity=asperity, tangential=tangential
    )
    flat, expected = Groups.of(given)[0], np.zeros(3)
    for segment in find(asperity, AsperityLaw).segments(flat, **options_of(asperity, AsperityLaw)):
        law = find(tangential, TangentialLaw).tangential_resistance(segment, flat, **options_of(tangential, TangentialLaw))
        last = float(coordinates(segment, 9.0)[0])
        if law is None or not last > segment.edges[0, 0]:
            continue
        u = np.linspace(segment.edges[0, 0], last, 40001)
        states = np.array([segment.normal(float(one), *(float(p[0]) for p in segment.parameters)) for one in u])
        parameters = [float(p[0]) for p in law.parameters]
        strength = np.array(
            [sum(law.resistance(float(at), *state[[0, 2, 3]], *parameters)) for at, state in zip(u, states, strict=True)]
        )
        dense = np.exp(-((0.4 + states[:, 0]) ** 2) / 2)
        weight = states[:, 1] * dense / math.sqrt(2 * math.pi)
        slides = 1.5 * strength * float(flat.K_beta[0]) / (8.0 * np.sqrt(states[:, 3]) + 1e-300)
        for at, one in enumerate(moved):
            s = np.minimum(one / np.maximum(slides, 1e-300), 1.0)
            carried = np.where(s < 1.0, strength * (1.0 - (1.0 - s) ** 1.5), kept * strength)
            expected[at] += np.trapezoid(carried * weight, u)
    assert_allclose(found["tangential_force"], expected, rtol=2e-4)


def options_of(key, kind):
    return {name: values[0] for name, values in find(key, kind).options.items()}


PAIRS = [
    ("hertz", "bowden_tabor_1943"), ("hertz", "kogut_etsion_2003"), ("hertz", "chang_etsion_bogy_1988"),
    ("jkr", "savkoor_briggs_1977"), ("jkr", "briscoe_tabor_1978"), ("kogut_etsion_2002", "junction_growth"),
]  # fmt: skip


@pytest.mark.parametrize(("asperity", "tangential"), PAIRS)
def test_static_friction_is_the_bound(asperity, tangential):
    """The force rises to all asperities at their strength together and never passes that, from the slope at rest."""
    given = st.Indices(theta=200.0, lam=30.0, shear_strength=0.05, pressure_coefficient=0.1)
    laws = {"model": PLAIN, "asperity": asperity, "tangential": tangential}
    found = st.slide(given, separation=[0.0, 2.0], **laws)
    static = st.solve(given, separation=[0.0, 2.0], **laws)
    assert_allclose(found["friction_force"], static["friction_force"], rtol=1e-12)
    carried = found["tangential_force"].values
    bound = static["friction_force"].values[:, None]
    assert (carried[:, 0] == 0.0).all() and (carried <= bound * (1.0 + 1e-9)).all()
    assert (np.diff(carried, axis=1) >= -1e-9 * bound).all() and (carried[:, -1] > 0.99 * bound[:, 0]).all()
    assert (np.diff(found["energy_loss"].values, axis=1) >= 0.0).all()
    little = 1e-5 * found["sliding_displacement"].values.min()
    slope = st.slide(given, separation=[0.0, 2.0], displacement=[little], **laws)["tangential_force"].values[:, 0] / little
    assert_allclose(slope, found["tangential_stiffness"], rtol=2e-3)
    fallen = st.slide(given, separation=[0.0, 2.0], residual_strength=0.0, **laws)
    assert (fallen["largest_tangential_force"].values <= bound[:, 0]).all()
    assert_allclose(fallen["tangential_force"].max("displacement"), fallen["largest_tangential_force"], rtol=0.01)
    assert (fallen["tangential_force"].max("displacement") <= fallen["largest_tangential_force"] * (1 + 1e-9)).all()


def test_asperities_without_strength_do_not_stiffen():
    """After Chang, Etsion and Bogy nothing beyond first yield resists: less stiff than all that touch."""
    given, laws = st.Indices(theta=200.0, lam=30.0), {"model": "chang_etsion_bogy_1988"}
    found = st.slide(given, separation=1.0, **laws)
    every = st.solve(given, separation=1.0, presliding="mindlin_1949", **laws)["tangential_stiffness"]
    assert 0.0 < float(found["tangential_stiffness"]) < 0.8 * float(every)
    assert np.isfinite(found["energy_loss"]).all() and float(found["energy_loss"][-1]) > 0.0
    filled = st.slide(given.with_changes(shear_strength=0.1), separation=1.0, plastic_junctions="tabor_1959", **laws)
    assert_allclose(filled["tangential_stiffness"], every, rtol=1e-9)


# Units, dimensions, refusals ---------------------------------------------------------------------------------------------

SURFACE = st.Roughness(asperity_height_deviation="48 nm", asperity_radius="50 um", asperity_density="1.7e10 1/m^2")
STEEL = {"first": "hardened_steel_52100", "second": "hardened_steel_52100", "roughness": SURFACE, "nominal_area": "1 mm^2",
         "interfacial_shear_strength": "100 MPa", "work_of_adhesion": "0.1 J/m^2"}  # fmt: skip
INTERFACE = {"model": PLAIN, "tangential": "bowden_tabor_1943"}


def test_in_newtons_metres_and_joules():
    """The lost energy is that of the curve in its own units, and the curve that of the groups."""
    moved = np.linspace(0.0, 6e-9, 2001)
    found = st.slide(st.Contact(**STEEL), load=["0.1 N", "1 N"], displacement=moved, **INTERFACE)
    assert [found[name].attrs["units"] for name in ("tangential_force", "displacement", "energy_loss")] == ["N", "m", "J"]
    carried = found["tangential_force"].values
    assert_allclose(found["load"], [0.1, 1.0])
    assert (carried[:, -1] <= found["friction_force"].values).all()
    loop = 8.0 * np.trapezoid(carried, moved, axis=1) - 4.0 * moved[-1] * carried[:, -1]
    assert_allclose(found["energy_loss"][:, -1], loop, rtol=1e-5)
    assert {"mindlin_1949", "bowden_tabor_1943"} <= set(found.attrs["sources"].split())
    text = st.slide(st.Contact(**STEEL), load="1 N", displacement="6 nm", **INTERFACE)
    assert float(text["tangential_force"]) == pytest.approx(carried[1, -1], rel=1e-12)


@pytest.mark.parametrize("deviation", ["10 nm", "48 nm", "300 nm"])
def test_default_displacements_end_beyond_the_farthest_sliding(deviation):
    """Half as far again as where the last of the contacts slides, in metres, so that the whole curve is seen."""
    rough = SURFACE.replace(asperity_height_deviation=deviation)
    found = st.slide(st.Contact(**STEEL | {"roughness": rough}), load=["0.1 N", "1 N"], **INTERFACE)
    moved, slides_at = found["displacement"].values, found["sliding_displacement"].values
    assert_allclose(moved, np.linspace(0.0, 1.5 * slides_at.max(), 61), rtol=1e-14)
    # metres: Coulomb's asperity slides at a share of how far it is pressed in, which is less than a few deviations
    assert 0.0 < slides_at.max() < 5.0 * float(deviation.split()[0]) * 1e-9
    assert_allclose(found["tangential_force"].max("displacement"), found["largest_tangential_force"], rtol=0.02)


def test_several_contacts_at_several_loads():
    strengths = st.axis("interfacial_shear_strength", ["50 MPa", "100 MPa", "200 MPa"])
    contact = st.Contact(**STEEL | {"interfacial_shear_strength": strengths})
    found = st.slide(contact, load=["0.1 N", "1 N"], displacement=["1 nm", "5 nm"], **INTERFACE)
    assert found["tangential_force"].dims == ("interfacial_shear_strength", "load", "displacement")
    one = st.slide(st.Contact(**STEEL), load="1 N", displacement="5 nm", **INTERFACE)
    assert float(found["tangential_force"][1, 1, 1]) == pytest.approx(float(one["tangential_force"]), rel=1e-10)
    assert float(found["sliding_displacement"][1, 1]) == pytest.approx(float(one["sliding_displacement"]), rel=1e-9)


@pytest.mark.parametrize(
    ("change", "laws", "why"),
    [
        ({"coating": st.Coating(material="silver", thickness="200 nm")}, {"film": "sequential"}, ("contact",)),
        ({}, {"model": "persson_2001"}, ("presliding",)),
        ({}, {"tangential": "none"}, ("tangential",)),
        ({}, {"model": "soft_coating_2015", "tangential": None, "variant": "published"}, ("variant",)),
        ({}, {"residual_strength": 1.5}, ("residual_strength", "0", "1")),
        ({}, {"residual_strength": math.nan}, ("residual_strength", "0", "1")),
        ({}, {"displacement": "-1 nm"}, ("displacement", ">= 0")),
        ({}, {"displacement": []}, ("displacement",)),
        ({}, {"separation": "48 nm"}, ("separation and load",)),
        ({"interfacial_shear_strength": 0.0}, {}, ("displacement",)),
    ],
)
def test_refused_in_one_line(change, laws, why):
    with refusal(*why) as caught:
        st.slide(st.Contact(**STEEL | change), **{"load": "1 N"} | INTERFACE | laws)
    assert "\n" not in str(caught.value)


def test_a_displacement_of_groups_is_not_negative():
    with refusal("displacement", "0"):
        st.slide(coulomb(), separation=1.0, displacement=[0.1, -0.1], **COULOMB)


def test_without_friction_the_curve_is_nothing():
    contact = st.Contact(**STEEL | {"interfacial_shear_strength": 0.0})
    found = st.slide(contact, load="1 N", displacement=["0 nm", "5 nm"], **INTERFACE)
    assert (found["tangential_force"] == 0.0).all() and (found["energy_loss"] == 0.0).all()
    assert np.isnan(found["sliding_displacement"]) and found["largest_tangential_force"] == 0.0


def test_without_adhesion_spots_that_yield_answer():
    bare = st.Contact(
        first="copper",
        second="copper",
        interfacial_shear_strength="50 MPa",
        nominal_area="1 cm^2",
        roughness={"asperity_height_deviation": "0.2 um", "asperity_radius": "20 um", "asperity_density": "1e10 1/m^2"},
    )
    moved = st.slide(bare, load="10 N", displacement=["0 nm", "5 nm"])
    named = st.slide(
        bare,
        load="10 N",
        displacement=["0 nm", "5 nm"],
        model="greenwood_williamson_1966",
        asperity="zhao_maietta_chang_2000",
    )
    np.testing.assert_array_equal(moved.tangential_force, named.tangential_force)
