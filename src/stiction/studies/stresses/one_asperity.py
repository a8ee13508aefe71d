"""One asperity, pressed and dragged: the stresses under it in section, and where it yields first.

The asperity is a paraboloid that does not adhere, on the contact radius a, of which x = a/(R sigma)^(1/2) is asked; without a
film it is Hertz's contact with Hamilton's stresses, with one the layered solid of `solvers.layered`. With K, sigma and R as in
docs/theory.md, theory 1, and E_P = 1 and n_E = 1 where there is no film, its load and mean pressure are

    W = n_E E_P x^3 K R^(1/2) sigma^(3/2),    p_m/H = n_E E_P x/eta,    eta = pi H R^(1/2)/(K sigma^(1/2)),

from W = (4/3) E* E_P a^3/R (Hertz 1882; `solvers.layered.sphere`). The yield stress is H/k. The solution is elastic: where the
von Mises stress is above the yield stress, it says by how much, and no more.
"""

import math
from dataclasses import dataclass

import numpy as np

from stiction.contact.indices import Groups
from stiction.contact.subject import Subject
from stiction.laws.tangential.shared.hamilton_field import first_yield, stress, von_mises
from stiction.quantities.errors import InputError
from stiction.solvers.layered.bodies import bodies_of
from stiction.solvers.layered.first_yield import first_yield as first_yield_of_layers
from stiction.solvers.layered.sphere import respond
from stiction.solvers.layered.stresses import Stresses, cartesian
from stiction.studies.stresses.film_stress import require_proportion

_X = np.linspace(-1.8, 1.8, 73)
_Z = np.linspace(0.0, 1.8, 49)


@dataclass(frozen=True)
class OneAsperity:
    """An asperity in section.

    x (m,), z (n,): places over the contact radius, x in the direction of the tangential force and z into the body; stress
    (n, m): the von Mises stress over the yield stress of what is there. thickness: of the film, over the contact radius,
    infinite without one. largest: of the stress, anywhere; at: its place (x, z); where: "film", "interface" or "body".
    radius: over (R sigma)^(1/2); load: over K R^(1/2) sigma^(3/2); pressure: the mean one, over the hardness.
    """

    x: np.ndarray
    z: np.ndarray
    stress: np.ndarray
    thickness: float
    largest: float
    at: tuple[float, float]
    where: str
    radius: float
    load: float
    pressure: float


def one_asperity(subject: Subject, radius: float, traction: float) -> OneAsperity:
    """Compute the stresses under one asperity of a contact.

    radius: of the contact, over (R sigma)^(1/2), above 0; traction: tangential over normal force, 0 or more. Raises InputError
    for array parameters, and for a film out of proportion.
    """
    subject.require_single("one number, for one asperity")
    if not (math.isfinite(radius) and radius > 0.0 and math.isfinite(traction) and traction >= 0.0):
        raise InputError("radius", (radius, traction), "a contact radius above 0, and a traction of 0 or more")
    groups, _ = Groups.of(subject.indices())
    if not groups.has_film or not np.isfinite(groups.film_aspect[0]):
        return _bare(groups, radius, traction)
    return _coated(groups, radius, traction)


def _bare(groups: Groups, radius: float, traction: float) -> OneAsperity:
    nu, k = float(groups.nu[0]), float(np.ravel(groups.hardness_to_yield)[0])
    pressure = radius / float(groups.eta[0])
    over_yield = 1.5 * pressure * k  # p0 = 3/2 p_m, over H/k
    field = over_yield * von_mises(stress(_X[None, :], 0.0, _Z[:, None], traction, nu))
    at_yield, place = first_yield(traction, nu)
    return OneAsperity(
        _X, _Z, field, math.inf, over_yield / at_yield, place, "body", radius, radius**3, pressure
    )  # fmt: skip


def _coated(groups: Groups, radius: float, traction: float) -> OneAsperity:
    """On one film of thickness t/films; where both bodies have one, the first of them."""
    over_film = radius / float(groups.film_aspect[0] / groups.films[0])
    require_proportion(over_film)
    (bodies, *_), _ = bodies_of(groups)
    body, n_E, n_H = bodies.coated[0], float(groups.n_E[0]), float(groups.n_H[0])
    response = respond(bodies.pair, over_film)
    pressure = n_E * response.load * radius / float(groups.eta[0])
    over_yield = pressure * float(np.ravel(groups.hardness_to_yield)[0])
    stresses = Stresses(bodies.pair, body, over_film)
    found = first_yield_of_layers(stresses, traction, n_H)
    field = over_yield * section(stresses, traction, n_H, _X, _Z)
    return OneAsperity(
        _X, _Z, field, 1.0 / over_film, over_yield * found.excess, (found.x, found.z), found.where, radius,
        n_E * response.load * radius**3, pressure,
    )  # fmt: skip


def section(stresses: Stresses, traction: float, film_strength: float, x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Return the von Mises stress over the mean pressure at depths z (n,) and places x (m,).

    In the film it is over the film's strength. x runs along the traction, symmetric about the axis.
    """
    r = np.abs(x[len(x) // 2 :])
    inside = stresses.thickness > z
    rows = []
    for part, depths, strength in ((stresses.in_film, z[inside], film_strength), (stresses.in_body, z[~inside], 1.0)):
        if not depths.size:
            continue
        radial = part(r, depths)
        sides = [cartesian(radial, np.full(r.shape, angle), traction) for angle in (0.0, math.pi)]
        ahead, behind = (von_mises((xx, yy, zz, xy, yz, xz)) for xx, yy, zz, xy, yz, xz in sides)
        rows.append(np.concatenate([behind[:, :0:-1], ahead], axis=1) / strength)
    return np.concatenate(rows)
