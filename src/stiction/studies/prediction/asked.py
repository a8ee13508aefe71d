"""The contact and the loads of a prediction, with its uncertain numbers, and the bare contact."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from stiction.case.read import Case
from stiction.case.several import Address
from stiction.case.uncertain import SAMPLE
from stiction.contact.contact import Contact
from stiction.contact.materials import class_of
from stiction.contact.pair import pair_of
from stiction.contact.size_effect import at_radius
from stiction.quantities.dimensions import aligned, arranged, dimensions
from stiction.solving.choice import Choice
from stiction.studies.uncertainty.drawing import Variant, draw
from stiction.surfaces.theory.moments import LEAST_DENSITY

__all__ = ["PULLS", "Asked", "Bodies"]

# What pulls on a contact beside its load, and what its interface resists: drawn by parts of their own.
PULLS = ("work_of_adhesion", "liquid")
_INTERFACE = (
    "interface",
    "interfacial_shear_strength",
    "pressure_coefficient",
    "peeling",
    "strength_variation",
    "weakening_slip",
    "residual_strength",
    "hold_time",
    "reference_time",
    "ageing_rate",
)


@dataclass(frozen=True)
class Bodies:
    """Strengths of the surfaces that meet [Pa], arrays (n or 1, m or 1) over draws and points.

    hardness, shear_strength, shear_modulus: of the softer one. hardest: the larger hardness of what may bear the load, which
    bounds the mean pressure of a spot.
    """

    hardness: np.ndarray
    shear_strength: np.ndarray
    shear_modulus: np.ndarray
    hardest: np.ndarray


@dataclass(frozen=True)
class Asked:
    """A case at its loads, and the levels (n, k) of its k uncertain numbers.

    load: array (m,) [N], or a labelled one along dimensions of the contacts, all above 0. Numbers of the case may be several:
    then the m points are all combinations of these with the loads, in the order of `dims`.
    """

    case: Case
    load: Any
    levels: np.ndarray

    @property
    def contact(self) -> Contact:
        """Return the nominal contact, with arrays where numbers of the case are several."""
        return _contact(self.case)

    @cached_property
    def dims(self) -> dict[str, int]:
        """Return the lengths of the dimensions along which the points are."""
        loads = {} if hasattr(self.load, "dims") else {"load": np.size(self.load)}
        return dimensions([*self.case.several.values(), self.load]) | loads

    @cached_property
    def loads(self) -> np.ndarray:
        """Return the load of each point (m,)."""
        own = self.load if hasattr(self.load, "dims") else None
        values = np.reshape(self.load, [1] * (len(self.dims) - 1) + [-1]) if own is None else aligned(own, self.dims)
        return np.broadcast_to(values, tuple(self.dims.values())).reshape(-1)

    @property
    def contacts(self) -> int:
        """Return the number of contacts."""
        return math.prod(size for dim, size in self.dims.items() if dim != "load")

    def ends(self) -> "list[Asked]":
        """Return the first and the last contact, each alone with one draw."""
        found = []
        for at in (0, -1):
            some = {path: value.isel({dim: [at] for dim in value.dims}) for path, value in self.case.several.items()}
            load = self.load.isel({dim: [at] for dim in self.load.dims}) if hasattr(self.load, "dims") else self.load
            case = replace(self.case.at(some), several=some, uncertain=())
            found.append(replace(self, case=case, load=load, levels=np.zeros((1, 0))))
        return found

    def places(self, dims: Mapping[str, int]) -> np.ndarray:
        """Return where each point (m,) stands among results along these dimensions, laid out in their order."""
        numbers = np.arange(math.prod(dims.values())).reshape(tuple(dims.values()))
        return np.broadcast_to(arranged(numbers, list(dims), self.dims), tuple(self.dims.values())).reshape(-1)

    def areas(self, choice: Choice, pulls: Sequence[str] = (), faint: bool = False) -> np.ndarray:
        """Return the area [m2] (n, m) of a model on the drawn contacts, NaN where it refuses one or cannot be right there.

        n is 1 where no number is uncertain. pulls: which of PULLS the contact has; faint: with a work of adhesion so small that
        it pulls with nothing. Raises InputError where the model refuses the nominal contact.
        """
        left_out = [*_INTERFACE, *(name for name in PULLS if name not in pulls)]
        case = replace(_without(self.case, left_out), load=self.load, separation=None)
        case = _faint(case) if faint else case
        kept = [name for name in self.case.unknowns if name in case.unknowns]
        columns = [list(self.case.unknowns).index(name) for name in kept]
        levels = self.levels[:, columns] if columns else np.zeros((1, 0))
        drawn = draw(case, levels, [Variant(choice)], names=("contact_area",))
        table = arranged(drawn.tables["contact_area"], (SAMPLE, *drawn.dims["contact_area"]), (SAMPLE, *self.dims))
        return np.broadcast_to(table, (len(levels), *self.dims.values())).reshape(len(levels), -1)

    def by_numbers(self) -> "Asked":
        """Return the same without the map of its surface: of every draw a map would be solved anew."""
        return replace(self, case=replace(self.case, subject=self.contact.as_numbers()))

    @cached_property
    def is_gaussian(self) -> np.ndarray:
        """Return whether a Gaussian surface has as few asperities as the contact at each point (m,)."""
        rough = self.contact.roughness
        numbers = self.column(rough.asperity_density * rough.asperity_radius * rough.asperity_height_deviation)[0]
        return np.broadcast_to(numbers >= LEAST_DENSITY, self.loads.shape)

    def as_gaussian(self) -> "Asked":
        """Return the same with at least as many asperities as a Gaussian surface has."""
        path, rough = ("contact", "roughness", "asperity_density"), self.contact.roughness
        least = LEAST_DENSITY * (1.0 + 1e-9) / (rough.asperity_radius * rough.asperity_height_deviation)
        density: dict[Address, Any] = {path: np.maximum(rough.asperity_density, least)}
        return replace(self, case=replace(self.case.at(density), several={**self.case.several, **density}))

    def variation(self, choice: Choice) -> np.ndarray:
        """Return the area (n, m) of a model on the drawn contacts, over that on the nominal one."""
        nominal = replace(self, case=replace(self.case, uncertain=()), levels=np.zeros((1, 0)))
        return self.areas(choice) / nominal.areas(choice)

    def nominal(self, model: str) -> Contact:
        """Return the nominal contact without adhesion, liquid and interface, as the model of this key takes it."""
        return _contact(_without(self.case, _INTERFACE + PULLS).with_surface_moments(model))

    @property
    def on_map(self) -> bool:
        """Return whether the map of the surface is known, also where a model takes the asperities found on it."""
        return self.contact.with_surface_moments().map is not None

    @property
    def metallic(self) -> np.ndarray:
        """Return whether junctions are of a bulk metal (1 or m,), which grows under shear.

        No law covers the growth of films.
        """
        first, second = (class_of(body) in ("metal", "soft metal") for body in self.contact.touching)
        return np.where(self._first_is_softer(self.contact), first, second) & (not self.contact.has_film)

    def _first_is_softer(self, contact: Contact) -> np.ndarray:
        """Return whether the first body that meets is the softer one at each point (1 or m,), on average over the draws."""
        first, second = (self.column(body.hardness).mean(axis=0) for body in contact.touching)
        return first <= second

    @cached_property
    def drawn(self) -> Contact:
        """Return the contact whose uncertain numbers are arrays along the draws."""
        return _contact(self.case.at(self.case.numbers_at(self.levels)) if self.case.unknowns else self.case)

    @cached_property
    def bodies(self) -> Bodies:
        """Return the strengths of the surfaces that meet."""
        contact = self.drawn
        radius = contact.roughness.asperity_radius
        pair = pair_of(*(at_radius(body, radius) for body in contact.touching))
        below = pair_of(*(at_radius(body, radius) for body in (contact.first, contact.second)))
        ratio = pair.k if contact.hardness_to_yield is None else contact.hardness_to_yield
        hardness, body_below = self.column(pair.hardness), self.column(below.hardness)
        first, second = (self.column(body.shear_modulus) for body in contact.touching)
        modulus = np.where(self._first_is_softer(contact), first, second)
        shear_strength = hardness / (3.0**0.5 * self.column(ratio))
        return Bodies(hardness, shear_strength, modulus, np.maximum(hardness, body_below))

    def column(self, value: Any) -> np.ndarray:
        """Return a number of the drawn contact as an array (n or 1, m or 1) over draws and points."""
        table = aligned(value, {SAMPLE: 0, **self.dims})
        if table.ndim < 2 or table.size == len(table):
            return table.reshape(-1, 1)
        return np.broadcast_to(table, (len(table), *self.dims.values())).reshape(len(table), -1)


def _contact(case: Case) -> Contact:
    assert isinstance(case.subject, Contact)  # of normalised numbers there is no prediction
    return case.subject


def _without(case: Case, names: Sequence[str]) -> Case:
    """Return the case without these fields of its contact, and without their uncertain numbers."""
    return _changed(case, dict.fromkeys(names))


def _changed(case: Case, fields: Mapping[str, Any]) -> Case:
    """Return the case with these fields of its contact, of which nothing is uncertain or several.

    With the work of adhesion that of the film goes.
    """
    contact = _contact(case)
    uncertain = tuple(number for number in case.uncertain if not (set(number.path[1:]) & fields.keys()))
    several = {path: value for path, value in case.several.items() if not (set(path[1:]) & fields.keys())}
    film: dict[str, Any] = {}
    if contact.coating is not None and "work_of_adhesion" in fields:
        film = {"coating": contact.coating.replace(work_of_adhesion=None)}
    return replace(case, subject=contact.replace(**fields, **film), uncertain=uncertain, several=several)


_FAINT = 1e-6  # of the work of adhesion


def _faint(case: Case) -> Case:
    """Return the case with a millionth of its work of adhesion, which pulls with nothing: laws of adhesion alone refuse 0."""
    return _changed(case, {"work_of_adhesion": _FAINT * float(np.mean(_contact(case).work_of_adhesion))})
