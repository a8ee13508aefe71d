"""Place a contact in the plane of the adhesion indices theta and lambda, and compute the limits drawn in this plane.

Adhesion matters if theta is below 10 or lambda is below 0.125 (theory.md, theory 1, and the 2015 paper). The plasticity index
psi has the limits 0.6 and 1 of Greenwood & Williamson (1966): contacts with a smaller index are elastic, contacts with a larger
one plastic, at all practical loads. As eta = pi H (R/sigma)^(1/2)/K = (3 pi/4)/psi follows from theta and lambda (theory.md,
theory 1), each psi is a line in the plane: lambda = [3 pi/(4 psi)/eta(theta, 1)]^4.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from stiction.contact.indices import hardness_group
from stiction.contact.subject import Subject
from stiction.quantities.errors import InputError

ADHESION_MATTERS: Mapping[str, float] = {"theta": 10.0, "lam": 0.125}
PLASTICITY = (0.6, 1.0)


@dataclass(frozen=True)
class Place:
    """Store the position of a contact in the plane of the adhesion indices, and its plasticity index.

    bodies: (theta, lambda) of the two bodies without a film. film: (theta, lambda) of the contact with an infinitely thick
    film; None without a film. plasticity_index: psi of the bodies without a film.
    """

    bodies: tuple[float, float]
    film: tuple[float, float] | None
    plasticity_index: float


def place_of(subject: Subject) -> Place:
    """Return the adhesion indices theta and lambda and the plasticity index of a contact.

    Raises InputError if the contact has no adhesion or has array parameters.
    """
    subject.require_single("one number, for one place")
    groups: Any = subject.indices().resolved()
    if groups.theta is None:
        raise InputError("work_of_adhesion", None, "above 0 J/m^2; without adhesion both indices are infinite")
    film = groups.film() if groups.has_film else None
    psi = 0.75 * math.pi / float(hardness_group(groups.theta, groups.lam))
    return Place(
        (float(groups.theta), float(groups.lam)), None if film is None else (float(film.theta), float(film.lam)), psi
    )  # fmt: skip


def plasticity_line(theta: np.ndarray, psi: float) -> np.ndarray:
    """Return the lambda (n,) at which the plasticity index has the value psi, for each theta (n,)."""
    return (0.75 * math.pi / psi / hardness_group(np.asarray(theta, dtype=float), 1.0)) ** 4
