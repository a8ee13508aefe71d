"""The case that the page begins with, and what a part has where it is added."""

import tomllib
from importlib import resources
from typing import Any

# What the switch of a part that may be left out puts there.
OPTIONAL_PARTS: dict[str, dict[str, Any]] = {
    "coating": {"material": "silver", "thickness": "200 nm", "bodies": "first"},
    "liquid": {"relative_humidity": 0.5, "contact_angle_first": "10 deg", "contact_angle_second": "10 deg"},
}

# What is known of a surface, with what it begins with.
SURFACE_KNOWN_BY: dict[str, dict[str, Any]] = {
    "sigma, R and N": {"asperity_height_deviation": "48 nm", "asperity_radius": "50 um", "asperity_density": "1.7e10 1/m^2"},
    "its finish and Sq or Ra": {"finish": "ground"},
}


def first_case() -> dict[str, Any]:
    """The tables of the case of a page that was asked for none: a soft film on hardened steel."""
    return tomllib.loads(resources.files("stiction.web").joinpath("first.toml").read_text(encoding="utf-8"))
