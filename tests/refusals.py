"""Expect an error of the user's input by its field, its numbers and its names, whatever its sentence is."""

import re
from collections.abc import Iterator
from contextlib import contextmanager

import pytest
import xarray

from stiction.laws.validity import warnings_of
from stiction.quantities.errors import InputError


@contextmanager
def refusal(field: str, *parts: object) -> Iterator[pytest.ExceptionInfo[InputError]]:
    """Expect an InputError of this field that shows these numbers, values and names; `tests/texts.txt` has the sentences."""
    with pytest.raises(InputError) as caught:
        yield caught
    error = caught.value
    text = str(error)
    assert error.field == field, text
    for part in map(str, parts):
        assert re.search(rf"(?<![\w.]){re.escape(part)}(?!\w)", text), f"{part!r} is missing: {text}"


def outside(data: xarray.Dataset) -> set[str]:
    """Return the quantities whose range of validity a result leaves."""
    return {warning.quantity for warning in warnings_of(data)}
