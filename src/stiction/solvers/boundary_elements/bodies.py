"""Describe elastic constants, films, hardness and menisci of the two bodies in a map contact."""

from dataclasses import dataclass

from stiction.solvers.boundary_elements.compliance import Film
from stiction.solvers.boundary_elements.menisci import Menisci


@dataclass(frozen=True)
class Bodies:
    """Describe two bodies that are pressed together.

    modulus: contact modulus E* of the bodies without their films [Pa], infinite if both are rigid. film, counter_film: elastic
    film on the first and the second body, or None. hardness: largest contact pressure [Pa]; None for elastic bodies. menisci:
    liquid between the bodies; None if they are dry.
    """

    modulus: float
    film: Film | None = None
    counter_film: Film | None = None
    hardness: float | None = None
    menisci: Menisci | None = None
