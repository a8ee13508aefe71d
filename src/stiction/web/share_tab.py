"""The tab Share: the address of this page, and files of it, made by the same functions as those of the command line."""

import tempfile
from pathlib import Path
from typing import Any

from nicegui import ui

from stiction.case.text import as_toml
from stiction.quantities.errors import InputError
from stiction.report.view import View
from stiction.web.address import files_named
from stiction.web.asked import Answer
from stiction.web.drawn import attributes
from stiction.web.explorer import Explorer
from stiction.web.studying import Study
from stiction.web.working import Progress, run

# Names of the files.
KINDS = ("case.toml", "curve.csv", "curve.nc", "curve.svg", "curve.png")


def _view(answer: Answer) -> View:
    """Return what `stiction run` shows of the case."""
    assert answer.case is not None and answer.data is not None
    if answer.prediction is not None:
        from stiction.report.views.prediction import prediction_view

        return prediction_view(answer.case, answer.data, "case.toml")
    from stiction.report.views.run import run_view

    return run_view(answer.case, answer.data)


def content(answer: Answer, name: str) -> bytes:
    """One of KINDS, as bytes."""
    if name == "case.toml":
        return as_toml(answer.question.tables).encode()
    with tempfile.TemporaryDirectory(prefix="stiction-") as folder:
        path = Path(folder) / name
        _view(answer).writers()[name.replace(".svg", ".png")](path)
        return path.read_bytes()


def report_of(answer: Answer, progress: Progress) -> bytes:
    """The page of `stiction report`, which takes as long as a study. Raises InputError, and KeyboardInterrupt where it is
    stopped."""
    from stiction.report.html_report import case_as_html

    assert answer.case is not None
    return case_as_html(answer.case, as_toml(answer.question.tables), progress=progress).encode()


class ShareTab:
    """The case as text, as an address and as files."""

    def __init__(self, explorer: Explorer):
        self._explorer = explorer
        ui.label("The address of this page holds the whole case: copied and pasted, it opens the same page on any machine "
                 "that runs stiction serve.").classes("text-sm")  # fmt: skip
        self._files = ui.label().classes("text-sm text-negative")
        with ui.row().classes("gap-2"):
            for name in KINDS:
                button = ui.button(name, on_click=lambda event, name=name: self._download(name, event.sender)).props("no-caps")
                attributes(button, aria_label=f"download {name}")
        ui.label("The report: answer, inputs with their sources, pictures, all models, validity, on one page to print or send. "
                 "On the command line: stiction report case.toml").classes("text-sm")  # fmt: skip
        Study(
            explorer,
            "Make the report",
            lambda progress: report_of(explorer.good, progress),
            lambda page: ui.download.content(page, "report.html"),
            "report.html is downloaded",
        )
        ui.label("The same numbers, to the last digit, on the command line: stiction run case.toml").classes("text-sm")
        self._text = ui.code("", language="toml").classes("w-full")
        attributes(self._text.copy_button, aria_label="copy the case")
        attributes(self._text.markdown, tabindex=0)  # it is moved sideways where it is narrow
        explorer.listen(self.show)
        self.show()

    async def _download(self, name: str, button: Any) -> None:
        attributes(button, loading=True)
        try:
            data = await run(content, self._explorer.good, name)
        except InputError as error:
            ui.notify(f"{name}: {error}", type="negative")
            return
        finally:
            attributes(button, loading=False)
        ui.download.content(data, name)

    def show(self) -> None:
        """The newest case."""
        self._text.set_content(as_toml(self._explorer.good.question.tables))
        files = ", ".join(files_named(self._explorer.question.tables))
        self._files.set_text(f"Not in the address: {files}. Who opens it has to have these files." if files else "")
