"""Name the sources of the uncertainty of a prediction, and choose those that are worth naming."""

_LEAST, _MOST_SOURCES = 0.05, 3  # smallest share of the variance of a named source; largest number of named sources
_NO_REST = 0.005  # largest share of the other sources that is not shown
_NAMES = {
    "interface": "interface strength",
    "area model": "contact area model",
    "adhesion": "adhesion and liquid",
    "junctions": "growth of junctions",
    "squeezed film": "squeezing of the film",
    "chance": "chance, few asperities",
    "sliding": "size of the contact spots",
}
_BODIES = {"first": "first body", "second": "second body", "coating.material": "film", "coating": "film"}
_BODIES |= {f"roughness.{body}": _BODIES[body] for body in ("first", "second")}


def part_name(name: str) -> str:
    """Return the readable name of a source of uncertainty or an input: "hardness of first body" for "first.hardness"."""
    body, _, quantity = name.rpartition(".")
    words = _NAMES.get(name, f"{quantity} of {_BODIES.get(body, body)}" if body else name)
    return words.replace("_", " ").replace("youngs", "Young's").replace("poissons", "Poisson's")


def main_sources(shares: dict[str, float]) -> list[tuple[str, float]]:
    """Return the main sources of uncertainty as pairs (name, share of the variance of ln mu), the largest first.

    shares: share of the variance by name of the source. The list names at most three sources, by these names. Only the largest
    may have a share below 5 %. The last entry, "other", is the difference between 100 % and the sum of their rounded shares; it
    is omitted if it is below 0.5 %. Without shares the list is empty.
    """
    ordered = sorted(shares.items(), key=lambda item: -item[1])
    named = [item for rank, item in enumerate(ordered[:_MOST_SOURCES]) if not rank or item[1] >= _LEAST]
    rest = 1.0 - sum(round(share, 2) for _, share in named)  # uses the rounded shares, because a reader adds them up
    return [*named, ("other", rest)] if named and rest > _NO_REST else named


def sources_in_words(shares: dict[str, float]) -> str:
    """Return the main sources of uncertainty with their shares of the variance as text: "60% interface strength, 9% load".

    shares: share of the variance of ln mu, by name of the source.
    """
    return ", ".join(f"{share:.0%} {part_name(name)}" for name, share in main_sources(shares))
