"""Where a contact is in the plane of the adhesion indices, and the limits that are drawn there.

theta = 10 and lambda = 0.125 are those below which adhesion is felt (docs/theory.md, theory 1, and the 2015 paper). psi = 0.6
and 1 are those of Greenwood & Williamson (1966): below, contacts are elastic, above, plastic, at all loads of practice. As
eta = pi H (R/sigma)^(1/2)/K = (3 pi/4)/psi follows from theta and lambda (docs/theory.md, theory 1), psi is a line in the
plane: lambda = [3 pi/(4 psi)/eta(theta, 1)]^4.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from stiction.contact.indices import hardness_group
from stiction.contact.subject import Subject
from stiction.quantities.errors import InputError

ADHESION_MATTERS: Mapping[str, float] = {"theta": 10.0, "lam": 0.125}
PLASTICITY = (0.6, 1.0)


@dataclass(frozen=True)
class Place:
    """theta and lambda of the bodies, and of the film as a half-space or None where there is none; psi of the bodies."""

    bodies: tuple[float, float]
    film: tuple[float, float] | None
    plasticity_index: float


def place_of(subject: Subject) -> Place:
    """Where a contact is. Raises InputError for one that does not adhere, and for numbers that are several."""
    subject.require_single("one number, for one place")
    groups = subject.indices().resolved()
    if groups.theta is None:
        raise InputError("work_of_adhesion", None, "above 0 J/m^2; without adhesion both indices are infinite")
    film = groups.film() if groups.has_film else None
    psi = 0.75 * math.pi / float(hardness_group(groups.theta, groups.lam))
    return Place(
        (float(groups.theta), float(groups.lam)), None if film is None else (float(film.theta), float(film.lam)), psi
    )  # fmt: skip


def plasticity_line(theta: np.ndarray, psi: float) -> np.ndarray:
    """lambda at which the plasticity index is psi, for each theta (n,)."""
    return (0.75 * math.pi / psi / hardness_group(np.asarray(theta, dtype=float), 1.0)) ** 4
