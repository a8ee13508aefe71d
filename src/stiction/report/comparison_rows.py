"""A comparison as rows of tables, and as one JSON object."""

import json
import shlex
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from stiction.laws.validity import read_doubts
from stiction.quantities.units import show
from stiction.studies.comparison.compare import RESULTS

if TYPE_CHECKING:
    import xarray


_DIGITS = 6  # of a load that is read: its result differs in the sixth


def run_command(data: "xarray.Dataset", model: str, exact: bool = False) -> str:
    """The command line that computes one row of a comparison again; exact: to the last digit."""
    case = data.attrs.get("case_file", "CASE.toml")
    load = _load_in_words(data, exact)
    return f"stiction run {shlex.quote(case)} --model {shlex.quote(model)}" + (f" --load {shlex.quote(load)}" if load else "")


def _load_in_words(data: "xarray.Dataset", exact: bool) -> str:
    """The working load as --load takes it."""
    if "working_load" not in data.attrs:
        return ""
    unit, load = data["load"].attrs.get("units", "1"), float(data.attrs["working_load"])
    if unit == "1":
        return f"{load!r}" if exact else f"{load:.{_DIGITS}g}"
    return f"{load!r} {unit}" if exact else show(load, "load", _DIGITS).replace("µ", "u")  # which every keyboard has


def comparison(data: "xarray.Dataset") -> dict[str, Any]:
    """A comparison as one JSON object: attributes, and a list of models with what each says."""
    units = {name: data[name].attrs.get("units", "1") for name in RESULTS}
    rows = []
    for at, name in enumerate(data["model"].values):
        one = data.isel(model=at)
        row = {
            "model": str(name),
            "grade": str(one["grade"].item()),
            "status": str(one["status"].item()),
            "outside_validity": [doubt.short for doubt in read_doubts(one["doubts"].item())],
            "doubts": json.loads(one["doubts"].item()),
            "measured_error": json.loads(one["measured_error"].item()),
            "measured_film_error": json.loads(one["measured_film_error"].item()),
            "why_not": one["why_not"].item() or None,
            "family": one["family_of_curve"].item() or None,
            "plastic_junctions_resist": one["plastic_junctions_resist"].item() or None,
            "command": run_command(data, str(name), exact=True),
        }
        row |= {key: one[f"{key}_at_load"].item() for key in RESULTS if f"{key}_at_load" in data}
        row |= _over_methods(one)
        rows.append(row | {"curve": {key: one[key].values for key in RESULTS}})
    left_out = dict(line.split(": ", 1) for line in data.attrs["left_out"].splitlines())
    attributes = {name: value for name, value in data.attrs.items() if name not in ("left_out", "sources", "criteria")}
    attributes["criteria"] = data.attrs["criteria"].splitlines()
    return attributes | {"units": units, "models": rows, "left_out": left_out, "sources": data.attrs["sources"].split()}


def _over_methods(one: "xarray.Dataset") -> dict[str, Any]:
    """What one model says of every way to find asperities in a measured surface, at the working load."""
    name = "friction_coefficient_at_load"
    if f"{name}_by_method" not in one:
        return {}
    each = one[f"{name}_by_method"]
    return {
        "friction_coefficient_by_method": dict(zip(each["asperity_method"].values.tolist(), each.values.tolist(), strict=True)),
        "friction_coefficient_low": one[f"{name}_low"].item(),
        "friction_coefficient_high": one[f"{name}_high"].item(),
    }


def comparison_rows(data: "xarray.Dataset") -> tuple[list[str], Iterator[list[Any]]]:
    """Heads and rows of a table: every point of every model."""
    heads = [_head(data, name) for name in RESULTS]
    columns = [data[name].values for name in RESULTS]
    points = range(data.sizes["point"])
    names = data["model"].values
    rows = ([str(name), *(float(column[at, point]) for column in columns)] for at, name in enumerate(names) for point in points)
    return ["model", *heads], rows


def _head(data: "xarray.Dataset", name: str) -> str:
    unit = data[name].attrs.get("units", "1")
    return name if unit == "1" else f"{name} [{unit}]"


def at_load_rows(data: "xarray.Dataset") -> tuple[list[str], Iterator[list[Any]]]:
    """Heads and rows of a table: what every model says at the working load; of a measured surface also the lowest and the
    highest friction coefficient over the methods of finding asperities."""
    names = [f"{name}_at_load" for name in ("friction_coefficient", *RESULTS[:-1])]
    names[1:1] = [f"{names[0]}_{end}" for end in ("low", "high") if f"{names[0]}_{end}" in data]
    heads = [_head(data, name).replace("_at_load", "") for name in names]
    names += ["measured_area_error", "measured_area_error_rms", "measured_friction_error"]
    heads += names[-3:]
    texts = ("plastic_junctions_resist", "status", "outside_validity", "why_not")
    rows = (
        [str(one[name].item()) for name in ("model", "grade")]
        + [one[name].item() for name in names]
        + [str(one[name].item()) for name in texts]
        for one in (data.isel(model=at) for at in range(data.sizes["model"]))
    )
    return ["model", "grade", *heads, *texts], rows
