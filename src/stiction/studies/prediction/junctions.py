"""Compute changes of plastic contact spots: junctions grow under shear, and a soft film is squeezed out.

Growth: a plastic junction under the shear stress tau obeys p^2 + alpha tau^2 = H^2 (Tabor 1959), with its mean pressure p and
the hardness H. The pressure falls, and the area grows by 1/sqrt(1 - c^2), where c = tau_0/tau_b is the shear strength of the
interface over the shear strength of the body. A junction that stays elastic up to the pressure H sqrt(1 - c^2) does not grow.
Three assumptions are sampled with weights set by judgement: no growth; a bulk that shears at Y/sqrt(3) (yield stress Y, von
Mises); and a junction that hardens until its bulk shears at up to H/3 if the interface is as strong as the body (alpha = 9,
Tabor's experiments, the largest weight). As the body hardens, an interface that is given by its state hardens too. An interface
whose strength is stated as a number, below half of the body's strength, does not harden; such a junction grows less. If the
stated strength is between half of the body's strength and all of it, the degree of hardening is sampled. By the last two
assumptions growth may be unlimited as c approaches 1, so that c is limited to 0.999. On a film of thickness t the growth is
raised to the power 1/(1 + a/t) for a spot of radius a (judgement): a narrow spot is a junction of the bulk film; the body below
supports a wide spot. The shear strength of an interface state that was measured on films already includes growth.

Squeeze: a soft film of thickness t and hardness H_f between harder bodies bears a mean pressure up to H_f (1 + a/(7.3 t)) in a
spot of radius a, the pressure of a plastic layer that sticks to both faces (Hill 1950). The pressure is limited by the hardness
of the body, and by the pressure of elastic bodies that touch through the film, so that the area is at least the elastic area. A
uniform random number sets how much of this increase is applied.
"""

import numpy as np

# Prior weights: no growth, von Mises, Tabor's hardened junctions.
GROWTH = (0.03, 0.27, 0.70)
_MOST = 0.999  # largest ratio c of the shear strengths of interface and body
_TABOR = 9.0  # alpha


def grown(
    level: np.ndarray,
    pressure: np.ndarray,
    strength: np.ndarray,
    hardness: np.ndarray,
    shear_strength: np.ndarray,
    hardens: np.ndarray | float = 1.0,
) -> np.ndarray:
    """Return the factor (n, m), at least 1, by which the area of contact spots grows under shear, for n samples at m loads.

    Parameters
    ----------
    level : numpy.ndarray, shape (n,)
        Quantile level, 0 to 1, that selects one of three assumptions by their prior weights GROWTH: no growth, growth without
        hardening (von Mises), or Tabor's hardened junctions.
    pressure : numpy.ndarray, shape (n, m)
        Mean pressure of contact spots [Pa]. Below the hardness, the factor of a plastic spot is multiplied by
        pressure/hardness; the result is at least 1.
    strength, hardness, shear_strength : numpy.ndarray, shape (n, m or 1)
        Shear strength of the interface, and hardness and shear strength of the weaker body [Pa].
    hardens : numpy.ndarray, shape (n, m or 1), or float
        Mean of the sampled degrees, 0 to 1, to which the interface hardens with the body: 1 for a named state of the interface,
        0 for a stated strength of at most half the strength of the body.
    """
    ratio = np.minimum(strength / shear_strength, _MOST) ** 2
    most = np.maximum((hardness / shear_strength) ** 2 / _TABOR, 1.0)
    hardened = 1.0 + (most - 1.0) * ratio
    alone = 1.0 / np.sqrt(1.0 - ratio)
    which = np.searchsorted(np.cumsum(GROWTH)[:-1], level)
    share = _share_that_hardens(np.clip((level - sum(GROWTH[:2])) / GROWTH[2], 0.0, 1.0)[:, None], hardens)
    factors = np.stack([np.ones_like(alone), alone, np.sqrt(hardened**share / (1.0 - ratio / hardened ** (1.0 - share)))])
    factor = factors[which, np.arange(len(level))]
    return np.maximum(np.minimum(pressure / hardness, 1.0) * factor, 1.0)


def _share_that_hardens(level: np.ndarray, mean: np.ndarray | float) -> np.ndarray:
    """Return samples of the degree, 0 to 1, to which the interface hardens with the body, (n, m or 1).

    level: quantile levels (n, 1). mean: mean of the samples. The samples are level^((1 - mean)/mean), a judgement: they spread
    over 0 to 1, and are all equal if the mean is 0 or 1.
    """
    return np.maximum(level, 1e-12) ** ((1.0 - mean) / np.maximum(mean, 1e-9))


def squeezed(
    level: np.ndarray,
    pressure: np.ndarray,
    radius: np.ndarray,
    thickness: np.ndarray,
    hardness: np.ndarray,
    hardest: np.ndarray,
) -> np.ndarray:
    """Return the factor (n, m), at least 1, by which the pressure of spots on a thin soft film exceeds that on a thick film.

    Parameters
    ----------
    level : numpy.ndarray, shape (n,)
        Quantile level, 0 to 1: the exponent of the largest possible factor. 0 gives no increase, 1 the largest one.
    pressure, radius : numpy.ndarray, shape (n, m)
        Mean pressure [Pa] and radius [m] of contact spots, for n samples at m loads. Below the hardness, the exponent is
        multiplied by (pressure/hardness)^4.
    thickness, hardness, hardest : numpy.ndarray, shape (n, m or 1)
        Film thickness [m], hardness of the film, and largest pressure that film and bodies bear [Pa].
    """
    most = np.minimum(1.0 + radius / (7.3 * thickness), np.maximum(hardest / hardness, 1.0))
    plastic = np.clip(pressure / hardness, 0.0, 1.0) ** 4
    return most ** (level[:, None] * plastic)
