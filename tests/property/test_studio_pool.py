"""Whatever requests do, each is answered once by what it was, and the pool keeps its size."""

import asyncio
import json
from collections.abc import Iterator
from dataclasses import dataclass

import pytest
import studio_tasks
from hypothesis import given, settings
from hypothesis import strategies as st

from ilmek.web.framing import JSON, Reply
from ilmek.web.pool import Pool, PoolFull

STATUS = {"echo": 200, "sleep": 200, "refused": 422, "fault": 500, "crash": 507, "late": 503}
SIZE = 3


@dataclass(frozen=True)
class Case:
    """A request: what it does, for how long, when it comes and when its client goes [s]; never: it stays."""

    kind: str
    seconds: float
    begin: float
    gone: float | None
    affinity: str
    long: bool


CASES = st.builds(
    Case,
    kind=st.sampled_from(["echo", "echo", "sleep", "sleep", "sleep", "refused", "fault", "crash", "late"]),
    seconds=st.sampled_from([0.0, 0.005, 0.02]),
    begin=st.sampled_from([0.0, 0.0, 0.01, 0.03]),
    gone=st.one_of(st.none(), st.none(), st.sampled_from([0.0, 0.004, 0.02])),
    affinity=st.sampled_from(["", "machine", "chart"]),
    long=st.booleans(),
)


@pytest.fixture(scope="module")
def runner() -> Iterator[tuple[asyncio.Runner, Pool]]:
    with asyncio.Runner() as loop:
        pool = Pool(".", size=SIZE, command=studio_tasks.COMMAND, grace=0.1)
        loop.run(pool.start())
        yield loop, pool
        loop.run(pool.close())
        assert pool.processes() == []


async def outcome(pool: Pool, number: int, case: Case) -> Reply | None:
    """The reply; None: the client went before."""
    await asyncio.sleep(case.begin)
    late = case.kind == "late"
    body = json.dumps({"seconds": 9.0 if late else case.seconds, "deaf": late, "text": str(number)}).encode()
    function = "studio_tasks:sleep" if late else f"studio_tasks:{case.kind}"
    answer = pool.answer(function, body, limit=0.05 if late else 20, affinity=case.affinity, long=case.long)
    try:
        return await asyncio.wait_for(answer, case.gone)
    except TimeoutError:
        return None


@given(st.lists(CASES, min_size=1, max_size=10))
@settings(max_examples=12)
def test_each_request_has_its_own_answer(runner: tuple[asyncio.Runner, Pool], cases: list[Case]) -> None:
    loop, pool = runner

    async def all_outcomes() -> list[Reply | None]:
        return await asyncio.gather(*(outcome(pool, number, case) for number, case in enumerate(cases)))

    for number, (case, reply) in enumerate(zip(cases, loop.run(all_outcomes()), strict=True)):
        if reply is None:
            assert case.gone is not None
            continue
        assert (case.kind, reply.status, reply.kind) == (case.kind, STATUS[case.kind], JSON)
        if reply.status == 200:
            assert json.loads(reply.body)["text"] == str(number)
    assert len(pool.processes()) <= SIZE


def test_a_pool_takes_a_bounded_number_of_requests(runner: tuple[asyncio.Runner, Pool]) -> None:
    loop, pool = runner

    async def many() -> list[object]:
        asks = [pool.answer("studio_tasks:echo", b'{"text": ""}', limit=20) for _ in range(240)]
        return list(await asyncio.gather(*asks, return_exceptions=True))

    replies = loop.run(many())
    assert sum(isinstance(reply, Reply) and reply.status == 200 for reply in replies) >= 200
    assert sum(isinstance(reply, PoolFull) for reply in replies) >= 240 - 200 - SIZE
    assert {type(reply) for reply in replies} == {Reply, PoolFull}
