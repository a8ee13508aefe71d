"""A case that names scans: the friction of the roughness that is found in them, with its band over the methods."""

import json
import math
from pickle import dumps

import numpy as np
import pytest
import xarray
from comparing import near
from typer.testing import CliRunner

import stiction as st
from refusals import refusal
from stiction.case.case_tables import json_schema
from stiction.case.read import read_content
from stiction.cli import app
from stiction.studies.sweep.plan import make_plan

SIZE, PITCHES, AMPLITUDE = 20e-6, 256, 4e-9
CASE = """
title = "a scan"
[contact]
first = "silver"
second = "hardened_steel_52100"
work_of_adhesion = "0.05 J/m^2"
nominal_area = "1 mm^2"
[contact.roughness]
{roughness}
[solve]
load = ["1 mN", "1 N"]
"""
ONE = 'first = { file = "rough.npy", size = "20 um", unit = "m" }'


def command(*words, code=0):
    result = CliRunner().invoke(app, [str(word) for word in words])
    assert result.exit_code == code, (result.output, result.exception)
    return result


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder with two rough surfaces, an egg crate, and a profile."""
    folder = tmp_path_factory.mktemp("scans")
    spectrum = st.SelfAffine(hurst=0.8, rolloff=5e-6, shortest=0.6e-6, deviation=30e-9)
    for name, seed in (("rough", 1), ("other", 2)):
        made = st.gaussian_surface((PITCHES, PITCHES), (SIZE, SIZE), spectrum, seed)
        np.save(folder / f"{name}.npy", made.heights)
    x = 2.0 * np.pi * np.arange(PITCHES) / PITCHES
    np.save(folder / "eggs.npy", AMPLITUDE * np.cos(8.0 * x)[:, None] * np.cos(8.0 * x))
    np.save(folder / "line.npy", made.heights[7])
    return folder


def case(folder, roughness=ONE):
    path = folder / f"case-{abs(hash(roughness))}.toml"
    path.write_text(CASE.format(roughness=roughness))
    return path


def test_a_scan_is_solved_as_the_numbers_that_are_found_in_it(folder):
    """The same as giving these numbers by hand; and each line of the band is that of its method."""
    read = st.read_case(case(folder))
    data = st.solve_case(read)
    assert read.measured.method == data.attrs["roughness_method"] == "eight_neighbour"
    surface = st.prepared(st.read_scan(folder / "rough.npy", size="20 um", unit="m"))
    for method in data["asperity_method"].values:
        found = st.asperities(surface, str(method))
        numbers = {
            "asperity_height_deviation": found.deviation,
            "asperity_radius": found.radius,
            "asperity_density": found.density,
        }
        model = read.measured.by_method[method]
        by_hand = st.Roughness(
            **numbers, height_distribution=model.height_distribution, height_parameters=model.height_parameters
        )
        contact = read.subject.model_copy(update={"roughness": by_hand})
        expected = st.solve(contact, load=["1 mN", "1 N"])["friction_coefficient"].values
        assert data["friction_coefficient_by_method"].sel(asperity_method=method).values == pytest.approx(expected, rel=1e-9)
    table = data["friction_coefficient_by_method"].values
    assert data["friction_coefficient_low"].values == pytest.approx(table.min(axis=0))
    assert data["friction_coefficient_high"].values == pytest.approx(table.max(axis=0))
    assert data["friction_coefficient"].values == pytest.approx(table[0])
    assert "rough.npy" in data.attrs["scans"] and "levelled" in data.attrs["scans"]


@pytest.mark.parametrize("method", ("", 'method = "persistence"', 'heights = "empirical"'))
def test_theories_of_the_surface_take_what_was_measured_of_it(folder, method):
    """Persson 2001, A/A0 = erf(sqrt(2) p / (E* h')), with the gradient h' of the map: whatever stands for its asperities."""
    read = st.read_case(case(folder, f"{ONE}\n{method}"))
    heights, pitch = np.load(folder / "rough.npy"), SIZE / PITCHES
    slope = math.sqrt(sum(np.mean(np.diff(heights, axis=axis) ** 2) for axis in (0, 1))) / pitch
    pressure = np.array([1e-3, 1.0]) / 1e-6 / (read.subject.contact_modulus * slope)
    expected = 1e-6 * np.vectorize(math.erf)(math.sqrt(2.0) * pressure)
    for model in ("persson_2001", "bush_gibson_thomas_1975"):
        data = st.solve_case(read, read.choice.with_changes({"model": model}, {}))
        if model == "persson_2001":
            assert data["contact_area"].values == near(expected, rel=0.02)
        else:  # asymptotically pi/2 times as much, and less at all loads
            assert (data["contact_area"].values < 1.6 * expected).all()
        assert data.attrs["theta"] == near(read.by_method["mccool"].indices().theta, rel=1e-12)
    compared = st.compare_case(read, load=1.0)
    rows = compared.sel(model="persson_2001")
    assert float(rows["contact_area_at_load"]) == near(expected[1], rel=0.02)
    assert rows["load_at_load"] == near(1.0, rel=1e-12)
    for model in ("greenwood_williamson_1966", "mccool_1986"):  # the first of asperities found, the second of the moments
        sums = compared.sel(model=model)
        direct = st.solve(read.subject, load=1.0, model=model)
        assert float(sums["contact_area_at_load"]) == near(float(direct["contact_area"]), rel=1e-9)
        assert float(sums["mean_separation_at_load"]) == near(float(direct["mean_separation"]), rel=1e-9)
    takes_surface_moments = st.solve(read.by_method["mccool"], load=1.0, model="greenwood_williamson_1966")
    assert float(direct["contact_area"]) == near(float(takes_surface_moments["contact_area"]), rel=1e-9)


def test_theories_of_the_surface_have_no_spread_over_methods(folder):
    path = case(folder)
    path.write_text(path.read_text().replace("nominal_area", 'interfacial_shear_strength = "10 MPa"\nnominal_area'))
    said = json.loads(command("run", path, "--model", "persson_2001", "--tangential", "bowden_tabor_1943", "--json").stdout)
    assert said["measured"]["method"] == said["attrs"]["roughness_method"] == "mccool"
    assert list(said["measured"]["by_method"]) == ["mccool"]
    values = {name: said["variables"][name]["values"] for name in said["variables"]}
    assert values["friction_coefficient_low"] == values["friction_coefficient"] == values["friction_coefficient_high"]
    assert "tail" not in said["attrs"]["outside_validity"]  # no heights at all
    words = ("run", path, "--model", "persson_2001", "--tangential", "bowden_tabor_1943", "--details")
    assert "sigma" in command(*words).stdout
    rows = {row["model"]: row for row in json.loads(command("compare", path, "--json").stdout)["models"]}
    assert len(set(rows["persson_2001"]["friction_coefficient_by_method"].values())) == 1
    assert len(set(rows["greenwood_williamson_1966"]["friction_coefficient_by_method"].values())) == 5


def test_moments_that_are_not_known_are_said(folder):
    """Every third column is missing: no three points in a row, and so no second differences."""
    heights = np.load(folder / "rough.npy")
    heights[:, ::3] = np.nan
    np.save(folder / "gaps.npy", heights)
    read = st.read_case(case(folder, ONE.replace("rough", "gaps") + '\nheights = "gaussian"'))
    assert "mccool" in read.measured.failures and read.measured.by_method
    said = "the spectral moments are unknown ("
    for model in ("persson_2001", "greenwood_williamson_1966"):
        assert said in st.solve_case(read, read.choice.with_changes({"model": model}, {})).attrs["outside_validity"]
    assert said in st.compare_case(read, load=1.0).attrs["outside_validity"]


NUMBERS = {"asperity_height_deviation": "20 nm", "asperity_radius": "5 um", "asperity_density": "1e11 1/m^2"}


@pytest.mark.parametrize(
    ("surface", "field"),
    (
        (NUMBERS | {"height_distribution": "exponential"}, "surface.height_distribution"),
        (NUMBERS | {"surface": NUMBERS}, "surface.surface"),
        (NUMBERS | {"asperity_radius": "-1 um"}, "surface.asperity_radius"),
    ),
)
def test_a_surface_is_gaussian_and_has_none_of_its_own(surface, field):
    with refusal(field):
        st.Roughness(**NUMBERS, surface=surface)


def test_a_body_beside_a_scan_has_one_set_of_numbers(folder):
    numbers = "{ " + ", ".join(f'{name} = "{value}"' for name, value in NUMBERS.items())
    with refusal("contact.roughness.second.surface"):
        st.read_case(case(folder, f"{ONE}\nsecond = {numbers}, surface = {numbers} }} }}"))


DEFICIT = 1.0 + 16.0 / math.pi - 3.0 * math.sqrt(3.0)  # 0.8968 of sigma^2 = (1 - 0.8968 / alpha) m0, alpha = m0 m4 / m2^2


def moments_of(numbers):
    """m0, m2, m4 of McCool's sigma, R = (3/8) (pi/m4)^(1/2) and N = m4 / (6 pi 3^(1/2) m2)."""
    m4 = math.pi * (3.0 / 8.0 / numbers.asperity_radius) ** 2
    m2 = m4 / (6.0 * math.pi * math.sqrt(3.0) * numbers.asperity_density)
    return numbers.asperity_height_deviation**2 + DEFICIT * m2**2 / m4, m2, m4


def test_two_scans_are_added(folder):
    """sigma^2 of McCool's asperities adds with m0, m2 and m4: of two surfaces alike it doubles, and slopes with it."""
    two = ONE + '\nsecond = { file = "other.npy", size = "20 um", unit = "m" }'
    one = st.read_case(case(folder)).measured.by_method["mccool"]
    both = st.read_case(case(folder, two)).measured
    assert set(both.history) == {"first", "second"}
    found = both.by_method["mccool"]
    assert found.asperity_height_deviation / one.asperity_height_deviation == pytest.approx(math.sqrt(2.0), rel=0.2)
    assert found.asperity_radius / one.asperity_radius == pytest.approx(1.0 / math.sqrt(2.0), rel=0.1)
    assert found.asperity_density / one.asperity_density == pytest.approx(1.0, rel=0.1)  # two seeds are alike to chance only
    other = st.read_case(case(folder, ONE.replace("rough", "other"))).measured.by_method["mccool"]
    m0, m2, m4 = np.add(moments_of(one), moments_of(other))
    assert found.asperity_height_deviation == near(math.sqrt(m0 - DEFICIT * m2**2 / m4), rel=1e-9)
    assert found.asperity_radius == near(3.0 / 8.0 * math.sqrt(math.pi / m4), rel=1e-9)
    assert found.asperity_density == near(m4 / m2 / (6.0 * math.pi * math.sqrt(3.0)), rel=1e-9)


def test_a_scan_may_meet_a_body_known_by_numbers(folder):
    """With the numbers that McCool's method finds on the other scan it is the same as with that scan."""
    two = ONE + '\nsecond = { file = "other.npy", size = "20 um", unit = "m" }'
    alone = ONE.replace("rough.npy", "other.npy")
    other = st.read_case(case(folder, alone)).measured.by_method["mccool"]
    numbers = (
        f'{{ asperity_height_deviation = "{other.asperity_height_deviation!r} m", '
        f'asperity_radius = "{other.asperity_radius!r} m", asperity_density = "{other.asperity_density!r} 1/m^2" }}'
    )
    mixed = st.read_case(case(folder, ONE + f"\nsecond = {numbers}")).measured
    both = st.read_case(case(folder, two)).measured
    assert set(mixed.history) == {"first"} and set(mixed.counts.values()) == set(both.counts.values()) == {0}
    assert "stated by numbers is unknown" in mixed.validity_warnings[0] and both.validity_warnings == ()
    for name in ("asperity_height_deviation", "asperity_radius", "asperity_density"):
        assert getattr(mixed.by_method["mccool"], name) == near(getattr(both.by_method["mccool"], name), rel=1e-9)


def test_a_profile_has_methods_of_its_own(folder):
    read = st.read_case(case(folder, 'second = { file = "line.npy", size = "20 um", unit = "m" }'))
    assert read.measured.method == "mccool"
    assert {"eight_neighbour", "persistence"} == set(read.measured.failures)
    assert {"three_point", "n_point", "mccool"} == set(read.measured.by_method)


def test_too_few_asperities_do_not_stand_for_the_surface(folder):
    """In the waves of more than half the size there are a handful of summits: averages stand for it."""
    read = st.read_case(case(folder, ONE + '\nshortest = "12 um"'))
    assert read.measured.counts["eight_neighbour"] < 30 and read.measured.method == "mccool"


def test_spikes_are_masked_on_demand(folder):
    """One spike sets Sz, and with it the threshold of persistent summits, of which there are then next to none."""
    heights = np.load(folder / "rough.npy")
    heights[100, 100] += 5e-6
    np.save(folder / "spike.npy", heights)
    spiked = ONE.replace("rough", "spike")
    with_spike, without, never = (st.read_case(case(folder, text)).measured for text in (spiked, spiked + "\nspikes = 10", ONE))
    assert with_spike.counts.get("persistence", 0) < 5
    assert without.counts["persistence"] == pytest.approx(never.counts["persistence"], abs=2)
    assert "1 points further than 10 robust deviations" in " ".join(without.history["first"])
    answer = json.loads(command("surface", folder / "spike.npy", "--size", "20 um", "--unit", "m", "--json").stdout)
    assert answer["suspected_spikes"] == 1


def test_two_scans_of_different_resolution_have_a_warning(folder):
    heights = np.load(folder / "other.npy")
    np.save(folder / "coarse.npy", heights[::4, ::4])
    two = ONE + '\nsecond = { file = "coarse.npy", size = "20 um", unit = "m" }'
    read = st.read_case(case(folder, two))
    assert "different resolutions (shortest waves 156 nm and 625 nm)" in read.measured.validity_warnings[0]
    assert read.measured.validity_warnings[0] in st.solve_case(read).attrs["outside_validity"]
    assert st.read_case(case(folder, two + '\nshortest = "1 um"')).measured.validity_warnings == ()
    assert read.measured.validity_warnings[0] in st.predict(read).warnings
    assert "different resolutions" in " ".join(command("run", case(folder, two), "--details").stdout.split())


def test_one_hill_is_counted_once(folder):
    """Many profiles cross one hill: of three-point peaks not more are separate than the relation to an area says."""
    surface = st.prepared(st.read_scan(folder / "rough.npy", size="20 um", unit="m"))
    found = st.asperities(surface, "three_point")
    counts = st.read_case(case(folder)).measured.counts
    assert counts["three_point"] == round(found.density * SIZE * SIZE) < found.count / 4
    assert counts["eight_neighbour"] == pytest.approx(st.asperities(surface, "eight_neighbour").count, rel=0.02)


def test_missing_points_are_left_out_or_filled(folder):
    heights = np.load(folder / "rough.npy")
    heights[50:60, 50:60] = np.nan
    np.save(folder / "holed.npy", heights)
    words = ("surface", folder / "holed.npy", "--size", "20 um", "--unit", "m", "--json")
    left, filled = (json.loads(command(*words, *more).stdout) for more in ((), ("--fill", "nearest")))
    assert left["missing_points"] == 100 and "100 missing points filled: harmonic" in left["spectrum_of"]
    assert filled["missing_points"] == 0 and "100 missing points filled: nearest" in filled["history"]
    assert left["Sq"] != filled["Sq"]
    assert command(*words, "--fill", "glue", code=2).stderr.startswith("stiction: fill")


def test_few_asperities_in_contact_are_flagged(folder):
    """The share that touches times the number found: fewer than ten at light loads, which is said, and more at heavy ones."""
    heavy = folder / "heavy.toml"
    heavy.write_text(CASE.format(roughness=ONE).replace('"1 N"', '"30 N"'))
    read = st.read_case(heavy)
    data = st.solve_case(read)
    method = read.measured.method
    touching = data["found_touching_by_method"].sel(asperity_method=method).values
    share = data["touching_asperities"].values / (read.subject.roughness.asperity_density * read.subject.nominal_area)
    assert touching == pytest.approx(share * read.measured.counts[method])
    assert touching[0] < 10.0 < touching[1]
    assert f"{method} up to 1 mN" in data.attrs["outside_validity"]
    assert np.isnan(data["found_touching_by_method"].sel(asperity_method="mccool").values).all()
    assert "mccool at every load" in data.attrs["outside_validity"]


def test_run_writes_the_band(folder):
    out = folder / "out"
    text = command("run", case(folder), "--model", "soft_coating_2015", "--details", "--out", out).stdout
    assert "range over all methods" in " ".join(text.split())
    heads = [line for line in (out / "curve.csv").read_text().splitlines() if not line.startswith("#")]
    assert len(heads) == 3
    assert {"friction_coefficient_low", "friction_coefficient_high", "friction_coefficient_mccool"} <= set(heads[0].split(","))
    with xarray.open_dataset(out / "curve.nc") as data:
        assert data["friction_coefficient_by_method"].dims == ("asperity_method", "load")
    answer = json.loads(command("run", case(folder), "--model", "soft_coating_2015", "--json").stdout)
    assert answer["measured"]["method"] == "eight_neighbour"
    assert set(answer["measured"]["by_method"]["mccool"]) >= {"sigma", "R", "N", "mean_height"}
    assert answer["variables"]["friction_coefficient_by_method"]["dims"] == ["asperity_method", "load"]


SEVERAL = CASE.replace('"0.05 J/m^2"', '["0.02 J/m^2", "0.05 J/m^2"]')


def test_numbers_beside_a_scan_may_be_several(folder, tmp_path):
    """Each as it is alone, by every method; the picture is that of the quantity."""
    path, alone = folder / "several.toml", st.solve_case(st.read_case(case(folder)))
    path.write_text(SEVERAL.format(roughness=ONE))
    both = st.solve_case(st.read_case(path))
    for name in ("friction_coefficient", "friction_coefficient_by_method", "friction_coefficient_low", "contact_area"):
        assert "work_of_adhesion" in both[name].dims
        found = both[name].sel(work_of_adhesion=0.05).transpose(*alone[name].dims)
        np.testing.assert_allclose(found, alone[name], rtol=1e-9)
    command("run", path, "--out", tmp_path / "out")
    assert sorted(one.name for one in (tmp_path / "out").iterdir()) == ["curve.csv", "curve.nc", "curve.png"]


def test_a_sweep_of_a_scan_is_of_the_method_that_stands_for_it(folder, tmp_path):
    pytest.importorskip("zarr")
    path = folder / "swept.toml"
    for model in ("soft_coating_2015", "persson_2001"):
        path.write_text(SEVERAL.format(roughness=ONE) + f'model = "{model}"\n')
        swept, both = st.sweep(path, tmp_path / model), st.solve_case(st.read_case(path))
        np.testing.assert_allclose(swept["contact_area"], both["contact_area"], rtol=1e-9)
        assert swept.attrs["scans"] == both.attrs["scans"]
    assert len(dumps(make_plan(read_content(path), folder))) < 20_000  # no map goes to the workers


@pytest.mark.parametrize(
    "roughness, said",
    [
        (
            ONE + '\nsecond = { asperity_height_deviation = ["1 nm", "2 nm"], asperity_radius = "5 um", '
            'asperity_density = "1e12 1/m^2" }',
            "contact.roughness.second.asperity_height_deviation: 2 numbers, 1 nm to 2 nm; ",
        ),
        (
            ONE + '\nsecond = { asperity_height_deviation = "1 +/- 0.1 nm", asperity_radius = "5 um", '
            'asperity_density = "1e12 1/m^2" }',
            "contact.roughness.second.asperity_height_deviation",
        ),
    ],
)
def test_a_roughness_that_is_measured_is_one(folder, roughness, said):
    with pytest.raises(st.InputError) as refused:
        st.read_case(case(folder, roughness))
    assert str(refused.value).startswith(said)


def test_compare_gives_each_model_its_band(folder):
    answer = json.loads(command("compare", case(folder), "--load", "1 N", "--json", "--out", folder / "compared").stdout)
    rows = {row["model"]: row for row in answer["models"]}
    mu = rows["soft_coating_2015"]["friction_coefficient_by_method"]
    one = st.solve_case(st.read_case(case(folder)))["friction_coefficient_by_method"].sel(load=1.0)
    assert mu == pytest.approx({str(name): float(one.sel(asperity_method=name)) for name in one["asperity_method"].values})
    assert rows["soft_coating_2015"]["friction_coefficient_low"] == pytest.approx(min(mu.values()))
    assert rows["soft_coating_2015"]["friction_coefficient_high"] == pytest.approx(max(mu.values()))
    assert answer["measured"]["method"] == "eight_neighbour"


@pytest.mark.parametrize(
    ("roughness", "field"),
    [
        ('first = { file = "none.npy", size = "20 um", unit = "m" }', "contact.roughness.first"),
        ('first = { file = "rough.npy" }', "contact.roughness.first.unit"),
        ('first = { file = "rough.npy", unit = "m" }', "contact.roughness.first.size"),
        ('first = { file = "rough.npy", size = 20, unit = "m" }', "contact.roughness.first.size"),
        ('first = { file = "rough.npy", size = "20 um", unit = "kg" }', "contact.roughness.first.unit"),
        (ONE + '\nmethod = "guess"', "contact.roughness.method"),
        (ONE + "\nform = 9", "contact.roughness.form"),
        (ONE + '\nshortest = "1 nm"', "contact.roughness.shortest"),
        (ONE + ONE.replace("first", "\nsecond") + '\nheights = "weibull"', "contact.roughness.heights"),
        (ONE + '\nheights = "square"', "contact.roughness.heights"),
        (ONE + '\nasperity_radius = "1 um"', "contact.roughness.asperity_radius"),
        ('first = "rough.npy"', "contact.roughness.first"),
        ('first = { asperity_radius = "1 um" }', "contact.roughness.first.asperity_height_deviation"),
        (ONE + "\nsecond = { files = 1 }", "contact.roughness.second.files"),
        ('second = { file = "line.npy", size = "20 um", unit = "m" }\nmethod = "persistence"', "contact.roughness.method"),
    ],
)
def test_bad_scans_in_a_case_are_one_line(folder, roughness, field):
    result = command("run", case(folder, roughness), code=2)
    assert result.stderr.startswith(f"stiction: {field}") and result.stderr.count("\n") == 1


def test_the_height_distribution_can_be_chosen(folder):
    for name in ("gaussian", "weibull", "empirical"):
        read = st.read_case(case(folder, ONE + f'\nheights = "{name}"'))
        assert read.subject.roughness.height_distribution == name
        assert read.measured.by_method["mccool"].height_distribution == "gaussian"  # it has no heights to fit to


def test_the_schema_knows_scans():
    places = json_schema()["$defs"]["Contact"]["properties"]["roughness"]["anyOf"]
    names = [entry["$ref"].rpartition("/")[2] for entry in places]
    assert names[:2] == ["Roughness", "MeasuredRoughness"]
    assert "file" in json_schema()["$defs"]["Scan"]["properties"]


# ---- stiction surface


def test_surface_prints_closed_forms_of_an_egg_crate(folder):
    """A cos cos: Sq = A/2, 2 of 8 x 8 periods are summits, and R is 1/(A q^2) on infinitely fine points.

    The paraboloid fitted to (2 n + 1)^2 points around sees A q^2 less the mean of what the points farther away see: per axis
    sum (i^2 - mean i^2) cos(q i d) sum cos(q j d) / sum (i^2 - mean i^2)^2, over the points i and j from -n to n.
    """
    answer = json.loads(command("surface", folder / "eggs.npy", "--size", "20 um", "--unit", "m", "--json").stdout)
    assert answer["Sq"] == near(AMPLITUDE / 2.0, rel=1e-9)
    assert answer["size"] == {"x": SIZE, "y": SIZE} and answer["pixels"] == {"x": PITCHES, "y": PITCHES}
    assert answer["missing_points"] == 0
    q = 2.0 * np.pi * 8.0 / SIZE
    period = PITCHES // 8
    summits = np.arange(0, PITCHES, period // 2)  # along a line, every other of which belongs to the next line
    for method, n in (("eight_neighbour", 1), ("persistence", 2)):
        found = answer["asperities"][method]
        i = np.arange(-n, n + 1)
        apart, waves = i * i - np.mean(i * i), np.cos(2.0 * np.pi * i / period)
        curvature = -2.0 * AMPLITUDE * np.sum(apart * waves) * np.sum(waves) / np.sum(apart**2) / len(i) / (SIZE / PITCHES) ** 2
        assert found["R"] == near(1.0 / curvature, rel=1e-6) == near(1.0 / (AMPLITUDE * q * q), rel=0.06)
        here = (summits >= n) & (summits < PITCHES - n)
        count = sum(here[k] and here[m] for k in range(16) for m in range(16) if (k + m) % 2 == 0)
        assert found["N"] == near(count / ((PITCHES - 2 * n) * SIZE / PITCHES) ** 2, rel=1e-9)
    assert set(answer["asperities"]) | set(answer["failures"]) == {
        "three_point",
        "eight_neighbour",
        "persistence",
        "n_point",
        "mccool",
    }


def test_surface_writes_pictures_and_tables(folder):
    out = folder / "surface"
    words = ("surface", folder / "rough.npy", "--size", "20 um", "--unit", "m", "--out", out, "--case", case(folder))
    text = command(*words).stdout
    assert "Sq 28.5 nm" in text
    names = {path.name for path in out.iterdir()}
    assert names == {
        "map.png",
        "spectrum.png",
        "asperities.png",
        "fan.png",
        "fan.csv",
        "fan.nc",
        "spectrum.csv",
        "surface.json",
    }
    for name in names:
        assert (out / name).stat().st_size > 200
    with xarray.open_dataset(out / "fan.nc") as resolution_study:
        assert set(resolution_study.dims) == {"asperity_method", "cutoff"}
        assert np.isfinite(resolution_study["mu"].sel(asperity_method="mccool").values).all()


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["none.npy"], "stiction: scan: 'none.npy'"),
        (["rough.npy"], "stiction: unit"),
        (["rough.npy", "--unit", "m", "--size", "0 um"], "stiction: size"),
        (["rough.npy", "--unit", "m", "--size", "20 um", "--height-scale", "0"], "stiction: height_scale"),
        (["rough.npy", "--unit", "m", "--size", "20 um", "--load", "1 N"], "stiction: --load"),
        (["rough.npy", "--unit", "Mm", "--size", "20 um"], "stiction: scan"),
    ],
)
def test_bad_words_for_surface_are_one_line(folder, monkeypatch, words, said):
    monkeypatch.chdir(folder)
    result = command("surface", *words, code=2)
    assert result.stderr.startswith(said) and result.stderr.count("\n") == 1


# ---- scans of which little is left


def test_a_method_that_finds_nothing_of_use_does_not_stop_the_others(folder):
    """Grooves have no summits but profile peaks along x; equal peaks have no deviation: these methods fail in words."""
    x = 2.0 * np.pi * np.arange(128) / 128
    rows = np.arange(128)[:, None]
    np.save(folder / "grooves.npy", 1e-8 * np.cos(8.0 * x) * (1.0 + 1e-3 * np.sin(0.37 * rows)))
    np.save(folder / "flat_grooves.npy", 1e-8 * np.sin(8.0 * x) * np.ones((128, 1)))
    crate = 'second = { file = "eggs.npy", size = "20 um", unit = "m" }'
    read = st.read_case(case(folder, crate)).measured
    assert "asperity_height_deviation" in read.failures["eight_neighbour"]
    assert "mccool" in read.by_method
    first = 'first = { file = "flat_grooves.npy", size = "20 um", unit = "m" }'
    result = command("run", case(folder, first), code=2)
    assert result.stderr.startswith("stiction: contact.roughness: ") and result.stderr.count("\n") == 1
    two = first + '\nsecond = { file = "rough.npy", size = "20 um", unit = "m" }'
    assert command("run", case(folder, two), code=2).stderr.startswith("stiction: contact.roughness: ")


def test_what_is_all_form_is_refused(folder):
    """An exact plane at an angle leaves only rounding, and so does a parabola without its form."""
    y, x = np.mgrid[0:64, 0:64] / 64.0
    np.save(folder / "plane.npy", 1e-6 * (x + 2.0 * y) + 0.1)
    np.save(folder / "bowl.npy", 1e-6 * (x * x + y * y))
    for name, form in (("plane", 1), ("bowl", 2)):
        words = ("surface", folder / f"{name}.npy", "--size", "20 um", "--unit", "m", "--form", form)
        result = command(*words, code=2)
        assert f"{name}.npy" in result.stderr and result.stderr.count("\n") == 1
    assert command("surface", folder / "bowl.npy", "--size", "20 um", "--unit", "m", "--form", 1).exit_code == 0


def test_spikes_are_told_of_in_a_case(folder):
    said = "1 points of the scan of the first body"
    for spike in (3.3e-7, 4e-6):  # the second alone carries the load, at a separation of hundreds of sigma
        heights = np.load(folder / "rough.npy")
        heights[7, 7] += spike
        np.save(folder / "one.npy", heights)
        read = st.read_case(case(folder, ONE.replace("rough", "one")))
        result = st.solve_case(read)
        assert said in result.attrs["outside_validity"]
        assert np.abs(result["load_residual"]).max() < 1e-10
    assert "spikes" not in st.solve_case(st.read_case(case(folder))).attrs["outside_validity"]


def test_few_points_have_no_reliable_band(folder):
    np.save(folder / "small.npy", np.random.default_rng(1).standard_normal((9, 9)) * 1e-9)
    words = ("surface", folder / "small.npy", "--size", "1 um", "--unit", "m")
    assert json.loads(command(*words, "--json").stdout)["reliable_band"] is None
    assert "too few points" in command(*words, "--details").stdout


def test_masked_points_are_missing():
    heights = np.ma.masked_less(np.arange(100.0).reshape(10, 10) * 1e-9, 5e-9)
    assert st.HeightMap(heights, (1e-6, 1e-6)).missing == 5


def test_a_tip_ends_the_reliable_band(folder):
    words = ("surface", folder / "rough.npy", "--size", "20 um", "--unit", "m", "--json")
    blunt, none = (json.loads(command(*words, *more).stdout)["reliable_band"] for more in (("--tip-radius", "20 um"), ()))
    assert blunt is None or blunt["shortest"] > none["shortest"]
    assert command(*words, "--tip-radius", "0 um", code=2).stderr.startswith("stiction: tip_radius")
