r"""Scatter of friction due to junctions of different, independent strength, as on contaminated surfaces.

*Assumes*: the interface strength differs from junction to junction. It is a random number with the mean $\tau_0$ and the
standard deviation $c_\tau\tau_0$, independent of other junctions and of the junction's size and load. All junctions slide at
the same time. *Source*: the force of a junction is its strength times its area ([bowden_tabor_1943]); variances of independent
numbers add up.

$$
s_\mu=\frac{c_\tau\tau_0}P\sqrt{\sum_iA_i^2},\qquad
\frac{s_\mu}\mu=c_\tau\sqrt{\frac{\langle A^2\rangle}{n\langle A\rangle^2}}
$$

$s_\mu$ is the standard deviation of the friction coefficient $\mu$ between contacts under the same load $P$, due to the
scatter of strength alone. $A_i$ are the areas of the $n$ junctions in contact, and angle brackets denote their mean. The
second formula holds if the force is $\tau_0A$ alone. Different contacts also touch at different asperities. This scatter is
not included, and a validity warning states this. The mean of $\mu$ does not change. Theories without single junctions do not
support this law, nor do films, whose junctions belong to two bodies.

*Limit*: many junctions, or $c_\tau=0$: no scatter. *Check*: Hertz's asperities with exponential heights, for which $\langle
A^2\rangle=2\langle A\rangle^2$: $s_\mu/\mu=c_\tau\sqrt{2/n}$ at every load.

Symbols are defined in [units](#1-units).
"""

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.laws.contamination.kind import Contamination
from stiction.laws.segment import NormalSegment, TangentialResistance
from stiction.records.sources import Source

# Limit of the standard deviation: far beyond any real displacement, some laws' areas are so large that squares overflow.
_LARGEST = 1e150


@formula
def resistance(u, w, load, area, eta, shear_strength, strength_variation):
    """Return (variance of the friction force of one asperity, 0); the engine sums both numbers over all asperities.

    The variance is the square of strength_variation times interface strength times contact area. u, w, load: not used.
    area: contact area in units of pi R sigma. eta: hardness group; eta times the area is the load at which the mean
    pressure is the hardness. shear_strength: interface strength divided by the hardness. strength_variation: coefficient of
    variation of the interface strength.
    """
    deviation = min(strength_variation * shear_strength * eta * area, _LARGEST)
    return deviation * deviation, 0.0


def tangential_resistance(segment: NormalSegment, groups: Groups) -> TangentialResistance:
    """Return the variance of the friction force of one asperity, as a `TangentialResistance` that the engine can sum.

    segment: not used, because the formula is the same on every segment. groups: dimensionless groups of n contacts.
    """
    return TangentialResistance(resistance, (groups.eta, groups.shear_strength, groups.strength_variation))


RECORD = Contamination(
    key="independent_junctions",
    title="Scatter of friction by junctions of different, independent strength",
    grade="B",
    sources=(Source("bowden_tabor_1943", "", "force of one junction; variances of independent junctions add up"),),
    tangential_resistance=tangential_resistance,
    verified="closed form for exponential heights; simulation with random strengths; sums over heights at 20 digits",
    needs=("hardness_group", "shear_strength", "strength_variation", "roughness_parameter", "nominal_width", "sharpness"),
    notes="The result is the standard deviation between contacts. Their mean friction is that without contamination.",
)
