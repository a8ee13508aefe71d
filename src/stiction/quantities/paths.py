"""Read text files, and check output paths before a computation starts."""

import os
from pathlib import Path

from stiction.quantities.errors import InputError


def read_text(path: Path, field: str, wanted: str, largest: int, name: str | None = None) -> str:
    """Return the text of a UTF-8 file of at most `largest` bytes; raise InputError with the reason if it cannot be read.

    - field: name of the input, for the error message
    - wanted: kind of file that is expected, for the error message
    - name: path as the user wrote it, for the error message; by default `path`
    """
    try:
        why = _not_read(path, largest)
        if not why:
            return path.read_text(encoding="utf-8-sig")  # some editors begin a file with a byte order mark
    except OSError as error:
        why = f"this file cannot be read ({error.strerror})"
    except UnicodeDecodeError:
        why = "this file is not UTF-8 text"
    raise InputError(field, name or str(path), f"{wanted}; {why}")


def _not_read(path: Path, largest: int) -> str:
    if path.is_dir():
        return "this is a directory"
    if not path.is_file():
        return "this is not a regular file" if path.exists() else "this file does not exist"
    return f"this file is larger than {largest} bytes" if path.stat().st_size > largest else ""


def require_place(path: Path, allowed: str, in_place: bool = False) -> None:
    """Raise an InputError if no file or folder could be written at an output path.

    path: value of the option --out. allowed: allowed values, for the error message. in_place: whether an existing file is
    overwritten; otherwise a new file is made next to it and moved. The error is raised for a name that the operating system
    does not accept, for a path with a file in place of a parent folder, and without write permission. The permission is
    checked for the path itself if it is a folder or a file to be overwritten, else for its nearest existing parent folder.
    """
    try:
        path.stat()
    except FileNotFoundError:
        pass
    except NotADirectoryError:
        raise InputError("--out", str(path), f"{allowed}; a parent folder in this path is a file") from None
    except (OSError, ValueError) as error:
        why = getattr(error, "strerror", None) or error
        raise InputError("--out", str(path), f"{allowed}; this path cannot be used ({why})") from None
    full = path.absolute()
    place = next(folder for folder in (full, *full.parents) if folder.is_dir())
    if in_place and full.is_file():
        place = full
    if not os.access(place, os.W_OK if place.is_file() else os.W_OK | os.X_OK):
        raise InputError("--out", str(path), f"{allowed}; no permission to write in {place}")
