"""Combine the properties of two half-spaces in contact: the elastic properties of both, and the strength of the softer one."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from stiction.contact.indices import HARDNESS_TO_YIELD
from stiction.contact.materials import Material


@dataclass(frozen=True)
class Pair:
    """Represent two half-spaces in contact: the elastic properties of both, and the strength of the softer one.

    Every property is computed when it is first read. Properties are numbers, or xarray arrays if a material has arrays.
    """

    first: Material
    second: Material

    @cached_property
    def K(self) -> Any:
        """Return the stiffness modulus K = 4 E*/3 [Pa], with 1/E* the sum of (1 - nu^2)/E of both bodies."""
        return 4 / (3 * sum(map(compliance_of, (self.first, self.second))))  # departure D1

    @cached_property
    def beta(self) -> Any:
        """Return the tangential compliance [1/Pa]: the sum of (2 - nu)/G of both bodies (2015 paper, below eq. (10))."""
        return sum((2 - body.poissons_ratio) / body.shear_modulus for body in (self.first, self.second))

    @cached_property
    def hardness(self) -> Any:
        """Return the hardness [Pa] of the softer body."""
        return self._of_softer(self.first.hardness, self.second.hardness)

    @cached_property
    def nu(self) -> Any:
        """Return Poisson's ratio of the softer body."""
        return self._of_softer(self.first.poissons_ratio, self.second.poissons_ratio)

    @cached_property
    def k(self) -> Any:
        """Return hardness divided by yield stress of the softer body, or 2.8 if it has no yield stress."""
        return self._of_softer(_hardness_to_yield(self.first), _hardness_to_yield(self.second))

    @cached_property
    def hardening(self) -> Any:
        """Return tangent modulus divided by Young's modulus of the softer body; None if it has no tangent modulus."""
        return self._of_softer(_hardening(self.first), _hardening(self.second))

    @cached_property
    def _first_is_softer(self) -> Any:
        return first_is_softer(self.first, self.second)

    def _of_softer(self, of_first: Any, of_second: Any) -> Any:
        return choose(self._first_is_softer, of_first, of_second)


def compliance_of(body: Material):
    """Return the plane-strain compliance (1 - nu^2)/E of a body [1/Pa]."""
    return (1 - body.poissons_ratio**2) / body.youngs_modulus


def first_is_softer(first: Material, second: Material) -> Any:
    """Return whether the first of two bodies decides the strength of their contact, elementwise for arrays.

    The softer body decides. Of two equally hard bodies, the one with the lower yield stress decides. If these are equal too,
    the one with the lower Poisson's ratio decides, because it yields at a lower pressure (Chang, Etsion & Bogy 1987). The last
    criterion is the lower ratio of tangent modulus to Young's modulus; a body without tangent modulus comes before one that has
    it. The result is True if all of these are equal.
    """
    keys = (
        (first.hardness, second.hardness),
        (-_hardness_to_yield(first), -_hardness_to_yield(second)),
        (first.poissons_ratio, second.poissons_ratio),
        (_or_lowest(_hardening(first)), _or_lowest(_hardening(second))),
    )
    return _before(keys)


def more_compliant(first: Material, second: Material) -> Any:
    """Return whether the first of two bodies is the more compliant one, by (1 - nu^2)/E, elementwise for arrays.

    Of two equally compliant bodies, the one with the lower Poisson's ratio counts as more compliant.
    """
    return _before(((-compliance_of(first), -compliance_of(second)), (first.poissons_ratio, second.poissons_ratio)))


def _before(keys: tuple[tuple[Any, Any], ...]) -> Any:
    """Return whether a first body comes before a second one in the order defined by some keys, elementwise for arrays.

    keys: pairs (number of the first body, number of the second body). The first pair with different numbers decides: the body
    with the smaller number comes first. If all pairs are equal, the first body comes first.
    """
    (mine, other), *rest = keys
    equal = mine == other
    if not rest or not np.asarray(equal).any():  # of an xarray array, `any` takes ten times as long
        return mine <= other
    return (mine < other) | (equal & _before(tuple(rest)))


def _or_lowest(value: Any) -> Any:
    return -1.0 if value is None else value


def _hardness_to_yield(body: Material):
    return HARDNESS_TO_YIELD if body.yield_stress is None else body.hardness / body.yield_stress


def _hardening(body: Material):
    return None if body.tangent_modulus is None else body.tangent_modulus / body.youngs_modulus


def choose(condition, if_true, if_false):
    """Return `if_true` where the condition holds, else `if_false`, elementwise if the condition is an xarray array.

    if_true, if_false: numbers, xarray arrays or None. If one of them is None and is selected anywhere, the result is None.
    """
    if hasattr(condition, "dims"):
        if if_true is None or if_false is None:
            known, chosen = (if_true, condition) if if_false is None else (if_false, ~condition)
            return known if chosen.values.all() else None
        dims = {*condition.dims, *getattr(if_true, "dims", ()), *getattr(if_false, "dims", ())}
        for chosen, value in ((condition, if_true), (~condition, if_false)):  # usually one value is chosen everywhere: no copy
            if dims == {*getattr(value, "dims", ())} and chosen.values.all():
                return value
        import xarray

        return xarray.where(condition, if_true, if_false)
    return if_true if condition else if_false
