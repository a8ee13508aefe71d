"""The asperity of the 2015 paper, normal and tangential: JKR until its mean pressure reaches the hardness, then plastic;
elastic, it resists shear until it peels (Savkoor & Briggs) or yields (Hamilton, von Mises); plastic, not at all.

Its regimes, for a bare surface or for one of the two bodies of a coated one (docs/theory.md, sections 2 to 4).
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from ..asperity import chowdhury_ghosh_1994 as plastic
from ..asperity import jkr
from ..asperity.regime import Regime
from ..compiled import formula, kernel
from .edge_yield import yield_resistance
from .savkoor_briggs_1977 import slip_resistance, slip_resistance_printed
from .slip_or_yield import LOADING_EDGES, UNLOADING_EDGES, fill_edges

_adhesion, _displacement, _stretch, _load = jkr.adhesion, jkr.displacement, jkr.stretch, jkr.load
_area, _coordinate = jkr.area, jkr.coordinate
_plastic_load, _plastic_area = plastic.plastic_load, plastic.plastic_area


@dataclass(frozen=True)
class Asperity:
    """The groups that decide an asperity of one body; arrays (n,).

    theta, lam: adhesion indices of that body; K_beta, nu, k: its stiffness group, Poisson's ratio and hardness over
    yield stress. printed: the reading to the letter, in which the slip resistance is eq (10) and heights are weighed at
    the apparent displacement.
    """

    theta: np.ndarray
    lam: np.ndarray
    K_beta: np.ndarray
    nu: np.ndarray
    k: np.ndarray
    printed: bool = False

    @property
    def eta(self) -> np.ndarray:
        return plastic.hardness_group(self.theta, self.lam)

    @property
    def S(self) -> np.ndarray:
        return np.sqrt(6.0 * math.pi / self.theta)

    def kinks(self, unloading: bool = False) -> tuple[np.ndarray, np.ndarray]:
        """Edges (n, m) in u of the elastic regime, from first contact to yield, and the branch point (n,)."""
        laws = len(self.theta)
        edges = np.empty((laws, UNLOADING_EDGES if unloading else LOADING_EDGES))
        branch = np.empty(laws)
        fill_edges(self.S, self.eta, self.K_beta, self.nu, self.k, self.printed, unloading, edges, branch)
        return edges, branch


# Eqs (12)-(15) weigh the resistance with exp(-z^2/2) in place of phi(z) (D3).
PRINTED_GRIP = math.sqrt(2.0 * math.pi)


@dataclass(frozen=True)
class Share:
    """What of an asperity's response counts: it starts at the displacement `shift`; its load is multiplied by `force`, its
    resistance by `grip`, its contact area by `cover`. Arrays (n,) or numbers."""

    shift: np.ndarray | float = 0.0
    force: np.ndarray | float = 1.0
    grip: np.ndarray | float = 1.0
    cover: float = 1.0


@formula
def elastic(u, theta, eta, K_beta, nu, k, shift, force, grip, cover):
    """The elastic asperity at u = x^(1/4): displacement, its slope, load, area, slip- and yield-limited resistance."""
    S = _adhesion(theta)
    x, P = _area(u), _load(u, S)
    slip = slip_resistance(P, theta, K_beta)
    tear = yield_resistance(P, eta * x / (math.pi * k), nu)
    slips = slip <= tear
    return (
        shift + _displacement(u, S),
        _stretch(u, S),
        force * P,
        cover * x,
        grip * slip if slips else 0.0,
        0.0 if slips else grip * tear,
    )


@formula
def elastic_coordinate(w, theta, eta, K_beta, nu, k, shift, force, grip, cover):
    return _coordinate(w - shift, _adhesion(theta))


@formula
def elastic_printed(u, theta, eta, K_beta, nu, k, shift, force, grip, cover):
    """As `elastic`, to the letter of eqs (1) and (10): heights are weighed at the apparent displacement x."""
    x, P = _area(u), _load(u, _adhesion(theta))
    slip = slip_resistance_printed(x, theta, K_beta)
    tear = yield_resistance(P, eta * x / (math.pi * k), nu)
    slips = slip <= tear
    return x, 4.0 * u * u * u, force * P, cover * x, grip * slip if slips else 0.0, 0.0 if slips else grip * tear


@formula
def elastic_printed_coordinate(x, theta, eta, K_beta, nu, k, shift, force, grip, cover):
    return max(x, 0.0) ** 0.25


@formula
def plastic_flow(w, theta, eta, shift, force, cover):
    """The plastic asperity at its real displacement w."""
    return shift + w, 1.0, force * _plastic_load(w, theta, eta), cover * _plastic_area(w), 0.0, 0.0


@formula
def plastic_coordinate(w, theta, eta, shift, force, cover):
    return w - shift


def onset_of_plasticity(asperity: Asperity, edges: np.ndarray) -> np.ndarray:
    """w1 (n,): the displacement at the end of the elastic regime with these edges (eq 4)."""
    u1 = edges[:, -1]
    return u1 * (u1**3 - 2.0 / 3.0 * asperity.S)


def elastic_regime(asperity: Asperity, edges: np.ndarray, branch: np.ndarray, share: Share, **labels) -> Regime:
    """The elastic asperity between the first and the last of `edges` (n, m)."""
    parameters = (asperity.theta, asperity.eta, asperity.K_beta, asperity.nu, asperity.k)
    along, coordinate = (
        (elastic_printed, elastic_printed_coordinate) if asperity.printed else (elastic, elastic_coordinate)
    )
    share_of = (share.shift, share.force, share.grip, share.cover)
    return Regime(along, coordinate, parameters + share_of, edges, "elastic", branch=branch, **labels)


def plastic_regime(asperity: Asperity, first: np.ndarray, last: np.ndarray | float, share: Share, **labels) -> Regime:
    """The plastic asperity between the displacements `first` and `last`."""
    edges = np.stack(np.broadcast_arrays(first, last), axis=1)
    parameters = (asperity.theta, asperity.eta, share.shift, share.force, share.cover)
    return Regime(plastic_flow, plastic_coordinate, parameters, edges, "plastic", **labels)


def bare_regimes(asperity: Asperity, unloading: bool = False, share: Share = Share(), **labels) -> list[Regime]:
    """Both regimes of one body, from first contact (unloading: from the smallest contact that holds) without end."""
    edges, branch = asperity.kinks(unloading)
    elastic_part = elastic_regime(asperity, edges, branch, share, **labels)
    if unloading:
        u = edges[:, 0]
        elastic_part = replace(elastic_part, lowest=float(np.min(u * (u**3 - 2.0 / 3.0 * asperity.S), initial=0.0)))
    first = onset_of_plasticity(asperity, edges)
    return [elastic_part, plastic_regime(asperity, first, np.inf, share, **labels)]


@kernel
def _states_at(u, theta, eta, K_beta, nu, k, out):
    for i in range(u.size):
        state = elastic(u[i], theta[i], eta[i], K_beta[i], nu[i], k[i], 0.0, 1.0, 1.0, 1.0)
        out[i, 0], out[i, 1], out[i, 2] = state[2], state[4], state[5]


@kernel
def _coordinates_at(w, S, out):
    for i in range(w.size):
        out[i] = _coordinate(w[i], S[i])


def coordinate_at(asperity: Asperity, w: np.ndarray) -> np.ndarray:
    """u (n,) of the elastic asperity at the real displacement w (n,)."""
    out = np.empty(len(w))
    _coordinates_at(np.ascontiguousarray(w), asperity.S, out)
    return out


def held(asperity: Asperity, w: np.ndarray, u: np.ndarray) -> np.ndarray:
    """Load, slip- and yield-limited resistance (n, 3) of one asperity at the displacement w (n,); u: its coordinate there
    if it is elastic."""
    out = np.empty((len(w), 3))
    _states_at(u, asperity.theta, asperity.eta, asperity.K_beta, asperity.nu, asperity.k, out)
    flows = w >= onset_of_plasticity(asperity, asperity.kinks()[0])
    out[flows] = 0.0
    out[flows, 0] = (2.0 * asperity.eta * w - 2.0 * math.pi / asperity.theta)[flows]
    return out
