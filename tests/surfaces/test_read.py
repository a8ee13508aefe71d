"""Reading scans: instruments' files against the library that reads them independently of sizes, units and layout here, and
files written here in the plain formats."""

import io
import sys
import warnings
import zipfile
from pathlib import Path

import numpy as np
import pytest

from refusals import refusal
from stiction.quantities.errors import InputError
from stiction.surfaces import readers as formats
from stiction.surfaces.heightmap import HeightMap, metres
from stiction.surfaces.prepare import level
from stiction.surfaces.read import read_scan, readers

SCANS = Path(__file__).parents[2].parent / "shared" / "scans"
needs_scans = pytest.mark.skipif(not SCANS.is_dir(), reason="the folder of instrument files is not beside the project")
UNITS = {"m": 1.0, "mm": 1e-3, "µm": 1e-6, "nm": 1e-9}

# (rows, columns), missing points and the size along x [m] as the makers' own description or the file's header says
FILES = {
    "al3d-1.al3d": ((296, 200), 0),
    "dektak-1.csv": ((1, 9600), 0),
    "di-3.di": ((256, 256), 0),
    "frt-2.frt": ((300, 150), 12314),
    "hfm-1.hfm": ((1, 9600), 0),
    "opdx-3.opdx": ((1, 3001), 0),
    "stp-1.stp": ((256, 256), 0),
    "sur-2.sur": ((484, 563), 117),
    "tmd-1.tmd": ((300, 300), 0),
    "top-1.top": ((256, 256), 0),
}


def by_library(name):
    """The library's own topography of a file."""
    library = pytest.importorskip("SurfaceTopography.IO", reason="the extra that reads instrument files is not installed")
    with warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("ignore")
        return library.read_topography(str(SCANS / name))


@needs_scans
@pytest.mark.parametrize("name", FILES)
def test_instrument_file_is_what_the_library_says(name):
    other = by_library(name)
    shape, missing = FILES[name]
    surface = read_scan(SCANS / name)
    assert surface.heights.shape == shape and surface.missing == missing
    assert surface.is_profile == (other.dim == 1) and surface.name == name
    unit = UNITS[other.unit]
    heights = np.ma.filled(np.ma.asarray(other.heights(), dtype=float), np.nan).T * unit
    np.testing.assert_allclose(surface.heights, np.atleast_2d(heights), rtol=1e-12)
    sizes = np.array(other.physical_sizes) * unit
    if other.is_uniform:
        assert surface.size[::-1][: other.dim] == pytest.approx(sizes, rel=1e-12)
        assert surface.pitch[::-1][: other.dim] == pytest.approx(np.array(other.pixel_size) * unit, rel=1e-12)
    else:  # that size is from the first point to the last, in positions written to 0.1 um
        assert surface.pitch[1] * (shape[1] - 1) == pytest.approx(sizes[0], abs=0.1e-6)
    assert any(other.unit in step for step in surface.history) and name in surface.history[0]


@needs_scans
@pytest.mark.parametrize("name", [name for name in FILES if name != "dektak-1.csv"])
def test_levelled_height_deviation_is_that_of_the_library(name):
    other = by_library(name)
    with np.errstate(all="ignore"):
        flat = other.detrend("height")
        expected = flat.Sq() if other.dim == 2 else flat.Rq()
    found = np.sqrt(np.nanmean(level(read_scan(SCANS / name)).heights ** 2))
    assert found == pytest.approx(expected * UNITS[other.unit], rel=1e-9)


@needs_scans
def test_levelled_height_deviation_of_a_profile_with_positions():
    """That of the numbers in the file and a straight line through them by another fit."""
    pytest.importorskip("SurfaceTopography")
    lines = (SCANS / "dektak-1.csv").read_text(encoding="latin-1").splitlines()
    z = np.array([float(line.split(",")[1]) for line in lines if line[:1].isdigit()]) * 1e-6
    expected = np.std(z - np.polyval(np.polyfit(np.linspace(-1.0, 1.0, len(z)), z, 1), np.linspace(-1.0, 1.0, len(z))))
    found = np.sqrt(np.mean(level(read_scan(SCANS / "dektak-1.csv")).heights ** 2))
    assert len(z) == 9600 and found == pytest.approx(expected, rel=1e-9)


@needs_scans
def test_rounded_positions_are_not_interpolated():
    """The stylus profile's header says 0.156 um per sample; its positions are written to 0.1 um."""
    pytest.importorskip("SurfaceTopography")
    surface = read_scan(SCANS / "dektak-1.csv")
    assert surface.pitch[1] == pytest.approx(0.15625e-6, rel=1e-6)
    assert any("rounding" in step for step in surface.history)


@needs_scans
@pytest.mark.parametrize("name", ["di_corrupted.di", "nonsense_txt_file.txt"])
def test_damaged_and_unknown_files_are_one_line(name, capfd):
    pytest.importorskip("SurfaceTopography")
    with pytest.raises(InputError) as caught:
        read_scan(SCANS / name)
    assert name in str(caught.value) and "\n" not in str(caught.value)
    assert capfd.readouterr() == ("", "")


@needs_scans
def test_channels():
    pytest.importorskip("SurfaceTopography")
    first = read_scan(SCANS / "di-3.di")
    assert "channel 'ZSensor' of ZSensor, AmplitudeError, Phase, Height" in first.history[0]
    height = read_scan(SCANS / "di-3.di", channel="Height")
    assert np.array_equal(height.heights, read_scan(SCANS / "di-3.di", channel=3).heights)
    assert not np.array_equal(height.heights, first.heights)
    for wrong in ("Phase", "height of the sea", 17):  # a phase is no height
        with refusal("channel", "0 'ZSensor'", "3 'Height'"):
            read_scan(SCANS / "di-3.di", channel=wrong)


@needs_scans
def test_size_and_unit_of_an_instrument_file_can_be_overridden():
    pytest.importorskip("SurfaceTopography")
    plain = read_scan(SCANS / "stp-1.stp")
    other = read_scan(SCANS / "stp-1.stp", size=("1.2 um", "600 nm"), unit="um", height_unit="pm", height_scale=2.0)
    assert other.size == pytest.approx((1.2e-6, 0.6e-6))
    np.testing.assert_allclose(other.heights, plain.heights * 2e-3, rtol=1e-12)
    assert other.history[1:] == (
        "unit overridden: um for nm of the file",
        "unit of heights overridden: pm",
        "heights multiplied by 2 as given",
        "size overridden: in the file 600 x 600 nm (x, y)",
    )
    assert other.history[0].endswith(
        "size 600 nm x 1.2 µm (x, y), pitch = size/count = 2.34375 nm x 4.6875 nm, 0 points missing"
    )
    wider = read_scan(SCANS / "stp-1.stp", unit="um")
    assert wider.size == pytest.approx((600e-6, 600e-6))
    np.testing.assert_allclose(wider.heights, plain.heights * 1e3, rtol=1e-12)


def test_without_the_library(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "SurfaceTopography.IO", None)
    monkeypatch.setitem(sys.modules, "SurfaceTopography.Exceptions", None)
    (tmp_path / "scan.sur").write_bytes(b"DIGITAL SURF")
    with refusal("scan", "stiction[scans]"):
        read_scan(tmp_path / "scan.sur")


# ---- plain formats

HEIGHTS = np.arange(8 * 12).reshape(8, 12) % 7 * 1.5 - 3.0
HOLED = np.where(HEIGHTS == 0.0, np.nan, HEIGHTS)


def wavy(rows=8, columns=12):
    return np.sin(np.arange(rows * columns).reshape(rows, columns) ** 2.0)


@pytest.mark.parametrize("dtype", [np.float64, np.float32, np.int16])
def test_npy(tmp_path, dtype):
    heights = np.round(HEIGHTS).astype(dtype)
    np.save(tmp_path / "a.npy", heights)
    surface = read_scan(tmp_path / "a.npy", size="12 um", unit="nm")
    np.testing.assert_allclose(surface.heights, heights.astype(float) * 1e-9, rtol=1e-15)
    assert surface.heights.dtype == np.float64
    assert surface.size == pytest.approx((8e-6, 12e-6)) and surface.pitch == pytest.approx((1e-6, 1e-6))
    assert "12 x 8 points" in surface.history[0] and "unit as given: nm" in surface.history


def test_npy_profile_and_missing(tmp_path):
    np.save(tmp_path / "a.npy", HOLED[:, 0])
    profile = read_scan(tmp_path / "a.npy", size=4e-6, unit="um")
    assert profile.is_profile and profile.heights.shape == (1, 8) and profile.pitch[1] == pytest.approx(0.5e-6)
    np.save(tmp_path / "b.npy", HOLED)
    assert read_scan(tmp_path / "b.npy", size="1 mm", unit="um").missing == np.isnan(HOLED).sum() > 0


@pytest.mark.parametrize(
    ("delimiter", "decimal"), [(",", "."), (";", "."), ("\t", "."), (" ", "."), (";", ","), ("\t", ","), (", ", ".")]
)
@pytest.mark.parametrize("missing", ["nan", "NaN", ""])
def test_csv(tmp_path, delimiter, decimal, missing):
    if delimiter == " " and not missing:
        pytest.skip("blanks cannot part empty cells")
    rows = [[missing if np.isnan(z) else f"{z:.6f}".replace(".", decimal) for z in row] for row in HOLED]
    (tmp_path / "a.csv").write_text("# a remark\n\n" + "\n".join(delimiter.join(row) for row in rows) + "\n")
    surface = read_scan(tmp_path / "a.csv", size=("3", "6"), unit="um", height_unit="nm")
    np.testing.assert_allclose(surface.heights, HOLED * 1e-9, rtol=1e-12)
    assert surface.size == pytest.approx((3e-6, 6e-6))


def test_csv_where_the_delimiter_ends_the_row_and_windows_line_ends(tmp_path):
    text = "".join(",".join(f"{z:g}" for z in row) + ",\r\n" for row in HEIGHTS)
    (tmp_path / "a.csv").write_bytes(b"\xef\xbb\xbf" + text.encode())
    surface = read_scan(tmp_path / "a.csv", size="12 um", unit="nm")
    np.testing.assert_allclose(surface.heights, HEIGHTS * 1e-9, rtol=1e-12)


def test_csv_with_positions_or_a_heading(tmp_path):
    x = 0.1 * np.arange(50)
    rows = "".join(f"{a:.6f},{b:.6f}\n" for a, b in zip(x, np.sin(x), strict=True))
    for name, heading in (("a.csv", ""), ("a.txt", ""), ("b.csv", "x [um],z [um]\n"), ("c.xyz", "place,height\n")):
        (tmp_path / name).write_text(heading + rows)
        profile = read_scan(tmp_path / name, unit="um")
        assert profile.is_profile and profile.size[1] == pytest.approx(5e-6) and "columns x z" in profile.history[0]
        np.testing.assert_allclose(profile.heights[0], np.sin(x) * 1e-6, atol=1e-12)
        assert any("not read for units" in step for step in profile.history) == bool(heading)
    y, x = np.mgrid[:8, :12]
    table = "".join(f"{a};{b};{z}\n" for a, b, z in zip(x.flat, y.flat, HEIGHTS.flat, strict=True))
    (tmp_path / "d.csv").write_text("X;Y;Z\n" + table)
    np.testing.assert_allclose(read_scan(tmp_path / "d.csv", unit="um").heights, HEIGHTS * 1e-6, rtol=1e-12)
    (tmp_path / "e.csv").write_text("\n".join(f"{z:g}" for z in HEIGHTS[:, 1]))
    column = read_scan(tmp_path / "e.csv", unit="nm", size="8 um")
    np.testing.assert_allclose(column.heights, HEIGHTS[:, [1]].T * 1e-9, rtol=1e-12)
    assert any("cut short" in step for step in column.history)


def test_csv_in_another_encoding(tmp_path):
    rows = "".join(f"{z:g};{z + 1:g}\n" for z in range(20)).encode()
    (tmp_path / "a.csv").write_bytes("x [µm];z [µm]\n".encode("latin-1") + rows)
    assert read_scan(tmp_path / "a.csv", unit="um").heights.shape == (1, 20)


@pytest.mark.parametrize("ending", [".txt", ".asc", ".dat"])
def test_other_names_of_text(tmp_path, ending, monkeypatch):
    monkeypatch.setitem(sys.modules, "SurfaceTopography.IO", None)
    np.savetxt(tmp_path / f"a{ending}", HOLED)
    np.testing.assert_allclose(read_scan(tmp_path / f"a{ending}", **SMALL).heights, HOLED * 1e-9, rtol=1e-12)


def test_text_with_size_and_unit_in_its_remarks(tmp_path):
    pytest.importorskip("SurfaceTopography")
    np.savetxt(tmp_path / "a.txt", HEIGHTS, header="Channel: Main\nWidth: 12 um\nHeight: 16 um\nValue units: nm")
    surface = read_scan(tmp_path / "a.txt")
    np.testing.assert_allclose(surface.heights, HEIGHTS * 1e-9, rtol=1e-12)
    assert surface.size == pytest.approx((16e-6, 12e-6))


def test_blanks_with_decimal_commas_and_a_first_row_that_is_missing(tmp_path):
    (tmp_path / "a.csv").write_text("\n".join(" ".join(f"{z:.2f}".replace(".", ",") for z in row) for row in HEIGHTS) + "\n")
    np.testing.assert_allclose(read_scan(tmp_path / "a.csv", **SMALL).heights, HEIGHTS * 1e-9, rtol=1e-12)
    rows = [",".join(f"{z:g}" for z in row) for row in HEIGHTS]
    (tmp_path / "b.csv").write_text("\n".join([",,,,,,,,,,,", *rows]) + "\n")
    surface = read_scan(tmp_path / "b.csv", **SMALL)
    assert surface.missing == 12 and np.isnan(surface.heights[0]).all()


def test_an_npz_file_with_something_else_than_an_array_is_refused(tmp_path):
    with zipfile.ZipFile(tmp_path / "a.npz", "w") as archive:
        archive.writestr("heights.npy", b"no array at all")
    with refusal("scan", ".npz"):
        read_scan(tmp_path / "a.npz", **SMALL)


def test_npz(tmp_path):
    np.savez_compressed(tmp_path / "a.npz", HEIGHTS)
    np.testing.assert_allclose(read_scan(tmp_path / "a.npz", **SMALL).heights, HEIGHTS * 1e-9, rtol=1e-12)
    np.savez(tmp_path / "b.npz", top=HEIGHTS, phase=2.0 * HEIGHTS)
    surface = read_scan(tmp_path / "b.npz", channel="top", **SMALL)
    np.testing.assert_allclose(surface.heights, HEIGHTS * 1e-9, rtol=1e-12)
    assert "npz, array 'top' of top, phase" in surface.history[0]
    for wrong in (None, "bottom"):
        with refusal("channel", "top, phase"):
            read_scan(tmp_path / "b.npz", channel=wrong, **SMALL)


def test_xyz_with_rounded_positions(tmp_path):
    """Written to a tenth of a pitch that is no multiple of it: the grid is that of the unrounded ones."""
    y, x = np.mgrid[:8, :60]
    heights = np.sin(x * 0.7 + y)
    np.savetxt(
        tmp_path / "a.xyz", np.column_stack([0.3137 * x.ravel(), 0.5 * y.ravel(), heights.ravel()]), fmt="%.1f %.1f %.9f"
    )
    surface = read_scan(tmp_path / "a.xyz", unit="um")
    np.testing.assert_allclose(surface.heights, heights * 1e-6, atol=1e-15)
    assert surface.pitch[1] == pytest.approx(0.3137e-6, rel=2e-3)
    assert any("rounding" in step for step in surface.history)


def test_xyz_in_any_order_with_points_left_out(tmp_path):
    y, x = np.mgrid[:8, :12]
    table = np.column_stack([5.0 + 0.25 * x.ravel(), -3.0 + 0.5 * y.ravel(), HOLED.ravel()])
    table = table[~np.isnan(HOLED.ravel())]
    np.random.default_rng(1).shuffle(table)
    np.savetxt(tmp_path / "a.xyz", table)
    surface = read_scan(tmp_path / "a.xyz", unit="um")
    np.testing.assert_allclose(surface.heights, HOLED * 1e-6, rtol=1e-12)
    assert surface.size == pytest.approx((4e-6, 3e-6)) and surface.pitch == pytest.approx((0.5e-6, 0.25e-6))
    mapped = read_scan(tmp_path / "a.xyz", unit="um", height_unit="nm", size="30 um")
    assert mapped.size == pytest.approx((20e-6, 30e-6))
    np.testing.assert_allclose(mapped.heights, HOLED * 1e-9, rtol=1e-12)


def test_xyz_of_a_profile(tmp_path):
    x = 0.1 * np.arange(50)
    np.savetxt(tmp_path / "a.xyz", np.column_stack([np.full(50, 2.0), x, np.sin(x)]))
    along_y = read_scan(tmp_path / "a.xyz", unit="mm")
    np.savetxt(tmp_path / "b.xyz", np.column_stack([x, np.sin(x)]))
    for profile in (along_y, read_scan(tmp_path / "b.xyz", unit="mm")):
        assert profile.is_profile and profile.size[1] == pytest.approx(5e-3)
        np.testing.assert_allclose(profile.heights[0], np.sin(x) * 1e-3, rtol=1e-12)


def test_profile_that_is_not_equally_spaced_is_resampled(tmp_path):
    x = np.linspace(0.0, 1.0, 200) ** 1.5 + 0.01 * np.linspace(0.0, 1.0, 200)
    np.savetxt(tmp_path / "a.xyz", np.column_stack([x, 3.0 * x + 1.0]))
    profile = read_scan(tmp_path / "a.xyz", unit="mm")  # a straight line stays straight
    np.testing.assert_allclose(profile.heights[0], (3.0 * np.linspace(0.0, 1.01, 200) + 1.0) * 1e-3, rtol=1e-9)
    assert profile.pitch[1] == pytest.approx(1.01e-3 / 199)
    assert any("resampled by linear interpolation" in step for step in profile.history)


# ---- formats


def test_formats_say_what_they_are_of():
    """Their endings are theirs alone; one without any takes what is left."""
    endings = [ending for one in readers() for ending in one.endings]
    assert len(set(endings)) == len(endings) and all(ending == ending.lower() and ending[0] == "." for ending in endings)
    assert [bool(one.endings) for one in readers()] == [True] * (len(readers()) - 2) + [False, False]
    assert all(len(one.holds) > 20 and one.given for one in readers())


A_FORMAT = """
import numpy as np
from stiction.surfaces.raw_scan import RawScan, Reader

def read(path, channel):
    first, *rows = path.read_text().split()
    if first != "D":
        return None
    return RawScan(np.array([[float(digit) for digit in row] for row in rows]), "digits", (8.0, 8.0), "um")

READER = Reader(endings=(".digits", ".csv"), read=read, holds="rows of single digits", given="nothing")
"""


def test_a_format_is_one_file(tmp_path, monkeypatch):
    """In the folder of the others: it is asked for its endings, before others that it leaves a file to."""
    (tmp_path / "a_digits.py").write_text(A_FORMAT)
    monkeypatch.setattr(formats, "__path__", [*formats.__path__, str(tmp_path)])
    readers.cache_clear()
    try:
        digits = "\n".join("".join(str(i * j % 10) for j in range(8)) for i in range(8))
        for name in ("a.digits", "a.csv"):
            (tmp_path / name).write_text("D\n" + digits)
            surface = read_scan(tmp_path / name)
            assert surface.heights[3, 7] == pytest.approx(1e-6) and surface.size == pytest.approx((8e-6, 8e-6))
        np.savetxt(tmp_path / "b.csv", HEIGHTS)
        assert read_scan(tmp_path / "b.csv", size="12 um", unit="nm").heights.shape == HEIGHTS.shape
        (tmp_path / "c.digits").write_text("no heights in here")
        with refusal("scan"):
            read_scan(tmp_path / "c.digits")
    finally:
        readers.cache_clear()
        sys.modules.pop(f"{formats.__name__}.a_digits")


# ---- what is refused

SMALL = {"size": "10 um", "unit": "nm"}


@pytest.mark.parametrize(
    ("heights", "options", "message"),
    [
        (wavy(), {}, ("unit", "nm")),
        (wavy(), {"unit": "nm"}, ("size",)),
        (wavy(), {"size": "10 um", "unit": "kg"}, ("unit", "kg")),
        (wavy(), {"size": "10 um", "unit": "um", "height_unit": "furl ongs"}, ("height_unit", "furl ongs")),
        (wavy(), {"size": "0 um", "unit": "nm"}, ("size", "0 um")),
        (wavy(), {"size": "-3", "unit": "nm"}, ("size", "-3 nm")),
        (wavy(), {"size": "large", "unit": "nm"}, ("size", "large")),
        (wavy(), {"size": float("nan"), "unit": "nm"}, ("size",)),
        (wavy(), {"size": (1e-6, 1e-6, 1e-6), "unit": "nm"}, ("size",)),
        (wavy(), SMALL | {"height_scale": 0.0}, ("height_scale", "0")),
        (wavy(), SMALL | {"height_scale": "2"}, ("height_scale", "2")),
        (wavy(), SMALL | {"channel": "Height"}, ("channel", "Height")),
        (wavy(), {"size": "10 nm", "unit": "mm"}, ("scan",)),
        (1e-9 * wavy(), {"size": "1 m", "unit": "nm"}, ("scan",)),
        (1e308 * wavy(), SMALL | {"unit": "km"}, ("scan",)),
        (1e308 * wavy(), SMALL | {"unit": "m"}, ("scan",)),
        (np.full((9, 9), 3.7), SMALL, ("scan",)),
        (np.full((9, 9), np.nan), SMALL, ("scan", "81")),
        (np.where(wavy() > 0.9, np.inf, wavy()), SMALL, ("scan",)),
        (wavy(7, 40), SMALL, ("scan", "7 x 40", "8")),
        (wavy(9, 3), SMALL, ("scan", "9 x 3", ".csv", ".xyz")),
        (np.sin(np.arange(5)), SMALL, ("scan", "1 x 5")),
        (wavy() * 1j, SMALL, ("scan", "complex128")),
        (np.array([["a", "b"]]), SMALL, ("scan",)),
        (np.array([[1, "b"]], dtype=object), SMALL, ("scan", ".npy")),
        (np.zeros((2, 9, 9)), SMALL, ("scan", "(2, 9, 9)")),
        (np.zeros((0, 9)), SMALL, ("scan", "0 x 9")),
    ],
)
def test_bad_arrays_and_options_are_one_line(tmp_path, heights, options, message):
    np.save(tmp_path / "a.npy", heights)
    with refusal(*message) as caught:
        read_scan(tmp_path / "a.npy", **options)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("a.npy", b"", ("scan",)),
        ("a.csv", b"", ("scan",)),
        ("a.csv", b"\n# nothing\n \n", ("scan",)),
        ("a.npy", b"\x93NUMPY\x01\x00v\x00{'descr'", ("scan", ".npy")),
        ("a.npy", b"PK\x03\x04 not a zip archive", ("scan", ".npy")),
        ("a.npy", b"some text", ("scan", ".npy")),
        ("a.npy", b"\x93NUMPY\x01\x00\x14\x00{'descr': '<f8', ((((" + bytes(80), ("scan", ".npy")),
        ("a.npz", b"some text", ("scan", ".npz")),
        ("a.npz", b"PK\x03\x04 not a zip archive", ("scan", ".npz")),
        ("a.npz", b"PK\x05\x06" + bytes(18), ("channel",)),
        ("a.csv", b" \n\t\r\n" * 9, ("scan",)),
        ("a.csv", b",0,1,2\n0,5,6,7\n1,8,9,7\n", ("scan",)),
        ("a.csv", b",z\n" + b"".join(b"%d,%d\n" % (i, i % 3) for i in range(9)), ("scan",)),
        ("a.csv", b"1,5;2.5\n3;4\n", ("scan",)),
        ("a.csv", b"1,5 2,5\n3,1 4,1\n", ("scan", "8")),
        ("a.csv", b"1,2,3,4\n4,5,6,7\n", ("scan", "2 x 4")),
        ("a.csv", b"5", ("scan", "1 x 1")),
        ("a.csv", b"z,x\n" + b"".join(b"%d,%d\n" % (i % 3, i) for i in range(12)), ("scan",)),
        ("a.csv", b"1,2,3\n4,five,6\n", ("scan",)),
        ("a.csv", b"1,2,3\n4,5\n", ("scan",)),
        ("a.xyz", b"1 2 3 4\n5 6 7 8\n", ("scan", "4")),
        ("a.xyz", b"0 0 1\n0 0 2\n1 0 3\n", ("scan",)),
        ("a.xyz", b"0 0 1\n1 1 2\n2.5 2 1\n3 3 3\n4 4 1\n5 5 2\n", ("scan",)),
        ("a.xyz", b"nan 0 1\n1 1 2\n", ("scan",)),
        ("a.xyz", b"0 1\n1 2\n", ("scan", "8")),
        ("a.xyz", b"3 1\n" * 9, ("scan",)),
        ("a.xyz", b"0 1\n9 0\n1 2\n7 2\n3 2\n2 2\n5 2\n6 2\n50 2\n", ("scan",)),
        ("a.xyz", "".join(f"{i} {i * i} 1\n" for i in range(40)).encode(), ("scan",)),
    ],
)
def test_bad_files_are_one_line(tmp_path, name, content, message):
    (tmp_path / name).write_bytes(content)
    with refusal(*message) as caught:
        read_scan(tmp_path / name, **SMALL)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("name", ["a.csv", "a.xyz", "a.dat"])
@pytest.mark.parametrize("content", [b"no heights in here", b"\xff\xfe\x00\x01" * 50, b"\x00" * 300])
def test_files_of_no_known_format_are_one_line(tmp_path, name, content, capfd):
    pytest.importorskip("SurfaceTopography")
    (tmp_path / name).write_bytes(content)
    with refusal("scan") as caught:
        read_scan(tmp_path / name, **SMALL)
    assert "\n" not in str(caught.value)
    assert capfd.readouterr() == ("", "")


@needs_scans
@pytest.mark.parametrize("name", FILES)
@pytest.mark.parametrize("share", [0.003, 0.1, 0.5, 0.9])
def test_cut_files_are_one_line_or_what_is_left(tmp_path, name, share, capfd):
    """Part of a file is refused. But text ends anywhere, told of if within a line, and what follows the heights may be lost."""
    pytest.importorskip("SurfaceTopography")
    content = (SCANS / name).read_bytes()
    cut = tmp_path / name
    cut.write_bytes(content[: int(share * len(content))])
    try:
        surface = read_scan(cut)
    except InputError as error:
        assert "\n" not in str(error)
    else:
        whole = read_scan(SCANS / name)
        if name in ("dektak-1.csv", "hfm-1.hfm"):
            count = surface.heights.size
            assert count < whole.heights.size
            told = any("cut short" in step for step in surface.history)
            assert told != cut.read_bytes().endswith((b"\r", b"\n"))
            assert np.array_equal(surface.heights[0, :-1], whole.heights[0, : count - 1])
        else:
            assert np.array_equal(surface.heights, whole.heights, equal_nan=True) and surface.size == whole.size
    assert capfd.readouterr() == ("", "")


@needs_scans
def test_a_damaged_line_does_not_cost_the_lines_above(tmp_path):
    """The library would begin below it."""
    pytest.importorskip("SurfaceTopography")
    lines = (SCANS / "dektak-1.csv").read_bytes().splitlines(keepends=True)
    lines[60] = lines[60].replace(b".", b"~")
    (tmp_path / "a.csv").write_bytes(b"".join(lines))
    with refusal("scan", "9600"):
        read_scan(tmp_path / "a.csv")


@needs_scans
@pytest.mark.parametrize("name", FILES)
@pytest.mark.parametrize("ending", ["", ".csv", ".npy", ".hgt"])
def test_the_ending_of_the_name_is_no_matter_but_for_arrays(tmp_path, name, ending):
    pytest.importorskip("SurfaceTopography")
    other = tmp_path / f"scan{ending}"
    other.write_bytes((SCANS / name).read_bytes())
    if ending == ".npy":
        with refusal("scan", ".npy"):
            read_scan(other)
    else:
        assert np.array_equal(read_scan(other).heights, read_scan(SCANS / name).heights, equal_nan=True)


@needs_scans
def test_header_that_claims_more_than_the_file_holds(tmp_path):
    pytest.importorskip("SurfaceTopography")
    content = (SCANS / "stp-1.stp").read_bytes()
    claimed = content.replace(b"Number of columns: 256", b"Number of columns: 1000000")
    claimed = claimed.replace(b"Number of rows: 256", b"Number of rows: 1000000")
    assert claimed.count(b"1000000") == 2
    (tmp_path / "a.stp").write_bytes(claimed)
    with refusal("scan", "1000000000000"):
        read_scan(tmp_path / "a.stp")


@pytest.mark.parametrize("name", ["a.npy", "a.npz"])
def test_array_header_that_claims_more_than_the_file_holds(tmp_path, name):
    array = io.BytesIO()
    np.lib.format.write_array_header_1_0(array, {"descr": "<f8", "fortran_order": False, "shape": (10**6, 10**6)})
    array.write(bytes(800))
    if name == "a.npy":
        (tmp_path / name).write_bytes(array.getvalue())
    else:
        with zipfile.ZipFile(tmp_path / name, "w") as archive:
            archive.writestr("heights.npy", array.getvalue())
    with refusal("scan"):
        read_scan(tmp_path / name, **SMALL)


def test_absent_files_and_folders(tmp_path):
    for path in (tmp_path / "none.npy", tmp_path):
        with refusal("scan"):
            read_scan(path)


def test_outside_scale_is_said(tmp_path):
    np.save(tmp_path / "a.npy", wavy())
    assert any("input warning" in step for step in read_scan(tmp_path / "a.npy", size="1 um", unit="um").history)
    assert not any("input warning" in step for step in read_scan(tmp_path / "a.npy", size="9 um", unit="um").history)


# ---- the datum


def test_height_map():
    surface = HeightMap(np.arange(12).reshape(3, 4), (6.0, 4.0), name="steps")
    assert surface.heights.dtype == np.float64 and surface.pitch == (2.0, 1.0)
    assert surface.complete and surface.missing == 0 and not surface.is_profile
    after = surface.with_heights(np.full((1, 4), np.nan), "cut", size=(2.0, 4.0)).with_heights(np.ones((1, 4)), "filled")
    assert after.history == ("cut", "filled") and after.size == (2.0, 4.0) and after.is_profile and after.name == "steps"
    for heights, size in (
        (np.zeros(4), (1.0, 1.0)),
        (np.zeros((0, 4)), (1.0, 1.0)),
        (np.array([["a"]]), (1.0, 1.0)),
        (np.full((2, 2), np.inf), (1.0, 1.0)),
        (np.ones((2, 2)), (1.0, 0.0)),
        (np.ones((2, 2)), (1.0,)),
        (np.ones((2, 2)), (1.0, np.nan)),
    ):
        with pytest.raises(InputError):
            HeightMap(heights, size)


def test_metres():
    assert metres("10 um", "size") == 1e-5 and metres(2, "size") == 2.0
    for wrong in ("10", "10 s", -1.0, [1.0, 2.0], None, np.inf):
        with refusal("width"):
            metres(wrong, "width")
