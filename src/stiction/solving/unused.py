"""Find inputs that none of the laws in use depends on, and name laws that would use them."""

import json
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction.contact.indices import Groups
from stiction.quantities.errors import InputError, InWords
from stiction.records.registry import AsperityLaw, Record, TangentialLaw, friction_incompatibility, incompatibility, of_kind
from stiction.solving.choice import Choice
from stiction.solving.problem_base import Problem

if TYPE_CHECKING:
    import xarray

# Inputs that are not a single dimensionless group. Adhesive laws use the works of adhesion; laws without adhesion that need n_g
# also use the work of adhesion of the film. If none is given for the film, the work of adhesion of the bodies is used for it.
_ADHESION, _OF_FILM = "adhesion", "adhesion of the film"
# Dimensionless groups of the strength of the interface.
_STRENGTH = ("shear_strength", "pressure_coefficient")


@dataclass(frozen=True)
class Unused:
    """Store an input that changes no result.

    input: its name. laws: keys of laws that would use it, by keyword of `solve`. why: reason, if it is not that the model
    ignores the input.
    """

    input: str
    laws: Mapping[str, list[str]] = field(default_factory=dict)
    why: str = ""

    def say(self, before: str = "", between: str = " ") -> str:
        """Describe the unused input in one line of text, and name laws that would use it.

        before: text before the keyword of a law, for example "--" in the terminal. between: text between keyword and key.
        """
        others = "; ".join(f"{before}{kind}{between}{' or '.join(keys)} uses it" for kind, keys in self.laws.items())
        return (
            f"{self.input} is not used"
            + (f": {self.why}" if self.why else " by this model")
            + (f"; {others}" if others else "")
        )

    def __str__(self) -> str:
        return self.say()


def unused_inputs(problem: Problem) -> list[Unused]:
    """Return the specified inputs that change no result under the laws in use."""
    film = problem.chosen.film
    one_body = film is not None and film.one_body
    spoken_of = {name for record in problem.records() for name in record.needs}
    spoken_of |= {name for record in problem.records() if record is film or not one_body for name in record.takes}
    given = problem.subject.optional_inputs() if problem.subject is not None else {}
    if problem.adheres or "n_g" in spoken_of:
        spoken_of.add(_OF_FILM)
    if (problem.adheres and not one_body) or (_OF_FILM in spoken_of and _OF_FILM not in given.values()):
        spoken_of.add(_ADHESION)
    plastic = [record for record in problem.records() if not (isinstance(record, TangentialLaw) and record.interfacial)]
    if any(name in ("lam", "hardness_group", "n_H") for record in plastic for name in record.needs):
        spoken_of.add("hardness")
    ratio = problem.groups.strength_over_bodies
    if "shear_strength" in spoken_of and ratio is not None and np.any(ratio >= 1.0 - 1e-12):  # limited by the bodies
        spoken_of |= {"hardness", "hardness_to_yield"}
    listed = [Unused(name, why="this contact has no film") for name in problem.chosen.ignored]
    for name, group in given.items():
        if not group:
            listed.append(Unused(name, why="the values of the bodies are used for the film too"))
        elif group not in spoken_of:
            listed.append(Unused(name, _laws_that_use(group, problem)))
    return listed


def ignored_strength(problem: Problem) -> list[str]:
    """Return the names of specified inputs of the interface strength, such as "interface", that the laws in use ignore."""
    given = problem.subject.optional_inputs() if problem.subject is not None else {}
    names = {name for name, group in given.items() if group in _STRENGTH}
    return [unused.input for unused in unused_inputs(problem) if unused.input in names] if names else []


def refuse_ignored_strength(problem: Problem, choice: Choice) -> None:
    """Raise InputError if the default model would ignore a specified shear strength or pressure coefficient of the interface.

    A model or tangential law chosen by the user may ignore such an input; the result then lists it as unused.
    """
    if choice.model is not None or choice.tangential is not None:
        return
    if ignored := ignored_strength(problem):
        inputs = dict(problem.subject.inputs())
        value = InWords(inputs.get(ignored[0]) or inputs.get(f"{ignored[0]}.name", "given"))
        allowed = f"no value with the default model, {choice.model_key}, which ignores it"
        hint = f"name a model: --model recommended, one that `stiction compare` shows, or {choice.model_key}"
        raise InputError(ignored[0], value, allowed, hint)


def _laws_that_use(group: str, problem: Problem) -> dict[str, list[str]]:
    """Return the keys of laws that would use a dimensionless group and suit the laws in use, by keyword (tangential, asperity).

    A keyword without such laws is absent.
    """
    chosen = problem.chosen
    asperity = chosen.asperity  # None for a theory in closed form
    known = problem.groups
    others = [law for law in (chosen.tangential, chosen.film) if law is not None]
    asperities: Iterable[AsperityLaw] = of_kind(AsperityLaw).values() if asperity is not None else ()
    records = {
        "tangential": [
            law.key
            for law in of_kind(TangentialLaw).values()
            if _uses(law, group, known)
            and (law.interfacial if asperity is None else not incompatibility(law, asperity))
            and not (chosen.film is not None and friction_incompatibility(chosen.film, law))
        ],
        "asperity": [
            law.key
            for law in asperities
            if _uses(law, group, known) and not any(incompatibility(other, law) for other in others)
        ],
    }
    return {kind: keys for kind, keys in records.items() if keys}


def _uses(record: Record, group: str, known: Groups) -> bool:
    """Return whether a law would use a dimensionless group and has all inputs that it requires.

    known: groups of the contact.
    """
    if not all(known.has(name) for name in record.needs):
        return False
    if group in (_ADHESION, _OF_FILM):
        return isinstance(record, AsperityLaw) and "no adhesion" not in record.traits
    return group in record.needs or group in record.takes


def as_attributes(listed: Iterable[Unused]) -> dict[str, str]:
    """Return attributes of a result that list unused inputs, as plain text and as JSON.

    The values are texts, which a netCDF file can store.
    """
    listed = list(listed)
    data = json.dumps([asdict(unused) for unused in listed], ensure_ascii=False)
    return {"inputs_not_used": "; ".join(map(str, listed)), "unused_inputs": data}


def unused_of(data: "xarray.Dataset") -> list[Unused]:
    """Read the list of unused inputs from the attributes of a result."""
    rows: list[dict[str, Any]] = json.loads(data.attrs.get("unused_inputs", "[]"))
    return [Unused(**row) for row in rows]
