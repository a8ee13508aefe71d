"""Visitors of a running server: who leaves within a computation, and what the server keeps of visitors who have left."""

import asyncio
import multiprocessing
import random
import sys
import threading
import uuid
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import pytest

pytest.importorskip("aiohttp")
sys.path.insert(0, str(Path(__file__).parents[2] / "fuzz"))

import numpy as np
import visitors

from stiction.web.address import encoded
from stiction.web.background import STUDIES, Progress
from stiction.web.fields import example_cases, first_case
from stiction.web.query import Query, compared, headline, solved

OTHER = example_cases()["Silver film, 200 nm, on hardened steel, with adhesion"]


@pytest.fixture(scope="module")
def server():
    with visitors.served() as (address, process):
        yield address, process


def _asked(server, *states, leaves=()):
    """Return the pages of visitors who ask at once; those at the places `leaves` are gone before they get one."""

    async def together():
        async with visitors.browser() as session:
            asked = [
                (visitors.leave_within if place in leaves else visitors.visit)(session, server[0], state)
                for place, state in enumerate(states)
            ]
            return await asyncio.gather(*asked)

    return asyncio.run(together())


def test_a_guessed_visitor_is_not_let_in(server):
    """Who visits is a random number of 122 bits; nothing of a page is sent to another one, and nothing is taken from it."""

    async def guessed():
        async with visitors.browser() as session:
            async with session.get(server[0], params={"s": encoded(OTHER)}) as answer:
                client = uuid.UUID(visitors.client_of(await answer.text()))
            guess = str(uuid.uuid4())
            async with session.post(f"{server[0]}/_nicegui/client/{guess}/upload/5", data={"file": "content"}) as upload:
                status = upload.status
            return client, [await visitors.greeting(session, server[0], name) for name in (str(client), guess)], status

    client, (own, other), status = asyncio.run(guessed())
    assert client.version == 4 and own.startswith("40")
    assert other.startswith("44") and status == 404


def test_who_leaves_within_a_computation_does_not_change_the_answer_of_another(server):
    answer = solved(Query(OTHER))
    mu = headline(answer, answer.middle())[0].removeprefix("mu ")  # the page has a Greek letter
    assert mu != headline(solved(Query(first_case())), answer.middle())[0].removeprefix("mu ")
    pages = _asked(server, encoded(OTHER), "", encoded(OTHER), encoded(OTHER), leaves=(0, 1, 2))
    assert pages[:3] == [None] * 3 and mu in pages[3]
    assert mu in _asked(server, encoded(OTHER))[0]


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="this system does not say how much memory a process has")
def test_visitors_who_have_left_leave_no_memory_behind(server):
    """The server forgets them after a minute; a page is 1 MB of elements, so thirty that stayed would be seen."""
    asyncio.run(visitors.visits(server[0], 9))
    before = visitors.resident(server[1])
    asyncio.run(visitors.visits(server[0], 30))
    assert visitors.resident(server[1]) - before < 100.0


@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")  # a file of a half imported module stays open
def test_a_computation_that_is_stopped_leaves_the_next_one_right():
    """A stop may come before a kernel that is compiled, and at any step."""
    query, chance = Query(first_case()), random.Random(1)
    for _ in range(6):
        progress = Progress()
        killer = threading.Timer(chance.uniform(0.0, 1.0), progress.stop)
        killer.start()
        try:
            STUDIES.submit(progress.watched, lambda progress: compared(query, None, progress)).result()
        except KeyboardInterrupt:
            pass
        finally:
            killer.cancel()
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as elsewhere:
        undisturbed = elsewhere.submit(_compared).result()
    after = _compared()
    np.testing.assert_allclose(after["contact_area"], undisturbed["contact_area"], rtol=1e-12)
    assert list(after["status"].values) == list(undisturbed["status"].values)


def _compared():
    return compared(Query(first_case()), None, Progress(600.0))[1]
