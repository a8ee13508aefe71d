"""The pages of the models: for each its docstring, its picture, what its record says, and BibTeX; and the bibliography."""

import re
from pathlib import Path, PurePosixPath

import make_tables
import matplotlib.pyplot as plt
from links import relinked
from model_pictures import picture

import stiction as st
from stiction.laws.registry import KINDS, Record, records
from stiction.laws.sources import bibliography

TITLES = {
    "rough surface": "Rough surfaces",
    "asperity": "Laws of one asperity, pressed",
    "tangential": "Laws of one asperity, sheared",
    "film": "Films",
    "composite": "Film and substrate as one body",
    "presliding": "Before sliding",
    "meniscus": "Menisci of humid air",
    "ageing": "Time at rest",
    "contamination": "What lies between the faces",
    "criterion": "Criteria",
    "asperity method": "Ways of finding asperities",
}
_PAGE = PurePosixPath("docs") / make_tables.SECTIONS
_NAMED = re.compile(r"\[([a-z_]+_\d{4}\w*)\](?!\()")


def file_of(record: Record) -> str:
    """The page of a model, without its ending; keys of two kinds may be the same."""
    twin = make_tables.shares_its_key({"key": record.key, "kind": record.kind})
    return f"{record.key}-{record.kind}".replace(" ", "-") if twin else record.key


def write(out: Path) -> list[PurePosixPath]:
    """A page and a picture for each model, their list, and the bibliography."""
    folder = out / "models-by-name"
    folder.mkdir(parents=True)
    linked = []
    for row, record in zip(st.models(), records(), strict=True):
        drawn = picture(record)
        drawn.savefig(folder / f"{file_of(record)}.png", dpi=120)
        plt.close(drawn)
        place = PurePosixPath("models-by-name") / f"{file_of(record)}.md"
        text, more = relinked(page(row, record), _PAGE, place)
        (out / place).write_text(_with_sources(text, record), encoding="utf-8")
        linked += more
    (folder / "index.md").write_text(index(), encoding="utf-8")
    (out / "reference").mkdir(exist_ok=True)
    (out / "reference" / "bibliography.md").write_text(sources(), encoding="utf-8")
    return linked


def page(row: dict, record: Record) -> str:
    """What the file of a model says, with its picture and BibTeX; links are those of docs/published-models.md."""
    text = re.sub(r"^### ", "# ", make_tables.section(row), count=1)
    said, points = re.split(r"\n\n(?=- Grade )", text, maxsplit=1)
    drawn = f"```{{image}} {file_of(record)}.png\n:alt: {record.key}, drawn\n:class: drawn\n```"
    heading, _, rest = said.partition("\n\n")
    named = _also_named(record)
    entries = st.cite(list(dict.fromkeys(source.key for source in record.sources))).strip() if record.sources else ""
    cited = f"\n\n## BibTeX\n\n```bibtex\n{entries}\n```" if entries else ""
    parts = [heading, f"*{record.kind}: {record.title}.* {named}", rest, "## As a picture", drawn, "## Its record", points]
    return "\n\n".join(parts) + f"{cited}\n"


def _also_named(record: Record) -> str:
    """How it is chosen."""
    if not record.keyword:
        return ""
    return f'Chosen with `{record.keyword}="{record.key}"`.'


def _with_sources(text: str, record: Record) -> str:
    """Names of sources in brackets lead to the bibliography, those of models to their pages."""
    known = bibliography()
    for one in records():  # a model leads to the page of another, not to its section on the page of all
        there = make_tables.anchor({"key": one.key, "kind": one.kind})
        text = text.replace(f"](../{make_tables.SECTIONS}#{there})", f"]({file_of(one)}.md)")
    return _NAMED.sub(
        lambda found: f"[{found[1]}](../reference/bibliography.md#{found[1]})" if found[1] in known else found[0], text
    )


def index() -> str:
    """The list of all models, by kind."""
    lines = [
        "# Every model",
        "",
        "What is behind each name: equations, picture, record and BibTeX. [Models](../models.md) explains the list.",
        "",
    ]
    for kind in KINDS:
        mine = [one for one in records() if type(one) is kind]
        lines += [f"## {TITLES[kind.kind]}", "", "| key | what it is | grade |", "|---|---|---|"]
        lines += [f"| [`{one.key}`]({file_of(one)}.md) | {one.title} | {one.grade} |" for one in mine]
        lines += ["", ":::{toctree}", ":hidden:", "", *map(file_of, mine), ":::", ""]
    return "\n".join(lines)


def sources() -> str:
    """Everything that is cited."""
    lines = ["# Bibliography", "", "`stiction cite` prints all of it, `stiction cite KEY` that of one model.", ""]
    for key, entry in bibliography().items():
        lines += [f"## {key}", "", f"```bibtex\n{entry}\n```", ""]
    return "\n".join(lines)
