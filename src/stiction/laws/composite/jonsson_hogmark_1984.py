r"""Hardness of a film on a substrate, averaged over their areas under the indenter: Joensson & Hogmark 1984.

*Assumes*: the hardnesses of film and substrate are weighted by their areas under a Vickers pyramid whose impression has the
diagonal $d$. *Source*: [jonsson_hogmark_1984], as restated by the documentation of the NIMS toolbox. $H$ is the hardness of
film and substrate together, $H_s$ the hardness of the substrate, $n_H$ the film's hardness divided by the substrate's, $t$ the
film thickness:

$$
\frac H{H_s}=1+(n_H-1)\left[\frac{2Ct}d-\left(\frac{Ct}d\right)^2\right],\qquad C=1,\ \text{or}\ \tfrac12\ \text{for}\ n_H>6.3
$$

with $Ct/d$ at most 1. *Reconstructed*: $d$ is taken as seven times the displacement of an asperity, like the ratio of diagonal
to depth of a Vickers impression; this is the project's choice.
"""

import numpy as np

from stiction.engine.compiled import formula
from stiction.records.registry import Composite, Validity
from stiction.records.sources import Source

_DIAGONAL = 7.0  # diagonal of a Vickers impression divided by its depth


@formula
def value(hardness_ratio, depth_over_thickness, constant, exponent):
    """Return the hardness of film and substrate together divided by the substrate's, 1 + (H_f/H_s - 1) A_f/A.

    A_f/A, the fraction of the area that the film covers, is 2 C t/d - C^2 (t/d)^2 while C t/d < 1, else 1. hardness_ratio:
    H_f/H_s. depth_over_thickness: displacement omega divided by film thickness t; the diagonal d is 7 omega. constant: C.
    `exponent` is not used.
    """
    rim = constant / max(_DIAGONAL * depth_over_thickness, constant)
    return 1.0 + (hardness_ratio - 1.0) * rim * (2.0 - rim)


def constants(n_E: np.ndarray, n_H: np.ndarray, n_Y: np.ndarray) -> np.ndarray:
    """Return the constant C (n,): 1/2 for n_H > 6.3, else 1.

    n_H: hardness of the film divided by the substrate's. n_E and n_Y (modulus, yield stress) are not used. C = 1/2
    describes a hard film that cracks over a very soft substrate. The experiments cover n_H from 1.8 to 2.3 and from 6.3 to
    12.9.
    """
    return np.where(n_H > 6.3, 0.5, 1.0)


def landmarks(constant: np.ndarray, exponent: np.ndarray) -> np.ndarray:
    """Return nine values of omega/t (n, 9) at which the integral over asperity heights is split.

    The substrate contributes only beyond the first value; the others only shorten the intervals. constant: C (n,) from
    `constants`. `exponent` is not used.
    """
    return constant[:, None] / _DIAGONAL * np.array([1.0, 2.0, 6.0, 24.0, 100.0, 500.0, 3e3, 2e4, 2e5])


RECORD = Composite(
    key="jonsson_hogmark_1984",
    title="Hardness of film and substrate together: weighted by their areas under the indenter",
    grade="C",
    property="hardness",
    value=value,
    constants=constants,
    landmarks=landmarks,
    sources=(Source("jonsson_hogmark_1984", "", "as restated by the documentation of the NIMS toolbox"),),
    verified="independent evaluation; limits of the film alone and of the substrate alone",
    needs=("n_H", "tau"),
    validity=(Validity("n_H", 1.8, 12.9, "the experiments had hardness ratios of 1.8 to 2.3 and 6.3 to 12.9 only"),),
    notes="Derived for the Vickers pyramid: the diagonal is taken as seven times the displacement of an asperity.",
)
