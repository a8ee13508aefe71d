r"""Scatter of friction by junctions of different, independent strength, as on contaminated surfaces.

*Assumes*: each junction has its own interface strength, drawn independently with mean $\tau_0$ and standard deviation
$c_\tau\tau_0$, whatever its size and load. All junctions slide at the same time. *Source*: none is needed: variances of
independent numbers add up. The force of a junction follows [bowden_tabor_1943].

$$
s_\mu=\frac{c_\tau\tau_0}P\sqrt{\sum_iA_i^2},\qquad
\frac{s_\mu}\mu=c_\tau\sqrt{\frac{\langle A^2\rangle}{n\langle A\rangle^2}}
$$

The sum is over the $n$ junctions that touch; the second formula holds if the force is $\tau_0A$ alone. The result is the
standard deviation between contacts under the same load that follows from the strength only. It leaves out that other
asperities touch in each contact, of which another validity warning tells. The mean of $\mu$ does not change. Theories without
single junctions do not support this law, nor do films, whose junctions belong to two bodies.

*Limit*: many junctions, or $c_\tau=0$: no scatter. *Check*: Hertz's asperities with exponential heights, $\langle
A^2\rangle=2\langle A\rangle^2$: $s_\mu/\mu=c_\tau\sqrt{2/n}$ at every load.

*Units*: $T$ over $KR^{1/2}\sigma^{3/2}$, $A$ over $\pi R\sigma$; [symbols](#1-units).
"""

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.laws.contamination.kind import Contamination
from stiction.laws.segment import NormalSegment, TangentialResistance
from stiction.records.sources import Source

# Far beyond any height in reach some laws' areas are so large that their squares are none.
_LARGEST = 1e150


@formula
def resistance(u, w, load, area, eta, shear_strength, strength_variation):
    """Return (variance of the friction force of one asperity, 0); the engine sums these like a tangential force.

    strength_variation: standard deviation of the junction strength over its mean.
    """
    deviation = min(strength_variation * shear_strength * eta * area, _LARGEST)
    return deviation * deviation, 0.0


def tangential_resistance(segment: NormalSegment, groups: Groups) -> TangentialResistance:
    """Return the variance of the friction force of one asperity, in the form of a resistance that the engine sums."""
    return TangentialResistance(resistance, (groups.eta, groups.shear_strength, groups.strength_variation))


RECORD = Contamination(
    key="independent_junctions",
    title="Spread of friction by junctions of different strength, each independent of the others",
    grade="B",
    sources=(Source("bowden_tabor_1943", "", "force of one junction; that variances add up needs no source"),),
    tangential_resistance=tangential_resistance,
    verified="closed form of exponential heights; draws of strengths; integrals at 20 digits",
    needs=("hardness_group", "shear_strength", "strength_variation", "roughness_parameter", "nominal_width", "sharpness"),
    notes="The standard deviation is of single contacts; over many of them the mean friction is that without contamination.",
)
