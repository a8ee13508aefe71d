"""A picture of every model, drawn from its record: what one asperity does under a law, and what a surface does under a model.

The contacts are made: bearing steel, smooth where a law adheres, with a silver film where it is about films.
"""

from collections.abc import Callable
from itertools import pairwise

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import stiction as st
from stiction.contact.indices import Groups
from stiction.engine.regime import Regime
from stiction.laws.ageing.kind import Ageing
from stiction.laws.contamination.kind import Contamination
from stiction.laws.joining import states
from stiction.laws.meniscus.kind import Meniscus
from stiction.laws.presliding.kind import Presliding
from stiction.records.registry import (
    Addition,
    AsperityLaw,
    AsperityMethod,
    Composite,
    Criterion,
    FilmLaw,
    Record,
    RoughSurface,
    TangentialLaw,
    friction_incompatibility,
    incompatibility,
    of_kind,
)
from stiction.report.surface_pictures import asperity_figure
from stiction.solving.choice import Choice
from stiction.solving.problem import make_problem

SUM, COATED = "greenwood_williamson_1966", "soft_coating_2015"  # models in which other laws are drawn: bare, and with a film
STEEL = {"preset": "hardened_steel_52100", "tangent_modulus": "2 GPa"}
STATE_COLOURS = {"elastic": "#0072B2", "elastic-plastic": "#E69F00", "plastic": "#D55E00"}
FLATTENED = "persson_tosatti_2001"  # refuses bodies that adhesion does not flatten
RUBBER = {"name": "rubber", "youngs_modulus": "2 MPa", "poissons_ratio": 0.49, "hardness": "2 MPa"}
RADIUS = 50e-6
_FAR = 1e6  # a coordinate beyond all that is drawn


def contact(sigma: float = 48e-9, film: bool = False, energy: float = 1.0, **more) -> st.Contact:
    """Steel on steel; in SI."""
    silver = st.material("silver", hardness="0.4 GPa")
    return st.Contact(
        first=STEEL, second=STEEL, nominal_area=1e-6, interfacial_shear_strength=200e6, pressure_coefficient=0.05,
        burgers_vector=0.25e-9, work_of_adhesion=energy,
        coating=st.Coating(material=silver, thickness=200e-9, bodies="first") if film else None,
        roughness=more.pop("roughness", None)
        or st.Roughness(asperity_height_deviation=sigma, asperity_radius=RADIUS, asperity_density=1.7e10),
    )  # fmt: skip


def picture(record: Record) -> Figure:
    """The picture of a model."""
    return _DRAWN.get(type(record), addition)(record)


def regimes(given: st.Contact, choice: Choice) -> list[Regime]:
    """The regimes of one asperity under these laws."""
    return make_problem(given, choice).regimes


def along(regime: Regime, farthest: float, points: int = 600) -> list[np.ndarray]:
    """States (points, 6) of the asperity along every segment of a regime, up to this displacement over sigma."""
    found = []
    for low, high in pairwise(map(float, regime.edges[0])):
        if low < high:  # else the segment is empty
            if not high < _FAR:
                high = max(1.0, 2.0 * abs(low))
                while states(regime, np.array([high]))[0, 0] < farthest and high < _FAR:
                    high *= 1.3
            u = np.linspace(low, high, points) if low <= 0.0 else np.geomspace(low, high, points)
            found.append(states(regime, u))
    return found


def whole(found: list[Regime], w: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Load, area and resistance at displacements w: of all regimes together, as a film and its body share an asperity."""
    sums, reached = np.zeros((3, w.size)), np.zeros(w.size, dtype=bool)
    for rows in (rows for regime in found for rows in along(regime, float(w[-1]), 4000)):
        there = (w >= rows[0, 0]) & (w < rows[-1, 0])
        reached |= there
        for at, values in enumerate((rows[:, 2], rows[:, 3], rows[:, 4] + rows[:, 5])):
            sums[at, there] += np.interp(w[there], rows[:, 0], values)
    sums[:, ~reached] = np.nan  # before it touches, or in a gap of a law as printed
    return sums[0], sums[1], sums[2]


def scales(given: st.Contact) -> tuple[float, float, float]:
    """Displacement [nm], load [µN] and area [µm²] of one asperity, in the units of theory 1."""
    sigma, radius = given.roughness.asperity_height_deviation, given.roughness.asperity_radius
    load = 4.0 / 3.0 * given.contact_modulus * np.sqrt(radius) * sigma**1.5
    return sigma * 1e9, load * 1e6, np.pi * radius * sigma * 1e12


def two_panels() -> tuple[Figure, Axes, Axes]:
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.0, 3.6), layout="constrained")
    for axes in (left, right):
        axes.grid(alpha=0.3)
    return figure, left, right


def asperity(record: AsperityLaw) -> Figure:
    """Load and contact area against displacement, Hertz's beside them; logarithmic where the asperity yields."""
    given = contact()
    adheres, choice = "no adhesion" not in record.traits, Choice(SUM, asperity=record.key, tangential="none")
    found = regimes(given, choice)
    linear = all(regime.state == "elastic" for regime in found) and adheres
    if linear:
        given = contact(3e-9)
        found = regimes(given, choice)
    length, load, area = scales(given)
    w = np.linspace(-3.0, 8.0, 400) if linear else np.geomspace(0.02, 60.0, 400)
    figure, left, right = two_panels()
    bare = np.clip(w, 0.0, None)
    seen: set[str] = set()
    for regime in found:
        for rows in along(regime, float(w[-1])):
            rows = rows[(rows[:, 0] >= w[0]) & (rows[:, 0] <= w[-1]) & (linear | (rows[:, 2] > 0.0))]
            if len(rows):
                name = "_" * (regime.state in seen) + regime.state  # named once in the legend
                look = {"color": STATE_COLOURS[regime.state], "linewidth": 2.5, "label": name}
                left.plot(rows[:, 0] * length, rows[:, 2] * load, **look)
                right.plot(rows[:, 0] * length, rows[:, 3] * area, **look)
                seen.add(regime.state)
    left.plot(w * length, bare**1.5 * load, color="black", linestyle=":", label="Hertz")
    right.plot(w * length, bare * area, color="black", linestyle=":", label="Hertz")
    left.set(xlabel="displacement [nm]", ylabel="load on one asperity [µN]")
    right.set(xlabel="displacement [nm]", ylabel="contact area of one asperity [µm²]")
    for axes in (left, right) * (not linear):
        axes.set(xscale="log", yscale="log")
    left.legend()
    figure.suptitle(f"Steel, R = 50 µm{', w = 1 J/m$^2$' * adheres}", fontsize="medium")
    return figure


def tangential(record: TangentialLaw) -> Figure:
    """The force that shears one asperity off against its load, and their ratio."""
    partners = ("hertz", "jkr", "chang_etsion_bogy_1987", *of_kind(AsperityLaw))
    known = of_kind(AsperityLaw)
    law = next(known[key] for key in partners if not incompatibility(record, known[key]))
    adheres = "no adhesion" not in law.traits
    given = contact(3e-9 if adheres else 48e-9)
    w = np.concatenate([-np.geomspace(3.0, 1e-3, 100)] * adheres + [np.geomspace(1e-3, 30.0 if adheres else 20.0, 600)])
    pressed, _, sheared = whole(regimes(given, Choice(SUM, asperity=law.key, tangential=record.key)), w)
    return _friction_of_one(pressed, sheared, scales(given)[1], f"on the asperity law {law.key}; steel, R = 50 µm")


def _friction_of_one(pressed: np.ndarray, sheared: np.ndarray, load: float, title: str) -> Figure:
    figure, left, right = two_panels()
    left.plot(pressed * load, sheared * load, color="#0072B2", linewidth=2.5)
    left.set(xlabel="load on one asperity [µN]", ylabel="tangential resistance [µN]")
    there = (pressed > 1e-3 * np.nanmax(pressed)) & (sheared > 0.0)
    right.plot(pressed[there] * load, sheared[there] / pressed[there], color="#0072B2", linewidth=2.5)
    right.set(xscale="log", xlabel="load on one asperity [µN]", ylabel="tangential resistance over load", ylim=(0.0, None))
    figure.suptitle(title, fontsize="medium")
    return figure


def film_choice(record: FilmLaw) -> Choice:
    """Laws that the film goes with: those of the 2015 model where they do, else a strength of the interface."""
    asperities, tangentials = of_kind(AsperityLaw), of_kind(TangentialLaw)
    for shear in (record.tangential, COATED, "bowden_tabor_1943"):
        for press in (record.asperity or "roy_chowdhury_ghosh_1994", "hertz", "jkr"):
            if shear in tangentials and press in asperities:
                law = tangentials[shear]
                wrong = friction_incompatibility(record, law) or incompatibility(record, asperities[press])
                if not wrong and not incompatibility(law, asperities[press]):
                    return Choice(COATED, asperity=press, tangential=shear, film=record.key)
    raise ValueError(f"{record.key}: no laws to draw it with")


def film(record: FilmLaw) -> Figure:
    """Load and area of one asperity on the film, and on its body alone."""
    choice = film_choice(record)
    options = {"variant": "published"} if not record.interchangeable else {}
    given, bare = contact(film=True, energy=0.1), contact(energy=0.1)
    length, load, area = scales(given)
    w = np.linspace(0.0, 8.0, 300)
    coated = whole(regimes(given, Choice(choice.model, choice.asperity, choice.tangential, choice.film, options)), w)
    plain = whole(regimes(bare, Choice(SUM, asperity=choice.asperity, tangential="none")), w)
    figure, left, right = two_panels()
    for axes, at, scale in ((left, 0, load), (right, 1, area)):
        axes.plot(w * length, plain[at] * scale, color="grey", linestyle=":", label="no film")
        axes.plot(w * length, coated[at] * scale, color="#0072B2", linewidth=2.5, label=record.key)
    left.set(xlabel="displacement [nm]", ylabel="load on one asperity [µN]")
    right.set(xlabel="displacement [nm]", ylabel="contact area of one asperity [µm²]")
    left.legend()
    figure.suptitle(f"200 nm of silver on steel, R = 50 µm, asperity law {choice.asperity}", fontsize="medium")
    return figure


def surface_of(record: RoughSurface) -> st.Contact:
    """A contact that the model can be asked for."""
    if record.of_map is not None:
        spectrum = st.SelfAffine(0.8, 20e-6 / 8, 20e-6 / 16, 30e-9)
        return contact(roughness=st.gaussian_surface((64, 64), (20e-6, 20e-6), spectrum, seed=1), energy=0.0)
    if record.key == FLATTENED:
        return contact(energy=0.05).replace(first=RUBBER, second=RUBBER, interfacial_shear_strength=0.4e6)
    adheres = record.adheres or record.key in ("fuller_tabor_1975", "rough_dmt", COATED)
    return contact(film=record.on_film, energy=0.1 if adheres else 0.0 if not record.on_film else 0.1)


def rough_surface(record: RoughSurface) -> Figure:
    """Contact area and friction against load; Greenwood & Williamson's beside them where there is no film."""
    given = surface_of(record)
    loads = np.geomspace(0.03, 30.0, 60) if record.of_map is None else np.geomspace(3.0, 300.0, 7)
    figure, left, right = two_panels()
    shear = None if record.tangential != "none" else "bowden_tabor_1943"
    drawn = (
        {record.key: shear}
        if record.key in (SUM, FLATTENED) or record.on_film
        else {SUM: "bowden_tabor_1943", record.key: shear}
    )
    for key, law in drawn.items():
        data = st.solve(given, load=loads, model=key, tangential=law)
        own = key == record.key
        look = {"color": "#0072B2" if own else "grey", "linestyle": "-" if own else ":", "linewidth": 2.5 if own else 1.5}
        left.plot(loads, data["contact_area"] / given.nominal_area * 100.0, label=key, **look)
        right.plot(loads, data["friction_coefficient"], label=key, **look)
    left.set(xscale="log", yscale="log", xlabel="load [N]", ylabel="real contact area [% of 1 mm$^2$]")
    right.set(xscale="log", xlabel="load [N]", ylabel="static friction coefficient")
    right.set_ylim(0.0, 1.1 * right.dataLim.y1)
    left.legend(fontsize="small")
    shown = (
        "tangential law of the model"
        if shear is None
        else f"strength of the interface {given.interfacial_shear_strength / 1e6:g} MPa + 0.05 p"
    )
    pair = "Rubber on rubber" if record.key == FLATTENED else "Steel on steel"
    figure.suptitle(f"{pair}{', 200 nm of silver' * record.on_film}; {shown}", fontsize="medium")
    return figure


def composite(record: Composite) -> Figure:
    """The property of film and body together, for a soft film and a hard one."""
    figure, axes = plt.subplots(figsize=(5.5, 3.6), layout="constrained")
    at = np.geomspace(0.02, 50.0, 200)
    for ratio in (0.5, 2.0):
        if record.property == "modulus":
            values = [record.value(ratio, 1.0 / one, 0.3, 0.3) for one in at]
        else:
            assert record.constants is not None
            one = np.array([ratio])
            constant, exponent = (float(np.ravel(part)[0]) for part in _pair(record.constants(one, one, one)))
            values = [record.value(ratio, depth, constant, exponent) for depth in at]
        axes.plot(at, values, linewidth=2.5, label=f"film over substrate {ratio:g}")
    against = "contact radius over film thickness" if record.property == "modulus" else "depth over film thickness"
    axes.set(xscale="log", xlabel=against, ylabel=f"{record.property} over {record.property} of the substrate")
    axes.grid(alpha=0.3)
    axes.legend()
    return figure


def _pair(found) -> tuple:
    return found if isinstance(found, tuple) else (found, np.zeros(1))


def presliding(record: Presliding) -> Figure:
    """Stiffness before sliding against load."""
    loads = np.geomspace(0.01, 10.0, 60)
    data = st.solve(contact(energy=0.0), load=loads, model=SUM, presliding=record.key)
    figure, axes = plt.subplots(figsize=(5.5, 3.6), layout="constrained")
    axes.loglog(loads, data["tangential_stiffness"] * 1e-6, linewidth=2.5)
    axes.set(xlabel="load [N]", ylabel="tangential stiffness [N/µm]", title="Steel on steel, no film")
    axes.grid(alpha=0.3)
    return figure


def meniscus(record: Meniscus) -> Figure:
    """What menisci pull with against the separation, for three humidities."""
    separations = np.linspace(-0.5, 4.0, 80) * 10e-9
    figure, axes = plt.subplots(figsize=(5.5, 3.6), layout="constrained")
    for humidity in (0.5, 0.8, 0.95):
        water = st.Liquid(relative_humidity=humidity, contact_angle_first="10 deg", contact_angle_second="10 deg")
        data = st.solve(_small().replace(liquid=water), separation=separations, model=SUM, meniscus=record.key)
        axes.semilogy(separations * 1e9, -data["load_meniscus"] * 1e6, linewidth=2.5, label=f"{humidity:.0%}")
    axes.set(xlabel="mean separation [nm]", ylabel="pull of the menisci [µN]", title="Silicon, water at 20 degC, sigma = 10 nm")
    axes.grid(alpha=0.3)
    axes.legend(title="relative humidity")
    return figure


def ageing(record: Ageing) -> Figure:
    """Friction against the time at rest."""
    times = np.geomspace(1e-2, 1e6, 60)
    rested = _small().replace(hold_time=st.axis("hold_time", times), ageing_rate=0.02, reference_time=1.0)
    data = st.solve(rested, load=1e-3, model=SUM, ageing=record.key)
    figure, axes = plt.subplots(figsize=(5.5, 3.6), layout="constrained")
    axes.semilogx(times, np.ravel(data["friction_coefficient"]), linewidth=2.5)
    axes.set(xlabel="time at rest [s]", ylabel="static friction coefficient", title="2 % per factor e in time after 1 s")
    axes.grid(alpha=0.3)
    return figure


def contamination(record: Contamination) -> Figure:
    """Friction and its spread from one place to the next against load."""
    loads = np.geomspace(1e-5, 1e-1, 60)
    data = st.solve(_small().replace(strength_variation=1.0), load=loads, model=SUM, contamination=record.key)
    mu, spread = data["friction_coefficient"], data["friction_coefficient_scatter"]
    figure, axes = plt.subplots(figsize=(5.5, 3.6), layout="constrained")
    axes.fill_between(loads, mu - spread, mu + spread, alpha=0.3, label="standard deviation")
    axes.semilogx(loads, mu, linewidth=2.5, label="mean")
    axes.set(
        xlabel="load [N]",
        ylabel="static friction coefficient",
        ylim=(0.0, None),
        title="Standard deviation of the strength equal to its mean",
    )
    axes.grid(alpha=0.3)
    axes.legend()
    return figure


def addition(record: Addition) -> Figure:
    """Friction against load, with and without a law that has no picture of its own."""
    loads = np.geomspace(1e-5, 1e-1, 60)
    figure, axes = plt.subplots(figsize=(5.5, 3.6), layout="constrained")
    for label, law in (("without", {}), ("with", {record.keyword: record.key})):
        mu = st.solve(_small(), load=loads, model=SUM, **law)["friction_coefficient"]
        axes.semilogx(loads, mu, linewidth=2.5, label=label)
    axes.set(xlabel="load [N]", ylabel="static friction coefficient", ylim=(0.0, None), title="Silicon, sigma = 10 nm")
    axes.grid(alpha=0.3)
    axes.legend()
    return figure


def _small() -> st.Contact:
    """Two surfaces of a small machine of silicon."""
    surface = st.Roughness(asperity_height_deviation="10 nm", asperity_radius="1 um", asperity_density="1e13 1/m^2")
    return st.Contact(
        first="silicon", second="silicon", roughness=surface, nominal_area="0.01 mm^2", interfacial_shear_strength="100 MPa"
    )  # fmt: skip


def criterion(record: Criterion) -> Figure:
    """The number against the work of adhesion, for three radii of asperities."""
    energies = np.geomspace(0.01, 10.0, 80)
    figure, axes = plt.subplots(figsize=(5.5, 3.6), layout="constrained")
    for radius in (0.1e-6, 1e-6, 10e-6):
        rough = st.Roughness(asperity_height_deviation=1e-9, asperity_radius=radius, asperity_density=0.04 / (radius * 1e-9))
        groups, _ = Groups.of(contact(roughness=rough, energy=st.axis("work_of_adhesion", energies)).indices())
        axes.loglog(energies, record.ratio(groups), linewidth=2.5, label=f"R = {radius * 1e6:g} µm")
    axes.axhline(1.0, color="grey", linewidth=1.0)
    axes.set(xlabel="work of adhesion [J/m$^2$]", ylabel="ratio (below 1 the surfaces stick)", title="Steel, sigma = 1 nm")
    axes.grid(alpha=0.3)
    axes.legend()
    return figure


def method(record: AsperityMethod) -> Figure:
    """The asperities that it finds in a made map."""
    spectrum = st.SelfAffine(hurst=0.8, rolloff=10e-6, shortest=2e-6, deviation=8e-9)
    surface = st.gaussian_surface((128, 128), (40e-6, 40e-6), spectrum, seed=1)
    return asperity_figure([st.asperities(surface, record.key)], surface)


_DRAWN: dict[type[Record], Callable[..., Figure]] = {
    AsperityLaw: asperity, TangentialLaw: tangential, FilmLaw: film, RoughSurface: rough_surface, Composite: composite,
    Presliding: presliding, Meniscus: meniscus, Ageing: ageing, Contamination: contamination, Criterion: criterion,
    AsperityMethod: method,
}  # fmt: skip
