"""Case files that are built part by part, so that most are answered: materials, roughness, film, liquid, rest, errors, laws.

`built_case` draws a case of numbers that are likely to go together, and writes the files that it names to a folder. Films whose
modulus differs from that of the body by more than the table of layered spheres holds take seconds each: they are rare.
"""

import random
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from generate import put, scaled, schema_of, value_of

from stiction.contact.interfaces import allowed_interfaces, interface_names
from stiction.contact.materials import material, material_names
from stiction.records.registry import (
    AsperityLaw,
    AsperityMethod,
    FilmLaw,
    Record,
    RoughSurface,
    TangentialLaw,
    kinds_of_additions,
    of_kind,
)
from stiction.surfaces.finishes import finish_names
from stiction.surfaces.generate import SelfAffine, gaussian_surface

_KINDS = ("gaussian", "skewed", "worn", "lay", "two-scale", "ground", "polished")
_WRONG: tuple[Any, ...] = (
    "",
    "nan",
    "1e400 m",
    "-1 nm",
    "0",
    "5 parsnip",
    [],
    {},
    True,
    -1,
    0,
    1e300,
    1e-300,
    float("inf"),
    "1e-200 m",
    "1e200 Pa",
)
_FILMS = 0.05  # share of cases of [contact]
_TABLED = 0.9  # share of films with moduli near those of the bodies
_SCANS = 0.04
_PLAIN = (0.99, 0.95, 0.8)  # probabilities that a number is just a number; each case has one of them


def built_case(chance: random.Random, folder: Path) -> dict[str, Any]:
    """Return the tables of a case; files that it names are written to the folder."""
    draw = _Numbers(chance, folder)
    tables: dict[str, Any] = {"title": chance.choice(("", "built", "<b>mu</b>", "µ = 0,3"))} if chance.random() < 0.3 else {}
    if chance.random() < 0.2:
        tables["indices"] = _groups(draw)
    else:
        tables["contact"] = _contact(draw, tables)
    tables["solve"] = _solve(draw, tables)
    if chance.random() < 0.3:
        tables["uncertainty"] = _some(
            chance, count=lambda: 2 ** chance.randint(6, 8), seed=lambda: chance.randrange(2**31),
            coverage=lambda: round(chance.uniform(0.01, 0.999), 3), ranges=lambda: chance.random() < 0.5,
        )  # fmt: skip
    for section in ("sweep", "design", "fit"):
        if chance.random() < 0.04:
            tables[section] = value_of(chance, schema_of(section), section)
    if chance.random() < 0.15:
        _spoil(chance, tables)
    return tables


class _Numbers:
    """Draw numbers as a case file may state them: alone, in a list or range, or uncertain in one of all ways."""

    def __init__(self, chance: random.Random, folder: Path):
        self.chance, self.folder = chance, folder
        self._plain = chance.choice(_PLAIN)

    def log(self, least: float, most: float, unit: str = "") -> Any:
        """Return a number between two ends, uniform in its logarithm."""
        number = self.chance.uniform(np.log10(least), np.log10(most))
        return self._as(float(f"{10.0**number:.3g}"), unit, least, most)

    def even(self, least: float, most: float, unit: str = "") -> Any:
        """Return a number uniform between two ends."""
        return self._as(float(f"{self.chance.uniform(least, most):.3g}"), unit, least, most)

    def _as(self, value: float, unit: str, least: float, most: float) -> Any:
        def text(number: float) -> Any:
            number = float(f"{min(max(number, least), most):.4g}")
            return f"{number:.4g} {unit}" if unit else number

        chance = self.chance
        if chance.random() < self._plain:
            return text(value)
        far = value * 10.0 ** chance.choice((0.001, 0.01, 0.1, 0.3, 1.0))
        kind = chance.randrange(7)
        if kind == 0:
            return [text(value), text(far)][: chance.randint(1, 2)]
        if kind == 1:
            return {"start": text(value), "stop": text(far), "count": chance.randint(2, 4), "spacing": self._spacing()}
        if kind == 2:
            return {"low": text(value), "high": text(far), "spacing": self._spacing()}
        if kind == 3:
            return {"median": text(value), "factor": round(10 ** chance.uniform(0.001, 1.0), 4)}
        if kind == 4:
            return f"{value:.4g} +/- {value * chance.uniform(0.0, 0.5):.2g} {unit}".strip()
        if kind == 5:
            return {"values": [text(value), text(far)], "along": chance.choice(("pair", "x"))}
        name = f"samples_{len(list(self.folder.glob('samples_*')))}.txt"
        numbers = [min(max(value * 10 ** chance.gauss(0.0, 0.1), least), most) for _ in range(chance.randint(1, 9))]
        self.folder.joinpath(name).write_text("".join(f"{number:.6g}\n" for number in numbers), encoding="utf-8")
        return {"samples": name} | ({"unit": unit} if unit else {})

    def _spacing(self) -> str:
        return self.chance.choice(("linear", "log"))


def _contact(draw: _Numbers, tables: dict[str, Any]) -> dict[str, Any]:
    chance = draw.chance
    film, scan = chance.random() < _FILMS, chance.random() < _SCANS
    tabled = film and chance.random() < _TABLED
    modulus = 10.0 ** chance.uniform(10.0 if tabled else 3.5, 12.0)
    bodies = [_material(draw, modulus * 10 ** chance.choice((0.0, 0.0, 1.0, -1.0 if tabled else -2.0))) for _ in range(2)]
    if chance.random() < 0.1 and isinstance(bodies[0], dict):
        tables["materials"], bodies[0] = {"own": bodies[0]}, "own"
    contact = {"first": bodies[0], "second": bodies[1] if chance.random() < 0.6 else bodies[0]}
    contact["nominal_area"] = draw.log(1e-4, 1e3, "mm^2")
    contact["roughness"] = _scanned(draw) if scan else _roughness(draw)
    if film:
        contact["coating"] = _coating(draw, modulus if tabled else 10.0 ** chance.uniform(7.0, 12.0))
    _add_strength(draw, contact, bodies)
    _add_pulls_and_rest(draw, contact)
    return contact


def _add_strength(draw: _Numbers, contact: dict[str, Any], bodies: list[Any]) -> None:
    chance = draw.chance
    kind = chance.random()
    if kind < 0.3:
        states = _suited(bodies) if chance.random() < 0.9 else interface_names()
        contact["interface"] = chance.choice(states or interface_names())
    elif kind < 0.4:
        strengths = {
            "interfacial_shear_strength": lambda: draw.log(1e4, 1e10, "Pa"),
            "strength_over_shear_modulus": lambda: draw.log(1e-4, 1e-1),
            "shear_strength": lambda: draw.log(1e-4, 0.3),
        }
        name = chance.choice(list(strengths))
        contact["interface"] = {"name": "own", name: strengths[name]()}
        contact["interface"] |= _some(chance, pressure_coefficient=lambda: draw.even(0.0, 0.9))
    elif kind < 0.8:
        contact["interfacial_shear_strength"] = draw.log(1e4, 1e10, "Pa") if chance.random() < 0.95 else "0 Pa"
    if "interface" not in contact and chance.random() < 0.2:
        contact["pressure_coefficient"] = draw.even(0.0, 0.9)
    if chance.random() < 0.05:
        contact["peeling"] = draw.even(0.0, 1.0)  # refused without a named model
    contact |= _some(
        chance, (0.05, 0.25), hardness_to_yield=lambda: draw.even(1.0, 4.0), strength_variation=lambda: draw.even(0.0, 3.0),
    )  # fmt: skip
    if chance.random() < 0.2:
        contact["weakening_slip"] = draw.log(1e-2, 1e5, "nm")
        contact["residual_strength"] = draw.even(0.0, 1.0)


def _add_pulls_and_rest(draw: _Numbers, contact: dict[str, Any]) -> None:
    chance = draw.chance
    if chance.random() < 0.5:
        contact["work_of_adhesion"] = draw.log(1e-5, 10.0, "J/m^2") if chance.random() < 0.9 else "0 J/m^2"
    if chance.random() < 0.25:
        contact["hold_time"] = draw.log(1e-3, 1e9, "s") if chance.random() < 0.9 else "0 s"
        contact |= {"reference_time": draw.log(1e-6, 1e4, "s"), "ageing_rate": draw.log(1e-4, 1.0)}
    if chance.random() < 0.25:
        contact["liquid"] = {"relative_humidity": draw.even(0.01, 0.999)} | {
            f"contact_angle_{body}": draw.even(0.0, 100.0, "deg") for body in ("first", "second")
        }
        contact["liquid"] |= _some(
            chance, (0.1, 0.3), temperature=lambda: draw.even(200.0, 500.0, "K"),
            molar_volume=lambda: draw.log(5.0, 500.0, "cm^3/mol"),
            surface_tension=lambda: draw.log(1.0, 500.0, "mN/m"),
        )  # fmt: skip


def _suited(bodies: list[Any]) -> list[str]:
    """Return the interfaces that two bodies may have."""
    if all(body in material_names() for body in bodies):
        return allowed_interfaces(*map(material, bodies), coated=False)
    return ["boundary lubricant"]


def _material(draw: _Numbers, modulus: float) -> Any:
    chance = draw.chance
    if chance.random() < 0.45:
        return chance.choice(material_names())
    hardness = modulus * 10.0 ** chance.uniform(-3.0, -0.5)
    numbers = {"youngs_modulus": draw.log(modulus, modulus * 1.01, "Pa"), "poissons_ratio": draw.even(0.0, 0.499)}
    numbers["hardness"] = draw.log(max(hardness, 2e3), max(hardness, 2e3) * 1.01, "Pa")
    numbers |= _some(
        chance, (0.1, 0.4), yield_stress=lambda: draw.log(max(hardness / 5.0, 1e3), max(hardness, 1.1e3), "Pa"),
        tangent_modulus=lambda: draw.log(modulus * 1e-4, modulus * 0.9, "Pa"),
        characteristic_depth=lambda: draw.log(1.0, 1e5, "nm"), surface_energy=lambda: draw.log(1e-3, 5.0, "J/m^2"),
        material_class=lambda: chance.choice(("ice", "elastomer", "polymer", "soft metal", "metal", "ceramic", "carbon film")),
    )  # fmt: skip
    if chance.random() < 0.2:
        for name in chance.sample(sorted(numbers), chance.randint(1, len(numbers) - 1)):
            del numbers[name]
        numbers["preset"] = chance.choice(material_names())
    return numbers


def _coating(draw: _Numbers, modulus: float) -> dict[str, Any]:
    chance = draw.chance
    material = chance.choice(("silver", "titanium_nitride", "gold_film"))
    coating = {"material": material if chance.random() < 0.67 else _material(draw, modulus)}
    coating["thickness"] = draw.log(0.3, 1e6, "nm")
    return coating | _some(
        chance, bodies=lambda: chance.choice(("both", "first", "second")),
        work_of_adhesion=lambda: draw.log(1e-4, 5.0, "J/m^2"), friction_constant=lambda: draw.log(1e-3, 1e3, "N/m"),
    )  # fmt: skip


def _roughness(draw: _Numbers) -> dict[str, Any]:
    chance = draw.chance
    if chance.random() < 0.3:
        return _finished(draw) if chance.random() < 0.7 else {
            body: _finished(draw) if chance.random() < 0.7 else _summits(draw) for body in ("first", "second")
        }  # fmt: skip
    return _summits(draw)


def _finished(draw: _Numbers) -> dict[str, Any]:
    height = draw.chance.choice(("rms_height", "mean_height"))
    return {"finish": draw.chance.choice(finish_names()), height: draw.log(1.0, 2e4, "nm")} | _of_heights(draw, 0.1)


def _summits(draw: _Numbers) -> dict[str, Any]:
    chance = draw.chance
    sigma = 10.0 ** chance.uniform(-0.5, 4.0)
    radius = sigma * 10.0 ** chance.uniform(0.5, 5.0)
    density = 10.0 ** chance.uniform(-2.5, -0.3) / (sigma * radius) * 1e18
    rough = {
        "asperity_height_deviation": draw.log(sigma, sigma * 1.01, "nm"),
        "asperity_radius": draw.log(radius, radius * 1.01, "nm"),
    }
    rough["asperity_density"] = draw.log(density, density * 1.01, "1/m^2")
    law = chance.random()
    if law < 0.05:
        rough |= {"height_distribution": "weibull", "height_parameters": {"exponent": round(10 ** chance.uniform(0.0, 1.2), 3)}}
    elif law < 0.1:
        heights = [round(chance.gauss(0.0, sigma), 4) for _ in range(chance.randint(2, 30))]
        rough |= {
            "height_distribution": chance.choice(("discrete", "empirical")),
            "height_parameters": {"samples": [f"{height} nm" for height in heights] if chance.random() < 0.5 else heights},
        }
    elif law < 0.15:
        rough["height_distribution"] = chance.choice(("exponential", "uniform", "gaussian", "none"))
    return rough | _of_heights(draw, 0.15)


def _of_heights(draw: _Numbers, share: float) -> dict[str, Any]:
    chance = draw.chance
    heights = _some(
        chance, (share,), kind=lambda: chance.choice(_KINDS), texture_aspect_ratio=lambda: chance.uniform(0.02, 1.0)
    )
    if chance.random() < share:
        skewness = round(chance.uniform(-3.0, 3.0), 2)
        heights |= {"skewness": skewness, "kurtosis": round(1.0 + skewness**2 + 10.0 ** chance.uniform(-1.0, 1.0), 2)}
    return heights


def _scanned(draw: _Numbers) -> dict[str, Any]:
    """Return roughness measured by one or two small maps, some of them one period of a surface."""
    chance = draw.chance
    bodies = ("first", "second")[: chance.randint(1, 2)]
    rough: dict[str, Any] = {}
    for body in bodies:
        pixels = chance.choice((16, 24, 32))
        spectrum = SelfAffine(
            hurst=chance.uniform(0.2, 1.0), rolloff=1e-5 / chance.choice((1, 4)), shortest=4e-5 / pixels,
            deviation=10.0 ** chance.uniform(-9.0, -5.5),
        )  # fmt: skip
        heights = gaussian_surface((pixels, pixels), (1e-5, 1e-5), spectrum, chance.randrange(2**31)).heights.copy()
        if chance.random() < 0.2:
            heights[chance.randrange(pixels), :: chance.randint(1, 5)] = np.nan
        np.save(draw.folder / f"{body}.npy", heights)
        rough[body] = {"file": f"{body}.npy", "size": "10 um", "height_unit": "m"} | (
            {"periodic": True} if chance.random() < 0.5 else {}
        )
    return rough | _some(
        chance, (0.1, 0.3), method=lambda: chance.choice(list(of_kind(AsperityMethod))), form=lambda: chance.randint(0, 4),
        spikes=lambda: round(chance.uniform(2.0, 20.0), 1), fill=lambda: chance.choice(("harmonic", "nearest")),
        shortest=lambda: f"{chance.uniform(0.2, 5.0):.3g} um", longest=lambda: f"{chance.uniform(1.0, 20.0):.3g} um",
        heights=lambda: chance.choice(("gaussian", "weibull", "empirical")),
    )  # fmt: skip


def _groups(draw: _Numbers) -> dict[str, Any]:
    chance = draw.chance
    groups = {"theta": draw.log(1e-2, 1e6), "lam": draw.log(1e-3, 1e6)}
    if chance.random() < 0.3:
        groups = {"hardness_group": draw.log(1e-2, 1e3)}
    together = [("n_E", "n_H", "tau"), ("waiting", "ageing_rate"), ("meniscus_index", "meniscus_height"), ("shear_strength",)]
    together += [
        ("pressure_coefficient",),
        ("strength_variation",),
        ("hardness_to_yield",),
        ("nu",),
        ("peeling",),
        ("hardening",),
    ]
    together += [("sharpness", "roughness_parameter", "nominal_width"), ("tabor_parameter",), ("K_beta",), ("films",)]
    if chance.random() < 0.1:
        together = [(name,) for name in schema_of("indices")["properties"] if name not in groups]
    for names in together:
        if chance.random() < 0.2:
            groups |= {name: _group(draw, name) for name in names}
    return groups


def _group(draw: _Numbers, name: str) -> Any:
    if name in ("nu", "film_nu", "layer_nu", "coated_nu", "counter_nu", "hardening", "peeling", "coated_share"):
        return draw.even(0.0, 0.49)
    if name == "films":
        return draw.chance.choice((1, 2))
    return draw.log(1.0, 5.0) if name == "hardness_to_yield" else draw.log(1e-3, 1e2)


def _solve(draw: _Numbers, tables: dict[str, Any]) -> dict[str, Any]:
    chance = draw.chance
    of_groups = "indices" in tables
    middle = chance.uniform(-9.0, 5.0)
    if chance.random() < (0.6 if of_groups else 0.15):
        start = chance.uniform(-2.0, 6.0)
        table: dict[str, Any] = {"separation": [round(start - step, 3) for step in range(chance.randint(1, 4))]}
        if chance.random() < 0.3:
            table = {"separation": {"start": start, "stop": start - 3.0, "count": chance.randint(2, 8)}}
    else:
        loads = [10.0 ** (middle + chance.uniform(-1.0, 1.0)) for _ in range(chance.randint(1, 4))]
        if chance.random() < 0.1:
            loads.append(chance.choice((0.0, -1.0)) * loads[0])
        unit = "" if of_groups else " N"
        table = {"load": [f"{load:.4g}{unit}" if unit else load for load in loads]}
        if chance.random() < 0.3:
            ends = {"start": f"{loads[0]:.4g}{unit}", "stop": f"{loads[0] * 10 ** chance.uniform(0.0, 3.0):.4g}{unit}"}
            table = {"load": ends | {"count": chance.randint(2, 8), "spacing": chance.choice(("linear", "log"))}}
    if chance.random() < 0.5:
        return table
    laws: list[Record] = []
    for name, (kind, share) in _laws().items():
        if chance.random() < share:
            laws.append(chance.choice(list(of_kind(kind).values())))
            table[name] = laws[-1].key if chance.random() < 0.95 else "none"
    for name, values in ((name, values) for law in laws for name, values in law.options.items()):
        if chance.random() < 0.3:
            table[name] = chance.choice(values)
    return table


@cache
def _laws() -> dict[str, tuple[type[Record], float]]:
    """Return the keys of [solve] that name models and laws, each with its kind and the share of named models that have it."""
    named: dict[str, tuple[type[Record], float]] = {"model": (RoughSurface, 0.9), "asperity": (AsperityLaw, 0.25)}
    named |= {"tangential": (TangentialLaw, 0.25), "film": (FilmLaw, 0.1)}
    return named | {name: (kind, 0.1) for name, kind in kinds_of_additions().items()}


def _some(chance: random.Random, shares: tuple[float, ...] = (0.1, 0.5), **parts: Any) -> dict[str, Any]:
    """Return the parts that are drawn, each with a probability that is itself drawn."""
    share = chance.choice(shares)
    return {name: made() for name, made in parts.items() if chance.random() < share}


def _spoil(chance: random.Random, tables: dict[str, Any]) -> None:
    """Scale one number by much, remove one value, or put a wrong one in its place."""
    places = list(_places(tables))
    place = chance.choice(places)
    value: Any = tables
    for name in place:
        value = value[name]
    kind = chance.random()
    if kind < 0.5:
        put(tables, place, scaled(chance, value))
    elif kind < 0.8:
        put(tables, place, chance.choice(_WRONG))
    else:
        table: Any = tables
        for name in place[:-1]:
            table = table[name]
        del table[place[-1]]


def _places(table: dict[str, Any], place: tuple[str, ...] = ()) -> list[tuple[str, ...]]:
    return [
        found
        for name, value in table.items()
        for found in (_places(value, (*place, name)) if isinstance(value, dict) and value else [(*place, name)])
    ]
