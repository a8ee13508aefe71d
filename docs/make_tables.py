"""Writes what is generated in the documentation, from where it is said once.

    python docs/make_tables.py

- models.md: lists of models and laws, from their records;
- combining-laws.md: how asperities that have yielded unload, from the docstring of that module;
- materials.md: the presets, from their files;
- calibration.md: how often the interval of a prediction holds, from scores in validation/ (calibration_tables.py);
- compared-with-measurements.md: the prediction beside measured series (measured_tables.py);
- interfaces.md: states of an interface and finish classes, from their files (interface_tables.py);
- truth.md: how far models are from solved surfaces, from the set of these (truth_tables.py);
- what-mu-rests-on.md: friction of one contact with each assumption switched (what_mu_rests_on.py);
- reference/README.md: how each table of numbers was made, from the docstrings of the scripts that make them;
- choice.py: the keywords of laws for type checkers and editors, from the registry.

Each stands in its file between a line "<!-- NAME: begin, made by docs/make_tables.py -->" and "<!-- NAME: end -->".
"""

import ast
import inspect
import re
import sys
from functools import cache, partial
from pathlib import Path

import numpy as np

import stiction as st
from stiction.contact.materials import material_names, symbols_of
from stiction.laws.asperity.shared import unloading
from stiction.quantities.table import QUANTITIES
from stiction.records.claims import KINDS_OF_WARNING
from stiction.records.registry import (
    GRADES,
    Addition,
    AsperityMethod,
    Criterion,
    FilmLaw,
    Record,
    TangentialLaw,
    all_options,
    kinds,
    kinds_of_additions,
    records,
)
from stiction.report.lists import LISTED, with_range
from stiction.solving.accuracy import film_tables
from stiction.solving.accuracy.film_tables import summary
from stiction.solving.choice import LAWS
from stiction.solving.conditions import RULES
from stiction.surfaces.finding import methods
from stiction.surfaces.read import readers

HERE = Path(__file__).parent
sys.path.append(str(HERE))
import calibration_tables  # noqa: E402 - beside this file
import interface_tables  # noqa: E402 - beside this file
import measured_tables  # noqa: E402 - beside this file
import truth_tables  # noqa: E402 - beside this file
import what_mu_rests_on  # noqa: E402
from markdown_table import table  # noqa: E402

ROOT = HERE.parent
REFERENCE = ROOT / "reference"


def grades() -> str:
    """What the provenance grades mean."""
    return table(("grade", "meaning"), [(f"**{grade}**", meaning) for grade, meaning in GRADES.items()])


def of_kind(kind: str) -> list[dict]:
    return [model for model in st.models() if model["kind"] == kind]


def ways() -> str:
    """One line for each way of finding asperities, in the order of pictures."""
    rows = {model["key"]: model for model in of_kind("asperity method")}
    return table(
        ("key", "an asperity is", "grade", "also in profiles", "options, the default first"),
        [
            (link(rows[key]), one.title, one.grade, "yes" if one.of_profiles else "no",
             "; ".join(options_of(rows[key])))
            for key, one in methods().items()
        ],
    )  # fmt: skip


def options_of(model: dict) -> list[str]:
    """The options of a model, each with its values and, where they are not names, what they mean."""
    means = {name: f" ({meaning})" for name, meaning in model.get("options_mean", {}).items()}
    values = {name: ", ".join(f"`{value}`" for value in each) for name, each in model["options"].items()}
    return [f"`{name}`: {text}{means.get(name, '')}" for name, text in values.items()]


def formats() -> str:
    """One line for each format of files."""
    rows = [(", ".join(f"`{end}`" for end in one.endings) or "any other", one.holds, one.given) for one in readers()]
    return table(("file", "contents", "you must state"), rows)


def overview(kind: str) -> str:
    """One line for each model of a kind."""
    names, cells = COLUMNS.get(kind, ((), lambda model: ()))
    rows = [(link(model), model["title"], model["grade"], *cells(model)) for model in of_kind(kind)]
    return table(("key", "description", "grade", *names), rows)


def additions() -> str:
    """One line for each law that can be added to a model, with the keyword of its kind."""
    rows = [
        (f"`{kind}`", link(model), model["title"], model["grade"]) for kind in kinds_of_additions() for model in of_kind(kind)
    ]
    return table(("keyword", "key", "description", "grade"), rows)


def record_of(model: dict) -> Record:
    """The record that the row of `st.models()` is about."""
    return next(one for one in records() if (one.key, one.kind) == (model["key"], model["kind"]))


def takes(model: dict) -> tuple[str, ...]:
    """The laws that a rough-surface model takes by itself."""
    if not model["asperity"]:
        return "closed form" if record_of(model).of_map is None else "none: it solves the map", "none", "none"
    laws = {"asperity": model["asperity"], "tangential": model["tangential"], "film": model["default_film"]}
    keys = {kind: key if key != "none" else "" for kind, key in laws.items()}
    return tuple(link({"key": key, "kind": kind}) if key else "none" for kind, key in keys.items())


def asperities_of(model: dict) -> str:
    """Which asperity laws a tangential or film law goes with."""
    wanted = model["required_traits"]
    marked = f"with the propert{'y' if len(wanted) == 1 else 'ies'} {', '.join(wanted)}" if wanted else "any"
    if not getattr(record_of(model), "own_asperity", False):
        return marked
    return f"its own, in place of an asperity law {marked}" if wanted else "its own"


def friction_of(model: dict) -> str:
    """Which tangential laws a film law goes with."""
    if getattr(record_of(model), "solved_as_one", False):
        return "laws of the interface, and laws for a film and its substrate as one body"
    known = {"": "any that suits the asperity law", "interface": "laws of the interface"}
    return known.get(model["tangential"]) or f"its own, `{model['tangential']}`"


# What the overview of a kind has beyond key, title and grade: heads, and the cells of a row.
COLUMNS = {
    "rough surface": (("asperity law", "tangential law", "film law"), takes),
    "asperity": (("properties",), lambda model: (", ".join(model["traits"]),)),
    "tangential": (
        ("asperity laws", "of the interface"),
        lambda model: (asperities_of(model), "yes" if model["interfacial"] else ""),
    ),
    "film": (("asperity laws", "tangential laws"), lambda model: (asperities_of(model), friction_of(model))),
}


def shares_its_key(model: dict) -> bool:
    """Whether a model of an earlier kind has this key too."""
    chosen = [kind.kind for kind in kinds() if kind.keyword]
    earlier = chosen[: chosen.index(model["kind"])] if model["kind"] in chosen else chosen
    return any(other.key == model["key"] and other.kind in earlier for other in records())


def heading(model: dict) -> str:
    kind = model["kind"] if model["kind"] == Criterion.kind else f"{model['kind']} law"
    return f"`{model['key']}` ({kind})" if shares_its_key(model) else f"`{model['key']}`"


def file_of(model: dict) -> Path:
    """Return the file of the package that holds the model's record, relative to the project."""
    folder = model["kind"].replace(" ", "_")
    return next((ROOT / "src" / "stiction").glob(f"*/{folder}/{model['key']}.py")).relative_to(ROOT)


def link(model: dict) -> str:
    """Return the key as a link from a folder of docs/ to the model's file; the site leads to the model's page instead."""
    return f"[`{model['key']}`](../../{file_of(model).as_posix()})"


def record_lines(model: dict) -> str:
    """Return what the record of a model states, as a list."""
    record = record_of(model)
    options = options_of(model)
    lines = [f"- Grade {model['grade']}: {GRADES[model['grade']]}"]
    lines += [f"- Source: {source}" for source in model["source"]]
    lines += [f"- Checked against: {model['verified']}"]
    lines += [f"- Reference values: [`{name}`](../../../reference/{name})" for name in reference_tables(record)]
    good = "sigma and R of wide paraboloids" if model["kind"] == "asperity method" else "sums"
    lines += [f"- Relative error of {good}: at most {model['accuracy']:.0e}"] if record.keyword else []
    lines += [f"- Jumps {jump}" for jump in model.get("jumps", ())]
    lines += [f"- In the limit: {departure}" for departure in model.get("departures", ())]
    lines += [
        f"- Requires an asperity law with the property {trait}: {why}"
        for trait, why in model.get("required_traits", {}).items()
    ]
    lines += [f"- Error for a sphere (area at a given load, load at a given approach): {one}" for one in off_by(model)]
    lines += [f"- Properties: {', '.join(model['traits'])}"] if model.get("traits") else []
    lines += more(record)
    lines += [f"- Valid for: {rule}" for rule in model["validity"] or ["no range is stated"]]
    lines += [f"- Depends on: {', '.join(f'`{name}`' for name in model['needs'])}"] if model["needs"] else []
    lines += [f"- Options, the default first: {'; '.join(options)}"] if options else []
    lines += [f"- Note: {model['notes']}"] if model["notes"] else []
    return "\n".join(lines)


def off_by(model: dict) -> list[str]:
    """What was measured of a film law, in words."""
    return model.get("measured_film_error", [])


def more(record: Record) -> list[str]:
    """What is not in the rows of `st.models()`: what a film goes with, what a criterion says, and what a law becomes."""
    lines = []
    if isinstance(record, FilmLaw) and record.own_asperity:
        lines.append("- Has its own asperity law")
    if isinstance(record, FilmLaw) and record.tangential:
        others = (
            "of the interface" if record.tangential == "interface" else f"`{record.tangential}`, which is part of this film law"
        )
        others += " and tangential laws for a film and its substrate as one body" * record.solved_as_one
        lines.append(
            f"- Can be combined only with the tangential law{'s' if record.tangential == 'interface' else ''} {others}"
        )
    if isinstance(record, TangentialLaw) and record.layered:
        lines.append("- Uses the stresses in film and substrate if the film law computes them, otherwise those in a half-space")
    if isinstance(record, AsperityMethod):
        lines += ["- Accepts only maps, no profiles"] * (not record.of_profiles)
        lines += ["- Can be the default method, because it finds the summits of a Gaussian surface"] * record.of_summits
        lines += [
            "- Theories without asperities can use this method, because its numbers reproduce the moments of the surface"
        ] * record.of_moments
    if isinstance(record, Criterion):
        lines += [f"- Below 1: {record.below}", f"- Above 1: {record.above}"]
    for limit in record.limits:
        values = [f"`{name}` = {value:g}" for name, value in limit.groups.items()]
        chosen = [f"`{name}` `{value}`" for name, value in limit.options.items()]
        where = f"at {', '.join(values + chosen)}" if values else "for all values of the groups"
        results = " and ".join(limit.quantities)
        lines.append(f"- Agrees with `{limit.parent}` {where}: relative difference of {results} at most {limit.within:.0e}")
    return lines


def materials() -> str:
    """Every preset with its numbers and their ranges."""
    numbers = (f"{QUANTITIES[name].meaning.split(',')[0]} {QUANTITIES[name].symbol} (range)" for name in LISTED)
    rows = []
    for name in material_names():
        words = ", ".join(f"`{word}`" for word in (name, *symbols_of(name)))
        rows.append((words, *(with_range(st.material(name), quantity) for quantity in LISTED)))
    return table(("preset, symbols", *numbers), rows)


def material_sources() -> str:
    """Where each number comes from, presets with the same words taken together."""
    presets: dict[tuple[str, str], list[str]] = {}
    for key in material_names():
        for name, words in st.material(key).source.items():
            presets.setdefault((QUANTITIES[name].symbol, words), []).append(f"`{key}`")
    ordered = sorted(presets, key=lambda row: (row[0], -len(presets[row]), row[1]))
    head = ("number", "source", "presets")
    return table(head, [(*row, ", ".join(presets[row])) for row in ordered])


def conditions() -> str:
    """What every result is asked, whichever model made it."""
    rows = [
        (f"${QUANTITIES[rule.quantity].latex}$: {QUANTITIES[rule.quantity].meaning}", rule.range, rule.kind, rule.why)
        for rule, _ in RULES
    ]
    return table(("quantity", "range", "kind", "outside of it"), rows)


def kinds_of_warning() -> str:
    """What it means to leave a range."""
    return table(("kind", "meaning"), list(KINDS_OF_WARNING.items()))


def film_errors_on_a_sphere() -> str:
    """What film laws make of an elastic sphere, against the exact solution."""
    rows = []
    for model in of_kind("film"):
        for one in summary(model["key"]):
            name = f"{link(model)}{', ' * bool(one['options'])}{one['options']}"
            for at, n_E in enumerate(one["n_E"]):
                pairs = zip(one["area"][at], one["load"][at], strict=True)
                cells = (f"{_percent(area)}, {_percent(load)}" for area, load in pairs)
                rows.append((name if not at else "", f"{n_E:g}", *cells))
            widths = one["a_over_t"]
    return table(("film law", "E_f/E_s", *(f"a/t = {width:g}" for width in widths)), rows)


def _percent(value: float) -> str:
    return "over +1000" if value > 10.0 else f"{100.0 * value:+.0f}".replace("+0", "0").replace("-0", "0")


def summary_on_maps(law: str) -> list[tuple[str, float, float]]:
    """For each of a law's options, the geometric mean of its area over that of all solved maps at given load, and the root mean
    square of the logarithm. Nothing where it was not measured."""
    found = []
    for (key, options), rows in film_tables._maps().items():
        if key == law:
            mean, rms, count = np.array(rows)[:, 4:].T
            whole, scatter = np.exp(np.average(np.log(mean), weights=count)), np.sqrt(np.average(rms**2, weights=count))
            found.append((options, float(whole), float(scatter)))
    return found


def film_errors_on_maps() -> str:
    """What sums over asperities with film laws make of rough surfaces on a film."""
    models = [*of_kind("film"), *(model for model in of_kind("rough surface") if record_of(model).on_film)]
    rows = [
        (f"{link(model)}{', ' * bool(options)}{options}", f"{mean:.2f}", f"{rms:.2f}")
        for model in models
        for options, mean, rms in summary_on_maps(model["key"])
    ]
    return table(("law", "area over that of the map, geometric mean", "rms of its logarithm"), rows)


def unloading_of_yielded() -> str:
    """How yielded asperities unload if their law does not describe it."""
    files = {model["key"]: file_of(model) for model in of_kind("asperity")}
    return re.sub(r"\]\(#(\w+)\)", lambda found: f"](../../{files[found[1]].as_posix()})", inspect.getdoc(unloading) or "")


@cache
def scripts() -> dict[str, str]:
    """What each script that makes reference tables says of itself: its docstring."""
    paths = sorted(REFERENCE.glob("make_*.py"))
    return {path.name: ast.get_docstring(ast.parse(path.read_text(encoding="utf-8"))) or "" for path in paths}


# A line of such a docstring: "- `TABLE.csv`: ...", or "- `TABLE.csv` of `KEY`, `KEY`: ..." if it is not named for its model.
_TABLE = re.compile(r"^- `(\w+\.csv)`(?: of ([^:]*))?:", re.MULTILINE)


def tables_made() -> dict[str, dict[str, set[str]]]:
    """Script -> table -> the models that it is of, as their headings say."""
    return {
        script: {name: set(re.split(r",\s+", of or f"`{name[:-4]}`")) for name, of in _TABLE.findall(text)}
        for script, text in scripts().items()
    }


def reference_tables(record: Record) -> list[str]:
    """The tables of numbers with which the tests compare this model."""
    mine = heading({"key": record.key, "kind": record.kind})
    return [name for tables in tables_made().values() for name, models in tables.items() if mine in models]


def reference_scripts() -> str:
    """A section for each script."""
    return "\n\n".join(f"### `{name}`\n\n{text}" for name, text in scripts().items())


def keywords() -> str:
    """One line for each keyword of a law, and for each option of a law."""
    return "\n".join(f"    {name}: str | None" for name in (*LAWS[1:], *sorted(all_options())))


TABLES = {
    "reference/models.md": {"grades": grades, "additions": additions}
    | {kind.kind: partial(overview, kind.kind) for kind in kinds() if not issubclass(kind, Addition)},
    "explanation/combining-laws.md": {"unloading": unloading_of_yielded},
    "how-to/surfaces.md": {"formats": formats},
    "reference/surface-statistics.md": {"methods": ways},
    "explanation/which-film-law.md": {"errors on a sphere": film_errors_on_a_sphere, "errors on maps": film_errors_on_maps},
    "explanation/trust.md": {"conditions": conditions, "kinds of warning": kinds_of_warning},
    "explanation/truth.md": truth_tables.TABLES | {"by numbers": calibration_tables.by_numbers},
    "explanation/calibration.md": calibration_tables.TABLES,
    "explanation/compared-with-measurements.md": measured_tables.TABLES,
    "explanation/what-mu-rests-on.md": {"assumptions switched": what_mu_rests_on.table},
    "reference/materials.md": {"materials": materials, "sources of materials": material_sources},
    "reference/interfaces.md": interface_tables.TABLES,
    "../reference/README.md": {"scripts": reference_scripts},
    "../src/stiction/solving/choice.py": {"keywords": keywords},
}


def fresh_pages() -> dict[Path, str]:
    """Every page that holds generated tables, with these tables made anew."""
    pages = {}
    for file, tables in TABLES.items():
        text = (HERE / file).read_text(encoding="utf-8")
        for name, make in tables.items():
            marks = rf"(<!-- {name}: begin[^\n]*-->\n).*?([ #]*<!-- {name}: end -->)"
            text, places = re.subn(marks, lambda found, make=make: f"{found[1]}{make()}\n{found[2]}", text, flags=re.DOTALL)
            if places != 1:
                raise ValueError(f"{file}: {places} places for the table {name!r}")
        pages[HERE / file] = text
    return pages


if __name__ == "__main__":
    for page, text in fresh_pages().items():
        page.write_text(text, encoding="utf-8")
