"""What the site is laid out from: links, pages that are made, tutorials, the gallery; and the search for dead links."""

import json
import re
import sys
from pathlib import Path, PurePosixPath

import matplotlib
import numpy as np
import pytest
from matplotlib.collections import PolyCollection
from pages import ROOT

import stiction as st
from stiction.case.case_tables import json_schema
from stiction.records.registry import kinds, of_kind, records

matplotlib.use("Agg")
sys.path[:0] = [str(ROOT / "docs" / "site"), str(ROOT / "docs")]

import case_pages  # noqa: E402 - in docs/site
import command_pages  # noqa: E402
import draw_guides  # noqa: E402
import gallery  # noqa: E402
import model_pages  # noqa: E402
import name_pages  # noqa: E402
import notebooks  # noqa: E402
from dead_links import dead_links  # noqa: E402
from docstrings import as_markdown, said_of  # noqa: E402
from links import place_of, relinked  # noqa: E402
from matplotlib.image import imread  # noqa: E402
from model_pictures import picture  # noqa: E402

PAGE = PurePosixPath("docs/explanation/theory.md")
HERTZ = "src/stiction/laws/asperity/hertz.py"


def test_pages_of_docs_keep_their_folder_and_laws_have_their_page():
    assert place_of(PAGE) == PurePosixPath("explanation/theory.md")
    assert place_of(PurePosixPath(HERTZ)) == PurePosixPath("reference/laws/hertz.md")
    assert place_of(PurePosixPath("reference/hertz.csv")) == PurePosixPath("project/reference/hertz.csv")


@pytest.mark.parametrize(
    ("written", "there", "leads"),
    [
        ("[a](trust.md#in-numbers)", "[a](trust.md#in-numbers)", ["docs/explanation/trust.md"]),
        ("[a](../../CONTRIBUTING.md)", "[a](../project/CONTRIBUTING.md)", ["CONTRIBUTING.md"]),
        ("[`a`](../../reference/hertz.csv)", "[`a`](../project/reference/hertz.csv)", ["reference/hertz.csv"]),
        (f"[`hertz`](../../{HERTZ})", "[`hertz`](../reference/laws/hertz.md)", [HERTZ]),
        ("![a](film_errors.svg)", "![a](film_errors.svg)", ["docs/explanation/film_errors.svg"]),
        ("[a](../../README.md)", "[a](../index.md)", ["README.md"]),
        ("[a](../../validation/)", "a", []),
        ("[a](#1-units)", "[a](#1-units)", []),
        ("[a](https://example.org/x)", "[a](https://example.org/x)", []),
        ("`x[1](2)`", "`x[1](2)`", []),
        ("```python\nf[a](trust.md)\n```", "```python\nf[a](trust.md)\n```", []),
    ],
)
def test_links_of_a_page_become_those_of_the_site(written, there, leads):
    text, linked = relinked(written, PAGE)
    assert text == there
    assert linked == [PurePosixPath(one) for one in leads]


def test_every_page_is_in_a_table_of_contents():
    """Of its folder, or of any other; the sidebar of the site is made of these tables."""
    listed = set()
    for index in (ROOT / "docs").rglob("*.md"):
        for table in re.findall(r"```{toctree}\n(.*?)```", index.read_text(encoding="utf-8"), flags=re.DOTALL):
            names = [re.sub(r"^.* <(.+)>$", r"\1", line) for line in table.splitlines() if line and not line.startswith(":")]
            listed |= {(index.parent / f"{name}.md").resolve() for name in names}
    pages = {path for path in (ROOT / "docs").rglob("*.md") if path != ROOT / "docs" / "index.md"}
    assert pages <= listed, pages - listed


def test_every_public_name_has_its_page():
    listed = [name for names in name_pages.GROUPS.values() for name in names]
    assert sorted(listed) == sorted(set(st.__all__) - {"__version__"})
    assert len({name_pages.page_name(name).lower() for name in listed}) == len(listed)


def test_page_of_a_name_says_what_its_docstring_says():
    page = "\n".join(name_pages.page("read_scan", st.read_scan))
    assert "stiction.read_scan(path, *, size=None, unit=None" in page
    assert "- `path`: File of the scan (str or Path)." in page
    assert "NaN where missing" in page


def test_arguments_in_a_docstring_become_a_list():
    text = "What it is.\n\npath: of the\nfile. unit, scale: of it.\nother: not listed.\n\nAs in (docs/explanation/theory.md)."
    assert as_markdown(text, {"path", "unit", "scale"}, "../") == (
        "What it is.\n\n- `path`: of the file.\n- `unit`, `scale`: of it. other: not listed."
        "\n\nAs in ([theory](../explanation/theory.md))."
    )


def test_every_part_of_the_schema_has_its_section():
    schema = json_schema()
    assert set(case_pages.TABLES) == set(schema["$defs"])
    page = "\n".join(case_pages.page(schema))
    for part in schema["$defs"].values():
        for key in part.get("properties", ()):
            assert f"| `{key}` |" in page, key
    silent = [line for line in page.splitlines() if line.startswith("| `") and line.endswith("|  |")]
    assert not silent, "a key that no word is said of"


def test_what_is_said_of_one_argument():
    text = "What it is.\n\npath: of the\nfile. unit, scale: of it; other: x."
    names = {"path", "unit", "scale", "other"}
    assert [said_of(text, name, names) for name in ("path", "scale", "other")] == ["of the file", "of it", "x"]
    assert said_of(text, "none", names) == ""


def test_every_option_of_every_command_is_on_the_page(tmp_path):
    command_pages.write(tmp_path)
    page = (tmp_path / "reference" / "command-line.md").read_text(encoding="utf-8")
    for name, command in command_pages.commands().items():
        section = page.partition(f"## `stiction {name}`\n")[2].partition("\n## ")[0]
        assert section, name
        for one in command.params:
            assert one.hidden or all(f"`{opt}`" in section for opt in one.opts if opt.startswith("-")), (name, one.name)
    assert "[CASE.toml]" in page and "[[" not in page


@pytest.mark.parametrize(
    ("row", "record"), list(zip(st.models(), records(), strict=True)), ids=lambda one: getattr(one, "key", "row")
)
def test_page_of_a_model(row, record):
    """Its equations, its record, and the BibTeX of all its sources."""
    page = model_pages.page(row, record)
    assert page.startswith(f"# {model_pages.name_of(record)}\n\n`{record.key}`, {record.kind}: ")
    assert f"- Grade {record.grade}: " in page
    assert page.count("```{image}") == 1
    for source in record.sources:
        assert re.search(rf"^@\w+\{{{source.key},$", page, flags=re.MULTILINE), source.key


def test_rough_surface_says_what_was_measured_of_it_and_leads_to_its_sources(tmp_path):
    """The numbers are those of the table of docs/explanation/truth.md."""
    key = "greenwood_williamson_1966"
    row, record = next((row, one) for row, one in zip(st.models(), records(), strict=True) if one.key == key)
    page = model_pages.page(row, record)
    table = (ROOT / "docs" / "explanation" / "truth.md").read_text(encoding="utf-8")
    *means, rms = re.search(rf"^\| `{key}` \| (.*) \|$", table, flags=re.MULTILINE)[1].split(" | ")
    assert all(f"{mean} % at" in page for mean in means) and f"rms {rms} %" in page
    assert f"- Source: [{key}](../bibliography.md#{key})" in model_pages._with_sources(page)


def test_short_links_of_a_docstring_are_completed():
    """A page without its folder, a law or a section without its page."""
    text = "[a](theory.md#5-coated-surface) [b](#hertz) [c](#1-units) [d](#chang_etsion_bogy_1988-tangential-law)"
    assert model_pages._with_whole_links(text) == (
        "[a](../../explanation/theory-films.md#5-coated-surface) [b](hertz.md) [c](../../reference/symbols.md#units) "
        "[d](chang_etsion_bogy_1988-tangential.md)"
    )
    with pytest.raises(ValueError, match="nowhere"):
        model_pages._with_whole_links("[a](#no-such-law)")


def test_laws_are_titled_by_author_and_year():
    named = {record.key: model_pages.name_of(record) for record in records()}
    assert named["kogut_etsion_2002"] == "Kogut & Etsion 2002"
    assert named["jkr"] == "Johnson, Kendall & Roberts 1971 (JKR)"
    assert named["xu_zhu_xiao_zhou_2024"] == "Xu et al. 2024"


def test_every_model_has_a_page_of_its_own():
    files = [str(model_pages.place_of_law(record)) for record in records()]
    assert len({name.lower() for name in files}) == len(files)


def test_list_of_models_leads_to_each_under_its_kind():
    parts = dict(zip(kinds(), model_pages.index().split("\n## ")[1:], strict=True))
    for kind, part in parts.items():
        for key in of_kind(kind):
            assert f"| `{key}` |" in part, (kind.kind, key)


@pytest.mark.parametrize("kind", kinds(), ids=lambda kind: kind.kind)
def test_picture_of_a_model_of_each_kind(kind, tmp_path):
    key = next(iter(sorted(of_kind(kind).keys() - {"boundary_elements"})))
    picture(of_kind(kind)[key]).savefig(tmp_path / "x.png")
    assert drawn(tmp_path / "x.png")


def drawn(path: Path) -> bool:
    """Whether a picture shows more than an empty sheet."""
    colours = (imread(path)[..., :3] * 255).astype(int) @ [65536, 256, 1]
    return np.unique(colours).size > 20


def test_gallery_has_twelve_pictures():
    assert len(gallery.scripts()) == 12
    for script in gallery.scripts():
        title, text = gallery.told(script)
        assert title and text, script.name


@pytest.mark.parametrize("script", gallery.scripts(), ids=gallery.name_of)
def test_gallery_script_draws_its_picture(script, tmp_path):
    gallery.run(script, tmp_path / "x.png")
    assert drawn(tmp_path / "x.png")


def test_the_picture_of_the_landing_page_shows_the_contact_that_is_predicted_beside_it():
    """The thick line and its band, at 10 N, are mu and its interval as the README and the landing page print them."""
    readme, landing = ((ROOT / name).read_text(encoding="utf-8") for name in ("README.md", "docs/index.md"))
    axes = draw_guides.answer().axes[0]
    line = axes.lines[0]
    assert line.get_linewidth() >= 4
    (band,) = (one for one in axes.collections if isinstance(one, PolyCollection))
    edge = band.get_paths()[0].vertices
    at = edge[np.isclose(edge[:, 0], 10.0), 1]
    drawn = np.interp(10.0, line.get_xdata(), line.get_ydata()), at.min(), at.max()
    for page in (readme, landing):
        printed = re.search(r"mu = ([\d.]+),? +90% interval ([\d.]+) to ([\d.]+), at 10 N", page)
        assert drawn == pytest.approx([float(number) for number in printed.groups()], rel=0.05)
        assert "pictures/answer.svg" in page and "silver" not in page.lower().partition("answer.svg")[0]


TUTORIAL = """# One

Words.

```toml
# file: two.toml
two = 2
```

```python
import tomllib
from pathlib import Path
import matplotlib.pyplot as plt

print(tomllib.loads(Path("two.toml").read_text())["two"] + 3)
plt.plot([1, 2]);
```

```text
an old output
```

More.

```python
6 * 7
```
"""


def test_tutorial_is_executed():
    page, notebook, pictures = notebooks.executed(TUTORIAL, "one")
    assert "an old output" not in page
    assert "\n5\n```" in page and "\n42\n```" in page
    assert "{download}`Download this page as a notebook <one.ipynb>`" in page
    ((name, content),) = pictures.items()
    assert f"{{image}} {name}" in page and content.startswith(b"\x89PNG")
    kinds = [cell["cell_type"] for cell in notebook["cells"]]
    assert kinds == ["markdown", "code", "code", "markdown", "code"]
    assert notebook["cells"][1]["source"][0] == "%%writefile two.toml\n"
    stream, shown = notebook["cells"][2]["outputs"]
    assert stream["text"] == ["5\n"] and "image/png" in shown["data"]
    json.dumps(notebook)


def test_tutorial_does_not_show_where_a_picture_is_in_memory():
    drawn_last = (
        "# One\n\n```python\nimport matplotlib.pyplot as plt\n\nplt.plot([1, 2])\n```\n\n```python\nplt.plot([2, 1])\n```\n"
    )
    page, _, pictures = notebooks.executed(drawn_last, "one")
    assert " at 0x" not in page
    assert len(pictures) == 2


def test_dead_links_are_found(tmp_path):
    (tmp_path / "a.html").write_text(
        '<h1 id="x">A</h1><a href="b.html#y"></a><a href="#x"></a><img src="no.png">', encoding="utf-8"
    )
    (tmp_path / "b.html").write_text(
        '<a href="a.html#x"></a><a href="a.html#z"></a><a href="https://example.org">', encoding="utf-8"
    )
    assert list(dead_links(tmp_path)) == [
        "a.html: b.html#y: no such place in the page",
        "a.html: no.png: no such file",
        "b.html: a.html#z: no such place in the page",
    ]


def test_what_a_page_loads_from_a_network_is_found(tmp_path):
    (tmp_path / "a.html").write_text(
        '<script src="https://example.org/x.js"></script><link rel="stylesheet" href="//example.org/x.css">'
        '<a href="https://example.org">elsewhere</a><img src="data:image/png;base64,AA==">',
        encoding="utf-8",
    )
    (tmp_path / "a.css").write_text(
        "@import 'https://example.org/y.css'; a { src: url(data:image/png;base64,AA==) }\nb { src: url(\"//example.org/z\") }",
        encoding="utf-8",
    )
    assert list(dead_links(tmp_path)) == [
        "a.html: https://example.org/x.js: needs a network",
        "a.html: //example.org/x.css: needs a network",
        "a.css: https://example.org/y.css: needs a network",
        "a.css: //example.org/z: needs a network",
    ]
