"""Look up the selected model and laws by their keys, and raise errors for laws that cannot be combined."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from stiction.contact.indices import Groups
from stiction.laws.joining import Law
from stiction.quantities.errors import InputError
from stiction.records.registry import (
    JUNCTIONS,
    NO_JUNCTIONS,
    Addition,
    AsperityLaw,
    FilmLaw,
    Record,
    RoughSurface,
    TangentialLaw,
    find,
    friction_incompatibility,
    incompatibility,
    kinds_of_additions,
    resolve_options,
)
from stiction.solving.choice import Choice


@dataclass(frozen=True)
class ResolvedLaws:
    """Store a model with its laws and all their options.

    model: the rough-surface model. asperity: asperity law; None for a closed-form theory or a model that solves a map.
    tangential: tangential law; None for a contact without friction. film: film law; None for a bare contact. options: values by
    name. ignored: selected laws that have no effect on this contact, as texts. additions: additional laws (menisci, ageing ...)
    by keyword. dry: whether the user switched menisci off with meniscus = "none"; always False for a sum over asperities.
    """

    model: RoughSurface
    asperity: AsperityLaw | None
    tangential: TangentialLaw | None
    film: FilmLaw | None
    options: Mapping[str, str]
    ignored: tuple[str, ...] = ()
    additions: Mapping[str, Addition] = field(default_factory=dict)
    dry: bool = False

    @property
    def law(self) -> Law:
        """Return the combined law of a single asperity: the asperity law with the tangential law."""
        assert self.asperity is not None, "a theory in closed form has no asperity law"
        return Law(self.asperity, self.tangential, self.options)

    @property
    def yielded(self) -> str:
        """Return the assumption on the resistance of yielded junctions, a key of `records.claims.YIELDED`, such as "none".

        The result is "" without a tangential law, or if the law states no assumption.
        """
        if self.tangential is None:
            return ""
        taken = [law.yielded for law in self.tangential.parts(self.options) if isinstance(law, TangentialLaw)]
        return (taken or [self.tangential.yielded])[0]

    def with_option(self, name: str, value: str) -> "ResolvedLaws":
        """Return the same laws with the option `name` set to `value`."""
        return replace(self, options={**self.options, name: value})

    def without(self, keyword: str, **changes: Any) -> "ResolvedLaws":
        """Return the same laws without the additional law (menisci, ageing ...) that the given keyword of `solve` selects.

        changes: other fields to replace.
        """
        return replace(self, additions={name: law for name, law in self.additions.items() if name != keyword}, **changes)

    def records(self) -> list[Record]:
        """Return the records of the model and of all laws in use, including laws that options add.

        The asperity law is omitted if the film law has its own.
        """
        asperity = None if self.film is not None and self.film.own_asperity else self.asperity
        laws = [law for law in (self.model, asperity, self.tangential, self.film, *self.additions.values()) if law is not None]
        return [record for law in laws for record in (law, *law.parts(self.options))]


def resolve_laws(choice: Choice, coated: bool, groups: Groups | None = None) -> ResolvedLaws:
    """Look up the model and laws that a choice names by their keys, and check that they can be combined.

    coated: whether the contact has a film. groups: dimensionless groups of the contact; some of them add laws by default, for
    example menisci. Raises InputError for unknown keys, for options that none of the laws has, and for laws that cannot be
    combined.
    """
    model = find(choice.model_key, RoughSurface)
    key = choice.tangential or model.tangential
    tangential = None if key == "none" else find(key, TangentialLaw)
    if not model.asperity:
        _refuse_parts(choice, model, tangential, coated and model.of_map is None)
        options, ignored = _options(choice, model, tangential), _ignored(choice, coated)
        additions = _additions(choice, groups, model, tangential, None)
        return ResolvedLaws(model, None, tangential, None, options, ignored, additions, choice.beside.get("meniscus") == "none")
    asperity = find(choice.asperity or model.asperity, AsperityLaw)
    film = _film(choice, model) if coated else None
    additions = _additions(choice, groups, model, tangential, film)
    if choice.film and not coated:
        find(choice.film, FilmLaw)  # without a film a known law is ignored, but an unknown key must raise an error
    for law in (tangential, film, *additions.values()):
        if law is not None and (reason := incompatibility(law, asperity)):
            field, value = ("asperity", asperity.key) if choice.asperity else (law.keyword, law.key)
            raise InputError(field, value, f"another {field} law, because {reason}")
    if film is not None and (reason := friction_incompatibility(film, tangential)):
        assert tangential is not None  # without a tangential law the film law is always compatible
        raise InputError("tangential", tangential.key, f"another tangential law, because {reason}")
    options = _options(choice, model, asperity, tangential, film)
    _refuse_junctions(film, tangential, options)
    return ResolvedLaws(model, asperity, tangential, film, options, _ignored(choice, coated), additions)


def _additions(
    choice: Choice, groups: Groups | None, model: RoughSurface, tangential: TangentialLaw | None, film: FilmLaw | None
) -> dict[str, Addition]:
    """Return the additional laws (menisci, ageing ...) by keyword: laws that the choice names, and default laws.

    A default law is added if the contact specifies the quantities that it needs; it is omitted if it cannot be combined with
    the other laws. A named law that cannot be combined, or an unknown key, raises InputError.
    """
    additions: dict[str, Addition] = {}
    for keyword, kind in kinds_of_additions().items():
        key = choice.beside.get(keyword)
        if (key is None and (groups is None or not kind.is_stated(groups))) or (key == "none" and kind.default):
            continue
        allowed = kind.allowed(model, tangential, film)
        if key is None and allowed:
            continue
        law = find(key or kind.default, kind)
        if allowed:
            raise InputError(keyword, law.key, allowed)
        additions[keyword] = law
    return additions


def _refuse_junctions(film: FilmLaw | None, tangential: TangentialLaw | None, options: Mapping[str, str]) -> None:
    """Raise InputError if the selected law for yielded junctions cannot be combined with the film law."""
    if film is None or options.get(JUNCTIONS, NO_JUNCTIONS) == NO_JUNCTIONS:
        return
    for law in () if tangential is None else tangential.parts(options):
        if isinstance(law, TangentialLaw) and (reason := friction_incompatibility(film, law)):
            raise InputError(JUNCTIONS, law.key, f"{NO_JUNCTIONS}, or a law that suits the film law: {reason}")


def _ignored(choice: Choice, coated: bool) -> tuple[str, ...]:
    """Return the name of a film law that has no effect because the contact has no film, as a tuple of one text, or ().

    Raises InputError for an unknown key.
    """
    return () if coated or choice.film is None else (f"film {find(choice.film, FilmLaw).key}",)


def _options(choice: Choice, *laws: Record | None) -> dict[str, str]:
    return resolve_options([law for law in laws if law is not None], choice.options)


def _film(choice: Choice, model: RoughSurface) -> FilmLaw:
    brought = [key for value, key in model.film_by_option.items() if value in choice.options.values()]
    if brought:
        if choice.film not in (None, *brought):
            raise InputError("film", choice.film, f"{brought[0]}, the film law that these options of {model.key} select")
        return find(brought[0], FilmLaw)
    key = choice.film or model.default_film
    if not key:
        raise InputError("model", model.key, "a model for coated contacts, because this contact has a film")
    film = find(key, FilmLaw)
    if not film.interchangeable:
        raise InputError("film", key, "another film law: this one works only with one variant of its own model")
    return film


def _refuse_parts(choice: Choice, model: RoughSurface, tangential: TangentialLaw | None, coated: bool) -> None:
    """Raise InputError if a model without a sum over asperities does not support the contact or a chosen law.

    A model for coated contacts is refused for a bare contact, and a model for bare contacts for a coated one. An asperity law
    is refused. A film law is refused if the model has its own film or solves a map. The tangential law must be a law of
    interface strength. coated: whether the contact has a film; False for a model that solves a map.
    """
    if coated and not model.on_film:
        raise InputError("model", model.key, "a model for coated contacts, because this contact has a film")
    if model.on_film and not coated:
        raise InputError("model", model.key, "a model for bare contacts, because this contact has no film")
    if coated and choice.film:
        raise InputError("film", choice.film, f"no film law, because {model.key} already contains one")
    if choice.asperity:
        raise InputError("asperity", choice.asperity, f"no asperity law, because {model.key} does not sum over asperities")
    if model.of_map is not None and choice.film:
        raise InputError("film", choice.film, f"no film law, because {model.key} solves the elasticity of the film")
    if tangential is not None and not tangential.interfacial:
        why = "no single asperities" if model.of_map is None else "contact patches of any shape, not spheres"
        raise InputError("tangential", tangential.key, f"a law of interface strength, because {model.key} has {why}")
