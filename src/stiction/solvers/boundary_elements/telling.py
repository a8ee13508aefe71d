"""Report the progress of a solution to listeners registered by distant callers.

A caller that displays progress does not call the solver directly, so it registers a listener here.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from stiction.solvers.boundary_elements.solve import Progress

_listeners: list[Callable[[Progress], None]] = []


@contextmanager
def telling(listener: Callable[[Progress], None]) -> Iterator[None]:
    """Register a progress listener for all solutions inside a `with` block.

    listener: called with a Progress for each step that is reported.
    """
    _listeners.append(listener)
    try:
        yield
    finally:
        _listeners.remove(listener)


def tell(progress: Progress) -> None:
    """Pass the progress of a solver to all registered listeners."""
    for listener in _listeners:
        listener(progress)
