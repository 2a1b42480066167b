"""The command channel of a running controller: a socket of its journal's folder, for its owner alone.

A client connects, sends one line of JSON, {"command": "hold"}, and gets one line back; the connection then ends. The
server is polled by the loop of the controller: a poll takes a bounded time whatever clients do, and nothing blocks.
"""

import errno
import json
import os
import socket
import stat
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypeAlias

from ilmek.errors import LoomError, shortened
from ilmek.records import JsonObject
from ilmek.report import Json

LONGEST_REQUEST = 500
"""Largest length of a request [bytes]."""

LARGEST_ANSWER = 1_000_000
"""Largest length of an answer that a client reads [bytes]."""

MOST_CLIENTS = 16
"""Largest number of connections at one time; others wait."""

PATIENCE = 2.0
"""Time in which a client must send its request and take its answer [s]."""

ANSWER_TIME = 10.0
"""Time in which a controller must answer [s]."""

_EACH_POLL = 8
"""Largest number of requests that a poll answers."""

_LONGEST_ADDRESS = 103
"""Length of a path that every system takes as the address of a socket [bytes]."""

_BLOCKED = (errno.EAGAIN, errno.EWOULDBLOCK, errno.EINTR)

Handler: TypeAlias = Callable[[str], dict[str, Json]]
"""A command's name -> the answer."""


@dataclass(slots=True)
class _Client:
    socket: socket.socket
    until: float
    request: bytearray = field(default_factory=bytearray)
    answer: bytes = b""


class CommandServer:
    """The socket of a controller. Raises LoomError where the system has none; OSError."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._clients: list[_Client] = []
        self._socket = _socket()
        try:
            with suppress(FileNotFoundError):
                path.unlink()  # of a controller that was killed: the caller has the lock
            with _short(path) as address:
                os.fchmod(self._socket.fileno(), 0o600)  # before it has a name
                self._socket.bind(address)
            path.chmod(0o600)
            self._socket.listen(MOST_CLIENTS)
            self._socket.setblocking(False)
        except BaseException:
            self._socket.close()
            raise

    def poll(self, handler: Handler) -> None:
        """Accept clients and answer their requests, as far as this is possible without waiting."""
        now = time.monotonic()
        while len(self._clients) < MOST_CLIENTS:
            try:
                connection = self._socket.accept()[0]
            except OSError:  # none, or one that has gone, or too many open files
                break
            connection.setblocking(False)
            self._clients.append(_Client(connection, now + PATIENCE))
        answered = 0
        for client in tuple(self._clients):
            if answered == _EACH_POLL:
                break
            if not client.answer and (line := _received(client)) is not None:
                client.answer = _line(_answer(line, handler))
                answered += 1
            if client.until < now or (client.answer and _sent(client)):
                self._close(client)

    def close(self) -> None:
        """Close all connections, and remove the socket."""
        for client in tuple(self._clients):
            self._close(client)
        self._socket.close()
        with suppress(OSError):
            self.path.unlink()

    def _close(self, client: _Client) -> None:
        client.socket.close()
        self._clients.remove(client)


def request(path: Path, command: str) -> JsonObject | None:
    """The answer of the controller that listens at a socket; None if there is none.

    Raises LoomError for a controller that does not answer in ANSWER_TIME, and for an answer that cannot be read.
    """
    try:
        if not stat.S_ISSOCK(path.stat(follow_symlinks=False).st_mode):
            return None
        with _socket() as client:
            client.settimeout(ANSWER_TIME)
            with _short(path) as address:
                client.connect(address)
            client.sendall(_line({"command": command}))
            data = bytearray()
            until = time.monotonic() + ANSWER_TIME
            while part := client.recv(65_536):
                data += part
                if len(data) > LARGEST_ANSWER or time.monotonic() > until:
                    break
        found = json.loads(data)
    except (FileNotFoundError, ConnectionRefusedError):
        return None
    except TimeoutError:
        raise LoomError(
            f"the controller at {path} does not answer", do="end its process: its journal goes on"
        ) from None
    except (ValueError, RecursionError, ConnectionError):
        raise LoomError(f"the controller at {path} gave no answer that can be read", do="try again") from None
    except OSError as error:
        raise LoomError(f"{path} cannot be used: {error.strerror or error}") from error
    if not isinstance(found, dict):
        raise LoomError(f"the controller at {path} gave no answer that can be read", do="try again")
    return found


def _received(client: _Client) -> bytes | None:
    """The request, when it is complete; one that is too long as far as it is read."""
    try:
        part = client.socket.recv(LONGEST_REQUEST + 1 - len(client.request))
    except OSError as error:
        if error.errno not in _BLOCKED:
            client.until = 0.0
        return None
    client.request += part
    end = client.request.find(b"\n")
    if end >= 0 or not part or len(client.request) > LONGEST_REQUEST:
        return bytes(client.request[: end if end >= 0 else None])
    return None


def _sent(client: _Client) -> bool:
    """Whether the answer has been sent whole, or the client has gone."""
    try:
        client.answer = client.answer[client.socket.send(client.answer) :]
    except OSError as error:
        return error.errno not in _BLOCKED
    return not client.answer


def _answer(line: bytes, handler: Handler) -> dict[str, Json]:
    if len(line) > LONGEST_REQUEST:
        return {"ok": False, "reason": f"a request has at most {LONGEST_REQUEST} bytes"}
    try:
        found = json.loads(line)
    except (ValueError, RecursionError):
        return {"ok": False, "reason": 'a request is a line of JSON: {"command": "status"}'}
    if not isinstance(found, dict) or set(found) != {"command"} or not isinstance(found["command"], str):
        return {"ok": False, "reason": 'a request has a command and nothing else: {"command": "status"}'}
    return handler(shortened(found["command"]))


def _line(data: dict[str, Json]) -> bytes:
    return json.dumps(data).encode() + b"\n"


def _socket() -> socket.socket:
    """A socket that commands of other processes do not inherit. Raises LoomError where the system has none."""
    family = getattr(socket, "AF_UNIX", None)
    if family is None:
        raise LoomError("this system has no local sockets", allowed="Linux, macOS")
    return socket.socket(family, socket.SOCK_STREAM)


@contextmanager
def _short(path: Path) -> Iterator[str]:
    """An address for a path of any length: a socket's address has at most 103 bytes, on Linux 107.

    On Linux it is led through a handle of the folder. Raises LoomError where a system has no such names, OSError.
    """
    if len(os.fsencode(path)) <= _LONGEST_ADDRESS:
        yield str(path)
        return
    if not Path("/proc/self/fd").is_dir():
        raise LoomError(f"{path} has too many bytes for a socket", allowed=f"at most {_LONGEST_ADDRESS}")
    folder = os.open(path.parent, os.O_RDONLY)
    try:
        yield f"/proc/self/fd/{folder}/{path.name}"
    finally:
        os.close(folder)
