"""Writes the generated tables of the documentation: models and films from the registry, materials from the presets.

    python docs/make_tables.py

Each table stands in its page between a line "<!-- NAME: begin, made by docs/make_tables.py -->" and "<!-- NAME: end -->".
"""

import re
from pathlib import Path

import stiction as st
from stiction.materials import material_names
from stiction.quantities import QUANTITIES
from stiction.registry import GRADES
from stiction.units import show

HERE = Path(__file__).parent


def grades() -> str:
    """What the provenance grades mean."""
    return table(("grade", "meaning"), [(f"**{grade}**", meaning) for grade, meaning in GRADES.items()])


def overview(kind: str) -> str:
    """One line for each model of a kind."""
    rows = [
        (f"[`{model['key']}`](#{model['key']})", model["title"], model["grade"], *answers(model))
        for model in st.models()
        if model["kind"] == kind
    ]
    head = ("key", "what it is", "grade", *(("friction", "film") if kind == "rough surface" else ()))
    return table(head, rows)


def answers(model: dict) -> tuple[str, ...]:
    """Whether a rough-surface model predicts friction and takes a film."""
    if model["kind"] != "rough surface":
        return ()
    return tuple("yes" if model[name] else "no" for name in ("friction", "coating"))


def details(kind: str) -> str:
    """A section for each model of a kind."""
    return "\n\n".join(section(model) for model in st.models() if model["kind"] == kind)


def section(model: dict) -> str:
    """All that the record of one model says."""
    options = [f"`{name}`: {', '.join(f'`{value}`' for value in values)}" for name, values in model["options"].items()]
    lines = [f"### `{model['key']}`", "", f"{model['title']}. Grade {model['grade']}.", ""]
    lines += [f"- Source: {source}" for source in model["source"]]
    lines += [f"- Checked against: {model['verified']}"]
    lines += [f"- Sums are good to: {model['accuracy']:.0e}"]
    lines += [f"- Valid for: {rule}" for rule in model["validity"]]
    lines += [f"- Depends on: {', '.join(f'`{name}`' for name in model['needs'])}"] if model["needs"] else []
    lines += [f"- Options, the default first: {'; '.join(options)}"] if options else []
    lines += [f"- Note: {model['notes']}"] if model["notes"] else []
    return "\n".join(lines)


def materials() -> str:
    """Every preset with its numbers."""
    names = ("youngs_modulus", "poissons_ratio", "hardness", "surface_energy")
    head = ("preset", *(f"{QUANTITIES[name].meaning.split(',')[0]} {QUANTITIES[name].symbol}" for name in names))
    rows = []
    for key in material_names():
        preset = st.material(key)
        values = [getattr(preset, name) for name in names]
        shown = ["" if value is None else show(value, name) for name, value in zip(names, values, strict=True)]
        rows.append((f"`{key}`", *shown))
    return table(head, rows)


def material_sources() -> str:
    """Where each number comes from, presets with the same words taken together."""
    presets: dict[tuple[str, str], list[str]] = {}
    for key in material_names():
        for name, words in st.material(key).source.items():
            presets.setdefault((QUANTITIES[name].symbol, words), []).append(f"`{key}`")
    ordered = sorted(presets, key=lambda row: (row[0], -len(presets[row]), row[1]))
    head = ("number", "source, in the words of the file", "presets")
    return table(head, [(*row, ", ".join(presets[row])) for row in ordered])


def table(head: tuple[str, ...], rows: list[tuple[str, ...]]) -> str:
    """A Markdown table."""
    lines = [head, ("---",) * len(head), *rows]
    return "\n".join("| " + " | ".join(cell.replace("|", "\\|") for cell in line) + " |" for line in lines)


TABLES = {
    "models.md": {
        "grades": grades,
        "models": lambda: overview("rough surface"),
        "films": lambda: overview("film"),
        "details of models": lambda: details("rough surface"),
        "details of films": lambda: details("film"),
    },
    "materials.md": {"materials": materials, "sources of materials": material_sources},
}


def fresh_pages() -> dict[Path, str]:
    """Every page that holds generated tables, with these tables made anew."""
    pages = {}
    for file, tables in TABLES.items():
        text = (HERE / file).read_text(encoding="utf-8")
        for name, make in tables.items():
            marks = rf"(<!-- {name}: begin[^\n]*-->\n).*?(<!-- {name}: end -->)"
            text, places = re.subn(marks, lambda found, make=make: f"{found[1]}{make()}\n{found[2]}", text, flags=re.DOTALL)
            if places != 1:
                raise ValueError(f"{file}: {places} places for the table {name!r}")
        pages[HERE / file] = text
    return pages


if __name__ == "__main__":
    for page, text in fresh_pages().items():
        page.write_text(text, encoding="utf-8")
