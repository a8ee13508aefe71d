"""Compute the parameters of the formulas for a sphere on a film from the groups of each contact."""

import math

import numpy as np

from stiction.contact.indices import Groups
from stiction.solvers.layered.bodies import columns_of, film_share, per_root
from stiction.solvers.layered.compliance import Layer, poisson_excess
from stiction.solvers.layered.curves import curves
from stiction.solvers.layered.table import curves_of_films


def rows(groups: Groups, pull: np.ndarray) -> tuple[np.ndarray, ...]:
    """Return the parameters (n,) that the formulas of `solvers.layered.asperity` take.

    groups: complete groups (`Groups.resolved`) of contacts with a film. pull (n,): adhesion, from `edge_pull` or `outer_pull`.
    Raises InputError if no such bodies can exist.
    """
    laws = len(groups)
    n_E = np.where(groups.film_aspect > 0.0, groups.n_E, 1.0)
    return (
        np.log(np.broadcast_to(n_E, laws)),
        per_root(groups),
        np.broadcast_to(pull, laws),
        *coefficients(groups).reshape(laws, -1).T,
    )


def coefficients(groups: Groups) -> np.ndarray:
    """Return the compliance curves (n, CURVES, TERMS) of all contacts; each pair of materials is computed once."""
    columns = columns_of(groups)
    if (columns == columns[:, :1]).all():
        return np.broadcast_to(_curves(columns[:, :1]), (len(groups), *_curves(columns[:, :1]).shape[1:]))
    each, which = np.unique(columns, axis=1, return_inverse=True)
    return _curves(each)[which]


def _curves(columns: np.ndarray) -> np.ndarray:
    """Return the compliance curves for the material columns (6, n) of `columns_of`."""
    n_E, bodies, first, nu, nu_first, nu_second = columns
    alike = (bodies == 2.0) & (first == 0.5) & (nu_first == nu_second)
    share, ratio = film_share(columns)
    out = curves_of_films(share, np.maximum(ratio, 1e-12), poisson_excess(ratio, nu, nu_first))
    for i in np.flatnonzero((bodies == 2.0) & ~alike):
        films = [
            Layer.of(0.5, 2.0 * n_E[i] * part, nu[i], below)
            for part, below in ((first[i], nu_first[i]), (1.0 - first[i], nu_second[i]))
        ]
        out[i] = curves(tuple(sorted(films, key=lambda film: (film.ratio, film.excess))))
    return out


def edge_pull(groups: Groups) -> np.ndarray:
    """Return the adhesion parameter s = (2/3) sqrt(6 pi n_g/theta) of JKR's contact on the film (n,)."""
    return 2.0 / 3.0 * np.sqrt(6.0 * math.pi * groups.n_g / groups.theta)


def outer_pull(groups: Groups) -> np.ndarray:
    """Return DMT's adhesive force 2 pi n_g/theta (n,), which also acts on plastic asperities."""
    return 2.0 * math.pi * groups.n_g / groups.theta
