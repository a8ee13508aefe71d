r"""The graded film: one asperity law whose modulus and hardness depend on depth.

*Assumes*: the asperity of the 2015 paper ([`roy_chowdhury_ghosh_1994`](#roy_chowdhury_ghosh_1994)), with the modulus of film
and substrate together at its contact radius by [`gao_chiu_lee_1992`](#gao_chiu_lee_1992), and their hardness $H$ at its depth
by [`bhattacharya_nix_1988`](#bhattacharya_nix_1988). The plastic fraction $f$ of the asperity grows gradually from 0 to 1 by
the cubic step of [`zhao_maietta_chang_2000`](#zhao_maietta_chang_2000), as a function of the elastic mean pressure $p$:

$$
f=3\xi^2-2\xi^3,\qquad\xi=\frac{(p/H)^2-1}{54\cdot0.4^2-1}\ \text{limited to 0 to 1}
$$

*Source*: this project's own, composed of published parts: [theory, section 5.3](theory.md#5-coated-surface). The formulas are
in `graded_law.py`, their kinks in `graded_kinks.py`. Without a film the same law describes the bare asperity without a jump of
the load at yield. *Reconstructed*: the whole composition. *Check*: the law equals the law of the bare surface at $n_E=n_H=1$,
the law of the substrate for $\tau\to0$, and the law of the film material for $\tau\to\infty$.

*Symbols*: displacement $w=\omega/\sigma$, load $P$ in units of $KR^{1/2}\sigma^{3/2}$ and contact area $A$ in units of
$\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and $K=\tfrac43E^*$
($E^*$ contact modulus); $\tau=t/\sigma$ film thickness; $n_E$ modulus of the film divided by the substrate's; $n_H$ hardness
of the film divided by the substrate's. Full list: [symbols](#1-units).
"""

import math

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.regime import Regime
from stiction.laws.composite.bhattacharya_nix_1988 import constants
from stiction.laws.film.shared.graded_kinks import find_kinks, gather
from stiction.laws.film.shared.graded_law import along, coordinate
from stiction.laws.film.shared.two_bodies import TwoBodies
from stiction.laws.joining import Law
from stiction.quantities.errors import InputError
from stiction.records.registry import FilmLaw
from stiction.records.sources import Source


def fading_rates(
    n_E: np.ndarray, n_H: np.ndarray, n_Y: np.ndarray, tau: np.ndarray, m_soft: int = 2, m_hard: int = 1
) -> tuple[np.ndarray, np.ndarray]:
    """Return the two rates (n,) at which the influence of the film on the hardness fades with depth (S5.13, S5.14).

    They are the factors of w and w^2 in the exponent, with the displacement w in units of sigma: (c/tau, 0) for the
    exponent m = 1, (0, c/tau^2) for m = 2. n_E, n_H, n_Y: modulus, hardness and yield stress of the film divided by the
    substrate's. tau: film thickness in units of sigma. m_soft, m_hard: m for n_H < 1 and for n_H >= 1, 1 or 2 (sources
    disagree). Raises InputError for another m.
    """
    for name, exponent in (("m_soft", m_soft), ("m_hard", m_hard)):
        if exponent not in (1, 2):
            raise InputError(name, exponent, "1 or 2")
    c = constants(n_E, n_H, n_Y)
    m = np.where(n_H < 1.0, m_soft, m_hard)
    thickness = np.maximum(tau, 1e-100)
    return np.where(m == 1, c / thickness, 0.0), np.where(m == 2, c / thickness / thickness, 0.0)


# State and body of each part of the asperity law, in the order of their numbers.
PARTS = (("elastic", "film"), ("plastic", "film"), ("elastic", "substrate"), ("plastic", "substrate"))


def graded_regimes(
    substrate: Groups,
    film: Groups,
    n_E: np.ndarray,
    n_H: np.ndarray,
    tau: np.ndarray,
    film_aspect: np.ndarray,
    n_g: np.ndarray | float = 1.0,
    exponents: tuple[int, int] = (2, 1),
) -> list[Regime]:
    """Return the regimes of a graded film on one body against a rigid body.

    Forces are in units of K R^(1/2) sigma^(3/2), with K = (4/3) E* of the substrate. A regime is the part of the asperity law
    in which the asperity is elastic or plastic and counts as film or as substrate (PARTS). An asperity counts as film while its
    displacement is below the film thickness, and as plastic if its elastic mean pressure exceeds the hardness at its depth.

    substrate, film: groups with Poisson's ratio, K beta, and the ratio of hardness to yield stress, of substrate and film; only
    the adhesion indices of `substrate` are used, scaled by n_E, n_H and n_g. n_E, n_H, n_g (n,): modulus, hardness and work of
    adhesion of the film divided by the substrate's. tau, film_aspect (n,): film thickness in units of sigma and of sqrt(R
    sigma), 0 to infinity. exponents: m of (S5.13), 1 or 2, for a film softer than the substrate and for a harder one.
    """
    laws = len(substrate.theta)
    n_E, n_H, tau, film_aspect, n_g = (
        np.broadcast_to(np.asarray(value, dtype=float), laws) for value in (n_E, n_H, tau, film_aspect, n_g)
    )
    bodies = TwoBodies.against_rigid(n_E, film.nu, substrate.nu)
    return _film_regimes(substrate, film, bodies, n_H, tau, film_aspect, n_g, exponents)


def _film_regimes(
    substrate: Groups,
    film: Groups,
    bodies: TwoBodies,
    n_H: np.ndarray,
    tau: np.ndarray,
    film_aspect: np.ndarray,
    n_g: np.ndarray,
    exponents: tuple[int, int],
) -> list[Regime]:
    """Return the regimes of a graded film on one or on both bodies.

    Forces are in units of K R^(1/2) sigma^(3/2), with K = (4/3) E* of the substrate. bodies: elastic constants of film and
    bodies. The other arguments are as in `graded_regimes`.
    """
    bodies = bodies.without_film(film_aspect > 0.0)  # a film of zero thickness does not count
    n_E = bodies.film_over_bodies
    n_H = np.where(tau > 0.0, n_H, 1.0)
    n_Y = n_H * substrate.hardness_to_yield / film.hardness_to_yield
    film_k = np.where(tau > 0.0, film.hardness_to_yield, substrate.hardness_to_yield)
    rates = fading_rates(n_E, n_H, n_Y, tau, *exponents)
    parameters = _parameters(substrate, film, film_k, bodies, n_H, film_aspect, n_g, rates)
    return _regimes(parameters, tau, PARTS)


def bare_regimes_with_transition(asperity: Groups) -> list[Regime]:
    """Return the elastic and the plastic regime of a bare surface whose asperities become plastic gradually.

    asperity: dimensionless groups of n contacts. The gradual transition replaces the load jump of (S2.9).
    """
    ones, never = np.ones(len(asperity.theta)), np.full(len(asperity.theta), np.inf)
    bodies = TwoBodies.against_rigid(ones, asperity.nu, asperity.nu)
    parameters = _parameters(asperity, asperity, asperity.hardness_to_yield, bodies, ones, never, ones, (0.0, 0.0))
    return _regimes(parameters, never, (("elastic", "bare"), ("plastic", "bare")))


def _parameters(substrate, film, film_k, bodies, n_H, film_aspect, n_g, rates) -> np.ndarray:
    """Return the parameters (n, PARAMETERS) of asperities on graded films, in the order in which `graded_law.along` takes them.

    substrate, film: groups of substrate and film. film_k: hardness divided by yield stress of the film. bodies: elastic
    constants. n_H, n_g: hardness and work of adhesion of the film divided by the substrate's. film_aspect: film thickness
    in units of sqrt(R sigma); if both bodies are coated, each has half of it. rates: from `fading_rates`.
    """
    first, second, share, films, nu, nu_first, nu_second = bodies.columns()
    columns = (
        math.pi * n_g / substrate.theta,
        substrate.eta,
        n_H,
        *rates,
        substrate.nu,
        film.nu,
        substrate.K_beta,
        film.K_beta,
        1.0 / (math.pi * substrate.hardness_to_yield),
        n_H / (math.pi * film_k),
        *bodies.bounds(),
        films / np.maximum(film_aspect, 1e-100),
        first,
        second,
        share,
        films,
        (nu_first + nu) / 2.0,
        (nu_second + nu) / 2.0,
    )
    return np.stack(np.broadcast_arrays(*columns), axis=1)


def _regimes(parameters, tau, parts) -> list[Regime]:
    """Return one regime for each part of the law of asperities on graded films, in the order of `parts`.

    parameters: (n, PARAMETERS) of the law. tau (n,): film thickness in units of sigma. parts: state and body of each part, such
    as ("elastic", "film").
    """
    edges, part, levels, branch = find_kinks(parameters, tau)
    columns = (*parameters.T, *levels.T)
    return [
        Regime(
            along,
            coordinate,
            columns,
            gather(edges, part, number),
            state,
            body,
            branch=branch,
            yields_by_degrees=state == "plastic",
        )
        for number, (state, body) in enumerate(parts)
    ]


def regimes(groups: Groups, law: Law) -> list[Regime]:
    """Return the regimes of a surface with a graded film.

    A regime is a segment of an asperity law together with the tangential force on it. Forces are in units of K R^(1/2)
    sigma^(3/2), with K = (4/3) E* of the substrate. groups: dimensionless groups of n coated contacts. `law` is not used,
    because this film law has its own asperity law.
    """
    bodies = TwoBodies.of(groups)
    return _film_regimes(
        groups.substrate(), groups.film(), bodies, groups.n_H, groups.tau, groups.film_aspect, groups.n_g, (2, 1)
    )


RECORD = FilmLaw(
    key="graded",
    title="One asperity law whose modulus and hardness depend on depth",
    grade="C",
    sources=(
        Source("gao_chiu_lee_1992", "I0: modulus of film and substrate against t/a"),
        Source(
            "bhattacharya_nix_1988", "hardness against depth", "sources disagree on the exponent; here 2 if soft, 1 if hard"
        ),
        Source("zhao_maietta_chang_2000", "elastic to fully plastic", "as a function of elastic mean pressure, not of depth"),
        Source("soft_coating_2015", "asperities, sum over heights and friction"),
    ),
    regimes=regimes,
    verified="a second implementation, for six contacts; bare surface at n_E = n_H = 1, substrate for tau -> 0, film for "
    "tau -> infinity",
    needs=("theta", "lam", "n_E", "n_H", "tau", "film_aspect"),
    takes=("hardness_to_yield",),
    required_traits={"2015": "it needs the asperity law roy_chowdhury_ghosh_1994"},
    own_asperity=True,
    one_body=True,
    tangential="soft_coating_2015",
    load_is_monotonic=False,
    accuracy=2e-9,  # the worst of 400 000 parameter sets of the whole range; 1 in 10 000 is above 1e-10
    notes="This project's own composition. Where the load of an asperity would fall with growing displacement, it is kept "
    "constant until the law gives this load again.",
)
