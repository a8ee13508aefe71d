"""What the program knows and where a result comes from: the registry and the bibliography for users."""

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from .registry import records
from .sources import bibliography, bibtex

if TYPE_CHECKING:
    import xarray


def models() -> list[dict[str, Any]]:
    """One dict for each model and film law, with at least key, kind, title, grade, source, validity, needs, options,
    verified and notes; texts and lists of texts."""
    rows = []
    for record in records().values():
        rows.append(
            {
                "key": record.key,
                "kind": record.kind,
                "title": record.title,
                "grade": record.grade,
                "source": [str(source) for source in record.sources],
                "validity": [f"{rule.quantity} {rule.range}: {rule.why}" for rule in record.validity],
                "needs": list(record.needs),
                "options": {name: list(values) for name, values in record.options.items()},
                "friction": record.friction,
                "coating": record.coating,
                "accuracy": record.accuracy,
                "verified": record.verified,
                "notes": record.notes,
            }
        )
    return rows


def cite(what: "xarray.Dataset | str | Iterable[str] | None" = None) -> str:
    """BibTeX of exactly what a result used.

    what: a result of `solve`; or the key of a model or of a bibliography entry, or several; or None for all.
    Raises InputError for an unknown key.
    """
    known = records()
    more = {key: entry for record in known.values() for key, entry in record.entries.items()}
    if what is None:
        return bibtex([*bibliography(), *more], more)
    if hasattr(what, "attrs"):
        return bibtex(what.attrs["sources"].split(), more)
    keys: list[str] = []
    for key in [what] if isinstance(what, str) else what:
        keys += [source.key for source in known[key].sources] if key in known else [key]
    return bibtex(keys, more)
