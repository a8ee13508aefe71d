"""Resistance of yielded junctions by another law, chosen with the option plastic_junctions.

The law itself is left as it is published: only where it says nothing, from a displacement on or on a whole piece, the other one
answers. It then takes the junction as it is, whatever it wants of the asperity that is still elastic.
"""

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.laws.piece import NormalPiece, TangentialResistance
from stiction.records.registry import NO_JUNCTIONS, TangentialLaw, find, resolve_options

# From a weak interface to full stick.
LAWS = ("bowden_tabor_1943", "tabor_1959", "junction_growth", "brizmer_kligerman_etsion_2007")


def of_whole_piece(plastic_junctions: str, piece: NormalPiece, groups: Groups) -> TangentialResistance | None:
    """Return the resistance of a whole piece by the option plastic_junctions."""
    if plastic_junctions == NO_JUNCTIONS:
        return None
    law = find(plastic_junctions, TangentialLaw)
    return law.tangential_resistance(piece, groups, **resolve_options([law], {}))


@cache
def _from_there_on(published: Callable, own: int, junction: Callable, more: int) -> Any:
    whole = own + more

    @formula
    def resistance(u, w, load, area, *row):
        if w < row[whole]:
            return published(u, w, load, area, *row[:own])
        return junction(u, w, load, area, *row[own:whole])

    return resistance


def beyond(
    plastic_junctions: str, start: np.ndarray, published: TangentialResistance, piece: NormalPiece, groups: Groups
) -> TangentialResistance:
    """Return the published resistance, followed by the option's from `start` (n,) on.

    `start` is a displacement, one of the kinks of the published resistance.
    """
    other = of_whole_piece(plastic_junctions, piece, groups)
    if other is None:
        return published
    own, more = len(published.parameters), len(other.parameters)
    kinks = [one for one in (published.kinks, other.kinks) if one is not None]
    return TangentialResistance(
        _from_there_on(published.resistance, own, other.resistance, more),
        (*published.parameters, *other.parameters, start),
        np.concatenate(kinks, axis=1),
        published.branch,
    )
