r"""A sphere on a bonded film: exact elastic solution, adhesion by an energy balance, yield by mean pressure.

*Assumes*: the film is bonded to its body, the sphere is smooth, $a\ll R$, and there is no friction during loading. *Source*:
[perriot_barthel_2004] for the elastic solution, an integral equation that is derived and solved anew in `solvers/layered`;
[johnson_kendall_roberts_1971] for the energy of an adhesive edge, extended to layered bodies as in [barthel_perriot_2007]. The
contact radius is $a=\sqrt{xR\sigma}$, the film thickness $t$. Four functions of $a/t$ and of the elastic constants of film and
bodies describe the contact, each divided by its value for the bodies without film: $E_P$ for the load, $D$ for the
displacement, $E_S$ for the stiffness and $B$ for its derivative with respect to $a$. Index $H$ denotes the contact without
adhesion,

$$
\begin{aligned}
w_H&=D\,x,&P_H&=E_P\,x^{3/2},&\frac{dP_H}{dw_H}&=\tfrac32E_S\,x^{1/2},&A&=x\\
w&=w_H-\tfrac23S\sqrt{n_g/B}\;x^{1/4},&P&=P_H-S\,E_S\sqrt{n_g/B}\;x^{3/4}&&&&\text{(JKR)}
\end{aligned}
$$

with $S=\sqrt{6\pi/\theta}$; DMT's adhesion is $P=P_H-2\pi n_g/\theta$. In SI the displacement is
$\delta=\delta_H-\sqrt{4\pi a\gamma/k_n'}$ and the load $P=P_H-k_n\sqrt{4\pi a\gamma/k_n'}$, with the normal stiffness
$k_n=2aE_S$ and $k_n'=dk_n/da=2B$ ($E_S$ and $B$ in Pa).

*Bodies*: both bodies carry the same pressure, so their compliances add. This is exact for a film on one body against any other
body, and for films with half of the thickness on each of two bodies, equal or not. With `Indices`, the film is on one body and
the other body is rigid, unless `films` and the groups after it specify other bodies.

*Yield*: the asperity yields where its mean pressure reaches the value at which the chosen asperity law yields on a half-space
of modulus $E_P$ and hardness $\chi H$. $\chi$ is the hardness of film and substrate together divided by the substrate's, from
[`bhattacharya_nix_1988`](#bhattacharya_nix_1988) or another chosen law. Beyond yield, the plastic segments of the asperity law
follow, with the modulus and Poisson's ratio at yield, shifted to displacement, load and area of the layered contact. Their
load, without the adhesion, is proportional to the hardness at their depth. *Reconstructed*: this continuation. It equals the
asperity law for thin and for thick films, and if film and body are equal. With a hard film on a soft substrate, the load may
fall as the depth increases.

*Limit*: the asperity law on the substrate (with the film's work of adhesion) for $t\to0$ or for equal materials, and on the
film for $t\to\infty$. The only jumps are those of the asperity law. *Check*: $E_P=0.1219$, $D=0.693$, $E_S=0.2135$ for a rigid
sphere, $\nu=0.3$, $E_f/E_s=0.1$ (Young's modulus of film over substrate) and $a=t$.

*Symbols*: displacement $w=\omega/\sigma$, load $P$ in units of $KR^{1/2}\sigma^{3/2}$ and contact area $A$ in units of
$\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and $K=\tfrac43E^*$
($E^*$ contact modulus); $\theta=K\sigma^{3/2}/(\gamma R^{1/2})$ elastic adhesion index, $\gamma$ work of adhesion; $n_g$ work
of adhesion of the film divided by the substrate's; $\nu$ Poisson's ratio. Full list: [symbols](#1-units).
"""

from functools import cache
from typing import Any

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import lazy_kernel, unpack
from stiction.engine.regime import Regime, columns
from stiction.laws.film.shared.layered_rows import edge_pull, outer_pull, rows
from stiction.laws.film.shared.layered_yield import Hardness, cut_at_yield
from stiction.laws.joining import Law, normal_states
from stiction.laws.segment import NormalSegment, edges_at
from stiction.records.registry import FilmLaw, Limit, Validity, composites_of
from stiction.records.sources import Source
from stiction.solvers.layered.asperity import (
    EDGED,
    PLAIN,
    edged,
    edged_coordinate,
    plain,
    plain_coordinate,
    pulled_off,
    touch,
)

# Ratios of u to its value at a = t at which the elastic segment is split, because it changes over decades of a/t.
_CUTS = np.array([20.0, 400.0, 8000.0])


@cache
def _first(unloading: bool) -> Any:
    @lazy_kernel(worth=300)
    def fill_first(table, out):
        for i in range(out.size):
            row = unpack(table[i], EDGED)
            out[i] = pulled_off(row) if unloading else touch(row)

    return fill_first


def elastic(groups: Groups, law: Law) -> NormalSegment:
    """Return the segment of the elastic asperity on a bonded film, with the adhesion (none, DMT or JKR) of the asperity law.

    It begins at first touch or, for JKR and the option "unloading", at the loss of contact, and it has no end. groups:
    dimensionless groups of n coated contacts with all defaults filled in, from `Groups.resolved`. law: asperity law and
    options; only its kind of adhesion and the option "branch" are used.
    """
    laws, traits = len(groups), law.asperity.traits
    lowest = 0.0
    if "JKR" in traits:
        normal, coordinate, parameters = edged, edged_coordinate, rows(groups, edge_pull(groups))
        unloading, first = law.options.get("branch") == "unloading", np.empty(laws)
        _first(unloading)(columns(parameters, laws), first)
    else:
        pull = np.zeros(laws) if "no adhesion" in traits else outer_pull(groups)
        normal, coordinate, parameters = plain, plain_coordinate, rows(groups, pull)[:PLAIN]
        unloading, first = False, np.zeros(laws)
    cuts = np.maximum(_CUTS / parameters[1][:, None], first[:, None])
    edges = edges_at(first, *np.minimum(cuts, 1e100).T, np.inf)
    segment = NormalSegment(normal, coordinate, parameters, edges, "elastic", lowest)
    if unloading:
        lowest = float(np.min(normal_states(segment, first)[:, 0], initial=0.0))
        segment = NormalSegment(normal, coordinate, parameters, edges, "elastic", lowest)
    return segment


def regimes(groups: Groups, law: Law, hardness: str, soft_film_exponent: str) -> list[Regime]:
    """Return the regimes of a surface with a bonded film; results count the whole load as the film's.

    A regime is a segment of an asperity law together with the tangential force on it. Forces are in units of K R^(1/2)
    sigma^(3/2), with K = (4/3) E* of the substrate. groups: dimensionless groups of n coated contacts. law: asperity law and
    tangential law. hardness: key of the composite law for the hardness. soft_film_exponent: exponent m of that law for a soft
    film, "1" or "2"; a hard film has 3 - m.
    """
    resolved = groups.resolved()
    record: Any = composites_of("hardness")[hardness]
    pull = np.zeros(len(resolved)) if "no adhesion" in law.asperity.traits else outer_pull(resolved)
    first, following = cut_at_yield(
        elastic(resolved, law), law, resolved, Hardness(record, resolved, float(soft_film_exponent)), pull
    )
    return [law.join(segment, groups, body="film") for segment in (first, *following)]


RECORD = FilmLaw(
    key="layered",
    title="Sphere on a bonded film: exact elastic solution, adhesion by energy, yield by mean pressure",
    grade="C",
    sources=(
        Source("perriot_barthel_2004", "", "the integral equation; derived and solved again here"),
        Source("barthel_perriot_2007", "", "adhesion on a film by the energy balance of the edge; re-derived here"),
        Source("johnson_kendall_roberts_1971", "adhesion of a half-space, the limit of thick and thin films"),
        Source("bhattacharya_nix_1988", "", "hardness against depth, unless another law is chosen"),
    ),
    regimes=regimes,
    required_traits={"Hertz's shape": "it needs an asperity that is a Hertz, JKR or DMT contact while elastic"},
    tangential="interface",
    solved_as_one=True,
    composites={"hardness": "bhattacharya_nix_1988"},
    own_options={"soft_film_exponent": ("2", "1")},
    verified="integral equation solved by another method for 90 cases; minimum energy of adhesive contacts; the asperity law "
    "in the limits of zero and of infinite film thickness",
    needs=("nu", "n_E", "film_aspect", "films", "coated_share", "layer_nu", "coated_nu", "counter_nu"),
    validity=(Validity("n_E", 0.01, 100.0, "the elastic solution was checked only for these moduli"),),
    limits=(Limit("greenwood_williamson_1966", {"theta": 1.0, "lam": 1e24, "n_E": 1.0}, ("load", "contact_area"), 1e-6),),
    load_is_monotonic=False,
    accuracy=1e-7,
    notes="Film and substrate carry the same load; results count it as the film's. The law beyond yield is a reconstruction: "
    "modulus and Poisson's ratio keep their values at yield, and the hardness changes with depth as in indentation of a film.",
)
