"""Print the output of commands on any terminal; report in one line where it cannot be written."""

import codecs
import errno
import os
import sys
import unicodedata
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import Any, NoReturn

_UNWRITABLE = 1
_IN_ASCII = {"µ": "u", "μ": "u", "−": "-", "⁻": "-", "·": "*", "×": "x", "σ": "sigma", "Δ": "Delta", "–": "-", "…": "..."}


def _in_ascii(error: UnicodeError) -> tuple[str, int]:
    """Return a replacement for characters that an encoding lacks: "um^2" for µm², and "?" where there is none."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    return "".join(map(_one_in_ascii, error.object[error.start : error.end])), error.end


def _one_in_ascii(character: str) -> str:
    if character in _IN_ASCII:
        return _IN_ASCII[character]
    plain = unicodedata.normalize("NFKD", character).encode("ascii", "ignore").decode()
    return f"^{plain}" if plain.isdigit() else plain or "?"


codecs.register_error("stiction", _in_ascii)


def readable() -> None:
    """Print what the reader's encoding has, and what stands for the rest."""
    for stream in (sys.stdout, sys.stderr):
        with suppress(AttributeError, ValueError):  # what is no text stream is somebody's own
            stream.reconfigure(errors="stiction")  # type: ignore[union-attr]


def print_json(content: Any) -> None:
    """Print one JSON object, with escapes where the reader's encoding lacks characters."""
    from stiction.report.files import as_json

    everything = (sys.stdout.encoding or "").lower().replace("_", "-").startswith("utf")
    print(as_json(content, only_ascii=not everything))


@contextmanager
def said_if_unwritable() -> Iterator[None]:
    """End the program with one line where the output cannot be written: on a full disk, or into a closed pipe."""
    try:
        yield
        sys.stdout.flush()
    except OSError as error:
        give_up_output(error)


def give_up_output(error: OSError) -> NoReturn:
    """End the program, with one line; what is left to be written, at its end, would only fail once more."""
    with suppress(OSError, ValueError, AttributeError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    where = error.filename or "the output"
    print(f"stiction: {where} cannot be read or written ({error.strerror or error})", file=sys.stderr)
    sys.exit(_UNWRITABLE)


def closed_pipe() -> NoReturn:
    """Raise BrokenPipeError, as the reader of the output has gone."""
    raise BrokenPipeError(errno.EPIPE, os.strerror(errno.EPIPE))
