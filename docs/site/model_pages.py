"""The pages of the models: for each its docstring, its picture, what its record says, and BibTeX; and the bibliography."""

import re
from pathlib import Path, PurePosixPath

import make_tables
import matplotlib.pyplot as plt
import truth_tables
from links import relinked
from model_pictures import picture

import stiction as st
from stiction.records.registry import Record, RoughSurface, kinds, records
from stiction.records.sources import bibliography

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
HEADING = "## Grade, evidence and validity"
READ = "[How to read this list](published-models.md)."
_PAGE = PurePosixPath("docs") / make_tables.SECTIONS
_NAMED = re.compile(r"\[([a-z_]+_\d{4}\w*)\](?!\()")
_SOURCE = re.compile(r"^- Source: (\w+)", re.MULTILINE)
_SECTION = re.compile(rf"\]\((?P<up>[./]*){re.escape(make_tables.SECTIONS)}#(?P<place>[\w-]+)\)")


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
        (out / place).write_text(_with_sources(text), encoding="utf-8")
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
    told = points + _measured(record)
    parts = [heading, f"*{record.kind}: {record.title}.* {named}", rest, "## Picture", drawn, HEADING, told, READ]
    return "\n\n".join(parts) + f"{cited}\n"


def _measured(record: Record) -> str:
    """A line on its error against solved contacts, if it is a rough surface that was compared with them."""
    off = truth_tables.errors_of(record.key) if isinstance(record, RoughSurface) else ""
    return f"\n- Error of its contact area on solved surfaces ([all of them](truth.md)), {off}" if off else ""


def _also_named(record: Record) -> str:
    """How it is chosen."""
    if not record.keyword:
        return ""
    return f'Chosen with `{record.keyword}="{record.key}"`.'


def _with_sources(text: str) -> str:
    """Names of sources, in brackets or of the record, lead to the bibliography."""
    known = bibliography()

    def led(found: re.Match) -> str:
        link = f"[{found[1]}](../reference/bibliography.md#{found[1]})"
        return found[0].replace(f"[{found[1]}]", found[1]).replace(found[1], link) if found[1] in known else found[0]

    return _SOURCE.sub(led, _NAMED.sub(led, text))


def lead_here(out: Path) -> None:
    """Links to the section of a model on the page of all, which takes long to open, lead to its own page."""
    own = {make_tables.anchor({"key": one.key, "kind": one.kind}): file_of(one) for one in records()}

    def led(found: re.Match) -> str:
        return f"]({found['up']}models-by-name/{own[found['place']]}.md)" if found["place"] in own else found[0]

    for path in out.rglob("*.md"):
        if path != out / make_tables.SECTIONS:
            path.write_text(_SECTION.sub(led, path.read_text(encoding="utf-8")), encoding="utf-8")


def index() -> str:
    """The list of all models, by kind."""
    lines = [
        "# Every model",
        "",
        "What is behind each name: equations, picture, record and BibTeX. [Models](../models.md) explains the list.",
        "",
    ]
    for kind in kinds():
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
