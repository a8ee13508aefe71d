r"""Presliding of one elastic contact under a tangential force: Mindlin 1949 (and, before him, Cattaneo 1938).

*Assumes*: contacts are elastic and independent. With `presliding="mindlin_1949"` the result `tangential_stiffness` is the sum
of the tangential stiffnesses $k_t$ of all contacts before sliding. *Source*: [mindlin_1949], the stiffness of one contact at
zero tangential force,

$$
k_t=\frac{8a}\beta\ \text{(SI)},\qquad\frac{8\sqrt A}{K\beta}\ \text{in the units here}
$$

$a$ is the contact radius, $A$ the contact area, $\beta$ the tangential compliance of the pair of bodies and $K=\tfrac43E^*$
($E^*$ contact modulus). Here $A$ is in units of $\pi R\sigma$ and $k_t$ in units of $KR^{1/2}\sigma^{1/2}$, with the tip
radius $R$ and the standard deviation $\sigma$ of the heights. For equal bodies the ratio to the normal stiffness is
$k_t/k_n=2(1-\nu)/(2-\nu)$. In partial slip, a Hertz contact with the load $P$ and the friction coefficient $f$ at every point
carries the tangential force $T$ at the tangential displacement $\delta_t$; at $\delta_f$ the whole contact slides,

$$
T=fP\left[1-(1-s)^{3/2}\right],\qquad s=\frac{\delta_t}{\delta_f},\quad\delta_f=\frac{3fP\beta}{16a}
$$

Plastic contacts are treated as elastic; the bulk behind the asperities adds no compliance.

**Up to sliding** (`st.slide`): all asperities have the same tangential displacement $\delta$. Each carries the force of
partial slip, with the strength $T_m$ from its tangential law in place of $fP$. Their sum over the density $\varphi$ of
heights, at the separation $h$, is

$$
F=\int T_m\left[1-(1-s)^{3/2}\right]\varphi(h+w)\,dw,\qquad s=\frac\delta{\delta_f},\quad\delta_f=\frac{3T_m\beta}{16a};
\qquad r\,T_m\text{ where }s\ge1
$$

An asperity slides once $s$ reaches 1 and then retains the fraction $r$ of its strength. *Sources*: [bjorklund_1997] for the
sum (the text was not available) and [eriten_2011]. The residual strength $r$ ($r=1$ for Coulomb's law), and $T_m$ in place of
$fP$ for strengths that are not proportional to the load, are this project's own. With $r=1$, $F$ tends from below to the
static friction force, where all asperities have their full strength at once. With $r<1$ the asperities do not reach their peak
forces at the same displacement, and the largest force is lower. In a cycle between $\pm\delta$, unloading follows the same
curve at twice the scale ([masing_1926]). The energy loss of a cycle is

$$
\Delta W=8\int_0^\delta F\,d\delta'-4\,\delta F,\qquad
\frac{\Delta W}{T_m\delta_f}=4s-\tfrac{16}5+(1-s)^{3/2}\left(\tfrac{16}5+\tfrac45s\right)\ (s\le1)
$$

The second formula is for one asperity, in agreement with [mindlin_deresiewicz_1953]. *Check*, one asperity:

| $s$ | 0.1 | 0.5 | 0.9 | 1 |
|---|---|---|---|---|
| $F/T_m$ | 0.146185 | 0.646447 | 0.968377 | 1 |
| $\Delta W/(T_m\delta_f)$ | 0.0005131 | 0.0727922 | 0.5239613 | 0.8 |

For elastic asperities under Coulomb's law, $F(\delta)=f\,[P(h)-P(h+\delta/m)]$ with $m=\tfrac3{16}fK\beta$ ([jager_1998]), so
$F=fP\,(1-e^{-\delta/m})$ for exponential heights.

**Area that still sticks**: slip of an asperity begins at the rim of its contact and leaves the fraction $1-s$ of its area
sticking, so the sticking area per asperity is

$$
A_\mathrm{stick}=\int A\,\max(1-s,0)\,\varphi(h+w)\,dw
$$

Under Coulomb's law it equals the contact area at a separation larger by $\delta/m$, where the load is $P-F/f$. If the area is
proportional to the load, as it nearly is for many rough surfaces, $A_\mathrm{stick}/A=1-F/(fP)$ follows for any roughness.
This is the subject of [paggi_pohrt_popov_2014], whose formulas were not available; the formulas here follow from
[jager_1998]. Full list: [symbols](#1-units).
"""

import math

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.laws.presliding.kind import Presliding
from stiction.laws.segment import NormalSegment, TangentialResistance
from stiction.records.registry import Validity
from stiction.records.sources import Source


@formula
def stiffness(area, K_beta):
    """Return the tangential stiffness of a contact at zero tangential force, 8 sqrt(area)/(K beta), as a dimensionless number.

    area: contact area in units of pi R sigma. K_beta: K beta, with K = (4/3) E* and the tangential compliance beta = 1/G* of
    the pair of bodies. In SI the stiffness is k_t = 8 a/beta with the contact radius a; the result is k_t sigma/(K R^(1/2)
    sigma^(3/2)).
    """
    return 8.0 * math.sqrt(area) / K_beta


@formula
def sliding_displacement(load, area, friction, K_beta):
    """Return the tangential displacement at which a Hertz contact slips as a whole, 3 mu P beta/(16 a), in units of sigma.

    It is 3/2 times the friction force mu P divided by the initial stiffness. load: P in units of K R^(1/2) sigma^(3/2).
    area: contact area pi a^2 in units of pi R sigma. friction: friction coefficient mu. K_beta: K beta, with K = (4/3) E*
    and the tangential compliance beta of the pair of bodies.
    """
    return 1.5 * friction * load / stiffness(area, K_beta)


@formula
def force(displacement, load, area, friction, K_beta):
    """Return the tangential force T = mu P (1 - (1 - s)^(3/2)) of a Hertz contact at a tangential displacement.

    s: displacement divided by the displacement at which the whole contact slips, at most 1. By Coulomb's law at each point,
    slip spreads inwards from the rim. load: P. friction: friction coefficient mu. K_beta: K beta, with K = (4/3) E* and the
    tangential compliance beta of the pair of bodies. Units: displacement in sigma, P and T in K R^(1/2) sigma^(3/2), area
    in pi R sigma.
    """
    left = max(1.0 - displacement / sliding_displacement(load, area, friction, K_beta), 0.0)
    return friction * load * (1.0 - left * math.sqrt(left))


@formula
def displacement(force, load, area, friction, K_beta):
    """Return the tangential displacement of a Hertz contact under a tangential force T, 0 <= T <= mu P.

    It is the displacement at which the whole contact slips, times 1 - (1 - T/(mu P))^(2/3). force, load: T and P. friction:
    friction coefficient mu. K_beta: K beta, with K = (4/3) E* and the tangential compliance beta of the pair of bodies.
    Units: displacement in sigma, T and P in K R^(1/2) sigma^(3/2), area in pi R sigma.
    """
    left = max(1.0 - force / (friction * load), 0.0)
    return sliding_displacement(load, area, friction, K_beta) * (1.0 - left ** (2.0 / 3.0))


@formula
def slip_share(s):
    """Return the tangential force of a partly slipping contact as a fraction of its strength, 1 - (1 - s)^(3/2).

    s: tangential displacement divided by the displacement at which the whole contact slides, below 1. The result is
    accurate for small s.
    """
    return -math.expm1(1.5 * math.log1p(-s))


@formula
def loss_share(s):
    """Return the energy that a contact loses per cycle, divided by its strength times its sliding displacement.

    s: amplitude of the cycle divided by the sliding displacement, at which the whole contact slides. The loss is 8 times
    the integral of the force from 0 to s, minus 4 s times the force at s. For small s these terms cancel, and the Taylor
    series s^3/2 + s^4/8 + 9 s^5/160 + ... is used.
    """
    if s < 0.1:
        tail = 0.006982421875 + s * (0.0053558349609375 + s * (0.004215240478515625 + s * 0.0033884048461914062))
        tail = 0.03125 + s * (0.01953125 + s * (0.01318359375 + s * (0.0093994140625 + s * tail)))
        return s * s * s * (0.5 + s * (0.125 + s * (0.05625 + s * tail)))
    if s >= 1.0:
        return 4.0 * s - 3.2
    left = 1.0 - s
    return 4.0 * s - 3.2 + left * math.sqrt(left) * (3.2 + 0.8 * s)


@formula
def resistance(u, w, load, area, K_beta):
    """Return (stiffness, 0), with the tangential stiffness of one asperity at zero tangential force, as in `stiffness`.

    The second number is 0, because the engine always sums two numbers (see `TangentialResistance`). u, w, load: not used.
    area: contact area in units of pi R sigma. K_beta: K beta, with K = (4/3) E* and the tangential compliance beta of the pair
    of bodies.
    """
    return stiffness(area, K_beta), 0.0


def tangential_resistance(segment: NormalSegment, groups: Groups) -> TangentialResistance:
    """Return the tangential stiffness of the asperities on a segment, as a `TangentialResistance` that the engine can sum.

    segment: one smooth part of an asperity law. groups: dimensionless groups of n contacts.
    """
    return TangentialResistance(resistance, (groups.K_beta,), branch=np.array(segment.edges[:, 0]))


RECORD = Presliding(
    key="mindlin_1949",
    title="Tangential stiffness of elastic contacts before sliding",
    grade="B",
    sources=(Source("mindlin_1949", "", "the stiffness at zero tangential force, and the formulas of partial slip"),),
    tangential_resistance=tangential_resistance,
    verified="closed forms; ratio of tangential to normal stiffness, 2 (1 - nu)/(2 - nu) for equal bodies",
    needs=("K_beta",),
    validity=(Validity("plasticity_index", 0.0, 0.6, "plastic contacts are treated as elastic"),),
    notes="The stiffness is that of the asperities alone; the bulk of the bodies adds no compliance.",
)
