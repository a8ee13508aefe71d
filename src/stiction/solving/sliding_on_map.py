"""Compute the tangential force of a height map from rest to sliding; points may lose strength as they slip.

The tangential law gives each point its strength from its pressure; `solvers.shear` displaces the map tangentially.
"""

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction.contact.subject import Subject
from stiction.quantities.errors import InputError, InWords
from stiction.quantities.quotient import quotient
from stiction.solving.moving_adhesive import AdhesiveMap, PeelingMap, without_mode_mixity
from stiction.solving.moving_map import MovingMap
from stiction.solving.moving_unlike import UnlikeBodies, are_unlike, effect_of_coupling
from stiction.solving.on_map import MapProblem
from stiction.solving.points import Points, coordinates_of, requested_points, solve_points
from stiction.solving.problem_base import Problem
from stiction.solving.results import as_variables, labelled, summary_of
from stiction.solving.unused import as_attributes, unused_inputs

if TYPE_CHECKING:
    import xarray

    from stiction.solvers.boundary_elements.solve import MapContact
    from stiction.solvers.shear.path import SlidingPath, Weakening

_STEPS = 40  # number of displacements, if none are given
_MOST_SHOWN = 160  # largest number of points along a side of the returned map of sticking and sliding points
_STATES = {"long_name": "points of the map", "flag_values": [0, 1, 2], "flag_meanings": "apart sticks slides"}
_NEARLY = 0.99  # fraction of the largest force that counts as sliding, because the force only approaches its largest value
_KNOWN = "a length > 0: 0.3 to 3 nm for monolayers and oxides, 0.1 to 10 um for worn metals, 1 to 100 um for rock"


@dataclass(frozen=True)
class Move:
    """Store the arguments of `slide` that describe how a map is displaced tangentially.

    displacement, tangential_force, weakening_slip, spring_stiffness: values as given by the user, or None. residual:
    fraction of its strength that a point retains after the weakening slip.
    """

    displacement: Any
    tangential_force: Any
    residual: float
    weakening_slip: Any
    spring_stiffness: Any


def slide_on_map(problem: MapProblem, points: Points, move: Move) -> "xarray.Dataset":
    """Compute the tangential force of a solved map as a function of displacement; return the dataset that `slide` describes.

    points: requested loads. move: how the map is displaced. Raises InputError for arguments that a map does not support.
    """
    factors = problem.factors
    weakening = _weakening(problem, move.residual, move.weakening_slip)
    unsheared = without_mode_mixity(problem)
    static = solve_points(replace(points, problem=unsheared)).tables
    loads = static["load"]
    moving = _moving(problem, loads.reshape(-1))
    moved = requested_displacements(problem.subject, _displacements(problem, moving, weakening, move))
    shifts = np.atleast_1d(np.asarray(moved, dtype=float))
    paths = [moving.path(index, shifts, weakening) for index in range(len(moving.contacts))]
    whole = float(problem.contact.nominal_area) / moving.nominal_area
    ends = _ends(moving, paths, whole, factors) | moving.results(paths)
    if weakening is not None:
        ends["points_in_weakening"] = _points_in_loss(problem, moving, weakening)
    ends = {name: values.reshape(loads.shape) for name, values in ends.items()}
    ends["largest_friction_coefficient"] = quotient(ends["largest_tangential_force"], loads)
    dims = points.dims | ({"displacement": shifts.size} if hasattr(moved, "dims") else {})
    shape = tuple(dims.values())
    curves = {
        "tangential_force": np.array([path.array("force") for path in paths]) * whole / factors["N"],
        "sticking_share": np.array([path.array("stick") for path in paths]),
        **{name: values * whole / factors["m^2"] for name, values in moving.curves(paths).items()},
    }
    if move.spring_stiffness is not None:
        curves |= _through_spring(problem, paths, whole, move.spring_stiffness)
    curves = {name: values.reshape(shape) for name, values in curves.items()}
    coords = problem.coords | coordinates_of(points.value, moved)
    # Loads that are a coordinate keep their requested values.
    results = {name: table for name, table in (static | ends).items() if name not in coords}
    data = labelled(problem.subject, results, points.factors, points.dims, coords)
    data = data.assign(as_variables(problem.subject, curves, points.factors, dims))
    states = _point_states(paths)
    data["point_state"] = (*dims, "row", "column"), states.reshape(*shape, *states.shape[2:]), _STATES
    for name in {"displacement", points.name} & set(data.coords):
        data[name].attrs = problem.subject.attributes(str(name))
    known = summary_of(problem.subject, problem, static | ends)
    peels = ("peeling",) if problem.options["mode_mixity"] != "none" else ()
    known |= used_by_sliding(problem, ("residual_strength", "weakening_slip", *peels))
    return data.assign_attrs(known | _attributes(known, moving, move.residual, weakening, paths))


def requested_displacements(subject: Subject, given: Any) -> Any:
    """Return displacements as `requested_points` does; raise InputError for a negative displacement and for an empty array."""
    moved = requested_points(subject, "displacement", given)
    if not np.size(moved):
        raise InputError("displacement", InWords("no values"), "at least one value")
    if float(np.min(moved)) < 0.0:
        raise InputError("displacement", subject.show(float(np.min(moved)), "displacement"), "0 or more")
    return moved


def _moving(problem: MapProblem, loads: np.ndarray) -> MovingMap:
    """Solve the map at normalised loads (m,), and return the moving map that suits its bodies and its adhesion.

    Adhesive maps, maps of like bodies and maps of unlike bodies are displaced by different solvers. Raises InputError if the
    map is not solved at one of the loads.
    """
    contacts = _contacts(without_mode_mixity(problem), loads)
    unlike = are_unlike(problem)
    if problem.adheres:
        mixed = problem.options["mode_mixity"] != "none"
        moving: MovingMap = (PeelingMap if mixed else AdhesiveMap).of(problem, contacts)
        return _uncoupled(problem, moving, loads, "of adhesion") if unlike else moving
    if not unlike:
        return MovingMap.of(problem, contacts)
    if problem.menisci:
        return _uncoupled(problem, MovingMap.of(problem, contacts), loads, "of the liquid")
    return UnlikeBodies.of(problem, contacts)


def _contacts(problem: MapProblem, loads: np.ndarray) -> "tuple[MapContact, ...]":
    """Return the contacts of the map at normalised loads (m,); raise InputError if the solver finds none at one of them."""
    contacts = tuple(state for state in problem.curve(loads).contacts if state is not None)
    if len(contacts) < loads.size:
        raise InputError(
            "load", InWords(f"{loads.size - len(contacts)} loads without a solution"), "loads that the solver can solve"
        )
    return contacts


def _uncoupled(problem: MapProblem, moving: MovingMap, loads: np.ndarray, why: str) -> MovingMap:
    """Return the moving map with a remark that the coupling of pressure and shear is neglected, and the error of friction.

    The error is computed for the dry contact without adhesion at the normalised loads (m,); the error is omitted unless all
    loads are positive. why: reason why the coupling is neglected.
    """
    remark = f"pressure and shear are not coupled, because {why}"
    if (loads > 0.0).all():
        dry = problem.without_attraction()
        change = effect_of_coupling(dry, _contacts(dry, loads))
        remark += f": friction may be wrong by {100.0 * change:.2g} %"
    return replace(moving, remark="; ".join(text for text in (moving.remark, remark) if text))


def _displacements(problem: MapProblem, moving: MovingMap, weakening: "Weakening | None", move: Move) -> Any:
    """Return the displacements to solve: given ones, those at given forces, or a default range.

    The default range ends where all points slide or, with `weakening`, where all points have weakened. Raises InputError for
    forces that the map does not support.
    """
    from stiction.solvers.shear.path import full_shift

    if move.tangential_force is not None:
        return _at_forces(problem, moving, move)
    if move.displacement is not None:
        return move.displacement
    far = max(full_shift(moving.operator, strength) for strength in moving.strengths)
    return _default_displacements(moving.farther * far, weakening)


def _thinned(table: np.ndarray) -> np.ndarray:
    """Return all points of a map, or an evenly spaced selection with at most 160 points along a side."""
    every = -(-max(table.shape) // _MOST_SHOWN)
    return table[::every, ::every]


def _point_states(paths: "list[SlidingPath]") -> np.ndarray:
    """Return the state of every point (loads, displacements, rows, columns): 0 apart, 1 sticking, 2 sliding.

    Large maps are reduced to an evenly spaced selection of points.
    """
    states = [[_thinned(state.touching).astype(np.int8) + _thinned(state.slides) for state in path.states] for path in paths]
    return np.array(states, dtype=np.int8)


def used_by_sliding(problem: Problem, names: tuple[str, ...]) -> dict[str, str]:
    """Return the attributes that list the unused inputs of a problem, except those that only sliding uses.

    names: names of the inputs that sliding uses.
    """
    return as_attributes(unused for unused in unused_inputs(problem) if unused.input not in names)


def _default_displacements(elastic: float, weakening: "Weakening | None") -> np.ndarray:
    """Return the displacements [m] to solve: evenly spaced up to `elastic`, then until all points have weakened.

    elastic: displacement at which all points slide. weakening: how strength falls with slip, or None if it is constant.
    """
    if weakening is None:
        return np.linspace(0.0, elastic, _STEPS + 1)
    after = elastic + weakening.slip * np.linspace(0.0, 1.0, _STEPS // 3 + 1)[1:]
    return np.concatenate([np.linspace(0.0, elastic, _STEPS - _STEPS // 3 + 1), after])


def _weakening(problem: MapProblem, residual: float, slip: Any) -> "Weakening | None":
    """Return how strength falls with slip; None if it stays constant.

    residual: fraction of its strength that a point retains. slip: slip over which the strength falls to this fraction, as given
    by the user. Raises InputError for a residual strength below 1 without a slip, and for a slip with a residual strength of 1.
    """
    from stiction.solvers.shear.path import Weakening

    if slip is None:
        if residual < 1.0:
            raise InputError("weakening_slip", None, _KNOWN)
        return None
    if residual == 1.0:
        raise InputError(
            "weakening_slip", slip, "no value while residual_strength is 1, because the strength then stays constant"
        )
    return Weakening(float(problem.subject.read(slip, "weakening_slip")), residual)


def _at_forces(problem: MapProblem, moving: MovingMap, move: Move) -> np.ndarray:
    """Return the displacements [m] at which the whole contact bears the tangential forces given in `move`.

    Raises InputError if `move` also gives a displacement, if strength falls with slip, if shear changes the contact, if there
    is more than one load, or if a force is negative or too large.
    """
    from stiction.solvers.shear.path import at_force

    if move.displacement is not None:
        raise InputError("tangential_force", move.tangential_force, "no value together with displacement; give one of the two")
    if move.residual < 1.0:
        raise InputError(
            "tangential_force", move.tangential_force, "no value, because strength falls with slip; give displacement instead"
        )
    if type(moving) not in (MovingMap, AdhesiveMap):
        raise InputError(
            "tangential_force", move.tangential_force, "no value, because shear changes the contact; give displacement instead"
        )
    if len(moving.strengths) != 1:
        raise InputError("load", InWords(f"{len(moving.strengths)} loads"), "one load together with tangential_force")
    contact, strength = problem.contact, moving.strengths[0]
    forces = np.atleast_1d(np.asarray(problem.subject.read(move.tangential_force, "tangential_force"), dtype=float))
    most = float(strength.sum()) * moving.pixel(0) * float(contact.nominal_area) / moving.nominal_area
    if not ((forces >= 0.0) & (forces < most)).all():
        shown = contact.show(float(forces.max()), "tangential_force"), contact.show(most, "tangential_force")
        raise InputError("tangential_force", shown[0], f"0 to less than the summed strength of the points, {shown[1]}")
    part = moving.nominal_area / float(contact.nominal_area)
    return np.array([at_force(moving.operator, strength, float(force) * part, pixel=moving.pixel(0)).shift for force in forces])


def _through_spring(problem: MapProblem, paths: "list[SlidingPath]", whole: float, stiffness: Any) -> dict[str, np.ndarray]:
    """Return the displacement of the drive, normalised, and a mask of the states that are reached, by name.

    paths: states of the map, for each load. whole: nominal area of the contact divided by the area of the map. stiffness:
    stiffness of the spring, as given by the user.
    """
    from stiction.solvers.shear.path import through_spring

    of_map = float(problem.subject.read(stiffness, "spring_stiffness")) / whole
    drives = [through_spring(path, of_map) for path in paths]
    return {
        "drive_displacement": np.array([drive for drive, _ in drives]) / problem.factors["m"],
        "state_is_met": np.array([met for _, met in drives], dtype=float),
    }


def _ends(moving: MovingMap, paths: "list[SlidingPath]", whole: float, factors: dict[str, Any]) -> dict[str, np.ndarray]:
    """Return stiffness at rest, largest force, displacement at this force, and efficiency for each load (m,), by name.

    The first three are normalised. The efficiency is the largest force divided by the sum of strengths. If strength is
    constant, the displacement at 99 % of the largest force is returned instead, NaN if that force is not reached. whole:
    nominal area of the contact divided by the area of the map. factors: units by which results are divided.
    """
    from stiction.solvers.shear.path import stuck_stiffness

    sums = np.array([strength.sum() * path.pixel for strength, path in zip(moving.strengths, paths, strict=True)])
    largest = np.array([path.largest for path in paths])
    stiffness = np.array([stuck_stiffness(moving.operator, path.strength > 0.0) * path.pixel for path in paths])
    where = np.array([path.peak.shift if path.limit is None else _nearly(path) for path in paths])
    return {
        "tangential_stiffness": stiffness * whole / factors["N/m"],
        "largest_tangential_force": largest * whole / factors["N"],
        "sliding_displacement": where / factors["m"],
        "friction_efficiency": largest / sums,
    }


def _nearly(path: "SlidingPath") -> float:
    """Return the displacement [m] at which the force reaches 99 % of its largest value; NaN if it does not."""
    force, shift = path.array("force"), path.array("shift")
    wanted = _NEARLY * path.largest
    at = int(np.argmax(force >= wanted))
    if force[at] < wanted:
        return float("nan")
    before = max(at - 1, 0)
    return float(np.interp(wanted, force[[before, at]], shift[[before, at]]))


def _points_in_loss(problem: MapProblem, moving: MovingMap, weakening: "Weakening") -> np.ndarray:
    """Return the length of the weakening zone in map points (m,), at each of m loads.

    Strength is lost in this zone, which lies behind the tip of a slipping region. Its length is computed from the largest
    strength.
    """
    from stiction.solvers.shear.path import weakening_length

    surface = problem.surface()
    return np.array(
        [
            weakening_length(moving.operator, float(strength.max()), weakening) / max(surface.pitch)
            for strength in moving.strengths
        ]
    )


def _attributes(
    known: dict[str, Any], moving: MovingMap, residual: float, weakening: "Weakening | None", paths: "list[SlidingPath]"
) -> dict[str, Any]:
    """Return attributes for the result of `slide`: residual strength, neglected effects, and whether the force converged."""
    how = "a point that slips keeps all of its strength"
    if weakening is not None:
        how = f"a point that slips {weakening.slip:.3g} m keeps {weakening.residual:g} of its strength"
    settled = all(state.converged for path in paths for state in path.states)
    remarks = [known["remarks"], moving.remark_on(paths), "" if settled else "the force did not converge at some displacements"]
    title = f"Tangential force up to sliding after {known['model']}"
    return {
        "title": title,
        "residual_strength": residual,
        "sliding": how,
        "remarks": "; ".join(text for text in remarks if text),
    }
