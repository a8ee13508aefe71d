"""What the page gives away: the case file, tables and pictures, made by the same functions as those of the command line."""

import tempfile
from pathlib import Path

from stiction.case.text import as_toml
from stiction.report.view import View
from stiction.web.asked import Answer
from stiction.web.working import Progress

# Names of the files.
KINDS = ("case.toml", "curve.csv", "curve.nc", "curve.svg", "curve.png")


def _view(answer: Answer) -> View:
    """Return what `stiction run` shows of the case."""
    assert answer.case is not None and answer.data is not None
    if answer.prediction is not None:
        from stiction.report.views.prediction import prediction_view

        return prediction_view(answer.case, answer.data, "case.toml")
    from stiction.report.views.run import run_view

    return run_view(answer.case, answer.data)


def content(answer: Answer, name: str) -> bytes:
    """One of KINDS, as bytes."""
    if name == "case.toml":
        return as_toml(answer.question.tables).encode()
    with tempfile.TemporaryDirectory(prefix="stiction-") as folder:
        path = Path(folder) / name
        _view(answer).writers()[name.replace(".svg", ".png")](path)
        return path.read_bytes()


def report_of(answer: Answer, progress: Progress) -> bytes:
    """The page of `stiction report`, which takes as long as a study. Raises InputError, and KeyboardInterrupt where it is
    stopped."""
    from stiction.report.html_report import case_as_html

    assert answer.case is not None
    return case_as_html(answer.case, as_toml(answer.question.tables), progress=progress).encode()
