"""Run computations in threads, outside the event loop that serves browsers; skip outdated queries; time out studies."""

import asyncio
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Executor, ThreadPoolExecutor
from functools import partial
from typing import Any, Generic, TypeVar

from stiction.engine.stopping import stopped_by
from stiction.quantities.errors import InputError

_T = TypeVar("_T")
LONGEST = 60.0  # seconds, time limit of a study
# All visitors share these threads.
QUICK: Executor = ThreadPoolExecutor(2, thread_name_prefix="quick")
STUDIES: Executor = ThreadPoolExecutor(1, thread_name_prefix="study")


async def run(work: Callable[..., _T], *arguments: Any, pool: Executor = QUICK) -> _T:
    """Run a function with its arguments in a thread of a pool, and return its result."""
    return await asyncio.get_running_loop().run_in_executor(pool, partial(work, *arguments))


class Latest(Generic[_T]):
    """Run a function in a thread for one query at a time, and skip all waiting queries but the newest.

    A query is the tuple of arguments of the function. work: the function. show: called in the event loop with the result of
    `work`. refuse: called with an InputError that `work` raised.
    """

    def __init__(self, work: Callable[..., _T], show: Callable[[_T], object], refuse: Callable[[InputError], object] = print):
        self._work, self._show, self._refuse = work, show, refuse
        self._waiting: tuple[Any, ...] | None = None
        self._running = False

    @property
    def is_waiting(self) -> bool:
        """Return whether a newer query waits for its result."""
        return self._waiting is not None

    async def ask(self, *arguments: Any) -> None:
        """Run the function for this query; during another run, the query waits and replaces a query that already waits."""
        self._waiting = arguments
        if self._running:
            return
        self._running = True
        try:
            while self._waiting is not None:
                query, self._waiting = self._waiting, None
                try:
                    result = await run(self._work, *query)
                except InputError as error:
                    self._refuse(error)
                else:
                    self._show(result)
        finally:
            self._running = False


class Progress:
    """Record the progress of a study, and stop the study on request or after a time limit.

    seconds: the time limit.
    """

    def __init__(self, seconds: float = LONGEST) -> None:
        self._seconds = seconds
        self._end = time.monotonic() + seconds
        self.text = ""
        self.share = 0.0
        self.too_long = False
        self._stop = threading.Event()

    def stop(self) -> None:
        """Stop the study before its next kernel or its next step."""
        self._stop.set()

    def watched(self, work: Callable[["Progress"], _T]) -> _T:
        """Call `work` with this Progress in the current thread, and return its result.

        Raises KeyboardInterrupt within `work` when the study is stopped or times out. The time limit starts here, so that
        waiting for earlier studies does not count.
        """
        self._end = time.monotonic() + self._seconds
        self.check()
        with stopped_by(self.check):
            return work(self)

    def check(self) -> None:
        """Raise KeyboardInterrupt, as Ctrl+C in a terminal does, if the study was stopped or has timed out."""
        self.too_long = time.monotonic() > self._end
        if self._stop.is_set() or self.too_long:
            raise KeyboardInterrupt

    def __call__(self, text: str) -> Callable[[Iterable], Iterator]:
        """Return a function that wraps a list of steps and records each step as progress.

        text: label of the steps. Before each step, `check` may raise KeyboardInterrupt.
        """

        def wrapped(steps: Iterable) -> Iterator:
            listed = list(steps)
            for at, step in enumerate(listed):
                self.check()
                self.text, self.share = text, at / len(listed)
                yield step
            self.share = 1.0

        return wrapped

    def tell(self, count: int, text: str) -> None:
        """Record the number of tried designs, `count`, and a text on their maximum; raise KeyboardInterrupt as `check` does."""
        self.check()
        self.text, self.share = f"{count} designs tried, {text}", 0.0
