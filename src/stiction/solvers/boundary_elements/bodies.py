"""What is pressed on a map."""

from dataclasses import dataclass

from stiction.solvers.boundary_elements.compliance import Film
from stiction.solvers.boundary_elements.menisci import Menisci


@dataclass(frozen=True)
class Bodies:
    """What presses: modulus: E* of what has no film [Pa], infinite: nothing; film, counter_film: on one body and on both;
    hardness: the largest pressure [Pa], None: elastic; menisci: of the liquid between them, None: dry."""

    modulus: float
    film: Film | None = None
    counter_film: Film | None = None
    hardness: float | None = None
    menisci: Menisci | None = None
