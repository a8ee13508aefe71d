"""Run the examples of exported names, and hold rooms that have them to all sections of the numpydoc standard."""

import doctest
import inspect

import pytest

import stiction as st

ROOMS = ("contact", "surfaces")  # others join as their docstrings get the sections
EXPORTED = {name: getattr(st, name) for name in st.__all__ if callable(getattr(st, name))}


def room_of(name):
    return EXPORTED[name].__module__.removeprefix("stiction.").split(".")[0]


@pytest.mark.parametrize("name", [name for name, value in EXPORTED.items() if ">>> " in (inspect.getdoc(value) or "")])
def test_examples_run(name):
    example = doctest.DocTestParser().get_doctest(inspect.getdoc(EXPORTED[name]), {}, name, None, 0)
    assert example.examples and doctest.DocTestRunner(verbose=False).run(example).failed == 0


@pytest.mark.parametrize("name", [name for name in EXPORTED if room_of(name) in ROOMS])
def test_sections_are_complete(name):
    value, text = EXPORTED[name], inspect.getdoc(EXPORTED[name])
    sections = ["Parameters", "Raises", "Examples", *(["Returns"] if inspect.isfunction(value) else [])]
    assert not [title for title in sections if f"\n{title}\n{'-' * len(title)}\n" not in text]
    parameters = text.split("Parameters\n", 1)[1].split("\n\n", 1)[0]
    fields = [each for each in inspect.signature(value).parameters if each not in ("unnamed_values", "args", "kwargs")]
    assert not [field for field in fields if field not in parameters]
