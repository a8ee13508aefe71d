"""Measured scans, as this package reads them and as the library SurfaceTopography holds them.

The files are from the test suite of SurfaceTopography, whose repository has the MIT licence; what terms the donors of the
single files set is not stated, so they are not copied into this project. They are looked for in shared/scans beside it, and
tests that need them are skipped where they are not; files that the tests write themselves (written_files.py) stand in for them.
"""

import warnings
from pathlib import Path

import numpy as np
import pytest
from written_files import UNITS, WRITTEN

from stiction.surfaces.fill import fill_missing
from stiction.surfaces.heightmap import HeightMap
from stiction.surfaces.prepare import level
from stiction.surfaces.read import read_scan

SCANS = Path(__file__).parents[2].parent / "shared" / "scans"


@pytest.fixture
def library():
    """The module SurfaceTopography."""
    return pytest.importorskip("SurfaceTopography", reason="the extra that reads instrument files is not installed")


@pytest.fixture
def topography_of(library):
    """surface -> the same heights as the library's topography, not periodic."""

    def made(surface: HeightMap):
        if surface.is_profile:
            return library.UniformLineScan(surface.heights[0], surface.size[1], unit="m")
        return library.Topography(surface.heights.T, surface.size[::-1], unit="m")

    return made


@pytest.fixture
def measured(library, topography_of, tmp_path):
    """name of a file -> (levelled surface, the library's levelled topography in metres).

    Read and levelled twice, here and by the library, where that gives the same points. Missing points are filled here, and
    positions that the library takes as written, rounded, are evenly spaced here: then both are of the heights found here.
    """

    def both(name: str):
        path = SCANS / name
        if name in WRITTEN:
            path = tmp_path / name
            path.write_bytes(WRITTEN[name]())
        elif not path.is_file():
            pytest.skip(f"{name} is not in the folder of measured scans beside the project")
        surface = level(read_scan(path, unit=UNITS.get(name)))
        if name in UNITS:  # the library does not read it
            return surface, topography_of(surface)
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            read = library.read_topography(str(path))
            if surface.complete and read.is_uniform:
                return surface, read.to_unit("m").detrend("height")
        if not surface.complete:
            surface = level(fill_missing(surface))
        return surface, topography_of(surface)

    return both
