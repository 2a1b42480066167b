"""Messages between the server and its workers: a length of four bytes, then MessagePack. Nothing is pickled."""

from typing import BinaryIO

import msgspec

MOST = 2**31 - 1
"""Largest number of bytes of a message."""


class Ask(msgspec.Struct, tag="ask", array_like=True):
    """A request for a worker: number, "module:name" of the function, and the JSON of its record."""

    number: int
    function: str
    body: bytes
    project: str


class Cancel(msgspec.Struct, tag="cancel", array_like=True):
    """The request of a number is no longer wanted."""

    number: int


class Step(msgspec.Struct, tag="step", array_like=True):
    """Progress of a request: stage and completed share."""

    number: int
    stage: str
    share: float


class News(msgspec.Struct, tag="news", array_like=True):
    """What a request that goes on has to show before its end: JSON."""

    number: int
    body: bytes


class Answer(msgspec.Struct, tag="answer", array_like=True):
    """The answer to a request.

    status   as of HTTP      kind  media type      time  [s] that the function took
    """

    number: int
    status: int
    kind: str
    body: bytes
    time: float


Message = Ask | Cancel | Step | News | Answer

_ENCODER = msgspec.msgpack.Encoder()
_DECODER: msgspec.msgpack.Decoder[Message] = msgspec.msgpack.Decoder(Message)


def encoded(message: Message) -> bytes:
    """The bytes of a message with their length before them. Raises ValueError for more than MOST bytes."""
    body = _ENCODER.encode(message)
    if len(body) > MOST:
        raise ValueError(f"a message of {len(body):,} bytes")
    return len(body).to_bytes(4, "little") + body


def decoded(body: bytes) -> Message:
    """The message of bytes without their length."""
    return _DECODER.decode(body)


def read_message(stream: BinaryIO) -> Message | None:
    """The next message of a stream; None at its end."""
    head = stream.read(4)
    if len(head) < 4:
        return None
    size = int.from_bytes(head, "little")
    body = stream.read(size)
    return decoded(body) if len(body) == size else None
