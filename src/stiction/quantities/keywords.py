"""Describe keyword arguments and field types to editors and type checkers; nothing here changes a computation."""

import inspect
from collections.abc import Callable
from typing import Generic, TypeVar

F = TypeVar("F", bound=Callable)
Value = TypeVar("Value")
Taken = TypeVar("Taken")


class Converted(Generic[Value, Taken]):
    """Declare to type checkers a field that accepts values of type `Taken` and is read as type `Value` (PEP 681)."""

    def __get__(self, record: object, owner: object) -> Value:
        raise NotImplementedError  # only type checkers use this method

    def __set__(self, record: object, value: Taken) -> None:
        raise NotImplementedError


def with_keywords(names: type) -> Callable[[F], F]:
    """Return a decorator that replaces `**kwargs` in the visible signature of a function by named keyword arguments.

    names: a TypedDict with the name and type of each keyword. With total=False each keyword has the default None.
    """

    def named(function: F) -> F:
        signature = inspect.signature(function)
        own = [each for each in signature.parameters.values() if each.kind is not inspect.Parameter.VAR_KEYWORD]
        default = None if getattr(names, "__total__", True) is False else inspect.Parameter.empty
        more = [
            inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=default, annotation=annotation)
            for name, annotation in names.__annotations__.items()
        ]
        function.__signature__ = signature.replace(parameters=[*own, *more])  # type: ignore[attr-defined]
        return function

    return named
