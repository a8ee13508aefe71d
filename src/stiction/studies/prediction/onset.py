"""How much of its strength a contact bears at once, where the case states that strength falls with slip."""

from dataclasses import dataclass

import numpy as np

from stiction.solving.sliding_efficiency import SPOTS_ERROR, efficiency, spot_radius, spread_of_edges, spread_of_spots
from stiction.studies.prediction.asked import Asked

__all__ = ["Onset"]


@dataclass(frozen=True)
class Onset:
    """The loss of strength with slip, and what it depends on; arrays (n or 1, m or 1) over draws and points.

    slip [m], residual; deviation [m], radius [m], density [1/m2]: of asperities; side [m]: of the nominal area; compliance
    [1/Pa]: S of the faces, and of the bodies below them; thickness [m]: of the film, 0 where there is none.
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
    def of(cls, asked: Asked) -> "Onset | None":
        """Return the loss that a case states; None where it states none."""
        contact = asked.drawn
        if contact.weakening_slip is None:
            return None
        rough, coating = contact.roughness, contact.coating
        faces, bodies = (
            asked.column(sum((2.0 - one.poissons_ratio) / (2.0 * one.shear_modulus) for one in pair))
            for pair in (contact.touching, (contact.first, contact.second))
        )
        return cls(
            asked.column(contact.weakening_slip),
            asked.column(contact.residual_strength),
            asked.column(rough.asperity_height_deviation),
            asked.column(rough.asperity_radius),
            asked.column(rough.asperity_density),
            asked.column(contact.nominal_area**0.5),
            (faces, bodies),
            asked.column(0.0 if coating is None else coating.thickness),
        )

    def efficiency(self, strength: np.ndarray, share: np.ndarray, level: np.ndarray, rows: np.ndarray) -> np.ndarray:
        """Return the largest force over the sum of strengths (n, m).

        strength: mean strength on the area [Pa] (n, m); share: of the nominal area in contact (n, m); level: of the error of
        the spots (n,); rows: of the inputs (n,). Spots wider than a film is thick feel the body below it.
        """
        from scipy.special import ndtri

        def drawn(column: np.ndarray) -> np.ndarray:
            return column[rows % len(column)]

        deviation, radius, density = (drawn(one) for one in (self.deviation, self.radius, self.density))
        spots = spot_radius(share, deviation, radius, density)
        faces, bodies = (drawn(one) for one in self.compliance)
        thickness = drawn(self.thickness)
        below = bodies + (faces - bodies) * thickness / (thickness + spots)
        of_spots = (
            below * spread_of_spots(spots, share, deviation * radius * density) * np.exp(SPOTS_ERROR * ndtri(level))[:, None]
        )
        of_edges = bodies * spread_of_edges(drawn(self.side), share)
        return efficiency(strength * np.hypot(of_spots, of_edges) / drawn(self.slip), drawn(self.residual))
