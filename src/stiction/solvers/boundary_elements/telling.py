"""Tells how far a solution is, to whoever asked to be told: the solver is called many rooms below who shows it."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from stiction.solvers.boundary_elements.solve import Progress

_listeners: list[Callable[[Progress], None]] = []


@contextmanager
def telling(listener: Callable[[Progress], None]) -> Iterator[None]:
    """Call the listener before every step of every solution inside."""
    _listeners.append(listener)
    try:
        yield
    finally:
        _listeners.remove(listener)


def tell(progress: Progress) -> None:
    """Report a step of a solver to the listener."""
    for listener in _listeners:
        listener(progress)
