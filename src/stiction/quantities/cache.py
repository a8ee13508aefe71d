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
    """Return whether only this user can write to a folder; True where there is none yet, and on systems without owners."""
    try:
        about = folder.stat()
    except OSError:
        return True
    return not hasattr(os, "geteuid") or (about.st_uid == os.geteuid() and not about.st_mode & 0o022)


def keep_file(path: Path, write: Callable[[BinaryIO], object], most: int) -> None:
    """Write a file to the cache and delete old files of the same kind: unused for 90 days, or beyond `most` bytes.

    The file is written completely or not at all. A full disk or missing permission gives a notice, not an error: results do
    not depend on the cache.
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
        notice(f"{reason}: what is compiled is not kept for the next time")


def _delete_oldest(path: Path, most: int) -> None:
    """Delete files that were not used for long, as those of earlier versions, and others until the rest has `most` bytes.

    The least recently used files are deleted first. Another process may delete the same files at the same time.
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
