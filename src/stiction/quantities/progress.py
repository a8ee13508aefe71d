"""Report the progress of long work: a label and its steps."""

from collections.abc import Callable, Iterable

Steps = Callable[[Iterable], Iterable]  # wraps a list of steps
Progress = Callable[[str], Steps]  # from a label, what wraps its steps


def silent(label: str) -> Steps:
    """Return what wraps steps and reports nothing."""
    return iter
