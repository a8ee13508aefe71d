"""Tells when kernels are compiled: the first use of a model on a machine takes some seconds more than all later ones."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from numba.core import event


class _Kernels(event.Listener):
    """Counts kernels that are compiled, not those that come from the cache, nor the formulas inside them."""

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
    """Formulas are taken in whole by kernels, and have no cache of their own."""
    return event.data["dispatcher"].targetoptions.get("forceinline") is None


@contextmanager
def telling(tell: Callable[[int], None]) -> Iterator[None]:
    """Call tell(number of kernels done) whenever a kernel starts or ends compiling; never, if all are in the cache."""
    with event.install_listener("numba:compile", _Kernels(tell)):
        yield
