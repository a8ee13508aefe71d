"""Predict the static friction of rough, adhesive, possibly soft-coated contacts, and name the source of every number.

The public names are listed once, in `__init__.pyi`, and imported when they are first used, so that `import stiction` is
fast.
"""

import importlib

import lazy_loader

_lazily, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
# Functions whose results have the method `.stiction.plot()`; the module of plotting adds it.
_RESULTS = (
    "compare", "compare_case", "design", "fit", "predict", "resolution_study", "sensitivity", "slide", "slide_case", "solve",
    "solve_case", "sweep",
)  # fmt: skip


def __getattr__(name: str):
    if name == "__version__":  # reading the version takes longer than the rest of this import
        from importlib.metadata import version

        return version("stiction")
    if name in _RESULTS:
        importlib.import_module("stiction.report.plotting")
    return _lazily(name)
