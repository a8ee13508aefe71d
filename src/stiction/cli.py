"""The command line. What is slow to import is imported inside the commands, so that `stiction --help` answers at once."""

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from typer.core import TyperGroup

from . import __version__
from .errors import InputError
from .quantities import QUANTITIES

if TYPE_CHECKING:
    import xarray

    from .case import Case
    from .claims import ClaimMap
    from .figures import PanelCurves

_BAD_INPUT, _INTERRUPTED = 2, 130
# Inputs of the Python interface that no case file has.
_NOT_IN_CASES = ("interfacial_energy", "equilibrium_distance")


class _Commands(TyperGroup):
    """Bad input is one line and exit code 2, an interruption exit code 130; neither is a traceback."""

    def invoke(self, ctx):
        try:
            return super().invoke(ctx)
        except InputError as error:
            print(f"stiction: {error}", file=sys.stderr)
            raise typer.Exit(_BAD_INPUT) from None
        except KeyboardInterrupt:
            print("stiction: interrupted", file=sys.stderr)
            raise typer.Exit(_INTERRUPTED) from None


app = typer.Typer(
    cls=_Commands,
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)


def _bounds(name: str) -> str:
    """Meaning, bounds and unit of a quantity, for --help."""
    quantity = QUANTITIES[name]
    return f"{quantity.meaning}; {quantity.wanted}"


def _case_numbers() -> str:
    """Unit and bounds of every number of a case file, a paragraph for each, for --help."""
    rows = [row for row in QUANTITIES.values() if row.example and row.name not in _NOT_IN_CASES]
    lines = [f"{row.name}: {row.meaning}; {row.wanted}" for row in rows]
    return "\n\n".join(["Numbers of a case file, text with its unit where it has one:", *lines])


_Out = Annotated[Path | None, typer.Option("--out", help="Folder for the results; other files in it stay.")]
_Json = Annotated[bool, typer.Option("--json", help="Print one JSON object and nothing else.")]
_Reading = Annotated[str | None, typer.Option(help="corrected (default), or published: the 2015 paper to the letter.")]


def _version(wanted: bool) -> None:
    if wanted:
        print(f"stiction {__version__}")
        raise typer.Exit


@app.callback()
def _stiction(
    version: Annotated[bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version.")] = False,
) -> None:
    """Static friction of rough, adhesive, possibly soft-coated contacts: every number with its source."""


@app.command(epilog=_case_numbers())
def run(
    case: Annotated[Path, typer.Argument(metavar="CASE.toml", help="Case file: what is in contact and what to solve.")],
    out: _Out = None,
    model: Annotated[str | None, typer.Option(help="Key of a rough-surface model, see: stiction models.")] = None,
    asperity: Annotated[str | None, typer.Option(help="Asperity law in place of its own.")] = None,
    tangential: Annotated[str | None, typer.Option(help="Tangential law in place of its own; none: contact only.")] = None,
    coating_law: Annotated[str | None, typer.Option(help="Film law in place of its own.")] = None,
    reading: _Reading = None,
    branch: Annotated[str | None, typer.Option(help="loading (default) or unloading.")] = None,
    transition: Annotated[str | None, typer.Option(help="How a bare asperity turns plastic: jump (default), gradual.")] = None,
    json: _Json = False,
) -> None:
    """Solve a case: friction coefficient, contact area and load along a curve.

    With --out: curve.csv, curve.nc (netCDF4) and curve.png. Options given here override those of the case file.
    """
    from .output import check_folder

    if out is not None:
        check_folder(out)
    with _busy("Reading the case"):
        from .case import read_case

        chosen = read_case(case)
    laws = {"model": model, "asperity": asperity, "tangential": tangential, "coating_law": coating_law}
    data = _solve(chosen, laws, {"reading": reading, "branch": branch, "transition": transition})
    if out is not None:
        _write_run(out, chosen, data)
    _print_run(chosen, data, out, json)


def _solve(case: "Case", laws: dict[str, str | None], options: dict[str, str | None]) -> "xarray.Dataset":
    with _busy(_solving()):
        from .output import groups_of
        from .solve import solve

        choice = case.choice.with_changes(laws, options)
        data = solve(case.subject, separation=case.separation, load=case.load, **choice.arguments())
        title = {"case": case.title} if case.title else {}
        return data.assign_attrs(title, program=f"stiction {__version__}", **groups_of(case.subject))


def _write_run(out: Path, case: "Case", data: "xarray.Dataset") -> None:
    with _busy("Writing the results"):
        from .output import write_csv, write_folder, write_netcdf, write_picture
        from .plot import curve_figure

        files = {
            "curve.csv": lambda path: write_csv(data, path),
            "curve.nc": lambda path: write_netcdf(data, path),
            "curve.png": lambda path: write_picture(curve_figure(data, case.title), path),
        }
        write_folder(out, files)


def _print_run(case: "Case", data: "xarray.Dataset", out: Path | None, json: bool) -> None:
    from .output import as_json, groups_of, record

    if json:
        print(as_json(record(data, groups_of(case.subject))))
        return
    from rich.text import Text

    from .tables import curve_table, outside_validity, run_notes, run_summary

    console = _console()
    console.print(run_summary(case, data), "", curve_table(data), "")
    for note in run_notes(data):
        console.print(Text(note, style="dim"))
    beyond = outside_validity(data)
    if beyond is not None:
        console.print(beyond)
    if out is not None:
        console.print(f"written to {out}: curve.csv, curve.nc, curve.png", highlight=False, markup=False, soft_wrap=True)


@app.command()
def compare(
    case: Annotated[Path, typer.Argument(metavar="CASE.toml", help="Case file: what is in contact.")],
    load: Annotated[str | None, typer.Option(help='Working load, e.g. "1 N"; default: the middle load of the case.')] = None,
    out: _Out = None,
    json: _Json = False,
) -> None:
    """Every applicable model on one contact: friction of each, their spread at the working load, and which to trust.

    A contact that states an interfacial_shear_strength gets a friction coefficient from models of contact only, too.
    With --out: compare.csv, compare.nc (netCDF4) and compare.png.
    """
    from .output import as_json, check_folder

    if out is not None:
        check_folder(out)
    with _busy("Reading the case"):
        from .case import read_case
        from .compare import compare as compare_models
        from .compare import comparison, working_load

        chosen = read_case(case)
        at = working_load(chosen, load)
    data = compare_models(chosen.subject, load=at, progress=_bar("Asking the models"))
    data = data.assign_attrs({"case": chosen.title} if chosen.title else {}, program=f"stiction {__version__}")
    if out is not None:
        _write_comparison(out, data, chosen.title)
    if json:
        print(as_json(comparison(data)))
        return
    from .tables import comparison_summary, comparison_table

    console = _console()
    console.print(comparison_table(data))
    for line in comparison_summary(data):
        console.print(line)
    if out is not None:
        console.print(f"written to {out}: compare.csv, compare.nc, compare.png", highlight=False, markup=False, soft_wrap=True)


def _write_comparison(out: Path, data: "xarray.Dataset", title: str) -> None:
    with _busy("Drawing"):
        from .compare import comparison_rows
        from .output import write_folder, write_netcdf, write_picture, write_rows
        from .plot import comparison_figure

        files = {
            "compare.csv": lambda path: write_rows(path, *comparison_rows(data)),
            "compare.nc": lambda path: write_netcdf(data, path),
            "compare.png": lambda path: write_picture(comparison_figure(data, title), path),
        }
        write_folder(out, files)


@app.command()
def figures(
    theta: Annotated[float, typer.Option(help=_bounds("theta"))] = 40.0,
    lam: Annotated[float, typer.Option(help=_bounds("lam"))] = 10.0,
    reading: _Reading = None,
    out: Annotated[Path, typer.Option(help="Folder for the pictures and tables; other files in it stay.")] = Path("figures"),
    json: _Json = False,
) -> None:
    """Figures 1 to 3 of the 2015 paper, and where in the plane of theta and lambda each of its claims holds.

    theta and lambda of the figures are not printed in the paper: 40 and 10 show its claims (a) to (c). The map of the claims
    covers theta 1 to 1e4 and lambda 1e-3 to 1e4 in both readings. Written: fig1a.png to fig3.png, curves.csv, claims.png,
    claims.csv.
    """
    from .output import as_json, check_folder

    check_folder(out)
    with _busy(_solving()):
        from .figures import PANELS, panel_curves

        panels = [panel_curves(panel, theta, lam, reading or "corrected") for panel in PANELS]
    from .claims import claim_map, summary

    claims = claim_map(progress=_bar("Judging the claims"))
    rows = summary(claims, theta, lam)
    with _busy("Drawing"):
        _write_figures(out, panels, claims, {"theta": theta, "lam": lam})
    if json:
        print(as_json({"theta": theta, "lambda": lam, "reading": reading or "corrected", "claims": rows}))
        return
    from .tables import claims_meaning, claims_table

    console = _console()
    console.print(claims_meaning(rows), "", "Shares of the plane theta 1 to 1e4, lambda 1e-3 to 1e4, logarithmic:")
    console.print(claims_table(rows, f"theta {theta:g}\nlambda {lam:g}"))
    console.print("theta and lambda of the figures are not printed in the paper: those used were chosen.", highlight=False)
    console.print(f"written to {out}", highlight=False, markup=False, soft_wrap=True)


def _write_figures(out: Path, panels: "list[PanelCurves]", claims: "ClaimMap", here: dict[str, float]) -> None:
    from functools import partial

    from .claims import claim_rows
    from .figures import curve_rows
    from .output import write_folder, write_picture, write_rows
    from .plot import claims_figure, panel_figure

    def draw(make: Any, path: Path) -> None:
        write_picture(make(), path)

    files: dict[str, Callable[[Path], None]] = {}
    files |= {f"{curves.panel.name}.png": partial(draw, partial(panel_figure, curves)) for curves in panels}
    files["claims.png"] = partial(draw, partial(claims_figure, claims, here))
    files["curves.csv"] = lambda path: write_rows(path, *curve_rows(panels))
    files["claims.csv"] = lambda path: write_rows(path, *claim_rows(claims))
    write_folder(out, files)


@app.command()
def models(
    keys: Annotated[list[str] | None, typer.Argument(metavar="[KEY]...", help="Say all of these; else a line of each.")] = None,
    json: _Json = False,
) -> None:
    """Every model and law: key, kind, provenance grade, source, range of validity; what is missing where there is none."""
    from .overview import models as all_models

    rows = all_models(keys or None)
    if json:
        from .output import as_json

        print(as_json(rows))
        return
    from .tables import grades, model_in_full, models_tables

    console = _console()
    for row in rows if keys else ():
        console.print(model_in_full(row), "")
    if not keys:
        console.print(models_tables(rows), grades())


@app.command()
def cite(
    keys: Annotated[list[str] | None, typer.Argument(metavar="[KEY]...", help="Models or entries; all if none.")] = None,
) -> None:
    """BibTeX of models, film laws and entries of the bibliography."""
    from .overview import cite as bibtex_of

    print(bibtex_of(keys or None), end="")


@app.command()
def schema(out: Annotated[Path | None, typer.Option(help="File to write to; else it is printed.")] = None) -> None:
    """JSON schema of a case file, for editors that complete and check TOML."""
    from .case import json_schema
    from .output import as_json

    text = as_json(json_schema())
    if out is None:
        print(text)
        return
    try:
        out.write_text(text + "\n", encoding="utf-8")
    except OSError as error:
        raise InputError("--out", str(out), f"a file that can be written ({error.strerror})") from None


def _console():
    from rich.console import Console

    return Console()


def _solving() -> str:
    """What the waiting line says: a model's first use on this machine takes some ten seconds more."""
    from .compiled import cache_folder

    compiled = any(cache_folder().rglob("*.nbi"))
    return "Solving" if compiled else "Compiling kernels (once per installation, 10 s)"


@contextmanager
def _busy(text: str) -> Iterator[None]:
    """A line with a running clock on the terminal while something goes on, gone when it is done."""
    with _progress() as progress:
        progress.add_task(text, total=None)
        yield


def _bar(text: str):
    """A wrapper of a loop's list that shows how far the loop is."""

    def wrapped(steps):
        with _progress() as progress:
            yield from progress.track(steps, description=text)

    return wrapped


def _progress():
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    console = Console(stderr=True)
    columns = TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn()
    return Progress(*columns, console=console, transient=True, disable=not console.is_terminal)


def main() -> None:
    """Entry point of the command `stiction`."""
    app(prog_name="stiction")
