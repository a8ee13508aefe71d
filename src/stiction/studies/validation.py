"""Compare models and predictions with measured series from the literature.

An entry is a TOML file with a table [contact] or [indices], as in a case file, and a table [measured], which names the source.
The measured values are in a CSV file next to it, or in tables [[measured.band]] if only ranges of friction are published.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from pydantic import Field, model_validator

from stiction.case.measurements import Measurements, read_measurements
from stiction.case.read import Case, case_of, read_content, with_single_numbers
from stiction.case.uncertain import Uncertain, named
from stiction.contact.contact import Contact
from stiction.contact.subject import Subject
from stiction.laws.validity import warnings_of
from stiction.quantities.errors import InputError, InWords, field_below
from stiction.quantities.inputs import Input
from stiction.quantities.progress import Steps
from stiction.quantities.shown import reason_of
from stiction.quantities.table import QUANTITIES
from stiction.quantities.units import to_si
from stiction.records.validity_warning import ValidityWarning
from stiction.solving.candidates import candidates
from stiction.solving.solve import solve
from stiction.studies.prediction.predict import predict

if TYPE_CHECKING:
    import xarray

    from stiction.quantities.arguments import FilePath

# Predicted and measured values are compared by their ratio. A separation has an arbitrary zero, so it has no such ratio.
_NOT_COMPARED = ("mean_separation",)
_TABLES = ("title", "materials", "contact", "indices", "measured")
# Levels of the quantiles of the prediction: the ends of its 50 % and 90 % intervals, and the median.
LEVELS = (0.05, 0.25, 0.5, 0.75, 0.95)


class Band(Input):
    """Define a published range of the friction coefficient, from `low` to `high`, at one normal load."""

    load: str = Field(description='normal load with its unit, "0.98 mN"')
    low: float = Field(description="lower end of the measured friction coefficient, above 0")
    high: float = Field(description="upper end of the measured friction coefficient")

    @model_validator(mode="after")
    def _is_a_range(self):
        if not 0.0 < self.low <= self.high:
            raise InputError("low", self.low, f"above 0 and at most high, {self.high:g}")
        if not to_si(self.load, "load") > 0.0:
            raise InputError("load", self.load, "> 0 N")
        return self


class Origin(Input):
    """Define the table [measured]: the source of a measured series, and its values.

    file: CSV file with the values; a relative path starts at the folder of the entry. band: published ranges of friction
    instead of a file. kind: "measured", or "synthetic" for values made up to show the format. source: authors, title,
    publication, year. place: page, and table, figure or section. read: how the values were obtained; the standard errors of
    digitised values include the error of digitising. Raises InputError.
    """

    file: str = Field("", description="the CSV file with the values, from the folder of the entry")
    band: list[Band] = Field(default_factory=list, description="ranges of the friction coefficient, in place of a file")
    kind: Literal["measured", "synthetic"] = Field(description="measured, or synthetic: made up to show the format")
    source: str = Field(description="authors, title, journal or publisher, year")
    place: str = Field("", description='page, and table, figure or section: "p. 57, Table 3"')
    doi: str = Field("", description="DOI of the source, if it has one")
    read: Literal["printed", "digitised", "data file", "computed"] = Field(description="how the values were read")
    note: str = Field("", description="other facts that a reader needs: preparation, assumptions of the entry")

    @model_validator(mode="after")
    def _says_where(self):
        if bool(self.file) == bool(self.band):
            raise InputError(
                "file and band",
                InWords("both given") if self.file else None,
                "exactly one of the two: a CSV file or [[measured.band]]",
            )
        if not self.source.strip():
            raise InputError("source", self.source, "authors, title, journal or publisher, year")
        if self.kind == "measured" and not self.place.strip():
            raise InputError("place", self.place or None, 'page, and table, figure or section, e.g. "p. 57, Table 3"')
        if (self.kind == "synthetic") != (self.read == "computed"):
            raise InputError("read", self.read, '"computed" for the kind "synthetic", and for no other kind')
        return self


@dataclass(frozen=True)
class Entry:
    """Store a measured series with its contact.

    origin: source of the series. content: tables of the case, with scans and user-defined materials read in. values: the
    measured values. uncertain: uncertain numbers of the contact, which the prediction samples.
    """

    title: str
    origin: Origin
    content: Mapping[str, Any]
    values: Measurements
    uncertain: tuple[Uncertain, ...] = ()

    @property
    def ends(self) -> np.ndarray:
        """Return the lower and upper end of every measured range (2, n); for a single value, both ends equal this value."""
        bands = self.origin.band
        return np.array([[band.low for band in bands], [band.high for band in bands]] if bands else [self.values.value] * 2)

    def cases(self) -> list[tuple[Case, np.ndarray]]:
        """Return (case, row indices of its measured values) for each contact of the series.

        A series has one contact, unless columns of its file state numbers of the contact, such as a roughness, row by row.
        """
        known = [tuple(sorted(numbers.items())) for numbers in self.values.known]
        cases = []
        for numbers in dict.fromkeys(known):
            rows = np.array([row for row, other in enumerate(known) if other == numbers])
            cases.append((replace(case_of(self.content, dict(numbers)), uncertain=self.uncertain), rows))
        return cases


def read_entry(path: Any) -> Entry:
    """Read a measured series from the TOML file at a path, and from the CSV file that it names. Raises InputError."""
    content = read_content(path)
    table = content.get("measured")
    if not isinstance(table, Mapping):
        raise InputError("measured", table, f"a table [measured] with the source of the values, in {path}")
    unknown = [name for name in content if name not in _TABLES]
    if unknown:
        raise InputError(unknown[0], InWords("a table"), f"{', '.join(_TABLES)}; loads are read from the measured values")
    with field_below("measured"):
        origin = Origin(**table)
    load = {"load": "1 N"} if "indices" not in content else {"load": 1.0}
    tables = {name: value for name, value in content.items() if name != "measured"} | {"solve": load}
    folder = Path(path).parent
    tables_read, uncertain = with_single_numbers(tables, folder, "numbers that change from row to row are columns of the file")
    values = _of_bands(origin.band) if origin.band else read_measurements(folder / origin.file, tables_read)
    _check(values, origin.file)
    entry = Entry(str(content.get("title", "")), origin, tables_read, values, tuple(named([*uncertain.values()])))
    entry.cases()  # raises InputError here if a row gives an invalid contact
    return entry


def _of_bands(bands: list[Band]) -> Measurements:
    """Return published ranges of friction as measurements without errors; each value is the geometric mean of its range."""
    count = len(bands)
    load = np.array([float(to_si(band.load, "load")) for band in bands])
    value = np.array([np.sqrt(band.low * band.high) for band in bands])
    names = ("friction_coefficient",) * count
    return Measurements(names, ("",) * count, load, value, np.full(count, np.nan), ({},) * count, tuple(range(1, count + 1)))


def _check(values: Measurements, file: str) -> None:
    for quantity, value, line in zip(values.quantity, values.value, values.line, strict=True):
        if quantity in _NOT_COMPARED:
            raise InputError(
                f"{file}, {quantity}", InWords("a column"), "a positive quantity; predictions are compared by ratio"
            )
        if not value > 0.0:
            raise InputError(f"{file}, line {line}, {quantity}", float(value), "above 0")


def entries_in(folder: Any) -> list[Path]:
    """Return the paths of the TOML files with a table [measured] in a folder, sorted by name.

    Raises InputError if there are none.
    """
    paths = [path for path in sorted(Path(folder).glob("*.toml")) if "measured" in read_content(path)]
    if not paths:
        raise InputError("entry", str(folder), "a TOML file with a table [measured], or a folder with such files")
    return paths


def validate(entry: "Entry | FilePath", *, progress: Steps = iter) -> "xarray.Dataset":
    r"""Compare the prediction and every applicable model with measured values.

    Parameters
    ----------
    entry : path or Entry
        TOML file with the tables [contact] and [measured], usually next to a CSV file of values; or the result of `read_entry`.
    progress : callable
        Receives the list of models and returns an iterable over it.

    Returns
    -------
    xarray.Dataset
        Over `row`, one for each measured value: measured and error in SI units, quantity, sample, load [N], line, and the ends
        measured_low and measured_high of a published range. Over (model, row), for models with any result: `predicted`, NaN
        where a model gives no result. Over `model`: `bias`, the geometric mean of predicted over measured; `factor`, exp of the
        root mean square of ln(predicted over measured); `in_errors`, the root mean square of the differences over the standard
        errors; `answered`, the number of rows with a result; grade; `outside_validity`, the validity warnings, and `outside`,
        the symbols of their quantities. For friction also `prediction` (quantile, row), and `within_50` and `within_90`:
        whether the measured value or range is "inside", "partly" inside or "outside" the 50 % and 90 % interval of the
        prediction ("" without one). Attributes: title, kind, source, place, doi, read, note, `not_applicable` (model: reason)
        and `sources`.

    Raises
    ------
    InputError
        The entry or its values are missing or wrong.

    Notes
    -----
    Models are sorted by the number of rows with a result, then by `factor`.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> import stiction as st
    >>> folder = pathlib.Path(tempfile.mkdtemp())
    >>> _ = (folder / "values.csv").write_text("load [N],friction_coefficient\n0.1,0.3\n1,0.2\n")
    >>> entry = '''
    ... contact.first = "gold"
    ... contact.second = "gold"
    ... contact.nominal_area = "1 mm^2"
    ... contact.interfacial_shear_strength = "50 MPa"
    ... contact.roughness.asperity_height_deviation = "48 nm"
    ... contact.roughness.asperity_radius = "50 um"
    ... contact.roughness.asperity_density = "1.7e10 1/m^2"
    ... measured.file = "values.csv"
    ... measured.kind = "measured"
    ... measured.read = "printed"
    ... measured.source = "Example"
    ... measured.place = "Table 1"
    ... '''
    >>> _ = (folder / "entry.toml").write_text(entry)
    >>> st.validate(folder / "entry.toml").sizes["row"]
    2
    """
    series = entry if isinstance(entry, Entry) else read_entry(entry)
    cases = series.cases()
    subjects = [(case.subject, rows) for case, rows in cases]
    answers = [_answer(answer.name, series.values, subjects) for answer in progress(candidates(subjects[0][0]))]
    shown = sorted(
        (answer for answer in answers if answer["answered"]),
        key=lambda answer: (-answer["answered"], answer["factor"], answer["model"]),
    )
    left_out = [f"{answer['model']}: {answer['why_not']}" for answer in answers if not answer["answered"]]
    return _dataset(series, shown, left_out).assign(_predicted(series, cases))


# Variables over the models.
_OF_MODELS = ("bias", "factor", "in_errors", "answered", "grade", "outside_validity", "outside")


def _answer(name: str, values: Measurements, subjects: list[tuple[Subject, np.ndarray]]) -> dict[str, Any]:
    """Return the results of one model at the n measured values, as a dict.

    name: name of the model. subjects: each contact with the indices of its measured values. The keys are the names in
    _OF_MODELS, "model", "predicted" (n,), NaN without a result, "sources", and "why_not", the reason if there are no results.
    """
    predicted = np.full(len(values), np.nan)
    grades: set[str] = set()
    sources: dict[str, None] = {}
    validity_warnings: dict[str, ValidityWarning] = {}
    why = "it does not compute the measured quantity"
    waiting = list(subjects)
    while waiting:
        subject, rows = waiting.pop()
        try:
            data = solve(subject, load=values.load[rows], model=name)
        except InputError as error:
            why = reason_of(error)
            if len(rows) > 1 and error.field == "load":  # one load that cannot be carried does not affect the others
                waiting += [(subject, rows[index : index + 1]) for index in range(len(rows))]
            continue
        for place, row in enumerate(rows):
            if values.quantity[row] in data:
                table = np.broadcast_to(data[values.quantity[row]].values, rows.shape)
                predicted[row] = table[place]
        grades.add(data.attrs["grade"])
        sources |= dict.fromkeys(data.attrs["sources"].split())
        validity_warnings |= {warning.rule: warning for warning in warnings_of(data)}
    logarithm = np.log(np.where(predicted > 0.0, predicted / values.value, np.nan))
    quantities = [warning.quantity for warning in validity_warnings.values()]
    return {
        "model": name, "predicted": predicted, "sources": sources, "why_not": why,
        "bias": np.exp(_mean(logarithm)),
        "factor": np.exp(np.sqrt(_mean(logarithm**2))),
        "in_errors": np.sqrt(_mean(((predicted - values.value) / values.error) ** 2)),
        "answered": int(np.isfinite(logarithm).sum()),
        "grade": max(grades, default=""),
        "outside_validity": "; ".join(warning.short for warning in validity_warnings.values()),
        "outside": ", ".join(dict.fromkeys(QUANTITIES[name].symbol for name in quantities if name)),
    }  # fmt: skip


def _predicted(entry: Entry, cases: list[tuple[Case, np.ndarray]]) -> dict[str, Any]:
    """Return variables that compare the prediction with the n measured values of a series.

    cases: each case with the indices of its measured values. The variables are quantiles of the predicted friction coefficient
    at LEVELS, the ends of the measured ranges, and whether each range lies inside, partly inside or outside the 50 % and 90 %
    intervals. For other quantities, and if no prediction is possible, the quantiles are NaN and the texts "".
    """
    values, (low, high) = entry.values, entry.ends
    table = np.full((len(LEVELS), len(values)), np.nan)
    for case, rows in cases:
        of_friction = rows[[values.quantity[row] == "friction_coefficient" for row in rows]]
        if not of_friction.size or not isinstance(case.subject, Contact):
            continue
        try:
            mu = predict(case, load=values.load[of_friction])["friction_coefficient_samples"].values
        except InputError:  # the case has an input that predictions cannot use; only the models are then compared
            continue
        table[:, of_friction] = np.nanquantile(mu, LEVELS, axis=0)
    within = {
        f"within_{share}": ("row", [_within(*ends) for ends in zip(low, high, *table[[first, -1 - first]], strict=True)])
        for share, first in ((50, 1), (90, 0))
    }
    ends = {"measured_low": ("row", low), "measured_high": ("row", high)}
    return {"quantile": list(LEVELS), "prediction": (("quantile", "row"), table)} | ends | within


def _within(low: float, high: float, least: float, most: float) -> str:
    """Return whether a measured range is "inside", "partly" inside or "outside" a predicted interval; "" without one.

    low, high: ends of the measured range. least, most: ends of the interval.
    """
    if not np.isfinite(least):
        return ""
    return "inside" if least <= low and high <= most else "outside" if high < least or most < low else "partly"


def _dataset(entry: Entry, answers: list[dict[str, Any]], left_out: list[str]) -> "xarray.Dataset":
    import xarray

    values = entry.values
    predicted = np.array([answer["predicted"] for answer in answers]).reshape(len(answers), len(values))
    over_rows = {
        "measured": values.value, "error": values.error, "load": values.load,
        "quantity": list(values.quantity), "sample": list(values.sample), "line": list(values.line),
    }  # fmt: skip
    used = dict.fromkeys(key for answer in answers for key in answer["sources"])
    return xarray.Dataset(
        {name: ("model", [answer[name] for answer in answers]) for name in _OF_MODELS}
        | {name: ("row", table) for name, table in over_rows.items()}
        | {"predicted": (("model", "row"), predicted)},
        coords={"model": [answer["model"] for answer in answers]},
        attrs={"title": entry.title, "not_applicable": "\n".join(left_out), "sources": " ".join(used)}
        | entry.origin.model_dump(exclude={"file", "band"}),
    )


def _mean(values: np.ndarray) -> float:
    known = values[np.isfinite(values)]
    return float(known.mean()) if known.size else np.nan
