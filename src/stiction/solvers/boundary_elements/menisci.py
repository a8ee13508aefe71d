"""Liquid between the faces of a map: Laplace's pressure wherever the gap is less than a meniscus is high.

In equilibrium with its vapour a liquid fills every gap below H = 2 r c and pulls there with gamma/r (r: Kelvin's radius, c:
mean cosine of the contact angles). With s this suction, B the points of g < H, and q >= 0 what is pressed against it where they
touch, the pressure is p = q - s on B, and q solves the contact without liquid of

    heights  h + C(s on B),     mean pressure  P/A_n + s |B|/A_n,     hardness  H_s + s                                     (1)

B and q are found in turns, from B of the dry contact on. Suction nowhere opens a gap (where the opening of two solutions is
largest their difference would have to be pressed there by less, which it is not), so B grows until it is the smallest that
(1) agrees with: that which vapour fills as it condenses around dry contacts. The attraction of Maugis & Dugdale (Maugis 1992)
at every point of a map; derived here. The pressure at the edge of contact is -s, as there.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from stiction.quantities.errors import InputError
from stiction.solvers.boundary_elements.minimise import Found, Problem, minimise

_ROUGHLY = 1e-3  # residual of solutions that only say how far the liquid reaches


@dataclass(frozen=True)
class Menisci:
    """The liquid menisci between two faces.

    pressure: suction gamma/r of the liquid [Pa]. height: largest gap that it fills, 2 r c [m]. Raises InputError unless both
    are > 0.
    """

    pressure: float
    height: float

    def __post_init__(self) -> None:
        for name in ("pressure", "height"):
            if not (0.0 < getattr(self, name) < math.inf):
                raise InputError(f"menisci.{name}", getattr(self, name), "> 0, finite")


@dataclass(frozen=True)
class Condensed:
    """The solution of a contact with condensed liquid.

    found: solution of problem (1): contact pressure plus suction q [Pa], and the gap. wet: bool map of the points with
    liquid. problem: problem (1).
    """

    found: Found
    wet: np.ndarray
    problem: Problem


def condense(
    problem: Problem, menisci: Menisci | None, start: np.ndarray, *, tolerance: float, most: int,
    seen: Callable[[int, float], None] | None = None,
) -> Condensed:  # fmt: skip
    """Solve a contact together with the liquid that condenses around the dry contact.

    problem: the dry contact. menisci: the liquid, or None for a dry contact. Other arguments: as in `minimise`.
    """
    roughly = tolerance if menisci is None else max(tolerance, _ROUGHLY)
    solution = minimise(problem, start, tolerance=roughly, most=most, seen=seen)
    wet = np.zeros(solution.gap.shape, dtype=bool)
    if menisci is None:
        return Condensed(solution, wet, problem)
    finely, wetter = False, problem
    while (more := (solution.gap < menisci.height) & ~wet).any() or not finely:  # ends, as there are so many points and no more
        finely = not more.any()
        wet = wet | more
        wetter, pressed = _with_suction(problem, menisci, wet), solution.pressure + menisci.pressure * more
        solution = minimise(wetter, pressed, tolerance=tolerance if finely else roughly, most=most, seen=seen)
    return Condensed(solution, wet, wetter)


def _with_suction(problem: Problem, menisci: Menisci, wet: np.ndarray) -> Problem:
    """Return problem (1), with suction at the wet points."""
    suction = np.where(wet, menisci.pressure, 0.0)
    return replace(
        problem,
        heights=problem.heights + problem.displacement(suction),
        mean=problem.mean + float(suction.mean()),
        hardness=problem.hardness + menisci.pressure,
    )
