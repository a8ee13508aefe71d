r"""One elastic asperity on a film, as formulas: without adhesion or with DMT's, and with the energy of its edge (JKR).

The coordinate is u = x^(1/4), x = a^2/(R sigma). A row of parameters is ln n_E, per_root = (R sigma)^(1/4)/sqrt(t_1), t_1 the
thickness of one film, the pull, and the coefficients of two or three of `solvers.layered.curves`: with z = (q - 1)/(q + 1), q =
per_root u, the sphere's moduli E_P, E_S, B over that of the bodies without a film, and D in the approach D a^2/R.

    w_H = D u^4,  P_H = E_P u^6,  dP_H/dw_H = (3/2) E_S u^2,  A = u^4

DMT's adhesion is a pull of 2 pi n_g/theta. JKR's follows from energy alone, for bodies layered in any way: at a given radius
the load is a flat punch's less than P_H, and the energy that the edge releases is the work of adhesion,

    w = w_H - s u/sqrt(B),  P = P_H - (3/2) s E_S u^3/sqrt(B),  s = (2/3) sqrt(6 pi n_g/theta)

in SI delta = delta_H - sqrt(4 pi a gamma/S'), P = P_H - S sqrt(4 pi a gamma/S'), S = 2 a E_S, S' = dS/da = 2 B (compare
Barthel & Perriot 2007; the limit of short-ranged forces).
"""

import math

from stiction.engine.bisection import halving
from stiction.engine.compiled import formula
from stiction.engine.vectorised import exponential
from stiction.solvers.layered.curves import TERMS

# Parameters before the coefficients; all of a contact without the edge's energy, and with it.
HEAD = 3
_APPROACH, PLAIN, EDGED = HEAD + TERMS, HEAD + 2 * TERMS, HEAD + 3 * TERMS
_MOST_STEPS = 100


@formula
def _place(u, per_root):
    """Return z and (1 - z^2)/2 = dz/d ln u; at infinite u they are 1 and 0."""
    rest = 1.0 / (per_root * u + 1.0)
    return 1.0 - 2.0 * rest, 2.0 * rest * (1.0 - rest)


@formula
def _next(z, sums, coefficient):
    """Advance Horner's scheme by one coefficient, for a polynomial and its derivative."""
    value, slope = sums
    return value * z + coefficient, slope * z + value


@formula
def _polynomial(z, c):
    """Return Sum c_k z^k and its derivative by z.

    The terms are written out because the compiler does not vectorise a loop over a tuple.
    """
    sums = _next(z, _next(z, _next(z, (c[18], 0.0), c[17]), c[16]), c[15])
    sums = _next(z, _next(z, _next(z, sums, c[14]), c[13]), c[12])
    sums = _next(z, _next(z, _next(z, sums, c[11]), c[10]), c[9])
    sums = _next(z, _next(z, _next(z, sums, c[8]), c[7]), c[6])
    sums = _next(z, _next(z, _next(z, sums, c[5]), c[4]), c[3])
    return _next(z, _next(z, _next(z, sums, c[2]), c[1]), c[0])


@formula
def _curve(z, by_u, c):
    """Return Sum c_k z^k times 1 - z^2, and its derivative by ln u."""
    value, slope = _polynomial(z, c)
    return 2.0 * by_u * value, by_u * (2.0 * by_u * slope - 2.0 * z * value)


@formula
def _hertzian(u, row):
    """Return z, dz/d ln u, E_P, D, d ln E_P/d ln u and d ln D/d ln u (symbols: see the module)."""
    z, by_u = _place(u, row[1])
    load, load_slope = _curve(z, by_u, row[HEAD:_APPROACH])
    approach, approach_slope = _curve(z, by_u, row[_APPROACH:PLAIN])
    E_P = exponential(0.5 * (1.0 - z) * row[0] + load)
    return z, by_u, E_P, exponential(approach), load_slope - 0.5 * by_u * row[0], approach_slope


@formula
def plain(u, *row):
    """Return displacement, its slope, load minus pull, and area of a contact without edge energy (Hertz or DMT)."""
    _, _, E_P, D, _, approach_slope = _hertzian(u, row)
    u3 = u * u * u
    return D * u3 * u, D * u3 * (4.0 + approach_slope), E_P * u3 * u3 - row[2], u3 * u


@formula
def _edge(z, by_u, row):
    """Return 1/sqrt(B) and the derivative of its logarithm by ln u."""
    edge, edge_slope = _curve(z, by_u, row[PLAIN:EDGED])
    return exponential(-0.25 * (1.0 - z) * row[0] - 0.5 * edge), -0.5 * edge_slope + 0.25 * by_u * row[0]


@formula
def _stiffness(E_P, D, load_slope, approach_slope):
    """Return (3/2) E_S = (dP_H/du)/(dw_H/du)/u^2."""
    return E_P * (6.0 + load_slope) / (D * (4.0 + approach_slope))


@formula
def parted(u, row):
    """Return P_H, and how much smaller the adhesive load is on the same radius."""
    z, by_u, E_P, D, load_slope, approach_slope = _hertzian(u, row)
    u3, softness = u * u * u, _edge(z, by_u, row)[0]
    return E_P * u3 * u3, _stiffness(E_P, D, load_slope, approach_slope) * row[2] * softness * u3


@formula
def edged(u, *row):
    """Return displacement, its slope, load and area of a contact with edge energy (JKR), in the form of `plain`.

    The parameter pull of the row is s.
    """
    z, by_u, E_P, D, load_slope, approach_slope = _hertzian(u, row)
    softness, softness_slope = _edge(z, by_u, row)
    u3, back = u * u * u, row[2] * softness
    stiffness = _stiffness(E_P, D, load_slope, approach_slope)
    stretch = D * u3 * (4.0 + approach_slope) - back * (1.0 + softness_slope)
    return u * (D * u3 - back), stretch, u3 * (E_P * u3 - stiffness * back), u3 * u


@formula
def plain_coordinate(w, *row):
    """Return u at the displacement w, without edge energy.

    Newton's method on logarithms: ln w_H rises with ln u at a slope close to 4.
    """
    if not w > 0.0:
        return 0.0
    if w == math.inf:
        return math.inf
    u = math.sqrt(math.sqrt(w))
    for _ in range(_MOST_STEPS):
        _, _, _, D, _, approach_slope = _hertzian(u, row)
        step = math.log(D * u * u * u * u / w) / (4.0 + approach_slope)
        u *= math.exp(-step)
        if abs(step) <= 1e-14:
            break
    return u


@formula
def _approached(w, row):
    """Return u at the displacement w >= 0, with edge energy.

    Newton's method on ln(w_H/(w + v)), where v is the edge term of the displacement. This function rises with ln u.
    """
    u = max(math.sqrt(math.sqrt(w)), max(row[2], 1e-200) ** (1.0 / 3.0))
    for _ in range(_MOST_STEPS):
        z, by_u, _, D, _, approach_slope = _hertzian(u, row)
        softness, softness_slope = _edge(z, by_u, row)
        back = row[2] * softness * u
        slope = 4.0 + approach_slope - back / (w + back) * (1.0 + softness_slope)
        step = min(max(math.log(D * u * u * u * u / (w + back)) / slope, -2.0), 2.0)
        u *= math.exp(-step)
        if abs(step) <= 1e-14:
            break
    return u


@formula
def touch(row):
    """Return u at the displacement 0 with edge energy, where two approaching bodies make contact."""
    return _approached(0.0, row)


@formula
def _comes_off(u, row):
    """Return whether the displacement falls with u."""
    return edged(u, *row)[1] <= 0.0


@formula
def _is_short(u, given):
    """Return whether u lies before the displacement w, or where that falls with u."""
    w, row = given
    here = edged(u, *row)
    return here[0] < w or here[1] <= 0.0


_halve_off, _halve_short = halving(_comes_off), halving(_is_short)


@formula
def edged_coordinate(w, *row):
    """Return u at the displacement w, on the branch where the displacement grows with u."""
    if w == math.inf:
        return math.inf
    if w >= 0.0:
        return _approached(w, row)
    low = high = touch(row)
    while not _is_short(low, (w, row)):
        low, high = 0.9 * low, low
    return _halve_short(low, high, (w, row))


@formula
def pulled_off(row):
    """Return u at which a contact detaches when the bodies are moved apart.

    There dw/du = 0 at fixed displacement. It is the first such point, starting from where contact was made.
    """
    low = high = touch(row)
    while not _comes_off(low, row):
        low, high = 0.97 * low, low
    return _halve_off(low, high, row)
