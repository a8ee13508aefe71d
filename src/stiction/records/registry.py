"""The registry of models: one record each, found in their folders and in entry points.

A model is a module with a RECORD, in the folder named for its kind. Adding one is one file in its folder (or, outside the
package, an entry point in the group "stiction"), one file of reference numbers in the tests and one bibliography entry; tables,
command line, citations and contract tests are made from the record.
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
    """How one asperity carries a normal load.

    pieces(groups, **own options) -> list of Piece, in the order in which an approaching asperity meets them.
    traits: what it is, see TRAITS. jumps: where the published pieces do not meet. released(groups, distance, **own options) ->
    list of Piece, at the displacement that is left: the same after the surfaces were pressed together and then drawn apart by
    the distance (n,) over sigma; None where the law, if it yields and adheres, says nothing of that.
    """

    kind = keyword = "asperity"
    pieces: Callable
    released: Callable | None = None
    traits: frozenset[str] = frozenset()
    jumps: tuple[Jump, ...] = ()


# The option by which junctions that have yielded, to which a law gives no resistance, get that of another; and its default.
JUNCTIONS, NO_JUNCTIONS = "plastic_junctions", "none"


@dataclass(frozen=True, kw_only=True)
class TangentialLaw(Record):
    """Compute the force at which one loaded asperity is sheared off.

    tangential_resistance(piece, groups, **own options) -> TangentialResistance, or None for a piece that resists nothing.
    wants: trait of the asperity law that it cannot do without -> why. interfacial: it shears the interface, wherever that is:
    of a coated asperity, the whole load and the outer contact area count, whichever body answers. layered: it treats a film and
    its body as one elastic solid, and goes with film laws that solve them so; of a half-space it is another law. of_half_space:
    why a law that is neither says nothing of film and body as one; like: key of the law to take there in its place, or "".
    junctions: keys of laws that may answer, by the option plastic_junctions, for junctions that have yielded, where its own
    gives them nothing. of_area: its force is the strength of the interface times the contact area, plus a part that depends on
    the load. yielded: what junctions that have yielded resist, of YIELDED; "" if the source does not state it.
    """

    kind = keyword = "tangential"
    tangential_resistance: Callable
    wants: Mapping[str, str] = field(default_factory=dict)
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
    """Describe how a film and its substrate carry load together.

    regimes(groups, law, **own options) -> list of Regime; law: a joining.Law, the asperity of either body. wants: trait
    of the asperity law that it cannot do without -> why. own_asperity: the film law brings its own asperity law and does not
    use the one in `law`. one_body: film and substrate are one, with the film's surface: where the film has its own work of
    adhesion, the work of adhesion of the bodies does not count, nor do the groups in `takes` of `law`. solved_as_one: its
    elastic asperity is a sphere on the layered solid, so that tangential laws with `layered` go with it, too.
    bares_substrate: a law of the interface shears what is film of the contact, and the rest shears at the substrate's own
    strength. confined: the film may bear more than its own hardness, up to the substrate's.
    tangential: "" if it goes with any tangential law that suits the asperity law, "interface" if only with laws of the
    interface, or the key of the one built into it. asperity: key of the asperity law that its source takes;
    any that has what it wants may be taken in its place. interchangeable: False for a film of one variant only.
    departures: from what films of no thickness, without end, and like their substrate have to be.
    composites: properties of film and substrate together which options of these names choose among the composites: property ->
    key of the default.
    """

    kind = keyword = "film"
    regimes: Callable
    wants: Mapping[str, str] = field(default_factory=dict)
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
    """Describe the contact of a whole rough surface.

    It sums an asperity law over heights, with a tangential law (keys; the defaults of the options of these names: any that
    suit each other may be taken), bare or, if default_film is given, with any film. tangential "none": contact only. Or,
    where asperity is "": curve(h, groups, **own options) -> load and area (n, H) in closed form at the separations h (H,), and
    with it, or None, separation_near(load, groups, **own options) -> separations (n, H), about where the loads (n, H) are
    carried, not a number where that is not known: curve then takes separations (n, H), too, and does not adhere; or
    area_at_load(load, groups, **own options) -> area (n, H) at the loads (n, H), for theories without a separation; with
    it, or None, area_on_map(load, groups, map), the same where the contact has a map (a HeightMap) that stands for both faces,
    and way(map or None) -> words, how the area is then found.
    on_film: a theory in closed form of surfaces with a film, which it requires; others allow none.
    of_surface: it takes sigma, R and N for the moments of a Gaussian surface, which decide, and not asperities as they were
    found. up_to_full_contact: it includes the interaction of contacts, so that no area of contact is too large for it. adheres:
    a theory without an asperity law that includes the attraction of the surfaces; of a sum its asperity law says that.
    regimes(groups, law, film or None, **own options) -> list of Regime, or None where the law is simply summed: a model
    that is more. film_by_option: value of an own option that brings a film law of its own -> key of that.
    of_map(surface, contact, pressures, **own options) -> boundary_elements.curve.MapCurve: it solves the contact of a measured
    HeightMap itself, with the film if there is one, at nominal pressures [Pa]; then it is neither a sum nor in closed form.
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
    """Compute a property of film and substrate together, as a function of depth.

    property, and value, a formula of scalars: "modulus", over the substrate's, by value(film's over substrate's,
    thickness over contact radius, nu of film and substrate); "hardness", likewise, by value(film's over substrate's, depth
    over thickness, constant, exponent), with constants(n_E, n_H, n_Y) -> (n,), n_Y the ratio of the yield stresses, and
    landmarks(constant, exponent) -> (n, m), depths over thickness between which it is smooth.
    """

    kind = "composite"
    property: str
    value: Callable
    constants: Callable | None = None
    landmarks: Callable | None = None


# What a law that strengthens or spreads the force of an interface wants of a tangential law.
OF_AREA = "none, or a tangential law whose force is a strength of the interface on the area"


@dataclass(frozen=True, kw_only=True)
class Addition(Record):
    """Describe a law that a contact may have in addition to those of its model.

    A kind of them is a folder of `laws`: `__init__.py` says in its docstring what is to be named, and kind.py has KIND, a
    subclass of this. default: key of the law that is taken where the contact states what it is about, `is_stated`; "" where
    none is. order: of its kind among the others. wants: trait of the asperity law that it cannot do without -> why.
    """

    default: ClassVar[str] = ""
    order: ClassVar[int] = 100
    wants: Mapping[str, str] = field(default_factory=dict)

    @classmethod
    def allowed(cls, model: RoughSurface, tangential: TangentialLaw | None, film: FilmLaw | None) -> str:
        """Return what is allowed instead where no law of this kind suits these, "" where one does."""
        return ""

    @classmethod
    def is_stated(cls, groups: "Groups") -> bool:
        """Return whether the contact states what this is about."""
        return False

    def changed(self, groups: "Groups") -> "Groups":
        """Return the groups that all other laws take."""
        return groups

    def regimes(self, groups: "Groups") -> "list[Regime]":
        """Return what is added to the sum over asperities."""
        return []

    def results(
        self,
        results: "Mapping[str, np.ndarray]",
        summed: "Callable[[TangentialLaw], np.ndarray]",
        asperities: "np.ndarray | None",
    ) -> "dict[str, np.ndarray]":
        """Return more results (n, m) of a sum.

        summed(law): the sum per asperity of a law in the place of the tangential law;
        asperities: their number (n, 1), None where that is not known."""
        return {}


@dataclass(frozen=True, kw_only=True)
class Criterion(Record):
    """Compute a number that separates two kinds of behaviour of a rough surface in contact.

    ratio(groups) -> array (n,), of asperities with the moments of the surface; below, above: statements on the contact
    where the ratio is below 1, and above.
    """

    kind = "criterion"
    ratio: Callable
    below: str
    above: str


@dataclass(frozen=True, kw_only=True)
class AsperityMethod(Record):
    """A way of finding the asperities of a measured surface: what is one, how high it is and how blunt.

    find(surface, **parameters) -> surfaces.asperity_set.Asperities, in a levelled HeightMap; every one of the parameters is
    handed to it, checked, lengths in metres. parameters: name -> Parameter. label: what it finds, in a few words, for pictures.
    order: where it stands among the others in tables and pictures, which also gives its colour. of_profiles: it can be given a
    single profile too. of_summits: of a Gaussian surface whose waves are resolved it finds sigma, R and N of Nayak's summits,
    so that it may stand for the surface where no method is named. of_moments: its asperities have the measured moments,
    exactly, and are what theories of the whole surface take. accuracy: of sigma and R of paraboloids 400 points wide. validity:
    in numbers of the asperities found, whose note has a validity warning outside of it. limits: without groups; the parent is
    another method.
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
    """Return the kinds of laws that are added to a model, by keyword."""
    found = [import_module(f"stiction.laws.{name}.kind").KIND for name in names_of_additions()]
    return {kind.keyword: kind for kind in sorted(found, key=lambda kind: kind.order)}


def kinds() -> tuple[type[Record], ...]:
    """Return the kinds of records."""
    additions = kinds_of_additions().values()
    return RoughSurface, AsperityLaw, TangentialLaw, FilmLaw, Composite, *additions, Criterion, AsperityMethod


# What the authors of records and those who read them import from here.
__all__ = [
    "FILM_LIMITS", "GRADES", "JUNCTIONS", "NO_JUNCTIONS", "OF_AREA", "TRAITS", "YIELDED", "Addition", "AsperityLaw",
    "AsperityMethod", "Composite", "Criterion", "Departure", "FilmLaw", "Jump", "Limit", "Parameter", "Record",
    "RoughSurface", "TangentialLaw", "Validity", "all_options", "composites_of", "find", "friction_incompatibility",
    "incompatibility", "kinds", "kinds_of_additions", "of_kind", "records", "resolve_options", "select_options", "text_of",
]  # fmt: skip


def records() -> tuple[Record, ...]:
    """Return every record, in the order of their kinds, each kind in alphabetical order."""
    return tuple(record for kind in kinds() for record in of_kind(kind).values())


def all_options() -> dict[str, tuple[str, ...]]:
    """Return every option of every record: name -> all values that any of them allows."""
    known: dict[str, dict[str, None]] = {}
    for record in records():
        for name, values in record.options.items():
            known.setdefault(name, {}).update(dict.fromkeys(values))
    return {name: tuple(values) for name, values in known.items()}


def composites_of(property: str) -> dict[str, Composite]:
    """Return the composites that give a property: key -> record."""
    return {key: one for key, one in of_kind(Composite).items() if one.property == property}


def _first(key: str, known: Iterable[str]) -> tuple[str, ...]:
    """Return the keys, this one first."""
    return key, *(one for one in known if one != key)


def incompatibility(law: TangentialLaw | FilmLaw | Addition, asperity: AsperityLaw) -> str:
    """Return why a tangential law, a film or an addition cannot go with an asperity law; "" if it can."""
    missing = [f"{why} ({trait}: {TRAITS[trait]})" for trait, why in law.wants.items() if trait not in asperity.traits]
    return f"{law.key} does not suit the asperity law {asperity.key}: {'; '.join(missing)}" if missing else ""


def friction_incompatibility(film: FilmLaw, tangential: TangentialLaw | None) -> str:
    """Return why a film cannot go with a tangential law; "" if it can."""
    if tangential is None or film.tangential in ("", tangential.key):
        return ""
    if film.tangential != "interface":
        return f"{film.key} brings its own friction, {film.tangential}"
    if tangential.interfacial or (film.solved_as_one and tangential.layered):
        return ""
    if not film.solved_as_one:
        return f"{film.key} goes with laws of the interface only: its friction is there"
    why = f": {tangential.of_half_space}" if tangential.of_half_space else ""
    why += f"; take {tangential.like}" if tangential.like else ""
    return f"{film.key} goes with laws of the interface and with those that know film and body as one{why}"


def select_options(record: Record, options: Mapping[str, str]) -> dict[str, str]:
    """Return the values of the record's own options, with defaults for missing ones."""
    return {name: options.get(name, values[0]) for name, values in record.options.items()}


def resolve_options(known: Iterable[Record], options: Mapping[str, str | None]) -> dict[str, str]:
    """Return every option of these records, with defaults; raise InputError for unknown ones."""
    known = tuple(known)
    allowed = {name: values for record in known for name, values in record.options.items()}
    for name, value in options.items():
        if value is not None and value not in allowed.get(name, ()):
            keys = dict.fromkeys(record.key for record in known)
            nothing = f"nothing: {' and '.join(keys)} have no such option, but {', '.join(allowed) or 'none'}"
            raise InputError(name, value, ", ".join(allowed.get(name, ())) or nothing)
    return {name: options.get(name) or values[0] for name, values in allowed.items()}
