"""Build the sections of a report as plain text and tables; the HTML template formats and escapes them."""

import json
import platform
import shlex
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

import numpy as np
from markupsafe import Markup

from stiction.contact.contact import Contact
from stiction.contact.materials import Material
from stiction.laws.validity import warnings_of
from stiction.quantities.ranges import range_in_words
from stiction.quantities.table import QUANTITIES
from stiction.records.claims import KINDS_OF_WARNING
from stiction.records.sources import keys_in
from stiction.records.validity_warning import ValidityWarning
from stiction.report.answer import PREDICTION_HEADS, answer_lines, grade_line, model_line, next_in_words
from stiction.report.card import card_of
from stiction.report.html_words import letters, on_page
from stiction.report.report_answer import headline, inputs_as_stated, plain_name, value_in_words, warnings_here
from stiction.report.swept_tables import swept_table
from stiction.report.table import Column, Table, numbers, with_signs
from stiction.report.tables import HEADS, curve_table, group_in_words, run_notes
from stiction.report.views.comparison import GROUP_HEADS, group_row, groups_of
from stiction.report.views.run import draws_in_words, in_draws, with_meaning
from stiction.solving.choice import RECOMMENDED
from stiction.studies.prediction.uncertainty_sources import main_sources, part_name
from stiction.studies.report_data import ReportData, source_of_finish, stated_in

if TYPE_CHECKING:
    from stiction.case.uncertain import Uncertain


_PARTS = {
    "first": "First body",
    "second": "Second body",
    "coating.material": "Material of the film",
    "coating": "Film",
    "roughness": "Roughness",
    "": "Contact",
}
_NOT_NUMBERS = {
    "bodies": "which bodies have a film",
    "height_distribution": "distribution of asperity heights",
    "interface.name": "interface",
}


_MOMENTS = "surface."  # prefix of the asperity numbers that follow from spectral moments
_COLUMNS = [*map(Column, ("quantity", "symbol")), *numbers("value"), *map(Column, ("known range", "source"))]


def groups_of_inputs(findings: ReportData) -> list[Table]:
    """Return the inputs of a case as tables, one for each part of the contact, with the range and the source of each input."""
    subject, places = findings.case.subject, stated_in(findings.text)
    table = "contact" if isinstance(subject, Contact) else "indices"
    known = {
        ".".join(candidate.path[1:]): with_signs(f"{candidate.distribution.words}: counted")
        for candidate in findings.case.uncertain
    }
    counted = findings.prediction is not None and "ranges" not in findings.case.uncertainty.model_fields_set
    grouped: dict[str, list[list[str]]] = {part: [] for part in _PARTS}
    for dotted, text in inputs_as_stated(findings).items():
        part = next((candidate for candidate in _PARTS if candidate and dotted.startswith(f"{candidate}.")), "")
        name = dotted.removeprefix(f"{part}.")
        if name == "name":
            continue
        material = _material(subject, part)
        path = (table, *dotted.split("."))
        source = _source_of_material(material, name, path, places) if material else _source(findings, dotted, path, places)
        meaning, symbol = _meaning(name)
        grouped[part].append([meaning, symbol, with_signs(text), known.get(dotted) or _range(material, name, counted), source])
    return [Table(_COLUMNS, rows, _title(subject, part), stacked=True) for part, rows in grouped.items() if rows]


def groups_of_groups(findings: ReportData) -> list[Table]:
    """Return the dimensionless groups of a contact as a list with one table; [] if the case itself states groups."""
    subject = findings.case.subject
    if not isinstance(subject, Contact):
        return []
    rows = [
        [QUANTITIES[name].meaning, QUANTITIES[name].symbol, group_in_words(value)]
        for name, value in subject.all_groups().items()
    ]
    columns = [Column("group"), Column("symbol"), *numbers("value")]
    return [Table(columns, rows, "Dimensionless groups computed from the inputs", stacked=True)]


def _meaning(name: str) -> tuple[str, str]:
    if name.startswith(_MOMENTS):
        meaning, symbol = _meaning(name.removeprefix(_MOMENTS))
        return f"{meaning}, from the spectral moments of the surface", symbol
    row = QUANTITIES.get(name.rpartition(".")[2])
    return (_NOT_NUMBERS.get(name, name.replace("_", " ")), "") if row is None else (row.meaning, row.symbol)


def _material(subject: Any, part: str) -> Material | None:
    for name in part.split(".") if part else ():
        subject = getattr(subject, name, None)
    return subject if isinstance(subject, Material) else None


def _range(material: Material | None, name: str, counted: bool) -> str:
    """State the known range of a property, and whether the interval of mu includes its effect (counted); "" without a range."""
    if material is None or name not in material.range:
        return ""
    known = range_in_words(*material.range[name], name)
    return letters(f"{known}, {'in' if counted else 'not in'} the interval of mu")


def _source_of_material(material: Material, name: str, path: tuple[str, ...], places: dict) -> str:
    """Return the text of the source of a material property, or "the case" if there is none.

    A source is marked "(stated in the case)" if the case states the property and its source. path: path of the property in the
    case file. places: values in the case file by path.
    """
    tables = (path[:-1], ("materials", material.name))
    in_case = any((*table, name) in places for table in tables)
    said_in_case = any((*table, "source") in places for table in tables)
    stated = material.source if isinstance(material.source, str) else (material.source or {}).get(name, "")
    if in_case and not said_in_case:
        return "the case"
    return f"{stated} (stated in the case)" if in_case and stated else stated or "the case"


def _source(findings: ReportData, dotted: str, path: tuple[str, ...], places: dict) -> str:
    if dotted.startswith("roughness.") and (measured := findings.case.measured) is not None:
        return f"measured in scans, by {'their moments' if dotted.startswith(f'roughness.{_MOMENTS}') else measured.method}"
    if dotted.startswith("interface.") and path[:2] in places:
        return "the case" if dotted == "interface.name" else "the stated interface"
    if path in places or not places:
        return "the case"
    return source_of_finish(findings.case.subject, dotted) or "default of stiction"


def _title(subject: Any, part: str) -> str:
    if not isinstance(subject, Contact):
        return "Dimensionless groups"
    material = _material(subject, part)
    return _PARTS[part] + (f": {plain_name(material.name)}" if material else "")


_RESULTS = ("friction_coefficient", "friction_force", "contact_area", "area_fraction", "nominal_pressure", "mean_separation",
            "touching_asperities", "pull_off_force")  # fmt: skip
_PACKAGES = ("numpy", "scipy", "numba", "xarray", "pydantic", "pint", "matplotlib")


def answer_table(findings: ReportData) -> Table:
    """Return the answer of a prediction as a table of headings and texts."""
    assert findings.prediction is not None  # the template calls this for a prediction only
    return Table([Column(""), Column("")], answer_lines(findings.prediction, terminal=False), "Basis of the answer")


def card(findings: ReportData) -> Markup:
    """Return the summary card as HTML; empty if there is no prediction.

    The result of a model that the user named is shown above the prediction.
    """
    if findings.recommended is None:
        return Markup("")
    named = "" if findings.prediction is not None else f"{headline(findings)} by {findings.data.attrs['model']}"
    answer = card_of(findings.recommended, named)._replace(next_step=next_in_words(findings.recommended, terminal=False))
    return Markup(answer.html(why=False))  # safe, because Card.html escapes its texts


def validity_line(findings: ReportData) -> str:
    """Return one line on the validity of the answer.

    For a prediction the line states what it was checked against. Otherwise it states the first validity warning.
    """
    if findings.prediction is not None:
        checked = findings.prediction.attrs["checked_against"]
        known = f"Checked against {checked}." if checked else "Not checked against any measurement."
        return f"{letters(known)} Not tested on a contact whose friction, roughness and interface were all measured."
    warnings = warnings_of(findings.data)
    if not warnings:
        return "The whole curve is within the range that the authors of the model claim."
    more = f", and in {len(warnings) - 1} more respects" if len(warnings) > 1 else ""
    return letters(f"Outside its range of validity: {warnings[0].in_brief}{more} (see Validity).")


def here_table(findings: ReportData) -> Table | None:
    """Return a table of the results at the working load, each with its validity warnings; None without a working load.

    Warnings on quantities that the table does not have are in the first row.
    """
    point = findings.working_results
    if point is None:
        return None
    names = [name for name in _RESULTS if name in point]
    every, rows = warnings_here(findings), []
    for row_number, name in enumerate(names):
        mine: Any = [
            letters(f"{KINDS_OF_WARNING[warning.kind].capitalize()}: {warning}")
            for warning in every
            if warning.quantity == name or (row_number == 0 and warning.quantity not in names)
        ]
        row = QUANTITIES[name]
        if row_number == 0 and not every:
            mine = "none: within the claimed ranges"
        rows.append([row.meaning, row.symbol, value_in_words(point[name], float(point[name]), 4), mine])
    caption = "Results to four digits; only the digits of the answer are significant"
    columns = [Column("quantity"), Column("symbol"), *numbers("value"), Column("validity warnings")]
    return Table(columns, rows, caption, stacked=True)


def model_lines(findings: ReportData) -> list[str]:
    """State the model that the user named, with its laws and grade; [] for a prediction."""
    used = findings.data.attrs
    if used.get("model", RECOMMENDED) == RECOMMENDED:
        return []
    return [f"Model {model_line(used)}.", f"Grade {grade_line(used)}."]


def curve_rows(findings: ReportData) -> Table:
    """Return a table of some points of the curve, or of some combinations of array parameters."""
    data = findings.data
    if findings.prediction is not None:
        curve = data if findings.curve is None else findings.curve
        return on_page(curve_table(curve, heads=PREDICTION_HEADS), "μ along the loads")
    if findings.case.is_swept:
        return on_page(swept_table(data), "Some of the combinations")
    return on_page(curve_table(data, heads=HEADS | {"touching_asperities": "touching asperities"}), "Some points of the curve")


def compared(findings: ReportData) -> Table | None:
    """Return a table with a row for every model at the working load; None without a comparison."""
    if findings.comparison is None:
        return None
    rows = [[letters(cell) for cell in group_row(group)] for group in groups_of(findings.comparison, every=True)]
    columns = [Column("model"), *numbers(*GROUP_HEADS[1:3]), Column(GROUP_HEADS[3])]
    return Table(columns, rows, "Every model at the working load; models within their range come first", stacked=True)


def comparison_lines(findings: ReportData) -> dict[str, Any]:
    """Return criteria and inapplicable models of a comparison as {"lines": [...], "not_applicable": [...]}; {} without one."""
    if findings.comparison is None:
        return {}
    used = findings.comparison.attrs
    return {
        "lines": [letters(f"{line}.") for line in used["criteria"].splitlines()],
        "not_applicable": letters(used["not_applicable"]).splitlines(),
    }


def uncertainty_lines(findings: ReportData) -> list[str]:
    """Return sentences on the uncertain inputs and their samples or, for a prediction, on its main sources of uncertainty."""
    used = findings.data.attrs
    if findings.prediction is not None:
        parts = ((part_name(name), share) for name, share in main_sources(used["shares"]))
        return [f"{name[0].upper()}{name[1:]}: {share:.0%} of the variance of ln μ." for name, share in parts]
    if "uncertain_inputs" not in used:
        return ["No input of the case is uncertain, so the effect of input errors on μ is unknown."]
    lines = [f"Uncertain: {_unknown(some)}." for some in findings.case.unknowns.values()]
    lines.append(
        "± is one standard deviation, a factor is exp of one standard deviation of the logarithm, and a range is uniform."
    )
    if "uncertainty" in used:
        lines.append(f"R{draws_in_words(used)[1:]} (Sobol's sequence, scrambled).")
    shares: dict[str, float] = json.loads(used.get("validity_warnings_of_points", "{}"))
    return lines + [f"I{in_draws(share, letters(with_meaning(text)))[1:]}." for text, share in shares.items()]


def _unknown(some: "list[Uncertain]") -> str:
    """Return one text on inputs that vary together: "meanings (addresses in the case): distribution"."""
    names = dict.fromkeys(QUANTITIES[uncertain.quantity].meaning for uncertain in some)
    places = ", ".join(uncertain.where for uncertain in some)
    return f"{' and '.join(names)} ({places}): {with_signs(some[0].distribution.words)}"


def validity_table(findings: ReportData) -> Table | None:
    """Return a table of all validity warnings of the curve; None without warnings."""
    warnings = warnings_of(findings.data)
    if not warnings:
        return None
    rows = [[letters(cell) for cell in _validity_row(warning)] for warning in warnings]
    heads = ["quantity", "value", "claimed range", "where", "reason and meaning"]
    return Table([*map(Column, heads)], rows, "Where the result is outside the ranges of its laws", stacked=True)


def _validity_row(warning: ValidityWarning) -> list[str]:
    if not warning.quantity:
        return ["the result", "", "", "", f"{warning.why} ({KINDS_OF_WARNING[warning.kind]})"]
    row = QUANTITIES[warning.quantity]
    unit = f" {row.unit}" if row.unit else ""
    ends = " to ".join(dict.fromkeys((f"{warning.least:.3g}", f"{warning.most:.3g}")))
    low, high = (f"{end:g}{unit}" if np.isfinite(end) else "" for end in (warning.low, warning.high))
    claimed = f"{low} to {high}" if low and high else f"{low} or more" if low else f"{high} or less"
    where = f"{warning.outside} of {warning.points} points" if warning.points > 1 else "the point"
    return [f"{row.meaning} ({row.symbol})", ends + unit, claimed, where, f"{warning.why} ({KINDS_OF_WARNING[warning.kind]})"]


def notes(findings: ReportData) -> list[str]:
    """Return the input warnings, followed by the warnings of a prediction, or by the `run_notes` of any other result."""
    warnings = [f"Input warning: {note}" for note in findings.input_warnings]
    if findings.data.attrs.get("model", RECOMMENDED) == RECOMMENDED:
        return [*warnings, *map(letters, findings.data.attrs.get("warnings", []))]
    return [*warnings, *(letters(f"{note.rstrip('.')}.") for note in run_notes(findings.data))]


def scan_parts(findings: ReportData) -> list[tuple[str, Any, Table, list[str]]]:
    """Return (title, facts, table of asperities by method, notes) for the scan of each body."""
    from stiction.report.views.surface import asperity_table, surface_notes, surface_summary

    parts = []
    for body, analysis in findings.analyses.items():
        table = on_page(asperity_table(analysis), f"Asperities of the {body} body by each method")
        parts.append(
            (
                f"{body.capitalize()} body",
                surface_summary(analysis).rows,
                table,
                [line for part in surface_notes(analysis) for _, line in part.rows],
            )
        )
    return parts


def versions() -> list[tuple[str, str]]:
    """Return name and version of each program that computed the report, then the operating system and processor."""
    rows = [("stiction", version("stiction")), ("Python", platform.python_version())]
    rows += [(name, version(name)) for name in _PACKAGES]
    return [*rows, ("system", f"{platform.system()} {platform.machine()}")]


def command(name: str, load: Any, ranges: bool | None) -> str:
    """Return the command line that makes a report again.

    name: name of the case file. load, ranges: options of the report, or None for the defaults.
    """
    words = ["stiction", "report", name, "--out", "report.html"]
    words += ["--load", str(load)] if load is not None else []
    words += [] if ranges is None else ["--ranges" if ranges else "--no-ranges"]
    return shlex.join(words)


def measured_table(findings: ReportData) -> Table | None:
    """Return a table of sigma, R and N of scanned bodies by every asperity method, with friction; None without scans."""
    if findings.case.measured is None:
        return None
    from stiction.report.views.surface import roughness_table

    table = roughness_table(findings.case.measured, findings.data)
    return on_page(table, "Combined roughness of both bodies by every method; the method used is bold")


def sources_of(findings: ReportData) -> tuple[list[str], list[str], list[str]]:
    """Return three lists of bibliography keys: of the answer, of the materials, and of the other models that were compared.

    Each list leaves out the keys of the lists before it.
    """
    measured = findings.case.measured
    own = dict.fromkeys(findings.data.attrs.get("sources", "").split())
    own |= dict.fromkeys([] if measured is None else measured.sources())
    texts = " ".join(str(row[-1]) for table in groups_of_inputs(findings) for row in table.rows)
    of_materials = [key for key in keys_in(texts) if key not in own]
    comparison = findings.comparison
    others = (
        [] if comparison is None else [key for key in comparison.attrs["sources"].split() if key not in (*own, *of_materials)]
    )
    return list(own), of_materials, others
