"""Report the progress of map solutions to registered listeners.

A caller that displays progress, but does not call the solver itself, registers a listener with this module.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from stiction.solvers.boundary_elements.solve import Progress

_listeners: list[Callable[[Progress], None]] = []


@contextmanager
def listening(listener: Callable[[Progress], None]) -> Iterator[None]:
    """Register a callback for the progress of all map solutions inside a `with` block.

    listener: called with each reported Progress.
    """
    _listeners.append(listener)
    try:
        yield
    finally:
        _listeners.remove(listener)


def notify_listeners(progress: Progress) -> None:
    """Pass the progress of a solver to all registered listeners."""
    for listener in _listeners:
        listener(progress)
