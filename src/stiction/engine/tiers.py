"""How much is compiled: nothing yet, shared loops in stages, quick to compile, or one loop for a regime, quicker to run."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from importlib.metadata import version

from stiction.quantities.cache import cache_folder
from stiction.quantities.errors import InputError

TIERS = ("auto", "interpreted", "shared", "specialised")
VARIABLE = "STICTION_LOOPS"
# So many pairs of a law and a separation are worth a loop of their own: it takes a second to compile and runs twice as fast.
_WORTH_COMPILING = 100_000
_PAIRS_OF_A_LAW = 8  # at least: a law is summed more than once until its load is found

_compiled = ContextVar("compiled", default=False)


@contextmanager
def all_compiled() -> Iterator[None]:
    """Compile within what Python else runs at first: results then have the same bits, whichever process computes them."""
    before = _compiled.set(True)
    try:
        yield
    finally:
        _compiled.reset(before)


def tier() -> str:
    """Return which loops are wanted: STICTION_LOOPS, one of TIERS. Raises InputError for any other."""
    wanted = os.environ.get(VARIABLE, TIERS[0])
    if wanted not in TIERS:
        raise InputError(VARIABLE, wanted, ", ".join(TIERS))
    return wanted


def specialised(laws: int, pairs: int = 0) -> bool:
    """Return whether so many laws, at so many pairs of a law and a separation, are summed by a loop compiled for the regime."""
    wanted = tier()
    return max(pairs, _PAIRS_OF_A_LAW * laws) >= _WORTH_COMPILING if wanted == TIERS[0] else wanted == TIERS[-1]


def interpreted(little: bool) -> bool:
    """Return whether Python itself runs what belongs to one law: where it is little work, or where that is wanted."""
    wanted = tier()
    return little and not _compiled.get() if wanted == TIERS[0] else wanted == TIERS[1]


def show_config() -> dict[str, str]:
    """Return how this process computes sums over asperities.

    Returns
    -------
    dict[str, str]
        `stiction`, `numba`: versions. `loops`: which loops run, one of TIERS, as the environment variable STICTION_LOOPS asks;
        `auto` compiles them when that pays. `compiler`: `on`, or `off` where NUMBA_DISABLE_JIT is set. `cache`: folder of
        compiled loops.

    Raises
    ------
    InputError
        For a STICTION_LOOPS that is none of TIERS.

    Examples
    --------
    >>> import stiction as st
    >>> sorted(st.show_config())
    ['cache', 'compiler', 'loops', 'numba', 'stiction']
    """
    import numba

    return {
        "stiction": version("stiction"),
        "numba": numba.__version__,
        "loops": tier(),
        "compiler": "off" if numba.config.DISABLE_JIT else "on",  # type: ignore[attr-defined]
        "cache": str(cache_folder("kernels")),
    }
