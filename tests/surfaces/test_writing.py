"""Maps written for other programs, read back by parsers written here from the descriptions of the formats."""

import io
import struct
import xml.etree.ElementTree as ET
import zipfile

import numpy as np
import pytest

import stiction as st
from refusals import refusal
from stiction.surfaces.writing import write_map


@pytest.fixture
def surface():
    heights = 1e-8 * np.random.default_rng(3).normal(size=(9, 12))
    heights[2, 5] = np.nan
    return st.HeightMap(heights, size=(3e-6, 4.2e-6))


def test_sdf_is_text_with_a_header(surface, tmp_path):
    """ISO 25178-71: version, `name = value` lines, a star, heights in the unit of Zscale, BAD where missing."""
    write_map(surface, tmp_path / "map.sdf")
    version, rest = (tmp_path / "map.sdf").read_text(encoding="ascii").split("\n", 1)
    head, body = rest.split("*\n")[:2]
    header = dict(line.split(" = ") for line in head.splitlines())
    shape = int(header["NumProfiles"]), int(header["NumPoints"])
    found = np.array([np.nan if word == "BAD" else float(word) for word in body.split()]).reshape(shape)
    assert version == "aISO-1.0" and float(header["Zscale"]) == 1.0
    np.testing.assert_array_equal(found, surface.heights)
    pitch = float(header["Yscale"]), float(header["Xscale"])
    assert pitch == pytest.approx(surface.pitch, rel=1e-15)


def test_gwy_holds_doubles_in_metres(surface, tmp_path):
    """Gwyddion's serialised objects: the component `data` is D, a count, and little-endian doubles; xres and yres are i."""
    pytest.importorskip("SurfaceTopography")
    write_map(surface, tmp_path / "map.gwy")
    raw = (tmp_path / "map.gwy").read_bytes()
    assert raw[:4] == b"GWYP"

    def component(name, kind):
        return raw.index(name.encode() + b"\0" + kind.encode()) + len(name) + 2

    columns, rows = (struct.unpack_from("<i", raw, component(name, "i"))[0] for name in ("xres", "yres"))
    lengths = [struct.unpack_from("<d", raw, component(name, "d"))[0] for name in ("yreal", "xreal")]
    start = component("data", "D")
    (count,) = struct.unpack_from("<I", raw, start)
    found = np.frombuffer(raw, "<f8", count, start + 4).reshape(rows, columns)
    assert lengths == pytest.approx(surface.size, rel=1e-15) and b"/0/mask" in raw
    there = ~np.isnan(surface.heights)
    np.testing.assert_array_equal(found[there], surface.heights[there])


def test_x3p_is_an_archive_of_xml_and_doubles(surface, tmp_path):
    """ISO 25178-72: main.xml has the axes and sizes, and names the file of binary heights, x fastest."""
    pytest.importorskip("SurfaceTopography")
    write_map(surface, tmp_path / "map.x3p")
    with zipfile.ZipFile(tmp_path / "map.x3p") as archive:
        main = ET.parse(io.BytesIO(archive.read("main.xml")))
        text = {element.tag.rpartition("}")[2]: element.text for element in main.iter()}
        heights = np.frombuffer(archive.read(text["PointDataLink"]), "<f8").reshape(int(text["SizeY"]), int(text["SizeX"]))
    steps = [float(element.text) for element in main.iter() if element.tag.endswith("Increment")][:2]
    assert steps == pytest.approx(surface.pitch[::-1], rel=1e-12)
    there = ~np.isnan(surface.heights)
    np.testing.assert_allclose(heights[there], surface.heights[there], rtol=1e-12)


def test_refusals(surface, tmp_path):
    with refusal("save_map", ".gwy, .x3p, .sdf"):
        write_map(surface, tmp_path / "map.tiff")
    with refusal("save_map", "profile"):
        write_map(st.HeightMap(surface.heights[:1], size=(1e-6, 4e-6)), tmp_path / "map.sdf")
