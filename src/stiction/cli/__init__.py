"""The command line: a file for each command. What is slow to import is imported inside the commands, so that
`stiction --help` answers at once."""

from stiction.cli import run, compare, surface, figures, lists  # noqa: F401, I001  the order of the help
from stiction.cli.program import app

__all__ = ["app", "main"]


def main() -> None:
    """Entry point of the command `stiction`."""
    app(prog_name="stiction")
