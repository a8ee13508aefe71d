"""Run linear algebra on one thread, for computations with many small systems.

Threads do not speed up systems of some dozens of unknowns, and several processes with many threads each slow each other down
tenfold. On one thread, sums are also rounded the same way each time: the same case gives the same bits in every process.
"""

from collections.abc import Callable
from functools import cache, wraps
from typing import Any, ParamSpec, TypeVar

_Given = ParamSpec("_Given")
_Result = TypeVar("_Result")


@cache
def _controller() -> Any:
    from threadpoolctl import ThreadpoolController

    return ThreadpoolController()


def on_one_thread(function: Callable[_Given, _Result]) -> Callable[_Given, _Result]:
    """Return the function, wrapped so that NumPy's linear algebra inside it runs on one thread."""

    @wraps(function)
    def alone(*args: _Given.args, **given: _Given.kwargs) -> _Result:
        with _controller().limit(limits=1, user_api="blas"):
            return function(*args, **given)

    return alone
