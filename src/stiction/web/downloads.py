"""What the page gives away: the case file, tables and pictures, made by the same functions as those of the command line."""

import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from stiction.case.text import as_toml
from stiction.report.files import write_netcdf, write_picture
from stiction.web.asked import Answer
from stiction.web.working import Progress

if TYPE_CHECKING:
    from stiction.report.view import View

__all__ = ["KINDS", "content", "report_of"]


def _view(answer: Answer) -> "View":
    """Return what `stiction run` shows of the case."""
    assert answer.case is not None and answer.data is not None
    if answer.prediction is not None:
        from stiction.report.views.prediction import prediction_view

        return prediction_view(answer.case, answer.data, "case.toml")
    from stiction.report.views.run import run_view

    return run_view(answer.case, answer.data)


def _picture(answer: Answer, path: Path) -> None:
    write_picture(_view(answer).pictures["curve.png"].draw(), path)


def _csv(answer: Answer, path: Path) -> None:
    _view(answer).files["curve.csv"](path)


def _netcdf(answer: Answer, path: Path) -> None:
    data = _view(answer).data
    assert data is not None
    write_netcdf(data, path)


def _toml(answer: Answer, path: Path) -> None:
    path.write_text(as_toml(answer.question.tables), encoding="utf-8")


def report_of(answer: Answer, progress: Progress) -> bytes:
    """The page of `stiction report`, which takes as long as a study. Raises InputError, and KeyboardInterrupt where it is
    stopped."""
    from stiction.report.html_report import case_as_html

    assert answer.case is not None
    return case_as_html(answer.case, as_toml(answer.question.tables), progress=progress).encode()


# Name of the file -> what writes it.
KINDS: dict[str, Callable[[Answer, Path], None]] = {
    "case.toml": _toml,
    "curve.csv": _csv,
    "curve.nc": _netcdf,
    "curve.svg": _picture,
    "curve.png": _picture,
}


def content(answer: Answer, name: str) -> bytes:
    """One of KINDS, as bytes."""
    with tempfile.TemporaryDirectory(prefix="stiction-") as folder:
        path = Path(folder) / name
        KINDS[name](answer, path)
        return path.read_bytes()
