"""Add a study to the page: a button that starts it, its progress, and a button that stops it."""

import time
from collections.abc import Callable
from typing import Any

from nicegui import context, ui

from stiction.quantities.errors import InputError
from stiction.web.background import STUDIES, Progress, run
from stiction.web.explorer import Explorer

_EVERY = 0.3  # seconds between updates of the shown progress


class Study:
    """Add a study to the page: a button that starts it, a button that stops it, and its progress.

    The study cannot be started again while it runs. After a change of the case, a result is marked as old. explorer: state of
    the visitor; None if the result does not depend on the case. work: function of a Progress that computes the result in a
    thread. show: receives the result in the event loop. done: text after the run.
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
        self._asked: Any = None  # (answer, point) that the last run used
        self._shown: Any = None  # (answer, point) of the shown result
        with ui.row().classes("items-center gap-3 w-full"):
            self._start = ui.button(label, on_click=self.start).props("no-caps")
            self._stop = ui.button("Stop", on_click=self.stop).props("no-caps outline")
            self._text = ui.label().props('role="status"')
        self._old = ui.label(f"This result belongs to earlier numbers: press “{label}” to update it.")
        self._old.classes("text-negative font-bold").props('role="status"')
        self._timer = ui.timer(_EVERY, self._watch, active=False)
        self._set_running(False)
        if explorer is not None:
            explorer.listen(self._mark)
        context.client.on_delete(self.stop)  # a visitor who leaves must not keep others waiting

    @property
    def is_current(self) -> bool:
        """Return whether the last run used the present answer at the present point of the curve."""
        return bool(self._asked == self._present())

    @property
    def is_running(self) -> bool:
        """Return whether the study is running."""
        return self._progress is not None

    def _present(self) -> Any:
        return self._explorer and (self._explorer.answer, self._explorer.point)

    def _mark(self) -> None:
        self._old.set_visibility(self._shown is not None and self._shown != self._present())

    def _watched(self, progress: Progress) -> Any:
        """Run the study and return its result, after recording the answer that the study uses.

        If the case changes during the run, the result is thus marked as old.
        """
        self._asked = self._present()
        return self._work(progress)

    async def start(self) -> None:
        """Run the study and show its result, unless the study is running already."""
        if self._progress is not None:
            return
        self._progress = progress = Progress()
        self._set_running(True)
        text = ""
        try:
            self._show(await run(progress.watched, self._watched, pool=STUDIES))
            self._shown, text = self._asked, self._done
        except InputError as error:
            text = str(error)
        except KeyboardInterrupt:
            text = "stopped after a minute: run it on the command line" if progress.too_long else "stopped"
        finally:
            self._progress = None
            self._set_running(False)
            self._text.set_text(text)

    def stop(self) -> None:
        """Stop the study."""
        if self._progress is not None:
            self._progress.stop()

    def _set_running(self, running: bool) -> None:
        self._began = time.monotonic()
        self._start.set_enabled(not running)
        self._stop.set_visibility(running)
        self._timer.active = running
        self._mark()

    def _watch(self) -> None:
        if (progress := self._progress) is not None:
            share = f" {progress.share:.0%}" if progress.share else ""
            self._text.set_text(f"{progress.text or 'waiting for its turn'}{share}, {time.monotonic() - self._began:.0f} s")
