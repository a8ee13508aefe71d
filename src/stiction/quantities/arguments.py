"""Name the types of the arguments of public functions, for editors and type checkers."""

from os import PathLike
from typing import Protocol, TypeAlias

from numpy.typing import ArrayLike


class HasUnit(Protocol):
    """Describe a number or array that carries a unit, such as a quantity of the package pint."""

    @property
    def magnitude(self) -> object:
        """Return the number or the array."""

    @property
    def units(self) -> object:
        """Return the unit."""


# A number in SI units, a text with a unit ("48 nm"), a sequence of these, an array (NumPy, pandas, xarray), or pint's.
QuantityLike: TypeAlias = ArrayLike | HasUnit
FilePath: TypeAlias = str | PathLike[str]
