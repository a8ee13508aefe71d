"""Define validity ranges and limits that several laws share."""

import math

from stiction.records.claims import Limit, Validity
from stiction.surfaces.theory.moments import LEAST_DENSITY

ELASTIC = Validity("plasticity_index", 0.0, 0.6, "asperities are taken as elastic", "effect")
ELASTIC_CONTACT = Validity("plasticity_index", 0.0, 0.6, "contact is taken as elastic", "effect")
SHORT_RANGE = Validity("tabor_parameter", 5.0, math.inf, "adhesion acts inside the contact only for soft, large asperities")
NEAR_YIELD = Validity(
    "asperity_area_over_yield",
    0.0,
    10.0,
    "yielded asperities keep about the pressure of first yield, and their hardness is above it",
)  # fmt: skip
SOFT_FILM = Validity("n_H", 0.0, 1.0, "the film is soft")
PLASTIC_FILM = Validity("film_plasticity_index", 1.0, math.inf, "the film is taken as plastic at any load", "effect")
THIN_LAYER = Validity("load_share_beyond_film", 0.5, 1.0, "a thin layer: contact radius above thickness")
DEEP_FILM = Validity("load_share_beyond_film", 0.0, 0.5, "the film is a half-space: contact radius below thickness")
ENOUGH_SUMMITS = Validity(
    "roughness_parameter", LEAST_DENSITY, math.inf, "no isotropic Gaussian surface has fewer asperities N R sigma"
)


def elastic_limit(parent: str) -> Limit:
    """Return the limit check of a law that equals the elastic law `parent` if nothing yields."""
    return Limit(parent, {"theta": 1.0, "lam": 1e24}, ("load", "contact_area"), 1e-9)
