"""Compute additions to a prediction: mu of the bare metals, and how benchmark surfaces and handbooks support it."""

import json
import math
from functools import cache
from pathlib import Path

import numpy as np

from stiction.contact.interfaces import interface
from stiction.contact.materials import class_of
from stiction.contact.pair import Pair
from stiction.studies.prediction.area import AreaLaw
from stiction.studies.prediction.junctions import grown
from stiction.studies.prediction.levels import draw_levels
from stiction.studies.prediction.mixture import Mixture

FILE = Path(__file__).parent / "checked.json"  # made by validation/contacts/score.py

_BARE, _METALS = "clean metal", ("metal", "soft metal")
_UNPARTED = (_BARE, "oxidised metal", "gold contact")  # an oxide that is rubbed off forms again in air
_DRAWS = 256
_WIDE = 1.5  # error factor of the area from which it is shown as a factor instead of a percentage
_ENOUGH, _UNLIKE = 3, 1.5  # least number of handbook contacts, and factor beyond their mu, for a warning (judgements)
_LEAST = 0.01  # smallest error of the area that is shown, because the solved surfaces are not more accurate


def bare_metal(mixture: Mixture, level: float) -> list[float]:
    """Return the interval [low, high] of mu for two metals where the film or surface layer between them is worn away.

    level: coverage probability of the interval. The list is empty if a body is not a metal, or if the contact has neither a
    film nor a stated interface other than clean metal, oxidised metal and gold contact. The contact spots are plastic, have the
    shear strength tau_0 of clean metal, limited to the shear strength of the softer body, and grow under shear. As tau_0 is
    proportional to the hardness H, mu = tau_0/H times the junction growth does not depend on H.
    """
    contact = mixture.sampled.contact
    bodies = (contact.first, contact.second)
    parted = contact.has_film or (contact.interface is not None and contact.interface.name not in _UNPARTED)
    if not parted or any(class_of(body) not in _METALS for body in bodies):
        return []
    ratio = Pair(*bodies).k if contact.hardness_to_yield is None else contact.hardness_to_yield
    shear_strength = np.full((_DRAWS, 1), 1.0 / (3.0**0.5 * float(np.mean(ratio))))  # over hardness
    levels, ones = draw_levels(0, _DRAWS, 0), np.ones((_DRAWS, 1))
    strength = np.minimum(interface(_BARE).strength_at(levels["strength"], 1.0)[:, None], shear_strength)
    mu = strength * grown(levels["growth"], ones, strength, ones, shear_strength)
    return np.quantile(mu, [0.5 - 0.5 * level, 0.5 + 0.5 * level]).tolist()


def checked_against(mixture: Mixture, index: int) -> str:
    """Return a text on how well benchmark surfaces and measured friction support a prediction.

    index: position of the load among the loads of the prediction.
    """
    near = [law for law in mixture.laws if law.far[index] < 1.0]
    share = sum(float(law.weight[index]) for law in near)
    if share > 0.5:
        times = math.exp(sum(float(law.weight[index]) * _half_width(mixture, law, index) for law in near) / share)
        area = (
            f"solved surfaces (area ±{max(times - 1.0, _LEAST):.0%})"
            if times < _WIDE
            else f"solved surfaces (area within a factor of {times:.2g})"
        )
    else:
        area = "no similar solved surface"
    held, contacts = in_handbooks(mixture)
    if not contacts:
        return f"{area}, never against measured friction"
    return f"{area}; right for {held} of {contacts} handbook contacts with this interface"


def in_handbooks(mixture: Mixture) -> tuple[int, int]:
    """Return how many handbook contacts with this interface are predicted correctly, and how many there are.

    Only contacts with the interface state that `mixture` has count; the result is (0, 0) if no state is stated, or no handbook
    contact has it. A contact is predicted correctly if its predicted 90 % interval contains the geometric mean of the published
    range of mu.
    """
    published = _published(mixture)
    return int(published.get("held", 0)), int(published.get("contacts", 0))


def unlike_handbooks(mixture: Mixture, mu: float) -> list[str]:
    """Return a list with a warning if mu is far outside the range of mu in handbooks for this interface; else [].

    mu: median of the prediction. The warning is given below 1/1.5 of the lowest and above 1.5 times the highest mu, if
    handbooks have at least three contacts with this interface.
    """
    published = _published(mixture)
    if published.get("contacts", 0) < _ENOUGH or published["lowest"] / _UNLIKE <= mu <= published["highest"] * _UNLIKE:
        return []
    side, advice = ("below", "check the interface") if mu < published["lowest"] else ("above", "give a scan of the surface")
    ends = f"{published['lowest']:.2g} to {published['highest']:.2g}"
    return [f"mu is far {side} all {published['contacts']} handbook contacts with this interface, {ends}: {advice}."]


def _published(mixture: Mixture) -> dict[str, float]:
    """Return the entry of `published_contacts` for the interface state of the contact, empty if there is none."""
    stated = mixture.sampled.contact.interface
    return {} if stated is None else published_contacts().get(stated.name, {})


def _half_width(mixture: Mixture, law: AreaLaw, index: int) -> float:
    """Return half the width of the 90 % interval of ln(area) that arises from the error of one area model.

    It is the median over the samples of the inputs. The interval is narrower if many spots are plastic, or if the area is close
    to the nominal area. index: position of the load among the loads of the prediction.
    """
    sampled, rows, here = mixture.sampled, np.arange(len(law.log_area)), law.at_load(index)
    nominal = np.broadcast_to(sampled.column(sampled.drawn.nominal_area), (len(rows), 1))
    low, high = (here.corrected(rows, sampled.loads[[index]], np.full(len(rows), level), nominal) for level in (0.95, 0.05))
    return 0.5 * float(np.nanmedian(np.abs(np.log(high / low))))


@cache
def published_contacts() -> dict[str, dict[str, float]]:
    """Return, for each interface state, counts and mu of the contacts whose friction is published in handbooks.

    The keys are names of interface states. "contacts" counts all contacts with this state, "held" those whose predicted 90 %
    interval contains the geometric mean of the published range. "lowest" and "highest" are the ends of all published ranges.
    """
    return json.loads(FILE.read_text(encoding="utf-8"))
