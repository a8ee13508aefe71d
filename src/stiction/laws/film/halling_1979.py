r"""Film and substrate as one half-space whose modulus and hardness depend on depth: after Halling 1979.

*Assumes*: Halling and co-workers treated film and substrate as one half-space with an equivalent modulus and an effective
hardness. Friction is the film's shear strength divided by this hardness. *Source*: [el_sherbiney_halling_1976] for the
modulus, [halling_1979] for the hardness. *Unknown*: their expressions. *Reconstruction*: the equivalent modulus, $\kappa$
times the substrate's, and the effective hardness, $\chi$ times the substrate's, are chosen among the six laws of [film and
substrate as one body](#5-film-and-substrate-as-one-body). A plastic asperity is a truncated sphere of constant volume; it
becomes plastic at the displacement $w_c$, where its mean pressure reaches the effective hardness:

$$
P=\kappa\,w^{3/2},\ A=w\quad\text{while}\quad\kappa\sqrt w<\eta\,\chi;\qquad
P=\eta\,\chi(w/\tau)\,A,\ A=2w-w_c\quad\text{beyond}
$$

The chosen law gives $\kappa_1$ and $\kappa_2$ of the two half-spaces with their films as functions of film thickness divided
by contact radius, $t/a$. The compliances of the two bodies add in Hertz's contact. $s$ is the fraction of the bare compliance
due to the first body. The first formula is for a film on the first body only, the second for films of thickness $t/2$ on both:

$$
\frac1\kappa=\frac s{\kappa_1(t/a)}+1-s,\qquad\frac1\kappa=\frac s{\kappa_1(t/2a)}+\frac{1-s}{\kappa_2(t/2a)}
$$

Load and area are continuous at $w_c$. With a soft film on a hard substrate, friction rises with the film thickness. It falls
with load towards the ratio of the interface's shear strength to the substrate's hardness. It has no minimum as a function of
thickness.

*Symbols*: displacement $w=\omega/\sigma$, load $P$ in units of $KR^{1/2}\sigma^{3/2}$ and contact area $A$ in units of
$\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and $K=\tfrac43E^*$
($E^*$ contact modulus); $\eta=\pi H\sqrt{R/\sigma}/K$ hardness group, $H$ hardness; $\tau=t/\sigma$ film thickness; $n_E$
modulus of the film divided by the substrate's; $n_H$ hardness of the film divided by the substrate's. Full list:
[symbols](#1-units).
"""

from functools import cache
from typing import Any

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.bisection import halving
from stiction.engine.compiled import formula, lazy_kernel, unpack
from stiction.engine.regime import Regime, columns
from stiction.laws.film.shared.two_bodies import TwoBodies, in_series
from stiction.laws.segment import NormalSegment, displaced, root_of
from stiction.records.registry import FilmLaw, Limit, composites_of
from stiction.records.sources import Source

_THINNEST = 1e-100  # replaces a film thickness of 0, over sigma

CELLS = 256
ELASTIC = 15  # number of parameters before the displacement at yield
BODIES = 8  # position of the constants of the two bodies among these


@cache
def _formulas(modulus_key: str, hardness_key: str) -> tuple[Any, Any, Any]:
    """Return three formulas: response of the elastic asperity, response of the plastic asperity, and whether it yields.

    modulus_key, hardness_key: keys of the composite laws for modulus and hardness. The formulas take 15 parameters, in the
    order of `segments`; the response formulas also take the displacement at yield.
    """
    modulus, hardness = composites_of("modulus")[modulus_key].value, composites_of("hardness")[hardness_key].value

    @formula
    def stiffened(u, row):
        """Return the load divided by Hertz's load; it equals the modulus with film divided by the modulus without film.

        u: contact radius in units of sqrt(R sigma). row: the parameters of `_formulas`.
        """
        xi = row[4] / u if u > 0.0 else np.inf  # plain Python raises an error where compiled code gives infinity
        first, second, share, films, nu, nu_first, nu_second = row[BODIES:ELASTIC]
        g = modulus(first, xi, nu, nu_first)
        other = modulus(second, xi, nu, nu_second) if films == 2.0 else 1.0
        return in_series(g, other, share)

    @formula
    def hardened(w, row):
        """Return the hardness of film and substrate together at the displacement w, in units of load divided by area.

        w: in units of sigma. row: the parameters of `_formulas`.
        """
        n_H, eta, tau, constant, exponent = row[2], row[3], row[5], row[6], row[7]
        return eta * hardness(n_H, w / tau, constant, exponent)

    @formula
    def elastic(u, *row):
        """Return displacement w, dw/du, load and contact area of the elastic asperity at the coordinate u = sqrt(w).

        u is also the contact radius in units of sqrt(R sigma). row: the parameters of `_formulas` and the displacement at
        yield.
        """
        w = u * u
        return w, 2.0 * u, stiffened(u, row) * w * u, w

    @formula
    def plastic(w, *row):
        area = 2.0 * w - row[ELASTIC]
        return w, 1.0, hardened(w, row) * area, area

    @formula
    def flows(u, row):
        """Return whether the mean pressure of the elastic asperity at the coordinate u = sqrt(w) has reached the hardness."""
        return stiffened(u, row) * u >= hardened(u * u, row)

    return elastic, plastic, flows


@cache
def _onset(flows: Any) -> Any:
    """Return a kernel that finds the coordinate u = sqrt(w) at which asperities become plastic; w: displacement.

    flows(u, row): formula that returns whether the mean pressure has reached the hardness.
    """

    @formula
    def holds(u, row):
        return not flows(u, row)

    halve = halving(holds)

    @lazy_kernel(worth=300)
    def onset(table, out):
        """Fill `out` (n,) with the smallest u = sqrt(w) at which the mean pressure reaches the hardness.

        w: displacement in units of sigma. table (n, p): parameters of each contact. At this u, kappa u = eta chi, with the
        equivalent modulus kappa and the effective hardness chi, both divided by the substrate's, and the hardness group
        eta. The root lies between eta chi/kappa for the largest modulus with the smallest hardness, and eta chi/kappa for
        the smallest modulus with the largest hardness. This bracket is scanned in steps, then bisected.
        """
        for i in range(out.size):
            row = unpack(table[i], ELASTIC)
            least, greatest, n_H, eta = row[:4]
            low = eta * min(n_H, 1.0) / greatest
            step = (eta * max(n_H, 1.0) / least / low) ** (1.0 / CELLS)
            u = low
            for _ in range(CELLS):
                if flows(u, row):
                    break
                low = u
                u *= step
            out[i] = halve(low, u, row)

    return onset


def _between(low: np.ndarray, high: np.ndarray, inside: np.ndarray) -> np.ndarray:
    """Return the sorted edges (n, m + 2) of a range: its ends low and high (n,), and the points `inside` (n, m) clipped to it.

    If high < low, all edges equal low and the segments between them are empty.
    """
    high = np.maximum(low, high)
    inside = np.minimum(np.maximum(inside, low[:, None]), high[:, None])
    return np.sort(np.concatenate([low[:, None], inside, high[:, None]], axis=1), axis=1)


def segments(groups: Groups, modulus: str, hardness: str, soft_film_exponent: str) -> list[tuple[NormalSegment, str]]:
    """Return four pairs (segment, body): elastic and plastic asperities, each with the body "film" or "substrate".

    An asperity counts as film up to a displacement equal to the film thickness, and as substrate beyond it. groups:
    dimensionless groups of n coated contacts. modulus, hardness: keys of the composite laws. soft_film_exponent: exponent m for
    a soft film, "1" or "2"; a hard film has 3 - m.
    """
    laws = len(groups)
    tau = np.broadcast_to(groups.tau, laws)
    there = tau > 0.0
    tau, n_H = np.where(there, tau, _THINNEST), np.where(there, groups.n_H, 1.0)
    bodies, aspect = TwoBodies.of(groups).without_film(there), np.where(there, groups.film_aspect, 1.0)
    aspect = aspect / bodies.films  # two coated bodies have half of the thickness each
    soft = float(soft_film_exponent)
    exponent = np.where(n_H < 1.0, soft, 3.0 - soft)
    film_hardness: Any = composites_of("hardness")[hardness]
    constant = film_hardness.constants(bodies.film_over_bodies, n_H, n_H)
    eta = groups.eta
    elastic, plastic, flows = _formulas(modulus, hardness)
    known = *bodies.bounds(), n_H, eta, aspect, tau, constant, exponent, *bodies.columns()
    u_c = np.empty(laws)
    _onset(flows)(columns(known, laws), u_c)
    parameters = (*known, u_c * u_c)
    widths = aspect[:, None] * np.array(
        [0.1, 0.3, 1.0, 3.0, 10.0, 40.0, 200.0, 1e3, 6e3]
    )  # contact radii over which the modulus changes from the film's to the substrate's
    depths = tau[:, None] * film_hardness.landmarks(constant, exponent)
    none, all_u, all_w = np.zeros(laws), np.sqrt(tau), np.full(laws, np.inf)
    parts = (
        ("elastic", "film", none, np.minimum(u_c, all_u)),
        ("elastic", "substrate", np.minimum(u_c, all_u), u_c),
        ("plastic", "film", u_c * u_c, tau),
        ("plastic", "substrate", np.maximum(u_c * u_c, tau), all_w),
    )
    formulas = {"elastic": (elastic, root_of, widths), "plastic": (plastic, displaced, depths)}
    return [
        (NormalSegment(*formulas[state][:2], parameters, _between(low, high, formulas[state][2]), state), body)
        for state, body, low, high in parts
    ]


def regimes(groups: Groups, law, modulus: str, hardness: str, soft_film_exponent: str) -> list[Regime]:
    """Return the regimes of a coated surface with an effective modulus and hardness.

    A regime is a segment of an asperity law together with the tangential force on it. Forces are in units of K R^(1/2)
    sigma^(3/2), with K = (4/3) E* of the substrate. groups: dimensionless groups of n coated contacts. law: only its
    tangential law is used, which must describe the interface. modulus, hardness: keys of the composite laws.
    soft_film_exponent: exponent m for a soft film, "1" or "2"; a hard film has 3 - m.
    """
    return [law.join(segment, groups, body=body) for segment, body in segments(groups, modulus, hardness, soft_film_exponent)]


RECORD = FilmLaw(
    key="halling_1979",
    title="Film and substrate as one half-space of effective modulus and effective hardness",
    grade="C",
    sources=(
        Source("halling_1979", "", "effective hardness; the expression itself was not available"),
        Source("el_sherbiney_halling_1976", "", "Hertz contact with an equivalent modulus; the expression was not available"),
        Source("chang_etsion_bogy_1987", "", "the plastic asperity: truncated sphere of constant volume"),
    ),
    regimes=regimes,
    tangential="interface",
    own_asperity=True,
    composites={"modulus": "gao_chiu_lee_1992", "hardness": "bhattacharya_nix_1988"},
    own_options={"soft_film_exponent": ("2", "1")},
    verified="limits of the film alone and of the substrate alone; mean pressure at first yield; independent sums over heights",
    needs=(
        "hardness_group",
        "n_E",
        "n_H",
        "tau",
        "film_aspect",
        "films",
        "layer_nu",
        "coated_share",
        "coated_nu",
        "counter_nu",
    ),
    limits=(Limit("greenwood_williamson_1966", {"theta": 1.0, "lam": 1e24, "n_E": 1.0}, ("load", "contact_area"), 1e-9),),
    load_is_monotonic=False,
    notes="A reconstruction. soft_film_exponent is the exponent m of bhattacharya_nix_1988 for a soft film; a hard film has 3 "
    "- m. With a soft film on a hard substrate, friction rises with the film thickness and falls with load towards the "
    "Bowden-Tabor value, shear strength divided by substrate hardness. Friction has no minimum as a function of thickness.",
)
