"""Serve the page in one process, to this machine only unless another address is given."""

import gc
import socket
from pathlib import Path
from typing import Any

from nicegui import Client, app, ui

from stiction.case.read import read_content
from stiction.quantities.errors import InputError
from stiction.web.address import files_named
from stiction.web.explorer import close_all
from stiction.web.fields import first_case
from stiction.web.guard import Guard, names_for
from stiction.web.page import make_page
from stiction.web.query import Query, answered, law_names, option_values

_MOST_CONNECTIONS = 1000
# Thresholds of the garbage collection. A page consists of some 10,000 objects that refer to each other. After its visitor has
# left, they stay in memory until the oldest generation is collected, here after about five pages.
_COLLECTED = 5_000, 5, 2
_FORGOTTEN = 60.0  # seconds after which the library forgets the tab of a browser; by default it is 30 days
_PATIENCE = 600.0  # seconds, time limit for building a page; the first use of a model compiles its kernels


def query_of(case: Path | None) -> Query:
    """Return the case that the page starts with, from a case file or the default one, as a `Query`.

    Raises InputError if the case cannot be solved. The case is solved before the server starts. Errors of the file are thus
    reported at once, and kernels are compiled and laws imported before the first visit.
    """
    if case is None:
        query = Query(first_case())
    else:
        tables = read_content(case)
        query = Query(tables, case.resolve().parent, frozenset(files_named(tables)))
    answer = answered(query)
    # Laws are imported on first use, and the form of every page needs these names.
    law_names(answer.case)
    option_values(answer.data)
    return query


def check_port(host: str, port: int) -> None:
    """Raise InputError if the server cannot be bound to this host and port."""
    try:
        family = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0][0]
        with socket.socket(family, socket.SOCK_STREAM) as trial:
            trial.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            trial.bind((host, port))
    except (OSError, OverflowError) as error:
        why = getattr(error, "strerror", None) or str(error)
        raise InputError("--port", port, f"a free port of {host}, 1024 to 65535 ({why})") from None


def serve(query: Query, host: str, port: int) -> None:
    """Serve the page of a case to all visitors until the program is interrupted. Bad requests are refused."""
    app.add_middleware(Guard, names=names_for(host), visitors=lambda: len(Client.instances))

    @ui.page("/", title="stiction", response_timeout=_PATIENCE)
    async def page(s: str = "") -> None:
        await make_page(query, s)

    app.on_shutdown(close_all)
    app.storage.max_tab_storage_age = _FORGOTTEN
    gc.collect()
    gc.freeze()  # otherwise every collection would scan all imported objects, which takes longer than building a page
    gc.set_threshold(*_COLLECTED)
    # Responses to a browser on this machine are not compressed, because compressing takes longer than sending. Tailwind, which
    # makes styles in the browser, takes half the time of a page; it is off, and page.py has the few styles that are used.
    middleware: dict[str, Any] = {"gzip_middleware_factory": None} if names_for(host) else {}
    ui.run(
        host=host, port=port, title="stiction", dark=None, language="en-US", tailwind=False, show=False, reload=False,
        show_welcome_message=False, reconnect_timeout=10.0, uvicorn_logging_level="warning",
        limit_concurrency=_MOST_CONNECTIONS, h11_max_incomplete_event_size=2**16, **middleware,
    )  # fmt: skip
