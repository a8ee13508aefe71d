"""Run the command line as `python -m stiction`, for systems where the command `stiction` is not on the path."""

from stiction.cli import main

main()
