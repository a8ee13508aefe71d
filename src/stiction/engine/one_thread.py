"""Run linear algebra on one thread, for computations with many small systems.

Threads do not speed up systems of a few dozen unknowns, and several multithreaded processes slow each other down tenfold. On
one thread, sums are also rounded identically each time, so that results are bit-identical in every process.
"""

from collections.abc import Callable
from functools import cache, wraps
from typing import Any, ParamSpec, TypeVar

_Parameters = ParamSpec("_Parameters")
_Result = TypeVar("_Result")


@cache
def _controller() -> Any:
    from threadpoolctl import ThreadpoolController

    return ThreadpoolController()


def on_one_thread(function: Callable[_Parameters, _Result]) -> Callable[_Parameters, _Result]:
    """Return the function, wrapped so that NumPy's linear algebra inside it runs on one thread."""

    @wraps(function)
    def alone(*args: _Parameters.args, **kwargs: _Parameters.kwargs) -> _Result:
        with _controller().limit(limits=1, user_api="blas"):
            return function(*args, **kwargs)

    return alone
