"""Write the report of one case as a self-contained HTML page without network access or scripts."""

import base64
import datetime
import json
import os
import shutil
import subprocess
import tempfile
from collections.abc import Iterable
from functools import partial
from importlib import resources
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypedDict

from stiction.case.read import Case, as_case
from stiction.case.text import as_toml
from stiction.quantities.errors import InputError
from stiction.quantities.extras import installed, require
from stiction.quantities.paths import require_place
from stiction.quantities.progress import Progress, silent
from stiction.report import report_sections as say
from stiction.report.answer import ModelAnswer, PredictionAnswer, answer_record, model_record
from stiction.report.html_words import breakable, formula, unbroken
from stiction.report.printed_sources import printed
from stiction.report.report_answer import answer_in_words, headline, interval_of, main_inputs, question, warnings_here
from stiction.report.report_sections import groups_of_groups, groups_of_inputs
from stiction.report.significant_digits import rounded
from stiction.solving.choice import RECOMMENDED
from stiction.solving.overview import entries
from stiction.studies.report_data import ReportData, collect_report_data, text_of_file

if TYPE_CHECKING:
    from stiction.case.arguments import CaseLike
    from stiction.quantities.arguments import FilePath, QuantityLike

# Columns whose cells are symbols and meanings of the table of quantities.
_FORMULAS = ("symbol", "quantity", "group", "stated")
_SUFFIXES = (".html", ".htm", ".pdf")
# Browsers that can print a page as PDF.
_BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome", "msedge", "microsoft-edge")


class ReportAnswer(TypedDict):
    """Define the answer of a report, as `write_report` returns it.

    friction_coefficient: None if no load is compressive, if the model has no friction, or for a case with array parameters.
    answer: answer of the prediction, or of the model that the case names; None for a case with array parameters. grade: grade
    of that model; None for a prediction. measured_error: errors of that model on benchmark surfaces; None for a prediction.
    not_compared: why models were not compared; "" if they were.
    """

    title: str
    question: str
    answer: PredictionAnswer | ModelAnswer | None
    answer_in_words: str
    model: str
    grade: str | None
    working_load: float | None
    working_load_unit: str
    friction_coefficient: float | None
    friction_coefficient_rounded: str | None
    validity_warnings: list[dict[str, str | float | None]]
    measured_error: dict[str, str | bool | list[float | None] | None] | None
    not_compared: str
    sources: list[str]
    versions: dict[str, str]


def write_report(
    case: "CaseLike",
    path: "FilePath",
    *,
    load: "QuantityLike | None" = None,
    ranges: bool | None = None,
    progress: Progress = silent,
) -> ReportAnswer:
    """Write a report of a case as one HTML or PDF file.

    Parameters
    ----------
    case : Case, path, or dict like a case file
        One contact, or a case with array parameters.
    path : path
        File to write: .html, or .pdf if a browser or weasyprint is installed. An existing file is replaced.
    load : float [N] or str with a unit, optional
        Working load of one contact; by default the middle load of the case. Not allowed with array parameters.
    ranges : bool, optional
        Whether the properties of material presets vary within their ranges. By default the case decides.
    progress : callable
        Receives a label and returns a function that wraps the list of steps.

    Returns
    -------
    ReportAnswer
        A dict with the answer as numbers and texts, e.g. `friction_coefficient`.

    Raises
    ------
    InputError
        If the case is invalid or the file cannot be written.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> import stiction as st
    >>> contact = {
    ...     "first": "gold", "second": "gold", "nominal_area": "1 mm^2", "interface": "clean metal",
    ...     "roughness": {"asperity_height_deviation": "48 nm", "asperity_radius": "50 um", "asperity_density": "1.7e10 1/m^2"},
    ... }
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "report.html"
    >>> answer = st.write_report({"contact": contact, "solve": {"load": "1 N", "model": "persson_2001"}}, path)
    >>> path.exists()
    True
    """
    require("report", "matplotlib")
    check_place(Path(path), case)
    (read,) = progress("Reading the case")(as_case(source, ranges) for source in [case])
    text, name = "", "case.toml"
    if isinstance(case, str | os.PathLike):
        text, name = text_of_file(Path(case)), Path(case).name
    elif not isinstance(case, Case):
        text = as_toml(case)
    findings = collect_report_data(read, text, load=load, progress=progress)
    write_html(Path(path), as_html(findings, name, say.command(name, load, ranges), progress))
    return report_record(findings)


def case_as_html(case: Case, text: str, progress: Progress = silent) -> str:
    """Solve a case and return its report as one HTML page.

    text: content of the case file, which the page calls case.toml. Raises InputError if the case is invalid.
    """
    name = "case.toml"
    return as_html(collect_report_data(case, text, progress=progress), name, say.command(name, None, None), progress)


def as_html(findings: ReportData, name: str, again: str, progress: Progress = silent) -> str:
    """Return the HTML page of a report.

    findings: results that the report shows. name: name of the case file. again: command line that makes the report again. Apart
    from the date, the page depends on these arguments only.
    """
    import jinja2

    from stiction.report.report_pictures import all_of_one

    loader = jinja2.PackageLoader("stiction.report")
    templates = jinja2.Environment(
        loader=loader, autoescape=True, undefined=jinja2.StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    templates.filters |= {"breakable": breakable, "formula": formula, "unbroken": unbroken}
    own, of_materials, others = say.sources_of(findings)
    style = resources.files("stiction.report").joinpath("templates/report.css").read_text(encoding="utf-8")
    pictures = dict(_pictures(findings, progress))
    page = templates.get_template("report.html").render(
        findings=findings,
        style=style,
        title=findings.case.title or "A contact",
        date=datetime.datetime.now(datetime.UTC).date().isoformat(),
        question=question(findings),
        headline=headline(findings),
        card=say.card(findings),
        main_inputs=main_inputs(findings),
        answer=answer_in_words(findings),
        say=say,
        inputs=[*groups_of_inputs(findings), *groups_of_groups(findings)],
        formulas=_FORMULAS,
        all_of_one=all_of_one(findings),
        pictures=pictures,
        comparison=say.comparison_lines(findings),
        sources=printed(own),
        material_sources=printed(of_materials),
        other_sources=printed(others),
        bibtex=_as_link(entries([*own, *of_materials, *others])),
        name=name,
        again=again,
        case_link=_as_link(findings.text) if findings.text else "",
    )
    return page.lstrip() + "\n"


def _as_link(text: str) -> str:
    """Return a data URL from which a browser can save a text as a file."""
    return f"data:text/plain;charset=utf-8;base64,{base64.b64encode(text.encode()).decode('ascii')}"


def _pictures(findings: ReportData, progress: Progress) -> Iterable[tuple[str, list]]:
    """Yield pairs (name of a section of the report, list of its pictures)."""
    from stiction.report.report_pictures import SECTIONS, pictures_of_scan

    bodies = [f"{body.capitalize()} body" for body in findings.analyses]
    for name in progress("Drawing")([*SECTIONS, *bodies]):
        draw = SECTIONS.get(name) or partial(pictures_of_scan, body=name.partition(" ")[0].lower())
        yield name, list(draw(findings))


def report_record(findings: ReportData) -> ReportAnswer:
    """Return the answer of a report as a dict of numbers and texts for JSON."""
    data, point = findings.data, findings.working_results
    mu = None if point is None or "friction_coefficient" not in point else float(point["friction_coefficient"])
    if findings.prediction is not None:
        mu = answer_record(findings.prediction)["friction_coefficient"]
    unit = data["load"].attrs.get("units", "1")
    own, of_materials, _ = say.sources_of(findings)
    return {
        "title": findings.case.title,
        "question": question(findings),
        "answer": _answer(findings),
        "answer_in_words": answer_in_words(findings),
        "model": data.attrs.get("model", RECOMMENDED),
        "grade": data.attrs.get("grade"),
        "working_load": findings.load,
        "working_load_unit": unit,
        "friction_coefficient": mu,
        "friction_coefficient_rounded": None if point is None or mu is None else rounded(mu, interval_of(point)),
        "validity_warnings": [warning.as_data() for warning in warnings_here(findings)],
        "measured_error": json.loads(findings.result.attrs.get("measured_error", "null")),
        "not_compared": findings.not_compared,
        "sources": [*own, *of_materials],
        "versions": dict(say.versions()),
    }


def _answer(findings: ReportData) -> PredictionAnswer | ModelAnswer | None:
    if findings.prediction is not None:
        return answer_record(findings.prediction)
    return None if findings.case.is_swept else model_record(findings.data)


def check_place(path: Path, case: Any = None) -> None:
    """Raise InputError if no report can be written to this path; call it before computing.

    case: the case, whose file must not be overwritten.
    """
    allowed = "a file that ends in .html or .pdf, new or existing"
    if path.suffix.lower() not in _SUFFIXES:
        raise InputError("--out", str(path), allowed)
    if path.suffix.lower() == ".pdf" and not _browser() and not installed("weasyprint"):
        raise InputError(
            "--out",
            str(path),
            "a file that ends in .html; PDF needs Chromium, Chrome, Edge or weasyprint, and none is installed",
        )
    require_place(path, allowed)
    if path.is_dir():
        raise InputError("--out", str(path), f"{allowed}; this is a folder")
    if isinstance(case, str | os.PathLike) and path.exists() and Path(case).exists() and path.samefile(case):
        raise InputError("--out", str(path), f"{allowed}; this is the case file itself")


def _browser() -> str:
    """Return the path of a browser that prints PDF files; "" if none is installed."""
    return next(filter(None, map(shutil.which, _BROWSERS)), "")


def _printed_page(made: Path) -> Path:
    """Convert an HTML file to PDF in the same folder, and return the path of the PDF; rename the HTML file to end in .html."""
    page, printed_to = made.rename(made.with_suffix(".html")), made.with_suffix(".pdf")
    if browser := _browser():
        words = [browser, "--headless", "--disable-gpu", "--no-pdf-header-footer", f"--user-data-dir={made.parent / 'profile'}"]
        words += ["--no-sandbox"] if hasattr(os, "geteuid") and os.geteuid() == 0 else []  # browsers run by root require this
        subprocess.run([*words, f"--print-to-pdf={printed_to}", page.as_uri()], check=True, capture_output=True, timeout=120)
    else:
        import weasyprint

        weasyprint.HTML(str(page)).write_pdf(str(printed_to))
    return printed_to


def write_html(path: Path, text: str) -> None:
    """Write an HTML text as an .html or .pdf file.

    The file is made in a temporary folder and then moved, so that no incomplete file is left. Raises InputError if the file
    cannot be written.
    """
    check_place(path)
    path = path.resolve()
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=path.parent, prefix=f".{path.name}-") as beside:
            made = Path(beside) / "made"  # write_text gives the usual permissions, a temporary file is private
            made.write_text(text, encoding="utf-8", newline="\n")
            (_printed_page(made) if path.suffix.lower() == ".pdf" else made).replace(path)
    except subprocess.SubprocessError:
        raise InputError("--out", str(path), "a file that ends in .html; the browser failed to print a PDF") from None
    except OSError as error:
        raise InputError(
            "--out", str(path), f"a file that can be written; the system reports: {error.strerror or error}"
        ) from None
