"""Evaluate the criteria that apply to a contact, e.g. whether its asperities deform plastically."""

from stiction.contact.indices import Groups
from stiction.contact.subject import Subject
from stiction.records.registry import Criterion, of_kind


def criteria_of(contact: Subject) -> list[str]:
    """Return one line of text for each criterion that applies to a contact, e.g. whether its asperities deform plastically.

    Films are ignored. A criterion is left out if the contact does not state a dimensionless group that it needs.
    """
    whole = contact.with_surface_moments()
    groups = Groups.of(whole.indices())[0].substrate()
    lines = []
    for criterion in of_kind(Criterion).values():
        if all(groups.has(name) for name in criterion.needs):
            ratio = float((criterion.ratio(groups, whole.map) if criterion.on_map else criterion.ratio(groups))[0])
            statement = criterion.below if ratio < 1.0 else criterion.above
            lines.append(f"{criterion.key}: {statement} (ratio {ratio:.3g}, threshold 1)")
    return lines
