"""Report the compilation of kernels: the first use of a model on a computer takes some seconds longer than later uses."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from numba.core import event


class _Kernels(event.Listener):
    """Listen to Numba's compile events and count the kernels compiled; cached kernels and inlined formulas do not count."""

    def __init__(self, tell: Callable[[int], None]):
        self.tell, self.done = tell, 0

    def on_start(self, event: Any) -> None:
        if _is_kernel(event):
            self.tell(self.done)

    def on_end(self, event: Any) -> None:
        if _is_kernel(event):
            self.done += 1
            self.tell(self.done)


def _is_kernel(event: Any) -> bool:
    """Return whether a compile event belongs to a kernel; inlined formulas have the option `forceinline`."""
    return event.data["dispatcher"].targetoptions.get("forceinline") is None


@contextmanager
def telling(tell: Callable[[int], None]) -> Iterator[None]:
    """Within the context, call tell(number of kernels compiled so far) whenever a kernel starts or finishes compiling.

    `tell` is not called for kernels that are loaded from the cache.
    """
    with event.install_listener("numba:compile", _Kernels(tell)):
        yield
