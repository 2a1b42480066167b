"""Events: what the server tells the open pages by WebSocket.

Each event is an object of JSON with `type`:

    hello      the connection is open: the server's `version` and `start`, another number after each start of the server
    step       progress of a work: `work`, `stage`, `share`
    news       what a work has to show before its end: `work`, `news`
    done       a work has ended well: `work`, `time` [s]; its answer is at /api/work/N
    failed     a work has ended with an error: `work`, `error`
    cancelled  a work was cancelled: `work`
    announced  what a request has to tell all pages: `news`
    changed    files of the project came, went or changed: their `paths`
"""

import asyncio
import contextlib
from collections.abc import Callable

import msgspec
from starlette.websockets import WebSocket, WebSocketDisconnect

MOST_UNREAD = 2000
"""Events that wait for a page; one that does not read them is disconnected, and asks again when it comes back."""

MOST_PAGES = 100
"""Connections at a time."""


class EventHub:
    """Sends events to pages; a page gives its name as `?page=NAME`."""

    def __init__(self, hello: dict[str, object], left: Callable[[str], None]) -> None:
        self._hello, self._left = hello, left
        self._pages: dict[asyncio.Queue[bytes | None], str] = {}

    def send(self, event: dict[str, object], page: str = "") -> None:
        """Send an event to one page, or to all."""
        text = msgspec.json.encode(event)
        for queue, name in tuple(self._pages.items()):
            if page and name != page:
                continue
            if queue.qsize() < MOST_UNREAD:
                queue.put_nowait(text)
            else:
                queue.put_nowait(None)
                del self._pages[queue]

    def has(self, page: str) -> bool:
        """Whether a page is connected."""
        return page in self._pages.values()

    def close(self) -> None:
        """Disconnect all pages."""
        for queue in self._pages:
            queue.put_nowait(None)
        self._pages.clear()

    async def serve(self, socket: WebSocket) -> None:
        """Serve one page until it goes."""
        if len(self._pages) >= MOST_PAGES:
            await socket.close(1013, "too many pages")
            return
        await socket.accept()
        page = socket.query_params.get("page", "")[:64]
        queue: asyncio.Queue[bytes | None] = asyncio.Queue()
        queue.put_nowait(msgspec.json.encode({"type": "hello", **self._hello}))
        self._pages[queue] = page
        reader = asyncio.ensure_future(_until_gone(socket))
        writer = asyncio.ensure_future(_written(socket, queue))
        try:
            await asyncio.wait((reader, writer), return_when=asyncio.FIRST_COMPLETED)
        finally:
            reader.cancel()
            writer.cancel()
            await asyncio.gather(reader, writer, return_exceptions=True)
            self._pages.pop(queue, None)
            self._left(page)


async def _until_gone(socket: WebSocket) -> None:
    """Wait for the end of a connection; a page sends nothing, and one that does is disconnected."""
    if (await socket.receive())["type"] != "websocket.disconnect":
        with contextlib.suppress(WebSocketDisconnect, RuntimeError):
            await socket.close(1008, "a page sends nothing")


async def _written(socket: WebSocket, queue: "asyncio.Queue[bytes | None]") -> None:
    with contextlib.suppress(WebSocketDisconnect, RuntimeError):
        while (text := await queue.get()) is not None:
            await socket.send_text(text.decode())
        await socket.close(1001)
