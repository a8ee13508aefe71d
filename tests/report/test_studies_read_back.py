"""Read numbers back from film, slide, sweep, surface and validate, and compare them with closed forms.

Film and sliding: Greenwood and Williamson (1966) over a film that is as stiff as its body, with sums made here by quadrature.
"""

import json
import math

import numpy as np
import pytest
import xarray
from scipy.integrate import quad
from scipy.optimize import minimize_scalar
from scipy.stats import norm
from typer.testing import CliRunner

from report.test_numbers_read_back import BODY, CASE, LOADS, STRENGTH, area, mu, table
from stiction.cli import app

SIGMA, RADIUS, DENSITY, POISSON = 48e-9, 50e-6, 1.7e10, 0.3
MODULUS = 210e9 / (2.0 * (1.0 - POISSON**2))
YIELD = 7.3e9 / 2.8
SHOWN = 5.1e-4  # four digits
SUMS = CASE.replace("200 +/- 20 MPa", "200 MPa").replace("persson_2001", "greenwood_williamson_1966")
SUMS = SUMS.replace('load = ["0.5 N", "2 N"]', "separation = [3.0, 2.0]")
pytestmark = pytest.mark.usefixtures("no_pictures")


def gaussian_sum(power, height):
    """The integral of (z - d)^power over the Gaussian heights z above d, all over sigma."""
    return quad(lambda gap: gap**power * norm.pdf(gap + height), 0.0, 12.0, epsabs=0.0, epsrel=1e-12)[0]


def touching(height):
    """Number, load [N], area [m^2] and tangential stiffness [N/m] of Hertzian asperities of 1 mm^2 (Mindlin 1949: 8 G* a)."""
    number = DENSITY * 1e-6
    shear = 210e9 / (2.0 * (1.0 + POISSON)) / (2.0 * (2.0 - POISSON))  # G* of two bodies
    load = number * 4.0 / 3.0 * MODULUS * math.sqrt(RADIUS) * SIGMA**1.5 * gaussian_sum(1.5, height)
    stiffness = number * 8.0 * shear * math.sqrt(RADIUS * SIGMA) * gaussian_sum(0.5, height)
    real = number * math.pi * RADIUS * SIGMA * gaussian_sum(1.0, height)
    return number * gaussian_sum(0.0, height), load, real, stiffness


def called(*words):
    done = CliRunner().invoke(app, [str(word) for word in words])
    assert done.exit_code == 0, (done.output, done.exception)
    return done.stdout


def shown(tmp_path, command, *options):
    """Return the lines of words of a command, its folder and its JSON."""
    lines = [line.split() for line in called(*command, *options, "--out", tmp_path / "out").splitlines()]
    return lines, tmp_path / "out", json.loads(called(*command, *options, "--json"))


@pytest.fixture
def sums(tmp_path):
    def written(more=""):
        (tmp_path / "case.toml").write_text(SUMS + more, encoding="utf-8")
        return tmp_path / "case.toml"

    return written


def test_sliding(tmp_path, sums):
    lines, out, found = shown(tmp_path, ["slide", sums()])
    rows = [row for row in table(out / "sliding.csv") if float(row["displacement [m]"]) == 0.0]
    for at, height in enumerate((3.0, 2.0)):
        number, load, real, stiffness = touching(height)
        exact = [1e9 * height * SIGMA, 1e3 * load, STRENGTH * real / load, STRENGTH * real / load]  # nm, mN
        printed = next(line for line in lines if len(line) == 6 and line[0] == f"{1e9 * height * SIGMA:g}")
        np.testing.assert_allclose([float(word) for word in printed[:4]], exact, rtol=SHOWN)
        assert float(printed[5]) == pytest.approx(1e-6 * stiffness, rel=SHOWN)  # MN/m
        moved = np.ravel(found["variables"]["sliding_displacement"]["values"])[at]
        assert float(printed[4]) == pytest.approx(1e9 * moved, rel=SHOWN)  # nm
        names = ("touching_asperities", "load [N]", "contact_area [m^2]", "tangential_stiffness [N/m]")
        np.testing.assert_allclose([float(rows[at][name]) for name in names], [number, load, real, stiffness], rtol=1e-7)
        given = [np.ravel(found["variables"][name.split()[0]]["values"])[at] for name in names]
        np.testing.assert_allclose(given, [number, load, real, stiffness], rtol=1e-7)


def stress_on_the_axis():
    """The largest von Mises stress under a Hertzian contact without friction, over its largest pressure."""

    def minus(depth):
        radial = (1.0 + POISSON) * (1.0 - depth * math.atan(1.0 / depth)) - 0.5 / (1.0 + depth**2)
        return radial - 1.0 / (1.0 + depth**2)

    return -minimize_scalar(minus, bounds=(0.1, 1.0), method="bounded").fun


def test_film(tmp_path, sums):
    """A film as stiff and hard as its body leaves Hertz's stresses under the mean touching asperity; there is no friction."""
    film = f'[contact.coating]\nmaterial = {BODY}\nbodies = "first"\nthickness = "0.4 um"\n'
    case = sums(film)
    case.write_text(case.read_text(encoding="utf-8").replace("200 MPa", "1 kPa"), encoding="utf-8")
    lines, out, found = shown(tmp_path, ["film", case])
    units = next(line for line in lines if line[:1] == ["[nm]"])
    for at, (height, row) in enumerate(zip((3.0, 2.0), table(out / "film.csv"), strict=True)):
        number, load, real, _ = touching(height)
        radius = math.sqrt(real / (math.pi * number)) / 0.4e-6
        stress = stress_on_the_axis() * 1.5 * load / real / YIELD
        printed = next(line for line in lines if line[:1] == [f"{1e9 * height * SIGMA:g}"])
        value = float(printed[1]) * {"[N]": 1.0, "[mN]": 1e-3}[units[1]]
        assert value == pytest.approx(load, rel=SHOWN)
        assert [float(word) for word in printed[2:5]] == pytest.approx([1e3 * real / load, radius, stress], rel=2e-3)
        names = ("load [N]", "contact_area [m^2]", "contact_over_thickness", "stress_over_yield")
        np.testing.assert_allclose([float(row[name]) for name in names], [load, real, radius, stress], rtol=1e-3)
        given = [np.ravel(found["variables"][name.split()[0]]["values"])[at] for name in names]
        np.testing.assert_allclose(given, [load, real, radius, stress], rtol=1e-3)
        ends = [np.ravel(found["variables"][name]["values"])[at] for name in ("interface_tension", "interface_shear")]
        assert [float(word) for word in printed[-2:]] == pytest.approx(ends, rel=SHOWN)


def test_sweep(tmp_path):
    case = CASE.replace('"200 +/- 20 MPa"', '["100 MPa", "200 MPa", "300 MPa"]')
    (tmp_path / "case.toml").write_text(case, encoding="utf-8")
    text = called("sweep", tmp_path / "case.toml", "--out", tmp_path / "store")
    assert any(line.startswith("6 points, 6 of them computed now in ") for line in text.splitlines())
    found = json.loads(called("sweep", tmp_path / "case.toml", "--out", tmp_path / "store", "--json"))
    assert (found["points"], found["computed_now"], found["dims"]) == (6, 0, {"interfacial_shear_strength": 3})
    stored = xarray.open_zarr(tmp_path / "store", consolidated=False)
    for strength in (100e6, 200e6, 300e6):
        for load in LOADS:
            point = stored.sel(interfacial_shear_strength=strength, load=load)
            read = [float(point[name]) for name in ("friction_coefficient", "contact_area", "friction_force")]
            assert read == pytest.approx([mu(load, strength), area(load), mu(load, strength) * load], rel=1e-9)


def test_surface(tmp_path):
    """Cosines of 50 nm, 4 waves along x, and of 30 nm, 6 waves along y; slopes are the 127 differences of neighbours."""
    size, count = 10e-6, 128
    phase = 2.0 * math.pi * np.arange(count) / count
    np.save(tmp_path / "waves.npy", np.add.outer(30.0 * np.cos(6 * phase), 50.0 * np.cos(4 * phase)))
    options = ["--size", "10 um", "--unit", "nm", "--periodic", "--details"]
    command = ["surface", tmp_path / "waves.npy"]
    lines, out, found = shown(tmp_path, command, *options)
    rms, slopes = [], []
    for height, waves in ((50e-9, 4), (30e-9, 6)):
        rms.append(height / math.sqrt(2.0))
        half = (
            math.pi * waves / count
        )  # of the phase between neighbours: the difference that would close the period is left out
        squares = (count / 2.0 - math.sin(half) ** 2) / (count - 1)
        slopes.append(height * 2.0 * math.sin(half) / (size / count) * math.sqrt(squares))
    heights, slope = (next(line for line in lines if line[:1] == [word]) for word in ("heights", "rms"))
    assert [float(heights[3]), heights[4]] == [pytest.approx(1e9 * math.hypot(*rms), rel=SHOWN), "nm,"]
    heights_nm = np.load(tmp_path / "waves.npy")
    ends = [float(np.mean(np.abs(heights_nm))), float(np.ptp(heights_nm))]
    assert [float(heights[7]), float(heights[11])] == pytest.approx(ends, rel=SHOWN)
    radii = [1e6 * one["R"] for one in found["asperities"].values()]
    brief = next(line.split() for line in called(*command, *options[:-1]).splitlines() if line.startswith("Asperities"))
    assert "skewness 0, " in called(*command, *options[:-1])  # by symmetry, not what rounding leaves of it
    at = brief.index("R")
    assert [float(brief[at + 2]), float(brief[at + 5])] == pytest.approx([min(radii), max(radii)], rel=0.051)
    assert [float(slope[at]) for at in (2, 5, 8)] == pytest.approx([*slopes, math.hypot(*slopes)], rel=SHOWN)
    for record in (found, json.loads((out / "surface.json").read_text(encoding="utf-8"))):
        read = [record["statistics"][name] for name in ("Sq", "slope_x", "slope_y", "slope")]
        assert read == pytest.approx([math.hypot(*rms), *slopes, math.hypot(*slopes)], rel=1e-9)
    # the spectral density, per wavelength^-1 along x and y, sums to the variance
    spectrum = table(out / "spectrum.csv")
    variance = sum(float(row["density [m^4]"]) * int(row["waves"]) for row in spectrum) / size**2
    assert variance == pytest.approx(math.hypot(*rms) ** 2, rel=1e-3)


def test_validate(tmp_path):
    """Two measured values, 0.8 and 1.1 of the exact friction: the mean ratio, and by what factor the model is off."""
    measured = [0.8 * mu(LOADS[0]), 1.1 * mu(LOADS[1])]
    rows = "".join(f"{load!r},{value!r},0.01\n" for load, value in zip(LOADS, measured, strict=True))
    (tmp_path / "values.csv").write_text(f"load [N],friction_coefficient,friction_coefficient_error\n{rows}", encoding="utf-8")
    said = '[measured]\nfile = "values.csv"\nkind = "synthetic"\nread = "computed"\nsource = "made up"\n'
    contact = CASE.replace("200 +/- 20 MPa", "200 MPa").split("[solve]")[0]
    (tmp_path / "entry.toml").write_text(said + contact, encoding="utf-8")
    lines, out, found = shown(tmp_path, ["validate", tmp_path / "entry.toml"])
    logs = [-math.log(0.8), -math.log(1.1)]
    exact = [math.exp(sum(logs) / 2.0), math.exp(math.hypot(*logs) / math.sqrt(2.0))]
    printed = next(line for line in lines if line[:1] == ["persson_2001"])
    assert int(printed[2]) == 2 and [float(word) for word in printed[3:5]] == pytest.approx(exact, rel=5.1e-3)
    for row, load, value in zip(table(out / "entry.csv"), LOADS, measured, strict=True):
        assert [float(row["measured"]), float(row["persson_2001"])] == pytest.approx([value, mu(load)], rel=1e-9)
    (model,) = [one for one in found["entry"]["models"] if one["model"] == "persson_2001"]
    assert [model["bias"], model["factor"]] == pytest.approx(exact, rel=1e-9)
    assert model["predicted"] == pytest.approx([mu(load) for load in LOADS], rel=1e-9)
