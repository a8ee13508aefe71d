"""Small edits that make a module wrong: found by its syntax, so that texts, annotations and messages are left alone."""

import ast
import itertools
from collections.abc import Iterator
from typing import NamedTuple

# What stands there, and what is put in its place.
_OPERATORS: dict[type[ast.AST], tuple[str, ...]] = {
    ast.Add: ("operator", "+", "-"),
    ast.Sub: ("operator", "-", "+"),
    ast.Mult: ("operator", "*", "/"),
    ast.Div: ("operator", "/", "*"),
    ast.Lt: ("comparison", "<", "<=", ">="),
    ast.LtE: ("comparison", "<=", "<", ">"),
    ast.Gt: ("comparison", ">", ">=", "<="),
    ast.GtE: ("comparison", ">=", ">", "<"),
    ast.Eq: ("comparison", "==", "!="),
    ast.NotEq: ("comparison", "!=", "=="),
    ast.And: ("condition", "and", "or"),
    ast.Or: ("condition", "or", "and"),
}
_OTHER_ENDS = {"min": "max", "max": "min", "minimum": "maximum", "maximum": "minimum", "sin": "cos", "cos": "sin"}
_OTHER_ENDS |= {"argmin": "argmax", "argmax": "argmin", "any": "all", "all": "any", "floor": "ceil", "ceil": "floor"}
# What is said and not computed: words of records, errors and notices.
_SAID = {"InputError", "Source", "Validity", "Departure", "notice", "warn", "Quantity", "TypeVar"}
_NOT_COMPUTED = {"annotation", "returns", "decorator_list", "type_params"}


class Edit(NamedTuple):
    """Replace text[start:stop], which is `old`, by `new`; kind: what sort of mistake it is; line: where, from 1."""

    kind: str
    line: int
    start: int
    stop: int
    old: str
    new: str

    def of(self, text: str) -> str:
        if text[self.start : self.stop] != self.old:
            raise ValueError(f"line {self.line}: the text is not {self.old!r}")
        return text[: self.start] + self.new + text[self.stop :]


def edits(text: str) -> list[Edit]:
    """All edits of a module, in their order in it."""
    ends = list(itertools.accumulate((len(line) for line in text.splitlines(keepends=True)), initial=0))
    lines = text.splitlines(keepends=True)

    def at(line: int, column: int) -> int:
        """Place in the text; columns of the syntax count bytes."""
        return ends[line - 1] + len(lines[line - 1].encode()[:column].decode())

    found = []
    for node in _computing(ast.parse(text)):
        for kind, start, stop, old, new in _of_node(node, text, at):
            found.append(Edit(kind, node.lineno, start, stop, old, new))
    return sorted(set(found), key=lambda one: (one.start, one.new))


def _computing(node: ast.AST) -> Iterator[ast.AST]:
    """Nodes of what is computed: no annotation, default, raised error, assertion, record's words or bare text."""
    if _is_said(node):
        return
    if isinstance(node, ast.expr):
        yield node
    # `for _ in`: how many steps, at most
    left_out = _NOT_COMPUTED | ({"iter"} if isinstance(node, ast.For) and _name(node.target) == "_" else set())
    for name, value in ast.iter_fields(node):
        for child in value if isinstance(value, list) else [value]:
            if name not in left_out and isinstance(child, ast.AST):
                yield from _computing(child)


def _is_said(node: ast.AST) -> bool:
    if isinstance(node, ast.Raise | ast.Assert | ast.Import | ast.ImportFrom | ast.arguments | ast.JoinedStr):
        return True
    return (isinstance(node, ast.Call) and _name(node.func) in _SAID) or (
        isinstance(node, ast.If) and _name(node.test) == "TYPE_CHECKING"
    )


def _name(node: ast.AST) -> str:
    return node.id if isinstance(node, ast.Name) else node.attr if isinstance(node, ast.Attribute) else ""


def _of_node(node, text, at) -> Iterator[tuple[str, int, int, str, str]]:
    """(kind, start, stop, old, new) of the edits of one node."""

    def span(one) -> tuple[int, int]:
        return at(one.lineno, one.col_offset), at(one.end_lineno, one.end_col_offset)

    match node:
        case ast.BinOp() if not (_is_text(node.left) or _is_text(node.right)):
            yield from _between(text, span(node.left)[1], span(node.right)[0], node.op)
        case ast.Compare(ops=[operator], comparators=[right]):
            yield from _between(text, span(node.left)[1], span(right)[0], operator)
        case ast.BoolOp(values=[left, right]):
            yield from _between(text, span(left)[1], span(right)[0], node.op)
        case ast.UnaryOp(op=ast.USub()):
            yield "minus", span(node)[0], span(node)[0] + 1, "-", ""
        case ast.Call() if _name(node.func) != "range":
            yield from _of_call(node, text, span)
        case ast.Subscript(slice=ast.Constant(value=int(index))) if not isinstance(index, bool):
            start, stop = span(node.slice)
            yield "index", start, stop, text[start:stop], str(index + 1 if index == 0 else index - 1)
        case ast.Constant(value=int() | float() as value) if not isinstance(value, bool) and _matters(value):
            start, stop = span(node)
            yield "constant", start, stop, text[start:stop], _changed(value)


def _between(text: str, start: int, stop: int, operator: ast.AST) -> Iterator[tuple[str, int, int, str, str]]:
    """An operator between two operands; brackets and breaks of lines there stay."""
    if type(operator) not in _OPERATORS:
        return
    kind, old, *others = _OPERATORS[type(operator)]
    if text[start:stop].strip(" \n\\()") == old:
        place = start + text[start:stop].index(old)
        for new in others:
            yield kind, place, place + len(old), old, new


def _is_text(node: ast.AST) -> bool:
    return isinstance(node, ast.JoinedStr) or (isinstance(node, ast.Constant) and isinstance(node.value, str))


def _matters(value: float) -> bool:
    """Not a tolerance, nor a number that stands for nothing or for everything: a per cent of those changes no result."""
    return value == 0 or 1e-6 < abs(value) < 1e6


def _changed(value: float) -> str:
    """A whole number by one, any other by a per cent."""
    return str(value + 1) if isinstance(value, int) else repr(value * 1.01 if value else 0.01)


def _of_call(node: ast.Call, text: str, span) -> Iterator[tuple[str, int, int, str, str]]:
    other = _OTHER_ENDS.get(_name(node.func))
    if other:
        stop = span(node.func)[1]
        old = _name(node.func)
        yield "function", stop - len(old), stop, old, other
    if len(node.args) >= 2 and all(isinstance(one, ast.Name) for one in node.args[:2]):
        (start, middle), (again, stop) = span(node.args[0]), span(node.args[1])
        first, second = text[start:middle], text[again:stop]
        if first != second and not other:
            yield "arguments", start, stop, text[start:stop], second + text[middle:again] + first
