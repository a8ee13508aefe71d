"""Define the error that every unusable user input raises, and the warning for unusual input."""

import difflib
import re
from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager, contextmanager

_LONGEST = 80  # characters; a longer value is shown by both ends, because the end of a path matters most


class InWords(str):
    """Mark a text as a description of an input value; error messages show it without quotes."""


def _value_as_text(value) -> str:
    """Return an input value as one line of text for an error message.

    Text is quoted, None becomes "not given", and the middle of a line longer than 80 characters is replaced by "...".
    """
    if value is None:
        return "not given"
    if isinstance(value, InWords):
        return re.sub(r"\s+", " ", value)
    if hasattr(value, "item") and getattr(value, "size", 1) == 1:
        value = value.item()  # so that the error shows 0.6 and not np.float64(0.6)
    text = re.sub(r"\s+", " ", repr(value))
    half = (_LONGEST - 3) // 2
    return text if len(text) <= _LONGEST else f"{text[:half]}...{text[-half:]}"


class InputError(ValueError):
    """Report an unusable input in one line of text.

    Parameters
    ----------
    field : str
        Dotted name of the input, e.g. "contact.coating.thickness".
    value : object
        Value of the input; None if it is missing.
    allowed : str
        Allowed values, with their unit.
    hint : str, optional
        Further help for the user.

    Examples
    --------
    >>> import stiction as st
    >>> try:
    ...     st.Coating(material="silver", thickness="-3 nm")
    ... except st.InputError as error:
    ...     print(error.field)
    thickness
    """

    def __init__(self, field: str, value: object, allowed: str, hint: str = ""):
        self.field = field
        self.value = value
        self.allowed = allowed
        self.hint = hint
        super().__init__(field, value, allowed, *filter(None, [hint]))  # pickling needs these arguments

    def __str__(self) -> str:
        field, allowed = (re.sub(r"\s+", " ", text) for text in (self.field, self.allowed))
        # If no value is allowed, only the reason is stated.
        reason = allowed if allowed.startswith("not supported") else f"allowed: {allowed}"
        return "; ".join(filter(None, [f"{field}: {_value_as_text(self.value)}", reason, self.hint]))


@contextmanager
def explained(text: Callable[[str], str]) -> Iterator[None]:
    """Return a context manager that sets the hint of every InputError raised within it, in place of any earlier hint.

    text: function that maps the field name to the hint.
    """
    try:
        yield
    except InputError as error:
        raise InputError(error.field, error.value, error.allowed, text(error.field)) from None


@contextmanager
def field_as(name: Callable[[str], str]) -> Iterator[None]:
    """Return a context manager that replaces the field name of every InputError raised within it.

    name: function that maps the old field name to the new one.
    """
    try:
        yield
    except InputError as error:
        raise InputError(name(error.field), error.value, error.allowed, error.hint) from None


def field_named(name: str) -> AbstractContextManager[None]:
    """Return a context that sets the field name of every InputError raised in it to `name`.

    name: "" if the caller adds the full path of the field.
    """
    return field_as(lambda field: name)


def field_below(place: str) -> AbstractContextManager[None]:
    """Return a context that puts `place` and a dot before the field name of every InputError raised in it.

    place: dotted path of a table, such as "contact.coating": the field "thickness" becomes "contact.coating.thickness".
    """
    return field_as(lambda field: f"{place}.{field}".rstrip("."))


_MANY = 20  # largest number of allowed words that an error lists in full


def nearest(word, known: Iterable[str]) -> str:
    """Return the allowed words as text for an error message, starting with those most similar to a misspelt word.

    word: the unknown word. known: the allowed words. If there are more than 20, only similar words are listed, or, if none is
    similar, the first three and the number of the others.
    """
    known = list(known)
    plain = {name.casefold(): name for name in known}
    part = str(word).casefold()
    holding = [name for name in plain if part in name.split("_")]  # "glass" suggests "soda_lime_glass" rather than "brass"
    close = [plain[name] for name in holding[:3] or difflib.get_close_matches(part, plain, n=3, cutoff=0.5)]
    if len(known) > _MANY:
        return " or ".join(close) if close else f"{', '.join(known[:3])} and {len(known) - 3} more"
    every = ", ".join(known)
    return f"{' or '.join(close)} (all: {every})" if close else every


class InputWarning(UserWarning):
    """Warn of an input that can be used but is unusually large or small.

    Notes
    -----
    Python's `warnings` module can filter this warning; `warnings.simplefilter("error", st.InputWarning)` turns it into an
    error.

    Examples
    --------
    >>> import stiction as st
    >>> issubclass(st.InputWarning, UserWarning)
    True
    """
