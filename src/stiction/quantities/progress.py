"""Define the callbacks that report the progress of long computations.

A progress callback takes a label and returns a function that wraps an iterable of steps.
"""

from collections.abc import Callable, Iterable

Steps = Callable[[Iterable], Iterable]  # wraps a list of steps
Progress = Callable[[str], Steps]  # from a label, what wraps its steps


def silent(label: str) -> Steps:
    """Return a progress wrapper that passes an iterable of steps on unchanged and reports nothing."""
    return iter
