"""What the page gives away: the case file, tables and pictures, made by the same functions as those of the command line."""

import tempfile
from collections.abc import Callable
from pathlib import Path

from stiction.report.files import comments_of, write_csv, write_netcdf
from stiction.solving.method_spread import as_columns
from stiction.studies.case.text import as_toml
from stiction.studies.uncertainty.bands import as_columns as with_quantiles
from stiction.web.asked import Answer
from stiction.web.working import Progress

__all__ = ["KINDS", "content", "report_of"]


def _picture(answer: Answer, path: Path) -> None:
    from stiction.report.files import write_picture

    assert answer.case is not None and answer.data is not None
    if answer.case.is_several:
        from stiction.report.several_pictures import several_figure

        write_picture(several_figure(answer.data, answer.case.title), path)
        return
    from stiction.report.pictures import curve_figure

    write_picture(curve_figure(answer.data, answer.case.title), path)


def _csv(answer: Answer, path: Path) -> None:
    assert answer.data is not None
    write_csv(with_quantiles(as_columns(answer.data)), path, comments_of(answer.data))


def _netcdf(answer: Answer, path: Path) -> None:
    assert answer.data is not None
    write_netcdf(answer.data, path)


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
