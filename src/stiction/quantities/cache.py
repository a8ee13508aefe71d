"""Write files to the cache on disk, and delete old ones; the cache contains results that can be computed again."""

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
    """Return the folder of one part of the cache on disk.

    part: name of the subfolder, such as "points". Its parent is the path in the environment variable STICTION_CACHE_DIR, or
    else the user's cache folder for stiction. The folder is not created.
    """
    root = os.environ.get("STICTION_CACHE_DIR") or platformdirs.user_cache_dir("stiction", appauthor=False)
    return Path(root) / part


def is_private(folder: Path) -> bool:
    """Return whether only the user who runs this process can write to a folder.

    The result is also True if the folder does not exist, and on systems without file owners (Windows).
    """
    try:
        about = folder.stat()
    except OSError:
        return True
    return not hasattr(os, "geteuid") or (about.st_uid == os.geteuid() and not about.st_mode & 0o022)


def keep_file(path: Path, write: Callable[[BinaryIO], object], most: int) -> None:
    """Write a file to the cache, then delete old cache files with the same suffix in the same folder.

    - path: path of the file
    - write: function that writes the content to an open binary file
    - most: largest allowed total size [bytes] of the files with this suffix; the least recently used files are deleted first

    Files unused for 90 days are deleted too, judged by the modification time, which every use of a file updates. The file is
    written completely or not at all. If it cannot be written, for instance because the disk is full, a notice is issued instead
    of an error.
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
    """Delete cache files unused for 90 days, then the least recently used files until at most `most` bytes remain.

    path: a file of the cache; only files in its folder with the same suffix are counted and deleted. Files that another process
    has already deleted are skipped.
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
