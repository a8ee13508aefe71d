"""Divide a film's asperity law where the film is pressed through and where it stops acting as a half-space."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.regime import Regime
from stiction.laws.joining import Law, Weights, coordinates, coordinates_at_area, within
from stiction.laws.segment import NormalSegment


def film_regimes(
    law: Law, groups: Groups, through: np.ndarray, weights: Callable[[NormalSegment], tuple[Weights, Weights]]
) -> list[Regime]:
    """Return the regimes of a film that obeys its own asperity law at every displacement.

    A regime is a segment of an asperity law together with the tangential force on it. groups: dimensionless groups of n
    coated contacts. through (n,): displacement, in units of sigma, at which the film is pressed through. weights(segment):
    returns the `Weights` of the response before and after this displacement. The film acts as a half-space while the
    contact radius is below the film thickness; regimes of wider contacts have in_half_space=False.
    """
    film = groups.film()
    # For a film of infinite thickness the regimes of wider contacts would be empty and are left out.
    bounded = not np.all(np.isinf(groups.film_aspect))
    regimes = []
    for segment in law.segments(film):
        u_through = coordinates(segment, through)
        u_bound = coordinates_at_area(segment, groups.film_aspect**2) if bounded else np.inf
        before, after = weights(segment)
        stretches = (within(segment, -np.inf, u_through), before), (within(segment, u_through, np.inf), after)
        for stretch, counts in stretches:
            joined = law.join(stretch, film, counts, body="film")
            regimes.append(within(joined, -np.inf, u_bound))
            if bounded:
                regimes.append(replace(within(joined, u_bound, np.inf), in_half_space=False))
    return regimes
