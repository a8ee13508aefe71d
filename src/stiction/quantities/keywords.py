"""Show the names of keyword arguments that a typed dictionary holds."""

import inspect
from collections.abc import Callable
from typing import TypeVar

F = TypeVar("F", bound=Callable)


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
