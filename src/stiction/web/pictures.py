"""What a view shows, on the page: its tables, sentences and pictures, and pictures of the room `report` alone."""

import base64
import io
from collections.abc import Callable
from typing import Any, NamedTuple

from nicegui import ui

from stiction.report.html_words import on_page
from stiction.report.table import Table
from stiction.report.view import View
from stiction.web.drawn import attributes

_NARROW = 5.6  # inches: on a page as narrow as a telephone letters of eight points can then be read
_PANEL = 3.9  # inches, the height of a panel there
_FEW = 3  # steps of an axis there
# The first cell of a row as a button, which a keyboard reaches; the name is bound as text.
_BUTTON = """<q-btn flat dense no-caps align="left" color="primary" style="text-align: left" :label="props.row[0]"
  @click="() => $parent.$emit('opened', props.row[0])" />"""
# A row on a narrow page: its cells below one another.
_CARD = """<q-card flat bordered class="w-full q-pa-sm q-mb-sm">HEAD<div v-for="one in props.cols.slice(FIRST)" :key="one.name">
  <b v-if="one.label">{{ one.label }}:</b> {{ one.value }}</div></q-card>"""


class Shown(NamedTuple):
    """What is shown of a view: tables and sentences, images, each with what it shows in words, and what is wrong with it."""

    parts: list[Any]
    pictures: list[tuple[str, str]]
    warnings: tuple[str, ...] = ()

    @classmethod
    def of(cls, view: View, narrow: bool) -> "Shown":
        """Draw a view for a narrow page or a wide one."""
        pictures = [(image_of(one.draw(), narrow), one.told) for one in view.pictures.values()]
        return cls(list(view.parts()), pictures, view.warnings)

    def show(self, narrow: bool, opened: Callable[[str], object] | None = None) -> None:
        """Add it to the page; opened: told the name of a model that is chosen in a table."""
        for words in self.warnings:
            ui.label(words).classes("text-lg text-negative").props('role="alert"')
        with ui.column().classes("w-full gap-1"):
            for part in self.parts:
                if isinstance(part, Table):
                    _show_table(on_page(part, ""), narrow, opened)
                elif str(part):
                    ui.label(str(part)).classes("text-sm").style("white-space: pre-line")
        for source, told in self.pictures:
            show_image(source, told)


def _show_table(table: Table, narrow: bool, opened: Callable[[str], object] | None) -> None:
    """Add a table of the terminal to the page; on a narrow one its cells stand below one another."""
    columns = [
        {"name": str(at), "label": column.head, "field": str(at), "align": "right" if column.right else "left"}
        for at, column in enumerate(table.columns)
    ]
    rows = [{str(at): cell for at, cell in enumerate(row)} for row in table.rows]
    with ui.element("div").classes("w-full overflow-auto table").props("tabindex=0"):  # a keyboard moves it where it is narrow
        shown = ui.table(columns=columns, rows=rows).classes("w-full").props("dense flat wrap-cells")
    shown.props("grid" if narrow else "" if any(table.heads) else "hide-header")
    chosen = opened is not None and table.heads[0].startswith("model")
    shown.add_slot("item", _CARD.replace("HEAD", _BUTTON if chosen else "").replace("FIRST", "1" if chosen else "0"))
    if chosen and opened is not None:
        shown.add_slot("body-cell-0", f'<q-td :props="props">{_BUTTON}</q-td>')
        shown.on("opened", lambda event: opened(event.args))


def image_of(figure: Any, narrow: bool = False) -> str:
    """A figure as the address of an image: as an image, nothing in it is ever executed. narrow: for a narrow page."""
    made = io.BytesIO()
    if narrow and figure.get_figwidth() > _NARROW:
        _make_narrow(figure)
    figure.savefig(made, format="png", dpi=160 if narrow else 110)
    return f"data:image/png;base64,{base64.b64encode(made.getvalue()).decode()}"


def _make_narrow(figure: Any) -> None:
    """Panels below one another, where each stands by itself, fewer ticks, and a title that is broken."""
    from matplotlib.ticker import AutoLocator, MaxNLocator

    width, height = figure.get_size_inches()
    panels = [axes for axes in figure.axes if axes.get_subplotspec() is not None]
    alone = len(panels) == len(figure.axes) > 1 and figure.get_layout_engine() is not None
    if alone:
        below = figure.add_gridspec(len(panels), 1)
        for at, axes in enumerate(panels):
            axes.set_subplotspec(below[at])
    figure.set_size_inches(_NARROW, _PANEL * len(panels) if alone else max(0.75 * _NARROW, _NARROW * height / width))
    if (title := figure.get_suptitle()) and alone:
        figure.suptitle(title, fontsize=9, wrap=True)
    for axis in (one for axes in figure.axes for one in (axes.xaxis, axes.yaxis)):
        if axis.get_scale() == "linear" and isinstance(axis.get_major_locator(), AutoLocator):
            axis.set_major_locator(MaxNLocator(_FEW))


def show_image(source: str, told: str) -> None:
    """An image, with what it shows for who does not see it."""
    image = (
        ui.image(source).classes("w-full picture").style("max-width: 900px; background: white").props("no-spinner fit=contain")
    )
    attributes(image, alt=told)
