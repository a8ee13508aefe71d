"""The contact and the loads of a prediction, with its uncertain numbers, and the same contact bare of what is drawn beside."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from stiction.case.places import with_numbers
from stiction.case.read import Case, case_of
from stiction.case.uncertain import expanded
from stiction.contact.contact import Contact
from stiction.contact.materials import class_of
from stiction.contact.pair import pair_of
from stiction.contact.size_effect import at_radius
from stiction.solving.choice import Choice
from stiction.studies.uncertainty.drawing import Variant, draw

__all__ = ["PULLS", "Asked", "Bodies"]

# What pulls on a contact beside its load, and what its interface resists: drawn by parts of their own.
PULLS = ("work_of_adhesion", "liquid")
_INTERFACE = (
    "interface",
    "interfacial_shear_strength",
    "pressure_coefficient",
    "peeling",
    "strength_variation",
    "waiting_time",
    "cut_off_time",
    "strengthening",
)


@dataclass(frozen=True)
class Bodies:
    """Strengths of the surfaces that meet, arrays (n,) or single numbers [Pa]: of the softer one hardness, shear strength and
    shear modulus; hardest: the larger hardness of what may bear the load, which bounds the mean pressure of a spot."""

    hardness: np.ndarray
    shear_strength: np.ndarray
    shear_modulus: np.ndarray
    hardest: np.ndarray


@dataclass(frozen=True)
class Asked:
    """A case with one load or several, and the levels (n, k) of its k uncertain numbers.

    loads: array (m,) [N], all above 0.
    """

    case: Case
    loads: np.ndarray
    levels: np.ndarray

    @property
    def contact(self) -> Contact:
        """Return the nominal contact."""
        return _contact(self.case)

    def areas(self, choice: Choice, pulls: Sequence[str] = (), faint: bool = False) -> np.ndarray:
        """Return the area [m2] (n, m) of a model on the drawn contacts, NaN where it refuses one or cannot be right there.

        n is 1 where no number is uncertain. pulls: which of PULLS the contact has; faint: with a work of adhesion so small that
        it pulls with nothing. Raises InputError where the model refuses the nominal contact.
        """
        left_out = [*_INTERFACE, *(name for name in PULLS if name not in pulls)]
        case = replace(_without(self.case, left_out), load=self.loads, separation=None)
        case = _faint(case) if faint else case
        kept = [name for name in self.case.unknowns if name in case.unknowns]
        columns = [list(self.case.unknowns).index(name) for name in kept]
        levels = self.levels[:, columns] if columns else np.zeros((1, 0))
        drawn = draw(case, levels, [Variant(choice)], names=("contact_area",))
        return np.broadcast_to(drawn.tables["contact_area"], (len(levels), len(self.loads)))

    def by_numbers(self) -> "Asked":
        """Return the same without the map of its surface: of every draw a map would be solved anew."""
        tables = expanded(self.case.tables)
        numbers = {**tables["contact"], "roughness": self.contact.as_numbers().roughness}
        return replace(self, case=replace(self.case, tables={**tables, "contact": numbers}))

    def variation(self, choice: Choice) -> np.ndarray:
        """Return the area (n, m) of a model on the drawn contacts, over that on the nominal one."""
        nominal = replace(self, case=replace(self.case, uncertain=()), levels=np.zeros((1, 0)))
        return self.areas(choice) / nominal.areas(choice)

    def nominal(self, model: str) -> Contact:
        """Return the nominal contact without adhesion, liquid and interface, as the model of this key takes it."""
        bare = _without(self.case, _INTERFACE + PULLS)
        case = case_of(bare.tables, {})
        return _contact(case.with_surface_moments(model))

    @property
    def on_map(self) -> bool:
        """Return whether the map of the surface is known, also where a model takes the asperities found on it."""
        return self.contact.with_surface_moments().map is not None

    @property
    def metallic(self) -> bool:
        """Return whether junctions are of a bulk metal, which grows under shear; how a film grows no law knows."""
        weaker = min(self.contact.touching, key=lambda body: float(np.mean(body.hardness)))
        return not self.contact.has_film and class_of(weaker) in ("metal", "soft metal")

    @cached_property
    def drawn(self) -> Contact:
        """Return the contact whose uncertain numbers are arrays along the draws."""
        numbers = self.case.numbers_at(self.levels) if self.case.unknowns else {}
        return _contact(case_of(with_numbers(expanded(self.case.tables), numbers), {}))

    @cached_property
    def bodies(self) -> Bodies:
        """Return the strengths of the surfaces that meet."""
        contact = self.drawn
        radius = contact.roughness.asperity_radius
        pair = pair_of(*(at_radius(body, radius) for body in contact.touching))
        below = pair_of(*(at_radius(body, radius) for body in (contact.first, contact.second)))
        ratio = pair.k if contact.hardness_to_yield is None else contact.hardness_to_yield
        softer = min(contact.touching, key=lambda body: float(np.mean(body.hardness)))
        each = (
            pair.hardness,
            pair.hardness / (3.0**0.5 * ratio),
            softer.shear_modulus,
            np.maximum(pair.hardness, below.hardness),
        )
        return Bodies(*(self.column(one) for one in each))

    def column(self, value: Any) -> np.ndarray:
        """Return a number of the drawn contact as an array (n, 1), or (1, 1) where it is one number."""
        return np.asarray(value, dtype=float).reshape(-1, 1)


def _contact(case: Case) -> Contact:
    assert isinstance(case.subject, Contact)  # of normalised numbers there is no prediction
    return case.subject


def _without(case: Case, names: Sequence[str]) -> Case:
    """Return the case without these fields of its contact, and without their uncertain numbers."""
    tables = expanded(case.tables)
    contact = {name: value for name, value in tables["contact"].items() if name not in names}
    if "work_of_adhesion" in names and isinstance(contact.get("coating"), Mapping):
        contact["coating"] = {name: value for name, value in contact["coating"].items() if name != "work_of_adhesion"}
    uncertain = tuple(one for one in case.uncertain if not (set(one.path[1:]) & set(names)))
    return replace(case, tables={**tables, "contact": contact, "solve": {"load": ["1 N"]}}, uncertain=uncertain)


_FAINT = 1e-6  # of the work of adhesion


def _faint(case: Case) -> Case:
    """Return the case with a millionth of its work of adhesion, which pulls with nothing: laws of adhesion alone refuse 0."""
    contact = dict(case.tables["contact"])
    contact["work_of_adhesion"] = _FAINT * float(np.mean(_contact(case).work_of_adhesion))
    if isinstance(contact.get("coating"), Mapping):
        contact["coating"] = {name: value for name, value in contact["coating"].items() if name != "work_of_adhesion"}
    uncertain = tuple(one for one in case.uncertain if "work_of_adhesion" not in one.path)
    return replace(case, tables={**case.tables, "contact": contact}, uncertain=uncertain)
