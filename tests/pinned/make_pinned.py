"""Writes pinned.csv.gz: 2,000 results of the package as it is, asked for through its public names alone.

    python tests/pinned/make_pinned.py

They show that nothing has changed, never that anything is right: they come from the code that they test. What is right is held
by reference. Renew them only where a change of numbers is meant, say so in the commit, and read the difference.

A row is what was asked, as JSON with every argument of the call; the quantity; where in the result it is; its value, as `repr`
writes it; and the size against which a difference is judged, see `_sizes`. Texts and refusals have none: they are equal or not.
"""

import csv
import gzip
import io
import itertools
import json
from pathlib import Path
from typing import Any

import numpy as np

import stiction as st

FILE = Path(__file__).with_name("pinned.csv.gz")
COLUMNS = ("asked", "quantity", "at", "value", "size")
REFUSED = "refused"

QUANTITIES = (
    "load", "contact_area", "friction_force", "friction_coefficient", "touching_asperities", "mean_separation",
    "tangential_stiffness", "pull_off_force",
)  # fmt: skip


# From a row to its result ------------------------------------------------------------------------------------------------


def ask(asked: dict[str, Any]) -> dict[tuple[str, str], tuple[Any, float]]:
    """All results of a request: (quantity, at) -> value and size. at: "" of a single number, else JSON: dimension -> place."""
    calls = {"solve": _solved, "unload": _solved, "compare": _compared, "evaluate": _evaluated, "asperities": _found}
    try:
        return calls[asked["call"]](asked)
    except st.InputError:
        return {("refusal", ""): (REFUSED, 0.0)}


def _subject(asked):
    kind = st.Contact if "contact" in asked else st.Indices
    given = asked.get("contact") or asked["indices"]
    return kind(**{name: _argument(name, value) for name, value in given.items()})


def _argument(name: str, value: Any) -> Any:
    """A value as it is, or {"axis": [...]}: numbers along a dimension of their own; or heights: {distribution: parameters}."""
    if name == "heights":
        ((key, parameters),) = value.items()
        return st.height_distribution(key, **parameters)
    return st.axis(name, value["axis"]) if isinstance(value, dict) and "axis" in value else value


def _solved(asked) -> dict:
    contact = _subject(asked)
    given = {name: _argument(name, value) for name, value in asked["with"].items()}
    data = getattr(st, asked["call"])(contact, **given)
    at_load = "load" in given or "max_load" in given
    sizes = _sizes(data, contact, at_load)
    found = {}
    for name in QUANTITIES:
        # At a given separation mu is the ratio of two others; of what does not adhere no tension need be written.
        said = at_load or name not in ("mean_separation", "friction_coefficient")
        if name in data.data_vars and said and not (name == "pull_off_force" and (data[name] == 0.0).all()):
            table = data[name]
            size = sizes.get(name, np.abs(table)).transpose(*table.dims) if table.dims else sizes.get(name, np.abs(table))
            for place in _places(table.shape):
                at = dict(zip(table.dims, place, strict=True))
                found[name, json.dumps(at) if at else ""] = table.isel(at).item(), float(np.max(size.isel(at).values))
    return found


def _sizes(data, contact, at_load: bool) -> dict[str, Any]:
    """Against what a difference of each quantity is judged; its own size if nothing is said here.

    A load is what compression leaves of tension, and its rounding is that of both. Tension is, of a contact that has any, what
    the asperities that touch hold at most, 2 pi R gamma each; the rest are the parts by state of the asperities.
    The friction coefficient is divided by the load, and everything at a given load follows the separation that was found for
    it: these are known as well as the load is. A separation is counted from the mean of the heights, in sigma.
    """
    real = isinstance(contact, st.Contact)
    sigma = contact.roughness.asperity_height_deviation if real else 1.0
    radius_gamma = contact.roughness.asperity_radius * contact.work_of_adhesion if real else 1.0 / contact.theta
    load = np.abs(data["load"])
    parts = [np.abs(data[f"load_{state}"]) for state in ("elastic", "plastic", "elastic_plastic") if f"load_{state}" in data]
    whole = np.maximum(sum(parts, start=0.0 * load), load)
    if "touching_asperities" in data:
        tension = 2.0 * np.pi * radius_gamma * data["touching_asperities"]
        whole = whole + tension.where(data["pull_off_force"] > 0.0, 0.0)
    blur = (whole / load).where(load > 0.0, 1.0)
    sizes = {"load": whole, "friction_coefficient": blur * np.abs(data.get("friction_coefficient", 0.0))}
    if at_load:
        for name in ("contact_area", "friction_force", "touching_asperities", "tangential_stiffness"):
            sizes[name] = blur * np.abs(data.get(name, 0.0))
        sizes["mean_separation"] = blur * (np.abs(data.get("mean_separation", 0.0)) + sigma)
    return sizes


def _places(shape: tuple[int, ...]) -> list[tuple[int, ...]]:
    """First, last and some between of a table: at most five."""
    every = list(np.ndindex(shape))
    chosen = sorted({round(part * (len(every) - 1)) for part in (0.0, 0.21, 0.47, 0.78, 1.0)})
    return [tuple(int(i) for i in every[one]) for one in chosen]


def _compared(asked) -> dict:
    """Of every model the friction coefficient and the contact area at the load."""
    data = st.compare(_subject(asked), **asked["with"])
    found: dict[tuple[str, str], tuple[Any, float]] = {}
    for model in map(str, data["model"].values):
        at = json.dumps({"model": model})
        for name in ("friction_coefficient_at_load", "contact_area_at_load"):
            value = data[name].sel(model=model).item()
            # Of a load far above all tension, see `_sizes`.
            found[name, at] = value, abs(value)
    return found


def _evaluated(asked) -> dict:
    """Places in the arrays that `evaluate` returns."""
    given = {name: np.array(value) if isinstance(value, list) else value for name, value in asked["with"].items()}
    result = st.evaluate(**given)
    # 2 pi/theta is the largest tension of an asperity, and no more touch than there are.
    tension = np.broadcast_to(2.0 * np.pi / given["theta"], result.load.shape)
    found = {}
    for name in result._fields:
        table = getattr(result, name)
        for place in _places(table.shape):
            value = float(table[place])
            size = abs(value) + (float(tension[place] * result.contact_area[place]) if name == "load" else 0.0)
            found[name, json.dumps(place)] = value, size
    return found


def _found(asked) -> dict:
    """sigma, R and N of a made surface by one way of finding asperities."""
    spectrum = st.SelfAffine(**asked["spectrum"])
    found = st.asperities(st.gaussian_surface(**asked["surface"], spectrum=spectrum), **asked["with"])
    values = {name: float(getattr(found, name)) for name in ("deviation", "radius", "density", "mean_height")}
    # A mean height is counted from the mean plane: it is as good as the heights are.
    sizes = values | {"mean_height": abs(values["mean_height"]) + values["deviation"]}
    return {(name, ""): (value, abs(sizes[name])) for name, value in values.items()}


# What is asked -----------------------------------------------------------------------------------------------------------

HEIGHTS: tuple[dict[str, Any], ...] = (
    {"gaussian": {}},
    {"exponential": {}},
    {"weibull": {"exponent": 2.5}},
    {"empirical": {"samples": [0, 1, 1, 2, 2, 2, 3, 3, 3, 3, 4, 4, 4, 5, 5, 6, 7, 9]}},
)
PLAIN, PAPER = "greenwood_williamson_1966", "soft_coating_2015"
# Films that are younger than the first rows: asked last, so that what was drawn for the others stays as it was.
LATER = ("dayson_1971", "kato_1981", "ravindran_ramasamy_laddha_1980")
# And rough surfaces that are.
LATER_SURFACES = (
    "yang_persson_2008", "wang_muser_2017", "xu_zhu_xiao_zhou_2024", "pastewka_robbins_2014_area", "persson_widened",
    "persson_tosatti_2001",
)  # fmt: skip
ON_FILM, OF_MAP = "rough_on_film", "boundary_elements"  # the first is asked with a film, the other of no numbers


def kinds() -> dict[str, dict[str, dict[str, Any]]]:
    """Kind -> key -> what st.models() says of it."""
    known: dict[str, dict[str, dict[str, Any]]] = {}
    for one in st.models():
        known.setdefault(one["kind"], {})[one["key"]] = one
    return known


def with_options(*laws: dict[str, Any]):
    """Every combination of the options of these laws; a default is not said."""
    options = {name: values for law in laws for name, values in law["options"].items()}
    for chosen in itertools.product(*options.values()):
        yield {name: value for name, value in zip(options, chosen, strict=True) if value != options[name][0]}


class Drawn:
    """Draws groups, rounded so that a row is short: the same in the same order."""

    def __init__(self, seed: int):
        self.rng = np.random.default_rng(seed)

    def number(self, low: float, high: float, decades: bool = False) -> float:
        drawn = self.rng.uniform(low, high)
        return float(f"{10.0**drawn if decades else drawn:.3g}")

    def groups(self, *laws: dict[str, Any], film: bool = False, **fixed) -> dict[str, Any]:
        """The groups that the laws need, and theta and lambda in any case."""
        needs = {"theta", "lam", *(["n_E", "n_H", "tau"] if film else []), *(name for law in laws for name in law["needs"])}
        if "savkoor_briggs_1977" in (law["key"] for law in laws):
            needs.add("peeling")
        ranges = {
            "theta": (-1, 4, True), "lam": (-2, 4, True), "nu": (0.0, 0.49), "hardness_to_yield": (1.6, 3.5),
            "K_beta": (3.0, 9.0), "n_E": (-1, 1, True), "n_H": (-1, 0.5, True), "tau": (0.3, 6.0), "n_g": (0.3, 2.0),
            "film_aspect": (-1, 1.5, True), "film_nu": (0.1, 0.45), "tabor_parameter": (-1, 1, True),
            "sharpness": (-2.5, -0.7, True), "roughness_parameter": (-1.3, -0.5, True), "nominal_width": (2.5, 4.0, True),
            "shear_strength": (-2, -0.6, True), "pressure_coefficient": (-2, -0.6, True), "peeling": (0.1, 0.9),
            "hardening": (-3, -1, True),
        }  # fmt: skip
        return {name: self.number(*ranges[name]) for name in ranges if name in needs} | fixed


def asked_at_separations(known, drawn: Drawn):
    """Every model, every pair of an asperity and a tangential law, every asperity law with every heights: with every option."""
    asperities, tangentials = (known[kind] for kind in ("asperity", "tangential"))

    def request(given, laws, **more):
        groups = drawn.groups(*laws)
        return {"call": "solve", "indices": groups, "with": {"separation": drawn.number(-0.5, 2.5)} | given | more}

    for key, model in surfaces(known).items():
        laws = [model, *(law for law in (asperities.get(model["asperity"]), tangentials.get(model["tangential"])) if law)]
        for options, heights in itertools.product(with_options(*laws), HEIGHTS):
            if model["asperity"]:
                yield request({"model": key}, laws, **options, heights=heights)
        if not model["asperity"]:
            for _ in range(3):
                yield request({"model": key, "tangential": "briscoe_tabor_1978"}, [*laws, tangentials["briscoe_tabor_1978"]])
            yield request({"model": key}, laws, heights=HEIGHTS[1])
    yield from asked_of_pairs(asperities, tangentials, request)


def asked_of_pairs(asperities, tangentials, request):
    """Of asperity laws with tangential laws, and with heights."""
    for (key, law), (other, sheared) in itertools.product(asperities.items(), tangentials.items()):
        for options in with_options(law):
            yield request({"model": PLAIN, "asperity": key, "tangential": other}, [law, sheared], **options)
    for (key, law), heights in itertools.product(asperities.items(), HEIGHTS[1:]):
        for options in with_options(law):
            interface = tangentials["bowden_tabor_1943"]
            given = {"model": PLAIN, "asperity": key, "tangential": interface["key"]}
            yield request(given, [law, interface], **options, heights=heights)


def surfaces(known):
    """The rough surfaces that were there from the first."""
    return {key: one for key, one in known["rough surface"].items() if key not in (*LATER_SURFACES, ON_FILM, OF_MAP)}


def films(known, later: bool = False):
    """The films that may be chosen; or those of them that came later."""
    return [one for key, one in known["film"].items() if one["interchangeable"] and (key in LATER) == later]


def asked_of_each(some, known, drawn: Drawn):
    """Some films with every option and every asperity law, the kinds of heights in turn."""
    turn = itertools.cycle(HEIGHTS)
    interface = known["tangential"]["bowden_tabor_1943"]
    for film in some:
        asperities = [{}] if film["own_asperity"] else [{"asperity": key} for key in known["asperity"]]
        for options, chosen in itertools.product(with_options(film), asperities):
            laws = [film, *(known["asperity"][key] for key in chosen.values())]
            given = {"model": PLAIN, "film": film["key"], "separation": drawn.number(-1.0, 2.0), "heights": next(turn)}
            given |= {"tangential": interface["key"]} if film["tangential"] in ("", "interface") else {"model": PAPER}
            groups = drawn.groups(*laws, interface, film=True)
            yield {"call": "solve", "indices": groups, "with": given | chosen | options}


def asked_of_films(known, drawn: Drawn):
    """Every film; and both variants of the paper."""
    yield from asked_of_each(films(known), known, drawn)
    for (key, model), heights in itertools.product(known["rough surface"].items(), HEIGHTS):
        if model["asperity"]:
            given = {"model": key, "separation": drawn.number(-1.0, 2.0), "heights": heights}
            laws = [known["asperity"][model["asperity"]]]
            yield {"call": "solve", "indices": drawn.groups(*laws, film=True), "with": given}
    for options, heights in itertools.product(with_options(known["rough surface"][PAPER]), HEIGHTS):
        given = {"separation": drawn.number(-1.0, 2.0), "heights": heights}
        yield {"call": "solve", "indices": drawn.groups(film=True, n_g=drawn.number(0.3, 2.0)), "with": given | options}


# With a hardness of its own, so that a better one of the preset leaves these results as they are.
STEEL_52100 = {"preset": "hardened_steel_52100", "hardness": 7.3e9}
STEEL: dict[str, Any] = {
    "first": STEEL_52100,
    "second": STEEL_52100,
    "work_of_adhesion": 0.1,
    "nominal_area": 1e-6,
    "interfacial_shear_strength": 2e8,
    "pressure_coefficient": 0.05,
}
ROUGH = {"asperity_height_deviation": 4.8e-8, "asperity_radius": 5e-5, "asperity_density": 1.7e10}
SILVER = {"material": {"preset": "silver", "hardness": "0.4 GPa"}, "thickness": 2e-7, "bodies": "first"}
HARDENING = STEEL_52100 | {"tangent_modulus": "2 GPa"}


def contact_of(**more) -> dict[str, Any]:
    return STEEL | {"roughness": ROUGH} | more


def asked_at_loads(known, drawn: Drawn):
    """Real contacts at loads: every model, asperity law and film; groups at loads, on both branches, many loads at once; the
    stiffness before sliding with every asperity law."""
    loads = [0.03, 1.0, 20.0]
    turn = itertools.cycle(loads)
    for key in surfaces(known):
        yield {"call": "solve", "contact": contact_of(), "with": {"load": next(turn), "model": key}}
        given = {"load": next(turn), "model": key, "tangential": "briscoe_tabor_1978"}
        yield {"call": "solve", "contact": contact_of(), "with": given}
        yield {"call": "solve", "contact": contact_of(coating=SILVER), "with": {"load": next(turn), "model": key}}
    for key in known["asperity"]:
        given = {"load": next(turn), "model": PLAIN, "asperity": key, "presliding": "mindlin_1949"}
        yield {"call": "solve", "contact": contact_of(first=HARDENING, second=HARDENING), "with": given}
    yield from asked_at_loads_of(films(known))
    each = itertools.cycle(HEIGHTS)
    for (key, law), _ in itertools.product(known["asperity"].items(), range(2)):
        for options in with_options(law):
            given = {"load": drawn.number(-4, 0, True), "model": PLAIN, "asperity": key, "heights": next(each)}
            groups = drawn.groups(law, theta=drawn.number(1, 4, True))
            yield {"call": "solve", "indices": groups, "with": given | options}
    many = [1e-4, 1e-3, 1e-2, 0.1, 1.0]
    for model in (key for key, one in known["rough surface"].items() if one["tangential"] != "none"):
        groups = drawn.groups(theta={"axis": [20.0, 100.0, 900.0]}, lam=drawn.number(0, 3, True))
        yield {"call": "solve", "indices": groups, "with": {"load": many, "model": model}}
    yield {"call": "solve", "contact": contact_of(), "with": {"load": 1e9}}


def asked_at_loads_of(some):
    """A real contact with some films, at loads."""
    for film in some:
        given = (
            {"model": PLAIN, "tangential": "bowden_tabor_1943"} if film["tangential"] in ("", "interface") else {"model": PAPER}
        )
        given |= {"asperity": film["asperity"]} if film["asperity"] else {}
        for one in (0.03, 1.0):
            chosen = {"load": one, "film": film["key"]} | given
            yield {"call": "solve", "contact": contact_of(coating=SILVER), "with": chosen}


def asked_later(known, drawn: Drawn):
    """Films that came later, at separations and at loads; then rough surfaces that did, at loads."""
    yield from asked_of_each(films(known, later=True) * 3, known, drawn)
    yield from asked_at_loads_of(films(known, later=True))
    interface = known["tangential"]["briscoe_tabor_1978"]
    for key in LATER_SURFACES:
        for load in (0.03, 1.0, 300.0):
            given = {"load": load, "model": key, "tangential": interface["key"]}
            yield {"call": "solve", "contact": contact_of(), "with": given}
            groups = drawn.groups(known["rough surface"][key], interface)
            yield {"call": "solve", "indices": groups, "with": given | {"load": drawn.number(-4, 0, True)}}
    for load in (0.03, 1.0, 300.0):
        given = {"load": load, "model": ON_FILM, "tangential": interface["key"]}
        yield {"call": "solve", "contact": contact_of(coating=SILVER), "with": given}


def asked_otherwise(known, drawn: Drawn):
    """Grids, the fast form, the way back, comparisons, and asperities found in a made surface."""
    grid = [round(-3.0 + 0.15 * step, 2) for step in range(41)]
    for coated, variant in itertools.product((False, True), ("corrected", "published")):
        groups = drawn.groups(film=coated, theta={"axis": [0.5, 7.0, 40.0, 900.0]})
        yield {"call": "solve", "indices": groups, "with": {"separation": grid, "variant": variant}}
        film = {"n_E": 0.3, "n_H": 0.4, "tau": drawn.number(0.5, 4.0)} if coated else {}
        for h in (grid, 0.7):
            given = {"h": h, "theta": [[0.5], [7.0], [40.0], [900.0]], "lam": 10.0, "variant": variant}
            yield {"call": "evaluate", "with": given | film}
    for key, law in known["asperity"].items():
        for options in with_options(law):
            groups = drawn.groups(law, theta=drawn.number(1, 3, True), shear_strength=0.1)
            given = {"asperity": key, "tangential": "bowden_tabor_1943"} | options
            yield {"call": "unload", "indices": groups, "with": given | {"min_separation": 0.2, "separation": [0.2, 0.5]}}
            yield {"call": "unload", "indices": groups, "with": given | {"max_load": 0.1, "separation_increase": 0.15}}
    for load, more in ((0.1, {}), (10.0, {}), (1.0, {"coating": SILVER}), (10.0, {"work_of_adhesion": 1.0, "coating": SILVER})):
        yield {"call": "compare", "contact": contact_of(**more), "with": {"load": load}}
    spectrum = {"hurst": 0.8, "rolloff": 1e-5, "shortest": 1e-6, "deviation": 8e-9}
    for method, seed in itertools.product(("three_point", "eight_neighbour", "persistence", "n_point", "mccool"), (1, 2)):
        surface = {"shape": [128, 128], "size": [2e-5, 2e-5], "seed": seed}
        yield {"call": "asperities", "surface": surface, "spectrum": spectrum, "with": {"method": method}}


def requests():
    """All requests, in the order of the file."""
    known = kinds()
    parts = (asked_at_separations, asked_of_films, asked_at_loads, asked_otherwise, asked_later)
    for seed, part in enumerate(parts):
        yield from part(known, Drawn(seed))


def main() -> None:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(COLUMNS)
    for asked in requests():
        line = json.dumps(asked, separators=(",", ":"))
        with np.errstate(all="ignore"):
            for (quantity, at), (value, size) in ask(asked).items():
                writer.writerow([line, quantity, at, repr(value), repr(size)])
    FILE.write_bytes(gzip.compress(text.getvalue().encode(), mtime=0))


if __name__ == "__main__":
    main()
