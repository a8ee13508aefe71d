"""`stiction film`: the table, the files and the picture; the section by hand; bad input in one line."""

import json
import math

import numpy as np
import pytest
import xarray
from numpy.testing import assert_allclose
from typer.testing import CliRunner

import stiction as st
from stiction.cli import app
from stiction.laws.tangential.shared.hamilton_field import stress, von_mises
from stiction.quantities.errors import InputError
from stiction.studies.stresses.film_section import film_section
from stiction.studies.stresses.film_stress import middle_point

CASE = """
title = "A hard film on steel"
[contact]
first = "hardened_steel_52100"
second = "hardened_steel_52100"
nominal_area = "1 mm^2"
interfacial_shear_strength = "300 MPa"
[contact.roughness]
asperity_height_deviation = "50 nm"
asperity_radius = "20 um"
asperity_density = "1.7e10 1/m^2"
[contact.coating]
material = { youngs_modulus = "600 GPa", poissons_ratio = 0.2, hardness = "14 GPa" }
thickness = "0.4 um"
bodies = "first"
[solve]
model = "greenwood_williamson_1966"
load = ["0.1 N", "1 N", "5 N"]
"""
BARE = CASE.replace(CASE[CASE.index("[contact.coating]") : CASE.index("[solve]")], "")


def run(path, *words, code=0):
    result = CliRunner().invoke(app, ["film", str(path), *words])
    assert result.exit_code == code, result.output
    return result


@pytest.fixture
def case(tmp_path):
    path = tmp_path / "case.toml"
    path.write_text(CASE)
    return path


def test_table_files_and_picture(case, tmp_path):
    shown = run(case, "--details", "--out", str(tmp_path / "out")).stdout
    assert "[N]" in shown and "tension" in shown and "interface" in shown and "layered" in shown
    assert sorted(one.name for one in (tmp_path / "out").iterdir()) == ["film.csv", "film.nc", "film.png", "section.nc"]
    section, data = (xarray.open_dataset(tmp_path / "out" / name, engine="h5netcdf") for name in ("section.nc", "film.nc"))
    middle = data.isel(load=1)
    assert section.attrs["largest"] == pytest.approx(float(middle["stress_over_yield"]), rel=1e-9)
    assert section.attrs["film_thickness"] == pytest.approx(400e-9, rel=1e-9)
    assert section.attrs["contact_radius"] == pytest.approx(400e-9 * float(middle["contact_over_thickness"]), rel=1e-9)
    assert section.attrs["where"] == str(middle["yields_first"].values) == "interface"
    assert section["interface_normal_stress"].attrs["units"] == "Pa"
    assert 0.85 * section.attrs["largest"] < float(section["stress_over_yield"].max()) < 1.02 * section.attrs["largest"]


def test_one_load_as_json(case):
    content = json.loads(run(case, "--load", "2 N", "--json").stdout)
    same = st.film_stresses(st.read_case(case).subject, load="2 N", model="greenwood_williamson_1966")
    values = {name: np.ravel(one["values"]) for name, one in content["variables"].items()}
    for name in ("stress_over_yield", "interface_shear", "contact_over_thickness"):
        assert_allclose(values[name], np.ravel(same[name].values), rtol=1e-12)
    assert content["variables"]["load"]["unit"] == "N" and content["attrs"]["film"] == "layered"
    assert any(warning["quantity"] == "stress_over_yield" for warning in content["attrs"]["validity_warnings"])


def test_a_film_like_its_body_has_hamiltons_stresses():
    """Place by place, and along the plane of the interface; over the mean pressure, as groups have no unit."""
    given = st.Indices(
        theta=1e9, lam=1e20, nu=0.3, n_E=1.0, n_H=1.0, tau=1.0, film_aspect=0.4, layer_nu=0.3, shear_strength=0.05
    )
    laws = {"model": "greenwood_williamson_1966", "asperity": "hertz", "tangential": "bowden_tabor_1943"}
    point = st.film_stresses(given, separation=1.0, **laws)
    section = film_section(given, point)
    depth, mu = section.attrs["thickness_over_radius"], float(point["friction_coefficient"])
    assert depth == pytest.approx(1.0 / float(point["contact_over_thickness"]), rel=1e-12)
    x, z = section["x"].values, section["z"].values
    expected = von_mises(stress(x[None, :], 0.0, z[:, None], mu, 0.3))
    found = section["stress_over_yield"].values
    scale = found[20, 40] / expected[20, 40]
    inside = np.abs(np.hypot(x[None, :] ** 2 - 1.0, 0.0) + 0.0 * z[:, None]) > 1e-6
    assert_allclose(found[inside], scale * expected[inside], rtol=1e-5, atol=1e-7)
    _, _, zz, _, _, xz = stress(x, 0.0 * x, np.full(x.shape, depth), mu, 0.3)
    assert_allclose(section["interface_normal_stress"].values, 1.5 * zz, atol=1e-6)
    assert_allclose(section["interface_shear_stress"].values, 1.5 * xz, atol=1e-6)


@pytest.mark.usefixtures("no_pictures")
def test_a_softer_counterbody_yields_in_place_of_the_film(tmp_path):
    """A film of 20 GPa meets a metal of 1 GPa: where the film would be the first to yield that metal does."""
    path, out = tmp_path / "case.toml", tmp_path / "out"
    soft = 'second = { youngs_modulus = "70 GPa", poissons_ratio = 0.3, hardness = "1 GPa" }'
    text = CASE.replace('second = "hardened_steel_52100"', soft).replace('"14 GPa"', '"20 GPa"').replace("0.4 um", "4 um")
    path.write_text(text)
    shown = run(path, "--out", str(out)).stdout
    assert "counterbody" in shown
    data = xarray.open_dataset(out / "film.nc", engine="h5netcdf")
    assert set(data["yields_first"].values) == {"counterbody"}
    assert xarray.open_dataset(out / "section.nc", engine="h5netcdf").attrs["where"] == "counterbody"


@pytest.mark.usefixtures("empty_pictures")
def test_where_files_are_fits_the_terminal(case, tmp_path):
    out = tmp_path / "a folder"
    lines = run(case, "--out", str(out)).stdout.splitlines()
    first = next(at for at, line in enumerate(lines) if line.startswith("written to"))
    names = [name.strip(" ,") for name in " ".join(lines[first:]).replace(str(out), "").split(":")[1].split()]
    assert sorted(names) == sorted(one.name for one in out.iterdir())
    longest = len(str(out).rsplit(" ", 1)[0]) + len("written to ")
    assert all(len(line) <= max(80, longest) for line in lines[first:])


def test_what_cannot_be(case, tmp_path):
    bare = tmp_path / "bare.toml"
    bare.write_text(BARE)
    said = {
        (str(bare),): "coating: not given; allowed: a film with material and thickness",
        (str(bare), "--model", "recommended"): "coating: not given; allowed: a film with material and thickness",
        (str(case), "--load", "much"): "--load: 'much'",
        (str(case), "--load", "-1 N"): "load: '-1 N'",
        (str(case), "--tangential", "hamilton_1983"): "take layered_first_yield",
        (str(case), "--model", "persson_2001"): "because this contact has a film",
    }
    for words, text in said.items():
        result = run(*words, code=2)
        assert result.stdout == "" and text in result.stderr and result.stderr.count("\n") == 1
    thick = st.Indices(theta=1, lam=1, n_E=1, n_H=1, tau=1)
    with pytest.raises(InputError, match="film_aspect: not given"):
        st.film_stresses(thick, separation=1.0)
    apart = st.film_stresses(
        st.Indices(theta=1, lam=1, n_E=1, n_H=1, tau=1, film_aspect=1), separation=[60.0, 59.0], asperity="hertz",
        tangential="none", model="greenwood_williamson_1966",
    )  # fmt: skip
    assert math.isnan(float(middle_point(apart)["stress_over_yield"]))
    with pytest.raises(InputError, match="at which asperities touch"):
        film_section(st.Indices(theta=1, lam=1, n_E=1, n_H=1, tau=1, film_aspect=1), middle_point(apart))


@pytest.mark.parametrize(("counterbody", "said"), [("hardened_steel_52100", True), ("silicon_carbide", False)])
def test_it_is_said_that_a_counterbody_yields_before_the_film(tmp_path, counterbody, said):
    path = tmp_path / "case.toml"
    path.write_text(CASE.replace('second = "hardened_steel_52100"', f'second = "{counterbody}"'), encoding="utf-8")
    told = CliRunner().invoke(app, ["film", str(path), "--details", "--load", "1 N"])
    assert told.exit_code == 0 and ("softer than the film" in " ".join(told.output.split())) == said
