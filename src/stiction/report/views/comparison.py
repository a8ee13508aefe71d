"""Build the view of a comparison of models, in which models that agree on mu share one row."""

import json
import math
import shlex
from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from rich.text import Text

from stiction.contact.contact import Contact
from stiction.laws.validity import read_warnings
from stiction.quantities.shown import show
from stiction.report.answer import answer_lines, answer_record, number
from stiction.report.files import write_csv, write_netcdf
from stiction.report.table import Column, Table, facts, notes, numbers
from stiction.report.view import MOST_LINES, Picture, View, lines_of
from stiction.studies.comparison.compare import FAMILIES, RESULTS
from stiction.studies.prediction.around import curve_of
from stiction.studies.prediction.unused import refusal_of

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

    from stiction.case.read import Case


_DIGITS = 6  # digits of the load in a command, enough for the same result to about six digits


def run_command(data: "xarray.Dataset", model: str, exact: bool = False) -> str:
    """Return the command line that solves the case of a comparison with one of its models, at the working load.

    data: result of `compare`. exact: whether to state the load with all its digits.
    """
    case = data.attrs.get("case_file", "CASE.toml")
    load = _load_in_words(data, exact)
    return f"stiction run {shlex.quote(case)} --model {shlex.quote(model)}" + (f" --load {shlex.quote(load)}" if load else "")


def _load_in_words(data: "xarray.Dataset", exact: bool) -> str:
    """Return the working load in a form that the option --load accepts; "" without a working load.

    exact: whether to state the load with all its digits.
    """
    if "working_load" not in data.attrs:
        return ""
    unit, load = data["load"].attrs.get("units", "1"), float(data.attrs["working_load"])
    if unit == "1":
        return f"{load!r}" if exact else f"{load:.{_DIGITS}g}"
    return f"{load!r} {unit}" if exact else show(load, "load", _DIGITS).replace("µ", "u")  # every keyboard has the letter u


# Key of a JSON row -> variable of the comparison; empty texts become null.
_TEXTS = {"why_not": "why_not", "family": "family_of_curve", "plastic_junctions_resist": "plastic_junctions_resist"}


def comparison(data: "xarray.Dataset") -> dict[str, Any]:
    """Return a comparison as a dict for JSON: attributes, and for each model its results at the working load and its curve.

    data: result of `compare`.
    """
    units = {name: data[name].attrs.get("units", "1") for name in RESULTS}
    rows = []
    for index, name in enumerate(data["model"].values):
        result = data.isel(model=index)
        row: dict[str, Any] = {"model": str(name)}
        row |= {key: str(result[key].item()) for key in ("grade", "status")}
        row["outside_validity"] = [warning.short for warning in read_warnings(result["validity_warnings"].item())]
        row |= {key: json.loads(result[key].item()) for key in ("validity_warnings", "measured_error", "measured_film_error")}
        row |= {key: result[column].item() or None for key, column in _TEXTS.items()}
        row["command"] = run_command(data, str(name), exact=True)
        row |= {key: result[f"{key}_at_load"].item() for key in RESULTS if f"{key}_at_load" in data}
        row |= _over_methods(result)
        rows.append(row | {"curve": {key: result[key].values for key in RESULTS}})
    left_out = dict(line.split(": ", 1) for line in data.attrs["not_applicable"].splitlines())
    attributes = {name: value for name, value in data.attrs.items() if name not in ("not_applicable", "sources", "criteria")}
    attributes["criteria"] = data.attrs["criteria"].splitlines()
    return attributes | {"units": units, "models": rows, "not_applicable": left_out, "sources": data.attrs["sources"].split()}


def _over_methods(result: "xarray.Dataset") -> dict[str, Any]:
    """Return the friction of one model at the working load by each asperity method, with its range, as entries for JSON.

    The dict is empty without a working load, or if fewer than two methods found asperities in a scan.
    """
    name = "friction_coefficient_at_load"
    if f"{name}_by_method" not in result:
        return {}
    each = result[f"{name}_by_method"]
    return {
        "friction_coefficient_by_method": dict(zip(each["asperity_method"].values.tolist(), each.values.tolist(), strict=True)),
        "friction_coefficient_low": result[f"{name}_low"].item(),
        "friction_coefficient_high": result[f"{name}_high"].item(),
    }


def at_working_load(data: "xarray.Dataset") -> "xarray.Dataset":
    """Return the results of all models at the working load, as a dataset over `model`.

    data: result of `compare`. If the roughness was measured in scans, the smallest and largest mu over all asperity methods are
    included.
    """
    mu, *others = (f"{name}_at_load" for name in ("friction_coefficient", *RESULTS[:-1]))
    names = [mu, *(f"{mu}_{end}" for end in ("low", "high") if f"{mu}_{end}" in data), *others]
    errors = ["measured_area_error", "measured_area_error_rms", "measured_friction_error"]
    texts = ["plastic_junctions_resist", "status", "outside_validity", "why_not"]
    table = data[["grade", *names, *errors, *texts]]
    return table.rename({name: name.replace("_at_load", "") for name in names})


_MU = "friction_coefficient_at_load"
_ALIKE = 1.1  # ratio of mu within which models agree
ALL = "--all lists every model"
_APART = 1.2  # ratio of mu from which a model and the prediction differ
GROUP_HEADS = ("model + others of equal mu", "mu", "area error", "in the model's range?")


@dataclass(frozen=True)
class Group:
    """Store one row of a comparison: models that agree on mu.

    family: basis of their friction. names: models, by ascending mu. low, high: range of mu. errors: mean error of the contact
    area on benchmark surfaces, of each model for which it is known. least, most: range of mu after correction for both ends of
    the 90 % interval of that error; equal to low and high if no error is known. status: status of the first model, a text that
    begins with "fits", "does not fit" or "cannot".
    """

    family: str
    names: list[str]
    low: float
    high: float
    errors: list[float]
    least: float
    most: float
    status: str

    @property
    def title(self) -> str:
        """Return the name of the first model and the number of the others, "hertz +2"."""
        return self.names[0] + (f" +{len(self.names) - 1}" if len(self.names) > 1 else "")

    @property
    def fits(self) -> bool:
        """Return whether the contact is within the ranges that the authors of the models claim."""
        return self.status.startswith("fits")

    @property
    def kind(self) -> tuple[str, bool, str]:
        """Return (family, possible, short status); models share a row if these and mu agree."""
        return self.family, self.possible, self.status.split(";")[0] if self.fits else ""

    @property
    def possible(self) -> bool:
        """Return whether the results of the models are physically possible for this contact."""
        return not self.status.startswith("cannot")


def groups_of(data: "xarray.Dataset", every: bool = False) -> list[Group]:
    """Return groups of models whose mu at the working load agrees within 10 %.

    Groups within their claimed range come first, then groups outside it, then groups of models that cannot be right for this
    contact. Within each of the three, groups are sorted by family and mu. Models without mu are left out. data: result of
    `compare`. every: whether each model is a group of its own.
    """
    models = [data.isel(model=index) for index in range(data.sizes["model"])]
    alone = [_group([model]) for model in models if np.isfinite(model[_MU].item())]
    alone.sort(key=lambda group: (not group.fits, not group.possible, group.family == FAMILIES[False], group.low))
    if every:
        return alone
    by_name = {str(model["model"].item()): model for model in models}
    agreeing: list[list[Group]] = []
    for group in alone:
        last = agreeing[-1][0] if agreeing else None
        alike = last is not None and last.kind == group.kind
        if last is not None and alike and group.high <= _ALIKE * max(last.low, 1e-300):
            agreeing[-1].append(group)
        else:
            agreeing.append([group])
    return [_group([by_name[group.names[0]] for group in some]) for some in agreeing]


def _group(models: "list[xarray.Dataset]") -> Group:
    mu, errors = ([float(model[name]) for model in models] for name in (_MU, "measured_area_error"))
    ends = [end for model, value in zip(models, mu, strict=True) for end in _ends(model, value)]
    names = [str(model["model"].item()) for model in models]
    known = [error for error in errors if math.isfinite(error)]
    family, status = (str(models[0][name].item()) for name in ("family_of_curve", "status"))
    return Group(family, names, mu[0], mu[-1], known, min(ends), max(ends), status)


def _ends(result: "xarray.Dataset", mu: float) -> list[float]:
    """Return mu after correction for each end of the 90 % interval of the model's area error on benchmark surfaces.

    The list has two values; both are mu itself if the interval is unknown.
    """
    errors = json.loads(result["measured_error"].item()) or {}
    ends = [errors.get(f"area_{end}") or [None] for end in ("high", "low")]
    return [mu if end[0] is None else mu / (1.0 + end[0]) for end in ends]


def group_row(group: Group) -> tuple[str, str, str, str]:
    """Return the table cells of a group, in the order of GROUP_HEADS."""
    mu = " to ".join(dict.fromkeys((number(group.low), number(group.high))))
    ends = dict.fromkeys(f"{end:+z.0%}" for end in (min(group.errors), max(group.errors))) if group.errors else ["-"]
    status = group.status.replace("does not fit", "no", 1)
    return group.title, mu, " to ".join(ends), f"yes{status[4:]}" if group.fits else status


def groups_table(groups: list[Group], room: int | None = None, silent: int = 0, more: str = ALL) -> Iterator[Table | Text]:
    """Yield a table of the groups that fit into `room` lines, then a line that counts the models left out.

    room: None for all groups; otherwise physically impossible groups are left out too. silent: number of models without
    friction because the interface is not stated. more: text on where every model is listed.
    """
    shown = groups
    if room is not None:  # a group takes at least one line, and so do the heads and the count
        shown = [group for group in groups if group.possible][: max(room - 2, 0)]

    def left_out() -> Text:
        text = left_out_in_words(groups, shown, silent)
        return Text("; ".join(filter(None, [text, more if text and room is not None else ""])), style="dim")

    while room is not None and shown and lines_of(_table(shown)) > room - max(1, lines_of(left_out())):
        shown = shown[:-1]
    if shown:
        yield _table(shown)
    if text := left_out():
        yield text


def _table(groups: list[Group]) -> Table:
    names, mu, error, status = GROUP_HEADS
    columns = [Column(names), *numbers(mu, error), Column(status, wrap=True)]
    return Table(columns, [group_row(group) for group in groups], whole=True)


def left_out_in_words(groups: list[Group], shown: list[Group], silent: int = 0) -> str:
    """State how many models a table leaves out, and why; "" if it leaves out none.

    groups: all groups. shown: the groups in the table. silent: number of models without friction, because no interface is
    stated.
    """
    counts = [
        (sum(len(group.names) for group in groups if group.possible and group not in shown), "more models not shown"),
        (sum(len(group.names) for group in groups if not group.possible and group not in shown), "cannot be right here"),
        (silent, "give an area but no friction: state the interface"),
    ]
    return "; ".join(f"{count} {text}" for count, text in counts if count)


def why_apart(groups: list[Group], prediction: "xarray.Dataset | None") -> str:
    """Explain why a prediction differs by over 20 % from most models within their range; "" if it does not.

    groups: groups of models. prediction: result of `predict` at the load of the groups, or None.
    """
    suited = [group for group in groups if group.kind[2] == "fits"]  # not those that leave out the interface
    if prediction is None or not suited:
        return ""
    mu, count = float(prediction["friction_coefficient"]), sum(len(group.names) for group in suited)
    near = sum(len(group.names) for group in suited if group.low <= _APART * mu and mu <= _APART * group.high)
    if not 2 * near < count:
        return ""
    added = [f"a factor of {number(factor)} for {cause}" for cause, factor in prediction.attrs["enlarged_by"].items()]
    lower = sum(len(group.names) for group in suited if mu > _APART * group.high)
    if added and 2 * lower > count:
        return f"mu = {number(mu)} includes {' and '.join(added)}; most models include these effects partly or not at all"
    return f"mu = {number(mu)} is a median over sampled inputs and corrected contact areas; each model uses nominal inputs"


def silent_models(case: "Case", data: "xarray.Dataset") -> int:
    """Return how many models give a contact area but no friction, because the case states no interface and no shear strength.

    data: result of `compare` for the case.
    """
    contact = case.subject
    if not isinstance(contact, Contact) or contact.interface is not None or contact.interfacial_shear_strength is not None:
        return 0
    return int((data[_MU].isnull() & data["contact_area_at_load"].notnull()).sum())


# Rows of the answer that, with mu, stand above the table of models.
_OF_ANSWER = ("friction force", "warning", "not used")


def comparison_view(
    case: "Case", data: "xarray.Dataset", prediction: "xarray.Dataset | None" = None, every: bool = False, more: str = ALL
) -> View:
    """Return the view (texts, tables, files and pictures) of a comparison of models, with the prediction above it.

    data: result of `compare` for the case. prediction: result of `predict`, or None. every: whether to show each model in a row
    of its own, with all notes. more: text on where every model is listed.
    """
    measured = case.measured
    groups = groups_of(data, every) if "working_load" in data.attrs else []

    def parts() -> Iterator[Any]:
        above: list[Any] = [Text(case.title, style="bold")] if case.title else []
        if prediction is not None:
            above.append(facts([row for row in answer_lines(prediction) if row[0] in _OF_ANSWER or row[0].startswith("mu")]))
        elif (refusal := refusal_of(case)) is not None:
            above.append(facts([("no prediction", str(refusal))]))
        if not groups:
            above.append(Text("no model gives friction for this contact at a load above 0"))
        yield from above
        below = [Text(apart)] if (apart := why_apart(groups, prediction)) else []
        room = None if every else MOST_LINES - sum(map(lines_of, [*above, *below]))
        yield from groups_table(groups, room, silent_models(case, data) if groups else 0, more)
        yield from below
        if every:
            yield from notes(data.attrs["criteria"].splitlines(), "")
            yield from notes(f"not applicable: {line}" for line in data.attrs["not_applicable"].splitlines())
            if measured is not None:
                from stiction.report.views.surface import roughness_notes, roughness_table

                yield from (roughness_table(measured), *roughness_notes(measured))

    def record() -> dict[str, Any]:
        answer = None if prediction is None else answer_record(prediction)
        return {"answer": answer} | comparison(data) | ({} if measured is None else {"measured": measured.record()})

    files: dict[str, Any] = {
        "compare.csv": partial(write_csv, data[list(RESULTS)].reset_coords(drop=True)),
        "compare.nc": partial(write_netcdf, data),
    }

    def draw() -> "Figure":
        from stiction.report.model_pictures import models_figure

        curve = None if prediction is None else curve_of(case, prediction)
        return models_figure(data, groups, prediction, case.title, curve)

    pictures = {}
    if "working_load" in data.attrs:
        files["compare_at_load.csv"] = partial(write_csv, at_working_load(data))
        description = "friction at the working load by groups of models that agree"
        pictures["compare.png"] = Picture(description, draw)
    return View("compare", None, parts, record, files, pictures, is_brief=True)
