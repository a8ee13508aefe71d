r"""One adhesive asperity, elastic (JKR) until its mean pressure reaches the hardness, then plastic: Roy Chowdhury & Ghosh 1994.

*Assumes*: the contact follows [`jkr`](#jkr) until its mean pressure reaches the hardness. Then it is fully plastic: the area
is $2\pi R\omega$, twice the area of a Hertz contact at this displacement, and the load is the hardness times this area minus
the adhesion $2\pi\gamma R$. It is the asperity law of the 2015 paper, eqs. (1) to (4): [theory, section
2](theory.md#2-one-asperity-under-normal-load). *Source*: [roy_chowdhury_ghosh_1994], as [soft_coating_2015] states it. With
$S=\sqrt{6\pi/\theta}$ and the coordinate $u$ of JKR's contact, the plastic segment is

$$
P=2\eta w-\frac{2\pi}\theta,\qquad A=2w\qquad(u\ge u_1),\qquad u_1^3-\eta u_1-S=0
$$

*Jumps*: at this transition, where $w_1=u_1^4-\tfrac23Su_1$, the load is multiplied by 1.276 and the area by 1.399 at
$\theta=10$, $\lambda=1$; both are doubled without adhesion. Under strong adhesion the load falls at this transition; it
becomes tensile if $\lambda^{1/4}\theta^{-1/6}<0.184$. *Unknown*: the text of the 1994 paper; the law is taken from the 2015
paper.

*Symbols*: displacement $w=\omega/\sigma$, load $P$ in units of $KR^{1/2}\sigma^{3/2}$ and contact area $A$ in units of
$\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and $K=\tfrac43E^*$
($E^*$ contact modulus); $\theta=K\sigma^{3/2}/(\gamma R^{1/2})$ elastic adhesion index, $\gamma$ work of adhesion;
$\eta=\pi H\sqrt{R/\sigma}/K$ hardness group, $H$ hardness; $\lambda$ plastic adhesion index. Full list: [symbols](#1-units).
"""

import math

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula, lazy_kernel
from stiction.laws.asperity import jkr
from stiction.laws.segment import NormalSegment, displaced, edges_at
from stiction.laws.shared_claims import SHORT_RANGE
from stiction.records.registry import AsperityLaw, Jump, Limit
from stiction.records.sources import Source

_STEPS = 7  # Newton steps that are sufficient from a start at most 50 % above the root


@formula
def unit_root(a):
    """Return the largest real root v of v^3 + a v - 1 = 0, by Newton's method, started above the root.

    The number of steps is fixed, because the compiler vectorises only loops in which every element takes the same number of
    steps. It is sufficient for every a.
    """
    # For s^2 = -a > 0 the root is s + d with 2 s^2 d + 3 s d^2 + d^3 = 1. Both starting values are close upper bounds.
    s = math.sqrt(max(-a, 0.0))
    v = s + 0.5 / max(s * s, 0.5) if a < 0.0 else 1.0 / max(a, 1.0)
    for _ in range(_STEPS):
        v -= (v * (v * v + a) - 1.0) / (3.0 * v * v + a)
    return v


@formula
def largest_root(a, c):
    """Return the largest real root v of v^3 + a v - c = 0 for c > 0."""
    scale = c ** (1.0 / 3.0)
    return scale * unit_root(a / (scale * scale))


@lazy_kernel(worth=300)
def _fill_unit_roots(a, out):
    for i in range(out.size):
        out[i] = unit_root(a[i])


def unit_roots(a: np.ndarray) -> np.ndarray:
    """Return the largest real root v (n,) of v^3 + a v - 1 = 0 for each element of the array a (n,)."""
    out = np.empty_like(a)
    _fill_unit_roots(a, out)
    return out


def onset(groups: Groups) -> tuple[np.ndarray, np.ndarray]:
    """Return coordinate u (n,) and displacement w (n,) at which the mean pressure of a JKR contact reaches the hardness.

    The condition is u^3 - eta u - S = 0 (eqs 2 and 4 of soft_coating_2015), with u^4 = a^2/(R sigma), the
    contact radius a, the hardness group eta and S = sqrt(6 pi/theta) (theta: elastic adhesion index). w: in units of sigma.
    """
    S = np.sqrt(6.0 * math.pi / groups.theta)
    scale = S ** (1.0 / 3.0)
    u = scale * unit_roots(-groups.eta / (scale * scale))
    return u, u * (u * u * u - 2.0 / 3.0 * S)


@formula
def plastic(w, theta, eta):
    """Return displacement w, dw/du = 1, load and contact area of a fully plastic adhesive asperity; the coordinate u is w.

    The area is 2 w. The load is 2 eta w - 2 pi/theta: the hardness times the area, minus the adhesive force 2 pi gamma R
    (second integrand of eq 1 of soft_coating_2015). theta: elastic adhesion index. eta: hardness group. Units: w in sigma, load
    in K R^(1/2) sigma^(3/2), area in pi R sigma.
    """
    return w, 1.0, 2.0 * eta * w - 2.0 * math.pi / theta, 2.0 * w


def flow(groups: Groups, first: np.ndarray) -> NormalSegment:
    """Return the fully plastic NormalSegment that starts at the displacements `first` (n,), in units of sigma."""
    edges = edges_at(first, np.inf)
    return NormalSegment(plastic, displaced, (groups.theta, groups.eta), edges, "plastic")


def segments(groups: Groups, branch: str) -> list[NormalSegment]:
    u_1, w_1 = onset(groups)
    return [jkr.elastic(groups.theta, branch, u_1), flow(groups, w_1)]


RECORD = AsperityLaw(
    key="roy_chowdhury_ghosh_1994",
    title="JKR sphere until its mean pressure reaches the hardness, then fully plastic",
    grade="C",
    sources=(
        Source("soft_coating_2015", "eqs. (1)-(4)", "the form used; the text of the 1994 paper was not available"),
        Source("roy_chowdhury_ghosh_1994", "the asperity law, as the 2015 paper reports it"),
        Source("johnson_kendall_roberts_1971", "load and displacement"),
    ),
    segments=segments,
    traits=frozenset({"JKR", "2015", "Hertz's shape"}),
    jumps=(
        Jump(
            1,
            1.276,
            1.399,
            "where the mean pressure reaches the hardness, at theta = 10, lam = 1; both double without adhesion",
            {"theta": 10.0, "lam": 1.0},
        ),
    ),
    verified="loads, areas and their sums over heights, computed independently at 30 digits",
    needs=("theta", "lam"),
    validity=(SHORT_RANGE,),
    limits=(
        Limit("jkr", {"lam": 1e30}, ("load", "contact_area"), 1e-9),
        Limit("jkr", {"lam": 1e30}, ("load", "contact_area"), 1e-9, {"branch": "unloading"}),
    ),
    own_options={"branch": ("loading", "unloading")},
    load_is_monotonic=False,
    notes="The load of an asperity jumps where it becomes plastic; without adhesion it doubles. Under strong adhesion it falls "
    "there, and becomes tensile if lambda^(1/4) theta^(-1/6) is below 0.184.",
)
