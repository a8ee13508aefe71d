"""What friction rests on: one contact with each of its assumptions switched, in numbers and in one picture.

    python docs/what_mu_rests_on.py     # draws two pictures beside docs/explanation/what-mu-rests-on.md

The table of docs/explanation/what-mu-rests-on.md is made from the same numbers by docs/make_tables.py. The contact is that of
examples/what_mu_rests_on.toml.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

import stiction as st
from stiction.case.read import read_case

HERE = Path(__file__).parent
CASE = read_case(HERE.parent / "examples" / "what_mu_rests_on.toml")
CONTACT, LAWS, LOAD = CASE.subject, {name: law for name, law in CASE.choice.arguments().items() if law}, "1 N"
# H/(2.8 3^(1/2)), what the bulk shears at where no yield stress is stated.
BULK = CONTACT.first.hardness / (2.8 * 3.0**0.5)


@dataclass(frozen=True)
class Switch:
    """One assumption switched.

    contact: what is replaced of the contact; laws: of the laws, model and options; residual: the fraction of its strength that
    an asperity retains once it slides, and friction the maximum of the sliding curve; None: all together; spread: friction is
    the mean and, either side of it, the standard deviation from one contact to the next; exponent: of Weibull's distribution of
    heights, where that is chosen.
    """

    words: str
    laws: Mapping[str, str] = field(default_factory=dict)
    contact: Mapping[str, Any] = field(default_factory=dict)
    residual: float | None = None
    load: str = LOAD
    spread: bool = False
    exponent: float | None = None


def _strength(share: float) -> dict[str, float]:
    return {"interfacial_shear_strength": share * BULK}


def _peeling(law: str, zeta: float, words: str) -> Switch:
    return Switch(f"{words}, zeta = {zeta:g}", {"asperity": "jkr", "tangential": law}, {"peeling": zeta})


def _humid(humidity: float) -> Switch:
    water = st.Liquid(
        relative_humidity=humidity, contact_angle_first="40 deg", contact_angle_second="40 deg", temperature="20 degC"
    )
    return Switch(f"humid air, {humidity:.0%}", contact={"liquid": water})


def _sized(depth: str) -> Switch:
    copper = CONTACT.first.replace(characteristic_depth=depth)
    return Switch(f"size effect of hardness, h* = {depth}", contact={"first": copper, "second": copper})


def _waited(time: str) -> Switch:
    return Switch(f"{time} at rest", contact={"hold_time": time, "ageing_rate": 0.02, "reference_time": "1 s"})


def _plated(film: str) -> Switch:
    silver = st.Coating(material="silver", thickness="1 um", bodies="first")
    return Switch(f"1 µm of silver, {film}", {"film": film}, {"coating": silver})


def _with_law(key: str) -> Switch:
    return Switch(key, {"asperity": key})


@cache
def assumptions() -> dict[str, list[Switch]]:
    """Assumption -> what may stand in its place."""
    growth, stick = {"tangential": "junction_growth"}, {"tangential": "brizmer_kligerman_etsion_2007"}
    yields = {"asperity": "kogut_etsion_2002", "tangential": "kogut_etsion_2003"}
    return {
        "resistance of plastic junctions": [
            Switch("none: kogut_etsion_2003", yields),
            Switch("none: chang_etsion_bogy_1988", {"model": "chang_etsion_bogy_1988", "asperity": "", "tangential": ""}),
            *(Switch(f"junction growth, tau_0 {share:.0%} of the bulk strength", growth, _strength(share))
              for share in (0.5, 0.8, 0.95)),
            Switch("growth without limit, tau_0 99.9% of the bulk strength", {"tangential": "tabor_1959"}, _strength(0.999)),
            Switch("full stick", stick),
        ],
        "interface": [
            Switch("contaminated: tau_0 5% of the bulk strength", contact=_strength(0.05)),
            Switch("clean: tau_0 equal to the bulk strength, without growth", contact=_strength(1.0)),
            Switch("clean: tau_0 equal to the bulk strength, with growth", growth, _strength(1.0)),
            Switch("tau_0 varies by 50% between junctions, contact of 0.01 mm^2",
                   contact={"strength_variation": 0.5, "nominal_area": "0.01 mm^2"}, load="10 mN", spread=True),
        ],
        "simultaneous sliding": [
            Switch(f"one after another, residual strength {residual:.0%}", residual=residual) for residual in (1.0, 0.7, 0.4)
        ],
        "elastic junctions that peel": [
            *(_peeling("savkoor_briggs_1977", zeta, "savkoor_briggs_1977") for zeta in (1.0, 0.1)),
            *(_peeling("waters_guduru_2010", zeta, "mode mixity, waters_guduru_2010") for zeta in (0.5, 0.1)),
        ],
        "adhesion": [
            Switch(f"{law}, {work}", {"asperity": law}, {"work_of_adhesion": work})
            for law in ("dmt", "roy_chowdhury_ghosh_1994") for work in ("0.1 J/m^2", "1 J/m^2")
        ],
        "air": [_humid(0.5), _humid(0.9), _humid(0.98)],
        "hardness": [_sized("0.5 µm"), _sized("5 µm")],
        "time at rest": [_waited(time) for time in ("1 h", "1 day", "1 year")],
        "film law": [
            _plated(film) for film in ("sequential", "halling_1979", "ogilvy_1993", "chang_1997", "kato_1981", "dayson_1971")
        ],
        "asperity law": [
            _with_law(key) for key in ("hertz", "chang_etsion_bogy_1987", "kogut_etsion_2002", "zhao_maietta_chang_2000",
                                       "jackson_green_2005", "thornton_ning_1998")
        ],
        "heights": [
            Switch("exponential", {"heights": "exponential"}),
            *(Switch(f"Weibull, exponent {one:g} ({words})", {"heights": "weibull"}, exponent=one)
              for one, words in ((2.0, "skewness 0.6"), (8.0, "worn, skewness -0.5"))),
        ],
    }  # fmt: skip


@dataclass(frozen=True)
class Answer:
    """Of a switch: friction coefficients, one or the ends of a spread, and whether they are outside of what is claimed."""

    words: str
    mu: tuple[float, ...]
    outside: bool


def solve(switch: Switch) -> Answer:
    """The contact at its load with one assumption switched."""
    laws = {name: law for name, law in (LAWS | dict(switch.laws)).items() if law}
    contact, heights = CONTACT.replace(**switch.contact), laws.pop("heights", "gaussian")
    chosen = st.height_distribution(heights, **({} if switch.exponent is None else {"exponent": switch.exponent}))
    if switch.residual is not None:
        found = st.slide(contact, load=switch.load, residual_strength=switch.residual, heights=chosen, **laws)
        mu = [float(found["largest_friction_coefficient"])]
    else:
        found = st.solve(contact, load=switch.load, heights=chosen, **laws)
        mu = [float(found["friction_coefficient"])]
    if switch.spread:
        by = float(found["friction_coefficient_scatter"])
        mu = [mu[0] - by, mu[0] + by]
    return Answer(switch.words, tuple(mu), bool(found.attrs["outside_validity"]))


@cache
def base() -> float:
    """Friction with every assumption as it is in the case."""
    return solve(Switch("as in the case")).mu[0]


@cache
def answers() -> dict[str, list[Answer]]:
    """Assumption -> friction with each choice in its place."""
    return {name: [solve(one) for one in some] for name, some in assumptions().items()}


def ends(some: list[Answer]) -> tuple[float, float]:
    """Between which friction is, by one assumption; what is in the case is one of its choices."""
    every = [base(), *(mu for one in some for mu in one.mu)]
    return min(every), max(every)


def table() -> str:
    """Every choice, with its friction, and how much that is of the base; * where a result is outside what its laws claim."""
    lines = [
        "| assumption: largest over smallest mu | alternative | mu | mu over mu of the case |",
        "| --- | --- | --- | --- |",
    ]
    lines.append(f"| none | the case itself | {base():.3g} | 1 |")
    for name, some in answers().items():
        low, high = ends(some)
        for at, one in enumerate(some):
            mu, over = (" to ".join(f"{value / unit:.3g}" for value in one.mu) for unit in (1.0, base()))
            head = f"**{name}**: {float(f'{high / low:.3g}'):g}" if at == 0 else ""
            lines.append(f"| {head} | {one.words}{' *' * one.outside} | {mu} | {over} |")
    return "\n".join(lines)


def figure() -> Figure:
    """A dot for each choice, hollow where it is outside what its laws claim; a bar over each assumption; a line at the case."""
    rows = sum(len(some) for some in answers().values()) + len(answers())
    picture = Figure(figsize=(9.5, 0.6 + 0.2 * rows), layout="constrained")
    axes, row, names, places = picture.subplots(), 0, [], []
    for at, (name, some) in enumerate(answers().items()):
        low, high = ends(some)
        axes.barh(row + 0.5 * len(some), high - low, len(some) + 0.7, left=low, color=f"C{at % 10}", alpha=0.13)
        names, places = [*names, f"{name}: a factor of {float(f'{high / low:.2g}'):g}"], [*places, row]
        for one in some:
            row += 1
            filled = "none" if one.outside else f"C{at % 10}"
            axes.plot(one.mu, [row] * len(one.mu), "o-", color=f"C{at % 10}", markerfacecolor=filled, label=one.words)
            names, places = [*names, one.words], [*places, row]
        row += 1
    axes.axvline(base(), color="black", linewidth=1.0)
    axes.annotate(f"as in the case: {base():.3g}", (base(), -0.9), ha="center", va="bottom", annotation_clip=False, fontsize=8)
    axes.set_yticks(places, names, fontsize=8)
    for text in axes.get_yticklabels():
        text.set_fontweight("bold" if ": a factor of" in text.get_text() else "normal")
    axes.set(xscale="log", xlim=(0.5 * min(ends(some)[0] for some in answers().values()), None), ylim=(row - 0.4, -0.9))
    axes.set(xlabel="static friction coefficient (hollow: outside the range of validity)")
    axes.grid(axis="x", linewidth=0.3)
    return picture


# The contact of the case, and one so smooth that its asperities are loaded to about first yield, where full stick holds most.
SMOOTH = {
    "roughness": st.Roughness(asperity_height_deviation="0.2 nm", asperity_radius="200 um", asperity_density="1e9 1/m^2"),
    "work_of_adhesion": None,
}


def along_strength(contact: st.Contact, load: str, law: str, shares: np.ndarray) -> np.ndarray:
    """Friction after a tangential law where the interface has these shares of the strength of the bulk."""
    strength = st.axis("interfacial_shear_strength", shares * BULK)
    found = st.solve(contact.replace(interfacial_shear_strength=strength), load=load, **(LAWS | {"tangential": law}))
    return np.broadcast_to(found["friction_coefficient"].values, shares.shape)


def strength_figure() -> Figure:
    """Friction against the strength of the interface, from weak to as strong as the bulk."""
    picture = Figure(figsize=(9.5, 4.2), layout="constrained")
    grown, every = 1.0 - np.geomspace(0.99, 1e-4, 300), np.linspace(0.01, 1.2, 240)
    contacts = {
        "as in the case": (CONTACT, LOAD),
        "smooth: sigma = 0.2 nm, R = 200 µm, 1 mN": (CONTACT.replace(**SMOOTH), "1 mN"),
    }
    for axes, (title, (contact, load)) in zip(picture.subplots(1, 2), contacts.items(), strict=True):
        for law, shares, look in (
            ("bowden_tabor_1943", every, ":"), ("tabor_1959", grown, "--"), ("junction_growth", every, "-"),
            ("brizmer_kligerman_etsion_2007", every, "-."),
        ):  # fmt: skip
            axes.plot(shares, along_strength(contact, load, law, shares), look, label=law)
        axes.set(yscale="log", title=title, xlabel="strength of the interface over that of the bulk")
        axes.grid(linewidth=0.3)
    picture.axes[0].set_ylabel("static friction coefficient")
    picture.axes[0].legend(fontsize=8)
    return picture


if __name__ == "__main__":
    figure().savefig(HERE / "explanation" / "what-mu-rests-on.svg")
    strength_figure().savefig(HERE / "explanation" / "weak-to-full-stick.svg")
