"""Build the HTML table that a notebook shows for an input record, such as a Contact or a Material."""

from collections.abc import Iterable
from html import escape


def table(title: str, rows: Iterable[tuple[str, str]], notes: Iterable[str] = ()) -> str:
    """Return HTML with a title, a table, and a list of notes below it; all text is escaped.

    rows: pairs (name, text). notes: one text per list item.
    """
    cells = "".join(
        f'<tr><th style="text-align:left">{escape(name)}</th><td style="text-align:left">{escape(text)}</td></tr>'
        for name, text in rows
    )
    items = "".join(f"<li>{escape(note)}</li>" for note in notes)
    below = f"<ul>{items}</ul>" if items else ""
    return f"<div><strong>{escape(title)}</strong><table><tbody>{cells}</tbody></table>{below}</div>"
