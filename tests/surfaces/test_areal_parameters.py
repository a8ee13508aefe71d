"""Areal parameters: closed forms of surfaces that have them, and other libraries on real scans."""

import csv
import json
import math
from dataclasses import asdict
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

import stiction as st
from conftest import SCANS
from stiction.cli import app
from stiction.surfaces.areal_parameters import areal_parameters, profile_parameters
from stiction.surfaces.prepare import level
from stiction.surfaces.read import read_scan
from stiction.surfaces.statistics import statistics

PITCH = 1e-8
with (Path(__file__).parent / "areal_parameters.csv").open(encoding="utf-8") as table:
    ROWS = list(csv.DictReader(table))


def map_of(heights, pitch=(PITCH, PITCH)):
    return st.HeightMap(np.asarray(heights, dtype=float), size=tuple(n * p for n, p in zip(heights.shape, pitch, strict=True)))


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row["file"])
def test_other_libraries_on_real_scans(row):
    path = SCANS / row["file"]
    if not path.exists():
        pytest.skip(f"{path.name} is not there")
    scan = level(read_scan(path))
    of_heights = statistics(scan)
    heights = {name: getattr(of_heights, name) for name in ("Sq", "Sa", "Sz", "Ssk", "Sku")}
    for name, value in (heights | asdict(areal_parameters(scan))).items():
        assert value == pytest.approx(float(row[name]), rel=1e-8), name


def test_a_ramp():
    """Heights evenly spread over h: the curve is a line, all core; area sqrt(1 + slope^2)."""
    heights = np.broadcast_to(np.linspace(0.0, 1e-7, 401), (50, 401))
    found = areal_parameters(map_of(heights))
    slope = 1e-7 / 400 / PITCH
    assert found.Sdr == pytest.approx(math.sqrt(1.0 + slope**2) - 1.0, rel=1e-6)
    assert (found.Sp, found.Sv) == pytest.approx((5e-8, 5e-8))
    assert found.Sk == pytest.approx(1e-7, rel=5e-3)
    assert max(found.Spk, found.Svk) < 1e-9 and found.Smr1 < 0.01 and found.Smr2 > 0.99


def test_a_wave_has_the_length_of_its_cosine():
    """The autocorrelation of a cosine is one: it falls to 0.2 at acos(0.2)/q, and never along the crests."""
    q = 2 * math.pi / (40 * PITCH)
    x = np.arange(800) * PITCH
    found = areal_parameters(map_of(np.broadcast_to(1e-9 * np.cos(q * x), (200, 800))))
    assert found.Sal == pytest.approx(math.acos(0.2) / q, rel=0.01) and found.Str is None


def test_two_lengths_make_the_aspect_ratio():
    """Noise filtered by a Gaussian of width w has the autocorrelation exp(-r^2/(4 w^2)): lengths are as the widths."""
    from scipy.ndimage import gaussian_filter

    noise = np.random.default_rng(1).normal(size=(1024, 1024))
    found = areal_parameters(map_of(gaussian_filter(noise, (12, 6), mode="wrap")))
    assert found.Sal == pytest.approx(2 * 6 * math.sqrt(math.log(5)) * PITCH, rel=0.05)
    assert found.Str == pytest.approx(0.5, rel=0.06)


def test_a_gaussian_surface():
    """Material ratio of normal heights: the 40 % least steep are its middle, and a line is fitted to them."""
    from scipy.stats import norm

    heights = np.random.default_rng(2).normal(size=(600, 600))
    found = areal_parameters(map_of(1e-9 * heights))
    ratio = np.linspace(0.3, 0.7, 4001)
    slope, _ = np.polyfit(ratio, norm.isf(ratio), 1)
    assert found.Sk == pytest.approx(-slope * 1e-9, rel=0.02)
    ends = norm.sf([-slope / 2, slope / 2])
    assert (found.Smr1, found.Smr2) == pytest.approx(ends.tolist(), abs=0.01)


def test_missing_points_and_unequal_pitches():
    noise = np.random.default_rng(3).normal(size=(300, 200))
    from scipy.ndimage import gaussian_filter

    heights = 1e-9 * gaussian_filter(noise, 4, mode="wrap")
    whole = asdict(areal_parameters(map_of(heights, (PITCH, 2 * PITCH))))
    heights[np.random.default_rng(4).random(heights.shape) < 0.02] = np.nan
    holed = asdict(areal_parameters(map_of(heights, (PITCH, 2 * PITCH))))
    for name, value in whole.items():
        assert holed[name] == pytest.approx(value, rel=0.15 if name in ("Sp", "Sv", "Spk", "Svk") else 0.03), name


def test_the_command(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    np.save(tmp_path / "scan.npy", 1e-9 * np.random.default_rng(5).normal(size=(64, 64)))
    words = ["surface", "scan.npy", "--size", "1 um", "--unit", "m"]
    told = json.loads(CliRunner().invoke(app, [*words, "--json"]).stdout)
    assert {"Sp", "Sdr", "Sal", "Str", "Sk", "Smr2"} <= set(told["iso_25178_2"])
    shown = CliRunner().invoke(app, [*words, "--details"])
    assert shown.exit_code == 0 and "ISO 25178-2" in shown.stdout and "Spk = " in shown.stdout


def test_a_profile_has_the_names_of_its_standard():
    """A sine of amplitude a: Pa = 2 a/pi, Pq = a/sqrt(2), Pt = 2 a, skewness 0, kurtosis 1.5."""
    x = np.arange(4000) / 4000
    profile = st.HeightMap(1e-6 * np.sin(2 * math.pi * 10 * x)[None], size=(1e-6, 1e-3))
    found = profile_parameters(profile, statistics(profile))
    slope = 1e-6 * 2 * math.pi * 10 / 1e-3 / math.sqrt(2)
    expected = {"Pa": 2e-6 / math.pi, "Pq": 1e-6 / math.sqrt(2), "Pt": 2e-6, "Psk": 0.0, "Pku": 1.5, "Pdq": slope}
    assert found == pytest.approx(expected, rel=1e-3, abs=1e-9)
    filtered = st.prepared(profile, form=0, longest="0.5 mm")
    assert list(profile_parameters(filtered, statistics(filtered))) == ["Ra", "Rq", "Rt", "Rsk", "Rku", "Rdq"]
    fine = st.prepared(profile, form=0, shortest="5 um")
    assert "Pq" in profile_parameters(fine, statistics(fine))
