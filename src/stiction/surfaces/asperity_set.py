"""The asperities of a surface in the form that every finding method returns."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

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
    """Store the asperities that one method finds on a surface.

    method: key of the method. density: N, number per nominal area [1/m^2]. deviation: standard deviation sigma of the
    asperity heights [m]. radius: R [m], the reciprocal of the mean summit curvature, as in the relations of Nayak and McCool.
    A mean of the radii would be dominated by the few flattest summits. mean_height: mean asperity height above the mean plane
    [m]. skewness: skewness of the asperity heights. note: the numbers found and their basis, in words.

    heights: (n,) [m] above the mean plane. radii: (n,) [m], inf for a summit that does not curve down. places: (n, 2), row
    and column of each asperity in the map, or of its middle point if it has several. The three arrays are empty for a method
    that only computes averages. places is also empty if the method does not return positions.
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
        """Return the number of asperities found; 0 for a method that only computes averages."""
        return len(self.heights)


def of_samples(
    method: str, heights: np.ndarray, curvatures: np.ndarray, density: float, note: str,
    remedy: str = "finer points or a larger map", places: np.ndarray | None = None,
) -> Asperities:  # fmt: skip
    """Return the Asperities object for single asperities, with their averages.

    heights: (n,) [m]. curvatures: (n,) [1/m], positive for summits that curve down. remedy: a change that would find more,
    for the error text. places: (n, 2), row and column of each, None if unknown. Raises InputError for fewer than two
    asperities, a density of 0, or a mean curvature that is not positive.
    """
    if len(heights) < 2:
        raise InputError(f"asperities by {method}", f"{len(heights)} found", f"2 or more: {remedy}")
    if not density > 0.0:
        raise InputError(
            f"asperities by {method}",
            "no curvature in one direction",
            "a surface that is rough in both directions; grooves have no asperities",
        )
    mean_curvature = float(curvatures.mean())
    if not mean_curvature > 0.0:
        raise InputError(
            f"asperities by {method}",
            f"mean curvature {mean_curvature:g} 1/m",
            "> 0, the sign for asperities with a rounded top",
        )
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
    """Return the standard deviation of samples (n,); 0 if all are equal apart from rounding."""
    deviation = float(samples.std())
    return deviation if deviation > _ROUNDING * np.abs(samples).max() else 0.0


def of_numbers(surface: "Roughness") -> Asperities:
    """Return the Asperities object for a body with stated sigma, R and N.

    Heights are measured from their own mean.
    """
    density: Any = surface.asperity_density
    deviation: Any = surface.asperity_height_deviation
    radius: Any = surface.asperity_radius
    return Asperities("numbers", density, deviation, radius, 0.0, 0.0, "as given")


def rounding(heights: np.ndarray) -> float:
    """Return the smallest height difference [m] that counts; smaller ones may be rounding errors of levelling.

    Without this limit, rounding would make peaks along the ridge of a groove.
    """
    return _ROUNDING * float(np.nanmax(heights) - np.nanmin(heights))


def skewness(samples: np.ndarray) -> float:
    """Return the skewness of samples (n,): third central moment over the cube of the standard deviation.

    The result is 0 if all samples are equal apart from rounding.
    """
    deviation = spread(samples)
    if deviation == 0.0:
        return 0.0
    apart = (samples - samples.mean()) / deviation
    return float(np.mean(apart * apart * apart))


def over_mean_plane(surface: HeightMap) -> np.ndarray:
    """Return the heights (rows, columns) [m] of a map minus their mean; NaN where missing.

    A tilt stays: level the map first.
    """
    return surface.heights - (surface.heights.mean() if surface.complete else np.nanmean(surface.heights))
