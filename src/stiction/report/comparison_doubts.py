"""What is doubtful in a comparison of models, each doubt once, numbered by its place."""

from typing import TYPE_CHECKING

import numpy as np

from stiction.laws.validity import read_doubts
from stiction.quantities.table import QUANTITIES
from stiction.studies.comparison.recommendation import LIQUID

if TYPE_CHECKING:
    import xarray

__all__ = ["doubts", "doubts_of_model", "doubts_with_meanings", "over_models", "said_of_liquid"]


def doubts_of_model(one: "xarray.Dataset") -> list[str]:
    """Why one model says nothing of friction, and the ranges of validity that it leaves, without by how much."""
    return [*filter(None, [one["why_not"].item()]), *(doubt.rule for doubt in read_doubts(one["doubts"].item()))]


def doubts(data: "xarray.Dataset") -> list[str]:
    """All doubts of a comparison, each once."""
    every = (doubts_of_model(data.isel(model=at)) for at in range(data.sizes["model"]))
    return list(dict.fromkeys(line for lines in every for line in lines))


def doubts_with_meanings(data: "xarray.Dataset") -> list[str]:
    """All doubts of a comparison, in the order of `doubts`, with what their symbols mean."""
    every = [one for text in data["doubts"].values for one in read_doubts(str(text))]
    meant = {
        one.rule: f"{QUANTITIES[one.quantity].meaning} ({QUANTITIES[one.quantity].symbol})" for one in every if one.quantity
    }
    return [f"{meant[rule]} {rule[rule.index('is not') :]}" if rule in meant else rule for rule in doubts(data)]


def over_models(data: "xarray.Dataset") -> str:
    """Say which models the range of mu spans, and how many impossible ones it leaves out."""
    impossible = data.attrs["impossible_models"]
    return f"over all possible models ({impossible} impossible left out)" if impossible else "over all models"


def said_of_liquid(data: "xarray.Dataset") -> str:
    """Name the models that leave out the liquid of the contact, and what it would pull; "" where none does."""
    left_out = data["liquid"].values == LIQUID[True]
    if not left_out.any():
        return ""
    pull = data["liquid_pull_left_out"].values[left_out]
    known = pull[np.isfinite(pull)]
    share = f", which would pull with up to {known.max():.2g} of the load" if known.size else ""
    names = ", ".join(map(str, data["model"].values[left_out]))
    return f"the liquid is left out{share}, and mu is too low, by {left_out.sum()} of {left_out.size} models: {names}"
