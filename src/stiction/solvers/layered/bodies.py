"""Derive the elastic constants of coated bodies from the dimensionless groups of a contact."""

from typing import NamedTuple

import numpy as np

from stiction.contact.indices import Groups
from stiction.quantities.errors import InputError
from stiction.solvers.layered.compliance import Layer, Pair
from stiction.solvers.layered.waves import CoatedBody

# Limits of the film thickness divided by sqrt(R sigma): thinner films have no effect, thicker ones act as half-spaces.
_THINNEST, _THICKEST = 1e-60, 1e200
_NAMED = ("n_E", "films", "coated_share", "layer_nu", "coated_nu", "counter_nu")


class Bodies(NamedTuple):
    """Store the elastic constants of two bodies in contact, one or both with a film.

    pair: the films, with their fractions of the elastic compliance. coated: elastic constants of each coated body.
    film_modulus: plane-strain modulus of the film divided by the contact modulus of the bodies without films. bare_share:
    compliance of the uncoated body divided by the compliance of both bodies without films; 0 if both are coated. bare_nu:
    Poisson's ratio of the uncoated body.
    """

    pair: Pair
    coated: tuple[CoatedBody, ...]
    film_modulus: float
    bare_share: float
    bare_nu: float


def per_root(groups: Groups) -> np.ndarray:
    """Return the factor (n,) by which (a^2/(R sigma))^(1/4) is multiplied to give sqrt(a/t_1): (R sigma)^(1/4)/sqrt(t_1).

    groups: dimensionless groups of n contacts. a: contact radius. t_1: thickness of one film. R, sigma: asperity radius and
    standard deviation of the asperity heights.
    """
    aspect = np.broadcast_to(groups.film_aspect / groups.films, len(groups))
    return 1.0 / np.sqrt(np.clip(aspect, _THINNEST, _THICKEST))


def columns_of(groups: Groups) -> np.ndarray:
    """Return the six groups (6, n) on which the elastic constants of the coated bodies of n contacts depend.

    Their rows are: contact modulus of the surfaces divided by the contact modulus of the bodies without films, number of films,
    fraction of the compliance without films that belongs to the coated (first) body, and Poisson's ratios of film, coated body
    and counterbody.
    """
    return np.stack([np.broadcast_to(getattr(groups, name), len(groups)) for name in _NAMED])


def film_share(given: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the films' fraction of the surface compliance, and the ratio of the moduli of film and body below: (n,) each.

    given: rows as returned by `columns_of`. The surface compliance belongs to two half-spaces that consist of the surface
    materials. The fraction is 1 if both bodies are coated. Raises InputError if an n_E is impossible for its coated_share.
    """
    n_E, bodies, first = given[:3]
    single = bodies == 1.0
    share = np.where(single, 1.0 - (1.0 - first) * n_E, 1.0)
    if (share <= 0.0).any():
        at = int(np.argmax(share <= 0.0))
        raise InputError("n_E", float(n_E[at]), f"less than 1/(1 - coated_share) = {1.0 / (1.0 - first[at]):.6g}")
    return share, np.where(single, first * n_E / share, n_E)


def bodies_of(groups: Groups) -> tuple[list[Bodies], np.ndarray]:
    """Return the distinct pairs of bodies among n contacts with films, and for each contact the index (n,) of its pair."""
    each, which = np.unique(columns_of(groups), axis=1, return_inverse=True)
    return [_bodies(row) for row in each.T], np.ravel(which)


def _bodies(given: np.ndarray) -> Bodies:
    n_E, films, first, nu, nu_first, nu_second = map(float, given)
    (share,), (ratio,) = film_share(given[:, None])
    if films == 1.0:
        body = CoatedBody(float(ratio), nu, nu_first)
        pair = (Layer.of(float(share), body.ratio, nu, nu_first),)
        return Bodies(pair, (body,), n_E / float(share), 1.0 - first, nu_second)
    coated = CoatedBody(2.0 * n_E * first, nu, nu_first), CoatedBody(2.0 * n_E * (1.0 - first), nu, nu_second)
    layers = sorted((Layer.of(0.5, one.ratio, nu, one.nu_below) for one in coated), key=lambda one: (one.ratio, one.excess))
    return Bodies(tuple(layers), coated, 2.0 * n_E, 0.0, nu_second)
