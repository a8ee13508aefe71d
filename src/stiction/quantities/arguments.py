"""Define type aliases for the arguments of public functions, for editors and type checkers."""

from os import PathLike
from typing import TYPE_CHECKING, Protocol, TypeAlias

from numpy.typing import ArrayLike

if TYPE_CHECKING:
    import numpy as np
    import xarray


class HasUnit(Protocol):
    """Describe, for type checkers, a number or array that carries a unit, such as a quantity of the package pint."""

    @property
    def magnitude(self) -> object:
        """Return the number or the array without its unit."""

    @property
    def units(self) -> object:
        """Return the unit of the number or array."""


# A number in SI units, a text with a unit ("48 nm"), a sequence of these, an array (NumPy, pandas, xarray), or a pint quantity.
QuantityLike: TypeAlias = ArrayLike | HasUnit
# A number in SI units, or numbers of a parameter sweep along named dimensions.
NumberOrArray: TypeAlias = "float | xarray.DataArray"
Values: TypeAlias = "float | np.ndarray | xarray.DataArray"
FilePath: TypeAlias = str | PathLike[str]
