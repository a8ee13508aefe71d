"""The laws that are to answer: a choice looked up in the registry, with the reason where its parts do not suit each other."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from stiction.laws.joining import Law
from stiction.laws.registry import (
    JUNCTIONS,
    NO_JUNCTIONS,
    Ageing,
    AsperityLaw,
    Contamination,
    FilmLaw,
    Meniscus,
    Presliding,
    Record,
    RoughSurface,
    TangentialLaw,
    find,
    friction_incompatibility,
    incompatibility,
    resolve_options,
)
from stiction.quantities.errors import InputError
from stiction.solving.choice import Choice


@dataclass(frozen=True)
class Chosen:
    """A model with its laws and all their options.

    asperity: None for a theory in closed form; film: None for a bare contact; tangential: None for contact only.
    ignored: what was chosen too and has nothing to answer for. meniscus: None where no law of menisci
    pulls; ageing: None where nothing strengthens at rest; contamination: None where no spread is asked; dry: whether menisci
    were left out by name.
    """

    model: RoughSurface
    asperity: AsperityLaw | None
    tangential: TangentialLaw | None
    film: FilmLaw | None
    presliding: Presliding | None
    options: Mapping[str, str]
    ignored: tuple[str, ...] = ()
    meniscus: Meniscus | None = None
    ageing: Ageing | None = None
    contamination: Contamination | None = None
    dry: bool = False

    @property
    def law(self) -> Law:
        """The asperity law joined with the tangential law."""
        assert self.asperity is not None, "a theory in closed form has no asperity law"
        return Law(self.asperity, self.tangential, self.options)

    @property
    def yielded(self) -> str:
        """What junctions that have yielded resist, of registry.YIELDED; "" for contact only, or a law that does not say."""
        if self.tangential is None:
            return ""
        taken = [one.yielded for one in self.tangential.parts(self.options) if isinstance(one, TangentialLaw)]
        return (taken or [self.tangential.yielded])[0]

    def with_option(self, name: str, value: str) -> "Chosen":
        """The same with another value of an option."""
        return replace(self, options={**self.options, name: value})

    def records(self) -> list[Record]:
        """The records of all that answers, each with the parts that its options bring into it."""
        asperity = None if self.film is not None and self.film.own_asperity else self.asperity
        interface = self.presliding, self.meniscus, self.ageing, self.contamination
        laws = [one for one in (self.model, asperity, self.tangential, self.film, *interface) if one is not None]
        return [record for one in laws for record in (one, *one.parts(self.options))]


def look_up(choice: Choice, coated: bool) -> Chosen:
    """The laws of a choice, for a contact with a film or without one.

    Raises InputError for keys that are not known, for options that none of the laws has, and where laws do not suit each other.
    """
    model = find(choice.model_key, RoughSurface)
    presliding = find(choice.presliding, Presliding) if choice.presliding else None
    tangential = _tangential(choice.tangential or model.tangential)
    if not model.asperity:
        _refuse_parts(choice, model, tangential, coated and model.of_map is None)
        options, ignored = _options(choice, model, tangential), _ignored(choice, coated)
        ageing, dry = _ageing(choice, model, tangential), choice.meniscus == "none"
        return Chosen(model, None, tangential, None, None, options, ignored, ageing=ageing, dry=dry)
    asperity = find(choice.asperity or model.asperity, AsperityLaw)
    film = _film(choice, model) if coated else None
    meniscus = None if choice.meniscus in (None, "none") else find(choice.meniscus, Meniscus)
    if choice.film and not coated:
        find(choice.film, FilmLaw)  # one that is known waits for a contact with a film; one that nobody knows is refused
    for one in (tangential, film, meniscus):
        if one is not None and (reason := incompatibility(one, asperity)):
            field, value = ("asperity", asperity.key) if choice.asperity else (one.keyword, one.key)
            raise InputError(field, value, f"laws that go together: {reason}")
    if film is not None and (reason := friction_incompatibility(film, tangential)):
        assert tangential is not None  # without friction there is nothing that could not suit
        raise InputError("tangential", tangential.key, f"laws that go together: {reason}")
    options = _options(choice, model, asperity, tangential, film)
    _refuse_junctions(film, tangential, options)
    ageing, ignored = _ageing(choice, model, tangential), _ignored(choice, coated)
    varies = _contamination(choice, tangential, film)
    return Chosen(model, asperity, tangential, film, presliding, options, ignored, meniscus, ageing, varies)


def _refuse_junctions(film: FilmLaw | None, tangential: TangentialLaw | None, options: Mapping[str, str]) -> None:
    """Raises InputError where the law that is taken for yielded junctions cannot go with the film."""
    if film is None or options.get(JUNCTIONS, NO_JUNCTIONS) == NO_JUNCTIONS:
        return
    for law in () if tangential is None else tangential.parts(options):
        if isinstance(law, TangentialLaw) and (reason := friction_incompatibility(film, law)):
            raise InputError(JUNCTIONS, law.key, f"{NO_JUNCTIONS}, or what goes with the film: {reason}")


def _ignored(choice: Choice, coated: bool) -> tuple[str, ...]:
    """The film law that was chosen for a contact without a film. Raises InputError for a key that is not known."""
    return () if coated or choice.film is None else (f"film {find(choice.film, FilmLaw).key}",)


def _options(choice: Choice, *laws: Record | None) -> dict[str, str]:
    return resolve_options([one for one in laws if one is not None], choice.options)


def _ageing(choice: Choice, model: RoughSurface, tangential: TangentialLaw | None) -> Ageing | None:
    """The law of strengthening at rest; InputError where no strength of the interface is sheared that could grow."""
    if choice.ageing in (None, "none"):
        return None
    found = find(choice.ageing, Ageing)
    if model.of_map is not None:
        raise InputError("ageing", found.key, f"none: {model.key} limits the shear of points, which do not wait")
    if tangential is None or not tangential.of_area:
        without = "there is no tangential law" if tangential is None else f"{tangential.key} is none that goes with the area"
        raise InputError(
            "ageing", found.key, f"none, or a tangential law whose force is a strength of the interface on the area: {without}"
        )
    return found


def _contamination(choice: Choice, tangential: TangentialLaw | None, film: FilmLaw | None) -> Contamination | None:
    """The law of junctions that differ; InputError where no strength of the interface is sheared, or a film is."""
    if choice.contamination in (None, "none"):
        return None
    found = find(choice.contamination, Contamination)
    if film is not None:
        raise InputError(
            "contamination", found.key, f"none: how a junction is shared by film and substrate ({film.key}) is not known"
        )
    if tangential is None or not tangential.of_area:
        raise InputError(
            "contamination", found.key, "none, or a tangential law whose force is a strength of the interface on the area"
        )
    return found


def _tangential(key: str) -> TangentialLaw | None:
    return None if key == "none" else find(key, TangentialLaw)


def _film(choice: Choice, model: RoughSurface) -> FilmLaw:
    brought = [key for value, key in model.film_by_option.items() if value in choice.options.values()]
    if brought:
        if choice.film not in (None, *brought):
            raise InputError("film", choice.film, f"{brought[0]}, with these options of {model.key}")
        return find(brought[0], FilmLaw)
    key = choice.film or model.default_film
    if not key:
        raise InputError("model", model.key, "a model that knows films, or a film law beside it; this contact has a film")
    film = find(key, FilmLaw)
    if not film.interchangeable:
        raise InputError("film", key, "another film law; this one belongs to one reading of its model")
    return film


def _refuse_parts(choice: Choice, model: RoughSurface, tangential: TangentialLaw | None, coated: bool) -> None:
    """InputError for what a theory in closed form cannot be combined with."""
    if coated and not model.on_film:
        raise InputError("model", model.key, "a sum over asperities, which this model is not: this contact has a film")
    if model.on_film and not coated:
        raise InputError("model", model.key, "another model: this one is of surfaces with a film, and this contact has none")
    if coated and choice.film:
        raise InputError("film", choice.film, f"nothing: {model.key} has its own")
    if choice.asperity:
        raise InputError("asperity", choice.asperity, f"nothing: {model.key} is not a sum over asperity laws")
    if choice.presliding:
        raise InputError("presliding", choice.presliding, f"nothing: {model.key} knows no single asperities")
    if choice.contamination not in (None, "none"):
        raise InputError("contamination", choice.contamination, f"none: {model.key} knows no single junctions")
    if choice.meniscus not in (None, "none"):
        raise InputError("meniscus", choice.meniscus, f"none: {model.key} knows no single asperities for a liquid to bridge")
    if model.of_map is not None and choice.film:
        raise InputError("film", choice.film, f"nothing: {model.key} solves the film of the contact itself")
    if tangential is not None and not tangential.interfacial:
        why = "no single asperities" if model.of_map is None else "patches of contact of any shape, and no spheres"
        raise InputError("tangential", tangential.key, f"a law of the interface: {model.key} knows {why}")
