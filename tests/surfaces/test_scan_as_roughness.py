"""In Python a scan is a roughness: the same results as from a case file that names it, for whatever holds the scan."""

import contextlib
import json
import subprocess
import sys

import numpy as np
import pytest
import xarray

import stiction as st
from stiction.surfaces.finding import methods

SIZE = 20e-6
SPECTRUM = st.SelfAffine(hurst=0.8, rolloff=5e-6, shortest=0.6e-6, deviation=30e-9)
BODIES = {
    "first": "silver",
    "second": "hardened_steel_52100",
    "work_of_adhesion": "0.05 J/m^2",
    "interfacial_shear_strength": "20 MPa",
    "nominal_area": "1 mm^2",
}
WAVY = np.cos(np.arange(32) * 0.8)[:, None] * np.cos(np.arange(32) * 0.7) * 1e-9
PAPER = "soft_coating_2015"
CASE = """
[contact]
first = "silver"
second = "hardened_steel_52100"
work_of_adhesion = "0.05 J/m^2"
interfacial_shear_strength = "20 MPa"
nominal_area = "1 mm^2"
roughness = {roughness}
[solve]
model = "soft_coating_2015"
load = ["1 mN", "1 N"]
"""


@pytest.fixture(scope="module")
def scan() -> st.HeightMap:
    return st.gaussian_surface((128, 128), (SIZE, SIZE), SPECTRUM, 1)


@pytest.fixture(scope="module")
def case(scan, tmp_path_factory):
    """The case of a file with this scan."""
    folder = tmp_path_factory.mktemp("scans")
    np.save(folder / "rough.npy", scan.heights)

    def read(**more):
        given = [
            'first = { file = "rough.npy", size = "20 um", unit = "m", periodic = true }',
            *(f'{key} = "{value}"' for key, value in more.items()),
        ]
        (folder / "case.toml").write_text(CASE.replace("{roughness}", "{ " + ", ".join(given) + " }"))
        return st.read_case(folder / "case.toml")

    return read


def alike(found: xarray.Dataset, expected: xarray.Dataset) -> None:
    """The same variables and validity warnings; what differs is how the scan came."""
    assert set(found.variables) == set(expected.variables)
    for name in expected.variables:
        if expected[name].dtype.kind == "f":  # plain Python at first, compiled loops later: the last digit may differ
            atol = 1e-13 if name == "load_residual" else 0.0
            np.testing.assert_allclose(found[name].values, expected[name].values, rtol=1e-13, atol=atol, err_msg=str(name))
        else:
            np.testing.assert_array_equal(found[name].values, expected[name].values, err_msg=str(name))
        assert found[name].dims == expected[name].dims
    for name in ("roughness_method", "outside_validity", "validity_warnings", "sources", "model"):
        assert found.attrs.get(name) == expected.attrs.get(name), name


def test_a_scan_is_solved_as_from_a_case(scan, case):
    contact = st.Contact(**BODIES, roughness=scan)
    assert contact.roughness.model_dump() == case().subject.roughness.model_dump()
    assert set(contact.roughness.measured.by_method) == {"three_point", "eight_neighbour", "persistence", "n_point", "mccool"}
    result = st.solve(contact, load=["1 mN", "1 N"], model=PAPER)
    alike(result, st.solve_case(case()))
    assert result["friction_coefficient_by_method"].sizes == {"asperity_method": 5, "load": 2}
    assert (result["friction_coefficient_low"] < result["friction_coefficient_high"]).all()
    assert "levelled" in result.attrs["scans"] and json.loads(result.attrs["validity_warnings"])


def test_theories_of_the_surface_take_its_moments(scan, case):
    words = {"model": "persson_2001", "tangential": "bowden_tabor_1943"}
    found = st.solve(st.Contact(**BODIES, roughness=scan), load=["1 mN", "1 N"], **words)
    read = case()
    alike(found, st.solve_case(read, read.choice.with_changes(words, {})))
    assert found.attrs["roughness_method"] == "mccool" and found["asperity_method"].values.tolist() == ["mccool"]
    of_moments = st.Contact(**BODIES, roughness={"first": scan, "method": "mccool"})
    alike(st.solve(of_moments, load=["1 mN", "1 N"], **words), found)
    assert st.solve(of_moments, load="1 N", model=PAPER).sizes["asperity_method"] == 5


def test_a_scan_is_compared_as_from_a_case(scan, case):
    found = st.compare(st.Contact(**BODIES, roughness=scan), load="1 N")
    expected = st.compare_case(case(), load=1.0)
    name = "friction_coefficient_at_load_by_method"
    np.testing.assert_allclose(found[name].values, expected[name].values, rtol=1e-13)
    assert found[name].sizes["asperity_method"] == 5
    assert found.attrs["roughness_method"] == expected.attrs["roughness_method"]


def test_whatever_holds_it(scan):
    expected = st.Contact(**BODIES, roughness=scan).roughness.replace()
    held = [
        scan.to_xarray(),
        (scan.heights, "20 um"),
        (scan.heights, (SIZE, SIZE)),
        {"first": scan},
        {"second": (scan.heights, SIZE)},
    ]
    with contextlib.suppress(st.InputError):  # an optional extra
        held.append(scan.to_topography())
    for one in held:
        found = st.Contact(**BODIES, roughness=one).roughness
        assert found.measured is not None
        for name in ("asperity_height_deviation", "asperity_radius", "asperity_density"):
            assert getattr(found, name) == pytest.approx(getattr(expected, name), rel=1e-9)


def test_how_asperities_are_found_may_be_given_with_it(scan, case):
    contact = st.Contact(**BODIES, roughness={"first": scan, "method": "persistence", "shortest": "1 um"})
    assert contact.roughness.measured.method == "persistence"
    alike(st.solve(contact, load=["1 mN", "1 N"], model=PAPER), st.solve_case(case(method="persistence", shortest="1 um")))
    other = st.gaussian_surface((128, 128), (SIZE, SIZE), SPECTRUM, 2)
    both = st.Contact(**BODIES, roughness={"first": scan, "second": other}).roughness
    one = st.Contact(**BODIES, roughness=scan).roughness
    assert both.asperity_height_deviation > one.asperity_height_deviation  # variances add


def test_the_measurement_goes_with_the_roughness(scan):
    contact = st.Contact(**BODIES, roughness=scan)
    moved = contact.replace(nominal_area="2 mm^2", work_of_adhesion="0.1 J/m^2")
    assert moved.measured is contact.measured and "friction_coefficient_low" in st.solve(moved, load="1 N", model=PAPER)
    for plain in (contact.as_numbers(), contact.replace(roughness=contact.roughness.replace(asperity_radius="1 um"))):
        assert plain.measured is None and "friction_coefficient_low" not in st.solve(plain, load="1 N", model=PAPER)
    assert float(st.solve(contact.as_numbers(), load="1 N", model=PAPER)["friction_coefficient"]) == pytest.approx(
        float(st.solve(contact, load="1 N", model=PAPER)["friction_coefficient"]), rel=1e-14
    )


def test_sweeps_have_their_spread(scan):
    """At every point that of the contact alone, along loads, separations and a swept number, in tension too."""
    gamma = st.axis("work_of_adhesion", [0.05, 0.2])
    contact = st.Contact(**BODIES | {"work_of_adhesion": gamma}, roughness=scan)
    for points in ({"load": ["1 mN", "1 N"]}, {"separation": ["150 nm", "0 nm"]}, {"load": "1 N"}):
        swept = st.solve(contact, **points, model=PAPER)
        for at, value in enumerate(gamma.values):
            alone = st.solve(contact.replace(work_of_adhesion=float(value)), **points, model=PAPER)
            for name in ("friction_coefficient_by_method", "friction_coefficient_low", "friction_coefficient_high"):
                found = swept[name].isel(work_of_adhesion=at)
                np.testing.assert_allclose(found.values, alone[name].values, rtol=1e-7)
                assert found.dims == alone[name].dims
    assert np.isnan(swept["friction_coefficient_by_method"].values).sum() == 0


def test_each_method_at_the_loads_of_the_first(scan):
    result = st.solve(st.Contact(**BODIES, roughness=scan), separation=["60 nm", "0 nm"], model=PAPER)
    contacts = st.Contact(**BODIES, roughness=scan)
    by_method = contacts.measured.contacts(contacts)
    for method in result["asperity_method"].values:
        for at, load in enumerate(result["load"].values):
            alone = st.solve(by_method[method], load=float(load), model=PAPER)["friction_coefficient"]
            assert float(result["friction_coefficient_by_method"].sel(asperity_method=method)[at]) == pytest.approx(
                float(alone), rel=1e-7
            )


@pytest.mark.parametrize(
    ("roughness", "said"),
    [
        (np.zeros((16, 16)), "roughness: 'ndarray'; allowed: a HeightMap, a topography"),
        ((np.zeros((16, 16)), "1 um"), "roughness: an array: constant heights"),
        ((np.eye(16) * 1e-9, "1 N"), "roughness.size: '1 N'"),
        ({"first": np.zeros((16, 16))}, "roughness.first: 'ndarray'; allowed: a HeightMap"),
        ({"first": {"file": "nowhere.npy"}}, "roughness.first.file: 'nowhere.npy'"),
        ({"first": (np.eye(16) * 1e-9, "1 um"), "methd": "mccool"}, "roughness.methd: unknown key; allowed: method"),
        ({"first": (WAVY, "1 um"), "method": "mcool"}, "roughness.method: 'mcool'; allowed: "),
        (3.0, "roughness: 3.0; allowed: a table with sigma, R and N"),
        ("scan.npy", "roughness: 'scan.npy'; allowed: a table with sigma, R and N"),
    ],
)
def test_what_is_no_roughness_is_one_line(roughness, said):
    with pytest.raises(st.InputError) as error:
        st.Contact(**BODIES, roughness=roughness)
    assert str(error.value).startswith(said) and "\n" not in str(error.value)


def test_a_period_whose_ends_do_not_meet_is_told(scan):
    """A tilt does it, of rows or of columns; what is one period has no such step."""
    assert "do not match" not in st.prepared(scan, period=True).history[-1]
    row = np.linspace(0.0, 1.0, 128)
    for tilt in (row[:, None], row):
        tilted = scan.with_heights(scan.heights + 1e-6 * tilt, "tilted")
        assert "do not match" in st.prepared(tilted, period=True).history[-1]


def test_a_contact_reads_scans_without_the_package():
    """The room of contacts asks the room of surfaces below it: no name of `stiction` has to be used before."""
    program = (
        "import numpy as np; from stiction.contact.contact import Contact; x = np.random.default_rng(1).normal(size=(64, 64));"
        "one = Contact(first='copper', second='copper', nominal_area=1e-10, roughness=(1e-9 * x, '10 um'));"
        "print(one.roughness.measured.method)"
    )
    done = subprocess.run([sys.executable, "-c", program], check=True, capture_output=True, text=True)
    assert done.stdout.strip() in methods()
