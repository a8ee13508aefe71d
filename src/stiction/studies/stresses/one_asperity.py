"""Compute the stresses in a section under one pressed and dragged asperity, and the position of first yield.

The asperity is a non-adhesive paraboloid with contact radius a, stated as x = a/(R sigma)^(1/2). Without a film it is Hertz's
contact with Hamilton's stresses, with a film the layered solid of `solvers.layered`. K, sigma and R are as in theory.md,
theory 1. E_P is the dimensionless load of the layered contact, and n_E the modulus of the film over the modulus of the body;
without a film both are 1. The load and mean pressure are

    W = n_E E_P x^3 K R^(1/2) sigma^(3/2),    p_m/H = n_E E_P x/eta,    eta = pi H R^(1/2)/(K sigma^(1/2)),

from W = (4/3) E* E_P a^3/R (Hertz 1882; `solvers.layered.sphere`). The yield stress is the hardness H over the constraint
factor k. The solution is elastic: a von Mises stress above the yield stress shows by how much yield is exceeded, not the true
stress.
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
    """Hold the stresses in a section under one asperity.

    x (m,), z (n,): positions along the tangential force and depths, over the contact radius. stress (n, m): von Mises stress
    over the local yield stress. thickness: film thickness over contact radius, infinite without a film. largest: highest stress
    anywhere, over the local yield stress. at: position (x, z) of this stress. where: part in which this position lies, "film",
    "interface" or "body". radius: contact radius over (R sigma)^(1/2), with the radius R and height deviation sigma of
    asperities. load: load over K R^(1/2) sigma^(3/2), with K = (4/3) E* of the bodies. pressure: mean pressure over the
    hardness.
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

    radius: contact radius over (R sigma)^(1/2), with the radius R and height deviation sigma of asperities, above 0. traction:
    tangential over normal force, 0 or more. Raises InputError for array parameters, and for a contact radius that is too large
    or too small relative to the film.
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
    """Compute the stresses under an asperity on a coated body; if both bodies are coated, in the first one.

    radius: contact radius over (R sigma)^(1/2). traction: tangential over normal force. If there are two films, each has half
    the total thickness.
    """
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
    """Return the von Mises stress over the mean pressure (n, m) at depths z (n,) and positions x (m,).

    stresses: solution of the layered body. traction: tangential over normal force. x and z are over the contact radius; x runs
    along the tangential force and must be symmetric about 0. In the film the stress is also divided by film_strength, the film
    hardness over the body hardness.
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
