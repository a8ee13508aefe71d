"""Static friction of rough, adhesive, possibly soft-coated contacts: every number with its source.

The public names are imported when they are first used, so that `import stiction` costs nothing.
"""

import sys
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from stiction.contact.contact import Coating as Coating
    from stiction.contact.contact import Contact as Contact
    from stiction.contact.contact import Indices as Indices
    from stiction.contact.contact import Roughness as Roughness
    from stiction.contact.contact import work_of_adhesion as work_of_adhesion
    from stiction.contact.materials import Material as Material
    from stiction.contact.materials import material as material
    from stiction.engine.heights import height_distribution as height_distribution
    from stiction.laws.overview import cite as cite
    from stiction.laws.overview import models as models
    from stiction.quantities.errors import InputError as InputError
    from stiction.quantities.units import axis as axis
    from stiction.solving.evaluate import Evaluation as Evaluation
    from stiction.solving.evaluate import evaluate as evaluate
    from stiction.solving.solve import solve as solve
    from stiction.solving.unloading import unload as unload
    from stiction.studies.case import read_case as read_case
    from stiction.studies.case_results import compare_case as compare_case
    from stiction.studies.case_results import solve_case as solve_case
    from stiction.studies.comparison import compare as compare
    from stiction.studies.resolution import resolution_study as resolution_study
    from stiction.studies.surface_analysis import analyse as analyse
    from stiction.studies.surface_analysis import prepared as prepared
    from stiction.surfaces.asperities import asperities as asperities
    from stiction.surfaces.generate import gaussian_surface as gaussian_surface
    from stiction.surfaces.generate import non_gaussian_surface as non_gaussian_surface
    from stiction.surfaces.heightmap import HeightMap as HeightMap
    from stiction.surfaces.read import read_scan as read_scan
    from stiction.surfaces.targets import SelfAffine as SelfAffine

_PLACES = {
    "Coating": "contact.contact",
    "Contact": "contact.contact",
    "Evaluation": "solving.evaluate",
    "HeightMap": "surfaces.heightmap",
    "Indices": "contact.contact",
    "InputError": "quantities.errors",
    "Material": "contact.materials",
    "Roughness": "contact.contact",
    "SelfAffine": "surfaces.targets",
    "analyse": "studies.surface_analysis",
    "asperities": "surfaces.asperities",
    "axis": "quantities.units",
    "cite": "laws.overview",
    "compare": "studies.comparison",
    "compare_case": "studies.case_results",
    "evaluate": "solving.evaluate",
    "fan": "studies.resolution",
    "gaussian_surface": "surfaces.generate",
    "height_distribution": "engine.heights",
    "material": "contact.materials",
    "models": "laws.overview",
    "non_gaussian_surface": "surfaces.generate",
    "prepared": "studies.surface_analysis",
    "read_case": "studies.case",
    "read_scan": "surfaces.read",
    "resolution_study": "studies.resolution",
    "solve": "solving.solve",
    "solve_case": "studies.case_results",
    "unload": "solving.unloading",
    "work_of_adhesion": "contact.contact",
}
__all__ = list(_PLACES)
__version__ = "0.1.0"


class _Package(ModuleType):
    """Keeps `stiction.solve` the function: importing the module of the same name would put the module in its place."""

    def __setattr__(self, name: str, value: Any) -> None:
        if not (name in _PLACES and isinstance(value, ModuleType)):
            super().__setattr__(name, value)


sys.modules[__name__].__class__ = _Package


def __getattr__(name: str) -> Any:
    if name not in _PLACES:
        raise AttributeError(f"module 'stiction' has no attribute {name!r}")
    value = getattr(import_module(f".{_PLACES[name]}", __name__), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)
