r"""Convert LaTeX formulas to plain text for the terminal and plain pages: \frac{\tau_0}H becomes τ_0/H."""

import re
import unicodedata
from collections.abc import Iterator
from dataclasses import dataclass, field

_GREEK = re.compile(
    "(alpha|beta|gamma|delta|epsilon|zeta|eta|theta|iota|kappa|lambda|mu|nu|xi|pi|rho|sigma|tau|upsilon|phi|chi|psi|omega)",
    re.IGNORECASE,
)
_SIGNS = {
    "varphi": "φ", "varepsilon": "ε", "varrho": "ϱ", "varsigma": "ς", "ell": "ℓ", "partial": "∂", "infty": "∞", "int": "∫",
    "sum": "∑", "prod": "∏", "cdot": "·", "times": "×", "ldots": "...", "dots": "...", "langle": "⟨", "rangle": "⟩",
    "{": "{", "}": "}", "|": "|", "quad": "  ", "qquad": "   ", ",": " ", ";": " ", " ": " ", "!": "", ":": "", "%": "%",
}  # fmt: skip
_RELATIONS = {
    "to": "→", "ge": "≥", "geq": "≥", "le": "≤", "leq": "≤", "ll": "≪", "gg": "≫", "approx": "≈", "propto": "∝", "sim": "~",
    "ne": "≠", "in": "∈",
}  # fmt: skip
_FUNCTION = re.compile("(arc)?(sin|cos|tan)|(cos|cot|sin|tan)h|ln|log|exp|min|max")
_ACCENTS = {"bar": "\u0304", "overline": "\u0304", "hat": "\u0302", "dot": "\u0307", "tilde": "\u0303"}
_RAISED = str.maketrans("0123456789+-n", "⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻ⁿ")
_TEXT = r"\\(?:mathrm|text|operatorname|mathcal|mathbf)\{[^}]*\}"
_BRACKET = r"\\(?:left|right|bigl|bigr)(?![A-Za-z])\s*(?:\\[A-Za-z]+|\\.|.)"
_TOKEN = re.compile(rf"{_TEXT}|\\begin.*?\\end\{{\w+\}}|{_BRACKET}|\\[A-Za-z]+|\\.|\d*\.?\d+|\n|\S", re.DOTALL)
_GROUP = r"\{(?:[^{}]|\{(?:[^{}]|\{(?:[^{}]|\{[^{}]*\})*\})*\})*\}"
# An argument of a LaTeX command without braces.
_ONE = rf"(\\(?:mathrm|mathcal|text|sqrt){_GROUP}|\\[td]?frac{_GROUP}{_GROUP}|\\[A-Za-z]+|[^\s{{}}\\[])"
_NAME = re.compile(r"[\d.]+|[^\W\d_][^\W_]*'*")
_OPEN = "([{⟨"


@dataclass
class _Piece:
    """Store a part of a formula as text, with the properties that decide the spaces around it.

    word: a space separates it from a neighbouring value. relation: there is a space on both sides. fraction: it is a fraction
    or a power, and a space separates it from a bracket that follows. function: it is the name of a function.
    """

    text: str
    word: bool = False
    relation: bool = False
    fraction: bool = False  # or a power: a bracket after it needs a space
    function: bool = False


@dataclass
class _Reader:
    """Convert the tokens of a LaTeX formula to pieces of text, from left to right.

    tokens: the tokens not read yet. pieces: the pieces of the group of braces that is being read.
    """

    tokens: Iterator[str]
    pieces: list[_Piece] = field(default_factory=list)

    def pieces_until(self, end: str) -> list[_Piece]:
        """Read and return the pieces before a closing token, and skip that token; "" reads to the end of the formula."""
        before, self.pieces = self.pieces, []
        for token in self.tokens:
            if token == end:
                break
            if token in ("^", "_"):
                self._script(token)
            else:
                self.pieces.append(self._piece(token))
        inner, self.pieces = self.pieces, before
        return inner

    def _piece(self, token: str) -> _Piece:
        if token == "{":
            return _Piece(_joined(self.pieces_until("}")), word=True)
        if token[0] != "\\":
            return _Piece(token, relation=token in "=<>" or (token in "+-" and self._after_a_value()))
        if token.startswith("\\begin"):
            return _Piece(_rows(token))
        name = token[1:]
        if text := re.fullmatch(r"([a-z]+)\{(.*)\}", name):
            return _Piece(text[2], word=True, function=text[1] == "operatorname")
        if name in ("frac", "tfrac", "dfrac"):
            above, below = self._argument(), self._argument()
            return _Piece(f"{_grouped(above, product=True)}/{_grouped(below)}", word=True, fraction=True)
        if name == "sqrt":
            return _Piece(f"√{_grouped(self._argument())}", word=bool(self.pieces) and self.pieces[-1].function)
        if sign := re.fullmatch(r"(?:left|right|bigl|bigr)(?![A-Za-z])\s*(\\?)(.+)", name):
            return _Piece(_SIGNS.get(sign[2], sign[2]) if sign[1] else sign[2].removeprefix("."))
        if name in _ACCENTS:
            inner = _joined(self._argument())
            return _Piece(unicodedata.normalize("NFC", inner[:1] + _ACCENTS[name]) + inner[1:])
        return self._sign(name)

    def _sign(self, name: str) -> _Piece:
        if name in _RELATIONS:
            return _Piece(_RELATIONS[name], relation=True)
        if name == "pm":
            return _Piece("±", relation=self._after_a_value())
        if _GREEK.fullmatch(name):
            case = "CAPITAL" if name[0].isupper() else "SMALL"
            return _Piece(unicodedata.lookup(f"GREEK {case} LETTER {name.upper().replace('LAMBDA', 'LAMDA')}"))
        return _Piece(
            _SIGNS.get(name, name), word=name not in _SIGNS or name in ("sum", "int"), function=bool(_FUNCTION.fullmatch(name))
        )

    def _after_a_value(self) -> bool:
        last = next((piece for piece in reversed(self.pieces) if piece.text.strip()), None)
        return last is not None and not last.relation and last.text[-1] not in _OPEN + ",;"

    def _script(self, sign: str) -> None:
        inner = _joined(self._argument())
        base = self.pieces[-1] if self.pieces else _Piece("")
        if sign == "^" and inner[:1] == "*":
            raised = "*" + inner[1:].translate(_RAISED)
        elif sign == "^" and not inner.translate({ord(character): "" for character in "0123456789+-n"}):
            raised = inner.translate(_RAISED)
        else:
            raised = f"{sign}{inner}" if len(inner) == 1 or _NAME.fullmatch(inner) else f"{sign}({inner})"
        text = base.text + raised
        self.pieces[-1:] = [_Piece(text, word=base.word or sign == "_" or raised[0] == "^", fraction=raised[0] == "^")]

    def _argument(self) -> list[_Piece]:
        next(self.tokens)  # skips the opening brace
        return self.pieces_until("}")


def _rows(environment: str) -> str:
    """Return the rows of a LaTeX environment as text, one line each; "cases" become one line."""
    rows = [row.strip() for row in re.sub(r"\\(?:begin|end)\{\w+\}", "", environment).split("\\\\") if row.strip()]
    text = [" if ".join(formula(cell) for cell in row.split("&")).strip(" ,;") for row in rows]
    return "{ " + "; ".join(text) + " }" if "{cases}" in environment else "\n" + "\n".join(text) + "\n"


def _joined(pieces: list[_Piece]) -> str:
    text, before = "", _Piece("")
    for piece in pieces:
        if piece.relation:
            text += f" {piece.text} "
        elif before.function and piece.fraction:
            text += f"({piece.text})"
        else:
            text += f" {piece.text}" if _apart(before, piece) else piece.text
        before = piece
    return re.sub(r"(?<=\S) {2}(?=\S)", " ", text).strip(" ")


def _apart(before: _Piece, piece: _Piece) -> bool:
    """Return whether a space is needed between two pieces, so that they are not read as one value."""
    if before.fraction:
        return piece.text[:1].isalnum() or piece.text[:1] in (*_OPEN, "√")
    if not before.text or not (before.text[-1].isalnum() or before.text[-1] in ")]*'∞\u0304"):
        return False
    return (before.word or piece.word) and (piece.text[:1].isalnum() or (piece.word and piece.text[:1] in ("(", "√", "∑")))


def _grouped(pieces: list[_Piece], product: bool = False) -> str:
    """Return an argument of a LaTeX command as text, in brackets if it is more than one value.

    product: whether a product stays without brackets.
    """
    text = _joined(pieces)
    single = " " not in text and "/" not in text and sum(bool(piece.text.strip()) for piece in pieces) == 1
    several = any(piece.relation or "/" in piece.text or piece.text[:1] in ("∑", "∫") for piece in pieces)
    return text if single or (product and not several) else f"({text})"


def braced(tex: str) -> str:
    """Return a LaTeX formula with braces around the arguments of accents, roots, fractions, subscripts and superscripts."""
    tex = re.sub(rf"(\\(?:mathrm|mathcal|sqrt|bar|overline|hat|dot|tilde))\s*{_ONE}", r"\1{\2}", tex)
    before = ""
    while before != tex:  # a fraction may stand inside another
        before, tex = tex, re.sub(rf"(\\[td]?frac(?:{_GROUP})?)\s*{_ONE}", r"\1{\2}", tex)
    return re.sub(rf"([\^_])\s*{_ONE}", r"\1{\2}", tex)


def formula(tex: str) -> str:
    """Convert one LaTeX formula to plain text; a displayed formula keeps its line breaks."""
    tokens = iter(_TOKEN.findall(braced(re.sub(r"\s*\n\s*", "\n", tex.strip()))))
    lines = _joined(_Reader(tokens).pieces_until("")).split("\n")
    return "\n".join(re.sub(r" {4,}", "   ", line).strip() for line in lines if line.strip())


def _replaced(text: str, inline: str, display: str, indent: str = "") -> str:
    def displayed(match: re.Match[str]) -> str:
        return display.format("\n".join(indent + line for line in formula(match[1]).split("\n")))

    text = re.sub(r"\$\$(.+?)\$\$", displayed, text, flags=re.DOTALL)
    return re.sub(r"\$(.+?)\$", lambda match: inline.format(formula(match[1])), text, flags=re.DOTALL)


def as_code(text: str) -> str:
    """Convert Markdown with LaTeX formulas to Markdown in which the formulas are code.

    Links to other pages become text, and underscores outside code are escaped.
    """
    marked = _replaced(_without_links(text), "`{}`", "```text\n{}\n```")
    parts = re.split(r"(```.*?```|`[^`]*`)", marked, flags=re.DOTALL)  # code is at odd indices
    return "".join(part if number % 2 else part.replace("_", r"\_") for number, part in enumerate(parts))


def as_text(text: str) -> str:
    """Convert Markdown with LaTeX formulas to plain text, without the marks of emphasis, code and links."""
    plain = _replaced(_without_links(text), "{}", "{}", "    ").replace("`", "")
    return re.sub(r"(?<!\w)\*([A-Z][^*\n]*)\*(?!\w)", r"\1", plain)


def _without_links(text: str) -> str:
    return re.sub(r"\[([^\]]+)\]\((?!https?:)[^)]*\)", r"\1", text)
