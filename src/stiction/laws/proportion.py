"""Warn about ratios of inputs that are implausible for a rough surface, whichever laws are used."""

from math import inf

from stiction.contact.subject import Subject
from stiction.laws.validity import warnings_about
from stiction.records.claims import Validity

# Outside these bounds the numbers describe no rough surface; the rules are checked on input.
OUT_OF_PROPORTION = (
    Validity("sharpness", 0.0, 1.0, "asperities are higher than their tips are wide: are sigma and R swapped?", "impossible"),
    Validity("roughness_parameter", 1e-5, 10.0, "asperities of this density and radius overlap or are far apart", "impossible"),
    Validity("nominal_width", 10.0, inf, "the surface is rougher than it is wide", "impossible"),
)


def input_warnings(subject: Subject) -> list[str]:
    """Return a sentence for each ratio of inputs, such as sqrt(sigma/R), that is implausible for a rough surface.

    A ratio that the contact does not determine is not checked. No model is run.
    """
    return [str(warning) for warning in warnings_about(subject, OUT_OF_PROPORTION, {})]
