"""Build the view of a sensitivity study, which ranks the inputs by their importance at the working load."""

import json
from collections.abc import Iterator, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from rich.text import Text

from stiction.case.distribution import LOG_UNIFORM
from stiction.laws.validity import warnings_of
from stiction.report.answer import answer_record, headline, model_line
from stiction.report.files import record, write_csv
from stiction.report.swept_tables import of_point, points_dimension
from stiction.report.table import Column, Table, facts, numbers
from stiction.report.view import View, picture
from stiction.report.views.prediction import plain
from stiction.report.views.run import draws_in_words, in_draws
from stiction.solving.pointwise import REASONS
from stiction.studies.prediction.uncertainty_sources import part_name

if TYPE_CHECKING:
    import xarray


_LEAST = 5e-5  # a logarithmic sensitivity below this is shown as 0
_HEADS = {"friction_coefficient": "mu", "contact_area": "area", "load": "load", "pull_off_force": "pull-off"}


def results_of(data: "xarray.Dataset", end: str) -> list[str]:
    """Return the names of the results for which the variable `{result}_{end}` exists, friction first.

    end: e.g. "total_order". Results with NaN only are left out, except the first.
    """
    there = [name for name in _HEADS if f"{name}_{end}" in data]
    return there[:1] + [name for name in there[1:] if np.isfinite(data[f"{name}_{end}"].values).any()]


def head_of(name: str) -> str:
    return _HEADS[name]


def working_place(data: "xarray.Dataset") -> int:
    """Return the index of the load nearest to the working load; the middle index if the study has no working load."""
    dim = points_dimension(data)
    count = data.sizes[dim] if dim else 1
    if "working_load" not in data.attrs or dim != "load":
        return (count - 1) // 2
    return int(np.argmin(np.abs(data["load"].values - data.attrs["working_load"])))


def at_working_load(data: "xarray.Dataset") -> "xarray.Dataset":
    """Return the results of a sensitivity study at the working load only."""
    dim = points_dimension(data)
    return data.isel({dim: working_place(data)}) if dim else data


def ranked(results: "xarray.Dataset", name: str, end: str, dim: str) -> np.ndarray:
    """Return the indices along `dim` that sort the variable `{name}_{end}` by descending absolute value, NaN last.

    results: sensitivity study at its working load.
    """
    size = np.abs(results[f"{name}_{end}"].values)
    return np.argsort(np.where(np.isfinite(size), -size, np.inf), kind="stable")


def indices_table(data: "xarray.Dataset") -> Table:
    """Return a table of Sobol indices and Morris effects of the first result, the most important input first.

    Each other result has a column with its total indices.
    """
    results, (first, *others) = at_working_load(data), results_of(data, "total_order")
    heads = [f"{_HEADS[first]}\ntotal", "\n95 %", "\nfirst", "\neffect", *(f"{_HEADS[name]}\ntotal" for name in others)]
    rows = []
    for place in ranked(results, first, "total_order", "input"):
        row = results.isel(input=int(place))
        low, high = (float(row[f"{first}_total_order_{end}"]) for end in ("low", "high"))
        cells = [_share(row, f"{first}_total_order"), f"{max(low, 0.0):.2f} to {high:.2f}" if np.isfinite(low) else "-"]
        cells += [_share(row, f"{first}_first_order"), _share(row, f"{first}_effect")]
        rows.append([part_name(str(row["input"].item())), *cells, *(_share(row, f"{name}_total_order") for name in others)])
    return Table([Column(f"{of_point(data, working_place(data))}\n"), *numbers(*heads)], rows, whole=True, ranked=True)


def _share(row: "xarray.Dataset", name: str) -> str:
    value = float(row[name])
    return f"{value:.2f}".replace("-0.00", "0.00") if np.isfinite(value) else "-"


def log_sensitivities_table(data: "xarray.Dataset") -> Table:
    """Return a table of the logarithmic sensitivities d ln y/d ln x at the working load, ranked by their effect on friction.

    y: results, such as mu. x: the inputs listed by `numbers_of`.
    """
    results, names = at_working_load(data), results_of(data, "log_sensitivity")
    digits = 2 if _SHARE in data else 3  # the sensitivities of a prediction scatter with its samples
    order: Any = ranked(results, names[0], "log_sensitivity", "number") if names else []
    rows = [
        [part_name(str(number)), *(_signed(float(results[f"{name}_log_sensitivity"][place]), digits) for name in names)]
        for place, number in zip(order, results["number"].values[order], strict=True)
    ]
    return Table(
        [Column("input raised by 1 %"), *numbers(*(f"{_HEADS[name]} changes by [%]" for name in names))], rows, ranked=True
    )


def _signed(value: float, digits: int) -> str:
    if not np.isfinite(value):
        return "-"
    return "0" if abs(value) < _LEAST else f"{value:+.{digits}g}"


def share_tables(data: "xarray.Dataset") -> Iterator[Table]:
    """Yield two tables: the fraction of the variance of ln mu that each source causes, and logarithmic sensitivities."""
    parts = zip(data["input"].values.tolist(), data["friction_coefficient_share"].values.tolist(), strict=True)
    rows = [(part_name(name), f"{share:.0%}") for name, share in parts]
    yield Table([Column("mu varies with"), *numbers("share")], rows, ranked=True)
    yield log_sensitivities_table(data)


def _uncertain_inputs(data: "xarray.Dataset") -> Iterator[Table]:
    """Yield a table with one row, the uncertain inputs and their ranges; nothing if no input of the case is uncertain."""
    inputs = [line.partition(": ") for line in data.attrs["uncertain_inputs"].splitlines()]
    if inputs:
        yield facts(
            [("uncertain", "; ".join(f"{part_name(name)} {words.removesuffix(LOG_UNIFORM)}" for name, _, words in inputs))]
        )


def _excluded(data: "xarray.Dataset") -> Iterator[Text]:
    """Yield the fraction of the samples without a result, and why they have none."""
    if share := data.attrs["impossible_draws"]:
        yield Text(f"excluded: {share:.0%} of the samples, pressure above hardness or area above nominal", style="bold yellow")
    for text, share in json.loads(data.attrs["validity_warnings_of_points"]).items():
        if text in REASONS:
            yield Text(f"excluded: {in_draws(share, text)}", style="bold yellow")


def sensitivity_notes(data: "xarray.Dataset") -> Iterator[Text | Table]:
    """Yield notes: which inputs were varied and how, and the validity warnings at nominal inputs."""
    used = data.attrs
    if "input" in data.dims:
        yield from _uncertain_inputs(data)
        if used["methods"]:
            yield Text(f"methods of finding asperities, equally likely: {', '.join(used['methods'].split())}", style="dim")
        models = ", ".join(f"{name} {weight:.0%}" for name, weight in json.loads(used["models"]).items())
        yield Text(f"models: {models}", style="dim")
        yield Text(draws_in_words(used), style="dim")
        yield Text(
            "total, first: share of the variance of the logarithm; effect: change of the logarithm over the range of the input",
            style="dim",
        )
    else:
        yield Text('no input is uncertain: state errors, e.g. "0.5 +/- 0.1 GPa", or use --ranges', style="bold")
    yield Text(f"logarithmic sensitivities: by {model_line(used)}, at nominal inputs", style="dim")
    for warning in warnings_of(data):
        yield Text(f"validity warning: {warning}", style="bold yellow")


_SHARE = "friction_coefficient_share"
# Table -> dimension of its rows.
_TABLES = {"sensitivity.csv": "input", "log_sensitivities.csv": "number"}


def sensitivity_view(data: "xarray.Dataset", groups: Mapping[str, float] | None = None) -> View:
    """Return the view (texts, tables, files and pictures) of a sensitivity study.

    groups: dimensionless groups of the contact by name, for JSON.
    """

    def parts() -> Iterator[Any]:
        if _SHARE in data:
            yield from (Text(f"{data.attrs['case']}: {headline(data)}".removeprefix(": "), style="bold"), *share_tables(data))
            yield from _uncertain_inputs(data)
            return
        if "input" in data.dims:
            yield from (*_excluded(data), indices_table(data), "")
        yield from (log_sensitivities_table(data), "", *sensitivity_notes(data))

    def as_record() -> dict[str, Any]:
        if _SHARE not in data:
            return record(data, groups or {})
        slopes = dict(
            zip(data["number"].values.tolist(), data["friction_coefficient_log_sensitivity"].values.tolist(), strict=True)
        )
        return {"answer": answer_record(data), "log_sensitivities": slopes}

    files = {
        name: partial(write_csv, data[[variable for variable in data.data_vars if dim in data[variable].dims]])
        for name, dim in _TABLES.items()
        if dim in data.dims
    }
    pictures = {"sensitivity.png": picture("inputs by their effect", "sensitivity_pictures.sensitivity_figure", data)}
    return View("sensitivity", plain(data), parts, as_record, files, pictures)
