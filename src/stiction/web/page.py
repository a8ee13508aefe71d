"""Build the page: its frame, its tabs, and its address, which contains the case."""

from collections.abc import Callable
from typing import Any

from nicegui import context, ui

from stiction.quantities.errors import InputError
from stiction.report.html_words import letters
from stiction.web.address import decoded, encoded
from stiction.web.answer_card import AnswerCard
from stiction.web.asperity_tab import AsperityTab
from stiction.web.background import run
from stiction.web.compare_tab import CompareTab
from stiction.web.contact_tab import ContactTab
from stiction.web.explorer import Explorer
from stiction.web.form import Form
from stiction.web.place_tab import PlaceTab
from stiction.web.query import Answer, Query, answered
from stiction.web.share_tab import ShareTab
from stiction.web.studies_tab import StudiesTab
from stiction.web.surface_tab import SurfaceTab

_STYLE = """
.w-full { width: 100% } .w-28 { width: 7rem } .w-32 { width: 8rem } .w-48 { width: 12rem } .w-56 { width: 14rem }
.w-64 { width: 16rem } .w-72 { width: 18rem } .w-80 { width: 20rem } .grow { flex-grow: 1 }
.overflow-auto { overflow: auto } .table .q-table__container, .table .scroll { overflow: visible }
.table .q-btn__content { text-align: left }
.gap-0 { gap: 0 } .gap-1 { gap: 0.25rem } .gap-2 { gap: 0.5rem } .gap-3 { gap: 0.75rem }
.gap-4 { gap: 1rem } .gap-6 { gap: 1.5rem }
.p-0 { padding: 0 } .px-2 { padding-left: 0.5rem; padding-right: 0.5rem }
.py-1 { padding-top: 0.25rem; padding-bottom: 0.25rem }
.items-center { align-items: center } .items-start { align-items: flex-start } .items-end { align-items: flex-end }
.text-xs { font-size: 0.75rem; line-height: 1.35 } .text-sm { font-size: 0.875rem; line-height: 1.45 }
.text-lg { font-size: 1.125rem; line-height: 1.55 } .text-xl { font-size: 1.25rem; line-height: 1.4 }
.text-3xl { font-size: 1.875rem; line-height: 1.2 } .font-bold { font-weight: 700 } .font-mono { font-family: monospace }
.charts { grid-template-columns: repeat(auto-fit, minmax(min(100%, 340px), 1fr)); gap: 8px }
.of-three > :first-child { grid-column: 1 / -1 }
@container (min-width: 701px) { .of-three > * { height: 222px !important } }
.legend { display: flex; flex-wrap: wrap; gap: 2px 20px } .legend svg { vertical-align: -2px }
.head { flex-wrap: nowrap } .title { min-width: 0; line-height: 1.3; overflow-wrap: anywhere }
.title { display: -webkit-box; -webkit-box-orient: vertical; -webkit-line-clamp: 3; overflow: hidden }
.frame { display: grid; grid-template-columns: minmax(280px, 392px) minmax(0, 1fr); gap: 16px; width: 100% }
.q-page { padding: 8px 12px }
.group { display: grid; grid-template-columns: 80px minmax(0, 1fr); gap: 0 8px; width: 100%; padding: 3px 0 }
.group-head { display: flex; align-items: center; align-self: start; gap: 6px }
.group > :last-child { display: flex; flex-direction: column; gap: 3px; min-width: 0 }
.group + .group { border-top: 1px solid #8886 }
.number { display: grid; grid-template-columns: 84px 106px minmax(0, 1fr); gap: 0 8px; align-items: center; width: 100% }
.number:has(.q-field--error) { align-items: start }
.number .q-select { grid-column: span 2 } .number .uncertain { grid-column: span 2 }
.number .uncertain + .q-slider { grid-column: span 3 } .number .q-slider { padding-right: 8px }
.number .q-field__bottom { width: 212px; padding: 2px 0; overflow-wrap: anywhere }
.knobs .q-field--dense .q-field__control, .knobs .q-field--dense .q-field__marginal { height: 30px; min-height: 30px }
.knobs .q-field--dense .q-field__native { min-height: 28px; padding: 0; font-size: 0.875rem }
.knobs .q-field__control { padding: 0 8px } .knobs .q-item { min-height: 26px; padding: 0 4px }
.knobs .q-expansion-item__content { padding: 2px 0 } .knobs .nicegui-expansion-content { padding: 2px 0; gap: 3px }
.card { display: grid; grid-template-columns: minmax(280px, 4fr) minmax(0, 5fr); gap: 2px 24px; margin-top: 4px }
.card > p > span { margin-right: .3em } .card > p, .card > svg { grid-column: 1; margin: 0 } .card svg { width: 100% }
.card > dl { grid-column: 2; grid-row: 1 / span 3; margin: 0; align-self: center }
.card dl { display: grid; grid-template-columns: max-content minmax(0, 1fr); gap: 2px 12px } .card dd { margin: 0 }
.card button { border: 0; padding: 0; background: none; color: inherit; font: inherit; cursor: pointer }
.card button { text-decoration: underline }
.knobs { position: sticky; top: 56px; align-self: start; max-height: calc(100vh - 64px); overflow-y: auto; flex-wrap: nowrap }
.section { aspect-ratio: 2; max-width: 900px }
.under-chart { margin: 0 18px 0 74px; width: auto; align-self: stretch }
.formula { max-width: 100%; object-fit: contain; object-position: left }
:root { --paper: #ffffff } .body--dark { --paper: #1d1d1d; --mark: #56B4E9 }
.picture svg, .picture img { width: 100%; height: auto; display: block; fill: currentColor }
.old { opacity: .4 } .body--dark .formula { filter: invert(.9) }
.answer { transition: opacity .1s .15s } .waiting .answer { opacity: .4 }
.pending { display: none } .waiting .pending { display: block }
.rows { display: grid; grid-template-columns: max-content minmax(0, 1fr); gap: 2px 12px }
.one-line { overflow: hidden; text-overflow: ellipsis; white-space: nowrap; min-width: 0 }
.equations { min-width: 0 } .equations pre { white-space: pre-wrap; overflow-wrap: anywhere }
.results { container-type: inline-size }
.by-rows { height: calc(var(--rows) * 22px + 130px) }
@container (max-width: 420px) { .by-rows { height: calc(var(--rows) * 34px + 170px) }
  .section { aspect-ratio: auto; height: calc(50cqw + 122px) } .under-chart { margin: 0 12px 0 50px } }
@container (max-width: 700px) { .card { grid-template-columns: minmax(0, 1fr) }
  .card > dl { grid-column: 1; grid-row: auto } .card dl { grid-template-columns: minmax(0, 1fr); gap: 0 }
  .card dd { margin-bottom: 4px } }
@media (max-width: 800px) { .head { flex-wrap: wrap; row-gap: 0 } .head > .q-btn { margin-left: auto }
  .title { order: 1; flex: 1 0 100% } .frame { grid-template-columns: minmax(0, 1fr) } .no-wrap-wide { flex-wrap: wrap }
  .number .q-field__bottom { width: calc(100vw - 214px) }
  .q-page { padding: 4px } .frame > .results { order: -1 } .knobs { position: static; max-height: none } }
/* the colours of the library are important in a layer, which nothing after it outranks: so its variables are changed */
.body--light .text-negative { --q-negative: #b00020 } .body--dark .text-negative { --q-negative: #ff8a80 }
.body--light .q-field--error { --q-negative: #b00020 } .body--dark .q-field--error { --q-negative: #ff8a80 }
.body--dark .text-primary { --q-primary: #90caf9 }
.q-tabs { max-width: 100% }
:focus-visible { outline: 3px solid #E69F00; outline-offset: 1px }
"""
_NARROW = 800  # largest width in pixels of a page of one column, as in _STYLE
# Scrolls the tabs to the top, below the header, if they are not in the upper half of the window.
_SCROLL_TO_TABS = """
const top = document.querySelector('.q-tabs').getBoundingClientRect().top
const header = document.querySelector('header').offsetHeight
if (top < header || top > window.innerHeight / 2) window.scrollBy({ top: top - header, behavior: 'smooth' })
"""
# Name -> class of the tab. The first is built with the page, the others when they are first opened.
TABS: dict[str, Callable[[Explorer], Any]] = {
    "Contact": ContactTab,
    "Compare": CompareTab,
    "Regime": PlaceTab,
    "One asperity": AsperityTab,
    "Surface": SurfaceTab,
    "Studies": StudiesTab,
    "Share": ShareTab,
}


async def make_page(query: Query, state: str) -> None:
    """Build the page of one visitor.

    query: the served case. state: text of a case from the address; "" for the served case.
    """
    answer, error = await run(_first_answer, query, state)
    _frame(Explorer(answer.query, answer), error)


def _first_answer(query: Query, state: str) -> tuple[Answer, InputError | None]:
    """Return the first answer of a page, and the InputError that the case in its address raises, or None.

    state: text of a case from the address; "" for the served case. After an error, the served case is solved.
    """
    if not state:
        return answered(query), None
    try:
        return answered(query.with_tables(decoded(state))), None
    except InputError as error:
        return answered(query), error


def _frame(explorer: Explorer, error: InputError | None) -> None:
    ui.add_css(_STYLE)
    ui.colors(primary="#1565C0")  # dark enough for white letters
    dark = ui.dark_mode(None)

    def switch() -> None:
        dark.set_value(not explorer.view.dark)
        explorer.view.dark = not explorer.view.dark
        explorer.redraw()

    with ui.header().classes("items-center gap-4 py-1 head").style("background: #0B3C5D"):
        ui.label("stiction").classes("text-lg font-bold").props('role="heading" aria-level="1"')
        number = ui.label().classes("font-bold one-line answer").style("flex: none; max-width: 50%")
        title = ui.label().classes("grow text-sm title")
        ui.label("Computing: the numbers shown belong to the previous case.").classes("text-sm one-line pending")
        ui.button(icon="contrast", on_click=switch).props('flat dense color="white" aria-label="light or dark"')
    if error is not None:
        ui.label(f"The address was not used: {error}").classes("text-negative").props('role="alert"')
    with ui.element("div").classes("frame"):
        with ui.column().classes("gap-1 knobs").props('role="form" aria-label="the case"'):
            Form(explorer)
        with ui.column().classes("w-full gap-1 results"):
            AnswerCard(explorer)
            _tabs(explorer)

    def mark() -> None:
        ui.query("body").classes(**{"add" if explorer.waits else "remove": "waiting"})

    def show() -> None:
        title.set_text(str(explorer.answer.query.tables.get("title", "")))
        number.set_text(letters(explorer.headline[0]))

    def moved() -> None:
        show()
        mark()
        ui.navigate.history.replace(f"/?s={encoded(explorer.query.tables)}")

    async def see() -> None:
        """Ask the browser whether the page is dark and how wide it is: charts and pictures depend on it."""
        try:
            found = await ui.run_javascript("[document.body.classList.contains('body--dark'), window.innerWidth]", timeout=5.0)
        except TimeoutError:
            return  # without an answer the charts stay light
        explorer.view.dark, explorer.view.narrow = bool(found[0]), float(found[1]) <= _NARROW
        explorer.redraw()

    explorer.listen(moved)
    explorer.client = context.client
    explorer.on_wait = mark
    show()
    context.client.on_delete(explorer.close)
    context.client.on_connect(see)


def _tabs(explorer: Explorer) -> None:
    built: dict[str, Any] = {}

    def show_tab(name: str) -> None:
        tabs.set_value(name)
        ui.run_javascript(_SCROLL_TO_TABS)

    explorer.open_tab = show_tab
    with ui.tabs().props('align="left" outside-arrows mobile-arrows no-caps inline-label') as tabs:
        for name in TABS:
            ui.tab(name)
    with ui.tab_panels(tabs, value="Contact", animated=False, keep_alive=True).classes("w-full"):
        panels = {name: ui.tab_panel(name).classes("p-0 gap-2") for name in TABS}

    async def open_tab(name: str) -> None:
        explorer.view.tab = name
        if name not in built:
            with panels[name]:
                built[name] = TABS[name](explorer)
        if hasattr(built[name], "opened"):
            await built[name].opened()

    with panels["Contact"]:
        built["Contact"] = ContactTab(explorer)
    tabs.on_value_change(lambda event: open_tab(event.value))
