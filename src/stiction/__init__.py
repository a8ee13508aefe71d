"""Static friction of rough, adhesive, possibly soft-coated contacts: every number with its source.

The public names are listed once, in `__init__.pyi`, and imported when they are first used, so that `import stiction` costs
nothing.
"""

import importlib

import lazy_loader

_lazily, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
# Functions whose results are drawn by `.stiction.plot()`.
_RESULTS = (
    "compare", "compare_case", "design", "fit", "predict", "resolution_study", "sensitivity", "slide", "slide_case", "solve",
    "solve_case", "sweep",
)  # fmt: skip


def __getattr__(name: str):
    if name == "__version__":  # reading it takes longer than all the rest of this import
        from importlib.metadata import version

        return version("stiction")
    if name in _RESULTS:
        importlib.import_module("stiction.report.plotting")
    return _lazily(name)
