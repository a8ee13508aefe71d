"""A chart on the page, which is drawn anew when its options change."""

from typing import Any

from nicegui import ui

__all__ = ["Picture"]


class Picture:
    """A chart with a name for who does not see it; hidden while there is nothing to draw."""

    def __init__(self, name: str, height: str = "300px"):
        self.element = ui.echart({}).classes("w-full").style(f"height: {height}")
        self.element.props(f'role="img" aria-label="{name}"')

    def show(self, options: dict[str, Any] | None) -> None:
        """Draw these options; None for nothing."""
        self.element.set_visibility(options is not None)
        if options is not None and options != dict(self.element.options):
            self.element.options.clear()
            self.element.options.update(options)
            told = options.get("aria", {}).get("label", {}).get("description", "")
            self.element.props(f'aria-label="{told}"')
            self.element.update()
