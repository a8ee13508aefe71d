"""Define page elements that are rebuilt when their content changes, and a button that uploads a file."""

from collections.abc import Awaitable, Callable
from typing import Any

from nicegui import ui
from nicegui.events import UploadEventArguments

from stiction.web.chart_layout import NARROW, fitted
from stiction.web.explorer import Explorer


def attributes(element: Any, **given: Any) -> Any:
    """Set HTML attributes of a page element, with hyphens for underscores, and return the element.

    given: values by name of the attribute. They are set directly and never parsed, because they may contain text of a user.
    """
    changed = {name.replace("_", "-"): value for name, value in given.items()}
    if any(element.props.get(name) != value for name, value in changed.items()):
        element.props.update(changed)
        element.update()
    return element


def folded(title: str, fill: Callable[[], object], is_open: bool = False, name: str = "") -> Any:
    """Add a folded section, and return it; its elements are added when it is first opened, because all of them take time.

    fill: function that adds the elements. is_open: whether the section is open from the start. name: name for screen readers,
    by default the title.
    """
    section = ui.expansion(title, value=is_open).classes("w-full").props("dense dense-toggle")
    waiting = [fill]

    def opened() -> None:
        if section.value and waiting:
            with section:
                waiting.pop()()

    section.on_value_change(opened)
    opened()
    return attributes(section, aria_label=name or title)


class Rows:
    """Hold a page element whose rows are rebuilt when they change.

    element: the page element. add: function that adds the elements of one row.
    """

    def __init__(self, element: Any, add: Callable[[Any], object]):
        self._element, self._add = element, add
        self._shown: list[Any] = []

    def show(self, rows: list[Any]) -> None:
        """Show these rows in place of the present ones."""
        if rows != self._shown:
            self._shown = rows
            self._element.clear()
            with self._element:
                for row in rows:
                    self._add(row)


class Picture:
    """Show a chart, which is hidden while there is nothing to draw.

    name: description for screen readers. height: CSS height; "" if a CSS class sets it. room: pixels for a legend line on a
    wide page.
    """

    def __init__(self, name: str, height: str = "300px", room: int = NARROW):
        self.element = ui.echart({}).classes("w-full").style(f"height: {height}" if height else "")
        self._room = room
        attributes(self.element, role="img", aria_label=name)

    def show(self, options: dict[str, Any] | None) -> None:
        """Draw a chart with these ECharts options, fitted to the page width; None hides the chart."""
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

    explorer: state of the visitor, which stores the file. uploaded: receives the path of the stored file and its original name.
    refuse: receives an error message.
    """

    async def arrived(event: UploadEventArguments) -> None:
        path = explorer.upload(event.file.name, await event.file.read())
        # `reset` would abort a second upload that is already on its way.
        hidden.run_method("removeUploadedFiles")
        await uploaded(path, event.file.name)

    hidden = ui.upload(auto_upload=True, max_file_size=most, on_upload=arrived)
    hidden.on_rejected(lambda: refuse(f"{label}: refused; allowed: one file of {most // 2**20} MiB at most"))

    def failed() -> None:
        hidden.reset()  # without this the library accepts no other file
        refuse(f"{label}: the file did not arrive; try again")

    hidden.on("failed", failed)
    # The library's own upload box is hidden, because some of its parts have no name for screen readers.
    attributes(hidden, aria_label=label).style("display: none")
    button = ui.button(label, icon="upload_file").props("no-caps outline")
    # This runs in the browser, which opens a file chooser only during the click itself, without a call to the server.
    button.on("click", js_handler=f"() => document.querySelector('#{hidden.html_id} input[type=file]').click()")
