"""Where results are to go: what can be told of a place before anything is computed for it."""

import os
from pathlib import Path

from stiction.quantities.errors import InputError

__all__ = ["require_place"]


def require_place(path: Path, allowed: str) -> None:
    """InputError where nothing new can stand at this path: a name that no system takes, a file where one of its folders should
    be, or a folder above it in which nothing can be made. What stands at the path itself is not looked at."""
    try:
        path.stat()
    except FileNotFoundError:
        pass
    except NotADirectoryError:
        raise InputError("--out", str(path), f"{allowed}; one of the folders in this path is a file") from None
    except (OSError, ValueError) as error:
        why = getattr(error, "strerror", None) or error
        raise InputError("--out", str(path), f"{allowed}; this cannot be one ({why})") from None
    above = next(one for one in path.absolute().parents if one.exists())
    if not os.access(above, os.W_OK | os.X_OK):
        raise InputError("--out", str(path), f"{allowed}; nothing can be written in {above}")
