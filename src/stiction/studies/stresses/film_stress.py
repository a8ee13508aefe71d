"""Compute stresses in a film and at its interface under the mean touching asperity, and where yield begins."""

from typing import TYPE_CHECKING, Unpack

import numpy as np

from stiction.contact.contact import Contact
from stiction.contact.indices import Groups
from stiction.contact.subject import Subject, as_subject
from stiction.engine.heights import Heights
from stiction.laws.validity import warnings_about, with_warnings
from stiction.quantities.errors import InputError, InWords
from stiction.quantities.keywords import with_keywords
from stiction.records.claims import Validity
from stiction.solvers.layered.bodies import Bodies, bodies_of, per_root
from stiction.solvers.layered.first_yield import at_interface, first_yield
from stiction.solvers.layered.stresses import Stresses
from stiction.solving.choice import LawKeywords
from stiction.solving.solve import solve

if TYPE_CHECKING:
    import xarray

    from stiction.quantities.arguments import QuantityLike

_FILM = "layered"
# Range of contact radius over film thickness in which stresses were checked against other solutions.
LEAST, MOST = 1e-3, 1e3
_RULES = (
    Validity("stress_over_yield", 0.0, 1.0, "film or body yields under the mean asperity, but computed stresses are elastic"),
    Validity("interface_shear", 0.0, 1.0, "the film shears off unless its bond is stronger than film or body"),
    Validity("interface_tension", 0.0, 1.0, "the film is torn off unless its bond is stronger than film or body"),
    Validity("contact_over_thickness", LEAST, MOST, "radii at which the stresses were compared", "fit"),
)


@with_keywords(LawKeywords)
def film_stresses(
    contact: Subject,
    *,
    separation: "QuantityLike | None" = None,
    load: "QuantityLike | None" = None,
    model: str | None = None,
    heights: Heights | str | None = None,
    **laws: Unpack[LawKeywords],
) -> "xarray.Dataset":
    """Compute the stresses in a film and its substrate under the mean asperity.

    Parameters
    ----------
    contact : Contact or Indices
        One contact with a film, without arrays.
    separation, load : float, str with a unit, or array, optional
        Exactly one of them, as in `solve`: mean separation [m] or normal load [N].
    model : str, optional
        Key of a rough-surface model (`st.models()`), as in `solve`.
    heights : Heights or str, optional
        Height distribution, or its name; by default the distribution of the contact, or Gaussian.
    **laws : str, optional
        Laws and options of the model by keyword, as in `solve`; the film law is "layered".

    Returns
    -------
    xarray.Dataset
        The dataset that `solve` returns, with these additions: contact_over_thickness, the contact radius over the film
        thickness; stress_over_yield, the largest von Mises stress over the local yield stress; interface_tension and
        interface_shear, the largest stresses at the interface over the yield stress and the shear yield stress of the weaker of
        film and body; and yields_first: "film", "counterbody", "interface", "body", or "" where nothing touches.
        `validity_warnings` name the stresses that film or body cannot bear.

    Raises
    ------
    InputError
        The contact has no film, a number of it is an array, or another film law is named.

    Notes
    -----
    The mean asperity has the mean area, load and friction force of the touching asperities. Its stresses are those of an
    elastic sphere that is pressed and dragged on a layered half-space (`solvers.layered.stresses`).

    Examples
    --------
    >>> import stiction as st
    >>> rough = st.Roughness(asperity_height_deviation="50 nm", asperity_radius="20 um", asperity_density="1.7e10 1/m^2")
    >>> nitride = st.Material(youngs_modulus="600 GPa", poissons_ratio=0.2, hardness="14 GPa")
    >>> contact = st.Contact(
    ...     first="hardened_steel_52100", second="hardened_steel_52100", roughness=rough, nominal_area="1 mm^2",
    ...     interfacial_shear_strength="300 MPa", coating=st.Coating(material=nitride, thickness="0.4 um", bodies="first"),
    ... )
    >>> stresses = st.film_stresses(contact, load="1 N", model="greenwood_williamson_1966")
    >>> stresses.yields_first.item()
    'interface'
    """
    subject = as_subject(contact)
    require_film(subject)
    groups, dims = Groups.of(subject.indices())
    if dims:
        raise InputError("contact", InWords(f"arrays along {', '.join(dims)}"), "one contact, with single numbers")
    if groups.film_aspect is None or not np.isfinite(groups.film_aspect[0]):
        raise InputError("film_aspect", None, "film thickness over sqrt(R sigma), 0 or more")
    if (film := laws.get("film") or _FILM) != _FILM:
        raise InputError("film", film, f"{_FILM}, which solves film and body as one")
    laws["film"] = _FILM
    data = solve(subject, separation=separation, load=load, model=model, heights=heights, **laws)
    factors = subject.scales().factors()
    touching = np.maximum(data["touching_asperities"] / factors["count"], 1e-300)
    friction = data.get("friction_force", 0.0 * data["load"])
    means = (data["contact_area"] / factors["m^2"], data["load"] / factors["N"], friction / factors["N"])
    rows = [_of_one(groups, *point) for point in zip(*(np.ravel(one / touching) for one in means), strict=True)]
    return _with_results(data, subject, rows)


def require_film(subject: Subject) -> None:
    """Raise InputError unless the contact has a film."""
    if not subject.has_film:
        raise InputError("coating", None, "a film with material and thickness")


def require_proportion(radius: float) -> None:
    """Raise InputError if stresses were not checked at this `radius`, the contact radius over the film thickness."""
    if not LEAST <= radius <= MOST:
        raise InputError(
            "thickness", InWords(f"a/t = {radius:.3g}"), f"contact radius over film thickness, {LEAST:g} to {MOST:g}"
        )


def part_that_yields(subject: Subject, where: str) -> str:
    """Return the part that yields first: `where`, or "counterbody" instead of "film" if the counterbody is softer.

    The counterbody is uncoated. where: "film", "interface" or "body", from the solution of the layered body.
    """
    softer = isinstance(subject, Contact) and subject.softer_counterbody is not None
    return "counterbody" if where == "film" and softer else where


def middle_point(data: "xarray.Dataset") -> "xarray.Dataset":
    """Return a `film_stresses` result at the middle of the loads or separations at which asperities are pressed.

    If their number is even, the first of the two middle ones is used. If no asperities are pressed, all loads or separations
    are considered. A result at a single number is returned unchanged.
    """
    if not data["load"].dims:
        return data
    (dim,) = data["load"].dims
    pressed = np.flatnonzero(np.isfinite(data["stress_over_yield"].values))
    among = pressed if pressed.size else np.arange(data.sizes[dim])
    return data.isel({dim: int(among[(among.size - 1) // 2])})


def _of_one(groups: Groups, area: float, load: float, friction: float) -> tuple[float, float, float, float, str]:
    """Return the largest stresses in film, interface and body under one asperity, and the part that yields first.

    The five results are: contact radius over film thickness; largest von Mises stress over the local yield stress; tension and
    shear at the interface, over the yield stress and shear yield stress of the weaker of film and body; and "film", "interface"
    or "body". If both bodies are coated, each stress is the larger of two. Without area or compressive load the stresses are
    NaN and the part is "". area, load, friction: dimensionless, of the asperity.
    """
    if not (area > 1e-100 and load > 0.0):
        return contact_over_thickness(groups, area), np.nan, np.nan, np.nan, ""
    radius, pressure = contact_over_thickness(groups, area), pressure_over_yield(groups, area, load)
    (bodies,), _ = bodies_of(groups.resolved())
    strength = float(groups.n_H[0])
    return radius, *_worst(bodies, min(max(radius, LEAST), MOST), pressure, friction / load, strength)


def contact_over_thickness(groups: Groups, area: float) -> float:
    """Return the contact radius over the thickness of one film, for an asperity with this dimensionless area."""
    return float(area**0.5 * per_root(groups)[0] ** 2)


def pressure_over_yield(groups: Groups, area: float, load: float) -> float:
    """Return the mean pressure over the body's yield stress, for an asperity with this dimensionless area and load."""
    return load * float(groups.hardness_to_yield[0]) / (float(groups.eta[0]) * area)


def _worst(bodies: Bodies, radius: float, pressure: float, traction: float, strength: float) -> tuple[float, float, float, str]:
    """Return the largest stresses over all coated bodies, each evaluated separately, and the part that yields first.

    radius: contact radius over film thickness. pressure: mean pressure over the body's yield stress. traction: friction force
    over load. strength: film hardness over body hardness. The stresses are von Mises stress over yield stress, and tension and
    shear at the interface over the yield stress and shear yield stress of the weaker of film and body.
    """
    each, weaker = coated_bodies(bodies, radius), min(strength, 1.0)
    first = max(first_yield(stresses, traction, strength) for stresses in each)
    tension, shear = map(max, zip(*(at_interface(stresses, traction) for stresses in each), strict=True))
    return pressure * first.excess, pressure * tension / weaker, pressure * shear * 3.0**0.5 / weaker, first.where


def coated_bodies(bodies: Bodies, radius: float) -> list[Stresses]:
    """Return the stress solution of each coated body; `radius`: contact radius over film thickness."""
    return [Stresses(bodies.pair, body, radius) for body in dict.fromkeys(bodies.coated)]


def _with_results(data: "xarray.Dataset", subject: Subject, rows: list[tuple]) -> "xarray.Dataset":
    like = data["load"]
    names = "contact_over_thickness", "stress_over_yield", "interface_tension", "interface_shear"
    *numbers, where = zip(*rows, strict=True)
    found = {name: np.reshape(np.array(column, dtype=float), like.shape) for name, column in zip(names, numbers, strict=True)}
    variables = {name: (like.dims, values, subject.attributes(name)) for name, values in found.items()}
    places = np.reshape(np.array([part_that_yields(subject, part) for part in where], dtype=object), like.shape)
    variables["yields_first"] = like.dims, places, {"long_name": "what yields first"}
    return with_warnings(data.assign(variables), warnings_about(subject, _RULES, found))
