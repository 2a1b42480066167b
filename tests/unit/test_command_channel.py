"""The command channel: one line in, one line out; no client can stall the loop or reach beyond it."""

import contextlib
import json
import socket
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from ilmek.io.command_channel import LONGEST_REQUEST, MOST_CLIENTS, CommandServer, request


def handler(command: str) -> dict[str, Any]:
    return {"ok": command == "hold", "reason": command}


@contextlib.contextmanager
def serving(path: Path) -> Iterator[CommandServer]:
    server, end = CommandServer(path), threading.Event()

    def loop() -> None:
        while not end.wait(0.002):
            server.poll(handler)

    thread = threading.Thread(target=loop)
    thread.start()
    try:
        yield server
    finally:
        end.set()
        thread.join()
        server.close()


def raw(path: Path, data: bytes) -> Any:
    with socket.socket(socket.AF_UNIX) as client:
        client.settimeout(5)
        client.connect(str(path))
        with contextlib.suppress(OSError):
            client.sendall(data)
            client.shutdown(socket.SHUT_WR)
        return json.loads(client.recv(10_000))


def test_a_command_is_answered(tmp_path: Path) -> None:
    with serving(tmp_path / "control"):
        assert (tmp_path / "control").stat().st_mode & 0o777 == 0o600
        assert request(tmp_path / "control", "hold") == {"ok": True, "reason": "hold"}
        assert request(tmp_path / "control", "jump") == {"ok": False, "reason": "jump"}
    assert request(tmp_path / "control", "hold") is None
    (tmp_path / "control").touch()
    assert request(tmp_path / "control", "hold") is None


def test_the_path_may_be_long_and_an_old_socket_there(tmp_path: Path) -> None:
    folder = tmp_path / ("d" * 120) / ("e" * 120)
    folder.mkdir(parents=True)
    with serving(folder / "control"):
        assert request(folder / "control", "hold") == {"ok": True, "reason": "hold"}
    old = socket.socket(socket.AF_UNIX)
    old.bind(str(tmp_path / "control"))
    old.close()  # its name stays, as after `kill -9`
    assert request(tmp_path / "control", "hold") is None
    with serving(tmp_path / "control"):
        assert request(tmp_path / "control", "hold") == {"ok": True, "reason": "hold"}


@pytest.mark.parametrize(
    ("data", "reason"),
    [
        (b"\n", "a line of JSON"),
        (b"\xff\xfe\n", "a line of JSON"),
        (b"[" * 400 + b"\n", "a line of JSON"),
        (b"[1]\n", "a command and nothing else"),
        (b'{"command": 1}\n', "a command and nothing else"),
        (b'{"command": "hold", "more": 1}\n', "a command and nothing else"),
        (b"x" * (LONGEST_REQUEST + 100), "at most 500 bytes"),
        (b"", "a line of JSON"),
    ],
)
def test_malformed_requests_are_refused(tmp_path: Path, data: bytes, reason: str) -> None:
    with serving(tmp_path / "control"):
        answer = raw(tmp_path / "control", data)
    assert not answer["ok"]
    assert reason in answer["reason"]


def test_a_flood_does_not_stall_a_poll(tmp_path: Path) -> None:
    server = CommandServer(tmp_path / "control")
    before = {one.name for one in Path("/proc/self/fd").iterdir()}
    clients = []
    for _ in range(2 * MOST_CLIENTS):
        client = socket.socket(socket.AF_UNIX)
        client.setblocking(False)
        with contextlib.suppress(BlockingIOError):
            client.connect(str(tmp_path / "control"))
            client.send(b'{"command": "status"}\n' * 20)
        clients.append(client)
    answered = 0

    def counted(command: str) -> dict[str, Any]:
        nonlocal answered
        answered += 1
        return {"ok": True, "reason": command}

    begin = time.process_time()
    for _ in range(50):
        server.poll(counted)
    assert time.process_time() - begin < 0.5
    assert MOST_CLIENTS <= answered <= 2 * MOST_CLIENTS
    for client in clients:
        client.close()
    server.poll(counted)
    server.poll(counted)
    assert {one.name for one in Path("/proc/self/fd").iterdir()} <= before
    server.close()


def test_a_silent_client_is_dropped(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("ilmek.io.command_channel.PATIENCE", -1.0)
    server = CommandServer(tmp_path / "control")
    with socket.socket(socket.AF_UNIX) as client:
        client.connect(str(tmp_path / "control"))
        server.poll(handler)
        server.poll(handler)
        client.settimeout(5)
        assert client.recv(10) == b""
    server.close()
