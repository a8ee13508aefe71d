"""Tell editors and type checkers which keyword arguments there are, and what they take."""

import inspect
from collections.abc import Callable
from typing import Generic, TypeVar

F = TypeVar("F", bound=Callable)
Value = TypeVar("Value")
Taken = TypeVar("Taken")


class Converted(Generic[Value, Taken]):
    """Describe a field of a record to type checkers: the type that is read, and the types that are taken (PEP 681)."""

    def __get__(self, record: object, owner: object) -> Value:
        raise NotImplementedError  # for type checkers alone

    def __set__(self, record: object, value: Taken) -> None:
        raise NotImplementedError


def with_keywords(names: type) -> Callable[[F], F]:
    """Return a decorator that shows each name of a TypedDict in the signature, in place of `**kwargs`."""

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
