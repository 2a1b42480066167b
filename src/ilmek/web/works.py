"""Works: requests that go on for long, with a number each. Their progress and end come by events."""

import asyncio
import contextlib
import itertools
from collections.abc import Callable
from dataclasses import dataclass, field

import msgspec

from ilmek.web.events import EventHub
from ilmek.web.framing import JSON, News, Reply, StepMessage, error_body
from ilmek.web.pool import Pool, PoolFull

MOST_KEPT = 50
"""Answers that are kept after the end of their works."""

MOST_KEPT_BYTES = 200_000_000
"""Size of the answers that are kept; the newest is kept whatever its size."""

MOST_RUNNING = 20
"""Works that run or wait at a time."""

PATIENCE = 60.0
"""Time that the works of a page go on after it has gone [s]; within it the page may come back."""


@dataclass(slots=True, eq=False)
class _Work:
    page: str
    task: "asyncio.Task[None] | None" = None
    stage: str = ""
    share: float = 0.0
    answer: Reply | None = None


@dataclass(eq=False, slots=True)
class Works:
    """The works that run, and the answers of those that have ended."""

    pool: Pool
    hub: EventHub
    patience: float = PATIENCE
    _works: dict[int, _Work] = field(default_factory=dict)
    _numbers: "itertools.count[int]" = field(default_factory=lambda: itertools.count(1))

    def start(  # noqa: PLR0917
        self, function: str, body: bytes, limit: float, page: str, content: bytes | None = None, language: str = ""
    ) -> int:
        """The number of a work that begins. Raises PoolFull."""
        if sum(1 for work in self._works.values() if work.answer is None) >= MOST_RUNNING:
            raise PoolFull
        number, work = next(self._numbers), _Work(page)
        self._works[number] = work

        def follow(message: StepMessage | News) -> None:
            self._follow(number, work, message)

        work.task = asyncio.ensure_future(self._run(number, work, (function, body, limit, content, language), follow))
        return number

    async def _run(
        self,
        number: int,
        work: _Work,
        ask: tuple[str, bytes, float, bytes | None, str],
        follow: Callable[[StepMessage | News], None],
    ) -> None:
        function, body, limit, content, language = ask
        try:
            answer = await self.pool.answer(
                function, body, limit=limit, content=content, language=language, long=True, follow=follow
            )
        except PoolFull:
            answer = Reply(0, 503, JSON, error_body("too many requests wait", do="try again"), 0.0)
        except asyncio.CancelledError:
            self._works.pop(number, None)
            self.hub.send({"type": "cancelled", "work": number}, work.page)
            raise
        work.answer = answer
        self._forget_oldest()
        if answer.status == 200:
            self.hub.send({"type": "done", "work": number, "time": answer.time}, work.page)
        else:
            error = msgspec.json.decode(answer.body).get("error")
            self.hub.send({"type": "failed", "work": number, "error": error}, work.page)

    def _follow(self, number: int, work: _Work, message: StepMessage | News) -> None:
        if isinstance(message, StepMessage):
            work.stage, work.share = message.stage, message.share
            event = {"type": "step", "work": number, "stage": message.stage, "share": message.share}
            self.hub.send(event, work.page)
        elif message.everyone:
            self.hub.send({"type": "announced", "news": msgspec.Raw(message.body)})
        else:
            self.hub.send({"type": "news", "work": number, "news": msgspec.Raw(message.body)}, work.page)

    def _forget_oldest(self) -> None:
        ended = [(number, len(work.answer.body)) for number, work in self._works.items() if work.answer is not None]
        while len(ended) > MOST_KEPT or (len(ended) > 1 and sum(size for _, size in ended) > MOST_KEPT_BYTES):
            del self._works[ended.pop(0)[0]]

    def state(self, number: int) -> Reply | None:
        """The answer of a work; status 202 while it goes on; None: there is no such work."""
        work = self._works.get(number)
        if work is None or work.answer is not None:
            return None if work is None else work.answer
        body = msgspec.json.encode({"work": number, "stage": work.stage, "share": work.share})
        return Reply(0, 202, JSON, body, 0.0)

    def cancel(self, number: int) -> bool:
        """Cancel a work that goes on, and forget one that has ended; False: there is no such work."""
        work = self._works.get(number)
        if work is None:
            return False
        if work.answer is not None or work.task is None:
            del self._works[number]
        else:
            work.task.cancel()
        return True

    def page_left(self, page: str) -> None:
        """Cancel the works of a page that does not come back."""
        if page:
            asyncio.get_running_loop().call_later(self.patience, self._cancel_of, page)

    def _cancel_of(self, page: str) -> None:
        if not self.hub.has(page):
            for work in tuple(self._works.values()):
                if work.page == page and work.task is not None:
                    work.task.cancel()

    async def close(self) -> None:
        """Cancel all works."""
        tasks = [work.task for work in self._works.values() if work.task is not None]
        for task in tasks:
            task.cancel()
        with contextlib.suppress(asyncio.CancelledError):
            await asyncio.gather(*tasks, return_exceptions=True)
