"""What stands before the server refuses with a sentence, and lets through what a browser sends."""

import asyncio

import pytest

from stiction.web.guard import LARGEST_UPLOAD, MOST_VISITORS, Guard, names_for

LET_THROUGH = 200


def _ask(kind="http", path="/", method="GET", query=b"", visitors=0, bound="127.0.0.1", **heads):
    """The status and the text with which a request is answered."""
    sent = []

    async def behind(scope, receive, send):
        await send({"type": "http.response.start", "status": LET_THROUGH})
        await send({"type": "http.response.body", "body": b"through"})

    async def send(message):
        sent.append(message)

    given = {"host": "127.0.0.1:8080"} | heads
    headers = [(name.replace("_", "-").encode(), value.encode()) for name, value in given.items()]
    scope = {"type": kind, "path": path, "method": method, "query_string": query, "headers": headers}
    asyncio.run(Guard(behind, names_for(bound), lambda: visitors)(scope, None, send))
    if sent[0]["type"] == "websocket.close":
        return sent[0]["code"], sent[0]["reason"]
    return sent[0]["status"], sent[1]["body"].decode()


def test_a_browser_on_this_machine_is_let_through():
    assert _ask() == (LET_THROUGH, "through")
    assert _ask(origin="http://127.0.0.1:8080")[0] == LET_THROUGH
    assert _ask(method="POST", content_length="1000")[0] == LET_THROUGH
    assert _ask(query=b"s=" + b"a" * 20_000)[0] == LET_THROUGH


@pytest.mark.parametrize(
    ("status", "request_"),
    [
        (413, {"method": "POST", "content_length": str(LARGEST_UPLOAD + 1)}),
        (413, {"method": "POST", "content_length": str(2 * 2**30)}),
        (411, {"method": "POST"}),
        (411, {"method": "POST", "content_length": "-1"}),
        (414, {"query": b"s=" + b"a" * 100_000}),
        (503, {"visitors": MOST_VISITORS}),
        (403, {"origin": "http://elsewhere.example"}),
        (403, {"origin": "null"}),
        (403, {"origin": "http://["}),
        (403, {"origin": "http://127.0.0.1:8080@elsewhere.example"}),
        (403, {"origin": "http://127.0.0.1:9090"}),
        (421, {"host": "elsewhere.example"}),
        (421, {"host": "["}),
        (421, {"host": ""}),
        (421, {"host": "127.0.0.1.elsewhere.example"}),
    ],
)
def test_what_is_refused_is_told_in_a_sentence(status, request_):
    found = _ask(**request_)
    assert found[0] == status and found[1].startswith("Refused: ") and found[1].endswith(".")


def test_a_server_for_others_answers_under_any_name():
    assert _ask(host="laboratory.example:8080", bound="0.0.0.0")[0] == LET_THROUGH
    assert _ask(host="[::1]:8080", bound="::1")[0] == LET_THROUGH
    assert _ask(host="localhost")[0] == LET_THROUGH


def test_a_socket_of_another_page_is_closed():
    code, why = _ask("websocket", path="/_nicegui_ws/socket.io/", origin="http://elsewhere.example")
    assert code == 1008 and why.startswith("Refused: ")
