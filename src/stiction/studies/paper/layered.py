"""Repeat the 2015 paper with an exactly solved film: elastic spheres on a film replace the paper's film law.

The film law `layered` treats film and body as one solid, and is used together with laws derived for this solid. An asperity
sticks until the edge of its contact peels. The peeling energy is computed for a contact on a film if the asperity is coated
(`layered_peeling`), otherwise for a half-space (Savkoor & Briggs 1977). The paper's other limit, yield at the trailing edge, is
left out in both cases, because it is not known for an adhesive asperity on a film.

The ratio t/sqrt(R sigma) decides how thick a film is relative to its contacts. The paper does not print it; with its
tau = t/sigma it is tau sqrt(sigma/R). SHARPNESS is sqrt(sigma/R) for the asperities of examples/silver_on_steel.toml, with
sigma = 48 nm and R = 50 um.
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
    """Return the model and laws for the coated or the uncoated surface."""
    return Choice(_SUM, _ASPERITY, "layered_peeling", LAYERED) if coated else Choice(_SUM, _ASPERITY, "savkoor_briggs_1977")


def film_groups(tau: Any) -> dict[str, Any]:
    """Return the groups that depend on the film thickness t, by name: tau = t/sigma, and film_aspect = t/sqrt(R sigma)."""
    return {"tau": tau, "film_aspect": tau * SHARPNESS}


def totals(theta: float, lam: np.ndarray, h: np.ndarray, film: tuple[np.ndarray, ...] | None = None) -> tuple[np.ndarray, ...]:
    """Return dimensionless load, contact area and friction force of n contacts at H separations, (n, H) each.

    theta: adhesion index, the same for all contacts. lam (n,): plastic adhesion index. h (H,): separations over sigma. film:
    the film groups n_E, n_H and tau, each (n,); None without a film.
    """
    n = len(lam)
    ones, K_beta = np.ones(n), stiffness_group(_NU)
    given = {"theta": theta * ones, "lam": lam, "nu": _NU * ones, "hardness_to_yield": 2.8 * ones, "K_beta": K_beta * ones}
    if film is not None:
        n_E, n_H, tau = film
        given |= {"n_E": n_E, "n_H": n_H, "n_g": ones, "film_nu": _NU * ones, "film_K_beta": K_beta * ones} | film_groups(tau)
    found = problem_of(Groups(**given).resolved(), choice(film is not None)).on_grid(h)
    return tuple(found[name] for name in ("load", "contact_area", "friction_force"))
