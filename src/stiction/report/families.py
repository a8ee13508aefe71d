"""Models of a comparison that belong together: by what their friction rests on, and by what plastic junctions resist."""

from typing import TYPE_CHECKING

import numpy as np

from stiction.records.registry import YIELDED

if TYPE_CHECKING:
    import xarray


def families_of(data: "xarray.Dataset") -> list[str]:
    """The family of each model, in words, with what its plastic junctions resist; "" of those that say nothing of friction."""
    rests, resist = (data[name].values for name in ("family_of_curve", "plastic_junctions_resist"))
    pairs = zip(rests, resist, strict=True)
    return [f"{one}; plastic junctions: {other}" if one and other else str(one) for one, other in pairs]


def with_plastic_junctions(data: "xarray.Dataset") -> list[str]:
    """The name of each model, with what its plastic junctions resist where others of `data` have it otherwise."""
    names, resist = (data[name].values for name in ("model", "plastic_junctions_resist"))
    if len({one for one in resist if one}) < 2:
        return [str(name) for name in names]
    return [f"{name} ({other})" if other else str(name) for name, other in zip(names, resist, strict=True)]


def said_of_plastic_junctions(data: "xarray.Dataset") -> str:
    """Between which ends mu at the working load is, by what plastic junctions resist; "" where no model says anything."""
    mu, resist = data["friction_coefficient_at_load"].values, data["plastic_junctions_resist"].values
    parts = []
    for kind in YIELDED:
        some = mu[np.isfinite(mu) & (resist == kind)]
        if some.size:
            ends = " to ".join(dict.fromkeys(f"{end:.3g}" for end in (some.min(), some.max())))
            parts.append(f"{kind} {ends} ({some.size} model{'s' * (some.size > 1)})")
    return f"mu by what plastic junctions resist: {', '.join(parts)}" if parts else ""
