"""List the bibliography keys of a prediction: its area models, its interface, and the laws that act on the contact."""

from collections.abc import Iterator

from stiction.contact.contact import Contact
from stiction.records.record import Record
from stiction.records.registry import AsperityLaw, Criterion, RoughSurface, find, kinds_of_additions
from stiction.records.sources import keys_in
from stiction.studies.prediction.mixture import Mixture


def sources_of(mixture: Mixture) -> str:
    """Return the bibliography keys of a prediction as one text, separated by spaces.

    They are the sources of the area models with a weight, of the possible states of the interface, of junction growth (for
    metals), and of the laws of adhesion, menisci, contamination and ageing whose inputs are specified for the contact.
    """
    keys = [key for law in mixture.laws if law.weight.any() for key in law.sources]
    keys += [source.key for record in _more_laws(mixture.sampled.contact) for source in record.sources]
    texts = " ".join(text for state, _ in mixture.strength.states for text in state.source.values())
    keys += keys_in(texts)
    if mixture.sampled.metallic.any():
        keys.append("tabor_1959")
    return " ".join(dict.fromkeys(keys))


def beside_area(contact: Contact) -> list[str]:
    """Return the names of the meniscus and contamination laws whose inputs are specified for the contact."""
    return [f"{kind} law {key}" for kind, key in _added(contact) if kind != "ageing"]


def _added(contact: Contact) -> list[tuple[str, str]]:
    """Return kind and key of each law that predictions add because its input is specified for the contact."""
    stated = {
        ("meniscus", "equilibrium_meniscus"): contact.liquid,
        ("contamination", "independent_junctions"): contact.strength_variation,
        ("ageing", "berthoud_1999"): contact.hold_time,
    }
    return [law for law, value in stated.items() if value is not None]


def _more_laws(contact: Contact) -> Iterator[Record]:
    """Yield the records of the adhesion laws, if the contact adheres, and of the laws that `_added` lists.

    Only the modules of these laws are imported.
    """
    if contact.adheres:
        yield find("soft_coating_2015", RoughSurface)
        yield find("maugis_1992", AsperityLaw)
        yield find("persson_tosatti_2001", Criterion)
    yield from (find(key, kinds_of_additions()[kind]) for kind, key in _added(contact))
