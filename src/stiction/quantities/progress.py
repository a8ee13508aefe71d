"""Define the callbacks that report the progress of long computations.

A progress callback takes a label, such as "solving", and returns a function. This function takes an iterable of steps and
returns an iterable over the same steps, which may report each one.
"""

from collections.abc import Callable, Iterable
from typing import Protocol, TypeVar

_Step = TypeVar("_Step")


class Steps(Protocol):
    """Describe a function that returns an iterable over the given steps, as `iter` or `tqdm.tqdm` does."""

    def __call__(self, steps: Iterable[_Step], /) -> Iterable[_Step]:
        """Yield the given steps in order, possibly reporting each one to the user."""


Progress = Callable[[str], Steps]


def silent(label: str) -> Steps:
    """Return the function `iter`, which yields the steps without reporting progress; the label is ignored."""
    return iter
