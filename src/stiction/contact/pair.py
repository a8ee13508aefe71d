"""Two half-spaces in contact: stiffnesses of both, strength of the softer."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from stiction.contact.indices import HARDNESS_TO_YIELD
from stiction.contact.materials import Material


@dataclass(frozen=True)
class Pair:
    """Two half-spaces in contact (theory 1): stiffnesses of both, strength of the softer."""

    K: Any
    beta: Any
    hardness: Any
    nu: Any
    k: Any
    hardening: Any


def pair_of(first: Material, second: Material) -> Pair:
    bodies = (first, second)
    compliance = sum(map(compliance_of, bodies))  # 1/E*, departure D1
    softer = first_is_softer(first, second)
    return Pair(
        K=4 / (3 * compliance),
        beta=sum((2 - body.poissons_ratio) / body.shear_modulus for body in bodies),  # paper, below eq (10)
        hardness=choose(softer, first.hardness, second.hardness),
        nu=choose(softer, first.poissons_ratio, second.poissons_ratio),
        k=choose(softer, _hardness_to_yield(first), _hardness_to_yield(second)),
        hardening=choose(softer, _hardening(first), _hardening(second)),
    )


def compliance_of(body: Material):
    """1/E' = (1 - nu^2)/E."""
    return (1 - body.poissons_ratio**2) / body.youngs_modulus


def first_is_softer(first: Material, second: Material) -> Any:
    """Whether the strength of the contact is that of the first body, elementwise.

    It is that of the softer. Of two as hard it is that of the body which yields first, whatever their order: the lower yield
    stress, then the lower Poisson's ratio, where the pressure at first yield is less (Chang, Etsion & Bogy 1987); and if these
    are equal too, the lower tangent modulus over Young's, one that is not known before one that is.
    """
    keys = (
        (first.hardness, second.hardness),
        (-_hardness_to_yield(first), -_hardness_to_yield(second)),
        (first.poissons_ratio, second.poissons_ratio),
        (_or_lowest(_hardening(first)), _or_lowest(_hardening(second))),
    )
    return _before(keys)


def more_compliant(first: Material, second: Material) -> Any:
    """Whether the first body is the more compliant, or of two alike the one of the lower Poisson's ratio; elementwise."""
    return _before(((-compliance_of(first), -compliance_of(second)), (first.poissons_ratio, second.poissons_ratio)))


def _before(keys: tuple[tuple[Any, Any], ...]) -> Any:
    """Whether the first comes before the second by the first pair in which they differ, or if they differ in none."""
    (one, other), *rest = keys
    equal = one == other
    if not rest or not np.any(equal):
        return one <= other
    return (one < other) | (equal & _before(tuple(rest)))


def _or_lowest(value: Any) -> Any:
    return -1.0 if value is None else value


def _hardness_to_yield(body: Material):
    return HARDNESS_TO_YIELD if body.yield_stress is None else body.hardness / body.yield_stress


def _hardening(body: Material):
    return None if body.tangent_modulus is None else body.tangent_modulus / body.youngs_modulus


def choose(condition, one, other):
    """`one` where the condition holds, else `other`: elementwise if the condition is a labelled array. What is not known (None)
    somewhere along a sweep is not known."""
    if hasattr(condition, "dims"):
        if one is None or other is None:
            known, chosen = (one, condition) if other is None else (other, ~condition)
            return known if chosen.all() else None
        import xarray

        return xarray.where(condition, one, other)
    return one if condition else other
