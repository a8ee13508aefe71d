"""Static friction of rough, adhesive, possibly soft-coated contacts: every number with its source.

The public names are imported when they are first used, so that `import stiction` costs nothing.
"""

import sys
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .case import read_case as read_case
    from .compare import compare as compare
    from .contact import Coating as Coating
    from .contact import Contact as Contact
    from .contact import Indices as Indices
    from .contact import Roughness as Roughness
    from .contact import work_of_adhesion as work_of_adhesion
    from .errors import InputError as InputError
    from .evaluate import Evaluation as Evaluation
    from .evaluate import evaluate as evaluate
    from .heights import height_distribution as height_distribution
    from .materials import Material as Material
    from .materials import material as material
    from .overview import cite as cite
    from .overview import models as models
    from .solve import solve as solve
    from .solve_case import compare_case as compare_case
    from .solve_case import solve_case as solve_case
    from .surfaces.analysis import analyse as analyse
    from .surfaces.analysis import prepared as prepared
    from .surfaces.asperities import asperities as asperities
    from .surfaces.fan import fan as fan
    from .surfaces.generate import gaussian_surface as gaussian_surface
    from .surfaces.generate import non_gaussian_surface as non_gaussian_surface
    from .surfaces.heightmap import HeightMap as HeightMap
    from .surfaces.read import read_scan as read_scan
    from .surfaces.targets import SelfAffine as SelfAffine
    from .units import axis as axis
    from .unloading import unload as unload

_PLACES = {
    "Coating": "contact",
    "Contact": "contact",
    "Evaluation": "evaluate",
    "HeightMap": "surfaces.heightmap",
    "Indices": "contact",
    "InputError": "errors",
    "Material": "materials",
    "Roughness": "contact",
    "SelfAffine": "surfaces.targets",
    "analyse": "surfaces.analysis",
    "asperities": "surfaces.asperities",
    "axis": "units",
    "cite": "overview",
    "compare": "compare",
    "compare_case": "solve_case",
    "evaluate": "evaluate",
    "fan": "surfaces.fan",
    "gaussian_surface": "surfaces.generate",
    "height_distribution": "heights",
    "material": "materials",
    "models": "overview",
    "non_gaussian_surface": "surfaces.generate",
    "prepared": "surfaces.analysis",
    "read_case": "case",
    "read_scan": "surfaces.read",
    "solve": "solve",
    "solve_case": "solve_case",
    "unload": "unloading",
    "work_of_adhesion": "contact",
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
