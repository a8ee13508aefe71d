"""Read uncertain numbers of a case file: with a standard deviation, an interval, a factor, or samples from a file."""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BeforeValidator, Field

from stiction.case.addresses import BODIES, entry_at
from stiction.case.distribution import (
    Distribution,
    between,
    from_scipy,
    in_range,
    is_scipy_law,
    normal,
    of_samples,
    within_factor,
)
from stiction.case.swept import Address, Along, Point, SweptNumber, number_of, numbers_in, read_ends, with_error
from stiction.contact.materials import Material, as_material
from stiction.quantities.errors import InputError, InWords, field_below, field_named
from stiction.quantities.inputs import Input, Seed
from stiction.quantities.paths import read_text
from stiction.quantities.table import QUANTITIES
from stiction.quantities.units import to_si

SAMPLE = "sample"  # name of the dimension of random samples
_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_ERROR = re.compile(rf"\s*\(?\s*({_NUMBER})\s*([^+±]*?)\s*(?:\+/-|\+-|±)\s*({_NUMBER})\s*\)?\s*(.*?)\s*", re.DOTALL)
_MOST_SAMPLES = 1_000_000
_LARGEST_FILE = 200_000_000
_NOT_OF_A_CONTACT = ("surface_energy",)  # not used: a contact uses its work of adhesion instead
_TOGETHER = "name of a dimension; numbers with the same dimension are sampled together"


def _power_of_two(value: Any) -> Any:
    if isinstance(value, bool) or not isinstance(value, int) or not 64 <= value <= 2**20 or value & (value - 1):
        raise InputError("", value, "a power of two, 64 to 1048576")
    return value


class Uncertainty(Input):
    """Define the table [uncertainty] of a case file: how uncertain numbers are sampled.

    count: number of samples, a power of two. seed: seed of the scrambled Sobol sequence. coverage: coverage probability of the
    prediction interval. ranges: whether material presets vary within their stated ranges. Defaults: 1024, 0, 0.9 and False.
    """

    count: Annotated[int, BeforeValidator(_power_of_two)] = Field(
        1024, strict=True, description="a power of two, 64 to 1048576"
    )
    seed: Seed = 0
    coverage: float = Field(0.9, gt=0.0, lt=1.0, strict=True, description="a probability above 0 and below 1, e.g. 0.9")
    ranges: bool = Field(
        False, strict=True, description="true or false: whether material properties vary within their stated ranges"
    )


class _Between(Input):
    """Define an uncertain number with a uniform or log-uniform distribution between two limits.

    along: name of a dimension; numbers with the same dimension are sampled at the same quantile levels.
    """

    low: Point = Field(description="the low end")
    high: Point = Field(description="the high end")
    spacing: Literal["linear", "log"] = Field(
        "linear", description="linear: uniform distribution; log: uniform distribution of the logarithm"
    )
    along: Along = Field(None, description=_TOGETHER)


class _Factor(Input):
    """Define an uncertain number with a log-normal distribution by its median and geometric standard deviation."""

    median: Point = Field(description="the median, with its unit")
    factor: float = Field(
        gt=1.0,
        le=1e6,
        strict=True,
        description="a factor above 1; two thirds of the values are within this factor of the median",
    )
    along: Along = Field(None, description=_TOGETHER)


class _Samples(Input):
    """Define an uncertain number whose distribution is given by samples in a text or CSV file."""

    samples: str = Field(description="path of a file with one number per line, or with named columns")
    unit: str | None = Field(None, description="the unit of the numbers in the file")
    column: str | None = Field(None, description="name of the column, if the file has several")
    along: Along = Field(None, description="name of a dimension; rows of one file are sampled together")


# The tables that describe an uncertain number, each with its name in the JSON schema.
FORMS: tuple[tuple[str, type[Input]], ...] = (("Between", _Between), ("WithinFactor", _Factor), ("FromSamples", _Samples))


@dataclass(frozen=True)
class Uncertain(SweptNumber):
    """Describe an uncertain number of a contact: its address in the case and its probability distribution.

    Numbers of the same `dimension` are sampled at the same quantile levels. `values` holds the nominal value only. The method
    `at` returns the quantiles (n,), in SI units, at quantile levels (n,).
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
        """Raise InputError, because an uncertain number has no list of values that a sweep could use."""
        drawn = 'a number, list or range; uncertain numbers need a sampled sweep: sample = { method = "sobol", count = 1024 }'
        raise InputError(self.where, self.words, drawn)

    def as_table(self) -> dict[str, Any]:
        return self.distribution.as_table() | {"along": self.dimension}

    def at(self, share: np.ndarray) -> np.ndarray:
        return self.distribution.ppf(share)


def uncertain_numbers(content: Mapping, folder: Path = Path(), of_materials: Path | None = None) -> dict[Address, Uncertain]:
    """Return the uncertain numbers of the tables [contact], [indices] and [materials] by address (tuple of keys).

    content: tables of a case. folder: folder at which relative paths of sample files start. of_materials: start folder for
    [materials]; None if it is `folder`. Raises InputError for an invalid entry.
    """
    entries = {path: entry for path, entry in numbers_in(content, ("contact", "indices", "materials")) if with_error(entry)}
    read = {}
    for path, entry in entries.items():
        beside = folder if of_materials is None or path[0] != "materials" else of_materials
        distribution = read_distribution(entry, path[-1], ".".join(path), beside)
        along = entry.get("along") if isinstance(entry, Mapping) else None
        read[path] = Uncertain.of(path, distribution, along or ".".join(path[1:]))
    _check_rows(read)
    return read


def _check_rows(numbers: Mapping[Address, Uncertain]) -> None:
    """Raise InputError if two numbers that are sampled together come from sample files with different numbers of rows."""
    first: dict[str, Uncertain] = {}
    for number in numbers.values():
        if number.distribution.kind != "values":
            continue
        other = first.setdefault(number.dimension, number)
        count, wanted = (len(uncertain.distribution.parameters) for uncertain in (number, other))
        if count != wanted:
            allowed = f"{wanted} values as in {other.where}, because rows of both are sampled together"
            raise InputError(f"{number.where}.samples", InWords(f"{count} values"), allowed)


def read_distribution(entry: Any, quantity: str, where: str, folder: Path = Path()) -> Distribution:
    """Return the distribution that an entry of a case describes.

    entry: text such as "0.5 +/- 0.1 GPa", a table such as { low, high }, a Distribution, or a distribution of scipy.stats.
    quantity: name of the quantity. where: address of the entry for errors. folder: folder at which relative paths of sample
    files start. Raises InputError for an entry that is not a distribution, or is out of bounds.
    """
    if isinstance(entry, Distribution):
        return entry
    if is_scipy_law(entry):
        return from_scipy(quantity, entry, where)
    if isinstance(entry, str):
        return _with_error(entry, quantity, where)
    forms = [form for _, form in FORMS]
    # Without a clear form, the one sharing most keys is used, so that its error names the missing field.
    likeliest = max(forms, key=lambda form: len(entry.keys() & form.model_fields.keys() - {"along"}))
    form = next((form for form in forms if next(iter(form.model_fields)) in entry), likeliest)
    with field_below(where):
        table = form(**entry)
    if isinstance(table, _Samples):
        return of_samples(quantity, _values(table, quantity, where, folder), ordered=table.along is None)
    if isinstance(table, _Factor):
        median = number_of(table.median, quantity, f"{where}.median")
        if not median > 0.0:
            raise InputError(f"{where}.median", table.median, "above 0")
        return within_factor(quantity, median, table.factor, where, entry)
    assert isinstance(table, _Between)
    return between(quantity, *read_ends(table, quantity, where), table.spacing == "log")


def _with_error(text: str, quantity: str, where: str) -> Distribution:
    """Return the normal distribution, in SI units, described by text such as "0.5 +/- 0.1 GPa" or "0.5 GPa +/- 20 %".

    quantity: name of the quantity. where: address for errors. Raises InputError for other text, and for a standard deviation
    that is not positive.
    """
    match = _ERROR.fullmatch(text)
    if match is None:
        raise InputError(where, text, f'a number and its standard deviation, e.g. "{_example(quantity)}"')
    number, unit, error, error_unit = match.groups()
    relative = error_unit == "%" and (bool(unit) or not QUANTITIES[quantity].unit)
    own = unit or ("" if relative else error_unit)
    plain = number if QUANTITIES[quantity].unit else float(number)  # kept as text, number_of reports the missing unit
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


def _values(table: _Samples, quantity: str, where: str, folder: Path) -> np.ndarray:
    """Read the samples (n,) of an uncertain number from a file, in SI units.

    table: entry of the case that names file, column and unit. where: address of the entry for errors. folder: folder at which
    relative paths start. Raises InputError for a missing unit, an unknown column, and a file that cannot be read or does not
    hold 2 to 1,000,000 valid numbers.
    """
    rows = _table(folder / table.samples, f"{where}.samples", table.samples)
    heads = None if _is_number(rows[0][0]) else [head.strip() for head in rows[0]]
    column = _column(heads, table.column, len(rows[0]), where)
    texts = [row[column] if column < len(row) else "" for row in rows[0 if heads is None else 1 :]]
    wanted = QUANTITIES[quantity]
    if wanted.unit and not table.unit:
        raise InputError(
            f"{where}.unit", None, f'the unit of the numbers in the file, e.g. "{wanted.example.partition(" ")[2]}"'
        )
    if not 2 <= len(texts) <= _MOST_SAMPLES:
        raise InputError(f"{where}.samples", table.samples, f"a file with 2 to {_MOST_SAMPLES} values")
    for line, text in enumerate(texts, start=1):
        if not _is_number(text):
            raise InputError(f"{where}.samples", text, f"a number; this is value {line} of {table.samples}")
    numbers = np.array([float(text) for text in texts])
    scale = 1.0
    if wanted.unit and numbers.any():
        first = int(np.flatnonzero(numbers)[0])
        scale = number_of(f"{texts[first]} {table.unit}", quantity, f"{where}.samples") / numbers[first]
    with field_named(f"{where}.samples"):
        return np.asarray(to_si(numbers * scale, quantity))


def _table(path: Path, where: str, name: str) -> list[list[str]]:
    """Read a text file as a list of rows, each a list of cells, without comments and empty lines.

    where: address in the case for errors. name: path as the user wrote it, for errors. Raises InputError if the file is empty
    or cannot be read.
    """
    text = read_text(path, where, "a file of numbers", _LARGEST_FILE, name)
    lines = [line.partition("#")[0].strip() for line in text.splitlines()]
    rows = [re.split(r"[,;\t]\s*|\s+", line) for line in lines if line]
    if not rows:
        raise InputError(where, name, "a file of numbers; this one is empty")
    return rows


def _column(heads: list[str] | None, wanted: str | None, columns: int, where: str) -> int:
    if wanted is None and columns == 1:
        return 0
    if heads is None or wanted not in heads:
        known = ", ".join(heads or []) or "a file with a single column, or with column names in its first line"
        raise InputError(f"{where}.column", wanted, known)
    return heads.index(wanted)


def _is_number(text: str) -> bool:
    try:
        return bool(np.isfinite(float(text)))
    except ValueError:
        return False


def at_bodies(numbers: Mapping[Address, Uncertain], content: Mapping) -> Iterator[Uncertain]:
    """Yield the uncertain numbers of a case, each at the address of the body to which it belongs.

    numbers: uncertain numbers by address (tuple of keys). content: tables of the case. A number of a user-defined material is
    yielded once for every body or film of this material that does not have its own value. All other numbers are yielded
    unchanged.
    """
    for path, number in numbers.items():
        if path[0] != "materials":
            yield number
            continue
        for body in BODIES:
            table = entry_at(content, body)
            name = table.get("preset") if isinstance(table, Mapping) else table
            if name == path[1] and not (isinstance(table, Mapping) and path[-1] in table):
                yield replace(number, path=(*body, path[-1]))


def with_ranges(content: Mapping, taken: Sequence[Address]) -> Iterator[Uncertain]:
    """Yield an uncertain number for every material property that has a stated range, for both bodies and the film.

    content: tables of a case. taken: addresses (tuples of keys) of numbers to skip. Surface energies are left out. A property
    whose range is above 0 has a log-uniform distribution over the range, other properties a uniform one. The same property of
    two bodies of one material is sampled at the same quantile levels.
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
    """Return the material of a body that is given as a name, table or Material; None for anything else.

    An invalid name or table also gives None, because the contact raises the error later.
    """
    try:
        material = as_material(body)
        material = Material(**material) if isinstance(material, Mapping) else material
    except InputError:  # raised again for the contact, with the name of the body
        return None
    return material if isinstance(material, Material) else None


def named(numbers: Sequence[Uncertain]) -> list[Uncertain]:
    """Return uncertain numbers with unique names: the short name, or the dotted name if two numbers share the short name.

    A sample dimension that was the dotted name of its number gets the new name too.
    """
    short = [number.path[-1] for number in numbers]
    renamed = []
    for number in numbers:
        dotted_name = ".".join(number.path[1:])
        name = number.path[-1] if short.count(number.path[-1]) == 1 else dotted_name
        renamed.append(replace(number, name=name, dimension=name if number.dimension == dotted_name else number.dimension))
    return renamed
