"""Rows below a prediction: mu where metals touch bare, and the surfaces it was checked against."""

import json
import math
from functools import cache
from pathlib import Path

import numpy as np

from stiction.contact.interfaces import interface
from stiction.contact.materials import class_of
from stiction.contact.pair import pair_of
from stiction.studies.prediction.area import AreaLaw
from stiction.studies.prediction.junctions import grown
from stiction.studies.prediction.levels import draw_levels
from stiction.studies.prediction.mixture import Mixture

FILE = Path(__file__).parent / "checked.json"  # made by validation/contacts/score.py

_BARE, _METALS = "clean metal", ("metal", "soft metal")
_DRAWS = 256
_WIDE = 1.5  # factor of the area from which on it is no percentage


def bare_metal(mixture: Mixture, level: float) -> list[float]:
    """Return the interval of mu where metals touch below their film or layer: empty where nothing parts two metals.

    The spots are plastic, as strong as clean metal allows, and grow: mu = tau_0/H times the growth of junctions, in which the
    hardness drops out.
    """
    contact = mixture.asked.contact
    bodies = (contact.first, contact.second)
    parted = contact.has_film or (contact.interface is not None and contact.interface.name != _BARE)
    if not parted or any(class_of(body) not in _METALS for body in bodies):
        return []
    ratio = pair_of(*bodies).k if contact.hardness_to_yield is None else contact.hardness_to_yield
    shear_strength = np.full((_DRAWS, 1), 1.0 / (3.0**0.5 * float(np.mean(ratio))))  # over the hardness, as all below
    levels, one = draw_levels(0, _DRAWS, 0), np.ones((_DRAWS, 1))
    strength = np.minimum(interface(_BARE).strength_at(levels["strength"], 1.0)[:, None], shear_strength)
    mu = strength * grown(levels["growth"], one, strength, one, shear_strength)
    return np.quantile(mu, [0.5 - 0.5 * level, 0.5 + 0.5 * level]).tolist()


def checked_against(mixture: Mixture, at: int) -> str:
    """Return what was compared with measurements and solved surfaces, at the load of this number."""
    near = [law for law in mixture.laws if law.far[at] < 1.0]
    share = sum(float(law.weight[at]) for law in near)
    if share > 0.5:
        times = math.exp(sum(float(law.weight[at]) * _half_width(mixture, law, at) for law in near) / share)
        area = (
            f"solved surfaces (area +-{times - 1.0:.0%})"
            if times < _WIDE
            else f"solved surfaces (area within a factor of {times:.2g})"
        )
    else:
        area = "no solved surface near it"
    stated = mixture.asked.contact.interface
    printed = {} if stated is None else printed_contacts().get(stated.name, {})
    if not printed:
        return f"{area}, never against measured friction"
    return f"{area}, {printed['held']} of {printed['contacts']} printed friction values inside"


def _half_width(mixture: Mixture, law: AreaLaw, at: int) -> float:
    """Return half the 90 % width of ln of the area by the error of a law.

    Flowing spots and the nominal area bound it.
    """
    asked, rows = mixture.asked, np.arange(len(law.log_area))
    nominal = np.broadcast_to(asked.column(asked.drawn.nominal_area), (len(rows), 1))
    low, high = (law.corrected(rows, asked.loads, np.full(len(rows), level), nominal)[:, at] for level in (0.95, 0.05))
    return 0.5 * float(np.nanmedian(np.abs(np.log(high / low))))


@cache
def printed_contacts() -> dict[str, dict[str, int]]:
    """Return the number of contacts with printed friction, by state of the interface.

    Also the number of them whose 90 % interval overlaps the printed range.
    """
    return json.loads(FILE.read_text(encoding="utf-8"))
