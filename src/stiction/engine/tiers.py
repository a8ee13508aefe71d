"""How much is compiled: nothing yet, shared loops in stages, quick to compile, or one loop for a regime, quicker to run."""

import os

from stiction.quantities.errors import InputError

TIERS = ("auto", "interpreted", "shared", "specialised")
VARIABLE = "STICTION_LOOPS"
# So many pairs of a law and a separation are worth a loop of their own: it takes a second to compile and runs twice as fast.
_WORTH_COMPILING = 100_000
_PAIRS_OF_A_LAW = 8  # at least: a law is summed more than once until its load is found


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
    return little if wanted == TIERS[0] else wanted == TIERS[1]
