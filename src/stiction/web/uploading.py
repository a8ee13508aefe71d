"""A button that takes a file from the visitor. What is refused is said; it goes to the folder of this visitor alone."""

from collections.abc import Awaitable, Callable

from nicegui import ui
from nicegui.events import UploadEventArguments

from stiction.web.drawn import attributes
from stiction.web.explorer import Explorer


def upload_button(
    explorer: Explorer,
    label: str,
    taken: Callable[[str, str], Awaitable[None]],
    refused: Callable[[str], object],
    most: int,
) -> None:
    """The button. taken(path, name): told where the file is kept and what it was called; refused: told why one is not
    taken; most: bytes."""

    async def arrived(event: UploadEventArguments) -> None:
        path = explorer.upload(event.file.name, await event.file.read())
        # Another one may come, and may be on its way already: `reset` would end it.
        hidden.run_method("removeUploadedFiles")
        await taken(path, event.file.name)

    hidden = ui.upload(auto_upload=True, max_file_size=most, on_upload=arrived)
    hidden.on_rejected(lambda: refused(f"{label}: refused; allowed: one file of {most // 2**20} MiB at most"))

    def failed() -> None:
        hidden.reset()  # else the library takes no other file
        refused(f"{label}: the file did not arrive; try again")

    hidden.on("failed", failed)
    # Of the library's own box only what sends the file is used: it has parts without a name.
    attributes(hidden, aria_label=label).style("display: none")
    button = ui.button(label, icon="upload_file").props("no-caps outline")
    # The browser opens a file chooser only within the click itself, so that no message to the server may come before.
    button.on("click", js_handler=f"() => document.querySelector('#{hidden.html_id} input[type=file]').click()")
