"""What every registered way of finding asperities must meet, whatever its name: a new one is held to it by being registered."""

import math
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

import stiction as st
from refusals import refusal
from stiction.quantities.errors import InputError
from stiction.records import record as record_finding
from stiction.records.registry import AsperityMethod, Parameter
from stiction.records.sources import Source
from stiction.solving.choice import Choice
from stiction.surfaces.asperity_set import Asperities, of_samples, over_mean_plane
from stiction.surfaces.finding import CHECKED_QUANTITIES, asperities, method_of_moments, methods, methods_for
from stiction.surfaces.heightmap import HeightMap
from stiction.surfaces.targets import GaussianCorrelation

KEYS = tuple(methods())
each = pytest.mark.parametrize("key", KEYS)
NUMBERS = ("density", "deviation", "radius", "mean_height")
LENGTH = 1e-7
SMOOTH = GaussianCorrelation(deviation=1e-8, length=LENGTH)
# Summits per area over the square of peaks per length, of an isotropic Gaussian surface (Nayak 1971).
PER_LENGTH_SQUARED = 2.0 * math.pi / (3.0 * math.sqrt(3.0))


def rough(points=8, side=16, seed=1):
    """A Gaussian surface of so many points to the correlation length, and so many lengths to a side."""
    return st.gaussian_surface((points * side,) * 2, (side * LENGTH,) * 2, SMOOTH, seed)


def same(found, expected, rel=1e-9, **factors):
    for name in NUMBERS:
        wanted = getattr(expected, name) * factors.get(name, 1.0)
        assert getattr(found, name) == pytest.approx(wanted, rel=rel), name


# ---- what it finds


def hills(tops, points):
    """A parabola, or paraboloids, with their tops (rows, columns) [m] in cells of so many points; and their radius [m]."""
    radius, pitch = 2e-6, 1e-6 / points
    x = (np.arange(points) - points // 2) * pitch
    y = x if len(tops) > 1 else np.zeros(1)
    dome = -(y[:, None] ** 2 + x**2) / (2.0 * radius)
    heights = np.tile(dome, tops.shape) + np.kron(tops, np.ones(dome.shape))
    return HeightMap(heights, (heights.shape[0] * pitch, heights.shape[1] * pitch)), radius


@each
def test_hills_are_found_as_they_are(key):
    """Parabolas of 400 points, or paraboloids of 16 x 16, where asperities are found one by one; where there are averages only,
    the method must be `of_summits`, and is tried below. N within what the ends leave out."""
    record = methods()[key]
    columns = 7
    tops = np.linspace(0.0, 5e-9, columns if record.of_profiles else columns**2).reshape(-1, columns)
    points = 400 if record.of_profiles else 16
    surface, radius = hills(tops, points)
    found = asperities(surface, key)
    if not found.count:
        assert record.of_summits
        return
    per_length = columns / surface.size[1]
    expected = PER_LENGTH_SQUARED * per_length**2 if record.of_profiles else per_length**2
    ends = 2.0 * 2.0 * 3.0 / (points * columns)  # three points on either side, along both directions
    assert found.density == pytest.approx(expected, rel=ends)
    assert found.radius == pytest.approx(radius, rel=record.accuracy)
    assert found.deviation == pytest.approx(tops.std(), rel=max(record.accuracy, 1e-9))
    assert found.mean_height == pytest.approx(tops.mean() - surface.heights.mean(), rel=1e-9)


@pytest.mark.parametrize("key", [key for key, one in methods().items() if one.of_summits])
def test_methods_of_summits_find_those_of_a_gaussian_surface(key):
    """Nayak's sigma, R and N in closed form, the mean of four maps of 12 points to the correlation length and 64 lengths to a
    side: chance is 1 % of sigma and less of the others, and the pitch makes R 1 to 2 % larger."""
    deviation, radius, density = SMOOTH.moments.asperities()
    found = [asperities(rough(12, 64, seed), key) for seed in range(4)]
    for name, expected in (("deviation", deviation), ("radius", radius), ("density", density)):
        assert np.mean([getattr(one, name) for one in found]) == pytest.approx(expected, rel=0.04), name


@each
def test_lengths_have_no_size_of_their_own(key):
    """With its defaults: twice as wide and three times as high, N is a quarter, R 4/3 times and sigma three times as large."""
    surface = rough()
    larger = HeightMap(3.0 * surface.heights, tuple(2.0 * one for one in surface.size))
    same(
        asperities(larger, key), asperities(surface, key),
        density=0.25, radius=4.0 / 3.0, deviation=3.0, mean_height=3.0,
    )  # fmt: skip


@each
def test_a_quarter_turn_changes_nothing(key):
    """Of a map that is not square, with unequal pitch and a hole. Its ends are low: what rises at one would fall at it if it
    were turned."""
    heights = rough().heights[:100].copy()
    low = np.ones(heights.shape, dtype=bool)
    low[2:-2, 2:-2] = False
    low[28:42, 48:72] = True
    heights[low] = -4e-8
    heights[30:40, 50:70] = np.nan
    surface = HeightMap(heights, (2e-6, 1.5e-6))
    turned = HeightMap(np.rot90(heights), surface.size[::-1])
    found, expected = asperities(turned, key), asperities(surface, key)
    same(found, expected)
    assert found.count == expected.count


@each
def test_heights_count_from_their_mean(key):
    surface = rough()
    same(asperities(HeightMap(surface.heights + 1e-7, surface.size), key), asperities(surface, key), rel=1e-7)


@each
def test_profiles_are_for_methods_of_profiles(key):
    profile = HeightMap(rough().heights[:1], (1e-6, 1e-6))
    record = methods()[key]
    assert (key in methods_for(profile)) == record.of_profiles and key in methods_for(rough())
    if record.of_profiles:
        assert asperities(profile, key).density > 0.0
    else:
        with refusal("heights"):
            asperities(profile, key)


@pytest.mark.parametrize(
    ("record", "limit"),
    [pytest.param(one, limit, id=f"{one.key}-{limit.parent}") for one in methods().values() for limit in one.limits],
)
def test_declared_limits(record, limit):
    names = {"asperity_height_deviation": "deviation", "asperity_radius": "radius", "asperity_density": "density"}
    assert not limit.groups and limit.quantities
    found, expected = asperities(rough(), record.key, **limit.options), asperities(rough(), limit.parent)
    for quantity in limit.quantities:
        name = names[quantity]
        assert getattr(found, name) == pytest.approx(getattr(expected, name), rel=limit.within), name
    assert asperities(rough(), record.key).density != expected.density  # it takes these options to be so


# ---- what it says of itself


def test_records_can_be_told_apart():
    every = list(methods().values())
    assert len({one.label for one in every}) == len({one.order for one in every}) == len(every)
    assert [one.key for one in every if one.of_moments] == [method_of_moments()]
    known = ["three_point", "eight_neighbour", "persistence", "n_point", "mccool"]  # whose colours are known by their order
    assert [key for key in KEYS if key in known] == known


@each
def test_validity_is_of_what_is_found(key):
    """In quantities that every method has; what is outside has a warning in the note, here by a range that nothing is in."""
    record = methods()[key]
    assert {rule.quantity for rule in record.validity} <= CHECKED_QUANTITIES.keys()


def test_what_leaves_its_range_has_a_warning():
    """An egg crate has alpha = 1, less than any isotropic Gaussian surface."""
    phase = 2.0 * math.pi / 16 * np.arange(96)
    crate = HeightMap(3e-9 * np.cos(phase)[:, None] * np.cos(phase), (96e-8, 96e-8))
    note = asperities(crate, "mccool").note
    assert "asperity density times R sigma) is 0.0" in note and "valid range 0.01" in note
    assert note.endswith("no isotropic Gaussian surface has such a low value (bandwidth parameter alpha >= 1.5)")
    assert "claimed" not in asperities(rough(), "mccool").note


# ---- options


def options():
    for key, record in methods().items():
        for name, option in record.parameters.items():
            yield pytest.param(key, name, option, id=f"{key}-{name}")


def wrong(option):
    """Values that an option must refuse."""
    yield from ("no such value", "2 kg", [1.0], {}, math.nan, math.inf, -math.inf, 1j)
    if option.values:
        yield from (0, -1, 1e-9, "")
    else:
        yield True
        if option.lower > -math.inf:
            yield option.lower - 1.0
            if not option.lower_included:
                yield option.lower


@pytest.mark.parametrize(("key", "name", "option"), list(options()))
def test_an_option_refuses_what_is_not_allowed(key, name, option):
    for value in wrong(option):
        with pytest.raises(InputError) as caught:
            asperities(rough(), key, **{name: value})
        assert caught.value.field == name and "\n" not in str(caught.value), value


@pytest.mark.parametrize(("key", "name", "option"), list(options()))
def test_an_option_takes_what_is_allowed(key, name, option):
    """Its default is what is taken without it, as is None; every value of a few changes something."""
    fine = rough(64, 8)  # of a pitch that 10 nm are more than
    plain = asperities(fine, key)
    assert len(option.meaning) > 10 and option.unit in ("m", "")
    for default in {None, option.default}:
        found = asperities(fine, key, **{name: default})
        assert [getattr(found, one) for one in NUMBERS] == [getattr(plain, one) for one in NUMBERS]
    assert option.default is None or option.default in option.values or option.allows(option.default)
    others = [value for value in option.values if value != option.default]
    for value in others or (1e-8, "10 nm"):
        assert asperities(fine, key, **{name: value}).radius != plain.radius, value


@each
def test_options_are_known_by_name(key):
    with refusal("no_such", key) as caught:
        asperities(rough(), key, no_such=1.0)
    assert all(name in caught.value.allowed for name in methods()[key].parameters)
    said = st.models([key])[0]
    assert set(said["options"]) == set(said["options_mean"]) == set(methods()[key].parameters)
    assert all(values for values in said["options"].values())


@pytest.mark.parametrize(
    ("option", "allowed", "good", "bad"),
    [
        (Parameter("", 5, (5, 9)), "5, 9", (5, 9), (7, None, np.ones(2))),
        (Parameter("", 0.0), "any finite length in m", (-1.0, 0.0), (math.nan, math.inf, -math.inf)),
        (Parameter("", 0.0, unit=""), "any finite number", (-1.0,), (math.inf,)),
        (Parameter("", 1.0, lower=0.0), "> 0 m, finite", (1e-9,), (0.0, -1.0, math.nan)),
        (Parameter("", 1.0, lower=2.0, lower_included=True, unit=""), ">= 2, finite", (2.0, 3), (1.9, math.inf)),
    ],
)
def test_options_say_what_they_allow(option, allowed, good, bad):
    assert option.allowed == allowed
    assert all(option.allows(value) for value in good)
    assert not any(value is not None and option.allows(value) for value in bad)


# ---- from outside the package


def every_point(surface: HeightMap, share: float) -> Asperities:
    """A share of the points of a map, each an asperity of the radius 1 um."""
    heights = over_mean_plane(surface).ravel()
    heights = heights[: int(share * len(heights))]
    return of_samples("every_point", heights, np.full(len(heights), 1e6), 1.0 / math.prod(surface.pitch), "points")


OUTSIDE = AsperityMethod(
    key="every_point",
    title="Every point is an asperity",
    label="points",
    grade="B",
    sources=(Source("somebody_2031", "p. 1"),),
    verified="nothing but this test",
    find=every_point,
    of_profiles=False,
    parameters={"share": Parameter("share of the points", 1.0, unit="", lower=0.0)},
    entries={"somebody_2031": "@misc{somebody_2031,\n  title = {Points},\n}"},
)


class Entry:
    module = name = value = __name__

    def load(self):
        return OUTSIDE


@pytest.fixture
def outside(monkeypatch):
    monkeypatch.setattr(record_finding, "entry_points", lambda group: [Entry()] if group == "stiction" else [])
    record_finding._from_plug_ins.cache_clear()
    yield OUTSIDE
    monkeypatch.undo()
    record_finding._from_plug_ins.cache_clear()


@pytest.mark.filterwarnings("ignore::stiction.InputWarning")  # every point is no asperity, and is said not to be
def test_a_method_from_outside_is_like_the_others(outside, tmp_path):
    from stiction.report.pictures import look_of, plain

    surface = rough(4, 16)
    assert (*KEYS, "every_point") == tuple(methods()) == methods_for(surface)
    assert "every_point" not in methods_for(hills(np.zeros((1, 3)), 9)[0])
    assert st.asperities(surface, "every_point", share=0.5).count == surface.heights.size // 2
    with refusal("share", "> 0"):
        st.asperities(surface, "every_point", share="half")
    assert "@misc{somebody_2031" in st.cite("every_point") and st.models(["every_point"])[0]["kind"] == "asperity method"
    assert list(st.analyse(surface).asperities) == [*KEYS, "every_point"]
    assert list(st.resolution_study(surface, [0.0])["asperity_method"].values) == [*KEYS, "every_point"]
    looks = [look_of(key, 0) for key in methods()]
    assert len({tuple(look.items()) for look in looks}) == len(looks) and plain("every_point") == "points"
    np.save(tmp_path / "scan.npy", surface.heights)
    (tmp_path / "case.toml").write_text(
        '[contact]\nfirst = "iron"\nsecond = "iron"\nwork_of_adhesion = "0.2 J/m^2"\nnominal_area = "1 mm^2"\n'
        f'[contact.roughness]\nfirst = {{ file = "scan.npy", size = "{surface.size[1]:g} m", unit = "m" }}\n'
        'method = "every_point"\n[solve]\nload = "1 mN"\n'
    )
    measured = st.read_case(tmp_path / "case.toml").measured
    assert measured.method == "every_point" and tuple(measured.by_method) == (*KEYS, "every_point")
    cited = st.cite(st.solve_case(st.read_case(tmp_path / "case.toml"), Choice("greenwood_williamson_1966")))
    assert "{somebody_2031," in cited and "{mccool_1986," in cited and "{hertz_1882," in cited
    from stiction.case.case_tables import json_schema

    assert "every_point" in json_schema()["$defs"]["MeasuredRoughness"]["properties"]["method"]["description"]


def test_one_that_says_it_is_of_summits_comes_after_those_before_it(outside, monkeypatch):
    """The first in order that finds enough stands for the surface."""
    from stiction.surfaces.measured import default_method

    first = replace(OUTSIDE, order=0, of_summits=True)
    monkeypatch.setattr(Entry, "load", lambda self: first)
    record_finding._from_plug_ins.cache_clear()
    found = dict.fromkeys(methods(), asperities(rough(), "eight_neighbour"))
    assert default_method(found, dict.fromkeys(found, 100)) == "every_point"
    assert default_method(found, dict.fromkeys(found, 100) | {"every_point": 3}) == "eight_neighbour"


# ---- what it costs


def loaded(program):
    """Names of the modules that a program has loaded in a process of its own."""
    code = f"{program}\nimport sys\nprint(*sys.modules)"
    return subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout.split()


def test_the_registry_loads_nothing_slow():
    names = loaded("from stiction.records.registry import records; records()")
    assert "stiction.surfaces.asperity_method.persistence" in names
    slow = {"SurfaceTopography", "scipy.ndimage", "scipy.signal", "scipy.fft", "scipy.stats", "xarray"}
    assert not slow & set(names)


def test_a_case_without_scans_knows_nothing_of_surfaces():
    case = "st.read_case('examples/silver_on_steel.toml')"
    names = loaded(f"import stiction as st; st.solve_case({case})")
    assert "stiction.solving.solve" in names
    moments = {"stiction.surfaces", "stiction.surfaces.theory", "stiction.surfaces.theory.moments"}  # a film is beside waves
    moments |= {"stiction.surfaces.theory.touching"}
    moments |= {
        f"stiction.surfaces.{name}"
        for name in ("roughness", "rough_input", "measured", "solvable_maps", "finished", "finishes")
    }  # forms of input
    assert not [name for name in names if name.startswith("stiction.surfaces") and name not in moments]
