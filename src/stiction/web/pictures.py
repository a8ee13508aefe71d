"""Pictures and tables of the room `report` for the page: a matplotlib figure as an image, a table of the terminal as text."""

import base64
import io
from collections.abc import Iterable
from typing import Any

from nicegui import ui

from stiction.web.drawn import attributes

__all__ = ["image_of", "show_image", "text_of"]


_NARROW = 5.6  # inches: on a page as narrow as a telephone letters of eight points can then be read
_PANEL = 3.9  # inches, the height of a panel there
_FEW = 3  # steps of an axis there


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


def text_of(parts: Iterable[Any], width: int = 118) -> str:
    """What the terminal would show of tables and notes."""
    from rich.console import Console

    made = Console(file=io.StringIO(), width=width, color_system=None, force_terminal=False)
    for one in parts:
        made.print(one)
    text: str = made.file.getvalue()  # type: ignore[attr-defined]
    return text


def show_image(source: str, told: str) -> None:
    """An image, with what it shows for who does not see it."""
    image = ui.image(source).classes("w-full").style("max-width: 900px; background: white").props("no-spinner fit=contain")
    attributes(image, alt=told)
