"""Give yielded junctions the resistance of another law, which the option plastic_junctions selects.

The published law stays unchanged. The other law is used only where the published law gives no resistance: beyond a displacement
or on a whole segment. The requirements of the other law on elastic asperities are not checked there.
"""

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.laws.segment import NormalSegment, TangentialResistance
from stiction.records.registry import NO_JUNCTIONS, TangentialLaw, find, resolve_options

# In the order from a weak interface to full stick.
LAWS = ("bowden_tabor_1943", "tabor_1959", "junction_growth", "brizmer_kligerman_etsion_2007")


def of_whole_segment(plastic_junctions: str, segment: NormalSegment, groups: Groups) -> TangentialResistance | None:
    """Return the resistance of a plastic segment by the law with the key `plastic_junctions`; None for the key "none".

    The options of that law have their default values. groups: dimensionless groups of n contacts.
    """
    if plastic_junctions == NO_JUNCTIONS:
        return None
    law = find(plastic_junctions, TangentialLaw)
    return law.tangential_resistance(segment, groups, **resolve_options([law], {}))


@cache
def _from_there_on(published: Callable, own: int, junction: Callable, more: int) -> Any:
    count = own + more

    @formula
    def resistance(u, w, load, area, *row):
        if w < row[count]:
            return published(u, w, load, area, *row[:own])
        return junction(u, w, load, area, *row[own:count])

    return resistance


def beyond(
    plastic_junctions: str, start: np.ndarray, published: TangentialResistance, segment: NormalSegment, groups: Groups
) -> TangentialResistance:
    """Return a resistance that equals `published` below the displacement `start`, and follows another law from there on.

    start (n,): displacement in units of sigma, which must be a kink of `published`, because none is added here.
    plastic_junctions: key of the other tangential law, or "none", which returns `published` unchanged. groups: dimensionless
    groups of n contacts.
    """
    other = of_whole_segment(plastic_junctions, segment, groups)
    if other is None:
        return published
    own, more = len(published.parameters), len(other.parameters)
    kinks = [array for array in (published.kinks, other.kinks) if array is not None]
    return TangentialResistance(
        _from_there_on(published.resistance, own, other.resistance, more),
        (*published.parameters, *other.parameters, start),
        np.concatenate(kinks, axis=1),
        published.branch,
    )
