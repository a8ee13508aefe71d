"""What is to answer: the names under which the registry knows a model and its laws. Quick to import: nothing is looked up."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from stiction.quantities.errors import InputError

# Keywords of the kinds of records that a user chooses.
LAWS = ("model", "asperity", "tangential", "film", "presliding", "meniscus", "ageing", "contamination")

# The model that answers where none is named, and the name under which the prediction is asked for in place of a model.
DEFAULT_MODEL, RECOMMENDED = "soft_coating_2015", "recommended"


@dataclass(frozen=True)
class Choice:
    """What is to answer: a model (None: the default one), and in place of what it takes by itself another asperity law,
    tangential law ("none" for contact only) or film law; how the contact yields before it slides, if that is wanted; how
    menisci pull ("none": as if there were no liquid), how the interface strengthens at rest ("none": it does not), and how
    it varies; keys of the registry. options: options of any of these, by name; None for a default."""

    model: str | None = None
    asperity: str | None = None
    tangential: str | None = None
    film: str | None = None
    options: Mapping[str, str | None] = field(default_factory=dict)
    presliding: str | None = None
    meniscus: str | None = None
    ageing: str | None = None
    contamination: str | None = None

    def __post_init__(self):
        for name, value in (self.arguments() | {"model": None}).items():  # an unknown model is refused with the known ones
            if not (value is None or isinstance(value, str)):
                raise InputError(name, value, "text: the key of a law, or a value of an option")

    @classmethod
    def of(cls, model: str | None, given: Mapping[str, str | None]) -> "Choice":
        """The choice of a model and of what is given by name: laws, and options, which are all that is no name of a law."""
        words = dict(given)
        laws = {name: words.pop(name) for name in LAWS if name in words}
        return cls(model, options=words, **laws)

    @property
    def model_key(self) -> str:
        """Return the key of the model that answers, the default one where none is named."""
        return DEFAULT_MODEL if self.model is None else self.model

    @property
    def name(self) -> str:
        """Return the model in a line, with the laws and options that are chosen in place of its own.

        >>> Choice("greenwood_williamson_1966", tangential="tabor_1959").name
        'greenwood_williamson_1966 + tabor_1959'
        """
        laws = [getattr(self, law) for law in LAWS if law != "model" and getattr(self, law) is not None]
        options = [f"{name} {value}" for name, value in self.options.items() if value is not None]
        return " + ".join([self.model_key, *laws, *options])

    def with_changes(self, laws: Mapping[str, str | None], options: Mapping[str, str | None]) -> "Choice":
        """The same with those laws and options that are not None."""
        changed = {name: value for name, value in options.items() if value is not None}
        return replace(self, **{k: v for k, v in laws.items() if v is not None}, options={**self.options, **changed})

    def arguments(self) -> dict[str, Any]:
        """The keywords of `solve`."""
        return {name: getattr(self, name) for name in LAWS} | dict(self.options)
