"""Pictures and tables of the room `report` for the page: a matplotlib figure as an image, a table of the terminal as text."""

import base64
import io
from collections.abc import Iterable
from typing import Any

from nicegui import ui

from stiction.web.drawn import attributes, wide

__all__ = ["image_of", "show_image", "text_of"]


def image_of(figure: Any) -> str:
    """A figure as the address of an image: as an image, nothing in it is ever executed."""
    made = io.BytesIO()
    figure.savefig(made, format="png", dpi=110)
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
    with wide(told):
        image = ui.image(source).classes("w-full").style("max-width: 900px; background: white").props("no-spinner fit=contain")
    attributes(image, alt=told)
