r"""One elastic asperity with adhesion of constant stress in a ring around the contact: Maugis 1992.

*Assumes*: elastic bodies. In a ring around the contact, from the contact radius $a$ to the outer radius $c$, the surfaces
attract each other with the constant stress $\sigma_0$, up to a gap $\gamma/\sigma_0$ (a Dugdale zone). As the Tabor parameter
grows, the law changes from DMT (stiff, small spheres) to JKR (soft, large spheres). *Source*: [maugis_1992]. Maugis's units
are $(\pi\gamma R^2/K)^{1/3}$ for the contact radius $\mathcal A$, $(\pi^2\gamma^2R/K^2)^{1/3}$ for the displacement $D$ and
$\pi\gamma R$ for the load. With $m=c/a$ and the parameter $\lambda_M$ of the attraction:

$$
\tfrac12\lambda_M\mathcal A^2\left[\sqrt{m^2-1}+(m^2-2)\arctan\sqrt{m^2-1}\right]
+\tfrac43\lambda_M^2\mathcal A\left[\sqrt{m^2-1}\,\arctan\sqrt{m^2-1}-m+1\right]=1
$$

$$
D=\mathcal A^2-\tfrac43\lambda_M\mathcal A\sqrt{m^2-1},\qquad
\frac{\text{load}}{\pi\gamma R}=\mathcal A^3-\lambda_M\mathcal A^2\left[\sqrt{m^2-1}+m^2\arctan\sqrt{m^2-1}\right]
$$

The first equation states that the gap at $c$ equals the range $\gamma/\sigma_0$. With $g=(\pi/\theta)^{1/3}$ the units here are
$w=g^2D$, $P=g^3\cdot\text{load}/(\pi\gamma R)$ and $A=g^2\mathcal A^2$. For a given $m$ the first equation is quadratic in
$\mathcal A$, so all results are explicit in the coordinate $s=1/\sqrt{m^2-1}=a/\sqrt{c^2-a^2}$. $s$ is 0 for a contact at a
point and grows with the contact radius. With $B=\mathcal A/s$, which stays finite at $s=0$, all functions are smooth:

$$
\tfrac12\lambda_MF\,B^2+\tfrac43\lambda_M^2G\,B=1,\quad
F=s+(1-s^2)\arctan\tfrac1s,\quad G=\arctan\tfrac1s-\sqrt{1+s^2}+s
$$

$$
D=s^2B^2-\tfrac43\lambda_MB,\qquad\frac{\text{load}}{\pi\gamma R}=s^3B^3-\lambda_MB^2\left[s+(1+s^2)\arctan\tfrac1s\right]
$$

$\lambda_M=2\sigma_0(R/(\pi\gamma K^2))^{1/3}=1.1570\,\mu_T$ if $\sigma_0$ is the largest stress between two
Lennard-Jones half-spaces, $16\gamma/(9\sqrt3\,\varepsilon)$.

| $\lambda_M$ | 0.01 | 0.1 | 0.3 | 1 | 3 | 10 | 100 |
|---|---|---|---|---|---|---|---|
| pull-off force over $\pi\gamma R$ | 1.9983 | 1.9506 | 1.8156 | 1.6007 | 1.5168 | 1.5016 | 1.5000 |
| load at first touch over $\pi\gamma R$ | −1.9445 | −1.7494 | −1.5736 | −1.4055 | −1.3455 | −1.3345 | −1.3333 |

The difference from JKR falls as $\mu_T^{-2}$ for large $\mu_T$, the difference from DMT only as $\mu_T^{1/2}$ for small
$\mu_T$. *Departure*: here, as for JKR and DMT, an asperity attracts only while it touches. During loading, contact begins at
$w=0$. In the source the ring also attracts before contact. During unloading the contact lasts until $dw/ds=0$ or, for small
$\lambda_M$, until it has shrunk to a point.

*Symbols*: displacement $w=\omega/\sigma$, load $P$ in units of $KR^{1/2}\sigma^{3/2}$ and contact area $A$ in units of
$\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and $K=\tfrac43E^*$
($E^*$ contact modulus); $\theta=K\sigma^{3/2}/(\gamma R^{1/2})$ elastic adhesion index, $\gamma$ work of adhesion;
$\mu_T=(R\gamma^2/(E^{*2}\varepsilon^3))^{1/3}$ Tabor parameter, $\varepsilon$ equilibrium distance. Full list:
[symbols](#1-units).
"""

import math

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.bisection import halving
from stiction.engine.compiled import formula, lazy_kernel
from stiction.laws.segment import NormalSegment, edges_at
from stiction.laws.shared_claims import ELASTIC
from stiction.records.registry import AsperityLaw, Limit
from stiction.records.sources import Source

# lambda_M = 2 sigma_0 (R/(pi gamma K^2))^(1/3) over the Tabor parameter (R gamma^2/(E*^2 epsilon^3))^(1/3), for a stress
# sigma_0 = 16 gamma/(9 sqrt(3) epsilon), the largest between two Lennard-Jones half-spaces: 1.1570. K = (4/3) E*.
LAMBDA_OVER_TABOR = 32.0 / (9.0 * math.sqrt(3.0)) * (9.0 / (16.0 * math.pi)) ** (1.0 / 3.0)

# Largest lambda_M. The asperity differs from JKR's by one part in lambda_M^2; a larger value would only risk overflow.
_SOFTEST = 1e9

# From this s on the closed form of F loses digits. Its series in 1/s is used: 14 terms are exact to the last digit.
_FAR = 4.0
_TERMS = 14


@formula
def ring(s):
    """Return F, -F'/s, G, -G'/s and arctan(1/s), functions of the shape s of the attracting ring around a contact.

    s = a/sqrt(c^2 - a^2), with the contact radius a and the outer radius c of the ring. F = s + (1 - s^2) arctan(1/s), G =
    arctan(1/s) - sqrt(1 + s^2) + s; a prime denotes the derivative with respect to s. For large s a series is used.
    """
    turn = math.atan2(1.0, s)
    root = math.sqrt(1.0 + s * s)
    G = turn - 1.0 / (s + root)
    G_falls = 1.0 / ((1.0 + s * s) * (s + root))
    if s < _FAR:
        return s + (1.0 - s * s) * turn, 2.0 * (turn - s / (1.0 + s * s)), G, G_falls, turn
    t = 1.0 / s
    t2 = t * t
    F = F_falls = 0.0
    for back in range(_TERMS):
        k = 2.0 * (_TERMS - 1 - back)
        both = 1.0 / (k + 1.0) + 1.0 / (k + 3.0)
        F = both - t2 * F
        F_falls = both * (k + 1.0) - t2 * F_falls
    return t * F, t2 * t * F_falls, G, G_falls, turn


@formula
def _contact(s, lam):
    """Return B = A/s, (dB/ds)/s and arctan(1/s), where A is the contact radius in units of (pi gamma R^2/K)^(1/3).

    B follows from the condition that the gap at the outer edge of the ring equals the range of the attraction. s = a/sqrt(c^2 -
    a^2), with the contact radius a and the outer radius c of the ring. lam: Maugis's parameter lambda_M of the attraction.
    """
    F, F_falls, G, G_falls, turn = ring(s)
    square, linear = 0.5 * lam * F, 4.0 / 3.0 * lam * lam * G
    root = math.sqrt(linear * linear + 4.0 * square)
    B = 2.0 / (linear + root)
    return B, (0.5 * lam * F_falls * B + 4.0 / 3.0 * lam * lam * G_falls) * B / root, turn


@formula
def stretch(s, lam):
    """Return (dD/ds)/s, where D is the displacement in units of (pi^2 gamma^2 R/K^2)^(1/3) and gamma the work of adhesion.

    s = a/sqrt(c^2 - a^2), with contact radius a and outer radius c of the attracting ring. lam: Maugis's parameter lambda_M of
    the attraction. The value at s = 0 is finite; it is negative if the approach to contact is unstable.
    """
    B, B_grows, _ = _contact(s, lam)
    return 2.0 * B * (B + s * s * B_grows) - 4.0 / 3.0 * lam * B_grows


@formula
def normal(s, g, lam):
    """Return displacement w, dw/ds, load and contact area of Maugis's contact at the coordinate s.

    s = a/sqrt(c^2 - a^2), with the contact radius a and the outer radius c of the attracting ring. g: (pi/theta)^(1/3), with
    the elastic adhesion index theta. lam: Maugis's parameter lambda_M of the attraction. All four results are infinite at s =
    infinity. Units: w in sigma, load in K R^(1/2) sigma^(3/2), area in pi R sigma.
    """
    if s == math.inf:
        return math.inf, math.inf, math.inf, math.inf
    B, B_grows, turn = _contact(s, lam)
    A = s * B
    D = A * A - 4.0 / 3.0 * lam * B
    slope = s * (2.0 * B * (B + s * s * B_grows) - 4.0 / 3.0 * lam * B_grows)
    P = A * A * A - lam * B * B * (s + (1.0 + s * s) * turn)
    return g * g * D, g * g * slope, g * g * g * P, g * g * A * A


@formula
def coordinate(w, g, lam):
    """Return the coordinate s of Maugis's contact at the displacement w in units of sigma, on the stable branch.

    s = a/sqrt(c^2 - a^2), with contact radius a and outer radius c of the attracting ring. g: (pi/theta)^(1/3), with the
    elastic adhesion index theta. lam: Maugis's parameter lambda_M of the attraction. w must not be below the smallest
    displacement of this branch. Newton's method, started above the root of the convex function, solves the equation to machine
    precision.
    """
    if w == math.inf:
        return math.inf
    D = w / (g * g)
    A = math.sqrt(max(D, 0.0)) + 1.5  # JKR's contact is the widest; at D = 0 its radius is A = (8/3)^(1/3)
    s = max(min(A * math.sqrt(2.0 * lam), (1.5 * lam * A * A) ** (1.0 / 3.0)), lam * min(1.2 * math.sqrt(A), 1.6 * lam * A))
    while normal(s, 1.0, lam)[0] < D:
        s *= 2.0
    for _ in range(200):
        displaced, slope, _, _ = normal(s, 1.0, lam)
        if slope <= 0.0:
            break
        step = min((displaced - D) / slope, 0.5 * s)
        s -= step
        if step <= 1e-15 * s:
            break
    return s


@formula
def _unstable(s, lam):
    return stretch(s, lam) < 0.0


_halve = halving(_unstable)


@lazy_kernel(worth=300)
def _fill_first(lam, loading, out):
    for i in range(lam.size):
        high = coordinate(0.0, 1.0, lam[i])
        if loading:
            out[i] = high
        else:  # unless it is unstable there, the contact shrinks to a point
            out[i] = _halve(0.0, high, lam[i]) if _unstable(0.0, lam[i]) else 0.0


@lazy_kernel(worth=300)
def _fill_displacement(s, g, lam, out):
    for i in range(s.size):
        out[i] = normal(s[i], g[i], lam[i])[0]


def segments(groups: Groups, branch: str) -> list[NormalSegment]:
    """Return a list of one segment, Maugis's contact during loading (from w = 0) or during unloading.

    For unloading the segment starts where dw/ds = 0 or, if the contact stays stable, at s = 0, where the contact has shrunk to
    a point. w: displacement. s: coordinate. groups: dimensionless groups of n contacts. branch: "loading" or "unloading". An
    edge is placed at s = 4, beyond which the functions of the attracting ring vary on another scale.
    """
    lam = np.minimum(LAMBDA_OVER_TABOR * groups.tabor_parameter, _SOFTEST)
    g = np.cbrt(math.pi / groups.theta)
    first, lowest = np.empty(len(groups)), np.zeros(len(groups))
    _fill_first(lam, branch == "loading", first)
    if branch == "unloading":
        _fill_displacement(first, g, lam, lowest)
    edges = edges_at(first, np.maximum(first, _FAR), np.inf)
    return [NormalSegment(normal, coordinate, (g, lam), edges, "elastic", float(np.min(lowest, initial=0.0)))]


RECORD = AsperityLaw(
    key="maugis_1992",
    title="Elastic sphere, adhesion of constant stress in a ring around the contact",
    grade="B",
    sources=(Source("maugis_1992", "", "the equations, in the source's own units"),),
    segments=segments,
    verified="the source's equations solved independently at 30 digits; JKR and DMT as limits",
    needs=("theta", "tabor_parameter"),
    validity=(ELASTIC,),
    limits=(
        Limit("jkr", {"tabor_parameter": 1e6}, ("load", "contact_area"), 1e-9),
        Limit("jkr", {"tabor_parameter": 1e6}, ("load", "contact_area"), 1e-9, {"branch": "unloading"}),
        Limit("dmt", {"tabor_parameter": 1e-20}, ("load", "contact_area"), 1e-6),
        Limit("hertz", {"theta": 1e14}, ("load", "contact_area"), 1e-4),
    ),
    own_options={"branch": ("loading", "unloading")},
    load_is_monotonic=False,
    notes="Asperities attract only while they touch, during loading only after zero displacement, as in jkr and dmt. In the "
    "source they attract before contact. lambda_M is 1.157 times the Tabor parameter; this sets the attracting stress to the "
    "largest stress between two Lennard-Jones half-spaces. The law is close to DMT for Tabor parameters below about 0.1 and to "
    "JKR above about 5. The difference from JKR falls with the inverse square of the Tabor parameter, the difference from DMT "
    "with its square root.",
)
