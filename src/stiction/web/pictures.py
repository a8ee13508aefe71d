"""Pictures and tables of the room `report` for the page: a matplotlib figure as an image, a table of the terminal as text."""

import base64
import io
from collections.abc import Iterable
from typing import Any

from nicegui import ui

from stiction.web.drawn import attributes

__all__ = ["image_of", "show_image", "text_of"]


_NARROW = 5.6  # inches: on a page as narrow as a telephone letters of eight points can then be read
_FEW = 4  # ticks of an axis there


def image_of(figure: Any, narrow: bool = False) -> str:
    """A figure as the address of an image: as an image, nothing in it is ever executed. narrow: for a narrow page."""
    from matplotlib.ticker import AutoLocator, MaxNLocator

    made = io.BytesIO()
    width, height = figure.get_size_inches()
    if narrow and width > _NARROW:
        figure.set_size_inches(_NARROW, max(0.75 * _NARROW, _NARROW * height / width))
        for axis in (one for axes in figure.axes for one in (axes.xaxis, axes.yaxis)):
            if (
                axis.get_scale() == "linear"
                and len(axis.get_majorticklocs()) > _FEW
                and isinstance(axis.get_major_locator(), AutoLocator)
            ):
                axis.set_major_locator(MaxNLocator(_FEW - 1))
    figure.savefig(made, format="png", dpi=160 if narrow else 110)
    return f"data:image/png;base64,{base64.b64encode(made.getvalue()).decode()}"


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
