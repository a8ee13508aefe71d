"""The film as a body of its own: its regimes, cut where it is pressed through and where it stops being a half-space."""

import numpy as np

from ..asperity.regime import Regime
from ..friction import adhesive_asperity as asperities
from ..friction.adhesive_asperity import Asperity, Share


def film_regimes(
    film: Asperity,
    film_aspect: np.ndarray,
    through: tuple[np.ndarray, np.ndarray],
    elastic_shares: tuple[Share, Share],
    plastic_shares: tuple[Share, Share],
) -> list[Regime]:
    """The film's own law at every displacement.

    through: where it is pressed through, in the elastic and in the plastic coordinate (n,); the shares count before and
    after that. film_aspect = t/sqrt(R sigma), (n,): to an asperity the film is a half-space while a < t, that is
    x < film_aspect^2; the regimes beyond are marked.
    """
    edges, branch = film.kinks()
    first_plastic = asperities.onset_of_plasticity(film, edges)
    u_bound, w_bound = np.sqrt(film_aspect), film_aspect**2 / 2.0  # x = u^4, and x = 2 w when plastic
    # Where the film is a half-space to all, the stretches beyond are empty: left out.
    half_space = (True,) if np.all(np.isinf(film_aspect)) else (True, False)
    regimes = []
    for after, (elastic_share, plastic_share) in enumerate(zip(elastic_shares, plastic_shares, strict=True)):
        u_range = (through[0], np.inf) if after else (0.0, through[0])
        w_range = (through[1], np.inf) if after else (0.0, through[1])
        for in_half_space in half_space:
            labels = {"body": "film", "in_half_space": in_half_space}
            bound = (0.0, u_bound) if in_half_space else (u_bound, np.inf)
            stretch = clip(edges, np.maximum(u_range[0], bound[0]), np.minimum(u_range[1], bound[1]))
            regimes.append(asperities.elastic_regime(film, stretch, branch, elastic_share, **labels))
            bound = (0.0, w_bound) if in_half_space else (w_bound, np.inf)
            first = np.maximum(first_plastic, np.maximum(w_range[0], bound[0]))
            last = np.minimum(w_range[1], bound[1])
            regimes.append(asperities.plastic_regime(film, first, last, plastic_share, **labels))
    return regimes


def clip(edges: np.ndarray, low: np.ndarray | float, high: np.ndarray | float) -> np.ndarray:
    """Edges (n, m) with all that is outside [low, high] drawn to its ends; without length where high < low."""
    return np.minimum(np.maximum(edges, np.reshape(low, (-1, 1))), np.reshape(high, (-1, 1)))
