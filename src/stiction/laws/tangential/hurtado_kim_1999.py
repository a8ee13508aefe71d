r"""A shear strength that decreases with contact size: Hurtado & Kim 1999, in the form of Adams, Muftu & Mohd Azhar 2003.

*Assumes*: a small contact slips as a whole, at a strength that does not depend on its size. A larger contact slips by a
dislocation that glides across it, at a strength that falls with its radius. A very large contact slips by many dislocations,
at a lower constant strength. *Sources*: [hurtado_kim_1999] for the mechanism, [adams_muftu_azhar_2003] for an approximation by
three straight lines; neither text was available. *Reconstructed*: the constants below are quoted from memory of secondary
literature. With the contact radius $a$, Burgers vector $b$ and shear modulus $G$

$$
\frac\tau G=\begin{cases}1/43&a\le28\,b\\\frac1{43}\left(\frac a{28\,b}\right)^{-M}&\text{between}\\
1/1290&a\ge8\cdot10^4\,b\end{cases},\qquad
M=\frac{\ln30}{\ln(8\cdot10^4/28)}=0.42742,\qquad T=\tau\,\pi a^2
$$

The lines meet by this choice of $M$. $G=2G_1G_2/(G_1+G_2)$ is taken as $(1-\nu)E^*$, which equals it for two bodies of the
same Poisson's ratio $\nu$, and for a rigid counterbody; $\nu$ is the softer body's. In the units here, with
$s=\sqrt{\sigma/R}$,

$$
T=\frac\tau G\,\frac{3\pi}{4s}(1-\nu)\,A,\qquad\frac ab=\frac{\sqrt{R\sigma}}b\sqrt A
$$

*Check*:

| $a/b$ | 10 | 28 | 100 | 1000 | 10000 | 80000 | $10^6$ |
|---|---|---|---|---|---|---|---|
| $1000\,\tau/G$ | 23.2558 | 23.2558 | 13.4970 | 5.04454 | 1.88541 | 0.775194 | 0.775194 |

The shear strength of the bodies, $Y/\sqrt3$, does not limit $\tau$. *Measured*: a smooth gold asperity of nanometre size slid
on mica at 264 MPa; a rough one of micrometre size slid at 40.5 MPa, where Hurtado and Kim's model gave 208 to 245 MPa
([li_kim_2008], abstract). *Limits*: a constant strength [`bowden_tabor_1943`](#bowden_tabor_1943) of $G/43$ for contacts below
$28\,b$ and $G/1290$ above $8\cdot10^4\,b$.

*Symbols*: displacement $w=\omega/\sigma$, load $P$ and tangential force $T$ in units of $KR^{1/2}\sigma^{3/2}$ and contact
area $A$ in units of $\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and
$K=\tfrac43E^*$ ($E^*$ contact modulus). Full list: [symbols](#1-units).
"""

import math

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.laws.joining import coordinates_at_area
from stiction.laws.segment import NormalSegment, TangentialResistance
from stiction.records.registry import TangentialLaw, Validity
from stiction.records.sources import Source

# Contact radius divided by Burgers vector: up to SMALL a contact slips as a whole, from LARGE many dislocations glide. Each
# limit has its own strength divided by the shear modulus.
SMALL, LARGE = 28.0, 8e4
STRONGEST, WEAKEST = 1.0 / 43.0, 1.0 / 1290.0
EXPONENT = math.log(STRONGEST / WEAKEST) / math.log(LARGE / SMALL)
# Number of parts into which a segment is split between SMALL and LARGE, where the force is a fractional power of the area.
_PIECES = 6


@formula
def strength_over_modulus(radius):
    """Return the shear strength of a contact divided by its shear modulus, tau/G.

    radius: contact radius divided by Burgers vector, a/b. tau/G is 1/43 up to a radius of 28, then falls as a power of the
    radius, and is 1/1290 above 80 000.
    """
    return STRONGEST * (min(max(radius, SMALL), LARGE) / SMALL) ** -EXPONENT


@formula
def resistance(u, w, load, area, unit, size_over_burgers):
    return unit * area * strength_over_modulus(size_over_burgers * math.sqrt(max(area, 0.0))), 0.0


def tangential_resistance(segment: NormalSegment, groups: Groups) -> TangentialResistance:
    """Return the tangential resistance on a segment, with kinks at seven contact radii from 28 to 80 000 Burgers vectors.

    segment: one smooth part of an asperity law. groups: dimensionless groups of n contacts. The kinks split the segment,
    because the force between the first and the last radius is a fractional power of the area, which is hard to integrate.
    """
    places = np.geomspace(SMALL, LARGE, _PIECES + 1)
    kinks = [coordinates_at_area(segment, (place / groups.size_over_burgers) ** 2) for place in places]
    unit = 0.75 * math.pi * (1.0 - groups.nu) / groups.sharpness
    return TangentialResistance(resistance, (unit, groups.size_over_burgers), np.stack(kinks, axis=1))


RECORD = TangentialLaw(
    key="hurtado_kim_1999",
    title="Shear strength that falls with the size of the contact",
    grade="C",
    sources=(
        Source("hurtado_kim_1999", "", "slip of small contacts as a whole, of larger ones by dislocations; text not available"),
        Source(
            "adams_muftu_azhar_2003",
            "abstract",
            "the mechanism in a sum over asperities; constants recalled from secondary literature, not read in the paper",
        ),
        Source("li_kim_2008", "abstract", "264 and 40.5 MPa measured; 208 to 245 MPa of the model"),
    ),
    tangential_resistance=tangential_resistance,
    yielded="interface",
    of_half_space="it describes slip between two half-spaces of one shear modulus",
    verified="evaluation in SI units at 30 digits; values at both sizes and between",
    needs=("nu", "sharpness", "size_over_burgers"),
    validity=(
        Validity(
            "size_over_burgers",
            1.0,
            np.inf,
            "contacts smaller than a Burgers vector cannot be treated as a continuum",
            "assumption",
        ),
    ),
    notes="The strength follows from the shear modulus and the contact's `burgers_vector`; `interfacial_shear_strength` is not "
    "used. It holds for clean contacts that are smooth below the asperity scale and is an upper bound for others: rough gold "
    "on mica slid at a fifth of it.",
)
