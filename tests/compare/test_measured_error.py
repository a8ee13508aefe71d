"""The error of a model near a contact, by the set of solved surfaces: the set itself, and what is read off it."""

import csv
import json
import math
import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.stats import norm

import stiction as st
from stiction.solvers.boundary_elements import map_area as map_areas
from stiction.solvers.boundary_elements.area_estimates import map_slopes
from stiction.solvers.boundary_elements.map_area import map_area
from stiction.solvers.boundary_elements.solve import solve_map
from stiction.solving.accuracy.benchmark_set import FEATURES, benchmark_set, coded, decoded
from stiction.solving.accuracy.errors_near import LEVELS, quantiles
from stiction.solving.accuracy.measured_error import _own_error, measured_errors
from stiction.solving.choice import Choice
from stiction.solving.problem import make_problem
from stiction.surfaces.finding import asperities
from stiction.surfaces.generate import gaussian_surface, with_slope
from stiction.surfaces.height_model import roughness
from stiction.surfaces.heightmap import HeightMap
from stiction.surfaces.targets import SelfAffine

TRUTH = Path(__file__).parents[2] / "truth"
SIDE, MODULUS, SLOPE = 10e-6, 1e11, 0.05
SOFT = {"youngs_modulus": MODULUS * 0.91, "poissons_ratio": 0.3}
STIFF = {"youngs_modulus": "1e9 GPa", "poissons_ratio": 0.3, "hardness": "1e9 GPa"}


def contact(roughness, hardness=1e3, **more):
    """Hardness over E* h'."""
    soft = SOFT | {"hardness": hardness * MODULUS * SLOPE}
    given = {"work_of_adhesion": "1 uJ/m^2", "nominal_area": SIDE**2, "interfacial_shear_strength": "5 MPa"}
    return st.Contact(first=soft, second=STIFF, roughness=roughness, **given | more)


def gaussian(seed, hurst=0.8, ratio=4.0, points=256):
    """Not one of the set: other seeds, size and slope."""
    spectrum = SelfAffine(hurst=hurst, rolloff=SIDE / 32 * ratio, shortest=SIDE / 32, deviation=1e-8)
    surface = with_slope(gaussian_surface((points, points), (SIDE, SIDE), spectrum, seed=seed), SLOPE)
    return HeightMap(surface.heights, surface.size, periodic=True)


def by_numbers(surface):
    return roughness(asperities(surface, "mccool"))


def solved(surface, pressures, hardness=None):
    """Area [m2] at pressures over E* h'."""
    loads = np.array(pressures) * MODULUS * SLOPE * SIDE**2
    hard = None if hardness is None else hardness * MODULUS * SLOPE
    return loads, solve_map(
        surface.heights, surface.size, modulus=MODULUS, loads=loads, periodic=True, hardness=hard, stiffness=False
    ).array("area")


def measured(data):
    return json.loads(data.attrs["measured_error"])


def test_bytes_keep_errors_to_a_fraction():
    errors = np.array([0.0, 0.001, -0.01, 0.1, -0.7, 2.4, np.nan])
    back = decoded(coded(errors))
    assert np.isnan(back[-1]) and back[0] == 0.0
    assert back[1:-1] == pytest.approx(errors[1:-1], rel=0.1, abs=2e-3)


def test_the_set_is_what_its_design_says():
    sys.path.insert(0, str(TRUTH))
    try:
        import surfaces as design
    finally:
        sys.path.remove(str(TRUTH))
    known, every = benchmark_set(), design.surfaces()
    assert known["surfaces"].tolist() == [one.name for one in every]
    assert known["held_out"].tolist() == [one.held_out for one in every]
    assert known["loads"].tolist() == list(design.LOADS)
    at = next(number for number, one in enumerate(every) if one.kind == "skewed" and one.with_hardness)
    surface = every[at].made()
    slopes = map_slopes(surface.heights, surface.size)
    assert known.feature("alpha")[at] == pytest.approx(slopes.alpha, rel=1e-5)
    assert known.feature("top")[at] == pytest.approx(slopes.top(design.TOP), rel=1e-5)
    assert len(FEATURES) == known["features"].shape[1]
    pressures = np.array([0.02, 0.2])
    nominal = surface.size[0] * surface.size[1]
    for hardness, row in ((None, 0), (0.5, 4)):
        hard = None if hardness is None else hardness * slopes.gradient
        again = solve_map(
            surface.heights, surface.size, modulus=1.0, loads=pressures * slopes.gradient * nominal, periodic=True,
            hardness=hard, stiffness=False,
        )  # fmt: skip
        assert known.areas[at, row, [3, 6]] == pytest.approx(again.array("area") / nominal, rel=2e-3)


def test_the_set_is_small():
    from stiction.solving.accuracy.benchmark_set import FILE

    assert FILE.stat().st_size < 300_000


@pytest.mark.parametrize(
    ("model", "hardness"),
    [("greenwood_williamson_1966", None), ("persson_2001", None), ("greenwood_2006", None),
     ("kogut_etsion_2004", 0.2), ("zhao_maietta_chang_2000", 0.2), ("greenwood_williamson_1966", 0.5)],
)  # fmt: skip
def test_stated_is_what_is_found_on_other_surfaces(model, hardness):
    """Within a factor of 1.5, or two parts in a hundred, in the mean over surfaces that are not in the set."""
    stated, found = [], []
    for seed, hurst, ratio in ((9001, 0.8, 4.0), (9002, 0.5, 6.0), (9003, 0.9, 2.0)):
        surface = gaussian(seed, hurst, ratio)
        loads, areas = solved(surface, [0.03, 0.15], hardness)
        data = st.solve(contact(by_numbers(surface), hardness or 1e3), load=loads, model=model)
        stated.append(measured(data)["area"])
        found.append(data["contact_area"].values / areas - 1.0)
    stated, found = np.mean(stated, axis=0), np.mean(found, axis=0)
    assert (np.abs(stated - found) <= np.maximum(np.abs(found) / 3.0, 0.025)).all()


KINDS = (
    (lambda z: z, 1.0), (lambda z: np.exp(0.35 * z), 1.0), (lambda z: -np.exp(-0.35 * z), 1.0), (lambda z: z, 3.0),
    (lambda z: z - 0.2 * np.logaddexp(0.0, (z - 0.9) / 0.2), 1.0),
)  # fmt: skip


def test_numbers_do_not_tell_the_kind_of_a_surface():
    """Gaussian, skewed up and down, with a lay, worn: one statement for all of them, that holds for nine in ten."""
    spectrum, inside = SelfAffine(hurst=0.7, rolloff=SIDE / 8, shortest=SIDE / 24, deviation=1e-8), []
    for seed, (shape, stretch) in enumerate(KINDS, start=9020):
        z = gaussian_surface((192, 192), (SIDE, SIDE), spectrum, seed=seed, stretch=stretch).heights
        surface = with_slope(HeightMap(shape(z / z.std()) * 1e-8, (SIDE, SIDE)), SLOPE)
        loads, areas = solved(surface, [0.02, 0.1])
        data = st.solve(contact(by_numbers(surface)), load=loads, model="persson_widened")
        said, error = measured(data), data["contact_area"].values / areas - 1.0
        assert said["kind_known"] is False and min(said["surfaces"]) > 80
        inside += ((np.array(said["area_low"]) <= error) & (error <= np.array(said["area_high"]))).tolist()
        width = (1.0 + np.array(said["area_high"])) / (1.0 + np.array(said["area_low"]))
        assert (width > 2.0).all() and (width < 20.0).all()
    assert np.mean(inside) >= 0.8


def test_a_solution_has_the_error_of_its_points():
    """As areas of maps with three times as many points along a side say, by how many touch (truth/points.csv)."""
    with (Path(__file__).parents[2] / "truth" / "points.csv").open(newline="") as file:
        rows = [row for row in csv.DictReader(file) if math.isfinite(float(row["error"]))]
    points, errors = (np.array([float(row[name]) for row in rows]) for name in ("points", "error"))
    loads = np.array([0.004, 0.1]) * MODULUS * SLOPE * SIDE**2
    one = contact(gaussian(9004, points=128))
    data = st.solve(one, load=loads, model="boundary_elements")
    for touching, stated in zip(data["points_in_contact"].values, measured(data)["area_rms"], strict=True):
        alike = errors[np.abs(np.log(points / touching)) < 0.7]
        assert len(alike) > 8 and 0.5 < stated / np.sqrt(np.mean(alike**2)) < 2.0
    assert measured(data)["sample"] == [0.0, 0.0]  # one period is all there is
    own = measured(st.solve(one, load=loads, model="persson_widened"))
    assert min(own["area_rms"]) >= 0.004


def test_a_window_is_one_sample_of_its_surface():
    """As its quadrants scatter, solved one by one: standard deviation over the root of their number; more with few waves."""
    whole = gaussian(9011, points=256).heights[:128, :128]
    window = HeightMap(whole, (SIDE / 2, SIDE / 2))
    pressure = 0.05 * MODULUS * SLOPE
    one = contact(window)
    data = st.solve(one, load=pressure * SIDE**2, model="persson_widened")
    prepared = one.measured.solvable.one()
    parts = [prepared.heights[rows, columns] for rows in (slice(64), slice(64, 128)) for columns in (slice(64), slice(64, 128))]
    load = pressure * (SIDE / 4) ** 2
    alone = [
        solve_map(np.ascontiguousarray(part), (SIDE / 4, SIDE / 4), modulus=MODULUS, loads=[load], periodic=False)[0].area
        for part in parts
    ]
    waves = map_area(prepared).waves.longest_waves_on_a_side
    few_waves = 1.0 + 0.8 * (6.0 / waves - 1.0)
    assert 4.0 < waves < 6.0
    assert measured(data)["sample"] == pytest.approx([few_waves * np.std(np.log(alone), ddof=1) / 2.0], rel=0.02)
    assert "larger surface" in data.attrs["measured_error_in_words"]


@pytest.mark.parametrize(("stretch", "formula", "error"), [(1.0, "top slopes", 0.031), (4.0, "ranks", 0.06)])
def test_a_map_too_large_to_be_solved_has_the_error_of_its_formula(monkeypatch, stretch, formula, error):
    """The errors that the table of formulas in docs/explanation/truth.md prints, whatever the area."""
    monkeypatch.setattr(map_areas, "MOST_POINTS", 100)
    spectrum = SelfAffine(hurst=0.8, rolloff=SIDE / 4, shortest=SIDE / 16, deviation=1e-8)
    surface = gaussian_surface((64, 64), (SIDE, SIDE), spectrum, seed=9031, stretch=stretch)
    assert map_area(surface).way == formula
    assert _own_error(surface, np.array([0.01, 0.3])).tolist() == [error, error]


def errors_at(one, pressure, model):
    """At a pressure over E* h', however far from the set."""
    problem = make_problem(one, Choice(model))
    load = np.array([[pressure * MODULUS * SLOPE * SIDE**2 / problem.subject.scales().factors()["N"]]])
    return measured_errors(problem, problem.at_load(load))


@pytest.mark.parametrize("along", ("load", "hardness"))
def test_what_is_stated_and_how_it_is_trusted_does_not_jump(along):
    """From among the set to far below its lightest load, and from soft to elastic, in steps of 10 and 5 %."""
    rough = by_numbers(gaussian(9012, points=128))
    if along == "load":
        rows = [errors_at(contact(rough), p, "persson_widened") for p in np.geomspace(1e-10, 0.02, 200)]
    else:
        rows = [errors_at(contact(rough, hard), 0.015, "persson_widened") for hard in np.geomspace(0.025, 4.0, 104)]
    trust = np.array([row.trust[0] for row in rows])
    assert trust.max() == 1.0 and (trust.min() == 0.0) == (along == "load")
    assert np.abs(np.diff(trust)).max() < 0.1
    ends = 0.4 if along == "load" else 0.1  # far below the set they are quantiles of ever fewer surfaces
    for name, most in (("area", 0.1), ("low", ends), ("high", ends)):
        values = np.array([getattr(row, name)[0] for row in rows])
        assert (np.isfinite(values) == (trust > 0.0)).all()
        assert np.abs(np.diff(values[trust > 0.0])).max() < most


def test_friction_of_the_interface_is_off_as_the_area_and_less_where_strength_rises_with_pressure():
    one = contact(by_numbers(gaussian(9004)))
    load = 0.02 * MODULUS * SLOPE * SIDE**2
    plain = measured(st.solve(one, load=load, model="persson_2001"))
    assert plain["friction"] == plain["area"] and plain["area"][0] < -0.2
    strong = one.replace(interfacial_shear_strength=0.3 * MODULUS * SLOPE)
    assert measured(st.solve(strong.replace(first=dict(SOFT, hardness=MODULUS * SLOPE)), load=load, model="persson_2001"))[
        "friction"
    ] == [None]
    risen = one.replace(pressure_coefficient=0.2)
    data = st.solve(risen, load=load, model="persson_2001")
    mu, error = float(data["friction_coefficient"]), measured(data)["area"][0]
    assert measured(data)["friction"][0] == pytest.approx(mu / ((mu - 0.2) / (1.0 + error) + 0.2) - 1.0, rel=0.02)


@pytest.mark.parametrize(
    ("change", "pressure", "why"),
    (
        ({"work_of_adhesion": "50 J/m^2"}, 0.02, "adheres"),
        ({}, 1e-10, "the nearest has nominal pressure over E* times rms slope 0.002 instead of 1e-10"),
        ({"roughness": st.Roughness(asperity_height_deviation="1 um", asperity_radius="1 um", asperity_density="1e13 1/m^2")},
         0.02, "no solved surface is like this one: the nearest has Nayak's alpha "),
    ),
)  # fmt: skip
def test_far_from_the_set_nothing_is_stated(change, pressure, why):
    one = contact(**{"roughness": by_numbers(gaussian(9004))} | change)
    load = pressure * MODULUS * SLOPE * SIDE**2
    data = st.solve(one, load=load, model="soft_coating_2015")
    assert measured(data)["area"] in ([], [None])
    assert why in data.attrs["measured_error_in_words"]
    assert data.attrs["measured_error_in_words"].startswith("not known here")


@pytest.mark.parametrize(("pressure", "said"), ((0.02, ""), (1e-6, "slope 0.002 instead of 1e-06")))
def test_in_what_the_nearest_differs_is_said_from_a_distance_of_one_on(pressure, said):
    """A pressure of e^7.6 below the least of the set, 0.002, is at 7.6/7."""
    one = contact(by_numbers(gaussian(9004)))
    words = st.solve(one, load=pressure * MODULUS * SLOPE * SIDE**2, model="persson_2001").attrs["measured_error_in_words"]
    assert words.startswith("contact area ") and said in words and ("the nearest has" in words) == bool(said)


def test_film_like_those_of_the_set_and_another():
    rough = by_numbers(gaussian(9005, ratio=4.0))
    load = 0.02 * MODULUS * SLOPE * SIDE**2
    stiff = {"youngs_modulus": MODULUS * 0.91 * 3.0, "poissons_ratio": 0.3, "hardness": 1e3 * MODULUS}
    soft = stiff | {"hardness": 1e-3 * MODULUS}
    said = []
    for material in (stiff, soft):
        coating = st.Coating(material=material, thickness=SIDE / 32, bodies="first")
        data = st.solve(contact(rough, coating=coating), load=load, model="greenwood_williamson_1966", film="layered")
        said.append(measured(data))
    assert said[0]["area"][0] is not None and said[0]["surfaces"][0] > 0
    assert said[1]["area"] == [] and "film" in said[1]["why_not"]


@pytest.mark.parametrize(
    "model", [("greenwood_williamson_1966", "sequential"), ("greenwood_williamson_1966", "layered"), "rough_on_film"]
)
def test_a_film_without_load_has_no_measured_error_there(model):
    """State nothing where nothing presses, and elsewhere what is stated without that point."""
    body, film = ({"youngs_modulus": f"{modulus} GPa", "poissons_ratio": 0.3, "hardness": "500 GPa"} for modulus in (10, 50))
    coated = st.Contact(
        first=body,
        second=body | {"youngs_modulus": "1000 GPa"},
        coating={"material": film, "thickness": "1 um", "bodies": "first"},
        roughness={"asperity_height_deviation": "48 nm", "asperity_radius": "50 um", "asperity_density": "1.7e10 1/m^2"},
        nominal_area="1 mm^2",
        interfacial_shear_strength="10 MPa",
    )
    if model == "rough_on_film":
        chosen, both, one = {"model": model}, {"load": [1.0, 0.0]}, {"load": [1.0]}
    else:
        chosen = {"model": model[0], "film": model[1]}
        both, one = {"separation": ["50 nm", "5 um"]}, {"separation": ["50 nm"]}
    pressed, alone = (json.loads(st.solve(coated, **points, **chosen).attrs["measured_error"]) for points in (both, one))
    for name in ("area", "area_low", "area_high"):
        assert pressed[name] == [alone[name][0], None] and alone[name][0] is not None


def test_quantiles_do_not_leap_where_values_change_places():
    weights = np.array([1.0, 0.3, *[1.0] * 18])
    values = np.array([-1.0, -1.0, *np.linspace(0.0, 1.0, 18)])
    signs = np.array([1.0, -1.0, *[0.0] * 18])
    before, after = (quantiles((values + step * signs)[None], weights[None])[0] for step in (1e-9, -1e-9))
    assert after == pytest.approx(before, abs=1e-7)


def test_quantiles_of_many_values_are_those_of_the_normal_distribution():
    ranks = (np.arange(4000) + 0.5) / 4000
    assert quantiles(norm.ppf(ranks)[None], np.ones((1, 4000)))[0] == pytest.approx(norm.ppf(LEVELS), abs=0.04)
    one_heavy = np.concatenate([norm.ppf(ranks), [0.0]])
    assert quantiles(one_heavy[None], np.append(np.ones(4000), 1e9)[None])[0] == pytest.approx(np.zeros(5), abs=1e-6)


def test_a_map_of_several_bodies_has_the_errors_of_each():
    """Another modulus changes the unit of load; the error is looked up at the pressure over modulus and gradient."""
    waves = SelfAffine(0.8, 5e-6, 1.25e-6, 2e-8)
    rough = {"roughness": gaussian_surface((64, 64), (2e-5, 2e-5), waves, 1), "nominal_area": 4e-10}
    moduli, found = [30e9, 70e9, 150e9], []
    for modulus in (st.axis("youngs_modulus", moduli), *moduli):
        body = {"youngs_modulus": modulus, "poissons_ratio": 0.3, "hardness": "1 GPa"}
        contact = st.Contact(first=body, second="silicon", interfacial_shear_strength="100 MPa", **rough)
        solved = st.solve(contact, load="1 uN", model="greenwood_williamson_1966", asperity="zhao_maietta_chang_2000")
        found.append(np.ravel(json.loads(solved.attrs["measured_error"])["area"]))
    assert len(found[0]) == 3 and np.ptp(found[0]) > 0.0
    np.testing.assert_allclose(found[0], np.concatenate(found[1:]), rtol=1e-9)
