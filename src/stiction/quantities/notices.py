"""Send notices to the user: a warning in Python, one line in a command."""

import warnings
from functools import cache


class Notice(UserWarning):
    """Report a problem that does not affect the results."""


@cache
def notice(text: str) -> None:
    """Issue a notice, once per process for each text."""
    warnings.warn(text, Notice, stacklevel=3)
