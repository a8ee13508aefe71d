"""What decides the claims of the 2015 paper: its film law, its tangential law, or how thick its films are beside the contacts.

    python truth/paper_films.py

prints the table of docs/explanation/claims.md: shares of the plane of theta and lambda, 13 x 13 points, where a claim holds
for all films.
"""

from unittest.mock import patch

import numpy as np

from stiction.solving.choice import Choice
from stiction.studies.paper import layered as paper_layered
from stiction.studies.paper.claims import CLAIMS, LAM, THETA, Surfaces, surfaces_at

OF_THE_PAPER = "greenwood_williamson_1966", "roy_chowdhury_ghosh_1994", "savkoor_briggs_1977"


def peeling_alone(coated: bool) -> Choice:
    """The paper's film law, with asperities that peel and do not yield."""
    return Choice(*OF_THE_PAPER, "sequential" if coated else None)


def shares(surfaces) -> list[float]:
    """Of the plane, where each claim holds for all films; surfaces(theta) -> Surfaces at every lambda."""
    judged = [[claim.judge(here)[0] for claim in CLAIMS] for here in map(surfaces, THETA[::2].tolist())]
    return [float(np.mean(one == 1.0)) for one in np.array(judged).swapaxes(0, 1)]


def solved(theta: float) -> Surfaces:
    return surfaces_at(theta, LAM[::2], "layered")


def row(name: str, found: list[float]) -> None:
    print(f"| {name} | {' | '.join(f'{one:.0%}' for one in found)} |", flush=True)


def main() -> None:
    print(f"| film | {' | '.join(f'({claim.key})' for claim in CLAIMS)} |\n|---|{'---|' * len(CLAIMS)}")
    row("law of the paper, peeling or yield", shares(lambda theta: surfaces_at(theta, LAM[::2], "corrected")))
    with patch.object(paper_layered, "choice", peeling_alone):
        row("law of the paper, peeling only", shares(solved))
    for ratio in (None, 1e-2, 1e-1, 1.0):
        sharpness = paper_layered.SHARPNESS if ratio is None else ratio**0.5
        with patch.object(paper_layered, "SHARPNESS", sharpness):
            ends = " to ".join(f"{tau * sharpness:.2g}" for tau in (2.0, 6.0))
            row(f"solved, peeling only, t/sqrt(R sigma) {ends}", shares(solved))


if __name__ == "__main__":
    main()
