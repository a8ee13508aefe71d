"""A page as a test reads it: its elements, its text, and whether every one that is opened is closed."""

from html.parser import HTMLParser

__all__ = ["Page"]

_VOID = {"meta", "img", "br", "link", "hr", "input"}


class Page(HTMLParser):
    """elements: (name, attributes) in their order; text: all that is read, in one line; ids: of all elements."""

    def __init__(self, html: str):
        super().__init__(convert_charrefs=True)
        self.elements: list[tuple[str, dict[str, str]]] = []
        self._open: list[str] = []
        self._words: list[str] = []
        self.feed(html.replace("<wbr>", ""))  # a place where a word may be broken is no part of it
        self.close()
        assert not self._open, self._open
        self.text = " ".join(" ".join(self._words).split())
        self.ids = [one["id"] for _, one in self.elements if "id" in one]

    def handle_starttag(self, tag, attrs):
        self.elements.append((tag, {name: value or "" for name, value in attrs}))
        if tag not in _VOID:
            self._open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.elements.append((tag, {name: value or "" for name, value in attrs}))

    def handle_endtag(self, tag):
        assert self._open and self._open.pop() == tag, f"</{tag}> closes nothing"

    def handle_data(self, data):
        if not self._open or self._open[-1] != "style":
            self._words.append(data)

    def named(self, *names: str) -> list[dict[str, str]]:
        """Attributes of all elements of these names."""
        return [attributes for name, attributes in self.elements if name in names]
