"""A figure as part of a page of HTML: drawn by the page itself, in its colours; or, where that is too much, as an image."""

import base64
import html
import io
import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_MOST = 300_000  # characters of a drawing, above which it is an image
_DOTS_PER_INCH = 160
# What a page has no use for; the style would hold for the whole of it.
_LEFT_OUT = re.compile(r"<\?xml.*?\?>|<!DOCTYPE.*?>|<!--.*?-->|<metadata>.*?</metadata>|<style.*?</style>", re.DOTALL)
_OWN_ID = re.compile(r' id="([^"]*)"')
_REFERENCE = re.compile(r'(?:xlink:href="|url\()#([^")]*)')
_COLOURS = {"#000000": "currentColor", "#ffffff": "var(--paper)"}


def inline(figure: "Figure", name: str, words: str) -> str:
    """HTML of a figure, the same for the same figure. name: letters, unique on the page; words: what it shows, for those who do
    not see it. Black and white become the colours of the page."""
    drawn = io.StringIO()
    figure.savefig(drawn, format="svg", transparent=True)
    text = drawn.getvalue()
    return _image(figure, words) if len(text) > _MOST else _drawing(text, name, words)


def _drawing(text: str, name: str, words: str) -> str:
    text = _LEFT_OUT.sub("", text)
    used = dict.fromkeys(_REFERENCE.findall(text))
    short = {old: f"{name}-{at}" for at, old in enumerate(used)}
    text = _OWN_ID.sub(lambda found: f' id="{short[found[1]]}"' if found[1] in short else "", text)
    text = re.sub(r'xlink:href="#([^"]*)"', lambda found: f'href="#{short[found[1]]}"', text)
    text = re.sub(r"url\(#([^)]*)\)", lambda found: f"url(#{short[found[1]]})", text)
    for colour, of_page in _COLOURS.items():
        text = text.replace(colour, of_page)
    size = re.search(r'viewBox="([^"]*)"', text)
    assert size is not None  # matplotlib writes one
    head = f'<svg role="img" aria-label="{html.escape(words)}" viewBox="{size[1]}">'
    return re.sub(r"\s*\n\s*", "\n", re.sub(r"<svg.*?>", lambda _: head, text, count=1, flags=re.DOTALL)).strip()


def _image(figure: "Figure", words: str) -> str:
    drawn = io.BytesIO()
    figure.savefig(drawn, format="png", dpi=_DOTS_PER_INCH, metadata={"Software": None})
    data = base64.b64encode(drawn.getvalue()).decode("ascii")
    return f'<img alt="{html.escape(words)}" src="data:image/png;base64,{data}">'
