"""Menisci: Kelvin's radius, the pull of one asperity, and what it adds to a rough surface."""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy import constants
from scipy.integrate import quad

import stiction as st
from refusals import refusal
from stiction.engine.heights import gaussian, height_distribution
from stiction.engine.summation import on_grid, scattered
from stiction.laws.joining import states
from stiction.laws.meniscus import equilibrium_meniscus, hertzian_meniscus
from stiction.laws.meniscus.kind import Meniscus
from stiction.quantities.errors import InputError
from stiction.records.registry import (
    AsperityLaw,
    FilmLaw,
    RoughSurface,
    TangentialLaw,
    friction_incompatibility,
    incompatibility,
    of_kind,
)
from stiction.solving.choice import Choice
from stiction.solving.problem import problem_of
from tables import column, columns_of_groups, groups, random_groups, random_others, read

PLAIN = "greenwood_williamson_1966"
MENISCI = list(of_kind(Meniscus).values())
BRIEF = {"relative_humidity": 0.5, "contact_angle_first": 0.0, "contact_angle_second": 0.0}


def at(regimes, w):
    """Load (n,) of one meniscus at displacements w (n,), one for each law."""
    found = np.zeros(len(w))
    for regime in regimes:
        first, last = regime.edges[:, 0], regime.edges[:, -1]
        one = _coordinates(regime, w)
        state = states(regime, np.clip(one, first, last))
        here = np.isclose(state[:, 0], w, rtol=1e-9, atol=1e-15)
        found[here] = state[here, 2]
    return found


def _coordinates(regime, w):
    inverse = getattr(regime.coordinate, "py_func", regime.coordinate)
    return np.array([inverse(one, *(value[i] for value in regime.parameters)) for i, one in enumerate(w)])


@pytest.mark.parametrize("law", MENISCI, ids=lambda law: law.key)
def test_one_meniscus(law):
    """From afar to deep contact: energy of the ring, differentiated; 1e-9 is what that is good to."""
    rows = [row for row in read(f"{law.key}.csv") if row["w"]]
    given = groups(**columns_of_groups(rows))
    assert_allclose(at(law.pull(given), column(rows, "w")), column(rows, "load"), rtol=1e-9, atol=1e-12)


def test_sums_over_heights():
    rows = [row for row in read("equilibrium_meniscus.csv") if row["h"]]
    regimes = equilibrium_meniscus.pull(groups(**columns_of_groups(rows)))
    found = scattered(regimes, column(rows, "h"), gaussian()).sum(axis=0)
    assert_allclose(found[:, 1], column(rows, "load_sum"), rtol=1e-11)
    assert (found[:, 2:] == 0.0).all()


@pytest.mark.parametrize("law", MENISCI, ids=lambda law: law.key)
def test_sums_of_every_law(law):
    """Against an independent integral over displacements; on the grid the same as one by one."""
    given = groups(meniscus_index=[2.0, 30.0], meniscus_height=[0.01, 0.7])
    regimes, h = law.pull(given), np.linspace(-2.0, 5.0, 4001)
    table = on_grid(regimes, h, gaussian()).sum(axis=0)[:, 1]
    for i, height in enumerate(given.meniscus_height):

        def pulled(w, h, i=i):
            return at([replace_row(one, i) for one in regimes], np.array([w]))[0] * np.exp(-((h + w) ** 2) / 2)

        for k in (0, 2000, 4000):
            places = [-height, 0.0, height / 10, height, 4 * height, 9.0]
            pieces = [quad(pulled, *ends, args=(h[k],), epsrel=1e-11, epsabs=0)[0] for ends in itertools.pairwise(places)]
            assert_allclose(table[i, k], sum(pieces) / np.sqrt(2 * np.pi), rtol=1e-8)


def replace_row(regime, i):
    return replace(regime, parameters=tuple(one[i : i + 1] for one in regime.parameters), edges=regime.edges[i : i + 1])


def test_exact_menisci():
    """Orr, Scriven & Rivas: the circle approximation is off by a share of the root of height over radius, which vanishes."""
    rows = read("exact_menisci.csv")
    height, gap, exact = (column(rows, name) for name in ("height", "gap", "force"))
    given = groups(meniscus_index=2.0 * np.pi * np.ones(len(rows)), meniscus_height=0.3)
    ours = -at(equilibrium_meniscus.pull(given), -0.3 * gap)
    off = (ours - exact) / np.sqrt(height)
    assert (off > 0.2).all() and (off < 0.7).all()
    within = height <= 0.01  # what the record claims
    assert (ours / exact - 1.0)[within & (gap == 0.0)].max() < 0.05


def test_work_of_parting_in_equilibrium():
    """De Boer and de Boer: half of the surface energy 2 gamma_L c on the area 2 pi R 2 r c that is created."""
    given = groups(meniscus_index=5.0, meniscus_height=0.2)
    work = quad(lambda w: -at(equilibrium_meniscus.pull(given), np.array([w]))[0], -0.2, 0.0)[0]
    assert_allclose(work, 0.5 * (2.0 * np.pi / 5.0) * 0.2, rtol=1e-10)


def test_the_ring_pulls_half_where_it_is_narrow():
    """DMT's force as the derivative of an energy, -W d(pi a^2)/dw."""
    given = groups(meniscus_index=1.0, meniscus_height=1e-9)
    narrow = at(hertzian_meniscus.pull(given), np.array([1.0]))[0]
    assert_allclose(narrow, -np.pi, rtol=1e-3)
    assert_allclose(at(hertzian_meniscus.pull(given), np.array([0.0]))[0], -2.0 * np.pi, rtol=1e-12)


def test_kelvin_radius():
    """Water: the surface tension that IAPWS tabulates (mN/m), and the radius with constants of another source."""
    for celsius, tension in ((0.01, 75.65), (20, 72.74), (25, 71.97), (50, 67.94), (100, 58.91)):
        liquid = st.Liquid(**BRIEF, temperature=f"{celsius} degC")
        assert_allclose(liquid.tension, tension * 1e-3, atol=6e-6)
        radius = tension * 1e-3 * 18.05e-6 / (constants.R * (celsius + 273.15) * np.log(2.0))
        assert_allclose(liquid.kelvin_radius, radius, rtol=2e-4)
    other = st.Liquid(**BRIEF, surface_tension="25 mN/m", molar_volume="108 cm^3/mol", temperature="293.15 K")
    assert_allclose(other.kelvin_radius, 25e-3 * 108e-6 / (constants.R * 293.15 * np.log(2.0)), rtol=1e-12)


@pytest.mark.parametrize(
    ("changes", "field"),
    [
        ({"relative_humidity": 1.0}, "relative_humidity"),
        ({"relative_humidity": "120 %"}, "relative_humidity"),
        ({"contact_angle_second": "180 deg"}, "contact_angle_second"),
        ({"contact_angle_first": "100 deg", "contact_angle_second": "85 deg"}, "contact_angle_first"),
        ({"temperature": "0 K"}, "temperature"),
        ({"temperature": "70 degF"}, "temperature"),
        ({"temperature": "700 K"}, "surface_tension"),
    ],
)
def test_refusals(changes, field):
    with pytest.raises(InputError) as caught:
        st.Liquid(**BRIEF | changes)
    assert caught.value.field == field and "\n" not in str(caught.value)


def draw(n, coated=False, seed=3):
    rng = np.random.default_rng(seed)
    menisci = {"meniscus_index": 10.0 ** rng.uniform(-1, 4, n), "meniscus_height": 10.0 ** rng.uniform(-2, 1, n)}
    return groups(**random_others(rng, n), **random_groups(rng, n, coated), **menisci)


def added(choice, given, heights, law):
    """Results with a liquid and without at the same separations; refused laws skipped."""
    h = np.linspace(-1.0, 4.0, 6)
    wet = problem_of(given, replace(choice, beside={"meniscus": law.key}), heights).on_grid(h)
    dry = problem_of(given, replace(choice, beside={"meniscus": "none"}), heights).on_grid(h)
    alone = on_grid(law.pull(given), h, heights or gaussian()).sum(axis=0)[:, 1]
    laplace = 1.0 / (given.roughness_parameter * given.meniscus_height * given.meniscus_index)  # gamma A_n/r per asperity
    free = np.clip(1.0 - math.pi * given.roughness_parameter[:, None] * dry["contact_area"], 0.0, 1.0)  # of solids, over A_n
    alone = np.maximum(alone, -laplace[:, None] * free)
    return wet, dry, alone


def check(choice, given, law, heights=None):
    """Compare the load with that of the solids and of the menisci, at most Laplace's pressure where the solids do not touch;
    friction and area with those of the solids."""
    wet, dry, alone = added(choice, given, heights, law)
    assert_allclose(wet["load_meniscus"], alone, rtol=1e-10)
    assert (alone <= 0.0).all() and alone.min() < 0.0
    size = np.abs(dry["load"]) + np.abs(alone)
    assert (np.abs(wet["load"] - (dry["load"] + alone)) <= 1e-9 * size).all()
    assert_allclose(wet["contact_area"], dry["contact_area"], rtol=1e-12)
    assert_allclose(wet["touching_asperities"], dry["touching_asperities"], rtol=1e-12)
    if "friction_force" in dry:
        assert_allclose(wet["friction_force"], dry["friction_force"], rtol=1e-12)
        pressed = wet["load"] > 0.0
        ratio = wet["friction_force"][pressed] / wet["load"][pressed]
        assert_allclose(wet["friction_coefficient"][pressed], ratio, rtol=1e-12)
        assert np.isnan(wet["friction_coefficient"][~pressed]).all()


@pytest.mark.parametrize("asperity", of_kind(AsperityLaw).values(), ids=lambda one: one.key)
@pytest.mark.parametrize("law", MENISCI, ids=lambda law: law.key)
def test_any_asperity_law(law, asperity):
    """Goes with it, or is refused with the reason that the records give."""
    choice, given = Choice(PLAIN, asperity=asperity.key, tangential="bowden_tabor_1943"), draw(12)
    reason = incompatibility(law, asperity)
    if not reason:
        return check(choice, given, law)
    with refusal("asperity"):
        problem_of(given, replace(choice, beside={"meniscus": law.key}))


@pytest.mark.parametrize("tangential", of_kind(TangentialLaw).values(), ids=lambda one: one.key)
def test_any_tangential_law(tangential):
    asperity = next((one for one in of_kind(AsperityLaw).values() if not incompatibility(tangential, one)), None)
    if asperity is None or tangential.layered:
        pytest.skip("goes with a film only")
    check(Choice(PLAIN, asperity=asperity.key, tangential=tangential.key), draw(12), MENISCI[0])


@pytest.mark.parametrize("film", of_kind(FilmLaw).values(), ids=lambda one: one.key)
def test_any_film(film):
    interface = of_kind(TangentialLaw)["bowden_tabor_1943"]
    if not film.interchangeable or friction_incompatibility(film, interface):
        pytest.skip("it brings its own friction, or belongs to one variant of its model")
    asperity = film.asperity or next(key for key, one in of_kind(AsperityLaw).items() if not incompatibility(film, one))
    check(Choice(PLAIN, asperity=asperity, tangential="bowden_tabor_1943", film=film.key), draw(8, coated=True), MENISCI[0])


HEIGHTS = {"exponential": {}, "weibull": {"exponent": 3.4}, "empirical": {"samples": list(np.linspace(-1.0, 1.4, 25) ** 3)}}


@pytest.mark.parametrize("key", HEIGHTS)
def test_any_heights(key):
    heights = height_distribution(key, **HEIGHTS[key])
    check(Choice(PLAIN, tangential="bowden_tabor_1943"), draw(6), MENISCI[0], heights)


@pytest.mark.parametrize("record", [one for one in of_kind(RoughSurface).values() if not one.asperity], ids=lambda one: one.key)
def test_theories_without_asperities_refuse(record):
    if record.on_film:
        pytest.skip("a bare contact has no film")
    with refusal("meniscus"):
        problem_of(draw(2), Choice(record.key, beside={"meniscus": "equilibrium_meniscus"}))


SURFACE = st.Roughness(asperity_height_deviation="10 nm", asperity_radius="1 um", asperity_density="1e13 1/m^2")
MEMS = st.Contact(
    first="silicon", second="silicon", roughness=SURFACE, nominal_area="0.01 mm^2", interfacial_shear_strength="100 MPa"
)


def humid(**changes):
    return MEMS.replace(liquid=BRIEF | changes)


def test_a_contact_in_humid_air():
    """A liquid that is stated counts; pull-off and friction grow with humidity, and a dry contact is what it was."""
    humidity = st.axis("relative_humidity", [0.3, 0.6, 0.8, 0.9, 0.95, 0.98])
    found = st.solve(humid(relative_humidity=humidity), load="1 mN", model=PLAIN)
    mu, pull = found["friction_coefficient"].values, found["pull_off_force"].values
    dry = st.solve(MEMS, load="1 mN", model=PLAIN)
    assert (np.diff(mu) > 0.0).all() and mu[0] > float(dry["friction_coefficient"])
    assert (np.diff(pull) >= 0.0).all() and pull[-1] > 1e-3
    without = st.solve(humid(), load="1 mN", model=PLAIN, meniscus="none")
    assert float(without["friction_coefficient"]) == float(dry["friction_coefficient"])
    assert "load_meniscus" not in without and "liquid" in without.attrs["inputs_not_used"]
    assert "Kelvin" in found.attrs["outside_validity"]


@pytest.mark.parametrize(
    ("changes", "radius", "warned"),
    [
        ({"relative_humidity": 0.86}, 3.57e-9, True),
        ({"relative_humidity": 0.91}, 5.71e-9, True),
        ({"relative_humidity": 0.96}, 13.2e-9, False),
        ({"relative_humidity": 0.91, "surface_tension": "72.74 mN/m", "molar_volume": "18.05 cm^3/mol"}, 5.71e-9, False),
        ({"relative_humidity": 0.86, "surface_tension": "72.74 mN/m", "molar_volume": "18.05 cm^3/mol"}, 3.57e-9, True),
    ],
)
def test_menisci_smaller_than_those_that_were_confirmed_have_a_warning(changes, radius, warned):
    """gamma V/(R T) of water at 20 C is 0.5387 nm, over ln(p_s/p). Water was measured down to 9 nm, other liquids to 4 nm."""
    found = st.solve(humid(**changes), load="1 mN", model=PLAIN)
    assert_allclose(humid(**changes).kelvin_radius, radius, rtol=2e-3)
    assert ("Kelvin's equation was confirmed" in found.attrs["outside_validity"]) == warned


@pytest.mark.parametrize("law", [one.key for one in MENISCI])
@pytest.mark.parametrize("heights", [None, height_distribution("weibull", exponent=3.4)], ids=("gaussian", "weibull"))
def test_the_largest_tension(law, heights):
    """The pull-off force is the least load over a fine way of approach, and loads are found behind it."""
    given = st.Indices(hardness_group=2.0, meniscus_index=3.0, meniscus_height=0.2)
    h = np.linspace(8.0, -3.0, 22001)
    way = st.solve(given, separation=h, model=PLAIN, meniscus=law, heights=heights)
    least = -float(way["load"].min())
    assert least > 1e-3
    assert_allclose(float(way["pull_off_force"]), least, rtol=1e-6)
    back = st.solve(given, load=[-0.5 * least, 1e-3, 0.1], model=PLAIN, meniscus=law, heights=heights)
    assert (np.abs(back["load_residual"].values) < 1e-9).all()
    assert (np.diff(back["mean_separation"].values) < 0.0).all()


def test_units_scale():
    """Dimensional pull of many wetted asperities that all touch: 4 pi R gamma_L c each."""
    few = humid(relative_humidity=0.9).replace(roughness=SURFACE.replace(asperity_density="1e11 1/m^2"))
    found = st.solve(few, separation="-60 nm", model=PLAIN, tangential="none")
    number = 1e11 * 1e-8
    tension = 72.74e-3
    assert_allclose(float(found["load_meniscus"]), -number * 4 * np.pi * 1e-6 * tension, rtol=1e-4)


def test_what_it_does_not_know():
    with refusal("contact"):
        st.unload(humid(), max_load="1 mN", separation_increase="1 nm", model=PLAIN)
    closed = st.solve(humid(), load="1 mN", model="persson_2001")
    assert "liquid" in closed.attrs["inputs_not_used"]


def test_groups_go_together():
    with pytest.raises(InputError) as caught:
        st.Indices(theta=10, lam=10, meniscus_index=3.0)
    assert caught.value.field == "meniscus_height"


def test_case_file(tmp_path):
    case = {
        "contact": {
            "first": "silicon",
            "second": "silicon",
            "nominal_area": "0.01 mm^2",
            "interfacial_shear_strength": "100 MPa",
            "roughness": {
                "asperity_height_deviation": "10 nm",
                "asperity_radius": "1 um",
                "asperity_density": "1e13 1/m^2",
            },
            "liquid": {
                "relative_humidity": [0.5, 0.9],
                "contact_angle_first": "0 deg",
                "contact_angle_second": "0 deg",
                "temperature": "20 degC",
            },
        },
        "solve": {"load": "1 mN", "model": PLAIN},
    }
    from stiction.case.read import parse_case
    from stiction.studies.case_results import solve_case

    parsed = parse_case(case)
    found = solve_case(parsed, parsed.choice)
    direct = st.solve(humid(relative_humidity=0.9), load="1 mN", model=PLAIN)
    assert_allclose(found["friction_coefficient"].values.ravel()[-1], float(direct["friction_coefficient"]), rtol=1e-12)
