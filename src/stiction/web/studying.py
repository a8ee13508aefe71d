"""A study on the page: a button that starts it, how far it is, and a button that stops it."""

import time
from collections.abc import Callable
from typing import Any

from nicegui import context, ui

from stiction.quantities.errors import InputError
from stiction.web.explorer import Explorer
from stiction.web.working import STUDIES, Progress, run

_EVERY = 0.3  # seconds between looks at how far it is


class Study:
    """Run one study at a time for each visitor, and mark its result as old once the case has changed.

    explorer: has the case, None for a result that does not depend on it; work(progress) runs in a thread; show takes its
    result in the loop; done: the text that follows.
    """

    def __init__(
        self,
        explorer: Explorer | None,
        label: str,
        work: Callable[[Progress], Any],
        show: Callable[[Any], None],
        done: str = "",
    ):
        self._explorer, self._work, self._show, self._done = explorer, work, show, done
        self._progress: Progress | None = None
        self._asked: Any = None  # the answer of the case, and its point, of the last run
        self._shown: Any = None  # those of the result that is shown
        with ui.row().classes("items-center gap-3 w-full"):
            self._start = ui.button(label, on_click=self.start).props("no-caps")
            self._stop = ui.button("Stop", on_click=self.stop).props("no-caps outline")
            self._said = ui.label().props('role="status"')
        self._old = ui.label(f"Result of earlier numbers: press “{label}” for the present ones.")
        self._old.classes("text-negative font-bold").props('role="status"')
        self._timer = ui.timer(_EVERY, self._look, active=False)
        self._running(False)
        if explorer is not None:
            explorer.listen(self._mark)
        context.client.on_delete(self.stop)  # who leaves keeps nobody waiting

    @property
    def is_current(self) -> bool:
        """Whether the last run was of the present answer and point."""
        return bool(self._asked == self._present())

    @property
    def is_running(self) -> bool:
        """Whether it is under way."""
        return self._progress is not None

    def _present(self) -> Any:
        return self._explorer and (self._explorer.good, self._explorer.here)

    def _mark(self) -> None:
        self._old.set_visibility(self._shown is not None and self._shown != self._present())

    def _watched(self, progress: Progress) -> Any:
        """The result; its numbers are noted first, so that it is never taken for one of later numbers."""
        self._asked = self._present()
        return self._work(progress)

    async def start(self) -> None:
        """Begin, unless it is under way."""
        if self._progress is not None:
            return
        self._progress = progress = Progress()
        self._running(True)
        said = ""
        try:
            self._show(await run(progress.watched, self._watched, pool=STUDIES))
            self._shown, said = self._asked, self._done
        except InputError as error:
            said = str(error)
        except KeyboardInterrupt:
            said = "stopped: it takes more than a minute, and the command line does it" if progress.too_long else "stopped"
        finally:
            self._progress = None
            self._running(False)
            self._said.set_text(said)

    def stop(self) -> None:
        """End it at its next step."""
        if self._progress is not None:
            self._progress.stop()

    def _running(self, running: bool) -> None:
        self._began = time.monotonic()
        self._start.set_enabled(not running)
        self._stop.set_visibility(running)
        self._timer.active = running
        self._mark()

    def _look(self) -> None:
        progress = self._progress
        if progress is not None:
            share = f" {progress.share:.0%}" if progress.share else ""
            self._said.set_text(f"{progress.text or 'waiting for its turn'}{share}, {time.monotonic() - self._began:.0f} s")
