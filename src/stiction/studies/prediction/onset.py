"""Loss of friction at the onset of sliding, if the case states that strength falls with slip."""

from dataclasses import dataclass

import numpy as np

from stiction.solving.sliding_efficiency import SPOTS_ERROR, efficiency, spot_radius, spread_of_edges, spread_of_spots
from stiction.studies.prediction.sampled_case import SampledCase

__all__ = ["Onset"]


@dataclass(frozen=True)
class Onset:
    """The inputs of the onset of sliding, arrays (n or 1, m or 1) over samples and points.

    slip: weakening slip [m]; residual: residual strength (fraction); deviation [m], radius [m], density [1/m2]: sigma, R
    and N of the asperities; side: side of the nominal area [m]; compliance: tangential compliance S [1/Pa] of the touching
    surfaces, and of the bodies below them; thickness: film thickness [m], 0 without a film.
    """

    slip: np.ndarray
    residual: np.ndarray
    deviation: np.ndarray
    radius: np.ndarray
    density: np.ndarray
    side: np.ndarray
    compliance: tuple[np.ndarray, np.ndarray]
    thickness: np.ndarray

    @classmethod
    def of(cls, sampled: SampledCase) -> "Onset | None":
        """Return the inputs of the onset of sliding, or None if the case states no weakening slip."""
        contact = sampled.drawn
        if contact.weakening_slip is None:
            return None
        rough, coating = contact.roughness, contact.coating
        faces, bodies = (
            sampled.column(sum((2.0 - body.poissons_ratio) / (2.0 * body.shear_modulus) for body in pair))
            for pair in (contact.touching, (contact.first, contact.second))
        )
        return cls(
            sampled.column(contact.weakening_slip),
            sampled.column(contact.residual_strength),
            sampled.column(rough.asperity_height_deviation),
            sampled.column(rough.asperity_radius),
            sampled.column(rough.asperity_density),
            sampled.column(contact.nominal_area**0.5),
            (faces, bodies),
            sampled.column(0.0 if coating is None else coating.thickness),
        )

    def efficiency(self, strength: np.ndarray, share: np.ndarray, level: np.ndarray, rows: np.ndarray) -> np.ndarray:
        """Return the largest friction force over the sum of the strengths of all contact spots (n, m).

        strength: mean shear strength on the contact area [Pa] (n, m); share: real over nominal area (n, m); level: quantile
        levels (n,) of the error of the model; rows: rows (n,) of the sampled inputs. Spots wider than a film is thick have
        the compliance of the body below it.
        """
        from scipy.special import ndtri

        def drawn(column: np.ndarray) -> np.ndarray:
            return column[rows % len(column)]

        deviation, radius, density = (drawn(table) for table in (self.deviation, self.radius, self.density))
        spots = spot_radius(share, deviation, radius, density)
        faces, bodies = (drawn(table) for table in self.compliance)
        thickness = drawn(self.thickness)
        below = bodies + (faces - bodies) * thickness / (thickness + spots)
        of_spots = (
            below * spread_of_spots(spots, share, deviation * radius * density) * np.exp(SPOTS_ERROR * ndtri(level))[:, None]
        )
        of_edges = bodies * spread_of_edges(drawn(self.side), share)
        return efficiency(strength * np.hypot(of_spots, of_edges) / drawn(self.slip), drawn(self.residual))
