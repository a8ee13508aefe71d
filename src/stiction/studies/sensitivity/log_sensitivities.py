"""Compute logarithmic sensitivities d ln y/d ln x of results y to each number x > 0 of a contact.

Sensitivities of a model are central differences in ln x with two widths, extrapolated to width 0 (Richardson 1911). The error
is of fourth order in the width; its bound is the change of the derivative by the extrapolation. Sensitivities of a prediction
are a single difference, from ln x - 0.05 to ln x + 0.05, without error bound.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from stiction.case.distribution import Distribution
from stiction.case.read import Case
from stiction.case.swept import Address
from stiction.case.uncertain import SAMPLE, Uncertain, named
from stiction.contact.contact import Contact
from stiction.contact.subject import Subject
from stiction.quantities.inputs import Input
from stiction.quantities.table import QUANTITIES
from stiction.solving.choice import Choice
from stiction.studies.prediction.many import predict_many
from stiction.studies.uncertainty.drawing import OUTPUTS, Variant, draw
from stiction.surfaces.roughness import Roughness

# Half the width of the wider difference, in ln x.
_WIDTH = 0.02
_STENCIL = np.array([-1.0, -0.5, 0.5, 1.0]) * _WIDTH
# Steps for a prediction. Smaller steps would mainly show the scatter of its few hundred samples; larger ones miss how steep mu
# is where the interface is nearly as strong as the body.
_WIDE = np.array([-0.05, 0.05])
# Numbers without effect on a contact, which uses its work of adhesion instead.
_LEFT_OUT = ("surface_energy",)


@dataclass(frozen=True)
class LogSensitivities:
    """Hold logarithmic sensitivities d ln y/d ln x of results y to k inputs x.

    names: names of the inputs, k texts. An input is one number, or several that are changed by the same factor. tables:
    sensitivities (k, *shape) of each result by its name, where `shape` is the shape of the result; NaN unless y > 0. errors:
    their error bounds, in the same form. dims: names of the dimensions in `shape`, by name of the result.
    """

    names: list[str]
    tables: dict[str, np.ndarray]
    errors: dict[str, np.ndarray]
    dims: dict[str, tuple[str, ...]]


@dataclass(frozen=True)
class _Steps:
    """Replace the distribution of an uncertain number: `ppf` returns the nominal value times exp(step).

    The code that samples uncertain numbers then changes the number by steps of its logarithm.
    """

    nominal: float
    words: str = ""

    def ppf(self, step: Any) -> np.ndarray:
        return self.nominal * np.exp(np.asarray(step))


def numbers_of(case: Case) -> dict[str, list[Uncertain]]:
    """Return the numbers of a contact (from `_numbers`) as uncertain numbers; each sample is a step of ln x.

    The result has a list of numbers for each input, by name of the input. Numbers that are sampled together in the case form
    one input and are changed by the same factor. Array parameters, surface energies, and roughness parameters measured from
    scans are left out.
    """
    together = {one.path: one for one in case.uncertain}
    found = []
    for path, value in _numbers(case.subject, (*case.tables,)):
        if path in case.swept or path[-1] in _LEFT_OUT or (path[1] == "roughness" and case.measured is not None):
            continue
        alone = Distribution(path[-1], value, "values", (value,), "")
        one = together[path] if path in together else Uncertain.of(path, alone, ".".join(path[1:]))
        found.append(replace(one, values=np.array([value]), distribution=_Steps(value)))
    by_name: dict[str, list[Uncertain]] = {}
    for one in named(found):
        by_name.setdefault(one.dimension, []).append(one)
    return by_name


def _numbers(record: Input, path: Address) -> Iterator[tuple[Address, float]]:
    """Yield the address (tuple of keys) and the value of each quantity above 0 in a record and its nested records.

    A quantity is a float in a field whose name is in QUANTITIES. Fields of a contact or of indices that the user did not state
    are left out, and so are the records `surface` and `interface`. For bodies with a finish, the heights of the finish replace
    sigma, R and N, which follow from them. path: address of the record, with which all addresses begin.
    """
    given = record.model_fields_set if isinstance(record, Subject) else type(record).model_fields  # groups may have a default
    for name in [name for name in type(record).model_fields if name in given]:
        value = getattr(record, name)
        if isinstance(value, Roughness) and value.unknowns:
            for place, body in _bodies_with_finish(value):
                yield from _numbers(body, (*path, name, *place))
        elif isinstance(value, Input) and name not in ("surface", "interface"):
            yield from _numbers(value, (*path, name))
        elif name in QUANTITIES and isinstance(value, float) and value > 0.0:
            yield (*path, name), value


def _bodies_with_finish(roughness: Roughness) -> Iterator[tuple[Address, Any]]:
    """Yield the address below `contact.roughness`, and the description, of each body of a roughness made from a finish."""
    bodies = {name: body for name in ("first", "second") if (body := roughness.part(name)) is not None}
    for name, body in bodies.items():
        yield (() if [*bodies] == ["first"] else (name,)), body


def log_sensitivities(case: Case, choice: Choice, names: Sequence[str] = OUTPUTS, progress: Any = iter) -> LogSensitivities:
    """Return the logarithmic sensitivities of the results of a model to the inputs that `numbers_of` returns.

    choice: the model. names: names of the results. progress: receives the list of batches and returns an iterable over it. A
    sensitivity is NaN unless the result is above 0 at all steps. Raises InputError or ArithmeticError if the model refuses the
    nominal contact, which is not solved if one batch has all steps.
    """
    inputs, stepped, steps = _stepped_case(case, _STENCIL)
    found = draw(stepped, steps, [Variant(choice)], names=names, progress=progress)
    each = {name: _slopes(found.tables[name], len(inputs)) for name in found.tables}
    tables, errors = ({name: pair[at] for name, pair in each.items()} for at in (0, 1))
    return LogSensitivities(inputs, tables, errors, found.dims)


def log_sensitivities_of_prediction(case: Case, load: float) -> dict[str, float]:
    """Return d ln mu/d ln x for the median mu of a prediction at a load [N], by name of the number x.

    The derivative is the slope between ln x - 0.05 and ln x + 0.05, NaN if the prediction is refused at one of them. The
    numbers are those of `numbers_of` and, as interface.NAME, those of the interface state of the contact. Raises InputError or
    ArithmeticError if all predictions are refused.
    """
    from xarray import DataArray

    inputs, stepped, steps = _stepped_case(case, _WIDE)
    numbers, mu = stepped.numbers_at(steps), np.full(len(steps), np.nan)
    # A surface with a finish can be predicted only one by one: its heights are left out where they do not change.
    heights = [path for path in numbers if path[1] == "roughness" and case.subject.roughness.unknowns]  # type: ignore[attr-defined]
    alone = np.repeat([any(one.path in heights for one in group) for group in stepped.unknowns.values()], len(_WIDE))
    for rows, left_out in ((np.flatnonzero(~alone), heights), (np.flatnonzero(alone), [])):
        some = {path: DataArray(value).isel({SAMPLE: rows}) for path, value in numbers.items() if path not in left_out}
        for region, _, solved in predict_many(case, some, np.array([load])) if rows.size else ():
            if solved is not None:
                mu[rows[region[SAMPLE]]] = solved.variables["friction_coefficient"][1].ravel()
    low, high = np.log(mu.reshape(-1, 2)).T
    return _of_interface(case, load) | dict(zip(inputs, ((high - low) / np.ptp(_WIDE)).tolist(), strict=True))


def _of_interface(case: Case, load: float) -> dict[str, float]:
    """Return d ln mu/d ln x for the strength and the pressure coefficient of the interface state of a contact.

    load: in N. The names are interface.NAME; the result is {} without an interface state. A number and its 5 and 95 % quantiles
    are changed by the same factor. Numbers that are arrays, or uncertain in the case, are left out. The shear strength is still
    limited by the bodies.
    """
    contact = case.subject
    if not isinstance(contact, Contact) or contact.interface is None:
        return {}
    state, slopes = contact.interface, {}
    for name in (state.strength, "pressure_coefficient"):
        value, path = getattr(state, name), ("contact", "interface", name)
        if not isinstance(value, float) or any(number.path == path for number in case.uncertain):
            continue
        mu = []
        for times in np.exp(_WIDE).tolist():
            ends = {name: tuple(end * times for end in state.range[name])} if name in state.range else {}
            moved = state.replace(**{name: value * times, "range": state.range | ends})
            stepped = replace(case, subject=contact.replace(interface=moved))
            mu += [
                solved.variables["friction_coefficient"][1].item()
                for *_, solved in predict_many(stepped, {}, np.array([load]), stepped.uncertain)
                if solved
            ]
        slopes[f"interface.{name}"] = float(np.log(mu[1] / mu[0]) / np.ptp(_WIDE)) if len(mu) == 2 else math.nan
    return slopes


def _stepped_case(case: Case, stencil: np.ndarray) -> tuple[list[str], Case, np.ndarray]:
    """Return the names of k inputs, a case in which their numbers are uncertain, and the steps to take (k s, k).

    stencil (s,): steps of ln x. Each row of steps is for one contact: it changes one input and leaves the others unchanged.
    """
    inputs = numbers_of(case)
    steps = np.zeros((len(inputs), len(stencil), len(inputs)))
    for at in range(len(inputs)):
        steps[at, :, at] = stencil
    stepped = replace(case, uncertain=tuple(one for group in inputs.values() for one in group))
    assert list(stepped.unknowns) == list(inputs)
    return list(inputs), stepped, steps.reshape(-1, len(inputs))


def _slopes(table: np.ndarray, inputs: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the slopes d ln y/d ln x (inputs, *shape), extrapolated to step 0, and error bounds of the same shape.

    table: y at the four steps of every input, (4 inputs, *shape). The error bound is the change of the slope by the
    extrapolation. The slope is NaN unless y > 0 at all steps.
    """
    y = table.reshape(inputs, len(_STENCIL), *table.shape[1:])
    positive = np.asarray(np.all(y > 0.0, axis=1))
    logs = np.log(np.where(positive[:, None], y, 1.0))
    wide, narrow = (logs[:, 3] - logs[:, 0]) / (2.0 * _WIDTH), (logs[:, 2] - logs[:, 1]) / _WIDTH
    slope = np.where(positive, narrow + (narrow - wide) / 3.0, np.nan)
    return slope, np.where(positive, np.abs(slope - narrow), np.nan)
