"""The bodies that are pressed on a map."""

from dataclasses import dataclass

from stiction.solvers.boundary_elements.compliance import Film
from stiction.solvers.boundary_elements.menisci import Menisci


@dataclass(frozen=True)
class Bodies:
    """Two bodies that are pressed together.

    modulus: E* of the parts without a film [Pa], infinite where they are rigid; film, counter_film: on one body and on the
    other; hardness: the largest pressure [Pa], None: elastic; menisci: of the liquid between them, None: dry.
    """

    modulus: float
    film: Film | None = None
    counter_film: Film | None = None
    hardness: float | None = None
    menisci: Menisci | None = None
