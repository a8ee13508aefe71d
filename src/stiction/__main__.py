"""`python -m stiction`, where the command is not on the path."""

from stiction.cli import main

main()
