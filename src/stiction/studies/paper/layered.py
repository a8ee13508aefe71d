"""The 2015 paper with its film solved: its asperities on an elastic sphere's film, exactly, in place of its film law.

The film is `layered`. It goes with laws of the interface, and with those that know film and body as one: so the asperity is
held by peeling alone, by the energy of a contact on a film (`layered_peeling`), and the uncoated one by that of a half-space
(Savkoor & Briggs 1977). The paper's other limit, yield at the trailing edge, is left out of both: for an adhesive asperity on a
film it is not known.

How thick a film is beside its contacts is decided by t/sqrt(R sigma), which the paper does not print: with its tau = t/sigma
that is tau sqrt(sigma/R). SHARPNESS is that of 48 nm and 50 um, asperities of the example that this project begins with.
"""

import math
from typing import Any

import numpy as np

from stiction.contact.indices import Groups, stiffness_group
from stiction.solving.choice import Choice
from stiction.solving.problem import problem_of

LAYERED = "layered"
SHARPNESS = math.sqrt(48e-9 / 50e-6)
_SUM, _ASPERITY = "greenwood_williamson_1966", "roy_chowdhury_ghosh_1994"
_NU = 0.3


def choice(coated: bool) -> Choice:
    """Return the laws of the coated or of the uncoated surface."""
    return Choice(_SUM, _ASPERITY, "layered_peeling", LAYERED) if coated else Choice(_SUM, _ASPERITY, "savkoor_briggs_1977")


def film_groups(tau: Any) -> dict[str, Any]:
    """Return the two groups that depend on film thickness: tau, and film_aspect = tau SHARPNESS."""
    return {"tau": tau, "film_aspect": tau * SHARPNESS}


def totals(theta: float, lam: np.ndarray, h: np.ndarray, film: tuple[np.ndarray, ...] | None = None) -> tuple[np.ndarray, ...]:
    """Return load, contact area and friction force, normalised, (n, H) at separations h (H,).

    Contacts have lam (n,) and films n_E, n_H, tau (n,), or none.
    """
    n = len(lam)
    ones, K_beta = np.ones(n), stiffness_group(_NU)
    given = {"theta": theta * ones, "lam": lam, "nu": _NU * ones, "hardness_to_yield": 2.8 * ones, "K_beta": K_beta * ones}
    if film is not None:
        n_E, n_H, tau = film
        given |= {"n_E": n_E, "n_H": n_H, "n_g": ones, "film_nu": _NU * ones, "film_K_beta": K_beta * ones} | film_groups(tau)
    found = problem_of(Groups(**given).resolved(), choice(film is not None)).on_grid(h)
    return tuple(found[name] for name in ("load", "contact_area", "friction_force"))
