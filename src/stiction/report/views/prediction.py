"""Build the view of a prediction: tables, sentences, files and pictures."""

import json
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rich.text import Text

from stiction.report.answer import (
    PREDICTION_HEADS,
    answer_lines,
    answer_record,
    beside_area,
    confidence_in,
    confidence_scale,
    ends_of_mu,
)
from stiction.report.files import comment_lines, record, write_csv
from stiction.report.swept_tables import combinations_shown, swept_table
from stiction.report.table import facts
from stiction.report.tables import curve_table
from stiction.report.view import MOST_LINES, Picture, View, lines_of, picture, regime_picture
from stiction.studies.prediction.around import curve_of
from stiction.studies.prediction.measured import read_measured

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

    from stiction.case.read import Case

_RESULTS = ("friction_coefficient", "friction_force", "contact_area")
_WIDE = 3.0  # ratio of the interval ends above which the sources of the interval are always shown
_COLUMNS = [f"{name}{end}" for name in _RESULTS for end in ("", "_low", "_high")]


def prediction_view(
    case: "Case",
    data: "xarray.Dataset",
    file: str,
    details: bool = False,
    saved: bool = False,
    curve: "xarray.Dataset | None" = None,
    measured: "Path | None" = None,
) -> View:
    """Return the view (texts, tables, files and pictures) of a prediction.

    data: result of `predict` for the case. file: name of the case file, for the commands that the view suggests. details:
    whether to show the full answer. saved: whether files are written, for which the output needs one more line. curve:
    prediction over the loads of the picture; by default computed when the picture is drawn. measured: file of the measured
    friction that the prediction uses, for the picture.
    """

    def draw() -> "Figure":
        from stiction.report.prediction_pictures import prediction_figure

        points = None if measured is None else read_measured(measured, case)
        return prediction_figure(data, case.title, curve_of(case, data) if curve is None else curve, points)

    def parts() -> Iterator[Any]:
        if case.title:
            yield Text(case.title, style="bold")
        name = Path(file).name
        more = f"--details; --out DIR; stiction compare {name}"
        if "measured" in data.attrs:
            more = "--details; --out DIR; for other loads repeat this command with --load LOAD"
        rows = [(head, text.replace("CASE.toml", name)) for head, text in answer_lines(data)]
        if details:
            yield from (facts(rows), *_details(case, data))
        else:
            wide = _is_wide(data)
            yield _in_short([*rows, ("details", more)], MOST_LINES - bool(case.title) - saved, wide)

    def as_record() -> dict[str, Any]:
        curve = {name: data[name].values.ravel().tolist() for name in ("load", *_COLUMNS)}
        parameters = (
            {"parameters": data[["value", "low", "high"]].to_dataframe().to_dict("index")} if "parameter" in data.dims else {}
        )
        return {"answer": answer_record(data), "curve": curve} | parameters

    if case.is_swept:
        return _swept_view(case, data, details)
    files = {"curve.csv": partial(write_csv, data[_COLUMNS], comments=_comments(case, data[_COLUMNS]))}
    pictures = {"curve.png": Picture("mu with its interval", draw)}
    pictures |= regime_picture(case.subject, data, case.title)
    return View("curve", plain(data), parts, as_record, files, pictures, is_brief=True)


def _is_wide(data: "xarray.Dataset") -> bool:
    """Return whether the interval of mu at the working load is wider than a factor of 3."""
    _, low, high = ends_of_mu(data)
    return high > _WIDE * low


def _in_short(rows: list[tuple[str, str]], most: int, wide: bool = False) -> Any:
    """Return the table of an answer, without its least important rows if it would have more than `most` lines.

    rows: pairs (heading, text). wide: whether the interval is so wide that its sources are always shown.
    """
    sources = ["uncertainty from"]
    order = ["model", "along the load", "checked against", *([] if wide else sources), "if worn through", "lower mu by"]
    for name in order:
        if lines_of(facts(rows)) <= most:
            break
        rows = [row for row in rows if row[0] != name]
    return facts(rows)


def _swept_view(case: "Case", data: "xarray.Dataset", details: bool) -> View:
    """Return the view of the predictions for a case with array parameters.

    details: whether the table has a row for every combination.
    """

    def parts() -> Iterator[Any]:
        if case.title:
            yield Text(case.title, style="bold")
        yield f"mu with its {data.attrs['level']:.0%} interval; {data.attrs['draws']} samples of each contact"
        if refused := data.attrs["refused"]:
            why = data.attrs["why_refused"]
            yield f"{refused} of {data['friction_coefficient'].size} points refused" + (f", for example: {why}" if why else "")
        yield swept_table(data, details)
        if not details and (text := combinations_shown(data, "--details")):
            yield Text(text, style="dim")

    files = {"curve.csv": partial(write_csv, data, comments=_comments(case, data))}
    drawn = picture("mu against the varied inputs", "swept_pictures.swept_figure", data, case.title)
    return View("curve", data, parts, lambda: {"curve": record(data, {})}, files, {"curve.png": drawn}, is_brief=True)


def _details(case: "Case", data: "xarray.Dataset") -> Iterator[Any]:
    """Yield the parts that only the detailed answer has: curve, warnings, model weights, samples, inputs, interface state."""
    if data["load"].size > 1:
        yield from ("", curve_table(data, heads=PREDICTION_HEADS))
    yield ""
    contact: Any = case.subject
    rows = [(("warning", "")[number > 0], text) for number, text in enumerate(data.attrs["warnings"])]
    rows += [("confidence", confidence_scale(confidence_in(data))), ("models", _models(data))]
    rows += [("samples", f"{data.sizes['sample']}; {data.attrs['excluded']:.1%} are impossible and excluded")]
    rows += [("inputs", "\n".join(_inputs(contact)))]
    if contact.interface is not None:
        rows += [("interface", "\n".join([contact.interface.name, *contact.interface.notes()]))]
    yield facts(rows)


def _inputs(contact: Any) -> list[str]:
    return [f"{name} = {text}" for name, text in contact.inputs()]


def _models(data: "xarray.Dataset") -> str:
    return ", ".join(f"{name} {share:.0%}" for name, share in data.attrs["models"].items()) + beside_area(data.attrs)


def _comments(case: "Case", data: "xarray.Dataset") -> list[str]:
    """Return the comment lines for the CSV file of a prediction."""
    used = data.attrs
    notes = {"warning": used.get("warnings"), "not used": used.get("inputs_not_used"), "input": _inputs(case.subject)}
    models = _models(data) if "models" in used else ""
    return comment_lines({"title": case.title, "model": models and f"{models}, combined by prediction"} | notes, data)


def plain(data: "xarray.Dataset") -> "xarray.Dataset":
    """Return a dataset with its list and dict attributes as JSON texts, because netCDF files cannot store lists and dicts."""
    texts = {
        name: json.dumps(value, ensure_ascii=False) for name, value in data.attrs.items() if isinstance(value, dict | list)
    }
    return data.assign_attrs(texts)
