"""Define the kinds of records of models and laws, list all records, and check which laws can be combined.

A model or law is a module with a constant RECORD, in the folder of its kind. To add one, write that module, a file of reference
numbers for the tests, and a bibliography entry. Another package provides its records by an entry point in the group "stiction".
Tables, command line, citations and contract tests use the record.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from functools import cache
from importlib import import_module
from typing import TYPE_CHECKING, ClassVar

from stiction.quantities.errors import InputError
from stiction.records.additions import names_of_additions
from stiction.records.claims import FILM_LIMITS, GRADES, TRAITS, YIELDED, Departure, Jump, Limit, Parameter, Validity
from stiction.records.record import Record, find, of_kind, text_of

if TYPE_CHECKING:
    import numpy as np

    from stiction.contact.indices import Groups
    from stiction.engine.regime import Regime


@dataclass(frozen=True, kw_only=True)
class AsperityLaw(Record):
    """Describe the relation between displacement, normal load and contact area of one asperity.

    groups: dimensionless groups of n contacts (contact.indices.Groups).

    - segments(groups, **own_options): list of NormalSegment, in the order in which an approaching asperity passes through them
    - released(groups, distance, **own_options): the same list for unloading, after the surfaces were pressed together and then
      separated by `distance` (n,), in units of sigma; None if the law does not describe unloading
    - traits: properties of the law, keys of TRAITS
    - jumps: discontinuities of the published law
    """

    kind = keyword = "asperity"
    segments: Callable
    released: Callable | None = None
    traits: frozenset[str] = frozenset()
    jumps: tuple[Jump, ...] = ()


# Name of the option that selects a second law for yielded junctions, to which the first gives no resistance; and its default.
JUNCTIONS, NO_JUNCTIONS = "plastic_junctions", "none"


@dataclass(frozen=True, kw_only=True)
class TangentialLaw(Record):
    """Describe the tangential force at which one loaded asperity slips.

    - tangential_resistance(segment, groups, **own_options): TangentialResistance of one segment of an asperity law, or None if
      the asperity has no resistance there. groups: dimensionless groups of n contacts (contact.indices.Groups)
    - required_traits: traits that the asperity law must have, each with the reason (a dict)
    - interfacial: whether the law describes the interface and not the bodies. On a coated asperity it then uses the whole load
      and the outer contact area, whether film or substrate carries the load
    - layered: whether it treats film and body as one layered elastic solid; it then suits film laws with `solved_as_one`
    - of_half_space: why the law cannot be used for a layered solid; "" if it is interfacial or layered
    - like: key of the law to use for a layered solid instead, or ""
    - of_area: whether the force is shear strength times contact area, plus a part that depends on the load
    - junctions: keys of the laws that the option `plastic_junctions` offers for yielded junctions (contact spots), to which
      this law gives no resistance
    - yielded: its assumption on the resistance of yielded junctions, a key of YIELDED; "" if the source has none
    """

    kind = keyword = "tangential"
    tangential_resistance: Callable
    required_traits: Mapping[str, str] = field(default_factory=dict)
    interfacial: bool = False
    layered: bool = False
    of_half_space: str = ""
    like: str = ""
    of_area: bool = False
    junctions: tuple[str, ...] = ()
    yielded: str = ""

    @property
    def options(self) -> Mapping[str, tuple[str, ...]]:
        added = {JUNCTIONS: (NO_JUNCTIONS, *self.junctions)} if self.junctions else {}
        return {**self.own_options, **added}

    def parts(self, options: Mapping[str, str]) -> list[Record]:
        chosen = options.get(JUNCTIONS, NO_JUNCTIONS) if self.junctions else NO_JUNCTIONS
        return [] if chosen == NO_JUNCTIONS else [find(chosen, TangentialLaw)]


@dataclass(frozen=True, kw_only=True)
class FilmLaw(Record):
    """Describe how a film and its substrate together carry the load of an asperity.

    - regimes(groups, law, **own_options): list of engine.regime.Regime. groups: dimensionless groups of n contacts. law:
      asperity law and tangential law of film and substrate (laws.joining.Law)
    - required_traits: traits that the asperity law must have, each with the reason (a dict)
    - own_asperity: whether the film law has its own asperity law and ignores the one in `law`
    - one_body: whether film and substrate count as one body with the film's surface. The groups that the other laws use
      if known (field `takes`) are then unused. If the film has a work of adhesion, the work of adhesion of the bodies is
      unused too
    - solved_as_one: whether its elastic asperity is a sphere on a layered solid; tangential laws with `layered` then suit it
      too
    - bares_substrate: whether the substrate can be exposed. A tangential law of the interface then applies only where the film
      covers the contact; the exposed part has the shear strength of the substrate
    - confined: whether the film can carry more than its own hardness, up to the hardness of the substrate
    - tangential: tangential laws that suit it: "" for all, "interface" for those that describe the interface, or the key of a
      single law
    - asperity: key of the asperity law in its source; another asperity law with the traits in `required_traits` may replace it
    - interchangeable: whether it can be combined with other models; False if it belongs to one variant of one model
    - departures: its errors for a thin film, for a thick film, and for a film equal to its substrate
    - composites: default key by option, for each joint property of film and substrate that a Composite computes
    """

    kind = keyword = "film"
    regimes: Callable
    required_traits: Mapping[str, str] = field(default_factory=dict)
    own_asperity: bool = False
    one_body: bool = False
    solved_as_one: bool = False
    bares_substrate: bool = False
    confined: bool = False
    tangential: str = ""
    asperity: str = ""
    interchangeable: bool = True
    departures: tuple[Departure, ...] = ()
    composites: Mapping[str, str] = field(default_factory=dict)

    @property
    def options(self) -> Mapping[str, tuple[str, ...]]:
        return {name: _first(key, composites_of(name)) for name, key in self.composites.items()} | dict(self.own_options)

    def parts(self, options: Mapping[str, str]) -> list[Record]:
        return [composites_of(name)[options[name]] for name in self.composites]


@dataclass(frozen=True, kw_only=True)
class RoughSurface(Record):
    """Describe a model of the contact of a whole rough surface. It has one of four forms.

    groups: dimensionless groups of n contacts (contact.indices.Groups). Loads and areas are per asperity, in units of
    K R^(1/2) sigma^(3/2) and pi R sigma; separations h are in units of sigma.

    1. A sum of an asperity law over the asperity heights:
       - asperity, tangential: keys of the default laws; with tangential "none" only contact is computed
       - default_film: key of the default film law; "" if the model is for contacts without a film only
       - film_by_option: keys of the film laws that an option selects, by option value
       - regimes(groups, law, film or None, **own_options): list of Regime, if the model is more than a plain sum
    2. A closed form in the separation (asperity is ""):
       - curve(h, groups, **own_options): load and area (n, H) at separations h (H,)
       - separation_near(load, groups, **own_options): estimated separations (n, H) at loads (n, H), NaN if unknown. `curve`
         then also takes separations (n, H). Only models without adhesion may define it.
    3. A closed form in the load, for theories without a separation:
       - area_at_load(load, groups, **own_options): area (n, H) at loads (n, H)
       - area_on_map(load, groups, map): the same for a HeightMap that represents the roughness of both faces
       - way(map or None): text that states how the area is computed
    4. A solution of a measured surface:
       - of_map(surface, contact, pressures, **own_options): boundary_elements.curve.MapCurve of a HeightMap at nominal
         pressures [Pa], with a film if the contact has one

    Flags:

    - takes_surface_moments: sigma, R and N only represent the spectral moments of a Gaussian surface, without asperities
    - on_film: a closed form that requires a film; other closed forms allow none
    - up_to_full_contact: the model includes the interaction of contact spots and holds for any contact area
    - adheres: a model without asperity law that includes adhesion
    """

    kind, keyword = "rough surface", "model"
    asperity: str = ""
    tangential: str = "none"
    default_film: str = ""
    film_by_option: Mapping[str, str] = field(default_factory=dict)
    takes_surface_moments: bool = False
    on_film: bool = False
    up_to_full_contact: bool = False
    adheres: bool = False
    regimes: Callable | None = None
    curve: Callable | None = None
    separation_near: Callable | None = None
    area_at_load: Callable | None = None
    area_on_map: Callable | None = None
    way: Callable | None = None
    of_map: Callable | None = None


@dataclass(frozen=True, kw_only=True)
class Composite(Record):
    """Describe a formula for a joint property of film and substrate: modulus against contact radius, or hardness against depth.

    `value` takes scalars; `constants` and `landmarks` take arrays (n,).

    - property "modulus": value(E'_film/E'_substrate, thickness/contact radius, Poisson's ratio of film, Poisson's ratio of
      substrate) returns the joint modulus divided by E'_substrate, with the reduced modulus E' = E/(1 - nu^2)
    - property "hardness": value(H_film/H_substrate, depth/thickness, constant, exponent) returns the joint hardness divided by
      the hardness of the substrate
    - constants(n_E, n_H, n_Y): constants (n,) of a hardness formula; n_E, n_H, n_Y are modulus, hardness and yield stress of
      the film divided by the substrate's
    - landmarks(constant, exponent): values (n, m) of depth/thickness between which the formula is smooth
    """

    kind = "composite"
    property: str
    value: Callable
    constants: Callable | None = None
    landmarks: Callable | None = None


# Which tangential laws allow ageing and contamination laws, as part of an error.
OF_AREA = "none, or a tangential law whose force is interface strength times contact area"


@dataclass(frozen=True, kw_only=True)
class Addition(Record):
    """Describe a law that a contact can have in addition to the laws of its model, such as a law of menisci.

    Each folder of `laws` with a file kind.py holds one kind of such laws. The docstring of its `__init__.py` names the kind;
    its kind.py defines KIND, a subclass of this class. Without overrides a kind fits all other laws, no contact states it, and
    it neither changes groups nor adds regimes or results.

    - default: key of the law used if the contact has the inputs of this kind (see `is_stated`); "" for none
    - order: position of the kind in lists, the lowest first
    - required_traits: traits that the asperity law must have, each with the reason (a dict)
    """

    default: ClassVar[str] = ""
    order: ClassVar[int] = 100
    required_traits: Mapping[str, str] = field(default_factory=dict)

    @classmethod
    def allowed(cls, model: RoughSurface, tangential: TangentialLaw | None, film: FilmLaw | None) -> str:
        """Return "" if a law of this kind can be added to the other laws; otherwise the allowed values, as text for an error.

        model, tangential, film: the other laws of the contact; None for no tangential law or no film law.
        """
        return ""

    @classmethod
    def is_stated(cls, groups: "Groups") -> bool:
        """Return whether the contact has the inputs of this kind of law, so that the default law of the kind is used."""
        return False

    def changed(self, groups: "Groups") -> "Groups":
        """Return the dimensionless groups as this law changes them; all other laws then use the changed groups."""
        return groups

    def regimes(self, groups: "Groups") -> "list[Regime]":
        """Return the regimes (smooth parts of an asperity's behaviour) that this law adds to the sum over asperities."""
        return []

    def results(
        self,
        results: "Mapping[str, np.ndarray]",
        summed: "Callable[[TangentialLaw], np.ndarray]",
        asperities: "np.ndarray | None",
    ) -> "dict[str, np.ndarray]":
        """Return the results that this law adds, by name, as arrays (n, m) for n contacts at m loads or separations.

        - results: results of the sum over asperities, by name, (n, m) each
        - summed(law): function that returns the sum per asperity of the tangential force by `law`, (n, m)
        - asperities: number of asperities of each contact (n, 1), or None if unknown
        """
        return {}


@dataclass(frozen=True, kw_only=True)
class Criterion(Record):
    """Describe a ratio that is below 1 for one kind of behaviour of a rough contact, and above 1 for another kind.

    - ratio(groups): function that returns the ratio (n,) from the dimensionless groups of n contacts, computed from the
      spectral moments of the surface
    - below, above: sentences on a contact whose ratio is below 1 and above 1, e.g. that it is elastic or plastic
    - on_map: whether `ratio` also takes a HeightMap that represents the roughness of both faces
    """

    kind = "criterion"
    ratio: Callable
    below: str
    above: str
    on_map: bool = False


@dataclass(frozen=True, kw_only=True)
class AsperityMethod(Record):
    """Describe a method that finds the asperities of a measured surface, with their heights and curvatures.

    - find(surface, **parameters): surfaces.asperity_set.Asperities of a levelled HeightMap; lengths are in m
    - parameters: Parameter by name; it checks the value before the call
    - label: short description for pictures
    - order: position among the methods in tables and pictures, which also sets its colour
    - of_profiles: whether it also accepts a single profile
    - of_summits: whether it finds the sigma, R and N of Nayak's theory (1971) on a Gaussian surface with fine enough points;
      only such a method may be the default
    - of_moments: whether its asperities have exactly the measured spectral moments; models of the whole surface need this
    - accuracy: relative error of sigma and R on paraboloids 400 points wide
    - validity: ranges of properties of the asperities found
    - limits: cases in which it agrees with another asperity method, whose key is the `parent`
    """

    kind, keyword = "asperity method", "method"
    room = "surfaces"
    find: Callable
    label: str
    order: int = 100
    of_profiles: bool = True
    of_summits: bool = False
    of_moments: bool = False
    parameters: Mapping[str, Parameter] = field(default_factory=dict)


@cache
def kinds_of_additions() -> dict[str, type[Addition]]:
    """Return the class of each kind of law that can be added to a model, by keyword, such as "meniscus", sorted by `order`."""
    additions = [import_module(f"stiction.laws.{name}.kind").KIND for name in names_of_additions()]
    return {kind.keyword: kind for kind in sorted(additions, key=lambda kind: kind.order)}


def kinds() -> tuple[type[Record], ...]:
    """Return the class of every kind of record, such as AsperityLaw and FilmLaw."""
    additions = kinds_of_additions().values()
    return RoughSurface, AsperityLaw, TangentialLaw, FilmLaw, Composite, *additions, Criterion, AsperityMethod


# Public names: all that modules with a record, and modules that use records, import from here.
__all__ = [
    "FILM_LIMITS", "GRADES", "JUNCTIONS", "NO_JUNCTIONS", "OF_AREA", "TRAITS", "YIELDED", "Addition", "AsperityLaw",
    "AsperityMethod", "Composite", "Criterion", "Departure", "FilmLaw", "Jump", "Limit", "Parameter", "Record",
    "RoughSurface", "TangentialLaw", "Validity", "all_options", "composites_of", "find", "friction_incompatibility",
    "incompatibility", "kinds", "kinds_of_additions", "of_kind", "records", "resolve_options", "select_options", "text_of",
]  # fmt: skip


def records() -> tuple[Record, ...]:
    """Return all records (models, laws, criteria, asperity methods) in the order of `kinds`, then of their keys."""
    return tuple(record for kind in kinds() for record in of_kind(kind).values())


def all_options() -> dict[str, tuple[str, ...]]:
    """Return all values that any model or law allows for each option, by option name."""
    known: dict[str, dict[str, None]] = {}
    for record in records():
        for name, values in record.options.items():
            known.setdefault(name, {}).update(dict.fromkeys(values))
    return {name: tuple(values) for name, values in known.items()}


def composites_of(property: str) -> dict[str, Composite]:
    """Return the formulas for a joint property of film and substrate by key; property: "modulus" or "hardness"."""
    return {key: composite for key, composite in of_kind(Composite).items() if composite.property == property}


def _first(key: str, known: Iterable[str]) -> tuple[str, ...]:
    """Return `key`, followed by the other keys in `known`, as a tuple."""
    return key, *(other for other in known if other != key)


def incompatibility(law: TangentialLaw | FilmLaw | Addition, asperity: AsperityLaw) -> str:
    """Return the reason why a tangential, film or added law cannot be combined with an asperity law, as text; "" if it can."""
    missing = [why for trait, why in law.required_traits.items() if trait not in asperity.traits]
    reasons = " and ".join(missing).replace(" and it ", " and ")
    return f"the {law.keyword} law {law.key} does not suit the asperity law {asperity.key}: {reasons}" if missing else ""


def friction_incompatibility(film: FilmLaw, tangential: TangentialLaw | None) -> str:
    """Return the reason why a film law cannot be combined with a tangential law, as text; "" without such a reason."""
    if tangential is None or film.tangential in ("", tangential.key):
        return ""
    if film.tangential != "interface":
        return f"{film.key} always takes its friction from {film.tangential}"
    if tangential.interfacial or (film.solved_as_one and tangential.layered):
        return ""
    if not film.solved_as_one:
        return f"{film.key} needs a tangential law of interface strength: its film slips at the interface"
    why = f": {tangential.of_half_space}" if tangential.of_half_space else ""
    why += f"; take {tangential.like}" if tangential.like else ""
    return f"{film.key} needs a tangential law of interface strength or of layered solids{why}"


def select_options(record: Record, options: Mapping[str, str]) -> dict[str, str]:
    """Return the values of a record's options, by name; the default where `options` has no value.

    options: values by option name; options that the record does not have are ignored.
    """
    return {name: options.get(name, values[0]) for name, values in record.options.items()}


def resolve_options(known: Iterable[Record], options: Mapping[str, str | None]) -> dict[str, str]:
    """Return the value of every option of these records, by name: the value in `options`, or the default.

    known: records of the laws in use. options: values by name, None for the default. Raises InputError for a value that is not
    allowed, or for an option that no record has, unless its value is None.
    """
    known = tuple(known)
    allowed = {name: values for record in known for name, values in record.options.items()}
    for name, value in options.items():
        if value is not None and value not in allowed.get(name, ()):
            keys = list(dict.fromkeys(record.key for record in known))
            nothing = f"not supported: no law in use has this option ({', '.join(keys)}); remove it" + (
                f"; their options are {', '.join(allowed)}" if allowed else ""
            )
            raise InputError(name, value, ", ".join(allowed.get(name, ())) or nothing)
    return {name: options.get(name) or values[0] for name, values in allowed.items()}
