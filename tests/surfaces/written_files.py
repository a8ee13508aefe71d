"""Files of instruments that the tests write themselves, byte for byte from the published layouts, so that a fresh clone reads
some; what instruments really write is tested on the files beside the project (conftest.py).

Heights are COUNTS times STEP [m], rows from the top as read, at PITCH (dy, dx) [m]; the layouts are

    .sdf   ISO 25178-71 (text: the fields of the header, a line "*", the numbers; binary: packed little-endian)
    .x3p   ISO 25178-72, once ISO 5436-2: a zip of main.xml and the numbers in bindata/data.bin
    .sur   Digital Surf: 512 bytes of header, in the order that Gwyddion's surffile.c lists
    .bcr   BCR-STM: 2048 bytes of "key = value", then 16-bit integers; 32767 where a point is missing
    .spm   Nanoscope 5 (Veeco): sections of "\\key: value" up to byte 8192, then a block of 16-bit integers for each image, the
           bottom line first
    .txt   columns of heights below remarks that name channel, size and unit, as Gwyddion and others export
    .hfm   a stylus: positions and heights of a profile below two lines of names and units
    .csv   Dektak (stylus.csv): sections of "key,value" and such a profile; and one of numbers below a heading (profile.csv)
"""

import io
import struct
import zipfile

import numpy as np

__all__ = ["COUNTS", "PITCH", "STEP", "UNITS", "WRITTEN", "WRITTEN_AREAS", "WRITTEN_PROFILES"]

ROWS, COLUMNS = 48, 64
PITCH, STEP = (0.37e-6, 0.25e-6), 0.5e-9


def _counts() -> np.ndarray:
    """Waves of many lengths in all directions, a tilt, and nothing that is alike turned or mirrored."""
    rng = np.random.default_rng(11)
    y, x = np.mgrid[:ROWS, :COLUMNS] / 64.0
    heights = 30.0 * x - 50.0 * y
    for _ in range(60):
        q = 2.0 * np.pi * rng.uniform(-10.0, 10.0, 2)
        heights = heights + 300.0 / (1.0 + np.hypot(*q)) * np.cos(q[0] * x + q[1] * y + rng.uniform(0.0, 2.0 * np.pi))
    return np.rint(8.0 * heights).astype(np.int16)


COUNTS = _counts()


def sdf_text() -> bytes:
    fields = {
        "ManufacID": "tests", "CreateDate": "010120260000", "ModDate": "010120260000", "NumPoints": COLUMNS,
        "NumProfiles": ROWS, "Xscale": PITCH[1], "Yscale": PITCH[0], "Zscale": STEP, "Zresolution": -1, "Compression": 0,
        "DataType": 6, "CheckType": 0,
    }  # fmt: skip
    header = "".join(f"{name} = {value}\r\n" for name, value in fields.items())
    rows = "".join(" ".join(map(str, row)) + "\r\n" for row in COUNTS)
    return f"aISO-1.0\r\n{header}*\r\n{rows}*\r\n".encode("ascii")


def sdf_binary() -> bytes:
    fields = b"bISO-1.0", b"tests", b"010120260000", b"010120260000", COLUMNS, ROWS, PITCH[1], PITCH[0], STEP, -1.0, 0, 5, 0
    return struct.pack("<8s10s12s12sHHddddBBB", *fields) + COUNTS.astype("<i2").tobytes()


X3P = """<?xml version="1.0" encoding="UTF-8"?>
<p:ISO5436_2 xmlns:p="http://www.opengps.eu/2008/ISO5436_2">
<Record1><Revision>ISO5436 - 2000</Revision><FeatureType>SUR</FeatureType><Axes>
<CX><AxisType>I</AxisType><DataType>D</DataType><Increment>{dx!r}</Increment><Offset>0</Offset></CX>
<CY><AxisType>I</AxisType><DataType>D</DataType><Increment>{dy!r}</Increment><Offset>0</Offset></CY>
<CZ><AxisType>A</AxisType><DataType>I</DataType><Increment>{step!r}</Increment><Offset>0</Offset></CZ>
</Axes></Record1>
<Record3><MatrixDimension><SizeX>{columns}</SizeX><SizeY>{rows}</SizeY><SizeZ>1</SizeZ></MatrixDimension>
<DataLink><PointDataLink>bindata/data.bin</PointDataLink></DataLink></Record3>
</p:ISO5436_2>
"""


def x3p() -> bytes:
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w") as archive:
        archive.writestr("main.xml", X3P.format(dx=PITCH[1], dy=PITCH[0], step=STEP, columns=COLUMNS, rows=ROWS))
        archive.writestr("bindata/data.bin", COUNTS.astype("<i2").tobytes())
    return file.getvalue()


def sur() -> bytes:
    """Heights in nm, lengths in um."""

    def text(*names, length):
        return b"".join(name.encode("latin-1").ljust(length) for name in names)

    um, nm = "\xb5m", "nm"
    header = b"DIGITAL SURF" + struct.pack("<4H", 0, 1, 1, 2) + text("written", "tests", length=30)
    header += struct.pack("<5H", 0, 0, 0, 0, 1) + bytes(8)
    header += struct.pack("<H2i", 16, int(COUNTS.min()), int(COUNTS.max()))
    header += struct.pack("<2iI3f", COLUMNS, ROWS, COUNTS.size, PITCH[1] * 1e6, PITCH[0] * 1e6, STEP * 1e9)
    header += text("X", "Y", "Z", um, um, nm, um, um, nm, length=16) + struct.pack("<3f", 1.0, 1.0, 1.0)
    header += struct.pack("<3H", 0, 0, 0) + bytes(12) + struct.pack("<7H", 0, 0, 12, 1, 1, 2026, 5) + bytes(4 + 10)
    header += struct.pack("<2H", 0, 0) + bytes(128) + struct.pack("<3f", 0.0, 0.0, 0.0)
    return header.ljust(512, b"\0") + COUNTS.astype("<i2").tobytes()


MISSING = [(0, 0), (5, 7), (47, 3)]  # of the .bcr file


def bcr() -> bytes:
    """Lengths in nm, heights bit2nm of them to a count."""
    fields = {
        "fileformat": "bcrstm", "headersize": 2048, "xpixels": COLUMNS, "ypixels": ROWS, "xlength": COLUMNS * PITCH[1] * 1e9,
        "ylength": ROWS * PITCH[0] * 1e9, "xunit": "nm", "yunit": "nm", "zunit": "nm", "intelmode": 1, "bit2nm": STEP * 1e9,
    }  # fmt: skip
    header = "".join(f"{name} = {value}\n" for name, value in fields.items())
    counts = COUNTS.copy()
    for place in MISSING:
        counts[place] = 32767
    return header.encode("ascii").ljust(2048, b"\n") + counts.astype("<i2").tobytes()


CHANNELS = {"Height": ("Sens. Zscan", 1), "Phase": ("Sens. Phase", 1), "ZSensor": ("Sens. Zscan", 2)}


def nanoscope() -> bytes:
    """Two channels of heights, of which the second has twice those of the first, and one of another kind. A count is worth
    the hard value / 2^16 V times the sensitivity of 20 nm/V."""
    volts = STEP / 20e-9 * 2.0**16
    size = f"{COLUMNS * PITCH[1] * 1e6} {ROWS * PITCH[0] * 1e6} ~m"
    lines = [
        "*File list", "Version: 0x05120130", "Date: 12:00:00 PM Thu Jan 01 2026", "Data length: 8192", "*Equipment list",
        "Description: tests", "*Scanner list", "@Sens. Zscan: V 20.00000 nm/V", "*Ciao scan list",
        "Samps/line: 64", "Lines: 48", "@Sens. Phase: V 1.000000 deg/V",
    ]  # fmt: skip
    length = 2 * COUNTS.size
    for place, (name, (scale, times)) in enumerate(CHANNELS.items()):
        lines += [
            "*Ciao image list", f"Data offset: {8192 + place * length}", f"Data length: {length}", "Bytes/pixel: 2",
            f"Samps/line: {COLUMNS}", f"Number of lines: {ROWS}", f"Scan size: {size}",
            f"@2:Z scale: V [{scale}] ({volts * times / 2**16!r} V/LSB) {volts * times!r} V",
            f'@2:Image Data: S [{name}] "{name}"',
        ]  # fmt: skip
    header = "".join(f"\\{line}\r\n" for line in [*lines, "*File list end"]).encode("latin-1")
    block = COUNTS[::-1].astype("<i2").tobytes()
    return header.ljust(8192, b"\0") + len(CHANNELS) * block


def remarks() -> bytes:
    size = COLUMNS * PITCH[1] * 1e6, ROWS * PITCH[0] * 1e6
    head = f"# Channel: Height\n# Width: {size[0]} µm\n# Height: {size[1]} µm\n# Value units: m\n"
    return (head + "".join("\t".join(repr(float(value)) for value in row) + "\n" for row in COUNTS * STEP)).encode()


def profile() -> bytes:
    rows = (f"{place * PITCH[1] * 1e6:.4f},{count * STEP * 1e6:.6f}\n" for place, count in enumerate(COUNTS[7]))
    return ("x,z\n" + "".join(rows)).encode("ascii")


def hfm() -> bytes:
    """In mm, and a flag of what was measured."""
    rows = (f"{place * PITCH[1] * 1e3:.6f};{count * STEP * 1e3:.7f};1\r\n" for place, count in enumerate(COUNTS[7]))
    return ("X;Y;valid\r\n[mm];[mm];[1/0]\r\n" + "".join(rows)).encode("ascii")


def dektak() -> bytes:
    """In um; a third column is empty."""
    sections = "Scan Parameters", "", "Scan Type,Standard Scan", "Stylus,Radius: 2.5 \xb5m", "", "Scan Data", ""
    head = "".join(f"{line}\r\n" for line in (*sections, "Lateral um,Raw Micrometer,"))
    rows = (f"{place * PITCH[1] * 1e6:.2f},{count * STEP * 1e6:.4f},,\r\n" for place, count in enumerate(COUNTS[7]))
    return (head + "".join(rows)).encode("latin-1")


# Name of a file -> its content.
WRITTEN = {
    "text.sdf": sdf_text, "binary.sdf": sdf_binary, "written.x3p": x3p, "written.sur": sur, "written.bcr": bcr,
    "written.spm": nanoscope, "written.txt": remarks, "profile.csv": profile, "written.hfm": hfm, "stylus.csv": dektak,
}  # fmt: skip
UNITS = {"profile.csv": "um"}  # of files that do not say
WRITTEN_PROFILES = ["profile.csv", "written.hfm", "stylus.csv"]
WRITTEN_AREAS = [name for name in WRITTEN if name not in WRITTEN_PROFILES]
