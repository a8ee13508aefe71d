"""The pages of the models: for each its docstring, its picture, what its record says, and BibTeX; and the bibliography."""

import re
from pathlib import Path, PurePosixPath

import make_tables
import matplotlib.pyplot as plt
import truth_tables
from links import law_pages, page_with, relinked
from model_pictures import picture

import stiction as st
from stiction.quantities.table import QUANTITIES
from stiction.records.registry import Record, RoughSurface, kinds, records, text_of
from stiction.records.sources import bibliography
from stiction.report.html_words import letters
from stiction.report.printed_sources import tex_to_text

TITLES = {"rough surface": "Rough surfaces", "criterion": "Criteria", "asperity method": "Asperity methods"}
HEADING = "## Grade, evidence and validity"
READ = "[How to read this page](../../explanation/combining-laws.md#how-to-read-the-page-of-a-law)."
_NAMED = re.compile(r"\[([a-z_]+_\d{4}\w*)\](?!\()")
_SOURCE = re.compile(r"^- Source: (\w+)", re.MULTILINE)
_SHORT = re.compile(r"\]\((?:(?P<stem>[\w-]+)\.md)?(?:#(?P<place>[\w-]+))?\)")
# What docstrings of laws call sections that have moved.
MOVED = {"1-units": "units", "5-film-and-substrate-as-one-body": "film-and-substrate-as-one-body"}
_VALID = re.compile(r"(?<=^- Valid for: )\w+", re.MULTILINE)
_AUTHOR = re.compile(r"^\s*author\s*=\s*\{(.*)\},?$", re.MULTILINE)


def name_of(record: Record) -> str:
    """Return the name of a law: authors and year of its paper, or its key in words where it is this project's own."""
    cited = record.key if record.key in bibliography() else record.sources[0].key if record.sources else ""
    if not re.search(r"_\d{4}", record.key) and record.key not in ("hertz", "jkr", "dmt", "mccool"):
        return record.key.replace("_", " ").capitalize().replace("Rough dmt", "Rough DMT")
    authors = _AUTHOR.search(bibliography().get(cited, ""))
    year = re.search(r"_(\d{4})", record.key) or re.search(r"_(\d{4})", cited)
    if not (authors and year):
        return record.key.replace("_", " ").capitalize()
    names = [tex_to_text(one).split(",")[0].strip() for one in authors[1].split(" and ")]
    who = (
        f"{names[0]} et al."
        if len(names) > 3 or "others" in names
        else " & ".join([", ".join(names[:-1]), names[-1]][len(names) == 1 :])
    )
    return f"{who} {year[1]}{_SHORTER.get(record.key, '')}"


_SHORTER = {"jkr": " (JKR)", "dmt": " (DMT)"}


def write(out: Path) -> list[PurePosixPath]:
    """Write a page and a picture for each law, their list, and the bibliography."""
    folder = out / "reference" / "laws"
    folder.mkdir(parents=True)
    linked = []
    for row, record in zip(st.models(), records(), strict=True):
        place = place_of_law(record)
        drawn = picture(record)
        drawn.savefig((out / place).with_suffix(".png"), dpi=120)
        plt.close(drawn)
        text, more = relinked(page(row, record), PurePosixPath("docs") / place)
        (out / place).write_text(_with_sources(text), encoding="utf-8")
        linked += more
    (folder / "index.md").write_text(index(), encoding="utf-8")
    (out / "reference" / "bibliography.md").write_text(sources(), encoding="utf-8")
    return linked


def place_of_law(record: Record) -> PurePosixPath:
    """Return the page of a law in the site."""
    return law_pages()[PurePosixPath(make_tables.file_of({"key": record.key, "kind": record.kind}))]


def page(row: dict, record: Record) -> str:
    """Return the page of a law: its docstring, picture, record and BibTeX, with links from docs/reference/laws/."""
    drawn = f"```{{image}} {place_of_law(record).stem}.png\n:alt: {record.key}, drawn\n:class: drawn\n```"
    entries = st.cite(list(dict.fromkeys(source.key for source in record.sources))).strip() if record.sources else ""
    cited = f"\n\n## BibTeX\n\n```bibtex\n{entries}\n```" if entries else ""
    chosen = f'Choose it with `{record.keyword}="{record.key}"`.' if record.keyword else ""
    about = f"`{record.key}`, {record.kind}: {record.title}. {chosen}".strip()
    stated = _in_words(make_tables.record_lines(row)) + _measured(record)
    parts = [f"# {name_of(record)}", about, _with_whole_links(text_of(record)), "## Picture", drawn, HEADING, stated, READ]
    return "\n\n".join(parts) + f"{cited}\n"


def _in_words(lines: str) -> str:
    """Return lines with meanings in place of names of quantities, and Greek letters, except in code and TeX."""
    meant = _VALID.sub(lambda found: QUANTITIES[found[0]].meaning if found[0] in QUANTITIES else found[0], lines)
    return "".join(part if part[:1] in "`$" else letters(part) for part in re.split(r"(`[^`]*`|\$[^$]*\$)", meant))


def _measured(record: Record) -> str:
    """Return a line on the law's error, if it is a rough surface that was compared with solved contacts."""
    off = truth_tables.errors_of(record.key) if isinstance(record, RoughSurface) else ""
    return f"\n- Error of its contact area on solved surfaces ([all of them](../../explanation/truth.md)), {off}" if off else ""


def _with_whole_links(text: str) -> str:
    """Complete the links of a docstring, which name a page without its folder, or a law or section without its page."""
    own = {_anchor(record): record for record in records()}

    def whole(found: re.Match) -> str:
        place = MOVED.get(found["place"] or "", found["place"] or "")
        if not found["stem"] and place in own:
            return f"]({place_of_law(own[place]).name})"
        stems = [found["stem"]] if found["stem"] else ["combining-laws", "symbols", "models"]
        goal = next((page for stem in stems if (page := page_with(stem, place))), None)
        if goal is None:
            raise ValueError(f"a docstring links to {found[0]}, which is nowhere")
        return f"](../../{goal.relative_to('docs')}{'#' * bool(place)}{place})"

    return _SHORT.sub(whole, text)


def _anchor(record: Record) -> str:
    """Return what docstrings call a law: its key, with its kind where two kinds share the key."""
    return f"{record.key}-{record.kind}-law" if place_of_law(record).stem != record.key else record.key


def _with_sources(text: str) -> str:
    """Names of sources, in brackets or of the record, lead to the bibliography."""
    known = bibliography()

    def led(found: re.Match) -> str:
        link = f"[{found[1]}](../bibliography.md#{found[1]})"
        return found[0].replace(f"[{found[1]}]", found[1]).replace(found[1], link) if found[1] in known else found[0]

    return _SOURCE.sub(led, _NAMED.sub(led, text))


def index() -> str:
    """Return the list of all laws by kind, each by author and year."""
    lines = [
        "# Laws and models",
        "",
        "The page of a law contains its equations, a picture, its range of validity, its checks, and BibTeX entries.",
        "",
    ]
    for kind in kinds():
        mine = sorted((one for one in records() if type(one) is kind), key=lambda one: (name_of(one).lower(), one.key))
        title = TITLES.get(kind.kind, f"{kind.kind.capitalize()} laws")
        lines += [f"## {title}", "", "| law | key | meaning | grade |", "|---|---|---|---|"]
        lines += [f"| [{name_of(one)}]({place_of_law(one).name}) | `{one.key}` | {one.title} | {one.grade} |" for one in mine]
        lines += ["", ":::{toctree}", ":hidden:", "", *(place_of_law(one).stem for one in mine), ":::", ""]
    return "\n".join(lines)


def sources() -> str:
    """Everything that is cited."""
    lines = [
        "# Bibliography",
        "",
        "`stiction cite` prints the whole bibliography. `stiction cite KEY` prints the entries of one model.",
        "",
    ]
    for key, entry in bibliography().items():
        lines += [f"## {key}", "", f"```bibtex\n{entry}\n```", ""]
    return "\n".join(lines)
