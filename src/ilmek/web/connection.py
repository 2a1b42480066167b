"""A connection of HTTP that is ended where its other side is too slow: it would be held for ever."""

import asyncio
from typing import Any

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol

HEAD_TIME = 20.0
"""Longest time until the head of a request is there, from the first byte or the connection [s]."""

BODY_TIME = 300.0
"""Longest time until the body of a request is there, from its head [s]."""

READING_TIME = 600.0
"""Longest time in which the other side takes an answer [s]."""


class BoundedConnection(H11Protocol):
    """HTTP as uvicorn serves it, with a limit to each time that the other side can make the server wait."""

    head_time, body_time, reading_time = HEAD_TIME, BODY_TIME, READING_TIME
    _awaited: Any = None
    _arrival: asyncio.TimerHandle | None = None
    _reading: asyncio.TimerHandle | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Wait for the first request."""
        super().connection_made(transport)
        self._watch_arrival()

    def data_received(self, data: bytes) -> None:
        """Take a part of a request."""
        super().data_received(data)
        self._watch_arrival()

    def connection_lost(self, exc: Exception | None) -> None:
        """Nothing is awaited any more."""
        for timer in (self._arrival, self._reading):
            if timer is not None:
                timer.cancel()
        super().connection_lost(exc)

    def pause_writing(self) -> None:
        """The other side does not take the answer as fast as it is sent."""
        super().pause_writing()
        self._reading = self.loop.call_later(self.reading_time, self.transport.abort)

    def resume_writing(self) -> None:
        """The other side has taken what was sent."""
        super().resume_writing()
        if self._reading is not None:
            self._reading.cancel()

    def _watch_arrival(self) -> None:
        """Limit the time until the head, or the body, is there; it begins when its first part is awaited."""
        awaited = self.conn.their_state
        if awaited is self._awaited:
            return
        self._awaited = awaited
        if self._arrival is not None:
            self._arrival.cancel()
        limits = {h11.IDLE: self.head_time, h11.SEND_BODY: self.body_time}
        if awaited in limits:
            self._arrival = self.loop.call_later(limits[awaited], self.transport.abort)
