"""The corrected reading of the 2015 paper's soft film: it deforms alone until it is pressed by its own thickness; beyond,
it keeps the load and resistance it had then, and the substrate answers the rest (docs/theory.md; D4, D5, D10).
"""

import numpy as np

from ..asperity.regime import Regime
from ..compiled import formula
from ..friction import adhesive_asperity as asperities
from ..friction.adhesive_asperity import Asperity, Share
from .film import film_regimes


@formula
def at_rest(w, load, slip, tear):
    """A film that no longer deforms: the same load and resistance at any displacement."""
    return w, 1.0, load, 0.0, slip, tear


@formula
def at_rest_coordinate(w, load, slip, tear):
    return w


def sequential_regimes(
    film: Asperity, substrate: Asperity, n_E: np.ndarray, tau: np.ndarray, film_aspect: np.ndarray
) -> list[Regime]:
    """Regimes of a coated surface, loads and resistances in units of the substrate; arrays (n,).

    film and substrate: each in its own adhesion indices. n_E: K of the film over K of the substrate. tau = t/sigma.
    film_aspect = t/sqrt(R sigma). The area is the film's at the full displacement: the outer contact is always on it.
    """
    u_tau = asperities.coordinate_at(film, tau)
    before, after = Share(force=n_E, grip=n_E), Share(force=0.0, grip=0.0)
    deforming = film_regimes(film, film_aspect, (u_tau, tau), (before, after), (before, after))
    kept = n_E[:, None] * asperities.held(film, tau, u_tau)
    edges = np.stack([tau, np.full(len(tau), np.inf)], axis=1)
    rest = Regime(at_rest, at_rest_coordinate, tuple(kept.T), edges, "held", "film", touching=False)
    below = Share(shift=tau, cover=0.0)
    return [*deforming, rest, *asperities.bare_regimes(substrate, share=below, body="substrate", touching=False)]
