"""Define the command line `stiction`.

Slow libraries are imported inside the commands that need them, so that `stiction --help` is printed at once.
"""

import atexit
import gc

from stiction.cli.interrupting import ended_by_interrupts

with ended_by_interrupts():
    # isort: off
    # The order of the commands in the help.
    from stiction.cli import run, serve, sweep, studies, export, surface, figures, lists  # noqa: F401

    # isort: on
    from stiction.cli.output import readable, reporting_write_errors
    from stiction.cli.program import app
    from stiction.quantities.extras import leave_out

__all__ = ["app", "main"]


def main() -> None:
    """Run the command `stiction`.

    Garbage collection is set to run rarely, because a command ends within seconds, and collections during its imports took a
    third of its processor time.
    """
    leave_out("dask")  # imported only if a cluster computes a sweep
    leave_out("pint")  # imported only for a unit that the table of units lacks
    gc.set_threshold(200_000)
    atexit.register(gc.freeze)
    readable()
    with reporting_write_errors():
        app(prog_name="stiction")
