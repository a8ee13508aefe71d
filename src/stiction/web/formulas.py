"""Typeset the formulas of the models with matplotlib; a formula with a symbol that matplotlib lacks becomes code."""

import base64
import io
import re
from functools import cache

from stiction.report.plain_formulas import as_code, braced, formula

_INLINE, _DISPLAY = 1.2, 1.7  # factors by which matplotlib's pictures are enlarged
# LaTeX commands that matplotlib lacks -> commands to use instead.
_RENAMED = {"tfrac": r"\frac", "le": r"\leq", "ge": r"\geq", "bigl": "", "bigr": ""}


def typeset(text: str) -> str:
    """Return Markdown in which the LaTeX formulas of a Markdown text are images.

    A displayed formula becomes one image per line. A formula that matplotlib cannot draw becomes code. Links become text.
    """
    drawn: list[str] = []

    def display(found: re.Match[str]) -> str:
        lines = [_picture(line, _DISPLAY) for line in re.split(r"\\\\\s|\n", found[1].strip())]
        if not all(lines) or "\\begin" in found[1]:
            return found[0]
        drawn.append("\n\n" + "<br>".join(lines) + "\n\n")
        return f"@{len(drawn) - 1}@"

    def inline(found: re.Match[str]) -> str:
        if not (picture := _picture(found[1])):
            return found[0]
        drawn.append(picture)
        return f"@{len(drawn) - 1}@"

    text = re.sub(r"\$\$(.+?)\$\$", display, text, flags=re.DOTALL)
    text = re.sub(r"\$([^$]+?)\$", inline, text)
    return re.sub(r"@(\d+)@", lambda found: drawn[int(found[1])], as_code(text))


@cache
def _picture(tex: str, scale: float = _INLINE) -> str:
    """Return the HTML image of a LaTeX formula; "" if matplotlib lacks one of its symbols.

    scale: factor by which a font size of 10 points is enlarged.
    """
    import matplotlib
    from matplotlib.font_manager import FontProperties
    from matplotlib.mathtext import MathTextParser, math_to_image

    typed = f"${_plain(tex.strip())}$"
    try:
        font, made = FontProperties(math_fontfamily="stix", size=10.0), io.BytesIO()
        depth = MathTextParser("path").parse(typed, dpi=72, prop=font)[2] * scale
        with matplotlib.rc_context({"savefig.transparent": True}):
            math_to_image(typed, made, font, dpi=72, format="svg")
    except (ValueError, IndexError):
        return ""
    size = re.search(r'height="([\d.]+)pt"', made.getvalue().decode())
    if size is None:
        return ""
    height, source = float(size[1]) * scale, base64.b64encode(made.getvalue()).decode()
    words = formula(tex).replace("\n", " ").replace('"', "").replace("<", "&lt;")
    return (f'<img class="formula" alt="{words}" src="data:image/svg+xml;base64,{source}" '
            f'style="height: {height:.1f}pt; vertical-align: -{depth:.1f}pt">')  # fmt: skip


def _plain(tex: str) -> str:
    """Rewrite a LaTeX formula with commands that matplotlib supports, and with every argument in braces."""
    tex = re.sub(r"\\([A-Za-z]+)", lambda command: _RENAMED.get(command[1], command[0]), tex)
    tex = re.sub(r"\\text\{[^}]*\}", lambda words: words[0].replace("text", "mathrm").replace(" ", r"\ "), tex)
    return braced(tex)
