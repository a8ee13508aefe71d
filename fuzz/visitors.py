"""Open the page as many visitors do, one after the other, and print how much memory the server has before, during and after.

    python fuzz/visitors.py [--count 500] [--every 50] [--at-once 1]

A visitor loads the page, opens its websocket, tells how wide the page is, waits until the charts are drawn for that width, and
leaves. Every third leaves within the computation, before the page has arrived. The server forgets a visitor ten seconds after
the websocket has closed, and one who opened none after a minute.
"""

import argparse
import asyncio
import json
import os
import re
import socket
import subprocess
import sys
import tempfile
import time
import uuid
from collections.abc import AsyncIterator, Iterator
from contextlib import asynccontextmanager, contextmanager, suppress
from pathlib import Path

import aiohttp

FORGOTTEN = 75.0  # seconds after which the server has forgotten all visitors
_LEAVES_WITHIN = 0.2  # seconds, in which no page is computed
_PATIENCE = 60.0  # seconds until the charts must be drawn


@contextmanager
def served(case: Path | None = None) -> Iterator[tuple[str, int]]:
    """Yield address and process id of a server of its own, once it answers."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    command = [sys.executable, "-m", "stiction", "serve", *([str(case)] if case else []), "--port", str(port)]
    environment = {name: value for name, value in os.environ.items() if name != "PYTEST_CURRENT_TEST"}
    with tempfile.TemporaryFile() as said, subprocess.Popen(command, env=environment, stdout=said, stderr=said) as server:
        try:
            while True:
                with suppress(OSError), socket.create_connection(("127.0.0.1", port), 60):
                    break
                if server.poll() is not None:
                    said.seek(0)
                    raise RuntimeError(said.read().decode())
                time.sleep(0.2)
            yield f"http://127.0.0.1:{port}", server.pid
        finally:
            server.terminate()
            server.wait(60)


def resident(process: int) -> float:
    """Return the memory of a process, MB; Linux only."""
    status = Path(f"/proc/{process}/status").read_text(encoding="utf-8")
    return int(re.findall(r"VmRSS:\s+(\d+)", status)[0]) / 1024.0


async def visit(session: aiohttp.ClientSession, address: str, state: str = "") -> str:
    """Return the page of a visitor who opens its websocket, waits until the charts are drawn anew, and leaves."""
    async with session.get(address, params={"s": state} if state else None) as answer:
        page = await answer.text()
    client = client_of(page)
    async with websocket(session, address, client) as (stream, said):
        if not said.startswith("40"):
            raise RuntimeError(f"the server does not take the visitor: {said}")
        await asyncio.wait_for(_answer_and_wait(stream, client), _PATIENCE)
    return page


async def _answer_and_wait(stream: aiohttp.ClientWebSocketResponse, client: str) -> None:
    """Answer the first question of the server to the browser, and wait for the elements that change by the answer."""
    answered = False
    async for message in stream:
        if message.data == "2":  # the server asks whether the visitor is still there
            await stream.send_str("3")
        if not message.data.startswith("42"):
            continue
        name, content = json.loads(message.data[2:])
        if name == "run_javascript" and "request_id" in content:
            response = {"request_id": content["request_id"], "client_id": client, "result": [True, 400]}
            await stream.send_str("42" + json.dumps(["javascript_response", response]))
            answered = True
        elif name == "update" and answered:
            return
    raise RuntimeError("the server closed the websocket of a visitor")


def client_of(page: str) -> str:
    """Return the name under which the server knows the visitor of a page."""
    return re.findall(r"""client_id['"]: ?['"]([^'"]+)""", page)[0]


@asynccontextmanager
async def websocket(
    session: aiohttp.ClientSession, address: str, client: str
) -> AsyncIterator[tuple[aiohttp.ClientWebSocketResponse, str]]:
    """Open the websocket of a visitor; yield it with the server's greeting: 40 if the visitor is let in."""
    asked = {"EIO": "4", "transport": "websocket", "client_id": client, "tab_id": str(uuid.uuid4())}
    asked |= {"document_id": str(uuid.uuid4()), "next_message_id": "0", "implicit_handshake": "true"}
    async with session.ws_connect(f"{address}/_nicegui_ws/socket.io/", params=asked, max_msg_size=0) as stream:
        await stream.receive_str()
        await stream.send_str("40")
        yield stream, await stream.receive_str()


async def greeting(session: aiohttp.ClientSession, address: str, client: str) -> str:
    """Return the server's greeting of a visitor: 40 if the visitor is let in."""
    async with websocket(session, address, client) as (_, said):
        return said


async def leave_within(session: aiohttp.ClientSession, address: str, state: str = "") -> None:
    """Ask for the page, and leave before it is computed."""
    with suppress(asyncio.TimeoutError):
        await asyncio.wait_for(visit(session, address, state), _LEAVES_WITHIN)


@asynccontextmanager
async def browser() -> AsyncIterator[aiohttp.ClientSession]:
    """Yield a session, and let its sockets close before the loop ends."""
    async with aiohttp.ClientSession(timeout=aiohttp.ClientTimeout(600.0)) as session:
        yield session
    await asyncio.sleep(_LEAVES_WITHIN)


async def visits(address: str, count: int, at_once: int = 4) -> None:
    """Open and leave the page so many times."""
    places = asyncio.Semaphore(at_once)
    async with browser() as session:

        async def one(number: int) -> None:
            async with places:
                await (leave_within(session, address) if number % 3 == 2 else visit(session, address))

        await asyncio.gather(*map(one, range(count)))


def main() -> None:
    """Print the memory of the server after every so many visitors, and again once it has forgotten them."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=500, help="number of visitors")
    parser.add_argument("--every", type=int, default=50, help="visitors between two figures")
    parser.add_argument("--at-once", type=int, default=1, help="visitors at the same time")
    wanted = parser.parse_args()
    with served() as (address, process):
        asyncio.run(visits(address, 1))
        print(json.dumps({"visitors": 1, "memory [MB]": round(resident(process))}), flush=True)
        for number in range(wanted.every, wanted.count + 1, wanted.every):
            asyncio.run(visits(address, wanted.every, wanted.at_once))
            print(json.dumps({"visitors": 1 + number, "memory [MB]": round(resident(process))}), flush=True)
        time.sleep(FORGOTTEN)
        print(json.dumps({"when all are forgotten [MB]": round(resident(process))}), flush=True)


if __name__ == "__main__":
    main()
