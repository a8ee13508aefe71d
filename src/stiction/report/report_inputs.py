"""The inputs of a case for a report: name, value with its unit, how well it is known, and where it comes from."""

from typing import Any

from stiction.contact.contact import Contact
from stiction.contact.materials import Material
from stiction.quantities.ranges import range_in_words
from stiction.quantities.table import QUANTITIES
from stiction.report.table import Column, Table, numbers
from stiction.report.tables import group_in_words
from stiction.studies.findings import Findings, places_in

_PARTS = {
    "first": "First body",
    "second": "Second body",
    "coating.material": "Material of the film",
    "coating": "Film",
    "roughness": "Roughness",
    "": "Contact",
}
_NOT_NUMBERS = {
    "bodies": "which body carries the film",
    "height_distribution": "distribution of asperity heights",
    "interface.name": "state of the interface",
}


_MOMENTS = "surface."  # of a roughness: the asperities that theories of the whole surface take
_COLUMNS = [*map(Column, ("quantity", "symbol")), *numbers("value"), *map(Column, ("how well it is known", "source"))]


def plain_name(name: str) -> str:
    """The name of a material as it is read: hardened steel 52100."""
    return name.replace("_", " ")


def with_powers(text: str) -> str:
    """m² in place of m^2."""
    return text.replace("m^2", "m²").replace("m^3", "m³")


def groups_of_inputs(findings: Findings) -> list[Table]:
    """The inputs of a case, part by part, in the order in which a reader asks for them."""
    subject, places = findings.case.subject, places_in(findings.text)
    table = "contact" if isinstance(subject, Contact) else "indices"
    known = {".".join(one.path[1:]): with_powers(f"{one.distribution.words}: counted") for one in findings.case.uncertain}
    counted = findings.prediction is not None and "ranges" not in findings.case.uncertainty.model_fields_set
    grouped: dict[str, list[list[str]]] = {part: [] for part in _PARTS}
    for dotted, text in subject.listed():
        part = next((one for one in _PARTS if one and dotted.startswith(f"{one}.")), "")
        name = dotted.removeprefix(f"{part}.")
        if name == "name":
            continue
        material = _material(subject, part)
        here = (table, *dotted.split("."))
        source = _source_of_material(material, name, here, places) if material else _source(findings, dotted, here, places)
        meaning, symbol = _meaning(name)
        grouped[part].append([meaning, symbol, with_powers(text), known.get(dotted) or _range(material, name, counted), source])
    return [Table(_COLUMNS, rows, _title(subject, part), stacked=True) for part, rows in grouped.items() if rows]


def groups_of_groups(findings: Findings) -> list[Table]:
    """The dimensionless groups that follow from the bodies; none where they are what was given."""
    subject = findings.case.subject
    if not isinstance(subject, Contact):
        return []
    rows = [
        [QUANTITIES[name].meaning, QUANTITIES[name].symbol, group_in_words(one)] for name, one in subject.all_groups().items()
    ]
    columns = [Column("group"), Column("symbol"), *numbers("value")]
    return [Table(columns, rows, "Dimensionless groups that follow", stacked=True)]


def _meaning(name: str) -> tuple[str, str]:
    if name.startswith(_MOMENTS):
        meaning, symbol = _meaning(name.removeprefix(_MOMENTS))
        return f"{meaning}, by the moments of the surface", symbol
    row = QUANTITIES.get(name.rpartition(".")[2])
    return (_NOT_NUMBERS.get(name, name.replace("_", " ")), "") if row is None else (row.meaning, row.symbol)


def _material(subject: Any, part: str) -> Material | None:
    for name in part.split(".") if part else ():
        subject = getattr(subject, name, None)
    return subject if isinstance(subject, Material) else None


def _range(material: Material | None, name: str, counted: bool) -> str:
    """What tables and makes give of a number, and whether the answer counts it."""
    if material is None or name not in material.range:
        return ""
    return with_powers(f"known to be {range_in_words(*material.range[name], name)}: {'counted' if counted else 'not counted'}")


def _source_of_material(material: Material, name: str, here: tuple[str, ...], places: frozenset) -> str:
    """Where a number of a material comes from: what its preset says, unless the case has another number in its place."""
    tables = (here[:-1], ("materials", material.name))
    in_case = any((*table, name) in places for table in tables)
    said_in_case = any((*table, "source") in places for table in tables)
    stated = material.source if isinstance(material.source, str) else (material.source or {}).get(name, "")
    if in_case and not said_in_case:
        return "the case"
    return f"{stated} (as the case says)" if in_case and stated else stated or "the case"


def _source(findings: Findings, dotted: str, here: tuple[str, ...], places: frozenset) -> str:
    measured = findings.case.measured
    if dotted.startswith("roughness.") and measured is not None:
        by = "their moments" if dotted.startswith(f"roughness.{_MOMENTS}") else measured.method
        return f"measured in scans, by {by}"
    if dotted.startswith("interface.") and here[:2] in places:
        return "the case" if dotted == "interface.name" else "the state of the interface (stiction interfaces)"
    return "the case" if here in places or not places else "what holds where a case says nothing"


def _title(subject: Any, part: str) -> str:
    if not isinstance(subject, Contact):
        return "Dimensionless groups"
    material = _material(subject, part)
    return _PARTS[part] + (f": {plain_name(material.name)}" if material else "")
