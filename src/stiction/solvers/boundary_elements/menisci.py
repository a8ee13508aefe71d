"""Add the liquid between the faces of a map: a Laplace pressure acts wherever the gap is below a limit.

A liquid in equilibrium with its vapour fills every gap below H = 2 r c and pulls there with the suction s = gamma/r (gamma:
surface tension, r: Kelvin radius, c: mean cosine of the contact angles). Let B be the points with a gap below H, |B| their
area, P/A_n the mean pressure, h the heights, C the compliance operator and H_s the hardness of the solids. Let q >= 0 be the
contact pressure plus s on B. The pressure is p = q - s on B, and q solves the contact without liquid of

    heights  h + C(s on B),     mean pressure  P/A_n + s |B|/A_n,     hardness  H_s + s                                     (1)

B and q are computed alternately, beginning with B of the dry contact. Additional suction opens no gap: where a gap would open
most, the contact pressure q would have to fall, which more suction does not cause. Therefore B only grows, up to the smallest
set that satisfies (1). This is the set that vapour fills as it condenses around dry contacts. The model applies the attraction
of Maugis & Dugdale (Maugis 1992) at every point of a map; it is derived here. As in that model, the pressure at the edge of
contact is -s.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from stiction.quantities.inputs import require_positive
from stiction.solvers.boundary_elements.arrays import factor, namespace
from stiction.solvers.boundary_elements.minimise import Found, Problem, minimise

_ROUGHLY = 1e-3  # tolerance while the wet area still grows; only the last solution must be accurate


@dataclass(frozen=True)
class Menisci:
    """Describe the liquid between two faces.

    pressure: suction of the liquid [Pa]: surface tension divided by Kelvin radius. height: largest gap that the liquid fills
    [m]. Raises InputError unless both are > 0.
    """

    pressure: float
    height: float

    def __post_init__(self) -> None:
        require_positive(**{"menisci.pressure": self.pressure, "menisci.height": self.height})


@dataclass(frozen=True)
class Condensed:
    """Store the solution of a contact with condensed liquid.

    found: pressure q of (1) [Pa], which is 0 where the faces are apart, and gap [m], both (rows, columns). wet: mask (rows,
    columns) of the points with liquid. problem: the equivalent contact problem without liquid, whose heights, load and hardness
    include the suction.
    """

    found: Found
    wet: np.ndarray
    problem: Problem


def condense(
    problem: Problem, menisci: Menisci | None, start: np.ndarray, *, tolerance: float, most: int,
    seen: Callable[[int, float], None] | None = None,
) -> Condensed:  # fmt: skip
    """Solve a contact together with the liquid that condenses around its contact spots, and return it as `Condensed`.

    problem: the dry contact. menisci: the liquid, or None for a dry contact. start: first guess of the pressure (rows, columns)
    [Pa]. tolerance: largest accepted residual. most: largest number of steps of each solution; the contact is solved again
    after each change of the liquid. seen: called before each step with its number and the residual.
    """
    roughly = tolerance if menisci is None else max(tolerance, _ROUGHLY)
    solution = minimise(problem, start, tolerance=roughly, most=most, seen=seen)
    xp = namespace(solution.gap)
    wet = xp.zeros_like(solution.gap, dtype=xp.bool)
    if menisci is None:
        return Condensed(solution, wet, problem)
    finely, wetter = False, problem
    # The loop ends, because wet points stay wet and their number is finite; the last pass has the full tolerance.
    while xp.any(more := (solution.gap < menisci.height) & ~wet) or not finely:
        finely = not xp.any(more)
        wet = wet | more
        pressed = solution.pressure + menisci.pressure * factor(more, solution.gap)
        wetter = _with_suction(problem, menisci, wet)
        solution = minimise(wetter, pressed, tolerance=tolerance if finely else roughly, most=most, seen=seen)
    return Condensed(solution, wet, wetter)


def _with_suction(problem: Problem, menisci: Menisci, wet: np.ndarray) -> Problem:
    """Return the contact problem without liquid that is equivalent to `problem` with suction at the wet points.

    wet: mask (rows, columns) of the points with liquid. Heights, load and hardness are changed by the suction, see (1) of this
    module.
    """
    xp = namespace(wet)
    suction = menisci.pressure * xp.astype(wet, xp.float64)
    return replace(
        problem,
        heights=problem.heights + problem.displacement(suction),
        mean=problem.mean + float(xp.mean(suction)),
        hardness=problem.hardness + menisci.pressure,
    )
