"""Messages between the server and its workers: a length of four bytes, then MessagePack. Nothing is pickled."""

from typing import BinaryIO

import msgspec

JSON = "application/json"

MOST = 2**31 - 1
"""Largest number of bytes of a message."""


class Ready(msgspec.Struct, tag="ready", array_like=True):
    """The worker has started and takes requests."""


class Prepared(msgspec.Struct, tag="prepared", array_like=True):
    """The worker has prepared for the requests of its affinity."""


class Ask(msgspec.Struct, tag="ask", array_like=True):
    """A request for a worker.

    function  "module:name" below ilmek.jobs      body  the JSON of its record      project  folder of the project
    lax       texts may stand for numbers, as in a query      content  the field `content` of the record: an upload
    language  of the page, of `ilmek.sentences`
    """

    number: int
    function: str
    body: bytes
    project: str
    lax: bool = False
    content: bytes | None = None
    language: str = ""


class Cancel(msgspec.Struct, tag="cancel", array_like=True):
    """The request of a number is no longer wanted."""

    number: int


class StepMessage(msgspec.Struct, tag="step", array_like=True):
    """Progress of a request: stage and completed share."""

    number: int
    stage: str
    share: float


class News(msgspec.Struct, tag="news", array_like=True):
    """What a request has to show before its end: JSON.

    everyone  True: for all open pages, whatever request it is; False: for the one who follows the work
    """

    number: int
    body: bytes
    everyone: bool = False


class Reply(msgspec.Struct, tag="answer", array_like=True):
    """The answer to a request.

    status   as of HTTP      kind  media type      time  [s] that the function took
    """

    number: int
    status: int
    kind: str
    body: bytes
    time: float


Message = Ready | Prepared | Ask | Cancel | StepMessage | News | Reply

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
    size = int.from_bytes(head, "little")
    body = stream.read(size) if len(head) == 4 else b""
    return decoded(body) if body and len(body) == size else None


def error_body(given: str, *, allowed: str = "", do: str = "") -> bytes:
    """The JSON of an error as the API has it."""
    return msgspec.json.encode({"error": {"given": given, "allowed": allowed, "do": do}})
