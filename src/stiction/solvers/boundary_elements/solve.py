"""Solve the contact of a height map with a rigid flat, or of two maps through their sum, point by point.

    found = solve_map(surface.heights, surface.size, modulus=1e11, loads=[1.0, 10.0], periodic=True)
    found[-1].area, found[-1].separation, found.validity_warnings

Assumptions: Slopes are small. There is no friction, and no adhesion except by a liquid. Bodies are half-spaces, with or without
a film. Plastic flow limits the pressure to the hardness, without hardening and without displaced volume. The contact at a load
does not depend on earlier loads: every load is a first loading.
"""

import math
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, fields, replace

import numpy as np

from stiction.quantities.errors import InputError, InWords, nearest
from stiction.records.validity_warning import ValidityWarning
from stiction.solvers.boundary_elements.arrays import factor, namespace, on_device, to_numpy
from stiction.solvers.boundary_elements.certificate import certify
from stiction.solvers.boundary_elements.compliance import Compliance, Film
from stiction.solvers.boundary_elements.increments import stiffness_per_area
from stiction.solvers.boundary_elements.limits import TOLERANCE
from stiction.solvers.boundary_elements.map_warnings import share_at_ends, warnings_of_load, warnings_of_map
from stiction.solvers.boundary_elements.measures import corrected_area, edges, rms_step
from stiction.solvers.boundary_elements.menisci import Condensed, Menisci, condense
from stiction.solvers.boundary_elements.minimise import Problem, minimise
from stiction.solvers.boundary_elements.operators import FreeBoundary, MirroredBoundary, PeriodicBoundary
from stiction.surfaces.heightmap import size_in_metres
from stiction.surfaces.memory import require_memory

MOST_STEPS = 2000
_COARSE = 96  # least number of points along a side of a coarser map whose solution serves as start
_COARSE_TOLERANCE = 1e-2


@dataclass(frozen=True)
class MapContact:
    """Store the contact of a map at one load; all values refer to the whole map.

    load [N]. mean_pressure: load divided by nominal area [Pa]. nominal_area [m2]. area: real area, corrected for edge pixels
    [m2]. area_pixels: area of all pixels in contact [m2]. perimeter: length of the contact edge [m]. separation: distance from
    the mean plane of the undeformed heights to the flat counterface [m]. For a map without free edges, on a body that is
    elastic to any depth, it is the distance to the mean plane of the deformed counterface, and approach is None. mean_gap: mean
    distance of the faces [m], with 0 where they touch. approach: approach since first touch [m]. stiffness: derivative of the
    load with respect to the approach [N/m]; NaN without elastic points, or if not requested, and infinite in full contact of
    half-spaces. plastic_area: area where the pressure equals the hardness [m2]. plastic_share: fraction of the load on this
    area [1].

    pressure: (rows, columns) [Pa]; None if not stored. residual: relative error of the contact conditions. steps: number of
    steps of the solver. pressure_error, area_error [1], overlap [m]: error bounds on this grid (see `certificate`). load_error:
    relative error of the summed pressures. points: number of points in contact. load_at_ends: fraction of the load on the
    outermost points; 0 for a map without free edges. validity_warnings: limits of the solver that this load exceeds. pull:
    force by which the liquid pulls outside the contact [N]; the contact carries it in addition to the load.
    """

    load: float
    mean_pressure: float
    nominal_area: float
    area: float
    area_pixels: float
    perimeter: float
    separation: float
    mean_gap: float
    approach: float | None
    stiffness: float
    plastic_area: float
    plastic_share: float
    residual: float
    pressure_error: float
    area_error: float
    overlap: float
    load_error: float
    steps: int
    points: int
    load_at_ends: float
    validity_warnings: tuple[ValidityWarning, ...] = ()
    pressure: np.ndarray | None = field(default=None, repr=False)
    pull: float = 0.0


@dataclass(frozen=True)
class MapContacts:
    """Store the contacts of a map, one for each load, as a sequence of MapContact.

    contacts: in the order in which the loads were given. validity_warnings: warnings that hold for the map at all loads.
    complete: False if the solution was interrupted; unsolved loads are then missing.
    """

    contacts: tuple[MapContact, ...]
    validity_warnings: tuple[ValidityWarning, ...]
    complete: bool = True

    def __getitem__(self, index: int) -> MapContact:
        return self.contacts[index]

    def __len__(self) -> int:
        return len(self.contacts)

    def __iter__(self) -> Iterator[MapContact]:
        return iter(self.contacts)

    def array(self, name: str) -> np.ndarray:
        """Return one attribute of all contacts, by its name, as an array (loads,); NaN where the attribute is None."""
        return np.array([getattr(contact, name) for contact in self.contacts], dtype=float)


@dataclass(frozen=True)
class Progress:
    """Report the progress of a map solution.

    load: index of the current load, from 0; loads are solved in increasing order. loads: number of loads. step: number of the
    step at this load. residual: current error of the contact conditions; the solution ends when it is at most the tolerance.
    """

    load: int
    loads: int
    step: int
    residual: float


def solve_map(
    heights: np.ndarray, size: tuple[float, float], *, modulus: float, loads: Sequence[float], periodic: bool,
    film: Film | None = None, counter_film: Film | None = None, hardness: float | None = None,
    menisci: Menisci | None = None, **how,
) -> MapContacts:  # fmt: skip
    """Solve the contact of a map with a rigid flat face at every load, and return the contacts.

    heights: (rows, columns) [m], finite, not all equal. size: (y, x) [m]. modulus: contact modulus E* [Pa] of the uncoated
    bodies: of both bodies, or of the only body without a film; infinite if both have films or the uncoated bodies are rigid.
    loads: [N], > 0, in any order. periodic: True if the map is one period of an endless surface; otherwise it is a window,
    continued by its mirror images. film, counter_film: elastic film on the first and the second body, or None. hardness:
    largest pressure [Pa]; None for elastic bodies. menisci: liquid between the faces in equilibrium with its vapour; None for
    dry faces.

    Further keywords: free: whether there is no pressure outside of a map that is not periodic (default False). tolerance:
    largest accepted residual (default 1e-5). most_steps: largest number of steps at each load (default 2000). keep_maps:
    whether pressure maps are stored (default True). stiffness: whether the contact stiffness is computed (default True).
    progress: called with a `Progress` before every step. done: called with each solved contact. device: array library that
    solves the map instead of NumPy, optionally with one of its devices, such as "torch:cuda". Results are NumPy arrays in the
    order of the loads.

    A load that did not converge has a warning `not_converged`. After a keyboard interrupt the loads solved so far are returned,
    if there are any. Raises InputError for unusable arguments, a load that the hardness cannot carry, or too little memory.
    """
    request = _Request.of(heights, size, hardness, loads, periodic, _How.of(**how), menisci)
    compliance = Compliance(modulus, film, counter_film)
    of_map = warnings_of_map(request.heights, request.size, film or counter_film, periodic)
    order = np.argsort(request.pressures, kind="stable")
    done: dict[int, MapContact] = {}
    try:
        for index, contact in zip(order, _rising(request, compliance, request.pressures[order]), strict=True):
            done[int(index)] = contact
            if request.how.done is not None:
                request.how.done(contact)
    except KeyboardInterrupt:
        if not done:
            raise
    return MapContacts(tuple(done[index] for index in sorted(done)), of_map, len(done) == len(order))


def checked(heights: np.ndarray, size: tuple[float, float], loads: Sequence[float], periodic: bool, how: dict) -> None:
    """Raise InputError if `solve_map` would reject the map, the loads or the keywords.

    heights: (rows, columns) [m]. size: (y, x) [m]. loads: [N]. how: further keywords of `solve_map`; film and counter_film are
    not checked.
    """
    rest = {name: value for name, value in how.items() if name not in ("film", "counter_film", "hardness", "menisci")}
    _Request.of(heights, size, how.get("hardness"), loads, periodic, _How.of(**rest), how.get("menisci"))


@dataclass(frozen=True)
class _How:
    free: bool = False
    tolerance: float = TOLERANCE
    most_steps: int = MOST_STEPS
    keep_maps: bool = True
    stiffness: bool = True
    device: str | None = None
    progress: Callable[[Progress], None] | None = None
    done: Callable[[MapContact], None] | None = None

    @classmethod
    def of(cls, **how) -> "_How":
        known = [entry.name for entry in fields(cls)]
        for name in how:
            if name not in known:
                raise InputError(name, how[name], f"another option: {nearest(name, known)}")
        made = cls(**how)
        if not 0.0 < made.tolerance < 1.0:
            raise InputError("tolerance", made.tolerance, "above 0 and below 1")
        return made


@dataclass(frozen=True)
class _Request:
    """Store the checked arguments of `solve_map`.

    heights: (rows, columns) [m]. size: (y, x) [m]. hardness: largest pressure [Pa], infinite for elastic bodies. pressures:
    mean pressures (loads,) [Pa]. periodic: whether the map repeats. how: further options. menisci: liquid, or None.
    """

    heights: np.ndarray
    size: tuple[float, float]
    hardness: float
    pressures: np.ndarray
    periodic: bool
    how: _How
    menisci: Menisci | None

    @property
    def ends(self) -> bool:
        """Return whether the map has free edges, with no pressure outside."""
        return self.how.free and not self.periodic

    @classmethod
    def of(cls, heights, size, hardness, loads, periodic, how, menisci) -> "_Request":
        size = size_in_metres(size)
        loads = np.atleast_1d(np.asarray(loads, dtype=float))
        if loads.ndim != 1 or loads.size == 0 or not (np.isfinite(loads) & (loads > 0.0)).all():
            raise InputError("loads", loads.tolist(), "a list of finite loads > 0 N")
        require_memory(np.shape(heights), free=how.free and not periodic, kept=len(loads) if how.keep_maps else 1)
        heights = usable_map(heights)
        hardness = math.inf if hardness is None else float(hardness)
        pressures = loads / (size[0] * size[1])
        if not hardness > 0.0:
            raise InputError("hardness", hardness, "> 0 Pa, or none for elastic bodies")
        if pressures.max() >= hardness:
            allowed = f"< {hardness * size[0] * size[1]:.6g} N, the hardness times the area of the map"
            raise InputError("loads", float(loads.max()), allowed)
        return cls(heights, size, hardness, pressures, periodic, how, menisci)


def usable_map(heights) -> np.ndarray:
    heights = np.ascontiguousarray(heights, dtype=np.float64)
    if heights.ndim != 2 or min(heights.shape) < 4:
        raise InputError("heights", InWords(f"shape {heights.shape}"), "an array with at least 4 rows and 4 columns")
    bad = int(heights.size - np.count_nonzero(np.isfinite(heights)))
    if bad:
        raise InputError(
            "heights",
            InWords(f"{bad} of {heights.size} points not finite"),
            "a height at every point; fill missing points first",
        )
    if float(heights.min()) == float(heights.max()):
        raise InputError("heights", InWords("all equal"), "a rough map, because a flat surface touches everywhere")
    return heights


def _rising(request: _Request, compliance: Compliance, pressures: np.ndarray) -> Iterator[MapContact]:
    """Solve the contact at one mean pressure after another, and yield each solution.

    pressures (n,) [Pa]: ascending; each solution starts from the previous one.
    """
    boundary = PeriodicBoundary if request.periodic else FreeBoundary if request.ends else MirroredBoundary
    displacement = boundary(compliance, request.heights.shape, request.size)
    length = rms_step(request.heights)
    heights = on_device(request.heights, request.how.device)
    start = None
    for index, mean in enumerate(pressures.tolist()):
        if start is None:
            start = _from_coarser(request, compliance, boundary, mean, heights)
        problem = Problem(displacement, heights, mean, request.hardness, length)
        seen = None
        if request.how.progress is not None:
            seen = _reporting(request.how.progress, index, len(pressures))
        wetted = condense(
            problem, request.menisci, start, tolerance=request.how.tolerance, most=request.how.most_steps, seen=seen
        )
        yield _contact(request, problem, wetted)
        solved = wetted.found.pressure
        start = solved * (float(pressures[min(index + 1, len(pressures) - 1)]) / float(namespace(solved).mean(solved)))


def _reporting(progress, index, loads):
    return lambda step, residual: progress(Progress(index, loads, step, residual))


def _from_coarser(request, compliance, boundary, mean, heights) -> np.ndarray:
    """Return a start pressure (rows, columns) [Pa], interpolated from the solution of every second point.

    request: arguments of `solve_map`. boundary: class of the compliance operator. mean: mean pressure [Pa]. heights: (rows,
    columns) [m]. The function calls itself for the coarser map. A small map, or one with an odd number of rows or columns,
    starts with a uniform pressure.
    """
    if min(heights.shape) < 2 * _COARSE or any(count % 2 for count in heights.shape):
        return on_device(np.full(heights.shape, mean), request.how.device)
    coarse = np.ascontiguousarray(heights[::2, ::2])
    start = _from_coarser(request, compliance, boundary, mean, coarse)
    displacement, mapped = boundary(compliance, coarse.shape, request.size), on_device(coarse, request.how.device)
    problem = Problem(displacement, mapped, mean, request.hardness, rms_step(coarse))
    solution = minimise(problem, start, tolerance=_COARSE_TOLERANCE, most=request.how.most_steps)
    return _between(_between(solution.pressure, 0, request.periodic), 1, request.periodic)


def _between(coarse: np.ndarray, axis: int, periodic: bool) -> np.ndarray:
    """Return a map with twice as many rows (axis 0) or columns (axis 1); added lines are means of their two neighbours.

    On a periodic map, the last added line is the mean of the last line and the first. On other maps it repeats the last line.
    """
    xp, last = namespace(coarse), (-1, slice(None)) if axis == 0 else (slice(None), -1)
    middle = 0.5 * (coarse + xp.roll(coarse, -1, axis=axis))
    if not periodic:
        middle[last] = coarse[last]
    rows, columns = coarse.shape
    return xp.reshape(xp.stack([coarse, middle], axis=axis + 1), (2 * rows, columns) if axis == 0 else (rows, 2 * columns))


def _contact(request: _Request, problem: Problem, wetted: Condensed) -> MapContact:
    """Return the MapContact of one solved load.

    wetted: the solution. Its pressure includes the suction of the liquid, which is subtracted to get the pressure between
    solids.
    """
    suction = 0.0 if request.menisci is None else request.menisci.pressure
    solids = wetted.found.pressure if request.menisci is None else _of_solids(wetted.found.pressure, suction)
    free = (wetted.found.pressure > 0.0) & (wetted.found.pressure < request.hardness + suction)
    per_area = stiffness_per_area(problem.displacement, free, solids) if request.how.stiffness else math.nan
    certificate = certify(wetted.problem, wetted.found)
    solution = replace(wetted.found, pressure=to_numpy(wetted.found.pressure), gap=to_numpy(wetted.found.gap))
    gap, pressure, wet = solution.gap, to_numpy(solids), to_numpy(wetted.wet)
    nominal = request.size[0] * request.size[1]
    pixel = nominal / gap.size
    contact = solution.pressure > 0.0
    mean = float(solution.pressure.mean())
    plastic = int(np.count_nonzero(solution.pressure >= request.hardness + suction))
    sides = edges(pressure > 0.0, request.periodic)
    corrected = corrected_area(pressure, pixel, request.periodic, request.hardness)
    wanted = problem.mean + suction * float(wet.mean())
    error = abs(mean / wanted - 1.0)
    highest = float(request.heights.max())
    return MapContact(
        load=float(problem.mean) * nominal,
        mean_pressure=float(problem.mean),
        nominal_area=nominal,
        area=corrected,
        area_pixels=int(np.count_nonzero(contact)) * pixel,
        perimeter=sides.perimeter(gap.shape, request.size),
        separation=-solution.offset - float(request.heights.mean()),
        mean_gap=float(np.mean(gap, where=gap > 0.0)) * float(np.mean(gap > 0.0)) if (gap > 0.0).any() else 0.0,
        approach=highest + solution.offset if problem.displacement.has_mean else None,
        stiffness=per_area * nominal,
        plastic_area=plastic * pixel,
        plastic_share=plastic * request.hardness / float(pressure.sum()) if plastic else 0.0,
        residual=solution.residual,
        pressure_error=certificate.pressure_error,
        area_error=certificate.area_error,
        overlap=certificate.overlap,
        load_error=error,
        steps=solution.steps,
        points=int(np.count_nonzero(contact)),
        load_at_ends=share_at_ends(pressure) if request.ends else 0.0,
        validity_warnings=warnings_of_load(solution, error, request.ends, request.how.tolerance),
        pressure=pressure if request.how.keep_maps else None,
        pull=suction * (int(np.count_nonzero(wet)) * pixel - corrected) if suction else 0.0,
    )


def _of_solids(pressure: np.ndarray, suction: float) -> np.ndarray:
    """Return the pressure between the solids (rows, columns) [Pa]: the solved pressure minus the suction [Pa].

    Touching points get at least the smallest positive number, so that they still count as contact.
    """
    xp = namespace(pressure)
    return xp.clip(pressure - suction, sys.float_info.min, None) * factor(pressure > 0.0, pressure)
