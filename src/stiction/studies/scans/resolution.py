"""Compute how roughness parameters and friction change with the asperity method and the cutoff wavelength."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache, partial
from numbers import Real
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction.contact.contact import Contact
from stiction.contact.indices import Groups
from stiction.quantities.errors import InputError, InWords
from stiction.quantities.progress import Steps
from stiction.quantities.units import to_si
from stiction.records.registry import RoughSurface, find
from stiction.solving.candidates import choice_of, with_interface
from stiction.solving.choice import Choice
from stiction.solving.method_spread import METHOD
from stiction.solving.solve import solve
from stiction.studies.case_results import require_choice
from stiction.studies.prediction.predict import case_given, predict
from stiction.studies.prediction.unused import refusal_of
from stiction.surfaces.filters import filter_band, filter_period
from stiction.surfaces.finding import Asperities, asperities, method_of_moments, methods_for
from stiction.surfaces.height_model import HeightModel, height_model, roughness
from stiction.surfaces.heightmap import HeightMap, in_metres
from stiction.surfaces.held import as_height_map
from stiction.surfaces.measured import of_one_map
from stiction.surfaces.spectrum import POINTS_PER_WAVE

if TYPE_CHECKING:
    import xarray

    from stiction.quantities.arguments import QuantityLike

# Stored numbers of each set of asperities: (name of the field, meaning, unit).
_KEPT = {
    "sigma": ("deviation", "asperity deviation", "m"),
    "R": ("radius", "asperity radius", "m"),
    "N": ("density", "asperities per area", "1/m^2"),
    "mean_height": ("mean_height", "mean asperity height", "m"),
    "skewness": ("skewness", "asperity skewness", "1"),
    "count": ("count", "asperities found", "1"),
}
_FRICTION = "mu"

# Number of default cutoffs besides 0, and number of the longest cutoff wavelengths that must fit into the map. With fewer,
# the map has too few asperities for their statistics.
_CUTOFFS = 7
_WAVES_IN_SIZE = 10


def default_cutoffs(surface: HeightMap, shortest: float = 0.0) -> np.ndarray:
    """Return the default cutoff wavelengths [m]: 0 (unfiltered), then seven in geometric progression.

    The seven run from POINTS_PER_WAVE times the larger point spacing, or from `shortest` [m] if this is longer, to a tenth of
    the map's shorter side. If the map is too small for this range, only 0 is returned.
    """
    sizes = surface.size[1:] if surface.is_profile else surface.size
    shortest, longest = max(POINTS_PER_WAVE * surface.coarsest_pitch, shortest), min(sizes) / _WAVES_IN_SIZE
    if shortest > longest:
        return np.zeros(1)
    return np.concatenate([[0.0], np.geomspace(shortest, longest, _CUTOFFS)])


@dataclass(frozen=True)
class _Friction:
    """Store the contact, load and model with which friction is computed; without friction, contact and load are None.

    load: above 0, in N or as text with a unit. choice: the model and its laws, or None for a prediction. Raises InputError if
    contact, load or model are invalid for every surface.
    """

    contact: Contact | None
    load: Any
    choice: Choice | None

    def __post_init__(self) -> None:
        if (self.contact is None) != (self.load is None):
            missing, given = ("load", "contact") if self.load is None else ("contact", "load")
            raise InputError(missing, None, f"both contact and load, or neither; {given} is given")
        if self.contact is None:
            return
        if not isinstance(self.contact, Contact):
            raise InputError("contact", type(self.contact).__name__, "a stiction.Contact")
        for name, array in self.contact.arrays():
            raise InputError(f"contact.{name}", InWords(f"array of shape {array.shape}"), "one number")
        asked = to_si(self.load, "load")
        if np.ndim(asked) or not asked > 0.0:
            raise InputError("load", self.load, "one load > 0 N")
        if self.choice is None:
            if (refusal := refusal_of(case_given(self.contact, self.load))) is not None:
                raise refusal
            return
        groups, _ = Groups.of(self.contact.indices())
        tangential = with_interface(self.choice, groups).tangential or find(self.choice.model_key, RoughSurface).tangential
        if tangential == "none":
            raise InputError("model", self.choice.model_key, "a model with friction")

    @property
    def of_map(self) -> bool:
        """Return whether a model that solves the height map itself, instead of using asperities, was chosen."""
        return self.choice is not None and find(self.choice.model_key, RoughSurface).of_map is not None

    @property
    def arguments(self) -> Mapping[str, Any]:
        """Return the chosen model, laws and options as arguments of `solve`; {} for a prediction."""
        return {} if self.choice is None else self.choice.arguments()

    def coefficient(
        self, seen: HeightMap, to_solve: HeightMap, found: Asperities, heights: HeightModel, options: Mapping[str, Any]
    ) -> float:
        """Return the static friction coefficient of the contact with this surface by the chosen model.

        seen: filtered map; theories of the whole surface use its spectral moments. to_solve: map for models that solve a map.
        found, heights: asperities of the surface and their height distribution, for all other models. options: options of
        asperity methods, by method.
        """
        assert self.contact is not None and self.choice is not None
        if find(self.choice.model_key, RoughSurface).takes_surface_moments:
            key = method_of_moments()
            found = asperities(seen, key, **options.get(key, {}))
            heights = height_model(found)
        one = roughness(found, heights)
        if self.of_map:
            one = one.attached(measured=of_one_map(one, found, to_solve))
        other = self.contact.model_copy(update={"roughness": one})
        return float(solve(other, load=self.load, **self.arguments)["friction_coefficient"])

    def predicted(self, surface: HeightMap) -> float:
        """Return the median friction coefficient that `predict` returns for the contact with this surface."""
        assert self.contact is not None
        return float(predict(self.contact.replace(roughness=surface), load=self.load)["friction_coefficient"])


def resolution_study(
    surface: HeightMap,
    cutoffs: Iterable[float | str] | None = None,
    methods: Iterable[str] | None = None,
    *,
    options: "Mapping[str, Mapping[str, QuantityLike | None]] | None" = None,
    points_per_cutoff: float | None = None,
    progress: Steps = iter,
    contact: Contact | None = None,
    load: "QuantityLike | None" = None,
    choice: Choice | None = None,
) -> "xarray.Dataset":
    """Compute roughness parameters and friction of a scan against the cutoff wavelength.

    Parameters
    ----------
    surface : HeightMap
        Levelled heights (rows, columns) [m].
    cutoffs : iterable of float [m] or str with a unit, optional
        Wavelengths at which the Gaussian low-pass halves the amplitude; 0 leaves the map unfiltered.
    methods : iterable of str, optional
        Keys of asperity methods; by default all methods that the map allows.
    options : dict of dict, optional
        Options of each method, by its key.
    points_per_cutoff : float, optional
        Smallest number of points per cutoff wavelength, 2 or more. Only every k-th point is then used, with the largest k that
        satisfies this; by default all points are used.
    progress : callable
        Receives the list of cutoffs and returns an iterable over it.
    contact : Contact, optional
        Contact without arrays. The roughness of the scan replaces its roughness; without a contact, no friction is computed.
    load : float [N] or str with a unit, optional
        Load of the contact, above 0.
    choice : Choice, optional
        Model and laws that compute mu; by default mu is the median of the prediction.

    Returns
    -------
    xarray.Dataset
        Over (asperity_method, cutoff): sigma [m], R [m] and N [1/m^2], the height deviation, radius and density of asperities;
        mean_height [m], skewness and count of asperities; height_distribution, the name of the fitted distribution; with a
        contact also mu, the friction coefficient; and `failure`, the reason why numbers are NaN.

    Raises
    ------
    InputError
        A cutoff, method, option, contact, load or choice is not usable.

    Notes
    -----
    Predictions and boundary_elements use the map itself; theories of the whole surface use its spectral moments. Their mu is
    the same for every asperity method.

    Examples
    --------
    >>> import stiction as st
    >>> target = st.SelfAffine(hurst=0.8, rolloff="2 um", shortest="400 nm", deviation="10 nm")
    >>> surface = st.gaussian_surface((64, 64), ("10 um", "10 um"), target, seed=1)
    >>> study = st.resolution_study(surface, ["0.5 um", "1 um"], ["mccool"])
    >>> bool((study.R.diff("cutoff") > 0).all())
    True
    """
    surface = as_height_map(surface, "surface")
    wanted = _cutoffs(default_cutoffs(surface) if cutoffs is None else cutoffs)
    keys = _methods(surface, methods)
    asked = _Friction(contact, load, None if choice is None else _resolved(choice, contact))
    given = options or {}
    if set(given) - set(keys):
        raise InputError("options", tuple(given), f"options of these methods only: {', '.join(keys)}")
    names = [*_KEPT, _FRICTION] if contact is not None else [*_KEPT]
    numbers = {name: np.full((len(keys), len(wanted)), math.nan) for name in names}
    words = {name: np.full((len(keys), len(wanted)), "", dtype=object) for name in ("height_distribution", "failure")}
    for j, cutoff in enumerate(progress(wanted.tolist())):
        seen = _seen(surface, cutoff, points_per_cutoff)
        to_solve = _to_solve(surface, seen, cutoff) if asked.of_map or choice is None else seen
        predicted = cache(partial(asked.predicted, to_solve))  # the same for every method
        for i, key in enumerate(keys):
            try:
                found = asperities(seen, key, **given.get(key, {}))
                for name, (attribute, _, _) in _KEPT.items():
                    numbers[name][i, j] = getattr(found, attribute)
                heights = height_model(found)
                words["height_distribution"][i, j] = heights.name
                if contact is not None:
                    by_model = partial(asked.coefficient, seen, to_solve, found, heights, given)
                    numbers[_FRICTION][i, j] = predicted() if choice is None else by_model()
            except InputError as error:
                if error.field in (*given.get(key, {}), *asked.arguments):
                    raise  # an argument is wrong, not the asperities at this cutoff
                words["failure"][i, j] = str(error)
    data = _labelled(surface, keys, wanted, numbers, words)
    if contact is not None and choice is None:
        data[_FRICTION].attrs["long_name"] += ", median of the prediction"
    return data


def _resolved(choice: Choice, contact: Contact | None) -> Choice:
    """Return the choice with a name that `compare` shows replaced by its model and laws. Raises InputError.

    Without a contact, the choice is returned unchanged.
    """
    require_choice(choice)
    given = choice.arguments()
    return choice if contact is None else choice_of(given.pop("model"), given, contact)


def _cutoffs(cutoffs: Iterable[float | str]) -> np.ndarray:
    if isinstance(cutoffs, str | Real) and not isinstance(cutoffs, bool):
        cutoffs = [cutoffs]  # type: ignore[list-item]
    try:
        wanted = np.asarray([in_metres(cutoff, "cutoffs") for cutoff in cutoffs], dtype=float)
    except (TypeError, ValueError):
        wanted = np.zeros(0)
    if wanted.ndim != 1 or not len(wanted) or not (np.isfinite(wanted) & (wanted >= 0.0)).all():
        raise InputError("cutoffs", cutoffs, "one or more wavelengths >= 0 m")
    return wanted


def _methods(surface: HeightMap, methods: Iterable[str] | None) -> tuple[str, ...]:
    allowed = methods_for(surface)
    if methods is None:
        return allowed
    keys = () if not isinstance(methods, Iterable) else (methods,) if isinstance(methods, str) else tuple(methods)
    if not keys or any(not isinstance(key, str) or key not in allowed for key in keys):
        raise InputError("methods", methods, f"one or more of {', '.join(allowed)}")
    return keys


def _seen(surface: HeightMap, cutoff: float, points_per_cutoff: float | None) -> HeightMap:
    """Return the map without wavelengths below the cutoff [m]; a cutoff of 0 returns the map unchanged.

    points_per_cutoff: the map is thinned to every k-th point, so that a cutoff wavelength contains at least this number of
    points; None keeps all points.
    """
    if cutoff == 0.0:
        return surface
    smooth = filter_band(surface, shortest=cutoff)
    return smooth if points_per_cutoff is None else thinned(smooth, cutoff, points_per_cutoff)


def _to_solve(surface: HeightMap, seen: HeightMap, cutoff: float) -> HeightMap:
    """Return the map that a map model solves: `seen`, or for a complete periodic map the result of a filter that keeps it so.

    surface: the unfiltered map. seen: the filtered map. cutoff: cutoff wavelength [m].
    """
    if not surface.periodic or not surface.complete:
        return seen
    return surface if cutoff == 0.0 else filter_period(surface, shortest=cutoff)


def thinned(surface: HeightMap, cutoff: float, points_per_cutoff: float) -> HeightMap:
    """Return every k-th point of a map along each axis, with the largest k that leaves enough points.

    A cutoff wavelength [m] must contain at least `points_per_cutoff` points. Raises InputError if `points_per_cutoff` is below
    2.
    """
    if not points_per_cutoff >= 2.0:
        raise InputError("points_per_cutoff", points_per_cutoff, "2 or more points per cutoff wavelength")
    # The tolerance is for a cutoff that is a whole number of pitches up to round-off.
    steps = [max(int(cutoff / (points_per_cutoff * pitch) * (1.0 + 1e-9)), 1) for pitch in surface.pitch]
    if surface.is_profile:
        steps[0] = 1
    heights = np.ascontiguousarray(surface.heights[:: steps[0], :: steps[1]])
    size = tuple(n * k * pitch for n, k, pitch in zip(heights.shape, steps, surface.pitch, strict=True))
    fewer = surface.with_heights(heights, f"every {steps[0]}th row and {steps[1]}th column", (size[0], size[1]))
    whole = not any(count % step for count, step in zip(surface.heights.shape, steps, strict=True))
    return fewer if whole else fewer.alone()


def _labelled(surface, keys, cutoffs, numbers, words) -> "xarray.Dataset":
    import xarray

    dims = (METHOD, "cutoff")
    meanings = {name: {"long_name": meaning, "units": unit} for name, (_, meaning, unit) in _KEPT.items()}
    meanings |= {
        _FRICTION: {"long_name": "friction coefficient", "units": "1"},
        "height_distribution": {"long_name": "height distribution used"},
        "failure": {"long_name": "reason for missing numbers"},
    }
    data = {name: (dims, table, meanings[name]) for name, table in numbers.items()}
    data |= {name: (dims, table.astype(str), meanings[name]) for name, table in words.items()}
    coords = {
        METHOD: list(keys),
        "cutoff": ("cutoff", cutoffs, {"long_name": "cutoff wavelength", "units": "m"}),
    }
    attributes = {"title": "The resolution study", "surface": surface.name, "history": "; ".join(surface.history)}
    return xarray.Dataset(data, coords=coords, attrs=attributes)
