"""Archives that would unpack to far more than a scan are refused before they do."""

import tracemalloc
import zipfile

import h5py
import numpy as np
import pytest

import stiction as st
from refusals import refusal

MEGABYTE = 1 << 20


def fill(path, name, megabytes):
    """A member of zeros, which pack to a thousandth."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive, archive.open(name, "w", force_zip64=True) as member:
        if name.endswith(".npy"):
            header = {"descr": "<f8", "fortran_order": False, "shape": (megabytes, MEGABYTE // 8)}
            np.lib.format.write_array_header_1_0(member, header)
        for _ in range(megabytes):
            member.write(bytes(MEGABYTE))


@pytest.mark.parametrize("file, member", [("scan.npz", "heights.npy"), ("scan.x3p", "main.xml"), ("scan.bin", "data.bin")])
def test_an_archive_out_of_proportion_is_refused_without_unpacking_it(tmp_path, file, member):
    fill(tmp_path / file, member, 80)
    tracemalloc.start()
    try:
        with refusal("scan", (tmp_path / file).stat().st_size, "50"):
            st.read_scan(tmp_path / file, size="1 um", unit="nm")
        assert tracemalloc.get_traced_memory()[1] < 8 * MEGABYTE
    finally:
        tracemalloc.stop()


def test_hdf5_out_of_proportion_is_refused(tmp_path):
    with h5py.File(tmp_path / "scan.h5", "w") as file:
        file.create_dataset("heights", shape=(4096, 4096), dtype="f8", chunks=True, compression="gzip")
    with refusal("scan", "134217728", "50"):
        st.read_scan(tmp_path / "scan.h5", unit="nm")


def test_what_packs_well_and_is_small_is_read(tmp_path):
    """A map most of which is missing packs far better than heights do."""
    heights = np.full((1000, 1000), np.nan)
    heights[100:120, 100:120] = np.random.default_rng(0).normal(size=(20, 20))
    np.savez_compressed(tmp_path / "scan.npz", heights=heights)
    assert (tmp_path / "scan.npz").stat().st_size < heights.nbytes / 200
    assert st.read_scan(tmp_path / "scan.npz", size="1 mm", unit="um").missing == heights.size - 400
