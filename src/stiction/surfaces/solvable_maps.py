"""Combine the maps of scanned bodies for a point-by-point solution of their contact."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from stiction.quantities.errors import InputError, InWords

if TYPE_CHECKING:
    from stiction.surfaces.heightmap import HeightMap

_ALIKE = 1e-6  # relative difference up to which the sizes of two maps count as equal


@dataclass(frozen=True)
class SolvableMaps:
    """Store the height maps of the rough bodies of a contact, prepared for a point-by-point solution.

    maps: HeightMap of each body, by "first" or "second". some_numbers: whether a rough body has no map, but only specified
    sigma, R and N.
    """

    maps: "Mapping[str, HeightMap]" = field(default_factory=dict)
    some_numbers: bool = False

    @property
    def points(self) -> int:
        """Return the number of points of the larger map; 0 without maps."""
        return max((one.heights.size for one in self.maps.values()), default=0)

    def filled(self) -> "list[HeightMap]":
        """Return the maps that are not profiles, with missing points set to the mean height of their map."""
        maps = [one for one in self.maps.values() if not one.is_profile]
        return [replace(one, heights=np.where(np.isnan(one.heights), np.nanmean(one.heights), one.heights)) for one in maps]

    def attributes(self) -> dict[str, str]:
        """Return the dataset attributes roughness_method ("none: the map itself") and scans (processing steps of the maps)."""
        scans = "\n".join(f"{body} body: {step}" for body, one in self.maps.items() for step in one.history)
        return {"roughness_method": "none: the map itself", "scans": scans}

    def one(self) -> "HeightMap":
        """Return the single map that represents the roughness of both bodies: the sum of their heights.

        Raises InputError if there is no map, a rough body has no map, a map is a profile or has missing points, or two maps
        differ in shape, size or periodicity.
        """
        if self.some_numbers or not self.maps:
            raise InputError(
                "roughness",
                InWords("a body stated by sigma, R and N"),
                "a scan of every rough body, because the heights are solved point by point",
            )
        for body, each in self.maps.items():
            if each.is_profile:
                raise InputError(
                    f"roughness.{body}",
                    InWords("a profile"),
                    "a map with rows and columns, because the contact of a profile is not solved",
                )
            if not each.complete:
                missing = f"{each.missing} points without a height"
                raise InputError(
                    "roughness.fill", missing, "harmonic or nearest, because the solver needs a height at every point"
                )
        first, *others = self.maps.values()
        return _sum(first, others[0]) if others else first


def _sum(first: "HeightMap", second: "HeightMap") -> "HeightMap":
    """Return the sum of the height maps of two bodies that face each other.

    The heights of each map are measured outwards from its body; the second map is mirrored along x. Raises InputError unless
    both maps have the same shape, size and periodicity.
    """
    same = all(math.isclose(one, other, rel_tol=_ALIKE) for one, other in zip(first.size, second.size, strict=True))
    if first.heights.shape != second.heights.shape or not same or first.periodic != second.periodic:
        allowed = "a map with the points, size and periodicity of the first, because both are added"
        raise InputError("roughness.second", _said(second), f"{allowed} ({_said(first)})")
    heights = np.add(first.heights, second.heights[:, ::-1])
    return first.with_heights(heights, f"heights of {second.name or 'the second body'}, turned over, added")


def _said(one: "HeightMap") -> str:
    rows, columns = one.heights.shape
    return f"{columns} x {rows} points over {one.size[1]:.6g} x {one.size[0]:.6g} m" + (", periodic" if one.periodic else "")
