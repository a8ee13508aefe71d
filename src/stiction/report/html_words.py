"""Format symbols as HTML: Greek letters, subscripts and superscripts."""

import re
from dataclasses import replace

from markupsafe import Markup, escape

from stiction.report.table import Table, with_signs

_GREEK = {"alpha": "α", "beta": "β", "gamma": "γ", "epsilon": "ε", "eta": "η", "theta": "θ", "lambda": "λ", "lam": "λ",
          "mu": "μ", "nu": "ν", "omega": "ω", "pi": "π", "psi": "ψ", "sigma": "σ", "tau": "τ", "Delta": "Δ"}  # fmt: skip
_WORD = re.compile(rf"(?<![A-Za-z])({'|'.join(sorted(_GREEK, key=len, reverse=True))})(?![A-Za-z])")
_BEFORE_UNIT = re.compile(r"(?<=\d) (?=(?:[pnuµmkMGT]?(?:m[²³]?|N|Pa|J|s)|1/[nuµmk]?(?:m[²³]?|Pa)|K|deg|ohm)(?!\w))")


def letters(text: str) -> str:
    """Replace spelled-out Greek letters and units by their signs: "sigma = 2 um" becomes "σ = 2 µm"."""
    shown = _WORD.sub(lambda match: _GREEK[match[1]], text).replace("τ_0", "τ₀")
    return with_signs(shown.replace("sqrt(", "√(").replace("+-", "±"))


def unbroken(text: str) -> str:
    """Replace the space between a number and its unit by a space at which no line breaks."""
    return _BEFORE_UNIT.sub("\N{NO-BREAK SPACE}", text)


def on_page(table: Table, caption: str) -> Table:
    """Convert a terminal table for the web page: plain texts as cells, Greek letters in the heads, and a new caption."""
    columns = [replace(column, head=letters(column.head.replace("\n", " "))) for column in table.columns]
    return replace(table, columns=columns, rows=[[str(cell) for cell in row] for row in table.rows], caption=caption)


def breakable(text: str) -> Markup:
    """Return the key of a model as escaped HTML in which lines may break after underscores."""
    return Markup(str(escape(text)).replace("_", "_<wbr>"))  # safe, because the text was escaped first


def formula(text: str) -> Markup:
    """Return a text with symbols and formulas, such as "sigma_s^2", as escaped HTML with subscripts and superscripts."""
    shown = str(escape(letters(text))).replace("&lt;=", "≤").replace("&gt;=", "≥")
    shown = re.sub(r"(?<=[\w)])_(\w+)", r"<sub>\1</sub>", shown)
    shown = re.sub(r"\^\(([^()]*)\)|\^(-?\w+)", lambda match: f"<sup>{match[1] or match[2]}</sup>", shown)
    return Markup(shown)  # safe, because the text was escaped first
