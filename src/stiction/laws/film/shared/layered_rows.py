"""Compute the parameters of the formulas for a sphere on a film from the dimensionless groups of each contact."""

import math

import numpy as np

from stiction.contact.indices import Groups
from stiction.solvers.layered.bodies import columns_of, film_share, per_root
from stiction.solvers.layered.compliance import Layer, Pair, poisson_excess
from stiction.solvers.layered.curves import CURVES, TERMS, curves_of_pairs
from stiction.solvers.layered.table import curves_of_films


def rows(groups: Groups, pull: np.ndarray) -> tuple[np.ndarray, ...]:
    """Return the parameters of the formulas in `solvers.layered.asperity` for a sphere on a film, each an array (n,).

    groups: dimensionless groups of n coated contacts with all defaults filled in, from `Groups.resolved`. pull (n,): adhesion,
    the result of `edge_pull` (JKR) or `outer_pull` (DMT). Raises InputError if no bodies can have these groups.
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
    """Return the coefficients (n, CURVES, TERMS) of the curves of spheres on films.

    The curves give effective moduli and displacement as functions of contact radius divided by film thickness. The first
    curve is the modulus E_P of the load. Each pair of materials is computed only once. groups: dimensionless groups of n
    coated contacts with all defaults filled in.
    """
    columns = columns_of(groups)
    if (columns == columns[:, :1]).all():
        return np.broadcast_to(_curves(columns[:, :1]), (len(groups), CURVES, TERMS))
    each, which = np.unique(columns, axis=1, return_inverse=True)
    return _curves(each)[which]


def _curves(columns: np.ndarray) -> np.ndarray:
    """Return the coefficients (n, CURVES, TERMS) of the curves of spheres on films, for n pairs of bodies.

    columns (6, n): elastic constants of the bodies, in the order of `columns_of`.
    """
    n_E, bodies, first, nu, nu_first, nu_second = columns
    alike = (bodies == 2.0) & (first == 0.5) & (nu_first == nu_second)
    unlike = (bodies == 2.0) & ~alike
    (share, ratio), out = film_share(columns), np.empty((len(n_E), CURVES, TERMS))
    one = ~unlike
    out[one] = curves_of_films(share[one], np.maximum(ratio[one], 1e-12), poisson_excess(ratio, nu, nu_first)[one])
    out[unlike] = curves_of_pairs([_films(*column) for column in columns[:, unlike].T.tolist()])
    return out


def _films(n_E: float, bodies: float, first: float, nu: float, nu_first: float, nu_second: float) -> Pair:
    """Return the films on both bodies of one contact; the result does not depend on the order of the bodies.

    The arguments are the elastic constants of the contact, one column of `columns_of`.
    """
    sides = ((first, nu_first), (1.0 - first, nu_second))
    films = [Layer.of(0.5, 2.0 * n_E * share, nu, below) for share, below in sides]
    return tuple(sorted(films, key=lambda film: (film.ratio, film.excess)))


def edge_pull(groups: Groups) -> np.ndarray:
    """Return the strength of adhesion (n,) of JKR's contact on the film, s = (2/3) sqrt(6 pi n_g/theta).

    n_g: work of adhesion of the film divided by the substrate's. theta: elastic adhesion index of the substrate. groups:
    dimensionless groups of n coated contacts.
    """
    return 2.0 / 3.0 * np.sqrt(6.0 * math.pi * groups.n_g / groups.theta)


def outer_pull(groups: Groups) -> np.ndarray:
    """Return DMT's adhesive force (n,) on the film, 2 pi n_g/theta, in units of K R^(1/2) sigma^(3/2).

    It acts on elastic and plastic asperities. n_g: work of adhesion of the film divided by the substrate's. theta: elastic
    adhesion index of the substrate. groups: dimensionless groups of n coated contacts.
    """
    return 2.0 * math.pi * groups.n_g / groups.theta
