"""Build tables and text for the terminal from results and model records."""

import json
import re
from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from rich.console import Group
from rich.text import Text

from stiction.contact.contact import Contact
from stiction.laws.validity import warnings_of
from stiction.quantities.sampling import spread_rows
from stiction.quantities.shown import show
from stiction.quantities.table import QUANTITIES
from stiction.records.registry import GRADES, AsperityLaw, FilmLaw, Record, RoughSurface, TangentialLaw, find
from stiction.report.answer import grade_line, model_line, model_record, number
from stiction.report.plain_formulas import as_text
from stiction.report.table import Table, facts, notes, numbers, prefix, short, shown, with_unit
from stiction.solving.accuracy.film_errors import in_words
from stiction.solving.unused import unused_of

if TYPE_CHECKING:
    import xarray

    from stiction.case.read import Case

_NOTED: tuple[type[Record], ...] = (RoughSurface, AsperityLaw, TangentialLaw, FilmLaw)
_ROWS = 12
_WIDE = 1e4  # ratio of the ends of a column above which each cell has a prefixed unit of its own
# Result -> head of its column.
HEADS = {
    "mean_separation": "separation",
    "load": "load",
    "contact_area": "contact area",
    "friction_force": "friction force",
    "friction_coefficient": "mu",
    "touching_asperities": "touching",
}


def curve_table(data: "xarray.Dataset", all_rows: bool = False, heads: Mapping[str, str] | None = None) -> Table:
    """Return a table of a result against load or separation, in prefixed units.

    all_rows: include all points; by default at most twelve, evenly spaced. heads: column head by name of the variable; by
    default HEADS.
    """
    heads = HEADS if heads is None else heads
    count = data["load"].size
    chosen = spread_rows(count, count if all_rows else _ROWS)
    names = [name for name in heads if name in data]
    columns = [_column(data[name], name, chosen) for name in names]
    units = any(unit for unit, _ in columns)
    texts = [
        f"{heads[name]}\n" + (f"[{unit}]" if unit else "") if units and "\n" not in heads[name] else heads[name]
        for name, (unit, _) in zip(names, columns, strict=True)
    ]
    return Table(numbers(*texts), list(zip(*(cells for _, cells in columns), strict=True)))


def rows_shown(data: "xarray.Dataset") -> str:
    """State how many points `curve_table` shows; "" if it shows all."""
    count = data["load"].size
    text = f"{_ROWS} of {count} points are shown; --all-rows shows all, and --out writes all to curve.csv"
    return text if count > _ROWS else ""


def _column(variable: "xarray.DataArray", name: str, chosen: np.ndarray) -> tuple[str, list[str]]:
    """Return the unit for the head of a column, and the texts of its cells.

    variable: the result. name: key of QUANTITIES. chosen: indices of the rows to show. The unit is "" if there is none, or if
    values other than separations span more than four decades: then each cell has a unit of its own.
    """
    values = np.broadcast_to(variable.values, max(variable.size, chosen.max() + 1))[chosen]
    if values.dtype.kind in "OU":
        return "", [value or "-" for value in values.tolist()]
    unit = variable.attrs.get("units", "1")
    sizes = np.abs(values[np.isfinite(values) & (values != 0.0)])
    if unit != "1" and sizes.size and name != "mean_separation" and sizes.max() > _WIDE * sizes.min():
        return "", [shown(value, name) for value in values]
    factor, unit = (1.0, "") if unit == "1" else prefix(name, float(np.median(sizes)) if sizes.size else 1.0)
    return unit, [short(value * factor) for value in values]


def run_summary(case: "Case", data: "xarray.Dataset") -> Table:
    """Return a table that describes a solved case: contact, dimensionless groups, model, grade and pull-off force."""
    return facts(
        [
            ("case", case.title),
            *_contact(case.subject),
            ("groups", _groups(case.subject)),
            ("model", model_line(data.attrs)),
            ("grade", grade_line(data.attrs)),
            ("pull-off force", _pull_off(data)),
        ]
    )


def _contact(subject: Any) -> list[tuple[str, str]]:
    """Describe a contact in pairs (heading, text); [] for a case of dimensionless groups."""
    if not isinstance(subject, Contact):
        return []
    rows = [("bodies", f"{_material(subject.first)} against {_material(subject.second)}")]
    if subject.coating is not None:
        coating = subject.coating
        rows.append(("film", f"{_material(coating.material)}, {_numbers(coating)}, on {coating.bodies}"))
    if subject.liquid is not None:
        rows.append(("liquid", _numbers(subject.liquid)))
    return [*rows, ("roughness", _numbers(subject.roughness)), ("contact", _numbers(subject))]


def _material(material: Any) -> str:
    return f"{material.name} ({_numbers(material)})"


def _numbers(part: Any) -> str:
    """List the numbers of a part of a contact, such as a body, with symbols and units: "E = 210 GPa, nu = 0.3"."""
    stated = ((QUANTITIES[name], getattr(part, name)) for name in type(part).model_fields if name in QUANTITIES)
    return ", ".join(f"{row.symbol} = {_number(value, row.name)}" for row, value in stated if value is not None)


def _number(value: Any, name: str) -> str:
    """Format a number of the contact with its unit or, if it is an array, its ends: "100 nm to 2 um (5 values)".

    name: key of QUANTITIES.
    """
    ends = (value.min(), value.max()) if hasattr(value, "dims") else (value,)
    text = " to ".join(show(float(end), name).replace("m^2", "m²") for end in ends)
    return f"{text} ({value.size} values)" if hasattr(value, "dims") else text


def in_brief(case: "Case", data: "xarray.Dataset") -> Iterator[Any]:
    """Yield a short answer: title, mu at the middle load with its interval, model, and the first validity warning.

    data: result of `solve` for the case.
    """
    if case.title:
        yield Text(case.title, style="bold")
    warnings = [str(warning) for warning in warnings_of(data)]
    more = f"; and {len(warnings) - 1} more" if len(warnings) > 1 else ""
    rows = [("model", f"{model_line(data.attrs)}; grade {data.attrs['grade']}")]
    if not case.is_swept:
        answer = model_record(data)
        mu, ends = answer["friction_coefficient"], answer["interval"]
        band = (
            _without_band(data) if ends is None else f", {answer['level']:.0%} interval {number(ends[0])} to {number(ends[1])}"
        )
        if mu is None:
            text = "not computed: state the strength of the interface"
        else:
            at = f" at {case.subject.show(answer['load'], 'load', 3)}" if data["load"].size > 1 else ""
            text = f"{number(mu)}{at}{band}" if np.isfinite(mu) else f"not defined{at or ' at this load'}"
        rows.insert(0, ("mu", text))
    unused = data.attrs.get("inputs_not_used", "")
    yield facts([*rows, ("not used", unused), ("outside", f"{warnings[0]}{more}" if warnings else "")])


def _without_band(data: "xarray.Dataset") -> str:
    """State why mu has no interval; "" if no number of the case is uncertain."""
    quantiles = data.get("friction_coefficient_quantile")
    if quantiles is None:
        return ""
    known = np.isfinite(quantiles.values).any()
    return (
        "; no interval: the uncertain inputs do not change mu"
        if known
        else "; no interval: no sample of the uncertain inputs gives a result"
    )


# Groups of the materials only, which are not listed next to the materials themselves.
_OF_MATERIALS = (
    "nu", "hardness_to_yield", "K_beta", "film_nu", "film_K_beta", "layer_n_H", "layer_nu", "coated_nu", "counter_nu",
)  # fmt: skip


def _groups(subject: Any) -> str:
    """List the dimensionless groups with names or formulas: "elastic adhesion index = 40, N R sigma = 0.04"."""
    groups = (
        group for group in subject.all_groups().items() if not (isinstance(subject, Contact) and group[0] in _OF_MATERIALS)
    )
    return ", ".join(f"{_group(name)} = {group_in_words(value)}" for name, value in groups)


def _group(name: str) -> str:
    symbol = QUANTITIES[name].symbol
    return symbol if "/" in symbol or "sigma" in symbol else QUANTITIES[name].short or symbol


def group_in_words(value: Any) -> str:
    """Format a dimensionless group; an array is shown by its smallest and largest value."""
    ends = (value.min(), value.max()) if hasattr(value, "dims") else (value,)
    return " to ".join(dict.fromkeys(f"{float(end):.4g}" for end in ends))


def _pull_off(data: "xarray.Dataset") -> str:
    if "pull_off_force" not in data:
        return ""
    force = data["pull_off_force"]
    if force.size > 1:
        return f"{with_unit(force.min())} to {with_unit(force.max())}" if bool((force > 0.0).any()) else _NO_TENSION
    if not float(force) > 0.0:
        return _NO_TENSION
    if force.attrs.get("units", "1") == "1":
        return f"{float(force):.4g} at h = {float(data['pull_off_separation']):.4g}"
    return with_unit(force)


_NO_TENSION = "none: the load is compressive at every separation"


def run_notes(data: "xarray.Dataset") -> list[str]:
    """Return notes on a result, one line each, for example how it is normalised and where mu is not defined."""
    used = data.attrs
    notes = []
    normalised = [name for name in ("load", "contact_area") if "normalised_by" in data[name].attrs]
    if normalised:
        parts = [f"{HEADS[name]} over {data[name].attrs['normalised_by']}" for name in normalised]
        notes.append(
            f"normalised: {', '.join(parts)}, separation over sigma, touching asperities as a fraction of all asperities"
        )
    if "friction_coefficient" not in data:
        notes.append(f"friction: {used['friction_law']}")
    elif bool((data["load"] <= 0.0).any()):
        notes.append("mu is not defined (shown as -) at loads that are not compressive")
    if used.get("area_by"):
        notes.append(f"contact area: {used['area_by']}")
    if used.get("change_by_junctions"):
        notes.append(used["change_by_junctions"])
    if used.get("measured_error_in_words"):
        notes.append(f"measured error: {used['measured_error_in_words']}")
    notes += [unused.say("--") for unused in unused_of(data)]
    notes += _measured(json.loads(used.get("measured_film_error", "[]")))
    notes += [used["remarks"]] if used.get("remarks") else []
    for kind in _NOTED:
        key = used[kind.keyword]
        if key != "none" and (text := find(key, kind).notes):
            notes.append(f"{key}: {text}" if kind is RoughSurface else f"{key} ({kind.kind}): {text}")
    return notes


def _measured(rows: list[dict[str, Any]]) -> list[str]:
    """State the benchmark errors of the film law near this result, or why no error is known."""
    return [f"measured: {in_words(row)}" for row in [row for row in rows if "error" in row] or rows[:1]]


def outside_validity(data: "xarray.Dataset") -> Iterator[Any]:
    """Yield a heading and the validity warnings of a result, highlighted; nothing without warnings."""
    if warnings := warnings_of(data):
        yield Text("outside the range of validity", style="bold yellow")
        yield from notes(map(str, warnings), "yellow")


def models_list(rows: Iterable[Mapping[str, Any]]) -> Iterator[Text]:
    """Yield one line for each model or law, below a heading for each kind: key, grade and title, cut to the terminal width.

    rows: records of models as dicts, sorted by kind.
    """
    kind = ""
    for row in rows:
        if kind != row["kind"]:
            kind = row["kind"]
            yield Text(kind, style="bold cyan")
        key = (f"  {row['key']:32}", "bold")
        yield Text.assemble(key, f" {row['grade']}  {row['title']}", no_wrap=True, overflow="ellipsis")


# Line ends inside a paragraph of Markdown are removed, because the terminal breaks lines itself.
_LINE_ENDS = re.compile(r"^([^\s|].*)\n(?=[^\s|-])", re.MULTILINE)
# Entries of a record that are shown in full, with their headings.
_IN_FULL = {
    "source": "source", "verified": "checked against", "jumps": "jumps", "departures": "in the limit",
    "traits": "marked", "validity": "valid for", "limits": "becomes", "needs": "depends on", "notes": "note",
}  # fmt: skip


def model_in_full(row: Mapping[str, Any]) -> Group:
    """Describe one model or law completely, with its assumptions and equations.

    row: its record as a dict.
    """
    pairs = [(row["key"], f"{row['title']} ({row['kind']}, grade {row['grade']})")]
    for name, head in _IN_FULL.items():
        value = row.get(name) or []
        lines = [value] if isinstance(value, str) else [", ".join(value)] if name in ("needs", "traits") else value
        pairs += [(head if number == 0 else "", line) for number, line in enumerate(lines)]
    pairs += [("only with", f"asperity laws marked {trait}: {why}") for trait, why in row.get("required_traits", {}).items()]
    means = row.get("options_mean", {})
    for name, values in row["options"].items():
        pairs.append(("option", f"{name}: {', '.join(values)}" + (f" ({means[name]})" if name in means else "")))
    return Group(facts(pairs), Text("\n" + _LINE_ENDS.sub(r"\1 ", as_text(row["text"]))))


def grades() -> Table:
    """Return a table of the grades and their meanings."""
    return facts((f"grade {grade}", meaning) for grade, meaning in GRADES.items())
