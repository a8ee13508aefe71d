"""Compute the curves behind figures 1 to 3 of the 2015 paper: friction coefficient against load, coated and uncoated.

Source: soft_coating_2015, section 4. The paper prints the film's n_E, n_H and tau and the range of h. It does not print
theta and lambda of any figure, nor the film values that the panels of figures 1 and 2 hold fixed. The values used here are our
choice.
"""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import xarray

# Section 4 of the paper: its films (t of 100 to 300 nm over sigma of 48 nm gives tau of 2 to 6), and its separations h.
FILM_VALUES: dict[str, tuple[float, ...]] = {"n_E": (0.5, 1.5, 2.5), "n_H": (0.2, 0.5, 0.8), "tau": (2.0, 3.0, 4.0, 5.0, 6.0)}
H_RANGE = (4.0, -4.0)
_POINTS = 161


@dataclass(frozen=True)
class Panel:
    """Describe one panel of the paper's figures 1 to 3.

    name: file name without its ending, such as "fig1a". figure: label in the paper, such as "Figure 1(a)". along: dimensionless
    group of the film that varies: n_E, n_H or tau. values: its values. fixed: values of the other two groups, by name.
    """

    name: str
    figure: str
    along: str
    values: tuple[float, ...]
    fixed: Mapping[str, float]


PANELS = (
    Panel("fig1a", "Figure 1(a)", "n_E", FILM_VALUES["n_E"], {"n_H": 0.5, "tau": 2.0}),
    Panel("fig1b", "Figure 1(b)", "n_E", FILM_VALUES["n_E"], {"n_H": 0.5, "tau": 6.0}),
    Panel("fig2a", "Figure 2(a)", "n_H", FILM_VALUES["n_H"], {"n_E": 1.5, "tau": 2.0}),
    Panel("fig2b", "Figure 2(b)", "n_H", FILM_VALUES["n_H"], {"n_E": 1.5, "tau": 6.0}),
    Panel("fig3", "Figure 3", "tau", (2.0, 4.0, 6.0), {"n_E": 0.5, "n_H": 0.8}),
)


@dataclass(frozen=True)
class PanelCurves:
    """Store the curves of one panel, with dimensionless results.

    coated: dataset over the film group that the panel varies and mean_separation. bare: dataset of the uncoated surface over
    mean_separation.
    """

    panel: Panel
    coated: "xarray.Dataset"
    bare: "xarray.Dataset"

    @property
    def caption(self) -> str:
        """Return a caption of two lines: figure, variant and fixed film groups; then theta, lambda and the range of h."""
        groups = self.bare.attrs
        fixed = ", ".join(f"{name} = {value:g}" for name, value in self.panel.fixed.items())
        chosen = f"theta = {groups['theta']:g}, lambda = {groups['lam']:g} (not printed in the paper)"
        return f"{self.panel.figure} of the 2015 paper, {in_words(groups['variant'])}: {fixed}\n{chosen}, h = 4 to -4"


def in_words(variant: str) -> str:
    """Return the caption name of a variant: "film solved as a layer" for LAYERED, otherwise e.g. "corrected variant"."""
    from stiction.studies.paper.layered import LAYERED

    return "film solved as a layer" if variant == LAYERED else f"{variant} variant"


def panel_curves(panel: Panel, theta: float, lam: float, variant: str) -> PanelCurves:
    """Compute the curves of one panel at adhesion indices theta and lam, both above 0.

    variant: "corrected", "published", or "layered" for a solved film. Raises InputError.
    """
    from stiction.contact.contact import Indices
    from stiction.quantities.dimensions import axis
    from stiction.solving.solve import solve
    from stiction.studies.paper.layered import LAYERED, choice, film_groups

    h = np.linspace(*H_RANGE, _POINTS)
    film = {**panel.fixed, panel.along: axis(panel.along, panel.values)}
    film |= film_groups(film["tau"]) if variant == LAYERED else {}

    def solved(**groups: Any) -> "xarray.Dataset":
        laws = choice(bool(groups)).arguments() if variant == LAYERED else {"variant": variant}
        return solve(Indices(theta=theta, lam=lam, **groups), separation=h, **laws)

    return PanelCurves(panel, solved(**film), solved().assign_attrs(theta=theta, lam=lam, variant=variant))


def curve_rows(panels: Iterable[PanelCurves]) -> tuple[list[str], Iterator[list]]:
    """Return column names and rows of a table of the curves of all panels, with dimensionless results.

    The film groups n_E, n_H and tau are empty for the uncoated surface.
    """
    names = ("mean_separation", "load", "contact_area", "friction_force", "friction_coefficient")
    return ["figure", "variant", "theta", "lambda", *FILM_VALUES, *names], _rows_of(panels, names)


def _rows_of(panels: Iterable[PanelCurves], names: Iterable[str]) -> Iterator[list]:
    for curves in panels:
        panel, used = curves.panel, curves.bare.attrs
        head = [panel.name, used["variant"], used["theta"], used["lam"]]
        films = [({**panel.fixed, panel.along: value}, curves.coated.sel({panel.along: value})) for value in panel.values]
        for film, data in [({}, curves.bare), *films]:
            groups = [film.get(name, "") for name in FILM_VALUES]
            for values in zip(*(data[name].values.tolist() for name in names), strict=True):
                yield [*head, *groups, *values]
