"""Read the table [fit] of a case into a fit plan, and check it against the measured values.

A free parameter is a number of the case that the fit varies between a low and a high end.
"""

from collections.abc import Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from stiction.case.addresses import address_of, as_numbers, leaves_of, roughness_in
from stiction.case.free import Free, read_free
from stiction.case.measurements import Measurements, read_measurements
from stiction.case.read import Case, case_of, with_single_numbers
from stiction.case.study_tables import study_table
from stiction.case.swept import Address, number_of
from stiction.quantities.errors import InputError, InWords
from stiction.quantities.inputs import require_names
from stiction.studies.fit.table import Fit

WANTED = 'a table [fit.free] with e.g. work_of_adhesion = { low = "1 mJ/m^2", high = "1 J/m^2" }'
RESISTANCE = ("fit", "specific_contact_resistance")
_MOST_FREE = 8


@dataclass(frozen=True)
class FitPlan:
    """Hold the checked input of a fit.

    content: tables of the case without [fit], with scans and user-defined materials read. case: the case of these tables.
    given: the tables as the user wrote them. folder: folder to which paths in the tables are relative. free: the free
    parameters. models: names of alternative models. predict: table [fit.predict], numbers of the contact at which the fitted
    model makes predictions. resistance: specific contact resistance [ohm m^2], or None. data: the measured values. uncertain:
    dotted names of numbers that the case states as uncertain, and that are neither fitted nor columns of the data.
    """

    content: Mapping[str, Any]
    case: Case
    given: Mapping[str, Any]
    folder: Path
    title: str
    free: tuple[Free, ...]
    models: tuple[str, ...]
    predict: Mapping[str, Any]
    resistance: float | None
    data: Measurements
    uncertain: tuple[str, ...]


def make_fit_plan(content: Mapping[str, Any], data: Any, folder: Path = Path()) -> FitPlan:
    """Return the checked fit plan for the tables of a case and a file of measured values.

    data: path of the CSV file. folder: folder to which paths in the tables are relative. Raises InputError.
    """
    require_names(content)
    given = dict(content)
    fit = read_fit(given)
    plain, uncertain = with_single_numbers(given, folder, "arrays go under [fit.predict]")  # uncertain ones are nominal
    plain = as_numbers(plain)
    free = free_numbers(fit, plain)
    measured = read_measurements(data, plain)
    resistance = None
    if fit.specific_contact_resistance is not None:
        resistance = number_of(fit.specific_contact_resistance, RESISTANCE[1], ".".join(RESISTANCE))
    taken = {one.path for one in free} | {path for row in measured.known for path in row}
    plan = FitPlan(
        plain,
        _complete(plain, free, measured),
        given,
        folder,
        str(given.get("title", "")),
        free,
        tuple(fit.models),
        fit.predict,
        resistance,
        measured,
        tuple(".".join(path[1:]) for path in uncertain if path not in taken),
    )
    _check(plan)
    return plan


def middle_of(free: Iterable[Free]) -> dict[Address, float]:
    """Return the middle of the range of each free parameter of the contact, in SI units by address.

    The middle of a logarithmic range is the geometric mean of its ends. An address is a tuple of keys, e.g. ("contact",
    "first", "hardness").
    """
    return {one.path: float(one.at(0.5)) for one in free if one.path != RESISTANCE}


def _complete(content: Mapping[str, Any], free: tuple[Free, ...], data: Measurements) -> Case:
    """Return the case of these tables; if they are incomplete, numbers that the fit or the data supply are filled in.

    Free parameters are then set to the middle of their ranges (`middle_of`). If this is not enough, the numbers of the first
    measured row are added, provided all rows state the same quantities. Raises InputError if the case is still incomplete.
    """
    known = data.known[0] if all(row.keys() == data.known[0].keys() for row in data.known) else {}
    for numbers in ({}, middle_of(free)):
        with suppress(InputError):
            return case_of(content, numbers)
    return case_of(content, {**known, **middle_of(free)})


def read_fit(content: Mapping[str, Any]) -> Fit:
    """Return the table [fit] of a case; raise InputError if it is invalid."""
    fit: Fit = study_table(content, "fit", WANTED)
    return fit


def free_numbers(fit: Fit, content: Mapping) -> tuple[Free, ...]:
    """Return the 1 to 8 free parameters of the table [fit.free], each with its address in the case.

    content: tables of the case. Raises InputError.
    """
    found: dict[Address, Free] = {}
    for name, entry in leaves_of(fit.free, "fit.free", lambda table: "low" in table or "high" in table):
        where = f"fit.free.{name}"
        path = RESISTANCE if name == RESISTANCE[1] else address_of(name, content, where)
        if path in found:
            raise InputError(where, name, "each number only once; delete the repetition")
        found[path] = read_free(path, entry, where)
    if not 1 <= len(found) <= _MOST_FREE:
        raise InputError(
            "fit.free", InWords(f"{len(found)} numbers"), f"1 to {_MOST_FREE} numbers of the case, each with low and high"
        )
    return tuple(found.values())


def _check(plan: FitPlan) -> None:
    """Raise InputError if free parameters or resistance contradict the data or scans, or if the data are too few for a fit."""
    known = {path for row in plan.data.known for path in row}
    for one in plan.free:
        if one.path in known:
            raise InputError(
                f"fit.free.{one.name}",
                "free",
                "a number that is not a column of the data; delete one of the two",
            )
        if one.path[:2] == ("contact", "roughness") and _has_scans(plan.given):
            raise InputError(f"fit.free.{one.name}", "free", "a number other than roughness, which is measured by scans")
    resistance = "contact_resistance" in plan.data.quantities
    has = plan.resistance is not None or any(one.path == RESISTANCE for one in plan.free)
    if resistance and not has:
        raise InputError(
            ".".join(RESISTANCE), None, "a number with its unit, or a free number, because resistance was measured"
        )
    if not resistance and has:
        raise InputError(
            ".".join(RESISTANCE), InWords("given"), "no value, because the data have no contact_resistance; delete it"
        )
    count = sum(len(plan.data.samples) if one.each_sample else 1 for one in plan.free)
    if len(plan.data) < count:
        raise InputError("--data", InWords(f"{len(plan.data)} values"), f"at least {count}, one for each free parameter")
    if len(plan.data) == count and not np.isfinite(plan.data.error).all():
        allowed = f"at least {count + 1}, one more than there are free parameters, or a column of their errors"
        raise InputError("--data", InWords(f"{count} values without errors"), allowed)


def _has_scans(given: Mapping) -> bool:
    rough = roughness_in(given)
    return isinstance(rough, Mapping) and bool(rough.keys() & {"first", "second"})
