"""Represent a case with samples of its uncertain numbers; compute contact areas and strengths of all samples."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from stiction.case.read import Case
from stiction.case.swept import Address
from stiction.case.uncertain import SAMPLE
from stiction.contact.contact import Contact
from stiction.contact.indices import HARDNESS_TO_YIELD, Groups
from stiction.contact.materials import class_of
from stiction.contact.pair import Pair
from stiction.contact.size_effect import at_radius
from stiction.quantities.dimensions import aligned, arranged, dimensions
from stiction.solving.choice import Choice
from stiction.studies.uncertainty.drawing import Variant, draw
from stiction.surfaces.theory.moments import LEAST_DENSITY

# Inputs of adhesion and of interface strength: area models ignore them, because other parts of the prediction use them.
PULLS = ("work_of_adhesion", "liquid")
_INTERFACE = (
    "interface",
    "interfacial_shear_strength",
    "pressure_coefficient",
    "burgers_vector",
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
    """Store strengths and stiffness of the touching surfaces in Pa, arrays (n or 1, m or 1).

    The arrays run over n samples and m points (contacts at a load). hardness, shear_strength, shear_modulus: properties of the
    softer surface. hardest: the largest pressure that a contact spot can bear. It is the larger of two values: the hardness of
    the softer surface and the hardness of the softer body.
    """

    hardness: np.ndarray
    shear_strength: np.ndarray
    shear_modulus: np.ndarray
    hardest: np.ndarray


@dataclass(frozen=True)
class SampledCase:
    """Store a case at its loads, with n samples of its uncertain numbers.

    load: loads above 0 in N, an array (m,) or a labelled array (xarray) along dimensions of the contacts. levels: quantile
    levels (n, k), one column for each of the k sample dimensions of the case. A point is a contact at a load: if numbers of the
    case are arrays, the m points are all combinations of their values and the loads, in the order of `dims`.
    """

    case: Case
    load: Any
    levels: np.ndarray

    @property
    def contact(self) -> Contact:
        """Return the contact with the nominal values of its uncertain numbers; array parameters are arrays."""
        return _contact(self.case)

    @cached_property
    def dims(self) -> dict[str, int]:
        """Return the length of each dimension of the points: the dimensions of the array parameters, and `load`."""
        loads = {} if hasattr(self.load, "dims") else {"load": np.size(self.load)}
        return dimensions([*self.case.swept.values(), self.load]) | loads

    @cached_property
    def loads(self) -> np.ndarray:
        """Return the load [N] of each of the m points, (m,)."""
        own = self.load if hasattr(self.load, "dims") else None
        values = np.reshape(self.load, [1] * (len(self.dims) - 1) + [-1]) if own is None else aligned(own, self.dims)
        return np.broadcast_to(values, tuple(self.dims.values())).reshape(-1)

    @property
    def contacts(self) -> int:
        """Return the number of contacts: combinations of the values of array parameters, without the loads."""
        return math.prod(size for dim, size in self.dims.items() if dim != "load")

    def ends(self) -> "list[SampledCase]":
        """Return the first and the last contact of a parameter sweep, each as a case of its own without uncertain numbers.

        Without array parameters, both are the same contact.
        """
        contacts = []
        for index in (0, -1):
            some = {path: value.isel({dim: [index] for dim in value.dims}) for path, value in self.case.swept.items()}
            load = self.load.isel({dim: [index] for dim in self.load.dims}) if hasattr(self.load, "dims") else self.load
            case = replace(self.case.at(some), swept=some, uncertain=())
            contacts.append(replace(self, case=case, load=load, levels=np.zeros((1, 0))))
        return contacts

    def places(self, dims: Mapping[str, int]) -> np.ndarray:
        """Return, for each of the m points (contacts at a load), its index in flattened results, (m,).

        dims: length of each dimension of the results. Each of these dimensions is also in `self.dims`.
        """
        numbers = np.arange(math.prod(dims.values())).reshape(tuple(dims.values()))
        return np.broadcast_to(arranged(numbers, list(dims), self.dims), tuple(self.dims.values())).reshape(-1)

    def areas(self, choice: Choice, pulls: Sequence[str] = (), faint: bool = False) -> np.ndarray:
        """Return the real contact area [m2] (n or 1, m) by one model for all samples; one row if it does not vary.

        The area is NaN where the model refuses a sample, cannot carry the load, or gives an impossible result. choice: the
        model. pulls: names in PULLS of the attractive forces to include; by default adhesion and liquid are left out. faint:
        whether the work of adhesion is reduced until it has no effect. Raises InputError or ArithmeticError if the model
        refuses the nominal contact. The nominal contact is not solved if one batch solves all samples without an error.
        """
        left_out = [*_INTERFACE, *(name for name in PULLS if name not in pulls)]
        case = replace(_without(self.case, left_out), load=self.load, separation=None)
        case = _faint(case) if faint else case
        names = [name for name in self.case.unknowns if name in case.unknowns]
        columns = [list(self.case.unknowns).index(name) for name in names]
        levels = self.levels[:, columns] if columns else np.zeros((1, 0))
        drawn = draw(case, levels, [Variant(choice)], names=("contact_area",))
        table = arranged(drawn.tables["contact_area"], (SAMPLE, *drawn.dims["contact_area"]), (SAMPLE, *self.dims))
        return np.broadcast_to(table, (len(levels), *self.dims.values())).reshape(len(levels), -1)

    def by_numbers(self) -> "SampledCase":
        """Return the case with roughness parameters instead of a height map.

        Solving the map again for each sample would take too long.
        """
        return replace(self, case=replace(self.case, subject=self.contact.as_numbers()))

    @cached_property
    def gaussian_share(self) -> np.ndarray:
        """Return the degree, 0 to 1, to which the asperities agree with a Gaussian surface, at each of m points (m,).

        A point is a contact at a load. N, R and sigma are density, radius and height deviation of asperities. The degree is 1
        if N R sigma reaches the smallest value of a Gaussian surface, and 0 at half of this value or less. The transition
        between these values is a judgement.
        """
        rough = self.contact.roughness
        numbers = self.column(rough.asperity_density * rough.asperity_radius * rough.asperity_height_deviation)[0]
        return np.broadcast_to(np.clip(1.0 + np.log2(numbers / LEAST_DENSITY), 0.0, 1.0), self.loads.shape)

    def as_gaussian(self) -> "SampledCase":
        """Return the case with the asperity density raised to the smallest value that a Gaussian surface can have.

        This smallest density follows from the radius and the height deviation of asperities. A larger density is unchanged.
        """
        path, rough = ("contact", "roughness", "asperity_density"), self.contact.roughness
        least = LEAST_DENSITY * (1.0 + 1e-9) / (rough.asperity_radius * rough.asperity_height_deviation)
        density: dict[Address, Any] = {path: np.maximum(rough.asperity_density, least)}
        return replace(self, case=replace(self.case.at(density), swept={**self.case.swept, **density}))

    def variation(self, choice: Choice) -> np.ndarray:
        """Return the area of all samples divided by the area of the nominal contact, (n, m), both by one model."""
        nominal = replace(self, case=replace(self.case, uncertain=()), levels=np.zeros((1, 0)))
        return self.areas(choice) / nominal.areas(choice)

    def nominal(self, model: str) -> Contact:
        """Return the nominal contact without adhesion, liquid and interface, with the roughness parameters that a model needs.

        model: key of the model.
        """
        return _contact(_without(self.case, _INTERFACE + PULLS).with_surface_moments(model))

    @cached_property
    def on_map(self) -> bool:
        """Return whether the contact has a height map of its surface, even if a model uses the asperities found on it."""
        return self.contact.with_surface_moments().map is not None

    @cached_property
    def metallic(self) -> np.ndarray:
        """Return a mask (1 or m,), True where the softer of the two touching surfaces (bodies or films) is a metal.

        Only junctions of metals grow under shear. m: number of points (contacts at a load).
        """
        first, second = (class_of(body) in ("metal", "soft metal") for body in self.contact.touching)
        return np.where(self._first_is_softer(self.contact), first, second)

    def _first_is_softer(self, contact: Contact) -> np.ndarray:
        """Return a mask (1 or m,) of the points (contacts at a load) at which the first surface is not harder than the second.

        The surfaces are the two that touch, bodies or films. Hardness is averaged over the samples.
        """
        first, second = (self.column(body.hardness).mean(axis=0) for body in contact.touching)
        return first <= second

    @cached_property
    def drawn(self) -> Contact:
        """Return the contact with the samples of its uncertain numbers as arrays along `sample`, without coordinates."""
        return _contact(self.case.at(self.case.numbers_at(self.levels)) if self.case.unknowns else self.case).unlabelled

    @cached_property
    def groups(self) -> tuple[Groups, dict[str, int]]:
        """Return the dimensionless groups of all samples and points (contacts at a load), and the dimensions of their arrays.

        The ratio of hardness to yield stress has its default value, because in some samples it would be less than 1.
        """
        return Groups.of(self.drawn.replace(hardness_to_yield=HARDNESS_TO_YIELD).indices())

    @cached_property
    def bodies(self) -> Bodies:
        """Return hardness, shear strength and shear modulus of the softer surface, and the largest pressure of spots, in Pa.

        They are given for all samples and points (contacts at a load), see `Bodies`. Hardness is that under asperities of the
        radius of each sample.
        """
        contact = self.drawn
        radius = contact.roughness.asperity_radius
        pair = Pair(*(at_radius(body, radius) for body in contact.touching))
        below = Pair(*(at_radius(body, radius) for body in (contact.first, contact.second)))
        ratio = pair.k if contact.hardness_to_yield is None else contact.hardness_to_yield
        hardness, body_below = self.column(pair.hardness), self.column(below.hardness)
        first, second = (self.column(body.shear_modulus) for body in contact.touching)
        modulus = np.where(self._first_is_softer(contact), first, second)
        shear_strength = hardness / (3.0**0.5 * self.column(ratio))
        return Bodies(hardness, shear_strength, modulus, np.maximum(hardness, body_below))

    def column(self, value: Any) -> np.ndarray:
        """Return a number of the sampled contact as an array (n or 1, m or 1) over n samples and m points (contacts at a load).

        value: a number, or an array along `sample` and dimensions in `dims`.
        """
        table = aligned(value, {SAMPLE: 0, **self.dims})
        if table.ndim < 2 or table.size == len(table):
            return table.reshape(-1, 1)
        return np.broadcast_to(table, (len(table), *self.dims.values())).reshape(len(table), -1)


def rows_of(table: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """Return the row of a table (n or 1, m) that each sample uses, (k, m); a single row serves all samples.

    rows: index of the row for each of k samples, (k,).
    """
    return table[rows] if len(table) > 1 else np.broadcast_to(table, (len(rows), *table.shape[1:]))


def _contact(case: Case) -> Contact:
    assert isinstance(case.subject, Contact)  # predictions of [indices] were refused before
    return case.subject


def _without(case: Case, names: Sequence[str]) -> Case:
    """Return the case without the fields `names` of its contact, and without uncertain numbers and arrays in these fields."""
    return _changed(case, dict.fromkeys(names))


def _changed(case: Case, fields: Mapping[str, Any]) -> Case:
    """Return the case with fields of its contact replaced by exact values, which are neither uncertain nor arrays.

    fields: values by name of the field. Replacing the work of adhesion also removes the work of adhesion of the film.
    """
    contact = _contact(case)
    uncertain = tuple(number for number in case.uncertain if not (set(number.path[1:]) & fields.keys()))
    swept = {path: value for path, value in case.swept.items() if not (set(path[1:]) & fields.keys())}
    film: dict[str, Any] = {}
    if contact.coating is not None and "work_of_adhesion" in fields:
        film = {"coating": contact.coating.replace(work_of_adhesion=None)}
    return replace(case, subject=contact.replace(**fields, **film), uncertain=uncertain, swept=swept)


_FAINT = 1e-6  # factor of the work of adhesion at which adhesion has no effect


def _faint(case: Case) -> Case:
    """Return the case with a millionth of its mean work of adhesion, as an exact number.

    Adhesion then has no effect, but adhesive models, which refuse a work of adhesion of 0, still apply.
    """
    return _changed(case, {"work_of_adhesion": _FAINT * float(np.mean(np.asarray(_contact(case).work_of_adhesion)))})
