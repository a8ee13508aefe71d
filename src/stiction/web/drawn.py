"""A chart on the page, which is drawn anew when its options change."""

from typing import Any

from nicegui import ui

__all__ = ["Picture", "attributes", "wide"]


def attributes(element: Any, **given: Any) -> Any:
    """The element with these attributes, an underscore for a hyphen. As values, never as text to be parsed: they may hold what
    a user wrote."""
    changed = {name.replace("_", "-"): value for name, value in given.items()}
    if any(element.props.get(name) != value for name, value in changed.items()):
        element.props.update(changed)
        element.update()
    return element


def wide(name: str) -> Any:
    """A frame for what is not read when it is as narrow as a telephone: there it is moved sideways, also by keyboard."""
    return attributes(ui.element("div").classes("wide"), tabindex=0, role="group", aria_label=name)


class Picture:
    """A chart with a name for who does not see it; hidden while there is nothing to draw."""

    def __init__(self, name: str, height: str = "300px"):
        self.element = ui.echart({}).classes("w-full").style(f"height: {height}")
        attributes(self.element, role="img", aria_label=name)

    def show(self, options: dict[str, Any] | None) -> None:
        """Draw these options; None for nothing."""
        self.element.set_visibility(options is not None)
        if options is not None and options != dict(self.element.options):
            self.element.options.clear()
            self.element.options.update(options)
            told = options.get("aria", {}).get("label", {}).get("description", "")
            attributes(self.element, aria_label=told)
            self.element.update()
