"""Films with a plastic asperity of their own: limits, trends that the abstracts state, and the pressure integrated anew."""

import itertools
import json
import math
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq
from typer.testing import CliRunner

import stiction as st
from refusals import outside, refusal
from stiction import cli
from stiction.contact.indices import Groups
from stiction.engine import heights, summation
from stiction.engine.regime import columns
from stiction.laws import joining as law
from stiction.laws.asperity import hertz
from stiction.laws.film import dayson_1971, kato_1981, ravindran_ramasamy_laddha_1980
from stiction.laws.tangential import bowden_tabor_1943, briscoe_tabor_1978
from stiction.solving.choice import Choice
from stiction.solving.problem import problem_of
from tables import assert_near, groups

INTERFACE = law.Law(hertz.RECORD, bowden_tabor_1943.RECORD)
LOAD, AREA, FRICTION = 1, 2, 3
ETA_ONE = {"theta": 1e3, "lam": 1e6 / (18 * math.pi**2)}  # theta^2 = 18 pi^2 lam: eta = 1


def dayson(given, pressure="film_hardness", shared=INTERFACE):
    return dayson_1971.regimes(given, shared, pressure)


def kato(given):
    return kato_1981.regimes(given, INTERFACE)


def ravindran(given):
    return ravindran_ramasamy_laddha_1980.regimes(given, INTERFACE)


FILMS = {"dayson": dayson, "kato": kato, "ravindran": ravindran}


def total(regimes, h):
    """Count, load, area and friction (n, 4) of all regimes at the separations h."""
    return summation.scattered(regimes, np.broadcast_to(h, len(regimes[0].edges)), heights.gaussian()).sum(axis=0)


def one_asperity(regimes, w):
    """Load, area and friction (n, 3) of one asperity at the displacements w (n,), of all regimes that it is in."""
    found = np.zeros((len(w), 3))
    for regime in regimes:
        rows = columns(regime.parameters, len(w))
        ends = np.broadcast_to(regime.edges[:, [0, -1]], (len(w), 2))
        for at, (depth_there, row, (first, last)) in enumerate(zip(w, rows, ends, strict=True)):
            u = regime.coordinate(float(depth_there), *row)
            there, _, load, area, slip_limited, yield_limited = (
                regime.along(u, *row) if first <= u < last else np.full(6, np.nan)
            )
            if abs(there - depth_there) <= 1e-11 * depth_there:  # a coordinate ends at that of the nearest depth
                found[at] += load, area, slip_limited + yield_limited
    return found


def coefficient(regimes, h):
    sums = total(regimes, h)
    return sums[:, FRICTION] / sums[:, LOAD]


def depth(h):
    """Mean depth of Gaussian heights beyond h."""
    return math.exp(-h * h / 2) / math.sqrt(2 * math.pi) - h * math.erfc(h / math.sqrt(2)) / 2


@pytest.mark.parametrize("film", FILMS)
def test_no_thickness_leaves_the_plastic_substrate_and_a_thick_film_is_alone(film):
    """P = 2 eta F(h) times 1 or n_H; mu is tau_0/H, or that over n_H; of Dayson's, no film leaves the bare metal's friction."""
    h, given = 0.4, {**ETA_ONE, "n_E": 0.3, "n_H": 0.2, "shear_strength": 0.05}
    thin, thick = (FILMS[film](groups(**given, tau=tau, film_aspect=0.1 * tau)) for tau in (0.0, 1e12))
    bare = 1 / (math.sqrt(3) * 2.8) if film == "dayson" else 0.05
    assert total(thin, h)[0, [LOAD, AREA]] == pytest.approx([2 * depth(h), 2 * depth(h)], rel=1e-10)
    assert coefficient(thin, h) == pytest.approx(bare, rel=1e-10)
    assert total(thick, h)[0, [LOAD, AREA]] == pytest.approx([0.4 * depth(h), 2 * depth(h)], rel=1e-6)
    assert coefficient(thick, h) == pytest.approx(0.25, rel=1e-6)


@pytest.mark.parametrize("film", FILMS)
def test_a_film_as_hard_as_its_substrate_is_not_felt_in_load(film):
    given = groups(
        theta=100.0, lam=30.0, n_E=1.0, n_H=1.0, tau=[0.1, 1.0, 5.0], film_aspect=[0.01, 0.1, 0.5], shear_strength=0.1
    )
    assert_near(total(FILMS[film](given), 0.7)[:, LOAD], given.eta * 2 * depth(0.7), 1e-10)


@pytest.mark.parametrize("film", FILMS)
def test_load_grows_without_a_jump_over_all_depths(film):
    """Over random groups, five decades of depth, and at the places where one segment gives way to the next."""
    rng, n = np.random.default_rng(3), 1000
    tau = 10.0 ** rng.uniform(-3, 3, n)
    given = groups(
        theta=10.0 ** rng.uniform(0, 6, n), lam=10.0 ** rng.uniform(-3, 6, n), hardness_to_yield=rng.uniform(1.5, 4, n),
        n_E=1.0, n_H=10.0 ** rng.uniform(-2.5, 0.5, n), tau=tau, film_aspect=tau * 10.0 ** rng.uniform(-3, 0, n),
        shear_strength=10.0 ** rng.uniform(-3, -0.5, n), film_friction_constant=10.0 ** rng.uniform(-4, 1, n),
    )  # fmt: skip
    regimes = FILMS[film](given)
    w = tau * 10.0 ** rng.uniform(-3, 2, n)
    near, far = one_asperity(regimes, w), one_asperity(regimes, w * 1.001)
    assert np.isfinite(near).all() and (near > 0.0).all()
    assert (far[:, 0] > near[:, 0]).all()
    hardness = near[:, 0] / near[:, 1] / given.eta
    assert (hardness <= np.maximum(given.n_H, 1.0) * (1 + 1e-12)).all()
    assert (hardness >= np.minimum(given.n_H, 1.0) * (1 - 1e-12)).all()
    for regime in regimes:
        for end in (regime.edges[:, 0], regime.edges[:, -1]):
            inside = np.isfinite(end) & (regime.edges[:, -1] > regime.edges[:, 0])
            at = law.states(regime, np.where(inside, end, 1.0))[:, 0]
            inside &= at > 1e-6
            before, after = (one_asperity(regimes, np.where(inside, at * side, w))[:, 0] for side in (1 - 1e-9, 1 + 1e-9))
            steepest = 2e-8 / np.minimum(given.n_H, 1.0)[inside]  # where the substrate takes over from a film that soft
            assert (np.abs(after - before)[inside] <= steepest * before[inside]).all()


def test_daysons_film_is_penetrated_more_as_it_gets_thinner():
    """mu = tau_0/H + (1/(sqrt(3) k) - tau_0/H) F(h + tau)/F(h) where the substrate carries the load; friction rises as the film
    gets thinner, also where the film is at its own hardness, if it is weak enough; a metal film that shears at its own yield
    stress in shear leaves friction as it is."""
    tau, h, metal = np.array([0.02, 0.1, 0.5, 1.0, 3.0]), 1.2, 1 / (math.sqrt(3) * 2.8)
    weak = groups(theta=100.0, lam=10.0, n_E=1.0, n_H=0.3, tau=tau, shear_strength=0.02)
    found = coefficient(dayson(weak, "substrate_hardness"), h)
    expected = [0.02 + (metal - 0.02) * depth(h + one) / depth(h) for one in tau]
    assert found == pytest.approx(expected, rel=1e-10)
    assert (np.diff(found) < 0.0).all()
    assert (np.diff(coefficient(dayson(weak), h)) < 0.0).all()
    assert coefficient(dayson(weak.with_changes(shear_strength=0.3 * metal * np.ones(5))), h) == pytest.approx(metal, rel=1e-10)


def contact(sigma="48 nm", thickness="50 nm", **more):
    coating = {"material": {"preset": "silver", "hardness": "0.4 GPa"}, "thickness": thickness, "bodies": "first"}
    steel = {"preset": "hardened_steel_52100", "hardness": "2 GPa"}
    return st.Contact(
        first=steel, second=steel,
        roughness={"asperity_height_deviation": sigma, "asperity_radius": "50 um", "asperity_density": 1.7e10},
        work_of_adhesion=0.05, nominal_area="1 mm^2", interfacial_shear_strength="20 MPa", coating=coating | more,
    )  # fmt: skip


def at_loads(subject, film, load=(0.03, 1.0, 20.0), **options):
    return st.solve(
        subject, load=list(load), model="greenwood_williamson_1966", tangential="bowden_tabor_1943", film=film, **options
    )


@pytest.mark.parametrize("pressure", dayson_1971.RIM_PRESSURE)
def test_daysons_friction_rises_with_roughness(pressure):
    """The abstract's experiments: films of several thicknesses on surfaces of several roughnesses. At the same load."""
    mu = np.array(
        [
            [
                float(at_loads(contact(sigma, t), "dayson_1971", [5.0], rim_pressure=pressure)["friction_coefficient"][0])
                for t in ("5 nm", "20 nm", "80 nm")
            ]
            for sigma in ("20 nm", "50 nm", "200 nm")
        ]
    )
    assert (np.diff(mu, axis=0) > 0.0).all() and (np.diff(mu, axis=1) < 0.0).all()


def test_daysons_bared_metal_shears_at_its_own_strength():
    """Whatever the law of the interface; and without a tangential law nothing shears."""
    given = groups(theta=100.0, lam=10.0, n_E=1.0, n_H=0.3, tau=0.4, shear_strength=0.02, pressure_coefficient=0.1)
    film, rim, metal = dayson(given, shared=law.Law(hertz.RECORD, briscoe_tabor_1978.RECORD))
    strength = given.eta / (math.sqrt(3) * 2.8)
    assert_near(total([metal], 1.0)[:, FRICTION], strength * 2 * depth(1.4), 1e-10)
    of_film = total([film, rim], 1.0)
    assert_near(of_film[:, FRICTION], 0.02 * given.eta * of_film[:, AREA] + 0.1 * of_film[:, LOAD], 1e-10)
    assert total(dayson(given, shared=law.Law(hertz.RECORD)), 1.0)[0, FRICTION] == 0.0


def test_ravindrans_powers_of_thickness_and_load():
    """One asperity: mu = (C t/W)^(1/3) to rounding, between the bounds; 0.62996 tau_0/H_f at W = 8 pi R H_f t."""
    C, n_H, s = 0.02, 0.1, 0.01
    tau = np.array([0.2, 0.2, 3.0, 3.0])
    given = groups(theta=100.0, lam=10.0, n_E=1.0, n_H=n_H, tau=tau, shear_strength=s, film_friction_constant=C)
    q = math.sqrt(2 * given.eta[0] * s**3 / C) / n_H
    load, _, friction = one_asperity(ravindran(given), tau / q**2 * np.array([2.0, 60.0, 5.0, 90.0])).T
    assert friction / load == pytest.approx((C * tau / load) ** (1 / 3), rel=1e-12)
    load, _, friction = one_asperity(ravindran(given), tau / q**2 * np.array([0.01, 0.99, 101.0, 1e5])).T
    assert friction / load == pytest.approx([s / n_H, s / n_H, s, s], rel=1e-12)
    calibrated = given.with_changes(film_friction_constant=None)
    load, _, friction = one_asperity(ravindran(calibrated), 4 ** (2 / 3) * tau).T
    assert load == pytest.approx(8 * given.eta * n_H * tau, rel=1e-12)  # 8 pi R H_f t over the units of load
    assert friction / load == pytest.approx(0.62996 * s / n_H, rel=1e-5)


def test_ravindrans_constant_in_si_units():
    """mu = (C t/W)^(1/3) in newtons and metres, of one asperity of a contact; and the constant that it is calibrated to."""
    for C in (None, 3.0):
        subject = contact(**({} if C is None else {"friction_constant": f"{C} N/m"}))
        given, _ = Groups.of(subject.indices())
        R, t, H_f, tau_0 = 50e-6, 50e-9, 0.4e9, 20e6
        C = 2 * math.pi * R * tau_0**3 / H_f**2 if C is None else C
        first = given.tau / ravindran_ramasamy_laddha_1980.rise(given) ** 2
        load, _, friction = one_asperity(ravindran(given), 5.0 * first)[0]
        newtons = load * float(subject.scales().load)
        assert friction / load == pytest.approx((C * t / newtons) ** (1 / 3), rel=1e-10)


def test_ravindrans_friction_falls_with_load_and_rises_with_thickness():
    mu = np.array(
        [at_loads(contact(thickness=t), "ravindran_ramasamy_laddha_1980")["friction_coefficient"] for t in (2e-8, 1e-7)]
    )
    assert (np.diff(mu, axis=1) < 0.0).all() and (np.diff(mu, axis=0) > 0.0).all()
    assert (mu < 20e6 / 0.4e9).all() and (mu > 20e6 / 2e9).all()


def test_what_ravindran_needs_is_asked_for_by_name():
    given = groups(n_E=1.0, n_H=0.5, tau=1.0)
    with refusal("shear_strength", "ravindran_ramasamy_laddha_1980"):
        problem_of(given, Choice("greenwood_williamson_1966", film="ravindran_ramasamy_laddha_1980"))
    with refusal("coating.friction_constant", "-1 N/m", "> 0 N/m"):
        contact(friction_constant="-1 N/m")
    with refusal("n_E", "n_H", "tau", "film_friction_constant"):
        st.Indices(theta=10.0, lam=1.0, film_friction_constant=0.1)


def pressure_at(r, w, tau, hill, edge):
    """dp/dr = -2 k/s from the edge inward, numerically; lengths over sqrt(R sigma), s = tau - w + r^2/2 over sigma."""
    return edge + quad(lambda x: 0.5 * hill / (tau - w + x * x / 2), r, math.sqrt(2 * w), epsabs=0, epsrel=1e-11, limit=400)[0]


@pytest.mark.parametrize(
    ("tau", "aspect", "n_H", "k"), [(2.0, 0.3, 0.2, 2.8), (0.5, 0.02, 0.1, 3.0), (1.0, 0.5, 0.9, 2.0), (1e-3, 1e-5, 0.05, 2.8)]
)
@pytest.mark.parametrize("depth_over_thickness", [0.02, 0.3, 0.7, 0.97, 1.03, 1.5, 20.0])
def test_katos_load_is_the_integral_of_its_pressure(tau, aspect, n_H, k, depth_over_thickness):
    given = groups(**ETA_ONE, hardness_to_yield=k, n_E=1.0, n_H=n_H, tau=tau, film_aspect=aspect, shear_strength=0.1)
    w = depth_over_thickness * tau
    hill, a = 4 * n_H / (math.sqrt(3) * k) * tau / aspect, math.sqrt(2 * w)
    middle = math.sqrt(2 * (w - tau)) if w > tau else 0.0  # where a rigid substrate would be met
    beyond = lambda r: pressure_at(r, w, tau, hill, n_H) - 1  # noqa: E731
    parts = (0.25**number for number in range(14)) if w > tau else (0.0,)  # not too near to where the pressure has no bound
    inner = next((r for r in (middle + part * (a - middle) for part in parts) if beyond(r) > 0), None)
    c = 0.0 if inner is None else brentq(beyond, inner, a, xtol=1e-14)
    expected = c * c + quad(lambda r: 2 * r * pressure_at(r, w, tau, hill, n_H), c, a, epsabs=0, epsrel=1e-9, limit=400)[0]
    load, area, friction = one_asperity(kato(given), [w])[0]
    assert given.eta[0] == pytest.approx(1.0, rel=1e-14)
    assert load == pytest.approx(expected, rel=1e-8)
    assert area == pytest.approx(2 * w, rel=1e-12) and friction == pytest.approx(0.2 * w, rel=1e-12)


def test_katos_shallow_contact_is_the_disc_between_rough_plates():
    """Mean pressure H_f + 2 k_f a/(3 t) of a gap of one height, as of a disc that is upset with sticking friction."""
    n_H, tau, aspect, w = 0.2, 4.0, 0.02, 4e-4
    given = groups(**ETA_ONE, n_E=1.0, n_H=n_H, tau=tau, film_aspect=aspect, shear_strength=0.1)
    load, area, _ = one_asperity(kato(given), [w])[0]
    k_f, a_over_t = n_H / (math.sqrt(3) * 2.8), math.sqrt(2 * w) / aspect
    assert load / area - n_H == pytest.approx(2 / 3 * k_f * a_over_t, rel=2e-4)


def test_what_katos_abstracts_say():
    """mu falls with load, because the pressure in the middle is many times that at the edge; film thickness, film hardness and
    radius count: a thinner or a harder film lowers mu, a blunter ball, which leaves a wider gap, raises it. Lengths are in
    sigma, loads in pi sigma H."""
    w = np.geomspace(1e-5, 300.0, 600)

    def friction(load, t, R, n_H=0.1):
        each = np.ones(w.size)
        given = groups(
            **ETA_ONE, n_E=1.0, n_H=n_H * each, tau=t * each, film_aspect=t / math.sqrt(R) * each, shear_strength=0.01
        )
        P, _, T = one_asperity(kato(given), w).T
        return np.interp(np.log(load / R), np.log(P), T / P)

    loads = np.array([1e2, 1e3, 1e4, 1e5])
    mu = np.array([friction(loads, t, 1e4) for t in (0.5, 1.0, 2.0)])
    assert (np.diff(mu, axis=1) < 0.0).all() and (np.diff(mu, axis=0) > 0.0).all()
    assert ((mu > 0.01) & (mu < 0.1)).all() and mu.max() > 4.0 * mu.min()
    assert (np.diff([friction(loads, 1.0, R) for R in (3e3, 1e4, 3e4)], axis=0) > 0.0).all()
    assert (np.diff([friction(loads, 1.0, 1e4, n) for n in (0.05, 0.1, 0.2)], axis=0) < 0.0).all()
    hill = 4 * 0.1 / (math.sqrt(3) * 2.8) * 1e2
    assert pressure_at(0.0, 0.5, 1.0, hill, 0.1) > 10 * 0.1


@pytest.mark.parametrize("film", ["dayson_1971", "kato_1981", "ravindran_ramasamy_laddha_1980"])
def test_they_answer_at_loads_and_in_comparisons(film):
    found = at_loads(contact(), film)
    assert found["load"].values == pytest.approx([0.03, 1.0, 20.0])
    assert ((found["friction_coefficient"] > 0.005) & (found["friction_coefficient"] < 0.25)).all()
    assert st.models([film])[0]["grade"] == "C" and "@article" in st.cite(found)
    beside = st.compare(contact(), load="1 N", separations=[1.0])
    assert float(beside["friction_coefficient_at_load"].sel(model=film)) == pytest.approx(
        float(found["friction_coefficient"][1])
    )


CASE = """
[contact]
first = "hardened_steel_52100"
second = "hardened_steel_52100"
work_of_adhesion = "50 mJ/m^2"
nominal_area = "1 mm^2"
interfacial_shear_strength = "20 MPa"
roughness = {asperity_height_deviation = "48 nm", asperity_radius = "50 um", asperity_density = "1.7e10 1/m^2"}
coating = {material = "silver", thickness = "50 nm", bodies = "first", friction_constant = "FRICTION_CONSTANT"}
[solve]
model = "greenwood_williamson_1966"
tangential = "bowden_tabor_1943"
load = ["0.1 N", "1 N"]
"""


def test_they_are_run_from_a_case_file(tmp_path: Path):
    """With their options, and the constant of Ravindran's film; mu of that grows with it."""
    mu = {}
    for constant, words in itertools.product(
        ("1 N/m", "3 N/m"),
        (
            ("dayson_1971",),
            ("dayson_1971", "--rim-pressure", "substrate_hardness"),
            ("kato_1981",),
            ("ravindran_ramasamy_laddha_1980",),
        ),
    ):
        path = tmp_path / "case.toml"
        path.write_text(CASE.replace("FRICTION_CONSTANT", constant))
        done = CliRunner().invoke(cli.app, ["run", str(path), "--json", "--film", *words])
        assert (done.exit_code, done.stderr) == (0, "")
        mu[constant, words] = np.array(json.loads(done.stdout)["variables"]["friction_coefficient"]["values"])
    for (constant, words), found in mu.items():
        more = found / mu["1 N/m", words] - 1.0
        assert (more > 0.1).all() if constant == "3 N/m" and words[0].startswith("ravindran") else (more == 0.0).all()
    assert (mu["1 N/m", ("dayson_1971",)] > mu["1 N/m", ("dayson_1971", "--rim-pressure", "substrate_hardness")]).all()


def test_what_leaves_their_validity_is_said():
    """A film that is hard, on both bodies; asperities that are not plastic; a contact narrower than the film is thick."""
    films = ("dayson_1971", "kato_1981", "ravindran_ramasamy_laddha_1980")
    for film in films:
        assert not {"n_H", "load_share_beyond_film"} & outside(at_loads(contact(), film, [20.0]))
    hard = contact(thickness="2 um", material={"preset": "silver", "hardness": "9 GPa"}, bodies="both")
    for film in films:
        assert "n_H" in outside(at_loads(hard, film, [1.0]))
    smooth = contact(sigma="1 nm", thickness="2 um")
    for film in films[::2]:
        assert "film_plasticity_index" in outside(at_loads(smooth, film, [1.0]))
    assert "load_share_beyond_film" in outside(at_loads(smooth, "kato_1981", [1e-3]))


@pytest.mark.parametrize(("film", "options"), [("kato_1981", {}), ("dayson_1971", {"rim_pressure": "substrate_hardness"})])
def test_a_film_that_is_confined_may_bear_more_than_its_hardness(film, options):
    """The mean pressure is well above the hardness of a film that bears most of the load: no validity warning."""
    steel = {"first": "hardened_steel_52100", "second": "hardened_steel_52100"}
    thick = st.Contact(**(contact(thickness="200 nm").model_dump() | steel))
    found = at_loads(thick, film, [0.3], **options)
    assert float(found["load_film"][0]) > 0.5 * 0.3
    assert float(found["load"][0] / found["contact_area"][0]) > 1.5 * 0.4e9
    assert "mean_pressure_over_hardness" not in found.attrs["validity_warnings"]
