"""Works without a server: those of a page that has gone, and the answers that are kept."""

import asyncio
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from io import BytesIO
from typing import Any
from unittest.mock import AsyncMock, Mock

import pytest
from processes import PATIENCE

from ilmek.web import worker as workers
from ilmek.web.events import EventHub
from ilmek.web.framing import JSON, Ask, Prepared, Ready, Reply, read_message
from ilmek.web.pool import Pool, PoolFull, _Worker
from ilmek.web.worker import Worker
from ilmek.web.works import MOST_KEPT, MOST_KEPT_BYTES, MOST_RUNNING, Works


@dataclass
class FakePool(Pool):
    """Answers by a text, or never."""

    body: bytes | None = None
    cancelled: list[bytes] = field(default_factory=list)

    async def answer(self, *_: Any, **__: Any) -> Reply:
        body = bytes(_[1])
        try:
            while self.body is None:
                await asyncio.sleep(10)
        except asyncio.CancelledError:
            self.cancelled.append(body)
            raise
        return Reply(1, 200, JSON, self.body, 0.0)


def works(body: bytes | None) -> tuple[Works, FakePool]:
    pool = FakePool(".", body=body)
    return Works(pool, EventHub({}, lambda _: None), patience=0.01), pool


async def _until(condition: Callable[[], bool]) -> None:
    async with asyncio.timeout(PATIENCE):
        while not condition():
            await asyncio.sleep(0.001)


def test_the_works_of_a_page_that_does_not_come_back_end() -> None:
    async def scenario() -> None:
        running, pool = works(None)
        running.start("f", b"of one", 1.0, "one")
        other = running.start("f", b"of two", 1.0, "two")
        nobody = running.start("f", b"of nobody", 1.0, "")
        await asyncio.sleep(0)
        running.page_left("one")
        running.page_left("")
        await _until(lambda: bool(pool.cancelled))
        assert pool.cancelled == [b"of one"]
        for number in (other, nobody):
            state = running.state(number)
            assert state is not None
            assert state.status == 202
        await running.close()

    asyncio.run(scenario())


@pytest.mark.parametrize(("size", "kept"), [(10, MOST_KEPT), (MOST_KEPT_BYTES // 4, 4), (2 * MOST_KEPT_BYTES, 1)])
def test_answers_are_kept_up_to_a_number_and_a_size(size: int, kept: int) -> None:
    async def scenario() -> None:
        running, _ = works(bytes(size))
        numbers = []
        for _ in range(MOST_KEPT + 3):
            numbers.append(running.start("f", b"", 1.0, ""))
            await asyncio.sleep(0)

        def there() -> list[int]:
            return [number for number in numbers if running.state(number) is not None]

        await _until(lambda: len(there()) <= kept)
        assert there() == numbers[-kept:]

    asyncio.run(scenario())


def test_too_many_works_are_refused() -> None:
    async def scenario() -> None:
        running, _ = works(None)
        for _ in range(MOST_RUNNING):
            running.start("f", b"", 1.0, "")
        with pytest.raises(PoolFull):
            running.start("f", b"", 1.0, "")
        await running.close()

    asyncio.run(scenario())


def test_a_worker_prepares_until_its_first_request_comes(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(workers, "IDLE", 0.01)
    done: list[int] = []
    answers = BytesIO()
    worker = Worker(BytesIO(), answers)

    def step(number: int) -> None:
        done.append(number)
        if number == 2:
            worker._queue.put(Ask(1, "none:none", b"{}", "."))
        raise RuntimeError("what fails while preparing is reported later")

    def end() -> None:
        raise SystemExit

    with pytest.raises(SystemExit):
        worker.run([partial(step, number) for number in range(5)], [end])
    assert done == [0, 1, 2]
    answers.seek(0)
    assert isinstance(read_message(answers), Ready)
    assert isinstance(read_message(answers), Prepared)
    answer = read_message(answers)
    assert isinstance(answer, Reply)
    assert answer.status == 500


def test_the_worker_of_the_first_view_takes_no_other_request_until_it_is_prepared() -> None:
    async def scenario() -> None:
        pool, process = Pool("."), Mock(stdin=Mock(drain=AsyncMock()))
        files, first = (_Worker(process, ready=True, affinity=name, reserved=name != "") for name in ("", "carpet"))
        pool._workers += [files, first]
        files.request = Mock(long=False)
        assert pool._free("") is None
        assert pool._free("carpet") is first
        pool._serve()
        assert pool._starting == 0, "no further worker starts before the first view is there"
        pool._receive(first, Prepared())
        assert pool._free("") is first

    asyncio.run(scenario())
