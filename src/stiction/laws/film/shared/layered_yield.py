"""Find where an asperity on a bonded film yields, and compute its plastic response beyond yield.

The asperity yields where its mean pressure reaches the value at which its asperity law yields on a uniform half-space. This
half-space has the modulus E_P of film and substrate together at this contact radius, and their hardness chi at this depth; the
depth does not include the stretch by adhesion. Beyond yield, the plastic segments of the asperity law on this half-space are
shifted to the displacement, load and area of the contact on the film. Their load, without the adhesion, is proportional to the
hardness at their depth.
"""

from dataclasses import replace
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula, lazy_kernel, unpack
from stiction.engine.crossings import narrowing
from stiction.engine.regime import columns
from stiction.laws.joining import Law, normal_states
from stiction.laws.segment import NormalSegment
from stiction.records.registry import Composite
from stiction.solvers.layered.asperity import _hertzian, edged, touch

_STEP, _FARTHEST = 1.5, 1e30
# Largest number of iterations: with adhesion the pressure at yield depends on the modulus there.
_ROUNDS = 6


class Hardness:
    """Hold the hardness chi of film and substrate together as a function of the displacement, for n contacts.

    chi is divided by the substrate's hardness. `value` is the formula, `row` its parameters (n,): film hardness divided by
    the substrate's, film thickness in units of sigma, constant, exponent. `depths` (n, m) are displacements in units of
    sigma at which an integral is split.
    """

    def __init__(self, record: Composite, groups: Groups, soft_film_exponent: float):
        laws = len(groups)
        tau = np.broadcast_to(groups.tau, laws)
        self.value = record.value
        self.n_H = np.where(tau > 0.0, groups.n_H, 1.0)
        self.tau = np.maximum(tau, 1e-100)
        self.exponent = np.where(self.n_H < 1.0, soft_film_exponent, 3.0 - soft_film_exponent)
        self.constant = (
            record.constants(np.where(tau > 0.0, groups.n_E, 1.0), self.n_H, self.n_H) if record.constants else self.n_H
        )
        places = record.landmarks(self.constant, self.exponent) if record.landmarks else np.empty((laws, 0))
        self.depths = self.tau[:, None] * places[:, ::2]  # every second landmark is enough for the accuracy of the law

    @property
    def row(self) -> tuple[np.ndarray, ...]:
        return self.n_H, self.tau, self.constant, self.exponent


@cache
def _onset(along: Any, hardness: Any, parameters: int) -> Any:
    """Return a kernel that finds where an asperity on a film first yields.

    It yields where its mean pressure equals a given constant times the hardness. along: formula of the elastic asperity, with
    `parameters` parameters. hardness: formula of the hardness.
    """
    edge = along is edged

    @formula
    def excess(u, arguments):
        """Return the load at the coordinate u minus the load at which a contact of the same area would yield.

        It is negative before yield. arguments: parameters of the asperity, mean pressure at which a body of the substrate's
        hardness would yield, parameters of the hardness.
        """
        row, pressure, (n_H, tau, constant, exponent) = arguments
        _, _, load, area = along(u, *row)
        chi = hardness(n_H, _hertzian(u, row)[3] * area / tau, constant, exponent)
        return load - area * pressure * chi

    narrow = narrowing(excess)

    @lazy_kernel(worth=300)
    def find(table, pressure, of_hardness, out):
        """Fill out[i] with coordinate u, modulus, hardness, z, and displacement in units of sigma at first yield of contact i.

        The displacement does not include the stretch by adhesion. Modulus and hardness are those of film and substrate
        together divided by the substrate's. z selects Poisson's ratio: -1 for the film's, 1 for the substrate's. table:
        parameters of the elastic asperities. pressure: eta times the ratio of the mean pressure at yield to the hardness.
        of_hardness: parameters of `Hardness`.
        """
        for i in range(pressure.size):
            row, hard = unpack(table[i], parameters), unpack(of_hardness[i], 4)
            low = touch(row) if edge else 1e-8
            least = min(hard[0], 1.0) * max(pressure[i], 0.0) * min(np.exp(-row[0]), 1.0)
            low = max(low, 0.5 * np.sqrt(least))
            arguments = row, pressure[i], hard
            u, value = low, excess(low, arguments)
            below = value
            while value < 0.0 and u < _FARTHEST:
                low, below = u, value
                u *= _STEP
                value = excess(u, arguments)
            if below < 0.0:
                u = narrow(low, u, below, value, arguments)
            z, _, modulus, approach, _, _ = _hertzian(u, row)
            depth = approach * u**4
            chi = hardness(hard[0], depth / hard[1], hard[2], hard[3])
            out[i, 0], out[i, 1], out[i, 2], out[i, 3], out[i, 4] = u, modulus, chi, z, depth

    return find


def half_space_at_yield(groups: Groups, modulus: np.ndarray, hardness: np.ndarray, place: np.ndarray) -> Groups:
    """Return the dimensionless groups (n,) of the uniform half-space that replaces film and substrate at first yield.

    groups: dimensionless groups of n coated contacts. modulus, hardness (n,): modulus of the half-space divided by the bare
    bodies', and its hardness divided by the substrate's. place (n,): -1 for Poisson's ratio of the film, 1 for the substrate's,
    linear in between. The work of adhesion is the film's.
    """
    theta, lam, tabor, eta = groups.theta, groups.lam, groups.tabor_parameter, groups.hardness_group
    return groups.substrate().with_changes(
        theta=None if theta is None else theta * modulus / groups.n_g,
        lam=None if lam is None else lam * (hardness * hardness / (modulus * groups.n_g)) ** 2,
        hardness_group=None if eta is None else eta * hardness / modulus,
        nu=0.5 * ((1.0 - place) * groups.film_nu + (1.0 + place) * groups.nu),
        tabor_parameter=None if tabor is None else tabor * (groups.n_g / modulus) ** (2.0 / 3.0),
    )


def cut_at_yield(
    elastic: NormalSegment, law: Law, groups: Groups, hardness: Hardness, pull: np.ndarray
) -> tuple[NormalSegment, list[NormalSegment]]:
    """Return the elastic segment of an asperity on a film up to yield, and a list of the plastic segments that follow.

    elastic: the segment without yield. law: asperity law. groups: dimensionless groups of n coated contacts with all defaults
    filled in. hardness: hardness of film and substrate together. pull (n,): adhesive force on a plastic asperity. If the
    asperity law has no yield, `elastic` is returned unchanged with an empty list.
    """
    ones = np.ones(len(groups))
    segments = law.segments(half_space_at_yield(groups, groups.n_E, hardness.n_H, -ones))
    if all(segment.state == "elastic" for segment in segments):
        return elastic, []
    table, of_hardness = columns(elastic.parameters, len(groups)), columns(hardness.row, len(groups))
    find, at_yield = _onset(elastic.normal, hardness.value, len(elastic.parameters)), np.empty((len(groups), 5))
    own, of_yield = half_space_at_yield(groups, groups.n_E, hardness.n_H, -ones), ones
    for _ in range(_ROUNDS):
        before, of_yield = of_yield, _pressure_at_yield(segments, own)
        find(table, groups.eta * of_yield, of_hardness, at_yield)
        own = half_space_at_yield(groups, *at_yield[:, 1:4].T)
        segments = law.segments(own)
        if np.allclose(of_yield, before, rtol=1e-9, atol=0.0):
            break
    last = np.maximum(at_yield[:, 0], elastic.edges[:, 0])
    until = replace(elastic, edges=np.minimum(elastic.edges, last[:, None]))
    return until, _plastic_segments(until, segments, at_yield, hardness, pull)


def _pressure_at_yield(segments: list[NormalSegment], own: Groups) -> np.ndarray:
    """Return the ratio (n,) of mean pressure to hardness at the end of the last elastic segment.

    segments: segments of an asperity law. own: dimensionless groups of the uniform half-space that replaces film and substrate,
    for which `segments` were computed.
    """
    last = _last_elastic(segments)
    _, _, load, area = normal_states(last, last.edges[:, -1]).T
    return load / (area * own.eta)


def _last_elastic(segments: list[NormalSegment]) -> NormalSegment:
    return next(before for before, after in pairwise(segments) if after.state != "elastic")


def _plastic_segments(elastic, segments, at_yield, hardness: Hardness, pull) -> list[NormalSegment]:
    """Return the plastic segments of an asperity law, shifted to start where the asperity on a film yields.

    elastic: segment of the asperity on the film up to yield. segments: segments of the asperity law on the uniform half-space
    that replaces film and substrate at yield. at_yield (n, 5): u, modulus, hardness, z and displacement at yield. pull (n,):
    adhesive force on a plastic asperity.
    """
    first, last = _last_elastic(segments), elastic.edges[:, -1]
    w, _, load, area = normal_states(elastic, last).T
    own_w, _, own_load, own_area = normal_states(first, first.edges[:, -1]).T
    modulus, hardness_at_yield = at_yield[:, 1], at_yield[:, 2]
    shallower = at_yield[:, 4] - w
    move = (
        w - own_w,
        load - modulus * own_load,
        modulus,
        area - own_area,
        pull,
        1.0 / hardness_at_yield,
        shallower,
        *hardness.row,
    )
    moved = []
    for segment in segments:
        if segment.state == "elastic":
            continue
        normal, coordinate = _shifted_formulas(segment.normal, segment.coordinate, hardness.value, len(segment.parameters))
        shifted = NormalSegment(normal, coordinate, (*segment.parameters, *move), segment.edges, segment.state)
        kinks = _coordinates_at(shifted, hardness.depths - shallower[:, None])
        moved.append(replace(shifted, edges=np.sort(np.concatenate([segment.edges, kinks], axis=1), axis=1)))
    return moved


def _coordinates_at(segment: NormalSegment, w: np.ndarray) -> np.ndarray:
    """Return the coordinates (n, m) of a segment at the displacements w (n, m), clipped to it; w: in units of sigma."""
    out, edges = np.empty(w.shape), np.ascontiguousarray(segment.edges)
    fill = _filling(segment.normal, segment.coordinate, len(segment.parameters))
    fill(np.ascontiguousarray(w), columns(segment.parameters, len(w)), edges, out)
    return out


@cache
def _filling(normal: Any, coordinate: Any, parameters: int) -> Any:
    @lazy_kernel(worth=300)
    def fill_places(w, table, edges, out):
        for i in range(w.shape[0]):
            row = unpack(table[i], parameters)
            first, last = edges[i, 0], edges[i, edges.shape[1] - 1]
            w_first, w_last = normal(first, *row)[0], normal(last, *row)[0]
            for j in range(w.shape[1]):
                inside = w_first < w[i, j] < w_last
                out[i, j] = (
                    min(max(coordinate(w[i, j], *row), first), last) if inside else first if w[i, j] <= w_first else last
                )

    return fill_places


@cache
def _shifted_formulas(normal: Any, coordinate: Any, hardness: Any, parameters: int) -> tuple[Any, Any]:
    """Return the formulas `along` and `back` of a plastic segment, shifted to start where a coated asperity yields.

    along(u) returns displacement, its derivative, load and area; back(w) returns u at the displacement w. normal,
    coordinate: formulas of the segment, with `parameters` parameters. hardness: formula of the hardness. The returned
    formulas take these parameters, then: shift of displacement and load, modulus, shift of the area, pull, reciprocal of
    the hardness at yield, depth minus displacement, and the parameters of the hardness.
    """

    @formula
    def along(u, *row):
        w, stretch, load, area = normal(u, *row[:parameters])
        more_w, more_load, modulus, more_area, pull, per_hardness, more_depth, n_H, tau, constant, exponent = row[parameters:]
        w += more_w
        share = per_hardness * hardness(n_H, max(w + more_depth, 0.0) / tau, constant, exponent)
        return w, stretch, (modulus * load + more_load + pull) * share - pull, area + more_area

    @formula
    def back(w, *row):
        return coordinate(w - row[parameters], *row[:parameters])

    return along, back
