"""Compute the tangential force of a rough surface from rest to sliding, asperity by asperity.

Each asperity first sticks, then slips from its rim inwards, and slides at its own displacement. The sum over asperities
therefore shows how many of them reach their full strength at the same time. Shear does not change the mean separation. For
each displacement, a separate tangential law is summed over the heights (equations: `laws/presliding/mindlin_1949.py`).
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Unpack

import numpy as np

from stiction.contact.subject import Subject, as_subject
from stiction.engine.blocks import blocks
from stiction.engine.heights import Heights
from stiction.laws.presliding.shared.partial_slip import slipping_law, sticking_area_law, sticking_law
from stiction.quantities.dimensions import aligned, dimensions
from stiction.quantities.errors import InputError, InWords
from stiction.quantities.inputs import floats
from stiction.quantities.keywords import with_keywords
from stiction.quantities.quotient import quotient
from stiction.solving.candidates import choice_of
from stiction.solving.choice import LawKeywords
from stiction.solving.on_map import MapProblem
from stiction.solving.points import coordinates_of, in_words, normalised, points_of, solve_points
from stiction.solving.problem import SLIP_LIMITED, AsperitySum, Problem, make_problem
from stiction.solving.results import labelled, summary_of
from stiction.solving.sliding_on_map import Move, requested_displacements, slide_on_map, used_by_sliding

if TYPE_CHECKING:
    import xarray

    from stiction.quantities.arguments import QuantityLike

_PRESLIDING = "mindlin_1949"
# A model without adhesion in which contact spots yield, as most real spots do. It is the default if no adhesion is stated, and
# is used for the stiffness before sliding.
YIELDING_SPOTS: dict[str, Any] = {"model": "greenwood_williamson_1966", "asperity": "zhao_maietta_chang_2000"}
_LAW_OF_ITS_OWN = 4  # memory that one displacement needs, as a number of points; it determines the size of blocks
_POINTS = 61  # number of displacements of a curve, if none are given
_NEARLY = 0.99  # fraction of the largest force that counts as sliding, because the force only approaches its largest value
# Displacements among which the largest force is searched, divided by the displacement at which a force with the initial
# stiffness would reach the summed strength. _NARROWED is the number of refinements of the best displacement.
_WAY = np.geomspace(1e-3, 1e3, 121)
_NARROWED = 40


@with_keywords(LawKeywords)
def slide(
    contact: Subject,
    *,
    separation: "QuantityLike | None" = None,
    load: "QuantityLike | None" = None,
    displacement: "QuantityLike | None" = None,
    tangential_force: "QuantityLike | None" = None,
    residual_strength: float | None = None,
    weakening_slip: "QuantityLike | None" = None,
    spring_stiffness: "QuantityLike | None" = None,
    model: str | None = None,
    heights: Heights | str | None = None,
    **laws: Unpack[LawKeywords],
) -> "xarray.Dataset":
    """Compute the tangential force as a function of displacement, from rest to sliding.

    Parameters
    ----------
    contact : Contact or Indices
        As in `solve`. A film is allowed only if "boundary_elements" solves a height map.
    separation, load : float, str with a unit, or array, optional
        Exactly one of them, as in `solve`: mean separation [m] or normal load [N].
    displacement : float [m], str with a unit, or array, optional
        Tangential displacements from rest, 0 or more; in units of sigma for Indices. By default 61 values up to 1.5 times the
        largest sliding displacement; for a map 41 values, until all points slide or have weakened.
    tangential_force : float [N], str with a unit, or array, optional
        For a map at one load: forces below the sum of strengths, in place of displacements. Points must then keep their
        strength.
    residual_strength : float, optional
        Fraction of the strength, 0 to 1, that remains: for an asperity once it slides, for a point of a map after the slip
        `weakening_slip`. 1 is Coulomb's law. By default the value of the contact, or 1.
    weakening_slip : float [m] or str with a unit, optional
        For a map: slip over which the strength of a point falls linearly to the residual strength. By default the value of the
        contact.
    spring_stiffness : float [N/m] or str with a unit, optional
        For a map: stiffness of the machine, through which a slow drive moves the map. By default the machine is rigid.
    model : str, optional
        As in `solve`: a sum over an asperity law, or "boundary_elements", which moves the points of a map. For a contact
        without specified adhesion the default is "greenwood_williamson_1966" with the asperities of Zhao, Maietta and Chang.
    heights : Heights or str, optional
        As in `solve`.
    **laws : str, optional
        As in `solve`; a tangential law gives each asperity, or point, its strength.

    Returns
    -------
    xarray.Dataset
        friction_force [N], the sum of all strengths, and friction_coefficient, this force divided by the load;
        tangential_stiffness [N/m] at rest; largest_tangential_force [N], largest_friction_coefficient and sliding_displacement
        [m], where the force is largest, or 99 % of the largest if strength stays constant. Along `displacement`:
        tangential_force [N]; sticking_share, the fraction of the contact area that has not slipped; for a sum over asperities
        with a residual strength of 1, energy_loss [J], the energy lost in one cycle of this amplitude. For a map also
        friction_efficiency, the largest force divided by the sum of strengths, and point_state along `displacement`: 0 apart, 1
        sticks, 2 slides; with a spring, drive_displacement [m] and state_is_met, 0 at displacements that the map skips in a
        jump; if strength falls with slip, points_in_weakening, the weakening length in map points. If shear changes the contact
        of a map, also sheared_contact_area [m2] along `displacement`; for unlike bodies, coupling_residual.

    Raises
    ------
    InputError
        A value is out of bounds; the contact has a film, but the model is not "boundary_elements"; or the model has no
        asperities that can slip.

    Notes
    -----
    An asperity slips partially as in Mindlin (1949). All asperities are displaced together; plastic asperities stick like
    elastic ones. On a map, displacements are relative to its mean plane. For unlike bodies pressure and shear are coupled. The
    body with the larger (1 - 2 nu)/G (nu: Poisson's ratio, G: shear modulus) then slides towards higher columns, whether it is
    the first or the second; mirror the map to reverse this. For like bodies, traction perpendicular to the direction of sliding
    is neglected. With the option mode_mixity, shear lowers the adhesion of a map; none of its laws is recommended. The input
    `peeling` of the contact is the fraction of the shear energy that opens the edge.

    Examples
    --------
    >>> import stiction as st
    >>> moved = st.slide(st.Indices(theta=40, lam=10), load=1.0)
    >>> moved.sizes["displacement"]
    61
    >>> bool(moved.sliding_displacement > 0.0)
    True
    """
    subject = as_subject(contact)
    residual = _residual(subject, residual_strength)
    of_maps = {"weakening_slip": weakening_slip, "tangential_force": tangential_force, "spring_stiffness": spring_stiffness}
    if model is not None and isinstance(on_map := make_problem(contact, choice_of(model, laws, subject), heights), MapProblem):
        slip = getattr(subject, "weakening_slip", None) if weakening_slip is None else weakening_slip
        how = Move(displacement, tangential_force, residual, slip, spring_stiffness)
        return slide_on_map(on_map, points_of(on_map, load, separation), how)
    for name, value in of_maps.items():
        if value is not None:
            raise InputError(name, value, "no value; only model = boundary_elements uses it")
    if subject.has_film:
        raise InputError("contact", InWords("has a film"), "no film, or model = boundary_elements with a height map")
    words: dict[str, Any] = {**laws, "presliding": _PRESLIDING}
    if model is None and words.get("asperity") is None and not np.any(getattr(subject, subject.given_as("theta"), None)):
        model, words["asperity"] = YIELDING_SPOTS["model"], YIELDING_SPOTS["asperity"]
    choice = choice_of(model, words, subject)
    problem = _checked(make_problem(contact, choice, heights))
    sliding = Sliding(problem, residual)
    points = points_of(problem, load, separation)
    subject, name, point, factors, dims = problem.subject, points.name, points.value, points.factors, points.dims
    with in_words(points):
        static = solve_points(points).tables
    static["tangential_stiffness"] = sliding.stiffness(static["mean_separation"])
    ends = sliding.ends(static)
    moved = _displacements(subject, displacement, ends["sliding_displacement"] * aligned(factors["m"], dims))
    whole = dimensions([moved], dims)
    curve = sliding.curve(static, normalised(moved, factors["m"], whole))
    coords = problem.coords | coordinates_of(point, moved)
    data = labelled(subject, static | ends, factors, dims, coords)
    data = data.merge(labelled(subject, curve, factors, whole, problem.coords | coordinates_of(moved)))
    for coordinate in ("displacement", name):
        if coordinate in data.coords:
            data[coordinate].attrs = subject.attributes(coordinate)
    return data.assign_attrs(sliding.summary(static))


def _residual(subject: Subject, given: Any) -> float:
    """Return the fraction of its strength that an asperity retains once it slides.

    given: the argument of the user. If it is None, the value of the contact is used, or 1 if the contact has no value.
    Raises InputError for anything but a number from 0 to 1.
    """
    stated = getattr(subject, "residual_strength", None) if given is None else given
    value = floats(1.0 if stated is None else stated, "residual_strength", "a number from 0 to 1")
    if value.ndim or not 0.0 <= value <= 1.0:
        raise InputError("residual_strength", stated, "a number from 0 to 1")
    return float(value)


def _checked(problem: Problem) -> AsperitySum:
    """Return the problem if its asperities can slip; otherwise raise InputError with the reason."""
    model = problem.record
    if problem.chosen.tangential is None:
        wanted = f"a tangential law: {model.key} has none, and each asperity needs a shear strength"
        raise InputError("tangential", "none", wanted)
    assert isinstance(problem, AsperitySum)  # theories in closed form reject presliding laws
    for name, values in model.own_options.items() if model.regimes is not None else ():
        if problem.options[name] != values[0]:
            raise InputError(name, problem.options[name], f"{values[0]}: slide() supports only this variant of the model")
    return problem


def _displacements(subject: Subject, given: Any, slides_at: np.ndarray) -> Any:
    """Return the displacements to compute, as a number or an array with named dimensions, in the units of the contact.

    given: displacements of the user, or None for 61 values up to 1.5 times the largest value of slides_at. slides_at: sliding
    displacement of each point. Raises InputError for a negative displacement, for an empty array, and for None if the contact
    has no friction.
    """
    if given is None:
        farthest = float(np.nanmax(slides_at)) if np.isfinite(slides_at).any() else math.nan
        if not farthest > 0.0:
            raise InputError("displacement", None, "one or more values, because a contact without friction has no default")
        given = np.linspace(0.0, 1.5 * farthest, _POINTS)
    return requested_displacements(subject, given)


@dataclass(frozen=True)
class Sliding:
    """Represent a sum over asperities that are all displaced tangentially by the same amount.

    residual: fraction of its strength that an asperity retains once it slides.
    """

    problem: AsperitySum
    residual: float

    def at(self, h: np.ndarray, displacement: np.ndarray) -> np.ndarray:
        """Return the tangential force and the energy lost in one cycle of this amplitude, both normalised, (2, *shape).

        h, displacement: mean separation and tangential displacement in units of sigma, arrays of the same shape, with the
        contacts' dimensions first.
        """
        return self._summed(h, displacement, lambda tangential, moved: slipping_law(tangential, moved, self.residual))

    def _summed(self, h: np.ndarray, displacement: np.ndarray, law_of: Callable) -> np.ndarray:
        """Sum a tangential law that depends on displacement; return the slip-limited and yield-limited sums (2, *shape of h).

        law_of: function (tangential law of the problem, displacements) -> law that is summed. h, displacement: in units of
        sigma, arrays of the same shape.
        """
        laws = len(self.problem.groups)
        row = np.repeat(np.arange(laws), math.prod(h.shape) // laws)
        flat, moved = h.reshape(-1), np.ascontiguousarray(displacement, dtype=float).reshape(-1)
        parts = [self._forces(row[some], flat[some], moved[some], law_of) for some in blocks(flat.size, _LAW_OF_ITS_OWN)]
        return np.concatenate(parts, axis=1).reshape(2, *h.shape)

    def stiffness(self, h: np.ndarray) -> np.ndarray:
        """Return the normalised tangential stiffness at rest, in the shape of the separations h (in units of sigma).

        It is the slope of the curve of force against displacement, summed over all asperities that have strength.
        """
        chosen = self.problem.chosen
        assert chosen.tangential is not None
        still = replace(self.problem, chosen=chosen.without("presliding", tangential=sticking_law(chosen.tangential)))
        return still.sums_at(h.reshape(len(still.groups), -1))[..., SLIP_LIMITED].sum(axis=0).reshape(h.shape)

    def _forces(self, row: np.ndarray, h: np.ndarray, displacement: np.ndarray, law_of: Callable) -> np.ndarray:
        chosen = self.problem.chosen
        assert chosen.tangential is not None
        law = law_of(chosen.tangential, displacement)
        moved = replace(self.problem, groups=self.problem.groups[row], chosen=chosen.without("presliding", tangential=law))
        return moved.forces(h, np.arange(h.size))

    def curve(self, static: dict[str, np.ndarray], displacement: np.ndarray) -> dict[str, np.ndarray]:
        """Return tangential force, sticking fraction of the area and energy lost per cycle, normalised, by name.

        static: normalised results at rest. displacement: tangential displacements in units of sigma, with the dimensions of
        `static` first. The energy is omitted unless asperities keep their full strength.
        """
        h, area = (
            np.broadcast_to(table.reshape(table.shape + (1,) * (displacement.ndim - table.ndim)), displacement.shape)
            for table in (static["mean_separation"], static["contact_area"])
        )
        force, loss = self.at(h, displacement)
        sticking = quotient(self._summed(h, displacement, sticking_area_law)[0], area)
        # The branches of a cycle after asperities have separated are unknown.
        lost = {"energy_loss": loss} if self.residual == 1.0 else {}
        return {"tangential_force": force, "sticking_share": sticking} | lost

    def ends(self, static: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
        """Return the largest tangential force, its ratio to the load and the displacement at it, normalised, by name.

        static: normalised results at rest. With constant strength (Coulomb's law) the force only approaches its largest value;
        the displacement is then where it reaches 99 % of the sum of strengths. The displacement is NaN without strength or
        stiffness, or if the search fails.
        """
        h, strength, stiffness = (static[name] for name in ("mean_separation", "friction_force", "tangential_stiffness"))
        held = (strength > 0.0) & (stiffness > 0.0)
        unit = np.where(held, quotient(1.5 * strength, stiffness), 1.0)
        if self.residual == 1.0:
            where, largest = self._nearly(h, unit, _NEARLY * strength), strength
        else:
            where, largest = self._peak(h, unit)
        where = np.where(held & np.isfinite(where), where, np.nan)
        return {
            "largest_tangential_force": np.where(held, largest, strength),
            "largest_friction_coefficient": quotient(largest, static["load"]),
            "sliding_displacement": where,
        }

    def _nearly(self, h: np.ndarray, unit: np.ndarray, force: np.ndarray) -> np.ndarray:
        """Find the displacement at which the tangential force reaches `force`, by bisection; NaN beyond the searched range.

        h: separations in units of sigma. unit: scale of the searched displacements in units of sigma.
        """
        low, high = np.log(unit * _WAY[0]), np.log(unit * _WAY[-1])
        reached = self.at(h, np.exp(high))[0] >= force
        for _ in range(_NARROWED):
            middle = 0.5 * (low + high)
            above = self.at(h, np.exp(middle))[0] >= force
            low, high = np.where(above, low, middle), np.where(above, middle, high)
        return np.where(reached, np.exp(high), np.nan)

    def _peak(self, h: np.ndarray, unit: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Find the displacement, in units of sigma, at the largest tangential force; return it with the normalised force.

        h: separations in units of sigma. unit: scale of the searched displacements. The best of many displacements is
        refined by golden-section search.
        """
        found = np.stack([self.at(h, unit * one)[0] for one in _WAY])
        best = np.clip(found.argmax(axis=0), 1, len(_WAY) - 2)
        low, high = np.log(unit * _WAY[best - 1]), np.log(unit * _WAY[best + 1])
        golden = 0.5 * (math.sqrt(5.0) - 1.0)
        for _ in range(_NARROWED):
            left, right = high - golden * (high - low), low + golden * (high - low)
            falls = self.at(h, np.exp(left))[0] > self.at(h, np.exp(right))[0]
            low, high = np.where(falls, low, left), np.where(falls, right, high)
        where = np.exp(0.5 * (low + high))
        return where, self.at(h, where)[0]

    def summary(self, static: dict[str, np.ndarray]) -> dict[str, Any]:
        known = summary_of(self.problem.subject, self.problem, static) | used_by_sliding(self.problem, ("residual_strength",))
        how = "all of its strength" if self.residual == 1.0 else f"{self.residual:g} of its strength"
        title = f"Tangential force up to sliding after {known['model']}"
        return known | {"title": title, "residual_strength": self.residual, "sliding": f"an asperity that slides keeps {how}"}
