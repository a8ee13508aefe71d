"""Describe elastic constants, films, hardness and menisci of the two bodies in a map contact."""

from dataclasses import dataclass

from stiction.solvers.boundary_elements.compliance import Film
from stiction.solvers.boundary_elements.menisci import Menisci


@dataclass(frozen=True)
class Bodies:
    """Describe two bodies that are pressed together.

    modulus: contact modulus E* [Pa] of the uncoated bodies: of both bodies, or of the only body without a film. It is infinite
    if both bodies have films, or if the uncoated bodies are rigid. film, counter_film: elastic film with its substrate, on the
    first and the second body, or None. hardness: largest contact pressure [Pa]; None for elastic bodies. menisci: liquid
    between the bodies; None if they are dry.
    """

    modulus: float
    film: Film | None = None
    counter_film: Film | None = None
    hardness: float | None = None
    menisci: Menisci | None = None
