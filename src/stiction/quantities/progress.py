"""Define the callbacks that report the progress of long computations.

A progress callback takes a label and returns a function that wraps an iterable of steps.
"""

from collections.abc import Callable, Iterable
from typing import Protocol, TypeVar

_Step = TypeVar("_Step")


class Steps(Protocol):
    """Wrap an iterable of steps, as `iter` or `tqdm.tqdm` does."""

    def __call__(self, steps: Iterable[_Step], /) -> Iterable[_Step]:
        """Yield the steps."""


Progress = Callable[[str], Steps]  # from a label, what wraps its steps


def silent(label: str) -> Steps:
    """Return a progress wrapper that passes an iterable of steps on unchanged and reports nothing."""
    return iter
