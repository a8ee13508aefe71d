"""Linear algebra on one thread: small systems, many of them.

Threads gain nothing on systems of some dozens of unknowns; where several processes of a machine have as many each, all of them
wait for each other, ten times as long. And sums are rounded as they are shared out: with one thread the same case has the same
bits, whoever computes it.
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
    """Run a function with numpy's linear algebra on one thread."""

    @wraps(function)
    def alone(*args: _Given.args, **given: _Given.kwargs) -> _Result:
        with _controller().limit(limits=1, user_api="blas"):
            return function(*args, **given)

    return alone
