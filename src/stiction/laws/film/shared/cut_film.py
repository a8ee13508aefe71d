"""Divide a film's asperity law where the film is pressed through and where it stops acting as a half-space."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.regime import Regime
from stiction.laws.joining import Law, Weights, coordinates, coordinates_at_area, within
from stiction.laws.piece import NormalPiece


def film_regimes(
    law: Law, groups: Groups, through: np.ndarray, weights: Callable[[NormalPiece], tuple[Weights, Weights]]
) -> list[Regime]:
    """Return the regimes of a film that follows its own asperity law at every displacement.

    through (n,): displacement at which the film is pressed through. weights(piece): weights of the response before and after
    this displacement. The film acts as a half-space while the contact radius is below the film thickness, a < t; regimes
    beyond have in_half_space=False.
    """
    film = groups.film()
    # Where the film is a half-space to all, the stretches beyond are empty: left out.
    bounded = not np.all(np.isinf(groups.film_aspect))
    regimes = []
    for piece in law.pieces(film):
        u_through = coordinates(piece, through)
        u_bound = coordinates_at_area(piece, groups.film_aspect**2) if bounded else np.inf
        before, after = weights(piece)
        stretches = (within(piece, -np.inf, u_through), before), (within(piece, u_through, np.inf), after)
        for stretch, counts in stretches:
            joined = law.join(stretch, film, counts, body="film")
            regimes.append(within(joined, -np.inf, u_bound))
            if bounded:
                regimes.append(replace(within(joined, u_bound, np.inf), in_half_space=False))
    return regimes
