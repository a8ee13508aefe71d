"""Send notices to the user as Python warnings of class Notice, which the command line prints as one line each."""

import warnings
from functools import cache


class Notice(UserWarning):
    """Warn of a problem that does not change any result, such as a cache file that cannot be written."""


@cache
def notice(text: str) -> None:
    """Issue a Notice with this text; the same text is issued only once per process."""
    warnings.warn(text, Notice, stacklevel=3)
