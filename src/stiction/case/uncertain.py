"""Numbers of a case file that are uncertain: an error, ends, a factor, or values from a file, in place of the number."""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BeforeValidator, Field

from stiction.case.distribution import (
    Distribution,
    between,
    in_range,
    is_law,
    normal,
    of_law,
    of_samples,
    within_factor,
)
from stiction.case.places import BODIES, entry_at
from stiction.case.several import Address, Along, Point, Several, number_of, numbers_in, read_ends, with_error
from stiction.contact.materials import Material, as_material
from stiction.quantities.errors import InputError, InWords, field_below, field_named
from stiction.quantities.inputs import Input
from stiction.quantities.paths import read_text
from stiction.quantities.table import QUANTITIES
from stiction.quantities.units import to_si

SAMPLE = "sample"  # the dimension along which numbers are drawn
_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_ERROR = re.compile(rf"\s*\(?\s*({_NUMBER})\s*([^+±]*?)\s*(?:\+/-|\+-|±)\s*({_NUMBER})\s*\)?\s*(.*?)\s*", re.DOTALL)
_MOST_SAMPLES = 1_000_000
_LARGEST_FILE = 200_000_000
_NOT_OF_A_CONTACT = ("surface_energy",)  # a contact has a work of adhesion of its own
_TOGETHER = "name of a dimension: quantities with the same vary together"


def _power_of_two(value: Any) -> Any:
    if isinstance(value, bool) or not isinstance(value, int) or not 64 <= value <= 2**20 or value & (value - 1):
        raise InputError("", value, "a power of two, 64 to 1048576")
    return value


class Uncertainty(Input):
    """How uncertain numbers are drawn.

    count: points, of Sobol's sequence, scrambled; seed: of the scrambling; coverage: the share of all points that a band holds.
    ranges: whether numbers of materials vary within their ranges.
    """

    count: Annotated[int, BeforeValidator(_power_of_two)] = Field(
        1024, strict=True, description="a power of two, 64 to 1048576"
    )
    seed: int = Field(0, ge=0, le=2**63 - 1, strict=True, description="a whole number, 0 or more")
    coverage: float = Field(0.9, gt=0.0, lt=1.0, strict=True, description="a share above 0 and below 1, e.g. 0.9")
    ranges: bool = Field(False, strict=True, description="true: numbers of materials vary within their ranges; or false")


class _Between(Input):
    """Anything between two ends."""

    low: Point = Field(description="the low end")
    high: Point = Field(description="the high end")
    spacing: Literal["linear", "log"] = Field(
        "linear", description="linear: the number is as likely anywhere; log: its logarithm is"
    )
    along: Along = Field(None, validate_default=False, description=_TOGETHER)


class _Factor(Input):
    """A median, and the factor that is one standard deviation of the logarithm."""

    median: Point = Field(description="the value that is as likely too high as too low")
    factor: float = Field(gt=1.0, le=1e6, strict=True, description="a factor above 1: two thirds of the values lie within it")
    along: Along = Field(None, validate_default=False, description=_TOGETHER)


class _Samples(Input):
    """Values from a file: text with a column for each quantity."""

    samples: str = Field(description="a file beside the case, with a number in every line, or columns under their names")
    unit: str | None = Field(None, description="the unit of the numbers in the file")
    column: str | None = Field(None, description="the name of the column, where the file has several")
    along: Along = Field(None, validate_default=False, description="name of a dimension: rows of one file stay together")


# The tables that say how uncertain a number is, by the names that they have in a JSON schema.
FORMS: tuple[tuple[str, type[Input]], ...] = (("Between", _Between), ("WithinFactor", _Factor), ("FromSamples", _Samples))


@dataclass(frozen=True)
class Uncertain(Several):
    """Hold an uncertain number of a contact and its distribution.

    Numbers of the same `dimension` are sampled together. `values` has the nominal value; `at(share)` returns the values at
    quantile levels (n,) of the distribution.
    """

    distribution: Any = None

    @classmethod
    def of(cls, path: Address, distribution: Distribution, dimension: str | None = None) -> "Uncertain":
        name = path[-1]
        return cls(path, dimension or name, name, np.array([distribution.nominal]), distribution=distribution)

    @property
    def words(self) -> InWords:
        return InWords(self.distribution.words)

    def numbers(self) -> np.ndarray:
        """Refused: there are as many as are drawn."""
        drawn = 'a number, a list or a range; or points that are drawn, sample = { method = "sobol", count = 1024 }'
        raise InputError(self.where, self.words, drawn)

    def as_table(self) -> dict[str, Any]:
        return self.distribution.as_table() | {"along": self.dimension}

    def at(self, share: np.ndarray) -> np.ndarray:
        return self.distribution.ppf(share)


def uncertain_numbers(content: Mapping, folder: Path = Path(), of_materials: Path | None = None) -> dict[Address, Uncertain]:
    """Return the uncertain numbers of [contact], [indices] and [materials], by address.

    folder: of files of values; of_materials: folder of files of values of [materials], if these are in a file elsewhere. Raises
    InputError.
    """
    found = {path: entry for path, entry in numbers_in(content, ("contact", "indices", "materials")) if with_error(entry)}
    read = {}
    for path, entry in found.items():
        beside = folder if of_materials is None or path[0] != "materials" else of_materials
        one = read_distribution(entry, path[-1], ".".join(path), beside)
        along = entry.get("along") if isinstance(entry, Mapping) else None
        read[path] = Uncertain.of(path, one, along or ".".join(path[1:]))
    _check_rows(read)
    return read


def _check_rows(numbers: Mapping[Address, Uncertain]) -> None:
    """InputError where files whose rows stay together have not as many."""
    first: dict[str, Uncertain] = {}
    for one in numbers.values():
        if one.distribution.kind != "values":
            continue
        other = first.setdefault(one.dimension, one)
        count, wanted = (len(each.distribution.parameters) for each in (one, other))
        if count != wanted:
            allowed = f"{wanted}, as many as {other.where} has: rows of both go together"
            raise InputError(f"{one.where}.samples", f"{count} values", allowed)


def read_distribution(entry: Any, quantity: str, where: str, folder: Path = Path()) -> Distribution:
    """Read the distribution of a number; where: its address in the file. Raises InputError."""
    if isinstance(entry, Distribution):
        return entry
    if is_law(entry):
        return of_law(quantity, entry, where)
    if isinstance(entry, str):
        return _with_error(entry, quantity, where)
    forms = [form for _, form in FORMS]
    likeliest = max(forms, key=lambda form: len(entry.keys() & form.model_fields.keys() - {"along"}))  # names its missing field
    form = next((form for form in forms if next(iter(form.model_fields)) in entry), likeliest)
    with field_below(where):
        given = form(**entry)
    if isinstance(given, _Samples):
        return of_samples(quantity, _values(given, quantity, where, folder), ordered=given.along is None)
    if isinstance(given, _Factor):
        median = number_of(given.median, quantity, f"{where}.median")
        if not median > 0.0:
            raise InputError(f"{where}.median", given.median, "above 0")
        return within_factor(quantity, median, given.factor, where, entry)
    assert isinstance(given, _Between)
    return between(quantity, *read_ends(given, quantity, where), given.spacing == "log")


def _with_error(text: str, quantity: str, where: str) -> Distribution:
    """Read a number with its standard deviation: "0.5 +/- 0.1 GPa", "0.5 GPa +/- 20 %"."""
    match = _ERROR.fullmatch(text)
    if match is None:
        raise InputError(where, text, f'a number and its standard deviation, e.g. "{_example(quantity)}"')
    number, unit, error, error_unit = match.groups()
    relative = error_unit == "%" and (bool(unit) or not QUANTITIES[quantity].unit)
    own = unit or ("" if relative else error_unit)
    plain = number if QUANTITIES[quantity].unit else float(number)  # a number that lacks its unit is refused as text
    mean = number_of(f"{number} {own}" if own else plain, quantity, where, text)
    if relative:
        deviation = abs(mean) * float(error) / 100.0
    elif unit in ("", error_unit) and float(number) != 0.0:
        deviation = mean / float(number) * float(error)
    else:
        deviation = number_of(f"{error} {error_unit}".strip(), quantity, where, text)
    if not (deviation > 0.0 and np.isfinite(deviation)):
        raise InputError(where, text, f'a standard deviation above 0, e.g. "{_example(quantity)}"')
    return normal(quantity, mean, deviation, where, text)


def _example(quantity: str) -> str:
    number, _, unit = (QUANTITIES[quantity].example or "1").partition(" ")
    return f"{number} +/- {float(f'{float(number) / 10.0:.2g}'):g} {unit}".strip()


def _values(given: _Samples, quantity: str, where: str, folder: Path) -> np.ndarray:
    """Return the values (n,) of a file in SI units."""
    rows = _table(folder / given.samples, f"{where}.samples", given.samples)
    heads = None if _is_number(rows[0][0]) else [head.strip() for head in rows[0]]
    at = _column(heads, given.column, len(rows[0]), where)
    texts = [row[at] if at < len(row) else "" for row in rows[0 if heads is None else 1 :]]
    wanted = QUANTITIES[quantity]
    if wanted.unit and not given.unit:
        raise InputError(
            f"{where}.unit", None, f'the unit of the numbers in the file, e.g. "{wanted.example.partition(" ")[2]}"'
        )
    if not 2 <= len(texts) <= _MOST_SAMPLES:
        raise InputError(f"{where}.samples", given.samples, f"a file with 2 to {_MOST_SAMPLES} values")
    for line, text in enumerate(texts, start=1):
        if not _is_number(text):
            raise InputError(f"{where}.samples", text, f"numbers; this is value {line} of {given.samples}")
    numbers = np.array([float(text) for text in texts])
    scale = 1.0
    if wanted.unit and numbers.any():
        first = int(np.flatnonzero(numbers)[0])
        scale = number_of(f"{texts[first]} {given.unit}", quantity, f"{where}.samples") / numbers[first]
    with field_named(f"{where}.samples"):
        return np.asarray(to_si(numbers * scale, quantity))


def _table(path: Path, where: str, name: str) -> list[list[str]]:
    """Return the lines of a file without comments, split into columns."""
    text = read_text(path, where, "a file of numbers", _LARGEST_FILE, name)
    kept = [line.partition("#")[0].strip() for line in text.splitlines()]
    rows = [re.split(r"[,;\t]\s*|\s+", line) for line in kept if line]
    if not rows:
        raise InputError(where, name, "a file of numbers; this one is empty")
    return rows


def _column(heads: list[str] | None, wanted: str | None, columns: int, where: str) -> int:
    if wanted is None and columns == 1:
        return 0
    if heads is None or wanted not in heads:
        known = ", ".join(heads or []) or "nothing: the columns of the file have no names"
        raise InputError(f"{where}.column", wanted, known)
    return heads.index(wanted)


def _is_number(text: str) -> bool:
    try:
        return bool(np.isfinite(float(text)))
    except ValueError:
        return False


def placed(numbers: Mapping[Address, Uncertain], content: Mapping) -> Iterator[Uncertain]:
    """Yield the numbers where they are used: those of a material in every body of that material."""
    for path, one in numbers.items():
        if path[0] != "materials":
            yield one
            continue
        for body in BODIES:
            table = entry_at(content, body)
            name = table.get("preset") if isinstance(table, Mapping) else table
            if name == path[1] and not (isinstance(table, Mapping) and path[-1] in table):
                yield replace(one, path=(*body, path[-1]))


def with_ranges(content: Mapping, taken: Sequence[Address]) -> Iterator[Uncertain]:
    """Yield the numbers of materials that have ranges, but for those at the addresses that are taken.

    Within its range a number is as likely by its logarithm, where it is above 0; two bodies of one material vary together.
    """
    for body in BODIES:
        material = _material_of(entry_at(content, body))
        if material is None:
            continue
        for name, (low, high) in material.range.items():
            path = (*body, name)
            if low < high and path not in taken and name not in _NOT_OF_A_CONTACT:
                nominal = float(getattr(material, name))
                yield Uncertain.of(path, in_range(name, low, high, nominal, low > 0.0), f"{material.name}.{name}")


def _material_of(body: Any) -> Material | None:
    """Return the material of a body, where there is one."""
    found = as_material(body)
    return Material(**found) if isinstance(found, Mapping) else found


def named(numbers: Sequence[Uncertain]) -> list[Uncertain]:
    """Return the numbers with unique names: the short name if no other number has it."""
    short = [one.path[-1] for one in numbers]
    found = []
    for one in numbers:
        whole = ".".join(one.path[1:])
        name = one.path[-1] if short.count(one.path[-1]) == 1 else whole
        found.append(replace(one, name=name, dimension=name if one.dimension == whole else one.dimension))
    return found
