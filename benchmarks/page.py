"""How quick the page of `stiction serve` is: first answer, redraw after a slider in a browser, fifty visitors at once.

    python benchmarks/page.py [first] [redraw] [visitors]

Needs a Chromium and the extra `dev`; one server on this machine for each part. Times are of the machine it runs on; nothing is
asserted. `first`: from the moment the port answers until charts are drawn. `redraw`: from a key on a slider until number and
charts are drawn anew. `visitors`: fifty clients, each on a page of its own, move a slider ten times, a second apart on average,
and wait for their number; every number is compared with one that was computed without the page. The server keeps its last
answers, so the visitors come twice: all with the numbers of the same example, and each with numbers of his own.
"""

import asyncio
import contextlib
import html
import json
import math
import random
import re
import shutil
import socket
import statistics
import subprocess
import sys
import time
import urllib.request
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Any

VISITORS, MOVES = 50, 10


@dataclass(frozen=True)
class Moved:
    """A contact of which a slider is moved: the example by its title, the number by path and label, and two places."""

    title: str
    path: tuple[str, ...]
    label: str
    places: tuple[float, float]  # decimal logarithms in SI units; between them the answer changes in its two digits

    def tables(self) -> Any:
        from stiction.web.fields import example_cases

        return example_cases()[self.title]

    def address(self) -> str:
        """Return the end of the address of the page of this contact."""
        from stiction.web.address import encoded

        return f"/?s={encoded(self.tables())}"

    def expected(self, place: float) -> str:
        """Return what the page has to say with the slider at a place, computed without the page."""
        from stiction.quantities.shown import show
        from stiction.web.answer_card import card_on_page
        from stiction.web.fields import with_value_at
        from stiction.web.query import Query, solved

        answer = solved(Query(with_value_at(self.tables(), self.path, show(10.0**place, self.path[-1], 4))))
        return plain(card_on_page(answer.data).html(why=False))


CONTACTS = (
    Moved(
        "Silver film, 1 µm, on hardened steel", ("contact", "coating", "thickness"),
        "film thickness (the sum of both films if both bodies are coated) t", (-7.2, -6.0),
    ),
    Moved(
        "Silver film, 200 nm, on hardened steel, with adhesion", ("contact", "roughness", "asperity_radius"),
        "asperity tip radius R", (-5.0, -4.5),
    ),
)  # fmt: skip


@contextlib.contextmanager
def served() -> Iterator[tuple[str, int, float]]:
    """A server of its own: its address, its process, and when its port first answered."""
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        port = one.getsockname()[1]
    command = [sys.executable, "-m", "stiction", "serve", "--port", str(port)]
    with subprocess.Popen(command, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL) as process:
        try:
            while True:
                with contextlib.suppress(OSError), socket.create_connection(("127.0.0.1", port), 1.0):
                    break
                time.sleep(0.01)
            yield f"http://127.0.0.1:{port}", process.pid, time.perf_counter()
        finally:
            process.terminate()
            process.wait(20)


def told(what: str, times: list[float]) -> None:
    times = sorted(times)
    share = times[min(math.ceil(0.95 * len(times)), len(times)) - 1]
    print(f"{what}: median {statistics.median(times):.0f} ms, 95 % {share:.0f} ms, most {times[-1]:.0f} ms, of {len(times)}")


@contextlib.contextmanager
def browser() -> Iterator[Any]:
    from playwright.sync_api import sync_playwright

    path = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))))
    with sync_playwright() as play:
        one = play.chromium.launch(executable_path=path, args=["--headless=new", "--no-sandbox", "--disable-gpu"])
        yield one
        one.close()


def first() -> None:
    """The first answer on screen after the server is up."""
    times = []
    with browser() as one:
        for _ in range(3):
            with served() as (address, _, up):
                page = one.new_page(viewport={"width": 1280, "height": 900})
                page.goto(address)
                page.locator("canvas").first.wait_for()
                times.append(1e3 * (time.perf_counter() - up))
                page.close()
    told("first answer after the port answers", times)


# When the number and every chart that changes have been drawn after a key.
WATCH = """() => {
  window.drawn = 0;
  const status = document.querySelector('[role=status]');
  new MutationObserver(() => window.number = performance.now())
    .observe(status, {subtree: true, childList: true, characterData: true});
  document.addEventListener('keydown', () => { window.began = performance.now(); window.number = 0; window.drawn = 0 }, true);
  for (const one of document.querySelectorAll('[role=img]')) {
    const chart = getElement(one)?.chart;
    chart?.on('finished', () => { if (window.began) window.drawn = performance.now() });
  } }"""


def redraw() -> None:
    """From a key on a slider to number and charts, for a contact at 21 loads, and one with adhesion at 51."""
    for contact in CONTACTS:
        with served() as (address, _, _), browser() as one:
            page = one.new_page(viewport={"width": 1280, "height": 900})
            page.goto(address + contact.address())
            page.locator("canvas").first.wait_for()
            page.wait_for_function("window.socket && window.socket.connected")
            page.wait_for_timeout(1500)
            page.evaluate(WATCH)
            page.get_by_role("slider", name=contact.label).locator("[tabindex='0']").focus()
            numbers, charts = [], []
            for at in range(100):
                if at % 10 == 0:  # a step aside, so that no answer is asked twice: the server keeps its last ones
                    page.keyboard.press("ArrowUp")
                    page.wait_for_timeout(1000)
                page.keyboard.press("PageUp" if at % 20 < 10 else "PageDown")  # ten steps, as one may leave two digits alone
                page.wait_for_function("window.number && window.drawn > window.number")
                page.wait_for_timeout(120)  # whatever comes after
                number, drawn = page.evaluate("[window.number - window.began, window.drawn - window.began]")
                numbers.append(number)
                charts.append(drawn)
        told(f"{contact.title}: number after a slider's move", numbers)
        told(f"{contact.title}: number and charts after a slider's move", charts)


def resident(process: int) -> float:
    """Memory of a process [MB]."""
    text = Path(f"/proc/{process}/status").read_text(encoding="utf-8")
    return int(re.search(r"VmRSS:\s+(\d+)", text)[1]) / 1e3  # type: ignore[index]


class Visitor:
    """A browser without a window: loads the page, opens its socket, moves a slider, reads the number."""

    def __init__(self, address: str, contact: Moved, seed: int, own: bool):
        self._contact, self._address, self._random = contact, address, random.Random(seed)
        self._aside = 2e-4 * seed if own else 0.0
        self.times: list[float] = []
        self.said: list[tuple[float, str]] = []
        self._number = asyncio.Event()
        self._text = ""

    async def come(self) -> None:
        import socketio

        page = await asyncio.to_thread(
            lambda: urllib.request.urlopen(self._address + self._contact.address(), timeout=300).read().decode()
        )
        self._client = re.search(r"'client_id': '([0-9a-f-]+)'", page)[1]  # type: ignore[index]
        elements = json.loads(html.unescape(re.search(r"String\.raw`(\{.*?\})`", page, re.DOTALL)[1]))  # type: ignore[index]
        named = {one.get("props", {}).get("aria-label"): name for name, one in elements.items()}
        self._slider = int(named[f"{self._contact.label}, slider"])
        self._listeners = [one["listener_id"] for one in elements[str(self._slider)]["events"]]
        self._label = next(name for name, one in elements.items() if "where" in one.get("class", []))
        self._socket = socketio.AsyncClient()
        self._socket.on("update", self._updated)
        query = f"client_id={self._client}&next_message_id=0&implicit_handshake=true&document_id=d&tab_id=t&old_tab_id=o"
        path = "/_nicegui_ws/socket.io"
        await self._socket.connect(f"{self._address}?{query}", socketio_path=path, transports=["websocket"], wait_timeout=60)

    async def _updated(self, message: dict[str, Any]) -> None:
        await self._socket.emit("ack", {"client_id": self._client, "next_message_id": message["_id"] + 1})
        if self._label in message:
            self._text = message[self._label]["props"]["innerHTML"]
            self._number.set()

    async def _move(self, place: float) -> None:
        """Move the slider and wait for the number."""
        self._number.clear()
        began = time.perf_counter()
        for one in self._listeners:
            event = {"id": self._slider, "client_id": self._client, "listener_id": one, "args": [json.dumps(place)]}
            await self._socket.emit("event", event)
        await asyncio.wait_for(self._number.wait(), 60)
        self.times.append(1e3 * (time.perf_counter() - began))
        self.said.append((place, self._text))

    async def stay(self) -> None:
        for at in range(MOVES):
            await asyncio.sleep(self._random.uniform(0.0, 2.0))
            await self._move(self._contact.places[at % 2] + 0.01 * self._random.randrange(50) + self._aside)
        await self._socket.disconnect()


def plain(text: str) -> str:
    """The words of a card, without tags: on the page some words are buttons."""
    return re.sub(r"<[^>]+>", "", text)


async def _visits(address: str, process: int, contact: Moved, own: bool) -> None:
    everybody = [Visitor(address, contact, seed, own) for seed in range(VISITORS)]
    for one in everybody:  # who comes meets who is there; pages are made one after the other
        await one.come()
    before = resident(process)
    began = time.perf_counter()
    found = await asyncio.gather(*(one.stay() for one in everybody), return_exceptions=True)
    lasted = time.perf_counter() - began
    failed = [repr(one) for one in found if one is not None]
    told(
        f"{contact.title}: {VISITORS} visitors with {'numbers of their own' if own else 'the same example'}, "
        f"{VISITORS * MOVES / lasted:.0f} moves a second",
        [time for one in everybody for time in one.times],
    )
    said = [pair for one in everybody for pair in one.said]
    known = {place: contact.expected(place) for place in dict(said)}
    print(f"errors {len(failed)} {failed[:2]}; numbers that are not of their own slider "
          f"{sum(known[place] != plain(text) for place, text in said)} of {len(said)}; "
          f"memory {before:.0f} MB with all pages open, {resident(process):.0f} MB at the end")  # fmt: skip


def visitors() -> None:
    """Fifty visitors who move sliders at once."""
    for contact, own in product(CONTACTS, (False, True)):
        with served() as (address, process, _):
            urllib.request.urlopen(address, timeout=600).read()
            print(f"memory {resident(process):.0f} MB with no visitor")
            asyncio.run(_visits(address, process, contact, own))
            time.sleep(15.0)
            print(f"memory {resident(process):.0f} MB a quarter of a minute after all have left")


PARTS = {one.__name__: one for one in (first, redraw, visitors)}


def main() -> None:
    for name in sys.argv[1:] or PARTS:
        PARTS[name]()


if __name__ == "__main__":
    main()
