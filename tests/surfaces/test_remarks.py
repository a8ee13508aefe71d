"""Text scans below remarks: columns x y z are read here, with the units that remarks say, and without the library."""

import sys

import numpy as np
import pytest

import stiction as st
from refusals import refusal

ROWS, COLUMNS = 9, 11
X, Y = np.meshgrid(0.5 * np.arange(COLUMNS), 0.5 * np.arange(ROWS))
Z = np.random.default_rng(3).normal(size=X.shape).round(6)
POINTS = "".join(f"{x:.3f} {y:.3f} {z:.6f}\n" for x, y, z in zip(X.ravel(), Y.ravel(), Z.ravel(), strict=True))
UNITS = "# Channel: Height\n# Lateral units: µm\n# Value units: nm\n"


@pytest.fixture
def without_library(monkeypatch):
    """The library takes longer to load than any scan of text to read."""
    monkeypatch.setitem(sys.modules, "SurfaceTopography.Exceptions", None)


def read(folder, text, **given):
    (folder / "scan.txt").write_text(text, encoding="utf-8")
    return st.read_scan(folder / "scan.txt", **given)


@pytest.mark.parametrize("mark", ["", "\ufeff"])
def test_units_in_remarks(tmp_path, without_library, mark):
    surface = read(tmp_path, mark + UNITS + POINTS)
    np.testing.assert_allclose(surface.heights, Z * 1e-9, rtol=1e-12)
    np.testing.assert_allclose(surface.size, (0.5e-6 * ROWS, 0.5e-6 * COLUMNS), rtol=1e-9)


@pytest.mark.parametrize("mark", ["", "\ufeff"])
def test_remarks_that_say_nothing(tmp_path, without_library, mark):
    surface = read(tmp_path, mark + "# x y z\n# of yesterday\n" + POINTS, unit="um")
    np.testing.assert_allclose(surface.heights, Z * 1e-6, rtol=1e-12)


@pytest.mark.parametrize("remark", ["# Width: 10 µm", "# Operator: somebody", "# Lateral units: µm", "# Value units: stone"])
def test_remarks_that_say_more_are_left_to_the_library(tmp_path, without_library, remark):
    with refusal("scan", "stiction[scans]"):
        read(tmp_path, f"{remark}\n{POINTS}", unit="um")
