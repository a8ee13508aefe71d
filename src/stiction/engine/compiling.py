"""Report the compilation of kernels: the first use of a model on a computer takes some seconds longer than later uses."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

Tell = Callable[[int, str], None]  # from the number of kernels compiled so far, and the name of the kernel


class _Listener:
    """Count the kernels compiled since the listener was installed."""

    def __init__(self, tell: Tell):
        self.tell, self.done = tell, 0


_listeners: list[_Listener] = []


@contextmanager
def telling(tell: Tell) -> Iterator[None]:
    """Within the context, call tell(count, name) whenever a kernel starts or finishes compiling.

    count: number of kernels compiled so far. name: key of the law whose formulas are in the kernel, or name of a kernel that
    all laws share. `tell` is not called for kernels that are loaded from the cache.
    """
    listener = _Listener(tell)
    _listeners.append(listener)
    try:
        yield
    finally:
        _listeners.remove(listener)


def report(finished: int, name: str) -> None:
    """Tell all listeners that the kernel of this name starts compiling or has been compiled.

    finished: 0 if it starts, 1 if it has been compiled.
    """
    for listener in tuple(_listeners):
        listener.done += finished
        listener.tell(listener.done, name)
