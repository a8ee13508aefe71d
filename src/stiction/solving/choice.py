"""What is to answer: the names under which the registry knows a model and its laws. Quick to import: nothing is looked up."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any


@dataclass(frozen=True)
class Choice:
    """What is to answer: a model, and in place of what it takes by itself another asperity law, tangential law ("none" for
    contact only) or film law; and how the contact yields before it slides, if that is wanted; keys of the registry. options:
    own options of any of these; None for a default."""

    model: str = "soft_coating_2015"
    asperity: str | None = None
    tangential: str | None = None
    coating_law: str | None = None
    options: Mapping[str, str | None] = field(default_factory=dict)
    presliding: str | None = None

    def with_changes(self, laws: Mapping[str, str | None], options: Mapping[str, str | None]) -> "Choice":
        """The same with those laws and options that are not None."""
        changed = {name: value for name, value in options.items() if value is not None}
        return replace(self, **{k: v for k, v in laws.items() if v is not None}, options={**self.options, **changed})

    def arguments(self) -> dict[str, Any]:
        """The keywords of `solve`."""
        laws = {name: getattr(self, name) for name in ("model", "asperity", "tangential", "coating_law", "presliding")}
        return laws | dict(self.options)
