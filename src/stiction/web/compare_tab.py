"""The tab Compare: the prediction, models that agree in one row, and on demand every model."""

from typing import Any

from nicegui import ui

from stiction.report.plain_formulas import as_code
from stiction.report.views.comparison import comparison_view
from stiction.solving.overview import models
from stiction.web.asked import compared
from stiction.web.drawn import attributes
from stiction.web.explorer import Explorer
from stiction.web.pictures import Shown
from stiction.web.studying import Study


class CompareTab:
    """Asked when the tab is opened, and again by its button."""

    def __init__(self, explorer: Explorer):
        self._explorer = explorer
        self._study = Study(explorer, "Compare all models at this load", self._work, self._show, "compared")
        self._body = ui.column().classes("w-full gap-2")

    async def opened(self) -> None:
        """Compare when the tab is opened, unless that was done for the present numbers."""
        if not self._study.is_current:
            await self._study.start()

    def _work(self, progress: Any) -> tuple[Any, ...]:
        answer, load = self._explorer.good, self._explorer.load
        case, data, prediction = compared(answer.question, load if load > 0.0 else None, progress)
        few = Shown(list(comparison_view(case, data, prediction, more="").parts()), [])
        return few, Shown.of(comparison_view(case, data, None, every=True), self._explorer.view.narrow)

    def _show(self, found: tuple[Any, ...]) -> None:
        few, every = found
        narrow = self._explorer.view.narrow
        self._body.clear()
        with self._body:
            few.show(narrow, _open)
            with ui.expansion("Every model").classes("w-full"):
                every.show(narrow, _open)


def _open(name: str) -> None:
    """The page of a model: equations, source, grade, check numbers."""
    key = name.partition(" +")[0].partition(" (")[0]
    row = models([key])[0]
    with attributes(ui.dialog(), aria_label=key) as dialog, ui.card().classes("w-full").style("max-width: 860px"):
        ui.label(row["title"]).classes("text-xl")
        ui.label(f"{row['key']}, {row['kind']}, grade {row['grade']}: {row['verified']}")
        for source in row["source"]:
            ui.label(f"Source: {source}").classes("text-sm")
        ui.markdown(as_code(row["text"])).classes("equations w-full")
        for text in (row["notes"], *row["validity"], *row["limits"]):
            if text:
                ui.label(str(text)).classes("text-sm")
        ui.button("Close", on_click=dialog.close)
    dialog.on("hide", dialog.delete)
    dialog.open()
