"""Manage the cache on disk: files that are slow to compute and can be computed again."""

import os
import time
import uuid
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import BinaryIO

import platformdirs

from stiction.quantities.notices import notice

_UNUSED = 90 * 24 * 3600.0  # seconds after which a file that nobody used is deleted


def cache_folder(part: str) -> Path:
    """Return the folder of one part of the cache; the environment variable STICTION_CACHE_DIR sets the parent folder."""
    root = os.environ.get("STICTION_CACHE_DIR") or platformdirs.user_cache_dir("stiction", appauthor=False)
    return Path(root) / part


def is_private(folder: Path) -> bool:
    """Return whether only this user can write to a folder.

    Also return True if the folder does not exist, and on systems that have no file owners (Windows).
    """
    try:
        about = folder.stat()
    except OSError:
        return True
    return not hasattr(os, "geteuid") or (about.st_uid == os.geteuid() and not about.st_mode & 0o022)


def keep_file(path: Path, write: Callable[[BinaryIO], object], most: int) -> None:
    """Write a file to the cache, and delete old files that have the same suffix.

    write: function that writes the content to an open binary file. most: largest total size of such files in bytes. Files
    unused for 90 days are deleted too. The file is written completely or not at all. A full disk or missing permission gives a
    notice, not an error: results do not depend on the cache.
    """
    part = path.with_suffix(f".{uuid.uuid4().hex}")
    try:
        path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        with part.open("wb") as file:
            write(file)
        part.replace(path)
        _delete_oldest(path, most)
    except OSError as error:
        with suppress(OSError):
            part.unlink(missing_ok=True)
        reason = f"{cache_folder('')} takes no more files ({error.strerror})"
        notice(f"{reason}: the cache file is not written; later runs compute it again")


def _delete_oldest(path: Path, most: int) -> None:
    """Delete cache files that were unused for 90 days, and the least recently used ones beyond a total of `most` bytes.

    path: a file of the cache; only files in its folder with its suffix are deleted. Another process may delete the same files
    at the same time.
    """
    known = []
    for file in path.parent.glob(f"*{path.suffix}"):
        with suppress(FileNotFoundError):
            known.append((file.stat().st_mtime, file.stat().st_size, file))
    total, too_old = 0, time.time() - _UNUSED
    for used, size, file in sorted(known, reverse=True):
        total += size
        if total > most or used < too_old:
            file.unlink(missing_ok=True)
