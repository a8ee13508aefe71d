"""The contact of a map as a model: in `solve`, `compare`, case files and commands, against closed forms and the solver."""

import json
import math
from contextlib import suppress
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from typer.testing import CliRunner

import stiction as st
from refusals import refusal
from stiction import cli
from stiction.laws.validity import read_warnings, warnings_of
from stiction.records.registry import RoughSurface, of_kind
from stiction.solvers.boundary_elements import cache
from stiction.solvers.boundary_elements.adhesive import solve_adhesive
from stiction.solvers.boundary_elements.bodies import Bodies
from stiction.solvers.boundary_elements.compliance import Compliance, Film
from stiction.solvers.boundary_elements.curve import curve_of_map
from stiction.solvers.boundary_elements.listeners import listening
from stiction.solvers.boundary_elements.solve import solve_map
from stiction.solving.choice import Choice
from stiction.surfaces.filters import filter_period
from stiction.surfaces.generate import gaussian_surface
from stiction.surfaces.heightmap import HeightMap
from stiction.surfaces.prepare import level
from stiction.surfaces.targets import SelfAffine
from tables import read

SIDE, POINTS = 20e-6, 64
BODIES = {
    "first": "hardened_steel_52100",
    "second": st.material("silver", hardness=251e6),
    "interfacial_shear_strength": 20e6,
}
ELASTIC = {"youngs_modulus": 2e9, "poissons_ratio": 0.4, "hardness": 1e12}
FILM = {"youngs_modulus": 4e9, "poissons_ratio": 0.3, "hardness": 1e12}
MODEL = "boundary_elements"


@pytest.fixture(autouse=True)
def own_cache(monkeypatch, tmp_path):
    """Nothing that was solved before is read, and nothing is left behind."""
    monkeypatch.setattr(cache, "cache_folder", lambda name: tmp_path / "kept")
    with np.errstate(all="ignore"):  # matplotlib divides zero by zero inside
        yield


@pytest.fixture(scope="module")
def rough() -> HeightMap:
    return gaussian_surface((POINTS, POINTS), (SIDE, SIDE), SelfAffine(0.8, SIDE / 4, SIDE / 8, 4e-8), 3)


@pytest.fixture
def contact(rough):
    return st.Contact(**BODIES, roughness=rough, nominal_area=3.0 * SIDE**2)


def area(contact):
    return float(st.solve(contact, load="1 mN", model=MODEL)["area_fraction"])


def elastic(rough, **more):
    return st.Contact(first=ELASTIC, second=ELASTIC, roughness=rough, nominal_area=SIDE**2, **more)


def test_a_wave_in_one_direction_is_westergaards():
    """By the curve that the model solves; a profile has no asperities, so that no contact has this roughness."""
    points, bodies = 512, Bodies(1e9)
    heights = 1e-8 * np.cos(2.0 * math.pi * np.arange(points) / points) * np.ones((4, 1))
    surface = HeightMap(heights, (SIDE * 4 / points, SIDE), periodic=True)
    rows = [{name: float(value) for name, value in row.items()} for row in read("boundary_elements.csv")]
    whole = math.pi * 1e9 * 1e-8 / SIDE
    curve = curve_of_map(surface, bodies, [row["share"] * whole for row in rows])
    for one, row in zip(curve.contacts, rows, strict=True):
        assert one.area_pixels / one.nominal_area == pytest.approx(row["area"], abs=2.0 / points)
        assert one.pressure.max() == pytest.approx(row["largest"] * whole, rel=1e-3)


def test_waves_in_full_contact_have_their_mean_planes_on_each_other():
    """Crossed cosines of amplitude a are pressed flat by p = E* k a (Johnson, section 13.2), and touch less by less."""
    along = 1e-8 * np.cos(4.0 * math.pi * np.arange(64) / 64.0)
    surface = HeightMap(along[:, None] + along, (SIDE, SIDE), periodic=True)
    flat = 0.5 * 2e9 / (1.0 - 0.4**2) * 4.0 * math.pi / SIDE * 1e-8 * SIDE**2
    found = st.solve(elastic(surface), load=[1.01 * flat, 0.9 * flat], model=MODEL)
    assert float(found["area_fraction"][0]) == pytest.approx(1.0, abs=1e-12) and 0.9 < float(found["area_fraction"][1]) < 1.0
    assert abs(float(found["plane_separation"][0])) < 1e-13 < 1e-11 < float(found["plane_separation"][1])


def test_it_says_what_the_solver_says_of_the_whole_nominal_area(contact, rough):
    found = st.solve(contact, load=["2 mN", "1 mN"], model=MODEL)
    first, second = contact.first, contact.second
    modulus = 1.0 / sum((1.0 - one.poissons_ratio**2) / one.youngs_modulus for one in (first, second))
    loads = np.array([2e-3, 1e-3]) / 3.0
    plain = solve_map(rough.heights - rough.heights.mean(), rough.size, modulus=modulus, loads=loads, periodic=True,
                      hardness=second.hardness)  # fmt: skip
    for name, own, factor in (
        ("contact_area", "area", 3.0), ("contact_area_pixels", "area_pixels", 3.0), ("contact_stiffness", "stiffness", 3.0),
        ("plane_separation", "separation", 1.0), ("load_share_plastic", "plastic_share", 1.0),
    ):  # fmt: skip
        assert_allclose(found[name].values, plain.array(own) * factor, rtol=1e-4, err_msg=name)
    measured = contact.roughness.surface.measured if contact.roughness.surface.measured else contact.measured
    mean_height = measured.mean_heights[contact.measured.of_moments]
    assert_allclose(found["mean_separation"].values, found["plane_separation"].values - mean_height, atol=1e-15)
    assert 0.0 < float(found["load_share_plastic"][0]) < 1.0


def test_friction_of_an_interface_is_exact(contact):
    """T = tau_0 A + alpha P, whatever points bear."""
    found = st.solve(contact, load="2 mN", model=MODEL)
    assert_allclose(found["friction_force"], 20e6 * found["contact_area"], rtol=1e-12)
    more = st.solve(contact.replace(pressure_coefficient=0.1), load="2 mN", model=MODEL)
    assert float(more["friction_coefficient"]) == pytest.approx(20e6 * float(found["contact_area"]) / 2e-3 + 0.1, rel=1e-9)
    bare = st.solve(contact, load="2 mN", model=MODEL, tangential="none")
    assert "friction_force" not in bare


def test_friction_of_the_pressure_of_every_point(contact, rough):
    """The lesser of alpha p and tau_0, and growth to p^2 + 9 tau_0^2 = H^2, summed here over the solver's own pressures."""
    weak = contact.replace(interfacial_shear_strength=25e6, pressure_coefficient=0.15)
    first, second = contact.first, contact.second
    modulus = 1.0 / sum((1.0 - one.poissons_ratio**2) / one.youngs_modulus for one in (first, second))
    (one,) = solve_map(rough.heights - rough.heights.mean(), rough.size, modulus=modulus, loads=[40e-3 / 3.0], periodic=True,
                       hardness=second.hardness)  # fmt: skip
    pressure, point = one.pressure, one.nominal_area / one.pressure.size
    found = st.solve(weak, load="40 mN", model=MODEL, shear="lesser")
    edge = 3.0 * 25e6 * (one.area_pixels - one.area)  # what pixels at edges can make of it
    assert abs(float(found["friction_force"]) - 3.0 * np.minimum(0.15 * pressure, 25e6).sum() * point) <= edge
    plain = st.solve(weak, load="40 mN", model=MODEL, tangential="bowden_tabor_1943")
    assert float(found["friction_force"]) < float(plain["friction_force"])
    strength = 0.2 * second.hardness  # just below that of the bodies, H/(2.8 sqrt(3))
    strong = contact.replace(interfacial_shear_strength=strength)
    grown = st.solve(strong, load="40 mN", model=MODEL, shear="junction_growth")
    bearing = math.sqrt(second.hardness**2 - 9.0 * strength**2)
    expected = 3.0 * strength * np.maximum(pressure > 0.0, pressure / bearing).sum() * point
    assert abs(float(grown["friction_force"]) - expected) <= 3.0 * strength * (one.area_pixels - one.area)
    assert float(grown["friction_force"]) > 1.05 * strength * float(grown["contact_area"])
    for changes, given, message in (
        ({}, {"shear": "lesser"}, ("pressure_coefficient",)),
        (
            {"interfacial_shear_strength": second.hardness / 3.0, "hardness_to_yield": 1.5},
            {"shear": "junction_growth"},
            ("interfacial_shear_strength",),
        ),
        ({"pressure_coefficient": 0.1}, {"shear": "junction_growth"}, ("tangential",)),
    ):
        with refusal(*message):
            st.solve(contact.replace(**changes), load="2 mN", model=MODEL, **given)


def test_no_pressure_is_above_the_hardness_unless_asked_for(contact):
    found = st.solve(contact, load="40 mN", model=MODEL)
    free = st.solve(contact, load="40 mN", model=MODEL, yielding="none")
    assert float(free["load_share_plastic"]) == 0.0 < float(found["load_share_plastic"])
    least = 40e-3 / contact.second.hardness
    assert float(free["contact_area"]) < least < float(found["contact_area"])
    assert "mean_pressure_over_hardness" in {one.quantity for one in warnings_of(free)}


def test_a_film_is_solved_with_its_substrate(rough):
    """A film like its substrate is not felt, a thick one is a half-space, and which body carries it changes nothing."""
    alike = elastic(rough, coating={"material": ELASTIC, "thickness": "1 um", "bodies": "first"})
    assert area(alike) == pytest.approx(area(elastic(rough)), rel=1e-3)
    thick = elastic(rough, coating={"material": FILM, "thickness": "1 mm", "bodies": "both"})
    whole = st.Contact(first=FILM, second=FILM, roughness=rough, nominal_area=SIDE**2)
    assert area(thick) == pytest.approx(area(whole), rel=2e-3) and area(thick) < 0.8 * area(elastic(rough))
    one, other = (alike.replace(coating={"material": FILM, "thickness": 5e-7, "bodies": body}) for body in ("first", "second"))
    assert area(one) == area(other)


def test_two_films_give_way_one_after_the_other():
    film, other = Film(1e-7, 4e9, 0.3, 2e9, 0.4), Film(1e-7, 4e9, 0.3, 5e9, 0.2)
    k = np.geomspace(1e4, 1e9, 20)
    both = Compliance(math.inf, film, other).times_half_k(k)
    assert_allclose(both, Compliance(math.inf, film).times_half_k(k) + Compliance(math.inf, other).times_half_k(k), rtol=1e-14)
    assert Compliance(math.inf, film, other).far == pytest.approx(film.far + other.far, rel=1e-14)


def test_two_rough_faces_are_one_of_their_sum(rough):
    """The second is turned over; scans of other size are refused, and a body that is known by numbers."""
    flipped = replace(rough, heights=rough.heights[:, ::-1].copy())
    twice = replace(rough, heights=2.0 * rough.heights)
    two = st.solve(elastic({"first": rough, "second": flipped}), load="1 mN", model=MODEL)
    one = st.solve(elastic(twice), load="1 mN", model=MODEL)
    assert float(two["area_fraction"]) == pytest.approx(float(one["area_fraction"]), rel=1e-6)
    other = gaussian_surface((64, 64), (2 * SIDE, 2 * SIDE), SelfAffine(0.8, SIDE / 4, SIDE / 8, 4e-8), 3)
    with refusal("roughness.second", "64 x 64"):
        st.solve(elastic({"first": rough, "second": other}), load="1 mN", model=MODEL)
    numbers = {"asperity_height_deviation": 1e-8, "asperity_radius": 1e-6, "asperity_density": 1e12}
    with refusal("roughness"):
        st.solve(elastic({"first": rough, "second": numbers}), load="1 mN", model=MODEL)


def test_one_period_has_no_form_and_no_ends(rough, tmp_path):
    """A made map, and a scan that says so, is as it is; another is levelled, and ends."""
    np.save(tmp_path / "map.npy", rough.heights + 1e-6)
    given = {"file": str(tmp_path / "map.npy"), "size": "20 um", "unit": "m"}
    made = st.solve(elastic(rough), load="1 mN", model=MODEL)
    said = st.solve(elastic({"first": given | {"periodic": True}}), load="1 mN", model=MODEL)
    ends = st.solve(elastic({"first": given}), load="1 mN", model=MODEL)
    assert float(said["area_fraction"]) == pytest.approx(float(made["area_fraction"]), rel=1e-6)
    assert float(ends["area_fraction"]) != pytest.approx(float(made["area_fraction"]), rel=1e-3)
    assert "levelled" in ends.attrs["scans"] and "levelled" not in said.attrs["scans"]


def few_waves(validity_warnings) -> bool:
    return "longest_waves_on_a_side" in {one.quantity for one in validity_warnings}


@pytest.mark.parametrize("coating", (None, {"material": FILM, "thickness": "10 um", "bodies": "first"}))
def test_a_window_of_few_waves_is_no_sample_for_any_model(rough, coating):
    """Five waves of a quarter of the side or so, and fourteen: of all models that answer, by `solve` and by `compare`."""
    many = gaussian_surface((128, 128), (SIDE, SIDE), SelfAffine(0.8, SIDE / 14, SIDE / 16, 4e-8), 3)
    for surface, few in ((replace(rough, periodic=False), True), (many, False)):
        contact, said = elastic(surface, coating=coating, work_of_adhesion=1e-6), {}
        for model in of_kind(RoughSurface):
            with suppress(st.InputError):
                said[model] = few_waves(warnings_of(st.solve(contact, load="1 mN", model=model, tangential="none")))
        assert set(said.values()) == {few} and len(said) >= (3 if coating else 15)
        compared = st.compare(contact, load="1 mN")
        texts = compared["validity_warnings"][compared["friction_coefficient_at_load"] > 0]
        there = [few_waves(read_warnings(one.item())) for one in texts]
        assert set(there) == {few} and len(there) >= 3
        assert any("long waves" in one for one in st.predict(contact, load="1 mN").warnings) == few


def test_scans_that_make_no_one_map_are_samples_or_not(rough):
    """Points are missing, or two scans differ in size: theories take their numbers, which few waves make as well."""
    window = replace(rough, periodic=False)
    holes = window.heights.copy()
    holes[5:9, 40:44] = np.nan
    for scans in (
        {"first": replace(window, heights=holes)},
        {"first": window, "second": replace(window, size=(2 * SIDE, 2 * SIDE))},
    ):
        contact = elastic(scans)
        assert few_waves(warnings_of(st.solve(contact, load="1 mN", model="persson_2001")))
        assert any("long waves" in one for one in st.predict(contact, load="1 mN").warnings)


def test_warnings_are_those_of_the_map(rough):
    coarse = gaussian_surface((64, 64), (SIDE, SIDE), SelfAffine(0.8, SIDE / 2, SIDE / 20, 2e-6), 3)
    said = {one.quantity for one in warnings_of(st.solve(elastic(coarse), load="1 mN", model=MODEL))}
    assert {"points_in_shortest_wave", "longest_waves_on_a_side", "map_gradient", "points_in_contact"} <= said
    assert "sharpness" not in said and "touching_asperities" not in said
    thin = elastic(rough, coating={"material": FILM, "thickness": "10 nm", "bodies": "first"})
    assert "points_in_film" in {one.quantity for one in warnings_of(st.solve(thin, load="1 mN", model=MODEL))}


@pytest.mark.parametrize(
    ("changes", "given", "message"),
    [
        ({}, {"load": "-1 mN"}, ("load",)),
        ({}, {"separation": "10 nm"}, ("separation",)),
        ({}, {"load": "1 kN"}, ("loads",)),
        ({}, {"load": "1 mN", "tangential": "hamilton_1983"}, ("tangential", "hamilton_1983", "boundary_elements")),
        ({}, {"load": "1 mN", "film": "sequential"}, ("film",)),
        ({}, {"load": "1 mN", "heights": "gaussian"}, ("heights",)),
        ({"nominal_area": st.axis("nominal_area", [1e-9, 2e-9])}, {"load": "1 mN"}, ("nominal_area",)),
    ],
    ids=["tension", "separation", "too much", "asperities", "film law", "heights", "several"],
)  # fmt: skip
def test_what_cannot_be_is_refused_in_a_line(contact, changes, given, message):
    coated = "film" in given
    made = contact.model_copy(update=changes) if changes else contact
    made = made.replace(coating={"material": "silver", "thickness": "1 um"}) if coated else made
    with refusal(*message) as caught:
        st.solve(made, **given, model=MODEL)
    assert "\n" not in str(caught.value)


def test_maps_that_cannot_be_solved_get_a_line(rough):
    holed = rough.heights.copy()
    holed[3, 4] = np.nan
    with refusal("roughness.fill", "harmonic", "nearest"):
        st.solve(elastic({"first": replace(rough, heights=holed)}), load="1 mN", model=MODEL)
    filled = elastic({"first": replace(rough, heights=holed), "fill": "harmonic"})
    assert float(st.solve(filled, load="1 mN", model=MODEL)["contact_area"]) > 0.0
    numbers = st.Roughness(asperity_height_deviation=1e-8, asperity_radius=1e-6, asperity_density=1e12)
    with refusal("height map", "boundary_elements"):
        st.solve(elastic(numbers), load="1 mN", model=MODEL)
    with refusal("height map", "boundary_elements"):
        st.solve(st.Indices(theta=10.0, lam=10.0, nu=0.3), load=1e-3, model=MODEL)


def test_memory_is_asked_for_before_a_map_is_made_or_solved(contact, monkeypatch):
    with refusal("heights", "100000 x 100000"):
        st.gaussian_surface((100_000, 100_000), (1e-3, 1e-3), SelfAffine(0.8, 1e-4, 1e-6, 1e-7), 1)
    monkeypatch.setattr("stiction.surfaces.memory.available_memory", lambda: 10**5)
    with refusal("heights", "64 x 64"):
        st.solve(contact, load="1 mN", model=MODEL)


def test_adhesion_is_solved_if_asked_for(rough):
    """As by the solver of maps that stick; of elastic bodies and one period only; what the map does not resolve is said."""
    soft = elastic(rough, work_of_adhesion=0.05, interfacial_shear_strength=1e6)
    asked = {"model": MODEL, "yielding": "none", "adhesion": "shortest_range"}
    found = st.solve(soft, load=["1 mN", "-1 uN"], **asked)
    near = 2.0 * (1.0 - 0.4**2) / 2e9
    reach = math.sqrt(2.0 * SIDE / POINTS * near * 0.05)
    assert float(found["adhesion_range"][0]) == pytest.approx(reach) and float(found["points_at_edge"][0]) == pytest.approx(2.0)
    plain = solve_adhesive(rough.heights - rough.heights.mean(), rough.size, modulus=1.0 / near, loads=[1e-3, -1e-6], work=0.05,
                           reach=reach)  # fmt: skip
    assert_allclose(found["area_fraction"], [one.area / SIDE**2 for one in plain], rtol=1e-9)
    assert float(found["friction_coefficient"][0]) == pytest.approx(1e6 * float(found["contact_area"][0]) / 1e-3)
    bare = st.solve(soft, load="1 mN", model=MODEL, yielding="none")
    assert float(found["contact_area"][0]) > float(bare["contact_area"])
    said = {one.quantity for one in warnings_of(st.solve(soft, load="1 mN", **asked | {"adhesion": "atomic_range"}))}
    assert "points_at_edge" in said and "adhesion_share" not in said
    assert "range_tabor" in {one.quantity for one in warnings_of(found)}
    alone = replace(rough, periodic=False)
    for contact, changes, message in (
        (soft, {"yielding": "at_hardness"}, ("yielding",)),
        (elastic(alone, work_of_adhesion=0.05), {}, ("adhesion", "left_out")),
        (elastic(rough), {}, ("work_of_adhesion",)),
        (soft, {"shear": "junction_growth"}, ("shear",)),
    ):
        with refusal(*message):
            st.solve(contact, load="1 mN", **asked | changes)


def test_what_was_solved_is_read_and_what_differs_is_not(contact, rough):
    steps = []
    with listening(lambda one: steps.append(one.load)):
        first = st.solve(contact, load=["1 mN", "2 mN"], model=MODEL)
        solved = len(steps)
        again = st.solve(contact, load=["2 mN", "1 mN"], model=MODEL)
        assert solved > 0 and len(steps) == solved
        for name in first.data_vars:
            np.testing.assert_array_equal(first[name].values, again[name].values[::-1] if first[name].ndim else again[name])
        st.solve(contact, load=["1 mN", "3 mN"], model=MODEL)
        assert set(steps[solved:]) == {0}  # one load was missing
        solved = len(steps)
        for other in (contact.replace(second="iron"), contact.model_copy(update={"roughness": elastic(replace(
            rough, heights=rough.heights * 1.01)).roughness})):  # fmt: skip
            st.solve(other, load="1 mN", model=MODEL)
            assert len(steps) > solved
            solved = len(steps)


def test_a_damaged_file_is_solved_again(contact, tmp_path):
    first = st.solve(contact, load="1 mN", model=MODEL)
    (path,) = (tmp_path / "kept").iterdir()
    path.write_bytes(path.read_bytes()[:100])
    assert float(st.solve(contact, load="1 mN", model=MODEL)["contact_area"]) == float(first["contact_area"])


def test_a_file_of_another_contact_is_solved_again(contact, tmp_path):
    first = st.solve(contact, load="1 mN", model=MODEL)
    (path,) = (tmp_path / "kept").iterdir()
    content = path.read_bytes()
    other = contact.replace(second="iron")
    right = float(st.solve(other, load="1 mN", model=MODEL)["contact_area"])
    assert right != float(first["contact_area"])
    (exchanged,) = set((tmp_path / "kept").iterdir()) - {path}
    exchanged.write_bytes(content)
    assert float(st.solve(other, load="1 mN", model=MODEL)["contact_area"]) == right


def test_no_changed_byte_of_a_file_changes_a_solution(tmp_path):
    """Every eleventh byte of the file in turn, and the file cut off there: read as it was written, or not read."""
    heights = np.zeros((8, 8))
    heights[4, 4] = 1e-8
    (solution,) = cache.solve_cached(heights, (1e-6, 1e-6), modulus=1e9, loads=[1e-9], periodic=True)
    (path,) = (tmp_path / "kept").iterdir()
    content = path.read_bytes()
    for place in range(0, len(content), 11):
        for spoilt in (content[:place] + bytes([content[place] ^ 0x21]) + content[place + 1 :], content[:place]):
            path.write_bytes(spoilt)
            contact = cache._read(path, heights.shape)
            assert contact is None or (contact.area == solution.area and np.array_equal(contact.pressure, solution.pressure)), (
                place
            )


def test_comments_and_docstrings_of_the_solver_change_no_key():
    solver = 'def twice(value):\n    """Return 2 x."""\n    return 2 * value\n'
    same = '"""A module."""\n\ndef twice(value):\n    """Return two x."""\n    # a reason\n    return 2 * value\n'
    assert cache.code_alone(solver) == cache.code_alone(same)
    assert cache.code_alone(solver) != cache.code_alone(solver.replace("2 *", "3 *"))


def test_the_oldest_files_make_room(contact, tmp_path, monkeypatch):
    st.solve(contact, load="1 mN", model=MODEL)
    monkeypatch.setattr(cache, "_MOST", 1)
    st.solve(contact, load="2 mN", model=MODEL)
    assert list((tmp_path / "kept").iterdir()) == []


def test_an_interruption_keeps_the_loads_that_are_done(contact):
    def stop(one):
        if one.load == 1 and one.step == 2:
            raise KeyboardInterrupt

    with listening(stop):
        found = st.solve(contact, load=["3 mN", "1 mN", "2 mN"], model=MODEL)
    assert np.isnan(found["contact_area"].values).tolist() == [True, False, True]
    assert "interrupted: 2 of 3 loads were not solved" in found.attrs["outside_validity"]


def test_a_comparison_has_it_as_one_more_row(contact):
    data = st.compare(contact, load="2 mN")
    row = data.sel(model=MODEL)
    alone = st.solve(contact, load="2 mN", model=MODEL)
    assert float(row["friction_coefficient_at_load"]) == float(alone["friction_coefficient"])
    solved = np.isfinite(row["load"].values)
    assert solved.sum() == 5 and solved[:5].all() and (row["range_status"].values[~solved] == 1).all()
    assert (np.diff(row["contact_area"].values[:5]) > 0.0).all()
    numbers = st.compare(contact.as_numbers(), load="2 mN")
    assert MODEL not in numbers["model"] and "boundary_elements: height map is not given" in numbers.attrs["not_applicable"]


def test_of_many_points_a_comparison_takes_some(contact, monkeypatch):
    monkeypatch.setattr("stiction.solving.candidates._POINTS", 1000)
    data = st.compare(contact, load="2 mN")
    name = "boundary_elements (sampled)"
    assert name in data["model"] and MODEL not in data["model"]
    row = st.solve(contact, load="2 mN", model=name)
    assert row.attrs["points"] == "sampled"
    assert float(row["friction_coefficient"]) == float(data.sel(model=name)["friction_coefficient_at_load"])
    monkeypatch.setattr("stiction.solving.on_map._MOST_POINTS", 100)
    left_out = st.compare(contact, load="2 mN").attrs["not_applicable"]
    assert "boundary_elements (sampled): at most 100" in left_out


def test_sampled_points_say_so_and_are_near(rough):
    fine = gaussian_surface((256, 256), (SIDE, SIDE), SelfAffine(0.8, SIDE / 4, SIDE / 8, 4e-8), 3)
    found, every = (st.solve(elastic(fine), load="3 mN", model=MODEL, points=points) for points in ("sampled", "all"))
    assert float(found["point_spacing"]) > 1.0 == float(every["point_spacing"])
    assert float(found["area_fraction"]) == pytest.approx(float(every["area_fraction"]), rel=0.03)


# ---- commands


def run(*words):
    result = CliRunner().invoke(cli.app, [*map(str, words)])
    assert result.exit_code == 0, (result.output, result.exception)
    return result.stdout


@pytest.fixture
def case(rough, tmp_path):
    np.save(tmp_path / "map.npy", rough.heights)
    path = tmp_path / "case.toml"
    path.write_text(
        '[contact]\nfirst = "hardened_steel_52100"\nsecond = "silver"\ninterfacial_shear_strength = "20 MPa"\n'
        'nominal_area = "1 mm^2"\nroughness = { first = { file = "map.npy", size = "20 um", unit = "m", periodic = true } }\n'
        '[solve]\nload = ["1 N", "3 N"]\nmodel = "boundary_elements"\n'
    )
    return path


def test_run_and_compare_a_case(case, tmp_path):
    text = run("run", case, "--details", "--out", tmp_path / "out")
    assert "every point" in text and "counted in points" in text and "persistence" not in text
    assert {path.name for path in (tmp_path / "out").iterdir()} == {"curve.csv", "curve.nc", "curve.png", "regimes.png"}
    found = json.loads(run("run", case, "--json"))
    mu = 20e6 * np.array(found["variables"]["contact_area"]["values"]) / [1.0, 3.0]
    assert_allclose(found["variables"]["friction_coefficient"]["values"], mu, rtol=1e-12)
    rows = {row["model"]: row for row in json.loads(run("compare", case, "--load", "3 N", "--json"))["models"]}
    assert rows[MODEL]["friction_coefficient"] == pytest.approx(mu[1], rel=1e-12)
    sampled = json.loads(run("run", case, "--points", "sampled", "--json"))
    assert sampled["attrs"]["points"] == "sampled"


def test_the_contact_of_a_scan_alone(rough, tmp_path):
    """Over E* h': the same as a contact of materials with that gradient."""
    np.save(tmp_path / "map.npy", rough.heights)
    words = ["surface", tmp_path / "map.npy", "--size", "20 um", "--unit", "m", "--periodic", "--contact", "0.05 0.2"]
    found = json.loads(run(*words, "--json"))["contact"]
    modulus, slope = 0.5 * 2e9 / (1.0 - 0.4**2), found["rms_gradient"]
    loads = (np.array([0.05, 0.2]) * modulus * slope * SIDE**2).tolist()
    other = st.solve(elastic(rough), load=loads, model=MODEL)
    assert_allclose(found["columns"]["A/A0"], other["area_fraction"], rtol=1e-5)
    assert_allclose(found["columns"]["separation/Sq"], other["plane_separation"] / rough.heights.std(), rtol=1e-4)
    assert_allclose(found["columns"]["stiffness/(E* L)"], other["contact_stiffness"] / modulus / SIDE, rtol=1e-3)
    text = run(*words, "--hardness", "0.5", "--out", tmp_path / "out")
    assert "no pressure above 0.5 E* h'" in text
    pressures = np.load(tmp_path / "out" / "pressure.npy")
    assert pressures.shape == (2, POINTS, POINTS) and pressures.max() == pytest.approx(0.5)
    assert_allclose(pressures.mean(axis=(1, 2)), [0.05, 0.2], rtol=1e-9)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--contact", "0.1 x"), "--contact"),
        (("--contact", "-1"), "pressures"),
        (("--hardness", "1"), "--hardness"),
        (("--contact", "0.3", "--hardness", "0.2"), "the hardness over E"),
    ],
)
def test_pressures_that_cannot_be(rough, tmp_path, words, message):
    np.save(tmp_path / "map.npy", rough.heights)
    result = CliRunner().invoke(cli.app, ["surface", str(tmp_path / "map.npy"), "--size", "20 um", "--unit", "m", *words])
    assert result.exit_code == 2 and message in result.stderr and result.stderr.count("\n") == 1


# ---- the resolution study


def test_mu_of_the_map_against_the_cutoff(rough):
    """Of one period it is that of the period filtered over its ends, the same after every method; smoother is larger."""
    contact, choice = elastic(rough, interfacial_shear_strength=2e5), Choice(MODEL)
    study = st.resolution_study(rough, [0.0, SIDE / 4], contact=contact, load="1 mN", choice=choice)
    mu = study["mu"].values
    assert mu.shape == (5, 2) and (mu[0] == mu[np.isfinite(mu).all(axis=1)]).all()
    assert mu[0, 0] == pytest.approx(float(st.solve(contact, load="1 mN", model=MODEL)["friction_coefficient"]), rel=1e-6)
    smooth = elastic(filter_period(rough, SIDE / 4), interfacial_shear_strength=2e5)
    assert mu[0, 1] == pytest.approx(float(st.solve(smooth, load="1 mN", model=MODEL)["friction_coefficient"]), rel=1e-6)
    assert mu[0, 1] > 1.2 * mu[0, 0]


def test_one_period_stays_one_under_a_filter(rough):
    """The transmission of a wave is that of ISO 16610, and a shifted map filters to the shifted result."""
    along = np.arange(64) * 2.0 * math.pi / 64.0
    wave = HeightMap(np.cos(8.0 * along) * np.ones((64, 1)), (SIDE, SIDE), periodic=True)
    passed = filter_period(wave, shortest=SIDE / 8)
    assert_allclose(passed.heights, 0.5 * wave.heights, atol=1e-12)
    assert_allclose(filter_period(wave, longest=SIDE / 8).heights, 0.5 * wave.heights, atol=1e-12)
    moved = replace(rough, heights=np.roll(rough.heights, (5, 9), (0, 1)))
    one, other = (filter_period(each, shortest=SIDE / 6).heights for each in (moved, rough))
    assert_allclose(one, np.roll(other, (5, 9), (0, 1)), atol=1e-20)
    assert passed.periodic and not level(wave).periodic
    with refusal("heights", "512 missing points"):
        filter_period(replace(wave, heights=np.where(wave.heights > 0.99, np.nan, wave.heights)), shortest=SIDE / 8)
