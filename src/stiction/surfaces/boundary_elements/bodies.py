"""What is pressed on a map."""

from dataclasses import dataclass

from stiction.surfaces.boundary_elements.compliance import Film

__all__ = ["Bodies"]


@dataclass(frozen=True)
class Bodies:
    """What presses: modulus: E* of what has no film [Pa], infinite: nothing; film, counter_film: on one body and on both;
    hardness: the largest pressure [Pa], None: elastic."""

    modulus: float
    film: Film | None = None
    counter_film: Film | None = None
    hardness: float | None = None
