r"""One adhesive asperity, elastic (JKR) until its central pressure reaches a limit: Thornton & Ning 1998.

*Assumes*: the contact follows [`jkr`](#jkr) until the pressure in its centre reaches the limiting pressure $p_y$. The area
under this pressure then spreads from the centre. Contact radius and displacement stay related as in JKR. *Source*:
[thornton_ning_1998]: the stiffness after yield and the unloading law, both taken from published implementations. The load is
the integral of the stiffness. With $\eta_y=\eta\,p_y/H$, $S=\sqrt{6\pi/\theta}$, the coordinate $u$ of JKR's contact and its
value $u_y$ at yield,

$$
3u_y^3-2\eta_yu_y-S=0,\qquad P=u_y^6-S\,u_y^2\,u+\eta_y\,(u^4-u_y^4)\quad(u\ge u_y),\qquad w,\ A\ \text{as JKR}
$$

$$
p_y=\frac{2E^*a_y}{\pi R}-\sqrt{\frac{2\gamma E^*}{\pi a_y}},\qquad
\frac{dP}{d\omega}=\frac{3\pi Rp_y\sqrt{P_1}-2E^*a_y\sqrt{P_c}}{3\sqrt{P_1}-\sqrt{P_c}},\quad P_1=\frac{Ka^3}R
$$

The second line is in SI, with the contact radius $a$ and its value $a_y$ at yield. The load is the sum of the yielded centre
and the elastic ring around it. JKR's pressure at the radius $r$ is $p_0q-p_1/q$ with $q=\sqrt{1-r^2/a^2}$, $p_0=2E^*a/(\pi R)$
and $p_1=\sqrt{2\gamma E^*/(\pi a)}$; it is largest in the centre. After yield the pressure is $p_y$ for $r^2<a^2-a_y^2$ and
JKR's pressure outside. This is not the same as JKR's pressure limited to $p_y$, which falls below $p_y$ closer to the centre
and gives a slightly smaller $P$; without adhesion both agree. Load and stiffness are continuous at $u_y$. If $p_y$ is below
JKR's central pressure at zero displacement, $(2E^{*2}\gamma/(\pi^2R))^{1/3}$, the asperity yields at first touch, and the same
formulas hold afterwards.

The source does not state how to choose $p_y$. With `limiting_pressure="first_yield"`, the default, it is $H/k$ times the exact
$p_0/Y$ of the table under [`hertz`](#hertz); with `"hardness"` it is $H$. *Check*: at $\theta=40$, $\lambda=10$, $\nu=0.3$,
$k=2.8$ it yields at $w=0.0776$ under the tension $P=-0.0741$ with the first choice, and at $w=0.4116$, $P=0.1769$ with the
second.

Unloading from the largest load, $P_m$ at $u_m$, follows JKR with the larger radius $R_p$, shifted by the residual
displacement $w_\text{res}$:

$$
\frac{R_p}R=\frac{P_1}{P_m+2\sqrt{P_cP_1}}=\frac{u_m^6}{P_m+Su_m^3},\qquad w_\text{res}=u_m^4\left(1-\frac R{R_p}\right),\qquad
P_\text{pull-off}=\tfrac32\pi\gamma R_p
$$

These equations are used when a whole surface is [unloaded](#unloading). The sum over heights then runs over $u_m$ of the
asperities. *Limit*: `jkr` for $\lambda\to\infty$ (no yield). *Trap*: the contact area equals JKR's at the same displacement;
it does not grow by plastic flow.

*Symbols*: displacement $w=\omega/\sigma$, load $P$ in units of $KR^{1/2}\sigma^{3/2}$ and contact area $A$ in units of
$\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and $K=\tfrac43E^*$
($E^*$ contact modulus); $\theta=K\sigma^{3/2}/(\gamma R^{1/2})$ elastic adhesion index, $\gamma$ work of adhesion;
$\eta=\pi H\sqrt{R/\sigma}/K$ hardness group, $H$ hardness; $\lambda$ plastic adhesion index; $\nu$ Poisson's ratio; $k=H/Y$
hardness divided by yield stress; $P_c=\tfrac32\pi\gamma R$ pull-off force. Full list: [symbols](#1-units).
"""

import math

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.bisection import halving
from stiction.engine.compiled import formula, lazy_kernel
from stiction.laws.asperity import hertz, jkr, roy_chowdhury_ghosh_1994
from stiction.laws.joining import coordinates, within
from stiction.laws.segment import NormalSegment, edges_at
from stiction.laws.shared_claims import NEAR_YIELD, SHORT_RANGE
from stiction.records.registry import AsperityLaw, Limit
from stiction.records.sources import Source

_adhesion, _displacement, _stretch, _load = jkr.adhesion, jkr.displacement, jkr.stretch, jkr.load
_coordinate, _largest_root = jkr.coordinate, roy_chowdhury_ghosh_1994.largest_root


@formula
def onset(eta_y, S):
    """Return the coordinate u_y of a JKR contact at which the pressure in its centre reaches the limit p_y (yield).

    It is the largest root of 3 u^3 - 2 eta_y u - S = 0, with u^4 = a^2/(R sigma) and the contact radius a. eta_y: pi p_y
    sqrt(R/sigma)/K. S: strength of adhesion, sqrt(6 pi/theta), with the elastic adhesion index theta.
    """
    return _largest_root(-2.0 / 3.0 * eta_y, S / 3.0)


@formula
def yielded_load(u, S, eta_y, u_y):
    """Return the load of a yielded asperity at the coordinate u >= u_y, in units of K R^(1/2) sigma^(3/2).

    The centre of the contact carries the limiting pressure p_y, a ring around it JKR's pressure. u^4 = a^2/(R sigma), with the
    contact radius a. u_y: u at yield. S: strength of adhesion, sqrt(6 pi/theta), with the elastic adhesion index theta. eta_y:
    pi p_y sqrt(R/sigma)/K.
    """
    square = u_y * u_y
    return square * square * square - S * square * u + eta_y * (u * u * u * u - square * square)


@formula
def loading(u, S, eta_y, u_y):
    """Return the load at the coordinate u during loading, before or after yield, in units of K R^(1/2) sigma^(3/2).

    u^4 = a^2/(R sigma), with the contact radius a. u_y: u at yield. S, eta_y: as in `yielded_load`.
    """
    return yielded_load(u, S, eta_y, u_y) if u > u_y else _load(u, S)


@formula
def normal(u, theta, eta_y, u_y):
    """Return displacement w, dw/du, load and contact area of the yielded asperity at the coordinate u, during loading.

    u^4 = a^2/(R sigma), with the contact radius a. Displacement and contact radius are related as in a JKR contact. theta:
    elastic adhesion index. eta_y: pi p_y sqrt(R/sigma)/K, with the limiting pressure p_y. u_y: u at yield. Units: w in sigma,
    load in K R^(1/2) sigma^(3/2), area in pi R sigma.
    """
    S = _adhesion(theta)
    return _displacement(u, S), _stretch(u, S), yielded_load(u, S, eta_y, u_y), u * u * u * u


@formula
def coordinate(w, theta, eta_y, u_y):
    return _coordinate(w, _adhesion(theta))


@formula
def unloading_radius(u_max, P_max, S):
    """Return the effective radius R_p of a yielded asperity during unloading, divided by its tip radius R; it is 1 or more.

    R_p/R is P1/(P_max + 2 sqrt(Pc P1)) with P1 = u_max^6 and Pc = S^2/4. With this radius JKR's load at the turning point,
    where loading ended, equals the largest load P_max. u_max: coordinate at the turning point, u^4 = a^2/(R sigma) with the
    contact radius a. S: strength of adhesion, as in `yielded_load`.
    """
    u3 = u_max * u_max * u_max
    return u3 * u3 / (P_max + S * u3)


@formula
def residual(u_max, radius):
    """Return the residual displacement of a yielded asperity in units of sigma, which is the shift of its unloading curve.

    The shift makes the unloading curve start at the displacement at which loading ended. u_max: coordinate at the turning
    point, u^4 = a^2/(R sigma) with the contact radius a. radius: R_p/R, from `unloading_radius`.
    """
    return u_max * u_max * u_max * u_max * (1.0 - 1.0 / radius)


@formula
def unloading(u, u_max, P_max, S):
    """Return displacement w, dw/du, load and contact area of a yielded asperity during unloading, at the coordinate u.

    u^4 = a^2/(R sigma), with the contact radius a. u_max, P_max: coordinate and load at the turning point, where loading ended.
    S: as in `yielded_load`. Units: w in sigma, load in K R^(1/2) sigma^(3/2), area in pi R sigma.
    """
    radius = unloading_radius(u_max, P_max, S)
    u3 = u * u * u
    w = residual(u_max, radius) + u * (u3 / radius - 2.0 / 3.0 * S)
    return w, 4.0 * u3 / radius - 2.0 / 3.0 * S, u3 * (u3 / radius - S), u3 * u


@formula
def unloading_coordinate(w, u_max, P_max, S):
    """Return the coordinate u of a yielded asperity during unloading at the displacement w, in units of sigma.

    u^4 = a^2/(R sigma), with the contact radius a. If w is below the displacement at which contact is lost, the coordinate at
    the loss of contact is returned. u_max, P_max: coordinate and load at the turning point, where loading ended. S: as in
    `yielded_load`.
    """
    radius = unloading_radius(u_max, P_max, S)
    scale = math.sqrt(math.sqrt(radius))  # JKR's polynomial in u/scale
    return scale * _coordinate(w - residual(u_max, radius), scale * S)


@formula
def pull_off(u_max, P_max, S):
    """Return the pull-off force of a yielded asperity during unloading, (3/2) pi gamma R_p, in units of K R^(1/2) sigma^(3/2).

    R_p is the effective radius during unloading, gamma the work of adhesion. u_max, P_max: coordinate and load at the turning
    point, where loading ended. S: as in `yielded_load`.
    """
    return 0.25 * S * S * unloading_radius(u_max, P_max, S)


@formula
def lost_displacement(u_max, P_max, S):
    """Return the displacement at which a yielded asperity loses contact during unloading, in units of sigma.

    It is the displacement at which its derivative with respect to the coordinate u is 0: u^3 = (S/6) R_p/R. u_max, P_max:
    coordinate and load at the turning point, where loading ended. S: as in `yielded_load`.
    """
    radius = unloading_radius(u_max, P_max, S)
    u = (S * radius / 6.0) ** (1.0 / 3.0)
    return residual(u_max, radius) - 0.5 * S * u


@formula
def recovery(U, S, eta_y, u_y):
    """Return the increase of the separation after which an asperity that was loaded to U loses contact, in units of sigma.

    U: coordinate at the end of loading, U^4 = a^2/(R sigma) with the contact radius a; U is at least its value u_y at yield.
    The increase grows with U. S, eta_y: as in `yielded_load`.
    """
    return _displacement(U, S) - lost_displacement(U, yielded_load(U, S, eta_y, u_y), S)


@formula
def released_normal(v, theta, eta_y, u_y, distance, origin):
    """Return displacement w, dw/dv, load and contact area of a yielded asperity after the separation has increased.

    v: coordinate; the asperity was loaded to U = origin + v^2, with U^4 = a^2/(R sigma) and the contact radius a at the end of
    loading. origin: U below which contact is lost, or a U slightly below the first yielded asperity if all keep contact. Just
    above a loss of contact, the contact radius grows like sqrt(U - origin), which is smooth in v. distance: increase of the
    separation in units of sigma. theta: elastic adhesion index. eta_y: pi p_y sqrt(R/sigma)/K, with the limiting pressure p_y.
    u_y: U at yield.
    """
    S = _adhesion(theta)
    U = origin + v * v
    w = _displacement(U, S) - distance
    P_max = yielded_load(U, S, eta_y, u_y)
    _, _, load, area = unloading(unloading_coordinate(w, U, P_max, S), U, P_max, S)
    return w, 2.0 * v * _stretch(U, S), load, area


@formula
def released_coordinate(w, theta, eta_y, u_y, distance, origin):
    return math.sqrt(max(_coordinate(w + distance, _adhesion(theta)) - origin, 0.0))


@formula
def _is_lost(U, arguments):
    S, eta_y, u_y, distance = arguments
    return recovery(U, S, eta_y, u_y) < distance


_halve = halving(_is_lost)


@lazy_kernel(worth=300)
def _fill_origin(theta, eta_y, u_y, first, distance, out):
    """Fill `out` (n,) with the coordinate U above which yielded asperities keep contact after the separation has increased.

    U: coordinate at the end of loading, U^4 = a^2/(R sigma). theta, eta_y, u_y (n,): as in `normal`. first (n,): U of the first
    yielded asperity. distance (n,): increase of the separation in units of sigma. If all yielded asperities keep contact, the
    result lies between 0.9 `first` and `first`, so that sqrt(U - out) is smooth.
    """
    for i in range(out.size):
        arguments = _adhesion(theta[i]), eta_y[i], u_y[i], distance[i]
        low = high = first[i]
        if _is_lost(low, arguments):
            while _is_lost(high, arguments):
                high *= 2.0
        else:
            low *= 0.9
        out[i] = _halve(low, high, arguments)


def _displacements(u: np.ndarray, theta: np.ndarray) -> np.ndarray:
    """Return the displacements (n,) of JKR contacts at the coordinates u (n,), in units of sigma.

    They are u^4 - (2/3) sqrt(6 pi/theta) u. theta (n,): elastic adhesion index.
    """
    return u * (u * u * u - 2.0 / 3.0 * np.sqrt(6.0 * math.pi / theta))


@lazy_kernel(worth=300)
def _fill_onset(theta, eta_y, out):
    for i in range(theta.size):
        out[i] = onset(eta_y[i], _adhesion(theta[i]))


def _first_yield(groups: Groups) -> np.ndarray:
    """Return the largest pressure of a Hertz contact at first yield (von Mises), divided by the hardness (n,).

    It is the limiting pressure with `limiting_pressure` = "first_yield".
    """
    each, which = np.unique(groups.nu, return_inverse=True)
    return np.array([hertz.first_yield(nu)[0] for nu in each])[which] / groups.hardness_to_yield


def _hardness(groups: Groups) -> np.ndarray:
    return np.ones(len(groups))


# Functions that return the limiting pressure over the hardness. The source does not say how to choose this pressure.
_LIMITS = {"first_yield": _first_yield, "hardness": _hardness}


def segments(groups: Groups, limiting_pressure: str) -> list[NormalSegment]:
    eta_y = groups.eta * _LIMITS[limiting_pressure](groups)
    u_y = np.empty(len(groups))
    _fill_onset(groups.theta, eta_y, u_y)
    elastic = jkr.elastic(groups.theta, "loading", u_y)
    edges = edges_at(elastic.edges[:, 1], np.inf)
    return [elastic, NormalSegment(normal, coordinate, (groups.theta, eta_y, u_y), edges, "elastic-plastic")]


def released(groups: Groups, distance: np.ndarray, limiting_pressure: str) -> list[NormalSegment]:
    """Return the segments of an asperity after loading and an increase of the separation by `distance`.

    distance (n,): in units of sigma. The first segment describes the asperities that did not yield; they follow JKR's
    unloading branch if they touched before the increase. The second describes the yielded asperities. limiting_pressure:
    "first_yield" or "hardness", the pressure at yield.
    """
    elastic, yielded = segments(groups, limiting_pressure)
    first, last = elastic.edges.T
    unyielded = jkr.elastic(groups.theta, "unloading", np.full(len(groups), np.inf))
    low = coordinates(unyielded, -distance)
    high = coordinates(unyielded, _displacements(last, groups.theta) - distance)
    high[~(last > first)] = 0.0
    origin = np.empty(len(groups))
    parameters = *yielded.parameters, np.ascontiguousarray(distance, dtype=float)
    _fill_origin(*yielded.parameters, yielded.edges[:, 0].copy(), parameters[-1], origin)
    edges = np.sqrt(np.maximum(yielded.edges - origin[:, None], 0.0))
    lowest = -float(np.max(distance, initial=0.0))
    in_contact = NormalSegment(released_normal, released_coordinate, (*parameters, origin), edges, yielded.state, lowest)
    return [within(unyielded, low, high), in_contact]


RECORD = AsperityLaw(
    key="thornton_ning_1998",
    title="JKR sphere whose pressure is limited",
    grade="B",
    sources=(
        Source("thornton_ning_1998", "", "stiffness after yield, integrated here, and unloading, both from implementations"),
        Source("johnson_kendall_roberts_1971", "load and displacement up to yield"),
    ),
    segments=segments,
    released=released,
    traits=frozenset({"JKR", "Hertz's shape"}),
    verified="load by independent integration at 30 digits of the source's stiffness and of the pressure over the contact",
    needs=("theta", "lam", "nu", "hardness_to_yield"),
    validity=(
        SHORT_RANGE,
        NEAR_YIELD,
    ),
    limits=(Limit("jkr", {"lam": 1e30}, ("load", "contact_area"), 1e-9),),
    own_options={"limiting_pressure": tuple(_LIMITS)},
    load_is_monotonic=False,
    notes="The source takes the limiting pressure as given. Here it is the largest pressure of a Hertz contact at first "
    "yield, 1.61 times the yield stress at nu = 0.3 (first_yield, the default), or the hardness. The contact area is that of "
    "JKR at the same displacement and does not grow by plastic flow. Under strong adhesion an asperity yields at first touch, "
    "and its load first falls with approach.",
)
