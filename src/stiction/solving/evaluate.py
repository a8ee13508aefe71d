"""Evaluate the model of the 2015 paper quickly, with plain NumPy arrays without labels or units."""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from stiction.contact.indices import Groups, check_film
from stiction.engine.heights import gaussian
from stiction.engine.regime import Regime
from stiction.engine.summation import FARTHEST, check_threads, in_threads, scattered, totals_on_grid
from stiction.quantities.errors import InputError, InWords
from stiction.quantities.inputs import floats
from stiction.quantities.table import QUANTITIES
from stiction.quantities.units import has_unit
from stiction.solving.choice import Choice
from stiction.solving.problem import AsperitySum, problem_of

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

_POINTS, _LAWS = 16384, 4096  # most points, or parameter sets on a grid, that are computed at a time, to bound the memory


class Evaluation(NamedTuple):
    """Store the results of `evaluate`: dimensionless numbers per asperity.

    R is the asperity radius, sigma the standard deviation of the heights, and K = (4/3) E* with the contact modulus E*.

    Parameters
    ----------
    load, friction_force : ndarray (...)
        In units of K R^(1/2) sigma^(3/2).
    contact_area : ndarray (...)
        In units of pi R sigma.

    Examples
    --------
    >>> import stiction as st
    >>> st.evaluate(0.0, theta=40.0, lam=10.0)._fields
    ('load', 'contact_area', 'friction_force')
    """

    load: np.ndarray
    contact_area: np.ndarray
    friction_force: np.ndarray


def evaluate(
    h: "ArrayLike",
    theta: "ArrayLike",
    lam: "ArrayLike",
    nu: "ArrayLike" = 0.3,
    hardness_to_yield: "ArrayLike" = 2.8,
    n_E: "ArrayLike | None" = None,
    n_H: "ArrayLike | None" = None,
    tau: "ArrayLike | None" = None,
    variant: str = "corrected",
    threads: int = 1,
) -> Evaluation:
    """Compute load, contact area and friction of the 2015 model from arrays.

    Parameters
    ----------
    h : array_like (...)
        Mean separation in units of sigma, the standard deviation of the asperity heights.
    theta, lam : array_like (...)
        Elastic and plastic adhesion index, above 0.
    nu : array_like (...)
        Poisson's ratio, 0 or more and below 0.5.
    hardness_to_yield : array_like (...)
        Hardness divided by yield stress, 1 or more.
    n_E, n_H : array_like (...), optional
        Modulus and hardness of a film, divided by those of the substrate, above 0. Give n_E, n_H and tau together, or none
        of them.
    tau : array_like (...), optional
        Film thickness in units of sigma, 0 or more.
    variant : str
        "corrected", or "published" for the equations as published: friction then has exp(-(h+x)^2/2) in place of the normal
        density, and the contact area, which is not printed, follows eq. 1.
    threads : int
        Number of threads, 1 or more; it does not affect the results.

    Returns
    -------
    Evaluation
        float64 arrays in the broadcast shape of all arguments. Relative errors are at most 1e-10; the error of the load is
        relative to the integral of its absolute value.

    Raises
    ------
    InputError
        A value is not finite or out of bounds, or shapes do not broadcast.

    Notes
    -----
    Equations: docs/explanation/theory.md, sections 2 to 4. The computation is fastest if h varies along axes of its own.

    Examples
    --------
    >>> import stiction as st
    >>> st.evaluate([0.0, 1.0], theta=40.0, lam=10.0).load.round(4)
    array([0.4191, 0.0638])
    """
    numbers: dict[str, Any] = {"theta": theta, "lam": lam, "nu": nu, "hardness_to_yield": hardness_to_yield}
    film = {"n_E": n_E, "n_H": n_H, "tau": tau}
    missing = [name for name, value in film.items() if value is None]
    if missing and len(missing) < len(film):
        raise InputError(missing[0], None, "n_E, n_H and tau together, or none of them")
    if not missing:
        numbers |= film
    check_threads(threads)
    choice = Choice(options={"variant": variant})
    columns = [_separations(h), *(_checked(name, value) for name, value in numbers.items())]
    try:
        shape = np.broadcast_shapes(*(column.shape for column in columns))
    except ValueError:
        shapes = ", ".join(str(column.shape) for column in columns)
        raise InputError("h and groups", InWords(f"shapes {shapes}"), "shapes that NumPy can broadcast together") from None
    columns = [column.reshape((1,) * (len(shape) - column.ndim) + column.shape) for column in columns]
    separation, laws = columns[0], dict(zip(numbers, columns[1:], strict=True))
    if not missing:
        check_film(*(laws[name] for name in ("theta", "lam", "n_E", "n_H")))
    law_shape = np.broadcast_shapes(*(column.shape for column in laws.values()))
    own_axes = all(own == 1 or other == 1 for own, other in zip(separation.shape, law_shape, strict=True))
    if own_axes and separation.size > 1:
        return _on_grid(separation, laws, law_shape, shape, choice, threads)
    return _scattered(separation, laws, shape, choice, threads)


def _array(value, name: str, allowed: str) -> np.ndarray:
    """Return a value as an array of floats; raise InputError for anything else.

    name, allowed: field and allowed values, for the error message. A value with a unit also raises InputError, because
    NumPy would drop the unit silently.
    """
    if has_unit(value):
        raise InputError(name, str(value), f"{allowed}, without a unit")
    return floats(value, name, allowed)


def _checked(name: str, value) -> np.ndarray:
    """Return the value as an array of floats; raise InputError if it is outside the bounds of the quantity `name`."""
    quantity = QUANTITIES[name]
    array = _array(value, name, quantity.allowed)
    if array.size == 0:
        return array
    ends = np.array([array.min(), array.max()])  # either is NaN if any element is
    held = quantity.holds(ends)
    if not held.all():
        raise InputError(name, float(ends[~held][0]), quantity.allowed)
    return array


def _separations(h) -> np.ndarray:
    allowed = f"finite, {-FARTHEST:g} to {FARTHEST:g}"
    array = _array(h, "h", allowed)
    wrong = ~(np.abs(array) <= FARTHEST)
    if wrong.any():
        raise InputError("h", float(array[wrong][0]), allowed)
    return array


def _regimes(laws: dict[str, np.ndarray], choice: Choice) -> list[Regime]:
    """Return the regimes (smooth parts) of the model of the 2015 paper for many sets of dimensionless groups.

    laws: flat arrays of the groups, by name. A film is assumed to have the Poisson's ratio and the work of adhesion of the
    substrate, and to act as a half-space.
    """
    ones = np.ones_like(laws["nu"])
    film = {"n_g": ones, "film_aspect": np.inf * ones} if "tau" in laws else {}
    problem = problem_of(Groups(**laws, **film).resolved(), choice)
    assert isinstance(problem, AsperitySum)  # the 2015 model is a sum over asperities
    return problem.regimes


def _chunks(columns: list[np.ndarray], size: int) -> Iterator[tuple[slice, list[np.ndarray]]]:
    """Yield the columns, broadcast against each other, in flat chunks of at most `size` elements in C order.

    Each chunk is yielded as (slice of the flat result, columns of the chunk). Only one chunk at a time is copied.
    """
    start = 0
    pieces_of: Any = np.nditer(columns, flags=["external_loop", "buffered", "zerosize_ok"], order="C", buffersize=size)
    for piece in pieces_of:
        pieces = [np.array(part) for part in (piece if isinstance(piece, tuple) else (piece,))]
        stop = start + pieces[0].size
        yield slice(start, stop), pieces
        start = stop


def _scattered(separation, laws, shape, choice, threads) -> Evaluation:
    out = Evaluation(*(np.empty(shape) for _ in Evaluation._fields))
    flat = [array.reshape(-1) for array in out]

    def fill(chunk):
        where, (h, *pieces) = chunk
        regimes = _regimes(dict(zip(laws, pieces, strict=True)), choice)
        _, load, area, slip_limited, yield_limited = scattered(regimes, h, gaussian()).sum(axis=0).T
        for column, total in zip(flat, (load, area, slip_limited + yield_limited), strict=True):
            column[where] = total

    in_threads(fill, _chunks([separation, *laws.values()], _POINTS), threads)
    return out


def _on_grid(separation, laws, law_shape, shape, choice, threads) -> Evaluation:
    h = separation.reshape(-1)
    table = np.empty((int(np.prod(law_shape)), len(Evaluation._fields), h.size))

    def fill(chunk):
        where, pieces = chunk
        regimes = _regimes(dict(zip(laws, pieces, strict=True)), choice)
        totals_on_grid(regimes, h, gaussian(), out=table[where])

    in_threads(fill, _chunks(list(laws.values()), _LAWS), threads)
    # The table has laws and separations flattened; every axis of the result belongs to one of the two.
    of_laws = [axis for axis, length in enumerate(separation.shape) if length == 1]
    order = of_laws + [axis for axis in range(len(shape)) if axis not in of_laws]
    permuted = tuple(shape[axis] for axis in order)
    back = np.argsort(order)
    return Evaluation(*(np.reshape(table[:, column], permuted).transpose(back) for column in range(table.shape[1])))
