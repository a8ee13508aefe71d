"""Typeset the formulas of the models with matplotlib; a formula with an unknown symbol stays text."""

import base64
import io
import re
from functools import cache

from stiction.report.plain_formulas import as_code, formula

_INLINE, _DISPLAY = 1.2, 1.7  # of the size in which matplotlib draws
_RENAMED = {"tfrac": "frac", "dfrac": "frac", "text": "mathrm", "bigl": "", "bigr": "", "Bigl": "", "Bigr": "", "le": "leq",
            "ge": "geq", "to": "rightarrow", "lvert": "vert", "rvert": "vert", "operatorname": "mathrm"}  # fmt: skip
_ARGUMENTS = {"frac": 2, "sqrt": 1, "bar": 1, "hat": 1, "mathrm": 1, "mathcal": 1}
_TOKEN = re.compile(r"\\[A-Za-z]+|\\.|.", re.DOTALL)


def typeset(text: str) -> str:
    """Return Markdown with its formulas as images; displayed formulas are set line by line."""
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
    """Return the image of a formula; "" if it contains an unknown symbol."""
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
    """Rewrite a formula with commands that matplotlib supports, every argument in braces."""
    tokens = [_RENAMED.get(one[1:]) if one[0] == "\\" and one[1:] in _RENAMED else one for one in _TOKEN.findall(tex)]
    tokens = [f"\\{one}" if one in _RENAMED.values() and one else one or "" for one in tokens]
    return "".join(_braced(list(filter(None, tokens))))


def _braced(tokens: list[str]) -> list[str]:
    made: list[str] = []
    while tokens:
        token = tokens.pop(0)
        made.append(token)
        for _ in range(_ARGUMENTS.get(token[1:], 0) if token[0] == "\\" else 1 if token in "^_" else 0):
            words = _braced(_argument(tokens))
            made += ["{", *("\\ " if one == " " and token == "\\mathrm" else one for one in words), "}"]
    return made


def _argument(tokens: list[str]) -> list[str]:
    """Remove the next argument from the tokens and return it without its braces."""
    while tokens and tokens[0].isspace():
        tokens.pop(0)
    if not tokens:
        return []
    if tokens[0] == "[":  # the degree of a root is not used by any law
        return []
    if tokens[0] != "{":
        first = tokens.pop(0)
        count = _ARGUMENTS.get(first[1:], 0) if first[0] == "\\" else 0
        taken = [first]
        for _ in range(count):
            taken += ["{", *_argument(tokens), "}"]
        return taken
    depth, taken = 0, []
    while tokens:
        token = tokens.pop(0)
        depth += (token == "{") - (token == "}")
        taken.append(token)
        if not depth:
            break
    return taken[1:-1]
