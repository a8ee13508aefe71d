"""Page elements that follow their content, and a button that uploads a file."""

from collections.abc import Awaitable, Callable
from typing import Any

from nicegui import ui
from nicegui.events import UploadEventArguments

from stiction.web.chart_layout import NARROW, fitted
from stiction.web.explorer import Explorer


def attributes(element: Any, **given: Any) -> Any:
    """Set HTML attributes of an element, with hyphens for underscores; return the element.

    Values are set directly and never parsed, because they may contain text of a user.
    """
    changed = {name.replace("_", "-"): value for name, value in given.items()}
    if any(element.props.get(name) != value for name, value in changed.items()):
        element.props.update(changed)
        element.update()
    return element


class Rows:
    """Hold a page element whose rows are rebuilt when they change.

    add: function that adds the elements of one row.
    """

    def __init__(self, element: Any, add: Callable[[Any], object]):
        self._element, self._add = element, add
        self._shown: list[Any] = []

    def show(self, rows: list[Any]) -> None:
        """Show these rows."""
        if rows != self._shown:
            self._shown = rows
            self._element.clear()
            with self._element:
                for row in rows:
                    self._add(row)


class Picture:
    """Show a chart, hidden while there is nothing to draw.

    name: description for screen readers. height: CSS height, "" if a class sets it. room: pixels for the legend on a
    wide page.
    """

    def __init__(self, name: str, height: str = "300px", room: int = NARROW):
        self.element = ui.echart({}).classes("w-full").style(f"height: {height}" if height else "")
        self._room = room
        attributes(self.element, role="img", aria_label=name)

    def show(self, options: dict[str, Any] | None) -> None:
        """Draw a chart with these options, fitted to the page width; None hides the chart."""
        self.element.set_visibility(options is not None)
        options = options and fitted(options, self._room)
        if options is not None and options != dict(self.element.options):
            self.element.options.clear()
            self.element.options.update(options)
            attributes(self.element, aria_label=options.get("aria", {}).get("label", {}).get("description", ""))
            self.element.update()


def upload_button(
    explorer: Explorer,
    label: str,
    uploaded: Callable[[str, str], Awaitable[None]],
    refuse: Callable[[str], object],
    most: int,
) -> None:
    """Add a button that uploads a file of at most `most` bytes.

    uploaded: receives the path of the stored file and its original name. refuse: receives an error message.
    """

    async def arrived(event: UploadEventArguments) -> None:
        path = explorer.upload(event.file.name, await event.file.read())
        # Another one may come, and may be on its way already: `reset` would end it.
        hidden.run_method("removeUploadedFiles")
        await uploaded(path, event.file.name)

    hidden = ui.upload(auto_upload=True, max_file_size=most, on_upload=arrived)
    hidden.on_rejected(lambda: refuse(f"{label}: refused; allowed: one file of {most // 2**20} MiB at most"))

    def failed() -> None:
        hidden.reset()  # else the library takes no other file
        refuse(f"{label}: the file did not arrive; try again")

    hidden.on("failed", failed)
    # Of the library's own box only what sends the file is used: it has parts without a name.
    attributes(hidden, aria_label=label).style("display: none")
    button = ui.button(label, icon="upload_file").props("no-caps outline")
    # The browser opens a file chooser only within the click itself, so that no message to the server may come before.
    button.on("click", js_handler=f"() => document.querySelector('#{hidden.html_id} input[type=file]').click()")
