"""Draw the pictures of a report as HTML, with captions and descriptions for screen readers."""

import base64
import html
import io
import re
import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from stiction.report.answer import at_working_load
from stiction.report.html_words import letters
from stiction.report.method_pictures import method_spread_figure
from stiction.report.model_pictures import models_figure
from stiction.report.pictures import panel_of_curve, panels, uncertainty_figure
from stiction.report.prediction_pictures import answer_figure, sources_figure
from stiction.report.report_answer import value_in_words
from stiction.report.share_pictures import part_in_words, share_figure, shares_of, stacks
from stiction.report.surface_pictures import asperity_figure, map_figure, spectrum_figure
from stiction.report.swept_pictures import swept_figure
from stiction.report.swept_tables import shown_quantity
from stiction.studies.report_data import ReportData

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure


_MOST = 300_000  # characters of an SVG above which a PNG is used
_DOTS_PER_INCH = 160
# Parts of an SVG that the page does not need; a style element would apply to the whole page.
_LEFT_OUT = re.compile(r"<\?xml.*?\?>|<!DOCTYPE.*?>|<!--.*?-->|<metadata>.*?</metadata>|<style.*?</style>", re.DOTALL)
_OWN_ID = re.compile(r' id="([^"]*)"')
_REFERENCE = re.compile(r'(?:xlink:href="|url\()#([^")]*)')
_COLOURS = {"#000000": "currentColor", "#ffffff": "var(--paper)"}


def inline(figure: "Figure", name: str, words: str) -> str:
    """Convert a figure to HTML: SVG in the colours of the page, or PNG in its own colours if the SVG is large.

    name: letters, unique on the page, for the names inside the SVG. words: description for screen readers. Equal figures give
    equal HTML.
    """
    drawn = io.StringIO()
    figure.savefig(drawn, format="svg", transparent=True)
    text = drawn.getvalue()
    return _image(figure, words) if len(text) > _MOST else _drawing(text, name, words)


def _drawing(text: str, name: str, words: str) -> str:
    text = _LEFT_OUT.sub("", text)
    used = dict.fromkeys(_REFERENCE.findall(text))
    short = {old: f"{name}-{number}" for number, old in enumerate(used)}
    text = _OWN_ID.sub(lambda match: f' id="{short[match[1]]}"' if match[1] in short else "", text)
    text = re.sub(r'xlink:href="#([^"]*)"', lambda match: f'href="#{short[match[1]]}"', text)
    text = re.sub(r"url\(#([^)]*)\)", lambda match: f"url(#{short[match[1]]})", text)
    for colour, of_page in _COLOURS.items():
        text = text.replace(colour, of_page)
    size = re.search(r'viewBox="([^"]*)"', text)
    assert size is not None  # matplotlib always writes a viewBox
    head = f'<svg role="img" aria-label="{html.escape(words)}" viewBox="{size[1]}">'
    return re.sub(r"\s*\n\s*", "\n", re.sub(r"<svg.*?>", lambda _: head, text, count=1, flags=re.DOTALL)).strip()


def _image(figure: "Figure", words: str) -> str:
    drawn = io.BytesIO()
    figure.savefig(drawn, format="png", dpi=_DOTS_PER_INCH, metadata={"Software": None})
    data = base64.b64encode(drawn.getvalue()).decode("ascii")
    return f'<img alt="{html.escape(words)}" src="data:image/png;base64,{data}">'


_TITLES = {
    "friction_coefficient": "Static friction coefficient against load",
    "contact_area": "Real contact area against load",
    "load": "Load against mean separation",
    "friction_force": "Friction force against load",
}
_FEW = 2  # smallest number of loads for a chart of shares
_NEARLY_ALL = 0.995  # share of one part above which the others are too thin to see


@dataclass(frozen=True)
class Picture:
    """Store a picture of the report as HTML with its caption.

    wide: whether the picture spans the page; on narrow pages it can be scrolled.
    """

    content: str
    caption: str
    wide: bool = False


def _picture(make: "Callable[[], Figure]", name: str, caption: str, words: str = "", wide: bool = False) -> Picture:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # matplotlib warns of letters that its font lacks, and draws boxes
        return Picture(inline(make(), name, words or caption), letters(caption), wide)


def _in_words(data: "xarray.Dataset", what: str, against: str) -> str:
    """Describe a curve by its values at both ends, for screen readers.

    what, against: names of the variables along y and along x.
    """
    x, y = (np.asarray(data[name].values, dtype=float) for name in (against, what))
    known = np.flatnonzero(np.isfinite(x) & np.isfinite(y) & ((x > 0.0) | (against != "load")))
    if not known.size:
        return "The picture is empty, because no load is compressive."
    first, last = known[np.argmin(x[known])], known[np.argmax(x[known])]
    ends = [(value_in_words(data[against], x[point]), value_in_words(data[what], y[point])) for point in (first, last)]
    return f"At {ends[0][0]} it is {ends[0][1]}, at {ends[1][0]} it is {ends[1][1]}."


def pictures_of_curve(findings: ReportData) -> Iterator[Picture]:
    """Yield the pictures of the curve of one model: one for each panel, and one for each chart of stacked parts.

    A chart is omitted for fewer than two compressive loads, or if one part is more than 99.5 % of the sum. A case with array
    parameters has a single picture. A prediction has none, because `pictures_of_answer` draws its curve.
    """
    # The page states the validity warnings once, not below every picture.
    data = findings.data.assign_attrs(validity_warnings="[]", outside_validity="")
    if findings.prediction is not None:
        return  # its curve is on the first page
    if findings.case.is_swept:
        name = "friction" if shown_quantity(data) == "friction_coefficient" else "contact area"
        yield _picture(lambda: swept_figure(data), "several", f"{name.capitalize()} against the varied parameters.", wide=True)
        return
    pressing = int(np.count_nonzero(np.asarray(data["load"].values) > 0.0))
    for what, against in panels(data):
        if against == "load" and not pressing:
            continue
        title = _TITLES[what]
        make = partial(panel_of_curve, data, what, against)
        yield _picture(make, f"p-{what}", f"{title}.", f"{title}. {_in_words(data, what, against)}")
    for number, (what, (total, parts)) in enumerate(stacks(data).items()):
        if pressing < _FEW or _the_one(data, parts):
            continue  # `all_of_one` describes it in a sentence
        names = ", ".join(part_in_words(name, total) for name in parts)
        tension = any(np.nanmin(data[name].values, initial=0.0) < 0.0 for name in parts)
        words = f"Shares of the {what} against the load: {names}" + (
            "; shares of absolute values, because some parts are in tension." if tension else "."
        )
        yield _picture(partial(share_figure, data, what), f"share{number}", words)


def _the_one(data: "xarray.Dataset", parts: list[str]) -> str:
    """Return the name of the part that exceeds 99.5 % of the sum of absolute values at every compressive load; "" if none does.

    parts: names of the summed variables, for example the elastic and the plastic contact area.
    """
    shares = shares_of(data, parts)[:, np.asarray(data["load"].values) > 0.0]
    return next((name for name, share in zip(parts, shares, strict=True) if share.size and np.nanmin(share) > _NEARLY_ALL), "")


def all_of_one(findings: ReportData) -> list[str]:
    """Return sentences that explain which pictures of a report are omitted; [] for a prediction or a sweep.

    All curves are omitted if no load is compressive. A chart of stacked parts is omitted if one part exceeds 99.5 % everywhere.
    """
    data, lines = findings.data, []
    if findings.prediction is not None:
        return []
    if not findings.case.is_swept and not (np.asarray(data["load"].values) > 0.0).any():
        return ["The case has no compressive load, so no curve is drawn against load."]
    for what, (total, parts) in stacks(data).items() if not findings.case.is_swept else ():
        if name := _the_one(data, parts):
            lines.append(
                f"Shares of the {what}: {part_in_words(name, total)} makes up more than {_NEARLY_ALL:.1%} at every load."
            )
    return lines


def pictures_of_answer(findings: ReportData) -> Iterator[Picture]:
    """Yield the pictures of the first page: mu against load, and the sources of its interval; none without a prediction.

    For a single load without a curve of the prediction, the first picture shows samples of mu.
    """
    data, prediction = findings.data if findings.curve is None else findings.curve, findings.recommended
    if prediction is None:
        return
    drawn = "mu against load" if data is not prediction or data["load"].size > 1 else "Samples of mu"
    yield _picture(lambda: answer_figure(data, prediction), "answer", f"{drawn}.")
    caption = "The interval of mu, and the part of it that each main source of uncertainty would cause alone."
    yield _picture(lambda: sources_figure(prediction), "answer-sources", caption)


def pictures_of_comparison(findings: ReportData) -> Iterator[Picture]:
    """Yield the picture of mu by all possible models, with the prediction; none if models were not compared."""
    data_of_models, data = findings.comparison, findings.recommended
    if data_of_models is None:
        return
    from stiction.report.views.comparison import groups_of

    point = None if data is None else at_working_load(data)
    words = "Friction against load by each possible model, and the prediction with its interval (numbers: table of all models)."
    yield _picture(
        lambda: models_figure(data_of_models, groups_of(data_of_models), point, "", findings.curve), "models", words, wide=True
    )


def pictures_of_uncertainty(findings: ReportData) -> Iterator[Picture]:
    """Yield a picture of friction with its interval from uncertain inputs, and one of friction by each asperity method.

    A picture is left out if the result does not have its data.
    """
    data = findings.data
    if "friction_coefficient_quantile" in data and not findings.case.is_swept:
        caption = "The friction coefficient with its band over the uncertain inputs."
        yield _picture(lambda: uncertainty_figure(data), "band", caption)
    if "friction_coefficient_by_method" in data:
        plain = data.assign_attrs(validity_warnings="[]")
        caption = "Friction against load by each method of finding asperities in the scans."
        yield _picture(lambda: method_spread_figure(plain), "methods", caption, wide=True)


def pictures_of_scan(findings: ReportData, body: str) -> Iterator[Picture]:
    """Yield pictures of the scan of one body, "first" or "second": heights, spectrum and asperities."""
    analysis = findings.analyses[body]
    surface = replace(analysis.surface, name="")
    caption = f"Heights of the {body} body as prepared, and their histogram."
    yield _picture(lambda: map_figure(surface, " "), f"map-{body}", caption, wide=True)
    yield _picture(
        lambda: spectrum_figure(analysis.spectrum, " "), f"spectrum-{body}", f"Power spectrum of the {body} body.", wide=True
    )
    if analysis.asperities:
        yield _picture(lambda: asperity_figure(analysis.asperities.values(), surface, " "), f"asperities-{body}",
                       f"Asperities that each method finds in the {body} body.", wide=True)  # fmt: skip


# Section of the report -> its pictures.
SECTIONS = {
    "answer": pictures_of_answer,
    "curve": pictures_of_curve,
    "comparison": pictures_of_comparison,
    "uncertainty": pictures_of_uncertainty,
}
