"""Represent a choice of model and laws by their keys, without importing the registry."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, TypedDict

from stiction.quantities.errors import InputError
from stiction.records.additions import names_of_additions

_OF_MODEL = ("model", "asperity", "tangential", "film")
LAWS = (*_OF_MODEL, *names_of_additions())  # keywords of the kinds of records that a user chooses

# The default model, and the name that selects the prediction in place of a model.
DEFAULT_MODEL, RECOMMENDED = "soft_coating_2015", "recommended"


class LawKeywords(TypedDict, total=False):
    """List the keyword arguments for laws and options that public functions accept, for code completion in editors.

    Laws of other packages may add options, which are also passed as keywords.
    """

    # <!-- keywords: begin, made by docs/make_tables.py -->
    asperity: str | None
    tangential: str | None
    film: str | None
    ageing: str | None
    contamination: str | None
    meniscus: str | None
    presliding: str | None
    adhesion: str | None
    alpha: str | None
    bound: str | None
    branch: str | None
    film_shear: str | None
    hardness: str | None
    limiting_pressure: str | None
    mode_mixity: str | None
    modulus: str | None
    other_body: str | None
    plastic_junctions: str | None
    points: str | None
    rim_pressure: str | None
    shear: str | None
    soft_film_exponent: str | None
    transition: str | None
    variant: str | None
    yielding: str | None
    # <!-- keywords: end -->


@dataclass(frozen=True)
class Choice:
    """Store the keys of a model and of its laws, and its options.

    model: key of the model; None for the default model. asperity, tangential, film: keys of laws that replace those of the
    model; None keeps the law of the model, and tangential = "none" omits friction. options: values by name; None means the
    default. beside: keys of further laws (menisci, ageing ...) by keyword; "none" omits a law that would be added by default.
    """

    model: str | None = None
    asperity: str | None = None
    tangential: str | None = None
    film: str | None = None
    options: Mapping[str, str | None] = field(default_factory=dict)
    beside: Mapping[str, str | None] = field(default_factory=dict)

    def __post_init__(self):
        for name, value in (self.arguments() | {"model": None}).items():  # the model is checked where it is looked up
            if not (value is None or isinstance(value, str)):
                raise InputError(name, value, "text: the name of a law or of an option")

    @classmethod
    def of(cls, model: str | None, given: Mapping[str, Any]) -> "Choice":
        """Build the choice of a model from keyword arguments.

        model: key of the model, or None for the default model. given: keys of laws and values of options, by keyword.
        """
        words = dict(given)
        laws = {name: words.pop(name) for name in _OF_MODEL[1:] if name in words}
        beside = {name: key for name in LAWS if (key := words.pop(name, None)) is not None}
        return cls(model, options=words, beside=beside, **laws)

    def laws(self) -> dict[str, str | None]:
        """Return the keys of the model and of all laws, by keyword of `solve`; None means a default."""
        return {name: getattr(self, name) if name in _OF_MODEL else self.beside.get(name) for name in LAWS}

    @property
    def model_key(self) -> str:
        """Return the key of the model, or of the default model if none is named."""
        return DEFAULT_MODEL if self.model is None else self.model

    @property
    def name(self) -> str:
        """Return the name of the model with the laws and options that replace its own.

        >>> Choice("greenwood_williamson_1966", tangential="tabor_1959").name
        'greenwood_williamson_1966 + tabor_1959'
        """
        laws = [key for law, key in self.laws().items() if law != "model" and key is not None]
        options = [f"{name} {value}" for name, value in self.options.items() if value is not None]
        return " + ".join([self.model_key, *laws, *options])

    def with_changes(self, laws: Mapping[str, str | None], options: Mapping[str, str | None]) -> "Choice":
        """Return a copy with the given laws and options replaced, by keyword; a value of None changes nothing."""
        changed = {name: value for name, value in {**laws, **options}.items() if value is not None}
        words = {**self.laws(), **self.options, **changed}
        return Choice.of(words.pop("model"), words)

    def arguments(self) -> dict[str, Any]:
        """Return the choice as the keyword arguments of `solve` that select it."""
        return self.laws() | dict(self.options)
