"""Find where in the (theta, lambda) plane of the adhesion indices each claim of the 2015 paper holds.

docs/explanation/claims.md has the results. Each claim is tested by a number, computed for each film that the claim concerns,
and a bound on this number. Coated and uncoated surfaces are compared at the same load, over the paper's films and separations h
= 4 to -4 (h is the mean separation over sigma):

- The reference load is the load that the uncoated surface carries at h = -4. *Light load* is 1/1000 of it (h about 2, where
  under 3 % of the asperities touch), *moderate load* 1/100 (h about 1).
- A curve is followed on approach, from its largest tension. Results at a load belong to the first separation that carries
  this load.
- A film is not comparable if a surface does not carry that load within the range of h, or if the uncoated surface has no
  friction.

Claim (d) fails nearly everywhere: friction that looks level on linear axes has become small and goes on falling.
The paper prints no contact area; for claim (e) it is computed by an analogue of its eq. (1).
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from stiction.quantities.quotient import quotient
from stiction.studies.paper.figures import FILM_VALUES, H_RANGE

# The two variants of the paper's model, and the paper's asperities on an exactly solved film.
VARIANTS = ("corrected", "published", "layered")
THETA = np.geomspace(1.0, 1e4, 25)
LAM = np.geomspace(1e-3, 1e4, 25)
LIGHT, MODERATE = 1e-3, 1e-2  # loads over the reference load
_FEW = 0.03  # fraction of the plane that `where` neglects
_TELLS = 1.0 / 3.0  # fraction that bounds must classify correctly of the points that a rule without bounds gets wrong
_H = np.linspace(*H_RANGE, 161)
_N_E, _N_H, _TAU = (np.array(values) for values in FILM_VALUES.values())
_STIFF = _N_E > 1.0


@dataclass(frozen=True)
class Curves:
    """Store dimensionless load, contact area and friction force, arrays (..., separations) in order of approach.

    The last dimension runs over the separations _H, the dimensions before it over adhesion indices and films.
    """

    load: np.ndarray
    contact_area: np.ndarray
    friction_force: np.ndarray

    def at(self, load: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return contact area and friction force at the first separation on approach that carries a load; NaN if none does.

        load: broadcasts to the leading dimensions of the curves; the results are also NaN for a load that is not above 0.
        Curves are followed from their largest tension. Linear interpolation between separations 0.05 sigma apart is accurate to
        about 1e-3.
        """
        after_tension = np.arange(_H.size) > np.argmin(self.load, axis=-1, keepdims=True)
        reached = after_tension & (self.load >= load[..., None])
        last = np.argmax(reached, axis=-1)[..., None]
        first = np.maximum(last - 1, 0)

        def ends(values: np.ndarray) -> list[np.ndarray]:
            return [np.take_along_axis(values, at, -1)[..., 0] for at in (first, last)]

        below, above = ends(self.load)
        carried = reached.any(axis=-1) & (above > below) & (load > 0.0)
        share = np.where(carried, (load - below) / np.where(carried, above - below, 1.0), np.nan)
        area, friction = (start + share * (stop - start) for start, stop in map(ends, (self.contact_area, self.friction_force)))
        return area, friction


@dataclass(frozen=True)
class Surfaces:
    """Hold load, area and friction of the uncoated surface and of all films at n pairs (theta, lambda).

    bare: Curves with arrays (n, 1, 1, 1, separations). films: Curves with arrays (n, n_E, n_H, tau, separations) over the
    film's modulus and hardness relative to the body and its thickness over sigma.
    """

    bare: Curves
    films: Curves

    def ratio(self, over_reference: float, quantity: int) -> np.ndarray:
        """Return a result of the coated surface over the same result of the uncoated one at equal load, (n, n_E, n_H, tau).

        over_reference: ratio of the load to the reference load, which the uncoated surface carries at h = -4. quantity: 0 for
        contact area, 1 for friction force, whose ratio is also the ratio of friction coefficients. The ratio is NaN if a
        surface does not carry the load, or if the uncoated surface has no friction.
        """
        load = over_reference * self.bare.load[..., -1]
        bare, coated = self.bare.at(load)[quantity], self.films.at(np.broadcast_to(load, self.films.load.shape[:-1]))[quantity]
        return quotient(coated, bare)


def _stiff_film_friction(surfaces: Surfaces) -> np.ndarray:
    ratios = [surfaces.ratio(load, 1)[:, _STIFF] for load in (LIGHT, MODERATE)]
    return np.maximum(*ratios)


def _stiff_film_spread(surfaces: Surfaces) -> np.ndarray:
    ratios = surfaces.ratio(LIGHT, 1)[:, _STIFF]
    return ratios.max(axis=(2, 3)) - ratios.min(axis=(2, 3))


def _compliant_film_friction(surfaces: Surfaces) -> np.ndarray:
    chosen = np.ix_(_N_E == 0.5, _N_H == 0.8)
    ratios = [surfaces.ratio(load, 1)[:, chosen[0], chosen[1]] for load in (LIGHT, MODERATE)]
    return np.minimum(*ratios)


def _change_at_high_load(surfaces: Surfaces) -> np.ndarray:
    columns = []
    for curves in (surfaces.bare, surfaces.films):
        end = curves.load[..., -1:]
        late = (curves.load >= end / 2.0) & (end > 0.0) & (curves.friction_force > 0.0)
        mu = np.where(late, quotient(curves.friction_force, curves.load), np.nan)
        change = np.fmax.reduce(mu, axis=-1) / np.fmin.reduce(mu, axis=-1)
        columns.append(change.reshape(len(change), -1))
    return np.concatenate(columns, axis=1)


def _thin_film_area(surfaces: Surfaces) -> np.ndarray:
    return surfaces.ratio(LIGHT, 0)[..., _TAU == _TAU.min()]


@dataclass(frozen=True)
class Claim:
    """Define one claim of the paper as a test: it holds for a case if a number lies on the right side of a bound.

    A case is one film, all films with one n_E, or the uncoated surface. key: letter. says: the claim. number, cases: texts on
    what is computed, and for which cases. measure: function that computes the numbers from the curves. below: whether the claim
    holds below the bound, or above it.
    """

    key: str
    says: str
    number: str
    cases: str
    measure: Callable[[Surfaces], np.ndarray]
    bound: float
    below: bool

    @property
    def definition(self) -> str:
        """Return the test of the claim as one line, `NUMBER < BOUND, for CASES` (or `>`)."""
        return f"{self.number} {'<' if self.below else '>'} {self.bound:g}, for {self.cases}"

    def judge(self, surfaces: Surfaces) -> tuple[np.ndarray, np.ndarray]:
        """Return the fraction of comparable cases for which the claim holds, and the worst number, each (n,).

        surfaces: curves at n pairs (theta, lambda). The worst number is the largest if the claim holds below its bound, else
        the smallest. The results are NaN if no case is comparable.
        """
        numbers = self.measure(surfaces).reshape(len(surfaces.bare.load), -1)
        known = np.isfinite(numbers)
        count = known.sum(axis=1)
        holds = known & (numbers < self.bound if self.below else numbers > self.bound)
        share = quotient(holds.sum(axis=1), count)
        worst = np.where(known, numbers, -np.inf).max(axis=1) if self.below else np.where(known, numbers, np.inf).min(axis=1)
        return share, np.where(count > 0, worst, np.nan)


CLAIMS = (
    Claim(
        "a",
        "a film stiffer than its substrate lowers friction to less than half",
        "largest mu coated / mu uncoated at light and moderate load",
        "n_E = 1.5, 2.5 and every n_H, tau",
        _stiff_film_friction,
        0.5,
        True,
    ),
    Claim(
        "b",
        "friction with a film stiffer than its substrate hardly depends on the thickness or hardness of the film at light load",
        "(largest - smallest mu of all n_H and tau) / mu uncoated at light load",
        "n_E = 1.5, 2.5",
        _stiff_film_spread,
        0.2,
        True,
    ),
    Claim(
        "c",
        "a film more compliant than its substrate raises friction (figure 3)",
        "smallest mu coated / mu uncoated at light and moderate load",
        "n_E = 0.5, n_H = 0.8 and every tau",
        _compliant_film_friction,
        1.0,
        False,
    ),
    Claim(
        "d",
        "friction levels off at high load",
        "largest / smallest mu in the upper half of the loads that a surface carries down to h = -4",
        "the uncoated surface and every film",
        _change_at_high_load,
        1.1,
        True,
    ),
    Claim(
        "e",
        "a thin soft film raises the real contact area at light load",
        "area coated / area uncoated at light load",
        "tau = 2 and every n_E, n_H",
        _thin_film_area,
        1.0,
        False,
    ),
)


@dataclass(frozen=True)
class ClaimMap:
    """Hold the results of all claims over the plane of the indices theta and lambda (`lam`).

    share, worst (claims, variants, theta, lam): fraction of the comparable cases for which a claim holds, and the number
    farthest on the wrong side of the bound (see Claim.judge); NaN if no case is comparable.
    """

    theta: np.ndarray
    lam: np.ndarray
    share: np.ndarray
    worst: np.ndarray


def surfaces_at(theta: float, lam: np.ndarray, variant: str) -> Surfaces:
    """Return the curves of every surface of the paper, at one theta and each lambda of `lam` (n,), for one of VARIANTS."""
    from stiction.solving.evaluate import evaluate
    from stiction.studies.paper.layered import LAYERED

    if variant == LAYERED:
        return _layered_surfaces(theta, np.asarray(lam, dtype=float))
    lam = np.asarray(lam, dtype=float).reshape(-1, 1, 1, 1, 1)
    film: dict[str, Any] = {"n_E": _N_E[:, None, None, None], "n_H": _N_H[:, None, None], "tau": _TAU[:, None]}
    bare = evaluate(_H, theta, lam, variant=variant)
    return Surfaces(Curves(*bare), Curves(*evaluate(_H, theta, lam, **film, variant=variant)))


def _layered_surfaces(theta: float, lam: np.ndarray) -> Surfaces:
    from stiction.studies.paper.layered import totals

    shape = len(lam), _N_E.size, _N_H.size, _TAU.size
    each, *films = (one.ravel() for one in np.meshgrid(lam, _N_E, _N_H, _TAU, indexing="ij"))
    bare = (one.reshape(-1, 1, 1, 1, _H.size) for one in totals(theta, lam, _H))
    coated = (one.reshape(*shape, _H.size) for one in totals(theta, each, _H, tuple(films)))
    return Surfaces(Curves(*bare), Curves(*coated))


def claim_map(theta: np.ndarray = THETA, lam: np.ndarray = LAM, progress: Callable[[list], Iterable] = iter) -> ClaimMap:
    """Test every claim at every pair of theta and lam, for every variant of the paper's model.

    theta, lam: adhesion indices, one-dimensional arrays. progress: receives the list of steps and returns an iterable over it.
    """
    results = np.empty((2, len(CLAIMS), len(VARIANTS), len(theta), len(lam)))
    steps = [(row, column) for row in range(len(VARIANTS)) for column in range(len(theta))]
    for row, column in progress(steps):
        surfaces = surfaces_at(float(theta[column]), lam, VARIANTS[row])
        for at, claim in enumerate(CLAIMS):
            results[:, at, row, column] = claim.judge(surfaces)
    return ClaimMap(np.asarray(theta), np.asarray(lam), *results)


def where(claims: ClaimMap, chosen: np.ndarray) -> str:
    """Return a text that describes where the chosen points lie in the (theta, lambda) plane.

    chosen: mask (theta, lam). The text names one or two bounds on theta, lambda or the hardness group eta that best separate
    the chosen points from the others, and the fraction of points that these bounds classify correctly. It is "everywhere" or
    "nowhere" if all points or none are chosen, and "almost everywhere" or "almost nowhere" if this holds except for less than 3
    % of the points. It is "scattered" if the bounds correct less than a third of the errors made without bounds.
    """
    share = float(np.mean(chosen))
    if share in (0.0, 1.0):
        return "everywhere" if share else "nowhere"
    if min(share, 1.0 - share) < _FEW:
        return "almost everywhere" if share > 0.5 else "almost nowhere"
    names, sides = _bounds(claims)
    wanted = np.where(chosen.ravel(), 1, -1)
    # Number of points that each pair of bounds classifies correctly: chosen inside both, others outside. Bound 0 includes all.
    right = np.sum(wanted < 0) + (sides * wanted) @ sides.T
    one, two = np.argmax(right[0]), np.unravel_index(np.argmax(right), right.shape)
    blind = max(right[0, 0], wanted.size - right[0, 0])  # correct points without any bound
    if right[two] - blind < _TELLS * (wanted.size - blind):
        return "scattered"
    best = {int(one)} if right[two] - right[0, one] < _FEW * wanted.size else {int(at) for at in two}
    accuracy = right[two if len(best) > 1 else (0, one)] / wanted.size
    return f"{', '.join(names[at] for at in sorted(best))} (true of {accuracy:.0%})"


def _bounds(claims: ClaimMap) -> tuple[list[str], np.ndarray]:
    """Return candidate bounds on theta, lambda and eta: their names, and an array (bounds, points) of 1 inside and 0 outside.

    The bounds lie halfway between the logarithms of neighbouring points. The first bound has no name and includes all points.
    """
    theta, lam = (grid.ravel() for grid in np.meshgrid(claims.theta, claims.lam, indexing="ij"))
    eta = np.sqrt(np.pi) * 18.0**0.25 * lam**0.25 * theta**-0.5  # theory.md, theory 1
    names, sides = [""], [np.ones(theta.size, dtype=int)]
    for name, values in (("theta", theta), ("lambda", lam), ("eta", eta)):
        steps = np.unique(np.round(np.log(values), 9))
        for edge in np.exp((steps[:-1] + steps[1:]) / 2.0):
            bound = f"{float(f'{edge:.2g}'):g}"
            names += [f"{name} > {bound}", f"{name} < {bound}"]
            sides += [(values > edge).astype(int), (values < edge).astype(int)]
    return names, np.array(sides)


def summary(claims: ClaimMap, theta: float, lam: float) -> list[dict]:
    """Return one dict of results for each claim and each variant of the paper's model.

    The dict names the claim and the variant. It has four fractions of the plane: where the claim holds for all, for some and
    for none of its comparable cases, and where no case is comparable; texts on where it holds for all and for none; and the
    results of `Claim.judge` at the given theta and lam, None if no case is comparable there.
    """
    rows = []
    here = [surfaces_at(theta, np.array([lam]), variant) for variant in VARIANTS]
    for at, claim in enumerate(CLAIMS):
        for row, variant in enumerate(VARIANTS):
            share = claims.share[at, row]
            share_here, worst_here = (None if np.isnan(value[0]) else float(value[0]) for value in claim.judge(here[row]))
            rows.append(
                {
                    "claim": claim.key,
                    "says": claim.says,
                    "definition": claim.definition,
                    "variant": variant,
                    "holds_for_all": float(np.mean(share == 1.0)),
                    "holds_for_some": float(np.mean((share > 0.0) & (share < 1.0))),
                    "holds_for_none": float(np.mean(share == 0.0)),
                    "not_comparable": float(np.mean(np.isnan(share))),
                    "where_all": where(claims, share == 1.0),
                    "where_none": where(claims, share == 0.0),
                    "share_here": share_here,
                    "worst_here": worst_here,
                }
            )
    return rows


def claim_rows(claims: ClaimMap) -> tuple[list[str], list[list]]:
    """Return column names and rows of the claim map as a table; NaN where no case is comparable."""
    heads = ["claim", "variant", "theta", "lambda", "share_holding", "worst"]
    rows = []
    for (at, row, i, j), share in np.ndenumerate(claims.share):
        claim, worst = CLAIMS[at], claims.worst[at, row, i, j]
        place = [float(claims.theta[i]), float(claims.lam[j])]
        rows.append([claim.key, VARIANTS[row], *place, float(share), float(worst)])
    return heads, rows
