"""Build the tab Share: the address of this page, and the files that the command line writes too."""

import tempfile
from pathlib import Path
from typing import Any

from nicegui import ui

from stiction.case.text import as_toml
from stiction.quantities.errors import InputError
from stiction.report.view import View
from stiction.report.views.prediction import prediction_view
from stiction.report.views.run import run_view
from stiction.web.address import files_named
from stiction.web.background import Progress, run
from stiction.web.elements import attributes
from stiction.web.explorer import Explorer
from stiction.web.query import Answer
from stiction.web.study_button import Study

KINDS = ("case.toml", "curve.csv", "curve.nc", "curve.svg", "curve.png")


def _view(answer: Answer) -> View:
    """Return the view (texts, tables, files and pictures) that `stiction run` shows of the case."""
    if answer.is_prediction:
        return prediction_view(answer.case, answer.data, KINDS[0], curve=answer.curve_data)
    return run_view(answer.case, answer.data)


def content(answer: Answer, name: str) -> bytes:
    """Return the content of the file `name`, one of KINDS, for an answer."""
    if name == "case.toml":
        return as_toml(answer.query.tables).encode()
    with tempfile.TemporaryDirectory(prefix="stiction-") as folder:
        path = Path(folder) / name
        _view(answer).writers()[name.replace(".svg", ".png")](path)
        return path.read_bytes()


def report_of(answer: Answer, progress: Progress) -> bytes:
    """Return the HTML report that `stiction report` writes, as bytes.

    Raises InputError, and KeyboardInterrupt if the visitor stops it.
    """
    from stiction.report.html_report import case_as_html

    return case_as_html(answer.case, as_toml(answer.query.tables), progress=progress).encode()


class ShareTab:
    """Offer the case as text, as an address and as files."""

    def __init__(self, explorer: Explorer):
        self._explorer = explorer
        ui.label("The address of this page contains the case, and opens the same page on any machine that runs "
                 "stiction serve.").classes("text-sm")  # fmt: skip
        self._files = ui.label().classes("text-sm text-negative")
        with ui.row().classes("gap-2"):
            for name in KINDS:
                button = ui.button(name, on_click=lambda event, name=name: self._download(name, event.sender)).props("no-caps")
                attributes(button, aria_label=f"download {name}")
        ui.label("The report shows the answer, inputs with sources, pictures, all models and validity on one page. "
                 "On the command line: stiction report case.toml").classes("text-sm")  # fmt: skip
        Study(
            explorer,
            "Make the report",
            lambda progress: report_of(explorer.answer, progress),
            lambda page: ui.download.content(page, "report.html"),
            "report.html is downloaded",
        )
        ui.label("The same numbers, to the last digit, on the command line: stiction run case.toml").classes("text-sm")
        self._text = ui.code("", language="toml").classes("w-full")
        attributes(self._text.copy_button, aria_label="copy the case")
        attributes(self._text.markdown, tabindex=0)  # tabindex: a keyboard can scroll it
        explorer.listen(self.show)
        self.show()

    async def _download(self, name: str, button: Any) -> None:
        attributes(button, loading=True)
        try:
            data = await run(content, self._explorer.answer, name)
        except InputError as error:
            ui.notify(f"{name}: {error}", type="negative")
            return
        finally:
            attributes(button, loading=False)
        ui.download.content(data, name)

    def show(self) -> None:
        """Show the newest case as text, and name the files that it needs but the page's URL does not contain."""
        self._text.set_content(as_toml(self._explorer.answer.query.tables))
        files = ", ".join(files_named(self._explorer.query.tables))
        self._files.set_text(f"The address does not contain {files}. The recipient needs these files." if files else "")
