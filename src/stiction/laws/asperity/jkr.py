r"""One elastic asperity with adhesion that acts inside the contact: Johnson, Kendall & Roberts 1971.

*Assumes*: elastic bodies; adhesion acts only inside the contact and is described by an energy balance at its edge. *Source*:
[johnson_kendall_roberts_1971]. $S=\sqrt{6\pi/\theta}$ is the strength of adhesion (4.34 $\theta^{-1/2}$ in eqs. (1) and (2) of
the 2015 paper, [soft_coating_2015]). The coordinate is $u=x^{1/4}$ with $x=a^2/(R\sigma)$, $a$ the contact radius; $x$ is the
apparent displacement, at which a contact without adhesion would have this radius:

$$
w=u^4-\tfrac23S\,u,\qquad P=u^3(u^3-S),\qquad A=u^4
$$

In SI $P=Ka^3/R-\sqrt{6\pi\gamma Ka^3}$, $\omega=a^2/R-\sqrt{8\pi\gamma a/(3K)}$. During loading, contact begins at $w=0$, under
the tension $\tfrac89P_c$. With `branch="unloading"` it continues below $w=0$ down to the point where $dw/du=0$.

Characteristic states in Maugis's units: $\pi\gamma R$ for the load, $(\pi\gamma R^2/K)^{1/3}$ for the contact radius $a$,
$(\pi^2\gamma^2R/K^2)^{1/3}$ for the displacement:

| state | $a$ | displacement | load |
|---|---|---|---|
| no load | $6^{1/3}=1.817121$ | 1.100642 | 0 |
| zero displacement: first touch | $(8/3)^{1/3}=1.386723$ | 0 | −4/3 |
| largest tension: pull-off at given load | $(3/2)^{1/3}=1.144714$ | −0.436790 | −3/2 |
| most stretched: pull-off at given displacement | $6^{-1/3}=0.550321$ | −0.908560 | −5/6 |

*Valid* for Tabor parameters above about 5, without yield. *Limit*: `hertz` for $\theta\to\infty$. *Trap*: some codes write
$6\pi\gamma R$, where $\gamma$ is the surface energy of one surface, half the work of adhesion.

*Symbols*: displacement $w=\omega/\sigma$, load $P$ in units of $KR^{1/2}\sigma^{3/2}$ and contact area $A$ in units of
$\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and $K=\tfrac43E^*$
($E^*$ contact modulus); $\theta=K\sigma^{3/2}/(\gamma R^{1/2})$ elastic adhesion index, $\gamma$ work of adhesion;
$P_c=\tfrac32\pi\gamma R$ pull-off force. Full list: [symbols](#1-units).
"""

import math

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.laws.segment import NormalSegment, edges_at
from stiction.laws.shared_claims import ELASTIC, SHORT_RANGE
from stiction.records.registry import AsperityLaw, Limit
from stiction.records.sources import Source


@formula
def adhesion(theta):
    """Return S = sqrt(6 pi / theta), the strength of adhesion in JKR's formulas; theta: elastic adhesion index.

    It is the 4.34 / theta^(1/2) of eqs (1) and (2) of soft_coating_2015.
    """
    return math.sqrt(6.0 * math.pi / theta)


@formula
def displacement(u, S):
    """Return the displacement w = u^4 - (2/3) S u of a JKR contact at the coordinate u, in units of sigma.

    u^4 = a^2/(R sigma), with the contact radius a. S: strength of adhesion, from `adhesion`. Source: eq (4) of
    soft_coating_2015, with x = u^4.
    """
    return u * (u * u * u - 2.0 / 3.0 * S)


@formula
def stretch(u, S):
    """Return dw/du = 4 u^3 - (2/3) S, the derivative of a JKR contact's displacement w with respect to its coordinate u.

    u^4 = a^2/(R sigma), with the contact radius a. S: strength of adhesion, from `adhesion`.
    """
    return 4.0 * u * u * u - 2.0 / 3.0 * S


@formula
def load(u, S):
    """Return the load P = u^6 - S u^3 of a JKR contact at the coordinate u, in units of K R^(1/2) sigma^(3/2).

    u^4 = a^2/(R sigma), with the contact radius a. S: strength of adhesion, from `adhesion`. Source: integrand of eq (1) of
    soft_coating_2015, with x = u^4.
    """
    u3 = u * u * u
    return u3 * (u3 - S)


@formula
def area(u):
    """Return the contact area u^4 of a JKR contact in units of pi R sigma; u^4 = a^2/(R sigma), with the contact radius a."""
    return u * u * u * u


@formula
def coordinate(w, S):
    """Return the coordinate u of a JKR contact at the displacement w, on the stable branch, where w grows with u.

    u^4 = a^2/(R sigma), with the contact radius a. w: in units of sigma. S: strength of adhesion, from `adhesion`. If w is
    below the smallest displacement of the branch, the coordinate of that displacement is returned. Newton's method, started
    above the root of the convex polynomial, solves w = u^4 - (2/3) S u.
    """
    if w == math.inf:
        return math.inf
    s = 2.0 / 3.0 * S
    if w <= -0.75 * s * (0.25 * s) ** (1.0 / 3.0):  # at or below the displacement at which dw/du vanishes
        return (0.25 * s) ** (1.0 / 3.0)
    u = max((2.0 * max(w, 0.0)) ** 0.25, (2.0 * s) ** (1.0 / 3.0))
    for _ in range(60):
        u3 = u * u * u
        step = (u * (u3 - s) - w) / (4.0 * u3 - s)
        u -= step
        if step <= 1e-12 * u:
            break
    return u


@formula
def normal(u, theta):
    """Return displacement w, dw/du, load and contact area of a JKR contact at the coordinate u = (a^2/(R sigma))^(1/4).

    a: contact radius. theta: elastic adhesion index. Units: w in sigma, load in K R^(1/2) sigma^(3/2), area in pi R sigma.
    """
    S = adhesion(theta)
    return displacement(u, S), stretch(u, S), load(u, S), area(u)


@formula
def normal_coordinate(w, theta):
    return coordinate(w, adhesion(theta))


def first_contact(theta: np.ndarray, branch: str) -> np.ndarray:
    """Return the coordinate u (n,) at which a JKR contact begins during loading, or ends during unloading.

    u^4 = a^2/(R sigma), with the contact radius a. theta (n,): elastic adhesion index. branch: "loading" or "unloading". With
    s = (2/3) sqrt(6 pi/theta), loading begins where the displacement is zero (u^3 = s), and unloading ends where its derivative
    with respect to u is zero (4 u^3 = s).
    """
    s = 2.0 / 3.0 * np.sqrt(6.0 * math.pi / theta)
    return np.cbrt(s if branch == "loading" else s / 4.0)


def elastic(theta: np.ndarray, branch: str, last: np.ndarray) -> NormalSegment:
    """Return the JKR law as a NormalSegment, from the coordinates of `first_contact` to the coordinates `last` (n,).

    theta (n,): elastic adhesion index. branch: "loading" or "unloading". The segment is empty where `last` is below its first
    coordinate. Asperity laws with yield use the segment for their elastic part.
    """
    first = first_contact(theta, branch)
    lowest = 0.0 if branch == "loading" else float(np.min(-3.0 * first**4, initial=0.0))  # w = u (u^3 - s), s = 4 u^3
    edges = edges_at(first, np.maximum(last, first))
    return NormalSegment(normal, normal_coordinate, (theta,), edges, "elastic", lowest)


def segments(groups: Groups, branch: str) -> list[NormalSegment]:
    return [elastic(groups.theta, branch, np.full(len(groups), np.inf))]


RECORD = AsperityLaw(
    key="jkr",
    title="Elastic sphere, adhesion inside the contact",
    grade="A",
    sources=(Source("johnson_kendall_roberts_1971", "load and displacement of one contact"),),
    segments=segments,
    traits=frozenset({"JKR", "Hertz's shape"}),
    verified="characteristic states of the source in closed form; loads, areas and sums over heights at 30 digits; equal to "
    "Hertz without adhesion",
    needs=("theta",),
    validity=(
        SHORT_RANGE,
        ELASTIC,
    ),
    limits=(Limit("hertz", {"theta": 1e14}, ("load", "contact_area"), 1e-4),),
    load_is_monotonic=False,
    own_options={"branch": ("loading", "unloading")},
)
