"""Hold the state of one visitor: the case, its answer and the display settings. Visitors share only answers of equal cases."""

import tempfile
import time
from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any
from weakref import WeakSet

from stiction.quantities.errors import InputError
from stiction.report.table import with_signs
from stiction.web.background import Latest
from stiction.web.fields import value_at, with_value_at
from stiction.web.query import Answer, Query, answered, headline


@dataclass
class View:
    """Hold the display settings of the page.

    against: variable on the horizontal axis, "load" or "mean_separation". point: index on the curve, None for the middle point.
    tab: the open tab. dark: whether the page is dark. narrow: whether the page is as narrow as on a phone.
    """

    against: str = "load"
    point: int | None = None
    tab: str = "Contact"
    dark: bool = False
    narrow: bool = False


_APART = 1.0  # seconds; changes that follow faster are undone together
_open: "WeakSet[Explorer]" = WeakSet()


def close_all() -> None:
    """Delete the uploads of every visitor, when a signal ends the server: Python then runs no clean-up of its own."""
    for explorer in list(_open):
        explorer.close()


class Explorer:
    """Hold the case of one visitor and its answer, and call listeners after every new answer.

    query: the case. answer: its results. headline: two texts, mu with the digits that its uncertainty justifies, and the load,
    contact area and separation or, for a prediction, its interval and load.
    """

    def __init__(self, query: Query, answer: Answer):
        self.query, self.answer = query, answer  # the answer stays that of the last query without an error
        self.error: InputError | None = None  # error of the newest query
        self.waits = False  # whether the answer belongs to an earlier query
        self.first = self._titled = query.tables  # `_titled`: the case for which the title was written
        self._history: list[Mapping[str, Any]] = []  # cases to which `undo` goes back, the newest last
        self._changed = 0.0
        self.view = View()
        self.headline = headline(answer, self.point)
        self.rebuild: Callable[[], None] = lambda: None  # rebuilds the form when fields are added or removed
        self.client: AbstractContextManager[Any] = nullcontext()  # the page; the element that started a query may be gone
        self.open_tab: Callable[[str], object] = lambda name: None
        self.on_wait: Callable[[], None] = lambda: None  # marks the answer as old
        self._listeners: list[Callable[[], object]] = []
        self._latest = Latest(answered, self._show, self._refuse)
        self._uploads: tempfile.TemporaryDirectory[str] | None = None
        _open.add(self)

    def listen(self, listener: Callable[[], object]) -> None:
        """Register a listener that is called after every new answer."""
        self._listeners.append(listener)

    def redraw(self) -> None:
        """Call all listeners again with the same answer."""
        self.headline = headline(self.answer, self.point)
        with self.client:
            for listener in self._listeners:
                listener()

    def _show(self, answer: Answer) -> None:
        self.answer = answer
        self._refuse(None)

    def _refuse(self, error: InputError | None) -> None:
        self.error, self.waits = error, self._latest.is_waiting
        self.redraw()

    async def ask(self, tables: Mapping[str, Any]) -> None:
        """Solve a changed case, given by its tables; `undo` goes back to the previous case.

        If the contact has changed, the title of the case is replaced by one that names the bodies. A new title in the tables is
        kept.
        """
        now, before = time.monotonic(), self.query.tables
        if now - self._changed > _APART:
            self._history.append(before)
        self._changed = now
        await self._ask(tables)

    async def undo(self) -> None:
        """Go back to the case before the last change; changes less than a second apart are undone together."""
        self._changed = 0.0
        if self._history:
            await self._ask(self._history.pop())
            self.rebuild()

    async def open(self, tables: Mapping[str, Any]) -> None:
        """Show another case, given by its tables, with a new form."""
        self._changed = 0.0
        await self.ask(tables)
        self.rebuild()

    async def _ask(self, tables: Mapping[str, Any]) -> None:
        if tables.get("title") != self.query.tables.get("title"):
            self._titled = tables
        self.query = self.query.with_tables(_retitled(tables, self._titled))
        self.waits = True
        self.on_wait()
        await self._latest.ask(self.query)

    async def put(self, path: tuple[str, ...], value: Any) -> None:
        """Solve the case with another value at a path of keys in its tables; None removes the value."""
        await self.ask(with_value_at(self.query.tables, path, value))

    @property
    def point(self) -> int:
        """Return the index of the shown load or separation on the curve; for a prediction, the index of its working load."""
        if self.view.point is None or self.answer.is_prediction:
            return self.answer.middle()
        return min(self.view.point, self.answer.curve["load"].size - 1)

    @property
    def load(self) -> float:
        """Return the load at the shown point of the curve, in N, or normalised for dimensionless groups."""
        return float(self.answer.at(self.point)["load"])

    def upload(self, name: str, content: bytes) -> str:
        """Write an uploaded file into the folder of this visitor, and return its path.

        name: name of the file on the machine of the visitor. The stored file keeps its suffix only.
        """
        if self._uploads is None:
            self._uploads = tempfile.TemporaryDirectory(prefix="stiction-")
        suffix = "".join(letter for letter in Path(name).suffix.lower() if letter.isalnum())[:12]
        path = Path(self._uploads.name) / (f"upload.{suffix}" if suffix else "upload")
        path.write_bytes(content)
        self.query = replace(self.query, files=self.query.files | {str(path)})
        return str(path)

    def close(self) -> None:
        """Remove the visitor's listeners, and delete the uploads."""
        self._listeners.clear()
        if self._uploads is not None:
            self._uploads.cleanup()
            self._uploads = None


def _retitled(tables: Mapping[str, Any], titled: Mapping[str, Any]) -> dict[str, Any]:
    """Return case tables with the present title if it still suits the contact, otherwise with a new title.

    titled: tables of the case for which the present title was written. If its contact is the same, its title is kept. Otherwise
    the title names the bodies.
    """
    same = all(tables.get(name) == titled.get(name) for name in ("contact", "indices"))
    title = titled.get("title") if same else _described(tables)
    rest = {name: value for name, value in tables.items() if name != "title"}
    return {"title": title, **rest} if title else rest


def _described(tables: Mapping[str, Any]) -> str:
    """Return a title for a case: its bodies and film thickness, or "Dimensionless groups"."""
    if "contact" not in tables:
        return "Dimensionless groups"
    bodies = " on ".join(_material(tables, body) for body in ("first", "second"))
    if not isinstance(value_at(tables, ("contact", "coating")), Mapping):
        return bodies.capitalize()
    thickness = value_at(tables, ("contact", "coating", "thickness"))  # a list or a distribution would be too long for a title
    film = f"{_material(tables, 'coating', 'material').capitalize()} film"
    return ", ".join([film, *([with_signs(thickness)] if isinstance(thickness, str) else []), bodies])


def _material(tables: Mapping[str, Any], *path: str) -> str:
    name = value_at(tables, ("contact", *path, "preset")) or "material of its own"
    return str(name).replace("_", " ")
