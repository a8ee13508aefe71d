"""Where the program keeps what is slow to make: compiled kernels, and the units as they were read."""

import os
from pathlib import Path

import platformdirs

from stiction.quantities.notices import notice


def cache_folder(part: str) -> Path:
    """The folder of a part of the cache; STICTION_CACHE_DIR moves it."""
    root = os.environ.get("STICTION_CACHE_DIR") or platformdirs.user_cache_dir("stiction", appauthor=False)
    return Path(root) / part


def cannot_keep(error: OSError) -> None:
    """Say, once, that the cache takes nothing: results are the same, only slower to come."""
    notice(f"{cache_folder('')} takes no more files ({error.strerror}): what is compiled is not kept for the next time")
