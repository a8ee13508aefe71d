"""Build the tab Compare: models that suit the contact, do not suit it, or give impossible results, sorted by mu."""

import re
from collections.abc import Iterator
from typing import Any

import xarray
from nicegui import ui

from stiction.laws.validity import read_warnings
from stiction.records.claims import KINDS_OF_WARNING, range_in_words
from stiction.records.sources import bibliography
from stiction.report.html_words import letters
from stiction.report.table import Column, Table, numbers
from stiction.report.views.comparison import (
    Group,
    comparison_view,
    group_row,
    groups_of,
    left_out_in_words,
    silent_models,
    why_apart,
)
from stiction.solving.overview import models
from stiction.studies.prediction.unused import refusal_of
from stiction.web.background import run
from stiction.web.elements import attributes
from stiction.web.explorer import Explorer
from stiction.web.formulas import typeset
from stiction.web.pictures import Shown
from stiction.web.query import compared
from stiction.web.study_button import Study

_SOON = 0.7  # seconds after the last change
_PARTS = {
    "Inside their range of validity": (True, True),
    "Outside their range of validity": (False, True),
    "Physically impossible results": (False, False),
}


class CompareTab:
    """Compare models when the tab is opened, and after every change of the case while it is open.

    A comparison is grey while it is outdated.
    """

    def __init__(self, explorer: Explorer):
        self._explorer = explorer
        self._study = Study(explorer, "Compare all models at this load", self._work, self._show, "compared")
        self._body = ui.column().classes("w-full gap-2")
        self._later = ui.timer(_SOON, self._follow, active=False)
        explorer.listen(self._mark)

    async def opened(self) -> None:
        """Compare the models, unless the last comparison was of the present case and load."""
        if not self._study.is_current:
            await self._study.start()

    def _mark(self) -> None:
        """Grey the outdated comparison, and schedule a new one; each further change postpones it."""
        old = not self._study.is_current
        self._body.classes(**{"add" if old else "remove": "old"})
        self._later.deactivate()
        if old and self._explorer.view.tab == "Compare":
            self._study.stop()
            self._later.activate()

    async def _follow(self) -> None:
        if self._study.is_running:
            return  # the timer tries again until the stopped study has ended
        self._later.deactivate()
        await self.opened()

    def _work(self, progress: Any) -> tuple[Any, ...]:
        answer, load = self._explorer.answer, self._explorer.load
        case, data, prediction = compared(answer.query, load if load > 0.0 else None, progress)
        groups = groups_of(data) if "working_load" in data.attrs else []
        silent = silent_models(case, data)
        texts = [left_out_in_words([], [], silent), letters(why_apart(groups, prediction))]
        if prediction is None and (refusal := refusal_of(case)) is not None:
            texts.append(f"no prediction: {refusal}")
        if not groups:
            texts.append("no model gives friction for this contact at a load above 0")
        every = Shown.of(comparison_view(case, data, None, every=True), self._explorer.view.narrow)
        return list(tables_of(data, groups)), texts, every

    def _show(self, found: tuple[Any, ...]) -> None:
        tables, texts, every = found
        narrow = self._explorer.view.narrow
        self._body.clear()
        keys = {human_name(row["key"]): row["key"] for row in models()}

        async def opened(name: str) -> None:
            await _open(keys.get(name.partition(",")[0].partition(" and ")[0], name))

        with self._body:
            for title, table in tables:
                ui.label(title).classes("text-lg")
                Shown([table], []).show(narrow, opened)
            for words in filter(None, texts):
                ui.label(words).classes("text-sm")
            with ui.expansion("Every model").classes("w-full"):
                every.show(narrow, _open)
        self._mark()


def tables_of(data: xarray.Dataset, groups: list[Group]) -> Iterator[tuple[str, Table]]:
    """Yield (title, table) for models that suit the contact, do not suit it, or give impossible results, sorted by mu.

    data: result of `compare`. groups: groups of its models that agree on mu.
    """
    for title, kind in _PARTS.items():
        some = sorted((one for one in groups if (one.fits, one.possible) == kind), key=lambda one: one.low)
        rows = [[_title(one), group_row(one)[1], _why(data, one)] for one in some]
        if rows:
            yield title, Table([Column("model"), *numbers("mu"), Column("why", wrap=True)], rows)


def _title(group: Group) -> str:
    more = len(group.names) - 1
    return human_name(group.names[0]) + (f" and {more} more" if more else "")


def _why(data: xarray.Dataset, group: Group) -> str:
    """Return the reason why a group of models suits the contact or does not suit it, as text.

    For suitable models the text is "fits" with the area error on benchmark surfaces, if it is known; otherwise it is the most
    important validity warning with the claimed range.
    """
    if group.fits:
        return letters(f"fits; area error {group_row(group)[2]}") if group.errors else "fits"
    warnings = read_warnings(data["validity_warnings"].sel(model=group.names[0]).item())
    worst = min(warnings, key=lambda warning: list(KINDS_OF_WARNING).index(warning.kind))
    claimed = f"{worst.in_brief}, claimed {range_in_words(worst.low, worst.high)}: " if worst.points else ""
    return letters(claimed + worst.why)


def human_name(key: str) -> str:
    """Return the name of a model, and of a law combined with it, in the form in which the literature cites it.

    >>> human_name("kogut_etsion_2004 + layered")
    'Kogut-Etsion 2004, layered'
    >>> human_name("rough_dmt")
    'Rough DMT'
    """
    model, _, law = key.partition(" + ")
    if match := re.fullmatch(r"(\w+?)_(\d{4})(\w*)", model):
        authors, year, more = match.groups()
        entry = re.sub(r'\{\\"(\w)\}', r"\1", bibliography().get(f"{authors}_{year}", ""))
        found = [re.search(rf"\b{word}\b", entry, re.IGNORECASE) for word in authors.split("_")]
        if all(found):
            model = f"{'-'.join(one[0] for one in found if one)} {year}{more}"
    model = re.sub(r"\b(jkr|dmt)\b", lambda name: name[0].upper(), model[:1].upper() + model[1:].replace("_", " "), flags=re.I)
    return ", ".join(filter(None, [model, law.replace("_", " ")]))


async def _open(name: str) -> None:
    """Show a model in a dialog: equations, source, grade and limits.

    name: key of the model, or key of the model and of a law, joined by " + ".
    """
    key = name.partition(" +")[0].partition(" (")[0]
    row = models([key])[0]
    text = await run(typeset, row["text"])
    with attributes(ui.dialog(), aria_label=key) as dialog, ui.card().classes("w-full").style("max-width: 860px"):
        ui.label(human_name(key)).classes("text-xl")
        ui.label(row["title"])
        ui.label(f"{row['key']}, {row['kind']}, grade {row['grade']}: {row['verified']}").classes("text-sm")
        for source in row["source"]:
            ui.label(f"Source: {source}").classes("text-sm")
        ui.markdown(text, sanitize=False).classes("equations w-full")
        for text in (row["notes"], *row["validity"], *row["limits"]):
            if text:
                ui.label(str(text)).classes("text-sm")
        ui.button("Close", on_click=dialog.close)
    dialog.on("hide", dialog.delete)
    dialog.open()
