"""Report the compilation of loops to callbacks, because the first use of a model on a computer takes several seconds longer."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

Tell = Callable[[int, str], None]  # takes the number of kernels compiled so far and the name of the current kernel


class _Listener:
    """Store a callback and the number of kernels (compiled loops) compiled since the callback was installed.

    tell: callback that takes this number and the name of a kernel.
    """

    def __init__(self, tell: Tell):
        self.tell, self.done = tell, 0


_listeners: list[_Listener] = []


@contextmanager
def telling(tell: Tell) -> Iterator[None]:
    """Return a context manager that calls tell(count, name) when a kernel (a compiled loop) starts or finishes compiling.

    count: number of kernels compiled since the context was entered. name: key of the law whose formulas are in the kernel, or
    the name of a kernel that all laws share. `tell` is not called for kernels that are loaded from the disk cache.
    """
    listener = _Listener(tell)
    _listeners.append(listener)
    try:
        yield
    finally:
        _listeners.remove(listener)


def report(finished: int, name: str) -> None:
    """Call all installed listeners because the kernel of this name starts or finishes compiling.

    finished: 0 if it starts, 1 if it has been compiled.
    """
    for listener in tuple(_listeners):
        listener.done += finished
        listener.tell(listener.done, name)
