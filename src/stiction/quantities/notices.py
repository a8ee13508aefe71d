"""Notices to users: given once, as a warning in Python and as one line by a command."""

import warnings
from functools import cache


class Notice(UserWarning):
    """Something is not as it should be, and the results are right all the same."""


@cache
def notice(text: str) -> None:
    """Say it, once in a process."""
    warnings.warn(text, Notice, stacklevel=3)
