r"""One asperity without adhesion whose material hardens: Ghaednia, Brake, Berryhill & Jackson 2019.

*Assumes*: the flattened sphere of [`jackson_green_2005`](#jackson_green_2005), made of a material with bilinear hardening. Its
stress rises with Young's modulus $E$ up to the yield stress $Y$ and with the tangent modulus $E_t$ beyond (`tangent_modulus` of
the softer material; the group `hardening` is $e=E_t/E$). Up to $1.9\,\omega_c$ the contact is Hertz's, with $\omega_c$ the
displacement at first yield. Beyond this displacement, area and load lie between those of the sphere without hardening and
Hertz's, closer to Hertz's the stronger the hardening. *Source*: [ghaednia_2019], eqs. (1) to (6) and (23) to (31), with
constants from codes of one author's group. Contact radius $a$, load $P$ and limiting pressure $H_G$ at the displacement
$\omega$ are

$$
a=a_e+(a_p-a_e)\exp\Upsilon,\qquad P=P_p+(P_e-P_p)\left(1-\exp(-3.3e)\right),\qquad
\frac{H_G}Y=2.84-0.92\left(1-\cos\frac{\pi a}R\right)
$$

$$
\Upsilon=\frac{-2se^{\,1-(\omega-\omega_c)/R}}{(4-3\exp(-2se))(1-e)},\qquad s=\sqrt{E/Y}
$$

(eqs. 25, 30, 28 and 26). $\exp$ is the exponential function; the last equation has a power of $e=E_t/E$. $a_e$ and $P_e$ are
Hertz's (eqs. 1 and 31), $a_p$ and $P_p$ are Jackson and Green's (eqs. 23, 24, 27 and 29) with this $H_G$. $E$ is the modulus
of the sphere itself. With `other_body="alike"` (default) both bodies are equal and $E=2(1-\nu^2)E^*$; with `"rigid"` one body
is rigid and $E=(1-\nu^2)E^*$. $\Upsilon=0$ for $e=0$. $H_G$ is constant beyond $a=R$.

*Reconstructed*, hence grade C: eq. (26) is taken from these codes, not from the paper. The codes quote the printed form, which
has the opposite sign and $\omega$ in place of $\omega-\omega_c$, and call it wrong. Eq. (31) is used without its printed
factor $\pi$, which Hertz's force does not have.

*Limits*: at $e=0$ the area equals the area of `jackson_green_2005`. The load is the same for blunt asperities only, because
the limiting pressures differ if $a/R$ is not small. At $e\to1$ the area is Hertz's, and the load is $P_p$ plus 96 % of the
difference between Hertz's load and $P_p$. *Coordinate* of integration: $u=\sqrt w$.

*Check*: contact radius and force agree with thirteen rows of an independent code's regression file to $10^{-12}$. The table
shows four of these rows, for two equal spheres ($E=192$ GPa, $\nu=0.3$, $Y=330$ MPa, effective radius 1.4 mm), each flattened
against the plane between them:

| $E_t$ | interference (m) | contact radius (m) | force (N) |
|---|---|---|---|
| 620 MPa | $4.407882127871\cdot10^{-8}$ | $7.855593535195\cdot10^{-6}$ | $4.870544928015\cdot10^{-2}$ |
| 620 MPa | $8.815764255743\cdot10^{-8}$ | $1.110948691796\cdot10^{-5}$ | $1.377598138669\cdot10^{-1}$ |
| 620 MPa | $2.644729276723\cdot10^{-7}$ | $1.982362642132\cdot10^{-5}$ | $6.888366827256\cdot10^{-1}$ |
| 0 | $2.644729276723\cdot10^{-7}$ | $1.989065002445\cdot10^{-5}$ | $6.885474816181\cdot10^{-1}$ |

*Symbols*: displacement $w=\omega/\sigma$, load $P$ in units of $KR^{1/2}\sigma^{3/2}$ and contact area $A$ in units of
$\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and $K=\tfrac43E^*$
($E^*$ contact modulus); $\nu$ Poisson's ratio. Full list: [symbols](#1-units).
"""

import math

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.bisection import halving
from stiction.engine.compiled import formula, lazy_kernel
from stiction.laws.asperity import hertz
from stiction.laws.asperity import jackson_green_2005 as unhardened
from stiction.laws.segment import NormalSegment, root_of
from stiction.laws.shared_claims import elastic_limit
from stiction.records.registry import AsperityLaw, Jump, Limit
from stiction.records.sources import Source

_area_ratio, _load_ratio, _elastic_to = unhardened.area_ratio, unhardened.load_ratio, unhardened.ELASTIC_TO

# The sum over heights is split at these ratios omega/omega_c, beyond which the elastic part of the load without hardening
# vanishes.
_SPLITS = (1e3, 1e5)
# Young's modulus E of the asperity over (1 - nu^2) E*. E* is E/(2 (1 - nu^2)) for two equal bodies, E/(1 - nu^2) against a
# rigid one.
_BODIES = {"alike": 2.0, "rigid": 1.0}
# Number of steps in the search for a = R.
_STEPS = 64


def elastic_share(hardening):
    """Return the weight of Hertz's load in the load of a hardening asperity, 1 - exp(-3.3 E_t/E) (eq 30).

    hardening: tangent modulus divided by Young's modulus, E_t/E, a number or an array.
    """
    return -np.expm1(-3.3 * hardening)


def stiffening(hardening, modulus_over_yield):
    """Return the numbers `front` and `rate` in the formula for the contact radius of a hardening asperity (eq 26).

    They give the exponent Upsilon = -front exp(rate (omega - omega_c)/R), with the displacement omega and its value omega_c
    at first yield. hardening: e = E_t/E, tangent modulus divided by Young's modulus, below 1. modulus_over_yield: E/S_y,
    Young's modulus divided by yield stress, with s = (E/S_y)^(1/2). Both may be arrays. Upsilon = -2 s e^(1 - (omega -
    omega_c)/R) / ((4 - 3 exp(-2 s e)) (1 - e)), as the authors' code computes it, and 0 for e = 0. The printed equation,
    which the code calls wrong, has the opposite sign and omega in place of omega - omega_c. With that sign the area would
    grow without bound for e -> 1 instead of tending to Hertz's.
    """
    s = np.sqrt(modulus_over_yield)
    front = 2.0 * s * hardening / ((4.0 - 3.0 * np.exp(-2.0 * s * hardening)) * (1.0 - hardening))
    rate = -np.log(np.where(hardening > 0.0, hardening, 1.0))
    return front, rate


@formula
def radius(w, w_c, B, sharpness, front, rate):
    """Return the contact radius in units of (R sigma)^(1/2) at the displacement w: a = a_e + (a_p - a_e) exp(Upsilon) (eq 25).

    a_e is Hertz's radius (eq 1), a_p Jackson and Green's (eqs 23, 24) with the exponent B. w, w_c: displacement, and
    displacement at first yield, in units of sigma. sharpness: sqrt(sigma/R). front, rate: the two numbers in Upsilon, from
    `stiffening`. Upsilon is limited to keep it finite for displacements beyond R.
    """
    elastic = math.sqrt(w)
    upsilon = -front * math.exp(min(rate * (w - w_c) * sharpness * sharpness, 300.0))
    return elastic + elastic * (math.sqrt(_area_ratio(w / w_c, B)) - 1.0) * math.exp(upsilon)


@formula
def hardness(radius):
    """Return the limiting pressure divided by the yield stress, H_G/S_y = 2.84 - 0.92 (1 - cos(pi a/R)) (eq 28).

    radius: contact radius divided by sphere radius, a/R. H_G/S_y falls from 2.84 to 1 at a = R and stays 1 for larger
    radii, where the formula has no meaning.
    """
    return 2.84 - 0.92 * (1.0 - math.cos(math.pi * min(radius, 1.0)))


_radius, _hardness = radius, hardness


@formula
def yielding(u, *row):
    """Return displacement w, dw/du, load and contact area of a hardening asperity beyond 1.9 omega_c, at u = sqrt(w).

    omega_c is the displacement at first yield. The load is F_p + (F_e - F_p) share (eq 30). F_p is Jackson and Green's load
    (eqs 27, 29), F_e is Hertz's (eq 31, without its printed factor pi, which Hertz's force does not have). row: w_c =
    omega_c/sigma; C, largest pressure divided by yield stress at w_c; B, exponent of the area; sharpness, sqrt(sigma/R);
    front and rate, from `stiffening`; share, from `elastic_share`; wide, the displacement beyond which the limiting
    pressure stays at the yield stress. Units: w in sigma, load in K R^(1/2) sigma^(3/2), area in pi R sigma.
    """
    w_c, C, B, sharpness, front, rate, share, wide = row
    w = u * u
    a = _radius(w, w_c, B, sharpness, front, rate)
    H = _hardness(a * sharpness) if w < wide else 1.0
    soft = w_c * math.sqrt(w_c) * _load_ratio(w / w_c, C, H)
    return w, 2.0 * u, soft + (w * u - soft) * share, a * a


@formula
def _is_narrow(w, parameters):
    """Return whether the contact radius at the displacement w is smaller than the radius R of the sphere.

    w: in units of sigma. parameters: w_c, B, sharpness, front and rate, as `radius` takes them.
    """
    w_c, B, sharpness, front, rate = parameters
    return _radius(w, w_c, B, sharpness, front, rate) * sharpness < 1.0


_halve = halving(_is_narrow)


@lazy_kernel(worth=300)
def _fill_wide(w_c, B, sharpness, front, rate, out):
    """Fill `out` (n,) with the first displacement, at least 1.9 w_c, at which the contact radius reaches the sphere's radius R.

    Displacements are in units of sigma. The other arguments are arrays (n,) of the parameters of `radius`. With little
    hardening the contact radius may fall below R again before the displacement equals R. The search therefore takes small
    steps.
    """
    for i in range(out.size):
        parameters = w_c[i], B[i], sharpness[i], front[i], rate[i]
        low = high = _elastic_to * w_c[i]
        step = max(1.0 / (sharpness[i] * sharpness[i]) - low, 0.0) / _STEPS  # at omega = R, a >= R
        for _ in range(_STEPS):
            if _is_narrow(high, parameters):
                low, high = high, high + step
        out[i] = _halve(low, high, parameters)


def _edges(w_c, sharpness, front, rate, wide):
    """Return the edges (n, m) of the segment beyond 1.9 w_c: its start, the splits for integration, and infinity.

    Edges are displacements in units of sigma. The segment is split where the contact radius reaches R (`wide`), at fixed
    multiples of w_c and, if the material hardens, where Upsilon = -1 (the area may change quickly there). w_c: displacement at
    first yield. sharpness: sqrt(sigma/R). front, rate: from `stiffening`. All arguments are arrays (n,).
    """
    start = _elastic_to * w_c
    hardens = (front > 0.0) & (rate > 0.0)
    turn = np.log(np.divide(1.0, front, where=hardens, out=np.ones_like(front)))
    turn = w_c + np.divide(turn, rate * sharpness**2, where=hardens, out=np.zeros_like(turn))
    between = np.stack([wide, turn, *(ratio * w_c for ratio in _SPLITS)], axis=1)
    between = np.sort(np.maximum(between, start[:, None]), axis=1)
    return np.column_stack([start, between, np.full_like(w_c, np.inf)])


def segments(groups: Groups, other_body: str = "alike") -> list[NormalSegment]:
    C, k, sharpness = unhardened.yield_coefficient(groups.nu), groups.hardness_to_yield, groups.sharpness
    w_c = unhardened.critical_interference(groups.eta, C, k)
    B = unhardened.area_power(groups.yield_strain)
    front, rate = stiffening(groups.hardening, _BODIES[other_body] * (1.0 - groups.nu * groups.nu) / groups.yield_strain)
    wide = np.empty_like(w_c)
    _fill_wide(w_c, B, sharpness, front, rate, wide)
    parameters = w_c, C, B, sharpness, front, rate, elastic_share(groups.hardening), wide
    edges = np.sqrt(_edges(w_c, sharpness, front, rate, wide))
    return [hertz.elastic(_elastic_to * w_c), NormalSegment(yielding, root_of, parameters, edges, "elastic-plastic")]


RECORD = AsperityLaw(
    key="ghaednia_2019",
    title="Elastic-plastic sphere of a hardening material",
    grade="C",
    sources=(
        Source(
            "ghaednia_2019",
            "eqs 1 to 6 and 23 to 31",
            "as in the code of one author's group: eq 26 differs from print, and eq 31 is used without its printed factor pi",
        ),
        Source("jackson_green_2005", "the sphere without hardening"),
        Source("hertz_1882", "the elastic asperity"),
    ),
    segments=segments,
    traits=frozenset({"no adhesion", "Hertz", "Hertz's shape"}),
    own_options={"other_body": tuple(_BODIES)},
    jumps=(
        Jump(
            1,
            1.00474,
            1.0,
            "at 1.9 omega_c, without hardening; with it the excess over 1 is multiplied by exp(-3.3 E_t/E)",
            {"theta": 1e3, "lam": 1e2, "nu": 0.3, "hardness_to_yield": 2.8, "sharpness": 0.02, "hardening": 0.0},
        ),
    ),
    verified="contact radius and force of the code TMDSimPy to 1e-12, with `other_body` rigid: two materials with "
    "E_t/E = 0.0032 and one without hardening, at 0.5 to 8 omega_c; limits of no hardening and of E_t -> E",
    needs=("hardness_group", "nu", "hardness_to_yield", "sharpness", "hardening"),
    limits=(
        Limit("jackson_green_2005", {"hardening": 0.0}, ("contact_area",), 1e-9),
        Limit("jackson_green_2005", {"hardening": 0.0, "sharpness": 1e-8}, ("load", "contact_area"), 1e-9),
        Limit("hertz", {"hardening": 1.0 - 1e-12}, ("contact_area",), 1e-9),
        elastic_limit("hertz"),
    ),
    load_is_monotonic=False,
    notes="The yield stress Y is hardness over hardness_to_yield. The law uses E* of the pair, and E and E_t of the asperity. "
    "`other_body` states how E follows from E*: two equal bodies (alike, as in most figures of the source) or one rigid body. "
    "For E_t -> E the area becomes Hertz's, and the load rises by 96 % of the difference between Hertz's load and the load "
    "without hardening. Without hardening the law is that of Jackson and Green with another limiting pressure, a cosine in "
    "place of their exponential; the two differ where a/R is not small. The figures of the source end at omega/R = 0.05. "
    "Beyond a = R the limiting pressure is kept at its smallest value, Y; as omega approaches R, the area returns to Hertz's "
    "by eq 26.",
)
