"""A fast solution: of every r-th point of the map, never of means over points (which would take the sharp edges of plateaus).

Over 51 maps of 256^2 points (Gaussian, skewed, cut, worn, with a lay) at p/(E* h') from .002 to .3, with four points in the
shortest wave: rms (largest) error of the area .6 % (1.8) where 3000 points or more are in contact, 1.0 % (2.3) from 1000, 4.5 %
(10) from 300, 8.7 % (17) from 100. Across a lay patches are narrower: areas are 3 % too
large at 3:1 and 4 to 10 % at 6:1.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from stiction.solvers.boundary_elements.measures import waves
from stiction.solvers.boundary_elements.solve import MapContacts, solve_map
from stiction.surfaces.heightmap import size_in_metres

LEAST_POINTS = 4.0  # in the shortest wave
LEAST_CONTACT = 1000  # points in contact, at the lightest load


@dataclass(frozen=True)
class SampledContacts:
    """Contacts of the sampled map.

    every: r, 1: all points were solved.
    """

    contacts: MapContacts
    every: int


def solve_sampled(
    heights: np.ndarray, size: tuple[float, float], *, modulus: float, loads: Sequence[float], periodic: bool,
    solve: Callable[..., MapContacts] = solve_map, **how,
) -> SampledContacts:  # fmt: skip
    """Solve as `solve_map` with the fewest points that are enough.

    Enough are four points in the shortest wave, or more where at the lightest load fewer than 1000 would be in contact.
    Arguments and errors as in `solve_map`; solve: the solver to call instead.
    """
    size = size_in_metres(size)
    for every in _candidates(heights, size, periodic):
        sampled = np.ascontiguousarray(heights[::every, ::every])
        covered = tuple(
            length / full * every * few for length, full, few in zip(size, heights.shape, sampled.shape, strict=True)
        )
        contacts = solve(sampled, covered, modulus=modulus, loads=loads, periodic=periodic, **how)
        if (
            every == 1
            or min(contact.area_pixels / contact.nominal_area for contact in contacts) * sampled.size >= LEAST_CONTACT
        ):
            break
    return SampledContacts(contacts, every)


def fewest_points(heights: np.ndarray, size: tuple[float, float], periodic: bool) -> int:
    """Return how many points `solve_sampled` solves at least."""
    every = _candidates(heights, size, periodic)[0]
    return heights[::every, ::every].size


def _candidates(heights, size, periodic):
    """Return spacings of points, in points, from the longest to 1."""
    if np.ndim(heights) != 2 or not np.isfinite(heights).all() or np.ptp(heights) == 0.0 or min(np.shape(heights)) < 16:
        return [1]  # refused there
    pitch = max(length / count for length, count in zip(size, heights.shape, strict=True))
    longest = int(waves(heights, size, periodic).shortest / (LEAST_POINTS * pitch))
    longest = max(1, min(longest, min(heights.shape) // 16))
    return [every for every in range(longest, 0, -1) if not (periodic and any(count % every for count in heights.shape))]
