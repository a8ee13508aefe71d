"""Define validity ranges and limiting cases that several laws share."""

import math

from stiction.records.claims import Limit, Validity
from stiction.surfaces.theory.moments import LEAST_DENSITY

ELASTIC = Validity("plasticity_index", 0.0, 0.6, "asperities are modelled as elastic, but some yield", "effect")
ELASTIC_CONTACT = Validity("plasticity_index", 0.0, 0.6, "the contact is modelled as elastic, but it yields", "effect")
SHORT_RANGE = Validity(
    "tabor_parameter", 5.0, math.inf, "the law assumes all adhesion inside the contact, as for soft, large asperities"
)
NEAR_YIELD = Validity(
    "asperity_area_over_yield",
    0.0,
    10.0,
    "in this law the pressure of yielded asperities stays near the pressure at first yield; it should rise to the hardness",
)  # fmt: skip
SOFT_FILM = Validity("n_H", 0.0, 1.0, "the law assumes a film that is softer than the substrate")
PLASTIC_FILM = Validity("film_plasticity_index", 1.0, math.inf, "the film is modelled as plastic at any load", "effect")
THIN_LAYER = Validity("load_share_beyond_film", 0.5, 1.0, "the law assumes a film thinner than the contact radius")
DEEP_FILM = Validity(
    "load_share_beyond_film",
    0.0,
    0.5,
    "the law treats the film as a half-space, so it assumes a film thicker than the contact radius",
)
ENOUGH_SUMMITS = Validity(
    "roughness_parameter", LEAST_DENSITY, math.inf, "an isotropic Gaussian surface cannot have fewer asperities"
)


def elastic_limit(parent: str) -> Limit:
    """Return a record entry (Limit): the law equals the elastic law `parent` if nothing yields.

    Load and contact area must agree within 1e-9 at an elastic adhesion index of 1 and a plastic one of 1e24, at which
    nothing yields.
    """
    return Limit(parent, {"theta": 1.0, "lam": 1e24}, ("load", "contact_area"), 1e-9)
