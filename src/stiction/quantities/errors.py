"""The one error that a user's input can cause, and the one warning."""

import difflib
import re
from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager, contextmanager

_LONGEST = 80  # of a longer value the two ends are shown: of a path, the end says most


class InWords(str):
    """Describe a given value that is not text; it is shown without quotes."""


def _short(value) -> str:
    """Return the value on one line: quoted if text, "not given" for None, without its middle if long."""
    if value is None:
        return "not given"
    if isinstance(value, InWords):
        return re.sub(r"\s+", " ", value)
    if hasattr(value, "item") and getattr(value, "size", 1) == 1:
        value = value.item()  # 0.6 rather than np.float64(0.6)
    text = re.sub(r"\s+", " ", repr(value))
    half = (_LONGEST - 3) // 2
    return text if len(text) <= _LONGEST else f"{text[:half]}...{text[-half:]}"


class InputError(ValueError):
    """Report an unusable input; its text is one line.

    Parameters
    ----------
    field : str
        Dotted name of the input, e.g. "contact.coating.thickness".
    value : object
        Its value; None if it is missing.
    allowed : str
        Allowed values, with their unit.
    hint : str, optional
        Further help.

    Examples
    --------
    >>> import stiction as st
    >>> try:
    ...     st.Coating(material="silver", thickness="-3 nm")
    ... except st.InputError as error:
    ...     print(error.field)
    thickness
    """

    def __init__(self, field: str, value, allowed: str, hint: str = ""):
        self.field = field
        self.value = value
        self.allowed = allowed
        self.hint = hint
        super().__init__(field, value, allowed, *filter(None, [hint]))  # the arguments, so that the error can be pickled

    def __str__(self) -> str:
        field, allowed = (re.sub(r"\s+", " ", text) for text in (self.field, self.allowed))
        # Where no value is allowed, the reason stands alone.
        reason = allowed if allowed.startswith("not supported") else f"allowed: {allowed}"
        return "; ".join(filter(None, [f"{field}: {_short(self.value)}", reason, self.hint]))


@contextmanager
def field_as(name: Callable[[str], str]) -> Iterator[None]:
    """Rename the field of an InputError raised inside."""
    try:
        yield
    except InputError as error:
        raise InputError(name(error.field), error.value, error.allowed, error.hint) from None


def field_named(name: str) -> AbstractContextManager[None]:
    """Replace the field of an InputError raised inside by this name; "" if the caller adds the full path."""
    return field_as(lambda field: name)


def field_below(place: str) -> AbstractContextManager[None]:
    """Put the place of a table before the field of an InputError raised inside."""
    return field_as(lambda field: f"{place}.{field}".rstrip("."))


_MANY = 20  # known words, above which an error does not list them


def nearest(word, known: Iterable[str]) -> str:
    """Return the known words, the likely ones first if there are any; of more than _MANY only some."""
    known = list(known)
    plain = {one.casefold(): one for one in known}
    close = [plain[one] for one in difflib.get_close_matches(str(word).casefold(), plain, n=3, cutoff=0.5)]
    if len(known) > _MANY:
        return " or ".join(close) if close else f"{', '.join(known[:3])} and {len(known) - 3} more"
    every = ", ".join(known)
    return f"{' or '.join(close)} (all: {every})" if close else every


class InputWarning(UserWarning):
    """Warn of an input that can be used but is out of all proportion.

    Notes
    -----
    Python's `warnings` module filters it; `warnings.simplefilter("error", st.InputWarning)` raises it.

    Examples
    --------
    >>> import stiction as st
    >>> issubclass(st.InputWarning, UserWarning)
    True
    """
