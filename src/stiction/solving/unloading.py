"""Solve the unloading of rough surfaces: two surfaces were pressed together and are drawn apart again.

A yielded asperity unloads along a curve that differs from the loading curve. An adhesive asperity stays in contact until it
pulls off. Both effects depend on the smallest separation h_0 that was reached: an asperity of height z was compressed by z -
h_0, and at the separation h its interference is z - h. For each increase h - h_0 of the separation, a separate asperity law is
summed over the heights.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Any, Unpack

import numpy as np

from stiction.contact.indices import Groups
from stiction.contact.subject import Subject, as_subject
from stiction.engine.blocks import in_blocks
from stiction.engine.heights import Heights
from stiction.engine.summation import FARTHEST
from stiction.laws.asperity.shared.unloading import unloaded_segments
from stiction.laws.joining import coordinates, within
from stiction.laws.segment import NormalSegment
from stiction.laws.validity import with_warnings
from stiction.quantities.dimensions import aligned, dimensions, variable
from stiction.quantities.errors import InputError, InWords, field_named
from stiction.quantities.keywords import with_keywords
from stiction.quantities.table import QUANTITIES
from stiction.records.registry import AsperityLaw, RoughSurface, TangentialLaw, find
from stiction.solving.choice import Choice, LawKeywords
from stiction.solving.conditions import warnings_of_rounding
from stiction.solving.inversion import largest_tension
from stiction.solving.points import (
    Points,
    check_reach,
    coordinates_of,
    in_words,
    normalised,
    points_of,
    requested_points,
    solve_points,
)
from stiction.solving.problem import AsperitySum, make_problem, with_requested_load
from stiction.solving.results import labelled, summary_of

if TYPE_CHECKING:
    import xarray

    from stiction.quantities.arguments import QuantityLike

_LAW_OF_ITS_OWN = 2  # memory that one separation needs, in points, from which the size of blocks follows
# Number of separations among which the largest tension is searched, denser near the smallest separation; and fraction of the
# contact area that is left at the last of them.
_STEPS, _LEFT = 81, 1e-10
_ROUNDING = 1e-12  # accepted relative error of a separation that a user copies from an earlier result


@with_keywords(LawKeywords)
def unload(
    contact: Subject,
    *,
    min_separation: "QuantityLike | None" = None,
    max_load: "QuantityLike | None" = None,
    separation: "QuantityLike | None" = None,
    separation_increase: "QuantityLike | None" = None,
    model: str = "greenwood_williamson_1966",
    heights: Heights | str | None = None,
    **laws: Unpack[LawKeywords],
) -> "xarray.Dataset":
    """Solve a contact that was pressed together and is being drawn apart.

    Parameters
    ----------
    contact : Contact or Indices
        As in `solve`, without film and liquid.
    min_separation : float [m], str with a unit, or array, optional
        Smallest mean separation that was reached; in units of sigma for Indices.
    max_load : float [N], str with a unit, or array, optional
        Load at the smallest separation, in place of `min_separation`.
    separation : float [m], str with a unit, or array, optional
        Mean separations during unloading, not below the smallest one.
    separation_increase : float [m], str with a unit, or array, optional
        Increase of the mean separation above the smallest one, in place of `separation`.
    model : str
        Key of a model that sums over an asperity law.
    heights : Heights or str, optional
        As in `solve`.
    **laws : str, optional
        As in `solve`: `asperity`, or `tangential` for a law of the interface; by default no friction is computed.

    Returns
    -------
    xarray.Dataset
        As from `solve`, with min_separation [m] and pull_off_force [N], the largest tension during unloading; with an adhesive
        asperity law also pull_off_separation [m] and zero_load_separation [m], where the load is zero.

    Raises
    ------
    InputError
        A value is out of bounds or missing, the contact has a film or a liquid, or the laws do not describe unloading.

    Notes
    -----
    Elastic asperities follow the loading curve backwards; adhesive asperities that have touched stay in contact below zero
    displacement. Yielded asperities unload by their own law (thornton_ning_1998) or, without adhesion, as flattened elastic
    spheres with a residual interference. Results by state refer to the state of asperities at the smallest separation.

    Examples
    --------
    >>> import stiction as st
    >>> back = st.unload(st.Indices(hardness_group=0.1), max_load=1.0, separation_increase=[0.0, 0.1])
    >>> bool(back["load"][1] < back["load"][0])
    True
    """
    unloading = _make_unloading(contact, Choice.of(model, {"tangential": "none"} | laws), heights)
    subject = unloading.pressed.subject
    is_load = max_load is not None
    turn_value = _one_of(subject, min_separation=min_separation, max_load=max_load)
    turn = points_of(unloading.pressed, **{"load" if is_load else "separation": turn_value})
    point, factors = _one_of(subject, separation=separation, separation_increase=separation_increase), turn.factors
    dims = dimensions([point], turn.dims)
    shape = tuple(dims.values())
    nearest = _nearest(turn)
    turned = np.broadcast_to(nearest.reshape(nearest.shape + (1,) * (len(shape) - nearest.ndim)), shape)
    is_increase = separation_increase is not None
    wanted = normalised(point, factors["m"], dims)
    apart = _apart(subject, turned, wanted, np.broadcast_to(aligned(factors["m"], dims), shape), is_increase)
    results = unloading.at(unloading.rows(shape), turned, apart)
    validity_warnings = []
    if is_load:
        asked = np.where(apart == 0.0, normalised(turn.value, factors["N"], dims), results["load"])
        validity_warnings = warnings_of_rounding(results["load"], asked)
        results = with_requested_load(results, asked)
    tables = {"mean_separation": turned + apart if separation is None else wanted} | results
    data = labelled(subject, tables, factors, dims, unloading.pressed.coords | coordinates_of(turn.value, point))
    data = data.merge(_ends(unloading, nearest, factors, turn.dims))
    if "mean_separation" in getattr(point, "dims", ()):  # the values as the user gave them become the coordinate
        attributes = data["mean_separation"].attrs
        data = data.drop_vars("mean_separation").assign_coords(mean_separation=("mean_separation", point.values, attributes))
    for name in _DESCRIBED:
        if name in data.coords:
            data[name].attrs = _described(subject, name)
    return with_warnings(data.assign_attrs(unloading.summary(tables)), validity_warnings)


# Results that are not in the table of quantities: the quantity whose unit each has, and its description.
_DESCRIBED = {
    "min_separation": ("mean_separation", "smallest mean separation during loading"),
    "max_load": ("load", "normal load at the smallest mean separation"),
    "separation_increase": ("mean_separation", "increase of the mean separation since the smallest one"),
    "pull_off_separation": ("mean_separation", "mean separation at the largest tension; NaN if there is no tension"),
    "zero_load_separation": (
        "mean_separation",
        "mean separation at which the load has fallen to 0; NaN if it never does",
    ),
}


def _described(subject: Subject, name: str) -> dict[str, str]:
    """Return the attributes (unit, long name, description) of a result variable named in _DESCRIBED."""
    like, meaning = _DESCRIBED[name]
    symbol = QUANTITIES[name].symbol if name in QUANTITIES else ""
    return subject.attributes(like) | {"long_name": name.replace("_", " "), "comment": meaning, "symbol": symbol}


@dataclass(frozen=True)
class _Unloading:
    """Represent the unloading of n contacts.

    pressed: the problem during loading. released: function of (groups, distance, **own options of the asperity law) that
    returns the segments after the separation has grown by `distance`, in units of sigma, since the turning point. how: text on
    the assumption about the asperities.
    """

    pressed: AsperitySum
    released: Callable
    how: str

    def apart(self, rows: np.ndarray, distance: np.ndarray) -> AsperitySum:
        """Return the problem of contacts after each was drawn apart by its own distance (m,), in units of sigma.

        rows (m,): index of the contact for each distance.
        """

        def segments(groups, **options):
            return self.released(groups, distance, **options)

        asperity = replace(self.pressed.law.asperity, segments=segments)
        return replace(self.pressed, groups=self.pressed.groups[rows], chosen=replace(self.pressed.chosen, asperity=asperity))

    def rows(self, shape: tuple[int, ...]) -> np.ndarray:
        """Return an array of this shape with the index of the contact at each point; dimensions of the contacts come first."""
        laws = len(self.pressed.groups)
        return np.repeat(np.arange(laws), math.prod(shape) // laws).reshape(shape)

    def at(self, rows: np.ndarray, nearest: np.ndarray, distance: np.ndarray, only: str | None = None) -> dict[str, np.ndarray]:
        """Return normalised results during unloading by name, or only the result named `only`, as arrays of the same shape.

        rows: index of the contact at each point. nearest: smallest separation. distance: increase of the separation above
        the smallest one. All three have the shape of the results; separations are in units of sigma.
        """
        row, apart, h = (table.reshape(-1) for table in (rows, distance, nearest + distance))

        def summed(some: slice) -> dict[str, np.ndarray]:
            found = self.apart(row[some], apart[some]).at(h[some, None])
            return {name: table[:, 0] for name, table in found.items() if only in (None, name)}

        return {name: table.reshape(rows.shape) for name, table in in_blocks(summed, h.size, _LAW_OF_ITS_OWN).items()}

    def summary(self, tables: Mapping[str, np.ndarray]) -> dict[str, str]:
        chosen = self.pressed.chosen
        chosen = chosen.with_option("branch", "unloading") if "branch" in chosen.options else chosen
        known = summary_of(self.pressed.subject, replace(self.pressed, chosen=chosen), tables)
        title = f"Unloading of {known['asperity']} after {known['model']}"
        return known | {"title": title, "grade": max(known["grade"], "B"), "unloading": self.how}


def _one_of(subject: Subject, **either: Any) -> Any:
    """Return the value of whichever of two alternative arguments is given.

    either: the two arguments by name; None if not given. A sequence becomes an array with a named dimension. Raises
    InputError unless exactly one is given.
    """
    given = [name for name, value in either.items() if value is not None]
    if len(given) != 1:
        raise InputError(" and ".join(either), InWords("both given") if given else None, "exactly one of the two")
    name, quantity = given[0], "load" if given[0] == "max_load" else "mean_separation"
    with field_named(name):
        value = requested_points(subject, quantity, either[name])
    if not np.size(value):
        raise InputError(name, InWords("no values"), "at least one value")
    if quantity not in getattr(value, "dims", ()) or name == "separation":
        return value
    return value.rename({quantity: name}) if hasattr(value, "coords") else variable((name,), value.values)


def _make_unloading(contact: Subject, choice: Choice, heights) -> _Unloading:
    """Build the `_Unloading` of a contact under selected laws; raise InputError if the laws do not define unloading."""
    if choice.options.get("branch") is not None:
        raise InputError("branch", choice.options["branch"], "no value, because unload() always follows the unloading branch")
    for name, key in choice.laws().items():
        if key is not None and name not in ("model", "asperity", "tangential"):
            raise InputError(name, key, "not supported by unload()")
    tangential = choice.tangential or "none"
    if tangential != "none" and not find(tangential, TangentialLaw).interfacial:
        reason = f"{tangential} is valid only for loading"
        raise InputError("tangential", tangential, f"none, or a law of interface strength: {reason}")
    if as_subject(contact).indices().meniscus_index is not None:
        raise InputError("contact", InWords("has a liquid"), "no liquid, because unload() does not support menisci")
    if as_subject(contact).has_film:
        raise InputError("contact", InWords("has a film"), "no film, because unload() does not support films")
    model = find(choice.model_key, RoughSurface)
    if not model.asperity:
        raise InputError("model", choice.model_key, "a sum over asperities, because unload() follows each asperity")
    if model.regimes is not None:
        reason = f"the source of {choice.model_key} does not describe unloading"
        raise InputError("model", choice.model_key, f"another sum over asperities: {reason}")
    problem = make_problem(contact, choice, heights)
    assert isinstance(problem, AsperitySum)  # because the model has an asperity law
    released, how = _released(problem.law.asperity, problem)
    return _Unloading(problem, released, how)


def _released(law: AsperityLaw, problem: AsperitySum) -> tuple[Callable, str]:
    """Return the function that computes the segments of an asperity law during unloading, and a text on its assumption.

    The function takes (groups, increase of the separation in units of sigma, **options). Raises InputError if the law does
    not define unloading.
    """
    if law.released is not None:
        return law.released, f"by the unloading law of {law.key}"
    if all(segment.state == "elastic" for segment in problem.law.segments(problem.groups)):
        how = "elastic: the asperities follow their loading curve backwards"
        if "branch" in law.own_options:
            how += ", then stay attached until they are pulled off"
        return partial(_held_on, law), how
    if "no adhesion" in law.traits:
        how = "elastic spheres whose flattened shape gives the load and area of each asperity at its deepest compression"
        return (lambda groups, distance, **options: unloaded_segments(law.segments(groups, **options), distance)), how
    reason = f"the source of {law.key} does not describe unloading"
    raise InputError("asperity", law.key, f"a law that is elastic, without adhesion, or has an unloading law: {reason}")


def _held_on(law: AsperityLaw, groups: Groups, distance: np.ndarray, **options: str) -> list[NormalSegment]:
    """Return the segments of an elastic asperity law during unloading, for asperities that have touched.

    distance: increase of the separation above the smallest one, in units of sigma. Asperities that never touched carry no
    load.
    """
    options = options | ({"branch": "unloading"} if "branch" in options else {})
    return [within(segment, coordinates(segment, -distance), np.inf) for segment in law.segments(groups, **options)]


def _nearest(turn: Points) -> np.ndarray:
    """Return the smallest mean separations reached during loading, in units of sigma, in the shape of the points.

    turn: the smallest separations or largest loads given by the user, as points.
    """
    if turn.name == "mean_separation":
        check_reach(turn.wanted, "min_separation")
        return turn.wanted
    with in_words(turn):
        return solve_points(turn).tables["mean_separation"]


def _apart(subject: Subject, nearest: np.ndarray, wanted: np.ndarray, unit: np.ndarray, is_increase: bool) -> np.ndarray:
    """Return the increases of the separation above the smallest ones, in units of sigma.

    nearest: smallest separations. wanted: requested increases if `is_increase`, else separations. unit: factor by which
    normalised separations are multiplied. All arrays have the same shape. Raises InputError for a separation below the smallest
    one, and for too large an increase.
    """
    distance = wanted if is_increase else wanted - nearest
    short = distance < (0.0 if is_increase else -_ROUNDING * np.maximum(np.abs(nearest), 1.0))
    if not np.abs(distance).max(initial=0.0) <= FARTHEST:
        name = "separation_increase" if is_increase else "separation"
        farthest = float((np.abs(wanted) * unit).max())
        raise InputError(
            name, subject.show(farthest, "mean_separation"), f"within {FARTHEST:g} sigma of the smallest separation"
        )
    if short.any():
        point = tuple(np.argwhere(short)[0])
        given, pressed = (
            subject.show(separations[point] * unit[point], "mean_separation") for separations in (wanted, nearest)
        )
        if is_increase:
            raise InputError("separation_increase", given, "0 or more")
        raise InputError("separation", given, f"{pressed} or more, the smallest separation during loading")
    return np.maximum(distance, 0.0)


def _ends(unloading: _Unloading, nearest: np.ndarray, factors: Mapping[str, Any], dims: dict[str, int]) -> "xarray.Dataset":
    """Return a dataset: smallest separation, largest tension and its separation, and separation of zero load.

    nearest: smallest separations in units of sigma. Without adhesion the tension is 0, and the separations of largest
    tension and of zero load are omitted.
    """
    tables = {"pull_off_force": np.zeros(nearest.shape)}
    if unloading.pressed.adheres:
        tension = _tension(unloading, unloading.rows(nearest.shape).reshape(-1), nearest.reshape(-1))
        names = "pull_off_force", "pull_off_separation", "zero_load_separation"
        tables |= {name: table.reshape(nearest.shape) for name, table in zip(names, tension, strict=True)}
    own = {name: tables.pop(name) for name in _DESCRIBED if name in tables}
    if "min_separation" not in dims:  # as a dimension it already is a coordinate
        own["min_separation"] = nearest
    subject = unloading.pressed.subject
    data = labelled(subject, tables, factors, dims, {})
    for name, table in own.items():
        like = _DESCRIBED[name][0]
        data[name] = labelled(subject, {like: table}, factors, dims, {})[like].assign_attrs(_described(subject, name))
    return data


def _tension(unloading: _Unloading, rows: np.ndarray, nearest: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the largest tension during unloading, its separation, and the separation of zero load, each (m,).

    rows, nearest (m,): index of the contact and its smallest separation. Tensions are normalised, separations in units of
    sigma. Without tension the first is 0 and its separation NaN. The last is NaN if the load never falls below 0.
    """
    from scipy.optimize.elementwise import find_root

    every = np.arange(rows.size)

    def load(distance, pair):
        pair = np.broadcast_to(pair.astype(int), distance.shape)
        return unloading.at(rows[pair], nearest[pair], distance, "load")["load"]

    distance = _reach(unloading, rows, nearest)[:, None] * np.linspace(0.0, 1.0, _STEPS) ** 3
    loads = load(distance, every[:, None])
    tension, where = largest_tension(load, distance, loads)
    # The load is zero where a compressive load first turns to tension.
    zero = np.full(rows.size, np.nan)
    turns = (loads[:, 0] > 0.0) & (loads.min(axis=1) < 0.0)
    if turns.any():
        pair, at = every[turns], np.argmax(loads < 0.0, axis=1)[turns]
        root = find_root(load, (distance[pair, at - 1], distance[pair, at]), args=(pair.astype(float),))
        if not root.success.all():
            raise ArithmeticError(f"{np.sum(~root.success)} of {pair.size} separations at zero load did not converge")
        zero[turns] = root.x
    return tension, nearest + where, nearest + zero


def _reach(unloading: _Unloading, rows: np.ndarray, nearest: np.ndarray) -> np.ndarray:
    """Return the increases of separation (m,), in units of sigma, at which almost no contact area is left.

    rows, nearest (m,): index of the contact and its smallest separation.
    """

    def area(distance):
        return unloading.at(rows, nearest, distance, "contact_area")["contact_area"]

    reach, most = np.ones(rows.size), _LEFT * area(np.zeros(rows.size))
    while (left := area(reach) > most).any():
        if (reach > FARTHEST).any():
            raise ArithmeticError("no separation was found at which the surfaces come apart")
        reach[left] *= 2.0
    while (lost := area(reach / 2.0) <= most).any() and (reach > 1e-6).all():
        reach[lost] /= 2.0
    return reach
