"""The page: its frame, its tabs, its address."""

from collections.abc import Callable
from typing import Any

from nicegui import context, ui

from stiction.quantities.errors import InputError
from stiction.web.address import unpacked
from stiction.web.asked import Question, solved
from stiction.web.asperity_tab import AsperityTab
from stiction.web.compare_tab import CompareTab
from stiction.web.contact_tab import ContactTab
from stiction.web.explorer import Explorer
from stiction.web.form import Form
from stiction.web.place_tab import PlaceTab
from stiction.web.share_tab import ShareTab
from stiction.web.studies_tab import StudiesTab
from stiction.web.surface_tab import SurfaceTab
from stiction.web.words import headline
from stiction.web.working import run

__all__ = ["make_page"]

_STYLE = """
.charts { grid-template-columns: repeat(auto-fit, minmax(min(100%, 340px), 1fr)); gap: 8px }
.frame { display: grid; grid-template-columns: minmax(260px, 340px) minmax(0, 1fr); gap: 16px; width: 100% }
.knobs { position: sticky; top: 56px; align-self: start; max-height: calc(100vh - 64px); overflow-y: auto; flex-wrap: nowrap }
.section { aspect-ratio: 2; max-width: 900px }
.one-line { overflow: hidden; text-overflow: ellipsis; white-space: nowrap; min-width: 0 }
.wide { overflow-x: auto; width: 100% }
@media (max-width: 800px) { .frame { grid-template-columns: minmax(0, 1fr) } .no-wrap-wide { flex-wrap: wrap }
  .q-page { padding: 4px } .frame > .results { order: -1 } .knobs { position: static; max-height: none }
  .wide > * { min-width: 640px } .models table { min-width: 860px } }
/* the colours of the library are important in a layer, which nothing after it outranks: so its variables are changed */
.body--light .text-negative { --q-negative: #b00020 } .body--dark .text-negative { --q-negative: #ff8a80 }
.body--dark .text-primary { --q-primary: #90caf9 }
.q-tabs { max-width: 100% } .q-tabs__content { flex-wrap: wrap }
:focus-visible { outline: 3px solid #E69F00; outline-offset: 1px }
"""
# Tabs that are built when they are first opened: name -> what builds one.
TABS: dict[str, Callable[[Explorer], Any]] = {
    "Compare": CompareTab,
    "Where am I": PlaceTab,
    "One asperity": AsperityTab,
    "Surface": SurfaceTab,
    "Studies": StudiesTab,
    "Share": ShareTab,
}


def make_page(question: Question, state: str) -> Callable[[], Any]:
    """What builds the page of one visitor. question: the case that is served; state: what the address holds, "" for nothing."""

    async def build() -> None:
        wrong = None
        asked = question
        if state:
            try:
                asked = question.with_tables(unpacked(state))
            except InputError as error:
                wrong = error
        answer = await run(solved, asked)
        if answer.error is not None:
            wrong, answer = answer.error, await run(solved, question)
        if answer.error is not None:
            ui.label(str(answer.error)).props('role="alert"')
            return
        _frame(Explorer(answer.question, answer), wrong)

    return build


def _frame(explorer: Explorer, wrong: InputError | None) -> None:
    ui.add_css(_STYLE)
    ui.colors(primary="#1565C0")  # dark enough for white letters
    dark = ui.dark_mode(None)
    with ui.header().classes("items-center gap-4 py-1 no-wrap").style("background: #0B3C5D"):
        ui.label("stiction").classes("text-lg font-bold").props('role="heading" aria-level="1"')
        number = ui.label().classes("font-bold one-line").style("flex: none; max-width: 50%")
        title = ui.label().classes("grow text-sm one-line")
        look = ui.button(icon="contrast", on_click=lambda: _switch(explorer, dark))
        look.props('flat dense color="white" aria-label="light or dark"')
    if wrong is not None:
        ui.label(f"The address was not used: {wrong}").classes("text-negative").props('role="alert"')
    with ui.element("div").classes("frame"):
        with ui.column().classes("gap-1 knobs").props('role="form" aria-label="the case"'):
            Form(explorer)
        with ui.column().classes("w-full gap-2 results"):
            _tabs(explorer)

    def told() -> None:
        title.set_text(str(explorer.good.question.tables.get("title", "")))
        number.set_text(headline(explorer.good, explorer.here)[0])

    def moved() -> None:
        told()
        ui.navigate.history.replace(explorer.address)

    explorer.listen(moved)
    told()
    client = context.client
    client.on_delete(explorer.close)
    client.on_connect(lambda: _see(explorer))


async def _see(explorer: Explorer) -> None:
    """Ask the browser whether the page is dark: charts need to know."""
    try:
        explorer.view.dark = bool(await ui.run_javascript("document.body.classList.contains('body--dark')", timeout=5.0))
    except TimeoutError:
        return  # who does not answer sees light charts
    explorer.redraw()


def _switch(explorer: Explorer, dark: Any) -> None:
    explorer.view.dark = not explorer.view.dark
    dark.set_value(explorer.view.dark)
    explorer.redraw()


def _tabs(explorer: Explorer) -> None:
    built: dict[str, Any] = {}
    with ui.tabs().props('align="left" outside-arrows mobile-arrows no-caps inline-label') as tabs:
        for name in ("Contact", *TABS):
            ui.tab(name)
    panels: dict[str, Any] = {}
    with ui.tab_panels(tabs, value="Contact", animated=False, keep_alive=True).classes("w-full"):
        with ui.tab_panel("Contact").classes("p-0 gap-2"):
            ContactTab(explorer)
        for name in TABS:
            panels[name] = ui.tab_panel(name).classes("p-0 gap-2")

    async def opened(event: Any) -> None:
        name = event.value
        if name in TABS and name not in built:
            with panels[name]:
                built[name] = TABS[name](explorer)
        if hasattr(built.get(name), "opened"):
            await built[name].opened()

    tabs.on_value_change(opened)
