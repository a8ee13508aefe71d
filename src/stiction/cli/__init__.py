"""Define the command line.

What is slow to import is imported inside the commands, so that `stiction --help` answers at once.
"""

import atexit
import gc
import sys

from stiction.cli.interrupting import ended_by_interrupts

with ended_by_interrupts():
    # isort: off
    # In the order of the help.
    from stiction.cli import run, serve, sweep, studies, export, surface, figures, lists  # noqa: F401

    # isort: on
    from stiction.cli.output import readable, said_if_unwritable
    from stiction.cli.program import app
    from stiction.quantities.extras import leave_out

__all__ = ["app", "main"]


def main() -> None:
    """Run the command `stiction`.

    A command is over in seconds, and what it imports lives until then. Looking for reference cycles again and again while it is
    imported, and three times at the end, took a third of the processor time of a run.
    """
    if "sweep" not in sys.argv:  # which alone shares its work by dask
        leave_out("dask")
    leave_out("pint")  # until a unit is read that the table of units does not have
    gc.set_threshold(200_000)
    atexit.register(gc.freeze)
    readable()
    with said_if_unwritable():
        app(prog_name="stiction")
