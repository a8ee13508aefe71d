"""Comparing numbers in metres."""

import pytest

__all__ = ["near"]


def near(expected, rel: float = 1e-6):
    """As pytest.approx with a relative tolerance alone: its absolute one, 1e-12, is more than many a mean square in metres."""
    return pytest.approx(expected, rel=rel, abs=0.0)
