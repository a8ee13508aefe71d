"""Changes of a yielded spot of contact: junctions grow under shear, and a soft film is squeezed.

Growth: a plastic junction under the shear stress tau obeys p^2 + alpha tau^2 = H^2 (Tabor 1959), so that its pressure falls and
its area grows by 1/sqrt(1 - c^2), with c = tau_0/tau_b the strength of the interface over that of the body; a junction that is
elastic until p reaches H sqrt(1 - c^2) does not grow. Three assumptions are alternatives, with prior weights that are a
judgement (grade C): no growth, which a spot that flows contradicts; the bulk shears at Y/sqrt(3) (von Mises); the bulk of a
junction hardens, to H/3 where the interface is as strong as the body (alpha = 9, Tabor's experiments, which count most). What
ends growth where c goes to 1 is in none of them: c is bounded at 0.999.

Squeeze: a soft film between harder bodies bears up to H_f (1 + a/(7.3 t)) in a spot of radius a, that of a plastic layer that
sticks to both (Hill 1950), and at most the hardness of the body, or what elastic bodies bear that touch through the film, so
that its area is never less than theirs without it. How far this goes is drawn evenly between nothing and all.
"""

import numpy as np

__all__ = ["GROWTH", "grown", "squeezed"]

# Prior weights: no growth, von Mises, Tabor's hardened junctions.
GROWTH = (0.03, 0.27, 0.70)
_MOST = 0.999  # of the strength of the interface over that of the body
_TABOR = 9.0  # alpha


def grown(level: np.ndarray, pressure: np.ndarray, strength: np.ndarray, hardness: np.ndarray, shear_strength: np.ndarray):
    """Return the area of spots over that before shear, an array (n, m).

    Parameters
    ----------
    level : numpy.ndarray, shape (n,)
        Which assumption holds: its level among the prior weights GROWTH.
    pressure : numpy.ndarray, shape (n, m)
        Mean pressure of spots [Pa].
    strength, hardness, shear_strength : numpy.ndarray, shape (n, 1)
        tau_0, and of the weaker body hardness and shear strength [Pa].
    """
    share = np.minimum(strength / shear_strength, _MOST)
    hardened = (hardness / shear_strength) ** 2 / _TABOR
    alone = 1.0 / np.sqrt(1.0 - share**2)
    factors = np.stack([np.ones_like(alone), alone, alone * np.sqrt(1.0 + (np.maximum(hardened, 1.0) - 1.0) * share**2)])
    which = np.searchsorted(np.cumsum(GROWTH)[:-1], level)
    factor = factors[which, np.arange(len(level))]
    return np.maximum(np.minimum(pressure / hardness, 1.0) * factor, 1.0)


def squeezed(
    level: np.ndarray,
    pressure: np.ndarray,
    radius: np.ndarray,
    thickness: np.ndarray,
    hardness: np.ndarray,
    hardest: np.ndarray,
) -> np.ndarray:
    """Return the mean pressure of spots on a soft film over a thick one, (n, m).

    Parameters
    ----------
    level : numpy.ndarray, shape (n,)
        How far the film is squeezed, 0 to 1.
    pressure, radius : numpy.ndarray, shape (n, m)
        Mean pressure [Pa] and radius [m] of spots.
    thickness, hardness, hardest : numpy.ndarray, shape (n, m or 1)
        Film thickness [m], hardness of the film, and largest pressure that film and bodies bear [Pa].
    """
    most = np.minimum(1.0 + radius / (7.3 * thickness), np.maximum(hardest / hardness, 1.0))
    plastic = np.clip(pressure / hardness, 0.0, 1.0) ** 4
    return most ** (level[:, None] * plastic)
