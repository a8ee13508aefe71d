r"""A plastic film squeezed out between a rigid ball and a hard substrate: after Kato, Yamaguchi, Marui & Tachi 1981, 1982.

*Assumes* (abstracts of [kato_1981] and [kato_1982]): a soft metal film flows plastically out of the gap between a hard
protuberance and the hard surface below it. By the theory of plasticity, the pressure of this flow becomes extremely high, and
friction therefore falls with load. *Source*: [kato_1982], its abstract; the layer between rough plates is due to
[prandtl_1923]. *Reconstruction*: a rigid ball of radius $R$ is pressed by $\omega$ into a film of thickness $t$ on a rigid
substrate. The film sticks to both with the shear stress $k_f=Y_f/\sqrt3$, $Y_f=H_f/k$, and the pressure at the edge is the
film's hardness $H_f$. If radial and hoop stress are equal, the equilibrium of a ring at the radius $r$, in the gap $s(r)$
under the pressure $p(r)$, gives

$$
s=t-\omega+\frac{r^2}{2R},\qquad\frac{dp}{dr}=-\frac{2k_f}s,\qquad p(a)=H_f,\qquad a^2=2R\omega
$$

With a rigid substrate $p$ would grow without bound as the film is pressed through. The pressure is therefore limited to the
substrate's hardness $H$: $p=H$ for $r\le c$, where the substrate yields. With $b^2=2R(t-\omega)$ and $m=(H-H_f)/(4k_fR)$,

$$
\arctan\frac cb=\max\left(0,\ \arctan\frac ab-mb\right)
$$

$$
P=\pi a^2H_f+4\pi k_fR\begin{cases}a-b\arctan(a/b)&c=0\\a-c-mb^2&c>0\end{cases}
$$

and for $\omega>t$, where $b^2=-g^2$: $c=g\coth[\operatorname{arsinh}(g/\sqrt{2Rt})+mg]$. The tangential force comes from a law
of the interface, with the shear strength $\tau_0$ on the whole area $2\pi R\omega$. Values of $\tau_0$ above $k_f$ have no
meaning, because the film shears first. For $\tau_0$ below $k_f$ the film would slip, and its pressure in the centre would rise
less than computed here, down to half. A film harder than its substrate ($n_H>1$) is treated as equally hard, so the pressure
is $H$ everywhere.

*Limit*: in a thick film the pressure is the film's hardness, $\mu=\tau_0/H_f$; with zero thickness the plastic substrate
remains, $\mu=\tau_0/H$. In a shallow contact the gap has constant height, and the mean pressure is $H_f+2k_fa/(3t)$. *Check*
of the abstracts' statements: $\mu$ falls with load, and the pressure in the centre is many times the pressure at the edge. At
constant load $\mu$ rises with thickness and with radius, and falls with the hardness of the film. *Unknown*: the empirical
expression of [kato_1981]; in [kato_1982] the pressure at the edge, the shear stress on both faces, and whether the ball
ploughs as in a later paper of the group (J. Tribology 109 (1987) 545). Ploughing is not included here.

*Symbols*: displacement $w=\omega/\sigma$, load $P$ in units of $KR^{1/2}\sigma^{3/2}$ and contact area $A$ in units of
$\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and $K=\tfrac43E^*$
($E^*$ contact modulus); $\tau=t/\sigma$ film thickness; $n_H$ hardness of the film divided by the substrate's; $k=H/Y$ hardness
divided by yield stress; $\tau_0$ shear strength of the interface. Full list: [symbols](#1-units). Lengths along the surface are
in units of $\sqrt{R\sigma}$, so $a^2=2w$ and $b^2=2(\tau-w)$, and $\sqrt{R/\sigma}$ is $\tau$ divided by `film_aspect`.
"""

import math
from dataclasses import replace

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.engine.regime import Regime
from stiction.laws.joining import Law, within
from stiction.laws.segment import NormalSegment, edges_at
from stiction.laws.shared_claims import PLASTIC_FILM, SOFT_FILM, THIN_LAYER
from stiction.records.registry import Departure, FilmLaw
from stiction.records.sources import Source

_THINNEST = 1e-200  # replaces a film thickness of 0, over sigma
_FLATTEST = 1e-100  # least `hill` over eta, for a film so thick that it acts as a half-space
_SLOPE = 0.1  # below this angle tan x - x is summed as a series, below 2.5 times this sin x - x cos x


@formula
def arc_excess(x):
    """Return sin x - x cos x for x >= 0, without loss of precision at small x."""
    y = x * x
    if x > 2.5 * _SLOPE:
        return math.sin(x) - x * math.cos(x)
    return x * y / 3.0 * (1.0 - y / 10.0 * (1.0 - y / 28.0 * (1.0 - y / 54.0 * (1.0 - y / 88.0))))


@formula
def tan_excess(x):
    """Return tan x - x for 0 <= x < pi/2, without loss of precision at small x."""
    y = x * x
    if x > _SLOPE:
        return math.tan(x) - x
    higher = 62.0 / 2835.0 + y * (1382.0 / 155925.0 + y * (21844.0 / 6081075.0))
    return x * y * (1.0 / 3.0 + y * (2.0 / 15.0 + y * (17.0 / 315.0 + y * higher)))


@formula
def squeezed(u, *row):
    """Return displacement w, dw/du, load and contact area while only the film flows, at the coordinate u: w = tau sin(u)^2.

    With lengths in units of sqrt(R sigma), the contact radius a is sqrt(2 tau) sin(u), and b = sqrt(2 tau) cos(u). row: tau,
    film thickness in units of sigma; hill = 4 k_f sqrt(R/sigma), with the shear stress k_f on the film; bound = m = more/hill;
    edge = H_f, the film's hardness; more = H - H_f, the substrate's hardness minus the film's. Stresses are in units of load
    divided by area.
    """
    tau, hill, _, edge, _ = row
    sine = math.sin(u)
    w = tau * sine * sine
    return w, 2.0 * tau * sine * math.cos(u), 2.0 * edge * w + hill * math.sqrt(2.0 * tau) * arc_excess(u), 2.0 * w


@formula
def bounded(u, *row):
    """Return displacement w, dw/du, load and contact area while the substrate limits the pressure in the centre.

    The coordinate u gives w = tau sin(u)^2. With b = sqrt(2 tau) cos(u), the pressure equals the substrate's hardness within
    the radius c = b tan(u - m b); b and c are in units of sqrt(R sigma). row: `tau`, `hill`, `bound` (m), `edge` and `more`, as
    in `squeezed`.
    """
    tau, hill, bound, edge, _ = row
    width, sine, cosine = math.sqrt(2.0 * tau), math.sin(u), math.cos(u)
    w, a, b = tau * sine * sine, width * sine, width * cosine
    if u < 0.25 * math.pi:
        higher = b * (tan_excess(u) - tan_excess(max(u - bound * b, 0.0)))
    else:
        higher = a - b / math.tan(math.atan2(b, a) + bound * b) - bound * b * b
    return w, 2.0 * tau * sine * cosine, 2.0 * edge * w + hill * higher, 2.0 * w


@formula
def angle(w, *row):
    return math.asin(min(math.sqrt(max(w, 0.0) / row[0]), 1.0))


@formula
def pressed_through(v, *row):
    """Return w, dw/dv, load and contact area at the coordinate v, for displacements w = tau + v^2 above the film thickness.

    Within the radius c = g coth(y) the pressure is the substrate's hardness, with g = sqrt(2) v, y = arsinh(v/sqrt(tau)) + m g
    and lengths in units of sqrt(R sigma). All four results are infinite at v = infinity. row: `tau`, `hill`, `bound` (m),
    `edge` and `more`, as in `squeezed`.
    """
    tau, hill, bound, edge, more = row
    if v == math.inf:
        return math.inf, math.inf, math.inf, math.inf
    w, g = tau + v * v, math.sqrt(2.0) * v
    a, y = math.sqrt(2.0 * w), math.asinh(v / math.sqrt(tau)) + bound * g
    if y > 1.0:  # as (a - g) - (c - g), which loses no digits if all three are large
        ring = 2.0 * tau / (a + g) - (2.0 * g / math.expm1(2.0 * y) if y < 300.0 else 0.0)
    else:
        ring = a - (g / math.tanh(y) if y > 0.0 else 1.0 / (1.0 / a + bound))
    return w, 2.0 * v, 2.0 * edge * w + more * g * g + hill * ring, 2.0 * w


@formula
def depth_beyond(w, *row):
    return math.sqrt(max(w - row[0], 0.0))


def parameters(groups: Groups) -> tuple[np.ndarray, ...]:
    """Return the five parameters (n,) of the formulas: tau, hill, bound, edge and more, as in `squeezed`.

    A film harder than its substrate is treated as equally hard; a film of zero thickness is replaced by an extremely thin one.
    groups: dimensionless groups of n coated contacts.
    """
    laws = len(groups)
    n_H, aspect = np.broadcast_to(np.minimum(groups.n_H, 1.0), laws), np.broadcast_to(groups.film_aspect, laws)
    steepness = np.divide(groups.tau, aspect, where=aspect > 0.0, out=np.zeros(laws))  # sqrt(R/sigma)
    in_shear = groups.eta * n_H / (math.sqrt(3.0) * groups.hardness_to_yield)
    hill = np.maximum(4.0 * in_shear * steepness, _FLATTEST * groups.eta)
    more = groups.eta * (1.0 - n_H)
    return np.maximum(np.broadcast_to(groups.tau, laws), _THINNEST), hill, more / hill, groups.eta * n_H, more


def onset(tau: np.ndarray, bound: np.ndarray) -> np.ndarray:
    """Return the coordinate u (n,), an angle, above which the substrate limits the pressure: u = bound sqrt(2 tau) cos u.

    tau: film thickness in units of sigma. bound: parameter m of the formulas. Newton's method starts above the root, where the
    function is convex, so no step passes it.
    """
    steep = bound * np.sqrt(2.0 * tau)
    u = np.minimum(steep, 0.5 * math.pi)
    for _ in range(40):
        u = u - (u - steep * np.cos(u)) / (1.0 + steep * np.sin(u))
    return np.clip(u, 0.0, 0.5 * math.pi)


def segments(groups: Groups) -> list[tuple[NormalSegment, str]]:
    """Return three pairs (segment, body) of an asperity on a squeezed film, where `body` limits the pressure.

    As the displacement grows, the film is squeezed ("film"), then the substrate limits the pressure in the centre
    ("substrate"), and finally the film is pressed through ("substrate"). groups: dimensionless groups of n coated contacts.
    """
    row = parameters(groups)
    tau, _, bound, _, _ = row
    u_c = onset(tau, bound)
    with np.errstate(divide="ignore"):
        widths = [np.sqrt(tau) * size for size in (1.0, 3.0, 10.0, 30.0, 100.0)]
        widths += [size / bound for size in (0.7, 2.5, 8.0, 25.0)]
    edges = np.sort(edges_at(0.0, *widths, np.inf), axis=1)
    return [
        (NormalSegment(squeezed, angle, row, edges_at(0.0, u_c), "plastic"), "film"),
        (NormalSegment(bounded, angle, row, edges_at(u_c, 0.5 * math.pi), "plastic"), "substrate"),
        (NormalSegment(pressed_through, depth_beyond, row, edges, "plastic"), "substrate"),
    ]


def regimes(groups: Groups, law: Law) -> list[Regime]:
    """Return the regimes of a surface whose plastic film is squeezed out of the contacts.

    A regime is a segment of an asperity law together with the tangential force on it. Forces are in units of K R^(1/2)
    sigma^(3/2), with K = (4/3) E* of the substrate. groups: dimensionless groups of n coated contacts. law: its tangential
    law is used and must be a law of the interface; its asperity law is not used. Regimes of contacts wider than the film
    thickness have in_half_space=False.
    """
    tau = parameters(groups)[0]
    as_wide = 0.5 * groups.film_aspect**2  # a = t
    angle_there = np.arcsin(np.sqrt(np.minimum(as_wide / tau, 1.0)))
    parts = []
    for segment, body in segments(groups):
        there = np.sqrt(np.maximum(as_wide - tau, 0.0)) if segment.normal is pressed_through else angle_there
        joined = law.join(segment, groups, body=body)
        parts += [within(joined, -np.inf, there), replace(within(joined, there, np.inf), in_half_space=False)]
    return parts


RECORD = FilmLaw(
    key="kato_1981",
    title="Plastic film squeezed out between a rigid ball and a hard substrate, whose hardness limits the pressure",
    grade="C",
    sources=(
        Source("kato_1982", "abstract", "flow of the film to the side; reconstructed, the equations were not available"),
        Source("kato_1981", "abstract", "experiments; the empirical expression is unknown"),
        Source("prandtl_1923", "", "plastic layer between rough plates; the equilibrium of a circular layer is derived here"),
    ),
    regimes=regimes,
    tangential="interface",
    own_asperity=True,
    departures=(Departure("thick", "load", -0.98, 0.0),),  # for a film harder than its substrate
    confined=True,
    verified="independent integration of the pressure; limits of the film alone and of the substrate alone; trends of the "
    "abstracts",
    needs=("hardness_group", "hardness_to_yield", "n_H", "tau", "film_aspect"),
    validity=(
        PLASTIC_FILM,
        THIN_LAYER,
        SOFT_FILM,
    ),
    notes="load_substrate is the load on asperities under which the substrate's hardness limits the pressure. If it is most "
    "of the load, the substrate is plastic, although the source assumes a rigid one. Ploughing is not included. Without "
    "film_aspect (input by indices only) the pressure does not rise from edge to centre.",
)
