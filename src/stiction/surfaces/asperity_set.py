"""Define the class Asperities, which every method that finds asperities returns."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction.quantities.errors import InputError, InWords
from stiction.surfaces.heightmap import HeightMap

if TYPE_CHECKING:
    from stiction.surfaces.roughness import Roughness

# With fewer asperities, deviation and skewness do not describe the surface, and heights are assumed Gaussian.
FEW = 30
_ROUNDING = 1e-12


@dataclass(frozen=True, eq=False)
class Asperities:
    """Store the asperities that one method finds on a surface, with their averages.

    - method: key of the method
    - density: number N of asperities per nominal area [1/m^2]
    - deviation: standard deviation sigma of the asperity heights [m]
    - radius: tip radius R [m], the reciprocal of the mean curvature, as in the relations of Nayak and McCool; a mean of the
      radii would be dominated by the few flattest asperities
    - mean_height: mean asperity height above the mean plane [m]; skewness: skewness of the asperity heights
    - note: text that states how many asperities were found, and how
    - heights (n,) [m] above the mean plane; radii (n,) [m], inf for an asperity that does not curve down; places (n, 2), row
      and column of each asperity, or of its middle point. All are empty for a method that only computes averages; places may be
      empty for other methods too
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
        """Return the number of single asperities found; 0 if only their averages are known."""
        return len(self.heights)


def of_samples(
    method: str, heights: np.ndarray, curvatures: np.ndarray, density: float, note: str,
    remedy: str = "finer points or a larger map", places: np.ndarray | None = None,
) -> Asperities:  # fmt: skip
    """Return the Asperities object with the averages over single asperities.

    - method: key of the asperity method that found them
    - heights: (n,) [m] above the mean plane; curvatures: (n,) [1/m], positive for a top that curves down
    - density: asperities per nominal area [1/m^2]
    - note: how the asperities were found; it follows their number in the `note` of the result
    - remedy: advice for the error on how to find more asperities
    - places: (n, 2), row and column of each asperity; None if unknown

    Raises InputError for fewer than two asperities, a density of 0, or a mean curvature that is not positive.
    """
    if len(heights) < 2:
        raise InputError(f"asperities by {method}", InWords(f"{len(heights)} found"), f"2 or more: {remedy}")
    if not density > 0.0:
        raise InputError(
            f"asperities by {method}",
            InWords("no curvature in one direction"),
            "a surface that is rough in both directions; grooves have no asperities",
        )
    mean_curvature = float(curvatures.mean())
    if not mean_curvature > 0.0:
        raise InputError(
            f"asperities by {method}",
            InWords(f"mean curvature {mean_curvature:g} 1/m"),
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
    """Return the standard deviation of samples (n,); 0 if they are equal apart from round-off."""
    deviation = float(samples.std())
    return deviation if deviation > _ROUNDING * np.abs(samples).max() else 0.0


def of_numbers(surface: "Roughness") -> Asperities:
    """Return the Asperities object for a body whose sigma, R and N the user specifies; mean height and skewness are 0."""
    density: Any = surface.asperity_density
    deviation: Any = surface.asperity_height_deviation
    radius: Any = surface.asperity_radius
    return Asperities("numbers", density, deviation, radius, 0.0, 0.0, "as given")


def rounding(heights: np.ndarray) -> float:
    """Return the limit [m] below which height differences in a map of heights [m] count as round-off.

    Without this limit, the round-off of levelling would create peaks along the ridge of a groove.
    """
    return _ROUNDING * float(np.nanmax(heights) - np.nanmin(heights))


def skewness(samples: np.ndarray) -> float:
    """Return the skewness of samples (n,): the third central moment divided by the cube of the standard deviation.

    The result is 0 if all samples are equal apart from round-off.
    """
    deviation = spread(samples)
    if deviation == 0.0:
        return 0.0
    apart = (samples - samples.mean()) / deviation
    return float(np.mean(apart * apart * apart))


def over_mean_plane(surface: HeightMap) -> np.ndarray:
    """Return the heights (rows, columns) [m] of a map minus their mean; NaN for missing points.

    A tilt is not removed: level the map first.
    """
    return surface.heights - (surface.heights.mean() if surface.complete else np.nanmean(surface.heights))
