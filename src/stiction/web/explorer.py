"""What one visitor has before them: a case, its answer, how it is shown. Every visitor has their own, and nothing in common."""

import tempfile
import time
from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any
from weakref import WeakSet

from stiction.web.asked import Answer, Query, headline, solved
from stiction.web.fields import got, placed
from stiction.web.working import Latest


@dataclass
class View:
    """How the answer is shown. against: "load" or "mean_separation"; here: the point described in words, None for the middle
    one; tab: which is open; dark, narrow: whether the page is dark, and as narrow as a telephone."""

    against: str = "load"
    here: int | None = None
    tab: str = "Contact"
    dark: bool = False
    narrow: bool = False


_APART = 1.0  # seconds between two changes that are undone one by one
_open: "WeakSet[Explorer]" = WeakSet()


def close_all() -> None:
    """Forget every visitor: the server ends, by a signal that leaves no time for what Python does at the end of a program."""
    for one in list(_open):
        one.close()


class Explorer:
    """The case of one visitor, and whoever wants to know when it has a new answer."""

    def __init__(self, question: Query, answer: Answer):
        self.question, self.answer = question, answer
        self.first = question.tables
        self._opened = question.tables  # the case that has the title
        self._before: list[Mapping[str, Any]] = []  # cases to which `undo` goes back, the last one last
        self._changed = 0.0
        self.good = answer  # the newest without an error
        self.view = View()
        self.rebuild: Callable[[], None] = lambda: None  # makes the form anew, where the case gets other fields
        self.place: AbstractContextManager[Any] = nullcontext()  # of the page, as the field that asked may be gone
        self.open_tab: Callable[[str], object] = lambda name: None
        self._listeners: list[Callable[[], object]] = []
        self.on_wait: Callable[[], None] = lambda: None  # marks what is shown as old, while an answer is awaited
        self._latest = Latest(solved, self._show)
        self._uploads: tempfile.TemporaryDirectory[str] | None = None
        _open.add(self)

    def listen(self, listener: Callable[[], object]) -> None:
        """Call this after every new answer."""
        self._listeners.append(listener)

    def redraw(self) -> None:
        """The same answer, shown anew."""
        with self.place:
            for listener in self._listeners:
                listener()

    def _show(self, answer: Answer) -> None:
        self.answer = answer
        if answer.error is None:
            self.good = answer
        self.redraw()

    async def ask(self, tables: Mapping[str, Any]) -> None:
        """Solve these tables under a title that fits them, and show the result. Another title makes it another case."""
        now, before = time.monotonic(), self.question.tables
        if now - self._changed > _APART:
            self._before.append(before)
        self._changed = now
        await self._ask(tables)

    async def undo(self) -> None:
        """Go back to the case before the last change; what a slider passes within a second is one change."""
        self._changed = 0.0
        if self._before:
            await self._ask(self._before.pop())
            self.rebuild()

    async def open(self, tables: Mapping[str, Any]) -> None:
        """Show another case, with a form of its own."""
        self._changed = 0.0
        await self.ask(tables)
        self.rebuild()

    async def _ask(self, tables: Mapping[str, Any]) -> None:
        if tables.get("title") != self.question.tables.get("title"):
            self._opened = tables
        self.question = self.question.with_tables(_retitled(tables, self._opened))
        self.on_wait()
        await self._latest.ask(self.question)

    async def put(self, path: tuple[str, ...], value: Any) -> None:
        """Solve the case with another value at a place of its tables; None takes it away."""
        await self.ask(placed(self.question.tables, path, value))

    @property
    def waits(self) -> bool:
        """Whether the newest answer is of an earlier case than the one that was asked last."""
        return self.answer.question.tables is not self.question.tables

    @property
    def here(self) -> int:
        """Return the point that is described in words; a prediction has it at its working load."""
        if self.view.here is None or self.good.prediction is not None:
            return self.good.middle()
        return min(self.view.here, self.good.curve["load"].size - 1)

    @property
    def load(self) -> float:
        """Return the load of the point that is described in words, SI or normalised."""
        return float(self.good.at(self.here)["load"])

    @property
    def headline(self) -> tuple[str, str]:
        """The number with the digits that its uncertainty leaves it, and where it holds."""
        return headline(self.good, self.here)

    def upload(self, name: str, content: bytes) -> str:
        """Keep a file that was uploaded in a folder of this visitor, and say its name there: that of its ending only, so that
        it cannot be a path."""
        if self._uploads is None:
            self._uploads = tempfile.TemporaryDirectory(prefix="stiction-")
        ending = "".join(letter for letter in Path(name).suffix.lower() if letter.isalnum())[:12]
        path = Path(self._uploads.name) / (f"upload.{ending}" if ending else "upload")
        path.write_bytes(content)
        self.question = replace(self.question, files=self.question.files | {str(path)})
        return str(path)

    def close(self) -> None:
        """Forget the visitor and delete what they uploaded."""
        self._listeners.clear()
        if self._uploads is not None:
            self._uploads.cleanup()
            self._uploads = None


def _retitled(tables: Mapping[str, Any], opened: Mapping[str, Any]) -> dict[str, Any]:
    """Return the tables with the title of the opened case where bodies and groups are as in it, else one that names them."""
    same = all(tables.get(name) == opened.get(name) for name in ("contact", "indices"))
    title = opened.get("title") if same else _described(tables)
    rest = {name: value for name, value in tables.items() if name != "title"}
    return {"title": title, **rest} if title else rest


def _described(tables: Mapping[str, Any]) -> str:
    """Name the bodies, and the film with its thickness, of a contact; or dimensionless groups."""
    if "contact" not in tables:
        return "Dimensionless groups"
    bodies = " on ".join(_material(tables, body) for body in ("first", "second"))
    if not isinstance(got(tables, ("contact", "coating")), Mapping):
        return bodies.capitalize()
    thickness = got(tables, ("contact", "coating", "thickness"))  # a text; a list or a distribution is too long for a title
    film = f"{_material(tables, 'coating', 'material').capitalize()} film"
    return ", ".join([film, *([thickness] if isinstance(thickness, str) else []), bodies])


def _material(tables: Mapping[str, Any], *place: str) -> str:
    name = got(tables, ("contact", *place, "preset")) or "material of its own"
    return str(name).replace("_", " ")
