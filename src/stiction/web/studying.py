"""A study on the page: a button that starts it, how far it is, and a button that stops it."""

import time
from collections.abc import Callable
from typing import Any

from nicegui import context, ui

from stiction.quantities.errors import InputError
from stiction.web.working import STUDIES, Progress, run

__all__ = ["Study"]

_EVERY = 0.3  # seconds between looks at how far it is


class Study:
    """One at a time for each visitor. work(progress), in a thread, gives what show takes, in the loop; done: what is said
    then."""

    def __init__(self, label: str, work: Callable[[Progress], Any], show: Callable[[Any], None], done: str = ""):
        self._work, self._show, self._done = work, show, done
        self._progress: Progress | None = None
        self._began = 0.0
        with ui.row().classes("items-center gap-3 w-full"):
            self._start = ui.button(label, on_click=self.start).props("no-caps")
            self._stop = ui.button("Stop", on_click=self.stop).props("no-caps outline")
            self._said = ui.label().props('role="status"')
        self._timer = ui.timer(_EVERY, self._look, active=False)
        self._stop.set_visibility(False)
        context.client.on_delete(self.stop)  # who leaves keeps nobody waiting

    async def start(self) -> None:
        """Begin, unless it is under way."""
        if self._progress is not None:
            return
        self._progress = progress = Progress()
        self._began = time.monotonic()
        self._running(True)
        said = ""
        try:
            self._show(await run(progress.watched, self._work, pool=STUDIES))
            said = self._done
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
        self._start.set_enabled(not running)
        self._stop.set_visibility(running)
        self._timer.active = running

    def _look(self) -> None:
        progress = self._progress
        if progress is not None:
            share = f" {progress.share:.0%}" if progress.share else ""
            self._said.set_text(f"{progress.text or 'waiting for its turn'}{share}, {time.monotonic() - self._began:.0f} s")
