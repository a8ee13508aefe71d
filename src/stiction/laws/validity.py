"""Report validity warnings where an input or a result lies outside the range in which a model or law is valid."""

import json
from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction.contact.subject import Subject
from stiction.records.claims import Validity
from stiction.records.validity_warning import ValidityWarning

if TYPE_CHECKING:
    import xarray


def warnings_about(subject: Subject, rules: Iterable[Validity], results: Mapping[str, Any]) -> list[ValidityWarning]:
    """Return one warning for each validity range that is violated by an input or a result of a contact.

    rules: the validity ranges. results: dimensionless results by name. A quantity that is not in `results` is taken from the
    contact, `subject`. A quantity that is None or unknown is not checked. A warning states the smallest and the largest value
    outside the range, and how many of the values are outside.
    """
    warnings = []
    for rule, values, outside in violated_ranges(subject, rules, results):
        ends = float(values[outside].min()), float(values[outside].max())
        points = int(outside.sum()), outside.size
        warnings.append(ValidityWarning(rule.why, rule.quantity, *ends, rule.low, rule.high, *points, rule.kind))
    return warnings


def violated_ranges(
    subject: Subject, rules: Iterable[Validity], results: Mapping[str, Any]
) -> Iterator[tuple[Validity, np.ndarray, np.ndarray]]:
    """Yield each violated validity range, with all values of its quantity and a mask of the values outside the range.

    rules: the validity ranges. results: dimensionless results by name. A quantity that is not in `results` is taken from the
    contact, `subject`. A quantity that is None or unknown is not checked. NaN counts as inside.
    """
    for rule in rules:
        value = results[rule.quantity] if rule.quantity in results else subject.known(rule.quantity)
        if value is None:
            continue
        values = np.atleast_1d(np.asarray(value, dtype=float))
        outside = (values < rule.low) | (values > rule.high)
        if outside.any():
            yield rule, values, outside


def with_warnings(data: "xarray.Dataset", more: Iterable[ValidityWarning]) -> "xarray.Dataset":
    """Return a copy of a result with the validity warnings `more` appended to its own.

    Warnings are stored as text in the attribute `outside_validity` and as JSON in the attribute `validity_warnings`.
    """
    return data.assign_attrs(as_attributes([*warnings_of(data), *more]))


def as_attributes(warnings: Iterable[ValidityWarning]) -> dict[str, str]:
    """Return the two attributes that store validity warnings in a result and in netCDF files.

    `outside_validity` holds them as text, joined by "; ", `validity_warnings` as a JSON list. Without warnings the attributes
    are "" and "[]".
    """
    listed = tuple(warnings)
    data = json.dumps([warning.as_data() for warning in listed], ensure_ascii=False)
    return {"outside_validity": "; ".join(map(str, listed)), "validity_warnings": data}


def warnings_of(data: "xarray.Dataset") -> list[ValidityWarning]:
    """Return the validity warnings stored in the attributes of a result, or an empty list."""
    return read_warnings(data.attrs.get("validity_warnings", "[]"))


def read_warnings(text: str) -> list[ValidityWarning]:
    """Return the validity warnings in a JSON text, such as the attribute `validity_warnings` of a result."""
    return [ValidityWarning.from_data(row) for row in json.loads(text)]
