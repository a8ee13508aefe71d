"""Containers of contact.engineering: written by the library SurfaceTopography, read back measurement by measurement."""

import sys
import zipfile

import numpy as np
import pytest

import stiction as st
from refusals import refusal

SPECTRUM = st.SelfAffine(hurst=0.8, rolloff="4 um", shortest="400 nm", deviation="10 nm")


@pytest.fixture
def packed(tmp_path):
    """Path of a container of two maps, of one unit each, and these maps."""
    library = pytest.importorskip("SurfaceTopography", reason="the extra that reads instrument files is not installed")
    containers = pytest.importorskip("SurfaceTopography.Container.SurfaceContainer")
    writer = pytest.importorskip("SurfaceTopography.Container.IO")
    coarse = st.gaussian_surface((128, 96), ("20 um", "15 um"), SPECTRUM, seed=1)
    fine = st.gaussian_surface((64, 64), ("5 um", "5 um"), SPECTRUM, seed=2)
    topographies = [
        library.Topography(
            part.heights.T * factor, tuple(factor * length for length in part.size[::-1]), periodic=True, unit=unit, info=info
        )
        for part, factor, unit, info in ((coarse, 1e6, "µm", {"name": "coarse"}), (fine, 1e9, "nm", {"name": "fine"}))
    ]
    path = tmp_path / "surface.zip"
    writer.write_containers([containers.InMemorySurfaceContainer(topographies)], str(path))
    return path, coarse, fine


@pytest.mark.parametrize(("channel", "place"), [(None, 0), ("coarse", 0), ("fine", 1), (1, 1), ("1", 1)])
def test_a_measurement_is_read_by_name_or_position(packed, channel, place):
    path, *maps = packed
    found = st.read_scan(path, channel=channel)
    assert found.size == pytest.approx(maps[place].size, rel=1e-12)
    np.testing.assert_allclose(found.heights, maps[place].heights, rtol=1e-12, atol=1e-24)
    assert found.periodic and ("coarse", "fine")[place] in found.history[0] and "of coarse, fine" in found.history[0]


def test_all_resolutions_are_one_spectrum(packed):
    path, *maps = packed
    found = st.combined_spectrum(st.read_scan(path, channel=place) for place in range(2))
    assert found.moments.m2 == pytest.approx(st.combined_spectrum(maps).moments.m2, rel=1e-9)


def test_a_case_file_names_the_measurement(packed, tmp_path):
    case = tmp_path / "case.toml"
    case.write_text(
        '[contact]\nfirst = "copper"\nsecond = "soda_lime_glass"\nnominal_area = "1 mm^2"\n'
        'roughness.first = { file = "surface.zip", channel = "fine" }\n[solve]\nload = "1 N"\n'
    )
    surface = st.read_case(case).subject.with_surface_moments().map
    assert surface.size == pytest.approx(packed[2].size) and surface.periodic


def test_refusals(packed, tmp_path, monkeypatch):
    path = packed[0]
    for wanted in ("absent", 2, -1):
        with refusal("channel", "0 'coarse', 1 'fine'"):
            st.read_scan(path, channel=wanted)
    with zipfile.ZipFile(tmp_path / "other.zip", "w") as archive:
        archive.writestr("a.txt", "1 2 3")
    with refusal("scan", "contact.engineering"):
        st.read_scan(tmp_path / "other.zip")
    (tmp_path / "cut.zip").write_bytes(path.read_bytes()[:-200])
    with refusal("scan", "undamaged"):
        st.read_scan(tmp_path / "cut.zip")
    monkeypatch.setitem(sys.modules, "SurfaceTopography.Container.IO", None)
    with refusal("scan", "stiction[scans]"):
        st.read_scan(path)
