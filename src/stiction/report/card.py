"""Build the summary card: mu with its interval as a bar, confidence, sources of uncertainty, a warning and the next step."""

import math
from html import escape
from typing import TYPE_CHECKING, NamedTuple

from stiction.quantities import html
from stiction.report.answer import (
    answer_lines,
    confidence_in_words,
    ends_of_mu,
    next_in_words,
    number,
    working_load_in_words,
    worn_through,
)
from stiction.report.html_words import letters, unbroken
from stiction.studies.prediction.uncertainty_sources import sources_in_words

if TYPE_CHECKING:
    import xarray

_WORDS = 12  # largest number of words of a warning
_WIDTH, _DECADES, _BLUE = 320, (-2, 1), "var(--mark, #0072B2)"  # the bar covers at least 0.01 to 10


class Card(NamedTuple):
    """Store the content of the summary card of a prediction, at its working load.

    mu: predicted friction coefficient. low, high: ends of its prediction interval. level: coverage probability of the interval.
    load: working load as text. confidence: "high", "fair" or "low", with reasons. decides: main sources of uncertainty.
    warning: one short warning, or "". next_step: recommended next step. rows: the full answer as pairs (heading, text). named:
    result of the model that the user named, as text; "" if none was named. worn_through: mu after film or oxide has worn
    through, as text. lowered_by: changes that would lower mu.
    """

    mu: float
    low: float
    high: float
    level: float
    load: str
    confidence: str
    decides: str
    warning: str
    next_step: str
    rows: list[tuple[str, str]]
    named: str = ""
    worn_through: str = ""
    lowered_by: str = ""

    @property
    def interval(self) -> str:
        """Return the interval of mu as text, "low to high", with two significant digits."""
        return f"{number(self.low)} to {number(self.high)}"

    @property
    def lines(self) -> list[tuple[str, str]]:
        """Return the rows that the card shows below mu, as pairs (heading, text); rows without text are left out."""
        rows = [
            ("Confidence", self.confidence),
            ("Lower mu by", self.lowered_by),
            ("Uncertainty from", self.decides),
            ("If worn through", self.worn_through),
            ("Warning", self.warning),
            ("Next", self.next_step),
        ]
        return [(head, text) for head, text in rows if text]

    def bar(self) -> str:
        """Return an SVG drawing of the interval of mu on a logarithmic axis that covers at least 0.01 to 10."""
        known = [value for value in (self.low, self.mu, self.high) if value > 0.0]
        first = min(_DECADES[0], *(math.floor(math.log10(value)) for value in known))
        last = max(_DECADES[1], *(math.ceil(math.log10(value)) for value in known))

        def x(value: float) -> float:
            return 12.0 + (_WIDTH - 24.0) * (math.log10(max(value, 10.0**first)) - first) / (last - first)

        step = -(-(last - first) // 5)
        tick = '<text x="{:.1f}" y="34" text-anchor="middle" font-size="10" fill="currentColor">{:g}</text>'
        ticks = "".join(tick.format(x(value), value) for value in (10.0**power for power in range(first, last + 1, step)))
        return (
            f'<svg role="img" aria-label="mu from {self.interval}" viewBox="0 0 {_WIDTH} 38" style="max-width:30em">'
            f'<line x1="12" x2="{_WIDTH - 12}" y1="12" y2="12" stroke="currentColor" stroke-opacity=".3"/>'
            f'<rect x="{x(self.low):.1f}" y="7" width="{x(self.high) - x(self.low):.1f}" height="10" rx="5" '
            f'style="fill:{_BLUE}" fill-opacity=".45"/><line x1="{x(self.mu):.1f}" x2="{x(self.mu):.1f}" y1="3" y2="21" '
            f'style="stroke:{_BLUE}" stroke-width="3"/>{ticks}</svg>'
        )

    def html(self, why: bool = True) -> str:
        """Return the card as HTML.

        why: whether to add the full answer as a section that the reader can unfold.
        """
        more = ", recommended" if self.named else ""
        big = 'style="font-size:2em;font-weight:650;line-height:1.2"'
        value, by, model = map(escape, self.named.partition(" by "))
        named = f"<p><span {big}>{value}</span>{by}{model}</p>" if self.named else ""
        rows = "".join(
            f"<dt><strong>{letters(head)}</strong></dt><dd>{escape(unbroken(letters(text)))}</dd>" for head, text in self.lines
        )
        folded = f"<details><summary>why</summary>{html.table('', self.rows)}</details>" if why else ""
        return (
            f'<div class="card">{named}<p><span {big}>μ = {number(self.mu)}</span> '
            f"{self.interval} ({self.level:.0%} interval) at\N{NO-BREAK SPACE}{escape(unbroken(self.load))}{more}</p>"
            f"{self.bar()}<dl>{rows}</dl>{folded}</div>"
        )


def card_of(data: "xarray.Dataset", named: str = "") -> Card:
    """Return the summary card of a prediction at its working load.

    data: result of `predict`. named: result of the model that the user named, as text; "" if none was named.
    """
    attrs = data.attrs
    mu, low, high = ends_of_mu(data)
    decides = sources_in_words(attrs["shares"])
    warning = shortened(next(iter(attrs["warnings"]), ""))
    rows = answer_lines(data)
    return Card(
        mu, low, high, attrs["level"], working_load_in_words(data), _confidence(data), decides, warning, next_in_words(data),
        rows, named, worn_through(attrs["bare_metal"]), attrs["lowered_by"],
    )  # fmt: skip


def _confidence(data: "xarray.Dataset") -> str:
    """Return the confidence with a reason, such as "low (wide interval)" or "fair; all 5 handbook contacts agree".

    Handbook contacts do not support a low confidence. They are also left out if there are none, or if the user measured
    friction.
    """
    words, (held, contacts) = confidence_in_words(data), data.attrs["in_handbooks"]
    if not contacts or "measured" in data.attrs or words.startswith("low"):
        return words
    return f"{words}; {f'{held} of {contacts}' if held < contacts else f'all {contacts}'} handbook contacts agree"


def shortened(warning: str) -> str:
    """Shorten a warning to at most twelve words: cut it at a colon, then at a comma, then after the twelfth word.

    >>> shortened("The interface is not stated: mu is 0.06 to 0.3 with boundary lubricant, 0.2 to 1.1 with oxidised metal.")
    'The interface is not stated'
    """
    for mark in (": ", ", "):
        warning = warning.partition(mark)[0] if len(warning.split()) > _WORDS else warning
    return " ".join(warning.split()[:_WORDS])
