"""The shell completes commands, options and keys of models."""

import pytest
from typer.testing import CliRunner

from stiction.cli import app
from stiction.records.registry import RoughSurface, TangentialLaw, of_kind


def completed(words: str) -> list[str]:
    """What bash is told for the last of these words."""
    environment = {"_STICTION_COMPLETE": "complete_bash", "COMP_WORDS": words, "COMP_CWORD": str(len(words.split(" ")) - 1)}
    result = CliRunner().invoke(app, [], prog_name="stiction", env=environment)
    assert result.exit_code == 0, result.output
    return result.output.split()


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        ("stiction ru", ["run"]),
        ("stiction run --all", ["--all-rows"]),
        ("stiction run --model ", list(of_kind(RoughSurface))),
        ("stiction run --model gr", [key for key in of_kind(RoughSurface) if key.startswith("gr")]),
        ("stiction run --tangential ", [*of_kind(TangentialLaw), "none"]),
        ("stiction run --film gr", ["graded"]),
        ("stiction models persson_2001", ["persson_2001", "persson_2001_elastoplastic"]),
    ],
)
def test_words_are_completed(words, expected):
    assert completed(words) == expected and expected


def test_the_help_says_how_to_install_it():
    assert "--install-completion" in CliRunner().invoke(app, ["--help"]).output
