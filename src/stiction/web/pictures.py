"""Show a view on the page: the texts, tables and pictures of a result."""

import textwrap
from collections.abc import Callable
from itertools import count
from typing import Any, NamedTuple

from nicegui import ui

from stiction.report.html_words import on_page
from stiction.report.report_pictures import inline
from stiction.report.table import Table
from stiction.report.view import View

_NARROW = 5.6  # inches; letters of eight points can then be read on a phone
_LETTERS = 72  # largest number of characters of a title line on a narrow page
_PANEL = 3.9  # inches, the height of a panel on a narrow page
_FEW = 3  # steps of an axis on a narrow page
_PIXELS = 105  # pixels of the page for an inch of a picture
_NUMBERS = count()  # numbers that make the names in drawings unique on a page
# The first cell of a row as a button, which a keyboard can reach. The name is bound as text and never parsed.
_BUTTON = """<q-btn flat dense no-caps align="left" color="primary" style="text-align: left" :label="props.row[0]"
  @click="() => $parent.$emit('opened', props.row[0])" />"""
# A row on a narrow page: its cells below one another.
_CARD = """<q-card flat bordered class="w-full q-pa-sm q-mb-sm">HEAD<div v-for="one in props.cols.slice(FIRST)" :key="one.name">
  <b v-if="one.label">{{ one.label }}:</b> {{ one.value }}</div></q-card>"""


class Shown(NamedTuple):
    """Hold the parts of a view that the page shows: tables and sentences, drawings as HTML, and warnings."""

    parts: list[Any]
    drawings: list[str]
    warnings: tuple[str, ...] = ()

    @classmethod
    def of(cls, view: View, narrow: bool) -> "Shown":
        """Return the tables, sentences, drawings and warnings of a view, with drawings for a narrow or a wide page."""
        drawings = [drawing_of(picture.draw(), picture.description, narrow) for picture in view.pictures.values()]
        return cls(list(view.parts()), drawings, view.warnings)

    def show(self, narrow: bool, opened: Callable[[str], object] | None = None) -> None:
        """Add warnings, tables, drawings and sentences to the page.

        narrow: whether the page is narrow. opened: receives the name of a model that the visitor selects in a table.
        """
        for text in self.warnings:
            ui.label(text).classes("text-lg text-negative").props('role="alert"')
        for table in (part for part in self.parts if isinstance(part, Table)):
            _show_table(on_page(table, ""), narrow, opened)
        for drawing in self.drawings:
            show_drawing(drawing)
        if notes := [str(part) for part in self.parts if part and not isinstance(part, Table)]:
            with ui.expansion("Notes").classes("w-full").props("dense dense-toggle"):
                for text in notes:
                    ui.label(text).classes("text-sm")


def _show_table(table: Table, narrow: bool, opened: Callable[[str], object] | None) -> None:
    """Add a table to the page; on a narrow page the cells of a row stand below one another."""
    columns = [
        {"name": str(at), "label": column.head, "field": str(at)}
        | ({"align": "right", "style": "white-space: nowrap"} if column.right else {"align": "left"})
        for at, column in enumerate(table.columns)
    ]
    rows = [{str(at): cell for at, cell in enumerate(row)} for row in table.rows]
    with ui.element("div").classes("w-full overflow-auto table").props("tabindex=0"):  # tabindex: a keyboard can scroll it
        shown = ui.table(columns=columns, rows=rows).classes("w-full").props("dense flat wrap-cells")
    shown.props("grid" if narrow else "" if any(table.heads) else "hide-header")
    chosen = opened is not None and table.heads[0].startswith("model")
    shown.add_slot("item", _CARD.replace("HEAD", _BUTTON if chosen else "").replace("FIRST", "1" if chosen else "0"))
    if chosen and opened is not None:
        shown.add_slot("body-cell-0", f'<q-td :props="props">{_BUTTON}</q-td>')
        shown.on("opened", lambda event: opened(event.args))


def drawing_of(figure: Any, description: str, narrow: bool = False) -> str:
    """Return a matplotlib figure as HTML: a drawing in the colours of the page, or an image if the drawing is large.

    description: description for screen readers. narrow: whether the page is narrow.
    """
    if narrow and figure.get_figwidth() > _NARROW:
        _make_narrow(figure)
    width = _PIXELS * figure.get_figwidth()
    return f'<div style="max-width: {width:.0f}px">{inline(figure, f"drawing{next(_NUMBERS)}", description)}</div>'


def _make_narrow(figure: Any) -> None:
    """Make a figure narrow: fewer ticks, titles broken into lines, and panels below one another.

    Panels stay in place if the figure has other axes, such as a colour bar, or no layout engine.
    """
    from matplotlib.ticker import AutoLocator, MaxNLocator

    width, height = figure.get_size_inches()
    panels = [axes for axes in figure.axes if axes.get_subplotspec() is not None]
    alone = len(panels) == len(figure.axes) > 1 and figure.get_layout_engine() is not None
    if alone:
        below = figure.add_gridspec(len(panels), 1)
        for at, axes in enumerate(panels):
            axes.set_subplotspec(below[at])
    figure.set_size_inches(_NARROW, _PANEL * len(panels) if alone else max(0.75 * _NARROW, _NARROW * height / width))
    if title := figure.get_suptitle():
        figure.suptitle(_in_lines(title, _LETTERS), fontsize=9)
    for axes in figure.axes:
        axes.title.set_text(_in_lines(axes.get_title(), _LETTERS - 10))
    for axis in (one for axes in figure.axes for one in (axes.xaxis, axes.yaxis)):
        if axis.get_scale() == "linear" and isinstance(axis.get_major_locator(), AutoLocator):
            axis.set_major_locator(MaxNLocator(_FEW))


def _in_lines(text: str, most: int) -> str:
    return "\n".join(line for part in text.splitlines() for line in textwrap.wrap(part, most))


def show_drawing(drawing: str) -> None:
    """Add an HTML drawing to the page."""
    ui.html(drawing, sanitize=False).classes("w-full picture")
