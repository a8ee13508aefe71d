"""Static friction of rough, adhesive, possibly soft-coated contacts: every number with its source.

The public names are listed once, in `__init__.pyi`, and imported when they are first used, so that `import stiction` costs
nothing.
"""

import lazy_loader

_lazily, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)


def __getattr__(name: str):
    if name == "__version__":  # reading it takes longer than all the rest of this import
        from importlib.metadata import version

        return version("stiction")
    value = _lazily(name)
    from stiction.contact.measuring import measured_by

    measured_by(_roughness_of)
    return value


def _roughness_of(scan):
    """The roughness that is found in a scan: the one question that a room asks of one above it."""
    from stiction.studies.scans.measured import roughness_of

    return roughness_of(scan)
