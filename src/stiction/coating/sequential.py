"""The corrected reading of the 2015 paper's soft film: it deforms alone until it is pressed by its own thickness; beyond,
it keeps the load and resistance it had then, and the substrate answers the rest (docs/theory.md; D4, D5, D10).
"""

import numpy as np

from ..asperity.regime import Regime
from ..compiled import formula
from ..friction import adhesive_asperity as asperities
from ..friction.adhesive_asperity import Asperity, Share
from ..groups import Groups
from ..registry import Record, Validity
from ..sources import Source
from .film import film_regimes


@formula
def at_rest(w, load, slip, tear):
    """A film that no longer deforms: the same load and resistance at any displacement."""
    return w, 1.0, load, 0.0, slip, tear


@formula
def at_rest_coordinate(w, load, slip, tear):
    return w


def regimes(substrate: Asperity, film: Asperity, groups: Groups) -> list[Regime]:
    """Regimes of a coated surface, loads and resistances in units of the substrate.

    substrate and film: each in its own adhesion indices. The area is the film's at the full displacement: the outer
    contact is always on it.
    """
    tau, n_E = groups.tau, groups.n_E
    u_tau = asperities.coordinate_at(film, tau)
    before, after = Share(force=n_E, grip=n_E), Share(force=0.0, grip=0.0)
    deforming = film_regimes(film, groups.film_aspect, (u_tau, tau), (before, after), (before, after))
    kept = n_E[:, None] * asperities.held(film, tau, u_tau)
    edges = np.stack([tau, np.full(len(tau), np.inf)], axis=1)
    rest = Regime(at_rest, at_rest_coordinate, tuple(kept.T), edges, "held", "film", touching=False)
    below = Share(shift=tau, cover=0.0)
    return [*deforming, rest, *asperities.bare_regimes(substrate, share=below, body="substrate", touching=False)]


RECORD = Record(
    key="sequential",
    kind="film",
    title="Soft film deforming alone until it is pressed by its own thickness, then the substrate",
    grade="C",
    sources=(Source("soft_coating_2015", "eqs. (6) and (15)", "corrected: D4, D5, D8, D9, D10"),),
    regimes=regimes,
    verified="independent evaluation at 30 digits; the film's own law for a thick film",
    needs=("n_E", "n_H", "tau"),
    validity=(Validity("load_share_beyond_film", 0.0, 0.5, "the film is a half-space: contact radius below thickness"),),
    notes="At zero thickness the adhesion of first touch on the film remains: -4 pi/(3 theta) for each touching asperity.",
)
