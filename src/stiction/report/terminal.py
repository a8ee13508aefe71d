"""Print on a terminal without a line break between a number and its unit."""

from collections.abc import Iterable

from rich.console import Console, ConsoleOptions, RenderableType
from rich.segment import Segment
from rich.text import Text

from stiction.report.html_words import unbroken

_JOINED = "\ue001"  # a character for private use, because rich breaks lines at a no-break space too


class Terminal(Console):
    """Print like a rich console, but never break a line between a number and its unit."""

    def render(self, renderable: RenderableType, options: ConsoleOptions | None = None) -> Iterable[Segment]:
        """Return the rendered segments of a text or another renderable; texts in cells of tables are rendered here too."""
        if not isinstance(renderable, Text):
            return super().render(renderable, options)
        text = renderable.copy()
        text.plain = unbroken(text.plain).replace("\N{NO-BREAK SPACE}", _JOINED)  # styles keep their place
        return (part._replace(text=part.text.replace(_JOINED, " ")) for part in super().render(text, options))
