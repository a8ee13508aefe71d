"""Print to terminals and pipes with any encoding, and report write errors in one line."""

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
    """Return ASCII text to replace characters that the output cannot encode, and the position after these characters.

    This is an error handler for `codecs.register_error`. µm² becomes um^2; a character without a replacement becomes "?".
    """
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
    """Make standard output and standard error write ASCII text in place of characters that they cannot encode."""
    for stream in (sys.stdout, sys.stderr):
        with suppress(AttributeError, ValueError):  # an output that a caller replaced stays as it is
            stream.reconfigure(errors="stiction")  # type: ignore[union-attr]


def print_json(content: Any) -> None:
    """Print one JSON object, escaped to ASCII unless the output is encoded as UTF-8."""
    from stiction.report.files import as_json

    everything = (sys.stdout.encoding or "").lower().replace("_", "-").startswith("utf")
    print(as_json(content, only_ascii=not everything))


@contextmanager
def reporting_write_errors() -> Iterator[None]:
    """Return a context manager that reports an OSError, such as a full disk, in one line and exits with code 1."""
    try:
        yield
        sys.stdout.flush()
    except OSError as error:
        exit_on_write_error(error)


def exit_on_write_error(error: OSError) -> NoReturn:
    """Report an OSError in one line and exit with code 1.

    Standard output is redirected to the null device first, so that flushing it at exit cannot fail again.
    """
    with suppress(OSError, ValueError, AttributeError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    where = error.filename or "the output"
    print(f"stiction: {where} cannot be read or written ({error.strerror or error})", file=sys.stderr)
    sys.exit(_UNWRITABLE)


def closed_pipe() -> NoReturn:
    """Raise BrokenPipeError; rich calls this when the program that read the output has ended."""
    raise BrokenPipeError(errno.EPIPE, os.strerror(errno.EPIPE))
