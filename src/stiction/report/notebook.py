"""Summarise a result for a notebook: meaning, ranges and validity warnings.

Results are xarray datasets. The notebook view of xarray hides the attributes of a dataset, which include the warnings.
"""

from html import escape
from textwrap import fill
from typing import TYPE_CHECKING

from stiction.laws.validity import warnings_of
from stiction.quantities import html
from stiction.quantities.errors import InputError
from stiction.records.registry import GRADES
from stiction.report.answer import answer_lines
from stiction.report.card import Card, card_of
from stiction.report.html_words import unbroken
from stiction.solving.unused import unused_of

if TYPE_CHECKING:
    import xarray

_WIDTH = 100  # columns of a summary as text
_SHOWN = ("mean_separation", "load", "contact_area", "friction_force", "friction_coefficient", "touching_asperities")


class Summary:
    """Store a summary of a result: a title, pairs (heading, text), a list of notes, and the summary card of a prediction.

    A notebook shows the summary as HTML, and `print` shows it as text.
    """

    def __init__(self, title: str, rows: list[tuple[str, str]], notes: list[str], card: Card | None = None):
        self.title, self.rows, self.notes, self.card = title, rows, notes, card

    def _repr_html_(self) -> str:
        if self.card is not None:
            return f"<strong>{escape(self.title)}</strong>{self.card.html()}"
        return html.table(self.title, self.rows, self.notes)

    def __repr__(self) -> str:
        width = max((len(name) for name, _ in self.rows), default=0)
        rows = [f"  {name:{width}}  {unbroken(text)}" for name, text in self.rows]
        rows = [fill(row, _WIDTH, subsequent_indent=" " * (width + 4), break_on_hyphens=False) for row in rows]
        return "\n".join([self.title, *rows, *(f"- {note}" for note in self.notes)]).replace("\N{NO-BREAK SPACE}", " ")


def summary(result: "xarray.Dataset") -> Summary:
    """Return a short summary of a result.

    Parameters
    ----------
    result : xarray.Dataset
        Result of `predict`, `solve` or `compare`.

    Returns
    -------
    Summary
        For `predict`: the answer. For other results: model, grade, ranges of the results, and validity warnings. A notebook
        shows it as HTML.

    Raises
    ------
    InputError
        The argument is not an xarray object.

    Examples
    --------
    >>> import stiction as st
    >>> print(st.summary(st.solve(st.Indices(theta=40, lam=10), load=1e-3)).title)
    Static friction after soft_coating_2015
    """
    if not hasattr(result, "attrs"):
        raise InputError("result", result, "a result of predict, solve or compare")
    used = result.attrs
    if "regime" in used:
        return Summary(used.get("case") or "Prediction", answer_lines(result), [], card_of(result))
    named = ("model", "asperity", "tangential", "film", "roughness_method")
    rows = [(name.replace("_", " "), str(used[name])) for name in named if used.get(name, "none") not in ("", "none")]
    if "grade" in used:
        rows.append(("grade", f"{used['grade']}: {GRADES.get(used['grade'], '')}"))
    rows += [(name, _range(result[name])) for name in _SHOWN if name in result and result[name].size]
    notes = [f"validity warning: {warning}" for warning in warnings_of(result)]
    notes += [str(warning) for warning in unused_of(result)]
    notes += [used["remarks"]] if used.get("remarks") else []
    return Summary(used.get("case") or used.get("title") or "Result", rows, notes)


def _range(values: "xarray.DataArray") -> str:
    """Format the smallest and the largest value of a variable with unit and names of its dimensions: "1 to 5 N, along load"."""
    unit = values.attrs.get("units", "1")
    ends = [f"{float(end):.4g}" for end in (values.min(), values.max())]
    along = f", along {', '.join(map(str, values.dims))}" if values.dims else ""
    return " to ".join(dict.fromkeys(ends)) + ("" if unit == "1" else f" {unit}") + along
