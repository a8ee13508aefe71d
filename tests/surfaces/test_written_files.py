"""Files of instruments that the tests write themselves (written_files.py): read back to the numbers they were written from.
What is tested on the files beside the project in test_read.py is tested here where there are none."""

import numpy as np
import pytest
from written_files import CHANNELS, COLUMNS, COUNTS, MISSING, PITCH, ROWS, STEP, UNITS, WRITTEN, WRITTEN_AREAS, WRITTEN_PROFILES

from refusals import refusal
from stiction.quantities.errors import InputError
from stiction.surfaces.prepare import level
from stiction.surfaces.read import read_scan

HEIGHTS = COUNTS * STEP
FLOATS = 1e-6  # of the .sur file, whose pitch and step are 32-bit numbers


@pytest.fixture(autouse=True)
def library():
    """Most are read by the optional extra."""
    return pytest.importorskip("SurfaceTopography", reason="the extra that reads instrument files is not installed")


@pytest.fixture
def written(tmp_path):
    """name -> the path of that file, with what is done to its content."""

    def file(name, change=bytes, under=None):
        path = tmp_path / (under or name)
        path.write_bytes(change(WRITTEN[name]()))
        return path

    return file


def expected_of(name):
    if name in WRITTEN_PROFILES:
        return HEIGHTS[7:8]
    heights = HEIGHTS.copy()
    if name == "written.bcr":
        heights[tuple(np.transpose(MISSING))] = np.nan
    return heights


@pytest.mark.parametrize("name", WRITTEN)
def test_heights_and_size_are_those_written(written, name):
    found = read_scan(written(name), unit=UNITS.get(name))
    expected = expected_of(name)
    within = FLOATS if name == "written.sur" else 1e-12
    np.testing.assert_allclose(found.heights, expected, rtol=within, atol=within * STEP)
    rows = len(expected)
    assert found.size[1] == pytest.approx(COLUMNS * PITCH[1], rel=within)
    assert rows == 1 or found.size[0] == pytest.approx(ROWS * PITCH[0], rel=within)
    assert found.missing == np.isnan(expected).sum() and found.is_profile == (rows == 1)
    assert name in found.history[0] and f"{COLUMNS} " in found.history[0]


@pytest.mark.parametrize("name", WRITTEN)
def test_levelled_height_deviation(written, name):
    """Of the numbers written, less a plane by numpy's least squares."""
    expected = expected_of(name)
    there = ~np.isnan(expected)
    y, x = np.indices(expected.shape)
    terms = np.stack([np.ones(there.sum()), x[there], y[there]], axis=1)
    left = expected[there] - terms @ np.linalg.lstsq(terms, expected[there], rcond=None)[0]
    flat = level(read_scan(written(name), unit=UNITS.get(name)))
    assert np.sqrt(np.nanmean(flat.heights**2)) == pytest.approx(np.sqrt(np.mean(left**2)), rel=FLOATS)


@pytest.mark.parametrize("ending", ("", ".csv", ".npy", ".hgt"))
@pytest.mark.parametrize("name", ("text.sdf", "binary.sdf", "written.x3p", "written.sur", "written.spm"))
def test_the_ending_of_the_name_is_no_matter_but_for_arrays(written, name, ending):
    path = written(name, under=f"scan{ending}")
    if ending == ".npy":
        with refusal("scan", ".npy"):
            read_scan(path)
    else:
        assert np.array_equal(read_scan(path).heights, read_scan(written(name)).heights, equal_nan=True)


@pytest.mark.parametrize("share", (0.003, 0.1, 0.5, 0.9))
@pytest.mark.parametrize("name", [name for name in WRITTEN_AREAS if name != "written.txt"])
def test_cut_files_are_one_line(written, name, share, capfd):
    path = written(name, lambda content: content[: int(share * len(content))])
    with pytest.raises(InputError) as caught:
        read_scan(path)
    assert "\n" not in str(caught.value)
    assert capfd.readouterr() == ("", "")


DAMAGED = {  # name -> what is replaced, by what
    "binary.sdf": (b"bISO-1.0", b"bISO-9.9"),
    "written.x3p": (b"main.xml", b"mainexml"),
    "written.sur": (b"DIGITAL SURF", b"DIGITAL SERF"),
    "written.bcr": (b"ypixels = 48", b"ypixels = no"),
    "written.spm": (b"Samps/line: 64", b"Samps/line: 9999"),
}


@pytest.mark.parametrize("name", DAMAGED)
def test_damaged_headers_are_one_line(written, name, capfd):
    old, new = DAMAGED[name]
    path = written(name, lambda content: content.replace(old, new))
    with pytest.raises(InputError) as caught:
        read_scan(path)
    assert "\n" not in str(caught.value) and path.name in str(caught.value)
    assert capfd.readouterr() == ("", "")


def test_header_that_claims_more_than_the_file_holds(written):
    """A million times a million points: refused before memory is asked for."""

    def claimed(content):
        header = content[:2048].replace(b"xpixels = 64", b"xpixels = 1000000").replace(b"ypixels = 48", b"ypixels = 1000000")
        return header.rstrip(b"\n").ljust(2048, b"\n") + content[2048:]

    with refusal("scan", "1000000000000"):
        read_scan(written("written.bcr", claimed))


def test_channels(written):
    path = written("written.spm")
    first = read_scan(path)
    assert "channel 'Height' of Height, Phase, ZSensor" in first.history[0]
    other = read_scan(path, channel="ZSensor")
    np.testing.assert_allclose(other.heights, CHANNELS["ZSensor"][1] * HEIGHTS, rtol=1e-12)
    assert np.array_equal(other.heights, read_scan(path, channel=2).heights)
    for wrong in ("Phase", "height of the sea", 17):  # a phase is no height
        with refusal("channel", "0 'Height'", "2 'ZSensor'"):
            read_scan(path, channel=wrong)


def test_size_and_unit_can_be_overridden(written):
    """What is given goes before what the file says, heights with it."""
    path = written("written.bcr")
    plain = read_scan(path)
    other = read_scan(path, size=("1.2 um", "600 nm"), unit="um", height_unit="pm", height_scale=2.0)
    assert other.size == pytest.approx((1.2e-6, 0.6e-6))
    np.testing.assert_allclose(other.heights, plain.heights * 2e-3, rtol=1e-12)
    assert other.history[1:] == (
        "unit overridden: um for nm of the file",
        "unit of heights overridden: pm",
        "heights multiplied by 2 as given",
        "size overridden: in the file 16000 x 17760 nm (x, y)",
    )
    assert other.history[0].endswith("size 600 nm x 1.2 µm (x, y), pitch = size/count = 9.375 nm x 25 nm, 3 points missing")
    wider = read_scan(path, unit="um")
    assert wider.size == pytest.approx((17.76e-3, 16e-3))
    np.testing.assert_allclose(wider.heights, plain.heights * 1e3, rtol=1e-12)


def test_rounded_positions_are_not_interpolated(written):
    """Positions written to 0.1 um, of points 0.25 um apart."""

    def rounded(content):
        lines = content.decode().splitlines()
        cells = [line.split(",") for line in lines[1:]]
        return "\n".join([lines[0], *(f"{float(x):.1f},{z}" for x, z in cells), ""]).encode()

    found = read_scan(written("profile.csv", rounded), unit="um")
    assert found.pitch[1] == pytest.approx(PITCH[1], rel=1e-3)
    np.testing.assert_allclose(found.heights, HEIGHTS[7:8], rtol=1e-12, atol=1e-12 * STEP)
    assert any("rounding" in step for step in found.history)


def test_a_damaged_line_does_not_cost_the_lines_above(written):
    """The library would begin below it."""

    def damaged(content):
        lines = content.splitlines(keepends=True)
        lines[30] = lines[30].replace(b".", b"~")
        return b"".join(lines)

    with refusal("scan", COLUMNS):
        read_scan(written("stylus.csv", damaged))


@pytest.mark.parametrize("name", ("written.hfm", "stylus.csv"))
def test_cut_text_is_what_is_left(written, name):
    """Text ends anywhere: after a line, or before the line's end, which is told of."""
    whole = read_scan(written(name))
    for within in (False, True):

        def cut(content, within=within):
            lines = content.splitlines(keepends=True)[:-10]
            return b"".join(lines)[: -len(b"\r\n") if within else None]

        found = read_scan(written(name, cut, under=f"cut-{name}"))
        assert found.heights.size == COLUMNS - 10
        assert np.array_equal(found.heights, whole.heights[:, : COLUMNS - 10])
        assert any("cut short" in step for step in found.history) == within


def test_a_map_with_missing_points_is_drawn_with_them_missing(written):
    from stiction.report.surface_pictures import map_figure

    surface = level(read_scan(written("written.bcr")))
    with np.errstate(all="ignore"):  # matplotlib divides zero by zero inside
        figure = map_figure(surface)
        figure.draw_without_rendering()
    assert figure.axes[0].get_xlabel() == "x [µm]"
    assert np.ma.count_masked(figure.axes[0].images[0].get_array()) == surface.missing == len(MISSING)
