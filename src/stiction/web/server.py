"""The server of the page: one process, bound to this machine unless it is told otherwise."""

import socket
from pathlib import Path
from typing import Any

from nicegui import Client, app, ui

from stiction.case.read import read_content
from stiction.quantities.errors import InputError
from stiction.web.address import files_named
from stiction.web.asked import Query, keys_by_choice, option_values, solved
from stiction.web.explorer import close_all
from stiction.web.fields import first_case
from stiction.web.guard import Guard, names_for
from stiction.web.page import make_page

_MOST_CONNECTIONS = 1000
_PATIENCE = 600.0  # seconds for a page: other models have kernels of their own, compiled when they are first asked


def question_of(case: Path | None) -> Query:
    """The case that is served, by its file, or the one that the page begins with. Raises InputError.

    It is solved before there is a page: what is wrong with the file is said at once, and on a new installation kernels are
    compiled and laws imported here, so that the server, once it answers, answers soon.
    """
    if case is None:
        question = Query(first_case())
    else:
        tables = read_content(case)
        question = Query(tables, case.resolve().parent, frozenset(files_named(tables)))
    answer = solved(question)
    if answer.error is not None:
        raise answer.error
    # What the form of every page asks: laws are imported when they are first asked for.
    keys_by_choice(answer.case)
    option_values(answer.data)
    return question


def check_port(host: str, port: int) -> None:
    """Raise InputError for an address that cannot be bound."""
    try:
        family = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0][0]
        with socket.socket(family, socket.SOCK_STREAM) as trial:
            trial.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            trial.bind((host, port))
    except (OSError, OverflowError) as error:
        why = getattr(error, "strerror", None) or str(error)
        raise InputError("--port", port, f"a port of {host} that is free, 1024 to 65535 ({why})") from None


def serve(question: Query, host: str, port: int) -> None:
    """Serve the page of a case, behind its guard, until it is interrupted."""
    app.add_middleware(Guard, names=names_for(host), visitors=lambda: len(Client.instances))

    @ui.page("/", title="stiction", response_timeout=_PATIENCE)
    async def page(s: str = "") -> None:
        await make_page(question, s)

    app.on_shutdown(close_all)
    # Nothing is packed for a browser on this machine, which takes longer than to hand it over; nor is the library asked that
    # makes styles in the browser, which is half of what a page takes there: page.py has the few that are used.
    middleware: dict[str, Any] = {"gzip_middleware_factory": None} if names_for(host) else {}
    ui.run(
        host=host, port=port, title="stiction", dark=None, language="en-US", tailwind=False, show=False, reload=False,
        show_welcome_message=False, reconnect_timeout=10.0, uvicorn_logging_level="warning",
        limit_concurrency=_MOST_CONNECTIONS, h11_max_incomplete_event_size=2**16, **middleware,
    )  # fmt: skip
