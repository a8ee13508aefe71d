"""Let long computations be stopped from another thread: their loops ask before each step whether they may go on.

An exception raised in the thread from outside would not do, because it may come while a library holds a lock. The lock is then
never released. Numba's lock of the compiler, for example, would block every later computation of the process.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar

_check: ContextVar[Callable[[], None] | None] = ContextVar("check", default=None)


@contextmanager
def stopped_by(check: Callable[[], None]) -> Iterator[None]:
    """Within the context, call `check` before each kernel and before each step of a map solver.

    check: raises KeyboardInterrupt if the computation must stop.
    """
    before = _check.set(check)
    try:
        yield
    finally:
        _check.reset(before)


def may_go_on() -> None:
    """Call the check of the current context, which may raise KeyboardInterrupt."""
    check = _check.get()
    if check is not None:
        check()
