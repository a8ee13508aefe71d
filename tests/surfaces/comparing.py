"""Comparing numbers in metres, and the measured surfaces on which an independent library is compared with."""

import pytest
from written_files import WRITTEN_PROFILES

__all__ = ["AREAS", "PROFILES", "near"]

# Files of ../shared/scans, conftest.py has their licence; and some that the tests write.
AREAS = ["al3d-1.al3d", "di-3.di", "frt-2.frt", "stp-1.stp", "sur-2.sur", "tmd-1.tmd", "top-1.top"]
AREAS += ["binary.sdf", "written.x3p", "written.bcr"]
PROFILES = ["dektak-1.csv", "hfm-1.hfm", "opdx-3.opdx", *WRITTEN_PROFILES]


def near(expected, rel: float = 1e-6):
    """As pytest.approx with a relative tolerance alone: its absolute one, 1e-12, is more than many a mean square in metres."""
    return pytest.approx(expected, rel=rel, abs=0.0)
