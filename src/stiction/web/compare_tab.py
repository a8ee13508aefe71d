"""The tab Compare: the prediction, models that say the same in one row, and on demand every model."""

import re
from typing import Any

from nicegui import ui

from stiction.laws.validity import read_doubts
from stiction.report.answer import headline
from stiction.report.comparison_doubts import over_models, said_of_liquid
from stiction.report.comparison_groups import GROUP_HEADS, group_rows, left_out_in_words
from stiction.report.plain_formulas import as_code
from stiction.solving.overview import models
from stiction.web.asked import Comparison, compared
from stiction.web.charts import comparison_chart
from stiction.web.drawn import Picture, attributes
from stiction.web.explorer import Explorer
from stiction.web.studying import Study

__all__ = ["CompareTab"]

_COLUMNS = [
    {"name": name, "label": label, "field": name, "align": "left", "sortable": True}
    for name, label in (
        ("model", "model"),
        ("mu", "mu"),
        ("family", "its friction rests on"),
        ("plastic", "plastic junctions resist"),
        ("grade", "grade"),
        ("doubts", "doubts"),
    )
]

_GROUPS = [{"name": name, "label": name, "field": name, "align": "left"} for name in GROUP_HEADS]

_BUTTON = """<q-btn flat dense no-caps align="left" color="primary" style="text-align: left" :label="NAME"
  @click="() => $parent.$emit('opened', NAME)" />"""
_NAME = f"""<q-td :props="props">{_BUTTON.replace("NAME", "props.value")}</q-td>"""
# A row on a narrow page: its cells below one another.
_CARD = f"""<q-card flat bordered class="w-full q-pa-sm q-mb-sm">{_BUTTON.replace("NAME", "props.row.model")}
  <div v-for="one in props.cols.slice(1)" :key="one.name"><b>{{{{ one.label }}}}:</b> {{{{ one.value }}}}</div></q-card>"""


class CompareTab:
    """Asked when the tab is opened, and again by its button."""

    def __init__(self, explorer: Explorer):
        self._explorer = explorer
        self._data: Any = None
        self._asked: Any = None
        self._study = Study(explorer, "Compare all models at this load", self._work, self._show)
        self._advice = ui.label().classes("text-lg").props('role="status" aria-live="polite"')
        self._groups = ui.table(columns=_GROUPS, rows=[]).classes("w-full").props("dense flat wrap-cells")
        attributes(self._groups, aria_label="models that say the same")
        self._left_out = ui.label().classes("text-sm")
        with ui.expansion("Every model").classes("w-full") as self._every:
            self._every_model()
        self._groups.set_visibility(False)
        self._every.set_visibility(False)
        explorer.listen(self._again)

    def _every_model(self) -> None:
        self._more = ui.label().classes("text-sm").style("white-space: pre-line")
        self._picture = Picture("friction by model", "", 620)
        self._picture.element.classes("by-rows")
        self._picture.show(None)
        self._picture.element.on_point_click(lambda event: self._open(str(self._names()[event.value[1]])))
        self._table = ui.table(columns=_COLUMNS, rows=[], row_key="model").classes("w-full").props("dense flat wrap-cells")
        # A button in the row, which a keyboard reaches; the name is bound as text.
        self._table.add_slot("body-cell-model", _NAME)
        self._table.add_slot("item", _CARD)
        self._table.on("opened", lambda event: self._open(event.args))

    async def opened(self) -> None:
        """Compare when the tab is opened, unless that was done for the present numbers."""
        if not self._study.is_current:
            await self._study.start()

    def _again(self) -> None:
        if self._data is not None and self._explorer.view.dark != self._dark:
            self._draw()

    def _work(self, progress: Any) -> Comparison:
        answer = self._asked = self._explorer.good
        load = float(answer.curve["load"].values.reshape(-1)[self._explorer.here])
        return compared(answer.question, load if load > 0.0 else None, progress)

    def _show(self, found: Comparison) -> None:
        if found.error is not None or found.data is None:
            self._advice.set_text(str(found.error))
            return
        self._data = data = found.data
        said = data.attrs
        best = said.get("recommended", "none")
        told = f"Recommended: {best}." if best != "none" else "No model is recommended."
        told = " ".join(filter(None, [told, _sentence(said.get("leap", "")), _sentence(said.get("reason", ""))]))
        predicted = found.prediction
        self._advice.set_text(told if predicted is None else f"{headline(predicted)}. {predicted.attrs['regime']}")
        self._groups.rows = [dict(zip(GROUP_HEADS, row, strict=True)) for row in group_rows(data)]
        self._left_out.set_text(_sentence(left_out_in_words(data)))
        ends = [f"{end:.3g}" for end in said.get("spread", [])]
        parts = [told] if predicted is not None else []
        parts += [f"Mu {' to '.join(ends)} {over_models(data)}." if ends else "", _sentence(said.get("advice", ""))]
        parts.append(_sentence(said_of_liquid(data)))
        parts += [f"Set aside: {line}." for line in said.get("set_aside", "").splitlines()]
        self._more.set_text("\n".join(filter(None, parts)))
        self._draw()
        if self._explorer.view.narrow:
            self._table.props("grid")
        self._table.rows = [self._row(at) for at in range(data.sizes["model"])]
        self._groups.set_visibility(True)
        self._every.set_visibility(True)
        if "spread_low" in data:
            self._explorer.differ(self._asked, [float(data[f"spread_{end}"].sel(spread="models")) for end in ("low", "high")])

    def _draw(self) -> None:
        self._dark = self._explorer.view.dark
        options = comparison_chart(self._data, self._dark)
        self._picture.element.style(f"--rows: {len(options['yAxis']['data'])}")
        self._picture.show(options)

    def _names(self) -> list[str]:
        options = self._picture.element.options
        return list(options["yAxis"]["data"])

    def _row(self, at: int) -> dict[str, Any]:
        one = self._data.isel(model=at)
        mu = float(one["friction_coefficient_at_load"])
        doubts = [doubt.short for doubt in read_doubts(one["doubts"].item())]
        return {
            "model": str(one["model"].item()), "mu": f"{mu:.3g}" if mu == mu else one["why_not"].item() or "-",
            "family": one["family_of_curve"].item(), "plastic": one["plastic_junctions_resist"].item() or "-",
            "grade": one["grade"].item(), "doubts": "; ".join(doubts) or "none",
        }  # fmt: skip

    def _open(self, name: str) -> None:
        """The page of a model: equations, source, grade, check numbers."""
        key = name.partition(" + ")[0].partition(" (")[0]
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


def _sentence(text: str) -> str:
    """The text as sentences of its own: of what is parted by semicolons each begins with a capital."""
    parts = [one for one in re.split(r"; (?![^()]*\))", text) if one]
    return " ".join(f"{one[0].upper()}{one[1:]}{'' if one.endswith('.') else '.'}" for one in parts)
