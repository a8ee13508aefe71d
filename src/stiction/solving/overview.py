"""Describe the registered models and laws, and return the bibliography entries of a result."""

from collections.abc import Callable, Iterable
from contextlib import suppress
from typing import TYPE_CHECKING, Any, NotRequired, TypedDict, cast

from stiction.quantities.errors import InputError, InWords, nearest
from stiction.records.registry import AsperityMethod, FilmLaw, Limit, Record, records, text_of
from stiction.records.sources import bibliography, bibtex
from stiction.solving.accuracy.film_tables import summary

if TYPE_CHECKING:
    import xarray


class ModelRow(TypedDict):
    """Define the keys of the dictionaries that `models` returns for each model, law or method.

    Keys that exist only for some kinds of laws come last.
    """

    key: str
    kind: str
    title: str
    grade: str
    source: list[str]
    validity: list[str]
    needs: list[str]
    options: dict[str, list[str]]
    accuracy: str
    verified: str
    limits: list[str]
    notes: str
    text: str
    measured_film_error: NotRequired[list[str]]
    options_mean: NotRequired[dict[str, str]]
    traits: NotRequired[list[str]]
    required_traits: NotRequired[dict[str, str]]
    jumps: NotRequired[list[str]]
    departures: NotRequired[list[str]]
    asperity: NotRequired[str]
    tangential: NotRequired[str]
    default_film: NotRequired[str]
    own_asperity: NotRequired[bool]
    bares_substrate: NotRequired[bool]
    confined: NotRequired[bool]
    interchangeable: NotRequired[bool]
    interfacial: NotRequired[bool]
    yielded: NotRequired[str]
    below: NotRequired[str]
    above: NotRequired[str]
    property: NotRequired[str]
    label: NotRequired[str]
    order: NotRequired[int]
    of_profiles: NotRequired[bool]
    of_summits: NotRequired[bool]
    of_moments: NotRequired[bool]


def models(keys: Iterable[str] | None = None) -> list[ModelRow]:
    """Describe every model, law and method of finding asperities, or only those with given keys.

    Parameters
    ----------
    keys : iterable of str, optional
        Only the models, laws and methods with these keys; by default all.

    Returns
    -------
    list of ModelRow
        One dict for each model, law or method. Its value `text` holds assumptions, equations and check numbers in Markdown.

    Raises
    ------
    InputError
        A key is not known.

    Examples
    --------
    >>> import stiction as st
    >>> [model["title"] for model in st.models(["greenwood_williamson_1966"])]
    ['Elastic contact of nominally flat surfaces']
    """
    if keys is None:
        return [_row(record) for record in records()]
    known, wanted = {record.key for record in records()}, _texts(keys, "keys", "a list of keys of models, or None for all")
    for key in wanted:
        if key not in known:
            raise InputError("key", key, nearest(key, sorted(known)))
    return [_row(record) for record in records() if record.key in wanted]


def _row(record: Record) -> ModelRow:
    row: dict[str, Any] = {
        "key": record.key,
        "kind": record.kind,
        "title": record.title,
        "grade": record.grade,
        "source": [str(source) for source in record.sources],
        "validity": [f"{rule.quantity} {rule.range}: {rule.why}" for rule in record.validity],
        "needs": list(record.needs),
        "options": {name: list(values) for name, values in record.options.items()} | _parameters(record),
        "accuracy": record.accuracy,
        "verified": record.verified,
        "limits": [_limit(limit) for limit in record.limits],
        "notes": record.notes,
        "text": text_of(record),
    }
    if isinstance(record, FilmLaw):
        row["measured_film_error"] = _measured(record)
    if isinstance(record, AsperityMethod):
        row["options_mean"] = {name: option.meaning for name, option in record.parameters.items()}
    more = {name: say(getattr(record, name)) for name, say in _MORE.items() if hasattr(record, name)}
    return cast(ModelRow, row | more)


def _measured(record: FilmLaw) -> list[str]:
    """Return the measured errors of a film law on a sphere as lines of text, one per set of options and modulus ratio."""
    lines = []
    for table in summary(record.key):
        for row, n_E in enumerate(table["n_E"]):
            cells = [
                f"a/t = {width:g}: {area:+.0%}, {load:+.0%}"
                for width, area, load in zip(table["a_over_t"], table["area"][row], table["load"][row], strict=True)
            ]
            lines.append(f"{table['options']}, n_E = {n_E:g}: ".removeprefix(", ") + "; ".join(cells))
    return lines


def _parameters(record: Record) -> dict[str, list[str]]:
    """Return the allowed values of each option of an asperity method as texts, by name; {} for other records.

    The default comes first if there is one. An option without a list of values has one text that describes its allowed values.
    """
    texts: dict[str, list[str]] = {}
    for name, option in record.parameters.items() if isinstance(record, AsperityMethod) else ():
        others = [str(value) for value in option.values if value != option.default] or [option.allowed]
        texts[name] = others if option.default is None else [f"{option.default}", *others]
    return texts


def _limit(limit: Limit) -> str:
    """Describe one limiting case of a law: parent model, values of groups, results that agree, and tolerance."""
    values = [f"{name} = {value:g}" for name, value in limit.groups.items()]
    values += [f"{name} {value}" for name, value in limit.options.items()]
    return f"{limit.parent} at {', '.join(values)}: {' and '.join(limit.quantities)} within {limit.within:.0e}"


# Fields that only some kinds of records have, and the function that converts each for `models`.
_MORE: dict[str, Callable[[Any], Any]] = {
    "traits": sorted,
    "required_traits": dict,
    "jumps": lambda jumps: [f"{jump.where}: load times {jump.load:g}, contact area times {jump.area:g}" for jump in jumps],
    "departures": lambda departures: [str(one) for one in departures],
    "asperity": str,
    "tangential": str,
    "default_film": str,
    "own_asperity": bool,
    "bares_substrate": bool,
    "confined": bool,
    "interchangeable": bool,
    "interfacial": bool,
    "yielded": str,
    "below": str,
    "above": str,
    "property": str,
    "label": str,
    "order": int,
    "of_profiles": bool,
    "of_summits": bool,
    "of_moments": bool,
}


def cite(what: "xarray.Dataset | str | Iterable[str] | None" = None) -> str:
    """Return BibTeX entries of the sources that a result used.

    Parameters
    ----------
    what : xarray.Dataset, str or iterable of str, optional
        A result of `solve` or `predict`, or keys of models or of bibliography entries; by default the whole bibliography.

    Returns
    -------
    str
        BibTeX.

    Raises
    ------
    InputError
        A key is not known, or a dataset has no attribute `sources`.

    Examples
    --------
    >>> import stiction as st
    >>> print(st.cite("hertz_1882").splitlines()[0])
    @article{hertz_1882,
    """
    if what is None:
        return entries()
    if hasattr(what, "attrs"):
        if "sources" not in what.attrs:
            raise InputError("what", InWords("a dataset without the attribute sources"), "a result of `solve`")
        return entries(what.attrs["sources"].split())
    keys: list[str] = []
    for key in _texts([what] if isinstance(what, str) else what, "what", "a result of `solve`, a key or a list of keys"):
        named = [source.key for record in records() if record.key == key for source in record.sources]
        keys += named or [key]
    return entries(keys)


def _texts(values: Any, field: str, allowed: str) -> list[str]:
    """Return an iterable of texts as a list; raise InputError for anything else.

    field, allowed: field and allowed values, for the error message.
    """
    with suppress(TypeError):
        texts = list(values)
        if all(isinstance(text, str) for text in texts):
            return texts
    raise InputError(field, values, allowed)


def entries(keys: Iterable[str] | None = None) -> str:
    """Return the BibTeX entries with these keys, from the bibliography and from the laws; by default all.

    Raises InputError for an unknown key.
    """
    more = {key: entry for record in records() for key, entry in record.entries.items()}
    return bibtex([*bibliography(), *more] if keys is None else keys, more)
