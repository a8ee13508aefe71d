"""Work beside the loop that talks to the browser: threads for what is quick, one for studies, and only the newest question."""

import asyncio
import ctypes
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Executor, ThreadPoolExecutor
from functools import partial
from typing import Any, Generic, TypeVar

from stiction.quantities.errors import InputError

_T = TypeVar("_T")
LONGEST = 60.0  # seconds of a study
# Nothing is shared between users but these threads. Two do the work of two cores; what waits is asked anew when it is its turn.
QUICK: Executor = ThreadPoolExecutor(2, thread_name_prefix="quick")
STUDIES: Executor = ThreadPoolExecutor(1, thread_name_prefix="study")


async def run(work: Callable[..., _T], *arguments: Any, pool: Executor = QUICK) -> _T:
    """The result of some work, done in a thread."""
    return await asyncio.get_running_loop().run_in_executor(pool, partial(work, *arguments))


class Latest(Generic[_T]):
    """Asks for some work, one at a time: of questions that come while it is under way only the newest is asked.

    work: what is done, in a thread; show: what is done with the result, in the loop; refuse: with why there is none.
    """

    def __init__(self, work: Callable[..., _T], show: Callable[[_T], object], refuse: Callable[[str], object] = print):
        self._work, self._show, self._refuse = work, show, refuse
        self._waiting: tuple[Any, ...] | None = None
        self._running = False

    async def ask(self, *arguments: Any) -> None:
        """Answer this question, or leave it to whoever answers one already."""
        self._waiting = arguments
        if self._running:
            return
        self._running = True
        try:
            while self._waiting is not None:
                question, self._waiting = self._waiting, None
                try:
                    self._show(await run(self._work, *question))
                except InputError as error:
                    self._refuse(str(error))
        finally:
            self._running = False


class Progress:
    """How far a study is, and how it is stopped: what the studies take as `progress` and as `tell`. After so many seconds it is
    stopped by itself."""

    def __init__(self, seconds: float = LONGEST) -> None:
        self._seconds = seconds
        self._end = time.monotonic() + seconds
        self.text = ""
        self.share = 0.0
        self.too_long = False
        self._stop = threading.Event()
        self._thread: int | None = None
        self._guard = threading.Lock()

    def stop(self) -> None:
        """End the study, also within a step."""
        self._stop.set()
        self._interrupt()

    def watched(self, work: Callable[["Progress"], _T]) -> _T:
        """The result of the work, in this thread, which is interrupted when it is to be stopped or has taken its time; that
        begins here, and not while others have their turn."""
        self._end = time.monotonic() + self._seconds
        late = threading.Timer(self._seconds, self._interrupt)
        late.daemon = True
        try:
            with self._guard:
                self.check()
                self._thread = threading.get_ident()
            late.start()
            found = work(self)
        finally:
            late.cancel()
            with self._guard:  # an interrupt that was sent has arrived
                self._thread = None
        return found

    def _interrupt(self) -> None:
        """KeyboardInterrupt in the thread of the work: a step of a study may take minutes, and others wait for their turn."""
        with self._guard:
            if self._thread is not None:
                self.too_long = time.monotonic() > self._end
                ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(self._thread), ctypes.py_object(KeyboardInterrupt))
                self._thread = None

    def check(self) -> None:
        """KeyboardInterrupt, as of a user at a terminal, where it is to be stopped."""
        self.too_long = time.monotonic() > self._end
        if self._stop.is_set() or self.too_long:
            raise KeyboardInterrupt

    def __call__(self, text: str) -> Callable[[Iterable], Iterator]:
        """A wrapper of a list of steps."""

        def wrapped(steps: Iterable) -> Iterator:
            listed = list(steps)
            for at, one in enumerate(listed):
                self.check()
                self.text, self.share = text, at / len(listed)
                yield one
            self.share = 1.0

        return wrapped

    def tell(self, count: int, text: str) -> None:
        """Told how many designs were asked, and the best so far."""
        self.check()
        self.text, self.share = f"{count} designs asked: {text}", 0.0
