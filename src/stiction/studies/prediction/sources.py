"""List the bibliography keys of a prediction: its area models, its interface, and the laws that act on the contact."""

import re
from collections.abc import Iterator

from stiction.contact.contact import Contact
from stiction.records.registry import records
from stiction.records.sources import bibliography
from stiction.studies.prediction.mixture import Mixture

_KEY = re.compile(r"\[(\w+)\]")


def sources_of(mixture: Mixture) -> str:
    """Return the bibliography keys of a prediction, separated by spaces, as the attribute `sources` of `solve`.

    They are the sources of the area models with a weight, of the possible states of the interface, of junction growth, and of
    the laws of adhesion, menisci, contamination and ageing whose inputs the contact states.
    """
    laws = [key for law in mixture.laws if law.weight.any() for key in law.name.split(" + ")]
    laws += [name.split()[-1] for name in beside_area(mixture.sampled.contact)]
    keys = [*_of_records([*laws, *_more_laws(mixture)])]
    texts = " ".join(text for state, _ in mixture.strength.states for text in state.source.values())
    known = bibliography()
    keys += [key for key in _KEY.findall(texts) if key in known]
    if mixture.sampled.metallic.any():
        keys.append("tabor_1959")
    return " ".join(dict.fromkeys(keys))


def beside_area(contact: Contact) -> list[str]:
    """Return the names of the meniscus and contamination laws that apply because the contact states their inputs."""
    stated = {
        "meniscus law equilibrium_meniscus": contact.liquid,
        "contamination law independent_junctions": contact.strength_variation,
    }
    return [name for name, value in stated.items() if value is not None]


def _more_laws(mixture: Mixture) -> Iterator[str]:
    contact = mixture.sampled.contact
    if contact.adheres:
        yield from ("soft_coating_2015", "maugis_1992", "persson_tosatti_2001")
    if contact.hold_time is not None:
        yield "berthoud_1999"


def _of_records(keys: list[str]) -> list[str]:
    every = records()
    return [source.key for key in keys for record in every if record.key == key for source in record.sources]
