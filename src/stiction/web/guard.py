"""Refuse requests that are too long, uploads that are too large, and requests from other pages."""

from collections.abc import Awaitable, Callable, MutableMapping
from typing import Any
from urllib.parse import urlsplit

LARGEST_UPLOAD = 64 * 2**20  # bytes, the same for every upload
MOST_VISITORS = 200  # pages open at once
_LONGEST_ADDRESS = 24_000
_LOOPBACK = frozenset({"127.0.0.1", "localhost", "::1"})
Scope = MutableMapping[str, Any]


class Guard:
    """Refuse bad requests before they reach the web application.

    app: the application (ASGI). names: host names under which the server may be called; None for any. visitors: function that
    returns the number of open pages.
    """

    def __init__(
        self, app: Callable[..., Awaitable[None]], names: frozenset[str] | None = None, visitors: Callable[[], int] = int
    ):
        self._app, self._names, self._visitors = app, names, visitors

    async def __call__(self, scope: Scope, receive: Any, send: Any) -> None:
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        status, why = self._refusal(scope)
        if not why:
            await self._app(scope, receive, send)
        elif scope["type"] == "websocket":
            await send({"type": "websocket.close", "code": 1008, "reason": why})
        else:
            body = why.encode()
            head = [(b"content-type", b"text/plain; charset=utf-8"), (b"content-length", str(len(body)).encode())]
            await send({"type": "http.response.start", "status": status, "headers": [*head, (b"connection", b"close")]})
            await send({"type": "http.response.body", "body": body})

    def _refusal(self, scope: Scope) -> tuple[int, str]:
        """Return the HTTP status and message with which a request is refused; (200, "") for an accepted request.

        scope: description of the request by ASGI.
        """
        heads = {key.lower(): value.decode("latin-1") for key, value in scope.get("headers", [])}
        host = heads.get(b"host", "")
        if self._names is not None and _part_of(f"//{host}", "hostname") not in self._names:  # the name has no port
            return 421, "Refused: this server answers only under its own host name."
        if (origin := heads.get(b"origin")) and _part_of(origin, "netloc") != host:
            return 403, "Refused: the request comes from another page."
        if len(scope.get("query_string", b"")) + len(scope["path"]) > _LONGEST_ADDRESS:
            return 414, f"Refused: an address has {_LONGEST_ADDRESS} characters at most."
        if scope["type"] == "http" and scope["path"] == "/" and self._visitors() >= MOST_VISITORS:
            return 503, f"Refused: {MOST_VISITORS} pages are open. Try again in a minute."
        if scope["type"] == "http" and scope["method"] in ("POST", "PUT", "PATCH"):
            length = heads.get(b"content-length", "")
            if not length.isdigit():
                return 411, "Refused: an upload must state its length."
            if int(length) > LARGEST_UPLOAD:
                return 413, f"Refused: an upload has {LARGEST_UPLOAD} bytes at most; stiction surface reads larger scans."
        return 200, ""


def _part_of(address: str, part: str) -> str | None:
    """Return the `hostname` or the `netloc` (host and port) of an address; None if the text is not one, such as "//["."""
    try:
        return getattr(urlsplit(address), part)
    except ValueError:
        return None


def names_for(host: str) -> frozenset[str] | None:
    """Return the names under which a server bound to `host` may be called; None for any name."""
    return _LOOPBACK if host in _LOOPBACK else None
