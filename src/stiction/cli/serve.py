"""Define the command `stiction serve`, which opens the web page."""

import sys
from pathlib import Path

from stiction.cli.options import argument, option
from stiction.cli.program import app, busy
from stiction.quantities.extras import require

_LOOPBACK = ("127.0.0.1", "localhost", "::1")


@app.command()
def serve(
    case: Path | None = argument("[CASE.toml]", "Case file to begin with; without one, silver on steel.", None),
    port: int = option("Port of the page.", 8080, min=1, max=65535),
    host: str = option(
        "Network address; any other than the default lets other computers use the page without a password.", "127.0.0.1"
    ),
) -> None:
    """Open a page in the browser that shows friction, models, surfaces and studies, with a control for every number of a case.

    The page works without a network, and its data stay on this machine. The address of the page contains the case, so a copy of
    the address shares it. Uploads are kept in a temporary folder and deleted at the end. Ctrl-C ends the page.
    """
    require("serve", "nicegui", "matplotlib")
    with busy("Starting"):
        from stiction.web.server import check_port, query_of
        from stiction.web.server import serve as run

        check_port(host, port)
        query = query_of(case)
    if host not in _LOOPBACK:
        print(
            f"stiction: {host} is open to other machines: anyone who reaches it can use the page and see the case, without "
            "password or encryption",
            file=sys.stderr,
        )
    shown = f"[{host}]" if ":" in host else host
    print(f"stiction: http://{shown}:{port}/ (Ctrl-C ends it)", flush=True)
    run(query, host, port)
