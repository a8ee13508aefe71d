"""Asperities as every method returns them: how many, how high, how blunt."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from stiction.quantities.errors import InputError
from stiction.surfaces.heightmap import HeightMap

if TYPE_CHECKING:
    from stiction.surfaces.roughness import Roughness

# Below this many, deviation and skewness say nothing of the surface, and heights are taken as Gaussian.
FEW = 30
_ROUNDING = 1e-12


@dataclass(frozen=True, eq=False)
class Asperities:
    """The asperities of a surface as one method finds them.

    method: its key. heights: (n,) [m] over the mean plane; radii: (n,) [m], inf where a summit does not curve down; both are
    empty for a method that only computes averages. density: per nominal area [1/m^2]. deviation: of the heights, sigma [m].
    radius: R [m], of the mean curvature, 1 / <1/R>, as in Nayak's and McCool's relations; it is always finite, while the few
    flattest summits dominate the mean of the radii. mean_height: over the mean plane [m]. skewness: of the heights. note: the
    numbers found and their basis. places: (n, 2), row and column of each asperity in the map, of its middle point if it has
    several; also empty for averages, or where the method does not return them.
    """

    method: str
    density: float
    deviation: float
    radius: float
    mean_height: float
    skewness: float
    note: str
    heights: np.ndarray = field(default_factory=lambda: np.zeros(0))
    radii: np.ndarray = field(default_factory=lambda: np.zeros(0))
    places: np.ndarray = field(default_factory=lambda: np.zeros((0, 2), dtype=int))

    @property
    def count(self) -> int:
        """Return how many were found; 0 for a method that only computes averages."""
        return len(self.heights)


def of_samples(
    method: str, heights: np.ndarray, curvatures: np.ndarray, density: float, note: str,
    remedy: str = "finer points or a larger map", places: np.ndarray | None = None,
) -> Asperities:  # fmt: skip
    """Average asperities: heights (n,) [m] and curvatures (n,) [1/m], positive downwards.

    remedy: a change that would find more. places: (n, 2), row and column of each, None if unknown. Raises InputError if there
    are fewer than two, or if their mean curvature is not downwards.
    """
    if len(heights) < 2:
        raise InputError(f"asperities by {method}", f"{len(heights)} found", f"2 or more: {remedy}")
    if not density > 0.0:
        raise InputError(f"asperities by {method}", "none along one direction", "some along both: a surface, not grooves")
    mean_curvature = float(curvatures.mean())
    if not mean_curvature > 0.0:
        raise InputError(f"asperities by {method}", f"mean curvature {mean_curvature:g} 1/m", "> 0: summits that curve down")
    notes = [f"{len(heights)} {note}"]
    if len(heights) < FEW:
        notes.append(f"fewer than {FEW}: deviation and skewness are uncertain")
    if flat := int(np.count_nonzero(curvatures <= 0.0)):
        notes.append(f"{flat} of them do not curve down on average over the fitted points")
    with np.errstate(divide="ignore"):
        radii = np.where(curvatures > 0.0, 1.0 / curvatures, np.inf)
    return Asperities(
        method,
        density,
        spread(heights),
        1.0 / mean_curvature,
        float(heights.mean()),
        skewness(heights),
        "; ".join(notes),
        heights,
        radii,
        np.zeros((0, 2), dtype=int) if places is None else places,
    )


def spread(samples: np.ndarray) -> float:
    """Return the standard deviation; 0 where all are equal to rounding."""
    deviation = float(samples.std())
    return deviation if deviation > _ROUNDING * np.abs(samples).max() else 0.0


def of_numbers(surface: "Roughness") -> Asperities:
    """Return stated asperities of a body without a scan.

    Heights count from their own mean.
    """
    deviation, radius, density = surface.asperity_height_deviation, surface.asperity_radius, surface.asperity_density
    return Asperities("numbers", density, deviation, radius, 0.0, 0.0, "as given")


def rounding(heights: np.ndarray) -> float:
    """Return the difference in height [m] that may be rounding of levelling.

    Smaller differences are not taken for peaks along the ridge of a groove.
    """
    return _ROUNDING * float(np.nanmax(heights) - np.nanmin(heights))


def skewness(samples: np.ndarray) -> float:
    """Return the third central moment over the cube of the deviation.

    It is 0 where all heights are equal to rounding.
    """
    deviation = spread(samples)
    if deviation == 0.0:
        return 0.0
    apart = (samples - samples.mean()) / deviation
    return float(np.mean(apart * apart * apart))


def over_mean_plane(surface: HeightMap) -> np.ndarray:
    """Subtract the mean from the heights (rows, columns) [m]; NaN where missing.

    A tilt stays: level the map first.
    """
    return surface.heights - (surface.heights.mean() if surface.complete else np.nanmean(surface.heights))
